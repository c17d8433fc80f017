//! What the program says: faults until they are read, what was just done for a moment, what to try until something is tried.

use std::time::{Duration, Instant};

use egui::{Align2, Area, Button, Id, Label, Rect, RichText};

use super::theme::{ACCENT, AWAY, ON_ACCENT, TEXT, WEAK, floating};
use super::{Facts, Wish};

/// What was just done is said so long.
const MOMENT: Duration = Duration::from_secs(4);

/// What is to be said.
#[derive(Debug, Default)]
pub(in crate::app) struct Notes {
    /// What went wrong, or should be known: until it is closed.
    pub(in crate::app) complaint: Option<String>,
    /// A session that was cut off, which can be gone on with.
    pub(in crate::app) offer: Option<String>,
    /// What was just done, and when.
    done: Option<(String, Instant)>,
    /// Nobody has touched this scene yet: its caption is shown.
    pub(in crate::app) has_caption: bool,
    /// Nobody has touched anything yet: a line at the cursor says how, where the cursor is `[points]`.
    pub(in crate::app) hint_at: Option<egui::Pos2>,
}

/// The line at the cursor.
const HINT: &str = "press and drag: grab it, throw it";

impl Notes {
    /// Says what was just done.
    pub(in crate::app) fn say(&mut self, line: String) {
        self.done = Some((line, Instant::now()));
    }

    /// When something that is said is to go by itself.
    pub(in crate::app) fn until(&self) -> Option<Instant> {
        self.done.as_ref().and_then(|(_, since)| since.checked_add(MOMENT))
    }

    pub(super) fn show(&mut self, context: &egui::Context, room: Rect, facts: &Facts, wishes: &mut Vec<Wish>) {
        self.done.take_if(|(_, since)| since.elapsed() >= MOMENT);
        let width = (room.width() - 120.0).clamp(160.0, 640.0);
        let mut is_read = false;
        let up = room.height() - context.content_rect().height() - 12.0;
        if let Some(complaint) = &self.complaint {
            Area::new(Id::unique("complaint")).anchor(Align2::CENTER_BOTTOM, [0.0, up]).show(context, |ui| {
                floating().show(ui, |ui| {
                    ui.set_max_width(width);
                    ui.horizontal(|ui| {
                        is_read = ui.button("Close").clicked();
                        ui.label(RichText::new("!").color(AWAY).strong());
                        ui.add(Label::new(RichText::new(complaint).color(TEXT)).wrap());
                    });
                });
            });
        } else if let Some((line, _)) = &self.done {
            words(context, (Align2::CENTER_BOTTOM, up), width, "done", |ui| {
                ui.label(RichText::new(line).color(ACCENT));
            });
        } else if let Some([seen, to_try]) = facts.caption.filter(|_| self.has_caption && self.offer.is_none()) {
            // Bodies lie below: the caption stands above them.
            words(context, (Align2::CENTER_TOP, below_buttons(context)), width, "caption", |ui| {
                ui.add(Label::new(RichText::new(seen).color(TEXT)).wrap());
                ui.add(Label::new(RichText::new(format!("Try: {to_try}")).color(WEAK)).wrap());
            });
        }
        if is_read {
            self.complaint = None;
        }
        if let Some(line) = &self.offer {
            offer(context, width, line, wishes);
        }
        if let Some(at) = self.hint_at {
            let place = Area::new(Id::unique("hint")).fixed_pos(at + egui::vec2(18.0, 18.0)).interactable(false);
            place.show(context, |ui| {
                floating().show(ui, |ui| ui.label(RichText::new(HINT).color(TEXT)));
            });
        }
    }
}

/// How far below the upper edge a row of buttons ends, with some room `[points]`.
const BELOW_BUTTONS: f32 = 64.0;

/// The same where they take several rows.
fn below_buttons(context: &egui::Context) -> f32 {
    let buttons = context.memory(|memory| memory.area_rect(Id::unique("scene")));
    buttons.map_or(BELOW_BUTTONS, |place| BELOW_BUTTONS.max(place.bottom() + 8.0))
}

/// A session that was cut off: above, in place of the caption.
fn offer(context: &egui::Context, width: f32, line: &str, wishes: &mut Vec<Wish>) {
    Area::new(Id::unique("offer")).anchor(Align2::CENTER_TOP, [0.0, below_buttons(context)]).show(context, |ui| {
        floating().show(ui, |ui| {
            ui.set_max_width(width);
            ui.horizontal(|ui| {
                ui.add(Label::new(RichText::new(line).color(TEXT)).wrap());
                let go_on = Button::new(RichText::new("Go on with it").color(ON_ACCENT)).fill(ACCENT);
                if ui.add(go_on).clicked() {
                    wishes.push(Wish::GoOnWithLeftover);
                }
                if ui.button("Discard").clicked() {
                    wishes.push(Wish::DiscardLeftover);
                }
            });
        });
    });
}

/// A few words, so far from an edge of the window.
fn words(context: &egui::Context, (edge, off): (Align2, f32), width: f32, name: &str, add: impl FnOnce(&mut egui::Ui)) {
    let place = Area::new(Id::unique(name)).anchor(edge, [0.0, off]).interactable(false);
    place.show(context, |ui| {
        floating().show(ui, |ui| {
            ui.set_max_width(width);
            ui.vertical_centered(add);
        });
    });
}
