//! How fast a scene is played, and where it ends, in the settings.

use egui::Ui;

use super::super::ticks;
use super::{Sink, fields};
use crate::history::{Clock, EndOrNone, SetKeys};

/// Rates that can be set `[1]`.
const RATES: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// The longest duration `[s]`, and the first of a scene that had none.
const LONGEST: f64 = 1e6;
const FIRST: f64 = 20.0;

/// The rate, and whether and where it ends.
pub(super) fn show(ui: &mut Ui, clock: Clock, sink: &mut Sink<'_>) {
    ui.strong("Time");
    ui.horizontal(|ui| {
        let mut rate = clock.rate;
        let speed = 0.01 * rate;
        let by = fields::number_within(ui, "rate", (&mut rate, speed, " s a second"), RATES);
        let by = by.on_hover_text("seconds of the scene a second of the clock, at pace 1");
        if by.changed() {
            sink.scene(&by, "rate", SetKeys { rate: Some(rate), ..SetKeys::default() });
        }
    });
    ui.horizontal(|ui| {
        let mut ends = clock.duration.is_some();
        let by = ticks::check(ui, &mut ends, "ends")
            .on_hover_text("it stops there by itself, and plays again from the start");
        let set = |end: Option<f64>| {
            let duration = Some(end.map_or(EndOrNone::None(()), EndOrNone::At));
            SetKeys { duration, ..SetKeys::default() }
        };
        if by.changed() {
            sink.scene(&by, "duration", set(ends.then_some(FIRST)));
        }
        let Some(mut end) = clock.duration else { return };
        let by = fields::number_within(ui, "duration", (&mut end, 0.1, " s"), 0.0..=LONGEST);
        if by.changed() {
            sink.scene(&by, "duration", set(Some(end)));
        }
    });
}
