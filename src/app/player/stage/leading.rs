//! What the hand leads: pins and obstacles, on ways of their own.

use super::super::order::Note;
use super::super::pace::SINGLE_STEP;
use super::Stage;
use crate::app::lengths::length;
use crate::app::tools::{HaulWay, PinWay};
use crate::history::Do;
use crate::scene::{AddKeys, PinMotionKeys};
use crate::sim::reach::{Reach, reaches};
use crate::sim::{Dynamics, PointId};

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
        let (time, dimensions) = (world.time(), world.dimensions());
        self.led_at = Some(time);
        let track = |&(pin, to): &(PointId, [f64; 3])| {
            let here = (0..dimensions).map(|axis| world.positions().get(pin.index() * dimensions + axis));
            let from = std::iter::once(time).chain(here).collect();
            let there = std::iter::once(time + PIN_TIME).chain(to.into_iter().take(dimensions)).collect();
            PinMotionKeys { point: pin.0, track: vec![from, there] }
        };
        let pin_motion = pins.iter().map(track).collect();
        let numbers: Vec<PointId> = pins.iter().map(|(pin, _)| *pin).collect();
        // Looking for reaches goes through all bonds: once for pins that go on.
        let known = self.led.take().filter(|(led, _)| goes_on && *led == numbers).map(|(_, reaches)| reaches);
        let is_led = |pin: &PointId| numbers.binary_search(pin).is_ok();
        let all = || reaches(world.bonds().iter(), &numbers, world.pinned());
        let reaches = known.unwrap_or_else(|| all().into_iter().filter(|reach| !is_led(&reach.pins[1])).collect());
        self.strained = beyond_reach(world, &reaches, &pins);
        self.led = Some((numbers, reaches));
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

    /// Obstacles go on their way, as fast as time went since they did last, and as far as what they push has room.
    pub(super) fn haul(&mut self, way: HaulWay) -> Option<Note> {
        let before = self.hauled.take().filter(|_| way.goes_on);
        self.jam = None;
        let hauled = before.unwrap_or_else(|| way.begin());
        let Some(mut rest) = way.rest(hauled) else {
            self.hauled = before;
            return None;
        };
        let now = self.history.world().time();
        let shortest = SINGLE_STEP * self.pace.rate;
        let since = self.led_at.replace(now).filter(|_| before.is_some()).map_or(0.0, |last| now - last);
        rest.keys.over = Some(since.clamp(shortest, LONGEST_HAUL * shortest).max(rest.least * self.pace.rate));
        let acts = vec![Do::Move(rest.keys.clone())];
        let given = if before.is_some() { self.do_on(acts, rest.name) } else { self.do_now(acts, Some(rest.name)) };
        match given {
            Ok((applied, note)) => {
                let (gone, jam) = applied.into_iter().last().map_or((1.0, None), |applied| (applied.gone, applied.jam));
                (self.hauled, self.jam) = (Some(hauled.then(&rest, gone)), jam);
                note
            }
            Err(note) => {
                self.hauled = before;
                Some(note)
            }
        }
    }
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
