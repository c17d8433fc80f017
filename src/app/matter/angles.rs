//! Which angles points mean that are selected: what an angle is taken for says which of its points that takes.

use super::Among;
use crate::sim::{Angle, AngleDrive, Dynamics, PointId};

/// What an angle i, j, k is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum AngleAs {
    /// All that can have stops and servos: what is no motor. i, j and k are selected, or j alone: a click on a corner means its joints.
    Joint,
    /// What gives chains and skins their bending: no joint with stops, no motor, no servo, and nothing on the background. i, j and k are selected: a
    /// point alone has none.
    Bend,
    /// A motor. j and k are selected: i, which one on the background pushes against, hangs on nothing and is seldom meant too.
    Motor,
}

impl AngleAs {
    /// The angles of a world that are one.
    pub(super) fn all(self, world: &dyn Dynamics) -> impl Iterator<Item = &Angle> {
        let props = if self == AngleAs::Bend { world.props() } else { Vec::new() };
        let is = move |angle: &&Angle| self.is(angle) && props.binary_search(&angle.points[0]).is_err();
        world.angles().iter().filter(is)
    }

    /// Whether an angle is one by what it has itself.
    fn is(self, angle: &Angle) -> bool {
        let is_motor = || matches!(angle.drive, Some(AngleDrive::Motor { .. }));
        match self {
            AngleAs::Joint => !is_motor(),
            AngleAs::Bend => angle.range.is_none() && angle.drive.is_none(),
            AngleAs::Motor => is_motor(),
        }
    }

    /// Whether points, which are ascending as the props of their world are, mean an angle, if it is one. A corner is alone with its props too.
    pub(in crate::app) fn is_meant(self, points: &[PointId], props: &[PointId], angle: &Angle) -> bool {
        let has = |point: &PointId| points.binary_search(point).is_ok();
        let is_beside = |point: &PointId| *point == angle.points[1] || props.binary_search(point).is_ok();
        let is_alone = || has(&angle.points[1]) && points.iter().all(is_beside);
        match self {
            AngleAs::Joint => is_alone() || angle.points.iter().all(has),
            AngleAs::Bend => angle.points.iter().all(has),
            AngleAs::Motor => angle.points[1..].iter().all(has),
        }
    }
}

impl Among {
    /// The angles that the points mean.
    pub(super) fn angles_of(&self, world: &dyn Dynamics, taken: AngleAs) -> Vec<Angle> {
        let props = world.props();
        taken.all(world).filter(|angle| taken.is_meant(&self.points, &props, angle)).copied().collect()
    }
}
