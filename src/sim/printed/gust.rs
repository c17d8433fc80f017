//! 001's wind: in each frame one point of all that are moved together, as those of a cloth are, is pushed by a force; both are drawn by lot.
//!
//! Model: in a frame of h `[s]` the point gets faster by u U along each axis, u from 0 to 1 and U the wind's velocity `[m/s]`; the text says
//! nothing of its size. Fault: it is one point a frame, whatever its cloth has: of four times as many points each feels a quarter.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use crate::sim::force::wind::Wind;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert};

#[derive(Clone, Copy, Debug)]
pub(super) struct Gust<const D: usize> {
    /// The most that a point gets faster `[m/s]`.
    most: [f64; D],
    seed: u64,
}

impl<const D: usize> Gust<D> {
    pub(super) fn of(wind: &Wind<D>) -> Self {
        Gust { most: wind.velocity, seed: wind.seed }
    }

    /// Pushes one of the points in the frame that begins at `t` `[s]`: the same at the same time, wherever a run began.
    pub(super) fn push<S: Real>(&self, push: &mut [[S; D]], (t, h): (f64, f64)) {
        if push.is_empty() {
            return;
        }
        let mut lot = Pcg32::seed_from_u64(self.seed ^ t.to_bits());
        let shares: [f64; D] = std::array::from_fn(|_| lot.random());
        let point = lot.random_range(0..push.len() as u32) as usize;
        let more = std::array::from_fn(|k| shares[k] * self.most[k] / h);
        push[point] = add(push[point], convert(more));
    }
}
