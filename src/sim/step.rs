//! One step of a world: every group takes its substeps, bonds that are overstretched break.

use super::real::Real;
use super::world::World;

/// Times that a step ends early where a bond breaks: bonds that break after that do so where it ends.
const MOST_STOPS: u32 = 16;

impl<S: Real, const D: usize> World<S, D> {
    /// Advances by `h` [s] from the time reached, in a step that no knot interrupts.
    ///
    /// Where breaks are located, what follows one is made with the plan without that bond.
    pub(crate) fn step_by(&mut self, h: f64) {
        let t = self.timeline.time();
        for time in [t, t + h] {
            self.plan.groups.iter_mut().for_each(|group| group.stir(&self.around, time));
        }
        let (mut done, mut stops) = (0.0, 0);
        while done < h {
            let taken = self.advance((t + done, h - done), stops < MOST_STOPS);
            done = if taken < h - done - 1e-12 * h { done + taken } else { h };
            stops += 1;
            let torn: Vec<u32> = self.plan.groups.iter().flat_map(|group| group.torn()).collect();
            if !torn.is_empty() {
                self.tear(torn, t + done);
            }
        }
        self.gather();
    }

    /// Advances all groups by `h` from time `t`, or, where it `stops`, to the first time when a bond of any breaks.
    /// Returns how far they came [s].
    ///
    /// Groups that sleep stay where they are. Groups do not act on each other: each cuts the step into equal substeps no longer than its own.
    fn advance(&mut self, (t, h): (f64, f64), stops: bool) -> f64 {
        if stops && self.plan.groups.iter().any(|group| group.edges.has_breaks() && !group.is_asleep()) {
            return self.advance_to_break((t, h));
        }
        for group in self.plan.groups.iter_mut().filter(|group| !group.is_asleep()) {
            group.go(&self.around, (t, h), false, &mut self.counters);
        }
        h
    }

    /// As [`World::advance`], with groups that came further than another's break taken back to it.
    fn advance_to_break(&mut self, (t, h): (f64, f64)) -> f64 {
        let World { plan, around, counters, .. } = self;
        let awake = (0..plan.groups.len()).filter(|&place| !plan.groups[place].is_asleep());
        let (first, rest): (Vec<usize>, Vec<usize>) = awake.partition(|&place| plan.groups[place].edges.has_breaks());
        let start = if first.len() > 1 { plan.groups.clone() } else { Vec::new() };
        let mut reached = h;
        let mut came = Vec::with_capacity(first.len());
        for &place in &first {
            reached = plan.groups[place].go(around, (t, reached), true, counters);
            came.push(reached);
        }
        for (&place, _) in first.iter().zip(&came).filter(|(_, came)| **came > reached) {
            plan.groups[place].clone_from(&start[place]);
            plan.groups[place].go(around, (t, reached), false, counters);
        }
        for place in rest {
            plan.groups[place].go(around, (t, reached), false, counters);
        }
        reached
    }
}
