//! Springs with a damper along the bond, as forces.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// A spring as the kernel reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring<S> {
    a: u32,
    b: u32,
    rest_length: S,
    stiffness: S,
    damping: S,
    limit: Limit,
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

    pub(crate) fn is_damped(&self) -> bool {
        self.damping > S::ZERO
    }
}

/// Adds the acceleration by every spring to `points.acceleration`.
///
/// Model: d = x_a - x_b, f_a = -stiffness (|d| - rest) d/|d| - damping ((v_a - v_b).d) d/|d|^2, f_b = -f_a.
/// At rest length 0 the force is linear: f_a = -stiffness d - damping (v_a - v_b). Coincident ends of a spring with a
/// rest length have no direction: no force.
pub(crate) fn pull<S: Real, const D: usize>(points: &mut Points<S, D>, springs: &[Spring<S>]) {
    let Points { position, velocity, inverse_mass, acceleration, .. } = points;
    for spring in springs {
        let (a, b) = (spring.a as usize, spring.b as usize);
        let d = sub(position[a], position[b]);
        let force = force(spring, d, || sub(velocity[a], velocity[b]));
        acceleration[a] = add(acceleration[a], scale(force, inverse_mass[a]));
        acceleration[b] = sub(acceleration[b], scale(force, inverse_mass[b]));
    }
}

/// The force on end a [N].
#[inline(always)]
fn force<S: Real, const D: usize>(spring: &Spring<S>, d: [S; D], closing: impl Fn() -> [S; D]) -> [S; D] {
    if spring.rest_length == S::ZERO {
        if spring.limit == Limit::Min {
            return [S::ZERO; D];
        }
        let pull = scale(d, -spring.stiffness);
        return if spring.is_damped() { sub(pull, scale(closing(), spring.damping)) } else { pull };
    }
    let square = dot(d, d);
    let length = square.sqrt();
    let slack = match spring.limit {
        Limit::Both => false,
        Limit::Max => length <= spring.rest_length,
        Limit::Min => length >= spring.rest_length,
    };
    if slack || square == S::ZERO {
        return [S::ZERO; D];
    }
    let mut share = spring.stiffness * (spring.rest_length / length - S::ONE);
    if spring.is_damped() {
        share -= spring.damping * dot(closing(), d) / square;
    }
    scale(d, share)
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
