//! How what is selected is drawn.

use egui::{RichText, Ui};

use super::rows::{number, row};
use super::sink::Sink;
use crate::app::matter::{Common, Matter, MatterChange};
use crate::app::panels::theme::colors;
use crate::app::panels::{Facts, Wish, ticks};

/// How it is drawn.
pub(super) fn looks(ui: &mut Ui, matter: &Matter, facts: &Facts, sink: &mut Sink<'_>) {
    color(ui, matter, facts.drawn_color, sink);
    visible(ui, matter, sink);
    if matter.area > 0.0 && facts.dimensions == 2 {
        row(ui, "picture", |ui, label| {
            let by = ui.button("from a file…").labelled_by(label);
            if by.on_hover_text("drawn over all of it, as large as it is now").clicked() {
                sink.wishes.push(Wish::Wear);
            }
        });
    }
    number(ui, ("width", " m"), matter.width, sink, |x| Some(MatterChange::Width(x)));
}

/// Whether it is drawn.
fn visible(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    row(ui, "", |ui, _| {
        let mut is_shown = matter.hidden == 0;
        let words = "what is hidden moves as before; the tool that selects shows its outline";
        let by = ticks::check(ui, &mut is_shown, "visible").on_hover_text(words);
        if by.changed() {
            sink.set(&by, MatterChange::Visible(is_shown));
        }
        if matter.hidden > 0 && matter.hidden < matter.points {
            ui.label(RichText::new("some of it").color(colors(ui).weak));
        }
    });
}

/// The colour of its own, or that which it is drawn in.
fn color(ui: &mut Ui, matter: &Matter, drawn: Option<[u8; 3]>, sink: &mut Sink<'_>) {
    let color = match matter.color {
        Common::One(Some(color)) => color,
        Common::One(None) | Common::Mixed => drawn.unwrap_or([143, 166, 194]),
    };
    row(ui, "colour", |ui, label| {
        let words = "a picture is tinted by it: white leaves that as it is";
        if let Some((by, color)) = crate::app::panels::color::button(ui, color, label, words) {
            sink.set(&by, MatterChange::Color(color));
        }
        match matter.color {
            Common::One(None) => _ = ui.label(RichText::new("its own").color(colors(ui).weak)),
            Common::Mixed => _ = ui.label(RichText::new("mixed").color(colors(ui).weak)),
            Common::One(Some(_)) => {}
        }
    });
}
