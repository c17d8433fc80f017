//! Groups of islands that have come to rest sleep: they are not stepped until something reaches them.

use super::environment::Environment;
use super::force::mouse::{self, Push};
use super::group::Group;
use super::measure;
use super::real::Real;

/// Speed below which a point counts as still [m/s].
pub const STILL_SPEED: f64 = 1e-4;
/// How long all points must be still before a group falls asleep [s].
pub const STILL_TIME: f64 = 0.5;

/// What a group knows of its own rest.
///
/// It falls asleep when none of its points has been faster than [`STILL_SPEED`] for [`STILL_TIME`], no cursor was in reach
/// and none of its pins is led any more. That goes by the world's own time: so it is the same at any frame rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sleep<S, const D: usize> {
    still_since: Option<f64>,
    /// The box around its points, while it sleeps.
    asleep: Option<[[S; D]; 2]>,
}

impl<S, const D: usize> Default for Sleep<S, D> {
    fn default() -> Self {
        Sleep { still_since: None, asleep: None }
    }
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Looks at the group at time `t` [s], after a step. Costs one point where the first one moves.
    pub(crate) fn doze(&mut self, around: &Environment<D>, t: f64) {
        if self.is_asleep() {
            return;
        }
        let is_still = measure::is_slower(&self.points, STILL_SPEED)
            && !self.tracks.iter().any(|(_, track)| track.moves_after(t))
            && !around.mouse_at(t).is_some_and(|(force, cursor)| mouse::reaches(&self.points, force, cursor));
        if !is_still {
            return self.wake();
        }
        let since = *self.sleep.still_since.get_or_insert(t);
        if t - since >= STILL_TIME {
            self.sleep.asleep = measure::extent(&self.points.position);
        }
    }

    /// Whether it sleeps, as one without points always does.
    pub(crate) fn is_asleep(&self) -> bool {
        self.sleep.asleep.is_some() || self.points.len() == 0
    }

    /// Wakes if the mouse at time `t` [s] can reach it.
    pub(crate) fn stir(&mut self, around: &Environment<D>, t: f64) {
        let is_reached = |bounds| around.mouse_at(t).is_some_and(|(force, at)| Push::new(force, at).reaches(bounds));
        if self.sleep.asleep.is_some_and(is_reached) {
            self.wake();
        }
    }

    /// Wakes, or goes on being awake.
    pub(crate) fn wake(&mut self) {
        self.sleep = Sleep::default();
    }
}
