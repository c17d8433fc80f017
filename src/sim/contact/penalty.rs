//! A force by depth in place of contact: what a penalty is, and what it gives to points.

use super::surface::{Plane, Surface};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale};

/// How a surface pushes out what has got behind it, in place of contact.
///
/// Model: a point at depth s >= 0 `[m]` that moves outwards at v_n `[m/s]` is pushed along the normal by stiffness s - damping v_n `[N]`,
/// never inwards. A point of weight W rests at the depth W/stiffness; a fast one goes deep, and through what is thin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Penalty {
    /// `[N/m]`, >= 0.
    pub stiffness: f64,
    /// Along the normal `[N s/m]`, >= 0.
    pub damping: f64,
}

impl Penalty {
    /// Whether its numbers are in their ranges.
    pub(crate) fn is_fine(&self) -> bool {
        [self.stiffness, self.damping].iter().all(|x| *x >= 0.0 && x.is_finite())
    }
}

/// A surface with a penalty as the kernels read it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cushion<S, const D: usize> {
    surface: Surface<S, D>,
    stiffness: S,
    damping: S,
}

impl<S: Real, const D: usize> Cushion<S, D> {
    /// Of a plane that has a penalty.
    pub(crate) fn of(plane: &Plane<D>) -> Option<Self> {
        let Penalty { stiffness, damping } = plane.penalty?;
        let [stiffness, damping] = [stiffness, damping].map(S::from_f64);
        Some(Cushion { surface: Surface::new(plane), stiffness, damping })
    }

    /// Whether its force depends on velocities.
    pub(crate) fn is_damped(&self) -> bool {
        self.damping > S::ZERO
    }

    /// Adds to accelerations what it gives to free points.
    pub(crate) fn push(&self, (x, v, w): (&[[S; D]], &[[S; D]], &[S]), a: &mut [[S; D]]) {
        for i in (0..x.len()).filter(|&i| w[i] != S::ZERO) {
            let depth = -self.surface.gap(x[i]);
            if depth > S::ZERO {
                let normal = self.surface.normal;
                let force = self.stiffness * depth - self.damping * dot(v[i], normal);
                a[i] = add(a[i], scale(normal, force.max(S::ZERO) * w[i]));
            }
        }
    }

    /// What is stored in it of points at these places `[J]`.
    pub(crate) fn energy(&self, places: impl Iterator<Item = [S; D]>) -> f64 {
        let depths = places.map(|x| (-self.surface.gap(x)).to_f64().max(0.0));
        0.5 * self.stiffness.to_f64() * depths.map(|depth| depth * depth).sum::<f64>()
    }
}
