//! What of walls, planes and obstacles is near a body: whether it lies on one, or stands against one that is in its way.

use glam::{DVec2, DVec3};

use super::hinge::place;
use super::pick::Scope;
use super::segments::distance_to_sides;
use crate::app::player::Scenery;
use crate::sim::PointId;

/// A body touches what is no farther from one of its points than this share of how far it reaches `[1]`.
const NEAR: f64 = 0.08;
/// A surface is in the way of what lies on the ground where so much of its normal lies across gravity `[1]`.
const STEEP: f64 = 0.7;

/// How far a place is from the nearest wall, plane or obstacle `[m]`.
pub(super) fn gap(scope: Scope<'_>, at: DVec2) -> f64 {
    gap_in(&scope.shown.scenery, at)
}

/// The same, of what stands about a world.
pub(in crate::app) fn gap_in(scenery: &Scenery, at: DVec2) -> f64 {
    let walls = scenery.bounds.iter().flat_map(|[low, high]| {
        [0, 1].into_iter().flat_map(move |axis| [(at[axis] - low[axis]).abs(), (high[axis] - at[axis]).abs()])
    });
    let planes = scenery.planes.iter().map(|[point, normal]| {
        let [point, normal] = [*point, *normal].map(|x| DVec3::from(x).truncate());
        (at - point).dot(normal.normalize_or_zero()).abs()
    });
    let sides = scenery.polygons.iter().map(|polygon| distance_to_sides(at, &polygon.loops));
    walls.chain(planes).chain(sides).fold(f64::INFINITY, f64::min)
}

/// Whether some points that reach so far `[m]` touch anything that stands still.
pub(super) fn touches(scope: Scope<'_>, points: &[PointId], reach: f64) -> bool {
    points.iter().any(|&point| gap(scope, place(scope, point)) <= NEAR * reach)
}

/// Whether they touch what is too steep to be ground: a wall, or what hangs over them.
pub(super) fn stands_against(scope: Scope<'_>, points: &[PointId], reach: f64) -> bool {
    let [x, y, _] = scope.shown.settings.gravity.unwrap_or_default();
    let down = DVec2::new(x, y).normalize_or_zero();
    let step = 1e-3 * reach;
    let is_against = |&point: &PointId| {
        let at = place(scope, point);
        if gap(scope, at) > NEAR * reach {
            return false;
        }
        let along = |by: DVec2| gap(scope, at + step * by) - gap(scope, at - step * by);
        down == DVec2::ZERO || along(down.perp()).abs() > 2.0 * STEEP * step || along(down) > STEEP * step
    };
    points.iter().any(is_against)
}
