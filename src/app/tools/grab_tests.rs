//! Presses on worlds that run, at the strengths that the scenes have: what was pushed away, pins, cloth in space.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use super::tests::{SIZE, grabbed, pixel, scope};
use super::{Hand, PinWay};
use crate::app::opening;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::{Do, History};
use crate::render::Camera;
use crate::scene::{Scene, gallery};
use crate::sim::{Cursor, PointId};

/// A scene that is played.
struct Played {
    stage: Stage,
    hand: Hand,
    /// What is drawn.
    seen: (Shown, Camera, Scene),
}

impl Played {
    fn new(scene: Scene) -> Self {
        let mut stage = Stage::new(scene.clone().into()).unwrap();
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let camera = opening::camera(&scene, &shown.view(), SIZE);
        let mut hand = Hand::default();
        hand.set_strength(scene.mouse_force().map(|force| force.strength));
        Played { stage, hand, seen: (shown, camera, scene) }
    }

    fn named(name: &str) -> Self {
        Played::new(gallery().iter().find(|entry| entry.name == name).unwrap().scene().unwrap())
    }

    fn text(text: &str) -> Self {
        Played::new(Scene::parse(text, "x.json").unwrap())
    }

    /// A frame with the cursor at a pixel.
    fn frame(&mut self, at: DVec2) {
        let cursor = Some(self.seen.1.cursor(at.to_array()));
        let note = self.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor, back: false });
        assert_eq!(note, None);
        self.stage.show(&mut self.seen.0);
    }

    /// The button goes down at a pixel, as the window has it. Returns what is grabbed.
    fn press(&mut self, at: DVec2) -> Vec<PointId> {
        let deed = self.hand.press(scope(&self.seen), at);
        let points = grabbed(&deed);
        let to = Some(self.seen.1.cursor(at.to_array()));
        let commands = std::iter::once(Do::Cursor { to, by: None }).chain(deed.commands).collect();
        assert_eq!(self.stage.obey(Order::Give(commands, deed.edit)), None, "nothing is refused");
        points
    }

    /// A pin is led to a pixel, for a frame.
    fn lead(&mut self, at: DVec2) -> Option<PinWay> {
        let way = self.hand.lead(scope(&self.seen), at, 0.2);
        if let Some(way) = way.clone() {
            assert_eq!(self.stage.obey(Order::LeadPins(way)), None);
        }
        way
    }

    fn place(&self, point: u32) -> DVec3 {
        DVec3::from(self.seen.0.place(point as usize))
    }

    /// Plays until something is so.
    fn until(&mut self, at: DVec2, mut is_so: impl FnMut(&Self) -> bool) {
        for _ in 0..2000 {
            if is_so(self) {
                return;
            }
            self.frame(at);
        }
        panic!("it never comes");
    }
}

#[test]
fn while_time_stands_still_a_drag_moves_the_whole_body_and_a_click_does_nothing() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 1], [0.5, 1], [3, 1]]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 10}], "view": {"center": [1, 1], "height": 4}}"#;
    let mut played = Played::text(text);
    played.hand.stand_still(true);
    let at = pixel(&played.seen, 0);
    let pressed = played.hand.press(scope(&played.seen), at);
    let clicked = played.hand.release(scope(&played.seen), at + DVec2::new(1.0, 0.0));
    assert!(pressed.is_empty() && clicked.is_empty(), "a click does nothing");
    played.hand.press(scope(&played.seen), at);
    let to = at + DVec2::new(0.0, -40.0);
    let deed = played.hand.release(scope(&played.seen), to);
    assert_eq!((deed.edit, deed.commands.len()), (Some("move"), 1));
    let up = (scope(&played.seen).in_plane(to) - scope(&played.seen).in_plane(at)).y;
    assert_eq!(played.stage.obey(Order::Give(deed.commands, deed.edit)), None);
    played.stage.show(&mut played.seen.0);
    let heights = [0, 1, 2].map(|point| played.seen.0.place(point)[1]);
    assert!(up > 0.1 && (heights[0] - 1.0 - up).abs() < 1e-9 && (heights[1] - 1.0 - up).abs() < 1e-9);
    assert_eq!(heights[2], 1.0, "the other body stays");
}

#[test]
fn what_the_hover_force_holds_off_is_grabbed_all_the_same() {
    let mut played = Played::text(
        r#"{"wobble": 1, "gravity": [0, 0], "drag_rate": 20, "points": {"position": [[0, 0]]},
            "mouse": {"strength": 900, "radius": 0.8}, "view": {"center": [0, 0], "height": 8}}"#,
    );
    // Slowly up to it: it flees.
    let start = pixel(&played.seen, 0);
    for step in 0..60 {
        played.frame(start - DVec2::new(90.0 - f64::from(step), 0.0));
    }
    let at = start - DVec2::new(30.0, 0.0);
    assert!(pixel(&played.seen, 0).distance(at) > 20.0, "it is out of reach of the press itself");
    played.until(at, |played| pixel(&played.seen, 0).distance(at) > 60.0);
    assert_eq!(played.press(at), [PointId(0)]);
    played.until(at, |played| pixel(&played.seen, 0).distance(at) < 2.0);
    let far = at + DVec2::new(-300.0, 0.0);
    played.hand.release(scope(&played.seen), at);
    assert_eq!(played.press(far), [], "what is out of the circle is not meant");
}

#[test]
fn bodies_are_grabbed_at_the_scenes_own_strengths() {
    for (name, point) in [("rim", 3), ("rope", 900), ("ring", 40), ("net", 5050)] {
        let mut played = Played::named(name);
        let at = pixel(&played.seen, point);
        for step in 0..12 {
            played.frame(at + DVec2::new(60.0 - 5.0 * f64::from(step), 0.0));
        }
        let points = played.press(at);
        assert!(!points.is_empty(), "{name}");
        let away = at + DVec2::new(0.0, -40.0);
        let before = played.stage.history().world().time();
        played.until(away, |played| played.stage.history().world().time() > before);
        let grab = played.seen.0.grab.clone().unwrap();
        assert_eq!(grab.points.len(), points.len(), "{name}");
        assert!(DVec3::from(grab.force).length() > 0.0, "{name} is led");
    }
}

#[test]
fn a_pin_that_is_pressed_on_is_led_as_one_edit_and_bears_its_load() {
    // Twenty points hang from one: far more than a grab of it could hold.
    let text = r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 21, "to": [0, -2], "pinned": [0]}],
        "view": {"center": [0, 0], "height": 8}}"#;
    let mut played = Played::text(text);
    let at = pixel(&played.seen, 0);
    assert_eq!(played.press(at), [], "it is no grab");
    assert!(played.hand.is_leading());
    assert_eq!(played.lead(at + DVec2::new(1.0, 0.0)), None, "a click moves no pin");
    let to = at + DVec2::new(100.0, -50.0);
    let first = played.lead(0.5 * (at + to)).unwrap();
    assert!(!first.goes_on);
    for _ in 0..3 {
        played.frame(to);
    }
    assert!(played.lead(to).unwrap().goes_on);
    played.hand.release(scope(&played.seen), to);
    assert!(!played.hand.is_busy());
    let goal = played.seen.1.world_from_screen(to.to_array());
    played.until(to, |played| played.place(0).distance(goal) < 1e-9);
    assert!(played.place(20).distance(goal) < 2.01, "the rope still hangs on it");
    let recording = played.stage.history().recording();
    let mut again = History::new(recording.into()).unwrap();
    while again.world().time() < played.stage.history().world().time() {
        again.step();
    }
    let hash = |history: &History| crate::history::hash_now(history.world(), history.world().time());
    assert_eq!(hash(&again), hash(played.stage.history()), "a file leads it as the hand did");
    let Some(Note::Undone(name, _)) = played.stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    assert_eq!(name, "move a pin");
    played.stage.show(&mut played.seen.0);
    assert_eq!(played.place(0), DVec3::ZERO, "one undo for all of its way");
}

#[test]
fn a_cloth_in_space_is_picked_by_the_ray_and_led_in_the_view_plane() {
    let text = std::fs::read_to_string("tests/files/cloth-space.json").unwrap();
    let mut played = Played::text(&text);
    let point = played.seen.0.point_count() as u32 / 2;
    let at = pixel(&played.seen, point as usize);
    let points = played.press(at);
    assert!(points.contains(&PointId(point)) || !points.is_empty());
    let Cursor { direction, .. } = played.seen.1.cursor(at.to_array());
    let to = at + DVec2::new(60.0, 30.0);
    let middle = |played: &Played| DVec3::from(played.seen.0.grab.as_ref().unwrap().middle);
    played.frame(at);
    let before = middle(&played);
    let pixel_of = |played: &Played| DVec2::from(played.seen.1.screen_from_world(middle(played)).unwrap());
    played.until(to, |played| pixel_of(played).distance(to) < 3.0);
    let along = (middle(&played) - before).dot(DVec3::from(direction));
    assert!(along.abs() < 0.1 * middle(&played).distance(before), "it stays as deep: {along}");
    // A pin of it, led in the same plane.
    played.hand.release(scope(&played.seen), to);
    played.stage.obey(Order::Give(vec![Do::Release], None));
    let pin = played.seen.0.scenery.pinned[0];
    let (place, at) = (played.place(pin.0), pixel(&played.seen, pin.index()));
    played.press(at);
    let to = at + DVec2::new(40.0, 40.0);
    let way = played.lead(to).unwrap();
    let Cursor { direction, .. } = played.seen.1.cursor(at.to_array());
    assert_eq!(way.pins[0].0, pin, "the one that was pressed on");
    let moved = DVec3::from(way.pins[0].1) - place;
    assert!(moved.length() > 0.01 && moved.dot(DVec3::from(direction)).abs() < 1e-9 * moved.length());
    let on_screen = DVec2::from(played.seen.1.screen_from_world(DVec3::from(way.pins[0].1)).unwrap());
    assert!(on_screen.distance(to) < 1e-3, "{on_screen} {to}");
}

#[test]
fn pins_that_bonds_join_are_one_bar_that_goes_along_and_turns() {
    let mut played = Played::named("cloth-space");
    let pin = played.seen.0.scenery.pinned[0];
    let (place, at) = (played.place(pin.0), pixel(&played.seen, pin.index()));
    assert_eq!(played.press(at), []);
    let to = at + DVec2::new(40.0, 40.0);
    let way = played.lead(to).unwrap();
    let moved = DVec3::from(way.pins[0].1) - place;
    // All of the bar goes along; while Shift is held it turns about its middle, as long as it was.
    assert_eq!(way.pins.len(), played.seen.0.scenery.pinned.len());
    let ways: Vec<DVec3> = way.pins.iter().map(|(pin, to)| DVec3::from(*to) - played.place(pin.0)).collect();
    assert!(ways.iter().all(|own| own.distance(moved) < 1e-9), "{ways:?}");
    let middle = |way: &PinWay| way.pins.iter().map(|(_, x)| DVec3::from(*x)).sum::<DVec3>() / way.pins.len() as f64;
    let long = |way: &PinWay| DVec3::from(way.pins[0].1).distance(DVec3::from(way.pins[way.pins.len() - 1].1));
    played.hand.hold([true, false]);
    played.lead(to + DVec2::new(0.0, 1.0)).unwrap();
    let turned = played.lead(to + DVec2::new(0.0, 80.0)).unwrap();
    assert!(turned.goes_on && middle(&turned).distance(middle(&way)) < 1e-9, "{turned:?}");
    assert!((long(&turned) - long(&way)).abs() < 1e-9, "{} m", long(&turned));
    assert!(DVec3::from(turned.pins[0].1).distance(DVec3::from(way.pins[0].1)) > 0.05, "it turned");
    let before = played.stage.history().world().bonds().len();
    played.until(to, |played| played.place(pin.0).distance(DVec3::from(turned.pins[0].1)) < 1e-6);
    assert_eq!(played.stage.history().world().bonds().len(), before, "nothing tears");
}

#[test]
fn a_cloth_is_pulled_off_a_ball_and_a_box_by_its_corner() {
    let mut played = Played::named("cloth-ball");
    let count = played.seen.0.point_count();
    let middle = |played: &Played| {
        let sum: DVec3 = (0..count as u32).map(|point| played.place(point)).sum();
        sum / count as f64
    };
    let away = DVec2::new(5.0, 5.0);
    played.until(away, |played| played.stage.history().world().time() > 1.5);
    // The corner that lies foremost, pressed from beside the cloth.
    let corner = count as u32 - 1;
    let hung = middle(&played);
    let at = pixel(&played.seen, corner as usize) + DVec2::new(3.0, 3.0);
    assert!(!played.press(at).is_empty());
    for step in 1..=150 {
        played.frame(at + DVec2::new(3.0 * f64::from(step.min(100)), 0.5 * f64::from(step.min(100))));
    }
    let gone = (middle(&played) - hung).length();
    assert!(gone > 0.8, "it went on by {gone} m");
}

#[test]
fn a_bar_turns_wherever_along_it_it_is_grabbed() {
    // Five pins in a row, 1 m apart.
    let text = r#"{"wobble": 1, "points": {"position": [[-2,0],[-1,0],[0,0],[1,0],[2,0]], "pinned": [0,1,2,3,4]},
        "bonds": [{"a":0,"b":1},{"a":1,"b":2},{"a":2,"b":3},{"a":3,"b":4}]}"#;
    for pin in 0..5_u32 {
        let mut played = Played::text(text);
        played.hand.hold([true, false]);
        let at = pixel(&played.seen, pin as usize);
        played.press(at);
        let metre = played.seen.1.pixels_per_metre();
        played.lead(at + DVec2::new(0.0, -4.0));
        let way = played.lead(at + DVec2::new(0.0, -0.5 * metre)).unwrap();
        let place = |k: u32| way.pins.iter().find(|(pin, _)| *pin == PointId(k)).map(|(_, x)| DVec3::from(*x)).unwrap();
        let angle = (place(4) - place(0)).truncate().to_angle();
        // A lever of 1 m or more: half a metre turns by no more than 30 degrees, and by some.
        assert!((0.1..0.55).contains(&angle.abs()), "pin {pin}: {angle}");
        assert!((place(0).distance(place(4)) - 4.0).abs() < 1e-9);
        assert!(place(pin).y > 0.2, "it goes after the hand: {}", place(pin).y);
    }
}
