//! The gallery: pictures of all scenes, and a search among them.

use egui::{Align, Key, Label, Layout, Rect, RichText, Role, ScrollArea, Sense, TextEdit, WidgetInfo, vec2};

use super::finding::{found, instead};
use super::theme::colors;
use super::typed::takes_words;
use super::{Facts, PanelState, Wish, cut_off, sheet};
use crate::scene::Entry;

/// Size of a thumbnail `[points]`.
pub(in crate::app) const THUMBNAIL: [f32; 2] = [216.0, 135.0];
/// What the field that a search is written in is called.
const SEARCH: &str = "search the gallery";
/// Said where a thumbnail is not there yet.
const BEING_DRAWN: &str = "is being drawn …";
/// Words that are offered in place of one that finds nothing are in rows so wide `[points]`.
const WORDS: f32 = 440.0;
/// Room between cards `[points]`.
const GAP: f32 = 14.0;
/// Cards in a row at most.
const MOST: usize = 4;

/// How many cards a row has where there is so much room, and how wide it is with them: all of the room, shared evenly `[points]`.
fn columns(room: f32) -> (usize, f32) {
    (((room / (THUMBNAIL[0] + GAP)).floor() as usize).clamp(1, MOST), room)
}

pub(super) fn show(context: &egui::Context, room: Rect, state: &mut PanelState, facts: &Facts, wishes: &mut Vec<Wish>) {
    let (columns, width) = columns(sheet::fitting(context, [MOST as f32 * (THUMBNAIL[0] + GAP), 0.0])[0]);
    let card_width = width / columns as f32 - GAP;
    let stays = sheet::show(context, "gallery", "Gallery", |ui| {
        ui.set_width(width);
        let hint = RichText::new("search …").italics();
        let search = TextEdit::singleline(&mut state.search).id(search_id()).hint_text(hint);
        let field = ui.add(search.desired_width(f32::INFINITY));
        takes_words(&field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, SEARCH));
        if std::mem::take(&mut state.is_fresh) {
            field.request_focus();
        }
        let found = found(&state.search);
        if field.changed() {
            state.chosen = 0;
        }
        let is_moved = choose(ui, state, found.len(), columns);
        if sheet::entered(ui, &field)
            && let Some(chosen) = found.get(state.chosen)
        {
            wishes.push(Wish::OpenScene(chosen.name));
        }
        ui.add_space(4.0);
        let height = (room.height() - 130.0).max(40.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false).show(ui, |ui| {
            if state.search.is_empty() {
                cut_off::show(ui, state, wishes);
            }
            let mut in_view = Vec::new();
            for (number, row) in found.chunks(columns).enumerate() {
                ui.horizontal_top(|ui| {
                    ui.spacing_mut().item_spacing.x = GAP;
                    for (column, entry) in row.iter().enumerate() {
                        let is_chosen = number * columns + column == state.chosen;
                        let card = card(ui, card_width, (entry, state), (entry.title == facts.title, is_chosen));
                        if is_chosen && is_moved {
                            card.scroll_to_me(None);
                        }
                        in_view.extend(ui.is_rect_visible(card.rect).then_some(entry.name));
                        if card.clicked() {
                            wishes.push(Wish::OpenScene(entry.name));
                        }
                    }
                });
                ui.add_space(8.0);
            }
            state.in_view = in_view;
            if found.is_empty() {
                nothing(ui, height, &mut state.search);
            }
        });
    });
    if !stays {
        state.sheet = None;
    }
}

/// In the middle of a sheet so high, where nothing is found: what was looked for, what to look for instead, and a way back to all scenes.
fn nothing(ui: &mut egui::Ui, height: f32, search: &mut String) {
    ui.vertical_centered(|ui| {
        ui.add_space(0.4 * height);
        let looked_for = search.trim();
        ui.add(
            Label::new(RichText::new(format!("Nothing is called “{looked_for}”")).color(colors(ui).text).strong())
                .wrap(),
        );
        let (is_alike, words) = instead(looked_for);
        ui.weak(if is_alike { "is one of these meant?" } else { "there are, among others:" });
        ui.add_space(4.0);
        let width = ui.available_width().min(WORDS);
        ui.allocate_ui_with_layout(vec2(width, 0.0), Layout::left_to_right(Align::Min).with_main_wrap(true), |ui| {
            for word in words {
                if ui.button(word).clicked() {
                    word.clone_into(search);
                    ui.memory_mut(|memory| memory.request_focus(search_id()));
                }
            }
        });
        ui.add_space(8.0);
        if ui.button("Clear the search").clicked() {
            search.clear();
            ui.memory_mut(|memory| memory.request_focus(search_id()));
        }
    });
}

/// The field that a search is written in.
pub(in crate::app) fn search_id() -> egui::Id {
    egui::Id::unique("search")
}

/// The arrow keys choose another scene of those that are found, along the rows while nothing is written. Returns whether they did.
fn choose(ui: &egui::Ui, state: &mut PanelState, count: usize, columns: usize) -> bool {
    let is_pressed = |key| usize::from(ui.input(|input| input.key_pressed(key)));
    let along = usize::from(state.search.is_empty());
    let on = columns * is_pressed(Key::ArrowDown) + along * is_pressed(Key::ArrowRight);
    let back = columns * is_pressed(Key::ArrowUp) + along * is_pressed(Key::ArrowLeft);
    let last = count.saturating_sub(1);
    let chosen = (state.chosen + on).saturating_sub(back).min(last);
    std::mem::replace(&mut state.chosen, chosen) != chosen
}

/// A scene on a card so wide `[points]`, which may be open, and chosen by the keys.
fn card(
    ui: &mut egui::Ui,
    width: f32,
    (entry, state): (&Entry, &PanelState),
    (is_open, is_chosen): (bool, bool),
) -> egui::Response {
    let card = ui.scope_builder(egui::UiBuilder::new().sense(Sense::click()), |ui| {
        ui.set_width(width);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            let (rect, _) = ui.allocate_exact_size(vec2(width, width * THUMBNAIL[1] / THUMBNAIL[0]), Sense::hover());
            let painter = ui.painter();
            painter.rect_filled(rect, 8.0, ui.visuals().extreme_bg_color);
            if let Some(texture) = state.thumbnails.get(entry.name) {
                let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                painter.image(texture.id(), rect, whole, egui::Color32::WHITE);
            } else if state.is_drawing_thumbnails {
                let font = egui::FontId::proportional(12.0);
                painter.text(rect.center(), egui::Align2::CENTER_CENTER, BEING_DRAWN, font, colors(ui).weak);
            }
            let is_hovered = ui.response().hovered();
            if is_open || is_chosen || is_hovered {
                let color = match (is_chosen, is_open) {
                    (true, _) => colors(ui).text,
                    (_, true) => colors(ui).accent,
                    _ => colors(ui).weak,
                };
                let stroke = egui::Stroke::new(if is_chosen { 3.0 } else { 2.0 }, color);
                painter.rect_stroke(rect, 8.0, stroke, egui::StrokeKind::Inside);
            }
            ui.add(Label::new(RichText::new(entry.title).color(colors(ui).text).strong()).selectable(false));
            ui.add(
                Label::new(RichText::new(entry.description).color(colors(ui).weak).size(12.0)).wrap().selectable(false),
            );
            let to_try = RichText::new(format!("Try: {}", entry.to_try)).color(colors(ui).text).size(12.0);
            ui.add(Label::new(to_try).wrap().selectable(false));
        });
    });
    card.response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_open, entry.title));
    card.response
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::gallery;

    #[test]
    fn cards_take_all_of_the_room_that_the_sheet_has() {
        for (room, count) in [(436.0, 1), (656.0, 2), (700.0, 3), (920.0, 4)] {
            assert_eq!(columns(room), (count, room));
        }
        let context = egui::Context::default();
        let mut state = PanelState { sheet: Some(super::super::Sheet::Gallery), ..PanelState::default() };
        // A window that was wide before, and is narrow now.
        for width in [1280.0, 700.0] {
            let room = Rect::from_min_size(egui::Pos2::ZERO, vec2(width, 1000.0));
            for _ in 0..6 {
                let input = egui::RawInput { screen_rect: Some(room), ..Default::default() };
                let mut output = context.run_ui(input, |ui| {
                    show(ui.ctx(), room, &mut state, &Facts::default(), &mut Vec::new());
                });
                output.textures_delta.clear();
            }
            let sheet = context.memory(|memory| memory.area_rect(egui::Id::unique("gallery")));
            let field = context.read_response(search_id());
            let beside = sheet.zip(field).map(|(sheet, field)| sheet.right() - field.rect.right());
            assert!(width > 1000.0 || beside.is_some_and(|beside| beside < 60.0), "{width}: {beside:?}");
        }
    }

    #[test]
    fn what_is_in_view_is_known_so_that_it_is_drawn_first() {
        let mut state = PanelState::default();
        let room = Rect::from_min_size(egui::Pos2::ZERO, vec2(1280.0, 720.0));
        let context = egui::Context::default();
        for _ in 0..3 {
            let input = egui::RawInput { screen_rect: Some(room), ..Default::default() };
            let mut output = context.run_ui(input, |ui| {
                show(ui.ctx(), room, &mut state, &Facts::default(), &mut Vec::new());
            });
            output.textures_delta.clear();
        }
        assert_eq!(state.in_view.first(), Some(&gallery()[0].name));
        assert!((4..30).contains(&state.in_view.len()), "{}", state.in_view.len());
    }
}
