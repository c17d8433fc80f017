//! Velocities that bodies may take.

use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub};

/// How many times as far from the middle of the velocities of what strikes each other one of them may get, beside what it gets faster by itself:
/// what is light comes back from what is heavy as fast as it came.
const THROWN: f64 = 2.4;

/// Velocities about a middle, so far from it at most along an axis `[m/s]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Velocities<S, const D: usize> {
    pub(super) middle: [S; D],
    pub(super) around: S,
}

impl<S: Real, const D: usize> Velocities<S, D> {
    /// Whether all others are among these.
    pub(super) fn contain(self, other: Self) -> bool {
        let (room, way) = (self.around - other.around, sub(other.middle, self.middle));
        room >= S::ZERO && dot(way, way) <= room * room
    }

    /// The least that both are among.
    pub(super) fn with(self, other: Self) -> Self {
        if self.contain(other) {
            return self;
        }
        if other.contain(self) {
            return other;
        }
        let way = sub(other.middle, self.middle);
        let far = length(way);
        let around = S::HALF * (far + self.around + other.around);
        Velocities { middle: add(self.middle, scale(way, (around - self.around) / far)), around }
    }

    /// What those that have them may throw each other to.
    pub(super) fn thrown(self) -> Self {
        Velocities { around: self.around * S::from_f64(THROWN), ..self }
    }

    /// What something that stays may throw them back to.
    pub(super) fn held(self) -> Self {
        Velocities { middle: [S::ZERO; D], around: self.most() }
    }

    /// The largest speed along an axis.
    pub(super) fn most(self) -> S {
        self.middle.into_iter().fold(S::ZERO, |most, v| most.max(v.abs())) + self.around
    }

    /// How far beyond these others go along an axis.
    pub(super) fn lack(self, other: Self) -> S {
        (0..D).fold(S::ZERO, |most, k| most.max((other.middle[k] - self.middle[k]).abs())) + other.around - self.around
    }

    pub(super) fn widen(self) -> Velocities<f64, D> {
        Velocities { middle: self.middle.map(Real::to_f64), around: self.around.to_f64() }
    }
}
