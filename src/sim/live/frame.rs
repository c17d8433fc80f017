//! A rigid body of a cluster, or a rigid piece of a body in joints, as it moves: where it is, how fast, and what pushes make of that.
//!
//! A push J `[kg m]` at r from the middle moves that by J/m and turns the body by r x J/I: of the point there the inverse mass along n is
//! 1/m + (r x n)^2/I.

use std::sync::Arc;

use crate::sim::real::Real;
use crate::sim::rigid::motion::{Pose, Twist};
use crate::sim::rigid::place::Place;
use crate::sim::rigid::shape::Shape;
use crate::sim::vector::{add, convert, cross, dot, scale, sub};

/// A rigid body of a cluster as it moves.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) shape: Arc<Shape>,
    /// Of its mass `[1/kg]` and its moment of inertia `[1/(kg m^2)]`.
    pub(super) inverse: [f64; 2],
    /// Its points, in the order of the shape.
    pub(super) points: Vec<u32>,
    /// Where the substep found it; where it starts, after what was put in its place without speed; and as far as it is solved.
    pub(super) found: Place,
    pub(super) start: Place,
    pub(super) now: Place,
    /// Where its velocity alone takes it from its start.
    pub(super) free: Place,
    /// `[m/s]`, `[rad/s]`
    pub(super) velocity: [f64; 2],
    pub(super) spin: f64,
    /// What these are to be changed by beyond what the way says, times the substep `[m, rad]`.
    pub(super) turned: Twist,
    /// Its points that may touch something in the substep, counted in the shape, and those that others are fastened to.
    pub(super) near: Vec<u32>,
    pub(super) fastened: Vec<u32>,
    /// A pin holds it within an obstacle, which it cannot leave (`nailed.rs`).
    pub(super) is_nailed: bool,
    /// It is a whole body on whose points nothing acts but gravity and drag, or contacts: it moves by itself, and they follow.
    pub(super) is_free: bool,
}

/// A small motion of a body: of its middle `[m]`, and by an angle `[rad]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Shift {
    pub(super) way: [f64; 2],
    pub(super) turn: f64,
}

impl Shift {
    pub(super) fn between(from: &Place, to: &Place) -> Self {
        Shift { way: sub(to.middle, from.middle), turn: to.angle - from.angle }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Shift { way: add(self.way, other.way), turn: self.turn + other.turn }
    }

    pub(super) fn less(&self, other: &Self) -> Self {
        Shift { way: sub(self.way, other.way), turn: self.turn - other.turn }
    }
}

/// What a push changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    /// The way within the substep, which becomes speed.
    Way,
    /// The start of the substep too: it becomes none.
    Place,
    /// The velocity `[m/s]` at its end.
    Velocity,
}

impl Frame {
    /// Where the shape fits places best, by mass; `points` of it, the first, are those of the cluster.
    pub(super) fn of(shape: &Arc<Shape>, points: Vec<u32>, at: impl Fn(usize) -> [f64; 2]) -> Self {
        let origin = at(0);
        let sum = (0..shape.places.len())
            .fold([0.0; 2], |sum, k| add(sum, scale(sub(at(k), origin), shape.masses[k] / shape.mass)));
        let middle = add(origin, sum);
        let mut fit = [0.0; 2];
        for (k, (&q, &mass)) in shape.places.iter().zip(&shape.masses).enumerate() {
            let r = sub(at(k), middle);
            fit = add(fit, scale([dot(q, r), cross(q, r)], mass));
        }
        let length = dot(fit, fit).sqrt();
        let turn = if length > 0.0 { scale(fit, 1.0 / length) } else { [1.0, 0.0] };
        let place = Place { middle, angle: 0.0, turn };
        Frame {
            shape: shape.clone(),
            inverse: [1.0 / shape.mass, 1.0 / shape.inertia],
            points,
            found: place,
            start: place,
            now: place,
            free: place,
            velocity: [0.0; 2],
            spin: 0.0,
            turned: Twist::STILL,
            near: Vec::new(),
            fastened: Vec::new(),
            is_nailed: false,
            is_free: false,
        }
    }

    /// It moves as its points do, which go so fast.
    pub(super) fn take_motion(&mut self, velocity: impl Fn(usize) -> [f64; 2]) {
        let (mut momentum, mut turning) = ([0.0; 2], 0.0);
        for (k, (&q, &mass)) in self.shape.places.iter().zip(&self.shape.masses).enumerate() {
            let v = scale(velocity(k), mass);
            momentum = add(momentum, v);
            turning += cross(self.now.turned(q), v);
        }
        self.velocity = scale(momentum, 1.0 / self.shape.mass);
        self.spin = turning / self.shape.inertia;
    }

    pub(super) fn mass(&self) -> f64 {
        self.shape.mass
    }

    /// How many of its points are worked on in a substep.
    pub(super) fn busy(&self) -> usize {
        if self.is_free { self.shape.surface.len() } else { self.points.len() }
    }

    /// Its kinetic energy `[J]`.
    pub(super) fn kinetic(&self) -> f64 {
        0.5 * (self.shape.mass * dot(self.velocity, self.velocity) + self.shape.inertia * self.spin * self.spin)
    }

    /// The mean square of the speeds of its points, by mass `[m^2/s^2]`.
    pub(super) fn mean_square(&self) -> f64 {
        2.0 * self.kinetic() / self.shape.mass
    }

    /// Gravity gives it `fall` `[m/s]`, and drag leaves a share of what it has.
    pub(super) fn fall(&mut self, fall: [f64; 2], kept: f64) {
        self.velocity = scale(add(self.velocity, fall), kept);
        self.spin *= kept;
    }

    /// It gets faster.
    pub(super) fn speed_up(&mut self, gain: [f64; 2]) {
        self.velocity = add(self.velocity, gain);
    }

    /// It moves less about a mean velocity.
    pub(super) fn slow(&mut self, mean: [f64; 2], kept: f64) {
        self.velocity = add(mean, scale(sub(self.velocity, mean), kept));
        self.spin *= kept;
    }

    /// Place and velocity of each of its points, in the order of the shape.
    pub(super) fn state(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.shape.places.iter().map(|&q| [self.now.out(q), self.velocity_of(q)])
    }

    /// Of its mass `[1/kg]`.
    pub(super) fn ease(&self) -> f64 {
        self.inverse[0]
    }

    /// Of its mass `[1/kg]` and its moment of inertia `[1/(kg m^2)]`.
    pub(super) fn inverse(&self) -> [f64; 2] {
        self.inverse
    }

    pub(super) fn place(&self) -> Place {
        self.now
    }

    /// How far it is from where its velocity alone would take it.
    pub(super) fn pushed(&self) -> Shift {
        Shift::between(&self.free, &self.now)
    }

    /// How far it was led in this substep without speed.
    pub(super) fn led(&self) -> Shift {
        Shift::between(&self.found, &self.start)
    }

    /// Where it was as the substep began.
    pub(super) fn begun(&self) -> Place {
        self.start
    }

    /// Its velocity is to be changed by so much beyond what its way says, times the substep `[m, rad]`.
    pub(super) fn turn_back(&mut self, change: Twist) {
        self.turned.velocity = add(self.turned.velocity, change.velocity);
        self.turned.spin += change.spin;
    }

    pub(super) fn twist(&self) -> Twist {
        Twist { velocity: self.velocity, spin: self.spin }
    }

    /// Inverse mass of the point at `x` along a direction `[1/kg]`.
    #[inline(always)]
    pub(super) fn weight(&self, x: [f64; 2], n: [f64; 2]) -> f64 {
        let lever = cross(sub(x, self.now.middle), n);
        self.inverse[0] + lever * lever * self.inverse[1]
    }

    /// A push at `x`: `[kg m]`, or `[kg m/s]` where it changes velocities.
    #[inline(always)]
    pub(super) fn push(&mut self, x: [f64; 2], push: [f64; 2], change: Change) {
        let turn = cross(sub(x, self.now.middle), push) * self.inverse[1];
        let way = scale(push, self.inverse[0]);
        match change {
            Change::Way => self.now = self.now.moved(way, turn),
            Change::Place => {
                self.start = self.start.moved(way, turn);
                self.free = self.free.moved(way, turn);
                self.now = self.now.moved(way, turn);
            }
            Change::Velocity => {
                self.velocity = add(self.velocity, way);
                self.spin += turn;
            }
        }
    }

    /// Velocity of the point at `q` of the shape.
    #[inline(always)]
    pub(super) fn velocity_of(&self, q: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.now.turned(q);
        add(self.velocity, scale([-y, x], self.spin))
    }

    /// Way of the point at `q` of the shape: exact where it is short.
    #[inline(always)]
    pub(super) fn way_of(&self, q: [f64; 2]) -> [f64; 2] {
        add(sub(self.now.middle, self.start.middle), sub(self.now.turned(q), self.start.turned(q)))
    }
}

/// Places, ways, starts, how far they have gone, and velocities of the points of a cluster.
pub(super) type Lists<'a, S> = (&'a mut [[S; 2]], &'a mut [[S; 2]], &'a mut [[S; 2]], &'a mut [S], &'a mut [[S; 2]]);

/// Points of a frame that may touch something follow what was changed of it.
#[inline(always)]
pub(super) fn follow<S: Real>(frame: &Frame, (now, way, start, gone, velocity): Lists<'_, S>, change: Change) {
    for &k in &frame.near {
        let (i, q) = (frame.points[k as usize] as usize, frame.shape.places[k as usize]);
        if change == Change::Velocity {
            velocity[i] = convert(frame.velocity_of(q));
            continue;
        }
        if change == Change::Place {
            let before = start[i];
            start[i] = convert(frame.start.out(q));
            let shift = sub(start[i], before);
            gone[i] += dot(shift, shift).sqrt();
        }
        way[i] = convert(frame.way_of(q));
        now[i] = convert(frame.now.out(q));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::rigid::shape::Held;

    #[test]
    fn a_push_moves_and_turns_as_much_as_the_weight_says() {
        let places: [[f64; 2]; 3] = [[2.0, 1.0], [3.0, 1.0], [3.0, 2.0]];
        let bonds = vec![([0, 1], 1.0), ([1, 2], 1.0), ([0, 2], 2.0_f64.sqrt())];
        let held = Held { now: places.to_vec(), masses: vec![1.0, 2.0, 3.0], bonds, surface: &[] };
        let shape = Arc::new(Shape::of(held).unwrap_or_else(|| unreachable!("it is rigid")));
        let mut frame = Frame::of(&shape, vec![0, 1, 2], |k| places[k]);
        let (x, n) = (places[2], [0.6, 0.8]);
        let weight = frame.weight(x, n);
        frame.push(x, scale(n, 1e-7), Change::Way);
        let q = shape.places[2];
        assert!((dot(frame.way_of(q), n) / 1e-7 - weight).abs() < 1e-6, "{weight}");
        assert!(dot(sub(frame.start.out(q), x), sub(frame.start.out(q), x)).sqrt() < 1e-12);
    }
}
