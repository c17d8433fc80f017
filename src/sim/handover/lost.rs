//! Islands that leave the finite numbers: they are put back to where they last were among them, and stand still there.
//!
//! ```text
//! live       keeps the state at the start of its step, and tells whom it lost (`live/mod.rs`)
//! own        a copy of the state at the end of the frame, or at the last look that was good (`group/watch.rs`)
//! ```
//! What its own method lost is tried once by the live step, where that may move it.

use super::can_go;
use crate::sim::group::engine::Engine;
use crate::sim::group::watch::Alarm;
use crate::sim::real::Real;
use crate::sim::timeline::frame_of;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// After a step: what was lost in it.
    pub(super) fn heed_lost(&mut self) {
        self.heed_lost_of_live();
        if !self.model.freezes() {
            return;
        }
        let (t, h) = (self.timeline.time(), self.timeline.substep());
        for place in 0..self.plan.groups.len() {
            let group = &mut self.plan.groups[place];
            if group.is_asleep() || group.is_live() {
                continue;
            }
            if group.is_finite() {
                group.keep_good(frame_of(t) != frame_of(t + h), t);
            } else if can_go(group) {
                self.hand_over_on(place, Alarm::NotFinite, t);
            } else {
                self.stand_still(place, t);
            }
        }
    }

    /// The same of what the live step moves and of rigid bodies, which are where the step began.
    pub(super) fn heed_lost_of_live(&mut self) {
        let mut lost: Vec<[u32; 2]> = Vec::new();
        for (group, place) in self.plan.groups.iter_mut().zip(0..) {
            if let Engine::Bulk(mover) = &mut group.engine {
                lost.extend(mover.take_lost().into_iter().map(|slot| [place, slot]));
            }
        }
        let Some(&[place, _]) = lost.first() else { return };
        let solver = self.plan.own[place as usize].solver;
        lost.sort_unstable();
        let is_lost = |&point: &u32| {
            let slot = self.slot(point as usize).map(|slot| slot.map(|place| place as u32));
            slot.is_some_and(|slot| lost.binary_search(&slot).is_ok())
        };
        let points: Vec<u32> = self.free_points().filter(is_lost).collect();
        self.freeze(&points, (solver, self.timeline.time()));
    }

    /// The islands of a group that are not among the numbers are where the group last was, and stand still from `t` on `[s]`. Without a
    /// state to go back to they stay as they are.
    pub(super) fn stand_still(&mut self, place: usize, t: f64) {
        let Some(anchor) = self.plan.groups[place].take_anchor() else { return };
        let group = &self.plan.groups[place];
        let is_out = |&point: &u32| {
            let slot = self.slot(point as usize).filter(|slot| slot[0] == place);
            slot.is_some_and(|slot| !group.is_finite_at(slot[1]))
        };
        let out: Vec<u32> = self.free_points().filter(is_out).collect();
        let lost: Vec<u32> = self.islands_with(&out).into_iter().flatten().collect();
        let slots: Vec<usize> =
            lost.iter().filter_map(|&point| self.slot(point as usize)).map(|[_, slot]| slot).collect();
        self.plan.groups[place].put_back(&anchor, &slots);
        let solver = self.plan.own[place].solver;
        self.freeze(&lost, (solver, t));
    }

    /// The points that can move, ascending.
    fn free_points(&self) -> impl Iterator<Item = u32> {
        (0..self.count() as u32).filter(|&point| self.inverse_mass[point as usize] > 0.0)
    }
}
