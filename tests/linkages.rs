//! Rigid bodies in joints, by the rules of `auto`: against other methods that take them bond by bond, and against closed forms.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use serde_json::{Value, json};
use wobble::scene::record::ledgers;
use wobble::sim::{BondId, Command, PointId, Sample, Selection, judge};

use super::pieces::{run, world};

pub(crate) fn apart(one: &Sample, other: &Sample) -> f64 {
    let of = |(a, b): (&[f64; 3], &[f64; 3])| (a[0] - b[0]).hypot(a[1] - b[1]);
    one.position.iter().zip(&other.position).map(of).fold(0.0, f64::max)
}

/// Triangles of 1 kg a point, each at a corner of the one before, pinned at the first.
pub(crate) fn triangles(count: u32) -> Value {
    let (mut position, mut bonds) = (vec![[0.0, 0.0]], Vec::new());
    for k in 0..count {
        let x = f64::from(k);
        position.extend([[x + 0.5, -0.2], [x + 1.0, 0.0]]);
        let from = 2 * k;
        bonds.extend([[from, from + 1], [from + 1, from + 2], [from, from + 2]].map(|[a, b]| json!({"a": a, "b": b})));
    }
    json!({"wobble": 1, "gravity": [0, -9.81], "points": {"position": position, "mass": 1, "pinned": [0]}, "bonds": bonds})
}

/// Where the same scene is by a splitting of order 4 that solves bond by bond.
pub(crate) fn bond_by_bond(scene: &Value, t: f64) -> Sample {
    let mut scene = scene.clone();
    scene["method"] = json!({"solver": "blanes-moan-4", "substep": 0.0005, "budget": "none"});
    let mut world = world(&scene);
    while world.time() < t - 1e-9 {
        world.step();
    }
    world.sample(t)
}

#[test]
fn bodies_in_joints_swing_as_their_bonds_do() {
    let scene = triangles(3);
    let end = run(&mut *world(&scene), 1.0);
    let off = apart(&end, &bond_by_bond(&scene, 1.0));
    assert!(off < 1e-6, "{off}");
}

#[test]
fn a_swing_keeps_its_energy_and_its_lengths() {
    let mut scene = triangles(4);
    scene["method"] = json!({"ledger": true});
    let mut world = world(&scene);
    let start = world.energy();
    let end = run(&mut *world, 10.0);
    let ledger = end.ledger.unwrap();
    assert!(
        (world.energy() - start).abs() < 1e-6 * ledger.most_kinetic,
        "{} of {}",
        world.energy() - start,
        ledger.most_kinetic
    );
    for (bond, (a, b)) in world.bonds().iter().zip(scene["bonds"].as_array().unwrap().iter().map(ends)) {
        let length = (end.position[a][0] - end.position[b][0]).hypot(end.position[a][1] - end.position[b][1]);
        assert!((length / bond.rest_length - 1.0).abs() < 1e-12, "{length}");
    }
}

#[test]
fn a_chain_that_its_heavy_end_whips_keeps_its_energy() {
    let mut scene = triangles(12);
    let mut mass = vec![1.0; 25];
    mass[24] = 100.0;
    let mut velocity = vec![[0.0; 2]; 25];
    velocity[24] = [0.0, -60.0];
    (scene["points"]["mass"], scene["points"]["velocity"]) = (json!(mass), json!(velocity));
    scene["method"] = json!({"ledger": true});
    let mut world = world(&scene);
    let start = world.energy();
    let ledger = run(&mut *world, 4.0).ledger.unwrap();
    let made = (world.energy() - start) / ledger.most_kinetic;
    assert!(made.abs() < 3e-3, "{made} of its motion");
}

fn ends(bond: &Value) -> (usize, usize) {
    let of = |key: &str| bond[key].as_u64().unwrap() as usize;
    (of("a"), of("b"))
}

#[test]
fn in_flight_it_keeps_momentum_and_angular_momentum() {
    let mut scene = triangles(3);
    scene["points"]["pinned"] = json!([]);
    scene["gravity"] = json!([0, 0]);
    scene["points"]["velocity"] = json!([[0, 3], [1, 0], [0, -1], [0, 0], [2, 2], [0, 1], [0, -4]]);
    let mut world = world(&scene);
    let sums = |sample: &Sample| {
        let of = |(x, v): (&[f64; 3], &[f64; 3])| [v[0], v[1], x[0] * v[1] - x[1] * v[0]];
        let all = sample.position.iter().zip(&sample.velocity).map(of);
        all.fold([0.0; 3], |sum, one| [0, 1, 2].map(|k| sum[k] + one[k]))
    };
    let before = sums(&world.sample(0.0));
    let after = sums(&run(&mut *world, 5.0));
    for (before, after) in before.iter().zip(after) {
        assert!((before - after).abs() < 1e-10, "{before} {after}");
    }
}

#[test]
fn what_two_pins_hold_stands_still_and_bears_what_hangs_on_it() {
    // A braced square at two pins, and a triangle at its lower corner.
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[0, 0], [1, 0], [1, 1], [0, 1], [1.5, -0.5], [0.5, -0.8]], "mass": 1, "pinned": [2, 3]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2},
            {"a": 1, "b": 4}, {"a": 4, "b": 5}, {"a": 5, "b": 1}]});
    let mut world = world(&scene);
    let start = world.sample(0.0);
    let end = run(&mut *world, 2.0);
    for k in 0..4 {
        let moved = (start.position[k][0] - end.position[k][0]).hypot(start.position[k][1] - end.position[k][1]);
        assert!(moved < 1e-15 && end.velocity[k] == [0.0; 3], "{moved}");
    }
    let off = apart(&end, &bond_by_bond(&scene, 2.0));
    assert!(off < 1e-6, "{off}");
    // Let go at one pin it swings about the other one.
    world.apply(&Command::Unpin(vec![PointId(2)])).unwrap();
    let end = run(&mut *world, 2.3);
    assert!(end.position[2][1] < 0.9 && end.position[3] == start.position[3], "{:?}", end.position);
}

/// Two boxes that share an edge's lower corner, on a floor.
fn two_boxes(speed: f64, friction: f64, restitution: f64, height: f64) -> Value {
    let position = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.0], [2.0, 1.0], [1.2, 1.0]]
        .map(|[x, y]| [x, y + height]);
    let bonds = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 4], [4, 5], [5, 6], [6, 1], [4, 6]];
    json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": position, "velocity": vec![[speed, 0.0]; 7], "mass": 1},
        "bonds": bonds.map(|[a, b]| json!({"a": a, "b": b})),
        "bounds": {"min": [-90, 0], "max": [90, 90], "friction": friction, "restitution": restitution}})
}

#[test]
fn what_slides_in_joints_stops_after_v_square_over_2_mu_g() {
    let expected = 1.0 / (2.0 * 0.3 * 9.81);
    let mut world = world(&two_boxes(1.0, 0.3, 0.0, 0.0));
    let end = run(&mut *world, 2.0);
    assert!((end.position[0][0] - expected).abs() < 1e-8, "{} {expected}", end.position[0][0]);
    assert!(end.velocity.iter().flatten().all(|v| v.abs() < 1e-9));
}

#[test]
fn bounces_in_joints_neither_gain_nor_lose() {
    let mut scene = two_boxes(0.7, 0.0, 1.0, 1.0);
    scene["bounds"]["max"] = json!([90, 5]);
    let mut world = world(&scene);
    let (start, mut bounces) = (world.energy(), 0);
    while bounces < 20 && world.time() < 30.0 {
        world.step();
        bounces = world.counters().events;
    }
    let gain = world.energy() / start - 1.0;
    assert!(bounces >= 20 && gain.abs() < 1e-9, "{gain} after {bounces} bounces");
}

#[test]
fn no_energy_comes_from_nowhere_where_joints_meet_the_ground() {
    for (friction, restitution) in [(0.1, 0.2), (0.5, 0.3), (2.0, 0.9)] {
        let mut scene = triangles(6);
        scene["points"]["pinned"] = json!([]);
        scene["method"] = json!({"ledger": true});
        scene["bounds"] = json!({"min": [-90, -2], "max": [90, 90], "friction": friction, "restitution": restitution});
        let mut world = world(&scene);
        let list = ledgers(&mut *world, 4.0).unwrap();
        assert!(judge(&list).gain.abs() < 1e-3, "{friction} {restitution}: {:?}", judge(&list));
        let end = world.sample(4.0);
        assert!(end.position.iter().all(|x| x[1] > -2.0 - 1e-9), "{:?}", end.position);
    }
}

#[test]
fn springs_and_angles_between_bodies_are_those_of_other_methods() {
    let mut scene = triangles(3);
    let bonds = scene["bonds"].as_array_mut().unwrap();
    bonds.push(json!({"a": 1, "b": 3, "kind": "spring", "stiffness": 80, "damping": 0.5}));
    bonds.push(json!({"a": 0, "b": 1, "kind": "spring", "stiffness": 500, "rest": 0.9}));
    scene["angles"] =
        json!([{"points": [3, 4, 5], "stiffness": 4, "damping": 0.1}, {"points": [1, 2, 3], "stiffness": 9}]);
    let end = run(&mut *world(&scene), 1.0);
    let off = apart(&end, &bond_by_bond(&scene, 1.0));
    assert!(off < 1e-4, "{off}");
}

#[test]
fn what_is_cut_off_goes_on_by_itself() {
    let mut scene = triangles(3);
    scene["bonds"].as_array_mut().unwrap().push(json!({"a": 0, "b": 7}));
    scene["points"]["position"].as_array_mut().unwrap().push(json!([-0.6, 0.0]));
    let mut world = world(&scene);
    while world.time() < 0.5 - 1e-9 {
        world.step();
    }
    let selection = Selection { bonds: vec![BondId(9)], ..Selection::default() };
    world.apply(&Command::Delete(selection)).unwrap();
    let before = world.sample(0.5);
    while world.time() < 0.75 - 1e-9 {
        world.step();
    }
    let end = world.sample(0.75);
    let fall = 0.25 * before.velocity[7][1] - 0.5 * 9.81 * 0.0625;
    assert!((end.position[7][1] - before.position[7][1] - fall).abs() < 1e-9);
}

#[test]
fn friction_at_one_end_of_a_rod_is_a_share_of_what_presses_there() {
    // 1 kg on the floor, 5 kg straight above it on a rod whose foot a wall holds from behind: nothing moves but along the floor.
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[0, 0], [1, 0], [0.5, 1]], "velocity": [[2, 0], [2, 0], [2, 0]], "mass": [1, 1, 5]},
        "bonds": [{"a": 0, "b": 2}, {"a": 1, "b": 2}, {"a": 0, "b": 1, "kind": "spring", "stiffness": 1e-9}],
        "angles": [{"points": [0, 2, 1], "stiffness": 2e4, "damping": 200}],
        "bounds": {"min": [-90, 0], "max": [90, 90], "friction": 0.4}});
    let mut world = world(&scene);
    let end = run(&mut *world, 2.0);
    let expected = 4.0 / (2.0 * 0.4 * 9.81);
    assert!((end.position[2][0] - 0.5 - expected).abs() < 1e-3, "{} {expected}", end.position[2][0] - 0.5);
}

#[test]
fn a_light_point_on_a_heavy_one_rubs_by_its_load_in_an_impact() {
    // A rod upright that falls on its foot at 30 degrees to the floor: by Coulomb's law with the rod's inertia at the foot.
    let (mu, m): (f64, f64) = (0.2, 2.0);
    let (c, s) = (0.5_f64, 0.75_f64.sqrt());
    let scene = json!({"wobble": 1, "gravity": [0, 0],
        "points": {"position": [[0, 1], [c, 1.0 + s]], "velocity": [[3, -4], [3, -4]], "mass": m},
        "bonds": [{"a": 0, "b": 1}],
        "bounds": {"min": [-90, 0], "max": [90, 90], "friction": mu}});
    let end = run(&mut *world(&scene), 0.3);
    // Of a rod of two points the middle is at r = (c, s)/2 from the foot, its mass 2 m and its inertia m/2.
    let (ease, swing, r) = (1.0 / (2.0 * m), 2.0 / m, [-0.5 * c, -0.5 * s]);
    let lever = |n: [f64; 2]| r[0] * n[1] - r[1] * n[0];
    let (normal, along) = (lever([0.0, 1.0]), lever([1.0, 0.0]));
    let across = ease + swing * normal * normal - mu * swing * normal * along;
    let push = 4.0 / across;
    let spin = swing * push * (normal - mu * along);
    let expected = [3.0 - mu * push * ease, -4.0 + push * ease];
    let middle = [0, 1].map(|k| 0.5 * (end.velocity[0][k] + end.velocity[1][k]));
    for k in 0..2 {
        assert!((middle[k] - expected[k]).abs() < 1e-9, "{middle:?} {expected:?}");
    }
    let d = [0, 1].map(|k| end.position[1][k] - end.position[0][k]);
    let v = [0, 1].map(|k| end.velocity[1][k] - end.velocity[0][k]);
    assert!((d[0] * v[1] - d[1] * v[0] - spin).abs() < 1e-9);
}

#[test]
fn pins_that_are_led_take_bodies_along_and_their_work_is_told() {
    let mut scene = triangles(2);
    scene["pin_motion"] = json!([{"point": 0, "track": [[0, 0, 0], [0.5, 0.4, 0.1], [1, 0.4, 0.5]]}]);
    scene["method"] = json!({"ledger": true});
    let mut world = world(&scene);
    let end = run(&mut *world, 0.9);
    assert!((end.position[0][1] - 0.42).abs() < 1e-12);
    let off = apart(&end, &bond_by_bond(&scene, 0.9));
    assert!(off < 1e-5, "{off}");
    let ledger = end.ledger.unwrap();
    assert!(ledger.left_over().abs() < 1e-2 * ledger.most_kinetic, "{ledger:?}");
}

#[test]
fn angles_and_springs_at_led_pins_are_in_their_work() {
    let mut scene = triangles(2);
    scene["points"]["position"].as_array_mut().unwrap().push(json!([2.0, 1.0]));
    scene["points"]["pinned"] = json!([0, 5]);
    let spring = json!({"a": 5, "b": 4, "kind": "spring", "stiffness": 40, "damping": 2, "rest": 0.5});
    scene["bonds"].as_array_mut().unwrap().push(spring);
    scene["angles"] = json!([{"points": [0, 2, 4], "stiffness": 3, "damping": 0.5}]);
    let there = json!([[0, 0, 0], [1, 0.4, 0.3]]);
    scene["pin_motion"] = json!([{"point": 0, "track": there}, {"point": 5, "track": [[0, 2, 1], [1, 2.6, 0.8]]}]);
    scene["method"] = json!({"ledger": true});
    let ledger = run(&mut *world(&scene), 0.9).ledger.unwrap();
    assert!(ledger.book.pins.abs() > 1.0 && ledger.book.dampers > 0.1, "{ledger:?}");
    assert!(ledger.left_over().abs() < 1e-3 * ledger.most_kinetic, "{ledger:?}");
}

/// Three parallel bars of 1 m between pins and a triangle, at 1 rad to the pins' side, turning at 8 rad/s: one bar more than it takes, and through its
/// dead points.
#[test]
fn bars_in_parallel_go_through_their_dead_points() {
    let pins = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.5]];
    let (c, s) = (1.0_f64.cos(), 1.0_f64.sin());
    let position: Vec<[f64; 2]> = pins.into_iter().chain(pins.map(|[x, y]| [x + c, y + s])).collect();
    let velocity: Vec<[f64; 2]> = (0..6).map(|k| if k < 3 { [0.0; 2] } else { [-8.0 * s, 8.0 * c] }).collect();
    let bonds = [[3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": position, "velocity": velocity, "mass": 1, "pinned": [0, 1, 2]},
        "bonds": bonds.map(|[a, b]| json!({"a": a, "b": b}))});
    let mut linkage = world(&scene);
    let end = run(&mut *linkage, 2.0);
    // Each point goes around its pin as a pendulum of 1 m does.
    let one = json!({"wobble": 1, "gravity": [0, -9.81], "method": {"solver": "blanes-moan-6", "substep": 0.0005},
        "points": {"position": [[0, 0], [c, s]], "velocity": [[0, 0], [-8.0 * s, 8.0 * c]], "mass": 1, "pinned": [0]},
        "bonds": [{"a": 0, "b": 1}]});
    let mut pendulum = world(&one);
    while pendulum.time() < 2.0 - 1e-9 {
        pendulum.step();
    }
    let expected = pendulum.sample(2.0).position[1];
    let off = (end.position[3][0] - expected[0]).hypot(end.position[3][1] - expected[1]);
    assert!(off < 1e-4, "{off}");
}

/// Two legs of 1 m at 0.3 rad from upright, light feet and a heavy top: friction that is a little more than it takes holds them where they are.
#[test]
fn feet_that_friction_holds_do_not_creep_under_a_heavy_load() {
    let (c, s) = (0.3_f64.cos(), 0.3_f64.sin());
    let (foot, top) = (0.1, 10.0);
    // What presses on a foot, and what pushes it out.
    let (press, push) = ((0.5 * top + foot) * 9.81, 0.5 * top * 9.81 * s / c);
    for share in [1.02, 2.0] {
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": {"sleep": false},
            "points": {"position": [[-s, 0], [s, 0], [0, c]], "mass": [foot, foot, top]},
            "bonds": [{"a": 0, "b": 2}, {"a": 1, "b": 2}],
            "bounds": {"min": [-9, 0], "max": [9, 9], "friction": share * push / press}});
        let end = run(&mut *world(&scene), 3.0);
        assert!((end.position[2][1] - c).abs() < 1e-8, "{share}: {}", c - end.position[2][1]);
    }
}
