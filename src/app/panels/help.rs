//! The keys, as the program has them.

use egui::{Grid, Rect, RichText, ScrollArea};

use super::theme::colors;
use super::{PanelState, sheet};
use crate::app::keys::{TABLE, by_mouse};

pub(super) fn show(context: &egui::Context, room: Rect, state: &mut PanelState) {
    let stays = sheet::show(context, "keys", "Keys", |ui| {
        let height = (room.height() - 90.0).max(40.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            Grid::new("keys").num_columns(2).spacing([22.0, 4.0]).show(ui, |ui| {
                let keys = TABLE.iter().map(|binding| [binding.keys, binding.words]);
                for [keys, words] in by_mouse().into_iter().chain(keys) {
                    ui.label(RichText::new(keys).color(colors(ui).accent).monospace());
                    ui.label(words);
                    ui.end_row();
                }
            });
        });
    });
    if !stays {
        state.sheet = None;
    }
}
