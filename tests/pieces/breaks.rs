//! Bonds that may break or that act one way only, in bodies and between them.

use serde_json::{Value, json};
use wobble::sim::Solver;

use super::{run, world};

/// Points that hang together by rigid bonds with these keys, thrown onto a rough floor.
fn thrown(position: &[[f64; 2]], bonds: &[([usize; 2], Value)], [friction, restitution]: [f64; 2]) -> Value {
    let bond = |([a, b], keys): &([usize; 2], Value)| {
        let mut bond = json!({"a": a, "b": b});
        bond.as_object_mut().unwrap().extend(keys.as_object().unwrap().clone());
        bond
    };
    json!({"wobble": 1, "gravity": [0, -9.81], "method": {"ledger": true},
        "points": {"position": position, "velocity": vec![[3.0, -1.0]; position.len()]},
        "bonds": bonds.iter().map(bond).collect::<Vec<_>>(),
        "bounds": {"min": [-90, 0], "max": [90, 90], "friction": friction, "restitution": restitution}})
}

/// A square of two triangles.
const SQUARE: [[f64; 2]; 4] = [[0.0, 1.0], [0.8, 1.3], [0.5, 2.1], [-0.3, 1.8]];
const SIDES: [[usize; 2]; 5] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]];
const OTHER: [usize; 2] = [1, 3];

fn sides() -> Vec<([usize; 2], Value)> {
    SIDES.map(|ends| (ends, json!({}))).to_vec()
}

#[test]
fn what_may_break_or_acts_one_way_only_within_a_body_leaves_it_one() {
    let plain = run(&mut *world(&thrown(&SQUARE, &sides(), [0.4, 0.5])), 3.0);
    let length = (SQUARE[1][0] - SQUARE[3][0]).hypot(SQUARE[1][1] - SQUARE[3][1]);
    let spring = json!({"kind": "spring", "stiffness": 1000, "break_strain": 0.1});
    for keys in [
        json!({"break_strain": 0.1}),
        json!({"limit": "max"}),
        json!({"limit": "max", "rest": 2.0 * length}),
        json!({"limit": "min", "rest": 0.5 * length}),
        spring,
    ] {
        let bonds = [sides(), vec![(OTHER, keys.clone())]].concat();
        let other = run(&mut *world(&thrown(&SQUARE, &bonds, [0.4, 0.5])), 3.0);
        assert_eq!(plain.position, other.position, "{keys}");
    }
}

#[test]
fn what_is_strained_beyond_its_limit_makes_no_body() {
    let bonds = [sides(), vec![(OTHER, json!({"limit": "max", "rest": 0.5}))]].concat();
    let world = world(&thrown(&SQUARE, &bonds, [0.4, 0.5]));
    assert!(world.moved_by().iter().all(|moved| moved.method != Solver::Rigid));
}

/// How far points that bonds hold, by a method that locates impacts, are from where one body is at this time `[m]`.
fn apart(how: [f64; 2], t: f64) -> f64 {
    let finely = |bonds: &[([usize; 2], Value)]| {
        let mut scene = thrown(&SQUARE, bonds, how);
        scene["method"]["substep"] = json!(2e-4);
        scene
    };
    let one = run(&mut *world(&finely(&sides())), t);
    let mut bonds = sides();
    // Without a diagonal it is no body.
    bonds[4].1 = json!({"break_strain": 1});
    let mut scene = finely(&bonds);
    scene["method"]["solver"] = json!("rk4");
    let mut by_bonds = world(&scene);
    assert!(by_bonds.moved_by().iter().all(|moved| moved.method != Solver::Rigid));
    while by_bonds.time() + by_bonds.substep() <= t + 1e-9 {
        by_bonds.step();
    }
    let places = by_bonds.sample(t).position;
    let off = |(p, q): (&[f64; 3], &[f64; 3])| (p[0] - q[0]).hypot(p[1] - q[1]);
    places.iter().zip(&one.position).map(off).fold(0.0, f64::max)
}

#[test]
fn impacts_through_bonds_obey_coulombs_law_as_those_of_a_body_do() {
    for (how, t) in [([0.3, 0.0], 0.7), ([0.3, 0.5], 1.5), ([0.8, 0.3], 1.0), ([5.0, 0.2], 1.0)] {
        let off = apart(how, t);
        assert!(off < 1e-6, "{how:?}: {off}");
    }
}
