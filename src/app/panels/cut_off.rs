//! Sessions that were cut off, in the gallery: a picture and a line each, to be gone on with, or discarded once that is asked.

use std::path::Path;

use egui::{Button, Label, Rect, RichText, Sense, vec2};

use super::theme::colors;
use super::{PanelState, Wish};

/// Size of a picture of one `[points]`.
const PICTURE: [f32; 2] = [112.0, 70.0];

/// So many are listed at first: scenes come soon behind them.
const FIRST: usize = 2;

/// What is asked whether it is to be discarded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Discards {
    /// One, by its place.
    One(usize),
    All,
}

pub(super) fn show(ui: &mut egui::Ui, state: &mut PanelState, wishes: &mut Vec<Wish>) {
    if state.leftovers.is_empty() {
        state.discards = None;
        return;
    }
    ui.horizontal(|ui| {
        ui.label(RichText::new("Sessions that were cut off").color(colors(ui).text).strong());
        let count = state.leftovers.len();
        if state.discards == Some(Discards::All) {
            ask(ui, state, &format!("Discard all {count} for good?"), (Wish::DiscardLeftovers, "Discard all"), wishes);
        } else if count > 1 && ui.button("Discard all …").clicked() {
            state.discards = Some(Discards::All);
        }
    });
    let more = state.leftovers.len().saturating_sub(FIRST);
    let listed = if state.lists_leftovers { usize::MAX } else { FIRST };
    for (place, (path, line)) in state.leftovers.clone().into_iter().enumerate().take(listed) {
        ui.horizontal(|ui| {
            picture(ui, state, &path);
            ui.vertical(|ui| {
                ui.add_space(8.0);
                ui.add(Label::new(RichText::new(line).color(colors(ui).text)).truncate().selectable(false));
                ui.horizontal(|ui| {
                    if state.discards == Some(Discards::One(place)) {
                        return ask(
                            ui,
                            state,
                            "Discard it for good?",
                            (Wish::DiscardLeftover(place), "Discard"),
                            wishes,
                        );
                    }
                    if ui.button("Go on").on_hover_text("as it was when it was cut off").clicked() {
                        wishes.push(Wish::GoOnWithLeftover(place));
                    }
                    if ui.button("Discard …").clicked() {
                        state.discards = Some(Discards::One(place));
                    }
                });
            });
        });
    }
    if more > 0 && !state.lists_leftovers && ui.button(format!("{more} more")).clicked() {
        state.lists_leftovers = true;
    }
    ui.add_space(10.0);
}

/// How it was when it was last written, or where that is going to be seen.
fn picture(ui: &mut egui::Ui, state: &PanelState, path: &Path) {
    let (rect, _) = ui.allocate_exact_size(vec2(PICTURE[0], PICTURE[1]), Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(rect, 6.0, ui.visuals().extreme_bg_color);
    if let Some(texture) = state.cut_off.get(path) {
        let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
        painter.image(texture.id(), rect, whole, egui::Color32::WHITE);
    }
}

/// Asks before what cannot be undone.
fn ask(ui: &mut egui::Ui, state: &mut PanelState, question: &str, (wish, name): (Wish, &str), wishes: &mut Vec<Wish>) {
    ui.label(RichText::new(question).color(colors(ui).text));
    let button = Button::new(RichText::new(name).color(colors(ui).on_accent)).fill(colors(ui).accent);
    if ui.add(button).clicked() {
        state.discards = None;
        wishes.push(wish);
    }
    if ui.button("Keep").clicked() {
        state.discards = None;
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    type Panels = Harness<'static, (PanelState, Vec<Wish>)>;

    fn press(panels: &mut Panels, name: &str) {
        panels.get_by_label(name).click();
        panels.run_steps(4);
    }

    #[test]
    fn two_are_listed_and_all_of_them_by_a_click() {
        let leftovers = (0..9).map(|k| (format!("{k}").into(), format!("number {k}"))).collect();
        let state = PanelState { leftovers, ..PanelState::default() };
        let draw = |ui: &mut egui::Ui, (state, wishes): &mut (PanelState, Vec<Wish>)| show(ui, state, wishes);
        let mut panels: Panels = Harness::new_ui_state(draw, (state, Vec::new()));
        panels.run_steps(4);
        let listed = |panels: &Panels| panels.query_all_by_label("Go on").count();
        assert_eq!(listed(&panels), 2);
        press(&mut panels, "7 more");
        assert_eq!(listed(&panels), 9);
    }

    #[test]
    fn what_is_discarded_for_good_is_asked_about() {
        let leftovers = ["a", "b"].map(|name| (name.into(), format!("{name}, 3 s long"))).to_vec();
        let state = PanelState { leftovers, ..PanelState::default() };
        let draw = |ui: &mut egui::Ui, (state, wishes): &mut (PanelState, Vec<Wish>)| show(ui, state, wishes);
        let mut panels: Panels = Harness::new_ui_state(draw, (state, Vec::new()));
        press(&mut panels, "Discard all …");
        assert!(panels.state().1.is_empty(), "nothing goes by one click");
        press(&mut panels, "Keep");
        press(&mut panels, "Discard all …");
        press(&mut panels, "Discard all");
        assert_eq!(panels.state().1, [Wish::DiscardLeftovers]);
        let seconds = panels.get_all_by_label("Discard …").nth(1);
        if let Some(button) = seconds {
            button.click();
        }
        panels.run_steps(4);
        press(&mut panels, "Discard");
        assert_eq!(panels.state().1.last(), Some(&Wish::DiscardLeftover(1)));
    }
}
