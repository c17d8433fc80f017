//! Muscles and motors by clicks: what is marked is what comes, and it moves.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::drives::MotorChoice;
use super::marks::Mark;
use super::tests::{scope, shown};
use super::{Deed, Drives, Hand};
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
    let plain = hand(Tool::Motor).press(scope(&seen), at(-2.0, 0.0));
    assert_eq!(plain.edit, Some("hinge"), "between bodies a motor is asked for");
    let off = [Some(true), Some(true), None, None];
    // Near its rim, too, a wheel turns about its middle.
    let clicks = [[-2.0, 0.0], [-2.0, -0.8], [3.0, -3.0], [3.3, -2.7]];
    for ((middle, is_on), pins) in clicks.into_iter().zip(off).zip([0, 0, 2, 2]) {
        let mut hand = hand(Tool::Motor);
        let drives = hand.drives();
        hand.set_drives(Drives { motor: MotorChoice { is_on, ..drives.motor }, ..drives });
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

/// A soft box over a disc, and what bodies do where they meet.
const AXLE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.7}, "view": {"center": [0, 0], "height": 8},
    "bounds": {"min": [-6, -1.5], "max": [6, 4]},
    "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.17, "origin": [0, -0.9],
        "material": {"kind": "spring", "stiffness": 200, "damping": 1, "mass": 0.8}},
      {"make": "lattice", "columns": 7, "rows": 4, "spacing": 0.25, "origin": [-0.75, -0.8],
        "material": {"kind": "spring", "stiffness": 300, "damping": 2, "mass": 1}}]}"#;

#[test]
fn bodies_that_overlap_are_hinged_and_pass_through_each_other() {
    let seen = shown(Scene::parse(AXLE, "x.json").unwrap());
    let at = DVec2::from(seen.1.screen_from_world([0.0, -1.1, 0.0].into()).unwrap());
    let deed = hand(Tool::Motor).press(scope(&seen), at);
    assert!(deed.edit == Some("hinge") && deed.words.as_ref().is_some_and(|words| words.contains("overlap")));
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    stage.obey(Order::Give(deed.commands, deed.edit));
    let contact = stage.history().world().contact().unwrap();
    assert_eq!((contact.with_itself, contact.with_others, contact.friction), (false, true, 0.7));
    for _ in 0..120 {
        stage.obey(Order::Step(None));
    }
    let world = stage.history().world();
    let place = |k: usize| DVec2::new(world.positions().get(2 * k), world.positions().get(2 * k + 1));
    let hub = place(seen.0.point_count());
    let disc = |k: usize| place(k).distance(hub);
    let rim = (0..seen.0.point_count()).filter(|&k| {
        let [x, y, _] = seen.0.place(k);
        (DVec2::new(x, y + 0.9).length() - 0.5).abs() < 0.01 && y < -0.9
    });
    let far: Vec<f64> = rim.map(disc).collect();
    assert!(far.len() > 5 && far.iter().all(|far| (0.25..0.7).contains(far)), "the wheel is whole: {far:?}");
    assert!(world.is_finite());
}
