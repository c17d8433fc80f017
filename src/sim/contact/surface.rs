//! Surfaces that points cannot pass, as the kernels read them.

use super::penalty::Penalty;
use crate::sim::real::Real;
use crate::sim::vector::{convert, dot, resized, widen};

/// A half-space that points cannot enter; the free side is where the normal points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<const D: usize> {
    /// Any point of the surface `[m]`.
    pub point: [f64; D],
    /// Its normal, of any length above 0.
    pub normal: [f64; D],
    /// v_n -> -restitution v_n on touching `[1]`, >= 0.
    pub restitution: f64,
    /// |change of v_t| <= friction |change of v_n| `[1]`, >= 0; more than 30 is taken as 30.
    pub friction: f64,
    /// Where it pushes by depth in place of contact.
    pub penalty: Option<Penalty>,
}

/// The largest coefficient of friction `[1]`: it holds what stands on a slope of 88 degrees. Of more a step is too long to be stopped
/// by in time, and what should stand turns back with the speed that friction gave it.
pub(crate) const MOST_FRICTION: f64 = 30.0;

/// A plane as the kernels read it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface<S, const D: usize> {
    /// Unit normal, towards the free side.
    pub(crate) normal: [S; D],
    /// normal . x on the surface `[m]`.
    offset: S,
    pub(crate) restitution: S,
    pub(crate) friction: S,
    /// A distance that rounding cannot tell from 0 `[m]`.
    slack: S,
}

impl<S: Real, const D: usize> Surface<S, D> {
    pub(crate) fn new(plane: &Plane<D>) -> Self {
        Surface::within(plane, 0.0)
    }

    /// The same, to be met at coordinates up to `reach` `[m]`.
    pub(crate) fn within(plane: &Plane<D>, reach: f64) -> Self {
        let length = plane.normal.iter().fold(0.0, |sum, &n| libm::hypot(sum, n));
        let normal = plane.normal.map(|n| n / length);
        let offset = dot(normal, plane.point);
        Surface {
            normal: convert(normal),
            offset: S::from_f64(offset),
            slack: S::EPSILON * S::from_f64(64.0 * (1.0 + offset.abs().max(reach))),
            restitution: S::from_f64(plane.restitution),
            friction: S::from_f64(plane.friction.min(MOST_FRICTION)),
        }
    }

    /// How far a point is from the surface `[m]`; below 0 inside the solid.
    #[inline(always)]
    pub(crate) fn gap(&self, x: [S; D]) -> S {
        dot(self.normal, x) - self.offset
    }

    /// The place of a point that is put on a wall across an axis, without rounding, however far it is.
    pub(crate) fn clamped(&self, mut x: [S; D]) -> [S; D] {
        for (x, &n) in x.iter_mut().zip(&self.normal).filter(|(_, n)| **n != S::ZERO) {
            *x = self.offset * n;
        }
        x
    }

    /// [`Surface::gap`] in `f64`, whatever the world's scalar; in a plane of a world in space, too.
    #[inline(always)]
    pub(crate) fn gap_of<const N: usize>(&self, x: [f64; N]) -> f64 {
        dot(resized(widen(self.normal)), x) - self.offset.to_f64()
    }

    /// The gap of the nearest corner of a box `[m]`.
    pub(crate) fn least_gap(&self, [low, high]: [[S; D]; 2]) -> S {
        self.gap(std::array::from_fn(|k| if self.normal[k] > S::ZERO { low[k] } else { high[k] }))
    }

    /// How fast the gap may shrink at velocities from a box of them `[m/s]`: below 0 towards the surface.
    pub(crate) fn least_rate(&self, [low, high]: [[S; D]; 2]) -> S {
        dot(self.normal, std::array::from_fn(|k| if self.normal[k] > S::ZERO { low[k] } else { high[k] }))
    }

    /// A distance that rounding cannot tell from 0 `[m]`.
    pub(crate) fn slack(&self) -> S {
        self.slack
    }
}
