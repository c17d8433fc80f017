//! Ground: obstacles that have no end in view. The hand lets them be, for a short drag would move much that nobody sees.

use glam::{DVec2, DVec3};

use super::marks::{Mark, around_ball};
use super::pick::Scope;
use crate::sim::Figure;

/// Said of ground where the hand presses on it.
pub(super) const GROUND: &str = "this is ground, which the hand cannot move: the Select tool (6) can";
/// Said of it before that.
const WOULD_BE: &str = "ground: the Select tool (6) moves it";

impl Scope<'_> {
    /// The number of the obstacle that a pixel lies in and that the hand drags: one that is not larger than the view.
    pub(in crate::app) fn block(&self, at: DVec2) -> Option<u32> {
        self.with_an_end(at).filter(|&number| !self.is_larger_than_view(number))
    }

    /// Whether a pixel lies on ground: a plane's surface, or an obstacle that is larger than the view.
    pub(in crate::app) fn is_on_ground(&self, at: DVec2) -> bool {
        self.block(at).is_none() && self.solid(at).is_some()
    }

    /// Words beside the pointer where the hand would press on ground, with nothing about that it could take.
    pub(super) fn ground_marks(&self, at: DVec2) -> Vec<Mark> {
        if !self.is_on_ground(at) || !self.pushed(at).is_empty() {
            return Vec::new();
        }
        vec![Mark::Words(at + DVec2::new(16.0, -12.0) * self.scale, WOULD_BE.to_owned())]
    }

    /// Whether a solid is wider than the view or higher, or reaches behind the camera.
    fn is_larger_than_view(&self, number: u32) -> bool {
        let scenery = &self.shown.scenery;
        let Some(place) = scenery.solid_numbers.iter().position(|&other| other == number) else { return false };
        let places: Vec<DVec3> = match (scenery.convex.get(place), scenery.polygons.get(place)) {
            (Some(convex), _) => match &convex.figure {
                &Figure::Ball { center, radius } => around_ball(center, radius).to_vec(),
                figure => figure.frame().iter().flat_map(|frame| frame.corners()).map(DVec3::from).collect(),
            },
            (None, Some(polygon)) => {
                polygon.loops.iter().flatten().map(|&corner| DVec2::from(corner).extend(0.0)).collect()
            }
            (None, None) => return false,
        };
        let pixels: Option<Vec<[f64; 2]>> =
            places.into_iter().map(|place| self.camera.screen_from_world(place)).collect();
        let Some(pixels) = pixels else { return true };
        let view = self.camera.viewport().map(f64::from);
        (0..2).any(|axis| {
            let along = pixels.iter().map(|pixel| pixel[axis]);
            let [least, most] = [along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max)];
            most - least > view[axis]
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::Hand;
    use super::*;
    use crate::app::player::{Shown, Stage};
    use crate::render::{Camera, Pose};
    use crate::scene::Scene;

    /// Ground that goes on to the right, a box that stands out of the view at the left, a plane above, a box in the middle.
    const TERRAIN: &str = r#"{"wobble": 1, "points": {"position": [[0, -9]]}, "obstacles": [
        {"polygon": [[[-3, -4], [90, -4], [90, -2], [-3, -2]]]}, {"box": {"min": [-6, 0], "max": [-4, 1]}},
        {"plane": {"point": [0, 4], "normal": [0, -1]}}, {"box": {"min": [-1, 0], "max": [1, 1]}}]}"#;

    struct Seen {
        shown: Shown,
        camera: Camera,
    }

    impl Seen {
        fn of(text: &str, pose: Pose) -> Self {
            let mut shown = Shown::default();
            Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap().show(&mut shown);
            Seen { shown, camera: Camera::new(pose, [1000, 1000]) }
        }

        fn scope(&self) -> Scope<'_> {
            Scope { shown: &self.shown, camera: &self.camera, scale: 1.0, free: Scope::ANYWHERE }
        }

        fn pixel(&self, place: [f64; 3]) -> DVec2 {
            DVec2::from(self.camera.screen_from_world(place.into()).unwrap())
        }
    }

    fn plane(height: f64) -> Pose {
        Pose::Plane { center: DVec2::ZERO, height }
    }

    #[test]
    fn the_hand_lets_be_what_is_larger_than_the_view_says_so_before_and_drags_the_rest() {
        let seen = Seen::of(TERRAIN, plane(10.0));
        for (place, is_ground) in [([0.0, -3.0], true), ([-4.5, 0.5], false), ([0.0, 4.0], true), ([0.0, 0.5], false)] {
            let at = seen.pixel([place[0], place[1], 0.0]);
            let says =
                |marks: &[Mark]| marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words == WOULD_BE));
            for is_still in [false, true] {
                let mut hand = Hand::default();
                hand.stand_still(is_still);
                assert_eq!(says(&hand.marks(seen.scope(), Some(at))), is_ground, "{place:?}");
                let deed = hand.press(seen.scope(), at);
                assert_eq!(deed.words.as_deref(), is_ground.then_some(GROUND), "{place:?}");
                assert_eq!(hand.is_carrying(), !is_ground, "{place:?}");
                let to = at - DVec2::new(0.0, 200.0);
                let way = hand.haul(seen.scope(), to, 1.0);
                let moves = way.is_some() || !hand.release(seen.scope(), to).commands.is_empty();
                assert_eq!(moves, !is_ground, "{place:?}, still: {is_still}");
            }
        }
    }

    #[test]
    fn what_is_larger_than_the_view_is_dragged_once_all_of_it_is_seen() {
        let seen = Seen::of(TERRAIN, plane(250.0));
        assert_eq!(seen.scope().block(seen.pixel([40.0, -3.0, 0.0])), Some(0));
        let near = Seen::of(TERRAIN, plane(0.8));
        assert!(near.scope().is_on_ground(near.pixel([0.0, 0.3, 0.0])), "a wall from near by");
    }

    #[test]
    fn in_space_too_what_fills_the_view_is_ground() {
        let text = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0, 5, 0]]}, "obstacles": [
            {"box": {"min": [-40, -2, -40], "max": [40, -1, 40]}}, {"circle": {"center": [0, 0.5, 0], "radius": 0.5}}]}"#;
        let seen = Seen::of(text, Pose::Orbit { target: DVec3::ZERO, distance: 9.0, yaw: 0.0, pitch: 0.5 });
        let [floor, ball] = [[0.0, -1.0, 1.5], [0.0, 0.5, 0.0]].map(|place| seen.pixel(place));
        assert!(seen.scope().is_on_ground(floor) && seen.scope().block(floor).is_none());
        assert!(!seen.scope().is_on_ground(ball) && seen.scope().block(ball).is_some());
    }
}
