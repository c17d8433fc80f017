//! What an end of a rope is tied to: a point that is seen right there, of a body's skin before one within it, for what lies across a body
//! that it is tied to is pushed out of it for ever.

use glam::DVec2;

use super::SNAP;
use crate::app::tools::pick::Scope;
use crate::app::tools::segments::{self, nearest_on_segment};
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

/// The place of a wall or of the surface of an obstacle that an end of a rope at a pixel is pinned to: the nearest, where it is in reach or
/// the pixel lies on the obstacle or beyond the walls `[m]`.
pub(super) fn surface_at(scope: Scope<'_>, at: DVec2) -> Option<DVec2> {
    let scenery = &scope.shown.scenery;
    let place = scope.in_plane(at);
    let walls = scenery.bounds.iter().flat_map(|[low, high]| {
        let [low, high] = [low, high].map(|corner| DVec2::new(corner[0], corner[1]));
        let on = place.clamp(low, high);
        [DVec2::new(low.x, on.y), DVec2::new(high.x, on.y), DVec2::new(on.x, low.y), DVec2::new(on.x, high.y)]
    });
    let planes = scenery.planes.iter().map(|[point, normal]| {
        let [point, normal] = [point, normal].map(|x| DVec2::new(x[0], x[1]));
        let normal = normal.normalize_or_zero();
        place - (place - point).dot(normal) * normal
    });
    let sides = scenery.polygons.iter().flat_map(|polygon| segments::sides(&polygon.loops));
    let sides = sides.map(|[from, to]| nearest_on_segment(place, from, to));
    let nearest = walls.chain(planes).chain(sides).min_by(|a, b| a.distance(place).total_cmp(&b.distance(place)))?;
    let is_near = nearest.distance(place) * scope.camera.pixels_per_metre() <= SNAP * scope.scale;
    (is_near || scope.solid(at).is_some() || is_walled_off(scope, place)).then_some(nearest)
}

/// Whether what is drawn at a pixel would lie on a surface below it, of a wall or of an obstacle.
pub(super) fn lies_on(scope: Scope<'_>, at: DVec2) -> bool {
    let down = scope.shown.settings.gravity.map_or(DVec2::ZERO, |[x, y, _]| DVec2::new(x, y));
    let place = scope.in_plane(at);
    surface_at(scope, at).is_some_and(|surface| (surface - place).dot(down) > 0.0)
}

/// Whether a place `[m]` lies beyond the walls or behind a plane.
pub(super) fn is_walled_off(scope: Scope<'_>, place: DVec2) -> bool {
    let scenery = &scope.shown.scenery;
    let flat = |x: [f64; 3]| DVec2::new(x[0], x[1]);
    let is_out =
        scenery.bounds.is_some_and(|[low, high]| place.cmplt(flat(low)).any() || place.cmpgt(flat(high)).any());
    is_out || scenery.planes.iter().any(|[point, normal]| (place - flat(*point)).dot(flat(*normal)) < 0.0)
}

/// The nearest point of the skin of the body that a pixel lies on.
pub(super) fn nearest_of_skin(scope: Scope<'_>, at: DVec2) -> Option<PointId> {
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
