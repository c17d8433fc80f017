//! The skin of a body: the sides that only one of its triangles has.

use super::pick::Scope;
use crate::sim::PointId;

/// The sides of the skin of a body, whose points are ascending; none where it covers nothing.
pub(super) fn sides(scope: Scope<'_>, body: &[PointId]) -> Vec<[PointId; 2]> {
    let triangles = &scope.shown.scenery.triangles;
    let own = triangles.iter().filter(|corners| body.binary_search(&corners[0]).is_ok());
    let sides = lone(own.map(|corners| corners.map(|corner| corner.0)));
    sides.into_iter().map(|side| side.map(PointId)).collect()
}

/// The sides that one of some triangles has alone.
pub(super) fn lone(triangles: impl Iterator<Item = [u32; 3]>) -> Vec<[u32; 2]> {
    let sides = triangles.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut sides: Vec<[u32; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    sides.sort_unstable();
    sides.chunk_by(|a, b| a == b).filter(|equal| equal.len() == 1).flatten().copied().collect()
}
