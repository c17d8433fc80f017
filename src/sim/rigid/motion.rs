//! Where a rigid body is and how it moves.

use super::place::Place;
use crate::sim::vector::{add, scale};

/// How fast a body goes `[m/s]` and spins `[rad/s]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twist {
    pub(crate) velocity: [f64; 2],
    pub(crate) spin: f64,
}

impl Twist {
    /// It stands still.
    pub(crate) const STILL: Self = Twist { velocity: [0.0; 2], spin: 0.0 };

    /// The velocity of what is at `arm` from the origin.
    #[inline(always)]
    pub(crate) fn at(&self, arm: [f64; 2]) -> [f64; 2] {
        add(self.velocity, scale([-arm[1], arm[0]], self.spin))
    }
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) place: Place,
    pub(crate) twist: Twist,
}

impl Motion {
    pub(super) fn is_finite(&self) -> bool {
        let Motion { place: Place { middle, turn, .. }, twist: Twist { velocity, spin } } = self;
        middle.iter().chain(turn).chain(velocity).chain([spin]).all(|x| x.is_finite())
    }
}
