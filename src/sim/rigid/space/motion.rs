//! How a rigid body moves in space.

use super::place::Place;
use crate::sim::vector::{add, cross3};

/// How fast a body goes `[m/s]` and spins `[rad/s]`, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Twist {
    pub(super) velocity: [f64; 3],
    pub(super) spin: [f64; 3],
}

impl Twist {
    /// It stands still.
    pub(super) const STILL: Self = Twist { velocity: [0.0; 3], spin: [0.0; 3] };

    /// The velocity of what is at `arm` from the origin.
    #[inline(always)]
    pub(super) fn at(&self, arm: [f64; 3]) -> [f64; 3] {
        add(self.velocity, cross3(self.spin, arm))
    }
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) place: Place,
    pub(super) twist: Twist,
}

impl Motion {
    pub(super) fn is_finite(&self) -> bool {
        let Motion { place: Place { middle, axes }, twist: Twist { velocity, spin } } = self;
        middle.iter().chain(axes.iter().flatten()).chain(velocity).chain(spin).all(|x| x.is_finite())
    }
}
