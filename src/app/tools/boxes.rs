//! Outlines of many bodies at once: a box around each, where their skins would be more lines than a frame has time for.

use glam::DVec2;

use super::marks::{Mark, Role};
use super::pick::Scope;
use crate::picture::Tint;
use crate::sim::PointId;

/// More boxes than this are one grey: the box around all of them says enough.
const MOST: usize = 6000;
/// A box is no smaller than this on the screen `[logical px]`.
const LEAST: f64 = 3.0;

/// The boxes around the bodies that points, ascending, are of, as far as they are in view.
pub(super) fn around(role: Role, scope: Scope<'_>, points: &[PointId]) -> Vec<Mark> {
    let count = scope.shown.point_count();
    let pairs = scope.shown.scenery.bonds.ends().iter().copied().chain(scope.arms());
    let body = Tint::hanging(count, pairs.map(|ends| ends.map(|end| end.0)));
    let mut around: Vec<Option<[DVec2; 2]>> = vec![None; count];
    for &point in points {
        let (Some(&of), Some(at)) = (body.get(point.index()), scope.pixel(point)) else { continue };
        let own = &mut around[of as usize];
        *own = Some(own.map_or([at; 2], |[low, high]| [low.min(at), high.max(at)]));
    }
    let [width, height] = scope.camera.viewport().map(f64::from);
    let is_seen =
        |[low, high]: &[DVec2; 2]| high.cmpge(DVec2::ZERO).all() && low.cmple(DVec2::new(width, height)).all();
    let seen: Vec<[DVec2; 2]> = around.into_iter().flatten().filter(is_seen).collect();
    if seen.len() > MOST {
        return Vec::new();
    }
    let least = DVec2::splat(LEAST * scope.scale);
    seen.into_iter().map(|[low, high]| Mark::Frame(role, low - least, high + least)).collect()
}
