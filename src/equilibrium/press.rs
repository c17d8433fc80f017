//! Which surfaces press and which one-way bonds are taut.

use super::descent::Descent;
use super::hold::{Grip, Hold};
use super::part::grain;
use super::system::Step;
use crate::sim::bond::Limit;

/// Share of a violation that a round may leave.
const SLOW: f64 = 0.25;
/// How much firmer a hold that leaves more becomes each time, and at most: then a straight row of taut bonds sags by 1e-7 of
/// its length, which is the root of what rounding leaves of the lengths.
const FIRMER: f64 = 10.0;
const FIRMEST: f64 = 1e10;

impl<const D: usize> Descent<D> {
    /// Holds that the step would violate become active, and those that would have to pull where they can only push, or
    /// the other way round, are let go. Returns whether any did.
    pub(super) fn revise(&mut self, step: &Step<D>) -> bool {
        let fine = grain(&self.x);
        let mut changed = false;
        for (hold, &lambda) in self.holds.iter_mut().zip(&step.lambda).filter(|(hold, _)| hold.limit != Limit::Both) {
            let is_active = if hold.is_active {
                hold.can_have(lambda)
            } else {
                let off = hold.off(&self.part.surfaces, &self.x);
                let slack = match hold.grip {
                    Grip::Surface { surface, .. } => self.part.surfaces[surface].slack(),
                    Grip::Bond { .. } => 0.0,
                };
                hold.violation(off.value + off.change(hold.grip, &step.displacement)) > (slack + fine) * off.per_metre
            };
            if is_active != hold.is_active {
                *hold = Hold { is_active, lambda: 0.0, ..*hold };
                changed = true;
            }
        }
        self.touch();
        self.turn(step) || changed
    }

    /// Holds that a round without a shift left almost as violated as they were, `before` `[m]`, are made firmer.
    pub(super) fn firm_up(&mut self, before: &[f64]) {
        let after: Vec<f64> = self.violations(&self.x).collect();
        let worst = after.iter().copied().fold(0.0, f64::max);
        let fine = (4.0 * grain(&self.x)).max(0.1 * worst);
        for ((hold, &before), &after) in self.holds.iter_mut().zip(before).zip(&after) {
            if hold.is_active && after > fine && after > SLOW * before && before > 0.0 {
                hold.firmness = (FIRMER * hold.firmness).min(FIRMEST);
            }
        }
    }
}
