//! What no one should ask of contact: whatever comes of it is finite, and has no energy from nowhere.

use serde_json::{Value, json};
use wobble::scene::Scene;

use super::tangle::faults;
use super::{disc, world};

/// Runs for `t` [s]; returns the energy at the start and the largest one [J].
fn energies(what: &str, scene: &Value, t: f64) -> [f64; 2] {
    let mut world = world(scene);
    let start = world.energy();
    let mut most = start;
    while world.time() < t - 1e-9 {
        world.step();
        assert!(world.is_finite(), "{what} at {} s", world.time());
        most = most.max(world.energy());
    }
    [start, most]
}

fn scene(contact: &Value, bodies: &[Value]) -> Value {
    json!({"wobble": 1, "contact": contact,
        "method": {"solver": "live"}, "bodies": bodies, "bounds": {"min": [-2, -2], "max": [2, 2]}})
}

fn four(speed: f64) -> Vec<Value> {
    (0..4)
        .map(|k| {
            let [x, y] = [[-1.0, 0.0], [1.0, 0.1], [0.1, 1.0], [0.0, -1.0]][k];
            disc([x, y], [-speed * x, -speed * y])
        })
        .collect()
}

#[test]
fn absurd_numbers_stay_finite() {
    for (what, contact) in [
        ("friction of 1e9", json!({"friction": 1e9})),
        ("a radius larger than the body", json!({"radius": 1.0})),
        ("no radius", json!({"radius": 0.0})),
        ("restitution 1", json!({"restitution": 1.0})),
        ("all of it", json!({"restitution": 1.0, "friction": 1e9, "radius": 0.3})),
    ] {
        let [start, most] = energies(what, &scene(&contact, &four(5.0)), 2.0);
        assert!(most < 1.01 * start, "{what}: {start} J, then {most} J");
    }
}

#[test]
fn what_overlaps_gains_no_energy() {
    for restitution in [0.0, 1.0] {
        let contact = json!({"restitution": restitution, "friction": 0.0});
        let bodies: Vec<Value> =
            (0..6).map(|k| disc([0.15 * f64::from(k) - 0.4, 0.05 * f64::from(k % 2)], [1.0, 0.5])).collect();
        let [start, most] = energies("overlap", &scene(&contact, &bodies), 2.0);
        // What parts them goes 1 m/s, which six of 1 kg have 3 J at.
        assert!(most < start + 1.5, "{start} J, then {most} J");
    }
}

#[test]
fn two_thousand_points_in_one_place_stay_finite() {
    let points = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "gravity": [0, -9.81],
        "points": {"position": vec![[0.5, 0.5]; 2000]}, "bounds": {"min": [-2, 0], "max": [2, 3]}});
    energies("points", &points, 0.2);
    // A rope all of whose points lie in one place, and one across it.
    let bonds: Vec<Value> =
        (1..200).map(|k| json!({"a": k - 1, "b": k, "kind": "spring", "rest": 0.01, "stiffness": 100})).collect();
    let rope = json!({"wobble": 1, "contact": true,
        "method": {"solver": "live"}, "points": {"position": vec![[0.5, 0.5]; 200]}, "bonds": bonds});
    energies("rope", &rope, 0.2);
}

#[test]
fn many_bodies_in_one_place_come_apart() {
    let bodies: Vec<Value> = (0..12).map(|_| disc([0.0, 0.0], [0.0; 2])).collect();
    let mut world = world(&scene(&json!(true), &bodies));
    while world.time() < 4.0 {
        world.step();
    }
    assert!(world.is_finite());
    assert_eq!(faults(&*world), [0, 0]);
}

#[test]
fn triangles_without_an_inside_do_no_harm() {
    let lines = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "gravity": [0, -9.81],
        "points": {"position": [[0, 1], [0.5, 1], [1, 1], [0.2, 1], [0.2, 1], [0.2, 1.5]], "velocity": [[0, -9], [0, -9], [0, -9], [0, -9], [0, -9], [0, -9]]},
        "bonds": [{"a": 0, "b": 1, "kind": "rigid"}, {"a": 1, "b": 2, "kind": "rigid"}, {"a": 0, "b": 2, "kind": "rigid"},
            {"a": 3, "b": 5, "kind": "rigid"}, {"a": 4, "b": 5, "kind": "rigid"}],
        "triangles": [[0, 1, 2], [3, 4, 5]], "bounds": {"min": [-2, 0], "max": [2, 3]}});
    match Scene::parse(&lines.to_string(), "scene").and_then(|scene| scene.world(None)) {
        Err(error) => assert!(error.to_string().contains("triangle"), "{error}"),
        Ok(_) => {
            energies("lines", &lines, 1.0);
        }
    }
}
