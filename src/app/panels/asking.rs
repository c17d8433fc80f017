//! A question before something large comes into the scene.

use egui::{Align2, Area, Id, Order, RichText};

use super::theme::{colors, floating};

/// Width of the panel `[points]`.
const WIDTH: f32 = 360.0;

/// Asks in the middle. Returns the answer, once it is given by a button; the keys are Enter and Esc.
pub(in crate::app) fn show(context: &egui::Context, words: &str) -> Option<bool> {
    let mut answer = None;
    let area = Area::new(Id::unique("asking")).order(Order::Foreground).anchor(Align2::CENTER_CENTER, [0.0, 0.0]);
    area.show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_width(WIDTH.min(context.content_rect().width() - 40.0));
            ui.label(RichText::new(words).color(colors(ui).text));
            ui.horizontal(|ui| {
                if ui.button("Add").on_hover_text("Enter").clicked() {
                    answer = Some(true);
                }
                if ui.button("Cancel").on_hover_text("Esc").clicked() {
                    answer = Some(false);
                }
            });
        });
    });
    answer
}
