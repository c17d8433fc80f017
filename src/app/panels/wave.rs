//! Period and phase of a wave that a drive follows: sliders beside a tool, for what it makes next, and fields in the panel of what is selected.

use egui::{DragValue, Response, Slider, Ui};

use super::material::{row, short};
use super::ranged;
use crate::sim::drive::PERIODS;

/// The shortest and the longest period that sliders reach `[s]`.
const SLID: [f64; 2] = [0.2, 4.0];
/// How fast a field changes as it is dragged, for each point: a period by this share of it, a phase by so much `[rad]`.
const DRAGGED: f64 = 0.01;
/// Phases are no larger `[rad]`.
const TURNS: f64 = 1e6;

/// A slider for a period `[s]`.
pub(super) fn slide_period(ui: &mut Ui, period: &mut f64) -> Response {
    slider(ui, "period", period, SLID[0]..=SLID[1], " s")
}

/// A slider for a phase `[rad]`.
pub(super) fn slide_phase(ui: &mut Ui, phase: &mut f64) -> Response {
    slider(ui, "phase", phase, 0.0..=std::f64::consts::TAU, " rad")
}

/// Fields for both `[s]`, `[rad]`. Returns by what they are changed.
pub(super) fn fields(ui: &mut Ui, period: &mut f64, phase: &mut f64) -> [Response; 2] {
    let speed = DRAGGED * *period;
    [
        field(ui, ("period", " s"), (period, speed), PERIODS[0]..=PERIODS[1]),
        field(ui, ("phase", " rad"), (phase, DRAGGED), -TURNS..=TURNS),
    ]
}

/// A slider of a drive, with its name.
pub(super) fn slider(
    ui: &mut Ui,
    name: &str,
    value: &mut f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
) -> Response {
    let slider = Slider::new(value, range.clone()).max_decimals(2).suffix(unit).text(name);
    ranged::slider(ui, slider, range, unit)
}

/// A field of a drive, beside its name, which changes by so much for each point that it is dragged.
pub(super) fn field(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    (value, speed): (&mut f64, f64),
    range: std::ops::RangeInclusive<f64>,
) -> Response {
    row(ui, name, |ui, label| {
        let field = DragValue::new(value).speed(speed).update_while_editing(false);
        ranged::field(ui, field.custom_formatter(|x, _| short(x)).suffix(unit), range, unit).labelled_by(label)
    })
}
