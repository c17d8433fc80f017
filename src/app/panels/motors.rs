//! Motors of a selection in its panel: how fast and how strong they turn, and by which keys.

use egui::{DragValue, RichText, Ui};

use super::material::{Sink, number, row};
use super::theme::colors;
use super::{drives, ranged};
use crate::app::matter::{Common, MatterChange, MotorChange, Motors, Span};

/// How fast a speed changes as it is dragged, for each point `[rad/s]`, and the most that it is set to.
const DRAGGED: f64 = 0.1;
pub(super) const FASTEST: f64 = 200.0;

/// What of them can be set.
pub(super) fn show(ui: &mut Ui, motors: &Motors, sink: &mut Sink<'_>) {
    speed(ui, motors.speed, sink);
    number(ui, ("torque", " N m"), Some(motors.torque), sink, |x| {
        (x > 0.0).then_some(MatterChange::Motor(MotorChange::Torque(x)))
    });
    let Common::One(before) = motors.keys else {
        return row(ui, "keys", |ui, _| _ = ui.label(RichText::new("mixed").color(colors(ui).weak)));
    };
    let [mut key, mut back] = before;
    let by = ui.vertical(|ui| drives::keys(ui, &mut key, &mut back)).response;
    if [key, back] != before {
        sink.set(&by, MatterChange::Motor(MotorChange::Keys(key, back)));
    }
}

fn speed(ui: &mut Ui, span: Span, sink: &mut Sink<'_>) {
    let mut value = 0.5 * (span.least + span.most);
    row(ui, "speed", |ui, label| {
        let field = DragValue::new(&mut value).speed(DRAGGED).max_decimals(2).update_while_editing(false);
        let field = match span.same() {
            Some(_) => field.suffix(" rad/s"),
            None => field.custom_formatter(|_, _| "mixed".to_owned()),
        };
        let by = ranged::field(ui, field, -FASTEST..=FASTEST, " rad/s").labelled_by(label);
        let by = by.on_hover_text("below 0 clockwise, as a wheel rolls to the right");
        if by.changed() {
            sink.set(&by, MatterChange::Motor(MotorChange::Speed(value)));
        }
    });
}
