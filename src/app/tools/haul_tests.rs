//! What is dragged of what is selected, while time runs.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::{Chosen, Hand, Mark, Role, Scope};
use crate::app::action::Tool;
use crate::app::matter::{Among, Placing};
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::render::{Camera, Pose};
use crate::scene::Scene;
use crate::sim::PointId;

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
        call(&mut self.hand, Scope { shown: &self.shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE })
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
    assert_eq!((deed.commands, deed.edit), (vec![Do::Release], Some("drag")));
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

/// A rope between two posts, pinned within them; the end in the right one is led a little up and down from 5 s on.
const BRIDGE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true,
    "obstacles": [{"box": {"min": [-2, -1], "max": [-1, 0]}}, {"box": {"min": [1, -1], "max": [2, 0]}}],
    "bodies": [{"make": "rope", "count": 9, "to": [2.4, 0], "slack": 0.3, "origin": [-1.2, -0.1], "pinned": [0, 8],
        "material": {"kind": "rigid", "mass": 0.4}}],
    "pin_motion": [{"point": 8, "track": [[5, 1.2, -0.1], [6, 1.2, -0.4], [7, 1.2, -0.1]]}]}"#;

#[test]
fn pins_in_an_obstacle_go_along_with_it_while_time_runs_and_while_it_stands_still() {
    let from = DVec2::new(350.0, 550.0);
    let mut played = Played::of(BRIDGE);
    let pin = |played: &Played, point: usize| DVec2::new(played.shown.place(point)[0], played.shown.place(point)[1]);
    assert!(played.with(|hand, scope| hand.press(scope, from)).is_empty());
    for k in 1..=40 {
        played.frame(from + DVec2::new(f64::from(k.min(30)), -f64::from(k.min(30))));
    }
    let end = from + DVec2::new(30.0, -30.0);
    drop(played.with(|hand, scope| hand.release(scope, end)));
    (0..10).for_each(|_| _ = played.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    played.stage.show(&mut played.shown);
    assert!((played.left() + 1.7).abs() < 0.02, "the post went along: {}", played.left());
    assert!(pin(&played, 0).distance(DVec2::new(-0.9, 0.2)) < 0.02, "the pin in it too: {}", pin(&played, 0));
    assert!(pin(&played, 8).distance(DVec2::new(1.2, -0.1)) < 1e-9, "the other one stands");
    let Some(Note::Undone(name, _)) = played.stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    played.stage.show(&mut played.shown);
    assert_eq!((name.as_str(), played.left()), ("move", -2.0));
    assert!(pin(&played, 0).distance(DVec2::new(-1.2, -0.1)) < 1e-9, "in one step");
    // The one that is led: its track is moved along, by hand and while time stands still.
    let right = DVec2::new(650.0, 550.0);
    for is_still in [false, true] {
        let mut played = Played::of(BRIDGE);
        played.hand.stand_still(is_still);
        let by = DVec2::new(-20.0, 30.0);
        assert!(played.with(|hand, scope| hand.press(scope, right)).is_empty());
        if is_still {
            let deed = played.with(|hand, scope| hand.release(scope, right + by));
            assert!(matches!(&deed.commands[..], [Do::Move(keys)] if keys.points == [8]), "{deed:?}");
            assert_eq!(played.stage.obey(Order::Give(deed.commands, deed.edit)), None);
        } else {
            (1..=40).for_each(|k| played.frame(right + by * (f64::from(k) / 30.0).min(1.0)));
            drop(played.with(|hand, scope| hand.release(scope, right + by)));
        }
        let lead = |played: &mut Played, until: f64| {
            while played.stage.history().world().time() < until - 1e-9 {
                drop(played.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
            }
            played.stage.show(&mut played.shown);
            pin(played, 8)
        };
        let moved = DVec2::new(-0.2, -0.3);
        for (until, place) in [(1.0, DVec2::new(1.2, -0.1)), (6.0, DVec2::new(1.2, -0.4)), (7.0, DVec2::new(1.2, -0.1))]
        {
            let x = lead(&mut played, until);
            assert!(x.distance(place + moved) < 0.02, "still {is_still}, at {until} s: {x}");
        }
    }
}

#[test]
fn a_pin_goes_where_the_obstacle_that_it_is_stuck_in_is_turned_and_scaled() {
    let mut played = Played::of(BRIDGE);
    played.hand.stand_still(true);
    let chosen = Chosen { obstacles: vec![0], ..Default::default() };
    for (change, keys) in
        [(super::handles::Change::Turn(0.5), "turn"), (super::handles::Change::Scale([1.5; 2]), "scale")]
    {
        let deed = played.with(|_, scope| change.fitted(scope, &chosen, DVec2::new(-1.5, -0.5)));
        assert!(
            matches!(&deed.commands[..], [Do::Move(keys)] if keys.points == [0]) && deed.edit == Some(keys),
            "{deed:?}"
        );
    }
}

#[test]
fn what_is_thrown_is_taken_back_to_the_moment_of_the_grab_and_thrown_again() {
    let mut played = Played::new();
    played.hand.take(Tool::Hand);
    let still = DVec2::new(-900.0, 0.0);
    (0..5).for_each(|_| played.frame(still));
    let state = |played: &Played| {
        let world = played.stage.history().world();
        (world.time(), crate::history::hash_now(world, world.time()))
    };
    let before = state(&played);
    let from = DVec2::new(560.0, 500.0);
    let grab = played.with(|hand, scope| hand.press(scope, from));
    let to = Some(camera().cursor(from.to_array()));
    let commands = [vec![Do::Cursor { to, by: None }], grab.commands].concat();
    assert_eq!(played.stage.obey(Order::Give(commands, grab.edit)), None);
    for k in 1..=20 {
        let at = from + DVec2::new(3.0 * f64::from(k), 0.0);
        played.with(|hand, scope| hand.trace(scope, at));
        played.frame(at);
    }
    let throw = played.with(|hand, scope| hand.release(scope, from + DVec2::new(60.0, 0.0)));
    let order = Order::Give(throw.commands, throw.edit);
    assert!(!order.is_edit(), "nobody is asked to save it");
    assert_eq!(played.stage.obey(order), None);
    let thrown = state(&played);
    (0..30).for_each(|_| played.frame(still));
    let Some(Note::Undone(name, _)) = played.stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    assert_eq!((name.as_str(), state(&played)), ("drag", before));
    assert!(played.stage.history().world().grab().is_none());
    assert!(matches!(played.stage.obey(Order::Redo(None)), Some(Note::Redone(..))));
    assert_eq!(state(&played), thrown, "as it was let go, to the bit");
    // A click on a body is nothing to undo.
    let grab = played.with(|hand, scope| hand.press(scope, from));
    assert!(grab.edit.is_none());
    assert_eq!(played.with(|hand, scope| hand.release(scope, from)).edit, None);
}

#[test]
fn a_number_of_its_place_takes_pins_along_as_a_drag_does() {
    let mut played = Played::of(BRIDGE);
    let numbers = played.shown.scenery.solid_numbers.clone();
    let left = |loops: &[Vec<[f64; 2]>]| loops.iter().flatten().all(|corner| corner[0] < 0.0);
    let place = played.shown.scenery.polygons.iter().position(|polygon| left(&polygon.loops)).unwrap();
    let chosen = Chosen { obstacles: vec![numbers[place]], ..Chosen::default() };
    let among = Among { obstacles: chosen.obstacles.clone(), ..Among::default() };
    assert_eq!(played.stage.obey(Order::Inspect(among.clone())), None);
    played.stage.show(&mut played.shown);
    let [x, y, _] = played.shown.figures.placed.unwrap().middle;
    let placing = Placing::At(1, y + 0.3);
    let (fit, _) = played.with(|_, scope| chosen.fit(scope, placing)).unwrap();
    assert_eq!(fit.along, [PointId(0)]);
    assert_eq!(played.stage.obey(Order::Place { among, fit, placing, goes_on: false }), None);
    played.stage.show(&mut played.shown);
    let middle = played.shown.figures.placed.unwrap().middle;
    assert!((middle[0] - x).abs() < 1e-9 && (middle[1] - y - 0.3).abs() < 1e-9, "{middle:?}");
    assert!((played.shown.place(0)[1] - 0.2).abs() < 1e-6, "{:?}", played.shown.place(0));
    let there = Placing::At(1, middle[1]);
    assert_eq!(played.with(|_, scope| chosen.fit(scope, there)), Err(None), "it is there already");
}
