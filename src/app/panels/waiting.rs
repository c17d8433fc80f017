//! A scene that takes long to open: what it is called, that it is on its way, and how not to wait for it.

use std::time::Duration;

use egui::{Align2, Area, Id, RichText};

use super::Wish;
use super::theme::{colors, floating};

/// What takes less time than this is not worth a word `[s]`.
const PATIENCE: f64 = 0.3;
/// Time between two looks at how long it takes.
const LOOK: Duration = Duration::from_millis(100);

/// Says in the middle that a scene opens, for so long already `[s]`, and offers to stop that, where something is there to go back to.
pub(super) fn show(context: &egui::Context, (since, can_stop): (f64, bool), title: &str, wishes: &mut Vec<Wish>) {
    context.request_repaint_after(LOOK);
    if since < PATIENCE {
        return;
    }
    Area::new(Id::unique("opening")).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label(RichText::new(words(title, since)).color(colors(ui).text));
                if can_stop && ui.button("Cancel").on_hover_text("back to the scene before (Esc)").clicked() {
                    wishes.push(Wish::StopOpening);
                }
            });
        });
    });
}

/// "Opening A million points, 3 s".
fn words(title: &str, since: f64) -> String {
    if since < 1.0 { format!("Opening {title}") } else { format!("Opening {title}, {since:.0} s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_long_is_said_and_can_be_stopped_where_there_is_a_way_back() {
        let is_shown = |since: f64, can_stop: bool| {
            let context = egui::Context::default();
            let mut width = 0.0;
            for _ in 0..2 {
                let mut shown = context.run_ui(egui::RawInput::default(), |ui| {
                    show(ui.ctx(), (since, can_stop), "A million points", &mut Vec::new());
                });
                shown.textures_delta.clear();
                width =
                    context.memory(|memory| memory.area_rect(Id::unique("opening"))).map_or(0.0, |rect| rect.width());
            }
            width
        };
        assert!(is_shown(0.1, true) < 1.0);
        let alone = is_shown(4.0, false);
        assert!(alone > 100.0 && is_shown(4.0, true) > alone + 40.0, "with its button");
        assert_eq!(words("A million points", 4.2), "Opening A million points, 4 s");
    }
}
