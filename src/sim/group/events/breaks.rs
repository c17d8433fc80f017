//! Bonds that break: the step of the group ends there, for what follows needs another plan.

use super::edge::Broken;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::group::Group;
use crate::sim::real::Real;

impl<S: Real, const D: usize> Group<S, D> {
    /// A bond is gone at a time `[s]`.
    pub(super) fn snap(&mut self, bond: u32, at: f64) {
        self.edges.broken.get_or_insert(Broken { at, bonds: Vec::new() }).bonds.push(bond);
    }

    /// Advances by `h` from time `t` `[s]` in equal substeps no longer than its own, or, where it `stops`, to the first
    /// time when a bond breaks, or to where it gives the step up. Returns how far it came `[s]`.
    pub(crate) fn go(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        stops: bool,
        counters: &mut Counters,
    ) -> f64 {
        self.edges.stops = stops;
        self.gave_up = None;
        self.lead_pins(t, h);
        let count = (h / self.longest() * (1.0 - 1e-9)).ceil().max(1.0);
        for k in 0..count as u64 {
            self.edges.turns = 0;
            let (now, substep) = (t + h * (k as f64 / count), h / count);
            if self.gives_up(now, counters) {
                return now - t;
            }
            let held = self.middle_held();
            self.lead_grabbed(around, (now, substep));
            self.advance(around, now, substep, counters);
            self.note_held(held);
            if let Some(broken) = &self.edges.broken {
                return (broken.at - t).clamp(0.0, h);
            }
            if let Some(at) = self.gave_up {
                return (at - t).clamp(0.0, h);
            }
        }
        h
    }
}
