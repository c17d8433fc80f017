//! When an event happens within a step, by roots of its margin.

use super::{Event, Group, Margins, SHORTEST_FLIGHT};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::real::Real;
use crate::sim::solve::root::Root;

/// Evaluations after which a root counts as found.
const MOST_GUESSES: u32 = 60;
/// Steps in a row that an event may end where they begin; then it is dealt with at the end of the step, so that bonds and
/// points that cannot decide on a side do not stop time.
const MOST_RESTARTS: u32 = 16;
/// Share of a step within which an event of a contact or the mouse region counts as due at the start.
const INSTANT: f64 = 1e-12;
/// Share of a step within which an event of a bond counts as due at the start. Strings that get each other taut in turn do
/// so in flights that shrink without end: they are followed down to this, which costs a velocity of this share of what
/// gravity makes in a step.
const SOON: f64 = 1e-6;
/// Events of bonds within a substep for which that share grows tenfold: where strings lie almost along each other their
/// flights hardly shrink, and would not let time go on.
const PATIENCE: f64 = 4.0;
/// What it grows to at most.
const SOON_AT_MOST: f64 = 0.1;

impl<S: Real, const D: usize> Group<S, D> {
    /// Goes back and takes the part of the step that ends at the first event, given a time within it when one was passed
    /// and the margin there. Returns that part and the event; 0 where it was due at the start already, `h` where that
    /// cannot be told.
    pub(super) fn locate(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        (event, high): (Event, (f64, f64)),
        counters: &mut Counters,
    ) -> (f64, Option<Event>) {
        let (mut event, mut high) = (event, high);
        loop {
            let Some(low) = self.start_of(around, (t, h), event, &mut high, counters) else {
                let is_due = self.edges.restarts < MOST_RESTARTS;
                if is_due {
                    self.points.restore(&self.before);
                    self.engine.refresh();
                } else {
                    self.retake(around, (t, h), event, counters);
                }
                return (if is_due { 0.0 } else { h }, Some(event));
            };
            match self.close_in(around, t, event, (low, high), counters) {
                (at, None) => return (at, Some(event)),
                // Another event comes first.
                (at, Some((earlier, value))) => (event, high) = (earlier, (at, value)),
            }
        }
    }

    /// A time before the event, and the margin there; `None` where it seems to be due at the start. `high`, a time after
    /// it, comes nearer.
    fn start_of(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        event: Event,
        high: &mut (f64, f64),
        counters: &mut Counters,
    ) -> Option<(f64, f64)> {
        if let Some(margin) = self.margin_before(event) {
            return Some((0.0, margin));
        }
        let soon = (SOON * libm::pow(10.0, f64::from(self.edges.turns) / PATIENCE)).min(SOON_AT_MOST);
        let mut low = (if event.is_of_bond() { soon * high.0 } else { 0.5 * high.0 }, 0.0);
        loop {
            low.1 = self.retake(around, (t, low.0), event, counters).asked;
            if low.1 > 0.0 {
                return Some(low);
            }
            *high = if low.1 < 0.0 { low } else { *high };
            low.0 *= 0.5;
            // A flight that ends so soon is rest; any other event may well come right after one that it does not depend on.
            let least = if matches!(event, Event::Hit { .. }) { SHORTEST_FLIGHT } else { INSTANT };
            if event.is_of_bond() || low.0 < h * least {
                return None;
            }
        }
    }

    /// The root of an event's margin; or where another event was found to have been passed already.
    fn close_in(
        &mut self,
        around: &Environment<D>,
        t: f64,
        event: Event,
        (low, high): ((f64, f64), (f64, f64)),
        counters: &mut Counters,
    ) -> (f64, Option<(Event, f64)>) {
        let mut root = Root::between(low, high);
        let (mut at, mut ahead) = (high.0, None);
        for guess in 0..MOST_GUESSES {
            // Newton's method where the margin's rate is known, with a secant now and then, which never fails.
            let ahead_now = ahead.filter(|&ahead| guess % 4 != 3 && root.contains(ahead));
            at = ahead_now.unwrap_or_else(|| root.guess());
            let seen = self.retake(around, (t, at), event, counters);
            if let Some(earlier) = seen.next.filter(|&next| seen.least < 0.0 && next != event && seen.asked >= 0.0) {
                return (at, Some((earlier, seen.least)));
            }
            if seen.asked == 0.0 || root.width() < 4.0 * f64::EPSILON * (t + high.0) {
                break;
            }
            root.narrow(at, seen.asked);
            ahead = self.margin_rate(event).map(|rate| at - seen.asked / rate);
        }
        (at, None)
    }

    /// Takes a step of `h` from the state before. Returns the margins that it ends with.
    pub(super) fn retake(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        event: Event,
        counters: &mut Counters,
    ) -> Margins {
        self.points.restore(&self.before);
        self.engine.refresh();
        self.take(around, (t, h), counters);
        self.margins(around, t + h, Some(event), counters)
    }
}
