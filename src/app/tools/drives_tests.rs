//! Muscles and motors by clicks: what is marked is what comes, and it moves.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::marks::Mark;
use super::tests::{scope, shown};
use super::{Deed, Hand};
use crate::app::action::Tool;
use crate::app::player::{Order, Stage};
use crate::history::{Do, DriveOrNone};
use crate::scene::Scene;
use crate::sim::AngleDrive;

const WHEELS: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 10},
    "bodies": [{"make": "disc", "radius": 1, "spacing": 0.4, "origin": [-2, 0],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 2}},
      {"make": "lattice", "columns": 4, "rows": 2, "spacing": 0.5, "origin": [-2.5, 1.2],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 20}},
      {"make": "disc", "radius": 0.5, "spacing": 0.25, "origin": [3, -3],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 2}}]}"#;

fn hand(tool: Tool) -> Hand {
    let mut hand = Hand::default();
    hand.take(tool);
    hand
}

fn stage() -> Stage {
    Stage::new(Scene::parse(WHEELS, "x.json").unwrap().into()).unwrap()
}

fn give(stage: &mut Stage, deed: Deed) {
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
}

#[test]
fn a_click_makes_a_bond_a_muscle_and_another_one_takes_it_away() {
    let mut seen = shown(Scene::parse(WHEELS, "x.json").unwrap());
    let ends = seen.0.scenery.bonds.ends()[5];
    let [a, b] = ends.map(|end| scope(&seen).pixel(end).unwrap());
    let (at, hand) = (0.5 * (a + b), hand(Tool::Muscle));
    let said = |seen: &_| hand.marks(scope(seen), Some(at)).into_iter().any(|mark| matches!(mark, Mark::Words(..)));
    assert!(
        said(&seen) && !hand.marks(scope(&seen), Some(DVec2::ZERO)).iter().any(|mark| matches!(mark, Mark::Words(..)))
    );
    let mut stage = stage();
    let deed = hand.clone().press(scope(&seen), at);
    let [Do::Set(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert!(matches!(keys.drive, Some(DriveOrNone::This(_))) && deed.edit == Some("muscle"));
    let number = keys.bonds.clone().unwrap()[0] as usize;
    give(&mut stage, deed);
    let drive = stage.history().world().bonds().get(number).drive.unwrap();
    assert_eq!((drive.amplitude, drive.signal.wave.unwrap().period), (0.3, 1.0));
    let world = stage.history().world();
    std::sync::Arc::make_mut(&mut seen.0.scenery).bonds = world.bonds().clone();
    let deed = hand.clone().press(scope(&seen), at);
    assert_eq!(deed.edit, Some("muscle away"));
    give(&mut stage, deed);
    assert!(stage.history().world().bonds().get(number).drive.is_none());
}

#[test]
fn a_click_hinges_a_wheel_to_the_body_beside_it_or_to_the_ground_and_it_turns() {
    let seen = shown(Scene::parse(WHEELS, "x.json").unwrap());
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    for (middle, pins) in [([-2.0, 0.0], 0), ([3.0, -3.0], 2)] {
        let mut hand = hand(Tool::Motor);
        assert!(!hand.marks(scope(&seen), Some(at(middle[0], middle[1]))).is_empty());
        let deed = hand.press(scope(&seen), at(middle[0], middle[1]));
        let [Do::Add(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
        let points = keys.points.as_ref().unwrap();
        let first = keys.angles[0].points.0[2] as usize;
        assert_eq!((points.pinned.len(), keys.angles.len(), deed.edit), (pins, 3, Some("motor")));
        let mut stage = stage();
        give(&mut stage, deed);
        let world = stage.history().world();
        let most: f64 = world
            .angles()
            .iter()
            .filter_map(|angle| angle.drive)
            .map(|drive| match drive {
                AngleDrive::Motor { torque, .. } => torque,
                AngleDrive::Servo { .. } => 0.0,
            })
            .sum();
        assert!((most - 30.0).abs() < 1e-9);
        let angle = |stage: &Stage| {
            let sample = stage.history().world().sample(stage.history().world().time());
            let (x, hub) = (sample.position[first], sample.position[seen.0.point_count()]);
            assert!((x[0] - hub[0]).hypot(x[1] - hub[1]) < 0.7, "it keeps its place on the wheel");
            (x[1] - hub[1]).atan2(x[0] - hub[0])
        };
        let mut turned = 0.0;
        let mut last = angle(&stage);
        for _ in 0..60 {
            stage.obey(Order::Step(None));
            let now = angle(&stage);
            turned += (now - last + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
            last = now;
        }
        assert!(turned < -1.5, "clockwise: {turned} rad in a second");
    }
    let mut hand = hand(Tool::Motor);
    assert!(hand.press(scope(&seen), at(0.0, 4.0)).is_empty(), "nothing lies there");
}
