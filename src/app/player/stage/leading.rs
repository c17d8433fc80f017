//! What the hand leads: pins and obstacles, on ways of their own.

use glam::DVec2;

use super::super::order::Note;
use super::super::pace::SINGLE_STEP;
use super::Stage;
use crate::app::lengths::length;
use crate::app::tools::{HaulWay, Hauled, PinWay};
use crate::history::Do;
use crate::scene::{AddKeys, PinMotionKeys};
use crate::sim::reach::{Reach, reaches};
use crate::sim::{Dynamics, PointId, Track};

/// A pin that is led takes so long to the place where the cursor was `[s]`: a little longer than until it is sent on.
const PIN_TIME: f64 = 0.15;
/// The way of obstacles is gone in no more than this, in frames: before, they stood.
const LONGEST_HAUL: f64 = 6.0;
/// Pins that are so much further apart than bonds reach are told of `[m]`.
const STRAINED: f64 = 1e-3;
/// What leading a pin is called.
const LEAD_PIN: &str = "move a pin";
/// What leading pins that bonds join is called.
const LEAD_BAR: &str = "move a bar";

impl Stage {
    /// Sends pins on their way. Those that are none by now stay where they are.
    pub(super) fn lead_pins(&mut self, PinWay { mut pins, goes_on, follows }: PinWay) -> Option<Note> {
        let world = self.history.world();
        pins.retain(|(pin, _)| world.pinned().contains(pin));
        pins.sort_unstable_by_key(|(pin, _)| *pin);
        if pins.is_empty() {
            return None;
        }
        let time = world.time();
        self.led_at = Some(time);
        let there = |&(pin, to): &(PointId, [f64; 3])| way_of(world, pin, &[(time + PIN_TIME, to)]);
        let pin_motion = pins.iter().map(there).collect();
        self.look_how_far(&pins, goes_on);
        let way = Do::Add(Box::new(AddKeys { pin_motion, ..AddKeys::default() }));
        if follows {
            return self.give(vec![way], None);
        }
        let name = if pins.len() > 1 { LEAD_BAR } else { LEAD_PIN };
        if !goes_on {
            return self.give(vec![way], Some(name));
        }
        self.give_on(vec![way], name)
    }

    /// Looks whether bonds let pins be where they go `[m]`.
    fn look_how_far(&mut self, pins: &[(PointId, [f64; 3])], goes_on: bool) {
        let world = self.history.world();
        let numbers: Vec<PointId> = pins.iter().map(|(pin, _)| *pin).collect();
        // Looking for reaches goes through all bonds: once for pins that go on.
        let known = self.led.take().filter(|(led, _)| goes_on && *led == numbers).map(|(_, reaches)| reaches);
        let is_led = |pin: &PointId| numbers.binary_search(pin).is_ok();
        let all = || reaches(world.bonds().iter(), &numbers, world.pinned());
        let reaches = known.unwrap_or_else(|| all().into_iter().filter(|reach| !is_led(&reach.pins[1])).collect());
        self.strained = beyond_reach(world, &reaches, pins);
        self.led = Some((numbers, reaches));
    }

    /// What is stuck in obstacles and has a way of its own still to go.
    fn note_tracks(&mut self, way: &HaulWay) {
        let world = self.history.world();
        let is_meant = |pin: &PointId| way.pins().iter().any(|(own, _)| own == pin);
        let goes_on = |knots: &[(f64, [f64; 3])]| knots.last().is_some_and(|(t, _)| *t > world.time());
        let tracks = world.pin_tracks().into_iter();
        self.tracks = tracks.filter(|(pin, knots)| is_meant(pin) && goes_on(knots)).collect();
    }

    /// What is stuck in obstacles that came so far goes after them within so long `[s]`; what is led goes on along its track, which is moved
    /// as they are.
    fn take_along(&mut self, way: &HaulWay, hauled: Hauled, over: f64) -> Option<Do> {
        let world = self.history.world();
        let (time, dimensions) = (world.time(), world.dimensions());
        let there = |x: [f64; 3]| way.along(hauled, DVec2::new(x[0], x[1])).extend(x[2]).to_array();
        let is_pinned = |pin: &PointId| world.pinned().contains(pin);
        let tracks = &self.tracks;
        let mut ends = Vec::new();
        let mut along = Vec::new();
        for &(pin, from) in way.pins().iter().filter(|(pin, _)| is_pinned(pin)) {
            let then = time + over;
            let track = tracks.iter().find(|(led, _)| *led == pin).map(|(_, knots)| Track { knots: knots.clone() });
            let at = track.as_ref().and_then(|track| track.at(then)).unwrap_or([from.x, from.y, 0.0]);
            let later = track.into_iter().flat_map(|track| track.knots).filter(|(t, _)| *t > then);
            let knots: Vec<(f64, [f64; 3])> =
                std::iter::once((then, there(at))).chain(later.map(|(t, x)| (t, there(x)))).collect();
            ends.push((pin, knots[0].1));
            along.push(way_of(world, pin, &knots));
        }
        debug_assert!(along.is_empty() || dimensions == 2, "obstacles are hauled in the plane");
        self.look_how_far(&ends, way.goes_on);
        (!along.is_empty()).then(|| Do::Add(Box::new(AddKeys { pin_motion: along, ..AddKeys::default() })))
    }

    /// Obstacles go on their way, as fast as time went since they did last, and as far as what they push has room.
    pub(super) fn haul(&mut self, way: HaulWay) -> Option<Note> {
        let before = self.hauled.take().filter(|_| way.goes_on);
        self.jam = None;
        let hauled = before.unwrap_or_else(|| way.begin());
        if before.is_none() {
            self.note_tracks(&way);
        }
        let Some(mut rest) = way.rest(hauled) else {
            self.hauled = before;
            return None;
        };
        let now = self.history.world().time();
        let shortest = SINGLE_STEP * self.pace.rate;
        let since = self.led_at.replace(now).filter(|_| before.is_some()).map_or(0.0, |last| now - last);
        rest.keys.over = Some(since.clamp(shortest, LONGEST_HAUL * shortest).max(rest.least * self.pace.rate));
        let over = rest.keys.over.unwrap_or(shortest);
        let acts = vec![Do::Move(rest.keys.clone())];
        let given = if before.is_some() { self.do_on(acts, rest.name) } else { self.do_now(acts, Some(rest.name)) };
        match given {
            Ok((applied, note)) => {
                let (gone, jam) = applied.into_iter().last().map_or((1.0, None), |applied| (applied.gone, applied.jam));
                let came = hauled.then(&rest, gone);
                (self.hauled, self.jam) = (Some(came), jam);
                let along = self.take_along(&way, came, over);
                along.and_then(|along| self.give_on(vec![along], rest.name)).or(note)
            }
            Err(note) => {
                self.hauled = before;
                Some(note)
            }
        }
    }
}

/// The way of a pin from where it is, through places at times `[s]`, `[m]`.
fn way_of(world: &dyn Dynamics, pin: PointId, knots: &[(f64, [f64; 3])]) -> PinMotionKeys {
    let dimensions = world.dimensions();
    let row = |t: f64, x: [f64; 3]| std::iter::once(t).chain(x.into_iter().take(dimensions)).collect::<Vec<f64>>();
    let mut here = [0.0; 3];
    (0..dimensions).for_each(|axis| here[axis] = world.positions().get(pin.index() * dimensions + axis));
    let first = row(world.time(), here);
    PinMotionKeys { point: pin.0, track: std::iter::once(first).chain(knots.iter().map(|&(t, x)| row(t, x))).collect() }
}

/// What is said where rigid bonds do not let pins be so far from the others as where they go `[m]`.
fn beyond_reach(world: &dyn Dynamics, reaches: &[Reach], pins: &[(PointId, [f64; 3])]) -> Option<String> {
    let dimensions = world.dimensions();
    let apart = |[pin, other]: [PointId; 2]| {
        let to = pins.iter().find(|(led, _)| *led == pin).map_or([f64::NAN; 3], |(_, to)| *to);
        let place = |axis| world.positions().get(other.index() * dimensions + axis);
        (0..dimensions).map(|axis| (to[axis] - place(axis)).powi(2)).sum::<f64>().sqrt()
    };
    let most = reaches.iter().map(|reach| apart(reach.pins) - reach.most).fold(0.0, f64::max);
    (most > STRAINED).then(|| format!("the pins are {} further apart than the bonds between them reach", length(most)))
}
