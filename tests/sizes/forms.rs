//! Sizes at which large bodies take another form.

use serde_json::json;
use wobble::sim::{Bond, BondKind, Model, PointId, sizes};

use super::across::{Across, fine, keys, thrown, tipped};
use crate::large::models::{copies, hung, rims, rope, to_strain};

fn by_paths() -> serde_json::Value {
    json!({ "method": { "solver": "path", "max_strain": 1e-3 } })
}

#[test]
fn a_path_goes_over_to_a_chain() {
    let count = sizes::SHORTEST_CHAIN as u32;
    // The pin is at one end: the further bond, at the other, is nearly still.
    let [below, above] = [count, count + 1].map(|points| keys(&rope::<2>(points), &by_paths()));
    let fine = fine("velocity-verlet", 64);
    Across { size: "SHORTEST_CHAIN", below, above, fine, seconds: 0.2, points: 56 }
        .check_methods(["path a mesh by paths", "path a chain by paths"]);
}

#[test]
fn equal_bodies_go_side_by_side() {
    let count = sizes::FEWEST_ALIKE as u32;
    let [below, above] = [count - 1, count].map(|count| keys(&rims(count), &by_paths()));
    let fine = fine("velocity-verlet", 64);
    Across { size: "FEWEST_ALIKE", below, above, fine, seconds: 0.3, points: 26 * 7 }
        .check_methods(["path 7 meshes by paths", "path a crowd by paths"]);
}

#[test]
fn equal_bodies_of_many_bonds_go_one_by_one() {
    // Two columns of which the top is pinned, the bond between the pins left out.
    let body = |bonds: usize| {
        let ladder = hung::<2>([2, 135], [true, false]);
        let bonds = ladder.bonds.iter().skip(1).take(bonds).collect();
        copies(&Model { bonds, pinned: vec![PointId(0), PointId(1)], ..ladder }, 8)
    };
    let [below, above] = [0, 1].map(|more| keys(&to_strain(&body(sizes::MOST_ALIKE_BONDS + more), 1e-3), &by_paths()));
    let fine = fine("velocity-verlet", 64);
    Across { size: "MOST_ALIKE_BONDS", below, above, fine, seconds: 0.1, points: 200 }
        .check_methods(["path a crowd by paths, path", "path 8 meshes by paths, path"]);
}

#[test]
fn short_paths_go_over_to_sweeps() {
    // A net of nine rows and columns, two of the rows a bond longer, so that it is no sheet: 18 paths, and two far off.
    let mut net = hung::<2>([9, 9], [false; 2]);
    for row in [4, 8] {
        let (from, to) = (PointId(9 * row + 8), PointId(net.position.len() as u32));
        net.position.push([0.9, -0.1 * f64::from(row)]);
        net.velocity.push([0.0; 2]);
        net.mass.push(1.0);
        net.bonds.push(Bond::new(from, to, 0.1));
    }
    let bonds = (20.0 * sizes::SHORTEST_TRAILS) as usize - net.bonds.len() - 1;
    let net = thrown(1.0, net);
    let [below, above] =
        [bonds - 1, bonds].map(|bonds| keys(&tipped(&net, bonds as u32, BondKind::Rigid), &by_paths()));
    let fine = fine("velocity-verlet", 64);
    Across { size: "SHORTEST_TRAILS", below, above, fine, seconds: 0.2, points: 83 }.check();
}
