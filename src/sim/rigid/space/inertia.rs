//! What resists impulses on a rigid body in space.

use super::Twist;
use super::body::Body;
use super::place::Place;
use crate::sim::contact::coulomb::disc::Disc;
use crate::sim::rigid::inertia::Inertial;
use crate::sim::vector::dot;

/// A body where it is.
pub(super) struct Inertia<'a> {
    pub(super) body: &'a Body,
    pub(super) place: &'a Place,
}

impl Inertial<3> for Inertia<'_> {
    type Spin = [f64; 3];
    type Friction = Disc;

    #[inline(always)]
    fn ease(&self) -> f64 {
        self.body.ease
    }

    #[inline(always)]
    fn spun(&self, moment: [f64; 3]) -> [f64; 3] {
        self.body.spin(self.place, moment)
    }

    fn energy(&self, twist: &Twist) -> f64 {
        let Twist { velocity, spin } = *twist;
        let free = if self.body.ease > 0.0 { dot(velocity, velocity) / self.body.ease } else { 0.0 };
        0.5 * (free + dot(spin, self.body.turning(self.place, spin)))
    }

    fn heaviest(&self) -> f64 {
        self.body.shape.mass
    }
}
