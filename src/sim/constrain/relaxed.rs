//! Relaxed bonds: every sweep moves the ends by a share of the error, along the bond's present direction.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, widen};

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

    /// The pin that one end is, and the other end.
    fn pinned(&self) -> Option<[usize; 2]> {
        let [a, b] = [self.a as usize, self.b as usize];
        match self.share_a {
            share if share == S::ZERO => Some([a, b]),
            share if share == S::ONE => Some([b, a]),
            _ => None,
        }
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

/// The same, with what pins that are led do in a substep of `h` `[s]`: the impulses of corrections at their other ends times their velocities
/// `[J]`.
pub(crate) fn sweep_counting<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    bonds: &[RelaxedBond<S>],
    sweeper: &mut super::order::Sweeper,
    (share, h): (S, f64),
) -> f64 {
    let Points { position, displacement, velocity, inverse_mass, .. } = points;
    let mut done = 0.0;
    sweeper.sweep(bonds, |bond| {
        let pinned = bond.pinned().map(|[pin, free]| (pin, free, displacement[free]));
        bond.project(position, displacement, share);
        if let Some((pin, free, before)) = pinned {
            let correction: [f64; D] = widen(sub(displacement[free], before));
            done += dot(correction, widen(velocity[pin])) / (h * inverse_mass[free].to_f64());
        }
    });
    done
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
    fn a_pin_that_is_led_does_the_work_of_what_it_draws() {
        let bond = Bond::new(PointId(0), PointId(1), 1.0);
        let state = |lead: f64| crate::sim::points::State::<f64, 2> {
            position: vec![[0.0, 0.0], [1.0, 0.0]],
            velocity: vec![[lead, 0.0], [0.0, 0.0]],
            ..Default::default()
        };
        // Led by 0.2 m in 0.1 s, it draws 3 kg as far: an impulse of 6 N s at 2 m/s.
        let mut points = Points::new(state(2.0), vec![0.0, 1.0 / 3.0]);
        points.displacement = vec![[0.2, 0.0], [0.0, 0.0]];
        let mut bonds: Vec<_> = RelaxedBond::of(&bond, &points.inverse_mass).into_iter().collect();
        let mut sweeper =
            super::super::order::Sweeper::new(crate::sim::solver::Order::Fixed, 2, &mut bonds, RelaxedBond::ends, 1);
        let done = sweep_counting(&mut points, &bonds, &mut sweeper, (1.0, 0.1));
        assert!((done - 12.0).abs() < 1e-12 && (points.displacement[1][0] - 0.2).abs() < 1e-12, "{done}");
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
