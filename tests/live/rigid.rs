//! What is made of rigid bonds keeps its lengths where it strikes.

use serde_json::{Value, json};
use wobble::sim::{Dynamics, Sample};

use super::world;

/// The largest relative error of a bond.
pub(super) fn strain(world: &dyn Dynamics, sample: &Sample) -> f64 {
    let of = |bond: wobble::sim::Bond| {
        let [a, b] = [bond.a, bond.b].map(|end| sample.position[end.index()]);
        (((a[0] - b[0]).hypot(a[1] - b[1])) / bond.rest_length - 1.0).abs()
    };
    world.bonds().iter().map(of).fold(0.0, f64::max)
}

fn thrown(body: &Value, wall: &Value) -> Vec<f64> {
    let mut scene = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "bodies": [body]});
    for (key, value) in wall.as_object().unwrap() {
        scene[key] = value.clone();
    }
    let mut world = world(&scene);
    let mut strains = Vec::new();
    while world.time() < 0.5 - 1e-9 {
        world.step();
        strains.push(strain(&*world, &world.sample(world.time())));
    }
    strains
}

/// The largest strains of ropes thrown at a wall, and at how many steps' ends they are above 0.02.
fn strains(walls: &[(&'static str, Value)]) -> Vec<(&'static str, u32, f64, usize)> {
    let mut worst = Vec::new();
    for (what, wall) in walls {
        for turn in 0..4 {
            let angle = 0.5 * f64::from(turn);
            let body = json!({"make": "rope", "count": 20, "origin": [-1.5, 0], "velocity": [50, 0],
                "to": [1.9 * angle.cos(), 1.9 * angle.sin()], "material": {"kind": "rigid"}});
            let strains = thrown(&body, wall);
            let large = strains.iter().filter(|strain| **strain > 0.02).count();
            worst.push((*what, turn, strains.iter().copied().fold(0.0, f64::max), large));
        }
    }
    worst
}

fn plane(restitution: f64) -> Value {
    json!({"bounds": {"min": [-9, -9], "max": [1, 9], "restitution": restitution}})
}

#[test]
fn ropes_thrown_at_a_wall_keep_their_lengths() {
    let polygon = json!({"obstacles": [{"polygon": [[[1, -9], [1.1, -9], [1.1, 9], [1, 9]]]}]});
    let worst = strains(&[("plane", plane(0.0)), ("polygon", polygon)]);
    assert!(worst.iter().all(|entry| entry.2 < 0.05), "{worst:?}");
}

#[test]
fn ropes_that_bounce_and_crumple_keep_their_lengths() {
    // Where it crumples at 50 m/s a bond may give for a moment.
    let worst = strains(&[("bouncy plane", plane(0.8))]);
    assert!(worst.iter().all(|entry| entry.2 < 0.1 && entry.3 <= 2), "{worst:?}");
}

#[test]
fn trees_thrown_at_a_wall_keep_their_lengths() {
    // A comb: a spine, and teeth of three.
    let mut positions = Vec::new();
    let mut bonds = Vec::new();
    for k in 0..8_u32 {
        let x = 0.1 * f64::from(k);
        let spine = positions.len();
        positions.push(json!([x, 0.0]));
        if k > 0 {
            bonds.push(json!({"a": spine - 4, "b": spine, "kind": "rigid"}));
        }
        for j in 1..=3_u32 {
            bonds.push(json!({"a": positions.len() - 1, "b": positions.len(), "kind": "rigid"}));
            positions.push(json!([x + 0.02 * f64::from(j), -0.1 * f64::from(j)]));
        }
    }
    for velocity in [[0.0, -50.0], [50.0, 0.0], [35.0, -35.0]] {
        let scene = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "bonds": bonds,
            "points": {"position": positions, "velocity": vec![velocity; positions.len()]},
            "bounds": {"min": [-9, -1], "max": [2, 9]}});
        let mut world = world(&scene);
        let mut worst: f64 = 0.0;
        while world.time() < 0.5 - 1e-9 {
            world.step();
            worst = worst.max(strain(&*world, &world.sample(world.time())));
        }
        assert!(worst < 0.1, "{velocity:?}: {worst}");
    }
}

#[test]
fn what_hard_springs_hold_faster_than_can_be_seen_is_rigid() {
    let dropped = |stiffness: f64| {
        let scene = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "gravity": [0, -9.81],
            "bodies": [{"make": "lattice", "columns": 8, "rows": 8, "spacing": 0.1, "origin": [0, 1.2], "angle": 0.3,
                "material": {"kind": "spring", "mass": 1, "stiffness": stiffness}}],
            "bounds": {"min": [-9, 0], "max": [9, 9], "restitution": 0.5}});
        let mut world = world(&scene);
        let start = world.sample(0.0).energy;
        let (mut largest, mut most) = (0.0_f64, f64::NEG_INFINITY);
        while world.time() < 1.0 - 1e-9 {
            world.step();
            let sample = world.sample(world.time());
            largest = largest.max(strain(&*world, &sample));
            most = most.max(sample.energy - start);
        }
        (largest, most / start)
    };
    // 64 points of 1/64 kg: a bond swings with 11,000 rad/s, all of it with some hundred.
    let (largest, gained) = dropped(1e6);
    assert!(largest < 1e-9 && gained < 1e-3, "{largest:e} {gained}");
    // What can be seen to wobble does.
    let (largest, _) = dropped(2e3);
    assert!(largest > 0.01, "{largest:e}");
}
