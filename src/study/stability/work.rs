//! Counted work: what a run costs, without a clock.

use crate::sim::{Counters, Dynamics};

/// Milliseconds that a unit of counted work takes, about, on one core of the machine that the weights were fitted on.
const UNIT: f64 = 0.5e-6;

/// Counts the work of a world as it runs: the same on every machine.
///
/// Model: a substep of a group costs what its plan says; one that is split, cut by an event or handed to a more robust method is
/// paid for again. Groups are weighted by how often each takes a substep.
#[derive(Clone, Debug, Default)]
pub(super) struct Meter {
    /// The topology that `substep` is of.
    topology: Option<u64>,
    /// What a substep costs, in the mean [ms].
    substep: f64,
    /// Tries counted so far.
    tries: u64,
}

impl Meter {
    /// The work since the last reading [ms].
    pub(super) fn read(&mut self, world: &dyn Dynamics) -> f64 {
        if self.topology != Some(world.topology()) {
            self.topology = Some(world.topology());
            self.substep = mean(world);
        }
        let tries = tries(world.counters());
        let since = tries.saturating_sub(self.tries);
        self.tries = tries;
        since as f64 * self.substep
    }
}

/// What a substep of a world costs in the mean over those of its groups [ms].
fn mean(world: &dyn Dynamics) -> f64 {
    let sums = world.parts().iter().fold([0.0, 0.0], |[work, count], part| {
        let often = 1.0 / part.substep.max(1e-12);
        [work + part.work * often, count + often]
    });
    if sums[1] > 0.0 { UNIT * sums[0] / sums[1] } else { 0.0 }
}

/// Substeps with all that is taken again.
fn tries(counters: &Counters) -> u64 {
    counters.substeps + 2 * counters.guard_splits + 8 * counters.fallbacks + 2 * counters.events
}
