//! Where nothing of a world is in view: an arrow at the edge to the nearest of its points, and the key that brings all into view.

use std::time::{Duration, Instant};

use glam::DVec2;

use super::Session;
use crate::app::tools::{Mark, Role, Scope};
use crate::render::Camera;
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
/// Where the numbers of the grid beside the tools end `[logical px]`.
const NUMBERS: f64 = 116.0;

/// Larger worlds are looked through so often at most, while nothing of them is in view.
const LOOK_EVERY: Duration = Duration::from_millis(100);
const LARGE: usize = 20_000;

/// What a picture is of: it is looked at again where that is another.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Picture {
    motion: u64,
    topology: u64,
    camera: Camera,
    area: [u32; 2],
}

/// What of the world is in view, as it was found last.
#[derive(Debug, Default)]
pub(super) struct Lost {
    found: Option<(Picture, Instant)>,
    /// A point that was in view, twice, or the ends of a bond that crosses it.
    seen: Option<[PointId; 2]>,
    /// The point nearest to the middle, where nothing is in view.
    nearest: Option<PointId>,
}

impl Lost {
    /// Looks whether something is in view `[px]`, if the picture is another: first at what was so the last time. Returns whether it is to
    /// be looked again soon.
    fn look(&mut self, scope: Scope<'_>, picture: Picture) -> bool {
        let view = [DVec2::ZERO, DVec2::from(picture.area.map(f64::from))];
        let last = self.found.filter(|(last, _)| last.topology == picture.topology);
        if last.is_some_and(|(last, _)| last == picture) {
            return false;
        }
        let seen = self.seen.filter(|_| last.is_some());
        if seen.is_some_and(|ends| crosses(scope, view, ends)) {
            self.found = Some((picture, Instant::now()));
            return false;
        }
        let is_early = last.is_some_and(|(_, at)| at.elapsed() < LOOK_EVERY);
        if is_early && self.nearest.is_some() && scope.shown.point_count() > LARGE {
            return true;
        }
        (self.seen, self.nearest) = match nearest(scope, view) {
            Ok(nearest) => (None, nearest),
            Err(seen) => (Some(seen), None),
        };
        self.found = Some((picture, Instant::now()));
        false
    }
}

impl Session {
    /// Looks whether something is in view, where the world stands alone: of several all are looked at, and each has its own view.
    pub(super) fn look_for_the_lost(&mut self) {
        if self.tiles.count() > 1 || !self.player.is_open() {
            self.lost = Lost::default();
            return;
        }
        let (shown, camera, area) = (self.player.shown(), self.camera_here(), self.area);
        let picture = Picture { motion: shown.motion, topology: shown.topology, camera, area };
        let scope = Scope { shown, camera: &camera, scale: f64::from(self.look.scale_factor), free: Scope::ANYWHERE };
        self.dirty |= self.lost.look(scope, picture);
    }

    /// Whether all points are in view.
    pub(super) fn sees_all(&self) -> bool {
        let (shown, camera) = (self.player.shown(), self.camera_here());
        let scope = Scope { shown, camera: &camera, scale: f64::from(self.look.scale_factor), free: Scope::ANYWHERE };
        let view = [DVec2::ZERO, DVec2::from(self.area.map(f64::from))];
        let mut there = (0..shown.point_count() as u32).map(PointId).filter(|&point| scope.is_there(point));
        there.all(|point| crosses(scope, view, [point; 2]))
    }

    /// The arrow, if one is needed: off panels, and off the numbers of the grid beside the tools.
    pub(super) fn way_to_the_lost(&self, scope: Scope<'_>) -> Vec<Mark> {
        let lost = self.lost.nearest.filter(|&point| scope.is_there(point)).and_then(|point| way_to(scope, point));
        let [mut low, high] = self.free.map(DVec2::from);
        if self.look.has_grid {
            low.x = low.x.max(NUMBERS * scope.scale);
        }
        lost.map_or_else(Vec::new, |lost| arrow([low, high], lost, scope.scale))
    }
}

/// Whether a bond between these may be in view: whether a point is, where they are one.
fn crosses(scope: Scope<'_>, [low, high]: [DVec2; 2], [a, b]: [PointId; 2]) -> bool {
    let is_there = scope.is_there(a) && scope.is_there(b);
    let ends = scope.pixel(a).zip(scope.pixel(b)).filter(|_| is_there && [a, b].iter().any(|&end| reaches(scope, end)));
    ends.is_some_and(|(a, b)| a.min(b).cmple(high).all() && a.max(b).cmpge(low).all())
}

/// Whether a point is neither behind the camera nor too far ahead to be drawn.
fn reaches(scope: Scope<'_>, point: PointId) -> bool {
    scope.camera.reaches(scope.shown.place(point.index()).into())
}

/// Which way a point lies, behind the camera too `[px]`.
fn way_to(scope: Scope<'_>, point: PointId) -> Option<DVec2> {
    scope.camera.way_to(scope.shown.place(point.index()).into()).map(DVec2::from)
}

/// The point nearest to the middle of the view `[px]`, `None` where there is none.
///
/// Errors: something is in it: a point, twice, or the ends of a bond that may cross it.
fn nearest(scope: Scope<'_>, [low, high]: [DVec2; 2]) -> Result<Option<PointId>, [PointId; 2]> {
    let middle = 0.5 * (low + high);
    let mut nearest: Option<(f64, PointId)> = None;
    for point in (0..scope.shown.point_count() as u32).map(PointId).filter(|&point| scope.is_there(point)) {
        let Some(at) = way_to(scope, point) else { continue };
        if at.cmpge(low).all() && at.cmple(high).all() && reaches(scope, point) {
            return Err([point; 2]);
        }
        let far = at.distance_squared(middle);
        if nearest.is_none_or(|(least, _)| far < least) {
            nearest = Some((far, point));
        }
    }
    let bonds = scope.shown.scenery.bonds.ends();
    let seen = bonds.iter().filter(|_| nearest.is_some()).find(|&&ends| crosses(scope, [low, high], ends));
    seen.map_or_else(|| Ok(nearest.map(|(_, point)| point)), |&ends| Err(ends))
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
    use crate::render::Pose;
    use crate::scene::Scene;

    #[test]
    fn the_arrow_points_to_the_nearest_where_nothing_is_in_view() {
        let text = r#"{"wobble": 1, "points": {"position": [[20, 0], [0, 90], [24, 0]]},
            "bonds": [{"a": 0, "b": 2, "kind": "spring", "stiffness": 10}]}"#;
        let mut shown = Shown::default();
        Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap().show(&mut shown);
        let view = [DVec2::ZERO, DVec2::new(800.0, 600.0)];
        let looked = |lost: &mut Lost, low: [f64; 3], high: [f64; 3]| {
            let camera = Camera::fit([low, high], 2, [800, 600]);
            let scope = Scope { shown: &shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
            let picture = Picture { motion: shown.motion, topology: shown.topology, camera, area: [800, 600] };
            assert!(!lost.look(scope, picture), "small worlds are looked at whenever they move");
            lost.nearest.and_then(|point| scope.pixel(point))
        };
        let mut lost = Lost::default();
        let mut see = |low: [f64; 3], high: [f64; 3]| looked(&mut lost, low, high);
        assert_eq!(see([19.0, -1.0, 0.0], [21.0, 1.0, 0.0]), None, "it is in view");
        let lost = see([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]).unwrap();
        assert!(lost.x > 800.0 && (lost.y - 300.0).abs() < 1.0, "the point at the right: {lost}");
        assert_eq!(see([19.0, -1.0, 0.0], [21.0, 1.0, 0.0]), None, "it is in view again");
        assert_eq!(see([21.5, -0.2, 0.0], [22.5, 0.2, 0.0]), None, "its bond crosses the view");
        assert_eq!(see([21.5, -0.2, 0.0], [22.6, 0.2, 0.0]), None, "and crosses it still");
        let marks = arrow(view, lost, 1.0);
        let Mark::Line(_, from, to, _) = marks[0] else { panic!("a line") };
        assert!((to - DVec2::new(786.0, 300.0)).length() < 1.0 && from.x < to.x, "{from} to {to}");
        let Mark::Line(_, from, to, _) = arrow(view, DVec2::new(400.0, -5000.0), 1.0)[0] else { panic!("a line") };
        assert!((to - DVec2::new(400.0, 14.0)).length() < 1.0 && from.y > to.y, "up: {from} to {to}");
    }

    #[test]
    fn in_space_the_arrow_points_to_what_is_beside_the_view_behind_the_camera_or_too_far_to_be_drawn() {
        let pose = Pose::Orbit { target: glam::DVec3::ZERO, distance: 10.0, yaw: 0.0, pitch: 0.0 };
        let camera = Camera::new(pose, [800, 600]);
        let view = [DVec2::ZERO, DVec2::new(800.0, 600.0)];
        // The camera is at z = 10 and looks back along z.
        for (place, way) in [
            ([0.0, 0.0, 0.0], None),
            ([0.0, 0.0, -900.0], None),
            ([90.0, 0.0, 0.0], Some(DVec2::X)),
            ([2.0, 0.0, 12.0], Some(DVec2::X)),
            ([0.0, 3.0, 40.0], Some(DVec2::NEG_Y)),
            ([0.0, 0.0, -1e6], Some(DVec2::ZERO)),
        ] {
            let [x, y, z] = place;
            let text = format!(r#"{{"wobble": 1, "dimensions": 3, "points": {{"position": [[{x}, {y}, {z}]]}}}}"#);
            let mut shown = Shown::default();
            Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap().show(&mut shown);
            let scope = Scope { shown: &shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
            let found = nearest(scope, view).ok().flatten().and_then(|point| way_to(scope, point));
            let from_middle = found.map(|at| (at - DVec2::new(400.0, 300.0)).normalize_or_zero());
            assert!(
                from_middle.is_some() == way.is_some()
                    && from_middle.zip(way).is_none_or(|(is, to)| (is - to).length() < 1e-3),
                "{place:?}: {found:?}"
            );
        }
    }
}
