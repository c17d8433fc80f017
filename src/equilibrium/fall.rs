//! What hangs from no pin falls: to the first surface, or for ever.

use super::part::Part;
use crate::sim::contact::surface::Surface;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Cosine below which a direction counts as along a surface.
const ALONG: f64 = 1e-12;

impl<const D: usize> Part<D> {
    /// Whether a bond leads to a pin.
    pub(super) fn is_hung(&self) -> bool {
        self.is_free.contains(&false)
    }

    /// Whether the whole can go down for ever without entering a surface. Where some are rough that is not sure before it
    /// has been tried: it may stick.
    pub(super) fn falls_for_ever(&self) -> bool {
        let drift = self.drift();
        let g = length(drift);
        let is_smooth = self.surfaces.iter().all(|surface| surface.friction == 0.0);
        g > 0.0 && is_smooth && !self.is_hung() && can_fall(scale(drift, 1.0 / g), &self.surfaces, &mut Vec::new())
    }

    /// Moves the whole along gravity and the forces on it until its first point touches a surface: nothing but weight acts on it until then,
    /// and weight does not change its shape. What is in a surface already stays.
    pub(super) fn drop_down(&mut self) {
        let drift = self.drift();
        let g = length(drift);
        if self.is_hung() || g == 0.0 {
            return;
        }
        let down = scale(drift, 1.0 / g);
        let mut distance = f64::INFINITY;
        for surface in &self.surfaces {
            let lowest = self.position.iter().map(|&x| surface.gap(x)).fold(f64::INFINITY, f64::min);
            let closing = -dot(surface.normal, down);
            if lowest < -surface.slack() {
                return;
            }
            if closing > ALONG {
                distance = distance.min(lowest.max(0.0) / closing);
            }
        }
        if distance.is_finite() {
            self.position.iter_mut().for_each(|x| *x = add(*x, scale(down, distance)));
        }
    }
}

/// Whether some direction goes down and enters no surface.
///
/// The steepest one is gravity's part along surfaces that are pressed: all choices of fewer than D of them are tried.
/// `across` are the directions that those chosen take away, orthonormal.
fn can_fall<const D: usize>(down: [f64; D], surfaces: &[Surface<f64, D>], across: &mut Vec<[f64; D]>) -> bool {
    let along = |v: [f64; D], across: &[[f64; D]]| across.iter().fold(v, |v, n| sub(v, scale(*n, dot(v, *n))));
    let steepest = along(down, across);
    let steep = length(steepest);
    if steep <= ALONG {
        return false;
    }
    if surfaces.iter().all(|surface| dot(surface.normal, steepest) >= -ALONG * steep) {
        return true;
    }
    if across.len() + 1 == D {
        return false;
    }
    for surface in surfaces {
        let rest = along(surface.normal, across);
        let size = length(rest);
        if size > 1e-9 {
            across.push(scale(rest, 1.0 / size));
            let found = can_fall(down, surfaces, across);
            across.pop();
            if found {
                return true;
            }
        }
    }
    false
}
