//! Points are held where they are, or let go.

use std::sync::Arc;

use super::done;
use crate::sim::bond::PointId;
use crate::sim::command::{Applied, CommandError};
use crate::sim::real::Real;
use crate::sim::vector::zero;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn pin(&mut self, points: &[PointId]) -> Result<Applied, CommandError> {
        self.check_points(points)?;
        self.hold(points, |world, point| world.inverse_mass[point.index()] > 0.0, true)
    }

    pub(super) fn unpin(&mut self, points: &[PointId]) -> Result<Applied, CommandError> {
        self.check_points(points)?;
        self.hold(points, |world, point| world.model.pinned.contains(point), false)
    }

    /// Pins or unpins the points that are `meant`: they are at rest then.
    fn hold(
        &mut self,
        points: &[PointId],
        meant: impl Fn(&Self, &PointId) -> bool,
        is_pinned: bool,
    ) -> Result<Applied, CommandError> {
        let mut list: Vec<PointId> = points.iter().copied().filter(|point| meant(self, point)).collect();
        list.sort_unstable();
        list.dedup();
        if list.is_empty() {
            return Ok(done(false));
        }
        let touched: Vec<u32> = list.iter().map(|point| point.0).collect();
        let mut detached = self.detach(&self.with_mates(touched.clone()), false);
        for place in detached.places(touched.iter().copied()) {
            detached.state.velocity[place] = zero();
            detached.state.velocity_lost[place] = zero();
        }
        let model = Arc::make_mut(&mut self.model);
        model.pinned.retain(|pin| list.binary_search(pin).is_err());
        model.pin_motion.retain(|(pin, _)| list.binary_search(pin).is_err());
        if is_pinned {
            model.pinned.extend(&list);
        }
        self.weigh(touched);
        self.attach(detached);
        Ok(done(true))
    }
}
