//! What moves an island, since when and why: for those who ask, and for what goes back to its own method after a while.

use super::bond::PointId;
use super::solver::Solver;

/// Why an island is moved by the method that moves it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Why {
    /// The rules chose it, or the scene asks for it.
    #[default]
    Plan,
    /// Its own method took more work than a frame may, or would have taken it from the start.
    Budget,
    /// Bodies may meet.
    Contact,
    /// Its own method made energy, did not hold its bonds, did not converge or left the numbers.
    Alarm,
    /// It left the finite numbers and nothing can move it: it stands still where it last was, until a command touches it.
    NotFinite,
}

impl Why {
    /// All.
    pub const ALL: [Why; 5] = [Why::Plan, Why::Budget, Why::Contact, Why::Alarm, Why::NotFinite];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Why::Plan => "plan",
            Why::Budget => "budget",
            Why::Contact => "contact",
            Why::Alarm => "alarm",
            Why::NotFinite => "not finite",
        }
    }
}

/// Islands that step together, and what moves them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovedBy {
    /// The lowest of their points that can move.
    pub first: PointId,
    /// Points that can move.
    pub count: usize,
    /// Islands.
    pub islands: usize,
    /// The method; of what stands still the one that failed.
    pub method: Solver,
    /// Since when `[s]`.
    pub since: f64,
    /// Why.
    pub why: Why,
}

/// An island that was handed over to the live step, as a kept world has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandedOver {
    /// The lowest of its points that can move.
    pub first: PointId,
    /// Since when `[s]`.
    pub since: f64,
    /// Why.
    pub why: Why,
    /// When it may go back at the soonest `[s]`.
    pub until: f64,
    /// How often it was handed over, of late.
    pub times: u32,
}

/// Most of the hand-overs that the wait for the way back is doubled for: 64 s.
const MOST_DOUBLED: u32 = 6;
/// How long an island has to bear its own method until earlier hand-overs are forgotten `[s]`.
const FORGOTTEN: f64 = 10.0;

/// What a group knows of who moves it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moved {
    /// Since when `[s]`.
    pub(crate) since: f64,
    pub(crate) why: Why,
    /// Of what was handed over: when it may go back at the soonest `[s]`.
    pub(crate) until: f64,
    /// How often it was handed over, of late.
    pub(crate) times: u32,
}

impl Moved {
    /// By its plan since `t` `[s]`.
    pub(crate) fn by_plan(t: f64) -> Self {
        Moved { since: t, ..Moved::default() }
    }

    /// Whether it was handed over to the live step.
    pub(crate) fn is_handed_over(&self) -> bool {
        self.why != Why::Plan
    }

    /// Handed over at `t` `[s]`: for 1 s after an alarm and 2 s where the budget was the reason, twice as long every time that it
    /// happens again soon.
    pub(crate) fn handed_over(self, t: f64, why: Why) -> Self {
        let times = if t - self.since > FORGOTTEN { 0 } else { self.times };
        match why {
            // Whoever meets others often is none the worse for it.
            Why::Contact => Moved { since: t, why, until: t + wait(why, 0), times },
            _ => Moved { since: t, why, until: t + wait(why, times), times: times + 1 },
        }
    }

    /// Back to its own method at `t` `[s]`.
    pub(crate) fn handed_back(self, t: f64) -> Self {
        Moved { since: t, why: Why::Plan, until: t, times: self.times }
    }

    /// Live at `t` `[s]` as others are that it may touch.
    pub(crate) fn kept_until_apart(self, t: f64) -> Self {
        Moved { until: self.until.max(t + wait(Why::Contact, 0)), ..self }
    }

    /// It may take more work from `t` on `[s]`: what was too dear until now may go back at once.
    pub(crate) fn allow(&mut self, t: f64) {
        if self.why == Why::Budget {
            self.until = self.until.min(t);
        }
    }

    /// It cannot go back at `t` `[s]` yet.
    pub(crate) fn put_off(&mut self, t: f64) {
        self.until = t + wait(Why::Alarm, 0);
    }
}

/// How long an island stays handed over that was so this often before `[s]`.
fn wait(why: Why, times: u32) -> f64 {
    let first = if why == Why::Budget { 2.0 } else { 1.0 };
    first * f64::from(1_u32 << times.min(MOST_DOUBLED))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waits_double_and_are_forgotten() {
        let first = Moved::by_plan(0.0).handed_over(3.0, Why::Budget);
        assert_eq!((first.since, first.until, first.times), (3.0, 5.0, 1));
        let second = first.handed_back(5.0).handed_over(6.0, Why::Budget);
        assert_eq!((second.until, second.times), (10.0, 2));
        let alarmed = second.handed_back(10.0).handed_over(10.5, Why::Alarm);
        assert_eq!((alarmed.until, alarmed.times), (14.5, 3));
        let later = alarmed.handed_back(15.0).handed_over(40.0, Why::Alarm);
        assert_eq!((later.until, later.times), (41.0, 1));
        assert!(
            wait(Why::Budget, 1000) == 128.0 && later.is_handed_over() && !later.handed_back(50.0).is_handed_over()
        );
    }
}
