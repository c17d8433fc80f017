//! What keeps a point from going where the forces want it: rigid bonds and surfaces.

use super::descent::Descent;
use crate::sim::vector::{dot, sub};

/// A rigid bond, or a surface that a point is pressed onto.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    Bond { a: usize, b: usize, rest: f64 },
    Surface { point: usize, surface: usize },
}

impl<const D: usize> Descent<D> {
    pub(super) fn holds(&self) -> Vec<Hold> {
        self.rigid.iter().chain(&self.pressed).copied().collect()
    }

    /// How far a hold is off [m^2 for bonds, m for surfaces], and its gradient at its first end.
    pub(super) fn off(&self, hold: Hold, x: &[[f64; D]]) -> (f64, [f64; D]) {
        match hold {
            Hold::Bond { a, b, rest } => {
                let d = sub(x[a], x[b]);
                (0.5 * (dot(d, d) - rest * rest), d)
            }
            Hold::Surface { point, surface } => {
                let surface = &self.surfaces[surface];
                (surface.gap(x[point]), surface.normal)
            }
        }
    }
}
