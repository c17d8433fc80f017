//! Compliant projection: every bond is solved for its multiplier, one after the other, in small steps.
//!
//! Model: C = |d| - rest, alpha = compliance/h^2; change of lambda = -(C + alpha lambda)/(w_a + w_b + alpha) along d/|d|.
//! A damper c enters as beta = c compliance/h times the change of C in the substep. Compliance 0 is a rigid bond.
//! First order; stable at any substep, but a body is softer than its bonds until sweeps converge.
//! Source: M. Macklin, M. Mueller, N. Chentanez, XPBD, Motion in Games 2016, eq. (18) and (26).

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// A bond as the kernel reads it, with its multiplier.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CompliantBond<S> {
    a: u32,
    b: u32,
    w_a: S,
    w_b: S,
    rest_length: S,
    /// `[m/N]`; 0 is rigid.
    compliance: S,
    /// `[N s/m]`.
    damping: S,
    limit: Limit,
    lambda: S,
}

impl<S: Real> CompliantBond<S> {
    /// The bond, if it is rigid or a spring that pulls, and has an end that can move.
    pub(crate) fn of(bond: &Bond, w: &[S]) -> Option<Self> {
        let (compliance, damping) = match bond.kind {
            BondKind::Rigid => (0.0, 0.0),
            BondKind::Spring { stiffness, damping } if stiffness > 0.0 => (1.0 / stiffness, damping),
            _ => return None,
        };
        let (w_a, w_b) = (w[bond.a.index()], w[bond.b.index()]);
        (w_a + w_b > S::ZERO).then(|| CompliantBond {
            a: bond.a.0,
            b: bond.b.0,
            w_a,
            w_b,
            rest_length: S::from_f64(bond.rest_length),
            compliance: S::from_f64(compliance),
            damping: S::from_f64(damping),
            limit: bond.limit,
            lambda: S::ZERO,
        })
    }

    pub(crate) fn ends(&self) -> [u32; 2] {
        [self.a, self.b]
    }

    /// Moves the ends by their displacements in a substep of `h` `[s]`.
    #[inline(always)]
    fn project<const D: usize>(&mut self, position: &[[S; D]], displacement: &mut [[S; D]], h: S) {
        let (a, b) = (self.a as usize, self.b as usize);
        let change = sub(displacement[a], displacement[b]);
        let d = add(sub(position[a], position[b]), change);
        let length = dot(d, d).sqrt();
        if length == S::ZERO {
            return;
        }
        let n = scale(d, S::ONE / length);
        let stretch = length - self.rest_length;
        let alpha = self.compliance / (h * h);
        let gamma = self.compliance * self.damping / h;
        let top = stretch + alpha * self.lambda + gamma * dot(n, change);
        let mut step = -top / ((S::ONE + gamma) * (self.w_a + self.w_b) + alpha);
        match self.limit {
            Limit::Both => {}
            Limit::Max => step = (self.lambda + step).min(S::ZERO) - self.lambda,
            Limit::Min => step = (self.lambda + step).max(S::ZERO) - self.lambda,
        }
        self.lambda += step;
        displacement[a] = add(displacement[a], scale(n, step * self.w_a));
        displacement[b] = sub(displacement[b], scale(n, step * self.w_b));
    }
}

/// Solves `bonds` by `sweeps` over them, to and fro.
pub(crate) fn solve<S: Real, const D: usize>(
    bonds: &mut [CompliantBond<S>],
    position: &[[S; D]],
    displacement: &mut [[S; D]],
    h: f64,
    sweeps: u32,
) {
    let h = S::from_f64(h);
    for bond in bonds.iter_mut() {
        bond.lambda = S::ZERO;
    }
    for sweep in 0..sweeps {
        if sweep % 2 == 0 {
            bonds.iter_mut().for_each(|bond| bond.project(position, displacement, h));
        } else {
            bonds.iter_mut().rev().for_each(|bond| bond.project(position, displacement, h));
        }
    }
}
