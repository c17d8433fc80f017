//! One step of a world, phase by phase.
//!
//! ```text
//! meet        bodies that may touch each other in the step are moved together from its start on (`handover`)
//! take back   groups that no command touched since the step was cut take it whole
//! wake        what the cursor reaches or a grab holds
//! sweep       a cursor that goes far is followed in parts of the step, by the groups on its way that do not follow it themselves
//! advance     every group that is awake takes its substeps, pins led, grabs pulled
//! tear        bonds that are overstretched go, and what they held together is compiled anew
//! gather      positions in the order of the points
//! rest        what stays where it is falls asleep
//! hand over   what costs too much or fails goes to the live step, and back (`handover`)
//! ```
//!
//! What acts on each other in a step is one group. Each group goes its own way to the end of the step, in equal substeps no longer than
//! its own, and a command, a cursor or a break cuts the step of those alone that it touches.

use super::counters::Counters;
use super::environment::Environment;
use super::group::Group;
use super::handover::most_work;
use super::real::Real;
use super::threads;
use super::world::World;

/// Times that the step of a group ends early where a bond breaks: bonds that break after that do so where it ends.
const MOST_STOPS: u32 = 16;

/// What a group has before it in a step: `h` from time `from` `[s]`.
#[derive(Clone, Copy, Debug)]
struct Due {
    place: usize,
    from: f64,
    h: f64,
    /// How often it ended early.
    stops: u32,
}

/// How far a group came of what was due `[s]`, and the work that it did.
#[derive(Clone, Copy, Debug, Default)]
struct Gone {
    came: f64,
    counters: Counters,
}

/// A group goes on, as far as it comes.
fn go<S: Real, const D: usize>(
    group: &mut Group<S, D>,
    around: &Environment<D>,
    budget: Option<f64>,
    due: Due,
) -> Gone {
    let Due { from, h, stops, .. } = due;
    let mut counters = Counters::default();
    let locates = stops < MOST_STOPS && group.edges.has_breaks();
    group.watch_start(around, from);
    group.limit = most_work(group, budget, (from, h), &counters);
    let came = group.go(around, (from, h), locates, &mut counters);
    group.watch_end(around, (from, came), (counters.work, counters.fallbacks));
    Gone { came, counters }
}

impl<S: Real, const D: usize> World<S, D> {
    /// Takes what is left of the step under way.
    pub(crate) fn finish_step(&mut self) {
        self.foresee();
        self.meet();
        let kept = self.take_back();
        self.advance(&kept, |world, from| world.timeline.left(from));
        self.timeline.advance();
    }

    /// Goes to `time` `[s]` within the step under way. What no command touches there takes the step whole afterwards, as if it had
    /// not been cut.
    pub(crate) fn cut_step(&mut self, time: f64) {
        self.foresee();
        self.meet();
        let kept = self.take_back();
        self.keep(&kept);
        self.advance_to(&kept, time);
    }

    /// Goes to `time` `[s]` within the step under way, for good: of a copy that is looked at.
    pub(crate) fn look_ahead(&mut self, time: f64) {
        self.foresee();
        self.meet();
        let kept = self.take_back();
        self.advance_to(&kept, time);
    }

    fn advance_to(&mut self, kept: &[(usize, f64)], time: f64) {
        self.advance(kept, |_, from| time - from);
        self.timeline.advance_within(time);
    }

    /// Advances all groups by as much as `span` says for the time that each has reached.
    fn advance(&mut self, kept: &[(usize, f64)], span: impl Fn(&Self, f64) -> f64) {
        let t = self.timeline.time();
        let h = span(self, t);
        let between_pins = self.energy_between_pins();
        // Places of groups that are where the step ends already.
        let mut done: Vec<usize> = Vec::new();
        for &(place, from) in kept {
            done.push(place);
            self.take(Due { place, from, h: span(self, from), stops: 0 }, &mut done);
        }
        let parts = self.around.parts((t, h), |eye| self.farthest_from(eye));
        if parts > 1 {
            for place in self.apart((t, h), &done) {
                done.push(place);
                self.take(Due { place, from: t, h, stops: 0 }, &mut done);
            }
        }
        done.sort_unstable();
        for part in 0..parts {
            let [start, end] = [part, part + 1].map(|part| h * (f64::from(part) / f64::from(parts)));
            self.wake_reached([t + start, t + end]);
            let is_due = |place: &usize| done.binary_search(place).is_err() && !self.plan.groups[*place].is_asleep();
            let due = |place| Due { place, from: t + start, h: end - start, stops: 0 };
            let dues: Vec<Due> = (0..self.plan.groups.len()).filter(is_due).map(due).collect();
            self.take_all(&dues, &mut Vec::new());
        }
        self.gather();
        self.book_between_pins(between_pins);
        self.note_kinetic();
    }

    /// Those that take the step whole though the cursor goes far in the `h` from `t` on `[s]`: they are not on its way, or follow it
    /// themselves. They wake where it reaches them.
    fn apart(&mut self, (t, h): (f64, f64), done: &[usize]) -> Vec<usize> {
        let mut list = Vec::new();
        for (place, group) in self.plan.groups.iter_mut().enumerate().filter(|(place, _)| !done.contains(place)) {
            let is_reached = group.may_be_reached(&self.around, (t, h));
            if is_reached && !group.follows_cursor() {
                continue;
            }
            if is_reached {
                group.wake();
            }
            if !group.is_asleep() {
                list.push(place);
            }
        }
        list
    }

    /// Groups that are reached wake.
    fn wake_reached(&mut self, times: [f64; 2]) {
        for time in times {
            self.plan.groups.iter_mut().for_each(|group| group.wake_if_reached(&self.around, time));
        }
    }

    /// Groups take `h` from time `from` on `[s]`, though the world has come further.
    pub(crate) fn take_again(&mut self, places: &[usize], (from, h): (f64, f64)) {
        places.iter().for_each(|&place| self.take(Due { place, from, h, stops: 0 }, &mut Vec::new()));
    }

    /// A group takes what is due. What follows the break of a bond is made with the plan without it; `made`: the groups that come so.
    fn take(&mut self, due: Due, made: &mut Vec<usize>) {
        let budget = self.model.budget();
        let gone = go(&mut self.plan.groups[due.place], &self.around, budget, due);
        self.go_on(due, gone, made);
    }

    /// Groups take what is due, several at once where that is worth it: none of them knows of another within a step.
    fn take_all(&mut self, dues: &[Due], made: &mut Vec<usize>) {
        let World { plan, around, model, .. } = self;
        let (around, budget) = (&*around, model.budget());
        let mut gone: Vec<Gone> = vec![Gone::default(); dues.len()];
        let mut groups = plan.groups.iter_mut().enumerate();
        let tasks = dues.iter().zip(&mut gone).filter_map(|(&due, gone)| {
            let (_, group) = groups.find(|(place, _)| *place == due.place)?;
            let work = (group.work.step as f64 * (due.h / group.substep).ceil()) as u64;
            Some((work, (group, due, gone)))
        });
        threads::share_out(tasks.collect(), |(group, due, gone)| *gone = go(group, around, budget, due));
        for (&due, gone) in dues.iter().zip(gone) {
            // What an earlier one made may be in the place of one that was empty.
            if made.contains(&due.place) {
                self.counters.add(&gone.counters);
            } else {
                self.go_on(due, gone, made);
            }
        }
    }

    /// Counts what a group has done, and does what follows where it ended early.
    fn go_on(&mut self, due: Due, gone: Gone, made: &mut Vec<usize>) {
        let Due { place, from, h, stops } = due;
        let Gone { came, counters } = gone;
        self.counters.add(&counters);
        let group = &mut self.plan.groups[place];
        let torn: Vec<u32> = group.torn().collect();
        if torn.is_empty() {
            if group.gave_up.is_some() {
                for place in self.give_up(place, from + came) {
                    made.push(place);
                    self.take(Due { place, from: from + came, h: h - came, stops }, made);
                }
            }
            return;
        }
        for place in self.tear_booked(&torn, from + came) {
            made.push(place);
            if came < h - 1e-12 * h {
                self.take(Due { place, from: from + came, h: h - came, stops: stops + 1 }, made);
            }
        }
    }

    /// Groups that stay where they are fall asleep.
    pub(crate) fn rest(&mut self) {
        if self.model.method.sleeps {
            let t = self.timeline.time();
            self.plan.groups.iter_mut().for_each(|group| group.doze(&self.around, t));
        }
    }
}
