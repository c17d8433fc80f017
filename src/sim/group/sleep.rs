//! Groups of islands that have come to rest sleep: they are not stepped until something reaches them.
//!
//! Sleep is a part of the step: it goes by the world's own time and by where points were, never by a clock, so that a run that
//! is replayed sleeps and wakes as it did.

use super::Group;
use super::engine::Engine;
use crate::sim::environment::Environment;
use crate::sim::force::mouse::{self, Push};
use crate::sim::measure;
use crate::sim::real::Real;
use crate::sim::vector::{length, sub, zero};

/// How long all points must have stayed where they are before a group falls asleep `[s]`.
pub(crate) const STILL_TIME: f64 = 0.5;
/// How far a point may be, within that time, from where it was at its beginning, along each axis: as a share of the extent of its
/// group, or of 1 m where that is larger or the group is one point. What moves more slowly than 0.1 mm/s for long is seen by nobody.
pub(crate) const STILL_EXTENT: f64 = 5e-5;
/// Times that a group which moves is looked at in [`STILL_TIME`]: the places of its points are copied as often.
const LOOKS: f64 = 8.0;

/// How far points may be from where they were and count as still `[m]`.
fn still_extent<S: Real, const D: usize>(position: &[[S; D]]) -> S {
    let size = measure::extent(position)
        .map_or(0.0, |[low, high]| sub(high, low).into_iter().fold(0.0, |most: f64, side| most.max(side.to_f64())));
    S::from_f64(STILL_EXTENT * if size > 0.0 { size.min(1.0) } else { 1.0 })
}

/// What a group knows of its own rest.
///
/// It falls asleep when no point has left the place that it had [`STILL_TIME`] ago by more than [`STILL_EXTENT`] says at any step since,
/// no cursor was in reach, nothing of it is grabbed, none of its pins is led any more, no drive moves it, and no gust may come. Speeds say nothing of that: one that
/// turns around has none, and what rests on a floor may report some.
#[derive(Clone, Debug)]
pub(crate) struct Sleep<S, const D: usize> {
    /// Where the points were at `since`; empty: that is still to be noted, not before `since`.
    anchor: Vec<[S; D]>,
    /// How far they may be from there `[m]`.
    most: S,
    /// `[s]`
    since: f64,
    /// The point that moved last: it is looked at first.
    mover: usize,
    /// The box around its points, while it sleeps.
    asleep: Option<[[S; D]; 2]>,
}

impl<S: Real, const D: usize> Default for Sleep<S, D> {
    fn default() -> Self {
        Sleep { anchor: Vec::new(), most: S::ZERO, since: f64::NEG_INFINITY, mover: 0, asleep: None }
    }
}

impl<S: Real, const D: usize> Sleep<S, D> {
    /// Whether all points stayed about where they were, and the place of one that did not.
    fn left(&self, position: &[[S; D]]) -> Option<usize> {
        let most = self.most;
        // A position that is not finite has left.
        let has_left = |&i: &usize| {
            let is_near = |k: usize| (position[i][k] - self.anchor[i][k]).abs() <= most;
            !(0..D).all(is_near)
        };
        std::iter::once(self.mover).chain(0..position.len()).find(has_left)
    }
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Looks at the group at time `t` `[s]`, after a step. Costs one point where the one that moved last moves on.
    pub(crate) fn doze(&mut self, around: &Environment<D>, t: f64) {
        if self.is_asleep() {
            return;
        }
        let is_disturbed = self.grabbed.is_some()
            || self.pull.gusts().is_some()
            || self.pull.driven.moves_after(t, &around.keys)
            || self.tracks.iter().any(|(_, track)| track.moves_after(t))
            || around.mouse_at(t).is_some_and(|(force, cursor)| mouse::reaches(&self.points, force, cursor));
        if is_disturbed {
            return self.wake();
        }
        let Group { points, sleep, .. } = self;
        if sleep.anchor.is_empty() {
            if t >= sleep.since {
                sleep.anchor.clone_from(&points.position);
                sleep.since = t;
                sleep.most = still_extent(&points.position);
            }
        } else if let Some(mover) = sleep.left(&points.position) {
            *sleep = Sleep { since: t + STILL_TIME / LOOKS, mover, ..Sleep::default() };
        } else if t - sleep.since >= STILL_TIME {
            self.fall_asleep();
        }
    }

    /// Its points are at rest where they are.
    fn fall_asleep(&mut self) {
        self.sleep = Sleep { asleep: measure::extent(&self.points.position), ..Sleep::default() };
        self.points.velocity.fill(zero());
        self.points.velocity_lost.fill(zero());
        if let Engine::Bulk(bulk) = &mut self.engine {
            bulk.reload();
        }
        self.engine.refresh();
    }

    /// Whether it sleeps, as one without points always does.
    pub(crate) fn is_asleep(&self) -> bool {
        self.sleep.asleep.is_some() || self.points.len() == 0
    }

    /// Wakes if the mouse at time `t` `[s]` can reach it, or it is grabbed.
    pub(crate) fn wake_if_reached(&mut self, around: &Environment<D>, t: f64) {
        let is_reached = |bounds| around.mouse_at(t).is_some_and(|(force, at)| Push::new(force, at).reaches(bounds));
        if self.sleep.asleep.is_some_and(is_reached) || (self.grabbed.is_some() && self.is_asleep()) {
            self.wake();
        }
    }

    /// Whether the cursor may reach it at some time of the `h` from `t` on `[s]`, or leads it.
    pub(crate) fn may_be_reached(&self, around: &Environment<D>, (t, h): (f64, f64)) -> bool {
        if self.grabbed.is_some() {
            return true;
        }
        let Some([low, high]) = measure::extent(&self.points.position) else { return false };
        let pulled = length(self.pull.gravity) + self.pull.most_push();
        let fastest = measure::speed_bound(&self.points.velocity) + S::from_f64(h * pulled);
        let way = S::from_f64(2.0 * h) * fastest;
        let bounds = [low.map(|x| x - way), high.map(|x| x + way)];
        around.may_reach(bounds, (t, h))
    }

    /// Whether its method follows a fast cursor within a step by itself, in substeps.
    pub(crate) fn follows_cursor(&self) -> bool {
        matches!(self.engine, Engine::Bulk(_))
    }

    /// Wakes if a drive moves it from time `t` on `[s]`.
    pub(crate) fn wake_if_driven(&mut self, around: &Environment<D>, t: f64) {
        if self.sleep.asleep.is_some() && self.pull.driven.moves_after(t, &around.keys) {
            self.wake();
        }
    }

    /// Wakes, or goes on being awake.
    pub(crate) fn wake(&mut self) {
        self.sleep = Sleep::default();
    }
}
