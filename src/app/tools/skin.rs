//! The skin of a body: the sides that only one of its triangles has.

use super::pick::Scope;
use crate::sim::PointId;
use crate::sim::triangles::outer_sides;

/// The sides of the skin of a body, whose points are ascending; none where it covers nothing.
pub(super) fn sides(scope: Scope<'_>, body: &[PointId]) -> Vec<[PointId; 2]> {
    let triangles = &scope.shown.scenery.triangles;
    let own = triangles.iter().filter(|corners| body.binary_search(&corners[0]).is_ok());
    let sides = outer_sides(own.map(|corners| corners.map(|corner| corner.0)));
    sides.into_iter().map(|side| side.ends.map(PointId)).collect()
}
