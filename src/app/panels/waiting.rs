//! A scene that takes long to open: what it is called, that it is on its way, and how not to wait for it.

use std::time::Duration;

use egui::{Align2, Area, Id, ProgressBar, RichText};

use super::Wish;
use super::theme::{colors, floating};
use crate::app::player::Going;

/// What takes less time than this is not worth a word `[s]`.
const PATIENCE: f64 = 0.3;
/// Time between two looks at how long it takes.
const LOOK: Duration = Duration::from_millis(100);

/// Width of the line that says how much is there `[points]`.
const LINE: f32 = 260.0;

/// A scene that is being made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct Opening {
    /// For how long already `[s]`.
    pub(in crate::app) since: f64,
    /// How much of what was done in it is worked out anew, 0 to 1; `None`: it begins at its start.
    pub(in crate::app) share: Option<f32>,
    /// Whether something is there to go back to.
    pub(in crate::app) can_stop: bool,
}

/// Says in the middle that a scene opens, for how long already and how far it is, and offers to stop that, where something is there to go
/// back to.
pub(super) fn show(context: &egui::Context, opening: Opening, title: &str, wishes: &mut Vec<Wish>) {
    let Opening { since, share, can_stop } = opening;
    said(context, (since, share), &words(&format!("Opening {title}"), since), |ui| {
        if can_stop && ui.button("Cancel").on_hover_text("back to the scene before (Esc)").clicked() {
            wishes.push(Wish::StopOpening);
        }
    });
}

/// Says likewise that another time is gone to, which is to be worked out first, and offers not to wait for it.
pub(super) fn going(context: &egui::Context, going: &Going, wishes: &mut Vec<Wish>) {
    let since = going.since.as_secs_f64();
    said(context, (since, Some(going.share)), &words(&going.words, since), |ui| {
        if ui.button("Cancel").on_hover_text("stay at the moment that is shown (Esc)").clicked() {
            wishes.push(Wish::Stay);
        }
    });
}

/// Height of what lies below the line of a clip `[points]`.
const BELOW: f32 = 58.0;

/// Says above the bar below how much of a clip is drawn, and offers to give it up: the world goes on meanwhile.
pub(super) fn filming(context: &egui::Context, share: f32, wishes: &mut Vec<Wish>) {
    Area::new(Id::unique("filming")).anchor(Align2::CENTER_BOTTOM, [0.0, -BELOW]).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new("Writing a clip").color(colors(ui).text));
                ui.add(ProgressBar::new(share).desired_width(0.5 * LINE).desired_height(8.0));
                if ui.button("Give it up").on_hover_text("no clip is written (Esc)").clicked() {
                    wishes.push(Wish::GiveUpClip);
                }
            });
        });
    });
}

/// Whether another time is gone to for so long that it is said.
pub(in crate::app) fn is_said(going: &Going) -> bool {
    going.since.as_secs_f64() >= PATIENCE
}

/// Some words in the middle, with what can be done beside them, and how much is worked out.
fn said(context: &egui::Context, (since, share): (f64, Option<f32>), words: &str, beside: impl FnOnce(&mut egui::Ui)) {
    context.request_repaint_after(LOOK);
    if since < PATIENCE {
        return;
    }
    Area::new(Id::unique("opening")).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label(RichText::new(words).color(colors(ui).text));
                beside(ui);
            });
            if let Some(share) = share {
                ui.add(ProgressBar::new(share).desired_width(LINE).desired_height(8.0));
                ui.label(RichText::new(worked_out(share)).color(colors(ui).weak));
            }
        });
    });
}

/// "Opening A million points, 3 s".
fn words(what: &str, since: f64) -> String {
    if since < 1.0 { what.to_owned() } else { format!("{what}, {since:.0} s") }
}

/// "40 % of what was done is worked out again".
fn worked_out(share: f32) -> String {
    format!("{:.0} % of what was done is worked out again", (100.0 * share).floor())
}

#[cfg(test)]
mod tests {
    use super::super::pointer::click;
    use super::*;

    #[test]
    fn a_clip_that_is_written_is_given_up_by_its_button() {
        let context = egui::Context::default();
        let frame = |events: Vec<egui::Event>| {
            let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(800.0, 600.0)));
            let input = egui::RawInput { screen_rect, events, ..egui::RawInput::default() };
            let mut wishes = Vec::new();
            let mut shown = context.run_ui(input, |ui| filming(ui.ctx(), 0.4, &mut wishes));
            shown.textures_delta.clear();
            let at = context.memory(|memory| memory.area_rect(Id::unique("filming")));
            (at.unwrap_or(egui::Rect::NOTHING), wishes)
        };
        (0..3).for_each(|_| _ = frame(Vec::new()));
        let (at, _) = frame(Vec::new());
        assert!((at.center().x - 400.0).abs() < 1.0 && at.bottom() < 600.0 - 40.0, "{at:?}");
        let button = egui::pos2(at.right() - 40.0, at.center().y);
        let wishes: Vec<Wish> = click(button).into_iter().flat_map(|events| frame(events).1).collect();
        assert_eq!(wishes, [Wish::GiveUpClip]);
    }

    #[test]
    fn what_takes_long_is_said_and_can_be_stopped_where_there_is_a_way_back() {
        let size = |since: f64, share: Option<f32>, can_stop: bool| {
            let context = egui::Context::default();
            let mut size = egui::Vec2::ZERO;
            for _ in 0..2 {
                let mut shown = context.run_ui(egui::RawInput::default(), |ui| {
                    show(ui.ctx(), Opening { since, share, can_stop }, "A million points", &mut Vec::new());
                });
                shown.textures_delta.clear();
                let area = context.memory(|memory| memory.area_rect(Id::unique("opening")));
                size = area.map_or(egui::Vec2::ZERO, |rect| rect.size());
            }
            size
        };
        assert!(size(0.1, None, true).x < 1.0);
        let alone = size(4.0, None, false);
        assert!(alone.x > 100.0 && size(4.0, None, true).x > alone.x + 40.0, "with its button");
        assert!(size(4.0, Some(0.4), false).y > alone.y + 10.0, "with how far it is");
        assert_eq!(worked_out(0.409), "40 % of what was done is worked out again");
        assert_eq!(words("Opening A million points", 4.2), "Opening A million points, 4 s");
        let context = egui::Context::default();
        let seen = |since: u64| {
            for _ in 0..2 {
                let all = Going {
                    words: "Going to 41.3 s".to_owned(),
                    since: Duration::from_millis(since),
                    share: 0.4,
                    to: Some(41.3),
                };
                assert_eq!(is_said(&all), since > 300);
                let mut shown = context.run_ui(egui::RawInput::default(), |ui| going(ui.ctx(), &all, &mut Vec::new()));
                shown.textures_delta.clear();
            }
            context.memory(|memory| memory.area_rect(Id::unique("opening"))).map_or(0.0, |rect| rect.width())
        };
        assert!(seen(100) < 1.0 && seen(900) > 100.0);
    }
}
