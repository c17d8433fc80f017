//! One bond or one point of a body, selected in place of the whole body.

use glam::DVec2;

use super::chosen::Chosen;
use super::marks::{self, Mark, Role};
use super::pick::Scope;
use crate::sim::PointId;

/// A pixel on a bond means its end where it is nearer to that than this share of the bond's length `[1]`: short bonds can be taken, too.
const END: f64 = 0.25;

impl Chosen {
    /// The point that a pixel lies on, or the two points of the bond; `None` within triangles and beside bodies.
    pub(super) fn part_at(scope: Scope<'_>, at: DVec2) -> Option<Self> {
        let mut points = match (scope.point(at), scope.bond(at)) {
            (Some(point), Some((_, ends))) if !is_end(scope, (point, ends), at) => ends.to_vec(),
            (Some(point), _) => vec![point],
            (None, bond) => bond?.1.to_vec(),
        };
        points.sort_unstable();
        Some(Chosen { points, ..Chosen::default() })
    }

    /// With a bond or a point beside it; without it, where it had that: points of other bonds that are selected stay.
    pub(super) fn with_part(&self, scope: Scope<'_>, part: &Chosen) -> Self {
        if !self.has(part) {
            return self.joined(part, false);
        }
        let among =
            |chosen: &Chosen, ends: &[PointId; 2]| ends.iter().all(|end| chosen.points.binary_search(end).is_ok());
        let bonds = scope.shown.scenery.bonds.ends().iter();
        let others: Vec<&[PointId; 2]> = bonds.filter(|ends| among(self, ends) && !among(part, ends)).collect();
        let is_alone = |point: &PointId| !others.iter().any(|ends| ends.contains(point));
        let alone: Vec<PointId> = part.points.iter().copied().filter(is_alone).collect();
        let points = if alone.is_empty() { part.points.clone() } else { alone };
        self.joined(&Chosen { points, ..Chosen::default() }, true)
    }

    /// A bond with rings about its points, or a ring about a point.
    pub(super) fn part_marks(&self, scope: Scope<'_>) -> Vec<Mark> {
        let ring = |&point: &PointId| Some(Mark::Ring(Role::Lead, scope.pixel(point)?, 7.0 * scope.scale));
        let rings = self.points.iter().filter_map(ring);
        let line = <[PointId; 2]>::try_from(&self.points[..]).ok();
        line.and_then(|ends| marks::line(Role::Lead, scope, ends)).into_iter().chain(rings).collect()
    }
}

/// Whether a pixel on a bond means a point near it, and not the bond.
fn is_end(scope: Scope<'_>, (point, [a, b]): (PointId, [PointId; 2]), at: DVec2) -> bool {
    let [Some(point), Some(a), Some(b)] = [point, a, b].map(|point| scope.pixel(point)) else { return true };
    point.distance(at) <= END * a.distance(b)
}
