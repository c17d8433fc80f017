//! Sizes of what rigid bonds hold together.

use serde_json::{Value, json};
use wobble::sim::{BondKind, Model, PointId, sizes};

use super::across::{Across, beside, fine, floor, keys, precision, thrown, tipped, with};
use crate::large::models::{bonded, hub, hung, rope, to_strain, tree};

/// So many rigid triangles in a row, each jointed to the next at a corner, the first pinned.
fn triangles(count: usize) -> Model<2> {
    let (mut position, mut ends) = (vec![[0.0, 0.0]], Vec::new());
    for i in 0..count as u32 {
        let (next, left) = (2 * i + 1, 0.1 * f64::from(i));
        let last = next.saturating_sub(2);
        position.extend([[left + 0.1, 0.0], [left + 0.05, 0.08]]);
        ends.extend([[last, next], [last, next + 1], [next, next + 1]]);
    }
    Model { pinned: vec![PointId(0)], ..bonded(position, &ends, BondKind::Rigid) }
}

/// A rope of so many points, and bonds 50 m off, so that all are so many: and one more.
fn tipped_rope(points: u32, bonds: usize, changes: &Value) -> [Value; 2] {
    let rope = rope(points);
    let more = bonds as u32 - (points - 1);
    [more, more + 1].map(|more| keys(&tipped(&rope, more, BondKind::Rigid), changes))
}

const ORDER_2: &str = "velocity-verlet";
const BY_PATHS: &str = "path a mesh by paths";

#[test]
fn order_8_goes_over_to_order_2() {
    let [below, above] = tipped_rope(sizes::MOST_FINE_RODS as u32 - 3, sizes::MOST_FINE_RODS, &json!({}));
    let fine = fine("rk8", 16);
    Across { size: "MOST_FINE_RODS", below, above, fine, seconds: 0.5, points: 247 }.check_methods(["rk8", ORDER_2]);
}

#[test]
fn solving_together_goes_over_to_paths() {
    let [below, above] = tipped_rope(sizes::MOST_DIRECT as u32 - 3, sizes::MOST_DIRECT, &json!({}));
    let fine = fine(ORDER_2, 64);
    Across { size: "MOST_DIRECT", below, above, fine, seconds: 0.25, points: 1_997 }.check_methods([ORDER_2, BY_PATHS]);
}

#[test]
fn a_star_goes_over_to_paths() {
    // A star of 346 spokes has 59,685 pairs of them; a row of bonds one pair less than bonds.
    let star = hub(346, false);
    let more = (sizes::MOST_COUPLINGS - 346 * 345 / 2) as u32 + 1;
    let [below, above] = [more, more + 1].map(|more| keys(&tipped(&star, more, BondKind::Rigid), &json!({})));
    let fine = json!({ "method": { "solver": "rk4", "substep": 1.0 / 1920.0 } });
    Across { size: "MOST_COUPLINGS", below, above, fine, seconds: 0.03, points: 347 }
        .check_methods([ORDER_2, BY_PATHS]);
}

#[test]
fn a_tree_with_a_strain_goes_over_to_solving_together() {
    let tree = thrown(1.0, Model { pinned: Vec::new(), ..tree(3, sizes::MOST_SWEPT_TREE - 3) });
    let tips = [4, 5].map(|more| keys(&to_strain(&tipped(&tree, more, BondKind::Rigid), 0.01), &json!({})));
    let ([below, above], fine) = (tips, fine(ORDER_2, 64));
    let points = sizes::MOST_SWEPT_TREE - 3;
    Across { size: "MOST_SWEPT_TREE", below, above, fine, seconds: 0.25, points }.check_methods([BY_PATHS, ORDER_2]);
}

#[test]
fn located_impacts_go_over_to_paths() {
    let [below, above] = tipped_rope(sizes::MOST_LOCATED_RODS as u32 - 3, sizes::MOST_LOCATED_RODS, &floor(-1.5));
    let fine = fine(ORDER_2, 128);
    let across = Across { size: "MOST_LOCATED_RODS", below, above, fine, seconds: 0.6, points: 57 };
    across.check_methods([ORDER_2, BY_PATHS]);
}

#[test]
fn rods_that_meet_surfaces_go_over_from_bodies_to_points() {
    let [below, above] = tipped_rope(sizes::MOST_RODS as u32 - 3, sizes::MOST_RODS, &floor(-0.8));
    let fine = fine(ORDER_2, 512);
    Across { size: "MOST_RODS", below, above, fine, seconds: 0.5, points: 9 }
        .check_methods(["rigid 13 rigid bodies in joints", ORDER_2]);
}

#[test]
fn friction_through_bonds_goes_over_to_that_of_each_point() {
    // All of the row far off lie on the floor when the rope gets there, and the last of that.
    let lying = sizes::MOST_STRUCK as u32 - 2;
    let named = with(json!({ "method": { "solver": "rk4" } }), &floor(-0.5));
    let [below, above] = [lying, lying + 1].map(|more| keys(&tipped(&rope(9), more, BondKind::Rigid), &named));
    let fine = fine("rk4", 64);
    Across { size: "MOST_STRUCK", below, above, fine, seconds: 1.0, points: 9 }.check_methods(["rk4", "rk4"]);
}

#[test]
fn bodies_in_joints_go_over_to_points() {
    let count = sizes::MOST_PIECES;
    let [below, above] = [count, count + 1].map(|count| keys(&thrown(0.1, triangles(count)), &json!({})));
    let fine = fine(ORDER_2, 128);
    Across { size: "MOST_PIECES", below, above, fine, seconds: 0.2, points: 2 * count - 20 }
        .check_methods(["rigid 300 rigid bodies in joints", ORDER_2]);
}

#[test]
fn large_cloths_go_over_to_single_precision() {
    let cloth = thrown(0.2, hung::<3>([40, sizes::LARGE_RIGID_SINGLE as u32 / 40], [true; 2]));
    let auto = json!({ "method": { "precision": "auto" } });
    let [below, above] = [0, 1].map(|more| keys(&beside(&cloth, more), &auto));
    let fine = fine("path", 16);
    let across = Across { size: "LARGE_RIGID_SINGLE", below, above, fine, seconds: 0.1, points: 1_000 };
    across.check();
    assert_ne!(precision(&across.below), precision(&across.above));
}
