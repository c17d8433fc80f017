//! Bonds that get taut, go slack or break do so at their moment, not at the end of a substep: against closed forms.

use super::common::physics::{run_to, spring};
use wobble::search::search;
use wobble::sim::{Bond, BondKind, Dynamics, Limit, Method, Model, PointId, Sample, Solver, build};

const G: f64 = 9.81;

fn model(position: Vec<[f64; 2]>, velocity: Vec<[f64; 2]>, bonds: Vec<Bond>, pinned: &[u32]) -> Model<2> {
    Model {
        mass: vec![1.0; position.len()],
        position,
        velocity,
        bonds: bonds.into(),
        pinned: pinned.iter().map(|&i| PointId(i)).collect(),
        gravity: [0.0, -G],
        ..Model::default()
    }
}

fn string(a: u32, b: u32, rest_length: f64) -> Bond {
    Bond { limit: Limit::Max, ..Bond::new(PointId(a), PointId(b), rest_length) }
}

fn end(scene: &Model<2>, solver: Solver, h: f64, t: f64) -> (Sample, Box<dyn Dynamics>) {
    let mut scene = scene.clone();
    scene.method = Method { solver, substep: Some(h), ..Method::default() };
    scene.duration = Some(t);
    let mut world = build(&scene).unwrap();
    (run_to(&mut *world, t), world)
}

fn distance(sample: &Sample, point: usize, truth: [f64; 2]) -> f64 {
    (sample.position[point][0] - truth[0]).hypot(sample.position[point][1] - truth[1])
}

/// The root of a function that falls through 0 between two places.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// A mass on a string of length 1 from a pin at the origin, in flight or as a pendulum: the truth in its own coordinates.
#[derive(Clone, Copy, Debug)]
enum Ball {
    Flying {
        x: [f64; 2],
        v: [f64; 2],
    },
    /// Angle from straight down and its speed.
    Swinging {
        angle: f64,
        speed: f64,
    },
}

impl Ball {
    fn place(self) -> [f64; 2] {
        match self {
            Ball::Flying { x, .. } => x,
            Ball::Swinging { angle, .. } => [angle.sin(), -angle.cos()],
        }
    }

    /// Flies or swings for `t`, whatever the string would say.
    fn after(self, t: f64) -> Ball {
        match self {
            Ball::Flying { x, v } => {
                Ball::Flying { x: [x[0] + v[0] * t, x[1] + v[1] * t - 0.5 * G * t * t], v: [v[0], v[1] - G * t] }
            }
            Ball::Swinging { mut angle, mut speed } => {
                let steps = 20_000;
                let h = t / f64::from(steps);
                let pull = |angle: f64| -G * angle.sin();
                for _ in 0..steps {
                    let (a1, v1) = (pull(angle), speed);
                    let (a2, v2) = (pull(angle + 0.5 * h * v1), speed + 0.5 * h * a1);
                    let (a3, v3) = (pull(angle + 0.5 * h * v2), speed + 0.5 * h * a2);
                    let (a4, v4) = (pull(angle + h * v3), speed + h * a3);
                    angle += h / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
                    speed += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
                }
                Ball::Swinging { angle, speed }
            }
        }
    }

    /// Above 0 until the string gets taut or lets go.
    fn margin(self) -> f64 {
        match self {
            Ball::Flying { x, .. } => 1.0 - x[0].hypot(x[1]),
            Ball::Swinging { angle, speed } => speed * speed + G * angle.cos(),
        }
    }

    /// The string gets taut, and takes the velocity along itself; or lets go.
    fn turned(self) -> Ball {
        let [x, y] = self.place();
        match self {
            Ball::Flying { v, .. } => Ball::Swinging { angle: x.atan2(-y), speed: x * v[1] - y * v[0] },
            Ball::Swinging { speed, .. } => Ball::Flying { x: [x, y], v: [-speed * y, speed * x] },
        }
    }

    /// The motion for `t`, with a look every 0.01 s.
    fn run(mut self, mut t: f64) -> Ball {
        while t > 0.0 {
            let step = t.min(0.01);
            if self.after(step).margin() < 0.0 {
                let at = root(0.0, step, |t| self.after(t).margin());
                self = self.after(at).turned();
                t -= at;
            } else {
                self = self.after(step);
                t -= step;
            }
        }
        self
    }
}

#[test]
fn a_falling_mass_is_caught_by_its_string() {
    let (x, v) = ([0.3, 0.2], [0.5, 0.0]);
    let truth = Ball::Flying { x, v }.run(2.0).place();
    let scene = model(vec![[0.0, 0.0], x], vec![[0.0; 2], v], vec![string(0, 1, 1.0)], &[0]);
    let error = |solver, h| distance(&end(&scene, solver, h, 2.0).0, 1, truth);
    let order = (error(Solver::Rk4, 0.04) / error(Solver::Rk4, 0.02)).log2();
    assert!(order > 3.5 && order < 5.5, "{order}");
    assert!(error(Solver::Rk8, 0.02) < 1e-10, "{:e}", error(Solver::Rk8, 0.02));
    assert!(error(Solver::Pefrl, 0.0025) < 1e-6, "{:e}", error(Solver::Pefrl, 0.0025));
}

#[test]
fn a_swing_too_high_for_its_speed_lets_go_and_is_caught_again() {
    let start = Ball::Swinging { angle: 0.0, speed: 5.5 };
    let scene = model(vec![[0.0, 0.0], [0.0, -1.0]], vec![[0.0; 2], [5.5, 0.0]], vec![string(0, 1, 1.0)], &[0]);
    let error = |solver, h, t| {
        let (sample, world) = end(&scene, solver, h, t);
        (distance(&sample, 1, start.run(t).place()), world.counters().events)
    };
    assert!(matches!(start.run(0.6), Ball::Flying { .. }) && matches!(start.run(1.5), Ball::Swinging { .. }));
    let (flying, events) = error(Solver::Rk8, 0.02, 0.6);
    assert!(flying < 1e-9 && events == 1, "{flying:e}, {events} events");
    let (caught, events) = error(Solver::Rk8, 0.02, 1.5);
    assert!(caught < 1e-8 && events == 2, "{caught:e}, {events} events");
    let order = (error(Solver::Rk4, 0.01, 1.5).0 / error(Solver::Rk4, 0.005, 1.5).0).log2();
    assert!(order > 3.5 && order < 5.5, "{order}");
}

/// A mass of 1 kg that a spring of length 1 holds on one side only, thrown out of its reach and back: flights and
/// oscillations w^2 = k about where the spring carries the weight.
fn thrown(k: f64, t: f64, [mut s, mut v]: [f64; 2], pull: f64) -> f64 {
    // s: how far the spring is strained, in the direction of gravity; it acts where s > 0.
    let w = k.sqrt();
    let mut left = t;
    loop {
        let rest = pull / k;
        let swing = move |t: f64| {
            let (c, d) = (s - rest, v / w);
            [rest + c * (w * t).cos() + d * (w * t).sin(), w * (d * (w * t).cos() - c * (w * t).sin())]
        };
        let fly = move |t: f64| [s + v * t + 0.5 * pull * t * t, v + pull * t];
        let acts = s > 0.0 || (s == 0.0 && v > 0.0);
        let after = |t: f64| if acts { swing(t) } else { fly(t) };
        let sign = if acts { 1.0 } else { -1.0 };
        let mut at = 1e-3;
        while at < left && sign * after(at)[0] > 0.0 {
            at += 1e-3;
        }
        if at >= left {
            return after(left)[0];
        }
        let at = root(1e-6_f64.max(at - 1e-3), at, |t| sign * after(t)[0]);
        v = after(at)[1];
        s = 0.0;
        left -= at;
    }
}

#[test]
fn springs_with_a_limit_keep_the_order() {
    let (k, t) = (400.0, 1.7);
    for limit in [Limit::Max, Limit::Min] {
        // Below its pin a string holds it, above it a strut.
        let side = if limit == Limit::Max { -1.0 } else { 1.0 };
        let bond = Bond { limit, ..spring(0, 1, 1.0, k, 0.0) };
        let strained = 1.0 + if limit == Limit::Max { 0.2 } else { -0.2 };
        let mut scene = model(vec![[0.0, 0.0], [0.0, side * strained]], vec![[0.0; 2]; 2], vec![bond], &[0]);
        let s = thrown(k, t, [0.2, 0.0], G);
        let truth = [0.0, side - s];
        scene.duration = Some(t);
        let error = |solver, h| distance(&end(&scene, solver, h, t).0, 1, truth);
        let errors = [0.01, 0.005, 0.0025, 0.00125].map(|h| error(Solver::Rk4, h));
        let order = (errors[0] / errors[3]).log2() / 3.0;
        assert!(order > 3.5 && order < 5.0, "{limit:?}: {order} {errors:?}");
        assert!(error(Solver::Rk8, 0.01) < 1e-9, "{limit:?}: {:e}", error(Solver::Rk8, 0.01));
        let found = search(&scene, 1e-6, &[t]).unwrap();
        assert!(found.is_reached && found.substeps < 20_000, "{limit:?}: {found:?}");
        let (solver, h) = (found.method.solver, found.method.substep.unwrap());
        assert!(error(solver, h) < 1e-6, "{limit:?}: {found:?}");
    }
}

/// A spring of length 1 that is let go with its mass: stretched by (m g/k) (1 - cos w t) until it breaks.
fn dropped(k: f64, strain: f64, t: f64) -> f64 {
    let (w, rest) = (k.sqrt(), G / k);
    let at = (1.0 - strain / rest).acos() / w;
    if t < at {
        return -1.0 - rest * (1.0 - (w * t).cos());
    }
    -1.0 - strain - rest * w * (w * at).sin() * (t - at) - 0.5 * G * (t - at) * (t - at)
}

#[test]
fn a_bond_breaks_at_its_moment() {
    let weak = Bond { break_strain: 0.15, ..spring(0, 1, 1.0, 100.0, 0.0) };
    let scene = model(vec![[0.0, 0.0], [0.0, -1.0]], vec![[0.0; 2]; 2], vec![weak], &[0]);
    let truth = [0.0, dropped(100.0, 0.15, 1.0)];
    let error = |solver, h| {
        let (sample, world) = end(&scene, solver, h, 1.0);
        assert_eq!(world.counters().bonds_torn, 1);
        distance(&sample, 1, truth)
    };
    let order = (error(Solver::Rk4, 0.04) / error(Solver::Rk4, 0.02)).log2();
    assert!((order - 4.0).abs() < 0.6, "{order}");
    assert!(error(Solver::Rk8, 0.02) < 1e-10 && error(Solver::BlanesMoan6, 0.02) < 1e-9);
    assert!(error(Solver::VelocityVerlet, 0.001) < 1e-2, "not located");
}

/// Two islands of different speeds, which have substeps of their own: each breaks at its moment, in either order.
#[test]
fn islands_break_one_after_the_other() {
    // The second after the first, before it, and both within one step of the world.
    for breaks in [[1e-3, 9e-4], [0.15, 6.5e-4], [1e-3, 7.5e-4], [1e-3, 6.5e-4]] {
        let bonds = [(0, 1, 100.0, breaks[0]), (2, 3, 2e4, breaks[1])];
        let bonds = bonds.map(|(a, b, k, break_strain)| Bond { break_strain, ..spring(a, b, 1.0, k, 1e-12) });
        let position = vec![[0.0, 0.0], [0.0, -1.0], [3.0, 0.0], [3.0, -1.0]];
        let scene = model(position, vec![[0.0; 2]; 4], bonds.to_vec(), &[0, 2]);
        let mut world = build(&scene).unwrap();
        assert_eq!(world.parts().len(), 2);
        let sample = run_to(&mut *world, 0.6);
        assert_eq!(world.counters().bonds_torn, 2);
        for (point, x, k, strain) in [(1, 0.0, 100.0, breaks[0]), (3, 3.0, 2e4, breaks[1])] {
            let error = distance(&sample, point, [x, dropped(k, strain, 0.6)]);
            assert!(error < 3e-5, "{breaks:?}, point {point}: {error:e}");
        }
    }
}

#[test]
fn a_string_at_its_length_does_not_chatter() {
    // Hung at rest, standing on its pin in balance, at rest without gravity, and let go at the level.
    let hung = model(vec![[0.0, 0.0], [0.0, -1.0]], vec![[0.0; 2]; 2], vec![string(0, 1, 1.0)], &[0]);
    let mut floating = hung.clone();
    floating.gravity = [0.0, 0.0];
    let mut doubled = hung.clone();
    doubled.bonds.push(string(0, 1, 1.0));
    let elastic = |scene: &Model<2>| {
        let bonds =
            scene.bonds.iter().map(|bond| Bond { kind: BondKind::Spring { stiffness: 1e3, damping: 1.0 }, ..bond });
        Model { bonds: bonds.collect(), ..scene.clone() }
    };
    for (name, scene) in [("hung", &hung), ("floating", &floating), ("doubled", &doubled)] {
        for scene in [scene.clone(), elastic(scene)] {
            let (sample, world) = end(&scene, Solver::Rk4, 0.005, 1.0);
            assert!(world.counters().events <= 4, "{name}: {:?}", world.counters());
            assert!((sample.position[1][1] + 1.0).abs() < 0.03, "{name}: {sample:?}");
        }
    }
    let level = model(vec![[0.0, 0.0], [1.0, 0.0]], vec![[0.0; 2]; 2], vec![string(0, 1, 1.0)], &[0]);
    let truth = Ball::Swinging { angle: std::f64::consts::FRAC_PI_2, speed: 0.0 }.after(0.5).place();
    let (sample, world) = end(&level, Solver::Rk8, 0.01, 0.5);
    assert!(distance(&sample, 1, truth) < 1e-9 && world.counters().events <= 2, "{:?}", world.counters());
}

/// Links of a slack rope get each other taut in turn, in flights that shrink without end: the substeps must not.
#[test]
fn a_rope_of_strings_is_caught_without_endless_events() {
    let count = 10_u32;
    let position: Vec<[f64; 2]> =
        (0..=count).map(|i| [0.2 * f64::from(i), 0.02 * (7.0 * f64::from(i)).sin()]).collect();
    let length = |i: u32| {
        let [a, b] = [position[i as usize], position[i as usize + 1]];
        1.15 * (a[0] - b[0]).hypot(a[1] - b[1])
    };
    let bonds = (0..count).map(|i| string(i, i + 1, length(i))).collect();
    let mut scene = model(position.clone(), vec![[0.0; 2]; 11], bonds, &[0, count]);
    scene.mass = (0..=count).map(|i| 0.1 + 0.01 * f64::from(i * 7 % 5)).collect();
    let (truth, world) = end(&scene, Solver::Rk8, 0.0005, 1.0);
    assert!(world.counters().events < 100, "{:?}", world.counters());
    assert!(truth.max_strain < 0.2);
    let error = |h| {
        let (sample, world) = end(&scene, Solver::Rk4, h, 1.0);
        assert!(world.counters().events < 100, "{:?}", world.counters());
        (0..=10).map(|i| distance(&sample, i, [truth.position[i][0], truth.position[i][1]])).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(0.001), error(0.0005));
    assert!(fine < 1e-6 && (coarse / fine).log2() > 3.0, "{coarse:e} {fine:e}");
    scene.duration = Some(1.0);
    let found = search(&scene, 1e-6, &[1.0]).unwrap();
    assert!(found.is_reached && found.substeps < 100_000, "{found:?}");
}

/// A throw that passes the length of a string by 4e-5 m in the middle of one long substep, in free flight.
#[test]
fn an_edge_that_is_grazed_within_a_substep_is_seen() {
    let x = |t: f64| [2.0 * t, 1.0 + 4e-5 - 0.5 * G * t * t + 2.0 * t * t];
    // Relative to the pin the arc has its farthest point near the middle of the first substep of 0.02 s.
    let t0 = -0.0101;
    let start = x(t0);
    let velocity = [2.0, -(G - 4.0) * t0];
    let mut scene = model(vec![[0.0, 0.0], start], vec![[0.0; 2], velocity], vec![string(0, 1, 1.0)], &[0]);
    scene.gravity = [0.0, -(G - 4.0)];
    let (_, world) = end(&scene, Solver::Rk8, 0.02, 0.02);
    let farthest = (0..=2000).map(|i| x(t0 + 1e-5 * f64::from(i))).map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
    assert!(start[0].hypot(start[1]) < 1.0 && farthest > 1.0, "{farthest}");
    assert!(world.counters().events >= 1, "{:?}", world.counters());
}
