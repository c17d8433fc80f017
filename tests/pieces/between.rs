//! Bonds between rigid bodies that may break, act on one side only, or are driven: they leave the bodies what they are.

use std::f64::consts::PI;

use serde_json::{Value, json};
use wobble::sim::{Dynamics, Sample, Solver};

use super::{run, world};
use crate::linkages::{apart, bond_by_bond};

/// Two triangles of 1 kg a point and a bond with these keys from a corner of one to a corner of the other, 0.5 m apart; the first hangs on a pin.
fn swinging(keys: &Value) -> Value {
    let mut bond = json!({"a": 1, "b": 3});
    bond.as_object_mut().unwrap().extend(keys.as_object().unwrap().clone());
    let sides = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3]].map(|[a, b]| json!({"a": a, "b": b}));
    json!({"wobble": 1, "gravity": [0, -9.81], "method": {"ledger": true},
        "points": {"position": [[0, 0], [1, 0], [0.4, 0.8], [1.5, 0], [2.5, 0.1], [2.1, 0.9]], "mass": 1, "pinned": [0]},
        "bonds": sides.into_iter().chain([bond]).collect::<Vec<_>>()})
}

/// Two triangles of 1 kg a point that look at each other along x, their corners at 0 and 1 m, and a bond with these keys between those.
fn in_line(velocity: [f64; 2], keys: &Value) -> Value {
    let mut scene = swinging(keys);
    scene["gravity"] = json!([0, 0]);
    let [left, right] = velocity;
    scene["points"] = json!({"position": [[-1, 0.5], [0, 0], [-1, -0.5], [1, 0], [2, 0.5], [2, -0.5]], "mass": 1,
        "velocity": [[left, 0], [left, 0], [left, 0], [right, 0], [right, 0], [right, 0]]});
    scene
}

fn assert_told(what: &str, world: &dyn Dynamics, end: &Sample, most: f64) {
    let ledger = end.ledger.as_ref().unwrap();
    let left = ledger.left_over() / ledger.most_kinetic;
    assert!(left.abs() < most, "{what}: {left} of the motion at {} s, {ledger:?}", world.time());
}

fn far(sample: &Sample, [a, b]: [usize; 2]) -> f64 {
    let [a, b] = [a, b].map(|point| sample.position[point]);
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[test]
fn a_rod_that_may_break_joins_bodies_as_any_other_does() {
    let plain = run(&mut *world(&swinging(&json!({}))), 2.0);
    let fragile = run(&mut *world(&swinging(&json!({"break_strain": 0.1}))), 2.0);
    assert_eq!(plain.position, fragile.position);
}

#[test]
fn a_spring_between_bodies_breaks_at_its_length_and_the_load_falls() {
    // 3 kg on a spring from a pin straight above: x = x0 (1 - cos(omega t)) below its length at rest.
    let (stiffness, strain, g): (f64, f64, f64) = (100.0, 0.4, 9.81);
    let spring = json!({"a": 0, "b": 1, "kind": "spring", "stiffness": stiffness, "break_strain": strain});
    let scene = json!({"wobble": 1, "gravity": [0, -g], "method": {"ledger": true},
        "points": {"position": [[0, 1], [0, 0], [-0.5, -0.5], [0.5, -0.5]], "mass": 1, "pinned": [0]},
        "bonds": [{"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 1}, spring]});
    let mut world = world(&scene);
    let end = run(&mut *world, 0.6);
    let (omega, reach) = ((stiffness / 3.0).sqrt(), 3.0 * g / stiffness);
    let turned = (1.0 - strain / reach).acos();
    let (gone, speed) = (turned / omega, reach * omega * turned.sin());
    let left = 0.6 - gone;
    let y = -strain - speed * left - 0.5 * g * left * left;
    assert!((end.position[1][1] - y).abs() < 1e-6, "{} {y}", end.position[1][1]);
    let ledger = end.ledger.unwrap();
    let stored = 0.5 * stiffness * strain * strain;
    assert!((ledger.book.breaks - stored).abs() < 1e-6, "{} {stored}", ledger.book.breaks);
    assert_told("a spring that breaks", &*world, &end, 1e-6);
}

#[test]
fn what_lands_between_breaks_breaks_at_the_same_moment_as_bond_by_bond() {
    for strain in [0.2, 0.45] {
        let scene = swinging(&json!({"kind": "spring", "stiffness": 150, "damping": 0.5, "break_strain": strain}));
        let mut world = world(&scene);
        let end = run(&mut *world, 1.0);
        assert!(far(&end, [1, 3]) > 0.5 * (1.0 + strain), "it broke");
        let off = apart(&end, &bond_by_bond(&scene, 1.0));
        assert!(off < 1e-4, "{strain}: {off}");
    }
}

#[test]
fn a_string_that_gets_taut_gives_both_bodies_one_speed() {
    let scene = in_line([0.0, 1.0], &json!({"limit": "max", "rest": 1.5}));
    let mut world = world(&scene);
    let end = run(&mut *world, 2.0);
    // Taut after 0.5 s, then both go at half the speed.
    for (point, x) in [(1, 0.75), (3, 2.25)] {
        assert!((end.position[point][0] - x).abs() < 1e-9, "{} {x}", end.position[point][0]);
        assert!((end.velocity[point][0] - 0.5).abs() < 1e-9);
    }
    // Of 3 kg at 1 m/s half is lost.
    let lost = end.ledger.unwrap().book.impacts;
    assert!((lost - 0.75).abs() < 1e-9, "{lost}");
    assert_told("a jerk", &*world, &end, 1e-9);
}

#[test]
fn a_strut_stops_what_comes_near_and_lets_it_go() {
    let strut = json!({"limit": "min", "rest": 0.6});
    let end = run(&mut *world(&in_line([1.0, 0.0], &strut)), 1.0);
    // Met after 0.4 s.
    assert!((far(&end, [1, 3]) - 0.6).abs() < 1e-9 && (end.velocity[1][0] - 0.5).abs() < 1e-9);
    let end = run(&mut *world(&in_line([-1.0, 0.0], &strut)), 1.0);
    assert!((far(&end, [1, 3]) - 2.0).abs() < 1e-9);
}

#[test]
fn strings_and_struts_between_swinging_bodies_are_those_of_other_methods() {
    for (keys, t) in [
        (json!({"limit": "max"}), 1.5),
        (json!({"limit": "max", "rest": 0.8}), 1.5),
        (json!({"limit": "min"}), 1.0),
        (json!({"limit": "min", "rest": 0.3}), 1.0),
    ] {
        let mut scene = swinging(&keys);
        // What hangs on a taut string moves by order 2.
        scene["method"]["substep"] = json!(1.0 / 480.0);
        let mut world = world(&scene);
        let end = run(&mut *world, t);
        let off = apart(&end, &bond_by_bond(&scene, t));
        assert!(off < 1e-6, "{keys}: {off}");
        let rest = keys.get("rest").map_or(0.5, |rest| rest.as_f64().unwrap());
        let over = far(&end, [1, 3]) - rest;
        assert!(if keys["limit"] == "max" { over < 1e-9 } else { over > -1e-9 }, "{keys}: {over}");
        assert_told(&keys.to_string(), &*world, &end, 1e-5);
    }
}

#[test]
fn a_string_to_a_pin_that_is_led_pulls_a_body_along_and_its_work_is_told() {
    // Slack for 0.5 s, then 3 kg go along with it.
    let scene = json!({"wobble": 1, "gravity": [0, 0], "method": {"ledger": true},
        "points": {"position": [[1, 0], [0, 0], [-1, 0.5], [-1, -0.5]], "mass": 1, "pinned": [0]},
        "bonds": [{"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 1}, {"a": 0, "b": 1, "limit": "max", "rest": 2}],
        "pin_motion": [{"point": 0, "track": [[0, 1, 0], [2, 5, 0]]}]});
    let mut world = world(&scene);
    let end = run(&mut *world, 1.5);
    assert!((end.position[1][0] - 2.0).abs() < 1e-9 && (end.velocity[1][0] - 2.0).abs() < 1e-9, "{:?}", end.position);
    // Half of what the pin does is motion, the other half is lost in the jerk.
    let book = end.ledger.unwrap().book;
    assert!((book.pins - 12.0).abs() < 1e-6 && (book.impacts - 6.0).abs() < 1e-6, "{book:?}");
}

#[test]
fn a_driven_rod_between_bodies_is_as_long_as_its_drive_says_and_keeps_their_momentum() {
    let (amplitude, period) = (0.4, 0.8);
    let drive = json!({"drive": {"amplitude": amplitude, "period": period}});
    let mut line = world(&in_line([0.0, 0.0], &drive));
    for t in [0.3, 0.7, 1.3] {
        let end = run(&mut *line, t);
        let longer = amplitude * (2.0 * PI * t / period).sin();
        // Both are as heavy: each goes half of the way.
        for (point, x) in [(1, -0.5 * longer), (3, 1.0 + 0.5 * longer)] {
            assert!((end.position[point][0] - x).abs() < 1e-9, "{t}: {} {x}", end.position[point][0]);
        }
        assert_told("a drive", &*line, &end, 1e-3);
    }
    let mut scene = swinging(&drive);
    (scene["gravity"], scene["points"]["pinned"]) = (json!([0, 0]), json!([]));
    scene["points"]["velocity"] = json!([[0, 1], [1, 0], [0, -1], [-1, 0], [1, 1], [0, 1]]);
    let sums = |sample: &Sample| {
        let of = |(x, v): (&[f64; 3], &[f64; 3])| [v[0], v[1], x[0] * v[1] - x[1] * v[0]];
        let all = sample.position.iter().zip(&sample.velocity).map(of);
        all.fold([0.0; 3], |sum, one| [0, 1, 2].map(|k| sum[k] + one[k]))
    };
    let mut world = world(&scene);
    let before = sums(&world.sample(0.0));
    let end = run(&mut *world, 1.9);
    for (before, after) in before.iter().zip(sums(&end)) {
        assert!((before - after).abs() < 1e-9, "{before} {after}");
    }
    let rest = 0.5 * (1.0 + amplitude * (2.0 * PI * 1.9 / period).sin());
    assert!((far(&end, [1, 3]) - rest).abs() < 1e-9);
    assert_told("a drive in flight", &*world, &end, 1e-3);
}

#[test]
fn a_driven_rod_between_swinging_bodies_has_its_work_told() {
    let scene = swinging(&json!({"drive": {"amplitude": 0.3, "period": 0.7, "phase": 1}}));
    let mut world = world(&scene);
    let end = run(&mut *world, 2.0);
    let rest = 0.5 * (1.0 + 0.3 * (2.0 * PI * 2.0 / 0.7 + 1.0).sin());
    assert!((far(&end, [1, 3]) - rest).abs() < 1e-9, "{} {rest}", far(&end, [1, 3]));
    assert!(end.ledger.as_ref().unwrap().book.drives.abs() > 1.0);
    assert_told("a drive that swings", &*world, &end, 1e-3);
}

#[test]
fn motors_and_servos_between_bodies_are_those_of_other_methods() {
    for angle in [
        json!({"points": [0, 1, 4], "drive": {"speed": 3, "torque": 20}}),
        json!({"points": [0, 1, 4], "stiffness": 300, "damping": 3, "drive": {"amplitude": 0.8, "period": 1.3}}),
    ] {
        let mut scene = swinging(&json!({}));
        scene["angles"] = json!([angle]);
        scene["method"]["substep"] = json!(1.0 / 480.0);
        let end = run(&mut *world(&scene), 0.6);
        scene["method"] = json!({"solver": "rk4", "substep": 0.0005, "budget": "none"});
        let mut other = world(&scene);
        while other.time() < 0.6 - 1e-9 {
            other.step();
        }
        let off = apart(&end, &other.sample(0.6));
        assert!(off < 2e-4, "{angle}: {off}");
    }
}

#[test]
fn muscles_between_bodies_are_those_of_other_methods_and_their_work_is_told() {
    let scene = swinging(&json!({"kind": "spring", "stiffness": 200, "drive": {"amplitude": 0.4, "period": 0.9}}));
    let mut world = world(&scene);
    let end = run(&mut *world, 1.5);
    let off = apart(&end, &bond_by_bond(&scene, 1.5));
    assert!(off < 1e-5, "{off}");
    assert!(end.ledger.as_ref().unwrap().book.drives.abs() > 1.0);
    assert_told("a muscle", &*world, &end, 1e-4);
}

/// Two triangles with two such bonds from one to the other, of which the second goes its own way.
fn ring(one: &Value, other: &Value) -> Value {
    let mut scene = swinging(one);
    let mut bond = other.clone();
    bond.as_object_mut().unwrap().extend(json!({"a": 2, "b": 5}).as_object().unwrap().clone());
    scene["bonds"].as_array_mut().unwrap().push(bond);
    scene["points"]["velocity"] = json!([[0, 0], [0, 0], [0, 0], [2, 0], [2, 0], [2, 0]]);
    scene
}

#[test]
fn strings_in_a_ring_leave_bodies() {
    let scene = ring(&json!({"limit": "max", "rest": 0.6}), &json!({"limit": "max", "rest": 1.8}));
    let mut world = world(&scene);
    let end = run(&mut *world, 3.0);
    assert!(far(&end, [1, 3]) < 0.6 + 1e-9 && far(&end, [2, 5]) < 1.8 + 1e-9);
    assert_told("strings in a ring", &*world, &end, 1e-5);
}

/// They may be led where they cannot get: bodies were thrown at 1e12 m/s.
#[test]
fn what_drives_join_in_a_ring_is_moved_bond_by_bond() {
    let [one, other] = [0.0, 2.0].map(|phase| json!({"drive": {"amplitude": 0.3, "period": 1, "phase": phase}}));
    let mut world = world(&ring(&one, &other));
    while world.time() < 3.0 - 1e-9 {
        world.step();
    }
    let velocities = world.sample(3.0).velocity;
    let fastest = velocities.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max);
    assert!(fastest > 0.1 && fastest < 50.0, "{one}: {fastest} m/s");
    assert!(world.moved_by().iter().all(|moved| moved.method != Solver::Rigid), "{:?}", world.moved_by());
}
