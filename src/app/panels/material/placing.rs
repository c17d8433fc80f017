//! Where what is selected is: its middle, how it is turned, how large it is.

use std::ops::RangeInclusive;

use egui::{DragValue, Event, Id, Key, Response, Ui};

use super::rows::row;
use super::sink::Sink;
use crate::app::matter::{Placed, Placing, Size};
use crate::app::panels::{Facts, ranged};

/// How fast numbers change as they are dragged, for each point `[m]`, `[°]`.
const SPEEDS: [f64; 2] = [0.01, 0.5];
/// Places are no further off, and sides and radii from so small to so large `[m]`; angles go around once `[°]`.
const PLACES: RangeInclusive<f64> = -1e6..=1e6;
const SIZES: RangeInclusive<f64> = 1e-4..=1e6;
const ANGLES: RangeInclusive<f64> = -360.0..=360.0;

/// A row: its name, its unit, where it may go and how fast a drag goes there.
type Row<'a> = (&'a str, &'a str, RangeInclusive<f64>, f64);

pub(super) fn placing(ui: &mut Ui, facts: &Facts, sink: &mut Sink<'_>) {
    let Some(Placed { middle, angle, size }) = facts.figures.placed else { return };
    for (axis, name) in ["middle x", "middle y", "middle z"].into_iter().enumerate().take(facts.dimensions) {
        let at = |x: f64| Placing::At(axis, x);
        field(ui, (name, " m", PLACES, SPEEDS[0]), middle[axis], sink, at);
    }
    let turns = facts.matter.as_deref().is_some_and(|matter| matter.points > 1 || matter.obstacles > 0);
    match (angle, size) {
        _ if facts.dimensions != 2 || !turns => {}
        (Some(angle), _) => {
            let to = |x: f64| Placing::Angle(x.to_radians());
            field(ui, ("angle", "°", ANGLES, SPEEDS[1]), angle.to_degrees(), sink, to);
        }
        (None, Some(Size::Circle(_))) => {}
        (None, _) => turn_by(ui, sink),
    }
    let metres = |name: &'static str| (name, " m", SIZES, SPEEDS[0]);
    match size {
        Some(Size::Box([wide, high])) => {
            field(ui, metres("width"), wide, sink, |x| Placing::Side(0, x));
            field(ui, metres("height"), high, sink, |x| Placing::Side(1, x));
        }
        Some(Size::Circle(radius)) => field(ui, metres("radius"), radius, sink, Placing::Radius),
        None => {}
    }
}

/// A number of where it is, as figures are shown.
fn field(ui: &mut Ui, of: Row<'_>, value: f64, sink: &mut Sink<'_>, place: impl Fn(f64) -> Placing) {
    let (by, to, _) = written(ui, of, value);
    if let Some(to) = to {
        sink.place(&by, place(to));
    }
}

/// A turn from how it is: a drag asks for all of it from its beginning, of which some may be refused on the way, and begins at 0 again the next
/// time.
fn turn_by(ui: &mut Ui, sink: &mut Sink<'_>) {
    let kept = Id::unique("turned by");
    let before: f64 = ui.data(|data| data.get_temp(kept)).unwrap_or(0.0);
    let (by, to, from) = written(ui, ("turn by", "°", ANGLES, SPEEDS[1]), before);
    if let Some(to) = to {
        // Arrow keys go on from what they asked for before.
        let turn = if by.dragged() { to } else { to - from };
        sink.place(&by, Placing::TurnBy(turn.to_radians()));
    }
    let after = if by.dragged() { to.unwrap_or(before) } else { 0.0 };
    ui.data_mut(|data| data.insert_temp(kept, after));
}

/// A field, what was dragged to or written in it, and the number that it had before. While one writes it keeps the number that it had before: what is written would go with
/// that.
fn written(ui: &mut Ui, (name, unit, range, speed): Row<'_>, value: f64) -> (Response, Option<f64>, f64) {
    row(ui, name, |ui, label| {
        let own = ui.next_auto_id();
        let kept = own.with("before");
        let has_focus = ui.memory(|memory| memory.has_focus(own));
        // As the focus goes, what was written is taken.
        let held = ui.data(|data| data.get_temp::<(f64, bool)>(kept)).filter(|(_, had_focus)| has_focus || *had_focus);
        let before = held.map_or(value, |(before, _)| before);
        let mut to = before;
        let field = DragValue::new(&mut to).speed(speed).update_while_editing(false).suffix(unit);
        let by = ranged::field(ui, field.custom_formatter(|x, _| thousandths(x)), range, unit).labelled_by(label);
        let is_meant = is_meant(&by);
        ui.data_mut(|data| data.insert_temp(kept, (if by.changed() { to } else { before }, has_focus)));
        let to = (by.changed() && is_meant).then_some(to);
        (by, to, before)
    })
}

/// Whether a number was dragged or written: one that is left as it stood would put what moves meanwhile back to where it was as it was clicked.
fn is_meant(by: &Response) -> bool {
    let is_edit = |event: &Event| match event {
        Event::Text(_) | Event::Paste(_) | Event::Cut | Event::Ime(_) => true,
        Event::Key { key, pressed, .. } => *pressed && matches!(key, Key::Backspace | Key::Delete),
        _ => false,
    };
    let has_focus = by.has_focus() || by.lost_focus();
    let edits = has_focus && by.ctx.input(|input| input.events.iter().any(is_edit));
    let kept = by.id.with("written");
    let was_edited = !by.gained_focus() && by.ctx.data(|data| data.get_temp(kept)).unwrap_or(false);
    let is_edited = edits || was_edited;
    // Asked for before: what is known of focus lies behind the same lock.
    let is_left = by.lost_focus();
    by.ctx.data_mut(|data| data.insert_temp(kept, is_edited && !is_left));
    is_edited || !is_left
}

/// A number to a thousandth, without a sign that says nothing.
fn thousandths(x: f64) -> String {
    let words = format!("{x:.3}");
    if words == "-0.000" { "0.000".to_owned() } else { words }
}
