//! Islands go from their own methods to the live step, and back.
//!
//! ```text
//! meet     bodies come near each other, themselves or a corner: looked at before each step, where the scene has contact
//! alarm    energy from nowhere, strain, no convergence: looked at where frames end; pins that are led beyond reach, before (`taut.rs`)
//! lost     no numbers: looked at after every step; what nothing can move stands still where it last was among them (`lost.rs`)
//! budget   the counted work of a frame is more than it may be: groups in the order of their work, until the sum fits
//! back     after a while, if its own method takes an island as it is
//! ```
//!
//! All of it goes by counted work and by the motion, never by a clock: the same on every machine, for any number of threads, and from
//! any copy. A group whose step runs past the budget gives it up where it stands, and the live step takes what is left of it.

mod back;
mod lost;
mod meet;
mod taut;

use crate::sim::bond::PointId;
use crate::sim::bulk::control::FRAME;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::counters::{Counters, operations};
use crate::sim::group::Group;
use crate::sim::group::engine::Engine;
use crate::sim::group::watch::{Alarm, Anchor, Sums};
use crate::sim::live;
use crate::sim::measure;
use crate::sim::moved::Why;
use crate::sim::real::Real;
use crate::sim::timeline::frame_of;
use crate::sim::world::World;

/// A group is handed over where its work is so many times that of the live step: less would hardly help.
const CHEAPER: f64 = 1.25;
/// Longest step of a world that the live step needs `[s]`: in shorter ones it would look for neighbours more often than it has to.
const STEP: f64 = FRAME;
/// How long a live island that does not hold its bonds stays so at least `[s]`.
const UNHELD: f64 = 1.0;

/// Counted work until which a group may step for `h` from `t` `[s]`: beyond, it gives the step up. Only where it can be handed over and
/// takes more than a frame may, and more than the live step would.
pub(super) fn most_work<S: Real, const D: usize>(
    group: &Group<S, D>,
    budget: Option<f64>,
    (t, h): (f64, f64),
    counters: &Counters,
) -> u64 {
    let (Some(budget), Some(watch)) = (budget, &group.watch) else { return u64::MAX };
    let is_bounded = !matches!(group.engine, Engine::Bulk(_))
        || matches!(group.kernel(), Some(Kernel::Joined(_) | Kernel::Rigid(_)));
    if !watch.may_go || !is_bounded {
        return u64::MAX;
    }
    let most = allowed(budget, h).max((CHEAPER * live_work(group, 0.0)) as u64);
    counters.work.saturating_add(most).saturating_sub(watch.spent_in(frame_of(t + h)))
}

/// Counted work of a frame; a step of `h` `[s]` may be longer than one.
fn allowed(budget: f64, h: f64) -> u64 {
    operations(budget * (h / FRAME).max(1.0))
}

/// Counted work of a frame of a group by the live step, about, at this speed `[m/s]`.
fn live_work<S: Real, const D: usize>(group: &Group<S, D>, speed: f64) -> f64 {
    group.watch.as_ref().map_or(f64::INFINITY, |watch| live::work_of_a_frame(watch.size, speed, watch.edge))
}

/// Whether a group may go live that is not so.
fn can_go<S: Real, const D: usize>(group: &Group<S, D>) -> bool {
    !group.is_live() && group.watch.as_ref().is_some_and(|watch| watch.may_go)
}

/// Whether the live step may take less than its own method: of a rigid body alone it never does.
fn can_be_cheaper<S: Real, const D: usize>(group: &Group<S, D>) -> bool {
    can_go(group) && !matches!(group.kernel(), Some(Kernel::Rigid(_)))
}

/// Counted work of a frame that a group takes at least, of one that can go.
fn least_work<S: Real, const D: usize>(group: &Group<S, D>) -> u64 {
    let step = if matches!(group.engine, Engine::Bulk(_)) { group.work.batch } else { group.work.step };
    if can_go(group) && !group.is_asleep() { (step as f64 * (FRAME / group.substep)) as u64 } else { 0 }
}

impl<S: Real, const D: usize> World<S, D> {
    /// After a step: who moves what from now on.
    pub(crate) fn watch_over(&mut self) {
        self.heed_lost();
        let Some(budget) = self.model.budget() else { return };
        let (t, h) = (self.timeline.time(), self.timeline.substep());
        let ends_frame = frame_of(t + h) != frame_of(t);
        if ends_frame {
            self.heed_alarms(t);
            self.heed_pins(t);
        }
        let frame = frame_of(t);
        self.keep_budget(allowed(budget, h), t, |group| group.watch.as_ref().map_or(0, |watch| watch.spent_in(frame)));
        if ends_frame {
            self.hand_back(t);
        }
        if self.was_handed_over {
            self.was_handed_over = !self.stretch_steps();
        }
    }

    /// A group gives up its step at `t` `[s]`. Returns the places of those that take what is left of it.
    pub(crate) fn give_up(&mut self, place: usize, t: f64) -> Vec<usize> {
        // What takes that long may be past mending already.
        let alarm = self.plan.groups[place].look(&self.around, t, &mut self.counters);
        match alarm.filter(|alarm| alarm.is_lost()).and_then(|_| self.plan.groups[place].take_anchor()) {
            Some(anchor) => self.go_live_from(place, &anchor, t),
            None => self.go_live(&[place], t, Why::Budget),
        }
    }

    /// The live step moves a group from a state that was good, up to `t` `[s]` at once. Returns the places of its islands.
    fn go_live_from(&mut self, place: usize, anchor: &Anchor<S, D>, t: f64) -> Vec<usize> {
        let from = self.plan.groups[place].go_back(anchor);
        let places = self.go_live(&[place], from, Why::Alarm);
        self.take_again(&places, (from, t - from));
        places
    }

    /// The live step moves groups from `t` on `[s]`, with no more energy than each may have. Returns the places of their islands.
    fn go_live(&mut self, places: &[usize], t: f64, why: Why) -> Vec<usize> {
        let most = |place: usize| self.plan.groups[place].watch.as_ref().and_then(|watch| watch.most_energy());
        let list: Vec<(u32, Option<f64>)> =
            self.firsts_of(places).into_iter().map(|(place, first)| (first, most(place))).collect();
        if list.is_empty() {
            return Vec::new();
        }
        let firsts: Vec<u32> = list.iter().map(|entry| entry.0).collect();
        let mut detached = self.detach_at(&firsts, false, t);
        detached.moved.iter_mut().for_each(|moved| *moved = moved.handed_over(t, why));
        // Those that may meet soon would be put together anyway.
        detached.are_together = true;
        self.counters.hand_overs += list.len() as u64;
        self.was_handed_over = true;
        let places = self.put_back(detached);
        match list[..] {
            [(_, Some(most))] => self.take_out(&places, most),
            _ => {
                for (first, most) in list {
                    if let (Some(most), Some([place, _])) = (most, self.slot(first as usize)) {
                        self.take_out(&[place], most);
                    }
                }
            }
        }
        places
    }

    fn heed_alarms(&mut self, t: f64) {
        for place in 0..self.plan.groups.len() {
            let group = &mut self.plan.groups[place];
            if group.is_asleep() {
                continue;
            }
            let Some(alarm) = group.look(&self.around, t, &mut self.counters) else { continue };
            match (group.is_live(), alarm) {
                (true, Alarm::NotFinite) => self.stand_still(place, t),
                (true, _) => group.moved.until = group.moved.until.max(t + UNHELD),
                (false, alarm) => self.hand_over_on(place, alarm, t),
            }
        }
    }

    /// A group whose own method fails goes live: from its last good state where the present one is past mending.
    fn hand_over_on(&mut self, place: usize, alarm: Alarm, t: f64) {
        let anchor = if alarm.is_lost() { self.plan.groups[place].take_anchor() } else { None };
        let Some(anchor) = anchor else {
            if alarm != Alarm::NotFinite {
                let places = self.go_live(&[place], t, Why::Alarm);
                if let Alarm::Gain { most, .. } = alarm {
                    self.take_out(&places, most);
                }
            }
            return;
        };
        self.go_live_from(place, &anchor, t);
        self.heed_lost_of_live();
        self.gather();
    }

    /// What groups have more of energy than `most` `[J]` is taken out of their velocities.
    fn take_out(&mut self, places: &[usize], most: f64) {
        let of = |&place: &usize| self.plan.groups[place].energy_and_strain(&self.around);
        let energies: Vec<Sums> = places.iter().map(of).collect();
        let excess = energies.iter().map(Sums::total).sum::<f64>() - most;
        let kinetic: f64 = energies.iter().map(|sums| sums.kinetic).sum();
        if excess > 0.0 && kinetic > 0.0 {
            for (&place, own) in places.iter().zip(energies) {
                self.plan.groups[place].slow_down(excess * (own.kinetic / kinetic));
            }
        }
    }

    /// Before the first step of what was compiled: what is sure to take too much does not begin.
    pub(crate) fn foresee(&mut self) {
        if !std::mem::take(&mut self.is_fresh) {
            return;
        }
        self.lead_out();
        self.heed_pins(self.timeline.time());
        if let Some(budget) = self.model.budget() {
            self.keep_budget(allowed(budget, FRAME), self.timeline.time(), least_work);
        }
        if self.was_handed_over {
            self.was_handed_over = !self.stretch_steps();
        }
    }

    /// What lies in obstacles goes live, which leads it out slowly: by the exact methods its points are put out at once, and its bonds throw it
    /// about. What is rigid they put out as a whole.
    fn lead_out(&mut self) {
        let within = std::mem::take(&mut self.within);
        if self.model.budget().is_none() {
            return;
        }
        let mut places: Vec<usize> = within.iter().filter_map(|&point| Some(self.slot(point as usize)?[0])).collect();
        places.retain(|&place| can_be_cheaper(&self.plan.groups[place]));
        places.sort_unstable();
        places.dedup();
        self.go_live(&places, self.timeline.time(), Why::Alarm);
    }

    /// Whether a group may go live that took clearly more than the live step would, in the frame that ended last.
    pub(crate) fn has_cheaper(&self) -> bool {
        let frame = frame_of(self.timeline.time());
        let is_dear = |group: &Group<S, D>| {
            let spent = group.watch.as_ref().map_or(0, |watch| watch.spent_in(frame));
            let speed = measure::speed_bound(&group.points.velocity).to_f64();
            can_be_cheaper(group) && !group.is_asleep() && CHEAPER * live_work(group, speed) < spent as f64
        };
        self.model.budget().is_some() && self.plan.groups.iter().any(is_dear)
    }

    /// Groups go live in the order of what they `spent` in a frame, ties by their lowest points, until the sum is at most `allowed`.
    fn keep_budget(&mut self, allowed: u64, t: f64, spent: impl Fn(&Group<S, D>) -> u64) {
        let mut sum: u64 = self.plan.groups.iter().map(&spent).sum();
        if sum <= allowed {
            return;
        }
        let of = |(place, lowest): (usize, PointId)| {
            let group = &self.plan.groups[place];
            (can_be_cheaper(group) && spent(group) > 0).then_some((spent(group), lowest.0, place))
        };
        let mut list: Vec<(u64, u32, usize)> = self.lowest().into_iter().filter_map(of).collect();
        list.sort_unstable_by_key(|&(spent, lowest, _)| (std::cmp::Reverse(spent), lowest));
        let mut due = Vec::new();
        for (spent, _, place) in list {
            if sum <= allowed {
                break;
            }
            let group = &self.plan.groups[place];
            let live = live_work(group, measure::speed_bound(&group.points.velocity).to_f64());
            if CHEAPER * live < spent as f64 {
                due.push(place);
                sum -= spent - live as u64;
            }
        }
        self.go_live(&due, t, Why::Budget);
    }

    /// Steps of the world are made longer, where short ones are needed by nobody that is left: by powers of two, so that the substeps
    /// of others stay as they are, and where a longer one begins, so that none depends on when a run ends. Where somebody's are frames, so
    /// are they, or two might fall into one frame. Returns whether there is no more to do.
    fn stretch_steps(&mut self) -> bool {
        if self.model.method.substep.is_some() {
            return true;
        }
        let longest = self.plan.groups.iter().filter(|group| group.points.len() > 0);
        let longest = longest.map(|group| group.substep).fold(0.0, f64::max).min(STEP);
        let nominal = self.timeline.nominal();
        if longest == STEP {
            return nominal >= STEP * (1.0 - 1e-9) || self.timeline.stretch_to_frames();
        }
        let mut factor = 1;
        while f64::from(2 * factor) * nominal <= longest * (1.0 + 1e-9) {
            factor *= 2;
        }
        factor == 1 || self.timeline.stretch(factor)
    }
}
