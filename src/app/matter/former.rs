//! Stops that joints had before they were taken away, so that they come back as they were.

use super::{Among, AngleAs};
use crate::sim::{Angle, Dynamics, PointId};

/// The stops that joints had: a number and i, j, k as [`Angle`] has them, and the least and the largest angle `[rad]`.
#[derive(Clone, Debug, Default)]
pub(in crate::app) struct Former(Vec<(u32, [PointId; 3], [f64; 2])>);

impl Former {
    /// Remembers the stops that joints among some points have now.
    pub(in crate::app) fn note(&mut self, world: &dyn Dynamics, among: &Among) {
        for angle in among.angles_of(world, AngleAs::Joint) {
            let Some(range) = angle.range else { continue };
            self.0.retain(|(number, points, _)| (*number, *points) != (angle.number, angle.points));
            self.0.push((angle.number, angle.points, range));
        }
    }

    /// Those that a joint had last `[rad]`; `None`: nobody took any from it.
    pub(super) fn of(&self, angle: &Angle) -> Option<[f64; 2]> {
        let is_it =
            |(number, points, _): &&(u32, [PointId; 3], [f64; 2])| (*number, *points) == (angle.number, angle.points);
        self.0.iter().find(is_it).map(|(_, _, range)| *range)
    }
}
