//! The gallery: pictures of all scenes, and a search among them.

use egui::{Align2, Key, Label, Rect, RichText, ScrollArea, Sense, TextEdit, Window, vec2};

use super::theme::{ACCENT, TEXT, WEAK};
use super::{Facts, PanelState, Wish};
use crate::scene::{Entry, gallery};

/// Size of a thumbnail [points].
pub(in crate::app) const THUMBNAIL: [f32; 2] = [216.0, 135.0];
/// Room between cards [points].
const GAP: f32 = 14.0;

pub(super) fn show(context: &egui::Context, room: Rect, state: &mut PanelState, facts: &Facts, wishes: &mut Vec<Wish>) {
    let mut is_open = true;
    let columns = (((room.width() - 60.0) / (THUMBNAIL[0] + GAP)).floor() as usize).clamp(1, 4);
    let width = columns as f32 * (THUMBNAIL[0] + GAP);
    Window::new("Gallery")
        .id(egui::Id::unique("gallery"))
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(context, |ui| {
            ui.set_width(width);
            let search = TextEdit::singleline(&mut state.search).hint_text("search").desired_width(f32::INFINITY);
            let field = ui.add(search);
            if std::mem::take(&mut state.is_fresh) {
                field.request_focus();
            }
            let found = found(&state.search);
            if field.lost_focus()
                && ui.input(|input| input.key_pressed(Key::Enter))
                && let Some(first) = found.first()
            {
                wishes.push(Wish::OpenScene(first.name));
            }
            ui.add_space(4.0);
            ScrollArea::vertical().max_height((room.height() - 130.0).max(40.0)).auto_shrink([false, true]).show(
                ui,
                |ui| {
                    for row in found.chunks(columns) {
                        ui.horizontal_top(|ui| {
                            ui.spacing_mut().item_spacing.x = GAP;
                            for entry in row {
                                if card(ui, entry, state, entry.title == facts.title) {
                                    wishes.push(Wish::OpenScene(entry.name));
                                }
                            }
                        });
                        ui.add_space(8.0);
                    }
                    if found.is_empty() {
                        ui.weak("no scene is called so");
                    }
                },
            );
        });
    if !is_open {
        state.sheet = None;
    }
}

/// The scenes in whose words all words of a search are.
fn found(search: &str) -> Vec<&'static Entry> {
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    let has = |entry: &&Entry| {
        let text = [entry.name, entry.title, entry.description, entry.to_try].join(" ").to_lowercase();
        words.iter().all(|word| text.contains(word.as_str()))
    };
    gallery().iter().filter(has).collect()
}

/// A scene; returns whether it was clicked.
fn card(ui: &mut egui::Ui, entry: &Entry, state: &PanelState, is_open: bool) -> bool {
    let card = ui.scope_builder(egui::UiBuilder::new().sense(Sense::click()), |ui| {
        ui.set_width(THUMBNAIL[0]);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            let (rect, _) = ui.allocate_exact_size(vec2(THUMBNAIL[0], THUMBNAIL[1]), Sense::hover());
            let painter = ui.painter();
            painter.rect_filled(rect, 8.0, ui.visuals().extreme_bg_color);
            if let Some(texture) = state.thumbnails.get(entry.name) {
                let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                painter.image(texture.id(), rect, whole, egui::Color32::WHITE);
            }
            let is_hovered = ui.response().hovered();
            if is_open || is_hovered {
                let stroke = egui::Stroke::new(2.0, if is_open { ACCENT } else { WEAK });
                painter.rect_stroke(rect, 8.0, stroke, egui::StrokeKind::Inside);
            }
            ui.add(Label::new(RichText::new(entry.title).color(TEXT).strong()).selectable(false));
            ui.add(Label::new(RichText::new(entry.description).color(WEAK).size(12.0)).wrap().selectable(false));
            let to_try = RichText::new(format!("Try: {}", entry.to_try)).color(TEXT).size(12.0);
            ui.add(Label::new(to_try).wrap().selectable(false));
        });
    });
    card.response.clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_finds_words_anywhere_in_any_order() {
        assert_eq!(found("").len(), gallery().len());
        assert!(found("ROPE").iter().any(|entry| entry.name == "rope"));
        assert_eq!(found("shuffled rim source").first().map(|entry| entry.name), Some("rim-relaxed"));
        assert!(found("no such scene at all").is_empty());
    }
}
