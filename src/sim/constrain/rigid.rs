//! Rigid bonds, held to a tolerance by sweeps along the direction that they had at the start of the substep.
//!
//! Projecting along the old direction (SHAKE) keeps Verlet's method second order; along the new one it is first order
//! and loses energy. Source: J.-P. Ryckaert, G. Ciccotti, H. J. C. Berendsen, J. Comput. Phys. 23, 327 (1977).

use super::order::Sweeper;
use super::relaxed::RelaxedBond;
use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Sweeps after which a substep goes on with what it has. A rope of 50 links takes a few thousand; a contradictory set
/// of lengths never converges and must not hang the program.
pub(crate) const MOST_SWEEPS: u32 = 4000;

/// |length^2/rest^2 - 1| / 2 at which a bond counts as held: about 1e-10 in `f64`, 1e-6 in `f32`. Smaller is lost in
/// rounding and never ends; larger shows as energy that drifts.
fn tolerance<S: Real>() -> S {
    S::from_f64(1e-10).max(S::EPSILON * S::from_f64(8.0))
}

/// A bond that turns by more than about 75 degrees in a substep has no use for its old direction: cos 75.
const LEAST_COSINE: f64 = 0.26;

/// A rigid bond as the kernel reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidBond<S> {
    along_new: RelaxedBond<S>,
    rest_length: S,
    w_a: S,
    w_b: S,
    limit: Limit,
}

impl<S: Real> RigidBond<S> {
    /// The bond, if it is rigid and has an end that can move.
    pub(crate) fn of(bond: &Bond, inverse_mass: &[S]) -> Option<Self> {
        if bond.kind != BondKind::Rigid {
            return None;
        }
        Some(RigidBond {
            along_new: RelaxedBond::of(bond, inverse_mass)?,
            rest_length: S::from_f64(bond.rest_length),
            w_a: inverse_mass[bond.a.index()],
            w_b: inverse_mass[bond.b.index()],
            limit: bond.limit,
        })
    }

    pub(crate) fn ends(&self) -> [u32; 2] {
        self.along_new.ends()
    }

    /// Whether the bond acts at this square of its length.
    #[inline(always)]
    fn acts(&self, square: S) -> bool {
        let rest = self.rest_length * self.rest_length;
        match self.limit {
            Limit::Both => true,
            Limit::Max => square > rest,
            Limit::Min => square < rest,
        }
    }

    /// How far off the length is: (|d|^2 - rest^2) / (2 rest^2), or |d|^2 in m^2 at rest length 0; 0 where it doesn't act.
    #[inline(always)]
    fn error(&self, square: S) -> S {
        if !self.acts(square) {
            return S::ZERO;
        }
        let rest = self.rest_length * self.rest_length;
        if rest == S::ZERO { square } else { ((square - rest) / (rest + rest)).abs() }
    }

    /// Moves the ends along the old direction, or along the new one where the old won't do. Returns the error before.
    #[inline(always)]
    fn project<const D: usize>(&self, position: &[[S; D]], displacement: &mut [[S; D]]) -> S {
        let [a, b] = self.ends().map(|end| end as usize);
        let old = sub(position[a], position[b]);
        let new = add(old, sub(displacement[a], displacement[b]));
        let square = dot(new, new);
        let error = self.error(square);
        if error <= tolerance::<S>() {
            return error;
        }
        let along = dot(new, old);
        let rest = self.rest_length * self.rest_length;
        if along * along < S::from_f64(LEAST_COSINE * LEAST_COSINE) * square * dot(old, old)
            || along <= S::ZERO
            || rest == S::ZERO
        {
            self.along_new.project(position, displacement);
            return error;
        }
        let g = (square - rest) / ((along + along) * (self.w_a + self.w_b));
        displacement[a] = sub(displacement[a], scale(old, g * self.w_a));
        displacement[b] = add(displacement[b], scale(old, g * self.w_b));
        error
    }
}

/// What became of holding bonds.
pub(crate) struct Held {
    /// Sweeps taken.
    pub(crate) sweeps: u32,
    /// Whether all lengths are right to 1e-6, in `f32` to 1e-5: bonds that repeat each other stop short of the tolerance.
    pub(crate) is_held: bool,
}

/// Sweeps over `bonds` until all of them hold.
pub(crate) fn hold<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    bonds: &[RigidBond<S>],
    sweeper: &mut Sweeper,
) -> Held {
    let Points { position, displacement, .. } = points;
    let mut largest = S::ZERO;
    for sweeps in 1..=MOST_SWEEPS {
        largest = S::ZERO;
        sweeper.sweep_to_and_fro(bonds, |bond| largest = largest.max(bond.project(position, displacement)));
        if largest <= tolerance::<S>() {
            return Held { sweeps, is_held: true };
        }
    }
    let enough = S::from_f64(1e-6).max(S::EPSILON * S::from_f64(100.0));
    Held { sweeps: MOST_SWEEPS, is_held: largest <= enough }
}

/// Takes from the velocities what would lengthen or shorten a bond: (v_a - v_b).d = 0, by sweeps weighted by mass.
pub(crate) fn hold_velocity<S: Real, const D: usize>(points: &mut Points<S, D>, bonds: &[RigidBond<S>]) {
    let Points { position, velocity, .. } = points;
    for _ in 0..MOST_SWEEPS {
        let mut largest = S::ZERO;
        for bond in bonds {
            let [a, b] = bond.ends().map(|end| end as usize);
            let d = sub(position[a], position[b]);
            let square = dot(d, d);
            // A bond with a limit is free inside it: only a taut one holds velocities, and only one way.
            let rate = dot(sub(velocity[a], velocity[b]), d);
            let parting = rate > S::ZERO;
            let held = match bond.limit {
                Limit::Both => true,
                Limit::Max => parting && bond.is_at_rest_length(square),
                Limit::Min => !parting && bond.is_at_rest_length(square),
            };
            if square == S::ZERO || !held {
                continue;
            }
            let g = rate / (square * (bond.w_a + bond.w_b));
            velocity[a] = sub(velocity[a], scale(d, g * bond.w_a));
            velocity[b] = add(velocity[b], scale(d, g * bond.w_b));
            largest = largest.max((g * (bond.w_a + bond.w_b)).abs());
        }
        if largest <= tolerance::<S>() {
            return;
        }
    }
}

impl<S: Real> RigidBond<S> {
    fn is_at_rest_length(&self, square: S) -> bool {
        let rest = self.rest_length * self.rest_length;
        ((square - rest) / (rest + S::EPSILON)).abs() <= S::from_f64(1e-6)
    }
}
