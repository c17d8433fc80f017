//! What keeps points from going where the forces want them: rigid bonds and surfaces, as constraints.

use crate::sim::bond::Limit;
use crate::sim::contact::surface::Surface;
use crate::sim::vector::{dot, sub};

/// What a hold is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Grip {
    /// A rigid bond of this rest length `[m]`, > 0.
    Bond { a: usize, b: usize, rest: f64 },
    /// A surface that a point cannot enter.
    Surface { point: usize, surface: usize },
}

/// A constraint: off = 0, off <= 0 ([`Limit::Max`]: strings) or off >= 0 ([`Limit::Min`]: struts and surfaces).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hold {
    pub(super) grip: Grip,
    pub(super) limit: Limit,
    /// Those that act both ways always are; the others while they are taut or press.
    pub(super) is_active: bool,
    /// Multiplier [N/m for bonds, N for surfaces]: it takes `lambda` times the gradient from the force. Above 0 where a
    /// bond pulls its ends together, below 0 where it or a surface pushes.
    pub(super) lambda: f64,
    /// How much firmer it is than others `[1]`, for those that are slow to hold: bonds that are straight and taut need
    /// tensions without bound.
    pub(super) firmness: f64,
}

/// How far a hold is off, and which way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Off<const D: usize> {
    /// (|d|^2 - rest^2)/2 `[m^2]` for a bond, the gap `[m]` for a surface.
    pub(super) value: f64,
    /// Its gradient by the first end: d, or the normal. That by the other end of a bond is the opposite.
    pub(super) gradient: [f64; D],
    /// What turns `value` into a length `[m]`.
    pub(super) per_metre: f64,
}

impl Hold {
    pub(super) fn new(grip: Grip, limit: Limit) -> Self {
        Hold { grip, limit, is_active: limit == Limit::Both, lambda: 0.0, firmness: 1.0 }
    }

    pub(super) fn off<const D: usize>(&self, surfaces: &[Surface<f64, D>], x: &[[f64; D]]) -> Off<D> {
        match self.grip {
            Grip::Bond { a, b, rest } => {
                let d = sub(x[a], x[b]);
                Off { value: 0.5 * (dot(d, d) - rest * rest), gradient: d, per_metre: rest }
            }
            Grip::Surface { point, surface } => {
                let surface = &surfaces[surface];
                Off { value: surface.gap(x[point]), gradient: surface.normal, per_metre: 1.0 }
            }
        }
    }

    /// Its pull or push by a multiplier `[N]`.
    pub(super) fn tension(&self, lambda: f64) -> f64 {
        match self.grip {
            Grip::Bond { rest, .. } => lambda.abs() * rest,
            Grip::Surface { .. } => lambda.abs(),
        }
    }

    /// How much of what it is off is forbidden, >= 0.
    pub(super) fn violation(&self, off: f64) -> f64 {
        match self.limit {
            Limit::Both => off.abs(),
            Limit::Max => off.max(0.0),
            Limit::Min => (-off).max(0.0),
        }
    }

    /// Whether a multiplier has the sign that it can have: a string only pulls, a strut and a surface only push.
    pub(super) fn can_have(&self, lambda: f64) -> bool {
        match self.limit {
            Limit::Both => true,
            Limit::Max => lambda >= 0.0,
            Limit::Min => lambda <= 0.0,
        }
    }
}

impl<const D: usize> Off<D> {
    /// The change of the value when points move by `step`.
    pub(super) fn change(&self, grip: Grip, step: &[[f64; D]]) -> f64 {
        match grip {
            Grip::Bond { a, b, .. } => dot(self.gradient, sub(step[a], step[b])),
            Grip::Surface { point, .. } => dot(self.gradient, step[point]),
        }
    }
}
