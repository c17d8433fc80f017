//! Bodies of a case, with what they are made of.

use serde_json::{Value, json};

use super::Family;
use super::dice::Dice;

/// Gives a scene the bodies of a family; relaxed bonds bring the method that they need.
pub(super) fn fill(family: Family, dice: &mut Dice, scene: &mut Value) {
    let kind = kind(family, dice);
    match family {
        Family::HeavyEnd => heavy_end(dice, kind, scene),
        Family::Comb => comb(dice, kind, scene),
        Family::Pile => {
            let makers =
                [Family::Rope, Family::Rim, Family::Lattice, Family::Disc, Family::Picture, Family::RandomGraph];
            let count = dice.count(2, 5);
            let bodies: Vec<Value> = (0..count).map(|_| body(dice.of(&makers), dice, kind, 200)).collect();
            scene["bodies"] = bodies.into();
        }
        Family::Resting => {
            let maker = dice.of(&[Family::Rope, Family::Lattice, Family::Cloth, Family::Disc]);
            let mut body = body(maker, dice, Kind::Spring, 300);
            for key in ["velocity", "spin"] {
                body.as_object_mut().map(|keys| keys.remove(key));
            }
            body["material"]["damping"] = json!(1.0);
            scene["bodies"] = json!([body]);
        }
        family => {
            let most = if dice.chance(0.1) { 3_000 } else { 400 };
            scene["bodies"] = json!([body(family, dice, kind, most)]);
        }
    }
    if kind == Kind::Relaxed {
        let (substep, iterations) = (dice.of(&[1.0 / 240.0, 1.0 / 120.0, 0.01]), dice.count(1, 16));
        scene["method"] = json!({ "substep": substep, "iterations": iterations, "seed": dice.seed() });
    } else if dice.chance(0.08) {
        scene["method"] = json!({ "substep": dice.of(&[1.0 / 120.0, 1.0 / 60.0, 1e-3]) });
    }
}

/// How the bonds of a case resist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Spring,
    Rigid,
    Relaxed,
}

fn kind(family: Family, dice: &mut Dice) -> Kind {
    let (relaxed, rigid) = match family {
        Family::Points | Family::Resting => (0.0, 0.0),
        _ => (0.08, 0.48),
    };
    match dice.between(0.0, 1.0) {
        x if x < relaxed => Kind::Relaxed,
        x if x < rigid => Kind::Rigid,
        _ => Kind::Spring,
    }
}

/// What a body is made of: springs from soft to so stiff that they are hardly springs.
fn material(dice: &mut Dice, kind: Kind) -> Value {
    let mass = dice.decades(0.1, 10.0);
    match kind {
        Kind::Rigid => json!({ "kind": "rigid", "mass": mass }),
        Kind::Relaxed => json!({ "kind": "relaxed", "mass": mass, "relaxation": dice.between(0.1, 1.0) }),
        Kind::Spring => {
            let stiffness = if dice.chance(0.1) { dice.decades(1e6, 1e9) } else { dice.decades(30.0, 1e6) };
            let damping = if dice.chance(0.5) { 0.0 } else { dice.decades(1e-3, 10.0) };
            json!({ "kind": "spring", "mass": mass, "stiffness": stiffness, "damping": damping })
        }
    }
}

/// A body of up to about `most` points.
fn body(family: Family, dice: &mut Dice, kind: Kind, most: u64) -> Value {
    let mut body = shape(family, dice, most);
    body["origin"] = json!([dice.between(-1.0, 1.0), dice.between(-0.3, 1.0)]);
    if family == Family::Points {
        body["material"] = json!({ "mass": dice.decades(0.1, 10.0) });
    } else {
        body["material"] = material(dice, kind);
    }
    if dice.chance(0.5) {
        body["angle"] = json!(dice.between(-3.1, 3.1));
    }
    if dice.chance(0.5) {
        let speed = if dice.chance(0.3) { dice.decades(20.0, 200.0) } else { dice.decades(0.1, 20.0) };
        let angle = dice.between(0.0, std::f64::consts::TAU);
        body["velocity"] = json!([speed * libm::cos(angle), speed * libm::sin(angle)]);
        body["spin"] = json!(dice.between(-10.0, 10.0));
    }
    body
}

fn shape(family: Family, dice: &mut Dice, most: u64) -> Value {
    let side = libm::sqrt(most as f64) as u64;
    match family {
        Family::Points => {
            json!({ "make": "points", "count": dice.count(1, 60), "min": [-1, -1], "max": [1, 1], "seed": dice.seed() })
        }
        Family::RandomGraph => {
            let count = dice.count(3, 60);
            let bonds = dice.count(count, (4 * count).min(count * (count - 1) / 2));
            json!({ "make": "random-graph", "count": count, "bonds": bonds, "min": [-1, -1], "max": [1, 1],
                    "seed": dice.seed() })
        }
        Family::Rim => {
            let radius = dice.between(0.3, 1.2);
            json!({ "make": "rim", "radius": radius, "inner_radius": radius * dice.between(0.5, 0.95),
                    "sectors": dice.count(4, most / 4) })
        }
        Family::Box => {
            json!({ "make": "box", "width": dice.between(0.2, 1.5), "height": dice.between(0.2, 1.5),
                    "supports": dice.of(&[0, 1, 2]) })
        }
        Family::Net | Family::Cloth => {
            let columns = dice.count(3, side);
            let diagonals = if family == Family::Net { "none" } else { dice.of(&["one", "both"]) };
            let pinned = if dice.chance(0.75) { vec![0, columns - 1] } else { Vec::new() };
            json!({ "make": "cloth", "columns": columns, "rows": dice.count(2, side), "diagonals": diagonals,
                    "spacing": 1.6 / columns as f64, "pinned": pinned })
        }
        Family::Lattice => {
            let columns = dice.count(2, side);
            let pinned = if dice.chance(0.2) { vec![0] } else { Vec::new() };
            json!({ "make": "lattice", "columns": columns, "rows": dice.count(2, side),
                    "spacing": dice.between(0.6, 1.4) / columns as f64, "pinned": pinned })
        }
        Family::Disc => {
            let radius = dice.between(0.3, 1.0);
            let points = dice.count(12, most) as f64;
            json!({ "make": "disc", "radius": radius, "spacing": radius * libm::sqrt(3.6 / points) })
        }
        Family::Picture => {
            let file = dice.of(&["gear", "jelly", "letter", "pebble", "ring"]);
            let height = dice.between(0.8, 2.0);
            let cells = libm::sqrt(dice.count(60, most.max(120)) as f64);
            json!({ "make": "picture", "file": format!("pictures/{file}.png"), "height": height,
                    "spacing": height / cells, "pattern": dice.of(&["edges", "braced"]) })
        }
        // A rope, and what is made of one.
        _ => {
            let count = dice.count(2, most);
            let (angle, length) = (dice.between(-3.1, 3.1), dice.between(0.5, 2.0));
            let ends = [Vec::new(), vec![0], vec![0, count - 1]];
            json!({ "make": "rope", "count": count, "to": [length * libm::cos(angle), length * libm::sin(angle)],
                    "pinned": ends[dice.of(&[0, 1, 1, 2])] })
        }
    }
}

/// A rope whose last point is many times heavier or lighter than the others.
fn heavy_end(dice: &mut Dice, kind: Kind, scene: &mut Value) {
    let links = dice.count(1, 30);
    let (length, angle) = (dice.between(0.5, 2.0) / links as f64, dice.between(-2.0, 2.0));
    let position: Vec<Value> = (0..=links)
        .map(|i| json!([length * i as f64 * libm::cos(angle), 1.0 + length * i as f64 * libm::sin(angle)]))
        .collect();
    let mut mass = vec![0.01; links as usize + 1];
    mass[links as usize] = 0.01 * dice.decades(1e-3, 1e6);
    scene["points"] = json!({ "position": position, "mass": mass, "pinned": [0] });
    let bonds: Vec<Value> = (0..links).map(|i| bond(kind, i, i + 1, 1e4)).collect();
    scene["bonds"] = bonds.into();
}

fn bond(kind: Kind, a: u64, b: u64, stiffness: f64) -> Value {
    match kind {
        Kind::Rigid => json!({ "a": a, "b": b }),
        Kind::Relaxed => json!({ "a": a, "b": b, "kind": "relaxed", "relaxation": 0.8 }),
        Kind::Spring => json!({ "a": a, "b": b, "kind": "spring", "stiffness": stiffness }),
    }
}

/// A taut spine between two pins, with a tooth at every second joint.
fn comb(dice: &mut Dice, kind: Kind, scene: &mut Value) {
    let joints = dice.count(3, 120);
    let step = 4.0 / (joints - 1) as f64;
    let stiffness = dice.decades(1e2, 1e6);
    let mut position: Vec<Value> = (0..joints).map(|i| json!([-2.0 + step * i as f64, 1.0])).collect();
    let mut bonds: Vec<Value> = (1..joints).map(|i| bond(kind, i - 1, i, stiffness)).collect();
    for joint in (1..joints - 1).step_by(2) {
        bonds.push(bond(kind, joint, position.len() as u64, stiffness));
        position.push(json!([-2.0 + step * joint as f64, 0.7]));
    }
    scene["points"] = json!({ "position": position, "mass": dice.decades(0.01, 2.0), "pinned": [0, joints - 1] });
    scene["bonds"] = bonds.into();
}
