//! Pins that are led by the hand: they stay pins, which bear any load, and go along short straight ways after the cursor. Pins that
//! bonds join to each other are one bar, and go together.

use glam::{DQuat, DVec2, DVec3};

use super::hub::props_of;
use super::{Doing, Hand, Scope};
use crate::app::action::Tool;
use crate::sim::PointId;

/// Pins are sent on their way so often at most `[s]`: each time their body is compiled anew. What is on the cursor by itself goes after it
/// more smoothly.
const EVERY: f64 = 0.1;
const SMOOTHLY: f64 = 1.0 / 30.0;
/// A cursor that moved less has not been dragged yet `[logical px]`: a click moves no pin.
const LEAST: f64 = 3.0;
/// An arm that is shorter than this, as a share of the bar, turns nothing.
const LEAST_ARM: f64 = 0.02;
/// A bar that is grabbed nearer to its middle than this share of it turns about its far end: about the middle there would be no lever.
const LEVER: f64 = 0.35;

/// Pins, and the plane that they are led in: in space the one across the ray of the press.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lead {
    point: PointId,
    /// All that go, the one that was pressed on first, and where they are sent from `[m]`.
    bar: Vec<(PointId, DVec3)>,
    /// The props of what turns about them, each with the place of its pin in the bar, and how far from that it is `[m]`.
    props: Vec<(PointId, usize, DVec3)>,
    /// Where they were sent last.
    last: Vec<DVec3>,
    place: DVec3,
    normal: DVec3,
    /// Where the cursor was when the bar began to be led or turned `[m]`.
    from: DVec3,
    turns: bool,
    /// Where the press was, and where the cursor was when they were sent last `[px]`.
    pressed: DVec2,
    sent: Option<DVec2>,
    /// Since then, and how long it waits at least `[s]`.
    since: f64,
    every: f64,
}

/// Where pins are to go.
#[derive(Clone, Debug, PartialEq)]
pub struct PinWay {
    /// Each with its place `[m]`.
    pub pins: Vec<(PointId, [f64; 3])>,
    /// They were sent before, since one of them was pressed on.
    pub goes_on: bool,
    /// They go with the cursor by themselves, which is no edit.
    pub follows: bool,
}

/// Pins that bonds between pins join to one of them, that one first.
pub(super) fn bar(scope: Scope<'_>, point: PointId) -> Vec<PointId> {
    let is_pin = |end: &PointId| scope.is_pinned(*end);
    let bonds = scope.shown.scenery.bonds.ends().iter().filter(|ends| ends.iter().all(is_pin));
    let bonds: Vec<[PointId; 2]> = bonds.copied().collect();
    let mut all = vec![point];
    let mut looked = 0;
    while let Some(&from) = all.get(looked) {
        looked += 1;
        for ends in bonds.iter().filter(|ends| ends.contains(&from)) {
            all.extend(ends.iter().copied().filter(|end| *end != from).find(|end| !all.contains(end)));
        }
    }
    all
}

impl Lead {
    /// The pin that a pixel means, if it means one, with its bar.
    pub(super) fn of_pin(scope: Scope<'_>, at: DVec2) -> Option<Self> {
        let point = scope.nearest(at)?.point;
        if !scope.is_pinned(point) {
            return None;
        }
        Some(Lead::of(scope, point, at))
    }

    /// A pin, with its bar, from a pixel on.
    fn of(scope: Scope<'_>, point: PointId, at: DVec2) -> Self {
        let of = |pin: PointId| DVec3::from(scope.shown.place(pin.index()));
        let bar: Vec<(PointId, DVec3)> = bar(scope, point).into_iter().map(|pin| (pin, of(pin))).collect();
        let last = bar.iter().map(|(_, place)| *place).collect();
        let beside = |(k, (pin, place)): (usize, &(PointId, DVec3))| {
            let place = *place;
            props_of(scope, *pin).into_iter().map(move |prop| (prop, k, of(prop) - place)).collect::<Vec<_>>()
        };
        let props = bar.iter().enumerate().flat_map(beside).collect();
        let (place, normal) = (of(point), DVec3::from(scope.camera.cursor(at.to_array()).direction));
        let mut lead = Lead {
            point,
            bar,
            props,
            last,
            place,
            normal,
            from: place,
            turns: false,
            pressed: at,
            sent: None,
            since: f64::INFINITY,
            every: EVERY,
        };
        lead.from = lead.under(scope, at).unwrap_or(place);
        lead
    }

    pub(super) fn point(&self) -> PointId {
        self.point
    }

    /// All that go, ascending.
    pub(super) fn pins(&self) -> Vec<PointId> {
        let props = self.props.iter().map(|(prop, ..)| *prop);
        let mut pins: Vec<PointId> = self.bar.iter().map(|(pin, _)| *pin).chain(props).collect();
        pins.sort_unstable();
        pins
    }

    /// The place of its plane under a pixel `[m]`.
    fn under(&self, scope: Scope<'_>, at: DVec2) -> Option<DVec3> {
        let cursor = scope.camera.cursor(at.to_array());
        let (origin, direction) = (DVec3::from(cursor.origin), DVec3::from(cursor.direction));
        let along = direction.dot(self.normal);
        (along.abs() >= 1e-6).then(|| origin + ((self.place - origin).dot(self.normal) / along) * direction)
    }

    /// Time passes with the cursor at a pixel; infinitely much at the end. A bar turns about its middle while it `turns`, grabbed near that about its far end. Returns where they
    /// are to go now, if that is new.
    pub(super) fn pass(&mut self, scope: Scope<'_>, at: DVec2, (seconds, turns): (f64, bool)) -> Option<PinWay> {
        self.since += seconds;
        let is_dragged = self.sent.is_some() || at.distance(self.pressed) >= LEAST * scope.scale;
        if !is_dragged || self.sent == Some(at) || self.since < self.every {
            return None;
        }
        let to = self.under(scope, at)?;
        if self.turns != turns {
            // From here on otherwise.
            self.turns = turns;
            self.from = to;
            self.bar.iter_mut().zip(&self.last).for_each(|((_, place), last)| *place = *last);
        }
        match self.bar.len() {
            1 => self.last = vec![to],
            _ if turns => self.last = self.turned(to),
            _ => self.last = self.bar.iter().map(|(_, place)| *place + (to - self.from)).collect(),
        }
        let goes_on = self.sent.replace(at).is_some();
        self.since = 0.0;
        let pins = self.bar.iter().zip(&self.last).map(|((pin, _), place)| (*pin, place.to_array()));
        let props = self.props.iter().map(|(prop, k, off)| (*prop, (self.last[*k] + *off).to_array()));
        let pins = pins.chain(props).collect();
        Some(PinWay { pins, goes_on, follows: false })
    }

    /// Where pins are once the cursor, which turned with them, is here.
    fn turned(&self, to: DVec3) -> Vec<DVec3> {
        let count = self.bar.len() as f64;
        let middle = self.bar.iter().map(|(_, place)| *place).sum::<DVec3>() / count;
        let reach = self.bar.iter().map(|(_, place)| place.distance(middle)).fold(0.0, f64::max);
        let far = |place: &DVec3| place.distance(self.from);
        let end = self.bar.iter().map(|(_, place)| *place).max_by(|a, b| far(a).total_cmp(&far(b)));
        let has_lever = self.from.distance(middle) >= LEVER * reach;
        let about = end.filter(|_| !has_lever).unwrap_or(middle);
        let arms = [self.from - about, to - about];
        if arms.iter().any(|arm| arm.length() < LEAST_ARM * reach) {
            return self.last.clone();
        }
        let turn = DQuat::from_rotation_arc(arms[0].normalize(), arms[1].normalize());
        self.bar.iter().map(|(_, place)| about + turn * (*place - about)).collect()
    }
}

impl Hand {
    /// Where the pin goes that is on the cursor by itself, `seconds` after the last time, with the pointer at a pixel over the world: while
    /// the hand has nothing else to do.
    pub(in crate::app) fn lead_on_cursor(
        &mut self,
        scope: Scope<'_>,
        (pin, at): (PointId, DVec2),
        seconds: f64,
    ) -> Option<PinWay> {
        let is_free = self.doing == Doing::Nothing && matches!(self.tool(), Tool::Hand | Tool::Pin);
        if !is_free || !scope.is_there(pin) || !scope.is_pinned(pin) {
            self.on_cursor = None;
            return None;
        }
        let lead = self.on_cursor.get_or_insert_with(|| Lead { every: SMOOTHLY, ..Lead::of(scope, pin, at) });
        let way = lead.pass(scope, at, (seconds, false))?;
        Some(PinWay { follows: true, ..way })
    }
}
