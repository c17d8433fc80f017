//! The tool that takes away: a body, a bond or an obstacle.

use glam::DVec2;

use super::Deed;
use super::pick::{Scope, distance_to_segment};
use crate::history::{DeleteKeys, Do};
use crate::sim::PointId;

/// What goes when a pixel is clicked.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    Body(Vec<PointId>),
    Bond(u32, [PointId; 2]),
    Obstacle(u32),
}

/// Of what is filled a bond is meant only where it is longer than this, and the pixel no further from it `[logical px]`: of what is smaller the
/// body is, whose bonds nobody sees.
const LONG: f64 = 48.0;
const ON_IT: f64 = 3.0;
/// Said where a bond of something filled goes.
const ONE_BOND: &str = "this bond alone; a click beside it takes the body";

/// A point is meant before a bond, what is filled before its bonds, and what lies on top before an obstacle.
pub(super) fn target(scope: Scope<'_>, at: DVec2) -> Option<Target> {
    // Of a point with a skin about it the body is meant, wherever it is clicked.
    let hit = scope.nearest(at);
    let is_bare = |point: PointId| {
        let has = |skin: &crate::picture::Skin| skin.triangles.iter().any(|corners| corners.contains(&point.0));
        !scope.shown.scenery.skins.iter().any(has)
    };
    match hit {
        Some(hit) if hit.distance > 8.0 * scope.scale && is_bare(hit.point) => {
            let bond = scope.bond(at).filter(|(_, ends)| !is_filled(scope, *ends) || is_meant(scope, (*ends, at)));
            let bond = bond.map(|(place, ends)| Target::Bond(scope.shown.scenery.bond_number(place), ends));
            bond.or_else(|| Some(Target::Body(scope.body(hit.point))))
        }
        Some(hit) => Some(Target::Body(scope.body(hit.point))),
        None => scope.obstacle(at).map(Target::Obstacle),
    }
}

/// Whether both ends of a bond are of what is filled.
fn is_filled(scope: Scope<'_>, ends: [PointId; 2]) -> bool {
    let is_corner = |end: &PointId| scope.shown.scenery.triangles.iter().any(|corners| corners.contains(end));
    ends.iter().all(is_corner)
}

/// Whether a pixel means a bond of something filled.
fn is_meant(scope: Scope<'_>, (ends, at): ([PointId; 2], DVec2)) -> bool {
    let [Some(from), Some(to)] = ends.map(|end| scope.pixel(end)) else { return false };
    from.distance(to) > LONG * scope.scale && distance_to_segment(at, from, to) <= ON_IT * scope.scale
}

/// What is said of what goes, before the click.
pub(super) fn words(scope: Scope<'_>, target: &Target) -> Option<&'static str> {
    matches!(target, Target::Bond(_, ends) if is_filled(scope, *ends)).then_some(ONE_BOND)
}

/// Takes away what is meant by a pixel.
pub(super) fn erase(scope: Scope<'_>, at: DVec2) -> Deed {
    match target(scope, at) {
        Some(Target::Body(points)) => delete_points(points),
        Some(Target::Bond(number, _)) => {
            Deed::edit("delete a bond", Do::Delete(DeleteKeys { bonds: vec![number], ..DeleteKeys::default() }))
        }
        Some(Target::Obstacle(number)) => delete_obstacle(number),
        None => Deed::words("nothing lies here that could be taken away".to_owned()),
    }
}

/// All bodies go; obstacles stay.
pub(in crate::app) fn clear(scope: Scope<'_>) -> Deed {
    let gone = &scope.shown.scenery.gone;
    let all = (0..scope.shown.point_count() as u32).map(PointId);
    let points: Vec<PointId> = all.filter(|point| gone.binary_search(point).is_err()).collect();
    if points.is_empty() {
        return Deed::words("there is no body here".to_owned());
    }
    let words = Some("all bodies are gone: Ctrl+Z brings them back".to_owned());
    Deed { edit: Some("clear"), words, ..delete_points(points) }
}

pub(super) fn delete_points(points: Vec<PointId>) -> Deed {
    let points = points.into_iter().map(|point| point.0).collect();
    Deed::edit("delete", Do::Delete(DeleteKeys { points, ..DeleteKeys::default() }))
}

fn delete_obstacle(number: u32) -> Deed {
    let keys = DeleteKeys { obstacles: vec![number], ..DeleteKeys::default() };
    Deed::edit("delete an obstacle", Do::Delete(keys))
}
