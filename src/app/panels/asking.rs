//! A question: before something large comes into the scene, or the program is left.

use egui::{Align2, Area, Button, Id, Order, RichText};

use super::theme::{colors, floating};

/// Width of the panel `[points]`.
const WIDTH: f32 = 360.0;

/// A question with its answers.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Question {
    pub(in crate::app) words: String,
    /// What each is called, and the key for it; Enter gives the first, Esc the last.
    pub(in crate::app) answers: &'static [(&'static str, &'static str)],
}

/// Asks in the middle. Returns the place of the answer, once it is given by a button.
pub(in crate::app) fn show(context: &egui::Context, question: &Question) -> Option<usize> {
    let mut answer = None;
    let area = Area::new(Id::unique("asking")).order(Order::Foreground).anchor(Align2::CENTER_CENTER, [0.0, 0.0]);
    area.show(context, |ui| {
        // Lines of the world behind it would be read with it.
        let ground = floating(ui).fill(colors(ui).panel);
        ground.show(ui, |ui| {
            ui.set_width(WIDTH.min(context.content_rect().width() - 40.0));
            ui.label(RichText::new(&question.words).color(colors(ui).text));
            ui.horizontal(|ui| {
                for (place, (name, key)) in question.answers.iter().enumerate() {
                    let button = match place {
                        0 => Button::new(RichText::new(*name).color(colors(ui).on_accent)).fill(colors(ui).accent),
                        _ => Button::new(*name),
                    };
                    if ui.add(button).on_hover_text(*key).clicked() {
                        answer = Some(place);
                    }
                }
            });
        });
    });
    answer
}
