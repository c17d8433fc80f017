//! One point that rests on one or more surfaces.

use super::surface::Surface;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub};

/// A point on up to D surfaces: more have no more directions to take away.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rest<S, const D: usize> {
    pub(crate) point: u32,
    surfaces: [u32; D],
    /// Directions that the surfaces take away, orthonormal.
    basis: [[S; D]; D],
    rank: usize,
    /// Held by friction: it does not move at all.
    pub(crate) sticks: bool,
    /// Where it slides to at the start of the step, of any length: friction goes on against it when the velocity turns
    /// back within the step, so that the moment when it is zero can be located.
    pub(crate) heading: [S; D],
    /// The whole acceleration of the last evaluation `[m/s^2]`, before friction and the surfaces took their part.
    pub(crate) pressing: [S; D],
}

impl<S: Real, const D: usize> Rest<S, D> {
    pub(crate) fn new(point: u32) -> Self {
        Rest {
            point,
            surfaces: [0; D],
            basis: [[S::ZERO; D]; D],
            rank: 0,
            sticks: false,
            pressing: [S::ZERO; D],
            heading: [S::ZERO; D],
        }
    }

    /// The surfaces that it rests on.
    #[inline(always)]
    pub(crate) fn surfaces(&self) -> &[u32] {
        &self.surfaces[..self.rank]
    }

    /// Rests on one more surface, unless those before hold it in that direction already.
    pub(crate) fn add(&mut self, surface: u32, all: &[Surface<S, D>]) {
        if self.rank == D || self.surfaces().contains(&surface) {
            return;
        }
        let rest = self.along(all[surface as usize].normal);
        let size = length(rest);
        if size < S::from_f64(1e-3) {
            return;
        }
        self.surfaces[self.rank] = surface;
        self.basis[self.rank] = scale(rest, S::ONE / size);
        self.rank += 1;
    }

    /// Rests only on the surfaces that `keep` says.
    pub(crate) fn keep(&mut self, all: &[Surface<S, D>], keep: impl Fn(usize) -> bool) {
        let kept = *self;
        self.rank = 0;
        for &surface in kept.surfaces() {
            if keep(surface as usize) {
                self.add(surface, all);
            }
        }
        self.sticks &= self.rank > 0;
    }

    /// The part of a vector along the surfaces.
    #[inline(always)]
    pub(crate) fn along(&self, vector: [S; D]) -> [S; D] {
        let mut result = vector;
        for n in &self.basis[..self.rank] {
            result = sub(result, scale(*n, dot(result, *n)));
        }
        result
    }

    /// The shift across the surfaces that changes the gap of each of them, by its number, by so much.
    pub(crate) fn across(&self, all: &[Surface<S, D>], change: impl Fn(usize) -> S) -> [S; D] {
        let mut shift = [S::ZERO; D];
        for (&surface, &direction) in self.surfaces().iter().zip(&self.basis) {
            // Directions after this one lie along the surface.
            let normal = all[surface as usize].normal;
            let left = change(surface as usize) - dot(normal, shift);
            shift = add(shift, scale(direction, left / dot(normal, direction)));
        }
        shift
    }

    /// The part of a vector that the point can follow.
    #[inline(always)]
    pub(crate) fn free(&self, vector: [S; D]) -> [S; D] {
        if self.sticks { [S::ZERO; D] } else { self.along(vector) }
    }

    /// The largest friction of its surfaces.
    pub(crate) fn grip(&self, all: &[Surface<S, D>]) -> S {
        self.surfaces().iter().fold(S::ZERO, |most, &surface| most.max(all[surface as usize].friction))
    }
}
