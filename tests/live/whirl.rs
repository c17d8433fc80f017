//! Weights that whirl on ropes of light points: the tension turns these sideways faster than sixteen substeps a frame follow.

use serde_json::{Value, json};

use super::{run, world};

/// A weight at the end of so many rods of 10 g, 1 m in all, that whirls about a pin.
fn whirl((rods, weight): (usize, f64), spin: f64, method: &Value) -> Value {
    let at = |k: usize| k as f64 / rods as f64;
    let position: Vec<Value> = (0..=rods).map(|k| json!([at(k), 0])).collect();
    let velocity: Vec<Value> = (0..=rods).map(|k| json!([0, spin * at(k)])).collect();
    let mass: Vec<f64> = (0..=rods).map(|k| if k == rods { weight } else { 0.01 }).collect();
    let bonds: Vec<Value> = (0..rods).map(|k| json!({"a": k, "b": k + 1})).collect();
    json!({"wobble": 1, "gravity": [0, -9.81], "method": method, "bonds": bonds,
        "points": {"position": position, "velocity": velocity, "mass": mass, "pinned": [0]}})
}

#[test]
fn a_weight_that_whirls_on_a_rope_goes_where_a_fine_run_by_rods_says() {
    // 14 kg gained without end, 1 kg lost a third of its energy.
    for (rope, spin) in [((2, 14.0), 11.0), ((12, 14.0), 11.0), ((40, 1.0), 12.0)] {
        goes_as_rods_do(&format!("{rope:?}"), |method| whirl(rope, spin, method), rope.0);
    }
}

/// Where the live step and a fine run of RATTLE's method bring a point of a scene within 1 s.
fn goes_as_rods_do(what: &str, scene: impl Fn(&Value) -> Value, point: usize) {
    let (exact, _) = run(&scene(&json!({"solver": "velocity-verlet", "substep": 1e-4})), 1.0);
    let (live, _) = run(&scene(&json!({"solver": "live"})), 1.0);
    let [at, truth] = [&live, &exact].map(|sample| sample.position[point]);
    let off = (at[0] - truth[0]).hypot(at[1] - truth[1]);
    assert!(off < 6e-3, "{what}: {off} m off {truth:?}");
    assert!((live.energy / exact.energy - 1.0).abs() < 2e-3, "{what}: {} J, {} J", live.energy, exact.energy);
    assert!(live.max_strain < 1e-9, "{what}: {}", live.max_strain);
}

#[test]
fn a_weight_on_two_ropes_goes_where_rods_let_it() {
    // No tree: sweeps stretched them to 1.6 times their lengths, and all energy was gone after a turn.
    goes_as_rods_do(
        "two strands",
        |method| {
            let mut scene = whirl((6, 14.0), 8.0, method);
            let points = &mut scene["points"];
            for k in 1..6 {
                let at = f64::from(k) / 6.0;
                points["position"].as_array_mut().unwrap().push(json!([at, 0.02]));
                points["velocity"].as_array_mut().unwrap().push(json!([0, 8.0 * at]));
                points["mass"].as_array_mut().unwrap().push(json!(0.01));
            }
            let strand = [0, 7, 8, 9, 10, 11, 6];
            let bonds = strand.windows(2).map(|ends| json!({"a": ends[0], "b": ends[1]}));
            scene["bonds"].as_array_mut().unwrap().extend(bonds);
            scene
        },
        6,
    );
}

#[test]
fn a_rope_at_rest_pays_for_no_more_substeps_than_it_needs() {
    let count = |spin: f64| {
        let mut world = world(&whirl((12, 1.0), spin, &json!({"solver": "live"})));
        // Nobody knows how taut it is before its first step.
        world.step();
        let before = world.counters().substeps;
        world.step();
        world.counters().substeps - before
    };
    let [slow, fast] = [0.1, 10.0].map(count);
    assert!(slow == 16 && fast == 64, "{slow} and {fast} substeps");
}

/// A swing of half a circle whose end is a million times as heavy as its points: its bonds were three times as long as they are.
#[test]
fn a_chain_holds_an_end_a_million_times_as_heavy() {
    let angle = |k: u32| std::f64::consts::PI * f64::from(k) / 10.0;
    let position: Vec<Value> = (0..=10).map(|k| json!([-0.5 * angle(k).cos(), 2.0 - 0.65 * angle(k).sin()])).collect();
    let mass: Vec<f64> = (0..=10).map(|k| if k == 10 { 1e4 } else { 0.01 }).collect();
    let bonds: Vec<Value> = (0..10).map(|k| json!({"a": k, "b": k + 1})).collect();
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "bonds": bonds,
        "points": {"position": position, "mass": mass, "pinned": [0]},
        "bounds": {"min": [-4, -4], "max": [4, 4], "restitution": 0.5, "friction": 0.5}});
    let mut world = world(&scene);
    let start = world.sample(0.0).energy;
    let (mut strain, mut most) = (0.0_f64, start);
    while world.time() < 1.0 - 1e-9 {
        world.step();
        let sample = world.sample(world.time());
        (strain, most) = (strain.max(sample.max_strain), most.max(sample.energy));
    }
    assert!(strain < 0.5 && most < start + 1e-3 * start.abs(), "{strain} and {most} J of {start}");
}

/// Angles between the rods of such a rope fed it without end.
#[test]
fn a_heavy_weight_on_a_rope_with_angles_gains_nothing() {
    let position: Vec<Value> = (0..10).map(|k| json!([0.081 * f64::from(k), 1.0 + 0.066 * f64::from(k)])).collect();
    let mass: Vec<f64> = (0..10).map(|k| if k == 9 { 57.8 } else { 0.01 }).collect();
    let bonds: Vec<Value> = (0..9).map(|k| json!({"a": k, "b": k + 1})).collect();
    let angles: Vec<Value> =
        (0..8).map(|k| json!({"points": [k, k + 1, k + 2], "stiffness": 0.003, "damping": 0.001})).collect();
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "bonds": bonds, "angles": angles, "drag_rate": 0.15,
        "method": {"solver": "live"}, "points": {"position": position, "mass": mass, "pinned": [0]}});
    let mut world = world(&scene);
    let start = world.sample(0.0).energy;
    while world.time() < 2.0 - 1e-9 {
        world.step();
        let energy = world.sample(world.time()).energy;
        assert!(energy < 1.01 * start, "{energy} J of {start} at {} s", world.time());
    }
}
