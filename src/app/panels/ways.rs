//! How what is selected moves: its velocity, and the ways that its pins are led along.

use egui::{DragValue, RichText, Ui};

use super::Facts;
use super::material::{Sink, row};
use super::theme::colors;
use crate::app::matter::{Matter, MatterChange, Pin};
use crate::history::Do;
use crate::scene::{AddKeys, PinMotionKeys};
use crate::sim::vector::add;
use crate::sim::{Knots, PointId};

/// How fast numbers change as they are dragged, for each point: velocities `[m/s]`, times `[s]`, places `[m]`.
const SPEEDS: [f64; 3] = [0.05, 0.02, 0.01];
/// Knots are no nearer to each other `[s]`; a new one comes so much later, and the first so far to the right of where the pin is `[m]`.
const NEAREST: f64 = 0.01;
const LATER: f64 = 1.0;
const ASIDE: f64 = 0.5;
/// Places are no further off `[m]`.
const FARTHEST: f64 = 1e6;
const AXES: [&str; 3] = ["x", "y", "z"];

pub(super) fn show(ui: &mut Ui, matter: &Matter, facts: &Facts, sink: &mut Sink<'_>) {
    if let Some(velocity) = facts.figures.velocity {
        of_velocity(ui, velocity, facts, sink);
    }
    for pin in &matter.pins {
        of_pin(ui, pin, facts, sink);
    }
}

/// The mean velocity, as figures are shown.
fn of_velocity(ui: &mut Ui, velocity: [f64; 3], facts: &Facts, sink: &mut Sink<'_>) {
    let mut to = velocity;
    row(ui, "velocity", |ui, _| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (axis, name) in AXES.into_iter().enumerate().take(facts.dimensions) {
            let field = DragValue::new(&mut to[axis]).speed(SPEEDS[0]).max_decimals(2).update_while_editing(false);
            let by = ui.add(field.prefix(format!("{name} "))).on_hover_text("m/s, of its middle");
            by.widget_info(|| egui::WidgetInfo::labeled(egui::Role::SpinButton, true, format!("velocity {name}")));
            if by.changed() {
                sink.set(&by, MatterChange::Velocity(to));
            }
        }
        // In space there is no room for it: 0 does the same.
        if velocity != [0.0; 3] && facts.dimensions == 2 {
            let by = ui.small_button("stop").on_hover_text("at rest from now on");
            if by.clicked() {
                sink.set(&by, MatterChange::Velocity([0.0; 3]));
            }
        }
    });
}

/// A pin with its way: times and places, which come and go.
fn of_pin(ui: &mut Ui, pin: &Pin, facts: &Facts, sink: &mut Sink<'_>) {
    ui.separator();
    let (Pin { point, at, knots, props }, now) = (pin, facts.figures.time);
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("pin {}", point.0)).color(colors(ui).text));
        if knots.is_empty() {
            ui.label(RichText::new("stands").color(colors(ui).weak));
            let words = "it is led from place to place at times that you set";
            if ui.small_button("lead it").on_hover_text(words).clicked() {
                let there = [at[0] + ASIDE, at[1], at[2]];
                let way = vec![(now, *at), (now + LATER, there)];
                sink.give_all(vec![led(pin, &way, facts.dimensions)], TRACK);
            }
            return;
        }
        ui.label(RichText::new("is led").color(colors(ui).weak));
        if ui.small_button("+").on_hover_text("one place more, a second later").clicked() {
            let mut more = knots.clone();
            more.extend(knots.last().map(|&(t, x)| (t + LATER, x)));
            sink.give_all(vec![led(pin, &more, facts.dimensions)], TRACK);
        }
        if ui.small_button("stop").on_hover_text("it stands where it is").clicked() {
            let all: Vec<PointId> = std::iter::once(*point).chain(props.iter().map(|(prop, _)| *prop)).collect();
            sink.give_all(vec![Do::Unpin(all.clone()), Do::Pin(all)], TRACK);
        }
    });
    for place in 0..knots.len() {
        of_knot(ui, (pin, place), facts, sink);
    }
}

/// What a way of a pin is called when it is undone.
const TRACK: &str = "way of a pin";

/// One time and place of a way.
fn of_knot(ui: &mut Ui, (pin, place): (&Pin, usize), facts: &Facts, sink: &mut Sink<'_>) {
    let Pin { point, knots, .. } = pin;
    let mut to = knots.clone();
    let after = place.checked_sub(1).map_or(0.0, |before| knots[before].0 + NEAREST);
    let before = knots.get(place + 1).map_or(f64::MAX, |next| next.0 - NEAREST);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let named = |name: &str| format!("{name} of knot {place} of pin {}", point.0);
        let (t, x) = &mut to[place];
        let field = DragValue::new(t).speed(SPEEDS[1]).range(after..=before.max(after)).max_decimals(2).suffix(" s");
        let mut all = vec![(ui.add(field.update_while_editing(false)), named("time"))];
        for (axis, name) in AXES.into_iter().enumerate().take(facts.dimensions) {
            let field = DragValue::new(&mut x[axis]).speed(SPEEDS[2]).range(-FARTHEST..=FARTHEST).max_decimals(2);
            all.push((ui.add(field.update_while_editing(false).prefix(format!("{name} "))), named(name)));
        }
        let away = knots.len() > 1 && ui.small_button("×").on_hover_text("this place goes").clicked();
        for (by, name) in &all {
            by.widget_info(|| egui::WidgetInfo::labeled(egui::Role::SpinButton, true, name));
        }
        if away {
            to.remove(place);
            return sink.give_all(vec![led(pin, &to, facts.dimensions)], TRACK);
        }
        if let Some((by, _)) = all.iter().find(|(by, _)| by.changed()) {
            sink.give(by, led(pin, &to, facts.dimensions), TRACK);
        }
    });
}

/// A pin is led along a way from now on, and what stands beside it as it does.
fn led(pin: &Pin, knots: &Knots, dimensions: usize) -> Do {
    let along = |point: PointId, aside: [f64; 3]| {
        let row = |&(t, x): &(f64, [f64; 3])| std::iter::once(t).chain(add(x, aside).into_iter().take(dimensions));
        PinMotionKeys { point: point.0, track: knots.iter().map(|knot| row(knot).collect()).collect() }
    };
    let props = pin.props.iter().map(|&(prop, aside)| along(prop, aside));
    let pin_motion = std::iter::once(along(pin.point, [0.0; 3])).chain(props).collect();
    Do::Add(Box::new(AddKeys { pin_motion, ..AddKeys::default() }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_beside_a_pin_is_led_as_it_is() {
        let props = vec![(PointId(7), [0.0, -0.5, 0.0])];
        let pin = Pin { point: PointId(3), at: [1.0, 2.0, 0.0], knots: Knots::new(), props };
        let act = led(&pin, &vec![(0.0, [1.0, 2.0, 0.0]), (1.0, [4.0, 2.0, 0.0])], 2);
        let Do::Add(keys) = act else { return assert!(matches!(act, Do::Add(_))) };
        let ways: Vec<_> = keys.pin_motion.iter().map(|way| (way.point, way.track.clone())).collect();
        let expected =
            [(3, vec![vec![0.0, 1.0, 2.0], vec![1.0, 4.0, 2.0]]), (7, vec![vec![0.0, 1.0, 1.5], vec![1.0, 4.0, 1.5]])];
        assert_eq!(ways, expected);
    }
}
