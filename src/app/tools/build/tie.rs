//! What an end of a rope is tied to: a point that is seen right there, of a body's skin before one within it, for what lies across a body
//! that it is tied to is pushed out of it for ever.

use glam::DVec2;

use crate::app::tools::pick::Scope;
use crate::app::tools::skin;
use crate::sim::PointId;

/// The point that a rope is tied to which begins or ends at a pixel: in reach, the nearest that is within no body; where bodies pass
/// through each other one within a body does too. Of a body that the pixel lies on, but no point of its skin is in reach, it is the nearest
/// of the skin.
pub(super) fn point_at(scope: Scope<'_>, at: DVec2) -> Option<PointId> {
    let reached = scope.reached(at);
    let outer = reached.iter().copied().find(|&point| !is_within(scope, point));
    let passes = scope.shown.settings.contact.flatten().is_none();
    let own = outer.or_else(|| reached.first().copied().filter(|_| passes));
    own.or_else(|| nearest_of_skin(scope, at))
}

/// The nearest point of the skin of the body that a pixel lies on.
fn nearest_of_skin(scope: Scope<'_>, at: DVec2) -> Option<PointId> {
    let [corner, ..] = scope.triangle(at)?;
    let skin = skin::sides(scope, &scope.body(corner)).into_iter().flatten();
    let seen = skin.filter_map(|point| Some((scope.pixel(point)?.distance(at), point)));
    seen.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, point)| point)
}

/// Whether a point has triangles all around it.
fn is_within(scope: Scope<'_>, point: PointId) -> bool {
    let is_covered = scope.shown.scenery.triangles.iter().any(|corners| corners.contains(&point));
    is_covered && !skin::sides(scope, &scope.body(point)).iter().flatten().any(|corner| *corner == point)
}
