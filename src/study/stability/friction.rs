//! Whether what slides is slowed by friction times what presses it: seen from the momentum alone, whatever the method.
//!
//! Model: from frame to frame the surface's impulse is J = P' - P - M g dt, P = sum m v [kg m/s]. While every point that touches slips
//! one way along one flat surface, Coulomb's law says J_t = friction J_n against the motion, however bonds share the weight.

use crate::scene::Scene;
use crate::sim::{Dynamics, Sample};

/// Distance from a surface within which a point touches it [m].
const NEAR: f64 = 1e-4;
/// Speed along a surface from which a point slips [m/s].
const SLIPS: f64 = 0.02;
/// Frames of slipping that a judgement needs.
const FEWEST: u32 = 3;

/// A flat surface with friction.
#[derive(Clone, Copy, Debug)]
struct Rough {
    normal: [f64; 2],
    /// normal . x on the surface [m].
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

/// The impulses of a run while it slips.
#[derive(Clone, Debug, Default)]
pub(super) struct Friction {
    surfaces: Vec<Rough>,
    gravity: [f64; 2],
    before: Option<(f64, [f64; 2], Option<Slipping>)>,
    /// What friction took, and what it should have taken [N s].
    taken: f64,
    due: f64,
    frames: u32,
}

impl Friction {
    /// Of a scene in the plane on which nothing acts but gravity and flat surfaces; nothing is judged of any other.
    pub(super) fn of(scene: &Scene) -> Self {
        let is_flat = scene.obstacles.iter().all(|obstacle| obstacle.plane.is_some());
        let is_free = scene.mouse.is_none() && scene.drag_rate.unwrap_or(0.0) == 0.0 && scene.dimensions() == 2;
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
        let (mut momentum, mut mass) = ([0.0; 2], 0.0);
        for (m, v) in world.masses().iter().zip(&sample.velocity) {
            momentum = [momentum[0] + m * v[0], momentum[1] + m * v[1]];
            mass += m;
        }
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

    /// Share that friction is off by [1]; `None` where nothing slipped for long enough on a rough surface.
    pub(super) fn error(&self) -> Option<f64> {
        (self.frames >= FEWEST && self.due > 0.0).then(|| (self.taken / self.due - 1.0).abs())
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
}
