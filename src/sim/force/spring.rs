//! Springs with a damper along the bond, as forces.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// A spring as the kernel reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) rest_length: S,
    pub(crate) stiffness: S,
    pub(crate) damping: S,
    pub(crate) limit: Limit,
}

impl<S: Real> Spring<S> {
    /// The spring that a bond is, if it is one.
    pub(crate) fn of(bond: &Bond) -> Option<Self> {
        let BondKind::Spring { stiffness, damping } = bond.kind else { return None };
        Some(Spring {
            a: bond.a.0,
            b: bond.b.0,
            rest_length: S::from_f64(bond.rest_length),
            stiffness: S::from_f64(stiffness),
            damping: S::from_f64(damping),
            limit: bond.limit,
        })
    }

    /// The spring as it is while it acts, whatever its length, or while it does not: where events decide that.
    pub(crate) fn held(self, acts: bool) -> Self {
        let share = if acts { S::ONE } else { S::ZERO };
        Spring { stiffness: share * self.stiffness, damping: share * self.damping, limit: Limit::Both, ..self }
    }

    pub(crate) fn is_damped(&self) -> bool {
        self.damping > S::ZERO
    }
}

/// Adds the acceleration by every spring to `a`.
///
/// Model: d = x_a - x_b, f_a = -stiffness (|d| - rest) d/|d| - damping ((v_a - v_b).d) d/|d|^2, f_b = -f_a.
/// At rest length 0 the force is linear: f_a = -stiffness d - damping (v_a - v_b). Coincident ends of a spring with a
/// rest length have no direction: no force.
/// Shapes: `x`, `v`, `w` and `a` have one entry a point.
pub(crate) fn pull<S: Real, const D: usize>(
    springs: &[Spring<S>],
    is_damped: bool,
    x: &[[S; D]],
    v: &[[S; D]],
    w: &[S],
    a: &mut [[S; D]],
) {
    if is_damped {
        pull_each::<S, D, true>(springs, x, v, w, a);
    } else {
        pull_each::<S, D, false>(springs, x, v, w, a);
    }
}

fn pull_each<S: Real, const D: usize, const DAMPED: bool>(
    springs: &[Spring<S>],
    x: &[[S; D]],
    v: &[[S; D]],
    w: &[S],
    a: &mut [[S; D]],
) {
    for spring in springs {
        let (i, j) = (spring.a as usize, spring.b as usize);
        let force = spring.force::<D, DAMPED>(sub(x[i], x[j]), || sub(v[i], v[j]));
        a[i] = add(a[i], scale(force, w[i]));
        a[j] = sub(a[j], scale(force, w[j]));
    }
}

impl<S: Real> Spring<S> {
    /// The force on end a [N].
    #[inline(always)]
    fn force<const D: usize, const DAMPED: bool>(&self, d: [S; D], closing: impl Fn() -> [S; D]) -> [S; D] {
        if self.rest_length == S::ZERO {
            if self.limit == Limit::Min {
                return [S::ZERO; D];
            }
            let pull = scale(d, -self.stiffness);
            return if DAMPED { sub(pull, scale(closing(), self.damping)) } else { pull };
        }
        let square = dot(d, d);
        let length = square.sqrt();
        if self.is_slack(length) || square == S::ZERO {
            return [S::ZERO; D];
        }
        let mut share = self.stiffness * (self.rest_length / length - S::ONE);
        if DAMPED {
            share -= self.damping * dot(closing(), d) / square;
        }
        scale(d, share)
    }

    /// Minus the derivative of the force on end a: K + rate C [N/m], by d and (times `rate` [1/s]) by velocity.
    ///
    /// K = stiffness (n n^T + (1 - rest/|d|) (1 - n n^T)), C = damping n n^T, n = d/|d|. `is_cautious`: the second part
    /// of K is left out where it is below 0.
    pub(crate) fn stiffness_block<const D: usize>(&self, d: [S; D], rate: S, is_cautious: bool) -> [[S; D]; D] {
        let mut block = [[S::ZERO; D]; D];
        let square = dot(d, d);
        let length = square.sqrt();
        let (along, across) = if self.rest_length == S::ZERO {
            let all = if self.limit == Limit::Min { S::ZERO } else { self.stiffness + rate * self.damping };
            (S::ZERO, all)
        } else if square == S::ZERO || self.is_slack(length) {
            return block;
        } else {
            let tension = self.stiffness * (S::ONE - self.rest_length / length);
            let across = if is_cautious { tension.max(S::ZERO) } else { tension };
            (self.stiffness + rate * self.damping - across, across)
        };
        for r in 0..D {
            for c in 0..D {
                if square > S::ZERO {
                    block[r][c] = along * d[r] * d[c] / square;
                }
            }
            block[r][r] += across;
        }
        block
    }

    /// Whether a spring with a limit lets go at this length.
    #[inline(always)]
    pub(crate) fn is_slack(&self, length: S) -> bool {
        match self.limit {
            Limit::Both => false,
            Limit::Max => length <= self.rest_length,
            Limit::Min => length >= self.rest_length,
        }
    }
}

/// Energy of every spring [J]: stiffness (|d| - rest)^2 / 2 where it acts.
pub(crate) fn energy<const D: usize>(bonds: &[Bond], position: impl Fn(usize) -> [f64; D]) -> f64 {
    let of = |bond: &Bond| {
        let BondKind::Spring { stiffness, .. } = bond.kind else { return 0.0 };
        let d = sub(position(bond.a.index()), position(bond.b.index()));
        let stretch = dot(d, d).sqrt() - bond.rest_length;
        match bond.limit {
            Limit::Max if stretch < 0.0 => 0.0,
            Limit::Min if stretch > 0.0 => 0.0,
            _ => 0.5 * stiffness * stretch * stretch,
        }
    };
    bonds.iter().map(of).sum()
}
