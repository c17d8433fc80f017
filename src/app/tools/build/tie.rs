//! Where a rope is tied to a body: on its skin, for what lies across a body that it is tied to is pushed out of it for ever.

use glam::{DVec2, DVec3};

use crate::app::tools::pick::Scope;
use crate::sim::PointId;

/// The corner of the skin that a line from a place within a body to another place [m] leaves it by; `point` itself where no triangle
/// meets there.
pub(super) fn to_skin(scope: Scope<'_>, point: PointId, [from, to]: [DVec2; 2]) -> PointId {
    let far = |point: &PointId| {
        let at = DVec3::from(scope.shown.place(point.index())).truncate();
        at.distance(from) + at.distance(to)
    };
    skin(scope, point).into_iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(point)
}

/// The corners of the body's triangles that lie on a side of one triangle only.
fn skin(scope: Scope<'_>, point: PointId) -> Vec<PointId> {
    let triangles = &scope.shown.scenery.triangles;
    if !triangles.iter().any(|corners| corners.contains(&point)) {
        return Vec::new();
    }
    let body = scope.body(point);
    let own = triangles.iter().filter(|corners| body.binary_search(&corners[0]).is_ok());
    let sides = own.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut sides: Vec<[u32; 2]> = sides.map(|[a, b]| [a.0.min(b.0), a.0.max(b.0)]).collect();
    sides.sort_unstable();
    let lone = sides.chunk_by(|a, b| a == b).filter(|equal| equal.len() == 1);
    let mut corners: Vec<PointId> = lone.flatten().flatten().map(|&corner| PointId(corner)).collect();
    corners.sort_unstable();
    corners.dedup();
    corners
}
