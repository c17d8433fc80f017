//! Pins that are stuck in obstacles: they go along with what they are stuck in.

use glam::{DVec2, DVec3};

use super::chosen::Chosen;
use super::hub::props_of;
use super::pick::Scope;
use super::segments::{distance_to_sides, is_inside};
use crate::sim::PointId;

/// A pin this near to the side of an obstacle hangs on it `[logical px]`.
const NEAR: f64 = 3.0;

/// The pins that are stuck in obstacles of these numbers, or hang on their sides, with what the motors and stops about them push against; ascending.
pub(super) fn pins_in(scope: Scope<'_>, obstacles: &[u32]) -> Vec<PointId> {
    let scenery = &scope.shown.scenery;
    if obstacles.is_empty() || scope.shown.dimensions != 2 {
        return Vec::new();
    }
    let near = NEAR * scope.scale / scope.camera.pixels_per_metre();
    let is_meant = |number: &u32| obstacles.contains(number);
    let polygons = scenery.polygons.iter().zip(&scenery.solid_numbers).filter(|(_, number)| is_meant(number));
    let polygons: Vec<_> = polygons.map(|(polygon, _)| &polygon.loops).collect();
    let planes = scenery.planes.iter().zip(&scenery.plane_numbers).filter(|(_, number)| is_meant(number));
    let planes: Vec<[DVec2; 2]> = planes.map(|(plane, _)| plane.map(|x| DVec3::from(x).truncate())).collect();
    let is_stuck = |at: DVec2| {
        let in_polygon =
            |loops: &&Vec<Vec<[f64; 2]>>| is_inside(loops, at.to_array()) || distance_to_sides(at, loops) <= near;
        let behind = |[point, normal]: &[DVec2; 2]| (at - *point).dot(normal.normalize_or_zero()) <= near;
        polygons.iter().any(in_polygon) || planes.iter().any(behind)
    };
    let there = scenery.pinned.iter().copied().filter(|&pin| scope.is_there(pin));
    let mut pins: Vec<PointId> = there.filter(|pin| is_stuck(place(scope, *pin))).collect();
    let props: Vec<PointId> = pins.iter().flat_map(|&pin| props_of(scope, pin)).collect();
    pins.extend(props);
    pins.sort_unstable();
    pins.dedup();
    pins
}

/// What is chosen, with the pins that are stuck in its obstacles.
pub(super) fn with_pins(scope: Scope<'_>, chosen: &Chosen) -> Chosen {
    let pins = Chosen { points: pins_in(scope, &chosen.obstacles), ..Chosen::default() };
    if pins.points.is_empty() { chosen.clone() } else { chosen.joined(&pins, false) }
}

pub(super) fn place(scope: Scope<'_>, point: PointId) -> DVec2 {
    DVec3::from(scope.shown.place(point.index())).truncate()
}
