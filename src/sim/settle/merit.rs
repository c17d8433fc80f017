//! What a step has to lower: energy, and a penalty on what is violated.

use super::descent::Descent;
use super::hold::Hold;
use crate::sim::bond::Limit;
use crate::sim::force::spring;
use crate::sim::vector::dot;

impl<const D: usize> Descent<D> {
    /// Energy of springs and gravity [J].
    pub(super) fn energy(&self, x: &[[f64; D]]) -> f64 {
        let lift =
            |(i, x): (usize, &[f64; D])| if self.is_free[i] { -self.mass[i] * dot(self.gravity, *x) } else { 0.0 };
        spring::energy(&self.bonds, |i| x[i]) + x.iter().enumerate().map(lift).sum::<f64>()
    }

    pub(super) fn merit(&self, x: &[[f64; D]]) -> f64 {
        let off: f64 = self.holds().into_iter().map(|hold| self.off(hold, x).0.abs()).sum();
        let inside: f64 = self.depths(x);
        self.energy(x) + self.penalty * (off + inside)
    }

    /// Sum of how deep free points are in surfaces [m].
    pub(super) fn depths(&self, x: &[[f64; D]]) -> f64 {
        let deep = |x: &[f64; D]| self.surfaces.iter().map(|surface| (-surface.gap(*x)).max(0.0)).sum::<f64>();
        let surfaces: f64 = x.iter().zip(&self.is_free).filter(|(_, free)| **free).map(|(x, _)| deep(x)).sum();
        let over = |&(hold, limit): &(Hold, Limit)| match limit {
            Limit::Max => self.off(hold, x).0.max(0.0),
            _ => (-self.off(hold, x).0).max(0.0),
        };
        surfaces + self.limited.iter().map(over).sum::<f64>()
    }

    /// The scale of the energy [J], for what rounding makes of its differences.
    pub(super) fn energy_scale(&self) -> f64 {
        self.weight() * self.extent()
    }
}
