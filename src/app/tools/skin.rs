//! The skin of a body: the sides that only one of its triangles has.

use super::pick::Scope;
use crate::sim::PointId;
use crate::sim::triangles::outer_sides;

/// The sides of the skin of a body, whose points are ascending; none where it covers nothing.
pub(super) fn sides(scope: Scope<'_>, body: &[PointId]) -> Vec<[PointId; 2]> {
    let sides = outer_sides(own(scope, body).map(|corners| corners.map(|corner| corner.0)));
    sides.into_iter().map(|side| side.ends.map(PointId)).collect()
}

/// The corners of its triangles, ascending.
pub(super) fn corners(scope: Scope<'_>, body: &[PointId]) -> Vec<PointId> {
    let mut corners: Vec<PointId> = own(scope, body).flatten().copied().collect();
    corners.sort_unstable();
    corners.dedup();
    corners
}

fn own<'a>(scope: Scope<'a>, body: &'a [PointId]) -> impl Iterator<Item = &'a [PointId; 3]> {
    let has = |corner: &PointId| body.binary_search(corner).is_ok();
    scope.shown.scenery.triangles.iter().filter(move |corners| corners.iter().all(has))
}
