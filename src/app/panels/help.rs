//! The keys, as the program has them.

use egui::{Align, Label, Layout, Rect, RichText, ScrollArea, Ui, vec2};

use super::theme::colors;
use super::{PanelState, sheet};
use crate::app::keys::{TABLE, by_mouse};

/// What the sheet has beside its text, from keys to what they do, and the bar that scrolls it `[points]`.
const BESIDE: f32 = 60.0;
const APART: f32 = 22.0;
const BAR: f32 = 12.0;
/// Widest text, and of it that of the keys, which have less than half of a narrow window `[points]`.
const WIDEST: f32 = 1080.0;
const KEYS: f32 = 380.0;
const SHARE: f32 = 0.45;

pub(super) fn show(context: &egui::Context, room: Rect, state: &mut PanelState) {
    let stays = sheet::show(context, "keys", "Keys", |ui| {
        let height = (room.height() - 90.0).max(40.0);
        let whole = (room.width() - BESIDE).clamp(160.0, WIDEST);
        let of_keys = KEYS.min(SHARE * whole);
        ui.set_width(whole);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.spacing_mut().item_spacing = vec2(APART, 4.0);
            let keys = TABLE.iter().map(|binding| [binding.keys, binding.words]);
            for [keys, words] in by_mouse().into_iter().chain(keys) {
                ui.horizontal_top(|ui| {
                    column(ui, of_keys, RichText::new(keys).color(colors(ui).accent).monospace());
                    column(ui, whole - of_keys - APART - BAR, RichText::new(words));
                });
            }
        });
    });
    if !stays {
        state.sheet = None;
    }
}

/// Text in so much width, on as many lines as that takes.
fn column(ui: &mut Ui, width: f32, text: RichText) {
    ui.allocate_ui_with_layout(vec2(width, 0.0), Layout::top_down(Align::Min), |ui| {
        ui.set_width(width);
        ui.add(Label::new(text).wrap());
    });
}
