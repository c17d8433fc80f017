//! A group of points that the loop of a source moves.

use super::make::{Maker, breakable};
use crate::sim::group::Group;
use crate::sim::printed::{Printed, Setup};
use crate::sim::real::Real;
use crate::sim::source::Source;

impl<S: Real, const D: usize> Maker<'_, S, D> {
    pub(super) fn make_printed(&self, source: Source) -> Group<S, D> {
        let method = &self.model.method;
        let setup = Setup {
            source,
            sweeps: method.iterations,
            order: method.order,
            seed: method.seed,
            substep: self.lot.choice.substep,
            wind: self.model.wind,
        };
        let points = self.batched_state();
        let mover = Printed::new(&setup, self.bonds().map(|(_, bond)| bond), &points);
        self.batched(points, self.batched_pull(), Box::new(mover), breakable(self.bonds(), |_| true))
    }
}
