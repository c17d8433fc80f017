//! Where nothing of a world is in view: an arrow at the edge to the nearest of its points, and the key that brings all into view.

use glam::DVec2;

use super::Session;
use crate::app::tools::{Mark, Role, Scope};
use crate::sim::PointId;

/// From the edge of what panels leave to the tip, length, half the width of its head, and how far the words stand off `[logical px]`.
const INSET: f64 = 14.0;
const LENGTH: f64 = 44.0;
const HEAD: f64 = 11.0;
const OFF: f64 = 22.0;
/// Width of its line `[logical px]`.
const WIDTH: f64 = 3.0;
/// Width of the words, about `[logical px]`.
const WORDS: f64 = 40.0;

impl Session {
    /// The arrow, if one is needed: where worlds stand side by side all of them are looked at, and each has its own view.
    pub(super) fn way_to_the_lost(&self, scope: Scope<'_>) -> Vec<Mark> {
        if self.tiles.count() > 1 || !self.player.is_open() {
            return Vec::new();
        }
        let view = [DVec2::ZERO, DVec2::from(self.area.map(f64::from))];
        let free = self.free.map(DVec2::from);
        nearest(scope, view).map_or_else(Vec::new, |lost| arrow(free, lost, scope.scale))
    }
}

/// The point nearest to the middle of the view `[px]`; `None` where something is in it: a point, or a bond that may cross it.
fn nearest(scope: Scope<'_>, [low, high]: [DVec2; 2]) -> Option<DVec2> {
    let middle = 0.5 * (low + high);
    let mut nearest: Option<DVec2> = None;
    for point in (0..scope.shown.point_count() as u32).map(PointId).filter(|&point| scope.is_there(point)) {
        let Some(at) = scope.pixel(point) else { continue };
        if at.cmpge(low).all() && at.cmple(high).all() {
            return None;
        }
        if nearest.is_none_or(|least| at.distance_squared(middle) < least.distance_squared(middle)) {
            nearest = Some(at);
        }
    }
    let crosses = |&[a, b]: &[PointId; 2]| {
        let ends = scope.pixel(a).zip(scope.pixel(b));
        ends.is_some_and(|(a, b)| a.min(b).cmple(high).all() && a.max(b).cmpge(low).all())
    };
    nearest.filter(|_| !scope.shown.scenery.bonds.ends().iter().any(crosses))
}

/// An arrow at the edge of a room that points to a place beyond it, with its words on the side of the room.
fn arrow([low, high]: [DVec2; 2], to: DVec2, scale: f64) -> Vec<Mark> {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low) - INSET * scale);
    let way = (to - middle).normalize_or(DVec2::X);
    // As far as the edge that is met first.
    let reach = (half.max(DVec2::splat(1.0)) / way.abs().max(DVec2::splat(1e-9))).min_element();
    let tip = middle + reach * way;
    let side = way.perp();
    let (tail, neck) = (tip - LENGTH * scale * way, tip - HEAD * scale * way);
    let line = |from: DVec2| Mark::Line(Role::Lead, from, tip, WIDTH * scale);
    let words = tail - OFF * scale * way - DVec2::new(0.5 * WORDS, -7.0) * scale;
    vec![
        line(tail),
        line(neck + HEAD * scale * side),
        line(neck - HEAD * scale * side),
        Mark::Words(words, "F: fit".to_owned()),
    ]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::{Shown, Stage};
    use crate::render::Camera;
    use crate::scene::Scene;

    #[test]
    fn the_arrow_points_to_the_nearest_where_nothing_is_in_view() {
        let text = r#"{"wobble": 1, "points": {"position": [[20, 0], [0, 90], [24, 0]]},
            "bonds": [{"a": 0, "b": 2, "kind": "spring", "stiffness": 10}]}"#;
        let mut shown = Shown::default();
        Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap().show(&mut shown);
        let view = [DVec2::ZERO, DVec2::new(800.0, 600.0)];
        let see = |low: [f64; 3], high: [f64; 3]| {
            let camera = Camera::fit([low, high], 2, [800, 600]);
            nearest(Scope { shown: &shown, camera: &camera, scale: 1.0 }, view)
        };
        let lost = see([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]).unwrap();
        assert!(lost.x > 800.0 && (lost.y - 300.0).abs() < 1.0, "the point at the right: {lost}");
        assert_eq!(see([19.0, -1.0, 0.0], [21.0, 1.0, 0.0]), None, "it is in view");
        assert_eq!(see([21.5, -0.2, 0.0], [22.5, 0.2, 0.0]), None, "its bond crosses the view");
        let marks = arrow(view, lost, 1.0);
        let Mark::Line(_, from, to, _) = marks[0] else { panic!("a line") };
        assert!((to - DVec2::new(786.0, 300.0)).length() < 1.0 && from.x < to.x, "{from} to {to}");
        let Mark::Line(_, from, to, _) = arrow(view, DVec2::new(400.0, -5000.0), 1.0)[0] else { panic!("a line") };
        assert!((to - DVec2::new(400.0, 14.0)).length() < 1.0 && from.y > to.y, "up: {from} to {to}");
    }
}
