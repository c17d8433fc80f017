//! Judges a run by what is known of it, by the same rules in every engine.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::bodies::{Body, Pose, Shape, State};
use super::scenes::{GRAVITY, Scene};
use super::vector::{Vector, dot, length, minus};
use crate::heaps::depth;

/// Speed of the farthest corner below which a body rests [m/s].
const CALM: f64 = 1e-2;
/// What comes to rest is looked at for creep in this last part of a scene [s].
const CREEP: f64 = 2.0;

/// How good a run was.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Verdict {
    /// Farthest that a centre ever was from where it truly is [m].
    pub(super) error_m: Option<f64>,
    /// Most that a body ever was turned from how it truly is [rad].
    pub(super) error_rad: Option<f64>,
    /// Most energy above the least before, as a height of all bodies [m].
    pub(super) gained_m: f64,
    /// Deepest that a corner ever was in a plane or another body [m].
    pub(super) deepest_m: f64,
    /// Farthest that a centre got from where it was 2 s before the end, where all are to be at rest [m].
    pub(super) creep_m: Option<f64>,
    /// From when on all rested until the end [s].
    pub(super) calm_after_s: Option<f64>,
    /// From when on all slept until the end [s].
    pub(super) asleep_after_s: Option<f64>,
}

/// A run that is being judged.
pub(super) struct Judge<'a> {
    scene: &'a Scene,
    bodies: &'a [Body],
    shape: Shape,
    /// Of each body at each look.
    truth: Vec<Vec<Option<Pose>>>,
    looks: Vec<f64>,
    taken: usize,
    least_energy: f64,
    marked: Vec<Vector>,
    verdict: Verdict,
}

impl<'a> Judge<'a> {
    /// A run at its start.
    pub(super) fn new(scene: &'a Scene, bodies: &'a [Body], shape: Shape) -> Self {
        let looks = scene.looks();
        let start: Vec<_> = bodies.iter().map(Body::start).collect();
        Judge {
            truth: bodies.iter().map(|body| scene.truth.poses(body, shape, &looks)).collect(),
            scene,
            bodies,
            shape,
            looks,
            taken: 0,
            least_energy: energy(bodies, &start),
            marked: Vec::new(),
            verdict: Verdict {
                error_m: None,
                error_rad: None,
                gained_m: 0.0,
                deepest_m: 0.0,
                creep_m: None,
                calm_after_s: None,
                asleep_after_s: None,
            },
        }
    }

    /// Takes the next look: a state of each body, and whether all sleep.
    pub(super) fn look(&mut self, states: &[State], is_asleep: bool) {
        let time = self.looks[self.taken];
        for (state, truth) in states.iter().zip(&self.truth) {
            let Some(truth) = truth[self.taken] else { continue };
            let away = length(minus(state.pose.centre, truth.centre));
            let turned = (state.pose.angle - truth.angle + PI).rem_euclid(TAU) - PI;
            worsen(&mut self.verdict.error_m, away);
            worsen(&mut self.verdict.error_rad, turned.abs());
        }
        let since = |before: Option<f64>, holds: bool| if holds { before.or(Some(time)) } else { None };
        let speed = |(state, body): (&State, &Body)| length(state.velocity) + state.spin.abs() * body.radius();
        let is_calm = states.iter().zip(self.bodies).map(speed).all(|speed| speed < CALM);
        self.verdict.calm_after_s = since(self.verdict.calm_after_s, is_calm);
        self.verdict.asleep_after_s = since(self.verdict.asleep_after_s, is_asleep);
        self.look_at_energy(states);
        self.look_at_depth(states);
        self.look_at_creep(states, time);
        self.taken += 1;
    }

    /// What came of it.
    pub(super) fn verdict(self) -> Verdict {
        self.verdict
    }

    fn look_at_energy(&mut self, states: &[State]) {
        let (energy, mass) = (energy(self.bodies, states), self.bodies.iter().map(|body| body.mass).sum::<f64>());
        let gained = (energy - self.least_energy) / (mass * GRAVITY);
        self.verdict.gained_m = self.verdict.gained_m.max(if gained.is_nan() { f64::INFINITY } else { gained });
        self.least_energy = self.least_energy.min(energy);
    }

    fn look_at_depth(&mut self, states: &[State]) {
        let outlines = states.iter().zip(self.bodies).map(|(state, body)| body.placed(self.shape, state.pose));
        let outlines: Vec<Vec<Vector>> = outlines.collect();
        for plane in &self.scene.planes {
            let depths = outlines.iter().flatten().map(|&corner| -dot(minus(corner, plane.point), plane.normal));
            self.verdict.deepest_m = depths.fold(self.verdict.deepest_m, f64::max);
        }
        if self.scene.has_contact {
            let ends = outlines.iter().scan(0, |end, outline| {
                *end += outline.len();
                Some((*end - outline.len()..*end).collect())
            });
            let skins: Vec<Vec<usize>> = ends.collect();
            self.verdict.deepest_m = self.verdict.deepest_m.max(depth::deepest(&outlines.concat(), &skins));
        }
    }

    fn look_at_creep(&mut self, states: &[State], time: f64) {
        if !self.scene.rests || time < self.scene.seconds - CREEP - 1e-9 {
            return;
        }
        if self.marked.is_empty() {
            self.marked = states.iter().map(|state| state.pose.centre).collect();
        }
        for (state, &mark) in states.iter().zip(&self.marked) {
            worsen(&mut self.verdict.creep_m, length(minus(state.pose.centre, mark)));
        }
    }
}

/// The larger of two values counts, and what is no number is as bad as can be.
fn worsen(worst: &mut Option<f64>, value: f64) {
    let value = if value.is_nan() { f64::INFINITY } else { value };
    *worst = Some(worst.map_or(value, |worst| worst.max(value)));
}

/// Kinetic and potential energy [J].
fn energy(bodies: &[Body], states: &[State]) -> f64 {
    let of = |(body, state): (&Body, &State)| {
        let kinetic = body.mass * dot(state.velocity, state.velocity) + body.inertia * state.spin * state.spin;
        0.5 * kinetic + body.mass * GRAVITY * state.pose.centre[1]
    };
    bodies.iter().zip(states).map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::bodies::square;
    use crate::rigid::scenes::all;

    fn states(bodies: &[Body], change: impl Fn(&mut State)) -> Vec<State> {
        let mut states: Vec<_> = bodies.iter().map(Body::start).collect();
        states.iter_mut().for_each(change);
        states
    }

    #[test]
    fn a_run_is_judged_by_its_worst_moment() {
        let scenes = all();
        let scene = scenes.iter().find(|scene| scene.name == "land").expect("it is in the list");
        let bodies = [square([0.0, 2.0], [0.0; 2], 0.0), square([3.0, 2.0], [0.0; 2], 0.0)];
        let mut judge = Judge::new(scene, &bodies, Shape::Outline);
        let truth = judge.truth[0].clone();
        for (k, pose) in truth.iter().enumerate() {
            let pose = pose.expect("it is known at each moment");
            // Once 1 cm too low and a whole turn and 0.1 rad further, and 1 m/s for a moment.
            let is_wrong = k + 1 == truth.len();
            judge.look(
                &states(&bodies, |state| {
                    state.pose.centre[1] = pose.centre[1] - if is_wrong { 0.01 } else { 0.0 };
                    state.pose.angle = if is_wrong { TAU + 0.1 } else { 0.0 };
                    state.velocity[0] = if is_wrong { 1.0 } else { 0.0 };
                }),
                !is_wrong,
            );
        }
        let verdict = judge.verdict();
        let near = |value: Option<f64>, expected: f64| value.is_some_and(|value| (value - expected).abs() < 1e-9);
        assert!(
            near(verdict.error_m, 0.01) && near(verdict.error_rad, 0.1) && near(verdict.creep_m, 0.01),
            "{verdict:?}"
        );
        // 0.5 m^2/s^2 over g, less the centimetre.
        assert!(near(Some(verdict.gained_m), 0.5 / GRAVITY - 0.01), "{verdict:?}");
        // Turned by 0.1 rad about 0.99 m above the floor, a corner is so deep.
        assert!(near(Some(verdict.deepest_m), 0.1_f64.cos() + 0.1_f64.sin() - 0.99), "{verdict:?}");
        assert_eq!((verdict.calm_after_s, verdict.asleep_after_s), (None, None));
    }
}
