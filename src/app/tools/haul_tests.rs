//! What is dragged of what is selected, while time runs.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::{Hand, Mark, Role, Scope};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::render::{Camera, Pose};
use crate::scene::Scene;

const TRAY: &str = r#"{"wobble": 1, "contact": true, "obstacles": [{"box": {"min": [-1, -0.5], "max": [0, 0.5]}}],
    "bodies": [{"make": "lattice", "columns": 4, "rows": 4, "spacing": 0.2, "origin": [0.3, -0.3],
        "material": {"kind": "spring", "stiffness": 2000, "mass": 2}}]}"#;

fn camera() -> Camera {
    Camera::new(Pose::Plane { center: DVec2::ZERO, height: 10.0 }, [1000, 1000])
}

struct Played {
    stage: Stage,
    shown: Shown,
    hand: Hand,
}

impl Played {
    fn new() -> Self {
        Self::of(TRAY)
    }

    fn of(text: &str) -> Self {
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let (mut shown, mut hand) = (Shown::default(), Hand::default());
        stage.show(&mut shown);
        hand.take(Tool::Select);
        Played { stage, shown, hand }
    }

    fn with<T>(&mut self, call: impl FnOnce(&mut Hand, Scope<'_>) -> T) -> T {
        let camera = camera();
        call(&mut self.hand, Scope { shown: &self.shown, camera: &camera, scale: 1.0 })
    }

    /// A frame with the button down.
    fn frame(&mut self, at: DVec2) {
        let seconds = 1.0 / 60.0;
        if let Some(commands) = self.with(|hand, scope| hand.lead_bodies(scope, at)) {
            assert_eq!(self.stage.obey(Order::Give(commands, None)), None);
        }
        if let Some(way) = self.with(|hand, scope| hand.haul(scope, at, seconds)) {
            assert_eq!(self.stage.obey(Order::Haul(way)), None);
        }
        let cursor = Some(self.hand.led_to(camera().cursor(at.to_array())));
        drop(self.stage.obey(Order::Advance { wall: seconds, cursor, back: false }));
        self.stage.show(&mut self.shown);
    }

    fn middle(&self) -> f64 {
        (0..16).map(|point| self.shown.place(point)[0]).sum::<f64>() / 16.0
    }

    fn left(&self) -> f64 {
        self.shown.scenery.polygons[0].loops[0].iter().map(|corner| corner[0]).fold(f64::INFINITY, f64::min)
    }
}

#[test]
fn an_obstacle_that_is_dragged_while_time_runs_shoves_bodies_and_is_one_step_of_undo() {
    let mut played = Played::new();
    let from = DVec2::new(450.0, 500.0);
    assert!(played.with(|hand, scope| hand.press(scope, from)).is_empty());
    for k in 1..=60 {
        played.frame(from + DVec2::new(f64::from(k), 0.0));
        let right = played.left() + 1.0;
        assert!((0..16).all(|point| played.shown.place(point)[0] > right - 0.03), "frame {k}: it is ahead");
    }
    let end = from + DVec2::new(60.0, 0.0);
    assert!(played.with(|hand, scope| hand.haul(scope, end, f64::INFINITY)).is_none_or(|way| way.goes_on));
    assert!(played.with(|hand, scope| hand.release(scope, end)).is_empty());
    assert!((played.left() + 0.4).abs() < 0.05, "it went along: {}", played.left());
    assert!(played.middle() > 0.9, "{}", played.middle());
    let now = played.stage.history().world().time();
    let speed = played.stage.history().world().sample(now).velocity.iter().map(|v| v[0]).sum::<f64>() / 16.0;
    // What is soft and undamped is thrown ahead by up to as much again.
    assert!((0.55..1.3).contains(&speed), "as fast as it was pushed: {speed}");
    let Some(Note::Undone(name, _)) = played.stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    played.stage.show(&mut played.shown);
    assert_eq!((name.as_str(), played.left()), ("move", -1.0));
}

#[test]
fn a_body_that_is_dragged_while_time_runs_is_led_by_all_of_its_points_and_paused_it_jumps() {
    let mut played = Played::new();
    // Beside its middle.
    let from = DVec2::new(545.0, 515.0);
    assert!(played.with(|hand, scope| hand.press(scope, from)).is_empty());
    let before = played.middle();
    let to = from + DVec2::new(100.0, -100.0);
    for k in 1..=180 {
        played.frame(from.lerp(to, (f64::from(k) / 60.0).min(1.0)));
    }
    assert!(played.hand.is_grabbing());
    assert!((played.middle() - before - 1.0).abs() < 0.05, "as far as the pointer: {}", played.middle() - before);
    let deed = played.with(|hand, scope| hand.release(scope, to));
    assert_eq!((deed.commands, deed.edit), (vec![Do::Release], None));
    let mut still = Played::new();
    still.hand.stand_still(true);
    still.with(|hand, scope| hand.press(scope, from));
    assert!(still.with(|hand, scope| hand.lead_bodies(scope, to)).is_none());
    let deed = still.with(|hand, scope| hand.release(scope, to));
    assert!(matches!(deed.commands[..], [Do::Move(_)]) && deed.edit == Some("move"));
}

#[test]
fn the_hand_drags_an_obstacle_while_time_runs_as_the_tool_that_selects_does() {
    let mut played = Played::new();
    played.hand.take(Tool::Hand);
    played.hand.set_strength(Some(50.0));
    let from = DVec2::new(450.0, 500.0);
    let outline = played.with(|hand, scope| hand.marks(scope, Some(from)));
    assert!(!outline.is_empty(), "it is drawn before the press");
    let deed = played.with(|hand, scope| hand.press(scope, from));
    // The hover force goes away, or it would push what the obstacle pushes.
    assert!(matches!(deed.commands[..], [Do::Mouse(_)]) && deed.words.is_none() && !played.hand.is_pushing());
    assert!(played.with(|hand, scope| hand.haul(scope, from, 1.0)).is_none(), "a click moves nothing");
    for k in 1..=60 {
        played.frame(from + DVec2::new(f64::from(k), 0.0));
    }
    let end = from + DVec2::new(60.0, 0.0);
    assert!(played.hand.is_hauling());
    assert!(played.with(|hand, scope| hand.release(scope, end)).is_empty());
    assert!((played.left() + 0.4).abs() < 0.05 && played.middle() > 0.9, "{} {}", played.left(), played.middle());
    let Some(Note::Undone(name, _)) = played.stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    played.stage.show(&mut played.shown);
    assert_eq!((name.as_str(), played.left()), ("move", -1.0));
    // A while later the hover force is back.
    assert!(played.hand.pass(0.1).is_empty());
    assert!(matches!(played.hand.pass(0.2).commands[..], [Do::Mouse(_)]));
}

#[test]
fn what_has_no_room_before_an_obstacle_is_outlined_with_the_reason_until_it_has() {
    // The lattice stands between the obstacle and a wall 1.2 m on.
    let text = TRAY.replace("\"obstacles\": [", "\"obstacles\": [{\"box\": {\"min\": [1.2, -2], \"max\": [1.5, 2]}}, ");
    let mut played = Played::of(&text);
    let from = DVec2::new(450.0, 500.0);
    played.with(|hand, scope| hand.press(scope, from));
    let red = |marks: &[Mark]| marks.iter().filter(|mark| matches!(mark, Mark::Line(Role::Away, ..))).count();
    let words = |marks: Vec<Mark>| {
        marks.into_iter().find_map(|mark| if let Mark::Words(_, words) = mark { Some(words) } else { None })
    };
    let mut at = from;
    for k in 1..=150 {
        at = from + DVec2::new(f64::from(k).min(120.0), 0.0);
        played.frame(at);
        if k == 20 {
            let marks = played.with(|hand, scope| hand.marks(scope, Some(at)));
            assert_eq!((red(&marks), words(marks)), (0, None), "it has room");
        }
    }
    let marks = played.with(|hand, scope| hand.marks(scope, Some(at)));
    // The skin of a lattice of 4 by 4 points.
    assert_eq!(red(&marks), 12);
    assert_eq!(words(marks).as_deref(), Some("no room: the body in the way is pressed as far as it goes"));
    for k in 1..=60 {
        played.frame(at - DVec2::new(f64::from(2 * k), 0.0));
    }
    let marks = played.with(|hand, scope| hand.marks(scope, Some(from)));
    assert!(
        played.hand.is_hauling() && red(&marks) == 0 && words(marks).is_none(),
        "it is there no longer than it lasts"
    );
    assert_eq!(played.shown.jam, None);
}
