//! Points on planes, on the walls of the bounds and on circles, by the same rules as points on edges.

use super::cluster::{Cluster, Common};
use super::loads;
use super::pair::{BOUNCED, OnPlane, left};
use super::rigid::Change;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale};

impl<S: Real> OnPlane<S> {
    pub(super) fn new(p: u32, surface: u32, normal: [S; 2]) -> Self {
        OnPlane {
            p,
            surface,
            normal,
            pressed: S::ZERO,
            rubbed: S::ZERO,
            old: S::ZERO,
            slips: false,
            approach: S::ZERO,
            bounced: S::ZERO,
            is_met: false,
            load: [S::ZERO; 2],
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self, last: (S, S)) {
        if self.pressed > S::ZERO {
            self.load = loads::load([self.pressed, self.rubbed], self.approach, last);
        }
        (self.pressed, self.rubbed, self.bounced, self.old, self.is_met) = (S::ZERO, S::ZERO, S::ZERO, S::ZERO, false);
    }

    /// Puts the point out.
    #[inline(always)]
    pub(super) fn press(&mut self, state: &mut Cluster<S>, common: &Common<S>) {
        let p = self.p as usize;
        let Some(mut gap) = self.gap(common, [state.start[p], state.now[p]]) else { return };
        let normal = self.normal;
        if gap >= S::ZERO && self.pressed == S::ZERO && gap >= state.at_once([p, p], -dot(state.way[p], normal)) {
            return;
        }
        if !self.is_met {
            gap += self.meet(state, common);
        }
        gap += self.old;
        let before = self.pressed;
        self.pressed = (before - gap / state.own_weight(p, normal)).max(S::ZERO);
        let [friction, restitution] = self.surface(common);
        let along = left(normal);
        let most = friction * self.pressed;
        let was = self.rubbed;
        self.rubbed = (was - dot(state.way[p], along) / state.own_weight(p, along)).max(-most).min(most);
        self.slips = self.rubbed.abs() >= most;
        let (out, aside) = (scale(normal, self.pressed - before), scale(along, self.rubbed - was));
        let push = add(out, aside);
        if push != [S::ZERO; 2] {
            state.note_push_of_one(p, restitution, (out, aside));
            state.push_one(p, push, Change::Way);
        }
        if state.may_creep() && !self.slips {
            let crept = dot(state.crept(p), along) / state.own_weight(p, along);
            if crept != S::ZERO {
                state.push_one(p, scale(along, -crept.max(-most).min(most)), Change::Place);
            }
        }
    }

    /// The point meets it for the first time in this substep. Returns by how much it is put out of where it was `[m]`.
    #[inline(always)]
    pub(super) fn meet(&mut self, state: &mut Cluster<S>, common: &Common<S>) -> S {
        let (p, normal) = (self.p as usize, self.normal);
        self.is_met = true;
        self.approach = dot(state.begun[p], normal);
        let depth = self.depth(common, state.start[p]);
        if depth <= S::ZERO {
            return S::ZERO;
        }
        let out = state.led_out([p, p], normal, depth);
        state.push_one(p, scale(normal, out / state.own_weight(p, normal)), Change::Place);
        self.old = depth - out;
        out
    }

    /// Gives the velocity that restitution asks for, where the point came faster than `least` `[m/s]`. Returns whether that
    /// lacked.
    pub(super) fn bounce(&mut self, state: &mut Cluster<S>, restitution: S, least: S) -> bool {
        let p = self.p as usize;
        let is_rigid = state.is_of_rigid([p, p]);
        let has_hit = self.pressed > S::ZERO || (self.is_met && is_rigid);
        if !has_hit || self.approach > -least || (restitution == S::ZERO && !is_rigid) {
            return false;
        }
        let weight = state.own_weight(p, self.normal);
        let target = -restitution * self.approach;
        let lacking = target - dot(state.velocity[p], self.normal);
        let before = self.bounced;
        self.bounced = (before + lacking / weight).max(S::ZERO);
        if self.bounced != before {
            state.push_one(p, scale(self.normal, self.bounced - before), Change::Velocity);
        }
        (self.bounced - before).abs() * weight > -self.approach * S::from_f64(BOUNCED)
    }

    /// Its friction and its restitution.
    #[inline(always)]
    pub(super) fn surface(&self, common: &Common<S>) -> [S; 2] {
        match common.circle_of(self) {
            None => {
                let plane = &common.planes[self.surface as usize];
                [plane.friction, plane.restitution]
            }
            Some(circle) => [circle.friction, circle.restitution],
        }
    }

    /// How far the point is above the plane `[m]`; on its way to a circle that is the one which it meets. `None`: it meets none.
    #[inline(always)]
    fn gap(&mut self, common: &Common<S>, [start, now]: [[S; 2]; 2]) -> Option<S> {
        let Some(circle) = common.circle_of(self) else { return Some(common.planes[self.surface as usize].gap(now)) };
        if !self.is_met {
            self.normal = circle.entry(start, now)?;
        }
        Some(circle.gap_along(self.normal, now))
    }

    /// How deep in the surface the point was as the substep began `[m]`.
    #[inline(always)]
    pub(super) fn depth(&self, common: &Common<S>, start: [S; 2]) -> S {
        let gap = match common.circle_of(self) {
            None => common.planes[self.surface as usize].gap(start),
            Some(circle) => circle.gap(start),
        };
        (-gap).max(S::ZERO)
    }
}
