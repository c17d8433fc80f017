//! What begins in an obstacle, in another body or in itself is led out slowly: put out at once its bonds would throw it about.

use super::cluster::{Cluster, Common};
use super::pair::beside;
use super::rest::Lies;
use crate::sim::real::Real;

impl<S: Real> Cluster<S> {
    /// Whether all of a body is pinned: until it is not, nobody knows how it lies.
    pub(super) fn stands(&self, k: usize) -> bool {
        self.w[self.bases[k] as usize..self.bases[k + 1] as usize].iter().all(|&w| w == S::ZERO)
    }

    /// Looks which bodies that nobody looked at yet lie in something, deeper than a substep leads them out.
    pub(super) fn see_within(&mut self, common: &Common<S>) {
        if self.lies.iter().all(|&lies| lies == Lies::Clear) {
            return;
        }
        let mut is_in: Vec<bool> = self.lies.iter().map(|&lies| lies == Lies::Within).collect();
        let least = self.span * S::from_f64(super::substep::GENTLE);
        for couple in &self.tangle.couples {
            couple.bodies.into_iter().for_each(|body| is_in[body as usize] = true);
        }
        let own = self.own();
        for pair in self.pairs.iter().filter(|pair| pair.side != S::ZERO) {
            let places = [pair.p, pair.a, pair.b].map(|i| self.now[i as usize]);
            let overlap = beside(places, pair.side).map_or(S::ZERO, |found| pair.distance - found.gap);
            if overlap > least {
                for i in [pair.p, pair.a].map(|i| i as usize).into_iter().filter(|&i| i < own) {
                    is_in[self.body_of[i] as usize] = true;
                }
            }
        }
        for on in &self.on_planes {
            if on.depth(common, self.now[on.p as usize]) > least {
                is_in[self.body_of[on.p as usize] as usize] = true;
            }
        }
        for (lies, is_in) in self.lies.iter_mut().zip(is_in).filter(|(lies, _)| **lies == Lies::Anyhow) {
            *lies = if is_in { Lies::Within } else { Lies::Clear };
        }
    }

    /// How far the ends of an edge, or a point twice, are led out of an obstacle that they lie in so deep, in a substep `[m]`; `out` is the unit
    /// vector that way.
    #[inline(always)]
    pub(super) fn led_out(&mut self, ends: [usize; 2], out: [S; 2], depth: S) -> S {
        let most = if self.note_within(ends[0], depth) { self.gentle } else { depth };
        if self.is_tethered(ends[0]) {
            return self.yields(ends[0], out, most).min(self.yields(ends[1], out, most));
        }
        most
    }

    /// Whether a point that lies in something so deep `[m]` is of a body that began there, or that joints may hold there, and will still lie there
    /// after this substep.
    #[inline(always)]
    pub(super) fn note_within(&mut self, i: usize, depth: S) -> bool {
        let body = self.body_of[i] as usize;
        let is_held = || self.lies.get(body) == Some(&Lies::Within) || self.is_in_joints(body);
        let is_within = depth > self.gentle && is_held();
        if is_within {
            self.sunk[body] = true;
        }
        is_within
    }

    /// What is parted as a whole lies in another one too.
    pub(super) fn note_couples(&mut self) {
        let parted = self.tangle.couples.iter().filter(|couple| couple.is_led()).flat_map(|couple| couple.bodies);
        for body in parted.map(|body| body as usize) {
            self.sunk[body] |= self.lies[body] == Lies::Within;
        }
    }
}
