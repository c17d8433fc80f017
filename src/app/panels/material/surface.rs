//! How what is selected meets others.

use egui::{DragValue, RichText, Ui};

use super::rows::{SPEED, number, row, share};
use super::sink::Sink;
use crate::app::matter::{Matter, MatterChange, Span};
use crate::app::panels::theme::colors;
use crate::app::panels::{Facts, ticks};

/// Where a drag of the thickness of a skin begins that the rules chose `[m]`.
const THIN: f64 = 0.02;
/// What soft ground pushes with at first `[N/m]`, `[N s/m]`.
const PUSHES: [f64; 2] = [1000.0, 10.0];

/// How it meets others.
pub(super) fn surface(ui: &mut Ui, matter: &Matter, facts: &Facts, sink: &mut Sink<'_>) {
    share(ui, "friction", 2.0, matter.friction, sink, MatterChange::Friction);
    share(ui, "restitution", 1.0, matter.restitution, sink, MatterChange::Restitution);
    if matter.points > 0 && matter.friction.is_some() {
        ui.label(RichText::new("between bodies: walls and obstacles have their own").color(colors(ui).weak));
    }
    skin(ui, matter, sink);
    layers(ui, matter, sink);
    penalty(ui, matter, sink);
    if matter.points > 0 && matter.friction.is_none() && facts.dimensions == 2 {
        ui.label(RichText::new("bodies pass through each other: G, to let them meet").color(colors(ui).weak));
    }
}

/// How thick skins are, where bodies meet.
fn skin(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(radius) = matter.radius else { return };
    if let Some(span) = radius {
        return number(ui, ("skin", " m"), Some(span), sink, |x| Some(MatterChange::Radius(x)));
    }
    row(ui, "skin", |ui, label| {
        let mut value = THIN;
        let field = DragValue::new(&mut value).speed(SPEED * THIN).range(0.0..=1e3).update_while_editing(false);
        let field = ui.add(field.custom_formatter(|_, _| "by the rules".to_owned())).labelled_by(label);
        let by = field.on_hover_text("how thick its skin is: others lie so far off its outline");
        if by.changed() {
            sink.set(&by, MatterChange::Radius(value));
        }
    });
}

/// Whether its parts pass each other, where bodies meet themselves.
fn layers(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(layered) = matter.layered else { return };
    row(ui, "", |ui, _| {
        let mut is_layered = layered == matter.points;
        let words = "its parts are layers that pass each other, as the limbs of a figure do";
        let by = ticks::check(ui, &mut is_layered, "passes itself").on_hover_text(words);
        if by.changed() {
            sink.set(&by, MatterChange::Layered(is_layered));
        }
        if (1..matter.points).contains(&layered) {
            ui.label(RichText::new("some of it").color(colors(ui).weak));
        }
    });
}

/// Whether planes push out what has got into them, in place of contact, and how.
fn penalty(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(now) = matter.penalty else { return };
    row(ui, "", |ui, _| {
        let mut is_soft = now.is_some();
        let words = "what gets into it is pushed out, the harder the deeper it is, in place of contact";
        let by = ticks::check(ui, &mut is_soft, "soft ground").on_hover_text(words);
        if by.changed() {
            sink.set(&by, MatterChange::Penalty(is_soft.then_some(PUSHES)));
        }
    });
    let Some([stiffness, damping]) = now else { return };
    let one = |x: f64| Some(Span { least: x, most: x });
    number(ui, ("push", " N/m"), one(stiffness), sink, |x| Some(MatterChange::Penalty(Some([x, damping]))));
    number(ui, ("damping", " N s/m"), one(damping), sink, |x| Some(MatterChange::Penalty(Some([stiffness, x]))));
}
