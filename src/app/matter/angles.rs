//! Which angles points mean that are selected: what an angle is taken for says which of its points that takes.

use super::Among;
use crate::sim::{Angle, AngleDrive, Dynamics, PointId};

/// What an angle i, j, k is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum AngleAs {
    /// All that can have stops and servos: what is no motor. i, j and k are selected, or j alone: a click on a corner means its joints.
    Joint,
    /// What gives chains and skins their bending: no joint with stops, no motor and no servo. i, j and k are selected: a point alone
    /// has none.
    Bend,
    /// A motor. j and k are selected: i, which one on the background pushes against, hangs on nothing and is seldom meant too.
    Motor,
}

impl AngleAs {
    /// Whether an angle is one.
    pub(super) fn is(self, angle: &Angle) -> bool {
        let is_motor = || matches!(angle.drive, Some(AngleDrive::Motor { .. }));
        match self {
            AngleAs::Joint => !is_motor(),
            AngleAs::Bend => angle.range.is_none() && angle.drive.is_none(),
            AngleAs::Motor => is_motor(),
        }
    }

    /// Whether points, which are ascending, mean an angle, if it is one.
    pub(in crate::app) fn is_meant(self, points: &[PointId], angle: &Angle) -> bool {
        let has = |point: &PointId| points.binary_search(point).is_ok();
        match (self, points) {
            (AngleAs::Joint, [corner]) => angle.points[1] == *corner,
            (AngleAs::Joint | AngleAs::Bend, _) => angle.points.iter().all(has),
            (AngleAs::Motor, _) => angle.points[1..].iter().all(has),
        }
    }
}

impl Among {
    /// The angles that the points mean.
    pub(super) fn angles_of(&self, world: &dyn Dynamics, taken: AngleAs) -> Vec<Angle> {
        let is_meant = |angle: &&Angle| taken.is(angle) && taken.is_meant(&self.points, angle);
        world.angles().iter().filter(is_meant).copied().collect()
    }
}
