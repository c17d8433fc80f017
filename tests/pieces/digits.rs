//! Rigid bodies whose rest lengths are written with few digits.

use serde_json::{Value, json};
use wobble::sim::{Addition, Bond, Command, Dynamics, PointId, Solver};

use super::world;

/// A triangular lattice of so many rows and columns whose places and rest lengths have so many digits after the point.
fn lattice(size: i32, digits: i32) -> Value {
    let scale = 10_f64.powi(digits);
    let round = |x: f64| (x * scale).round() / scale;
    let place = |i: i32, j: i32| {
        let [i, j] = [i, j].map(f64::from);
        // No two bonds are of one length.
        let off = [(12.9 * i + 7.3 * j).sin(), (3.7 * i + 9.1 * j + 1.0).sin()].map(|x| 0.02 * x);
        [0.1 * (i + 0.5 * j) + off[0], 1.0 + 0.1 * 0.75_f64.sqrt() * j + off[1]]
    };
    let at = |i: i32, j: i32| j * size + i;
    let mut position = Vec::new();
    let mut bonds = Vec::new();
    for (j, i) in (0..size).flat_map(|j| (0..size).map(move |i| (j, i))) {
        position.push(place(i, j).map(round));
        for (p, q) in [(i + 1, j), (i, j + 1), (i - 1, j + 1)] {
            if (0..size).contains(&p) && q < size {
                let [[a, b], [c, d]] = [place(i, j), place(p, q)];
                bonds.push(json!({"a": at(i, j), "b": at(p, q), "rest": round((c - a).hypot(d - b))}));
            }
        }
    }
    json!({"wobble": 1, "gravity": [0, -9.81], "points": {"position": position}, "bonds": bonds,
        "bounds": {"min": [-50, 0], "max": [50, 50], "friction": 0.5}})
}

fn told(world: &dyn Dynamics) -> Vec<&String> {
    world.warnings().iter().filter(|line| line.contains("contradict")).collect()
}

#[test]
fn lengths_that_are_rounded_make_a_body() {
    for (size, digits, is_told) in [(16, 4, true), (35, 4, true), (35, 6, true)] {
        let mut world = world(&lattice(size, digits));
        let moved: Vec<Solver> = world.moved_by().iter().map(|moved| moved.method).collect();
        assert_eq!(moved, [Solver::Rigid], "{size} rows with {digits} digits");
        assert_eq!(
            told(&*world).len(),
            usize::from(is_told),
            "{size} rows with {digits} digits: {:?}",
            world.warnings()
        );
        let start = world.energy();
        while world.time() < 1.0 {
            world.step();
        }
        assert!(world.sample(1.0).max_strain < 1e-9, "{size} rows with {digits} digits");
        assert!(world.energy() < start * (1.0 + 1e-9));
    }
}

#[test]
fn lengths_that_contradict_each_other_by_more_than_rounding_are_no_rounding() {
    let mut scene = lattice(6, 12);
    scene["bonds"][20]["rest"] = json!(0.103);
    let world = world(&scene);
    assert!(told(&*world).iter().all(|line| !line.contains("of their length")), "{:?}", world.warnings());
}

#[test]
fn what_agrees_stays_to_the_bit() {
    // As a file says them.
    let scene: Value = serde_json::from_str(&lattice(12, 15).to_string()).unwrap();
    let world = world(&scene);
    let said: Vec<f64> = scene["bonds"].as_array().unwrap().iter().map(|bond| bond["rest"].as_f64().unwrap()).collect();
    let now: Vec<f64> = world.bonds().iter().map(|bond| bond.rest_length).collect();
    assert_eq!(said, now);
}

#[test]
fn lengths_of_a_body_that_comes_later_are_fitted_too() {
    let scene = lattice(16, 4);
    let mut empty = scene.clone();
    (empty["points"], empty["bonds"]) = (json!({"position": [[5, 1]]}), json!([]));
    let mut world = world(&empty);
    world.step();
    let list = |of: &Value| of.as_array().unwrap().clone();
    let number = |of: &Value| of.as_f64().unwrap();
    let position: Vec<[f64; 3]> =
        list(&scene["points"]["position"]).iter().map(|x| [number(&x[0]), number(&x[1]), 0.0]).collect();
    let point = |of: &Value| PointId(1 + of.as_u64().unwrap() as u32);
    let bond = |of: &Value| Bond::new(point(&of["a"]), point(&of["b"]), number(&of["rest"]));
    let addition = Addition {
        velocity: vec![[0.0; 3]; position.len()],
        mass: vec![1.0; position.len()],
        position,
        bonds: list(&scene["bonds"]).iter().map(bond).collect(),
        ..Addition::default()
    };
    world.apply(&Command::Add(Box::new(addition))).unwrap();
    assert_eq!(told(&*world).len(), 1, "{:?}", world.warnings());
    while world.time() < 1.0 {
        world.step();
    }
    assert!(world.moved_by().iter().any(|moved| moved.method == Solver::Rigid), "{:?}", world.moved_by());
    let strain = world.sample(world.time()).max_strain;
    assert!(strain < 1e-9, "{strain}");
}
