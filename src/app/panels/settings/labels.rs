//! The words that stand in the world: each can be written anew, put elsewhere, held to a point, or taken away, and others come.

use egui::{DragValue, Id, Key, Response, Role, TextEdit, Ui, WidgetInfo};

use super::super::theme::as_high_as_buttons;
use super::super::ticks;
use super::super::typed::takes_words;
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

/// All of them, and a button for another one.
pub(super) fn show(ui: &mut Ui, settings: &Settings, sink: &mut Sink<'_>) {
    let Settings { labels, middle, .. } = settings;
    ui.horizontal(|ui| {
        ui.strong("Labels");
        let has_room = labels.len() < LabelKeys::MOST;
        let by = ui.add_enabled_ui(has_room, |ui| ui.button("add a label")).inner;
        let by = by.on_hover_text("words in the middle of what is seen");
        if by.clicked() {
            let mut all = labels.to_vec();
            all.push(LabelKeys { at: sink.vector(*middle), text: FIRST.to_owned(), point: None });
            sink.scene(&by, NAME, keys(all));
        }
    });
    for place in 0..labels.len() {
        of_words(ui, labels, place, sink);
        of_place(ui, (labels, place), *middle, sink);
    }
}

/// What a change is called when it is undone.
const NAME: &str = "labels";

fn keys(labels: Vec<LabelKeys>) -> SetKeys {
    SetKeys { labels: Some(labels), ..SetKeys::default() }
}

/// One of them is another.
fn give(by: &Response, (labels, place): (&[LabelKeys], usize), label: LabelKeys, sink: &mut Sink<'_>) {
    let mut all = labels.to_vec();
    all[place] = label;
    sink.scene(by, NAME, keys(all));
}

/// The words of one, which are taken when the field is left, and a button that takes it away. Esc, or no words, leaves them as they were.
fn of_words(ui: &mut Ui, labels: &[LabelKeys], place: usize, sink: &mut Sink<'_>) {
    let (id, label) = (Id::unique(("label", place)), &labels[place]);
    let draft = ui.data(|data| data.get_temp::<String>(id));
    let has_draft = draft.is_some();
    let mut text = draft.unwrap_or_else(|| label.text.clone());
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        let field = TextEdit::singleline(&mut text).id(id).char_limit(LabelKeys::LONGEST).desired_width(WIDTH);
        let field = ui.add(field);
        takes_words(&field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, format!("label {}", place + 1)));
        if field.has_focus() {
            ui.data_mut(|data| data.insert_temp(id, text.clone()));
        } else if has_draft {
            ui.data_mut(|data| data.remove::<String>(id));
        }
        let is_written = field.lost_focus() && !ui.input(|input| input.key_pressed(Key::Escape));
        if is_written && !text.trim().is_empty() && text != label.text {
            give(&field, (labels, place), LabelKeys { text, ..label.clone() }, sink);
        }
        let by = ui.small_button("×").on_hover_text("this label goes");
        if by.clicked() {
            let mut all = labels.to_vec();
            all.remove(place);
            sink.scene(&by, NAME, keys(all));
        }
    });
}

/// Where one stands, and the point that it goes along with, if any: its place is seen from there then.
fn of_place(ui: &mut Ui, (labels, place): (&[LabelKeys], usize), middle: [f64; 3], sink: &mut Sink<'_>) {
    let label = &labels[place];
    let mut at = label.at.embed();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate().take(sink.dimensions) {
            let field = DragValue::new(&mut at[axis]).speed(SPEEDS[0]).range(-FARTHEST..=FARTHEST).max_decimals(2);
            let by = ui.add(field.update_while_editing(false).prefix(format!("{name} ")).suffix(" m"));
            let said = format!("{name} of label {}", place + 1);
            by.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, &said));
            if by.changed() {
                give(&by, (labels, place), LabelKeys { at: sink.vector(at), ..label.clone() }, sink);
            }
        }
        let mut follows = label.point.is_some();
        let by =
            ticks::check(ui, &mut follows, "point").on_hover_text("it goes along with a point, and is seen from there");
        if by.changed() {
            // Seen from another origin it would stand anywhere.
            let (at, point) = if follows { ([0.0; 3], Some(0)) } else { (middle, None) };
            give(&by, (labels, place), LabelKeys { at: sink.vector(at), point, ..label.clone() }, sink);
        }
        let Some(mut point) = label.point else { return };
        let by = ui.add(DragValue::new(&mut point).speed(SPEEDS[1]).update_while_editing(false));
        by.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, format!("point of label {}", place + 1)));
        if by.changed() {
            give(&by, (labels, place), LabelKeys { point: Some(point), ..label.clone() }, sink);
        }
    });
}
