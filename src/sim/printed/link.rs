//! A bond as the sources have it: each end is given half of a correction, whatever it weighs and whether the other end can move.

use super::State;
use crate::sim::bond::{Bond, BondKind};
use crate::sim::constrain::order::Sweeper;
use crate::sim::real::Real;
use crate::sim::vector::{add, length, scale, sub};

/// Bonds with the order that they are swept in, and how often.
pub(super) type Sweep<'a, S> = (&'a [Link<S>], &'a mut Sweeper, u32);

/// A bond between two points of a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link<S> {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) rest: S,
    /// k, or the stiffness of a spring.
    pub(super) stiffness: S,
    pub(super) damping: S,
    /// The one-sided bound on a correction `[1]`.
    pub(super) most: S,
}

impl<S: Real> Link<S> {
    pub(super) fn of(bond: &Bond) -> Self {
        let (stiffness, damping, most) = match bond.kind {
            BondKind::Rigid => (1.0, 0.0, f64::INFINITY),
            BondKind::Relaxed { relaxation, max_correction } => (relaxation, 0.0, max_correction),
            BondKind::Spring { stiffness, damping } => (stiffness, damping, 0.0),
        };
        Link {
            a: bond.a.0,
            b: bond.b.0,
            rest: S::from_f64(bond.rest_length),
            stiffness: S::from_f64(stiffness),
            damping: S::from_f64(damping),
            most: S::from_f64(most),
        }
    }

    pub(super) fn ends(&self) -> [u32; 2] {
        [self.a, self.b]
    }

    /// From b to a `[m]`, and how long that is `[m]`.
    pub(super) fn span<const D: usize>(&self, x: &[[S; D]]) -> ([S; D], S) {
        let d = sub(x[self.a as usize], x[self.b as usize]);
        (d, length(d))
    }
}

impl<S: Real, const D: usize> State<'_, S, D> {
    /// The ends of a bond go apart by this correction of d = x_a - x_b `[m]`: half of it each, the locked one not at all.
    pub(super) fn part(&mut self, link: &Link<S>, correction: [S; D]) {
        let half = scale(correction, S::HALF);
        let [a, b] = link.ends().map(|end| end as usize);
        if self.is_free(a) {
            self.x[a] = add(self.x[a], half);
        }
        if self.is_free(b) {
            self.x[b] = sub(self.x[b], half);
        }
    }
}
