//! What a rigid body is by its dimension: all that bodies in the plane and in space do alike stands on this.

use std::cell::Cell;

use super::course::STILL;
use super::field::Field;
use super::inertia::Inertial;
use super::motion::{Axial, Motion, Pose, Twist};
use super::touch::Near;
use crate::sim::ledger::Book;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, resized, sub, widen};

/// Spins of a body.
pub(super) type SpinOf<B, const N: usize> = <<B as Solid<N>>::Place as Pose<N>>::Spin;
/// Where a body is and how it moves.
pub(super) type MotionOf<B, const N: usize> = Motion<<B as Solid<N>>::Place, N>;
/// How a body moves.
pub(super) type TwistOf<B, const N: usize> = Twist<SpinOf<B, N>, N>;

/// The points of a body, in the order of its shape: their places in the group and in the shape `[m]`, and their masses `[kg]`.
pub(super) struct Parts<'a, const N: usize> {
    pub(super) slots: &'a [u32],
    pub(super) places: &'a [[f64; N]],
    pub(super) masses: &'a [f64],
}

/// A rigid body.
pub(super) trait Solid<const N: usize>: Sized {
    type Place: Pose<N>;
    type Inertia<'a>: Inertial<N, Spin = SpinOf<Self, N>>
    where
        Self: 'a;

    fn parts(&self) -> Parts<'_, N>;
    /// How far its points are from the origin of the shape, at most `[m]`.
    fn reach(&self) -> f64;
    /// The corners of its convex hull, by their numbers in the shape: what can meet planes.
    fn corners(&self) -> &[u32];
    /// Whether a point of the shape may meet surfaces.
    fn meets(&self, point: u32) -> bool;
    /// Whether a pin holds its origin.
    fn is_pinned(&self) -> bool;
    /// Whether pins leave it no motion.
    fn is_fixed(&self) -> bool {
        false
    }
    /// What resists impulses where it is.
    fn inertia<'a>(&'a self, place: &'a Self::Place) -> Self::Inertia<'a>;
    /// A unit normal, then the tangents of its surface.
    fn frame(normal: [f64; N]) -> [[f64; N]; N];
    /// Of points of the shape on one surface those that hold the others, by their places in the list.
    fn outermost(&self, place: &Self::Place, frame: &[[f64; N]; N], points: &[u32]) -> Vec<usize>;
    /// Turned about its pin so that what is at `arm` gets out by a gap, and the angle of that `[rad]`; `None`: it cannot be.
    fn swung(&self, place: &Self::Place, arm: [f64; N], normal: [f64; N], gap: f64) -> Option<(Self::Place, f64)>;

    /// On for `h` from `t` `[s]` where nothing touches it. Works and losses are booked where there is a book, and what it takes counts as spent.
    fn fly<S: Real, const D: usize>(
        &self,
        motion: &MotionOf<Self, N>,
        field: &Field<S, D>,
        span: (f64, f64),
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> MotionOf<Self, N>;
    /// On for `h` `[s]` by its own motion alone: nothing pushes or slows it.
    fn coast(&self, motion: &MotionOf<Self, N>, h: f64, spent: &Cell<u64>) -> MotionOf<Self, N>;
    /// The motion after `h` `[s]` of what pushes it from `t` on where it is: forces, gravity and drag.
    fn kicked<S: Real, const D: usize>(
        &self,
        motion: &MotionOf<Self, N>,
        field: &Field<S, D>,
        span: (f64, f64),
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> TwistOf<Self, N>;
    /// The longest part of a step of `h` `[s]` in flight that pushes allow.
    fn longest<S: Real, const D: usize>(&self, field: &Field<S, D>, h: f64) -> f64;
    /// The longest part of a flight, of the one in which it turns as far as it may among surfaces `[s]`.
    fn longest_turned(&self, turned: f64) -> f64;
    /// Operations of a part in flight, about.
    fn work_in_flight<S: Real, const D: usize>(&self, field: &Field<S, D>) -> u64;
    /// Operations of a look at what it touches, about.
    fn work_of_a_look(&self, near: &Near) -> u64;

    /// A speed that counts as none `[m/s]`.
    fn still(&self, twist: &TwistOf<Self, N>) -> f64 {
        STILL * (twist.fastest(self.reach()) + 1e-3)
    }

    /// Whether it has no speed that counts.
    fn is_still(&self, twist: &TwistOf<Self, N>) -> bool {
        twist.fastest(self.reach()) <= self.still(twist)
    }

    /// Whether its points are where the shape has them and go as it does, but for rounding.
    fn fits<S: Real, const D: usize>(&self, motion: &MotionOf<Self, N>, points: &Points<S, D>) -> bool {
        const ROUNDED: f64 = 64.0;
        let Motion { place, twist } = motion;
        let size = |x: [f64; N]| x.iter().fold(1.0 + self.reach(), |sum, x| sum + x.abs());
        let rounded = ROUNDED * S::EPSILON.to_f64();
        let near = rounded * size(place.middle());
        let slow = rounded * (size(twist.velocity) + self.reach() * twist.spin.size());
        let Parts { slots, places, .. } = self.parts();
        let is_there = |(&slot, &q): (&u32, &[f64; N])| {
            let r = place.turned(q);
            let at = |list: &[[S; D]]| resized(widen(list[slot as usize]));
            let off = sub(at(&points.position), add(place.middle(), r));
            let faster = sub(at(&points.velocity), twist.at(r));
            off.iter().all(|off| off.abs() <= near) && faster.iter().all(|faster| faster.abs() <= slow)
        };
        slots.iter().zip(places).all(is_there)
    }

    /// Its points follow.
    fn write<S: Real, const D: usize>(&self, motion: &MotionOf<Self, N>, points: &mut Points<S, D>) {
        let Motion { place, twist } = motion;
        let Parts { slots, places, .. } = self.parts();
        for (&slot, &q) in slots.iter().zip(places) {
            let i = slot as usize;
            if points.inverse_mass[i] == S::ZERO {
                continue;
            }
            let r = place.turned(q);
            set(&mut points.position[i], points.position_lost.get_mut(i), add(place.middle(), r));
            set(&mut points.velocity[i], points.velocity_lost.get_mut(i), twist.at(r));
        }
    }
}

/// What is known of a vector, with what rounding took from it where that is kept.
#[inline(always)]
pub(super) fn exact<S: Real, const D: usize, const N: usize>(list: &[[S; D]], lost: &[[S; D]], slot: u32) -> [f64; N] {
    let i = slot as usize;
    let mut exact = [0.0; N];
    for k in 0..N.min(D) {
        exact[k] = list[i][k].to_f64();
        if !lost.is_empty() {
            exact[k] += lost[i][k].to_f64();
        }
    }
    exact
}

/// A vector of a body in a world.
#[inline(always)]
pub(super) fn lift<S: Real, const D: usize, const N: usize>(x: [f64; N]) -> [S; D] {
    resized(x).map(S::from_f64)
}

/// A vector and what rounding takes from it, where that is kept, along the axes that both have.
#[inline(always)]
fn set<S: Real, const D: usize, const N: usize>(value: &mut [S; D], lost: Option<&mut [S; D]>, exact: [f64; N]) {
    for k in 0..D.min(N) {
        value[k] = S::from_f64(exact[k]);
    }
    if let Some(lost) = lost {
        for k in 0..D.min(N) {
            lost[k] = S::from_f64(exact[k] - value[k].to_f64());
        }
    }
}
