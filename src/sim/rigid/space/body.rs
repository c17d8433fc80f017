//! One rigid body in space: its motion is read from points, which follow.

use std::sync::Arc;

use super::place::{Matrix, Place, Turn, times, unit};
use super::shape::{Hold, Shape};
use super::{Motion, Twist};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::rigid::motion::Pose;
use crate::sim::rigid::solid::exact;
use crate::sim::vector::{add, cross3, dot, scale, sub};

/// Rounds in which the turn is found that fits best: where bonds keep their lengths the first is there already.
const ROUNDS: u32 = 4;

/// A rigid body.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub(super) shape: Arc<Shape>,
    /// Its points in the group, in the order of the shape.
    pub(super) slots: Vec<u32>,
    /// How far its points are from the origin of the shape, at most `[m]`.
    pub(super) reach: f64,
    /// Inverse mass `[1/kg]`; 0 of what pins hold.
    pub(super) ease: f64,
}

impl Body {
    pub(super) fn new(shape: Arc<Shape>, slots: Vec<u32>) -> Self {
        let ease = if shape.pins.is_empty() { 1.0 / shape.mass } else { 0.0 };
        Body { reach: shape.reach(), slots, ease, shape }
    }

    /// Where the shape fits the places of points best by weight, and the motion that has their momentum and angular momentum.
    ///
    /// Sums are taken about one point, and moved to the middle afterwards.
    pub(super) fn read<S: Real, const D: usize>(&self, points: &Points<S, D>) -> Motion {
        let Shape { places, masses, weights, mass, pins, .. } = &*self.shape;
        let Points { position, velocity, position_lost, velocity_lost, .. } = points;
        let base = exact(position, position_lost, self.slots[pins.first().map_or(0, |&pin| pin as usize)]);
        let (mut way, mut momentum, mut turning) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        let mut fit: Matrix = [[0.0; 3]; 3];
        for (((&slot, &q), &m), &weight) in self.slots.iter().zip(places).zip(masses).zip(weights) {
            let r = sub(exact(position, position_lost, slot), base);
            let v = exact(velocity, velocity_lost, slot);
            let w = scale(r, weight);
            fit = std::array::from_fn(|k| add(fit[k], scale(w, q[k])));
            let r = scale(r, m);
            way = add(way, r);
            momentum = add(momentum, scale(v, m));
            turning = add(turning, cross3(r, v));
        }
        way = scale(way, 1.0 / mass);
        let (middle, velocity, turning) = if pins.is_empty() {
            (add(base, way), scale(momentum, 1.0 / mass), sub(turning, cross3(way, momentum)))
        } else {
            (base, [0.0; 3], turning)
        };
        let place = self.hinged(self.fitted(middle, &fit), points);
        let spin = self.spin(&place, turning);
        Motion { place, twist: Twist { velocity, spin } }
    }

    /// The spin that an angular momentum about the origin makes, in the world.
    #[inline]
    pub(super) fn spin(&self, place: &Place, turning: [f64; 3]) -> [f64; 3] {
        place.turned(times(&self.shape.inverse, self.shape.left(place.back(turning))))
    }

    /// The angular momentum about the origin.
    #[inline]
    pub(super) fn turning(&self, place: &Place, spin: [f64; 3]) -> [f64; 3] {
        place.turned(times(&self.shape.inertia, place.back(spin)))
    }

    /// The turn with the largest sum of weight (turned place) . r, from those sums by the coordinates of places: the two longest axes say
    /// which it is about, then Newton's method.
    fn fitted(&self, middle: [f64; 3], fit: &Matrix) -> Place {
        let [a, b, c] = self.shape.spread;
        let x = unit(fit[0]).unwrap_or([1.0, 0.0, 0.0]);
        let other = if x[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let y = unit(sub(fit[1], scale(x, dot(x, fit[1])))).or_else(|| unit(cross3(x, other))).unwrap_or(other);
        let mut place = Place { middle, axes: [x, y, cross3(x, y)] };
        for _ in 0..ROUNDS {
            let torque = (0..3).fold([0.0; 3], |sum, k| add(sum, cross3(place.axes[k], fit[k])));
            let [p, q, r] = place.back(torque);
            let by = [p / (b + c), q / (a + c), r / (a + b)];
            // NaN is no turn.
            let is_off = dot(by, by) > f64::EPSILON * f64::EPSILON;
            if !is_off {
                break;
            }
            place = place.moved([0.0; 3], Turn::slight(by));
        }
        place
    }

    /// Turned to where its pins are, that a second one holds.
    fn hinged<S: Real, const D: usize>(&self, place: Place, points: &Points<S, D>) -> Place {
        let Hold::Hinge(axis) = self.shape.hold else { return place };
        let along = |&pin: &u32| dot(self.shape.places[pin as usize], axis);
        let Some(&last) = self.shape.pins.iter().max_by(|a, b| along(a).abs().total_cmp(&along(b).abs())) else {
            return place;
        };
        let at = exact(&points.position, &points.position_lost, self.slots[last as usize]);
        let way = scale(sub(at, place.middle), along(&last).signum());
        unit(way).map_or(place, |to| place.moved([0.0; 3], Turn::between(axis, place.back(to))))
    }

    /// The middle of its mass `[m]`.
    pub(super) fn centre(&self, place: &Place) -> [f64; 3] {
        place.out(self.shape.centre)
    }
}
