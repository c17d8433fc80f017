//! Bodies with contact are moved by their own methods until they may meet something, and again when they are apart.

use serde_json::{Value, json};
use wobble::sim::{Addition, Command, Dynamics, MovedBy, Solver, Why};

use super::{bits, run_to, world};
use crate::common::physics::middle;

fn disc(at: [f64; 2], velocity: [f64; 2]) -> Value {
    json!({"make": "disc", "radius": 0.3, "spacing": 0.15, "origin": at, "velocity": velocity,
        "material": {"kind": "spring", "stiffness": 2000, "damping": 0.3, "mass": 1}})
}

fn scene(bodies: Value) -> Value {
    json!({"wobble": 1, "contact": true, "bodies": bodies})
}

/// The one that moves the first point of a body.
fn mover(world: &dyn Dynamics, first: usize) -> MovedBy {
    world.moved_by().into_iter().rfind(|moved| moved.first.index() <= first).unwrap()
}

#[test]
fn what_stays_apart_has_the_bits_that_it_has_without_contact() {
    let bodies = json!([disc([0.0, 0.0], [1.0, 3.0]), disc([3.0, 0.0], [-0.5, 2.0])]);
    let mut with = scene(bodies.clone());
    with["gravity"] = json!([0, -9.81]);
    with["bounds"] = json!({"min": [-5, -1], "max": [5, 5], "restitution": 0.5, "friction": 0.3});
    let mut without = with.clone();
    without["contact"] = json!(false);
    let [mut with, mut without] = [world(&with), world(&without)];
    run_to(&mut *with, 1.0);
    run_to(&mut *without, 1.0);
    assert_eq!(bits(&*with), bits(&*without));
    let counters = with.counters();
    assert_eq!((counters.hand_overs, counters.contacts, counters.detections), (0, 0, 0));
}

/// A crowd, 5 cm from each other, that flies and falls as one.
fn crowd(velocity: [f64; 2]) -> Value {
    let at = |k: usize| [0.65 * (k % 4) as f64, 40.0 + 0.65 * (k / 4) as f64];
    (0..16).map(|k| disc(at(k), velocity)).collect()
}

#[test]
fn a_crowd_that_flies_side_by_side_is_left_alone() {
    for velocity in [[0.0, 0.0], [30.0, -10.0], [200.0, 5.0]] {
        let mut with = scene(crowd(velocity));
        with["gravity"] = json!([0, -9.81]);
        with["drag_rate"] = json!(0.1);
        let mut without = with.clone();
        without["contact"] = json!(false);
        let [mut with, mut without] = [world(&with), world(&without)];
        run_to(&mut *with, 0.5);
        run_to(&mut *without, 0.5);
        assert_eq!((with.counters().hand_overs, with.counters().detections), (0, 0), "at {velocity:?} m/s");
        assert_eq!(bits(&*with), bits(&*without), "at {velocity:?} m/s");
    }
}

/// The live step itself looks for no pairs where nothing may meet.
#[test]
fn what_the_live_step_moves_without_contact_looks_for_nothing() {
    let looked = |contact: bool| {
        let mut scene = scene(json!([disc([0.0, 0.0], [0.0, 0.0]), disc([1.0, 0.0], [0.0, 0.0])]));
        (scene["contact"], scene["method"]) = (json!(contact), json!({"solver": "live"}));
        let mut world = world(&scene);
        run_to(&mut *world, 0.2);
        world.counters().detections
    };
    assert_eq!(looked(false), 0);
    assert!(looked(true) > 0, "with contact one by one is looked at");
}

#[test]
fn who_comes_into_a_crowd_in_flight_is_met() {
    // One that overtakes the last row, and a wall that throws the first column back into those that follow.
    let mut flies = crowd([30.0, 0.0]);
    let last = disc([-1.0, 40.0], [36.0, 0.0]);
    flies.as_array_mut().unwrap().push(last);
    let mut overtaken = scene(flies);
    overtaken["contact"] = json!({"friction": 0.5});
    let mut thrown = scene(crowd([30.0, 0.0]));
    thrown["bounds"] = json!({"min": [-5, 0], "max": [4, 60], "restitution": 0.9});
    for (what, scene) in [("overtaken", overtaken), ("thrown back", thrown)] {
        let mut world = world(&scene);
        let bodies = scene["bodies"].as_array().unwrap().len();
        let count = world.point_count() / bodies;
        let mut nearest = f64::INFINITY;
        while world.time() < 0.4 {
            world.step();
            for one in 0..bodies {
                for other in 0..one {
                    let [a, b] = [one, other].map(|k| middle(&*world, k * count..(k + 1) * count));
                    nearest = nearest.min((a[0] - b[0]).hypot(a[1] - b[1]));
                }
            }
        }
        assert!(world.counters().contacts > 0, "{what}: nothing met");
        // At a wall they are pressed flat, and into each other.
        let least = if what == "overtaken" { 0.45 } else { 1e-3 };
        assert!(nearest > least, "{what}: {nearest} m from middle to middle");
    }
}

#[test]
fn what_is_light_is_thrown_back_by_what_is_heavy_and_meets_what_lies_behind() {
    let boxed = |x: f64, [width, height]: [f64; 2], mass: f64, v: f64| {
        json!({"make": "box", "width": width,
        "height": height, "supports": 2, "origin": [x, 0], "velocity": [v, 0], "material": {"mass": mass}})
    };
    for v in [6.0, 20.0, 60.0] {
        for far in [0.05, 0.2] {
            let heavy = boxed(0.1 + 0.01 + 1.0, [2.0, 1.0], 100.0, 0.0);
            let behind = boxed(-0.1 - far - 0.05, [0.1, 0.5], 1.0, 0.0);
            let mut scene = scene(json!([boxed(0.0, [0.2, 0.2], 0.1, v), heavy, behind]));
            scene["contact"] = json!({"restitution": 0.8, "friction": 0});
            let mut world = world(&scene);
            while world.time() < 0.3 {
                world.step();
                let [light, behind] = [0..4, 8..12].map(|range| middle(&*world, range)[0]);
                assert!(light > behind, "at {v} m/s, {far} m behind: through it at {} s", world.time());
            }
            let pushed = world.sample(world.time()).velocity[8][0];
            assert!(pushed < -0.05 * v, "at {v} m/s, {far} m behind: it is pushed by {pushed} m/s");
        }
    }
}

#[test]
fn what_may_meet_goes_live_together_before_it_touches_and_back_when_it_is_apart() {
    let far = disc([0.0, 20.0], [0.2, 0.0]);
    let bodies = json!([disc([-2.0, 0.0], [2.0, 0.0]), disc([2.0, 0.1], [-2.0, 0.0]), far.clone()]);
    let mut world = world(&scene(bodies));
    let count = world.point_count() / 3;
    let mut met = None;
    while world.time() < 4.0 {
        world.step();
        let movers = world.moved_by();
        if met.is_none() && movers.iter().any(|moved| moved.method == Solver::Live) {
            let way = middle(&*world, count..2 * count)[0] - middle(&*world, 0..count)[0];
            assert!(way > 0.6 && way < 1.0, "{way}");
            assert_eq!(movers.len(), 2, "{movers:?}");
            assert_eq!((movers[0].why, movers[0].count), (Why::Contact, 2 * count));
            assert_eq!((movers[1].why, movers[1].first.index(), movers[1].since), (Why::Plan, 2 * count, 0.0));
            met = Some(movers[0].since);
        }
    }
    assert!(world.counters().contacts > 0);
    let movers = world.moved_by();
    assert!(movers.len() == 3 && movers.iter().all(|moved| moved.why == Why::Plan), "{movers:?}");
    assert!(movers[0].since >= met.unwrap() + 1.0, "{movers:?}");
    assert!(middle(&*world, 0..count)[0] < -0.5 && middle(&*world, count..2 * count)[0] > 0.5);
    // Who met nobody has the bits that it has alone.
    let mut alone = super::world(&scene(json!([far])));
    run_to(&mut *alone, world.time());
    let own = |world: &dyn Dynamics, from: usize| world.sample(world.time()).position[from..].to_vec();
    assert_eq!(own(&*world, 2 * count), own(&*alone, 0));
}

#[test]
fn what_falls_on_itself_goes_live_before_it_crosses() {
    let rope = json!({"make": "rope", "count": 40, "origin": [0, 0.3], "to": [0.02, 3.2],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 0.3, "mass": 0.5}});
    let mut scene = scene(json!([rope]));
    scene["gravity"] = json!([0, -9.81]);
    scene["bounds"] = json!({"min": [-5, 0], "max": [5, 9], "friction": 0.3});
    let mut world = world(&scene);
    let mut was = Vec::new();
    while world.time() < 2.0 {
        world.step();
        was.push(mover(&*world, 0).why);
        if was.ends_with(&[Why::Contact]) {
            break;
        }
        let sample = world.sample(world.time());
        for i in 0..39 {
            for j in i + 2..39 {
                assert!(!cross([i, i + 1, j, j + 1].map(|k| sample.position[k])), "{i} and {j} at {}", world.time());
            }
        }
    }
    assert_eq!(was[0], Why::Plan);
    assert!(was.contains(&Why::Contact));
}

fn cross([a, b, c, d]: [[f64; 3]; 4]) -> bool {
    let turn = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    // What lies in one line does not cross, but for rounding.
    turn(a, b, c) * turn(a, b, d) < -1e-12 && turn(c, d, a) * turn(c, d, b) < -1e-12
}

#[test]
fn corners_of_obstacles_are_met_and_wide_ground_is_not() {
    let cases = [
        ([[-5.0, -1.0], [5.0, -1.0], [5.0, 0.0], [-5.0, 0.0]], Why::Plan),
        ([[-0.1, -1.0], [0.1, -1.0], [0.1, 0.0], [-0.1, 0.0]], Why::Contact),
    ];
    for (polygon, why) in cases {
        let mut scene = scene(json!([disc([0.0, 0.6], [0.0, 0.0])]));
        scene["gravity"] = json!([0, -9.81]);
        scene["obstacles"] = json!([{"polygon": [polygon]}]);
        let mut world = world(&scene);
        assert_eq!(mover(&*world, 0).why, Why::Plan);
        run_to(&mut *world, 0.4);
        assert_eq!(mover(&*world, 0).why, why, "{polygon:?}");
    }
}

#[test]
fn what_lies_on_a_corner_stays_live() {
    let mut scene = scene(json!([disc([0.0, 0.32], [0.0, 0.0])]));
    scene["gravity"] = json!([0, -9.81]);
    scene["contact"] = json!({"friction": 1.0});
    // A trough between two corners that hold the disc.
    scene["obstacles"] = json!([{"polygon": [[[-2, -1], [-0.15, -1], [-0.15, 0], [-2, 0]]]},
        {"polygon": [[[0.15, -1], [2, -1], [2, 0], [0.15, 0]]]}]);
    scene["method"] = json!({"sleep": false});
    let mut world = world(&scene);
    run_to(&mut *world, 3.5);
    assert_eq!((mover(&*world, 0).why, world.counters().hand_overs, world.counters().returns), (Why::Contact, 1, 0));
}

#[test]
fn what_is_pinned_all_over_is_met() {
    // Twenty pinned points are ground for what falls on them; nothing of it can move.
    let ground = json!({"make": "lattice", "columns": 10, "rows": 2, "spacing": 0.2, "origin": [-0.9, -0.2],
        "pinned": (0..20).collect::<Vec<u32>>(), "material": {"kind": "spring", "stiffness": 1000}});
    let mut scene = scene(json!([ground, disc([0.0, 1.0], [0.0, 0.0]), disc([9.0, 1.0], [0.0, 0.0])]));
    scene["gravity"] = json!([0, -9.81]);
    let mut world = world(&scene);
    let count = (world.point_count() - 20) / 2;
    run_to(&mut *world, 1.0);
    assert_eq!((mover(&*world, 20).why, mover(&*world, 20 + count).why), (Why::Contact, Why::Plan));
    run_to(&mut *world, 1.5);
    assert!(middle(&*world, 20..20 + count)[1] > 0.2);
    assert!(middle(&*world, 20 + count..20 + 2 * count)[1] < -5.0);
}

#[test]
fn pins_that_nothing_hangs_on_are_met_where_they_are() {
    // A box about all three would hold all of the scene.
    let mut scene = scene(json!([disc([0.0, 2.0], [0.0, 0.0]), disc([9.0, 3.0], [0.0, 0.0])]));
    scene["gravity"] = json!([0, -9.81]);
    scene["points"] = json!({"position": [[-50, -50], [50, 50], [0, 1.0]], "pinned": [0, 1, 2]});
    let mut world = world(&scene);
    let count = (world.point_count() - 3) / 2;
    run_to(&mut *world, 0.3);
    assert_eq!(world.counters().hand_overs, 0);
    run_to(&mut *world, 0.8);
    let [near, far] = [mover(&*world, 3), mover(&*world, 3 + count)];
    assert_eq!((near.why, far.why), (Why::Contact, Why::Plan));
    // The disc hangs on the peg, or rolls off it: it is later than what falls freely.
    assert!(middle(&*world, 3..3 + count)[1] > middle(&*world, 3 + count..3 + 2 * count)[1]);
}

#[test]
fn pins_that_are_led_are_met_before_they_touch_and_push() {
    for (speed, is_slow) in [(10.0, true), (50.0, false)] {
        let mut scene = scene(json!([disc([2.0, 0.0], [0.0, 0.0])]));
        scene["points"] = json!({"position": [[0, 0]], "pinned": [0]});
        scene["pin_motion"] = json!([{"point": 0, "track": [[0, 0, 0], [5.0 / speed, 5, 0]]}]);
        let mut world = world(&scene);
        run_to(&mut *world, 5.0 / speed);
        let moved = mover(&*world, 1);
        // The disc begins at 1.7 m.
        assert!(moved.why == Why::Contact && moved.since < 1.7 / speed, "at {speed} m/s: {moved:?}");
        let sample = world.sample(world.time());
        assert!(!is_slow || sample.position[1..].iter().all(|x| x[0] > 4.5), "at {speed} m/s");
    }
}

#[test]
fn an_edit_elsewhere_leaves_a_heap_its_bits() {
    let mut scene =
        scene((0..4).map(|k| disc([0.05 * f64::from(k % 2), 0.35 + 0.65 * f64::from(k)], [0.0; 2])).collect());
    scene["gravity"] = json!([0, -9.81]);
    scene["bounds"] = json!({"min": [-30, 0], "max": [30, 90], "friction": 0.5});
    let mut world = world(&scene);
    run_to(&mut *world, 0.8);
    assert_eq!(mover(&*world, 0).why, Why::Contact);
    let mut edited = world.boxed_clone();
    let addition = Addition {
        position: vec![[20.0, 3.0, 0.0], [20.5, 3.0, 0.0]],
        velocity: vec![[0.0; 3]; 2],
        mass: vec![1.0; 2],
        ..Addition::default()
    };
    edited.apply(&Command::Add(Box::new(addition))).unwrap();
    run_to(&mut *world, 1.6);
    run_to(&mut *edited, 1.6);
    let count = world.point_count();
    let own = |world: &dyn Dynamics| world.sample(world.time()).position[..count].to_vec();
    assert_eq!(own(&*world), own(&*edited));
}

#[test]
fn a_heap_that_is_kept_goes_on_as_one() {
    let bodies: Value = (0..3).map(|k| disc([0.0, 0.35 + 0.65 * f64::from(k)], [0.0; 2])).collect();
    let mut scene = scene(bodies);
    scene["gravity"] = json!([0, -9.81]);
    scene["bounds"] = json!({"min": [-3, 0], "max": [3, 9], "friction": 0.5});
    let mut world = world(&scene);
    run_to(&mut *world, 1.0);
    let before = world.moved_by();
    let mut again = wobble::sim::resume(&world.save().unwrap()).unwrap();
    run_to(&mut *again, 1.2);
    let after = again.moved_by();
    assert_eq!((before.len(), after.len(), after[0].count), (1, 1, before[0].count), "{after:?}");
    assert_eq!((after[0].why, after[0].since), (before[0].why, before[0].since));
    assert!(again.is_finite());
}

#[test]
fn a_line_that_is_pinned_all_over_holds_what_falls_on_it() {
    let block = json!({"make": "lattice", "columns": 7, "rows": 7, "spacing": 0.09, "origin": [-0.3, 1.0],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 3, "mass": 1}});
    let line =
        json!({"make": "rope", "count": 7, "spacing": 0.05, "origin": [-0.15, 0.75], "pinned": [0, 1, 2, 3, 4, 5, 6]});
    let mut scene = scene(json!([block, line]));
    scene["gravity"] = json!([0, -9.81]);
    let mut world = world(&scene);
    run_to(&mut *world, 1.0);
    assert!(middle(&*world, 0..49)[1] > 0.9, "it lies on the line at 0.75 m");
    assert!(world.counters().contacts > 0);
}

/// A row of rigid bonds that is straight between its pins stands, and is met though it does not move.
#[test]
fn a_taut_rope_between_two_pins_holds_what_falls_on_it() {
    let block = json!({"make": "lattice", "columns": 7, "rows": 7, "spacing": 0.09, "origin": [-0.3, 1.0],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 3, "mass": 1}});
    let rope = json!({"make": "rope", "count": 17, "spacing": 0.05, "origin": [-0.4, 0.75], "pinned": [0, 16]});
    let mut scene = scene(json!([block, rope]));
    scene["gravity"] = json!([0, -9.81]);
    let mut world = world(&scene);
    let start = world.sample(0.0).position[49..].to_vec();
    run_to(&mut *world, 1.0);
    assert!(middle(&*world, 0..49)[1] > 0.9, "it lies on the rope at 0.75 m");
    assert!(world.counters().contacts > 0);
    assert_eq!(world.sample(world.time()).position[49..], start);
}

#[test]
fn a_moment_behind_the_end_of_a_step_makes_no_energy() {
    // A taut net of rigid bonds, of which a substep leaves something undone, with a disc on it.
    let net = json!({"make": "lattice", "columns": 9, "rows": 3, "spacing": 0.1, "origin": [-0.4, 0],
        "pinned": [0, 8, 18, 26], "material": {"mass": 1}});
    let mut scene = scene(json!([net, disc([0.0, 0.6], [0.0, -3.0])]));
    scene["gravity"] = json!([0, -9.81]);
    scene["method"] = json!({"solver": "live"});
    let mut world = world(&scene);
    run_to(&mut *world, 0.2);
    let energy = world.energy();
    for late in [1e-9, 1e-7, 1e-6] {
        let sample = world.sample(world.time() + late);
        assert!(
            (sample.energy - energy).abs() < 0.01 * energy.abs(),
            "{late} s later: {} J, not {energy}",
            sample.energy
        );
    }
    world.step_until(world.time() + 1e-8);
    assert!((world.energy() - energy).abs() < 0.01 * energy.abs(), "{} J, not {energy}", world.energy());
}
