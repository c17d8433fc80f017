//! Where a rigid body is and how it moves, in the plane and in space.

use std::fmt::Debug;

use super::place::Place;
use crate::sim::vector::{add, cross, cross3, dot, length, scale};

/// An axial vector: a spin `[rad/s]`, a torque `[N m]` or an angular momentum. A number in the plane, a vector in space.
pub(crate) trait Axial<const N: usize>: Copy + Debug + PartialEq {
    const ZERO: Self;

    /// The vector product of an arm `[m]` and a force, or an impulse, at its end.
    fn moment(arm: [f64; N], of: [f64; N]) -> Self;
    /// The velocity of what is at `arm` from the origin, by this spin.
    fn around(self, arm: [f64; N]) -> [f64; N];
    fn plus(self, other: Self) -> Self;
    fn times(self, by: f64) -> Self;
    fn dot(self, other: Self) -> f64;
    fn size(self) -> f64;
    fn is_finite(self) -> bool;
}

impl Axial<2> for f64 {
    const ZERO: Self = 0.0;

    #[inline(always)]
    fn moment(arm: [f64; 2], of: [f64; 2]) -> Self {
        cross(arm, of)
    }

    #[inline(always)]
    fn around(self, arm: [f64; 2]) -> [f64; 2] {
        scale([-arm[1], arm[0]], self)
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn times(self, by: f64) -> Self {
        self * by
    }

    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        self * other
    }

    #[inline(always)]
    fn size(self) -> f64 {
        self.abs()
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }
}

impl Axial<3> for [f64; 3] {
    const ZERO: Self = [0.0; 3];

    #[inline(always)]
    fn moment(arm: [f64; 3], of: [f64; 3]) -> Self {
        cross3(arm, of)
    }

    #[inline(always)]
    fn around(self, arm: [f64; 3]) -> [f64; 3] {
        cross3(self, arm)
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        add(self, other)
    }

    #[inline(always)]
    fn times(self, by: f64) -> Self {
        scale(self, by)
    }

    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        dot(self, other)
    }

    #[inline(always)]
    fn size(self) -> f64 {
        length(self)
    }

    fn is_finite(self) -> bool {
        self.iter().all(|x| x.is_finite())
    }
}

/// Where a body is and how it is turned: places of its shape are turned, then carried along.
pub(crate) trait Pose<const N: usize>: Copy + Debug {
    type Spin: Axial<N>;

    /// Where the origin of the shape is `[m]`.
    fn middle(&self) -> [f64; N];
    /// A vector of the shape in the world.
    fn turned(&self, q: [f64; N]) -> [f64; N];
    /// A vector of the world in the shape.
    fn back(&self, v: [f64; N]) -> [f64; N];
    /// Carried along, not turned.
    fn shifted(&self, by: [f64; N]) -> Self;
    fn is_finite(&self) -> bool;

    /// Where a place of the shape is.
    #[inline(always)]
    fn out(&self, q: [f64; N]) -> [f64; N] {
        add(self.middle(), self.turned(q))
    }
}

/// How fast a body goes `[m/s]` and spins `[rad/s]`, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twist<W: Axial<N> = f64, const N: usize = 2> {
    pub(crate) velocity: [f64; N],
    pub(crate) spin: W,
}

impl<W: Axial<N>, const N: usize> Twist<W, N> {
    /// It stands still.
    pub(crate) const STILL: Self = Twist { velocity: [0.0; N], spin: W::ZERO };

    /// The velocity of what is at `arm` from the origin.
    #[inline(always)]
    pub(crate) fn at(&self, arm: [f64; N]) -> [f64; N] {
        add(self.velocity, self.spin.around(arm))
    }

    /// A bound on the speed of what is no further than `reach` `[m]` from the origin `[m/s]`.
    pub(crate) fn fastest(&self, reach: f64) -> f64 {
        length(self.velocity) + self.spin.size() * reach
    }
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<P: Pose<N> = Place, const N: usize = 2> {
    pub(crate) place: P,
    pub(crate) twist: Twist<P::Spin, N>,
}

impl<P: Pose<N>, const N: usize> Motion<P, N> {
    pub(super) fn is_finite(&self) -> bool {
        let Twist { velocity, spin } = self.twist;
        self.place.is_finite() && velocity.iter().all(|x| x.is_finite()) && spin.is_finite()
    }

    /// Twice as far as it may get in `h` `[s]` with its speed `[m/s]` and what pushes it `[m/s^2]`.
    pub(super) fn way(&self, h: f64, pushed: f64) -> f64 {
        2.0 * (length(self.twist.velocity) * h + pushed * h * h)
    }
}
