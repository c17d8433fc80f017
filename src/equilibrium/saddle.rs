//! Shapes that balance without being minima: a box on its corner, a chain that stands on its pin.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg32;

use super::descent::Descent;
use super::part::extent;
use super::system::NEUTRAL;
use crate::sim::vector::{add, length, scale};

/// Times that a shape is pushed off a saddle.
const MOST_PUSHES: u32 = 20;
/// How far its fastest point is pushed, as a share of its extent.
const PUSH: f64 = 1e-3;
/// Rounds of inverse iteration: more than one direction may fall away, and each should have its share.
const ITERATIONS: u32 = 4;

impl<const D: usize> Descent<D> {
    /// Goes on from a place where forces balance under a shift: without it if it was not needed, else along the direction
    /// that falls away.
    pub(super) fn leave_saddle(&mut self) {
        self.shift = 0.0;
        self.factor();
        if self.shift <= NEUTRAL * self.scale {
            return;
        }
        if self.pushes == MOST_PUSHES {
            self.give_up();
            return;
        }
        self.pushes += 1;
        let direction = self.falling_away();
        let to = |sign: f64| -> Vec<[f64; D]> {
            let size = sign * PUSH * extent(&self.x);
            self.x.iter().zip(&direction).map(|(&x, &direction)| add(x, scale(direction, size))).collect()
        };
        let (one, other) = (to(1.0), to(-1.0));
        self.x = if self.merit(&one) <= self.merit(&other) { one } else { other };
    }

    /// The direction of least curvature, its longest arrow 1: by inverse iteration from one that is the same every time.
    fn falling_away(&mut self) -> Vec<[f64; D]> {
        let mut generator = Pcg32::seed_from_u64(1);
        let mut draw = || f64::from(generator.next_u32()) / f64::from(u32::MAX) - 0.5;
        let mut direction: Vec<[f64; D]> = self.x.iter().map(|_| std::array::from_fn(|_| draw())).collect();
        for _ in 0..ITERATIONS {
            direction = self.solve(direction);
            let size = direction.iter().map(|&v| length(v)).fold(f64::MIN_POSITIVE, f64::max);
            direction.iter_mut().for_each(|v| *v = scale(*v, 1.0 / size));
        }
        direction
    }
}
