//! Rigid bodies that are hardly any: of no size, of masses that differ by twelve powers of ten, of a million points, cut as they land.

use serde_json::{Value, json};
use wobble::scene::record::ledgers;
use wobble::sim::{Command, Cursor, Dynamics, Solver, judge};

use super::{middle, rigid, run, world};

/// Three points of these masses with a bond each, in a room.
fn triangle(position: &Value, mass: &Value) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "method": {"ledger": true},
        "points": {"position": position, "mass": mass, "velocity": [[1, 2], [1, 2], [1, 2]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}],
        "bounds": {"min": [-3, -1], "max": [3, 3], "friction": 0.5, "restitution": 0.5}})
}

/// Where what is thrown at (1, 2) m/s from a place is after `t` [s].
fn thrown([x, y]: [f64; 2], t: f64) -> [f64; 2] {
    [x + t, y + 2.0 * t - 0.5 * 9.81 * t * t]
}

fn assert_near(what: &str, found: [f64; 2], wanted: [f64; 2], most: f64) {
    let off = (found[0] - wanted[0]).hypot(found[1] - wanted[1]);
    assert!(off < most, "{what}: at {found:?}, not at {wanted:?}");
}

/// Runs to `t` [s] with all energy accounted for.
fn go(what: &str, world: &mut dyn Dynamics, t: f64) {
    let verdict = judge(&ledgers(world, t).unwrap());
    assert!(verdict.is_told && verdict.passes() && world.is_finite(), "{what}: {verdict:?}");
}

#[test]
fn a_body_longer_than_its_box_takes_no_more_than_frames_have() {
    let body = json!({"make": "lattice", "spacing": 0.21381413333333332, "columns": 3, "rows": 53, "origin": [-0.2276205, 0.9312781],
        "angle": 1.592556, "velocity": [1.1799975060977161, -0.6342481276315841], "spin": 4.238607,
        "material": {"kind": "rigid", "mass": 7.319854}});
    let corners = [
        [1.1400842360751613, -1.4473306181734573],
        [-1.1296413835765298, -1.4151908229572698],
        [0.687713917650121, -2.7753037094645556],
        [0.01689689028228785, -0.6067346257752269],
        [-0.7150534296314479, -2.755440223629491],
    ];
    let mut world = world(&json!({"wobble": 1, "bodies": [body], "contact": true, "gravity": [0, -9.81],
        "forces": [{"points": [0], "force": [-19.292465133177704, -17.629456072415355]}],
        "bounds": {"min": [-2.443462, -2.443462], "max": [2.443462, 2.443462], "restitution": 0.3, "friction": 0.3},
        "obstacles": [{"polygon": [corners], "restitution": 0.3, "friction": 0.3}], "method": {"substep": 1.0 / 120.0}}));
    let mut most = 0;
    for _ in 0..30 {
        let before = world.counters().work;
        world.step();
        most = most.max(world.counters().work - before);
    }
    assert!(world.is_finite() && most < 60_000_000, "{most} operations in a step: {:?}", world.moved_by());
}

#[test]
fn what_has_no_size_moves_as_a_point() {
    let mut world = world(&triangle(&json!([[0, 1], [0, 1], [0, 1]]), &json!(1)));
    go("flight", &mut *world, 0.5);
    assert_near("all in one place", middle(&world.sample(0.5), world.masses()), thrown([0.0, 1.0], 0.5), 1e-12);
    go("the room", &mut *world, 4.0);
    let end = world.sample(world.time());
    assert!(end.position.iter().all(|x| *x == end.position[0]), "{:?}", end.position);
}

#[test]
fn what_is_a_nanometre_long_is_one_body() {
    let mut world = world(&triangle(&json!([[0, 1], [1e-9, 1], [0, 1.000_000_001]]), &json!(1)));
    let start = middle(&world.sample(0.0), world.masses());
    go("flight", &mut *world, 0.5);
    assert_near("a nanometre", middle(&world.sample(0.5), world.masses()), thrown(start, 0.5), 1e-12);
    go("the room", &mut *world, 4.0);
    // Four roundings of places beside its length.
    assert!(world.sample(world.time()).max_strain < 4.0 * 3.0 * f64::EPSILON / 1e-9);
}

#[test]
fn masses_of_one_to_a_million_millions_are_one_body() {
    let mut world = world(&triangle(&json!([[0, 0], [1, 0], [0.5, 1]]), &json!([1e-6, 1e6, 1])));
    let start = middle(&world.sample(0.0), world.masses());
    let end = run(&mut *world, 0.2);
    assert_near("flight", middle(&end, world.masses()), thrown(start, 0.2), 1e-12);
    go("the room", &mut *world, 4.0);
    assert!(world.sample(world.time()).max_strain < 1e-14);
}

#[test]
fn what_is_a_million_millions_times_as_heavy_falls_on_it_and_makes_no_energy() {
    let block = |mass: f64, origin: [f64; 2]| {
        json!({"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.2, "origin": origin,
            "material": {"kind": "rigid", "mass": mass}})
    };
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"ledger": true},
        "bodies": [block(1e-6, [0.0, -0.9]), block(1e6, [0.05, 0.0])],
        "bounds": {"min": [-3, -1], "max": [3, 3], "friction": 0.5, "restitution": 0.5}});
    let mut world = world(&scene);
    go("the heavy one above", &mut *world, 3.0);
    let end = world.sample(world.time());
    assert!(end.max_strain < 1e-9 && end.position.iter().all(|x| x[1] > -1.001), "{}", end.max_strain);
}

#[test]
fn a_million_points_are_one_body() {
    let body = json!({"make": "lattice", "columns": 1000, "rows": 1000, "spacing": 0.01, "velocity": [3, 0], "material": rigid()});
    let mut world = world(&json!({"wobble": 1, "gravity": [0, -9.81], "bodies": [body]}));
    let before = middle(&world.sample(0.0), world.masses());
    let end = run(&mut *world, 0.1);
    let after = middle(&end, world.masses());
    assert_near("a million points", [after[0] - before[0], after[1] - before[1]], [0.3, -0.5 * 9.81 * 0.01], 1e-5);
    assert_eq!(world.counters().bonds_solved, 0);
}

/// A beam that lands on a post in its middle at 10 m/s, and is cut there before, in and after the impact.
#[test]
fn what_is_cut_in_an_impact_goes_on_as_two_and_makes_no_energy() {
    let beam = json!({"make": "lattice", "columns": 21, "rows": 3, "spacing": 0.1, "origin": [-1, 1], "velocity": [0, -10], "material": rigid()});
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"ledger": true}, "bodies": [beam],
        "bounds": {"min": [-9, -1], "max": [9, 9], "friction": 0.3, "restitution": 0.3},
        "obstacles": [{"box": {"min": [-0.2, -1], "max": [0.2, 0.5]}, "friction": 0.3, "restitution": 0.3}]});
    let landing = 0.049;
    for at in [landing - 0.01, landing, landing + 0.002, landing + 0.01, landing + 0.1] {
        let what = format!("cut at {at} s");
        let mut world = world(&scene);
        while world.time() + world.substep() < at {
            world.step();
        }
        world.apply(&Command::Cut { from: Cursor::at([-0.05, -9.0]), to: Cursor::at([-0.05, 9.0]) }).unwrap();
        go(&what, &mut *world, 2.0);
        let end = world.sample(world.time());
        let [left, right] = [0, 20].map(|column| end.position[column][0]);
        assert!(end.max_strain < 1e-6 && left < -0.4 && right > 0.4, "{what}: {left} {right}, {}", end.max_strain);
        let movers = world.moved_by();
        assert!(movers.iter().all(|moved| matches!(moved.method, Solver::Rigid | Solver::Live)), "{what}: {movers:?}");
    }
}

#[test]
fn bodies_among_obstacles_that_are_asked_to_be_of_32_bits_are_told_that_these_are_too_few() {
    let mut scene = triangle(&json!([[0, 1], [1, 1], [0, 2]]), &json!(1));
    scene["method"] = json!({"precision": "f32"});
    let told = |scene: &Value| world(scene).warnings().iter().any(|warning| warning.starts_with("32 bits"));
    assert!(!told(&scene), "walls alone");
    scene["obstacles"] = json!([{"circle": {"center": [0, -0.5], "radius": 0.2}}]);
    assert!(told(&scene));
    scene["method"] = json!({});
    assert!(!told(&scene));
}

#[test]
fn pins_that_are_led_and_stop_take_what_the_body_had() {
    for pinned in [vec![0], vec![0, 4]] {
        let track = |&point: &usize| {
            let x = 0.2 * point as f64;
            json!({"point": point, "track": [[0, x, 1], [1, x + 1.0, 1]]})
        };
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": {"ledger": true},
            "bodies": [{"make": "lattice", "columns": 5, "rows": 5, "spacing": 0.2, "pinned": pinned, "origin": [0, 1]}],
            "pin_motion": pinned.iter().map(track).collect::<Vec<_>>()});
        go(&format!("{pinned:?}"), &mut *world(&scene), 2.0);
    }
}
