//! Whether what slides is slowed by friction times what presses it: seen from the momentum alone, whatever the method.
//!
//! Model: from frame to frame the surface's impulse is J = P' - P - M g dt, P = sum m v `[kg m/s]`. While every point that touches slips
//! one way along one flat surface, Coulomb's law says J_t = friction J_n against the motion, however bonds share the weight.
//! In a blow on one point, whatever else hangs on it: where J_t is less than friction J_n, the point does not slide on.

use crate::scene::Scene;
use crate::sim::{Dynamics, Sample};

/// Distance from a surface within which a point touches it `[m]`.
const NEAR: f64 = 1e-4;
/// Speed along a surface from which a point slips `[m/s]`.
const SLIPS: f64 = 0.02;
/// Frames of slipping that a judgement needs.
const FEWEST: u32 = 3;
/// Most points of a world whose blows are looked at: every step is.
const MOST_POINTS: usize = 64;
/// From how much of what gravity gives within a step on an impulse is a blow.
const BLOW: f64 = 20.0;
/// Share of the speed before a blow that a point may keep along the surface where it sticks: bonds turn it within the step.
const KEPT: f64 = 0.05;

/// A flat surface with friction.
#[derive(Clone, Copy, Debug)]
struct Rough {
    normal: [f64; 2],
    /// normal . x on the surface `[m]`.
    offset: f64,
    friction: f64,
}

/// A frame's end in which something slips.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Slipping {
    surface: usize,
    /// Along the surface's tangent, or against it.
    sign: f64,
}

/// Where a step ended.
#[derive(Clone, Debug)]
struct Passed {
    time: f64,
    momentum: [f64; 2],
    position: Vec<[f64; 3]>,
    velocity: Vec<[f64; 3]>,
}

/// The impulses of a run while it slips.
#[derive(Clone, Debug, Default)]
pub(super) struct Friction {
    surfaces: Vec<Rough>,
    gravity: [f64; 2],
    before: Option<(f64, [f64; 2], Option<Slipping>)>,
    /// What friction took, and what it should have taken `[N s]`.
    taken: f64,
    due: f64,
    frames: u32,
    /// The step before.
    passed: Option<Passed>,
    /// Largest share of friction that a blow left out though the point slid on.
    left_out: Option<f64>,
}

impl Friction {
    /// Of a scene in the plane on which nothing acts but gravity and flat surfaces; nothing is judged of any other.
    pub(super) fn of(scene: &Scene) -> Self {
        let is_flat = scene.obstacles.iter().all(|obstacle| obstacle.plane.is_some());
        let is_free = scene.mouse.is_none()
            && scene.forces.is_empty()
            && scene.drag_rate.unwrap_or(0.0) == 0.0
            && scene.dimensions() == 2;
        let mut friction = Friction::default();
        if !is_flat || !is_free {
            return friction;
        }
        friction.gravity = scene.gravity.map_or([0.0; 2], |g| [g.embed()[0], g.embed()[1]]);
        for obstacle in &scene.obstacles {
            let Some(plane) = &obstacle.plane else { continue };
            let ([px, py, _], [nx, ny, _]) = (plane.point.embed(), plane.normal.embed());
            let length = (nx * nx + ny * ny).sqrt();
            let normal = [nx / length, ny / length];
            friction.add(normal, normal[0] * px + normal[1] * py, obstacle.friction);
        }
        if let Some(bounds) = &scene.bounds {
            let (low, high) = (bounds.min.embed(), bounds.max.embed());
            friction.add([1.0, 0.0], low[0], bounds.friction);
            friction.add([0.0, 1.0], low[1], bounds.friction);
            friction.add([-1.0, 0.0], -high[0], bounds.friction);
            friction.add([0.0, -1.0], -high[1], bounds.friction);
        }
        friction
    }

    fn add(&mut self, normal: [f64; 2], offset: f64, friction: Option<f64>) {
        self.surfaces.push(Rough { normal, offset, friction: friction.unwrap_or(0.0) });
    }

    /// The end of a frame.
    pub(super) fn look(&mut self, world: &dyn Dynamics, sample: &Sample) {
        // A pin takes momentum too.
        if self.surfaces.is_empty() || !world.pinned().is_empty() || !world.gone().is_empty() {
            return;
        }
        let (momentum, mass) = momentum(world, sample);
        let now = self.slipping(sample);
        let last = self.before.replace((sample.time, momentum, now));
        let Some((time, before, Some(slips))) = last.filter(|(.., slips)| *slips == now) else { return };
        let Rough { normal: [nx, ny], friction, .. } = self.surfaces[slips.surface];
        let dt = sample.time - time;
        let impulse: [f64; 2] = std::array::from_fn(|k| momentum[k] - before[k] - mass * self.gravity[k] * dt);
        self.taken -= slips.sign * (impulse[1] * nx - impulse[0] * ny);
        self.due += friction * (impulse[0] * nx + impulse[1] * ny);
        self.frames += 1;
    }

    /// The end of a step.
    pub(super) fn look_at_blows(&mut self, world: &dyn Dynamics) {
        let is_rough = self.surfaces.iter().any(|rough| rough.friction > 0.0);
        if !is_rough || world.point_count() > MOST_POINTS || !world.pinned().is_empty() || !world.gone().is_empty() {
            return;
        }
        let sample = world.sample(world.time());
        let (momentum, mass) = momentum(world, &sample);
        let Sample { time, position, velocity, .. } = sample;
        let now = Passed { time, momentum, position, velocity };
        if let Some(before) = self.passed.take() {
            let left_out = self.surfaces.iter().filter_map(|rough| rough.left_out(&before, &now, (mass, self.gravity)));
            self.left_out = left_out.fold(self.left_out, |most, share| Some(most.unwrap_or(0.0).max(share)));
        }
        self.passed = Some(now);
    }

    /// Which way all points that touch slip; `None` where none does, or not all, or on several surfaces.
    fn slipping(&self, sample: &Sample) -> Option<Slipping> {
        let mut found: Option<Slipping> = None;
        for (x, v) in sample.position.iter().zip(&sample.velocity) {
            for (surface, rough) in self.surfaces.iter().enumerate() {
                let [nx, ny] = rough.normal;
                if (nx * x[0] + ny * x[1] - rough.offset).abs() > NEAR {
                    continue;
                }
                let along = nx * v[1] - ny * v[0];
                let own = Slipping { surface, sign: along.signum() };
                if along.abs() < SLIPS || found.is_some_and(|other| other != own) {
                    return None;
                }
                found = Some(own);
            }
        }
        found
    }

    /// Share that friction is off by `[1]`; `None` where nothing slipped for long enough on a rough surface, and no blow fell on one point.
    pub(super) fn error(&self) -> Option<f64> {
        let slipped = (self.frames >= FEWEST && self.due > 0.0).then(|| (self.taken / self.due - 1.0).abs());
        slipped.into_iter().chain(self.left_out).reduce(f64::max)
    }
}

/// The momentum of all points `[kg m/s]`, and their mass `[kg]`.
fn momentum(world: &dyn Dynamics, sample: &Sample) -> ([f64; 2], f64) {
    world
        .masses()
        .iter()
        .zip(&sample.velocity)
        .fold(([0.0; 2], 0.0), |(sum, mass), (m, v)| ([sum[0] + m * v[0], sum[1] + m * v[1]], mass + m))
}

impl Rough {
    /// Of a vector, what goes along the surface, and off it.
    fn split(&self, v: [f64; 2]) -> [f64; 2] {
        let [nx, ny] = self.normal;
        [nx * v[1] - ny * v[0], nx * v[0] + ny * v[1]]
    }

    /// Of a blow on one point in a step, the share of friction that it did not use though the point slides on; `None`: no such blow.
    fn left_out(&self, before: &Passed, now: &Passed, (mass, gravity): (f64, [f64; 2])) -> Option<f64> {
        let dt = now.time - before.time;
        let jump = |k: usize| now.momentum[k] - before.momentum[k] - mass * gravity[k] * dt;
        let [rubbed, pressed] = self.split([jump(0), jump(1)]);
        let weight = mass * gravity[0].hypot(gravity[1]) * dt;
        let is_same = before.position.len() == now.position.len();
        if self.friction == 0.0 || pressed <= BLOW * weight || !is_same {
            return None;
        }
        let at = |passed: &Passed, i: usize| {
            let ([x, y, _], [vx, vy, _]) = (passed.position[i], passed.velocity[i]);
            let [along, off] = self.split([vx, vy]);
            (self.split([x, y])[1] - self.offset, along, off)
        };
        // It came to the surface within the step, and goes from there.
        let is_hit = |i: &usize| {
            let ((from, _, comes), (to, _, goes)) = (at(before, *i), at(now, *i));
            comes < 0.0 && goes >= 0.0 && from <= NEAR - comes * dt && to <= NEAR + goes * dt
        };
        let mut hit = (0..now.position.len()).filter(is_hit);
        let (Some(point), None) = (hit.next(), hit.next()) else { return None };
        let ((_, slid, came), (_, slides, _)) = (at(before, point), at(now, point));
        let sticks = slides.abs() <= KEPT * slid.hypot(came);
        Some(if sticks { 0.0 } else { (1.0 - rubbed.abs() / (self.friction * pressed)).max(0.0) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::Start;
    use crate::study::stability::{Bounds, Fault, Subject, judge};

    fn error(scene: &str) -> Option<f64> {
        let scene = Scene::parse(scene, "test").unwrap();
        let judged = judge(&Subject::of_start(&Start::from(scene)), Bounds { work: 1.0, seconds: 60.0 });
        assert_eq!(judged.found.faults.contains(&Fault::Friction), judged.found.friction.is_some_and(|off| off > 0.1));
        judged.found.friction
    }

    #[test]
    fn a_point_that_slides_obeys_coulomb() {
        let on = |mu: f64, solver: &str| {
            format!(
                r#"{{"wobble": 1, "points": {{"position": [[0, 0]], "velocity": [[2, 0]]}}, "gravity": [0, -9.81], "duration": 0.4,
                "obstacles": [{{"plane": {{"point": [0, 0], "normal": [0, 1]}}, "friction": {mu}}}],
                "method": {{"solver": "{solver}"}}}}"#
            )
        };
        for solver in ["auto", "rk4", "velocity-verlet"] {
            let off = error(&on(0.3, solver));
            assert!(off.is_some_and(|off| off < 0.02), "{solver}: {off:?}");
        }
        assert_eq!(error(&on(0.0, "auto")), None);
    }

    #[test]
    fn a_blow_on_one_point_of_what_is_bonded_is_judged() {
        // A rough ball falls askew on a floor, alone: it sticks or slides as its friction says. With twice as much friction as it used it
        // would have stuck.
        let rough = Rough { normal: [0.0, 1.0], offset: 0.0, friction: 2.0 };
        let passed = |time: f64, v: [f64; 2]| Passed {
            time,
            momentum: v,
            position: vec![[0.0, 1e-5, 0.0]],
            velocity: vec![[v[0], v[1], 0.0]],
        };
        let blow =
            |after: [f64; 2]| rough.left_out(&passed(0.0, [1.0, -1.0]), &passed(1e-3, after), (1.0, [0.0, -9.81]));
        let is_about = |found: Option<f64>, share: f64| found.is_some_and(|found| (found - share).abs() < 0.02);
        assert!(is_about(blow([0.0, 0.5]), 0.0), "it sticks");
        assert!(is_about(blow([0.25, 0.5]), 0.75), "{:?}", blow([0.25, 0.5]));
        assert!(is_about(blow([1.0, 0.5]), 1.0), "it slides on as if there were no friction");
        assert_eq!(blow([1.0, -1.0]), None);
    }
}
