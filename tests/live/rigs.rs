//! Rigid bodies in joints in the live step: no bond of them strains, whatever hangs on them.

use serde_json::{Value, json};
use wobble::sim::Dynamics;

use super::world;
use crate::linkages::{apart, triangles};

/// Triangles in joints that a solver moves.
fn moved_by(solver: &str, count: u32) -> Value {
    let mut scene = triangles(count);
    scene["method"] = json!({"solver": solver});
    scene
}

/// Runs to a time; the largest strain on the way.
fn strain(world: &mut dyn Dynamics, t: f64) -> f64 {
    let mut most: f64 = 0.0;
    while world.time() < t - 1e-9 {
        world.step();
        most = most.max(world.sample(world.time()).max_strain);
    }
    most
}

#[test]
fn bodies_in_joints_swing_as_they_do_by_their_own_method() {
    let [mut live, mut exact] = ["live", "auto"].map(|solver| world(&moved_by(solver, 3)));
    assert!(strain(&mut *live, 0.5) < 1e-9);
    strain(&mut *exact, 0.5);
    let off = apart(&live.sample(0.5), &exact.sample(0.5));
    assert!(off < 0.03, "{off}");
}

/// How far joints are beyond their ranges at the most `[rad]`.
fn beyond(world: &dyn Dynamics) -> f64 {
    let sample = world.sample(world.time());
    let of = |angle: &wobble::sim::Angle| {
        let [i, j, k] = angle.points.map(|point| sample.position[point.index()]);
        let [p, q] = [i, k].map(|end| [end[0] - j[0], end[1] - j[1]]);
        let turn = (p[0] * q[1] - p[1] * q[0]).atan2(p[0] * q[0] + p[1] * q[1]);
        let [least, most] = angle.range.unwrap_or([-9.0, 9.0]);
        let off = (turn - 0.5 * (least + most)).rem_euclid(std::f64::consts::TAU);
        off.min(std::f64::consts::TAU - off) - 0.5 * (most - least)
    };
    world.angles().iter().map(of).fold(0.0, f64::max)
}

#[test]
fn a_doll_that_tumbles_keeps_its_joints_within_their_ranges_and_most_of_its_energy() {
    for solver in ["live", "auto"] {
        let scene = json!({"wobble": 1, "contact": {"self": false}, "method": {"solver": solver, "sleep": false, "ledger": true},
            "bodies": [{"make": "ragdoll", "spin": 6, "material": {"mass": 70}}]});
        let mut world = world(&scene);
        let (mut most, mut least) = (0.0_f64, f64::INFINITY);
        while world.time() < 4.0 - 1e-9 {
            world.step();
            most = most.max(beyond(&*world));
            least = least.min(world.energy());
        }
        let ledger = world.sample(world.time()).ledger.unwrap();
        assert!(most < 0.02, "{solver}: {most} rad");
        assert!(
            ledger.left_over().abs() < 0.05 * ledger.most_kinetic,
            "{solver}: {} of {}",
            ledger.left_over(),
            ledger.most_kinetic
        );
    }
}

#[test]
fn a_light_chain_bears_a_heavy_load() {
    let position: Vec<[f64; 2]> =
        (0..=20).map(|k| [0.1 * f64::from(k), 0.0]).chain([[2.3, 0.2], [2.3, -0.2], [2.5, 0.0]]).collect();
    let mut bonds: Vec<[u32; 2]> = (0..20).map(|k| [k, k + 1]).collect();
    bonds.extend([[20, 21], [20, 22], [21, 22], [21, 23], [22, 23]]);
    let mass: Vec<f64> = (0..24).map(|k| if k < 21 { 0.01 } else { 100.0 }).collect();
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": "live"},
        "points": {"position": position, "mass": mass, "pinned": [0]},
        "bonds": bonds.iter().map(|[a, b]| json!({"a": a, "b": b})).collect::<Vec<_>>(), "bounds": {"min": [-9, -9], "max": [9, 9]}});
    let most = strain(&mut *world(&scene), 2.0);
    assert!(most < 1e-3, "{most}");
}

#[test]
fn what_is_rigid_and_pinned_does_not_bend_under_a_load() {
    let scene = json!({"wobble": 1, "bonds": [{"a": 11, "b": 26}],
        "bodies": [{"make": "lattice", "columns": 12, "rows": 2, "spacing": 0.25, "origin": [-2, 0], "angle": 0.5, "pinned": [8],
                "material": {"mass": 5}},
            {"make": "box", "width": 0.4, "height": 0.4, "supports": 2, "origin": [0.413, 0.9], "material": {"mass": 50}}],
        "contact": true, "gravity": [0, -9.81], "bounds": {"min": [-4, -1.6], "max": [4, 4], "friction": 0.5}});
    let mut world = world(&scene);
    let most = strain(&mut *world, 3.0);
    assert!(most < 1e-3, "{most}");
}

#[test]
fn what_lies_between_two_pins_stays_there() {
    let scene = json!({"wobble": 1, "contact": true, "gravity": [0, -9.81], "method": {"solver": "live"},
        "bodies": [{"make": "lattice", "columns": 8, "rows": 2, "spacing": 0.25, "pinned": [0, 7], "material": {"mass": 5}},
            {"make": "disc", "radius": 0.3, "spacing": 0.1, "origin": [0.9, 1.5], "material": {"kind": "spring", "stiffness": 2000, "damping": 2, "mass": 4}}],
        "bounds": {"min": [-4, -2], "max": [4, 4]}});
    let mut world = world(&scene);
    let start = world.sample(0.0);
    let most = strain(&mut *world, 3.0);
    let end = world.sample(3.0);
    let moved = (0..16).map(|k| (end.position[k][1] - start.position[k][1]).abs()).fold(0.0, f64::max);
    assert!(most < 1.0 && moved < 1e-4, "{most} {moved}");
    assert!(end.position[16..].iter().all(|x| x[1] > 0.0), "it lies on it");
}

#[test]
fn a_figure_that_is_dropped_on_a_bouncy_floor_gains_nothing() {
    // What a floor gave within a step stayed as the speed of all of it: 6.9 MJ.
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "bodies": [{"make": "ragdoll", "origin": [0, 2.717], "velocity": [-3.58, 0]}],
        "contact": {"friction": 0.5, "restitution": 0.5},
        "obstacles": [{"plane": {"point": [0, -0.8], "normal": [0, 1]}, "friction": 0.5}]});
    let mut world = world(&scene);
    let start = world.energy();
    while world.time() < 2.0 - 1e-9 {
        world.step();
        assert!(world.energy() < start + 1.0, "{} J of {start} at {} s", world.energy(), world.time());
    }
}

/// What is nailed there would be pressed out in every substep, and be led back by its joints: gigajoules came and went.
#[test]
fn a_figure_that_hangs_by_a_pin_which_an_obstacle_covers_swings_on_quietly() {
    for (pin, center, radius, velocity) in [
        (25, [-0.05, 1.51], 0.34, [-2.8, 0.0]),
        (27, [0.37, 1.24], 0.19, [1.8, -1.7]),
        (28, [0.68, 1.16], 0.53, [0.0, 0.0]),
    ] {
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.3, "radius": 0.02}, "method": {"ledger": true},
            "bodies": [{"make": "ragdoll", "origin": [0, 2], "pinned": [pin], "velocity": velocity, "material": {"mass": 70}}],
            "obstacles": [{"circle": {"center": center, "radius": radius}, "friction": 0.5}],
            "bounds": {"min": [-4, -2], "max": [4, 6], "friction": 0.5}});
        let mut world = world(&scene);
        while world.time() < 3.0 {
            world.step();
            let ledger = world.sample(world.time()).ledger.unwrap();
            assert!(ledger.left_over().abs() < 100.0, "pin {pin}: at {} s {ledger:?}", world.time());
        }
        let strain = world.sample(world.time()).max_strain;
        assert!(strain < 1e-3, "pin {pin}: its bones are strained by {strain}");
    }
}
