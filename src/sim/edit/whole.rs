//! Bodies of one piece in the way of obstacles: they go and turn as their mass says.

use super::crowd::{Before, Crowd, Hanging, ROUNDS};
use super::push::{Part, Touch};
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Rounds in which the speeds of a rigid body at all that pushes it are found.
const BLOWS: u32 = 24;

impl<const D: usize> Crowd<D> {
    /// All that pushes a body now.
    pub(super) fn touches(&self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) -> Vec<Touch<D>> {
        let mut touches: Vec<Touch<D>> = before.iter().filter_map(|was| part.touch(self.x[was.i], was.depth)).collect();
        if touches.is_empty() {
            touches.extend(body.bonds.iter().filter_map(|ends| part.pierced(ends.map(|end| self.x[end]))));
        }
        touches
    }

    /// A body of one piece: where it is pushed it goes and, in the plane, turns as its mass says, and gets the speeds.
    pub(super) fn push_whole(&mut self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) {
        let touches = self.touches(body, before, part);
        if touches.is_empty() {
            return;
        }
        let inert = self.inert(body);
        for _ in 0..ROUNDS {
            let deepest = self.touches(body, before, part).into_iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
            let Some(touch) = deepest else { break };
            let (arm, weight) = inert.at(&touch);
            let blow = touch.depth / weight;
            let (by, angle) = (scale(touch.normal, blow / inert.mass), blow * arm / inert.inertia);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            for &i in &body.points {
                let mut from = sub(self.x[i], inert.middle);
                (from[0], from[1]) = (cos * from[0] - sin * from[1], sin * from[0] + cos * from[1]);
                self.x[i] = add(add(inert.middle, from), by);
            }
        }
        if !self.touches(body, before, part).is_empty() {
            // As far as the obstacle goes it is as free as it was.
            let way = part.way(inert.middle);
            before.iter().for_each(|was| self.x[was.i] = add(was.x, way));
        }
        let lacks_room = |x: &[[f64; D]]| before.iter().any(|was| !part.has_room(was.x, x[was.i]));
        if D == 3 && lacks_room(&self.x) {
            // Straight on, where there is none aside.
            let way = part.way(inert.middle);
            before.iter().for_each(|was| self.x[was.i] = add(was.x, way));
        }
        if lacks_room(&self.x) {
            before.iter().for_each(|was| self.x[was.i] = was.x);
        }
        let (mut velocity, mut spin) = (inert.velocity, inert.spin);
        for _ in 0..BLOWS {
            for touch in &touches {
                let (arm, weight) = inert.at(touch);
                let lacking = touch.speed - dot(velocity, touch.normal) - spin * arm;
                if lacking > 0.0 {
                    let blow = lacking / weight;
                    velocity = add(velocity, scale(touch.normal, blow / inert.mass));
                    spin += blow * arm / inert.inertia;
                }
            }
        }
        let (faster, turns) = (sub(velocity, inert.velocity), spin - inert.spin);
        for &Before { i, x, .. } in before {
            let from = sub(x, inert.middle);
            let mut more = faster;
            (more[0], more[1]) = (more[0] - turns * from[1], more[1] + turns * from[0]);
            (self.v[i], self.is_changed[i]) = (add(self.v[i], more), true);
        }
    }

    /// A body as one piece.
    pub(super) fn inert(&self, body: &Hanging) -> Inert<D> {
        let mass = |i: usize| 1.0 / self.w[i];
        let whole: f64 = body.points.iter().map(|&i| mass(i)).sum();
        let mean = |of: &[[f64; D]]| {
            let sum = body.points.iter().fold(zero(), |sum, &i| add(sum, scale(of[i], mass(i))));
            scale(sum, 1.0 / whole)
        };
        let (middle, velocity) = (mean(&self.x), mean(&self.v));
        let (mut inertia, mut turning) = (0.0, 0.0);
        for &i in &body.points {
            let (from, v) = (sub(self.x[i], middle), sub(self.v[i], velocity));
            inertia += mass(i) * dot(from, from);
            turning += mass(i) * (from[0] * v[1] - from[1] * v[0]);
        }
        Inert { middle, velocity, mass: whole, inertia, spin: turning / inertia }
    }
}

/// A body as one piece: its middle `[m]`, mass `[kg]`, inertia `[kg m^2]` and motion.
pub(super) struct Inert<const D: usize> {
    pub(super) middle: [f64; D],
    pub(super) velocity: [f64; D],
    mass: f64,
    inertia: f64,
    spin: f64,
}

impl<const D: usize> Inert<D> {
    /// The arm of a blow there `[m]`, and what one of 1 kg m/s makes its place faster by `[1/kg]`. In space it does not turn: a turn about z
    /// alone would lead it into the floor.
    fn at(&self, touch: &Touch<D>) -> (f64, f64) {
        if D != 2 {
            return (0.0, 1.0 / self.mass);
        }
        let from = sub(touch.at, self.middle);
        let arm = from[0] * touch.normal[1] - from[1] * touch.normal[0];
        (arm, 1.0 / self.mass + arm * arm / self.inertia)
    }
}
