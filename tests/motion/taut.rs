//! Straight rows of rigid bonds between pins: they can go nowhere, and what hangs on them does as from a pin.

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::{BondId, Command, Dynamics, Sample, Selection};

use super::common::physics::run_to;

/// A row of eleven points aslant between two pins, and two rods in line that hang at its middle, aside.
fn row(dimensions: usize, longer: f64) -> Value {
    let at = |k: f64| [0.3 * k, 0.1 * k, 0.05 * k][..dimensions].to_vec();
    let length = (0.1_f64 + if dimensions == 3 { 0.0025 } else { 0.0 }).sqrt() * (1.0 + longer);
    let mut position: Vec<Vec<f64>> = (0..=10).map(|k| at(f64::from(k))).collect();
    let middle = at(5.0);
    for k in 1..=2 {
        let aside = [0.6 * f64::from(k), -0.8 * f64::from(k), 0.0];
        position.push((0..dimensions).map(|axis| middle[axis] + aside[axis]).collect());
    }
    let mut bonds: Vec<Value> = (0..10).map(|k| json!({"a": k, "b": k + 1, "kind": "rigid", "rest": length})).collect();
    bonds.extend([[5, 11], [11, 12]].map(|[a, b]| json!({"a": a, "b": b, "kind": "rigid"})));
    let gravity = &[0.0, -9.81, 0.0][..dimensions];
    json!({"wobble": 1, "dimensions": dimensions, "gravity": gravity, "points": {"position": position, "pinned": [0, 10]}, "bonds": bonds,
        "method": {"ledger": true}})
}

/// The two rods alone, at a pin.
fn alone(scene: &Value) -> Value {
    let mut scene = scene.clone();
    let all = scene["points"]["position"].as_array().unwrap().clone();
    scene["points"] = json!({"position": [all[5], all[11], all[12]], "pinned": [0]});
    scene["bonds"] = json!([{"a": 0, "b": 1, "kind": "rigid"}, {"a": 1, "b": 2, "kind": "rigid"}]);
    scene
}

fn world(scene: &Value) -> Box<dyn Dynamics> {
    Scene::parse(&scene.to_string(), "scene").unwrap().world(None).unwrap()
}

fn apart(x: &[f64; 3], y: &[f64; 3]) -> f64 {
    (0..3).map(|k| (x[k] - y[k]).powi(2)).sum::<f64>().sqrt()
}

fn sag(scene: &Value, end: &Sample) -> f64 {
    let start = world(scene).sample(0.0);
    (0..=10).map(|k| apart(&start.position[k], &end.position[k])).fold(0.0, f64::max)
}

#[test]
fn a_straight_row_stands_and_what_hangs_on_it_swings_as_from_a_pin() {
    for dimensions in [2, 3] {
        let scene = row(dimensions, 0.0);
        let mut whole = world(&scene);
        let end = run_to(&mut *whole, 2.0);
        assert_eq!(sag(&scene, &end), 0.0, "in {dimensions} dimensions");
        assert_eq!([whole.counters().fallbacks, whole.counters().hand_overs], [0, 0]);
        let right = run_to(&mut *world(&alone(&scene)), 2.0);
        let off = (0..2).map(|k| apart(&end.position[11 + k], &right.position[1 + k])).fold(0.0, f64::max);
        assert!(off < 2e-3, "{off} m off in {dimensions} dimensions");
        let ledger = end.ledger.unwrap();
        assert!(ledger.left_over().abs() < 1e-3 * ledger.most_kinetic, "{ledger:?}");
    }
}

#[test]
fn a_row_falls_where_it_is_cut_or_its_pin_goes_and_a_longer_one_sags() {
    let scene = row(2, 0.0);
    let cut = Command::Delete(Selection { bonds: vec![BondId(2)], ..Selection::default() });
    let mut falls = world(&scene);
    run_to(&mut *falls, 0.5);
    let energy = falls.energy();
    falls.apply(&cut).unwrap();
    let end = run_to(&mut *falls, 1.5);
    assert!(sag(&scene, &end) > 1.0, "{}", sag(&scene, &end));
    assert!((falls.energy() - energy).abs() < 1e-2 * end.ledger.unwrap().most_kinetic, "{} J", falls.energy() - energy);
    // Points of equal mass hang in an arc about as a parabola: of a length L longer by e, sqrt(3 e/8) L deep.
    let mut longer = row(2, 1e-6);
    longer["bonds"].as_array_mut().unwrap().truncate(10);
    longer["points"]["position"].as_array_mut().unwrap().truncate(11);
    let deep = sag(&longer, &run_to(&mut *world(&longer), 0.2));
    assert!(deep > 1e-4, "it is not straight, and moves: {deep} m");
}

#[test]
fn what_falls_on_a_row_is_borne_by_it() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [
        {"make": "rope", "count": 11, "to": [2, 0], "origin": [0, 0], "pinned": [0, 10], "material": {"kind": "rigid", "mass": 1}},
        {"make": "disc", "radius": 0.2, "spacing": 0.1, "origin": [1, 0.6],
            "material": {"kind": "spring", "stiffness": 2000, "damping": 1, "mass": 0.5}}]});
    let end = run_to(&mut *world(&scene), 1.5);
    let lowest = end.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
    assert!(lowest > -0.5, "it fell through to {lowest} m");
}
