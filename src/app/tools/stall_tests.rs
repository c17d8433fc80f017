//! Motors on what is heavy: what is proposed turns it, and what is too weak says so.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::Hand;
use super::marks::Mark;
use super::stall::Stalls;
use super::tests::{scope, shown};
use crate::app::action::Tool;
use crate::app::player::{Order, Stage};
use crate::scene::Scene;
use crate::sim::PointId;

/// Something heavy on a floor, in thick air so that what swings comes to rest.
const HEAVY: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "drag_rate": DRAG, "contact": {"friction": 0.5}, "view": {"center": [0, 0], "height": 8},
    "bounds": {"min": [-6, -1], "max": [6, 6], "friction": 0.5}, "bodies": [BODY]}"#;
const WHEEL: &str = r#"{"make": "disc", "radius": 1, "spacing": 0.3, "origin": [0, 0], "material": KIND}"#;
const BAR: &str =
    r#"{"make": "lattice", "columns": 9, "rows": 2, "spacing": 0.25, "origin": [0, 2], "material": KIND}"#;
const KINDS: [&str; 2] =
    [r#"{"kind": "rigid", "mass": 40}"#, r#"{"kind": "spring", "stiffness": 40000, "damping": 100, "mass": 40}"#];

/// How far a body turns in five seconds with a motor of this torque where it is clicked `[rad]`, and what is said beside it then.
fn turned(body: &str, drag: &str, at: [f64; 2], torque: Option<f64>) -> (f64, Vec<String>) {
    let text = HEAVY.replace("BODY", body).replace("DRAG", drag);
    let mut seen = shown(Scene::parse(&text, "x.json").unwrap());
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let at = DVec2::from(seen.1.screen_from_world([at[0], at[1], 0.0].into()).unwrap());
    let mut hand = Hand::default();
    hand.take(Tool::Motor);
    let mut drives = hand.drives();
    (drives.motor.torque, drives.motor.is_on) = (torque, Some(true));
    hand.set_drives(drives);
    let deed = hand.press(scope(&seen), at);
    assert_eq!(deed.edit, Some("motor"));
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    let (mut stalls, mut angle, mut last) = (Stalls::default(), 0.0, None);
    for _ in 0..300 {
        stage.obey(Order::Step(None));
        stage.show(&mut seen.0);
        stalls.look(&seen.0, &[]);
        let [[x, y, _], [a, b, _]] = [0, seen.0.point_count() - 2].map(|point| seen.0.place(point));
        let now = DVec2::new(x - a, y - b);
        angle += last.replace(now).map_or(0.0, |last: DVec2| last.angle_to(now));
    }
    let words = stalls.marks(scope(&seen)).into_iter().filter_map(|mark| match mark {
        Mark::Label(_, words, _) => Some(words),
        _ => None,
    });
    (angle, words.collect())
}

#[test]
fn a_heavy_wheel_on_a_floor_is_turned_by_what_is_proposed() {
    for kind in KINDS {
        let (far, said) = turned(&WHEEL.replace("KIND", kind), "0", [0.0, 0.0], None);
        assert!(far < -6.0 && said.is_empty(), "{kind}: {far} rad, {said:?}");
    }
}

#[test]
fn a_bar_at_its_end_is_turned_by_what_is_proposed_and_what_is_too_weak_says_what_it_needs() {
    for kind in KINDS {
        let bar = BAR.replace("KIND", kind);
        let (far, said) = turned(&bar, "0", [0.05, 2.1], None);
        assert!(far < -6.0 && said.is_empty(), "{kind}: {far} rad, {said:?}");
        let (_, said) = turned(&bar, "6", [0.05, 2.1], Some(20.0));
        assert!(said.len() == 1 && said[0].starts_with("stalls with 20 N m: needs about"), "{kind}: {said:?}");
    }
}

#[test]
fn a_motor_whose_body_stands_against_a_wall_says_so_and_one_in_the_air_needs_no_friction() {
    let bar = r#"{"make": "lattice", "columns": 2, "rows": 9, "spacing": 0.25, "origin": [5.65, 1], "material": KIND}"#;
    let (_, said) = turned(&bar.replace("KIND", KINDS[0]), "6", [5.6, 2.9], Some(2.0));
    assert!(said.len() == 1 && said[0].ends_with("stands against a wall"), "{said:?}");
    let seen = shown(
        Scene::parse(
            &HEAVY.replace("BODY", &WHEEL.replace("KIND", KINDS[0]).replace("[0, 0]", "[0, 3]")).replace("DRAG", "0"),
            "x.json",
        )
        .unwrap(),
    );
    let all: Vec<PointId> = (0..seen.0.point_count() as u32).map(PointId).collect();
    let needs = |rubs| super::effort::needed(scope(&seen), DVec2::new(0.0, 3.0), [&all, &[]], (1.0, rubs));
    assert!(needs(true) > 5.0 * needs(false), "{} and {}", needs(true), needs(false));
}
