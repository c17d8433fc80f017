//! The skin of a body: the sides that only one of its triangles has.

use super::pick::Scope;
use crate::sim::PointId;

/// The sides of the skin of a body, whose points are ascending; none where it covers nothing.
pub(super) fn sides(scope: Scope<'_>, body: &[PointId]) -> Vec<[PointId; 2]> {
    let triangles = &scope.shown.scenery.triangles;
    let own = triangles.iter().filter(|corners| body.binary_search(&corners[0]).is_ok());
    let sides = own.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut sides: Vec<[u32; 2]> = sides.map(|[a, b]| [a.0.min(b.0), a.0.max(b.0)]).collect();
    sides.sort_unstable();
    let lone = sides.chunk_by(|a, b| a == b).filter(|equal| equal.len() == 1);
    lone.flatten().map(|side| side.map(PointId)).collect()
}
