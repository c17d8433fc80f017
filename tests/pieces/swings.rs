//! Rings of strings: bodies that hang on several, which get taut and slack again by themselves.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::{Dynamics, Solver};

use crate::common::unilateral::{Bodies, Seat, Tie};

/// Triangles of 1 kg a point on strings, as a scene and as the other way has them.
pub(crate) struct Swing {
    pub(crate) scene: Value,
    pub(crate) bodies: Bodies,
    position: Vec<[f64; 2]>,
    /// Corners: point, body, and where it is on that.
    corners: Vec<(usize, usize, [f64; 2])>,
    /// Strings and rods: both points.
    ends: Vec<[usize; 2]>,
}

const GRAVITY: f64 = 9.81;

impl Swing {
    fn new() -> Self {
        let bodies = Bodies { inertias: vec![], ties: vec![], gravity: GRAVITY, place: vec![], speed: vec![] };
        let scene = json!({"wobble": 1, "gravity": [0, -GRAVITY], "method": {"ledger": true, "substep": 1.0 / 960.0},
            "points": {"position": [], "velocity": [], "mass": 1, "pinned": []}, "bonds": []});
        Swing { scene, bodies, position: Vec::new(), corners: Vec::new(), ends: Vec::new() }
    }

    fn list(&mut self, name: &str, key: &str) -> &mut Vec<Value> {
        let of = if key.is_empty() { &mut self.scene[name] } else { &mut self.scene[name][key] };
        of.as_array_mut().unwrap()
    }

    fn point(&mut self, position: [f64; 2], velocity: [f64; 2]) -> usize {
        self.list("points", "position").push(json!(position));
        self.list("points", "velocity").push(json!(velocity));
        self.position.push(position);
        self.position.len() - 1
    }

    /// A pin: its point, and where it is.
    fn pin(&mut self, at: [f64; 2]) -> (usize, Seat) {
        let point = self.point(at, [0.0; 2]);
        self.list("points", "pinned").push(json!(point));
        (point, Seat::At(at))
    }

    /// A triangle: its corners, and where they are on it.
    fn triangle(&mut self, corners: [[f64; 2]; 3], [u, v, spin]: [f64; 3]) -> [(usize, Seat); 3] {
        let middle = [0, 1].map(|k| corners.iter().map(|corner| corner[k]).sum::<f64>() / 3.0);
        let body = self.bodies.inertias.len();
        let mut inertia = 0.0;
        let seats = corners.map(|corner| {
            let arm = [corner[0] - middle[0], corner[1] - middle[1]];
            inertia += arm[0] * arm[0] + arm[1] * arm[1];
            let point = self.point(corner, [u - spin * arm[1], v + spin * arm[0]]);
            self.corners.push((point, body, arm));
            (point, Seat::On(body, arm))
        });
        for k in 0..3 {
            let bond = json!({"a": seats[k].0, "b": seats[(k + 1) % 3].0});
            self.list("bonds", "").push(bond);
        }
        self.bodies.inertias.push([3.0, inertia]);
        self.bodies.place.extend([middle[0], middle[1], 0.0]);
        self.bodies.speed.extend([u, v, spin]);
        seats
    }

    fn apart(&self, ends: [(usize, Seat); 2]) -> f64 {
        let [from, to] = ends.map(|(point, _)| self.position[point]);
        (from[0] - to[0]).hypot(from[1] - to[1])
    }

    /// A string so many times as long as its ends are apart, or a rod.
    fn tie(&mut self, [a, b]: [(usize, Seat); 2], share: f64, is_rod: bool) {
        let rest = share * self.apart([a, b]);
        let bond = if is_rod {
            json!({"a": a.0, "b": b.0, "rest": rest})
        } else {
            json!({"a": a.0, "b": b.0, "rest": rest, "limit": "max"})
        };
        self.list("bonds", "").push(bond);
        self.bodies.ties.push(Tie { ends: [a.1, b.1], rest, is_rod });
        self.ends.push([a.0, b.0]);
    }

    /// By how much a sample differs from where the other way has all points `[m]`.
    pub(crate) fn off(&self, position: &[[f64; 3]]) -> f64 {
        let of = |&(point, body, [x, y]): &(usize, usize, [f64; 2])| {
            let [u, v, angle] = [0, 1, 2].map(|k| self.bodies.place[3 * body + k]);
            let (s, c) = angle.sin_cos();
            (position[point][0] - u - c * x + s * y).hypot(position[point][1] - v - s * x - c * y)
        };
        self.corners.iter().map(of).fold(0.0, f64::max)
    }

    /// By how much a string is too long at most, or a rod off its length `[m]`.
    pub(crate) fn over(&self, position: &[[f64; 3]]) -> f64 {
        let of = |([a, b], tie): (&[usize; 2], &Tie)| {
            let [a, b] = [position[*a], position[*b]];
            let over = (a[0] - b[0]).hypot(a[1] - b[1]) - tie.rest;
            if tie.is_rod { over.abs() } else { over }
        };
        self.ends.iter().zip(&self.bodies.ties).map(of).fold(f64::NEG_INFINITY, f64::max)
    }

    /// One or two bodies on two strings or more each, some of which are slack.
    pub(crate) fn random(seed: u64) -> Self {
        let mut random = Pcg32::seed_from_u64(seed);
        let mut swing = Swing::new();
        let mut between = |low: f64, high: f64| random.random_range(low..high);
        let two = [[-1.0, 0.0], [1.0, 0.0]].map(|[x, y]| [x + between(-0.4, 0.4), y + between(-0.3, 0.3)]);
        let pins = two.map(|at| swing.pin(at));
        let count = 1 + (seed % 2) as usize;
        let mut above = pins;
        for body in 0..count {
            let down = -1.2 * (body + 1) as f64;
            let corners = [[-0.6, 0.0], [0.6, 0.1], [0.1, -0.5]]
                .map(|[x, y]| [x + between(-0.2, 0.2), y + down + between(-0.2, 0.2)]);
            let spin = [between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)];
            let seats = swing.triangle(corners, spin);
            let is_rod = seed % 5 == 3;
            for k in 0..2 {
                let share = if is_rod && k == 0 { 1.0 } else { between(0.9, 1.25).max(1.0) };
                swing.tie([above[k], seats[k]], share, is_rod && k == 0);
            }
            if seed % 3 == 1 {
                swing.tie([above[1], seats[0]], between(1.0, 1.1), false);
            }
            if seed % 7 == 5 {
                // It says what another one says.
                let share = swing.bodies.ties[swing.bodies.ties.len() - 1].rest / swing.apart([above[1], seats[1]]);
                swing.tie([above[1], seats[1]], share, false);
            }
            above = [seats[0], seats[1]];
        }
        swing
    }
}

/// Runs a scene to a time as bodies: all the way no string is too long, and energy is told but for this share.
fn ran(what: &str, swing: &Swing, (time, most): (f64, f64)) -> Box<dyn Dynamics> {
    let mut world = Scene::parse(&swing.scene.to_string(), "swing").unwrap().world(None).unwrap();
    while world.time() + world.substep() <= time + 1e-9 {
        world.step();
        let now = world.sample(world.time());
        let ledger = now.ledger.as_ref().unwrap();
        let (left, over) = (ledger.left_over() / ledger.most_kinetic, swing.over(&now.position));
        assert!(left.abs() < most && over < 1e-9, "{what}: {left} of the motion, {over} m at {} s", now.time);
    }
    assert!(world.moved_by().iter().all(|moved| moved.method == Solver::Rigid), "{what}: {:?}", world.moved_by());
    world
}

#[test]
fn bodies_on_many_strings_are_where_another_way_has_them() {
    let mut far = Vec::new();
    for seed in 0..24 {
        let mut swing = Swing::random(seed);
        let world = ran(&format!("swing {seed}"), &swing, (1.2, 1e-6));
        swing.bodies.run(world.time());
        let off = swing.off(&world.sample(world.time()).position);
        if off > 1e-4 {
            far.push((seed, off));
        }
    }
    // Where strings get taut in quick turns a little more or less is another motion.
    assert!(far.len() <= 1, "{far:?}");
}

#[test]
fn a_level_swing_is_a_pendulum() {
    // Two strings of 1 m, as far apart above as below, let go from 0.5 rad: the platform stays level.
    let (swung, length) = (0.5_f64, 1.0);
    let mut swing = Swing::new();
    let pins = [-0.5, 0.5].map(|x| swing.pin([x, 0.0]));
    let [x, y] = [length * swung.sin(), -length * swung.cos()];
    let corners = [[x - 0.5, y], [x + 0.5, y], [x, y - 0.3]];
    let seats = swing.triangle(corners, [0.0; 3]);
    (0..2).for_each(|k| swing.tie([pins[k], seats[k]], 1.0, false));
    let world = ran("a level swing", &swing, (2.0, 1e-6));
    // theta'' = -g/l sin(theta), by steps of order 4.
    let h = world.time() / 20_000.0;
    let pull = |angle: f64| -GRAVITY / length * angle.sin();
    let (mut angle, mut rate) = (swung, 0.0);
    for _ in 0..20_000 {
        let a = [rate, pull(angle)];
        let b = [rate + 0.5 * h * a[1], pull(angle + 0.5 * h * a[0])];
        let c = [rate + 0.5 * h * b[1], pull(angle + 0.5 * h * b[0])];
        let d = [rate + h * c[1], pull(angle + h * c[0])];
        angle += h / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0]);
        rate += h / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1]);
    }
    let end = world.sample(world.time()).position[seats[1].0];
    let off = (end[0] - 0.5 - length * angle.sin()).hypot(end[1] + length * angle.cos());
    assert!(off < 1e-5, "{off}");
}

#[test]
fn a_swing_that_falls_into_both_strings_at_once_hangs_still() {
    let mut swing = Swing::new();
    let pins = [-0.5, 0.5].map(|x| swing.pin([x, 0.0]));
    let seats = swing.triangle([[-0.5, -0.8], [0.5, -0.8], [0.0, -1.1]], [0.0; 3]);
    (0..2).for_each(|k| swing.tie([pins[k], seats[k]], 1.25, false));
    let world = ran("a swing that falls", &swing, (1.0, 1e-6));
    let end = world.sample(world.time());
    let [left, right] = [0, 1].map(|k| end.position[seats[k].0]);
    assert!((left[1] + 1.0).abs() < 1e-9 && (right[1] + 1.0).abs() < 1e-9, "{left:?} {right:?}");
    // 3 kg fell 0.2 m.
    let lost = end.ledger.unwrap().book.impacts;
    assert!((lost - 3.0 * GRAVITY * 0.2).abs() < 1e-6, "{lost}");
}

#[test]
fn strings_that_are_too_short_for_their_pins_throw_nothing() {
    let mut swing = Swing::new();
    let pins = [-1.0, 1.0].map(|x| swing.pin([x, 0.0]));
    let seats = swing.triangle([[-0.5, -0.1], [0.5, -0.1], [0.0, -0.4]], [0.0; 3]);
    (0..2).for_each(|k| swing.tie([pins[k], seats[k]], 0.8, false));
    let mut world = Scene::parse(&swing.scene.to_string(), "swing").unwrap().world(None).unwrap();
    while world.time() < 2.0 {
        world.step();
        let fastest = world.sample(world.time()).velocity.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max);
        assert!(fastest < 1.0, "{fastest} m/s at {} s", world.time());
    }
}
