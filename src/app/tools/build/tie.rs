//! Where a rope is tied to a body: on its skin, for what lies across a body that it is tied to is pushed out of it for ever.

use glam::{DVec2, DVec3};

use crate::app::tools::pick::Scope;
use crate::app::tools::skin;
use crate::sim::PointId;

/// The corner of the skin that a line from a place within a body to another place `[m]` leaves it by; `point` itself where no triangle
/// meets there.
pub(super) fn to_skin(scope: Scope<'_>, point: PointId, [from, to]: [DVec2; 2]) -> PointId {
    let far = |point: &PointId| {
        let at = DVec3::from(scope.shown.place(point.index())).truncate();
        at.distance(from) + at.distance(to)
    };
    if !scope.shown.scenery.triangles.iter().any(|corners| corners.contains(&point)) {
        return point;
    }
    let corners = skin::sides(scope, &scope.body(point)).into_iter().flatten();
    corners.min_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b))).unwrap_or(point)
}
