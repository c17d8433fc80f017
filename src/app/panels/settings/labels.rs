//! The words that stand in the world: each can be written anew, put elsewhere, held to a point, or taken away, and others come.

use std::sync::Arc;

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{DragValue, Id, Key, Response, Role, TextEdit, Ui, WidgetInfo};

use super::super::material::short;
use super::super::theme::as_high_as_buttons;
use super::super::typed::takes_words;
use super::super::{ranged, ticks};
use super::names::Names;
use super::{Settings, Sink};
use crate::history::SetKeys;
use crate::scene::LabelKeys;

/// What a label says that was just added.
const FIRST: &str = "a label";
/// Width of the words beside the button that takes them away `[points]`.
const WIDTH: f32 = 196.0;
/// How fast places change as they are dragged, for each point `[m]`, and points.
const SPEEDS: [f64; 2] = [0.02, 0.1];
/// Places are no further off `[m]`.
const FARTHEST: f64 = 1e6;

/// All of them, and a button for another one. What is done in one frame, words that are left by a click elsewhere too, is one edit.
pub(super) fn show(ui: &mut Ui, settings: &Settings, sink: &mut Sink<'_>) {
    let Settings { labels, middle, points, .. } = settings;
    let now = asked(ui, labels).unwrap_or_else(|| labels.to_vec());
    let (mut all, mut by, mut names) = (now.clone(), None, Names::of(ui, &now));
    let has_room = now.len() < LabelKeys::MOST;
    let added = ui.horizontal(|ui| {
        ui.strong("Labels");
        let button = ui.add_enabled_ui(has_room, |ui| ui.button("add a label")).inner;
        button.on_hover_text("words in the middle of what is seen")
    });
    let mut gone = None;
    for (place, label) in all.iter_mut().enumerate() {
        let (words, cross) = of_words(ui, label, (place, names.at(place)));
        if cross.clicked() {
            gone = Some(place);
        }
        let seat = of_place(ui, (label, place), (*middle, *points), sink);
        by = [words, cross.clicked().then_some(cross), seat].into_iter().flatten().last().or(by.take());
    }
    if let Some(gone) = gone {
        all.remove(gone);
        drop_draft(ui, names.remove(gone));
    }
    if added.inner.clicked() {
        // What is typed next is its words.
        write(ui, names.push());
        all.push(LabelKeys { at: sink.vector(*middle), text: FIRST.to_owned(), point: None });
        by = Some(added.inner);
    }
    if let Some(by) = by.filter(|_| all != now) {
        let asked = Asked { of: Arc::clone(labels), all: all.clone(), until: ui.input(|input| input.time) + SOON };
        ui.data_mut(|data| data.insert_temp(Id::unique(ASKED), asked));
        names.keep(ui, &all);
        sink.scene(&by, NAME, SetKeys { labels: Some(all), ..SetKeys::default() });
    } else {
        names.keep(ui, &now);
    }
}

/// What was asked for last, of which labels, and until when these may still be shown `[s]`: a world that takes long has them later.
#[derive(Clone)]
struct Asked {
    of: Arc<Vec<LabelKeys>>,
    all: Vec<LabelKeys>,
    until: f64,
}

/// Where that is kept, and how long it may take `[s]`.
const ASKED: &str = "labels that were asked for";
const SOON: f64 = 1.0;

/// What was asked for of labels that are still shown; `None`: the world has it, or refused it.
fn asked(ui: &Ui, labels: &Arc<Vec<LabelKeys>>) -> Option<Vec<LabelKeys>> {
    let id = Id::unique(ASKED);
    let asked = ui.data(|data| data.get_temp::<Asked>(id))?;
    if asked.of == *labels && ui.input(|input| input.time) < asked.until {
        return Some(asked.all);
    }
    ui.data_mut(|data| data.remove::<Asked>(id));
    None
}

/// What a change is called when it is undone.
const NAME: &str = "labels";

/// The field that the words of a label are written in.
fn field_id(number: u64) -> Id {
    Id::unique(("label", number))
}

/// What was written of a label that goes, and not taken yet, goes with it.
fn drop_draft(ui: &Ui, number: u64) {
    ui.data_mut(|data| data.remove::<String>(field_id(number)));
}

/// The words of a label are about to be written: all of them are chosen, so that what is typed takes their place.
fn write(ui: &Ui, number: u64) {
    let id = field_id(number);
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    let all = CCursorRange::two(CCursor::default(), CCursor::new(FIRST.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), id);
    ui.memory_mut(|memory| memory.request_focus(id));
}

/// The words of one, which are taken when the field is left, and a button that takes it away. Esc, or no words, leaves them as they were.
/// Returns by what they are others, if they are, and the button.
fn of_words(ui: &mut Ui, label: &mut LabelKeys, (place, number): (usize, u64)) -> (Option<Response>, Response) {
    let id = field_id(number);
    let draft = ui.data(|data| data.get_temp::<String>(id));
    let has_draft = draft.is_some();
    let mut text = draft.unwrap_or_else(|| label.text.clone());
    let (field, cross) = ui
        .horizontal(|ui| {
            as_high_as_buttons(ui);
            let field = TextEdit::singleline(&mut text).id(id).char_limit(LabelKeys::LONGEST).desired_width(WIDTH);
            (ui.add(field), ui.small_button("×").on_hover_text("this label goes"))
        })
        .inner;
    takes_words(&field);
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, format!("label {}", place + 1)));
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    } else if has_draft {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    let is_left = field.lost_focus() && !ui.input(|input| input.key_pressed(Key::Escape));
    let is_written = is_left && !text.trim().is_empty() && text != label.text;
    if is_written {
        label.text = text;
    }
    (is_written.then_some(field), cross)
}

/// Where one stands, and which of so many points it goes along with, if any: its place is seen from there then. Returns by what that is
/// another, if it is.
fn of_place(
    ui: &mut Ui,
    (label, place): (&mut LabelKeys, usize),
    (middle, points): ([f64; 3], usize),
    sink: &Sink<'_>,
) -> Option<Response> {
    let mut changed = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let mut at = label.at.embed();
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate().take(sink.dimensions) {
            let field = DragValue::new(&mut at[axis]).speed(SPEEDS[0]).custom_formatter(|x, _| short(x));
            let field = field.update_while_editing(false).prefix(format!("{name} ")).suffix(" m");
            let by = ranged::field(ui, field, -FARTHEST..=FARTHEST, " m");
            let said = format!("{name} of label {}", place + 1);
            by.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, &said));
            if by.changed() {
                label.at = sink.vector(at);
                changed = Some(by);
            }
        }
        let mut follows = label.point.is_some();
        let by = ticks::check_if(ui, follows || points > 0, &mut follows, "point");
        let by = by.on_hover_text("it goes along with a point, and is seen from there");
        if by.changed() {
            // Seen from another origin it would stand anywhere.
            let (at, point) = if follows { ([0.0; 3], Some(0)) } else { (middle, None) };
            (label.at, label.point) = (sink.vector(at), point);
            changed = Some(by);
        }
        let Some(point) = &mut label.point else { return };
        let most = points.saturating_sub(1) as f64;
        let field = DragValue::new(point).speed(SPEEDS[1]).max_decimals(0).update_while_editing(false);
        let by = ranged::field(ui, field, 0.0..=most, "");
        by.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, format!("point of label {}", place + 1)));
        if by.changed() {
            changed = Some(by);
        }
    });
    changed
}
