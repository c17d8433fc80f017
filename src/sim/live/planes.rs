//! Points on planes, on the walls of the bounds and on circles, by the same rules as points on edges.

use super::cluster::{Cluster, Common};
use super::contact::{Contact, within};
use super::pair::{OnPlane, left};
use super::rigid::Change;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale};

impl<S: Real> OnPlane<S> {
    pub(super) fn new(p: u32, surface: u32, normal: [S; 2]) -> Self {
        OnPlane { p, surface, normal, contact: Contact::new(), slips: false }
    }

    /// Puts the point out.
    #[inline(always)]
    pub(super) fn press(&mut self, state: &mut Cluster<S>, common: &Common<S>) {
        let p = self.p as usize;
        let Some(mut gap) = self.gap(common, [state.start[p], state.now[p]]) else { return };
        let normal = self.normal;
        if gap >= S::ZERO && self.contact.pressed == S::ZERO && gap >= state.at_once([p, p], -dot(state.way[p], normal))
        {
            return;
        }
        if !self.contact.is_met {
            gap += self.meet(state, common);
        }
        let push = self.contact.press(-(gap + self.contact.old), state.own_weight(p, normal));
        let [friction, restitution] = self.surface(common);
        let along = left(normal);
        let most = friction * self.contact.pressed;
        let rub = self.contact.rub(dot(state.way[p], along), (state.own_weight(p, along), most));
        self.slips = self.contact.slips(friction);
        let (out, aside) = (scale(normal, push), scale(along, rub));
        let push = add(out, aside);
        if push != [S::ZERO; 2] {
            state.note_push_of_one(p, restitution, (out, aside));
            state.push_one(p, push, Change::Way);
        }
        if state.may_creep() && !self.slips {
            let crept = dot(state.crept(p), along) / state.own_weight(p, along);
            if crept != S::ZERO {
                state.push_one(p, scale(along, -within(crept, most)), Change::Place);
            }
        }
    }

    /// The point meets it for the first time in this substep. Returns by how much it is put out of where it was `[m]`.
    #[inline(always)]
    pub(super) fn meet(&mut self, state: &mut Cluster<S>, common: &Common<S>) -> S {
        let (p, normal) = (self.p as usize, self.normal);
        self.contact.is_met = true;
        self.contact.approach = dot(state.begun[p], normal);
        let depth = self.depth(common, state.start[p]);
        if depth <= S::ZERO {
            return S::ZERO;
        }
        let out = state.led_out([p, p], normal, depth);
        state.push_one(p, scale(normal, out / state.own_weight(p, normal)), Change::Place);
        self.contact.old = depth - out;
        out
    }

    /// Gives the velocity that restitution asks for, where the point came faster than `least` `[m/s]`. Returns whether that
    /// lacked.
    pub(super) fn bounce(&mut self, state: &mut Cluster<S>, restitution: S, least: S) -> bool {
        let p = self.p as usize;
        if !self.contact.bounces((restitution, state.is_of_rigid([p, p])), least) {
            return false;
        }
        let weight = state.own_weight(p, self.normal);
        let (push, lacked) = self.contact.give_back(restitution, dot(state.velocity[p], self.normal), weight);
        if push != S::ZERO {
            state.push_one(p, scale(self.normal, push), Change::Velocity);
        }
        lacked
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
        if !self.contact.is_met {
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
