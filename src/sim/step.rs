//! One step of a world: every group takes its substeps, bonds that are overstretched break.

use super::real::Real;
use super::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// Advances by `h` [s] from the time reached, in a step that no knot interrupts.
    ///
    /// Groups do not act on each other: each cuts the step into equal substeps no longer than its own.
    pub(crate) fn step_by(&mut self, h: f64) {
        let t = self.timeline.time();
        let mut torn = Vec::new();
        for group in &mut self.plan.groups {
            group.lead_pins(t);
            let count = (h / group.substep * (1.0 - 1e-9)).ceil().max(1.0);
            for k in 0..count as u64 {
                group.advance(&self.around, t + h * (k as f64 / count), h / count, &mut self.counters);
            }
            torn.extend(group.torn());
        }
        if !torn.is_empty() {
            self.tear(torn);
        }
        self.gather();
    }
}
