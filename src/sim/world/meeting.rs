//! What is told of bodies that meet so many others that it takes long, and of those that meet none.

use super::World;
use super::nested::by_place;
use crate::sim::real::Real;

/// Points of bodies in one place from which on it is said how long that takes: a frame of 5,000 takes half a second.
const CROWD: usize = 3_000;

impl<S: Real, const D: usize> World<S, D> {
    /// Tells of a place `[m]` with more points of bodies that meet than a frame has time for.
    pub(super) fn warn_of_crowds(&mut self, position: &[[f64; D]]) {
        if self.model.contact.is_none() {
            return;
        }
        let mut points: Vec<u32> = self.bonds.ends().iter().flatten().map(|end| end.0).collect();
        points.sort_unstable();
        points.dedup();
        let most = by_place(&mut points, position).map(<[u32]>::len).max();
        if let Some(most) = most.filter(|most| *most >= CROWD) {
            self.warnings.push(format!(
                "{most} points lie in one place, where each may meet all others, so a frame takes long: spread them out"
            ));
        }
    }

    /// Tells of bodies in space without triangles, which meet no others of their kind.
    pub(super) fn warn_of_bare_bodies(&mut self) {
        if D != 3 || self.model.contact.is_none_or(|contact| !contact.with_others) {
            return;
        }
        let mut bodies = self.bonded();
        let mut skinned: Vec<u32> = self.model.triangles.iter().map(|[corner, ..]| bodies.find(corner.0)).collect();
        skinned.sort_unstable();
        let mut bare: Vec<u32> = self.bonds.ends().iter().map(|[end, _]| bodies.find(end.0)).collect();
        bare.sort_unstable();
        bare.dedup();
        bare.retain(|body| skinned.binary_search(body).is_err());
        if bare.len() > 1 {
            self.warnings.push(format!(
                "{} bodies without triangles pass each other, for in space edges do not meet edges: give those that are to meet a skin",
                bare.len()
            ));
        }
    }
}
