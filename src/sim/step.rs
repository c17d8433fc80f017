//! One step of a world, phase by phase.
//!
//! ```text
//! wake      what the cursor reaches or a grab holds
//! sweep     a cursor that goes far is followed in parts of the step
//! advance   every group that is awake takes its substeps, pins led, grabs pulled
//! tear      bonds that are overstretched go, and what they held together is compiled anew
//! gather    positions in the order of the points
//! rest      what stays where it is falls asleep
//! ```

use super::group::Group;
use super::real::Real;
use super::world::World;

/// Times that a step ends early where a bond breaks: bonds that break after that do so where it ends.
const MOST_STOPS: u32 = 16;
/// Share of its radius that the cursor goes in a part of a step: a point that it passes is pushed on its way.
const SWEEP: f64 = 0.25;
/// Most parts of a step, however fast the cursor goes.
const MOST_SWEEPS: f64 = 64.0;

impl<S: Real, const D: usize> World<S, D> {
    /// Advances by `h` [s] from the time reached, in a step that no knot interrupts.
    pub(crate) fn step_by(&mut self, h: f64) {
        let t = self.timeline.time();
        let parts = (self.around.sweep(t, h) / SWEEP).ceil().clamp(1.0, MOST_SWEEPS);
        for part in 0..parts as u32 {
            let [start, end] = [part, part + 1].map(|part| h * (f64::from(part) / parts));
            self.wake_reached([t + start, t + end]);
            self.follow(t + start, end - start);
        }
        self.gather();
    }

    /// Groups that are reached wake.
    fn wake_reached(&mut self, times: [f64; 2]) {
        for time in times {
            self.plan.groups.iter_mut().for_each(|group| group.wake_if_reached(&self.around, time));
        }
    }

    /// Advances by `h` [s] from `t`. Where breaks are located, what follows one is made with the plan without that bond.
    fn follow(&mut self, t: f64, h: f64) {
        let (mut done, mut stops) = (0.0, 0);
        while done < h {
            let taken = self.advance((t + done, h - done), stops < MOST_STOPS);
            done = if taken < h - done - 1e-12 * h { done + taken } else { h };
            stops += 1;
            let torn: Vec<u32> = self.plan.groups.iter().flat_map(|group| group.torn()).collect();
            if !torn.is_empty() {
                self.tear(&torn, t + done);
            }
        }
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
        // Only a group that is not the last one may have to be taken back.
        let starts = first.len().saturating_sub(1);
        let starts: Vec<Group<S, D>> = first[..starts].iter().map(|&place| plan.groups[place].clone()).collect();
        let mut reached = h;
        let mut came = Vec::with_capacity(first.len());
        for &place in &first {
            reached = plan.groups[place].go(around, (t, reached), true, counters);
            came.push(reached);
        }
        for ((&place, came), start) in first.iter().zip(came).zip(starts) {
            if came > reached {
                plan.groups[place] = start;
                plan.groups[place].go(around, (t, reached), false, counters);
            }
        }
        for place in rest {
            plan.groups[place].go(around, (t, reached), false, counters);
        }
        reached
    }

    /// Groups that stay where they are fall asleep.
    pub(crate) fn rest(&mut self) {
        if self.model.method.sleeps {
            let t = self.timeline.time();
            self.plan.groups.iter_mut().for_each(|group| group.doze(&self.around, t));
        }
    }
}
