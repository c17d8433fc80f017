//! The scenes of the sweeps, each from one number.

use serde_json::{Value, json};

use super::table::FRAME;
use crate::body::draw::Draw;

/// A bond, a spring where a stiffness `[N/m]` is said.
fn bond(a: usize, b: usize, stiffness: Option<f64>) -> Value {
    match stiffness {
        Some(k) => json!({ "a": a, "b": b, "kind": "spring", "stiffness": k }),
        None => json!({ "a": a, "b": b }),
    }
}

/// The same with a rest length `[m]`.
fn bond_of(a: usize, b: usize, stiffness: Option<f64>, rest: f64) -> Value {
    let mut bond = bond(a, b, stiffness);
    bond["rest"] = json!(rest);
    bond
}

fn scene(position: Vec<[f64; 2]>, bonds: Vec<Value>, pinned: &[usize]) -> Value {
    json!({ "wobble": 1, "name": "sweep", "points": { "position": position, "mass": 0.1, "pinned": pinned },
            "bonds": bonds, "gravity": [0, -9.81] })
}

/// A hung lattice of 4 x 4 springs of a stiffness `[N/m]`.
pub(super) fn lattice(k: f64) -> Value {
    json!({ "wobble": 1, "name": "sweep", "gravity": [0, -9.81],
            "bodies": [{ "make": "lattice", "columns": 4, "rows": 4, "spacing": 0.2, "pinned": [12, 13, 14, 15],
                         "material": { "kind": "spring", "stiffness": k, "point_mass": 0.1 } }] })
}

/// A chain, level, held at one end; its other end weighs `ratio` times as much as the others.
pub(super) fn chain(links: usize, ratio: f64, stiffness: Option<f64>) -> Value {
    let position = (0..=links).map(|i| [i as f64 / links as f64, 0.0]).collect();
    let bonds = (0..links).map(|i| bond(i, i + 1, stiffness)).collect();
    let mut scene = scene(position, bonds, &[0]);
    let mut mass = vec![0.1; links + 1];
    mass[links] *= ratio;
    scene["points"]["mass"] = json!(mass);
    scene
}

/// The same of rigid bonds, straight down: in its equilibrium.
pub(super) fn hung(links: usize) -> Value {
    let mut scene = chain(links, 1.0, None);
    let position: Vec<[f64; 2]> = (0..=links).map(|i| [0.0, -(i as f64) / links as f64]).collect();
    scene["points"]["position"] = json!(position);
    scene
}

/// A ring of bonds of 0.1 m whose points all lie at one place.
pub(super) fn heap(count: usize, stiffness: Option<f64>) -> Value {
    let sides = if count == 2 { 1 } else { count };
    let bonds = (0..sides).map(|i| bond_of(i, (i + 1) % count, stiffness, 0.1)).collect();
    scene(vec![[0.3, 0.2]; count], bonds, &[])
}

/// A hung rope with rest lengths of so many times the distance.
pub(super) fn rests(factor: f64, stiffness: Option<f64>) -> Value {
    let position = (0..8).map(|i| [0.1 * f64::from(i), 0.0]).collect();
    let bonds = (0..7).map(|i| bond_of(i, i + 1, stiffness, 0.1 * factor)).collect();
    scene(position, bonds, &[0])
}

pub(super) fn repeated(times: usize, stiffness: Option<f64>) -> Value {
    let position = (0..6).map(|i| [0.2 * f64::from(i), 0.0]).collect();
    let bonds = (0..5).flat_map(|i| (0..times).map(move |_| bond(i, i + 1, stiffness))).collect();
    scene(position, bonds, &[0])
}

/// All pairs of points of a ring, hung by one; lengths are off by up to a share.
pub(super) fn complete(count: usize, off: f64, stiffness: Option<f64>) -> Value {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
    let position: Vec<[f64; 2]> = (0..count).map(|i| [libm::cos(angle(i)), libm::sin(angle(i))]).collect();
    let mut draw = Draw::new(7);
    let mut bonds = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            let (p, q) = (position[a], position[b]);
            let length = libm::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]));
            bonds.push(bond_of(a, b, stiffness, length * (1.0 + off * (2.0 * draw.unit() - 1.0))));
        }
    }
    scene(position, bonds, &[0])
}

/// Bonds of a grid of 5 x 5, both diagonals in every cell, 0.2 m apart.
fn grid(stiffness: Option<f64>) -> Vec<Value> {
    let mut bonds = Vec::new();
    for row in 0..5_usize {
        for column in 0..5_usize {
            let at = 5 * row + column;
            let ways = [(1, 0, 0.2), (0, 1, 0.2), (1, 1, 0.2 * libm::sqrt(2.0))];
            for (right, up, length) in ways.into_iter().filter(|way| column + way.0 < 5 && row + way.1 < 5) {
                bonds.push(bond_of(at, at + right + 5 * up, stiffness, length));
            }
            if column > 0 && row < 4 {
                bonds.push(bond_of(at, at + 4, stiffness, 0.2 * libm::sqrt(2.0)));
            }
        }
    }
    bonds
}

fn place(i: usize) -> [f64; 2] {
    [0.2 * (i % 5) as f64, 0.2 * (i / 5) as f64]
}

/// A grid of springs, drawn together: what it has at the start is to be unfolded.
pub(super) fn squeezed(across: f64, up: f64) -> Value {
    let position = (0..25).map(place).map(|[x, y]| [across * x, up * y]).collect();
    with_triangles(scene(position, grid(Some(1e3)), &[]))
}

/// A grid with one corner carried across.
pub(super) fn folded(way: f64, stiffness: Option<f64>) -> Value {
    let mut position: Vec<[f64; 2]> = (0..25).map(place).collect();
    position[24] = position[24].map(|x| x - 0.2 * way);
    with_triangles(scene(position, grid(stiffness), &[]))
}

/// Weightless, with drag, and with the triangles of the grid as they are at rest.
fn with_triangles(mut scene: Value) -> Value {
    let cells = (0..16_u32).map(|cell| 5 * (cell / 4) + cell % 4);
    let triangles: Vec<[u32; 3]> = cells.flat_map(|at| [[at, at + 1, at + 6], [at, at + 6, at + 5]]).collect();
    (scene["triangles"], scene["gravity"], scene["drag_rate"]) = (json!(triangles), json!([0, 0]), json!(2.0));
    scene
}

/// Places within a square, one a frame.
fn jumps(reach: f64) -> Vec<[f64; 3]> {
    let mut draw = Draw::new(11);
    let mut side = || reach * (2.0 * draw.unit() - 1.0);
    (0..=120).map(|i| [f64::from(i) * FRAME, side(), side()]).collect()
}

/// A free grid of springs, or a rope of rigid bonds, between walls, and a mouse that is somewhere else in every frame.
pub(super) fn pushed(strength: f64, is_rigid: bool) -> Value {
    let mut scene = match is_rigid {
        true => scene(
            (0..8).map(|i| [0.1 * f64::from(i), 0.0]).collect(),
            (0..7).map(|i| bond(i, i + 1, None)).collect(),
            &[],
        ),
        false => scene((0..25).map(place).collect(), grid(Some(1e3)), &[]),
    };
    scene["mouse"] = json!({ "strength": strength, "radius": 0.4, "track": jumps(1.0) });
    scene["bounds"] = json!({ "min": [-1.5, -1.5], "max": [1.5, 1.5], "restitution": 0.5 });
    scene
}

/// A rope whose pin is thrown about.
pub(super) fn thrown(way: f64, stiffness: Option<f64>) -> Value {
    let position = (0..8).map(|i| [0.1 * f64::from(i), 0.0]).collect();
    let mut scene = scene(position, (0..7).map(|i| bond(i, i + 1, stiffness)).collect(), &[0]);
    let mut track = jumps(way);
    track[0] = [0.0; 3];
    scene["pin_motion"] = json!([{ "point": 0, "track": track }]);
    scene
}

/// A chain of rigid bonds far from the origin.
pub(super) fn moved(offset: f64) -> Value {
    let mut scene = chain(5, 1.0, None);
    let position: Vec<[f64; 2]> = (0..=5).map(|i| [offset + 0.2 * f64::from(i), offset]).collect();
    scene["points"]["position"] = json!(position);
    scene
}

/// A free grid of rigid bonds that are more than it needs, with noise on its velocities.
pub(super) fn noisy(speed: f64) -> Value {
    let mut draw = Draw::new(13);
    let velocity: Vec<[f64; 2]> = (0..25).map(|_| [(); 2].map(|()| speed * (2.0 * draw.unit() - 1.0))).collect();
    let mut scene = scene((0..25).map(place).collect(), grid(None), &[]);
    (scene["points"]["velocity"], scene["gravity"]) = (json!(velocity), json!([0, 0]));
    scene
}

/// A rope of rigid bonds thrown between walls that give back all.
pub(super) fn bouncing(speed: f64) -> Value {
    let position = (0..8).map(|i| [0.1 * f64::from(i), 0.03 * f64::from(i)]).collect();
    let mut scene = scene(position, (0..7).map(|i| bond(i, i + 1, None)).collect(), &[]);
    let velocity = [speed, -0.5 * speed];
    scene["points"]["velocity"] = json!(vec![velocity; 8]);
    scene["bounds"] = json!({ "min": [-1, -1], "max": [1, 1], "restitution": 1 });
    scene
}
