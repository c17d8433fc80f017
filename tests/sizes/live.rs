//! Sizes within the live step.

use serde_json::{Value, json};
use wobble::sim::{BondKind, Model, sizes};

use super::across::{Across, fine, floor, keys, thrown, tipped, with};
use crate::large::models::rope;

fn live(changes: &Value) -> Value {
    with(json!({ "method": { "solver": "live" } }), changes)
}

/// A rope and bonds 50 m off, all of one tree for the live step, that together are one bond short of a size or reach it.
fn trees(bonds: usize, size: usize, changes: &Value) -> [Value; 2] {
    let rope = thrown(0.2, rope(bonds as u32 + 1));
    [1, 0].map(|short| keys(&tipped(&rope, (size - bonds - short) as u32, BondKind::Rigid), &live(changes)))
}

#[test]
fn a_large_tree_has_fewer_passes() {
    let [below, above] = trees(58, sizes::MOST_LIVE_TREE as usize + 1, &floor(-1.0));
    let fine = fine("velocity-verlet", 64);
    Across { size: "MOST_LIVE_TREE", below, above, fine, seconds: 0.6, points: 59 }.check();
}

#[test]
fn a_polygon_of_many_sides_is_a_circle() {
    let slope = |sides: usize| {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / sides as f64;
        let corners: Vec<[f64; 2]> = (0..sides).map(|i| [angle(i).cos(), angle(i).sin()]).collect();
        let point = Model {
            position: vec![[0.3, 1.0]],
            velocity: vec![[0.0; 2]],
            mass: vec![1.0],
            gravity: [0.0, -9.8],
            ..Model::default()
        };
        keys(&point, &live(&json!({ "obstacles": [{ "polygon": [corners] }] })))
    };
    let [below, above] = [1, 0].map(|short| slope(sizes::LEAST_SIDES - short));
    let fine = fine("rk4", 64);
    Across { size: "LEAST_SIDES", below, above, fine, seconds: 0.4, points: 1 }.check();
}
