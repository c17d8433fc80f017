//! What a press of the hand would do where the pointer is, in words, for who has not tried it yet.

use glam::DVec2;

use super::lead::Lead;
use super::{Hand, Scope};

/// Said over a body while time runs and while it stands still, over an obstacle, and over nothing in the plane.
const GRAB: &str = "press and drag: grab it, throw it";
const PUT: &str = "paused: press and drag to move it";
const MOVE: &str = "press and drag: move it";
const POINT: &str = "point at a body, then press and drag it";
/// The same in space.
const TURN: &str = "point at a body, then press and drag it; a drag with the right button turns the view";

impl Hand {
    /// What a press at a pixel would do; `None`: there is nothing to try.
    pub(in crate::app) fn hint(&self, scope: Scope<'_>, at: DVec2) -> Option<&'static str> {
        if self.is_busy() || scope.starts_at(at) || scope.shown.point_count() == scope.shown.scenery.gone.len() {
            return None;
        }
        let is_pushed = || self.strength.is_some_and(|strength| strength > 0.0) && !scope.pushed(at).is_empty();
        let is_body = !scope.grip(at).is_empty() || Lead::of_pin(scope, at).is_some();
        Some(match (self.is_still, is_body) {
            (true, true) => PUT,
            (false, true) => GRAB,
            _ if scope.block(at).is_some() => MOVE,
            (false, false) if is_pushed() => GRAB,
            _ if scope.shown.dimensions == 3 => TURN,
            _ => POINT,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::{Shown, Stage};
    use crate::render::{Camera, Pose};
    use crate::scene::Scene;

    #[test]
    fn the_hint_says_what_a_press_would_do_there() {
        let text = r#"{"wobble": 1, "obstacles": [{"box": {"min": [2, -1], "max": [4, 1]}}], "bodies": [{"make": "disc",
            "radius": 1, "spacing": 0.4, "origin": [-2, 0], "material": {"kind": "spring", "stiffness": 300, "mass": 2}}]}"#;
        let mut shown = Shown::default();
        Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap().show(&mut shown);
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 10.0 }, [1000, 1000]);
        let scope = Scope { shown: &shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
        let mut hand = Hand::default();
        for (x, words) in [(-2.0, [GRAB, PUT]), (3.0, [MOVE; 2]), (0.5, [POINT; 2])] {
            let at = DVec2::from(camera.screen_from_world([x, 0.0, 0.0].into()).unwrap());
            for (is_still, words) in [false, true].into_iter().zip(words) {
                hand.stand_still(is_still);
                assert_eq!(hand.hint(scope, at), Some(words), "{x}, still: {is_still}");
                hand.press(scope, at);
                assert_eq!(hand.is_grabbing() || hand.is_carrying(), words != POINT, "and so it does");
                hand.let_go();
            }
        }
    }
}
