//! Points on planes and on the walls of the bounds, by the same rules as points on edges.

use super::cluster::Cluster;
use super::pair::{BOUNCED, OnPlane};
use crate::sim::contact::surface::Surface;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

impl<S: Real> OnPlane<S> {
    pub(super) fn new(p: u32, surface: u32) -> Self {
        OnPlane { p, surface, pressed: S::ZERO, rubbed: S::ZERO, slips: false, approach: S::ZERO, is_met: false }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        (self.pressed, self.rubbed, self.is_met) = (S::ZERO, S::ZERO, false);
    }

    /// Puts the point out.
    #[inline(always)]
    pub(super) fn press(&mut self, state: &mut Cluster<S>, surface: &Surface<S, 2>) {
        let (p, normal) = (self.p as usize, surface.normal);
        let mut gap = surface.gap(state.now[p]);
        if gap >= S::ZERO && self.pressed == S::ZERO {
            return;
        }
        if !self.is_met {
            self.is_met = true;
            self.approach = dot(state.begun[p], normal);
            let depth = (-surface.gap(state.start[p])).max(S::ZERO);
            if depth > S::ZERO {
                let shift = scale(normal, depth);
                state.start[p] = add(state.start[p], shift);
                state.now[p] = add(state.now[p], shift);
                state.gone[p] += depth;
                gap += depth;
            }
        }
        let before = self.pressed;
        self.pressed = (before - gap).max(S::ZERO);
        let push = self.pressed - before;
        let d = state.way[p];
        let along = sub(d, scale(normal, dot(normal, d)));
        let slide = dot(along, along).sqrt();
        let out = scale(normal, push);
        let mut aside = zero();
        // What is still to be rubbed of what pressed so far.
        self.slips = slide > surface.friction * self.pressed - self.rubbed;
        let most = (surface.friction * self.pressed - self.rubbed).max(S::ZERO).min(slide);
        if most > S::ZERO {
            self.rubbed += most;
            aside = scale(along, -most / slide);
        }
        let shift = add(out, aside);
        if let Some(tally) = &mut state.tally {
            tally.push(p, surface.restitution, (out, aside));
        }
        state.now[p] = add(state.now[p], shift);
        state.way[p] = add(state.way[p], shift);
    }

    /// Gives the velocity that restitution asks for, where the point came faster than `least` [m/s]. Returns whether that
    /// lacked.
    pub(super) fn bounce(&self, state: &mut Cluster<S>, surface: &Surface<S, 2>, least: S) -> bool {
        if surface.restitution == S::ZERO || self.pressed == S::ZERO || self.approach > -least {
            return false;
        }
        let p = self.p as usize;
        let target = -surface.restitution * self.approach;
        let lacking = target - dot(state.velocity[p], surface.normal);
        if lacking > S::ZERO {
            state.velocity[p] = add(state.velocity[p], scale(surface.normal, lacking));
        }
        lacking > target * S::from_f64(BOUNCED)
    }
}
