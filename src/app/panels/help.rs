//! The keys, as the program has them: by what people do with them, and found by a word.

use egui::{Align, Label, Layout, Rect, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo, vec2};

use super::theme::colors;
use super::typed::takes_words;
use super::{PanelState, sheet};
use crate::app::keys::{Group, Row, found};

/// What the sheet has beside its text, from keys to what they do, from column to column, and the bar that scrolls it `[points]`.
const BESIDE: f32 = 60.0;
const APART: f32 = 14.0;
const BETWEEN: f32 = 30.0;
const BAR: f32 = 12.0;
/// Widest text, and the least width of a column where there are several `[points]`.
const WIDEST: f32 = 1400.0;
const LEAST: f32 = 350.0;
/// The part of a column that the keys have `[1]`.
const SHARE: f32 = 0.4;
/// Height of what is above the keys, with the frame of the sheet `[points]`.
const ABOVE: f32 = 130.0;
/// What the field that a search is written in is called.
const SEARCH: &str = "search the keys";
/// Rows that a heading takes.
const HEADING: usize = 2;

/// The field that a search of the keys is written in.
fn search_id() -> egui::Id {
    egui::Id::unique("search of the keys")
}

pub(super) fn show(context: &egui::Context, room: Rect, state: &mut PanelState) {
    let stays = sheet::show(context, "keys", "Keys", |ui| {
        let height = (room.height() - ABOVE).max(40.0);
        let whole = (room.width() - BESIDE).clamp(160.0, WIDEST);
        ui.set_width(whole);
        let hint = RichText::new("search …").italics();
        let field = TextEdit::singleline(&mut state.keys_search).id(search_id()).hint_text(hint);
        let field = ui.add(field.desired_width(f32::INFINITY));
        takes_words(&field);
        // What is typed is looked for.
        if std::mem::take(&mut state.is_fresh) {
            field.request_focus();
        }
        sheet::entered(ui, &field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, SEARCH));
        ui.add_space(4.0);
        let groups = found(&state.keys_search);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false).show(ui, |ui| {
            if groups.is_empty() {
                ui.weak("no key found: try another word");
            }
            let count = (((whole + BETWEEN) / (LEAST + BETWEEN)) as usize).clamp(1, 3);
            let width = (whole - BAR - (count - 1) as f32 * BETWEEN) / count as f32;
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing = vec2(BETWEEN, 4.0);
                for part in parts(&groups, count) {
                    of_column(ui, width, part);
                }
            });
        });
    });
    if !stays {
        state.sheet = None;
    }
}

/// The groups in so many columns, one after another, the highest of which is as low as can be.
fn parts(groups: &[(Group, Vec<Row>)], count: usize) -> Vec<&[(Group, Vec<Row>)]> {
    let high = |(_, rows): &(Group, Vec<Row>)| HEADING + rows.len();
    let cut = |most: usize| {
        let (mut parts, mut from, mut sum) = (Vec::new(), 0, 0);
        for (place, group) in groups.iter().enumerate() {
            if sum > 0 && sum + high(group) > most {
                parts.push(&groups[from..place]);
                (from, sum) = (place, 0);
            }
            sum += high(group);
        }
        parts.push(&groups[from..]);
        parts
    };
    let all: usize = groups.iter().map(high).sum();
    let least = groups.iter().map(high).max().unwrap_or(0);
    (least..=all).map(cut).find(|parts| parts.len() <= count).unwrap_or_else(|| vec![groups])
}

/// Groups below each other in so much width.
fn of_column(ui: &mut Ui, width: f32, groups: &[(Group, Vec<Row>)]) {
    ui.allocate_ui_with_layout(vec2(width, 0.0), Layout::top_down(Align::Min), |ui| {
        ui.set_width(width);
        for (group, rows) in groups {
            ui.label(RichText::new(group.heading()).color(colors(ui).text).strong());
            for [keys, words] in rows {
                ui.horizontal_top(|ui| {
                    ui.spacing_mut().item_spacing.x = APART;
                    written(ui, SHARE * width, RichText::new(*keys).color(colors(ui).accent).monospace());
                    written(ui, (1.0 - SHARE) * width - APART, RichText::new(*words));
                });
            }
            ui.add_space(10.0);
        }
    });
}

/// Text in so much width, on as many lines as that takes.
fn written(ui: &mut Ui, width: f32, text: RichText) {
    ui.allocate_ui_with_layout(vec2(width, 0.0), Layout::top_down(Align::Min), |ui| {
        ui.set_width(width);
        ui.add(Label::new(text).wrap());
    });
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::super::theme;
    use super::*;

    type Keys = Harness<'static, PanelState>;

    fn shown(size: [f32; 2]) -> Keys {
        let mut harness = Harness::builder().with_size(size).build_ui_state(
            |ui, state: &mut PanelState| {
                theme::apply(ui.ctx(), Default::default());
                let room = ui.available_rect_before_wrap();
                show(ui.ctx(), room, state);
            },
            PanelState { is_fresh: true, ..PanelState::default() },
        );
        harness.run_steps(6);
        harness
    }

    fn at(keys: &Keys, words: &str) -> Rect {
        keys.get_by_label(words).rect()
    }

    #[test]
    fn keys_stand_below_their_headings_in_columns_where_there_is_room() {
        for (size, columns) in [([1280.0, 720.0], 3), ([820.0, 600.0], 2), ([500.0, 700.0], 1)] {
            let keys = shown(size);
            let mut sides: Vec<i32> = Group::ALL.map(|group| at(&keys, group.heading()).left() as i32).to_vec();
            sides.sort_unstable();
            sides.dedup();
            assert_eq!(sides.len(), columns, "{size:?}: {sides:?}");
            let (heading, row) = (at(&keys, "Time"), at(&keys, "play or pause"));
            assert!(heading.bottom() <= row.top() && row.top() < heading.bottom() + 20.0, "{heading} {row}");
            assert!(row.left() > heading.left() && row.right() <= size[0], "{row}");
        }
    }

    #[test]
    fn what_is_typed_is_looked_for_at_once() {
        let mut keys = shown([1280.0, 720.0]);
        assert!(keys.ctx.text_edit_focused(), "nobody clicked on the field");
        keys.event(egui::Event::Text("grid".to_owned()));
        keys.run_steps(4);
        assert!(keys.query_by_label("the grid and its numbers").is_some());
        assert!(keys.query_by_label("play or pause").is_none() && keys.query_by_label("Time").is_none());
    }
}
