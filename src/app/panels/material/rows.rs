//! Rows of the panel of what is selected: a name, and beside it what sets a number.

use egui::{DragValue, Id, Slider, Ui};

use super::sink::Sink;
use crate::app::matter::{MatterChange, Span};
use crate::app::panels::ranged;
use crate::app::panels::theme::as_high_as_buttons;

/// Width of the names before fields `[points]`.
const NAMES: f32 = 74.0;
/// How fast a number changes as it is dragged, as a share of it for each point.
pub(super) const SPEED: f64 = 0.01;
/// Where a drag of a number that is 0 begins.
const FIRST: f64 = 0.01;

/// A field beside its name, by which what reads aloud calls it: all names are as wide, so that fields stand below each other.
pub(in crate::app::panels) fn row<T>(ui: &mut Ui, name: &str, add: impl FnOnce(&mut Ui, Id) -> T) -> T {
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        let size = egui::vec2(NAMES, ui.spacing().interact_size.y);
        let layout = egui::Layout::left_to_right(egui::Align::Center);
        let label = ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_size(size);
            ui.label(name)
        });
        add(ui, label.inner.id)
    })
    .inner
}

/// A number without an upper end, which says so where it is not the same everywhere.
pub(in crate::app::panels) fn number(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    span: Option<Span>,
    sink: &mut Sink<'_>,
    change: impl Fn(f64) -> Option<MatterChange>,
) {
    number_beside(ui, (name, unit), span, sink, change, |_| ());
}

/// The same with something at its right.
pub(super) fn number_beside(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    span: Option<Span>,
    sink: &mut Sink<'_>,
    change: impl Fn(f64) -> Option<MatterChange>,
    beside: impl FnOnce(&mut Ui),
) {
    let Some(span) = span else { return };
    let mut value = span.same().unwrap_or((span.least.max(FIRST) * span.most.max(FIRST)).sqrt());
    row(ui, name, |ui, label| {
        let speed = SPEED * value.max(FIRST);
        let field = DragValue::new(&mut value).speed(speed).update_while_editing(false);
        let field = match span.same() {
            Some(_) => field.custom_formatter(|x, _| short(x)).suffix(unit),
            None => field.custom_formatter(|_, _| "mixed".to_owned()),
        };
        let by = ranged::field(ui, field, 0.0..=1e9, unit).labelled_by(label);
        let by = match span.same() {
            Some(_) => by,
            None => by.on_hover_text(format!("from {} to {}{unit}", short(span.least), short(span.most))),
        };
        if let Some(change) = change(value).filter(|_| by.changed()) {
            sink.set(&by, change);
        }
        beside(ui);
    });
}

/// A number with few digits, whatever its size.
pub(in crate::app::panels) fn short(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size >= 1e6 => format!("{x:.2e}"),
        size if size >= 100.0 => format!("{x:.0}"),
        size if size >= 10.0 => format!("{x:.1}"),
        size if size >= 0.1 => format!("{x:.2}"),
        size if size >= 1e-3 => format!("{x:.4}"),
        _ => format!("{x:.2e}"),
    }
}

/// A share that a slider sets, from 0.
pub(super) fn share(
    ui: &mut Ui,
    name: &str,
    most: f64,
    span: Option<Span>,
    sink: &mut Sink<'_>,
    change: fn(f64) -> MatterChange,
) {
    let Some(span) = span else { return };
    let mut value = span.same().unwrap_or(0.5 * (span.least + span.most));
    let slider = Slider::new(&mut value, 0.0..=most).clamping(egui::SliderClamping::Edits).max_decimals(2);
    let slider = match span.same() {
        Some(_) => slider,
        None => slider.custom_formatter(|_, _| "mixed".to_owned()),
    };
    let by = row(ui, name, |ui, label| {
        ui.spacing_mut().slider_width = 72.0;
        ranged::slider(ui, slider.update_while_editing(false), 0.0..=most, "").labelled_by(label)
    });
    if by.changed() {
        sink.set(&by, change(value));
    }
}
