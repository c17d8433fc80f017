//! Relaxed bonds: every sweep moves the ends by a share of the error, along the bond's present direction.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// A relaxed bond as the kernel reads it.
///
/// Model: d = x_a - x_b, c = relaxation (rest/|d| - 1) held to [least, most]; x_a += c share_a d,
/// x_b -= c (1 - share_a) d, where share_a = w_a/(w_a + w_b). Zero length has no direction: nothing happens.
/// A bond that acts on one side of its rest length only has 0 as one of the two limits.
/// First order in time although Verlet's method is second: the direction is the one at the end of the substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelaxedBond<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    rest_length: S,
    relaxation: S,
    least: S,
    most: S,
    share_a: S,
}

impl<S: Real> RelaxedBond<S> {
    /// The bond as the relaxation method takes it: a rigid one is relaxed with relaxation 1.
    ///
    /// `None` for springs, and where both ends are pinned.
    pub(crate) fn of(bond: &Bond, inverse_mass: &[S]) -> Option<Self> {
        let (relaxation, limit) = match bond.kind {
            BondKind::Relaxed { relaxation, max_correction } => (relaxation, max_correction),
            BondKind::Rigid => (1.0, f64::INFINITY),
            BondKind::Spring { .. } => return None,
        };
        let (w_a, w_b) = (inverse_mass[bond.a.index()], inverse_mass[bond.b.index()]);
        if w_a + w_b == S::ZERO {
            return None;
        }
        Some(RelaxedBond {
            a: bond.a.0,
            b: bond.b.0,
            rest_length: S::from_f64(bond.rest_length),
            relaxation: S::from_f64(relaxation),
            least: S::from_f64(if bond.limit == Limit::Min { 0.0 } else { -limit }),
            most: S::from_f64(if bond.limit == Limit::Max { 0.0 } else { limit }),
            share_a: w_a / (w_a + w_b),
        })
    }

    pub(crate) fn ends(&self) -> [u32; 2] {
        [self.a, self.b]
    }

    /// Moves the ends by `share` of the correction: adds to their displacements.
    #[inline(always)]
    pub(crate) fn project<const D: usize>(&self, position: &[[S; D]], displacement: &mut [[S; D]], share: S) {
        let (a, b) = (self.a as usize, self.b as usize);
        let d = add(sub(position[a], position[b]), sub(displacement[a], displacement[b]));
        let square = dot(d, d);
        if square == S::ZERO {
            return;
        }
        let correction = self.relaxation * (self.rest_length / square.sqrt() - S::ONE);
        let correction = correction.max(self.least).min(self.most) * share;
        displacement[a] = add(displacement[a], scale(d, correction * self.share_a));
        displacement[b] = sub(displacement[b], scale(d, correction * (S::ONE - self.share_a)));
    }
}

/// Share of a correction in a substep of `h` where the scene says `nominal` `[s]`: (2 h/nominal)^2, at most 1.
///
/// A correction acts like a force times h^2. A substep cut short by a knot or a sample, with the whole correction in
/// it, would be a blow: the shorter, the harder. Cutting a stretch into equal substeps leaves more than half of each:
/// there the algorithm is kept to the letter.
pub(crate) fn share_of<S: Real>(h: f64, nominal: f64) -> S {
    let ratio = 2.0 * h / nominal;
    S::from_f64((ratio * ratio).min(1.0))
}

/// Sweeps once over `bonds` as `sweeper` orders them, with this share of every correction.
pub(crate) fn sweep<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    bonds: &[RelaxedBond<S>],
    sweeper: &mut super::order::Sweeper,
    share: S,
) {
    let Points { position, displacement, .. } = points;
    sweeper.sweep(bonds, |bond| bond.project(position, displacement, share));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bond::PointId;

    fn projected(kind: BondKind, limit: Limit, length: f64, w: [f64; 2]) -> [f64; 2] {
        let bond = Bond { kind, limit, ..Bond::new(PointId(0), PointId(1), 1.0) };
        let mut displacement = [[0.0, 0.0], [0.0, 0.0]];
        if let Some(bond) = RelaxedBond::of(&bond, &w) {
            bond.project(&[[length, 0.0], [0.0, 0.0]], &mut displacement, 1.0);
        }
        [displacement[0][0], displacement[1][0]]
    }

    const RELAXED: BondKind = BondKind::Relaxed { relaxation: 1.0, max_correction: 0.1 };

    #[test]
    fn one_bond_by_hand() {
        assert_eq!(projected(BondKind::Rigid, Limit::Both, 2.0, [1.0, 1.0]), [-0.5, 0.5]);
        assert_eq!(projected(BondKind::Rigid, Limit::Both, 0.5, [1.0, 1.0]), [0.25, -0.25]);
        let half = BondKind::Relaxed { relaxation: 0.5, max_correction: f64::INFINITY };
        assert_eq!(projected(half, Limit::Both, 2.0, [1.0, 1.0]), [-0.25, 0.25]);
    }

    #[test]
    fn a_correction_is_limited_both_ways() {
        assert_eq!(projected(RELAXED, Limit::Both, 2.0, [1.0, 1.0]), [-0.1, 0.1]);
        assert_eq!(projected(RELAXED, Limit::Both, 0.5, [1.0, 1.0]), [0.025, -0.025]);
    }

    #[test]
    fn a_pinned_end_leaves_all_of_it_to_the_other() {
        assert_eq!(projected(BondKind::Rigid, Limit::Both, 2.0, [1.0, 0.0]), [-1.0, 0.0]);
        assert_eq!(projected(BondKind::Rigid, Limit::Both, 2.0, [0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(projected(BondKind::Rigid, Limit::Both, 2.0, [3.0, 1.0]), [-0.75, 0.25]);
    }

    #[test]
    fn a_limit_acts_on_one_side() {
        assert_eq!(projected(BondKind::Rigid, Limit::Max, 0.5, [1.0, 1.0]), [0.0, 0.0]);
        assert_eq!(projected(BondKind::Rigid, Limit::Max, 2.0, [1.0, 1.0]), [-0.5, 0.5]);
        assert_eq!(projected(BondKind::Rigid, Limit::Min, 2.0, [1.0, 1.0]), [0.0, 0.0]);
    }

    #[test]
    fn zero_length_does_nothing() {
        assert_eq!(projected(BondKind::Rigid, Limit::Both, 0.0, [1.0, 1.0]), [0.0, 0.0]);
    }
}
