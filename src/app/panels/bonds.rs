//! What the bonds of a selection are, in its panel: springs or rigid, on which sides they act, whether they break.

use egui::{DragValue, RichText, Ui};

use super::material::{Sink, row};
use super::theme::colors;
use super::{ranged, ticks};
use crate::app::matter::{Matter, MatterChange, NEVER};
use crate::sim::Limit;

/// What bonds break at when they are first to break `[1]`.
const BREAKS: f64 = 0.5;

/// Springs, rigid or relaxed bonds.
pub(super) fn kinds(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let [rigid, springs, relaxed] = matter.kinds;
    if rigid + springs + relaxed == 0 {
        return;
    }
    row(ui, "bonds", |ui, _| {
        // Three of them have room there.
        (ui.spacing_mut().item_spacing.x, ui.spacing_mut().button_padding.x) = (2.0, 5.0);
        let words = "bonds are springs";
        let springy = ui.selectable_label(springs > 0 && rigid + relaxed == 0, "springy").on_hover_text(words);
        let stiff = ui.selectable_label(rigid > 0 && springs + relaxed == 0, "rigid");
        let stiff = stiff.on_hover_text("bonds keep their lengths");
        if springy.clicked() && rigid + relaxed > 0 {
            sink.set(&springy, MatterChange::Springy);
        }
        if stiff.clicked() && springs + relaxed > 0 {
            sink.set(&stiff, MatterChange::Rigid);
        }
        let lax = ui.selectable_label(relaxed > 0 && rigid + springs == 0, "relaxed");
        let lax = lax
            .on_hover_text("bonds take a share of their error in every sweep: how stiff that is depends on the method");
        if lax.clicked() && rigid + springs > 0 {
            sink.set(&lax, MatterChange::Relaxed);
        }
    });
    if matter.kinds.into_iter().filter(|count| *count > 0).count() > 1 {
        row(ui, "", |ui, _| _ = ui.label(RichText::new("some of each").color(colors(ui).weak)));
    }
}

/// On which sides of their lengths bonds act.
pub(super) fn limits(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    if matter.bonds == 0 {
        return;
    }
    row(ui, "they act", |ui, _| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for ((limit, name, words), count) in [
            (Limit::Both, "both ways", "against being longer and shorter"),
            (Limit::Max, "pull", "as strings: against being longer only"),
            (Limit::Min, "push", "as stops: against being shorter only"),
        ]
        .into_iter()
        .zip(matter.limits)
        {
            let by = ui.selectable_label(count == matter.bonds, name).on_hover_text(words);
            if by.clicked() && count < matter.bonds {
                sink.set(&by, MatterChange::Limit(limit));
            }
        }
    });
}

/// Whether bonds break, and at what strain.
pub(super) fn breaks(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(span) = matter.breaks else { return };
    let mut tears = span.least < NEVER;
    row(ui, "", |ui, _| {
        let by = ticks::check(ui, &mut tears, "tears");
        if by.changed() {
            sink.set(&by, MatterChange::Breaks(if tears { BREAKS } else { NEVER }));
        }
        // What was just asked for is not there yet.
        if !tears || span.least >= NEVER {
            return;
        }
        let mut percent = 100.0 * span.least;
        let field = DragValue::new(&mut percent).speed(0.5).max_decimals(1).prefix("at ");
        let field = match span.same() {
            Some(_) => field.suffix(" %"),
            None => field.suffix(" % or more"),
        };
        let by = ranged::field(ui, field.update_while_editing(false), 0.1..=1000.0, " %");
        let by = by.on_hover_text("stretched so far they tear");
        if by.changed() {
            sink.set(&by, MatterChange::Breaks(percent / 100.0));
        }
    });
}
