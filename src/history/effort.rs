//! What steps cost, by counted work: how far keyframes lie apart, and so how long going back takes, follows from it.

use crate::sim::{Counters, Dynamics};

/// Time that a point or a bond takes in a substep of a small body `[s]`: it is part of a system that is solved, or waits for events. Of the
/// gallery's scenes: 2e-8 to 6e-8.
const UNIT: f64 = 6e-8;
/// The same in vectors `[s]`: 3e-9 to 1e-8.
const UNIT_IN_VECTORS: f64 = 1e-8;
/// Time that a substep takes besides `[s]`: 1e-7 to 3e-7.
const SUBSTEP: f64 = 3e-7;

/// The work of a run from its start on.
#[derive(Clone, Debug, Default)]
pub(super) struct Effort {
    /// About so many seconds of one core.
    seconds: f64,
    /// What a point or a bond takes, and the topology that it was looked up for.
    unit: Option<(u64, f64)>,
}

impl Effort {
    /// About so many seconds since the start.
    pub(super) fn seconds(&self) -> f64 {
        self.seconds
    }

    /// A step was taken, before which the counters were `before`.
    pub(super) fn add(&mut self, before: &Counters, world: &dyn Dynamics) {
        let after = world.counters();
        let units = |counters: &Counters| counters.points_moved + counters.bonds_solved;
        let (units, substeps) =
            (units(after).saturating_sub(units(before)), after.substeps.saturating_sub(before.substeps));
        self.seconds += units as f64 * self.unit(world) + substeps as f64 * SUBSTEP;
    }

    /// What a point or a bond takes in the mean `[s]`.
    fn unit(&mut self, world: &dyn Dynamics) -> f64 {
        let topology = world.topology();
        if let Some((of, unit)) = self.unit
            && of == topology
        {
            return unit;
        }
        let parts = world.parts().iter();
        let (all, in_vectors) = parts.fold((0, 0), |(all, in_vectors), part| {
            let size = part.points + part.bonds;
            (all + size, in_vectors + if part.kernel.is_empty() { 0 } else { size })
        });
        let share = in_vectors as f64 / all.max(1) as f64;
        let unit = share * UNIT_IN_VECTORS + (1.0 - share) * UNIT;
        self.unit = Some((topology, unit));
        unit
    }
}
