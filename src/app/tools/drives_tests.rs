//! Muscles and motors by clicks: what is marked is what comes, and it moves.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::drives::MotorChoice;
use super::marks::Mark;
use super::muscles::MuscleChoice;
use super::pick::Scope;
use super::tests::{scope, shown};
use super::{Deed, Drives, Hand};
use crate::app::action::Tool;
use crate::app::matter::Among;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::scene::{KeyName, Scene};
use crate::sim::{AngleDrive, Held, Key, PointId, Signal, Wave};

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
        if pins == 2 {
            // What the motor pushes against is seen as one with the hub, and no click means it.
            let mut later = Shown::default();
            stage.show(&mut later);
            let scope = Scope { shown: &later, camera: &seen.1, scale: 1.0, free: Scope::ANYWHERE };
            let [hub, prop] = [0, 1].map(|k| PointId((seen.0.point_count() + k) as u32));
            let [at_hub, at_prop] = [hub, prop].map(|point| scope.pixel(point).unwrap());
            assert!(at_hub.distance(at_prop) < 4.0, "{at_hub} and {at_prop}");
            assert_ne!(scope.nearest(at_prop).unwrap().point, prop);
        }
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
    assert_eq!((deed.edit, deed.words.as_deref()), (Some("hinge"), None));
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    stage.obey(Order::Give(deed.commands, deed.edit));
    let contact = stage.history().world().contact().unwrap();
    assert!(contact.with_itself && contact.with_others, "all else meets as before");
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

/// What is written beside the cursor.
fn said(seen: &(Shown, Camera, Scene), hand: &Hand, at: DVec2) -> String {
    let words = hand.marks(scope(seen), Some(at)).into_iter().find_map(|mark| match mark {
        Mark::Words(_, words) => Some(words),
        _ => None,
    });
    words.unwrap_or_default()
}

/// Angles and points that are left.
fn counts(stage: &Stage) -> [usize; 2] {
    let world = stage.history().world();
    [world.angles().len(), world.point_count() - world.gone().len()]
}

#[test]
fn a_click_on_a_hinge_that_is_there_switches_its_motor_and_with_shift_takes_it_away() {
    let all = counts(&stage())[1];
    // Between the wheel and the box, and on the background.
    for (middle, props) in [([-2.0, 0.0], 0), ([3.0, -3.0], 1)] {
        let mut seen = shown(Scene::parse(WHEELS, "x.json").unwrap());
        let mut stage = stage();
        let mut hand = hand(Tool::Motor);
        let at = |seen: &(Shown, Camera, Scene), by: f64| {
            DVec2::from(seen.1.screen_from_world([middle[0], middle[1] - by, 0.0].into()).unwrap())
        };
        let mut click = |seen: &mut (Shown, Camera, Scene), hand: &mut Hand, by: f64| {
            let deed = hand.press(scope(seen), at(seen, by));
            let edit = deed.edit;
            if !deed.is_empty() {
                give(&mut stage, deed);
                stage.show(&mut seen.0);
            }
            (edit.unwrap_or(""), counts(&stage))
        };
        let drives = hand.drives();
        hand.set_drives(Drives { motor: MotorChoice { is_on: Some(false), ..drives.motor }, ..drives });
        assert_eq!(click(&mut seen, &mut hand, 0.0), ("hinge", [0, all + 1]));
        assert!(said(&seen, &hand, at(&seen, 0.0)).contains("a hinge is here already"));
        assert_eq!(click(&mut seen, &mut hand, 0.0), ("", [0, all + 1]), "the switch asks for none");
        hand.set_drives(drives);
        // Near the rim, too, its own hinge is meant, and no body far off.
        for by in [0.0, 0.35] {
            assert_eq!(click(&mut seen, &mut hand, by), ("motor", [3, all + 1 + props]));
            assert!(said(&seen, &hand, at(&seen, by)).contains("takes the motor off"));
            assert_eq!(click(&mut seen, &mut hand, by), ("motor off", [0, all + 1]), "nothing is left of it");
        }
        click(&mut seen, &mut hand, 0.0);
        let back = MotorChoice { speed: 5.0, ..drives.motor };
        hand.set_drives(Drives { motor: back, ..drives });
        assert_eq!(said(&seen, &hand, at(&seen, 0.0)), "a click gives it this motor instead");
        assert_eq!(click(&mut seen, &mut hand, 0.0), ("motor", [3, all + 1 + props]));
        hand.hold([true, false]);
        assert!(said(&seen, &hand, at(&seen, 0.0)).contains("takes the hinge away"));
        assert_eq!(click(&mut seen, &mut hand, 0.0), ("hinge away", [0, all]), "and the body is as it was");
    }
}

#[test]
fn a_wheel_that_is_joined_without_a_motor_is_offered_one_which_comes_as_a_step_of_its_own() {
    let mut seen = shown(Scene::parse(WHEELS, "x.json").unwrap());
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    let [joined, alone] = [at(-2.0, 0.0), at(3.0, -3.0)];
    let press = |is_on: Option<bool>, at: DVec2| {
        let mut hand = hand(Tool::Motor);
        let drives = hand.drives();
        hand.set_drives(Drives { motor: MotorChoice { is_on, ..drives.motor }, ..drives });
        hand.press(scope(&seen), at)
    };
    let hub = PointId(seen.0.point_count() as u32);
    assert_eq!(press(Some(true), joined).motor_for, None, "it has one");
    assert_eq!(press(Some(false), alone).motor_for, None, "it swings about a pin");
    let deed = press(None, joined);
    assert_eq!((deed.edit, deed.motor_for), (Some("hinge"), Some(hub)));
    let mut stage = stage();
    give(&mut stage, deed);
    stage.show(&mut seen.0);
    let whole = counts(&stage);
    let hand = hand(Tool::Motor);
    let deed = hand.give_motor(scope(&seen), hub);
    assert_eq!(deed.edit, Some("motor"));
    give(&mut stage, deed);
    stage.show(&mut seen.0);
    assert_eq!(counts(&stage), [3, whole[1]]);
    assert!(hand.give_motor(scope(&seen), hub).is_empty(), "it has one now");
    for (name, left) in [("motor", whole), ("hinge", [0, whole[1] - 1])] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name));
        assert_eq!(counts(&stage), left, "{name}");
    }
    stage.show(&mut seen.0);
    let late = hand.give_motor(scope(&seen), hub);
    assert!(late.is_empty() && late.words.is_some(), "the hinge is gone: {late:?}");
}

#[test]
fn a_motor_is_on_the_ground_only_where_its_wheel_touches_it() {
    for (floor, words) in [("", "pinned to the background"), (FLOOR, "on the ground")] {
        let scene = WHEELS.replace("\"bodies\"", &format!("{floor}\"bodies\""));
        let seen = shown(Scene::parse(&scene, "x.json").unwrap());
        let at = DVec2::from(seen.1.screen_from_world([3.0, -3.0, 0.0].into()).unwrap());
        let before = said(&seen, &hand(Tool::Motor), at);
        assert!(before.contains(words) && before.contains("to the background"), "{before}");
        let deed = hand(Tool::Motor).press(scope(&seen), at);
        assert_eq!(deed.edit, Some("motor"));
        assert!(deed.words.is_some_and(|words| words.starts_with("motor: its axle is pinned to the background")));
    }
}

const FLOOR: &str = r#""obstacles": [{"plane": {"point": [0, -3.5], "normal": [0, 1]}}], "#;

#[test]
fn while_paused_a_body_is_moved_with_the_pins_that_it_hangs_and_turns_on() {
    let mut seen = shown(Scene::parse(WHEELS, "x.json").unwrap());
    let mut stage = stage();
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    let [rim, to, middle] = [at(3.4, -3.1), at(2.4, -2.1), at(3.0, -3.0)];
    give(&mut stage, hand(Tool::Motor).press(scope(&seen), middle));
    stage.show(&mut seen.0);
    let count = seen.0.point_count();
    assert_eq!(seen.0.scenery.pinned.len(), 2);
    let before: Vec<[f64; 3]> = (0..count).map(|point| seen.0.place(point)).collect();
    let mut hand = Hand::default();
    hand.stand_still(true);
    // On its axle as well as on its rim.
    assert!(hand.press(scope(&seen), middle).is_empty() && hand.is_carrying());
    hand.release(scope(&seen), middle);
    assert!(hand.press(scope(&seen), rim).is_empty());
    assert!(said(&seen, &hand, to).contains("pins move too"));
    let deed = hand.release(scope(&seen), to);
    give(&mut stage, deed);
    stage.show(&mut seen.0);
    let moved = |point: &usize| {
        let [x, y, _] = seen.0.place(*point);
        (x - before[*point][0] + 1.0).abs() < 0.02 && (y - before[*point][1] - 1.0).abs() < 0.02
    };
    let last = scope(&seen).body(PointId(count as u32 - 1));
    assert!(last.len() > 20 && last.iter().all(|point| moved(&point.index())), "its wheel and both pins");
    assert_eq!((0..count).filter(moved).count(), last.len(), "nothing else");
}

/// A light box over two discs, as they are drawn, on a floor; its lower edge lies at `EDGE`.
const CAR: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.5}, "view": {"center": [0, 0], "height": 8},
    "bounds": {"min": [-40, -1], "max": [40, 6], "friction": 0.7},
    "bodies": [{"make": "disc", "radius": 0.4, "spacing": 0.14, "origin": [-0.7, -0.6],
        "material": {"kind": "spring", "stiffness": 125, "damping": 0.75, "mass": 0.5}},
      {"make": "disc", "radius": 0.4, "spacing": 0.14, "origin": [0.7, -0.6],
        "material": {"kind": "spring", "stiffness": 125, "damping": 0.75, "mass": 0.5}},
      {"make": "lattice", "columns": 11, "rows": 4, "spacing": 0.2, "origin": [-1, EDGE],
        "material": {"kind": "spring", "stiffness": 300, "damping": 2, "mass": 1.2}}]}"#;

/// Wheels whose middles lie on the edge of the box and below it carry it as well.
#[test]
fn a_box_on_two_discs_with_motors_drives_and_stays_upright() {
    for (edge, is_later) in [(-0.6, false), (-0.5, false), (-0.4, false), (-0.4, true)] {
        let mut car: serde_json::Value = serde_json::from_str(&CAR.replace("EDGE", &edge.to_string())).unwrap();
        if is_later {
            // The box is drawn first.
            car["bodies"].as_array_mut().unwrap().rotate_right(1);
        }
        let mut seen = shown(Scene::parse(&car.to_string(), "x.json").unwrap());
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let mut hand = hand(Tool::Motor);
        hand.drives.motor.is_on = (!is_later).then_some(true);
        let mut click = |stage: &mut Stage, words: &str, hubs: Option<usize>| {
            stage.show(&mut seen.0);
            for (k, x) in [-0.7, 0.7].into_iter().enumerate() {
                let place = hubs.map_or([x, -0.85, 0.0], |first| seen.0.place(first + k));
                let at = DVec2::from(seen.1.screen_from_world(place.into()).unwrap());
                let says = said(&seen, &hand, at);
                assert!(says.contains(words), "{says}");
                give(stage, hand.press(scope(&seen), at));
                stage.show(&mut seen.0);
            }
            seen.0.point_count()
        };
        let hubs = click(&mut stage, "joins both bodies", None) - 2;
        let first = if is_later { 0 } else { hubs - 44 };
        if is_later {
            // The wheels are round no more under what they carry, and turn all the same.
            for _ in 0..60 {
                stage.obey(Order::Step(None));
            }
            click(&mut stage, "gives it a motor", Some(hubs));
        }
        let place = |stage: &Stage, k: usize| {
            DVec2::from([0, 1].map(|axis| stage.history().world().positions().get(2 * k + axis)))
        };
        let mut tilt = 0.0_f64;
        for _ in 0..180 {
            stage.obey(Order::Step(None));
            let along = place(&stage, first + 10) - place(&stage, first);
            tilt = tilt.max(along.to_angle().abs());
        }
        let [far, low] = [place(&stage, first).x + 1.0, edge - place(&stage, first).y];
        let is_carried = tilt < 0.3 && far > 3.0 && low < 0.2;
        assert!(is_carried, "{edge}: it tilts by {tilt} rad, drives {far} m in 3 s and hangs {low} m lower");
    }
}

#[test]
fn the_hubs_of_a_car_are_no_part_of_its_name() {
    let mut seen = shown(Scene::parse(&CAR.replace("EDGE", "-0.5"), "x.json").unwrap());
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    for x in [-0.7, 0.7] {
        let at = DVec2::from(seen.1.screen_from_world([x, -0.85, 0.0].into()).unwrap());
        give(&mut stage, hand(Tool::Motor).press(scope(&seen), at));
        stage.show(&mut seen.0);
    }
    let points = (0..seen.0.point_count() as u32).map(PointId).collect();
    stage.obey(Order::Inspect(Among { points, ..Among::default() }));
    stage.show(&mut seen.0);
    let name = seen.0.matter.as_ref().unwrap().name.clone().unwrap();
    assert!(name.starts_with("2 discs and ") && !name.contains("net") && !name.contains("point"), "{name}");
}

#[test]
fn a_click_on_a_wheel_that_is_squashed_or_off_its_hub_takes_the_hub_that_is_there() {
    let seen = shown(Scene::parse(WHEELS, "x.json").unwrap());
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    let mut stage = stage();
    give(&mut stage, hand(Tool::Motor).press(scope(&seen), at(3.0, -3.0)));
    let hub = stage.history().world().pinned()[0];
    // The wheel is pressed flat, and goes a quarter of its radius to the side of its hub.
    let wheel: Vec<u32> = (0..seen.0.point_count() as u32)
        .filter(|&k| DVec2::new(seen.0.place(k as usize)[0] - 3.0, seen.0.place(k as usize)[1] + 3.0).length() < 0.51)
        .collect();
    let keys = crate::history::MoveKeys {
        points: wheel,
        by: Some(crate::scene::Vector::Plane([0.12, 0.0])),
        scale: Some(crate::history::Factors::Each([1.15, 0.75])),
        ..Default::default()
    };
    assert_eq!(stage.obey(Order::Give(vec![Do::Move(Box::new(keys))], Some("move"))), None);
    let mut squashed = Shown::default();
    stage.show(&mut squashed);
    let seen = (squashed, seen.1, seen.2);
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    for [x, y] in [[3.12, -3.0], [3.0, -3.0], [3.25, -2.9], [2.95, -3.12]] {
        let deed = hand(Tool::Motor).press(scope(&seen), at(x, y));
        let adds = deed.commands.iter().any(|act| matches!(act, Do::Add(keys) if !keys.bonds.is_empty()));
        assert!(deed.edit == Some("motor off") && !adds, "at {x} {y}: {deed:?}");
        let mut away = hand(Tool::Motor);
        away.hold([true, false]);
        let deed = away.press(scope(&seen), at(x, y));
        assert!(matches!(&deed.commands[..], [Do::Delete(keys)] if keys.points.contains(&hub.0)), "{deed:?}");
    }
}

#[test]
fn a_car_that_the_tools_build_stays_where_it_is_on_level_ground() {
    use crate::app::action::Primitive;
    let yard = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.5}, "view": {"center": [0, 2], "height": 8},
        "bounds": {"min": [-6, 0], "max": [6, 6], "friction": 0.5}}"#;
    let mut seen = shown(Scene::parse(yard, "x.json").unwrap());
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let at = |seen: &(Shown, Camera, Scene), x: f64, y: f64| {
        DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap())
    };
    let mut middle = Vec::new();
    // A box over two discs, each drawn from its middle; then hinges.
    for (primitive, from, to) in [
        (Primitive::Box, [0.0, 0.8], [1.5, 1.1]),
        (Primitive::Disc, [-1.0, 0.5], [-0.5, 0.5]),
        (Primitive::Disc, [1.0, 0.5], [1.5, 0.5]),
    ] {
        let mut hand = hand(Tool::Build);
        hand.choose(primitive);
        hand.hold([false, true]);
        hand.press(scope(&seen), at(&seen, from[0], from[1]));
        let deed = hand.release(scope(&seen), at(&seen, to[0], to[1]));
        give(&mut stage, deed);
        stage.show(&mut seen.0);
        middle.push(from);
    }
    for wheel in &middle[1..] {
        let deed = hand(Tool::Motor).press(scope(&seen), at(&seen, wheel[0], wheel[1]));
        assert_eq!(deed.edit, Some("hinge"));
        give(&mut stage, deed);
        stage.show(&mut seen.0);
    }
    let place = |stage: &Stage| {
        let world = stage.history().world();
        (0..world.point_count()).map(|k| world.positions().get(2 * k)).sum::<f64>() / world.point_count() as f64
    };
    let from = place(&stage);
    let mut most = 0.0_f64;
    for _ in 0..600 {
        stage.obey(Order::Step(None));
        most = most.max((place(&stage) - from).abs());
    }
    assert!(most < 0.03, "it creeps {most} m in 10 s");
}

#[test]
fn a_hinge_joins_a_body_to_a_wheel_only_where_the_click_lies_on_both() {
    // A plank whose right end lies over a wheel: its rim crosses the plank's middle at 0.61 m.
    let text = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 10},
        "bodies": [{"make": "lattice", "columns": 17, "rows": 5, "spacing": 0.125, "origin": [-1, -0.25],
            "material": {"kind": "rigid", "mass": 2}},
          {"make": "disc", "radius": 0.4, "spacing": 0.15, "origin": [1, 0],
            "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 1}}]}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let metres = 1.0 / scope(&seen).camera.pixels_per_metre();
    for (x, joins) in [(0.6 - 13.0 * metres, false), (0.6 - 6.0 * metres, false), (0.7, true)] {
        let at = DVec2::from(seen.1.screen_from_world([x, 0.0, 0.0].into()).unwrap());
        let said = said(&seen, &hand(Tool::Motor), at);
        assert_eq!(said.contains("joins both bodies"), joins, "at {x}: {said}");
    }
}

/// Two boxes that overlap, and a disc on the first.
const ARM: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 10},
    "bodies": [{"make": "lattice", "columns": 9, "rows": 4, "spacing": 0.25, "origin": [-2, 0],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 2}},
      {"make": "lattice", "columns": 9, "rows": 4, "spacing": 0.25, "origin": [-0.6, 0.1],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 2}},
      {"make": "disc", "radius": 0.9, "spacing": 0.3, "origin": [-2, 0],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 10, "mass": 2}}]}"#;

#[test]
fn two_bodies_that_are_hinged_get_no_second_hinge_that_would_lock_them() {
    let mut seen = shown(Scene::parse(ARM, "x.json").unwrap());
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let at = |seen: &(Shown, Camera, Scene), [x, y]: [f64; 2]| {
        DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap())
    };
    let mut click = |seen: &mut (Shown, Camera, Scene), hand: &mut Hand, place: [f64; 2]| {
        let pixel = at(seen, place);
        let said = said(seen, hand, pixel);
        let deed = hand.press(scope(seen), pixel);
        let told = (deed.edit, deed.words.clone().unwrap_or_default());
        if !deed.is_empty() {
            give(&mut stage, deed);
            stage.show(&mut seen.0);
        }
        (said, told)
    };
    let mut hand = hand(Tool::Motor);
    let (said, (edit, _)) = click(&mut seen, &mut hand, [-0.4, 0.6]);
    assert!(said.contains("joins both bodies") && edit == Some("hinge"), "{said}");
    let elsewhere = [-0.1, 0.2];
    let (said, (edit, words)) = click(&mut seen, &mut hand, elsewhere);
    assert!(said.starts_with("these two are hinged already") && said == words && edit.is_none(), "{said}");
    hand.hold([true, false]);
    let (_, (edit, _)) = click(&mut seen, &mut hand, elsewhere);
    assert_eq!(edit, Some("hinge away"));
    hand.hold([false, false]);
    let (said, (edit, _)) = click(&mut seen, &mut hand, elsewhere);
    assert!(said.contains("joins both bodies") && edit == Some("hinge"), "{said}");
    // A wheel, wherever it is clicked, on itself or on what holds it, turns about the hub that it has.
    assert_eq!(click(&mut seen, &mut hand, [-2.0, 0.0]).1.0, Some("hinge"));
    for (k, place) in [[-1.5, 0.0], [-1.75, 0.5], [-1.37, 0.13], [-2.0, 0.75]].into_iter().enumerate() {
        let pixel = at(&seen, place);
        assert_eq!(hand.hinge_at(scope(&seen), pixel), Some(k % 2 == 1), "the panel shows what it has");
        let (said, (edit, _)) = click(&mut seen, &mut hand, place);
        assert_eq!(edit, Some(if k % 2 == 0 { "motor" } else { "motor off" }), "{place:?}: {said}");
    }
}

#[test]
fn motors_and_muscles_have_the_wave_and_the_rate_that_are_chosen_and_no_rate_without_a_key() {
    let Drives { muscle, motor } = Drives::default();
    let held = MotorChoice { has_wave: true, period: 2.0, phase: 1.0, key: Some(KeyName::Left), rate: 8.0, ..motor };
    let signal = |drive: AngleDrive| match drive {
        AngleDrive::Motor { signal, .. } => signal,
        other => panic!("{other:?}"),
    };
    let wave = Some(Wave { period: 2.0, phase: 1.0 });
    let by_key = Some(Held { forth: Key::of("left").unwrap(), back: None, rate: 8.0 });
    assert_eq!(signal(held.keys(3.0).told_angle().unwrap()), Signal { wave, held: by_key });
    let alone = MotorChoice { has_wave: false, key: None, ..held };
    assert_eq!(signal(alone.keys(3.0).told_angle().unwrap()), Signal::default());
    let pulled = MuscleChoice { has_wave: false, key: Some(KeyName::Left), rate: 8.0, ..muscle };
    assert_eq!(pulled.keys().told_bond().unwrap().signal, Signal { wave: None, held: by_key });
    assert_eq!(MuscleChoice { key: None, rate: 8.0, ..muscle }.keys().rate, None, "nothing comes and goes");
}
