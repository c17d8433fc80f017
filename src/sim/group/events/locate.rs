//! When an event happens within a step, by roots of its margin.

use super::{Event, Group, Margins, SHORTEST_FLIGHT};
use crate::sim::counters::Counters;
use crate::sim::real::Real;
use crate::sim::solve::root::Root;
use crate::sim::surroundings::Surroundings;

/// Evaluations after which a root counts as found.
const MOST_GUESSES: u32 = 60;
impl<S: Real, const D: usize> Group<S, D> {
    /// Goes back and takes the part of the step that ends at the first event. Returns that part, or `h` where none can
    /// be told from the start.
    pub(super) fn locate(
        &mut self,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        (event, value): (Event, f64),
        counters: &mut Counters,
    ) -> f64 {
        let (mut event, mut high) = (event, (h, value));
        loop {
            let mut low = (0.5 * high.0, 0.0);
            loop {
                let seen = self.retake(around, (t, low.0), event, counters);
                low.1 = seen.asked;
                if low.1 > 0.0 {
                    break;
                }
                high = if low.1 < 0.0 { low } else { high };
                low.0 *= 0.5;
                if low.0 < h * SHORTEST_FLIGHT {
                    self.retake(around, (t, h), event, counters);
                    return h;
                }
            }
            match self.close_in(around, t, event, (low, high), counters) {
                (at, None) => return at,
                // Another event comes first.
                (at, Some((earlier, value))) => (event, high) = (earlier, (at, value)),
            }
        }
    }

    /// The root of an event's margin; or where another event was found to have been passed already.
    fn close_in(
        &mut self,
        around: &Surroundings<D>,
        t: f64,
        event: Event,
        (low, high): ((f64, f64), (f64, f64)),
        counters: &mut Counters,
    ) -> (f64, Option<(Event, f64)>) {
        let mut root = Root::between(low, high);
        let mut at = high.0;
        for _ in 0..MOST_GUESSES {
            at = root.guess();
            let seen = self.retake(around, (t, at), event, counters);
            if let Some(earlier) = seen.next.filter(|&next| seen.least < 0.0 && next != event && seen.asked > 0.0) {
                return (at, Some((earlier, seen.least)));
            }
            if seen.asked == 0.0 || root.width() < 4.0 * f64::EPSILON * (t + high.0) {
                break;
            }
            root.narrow(at, seen.asked);
        }
        (at, None)
    }

    /// Takes a step of `h` from the state before. Returns the margins that it ends with.
    fn retake(
        &mut self,
        around: &Surroundings<D>,
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
