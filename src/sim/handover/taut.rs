//! Islands whose pins are led further apart than their rigid bonds reach: they go live before these are taut, and stay so while they are.
//!
//! What gets taut between pins that go on can only give way across, the faster the straighter it is, and no exact method has lengths that
//! the pins contradict. The live step stretches all of them alike (`live/strap.rs`).

use std::collections::BTreeSet;

use super::{UNHELD, can_be_cheaper};
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::moved::Why;
use crate::sim::reach::{Reach, Span, reaches};
use crate::sim::real::Real;
use crate::sim::vector::{length, sub};
use crate::sim::world::World;

/// How long before that it goes `[s]`.
const AHEAD: f64 = 0.1;
/// Share of its reach by which a strap is longer: by less places are rounded.
const OVER: f64 = 1e-4;
/// Rigid bonds that ways are looked for along, of all pins that are led, about: of many of these the first are looked at. And most bonds of a
/// scene that is looked through: it is done anew with each command that leads a pin.
const MOST_WAYS: usize = 10_000;
const MOST_BONDS: usize = 100_000;

impl<S: Real, const D: usize> World<S, D> {
    /// At the end of a frame at `t` `[s]`: what is taut soon.
    pub(super) fn heed_pins(&mut self, t: f64) {
        if self.model.budget().is_none() || !self.model.pin_motion.iter().any(|(_, track)| !track.knots.is_empty()) {
            return;
        }
        if self.spans.0 != Some(self.topology) {
            self.spans = (Some(self.topology), self.spans_of_led_pins().into());
        }
        let list = self.spans.1.clone();
        let beyond = list.iter().filter(|span| self.is_beyond(&span.reach, t));
        let due: BTreeSet<usize> = beyond.flat_map(|span| self.between(span)).collect();
        let (live, own): (Vec<usize>, Vec<usize>) =
            due.into_iter().partition(|&place| self.plan.groups[place].is_live());
        for place in live {
            let moved = &mut self.plan.groups[place].moved;
            moved.until = moved.until.max(t + UNHELD);
        }
        let own: Vec<usize> = own.into_iter().filter(|&place| can_be_cheaper(&self.plan.groups[place])).collect();
        self.go_live(&own, t, Why::Alarm);
    }

    fn spans_of_led_pins(&self) -> Vec<Span> {
        if self.bonds.len() > MOST_BONDS {
            return Vec::new();
        }
        let is_free = |point: &PointId| self.can_move(point.index());
        // What joins two pins is not between them.
        let pulls = |bond: &Bond| {
            bond.kind == BondKind::Rigid && bond.limit != Limit::Min && (is_free(&bond.a) || is_free(&bond.b))
        };
        let list: Vec<Bond> = self.bonds.iter().filter(pulls).collect();
        let mut led: Vec<PointId> = self.model.pin_motion.iter().map(|(pin, _)| *pin).collect();
        led.sort_unstable();
        led.truncate(MOST_WAYS / list.len().max(1));
        let mut held = self.model.pinned.clone();
        held.sort_unstable();
        let mut hung: Vec<(PointId, PointId)> =
            list.iter().flat_map(|bond| [(bond.a, bond.b), (bond.b, bond.a)]).filter(|(_, end)| is_free(end)).collect();
        hung.sort_unstable();
        let at = |pin: PointId| {
            let first = hung.partition_point(|entry| entry.0 < pin);
            hung[first..].iter().take_while(|entry| entry.0 == pin).map(|entry| entry.1).collect()
        };
        reaches(list.into_iter(), &led, &held)
            .into_iter()
            .map(|reach| Span { reach, hung: reach.pins.map(at) })
            .collect()
    }

    /// Whether two pins are further apart at `t` `[s]`, or soon, than what is between them reaches.
    fn is_beyond(&self, reach: &Reach, t: f64) -> bool {
        let track = |pin: PointId| self.model.pin_motion.iter().find(|(led, _)| *led == pin).map(|(_, track)| track);
        let tracks = reach.pins.map(track);
        let place = |end: usize, time: f64| {
            tracks[end].and_then(|track| track.at(time)).unwrap_or_else(|| self.place(reach.pins[end].index()))
        };
        // Between knots both go straight on: they are furthest apart at the ends.
        let knots = tracks.iter().flatten().flat_map(|track| &track.knots).map(|knot| knot.0);
        let mut times = knots.filter(|&time| time > t && time < t + AHEAD).chain([t, t + AHEAD]);
        times.any(|time| length(sub(place(0, time), place(1, time))) > reach.most * (1.0 + OVER))
    }

    /// The groups that hang on both pins.
    fn between(&self, span: &Span) -> Vec<usize> {
        let [first, second] = span.hung.each_ref().map(|points| -> BTreeSet<usize> {
            points.iter().filter_map(|point| self.slot(point.index())).map(|[place, _]| place).collect()
        });
        first.intersection(&second).copied().collect()
    }
}
