//! The scenes of the sweeps, each from one number.

use serde_json::{Value, json};

use super::Sweep;
use crate::body::draw::Draw;
use crate::scene::PrecisionName;
use crate::study::stability::subject::Rest;

/// A scene of a sweep and how it is run.
pub(super) struct Setup {
    pub(super) scene: Value,
    /// [s]
    pub(super) substep: f64,
    /// `auto` is held to the substep too.
    pub(super) is_forced: bool,
    /// [s]
    pub(super) seconds: f64,
    pub(super) precision: Option<PrecisionName>,
    pub(super) rest: Rest,
    /// It starts in its equilibrium.
    pub(super) is_laid: bool,
}

impl Setup {
    fn new(scene: Value, substep: f64) -> Self {
        Setup { scene, substep, is_forced: false, seconds: 2.0, precision: None, rest: Rest::Free, is_laid: false }
    }
}

const FRAME: f64 = 1.0 / 60.0;

/// All sweeps.
pub fn sweeps() -> &'static [Sweep] {
    &SWEEPS
}

static SWEEPS: [Sweep; 26] = [
    Sweep {
        name: "substep of springs",
        quantity: "substep [s]",
        values: &STEPS,
        home: 4,
        setup: |h| stepped(lattice(1e3), h),
    },
    Sweep {
        name: "substep of rigid bonds",
        quantity: "substep [s]",
        values: &STEPS,
        home: 4,
        setup: |h| stepped(chain(10, 1.0, None), h),
    },
    Sweep {
        name: "stiffness",
        quantity: "stiffness [N/m], 0.1 kg a point, substep 1/60 s",
        home: 3,
        values: &[1e-2, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10, 1e12],
        setup: |k| Setup::new(lattice(k), FRAME),
    },
    Sweep {
        name: "mass ratio of springs",
        quantity: "mass of the end over the others",
        values: &RATIOS,
        home: 0,
        setup: |ratio| Setup::new(chain(6, ratio, Some(1e5)), FRAME / 10.0),
    },
    Sweep {
        name: "mass ratio of rigid bonds",
        quantity: "mass of the end over the others",
        values: &RATIOS,
        home: 0,
        setup: |ratio| Setup::new(chain(10, ratio, None), FRAME / 10.0),
    },
    Sweep {
        name: "coincident points, springs",
        quantity: "points at one place",
        values: &COUNTS,
        home: 0,
        setup: |n| Setup::new(heap(n as usize, Some(1e3)), FRAME / 8.0),
    },
    Sweep {
        name: "coincident points, rigid",
        quantity: "points at one place",
        values: &COUNTS,
        home: 0,
        setup: |n| Setup::new(heap(n as usize, None), FRAME / 8.0),
    },
    Sweep {
        name: "rest length",
        quantity: "rest length over distance",
        home: 4,
        values: &[0.0, 1e-9, 1e-3, 0.1, 1.0, 10.0, 1e2, 1e3, 1e6],
        setup: |f| Setup::new(rests(f), FRAME / 16.0),
    },
    Sweep {
        name: "repeated springs",
        quantity: "times that each bond is listed",
        values: &TIMES,
        home: 0,
        setup: |n| Setup::new(repeated(n as usize, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "repeated rigid bonds",
        quantity: "times that each bond is listed",
        values: &TIMES,
        home: 0,
        setup: |n| Setup::new(repeated(n as usize, None), FRAME / 16.0),
    },
    Sweep {
        name: "complete graph, springs",
        quantity: "points",
        values: &GRAPHS,
        home: 0,
        setup: |n| Setup::new(complete(n as usize, 0.0, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "complete graph, rigid",
        quantity: "points",
        values: &GRAPHS,
        home: 0,
        setup: |n| Setup::new(complete(n as usize, 0.0, None), FRAME / 16.0),
    },
    Sweep {
        name: "contradictory lengths",
        quantity: "share that lengths are off by",
        home: 0,
        values: &[0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.5],
        setup: |off| Setup::new(complete(8, off, None), FRAME / 16.0),
    },
    Sweep {
        name: "collapse to a point",
        quantity: "share of its size that is left",
        values: &SIZES,
        home: 6,
        setup: |s| Setup::new(squeezed(s, s), FRAME / 16.0),
    },
    Sweep {
        name: "collapse to a line",
        quantity: "share of its height that is left",
        values: &SIZES,
        home: 6,
        setup: |s| Setup::new(squeezed(1.0, s), FRAME / 16.0),
    },
    Sweep {
        name: "inside out",
        quantity: "way of a corner across its body [edges]",
        home: 0,
        values: &[0.0, 0.5, 1.0, 2.0, 5.0, 10.0],
        setup: |way| Setup::new(folded(way), FRAME / 16.0),
    },
    Sweep {
        name: "mouse that jumps",
        quantity: "strength [1/s^2]",
        home: 0,
        values: &[1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6],
        setup: |s| Setup::new(pushed(s), FRAME / 8.0),
    },
    Sweep {
        name: "thrown pin, springs",
        quantity: "jump a frame [m]",
        values: &JUMPS,
        home: 0,
        setup: |way| Setup::new(thrown(way, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "thrown pin, rigid",
        quantity: "jump a frame [m]",
        values: &JUMPS,
        home: 0,
        setup: |way| Setup::new(thrown(way, None), FRAME / 16.0),
    },
    Sweep {
        name: "offset, 64 bits",
        quantity: "distance from the origin [m]",
        values: &OFFSETS,
        home: 0,
        setup: |x| Setup::new(moved(x), FRAME / 16.0),
    },
    Sweep {
        name: "offset, 32 bits",
        quantity: "distance from the origin [m]",
        values: &OFFSETS,
        home: 0,
        setup: |x| Setup { precision: Some(PrecisionName::F32), ..Setup::new(moved(x), FRAME / 16.0) },
    },
    Sweep {
        name: "minutes of springs",
        quantity: "simulated time [s]",
        values: &MINUTES,
        home: 0,
        setup: |t| Setup { seconds: t, ..Setup::new(chain(2, 1.0, Some(1e2)), FRAME / 4.0) },
    },
    Sweep {
        name: "minutes of rigid bonds",
        quantity: "simulated time [s]",
        values: &MINUTES,
        home: 0,
        setup: |t| Setup { seconds: t, ..Setup::new(chain(2, 1.0, None), FRAME / 4.0) },
    },
    Sweep {
        name: "noise on a hard mesh",
        quantity: "speed of the noise [m/s]",
        home: 0,
        values: &[1e-6, 1e-3, 1e-2, 0.1, 1.0, 10.0],
        setup: |v| Setup { seconds: 10.0, ..Setup::new(noisy(v), FRAME / 4.0) },
    },
    Sweep {
        name: "thrown at walls, rigid",
        quantity: "speed [m/s], restitution 1",
        home: 0,
        values: &[1.0, 10.0, 50.0, 200.0, 1e3],
        setup: |v| Setup::new(bouncing(v), FRAME / 16.0),
    },
    Sweep {
        name: "rest",
        quantity: "stiffness [N/m] of what starts in its equilibrium",
        home: 1,
        values: &[1e2, 1e3, 1e4, 1e6, 1e8],
        setup: |k| Setup { rest: Rest::Stays, is_laid: true, ..Setup::new(lattice(k), FRAME / 16.0) },
    },
];

const STEPS: [f64; 10] = [1e-6, 1e-5, 1e-4, 2.5e-4, 1e-3, 4e-3, FRAME, 1.0 / 16.0, 0.25, 1.0];
const RATIOS: [f64; 7] = [1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6];
const COUNTS: [f64; 5] = [2.0, 3.0, 5.0, 10.0, 30.0];
const TIMES: [f64; 5] = [1.0, 2.0, 4.0, 16.0, 64.0];
const GRAPHS: [f64; 6] = [3.0, 4.0, 6.0, 10.0, 16.0, 32.0];
const SIZES: [f64; 7] = [0.0, 1e-8, 1e-4, 0.01, 0.1, 0.5, 1.0];
const JUMPS: [f64; 6] = [1e-3, 0.01, 0.1, 1.0, 10.0, 100.0];
const OFFSETS: [f64; 6] = [0.0, 1e2, 1e3, 1e4, 1e5, 1e6];
const MINUTES: [f64; 4] = [1.0, 10.0, 60.0, 600.0];

/// Substeps of a run with a substep of its own: at least so many, and at most as many as 2 s or this have.
const FEWEST_STEPS: f64 = 20.0;
const MOST_STEPS: f64 = 20_000.0;

fn stepped(scene: Value, h: f64) -> Setup {
    let seconds = (MOST_STEPS * h).min(2.0).max(FEWEST_STEPS * h);
    Setup { is_forced: true, seconds, ..Setup::new(scene, h) }
}

/// A bond, a spring where a stiffness [N/m] is said.
fn bond(a: usize, b: usize, stiffness: Option<f64>) -> Value {
    match stiffness {
        Some(k) => json!({ "a": a, "b": b, "kind": "spring", "stiffness": k }),
        None => json!({ "a": a, "b": b }),
    }
}

/// The same with a rest length [m].
fn bond_of(a: usize, b: usize, stiffness: Option<f64>, rest: f64) -> Value {
    let mut bond = bond(a, b, stiffness);
    bond["rest"] = json!(rest);
    bond
}

fn scene(position: Vec<[f64; 2]>, bonds: Vec<Value>, pinned: &[usize]) -> Value {
    json!({ "wobble": 1, "name": "sweep", "points": { "position": position, "mass": 0.1, "pinned": pinned },
            "bonds": bonds, "gravity": [0, -9.81] })
}

/// A hung lattice of 4 x 4 springs of a stiffness [N/m].
fn lattice(k: f64) -> Value {
    json!({ "wobble": 1, "name": "sweep", "gravity": [0, -9.81],
            "bodies": [{ "make": "lattice", "columns": 4, "rows": 4, "spacing": 0.2, "pinned": [12, 13, 14, 15],
                         "material": { "kind": "spring", "stiffness": k, "point_mass": 0.1 } }] })
}

/// A chain, level, held at one end; its other end weighs `ratio` times as much as the others.
fn chain(links: usize, ratio: f64, stiffness: Option<f64>) -> Value {
    let position = (0..=links).map(|i| [i as f64 / links as f64, 0.0]).collect();
    let bonds = (0..links).map(|i| bond(i, i + 1, stiffness)).collect();
    let mut scene = scene(position, bonds, &[0]);
    let mut mass = vec![0.1; links + 1];
    mass[links] *= ratio;
    scene["points"]["mass"] = json!(mass);
    scene
}

/// A ring of bonds of 0.1 m whose points all lie at one place.
fn heap(count: usize, stiffness: Option<f64>) -> Value {
    let sides = if count == 2 { 1 } else { count };
    let bonds = (0..sides).map(|i| bond_of(i, (i + 1) % count, stiffness, 0.1)).collect();
    scene(vec![[0.3, 0.2]; count], bonds, &[])
}

/// A hung rope of springs with rest lengths of so many times the distance.
fn rests(factor: f64) -> Value {
    let position = (0..8).map(|i| [0.1 * f64::from(i), 0.0]).collect();
    let bonds = (0..7).map(|i| bond_of(i, i + 1, Some(1e3), 0.1 * factor)).collect();
    scene(position, bonds, &[0])
}

fn repeated(times: usize, stiffness: Option<f64>) -> Value {
    let position = (0..6).map(|i| [0.2 * f64::from(i), 0.0]).collect();
    let bonds = (0..5).flat_map(|i| (0..times).map(move |_| bond(i, i + 1, stiffness))).collect();
    scene(position, bonds, &[0])
}

/// All pairs of points of a ring, hung by one; lengths are off by up to a share.
fn complete(count: usize, off: f64, stiffness: Option<f64>) -> Value {
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
fn squeezed(across: f64, up: f64) -> Value {
    let position = (0..25).map(place).map(|[x, y]| [across * x, up * y]).collect();
    with_triangles(scene(position, grid(Some(1e3)), &[]))
}

/// A grid of springs with one corner carried across.
fn folded(way: f64) -> Value {
    let mut position: Vec<[f64; 2]> = (0..25).map(place).collect();
    position[24] = position[24].map(|x| x - 0.2 * way);
    with_triangles(scene(position, grid(Some(1e3)), &[]))
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

/// A free grid between walls, and a mouse that is somewhere else in every frame.
fn pushed(strength: f64) -> Value {
    let mut scene = scene((0..25).map(place).collect(), grid(Some(1e3)), &[]);
    scene["mouse"] = json!({ "strength": strength, "radius": 0.4, "track": jumps(1.0) });
    scene["bounds"] = json!({ "min": [-1.5, -1.5], "max": [1.5, 1.5], "restitution": 0.5 });
    scene
}

/// A rope whose pin is thrown about.
fn thrown(way: f64, stiffness: Option<f64>) -> Value {
    let position = (0..8).map(|i| [0.1 * f64::from(i), 0.0]).collect();
    let mut scene = scene(position, (0..7).map(|i| bond(i, i + 1, stiffness)).collect(), &[0]);
    let mut track = jumps(way);
    track[0] = [0.0; 3];
    scene["pin_motion"] = json!([{ "point": 0, "track": track }]);
    scene
}

/// A chain of rigid bonds far from the origin.
fn moved(offset: f64) -> Value {
    let mut scene = chain(5, 1.0, None);
    let position: Vec<[f64; 2]> = (0..=5).map(|i| [offset + 0.2 * f64::from(i), offset]).collect();
    scene["points"]["position"] = json!(position);
    scene
}

/// A free grid of rigid bonds that are more than it needs, with noise on its velocities.
fn noisy(speed: f64) -> Value {
    let mut draw = Draw::new(13);
    let velocity: Vec<[f64; 2]> = (0..25).map(|_| [(); 2].map(|()| speed * (2.0 * draw.unit() - 1.0))).collect();
    let mut scene = scene((0..25).map(place).collect(), grid(None), &[]);
    (scene["points"]["velocity"], scene["gravity"]) = (json!(velocity), json!([0, 0]));
    scene
}

/// A rope of rigid bonds thrown between walls that give back all.
fn bouncing(speed: f64) -> Value {
    let position = (0..8).map(|i| [0.1 * f64::from(i), 0.03 * f64::from(i)]).collect();
    let mut scene = scene(position, (0..7).map(|i| bond(i, i + 1, None)).collect(), &[]);
    let velocity = [speed, -0.5 * speed];
    scene["points"]["velocity"] = json!(vec![velocity; 8]);
    scene["bounds"] = json!({ "min": [-1, -1], "max": [1, 1], "restitution": 1 });
    scene
}
