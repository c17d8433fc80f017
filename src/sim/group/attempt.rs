//! A substep of a group: the method's own step, in halves where a guard or its error says so, in parts where events cut it, by a more robust
//! method where neither helps.

use super::Group;
use super::engine::Engine;
use super::events::edge::Broken;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::integrate::implicit::{Energy, USUAL_ROUNDS, is_left_alone};
use crate::sim::real::Real;

/// Times that a substep is halved before it goes to a more robust method.
const MOST_SPLITS: u32 = 5;
/// The same of one of high order before it goes to a plain one.
const MOST_FINE_SPLITS: u32 = 20;
/// Parts of a substep that a plain method takes at most: a scene may ask for substeps of any length.
const MOST_PARTS: u32 = 4096;
/// Seconds of counted work for a second of the scene after which a substep goes on without being taken back: what is left of it is
/// taken by the more robust method, and events are dealt with where it ends.
pub(crate) const MOST_EFFORT: f64 = 100.0;
/// Steps of the method that a substep may take before that, however short it is.
const LEAST_TRIES: u64 = 32;

/// A method of order 2 behind one of high order, with a guard of its own.
#[derive(Clone, Debug)]
pub(crate) struct Plain<S: Real, const D: usize> {
    pub(crate) engine: Box<Engine<S, D>>,
    /// Seconds of counted work for a second of the scene after which a substep is not cut for its errors any more, but goes here at once.
    pub(crate) effort: f64,
    /// Its longest substep `[s]`.
    pub(crate) substep: f64,
    /// As that of the group.
    pub(crate) has_yielded: bool,
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Advances by `h` from time `t` `[s]`.
    pub(crate) fn advance(&mut self, around: &Environment<D>, t: f64, h: f64, counters: &mut Counters) {
        if let Engine::Bulk(bulk) = &mut self.engine {
            let before = *counters;
            bulk.bound(self.limit.saturating_sub(counters.work));
            bulk.step(&mut self.points, &self.pull, around, (t, h), counters, self.account.as_deref_mut());
            self.edges.broken = bulk.take_broken().map(|(at, bonds)| Broken { at, bonds });
            self.gave_up = bulk.take_gave_up();
            return counters.count_batches(&before, bulk.kernel().work_of_a_bond(), D);
        }
        counters.substeps += 1;
        counters.points_moved += self.points.len() as u64;
        self.has_yielded = false;
        self.plain.iter_mut().for_each(|plain| plain.has_yielded = false);
        if self.may_fail() {
            let least = LEAST_TRIES.saturating_mul(self.work.step);
            let fine = self.plain.as_ref().map_or(MOST_EFFORT, |plain| plain.effort);
            let [fine, most] = [fine, MOST_EFFORT].map(|effort| counters.work_after(effort * h));
            self.patience = [fine, most.saturating_add(least)];
            self.attempt(around, (t, h), 0, counters);
        } else {
            self.note_start();
            self.take(around, (t, h), counters);
            self.book_path(around, (t, h));
        }
    }

    /// A substep, in halves where the guard says so, in parts where events cut it.
    fn attempt(&mut self, around: &Environment<D>, (t, h): (f64, f64), depth: u32, counters: &mut Counters) {
        let mut done = 0.0;
        let mut events = 0;
        let most_events = 64 + 4 * self.points.len() as u32;
        while done < h {
            let (now, left) = (t + done, h - done);
            if self.gives_up(now, counters) {
                return;
            }
            self.points.save(&mut self.before);
            self.pull.contacts.set_out(&self.before.velocity);
            let is_fine = self.take(around, (now, left), counters);
            let mut passes = is_fine && self.guard.passes(&self.before.position, &self.points.position);
            if !passes {
                self.points.restore(&self.before);
                self.engine.refresh();
                passes = !is_fine && self.take_unheld(around, (now, left), counters);
            }
            if !passes {
                if self.may_split(depth, counters) {
                    counters.guard_splits += 1;
                    self.attempt(around, (now, 0.5 * left), depth + 1, counters);
                    if self.edges.broken.is_some() || self.gave_up.is_some() {
                        return;
                    }
                    return self.attempt(around, (now + 0.5 * left, 0.5 * left), depth + 1, counters);
                }
                // What follows in this substep is not cut into as many parts that each fail again.
                self.has_yielded = true;
                if let Some(plain) = self.plain.take() {
                    return self.attempt_plainly(plain, around, (now, left), counters);
                }
                counters.fallbacks += 1;
                self.take_robustly(around, (now, left), counters);
            }
            if passes && self.engine.meets_surfaces() {
                self.leave_ends();
                return self.book_path(around, (now, left));
            }
            if !self.has_events() {
                return self.book_path(around, (now, left));
            }
            events += 1;
            let may_locate = events < most_events && self.is_patient(counters);
            done += self.meet(around, (now, left), may_locate, counters);
            if h - done < 1e-12 * h || self.edges.broken.is_some() {
                return;
            }
        }
    }

    /// The rest of a substep by a plain method, cut anew where its guard says so.
    fn attempt_plainly(
        &mut self,
        plain: Plain<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) {
        let Plain { mut engine, mut has_yielded, .. } = plain;
        std::mem::swap(&mut self.engine, &mut engine);
        let follows_turns = std::mem::replace(&mut self.guard.follows_turns, false);
        self.engine.refresh();
        std::mem::swap(&mut self.has_yielded, &mut has_yielded);
        let parts = ((h / plain.substep - 1e-9).ceil() as u32).clamp(1, MOST_PARTS);
        for part in 0..parts {
            let start = t + h * (f64::from(part) / f64::from(parts));
            self.attempt(around, (start, h / f64::from(parts)), 0, counters);
            if self.edges.broken.is_some() || self.gave_up.is_some() {
                break;
            }
        }
        std::mem::swap(&mut self.has_yielded, &mut has_yielded);
        self.guard.follows_turns = follows_turns;
        std::mem::swap(&mut self.engine, &mut engine);
        self.engine.refresh();
        self.plain = Some(Plain { engine, has_yielded, ..plain });
    }

    /// Whether the step under way is given up at `now` `[s]`, for it costs too much: what is left of it is somebody else's.
    pub(crate) fn gives_up(&mut self, now: f64, counters: &Counters) -> bool {
        if counters.work.saturating_add(self.work.step) > self.limit {
            self.gave_up = Some(now);
        }
        self.gave_up.is_some()
    }

    /// Whether the substep under way may be halved once more.
    fn may_split(&self, depth: u32, counters: &Counters) -> bool {
        match self.plain {
            _ if self.has_yielded => false,
            Some(_) => depth < MOST_FINE_SPLITS && counters.work < self.patience[0],
            None => depth < MOST_SPLITS && self.is_patient(counters),
        }
    }

    /// Whether parts of the substep under way may still be taken back.
    fn is_patient(&self, counters: &Counters) -> bool {
        counters.work < self.patience[1]
    }

    /// Whether a substep may have to be taken back or cut. Kicks and flights alone converge always.
    fn may_fail(&self) -> bool {
        !self.guard.bonds.is_empty() || self.has_events() || !matches!(self.engine, Engine::Splitting(_))
    }

    /// Surfaces, an edge of the mouse region or lengths of bonds that are located.
    fn has_events(&self) -> bool {
        self.pull.contacts.has_surfaces() || self.pull.inside.is_some() || !self.edges.is_empty()
    }

    pub(super) fn take(&mut self, around: &Environment<D>, (t, h): (f64, f64), counters: &mut Counters) -> bool {
        let Group { points, pull, engine, work, limit, account, .. } = self;
        counters.work += work.step;
        engine.begin_tally(account.is_some());
        if let Engine::Implicit(implicit) = engine {
            let left = limit.saturating_sub(counters.work) / (work.step / USUAL_ROUNDS).max(1);
            implicit.most_rounds = left.saturating_add(USUAL_ROUNDS);
        }
        let is_fine = engine.step(points, pull, around, (t, h), counters);
        if let Engine::Implicit(implicit) = engine {
            counters.work += work.step / USUAL_ROUNDS * implicit.rounds().saturating_sub(USUAL_ROUNDS);
        }
        is_fine
    }

    /// The step with no point resting: surfaces and rigid bonds may hold points in ways that contradict each other, and what lies
    /// on a surface meets it again at the end. Returns whether that was so.
    fn take_unheld(&mut self, around: &Environment<D>, (t, h): (f64, f64), counters: &mut Counters) -> bool {
        if self.pull.contacts.is_idle() || self.pull.rigid.is_none() {
            return false;
        }
        self.pull.contacts.clear();
        self.engine.refresh();
        let is_fine =
            self.take(around, (t, h), counters) && self.guard.passes(&self.before.position, &self.points.position);
        if !is_fine {
            self.points.restore(&self.before);
            self.engine.refresh();
        }
        is_fine
    }

    /// The step by the more robust method, or by the engine again where there is none. What is found where it fails too, or with energy from
    /// nowhere, may be anywhere: it stands still instead.
    fn take_robustly(&mut self, around: &Environment<D>, (t, h): (f64, f64), counters: &mut Counters) {
        let Group { points, pull, engine, robust, work, .. } = self;
        counters.work += work.robust;
        let has_surfaces = pull.contacts.has_surfaces();
        let meets = engine.meets_surfaces();
        let is_watched = meets && has_surfaces && is_left_alone(points, pull, around, t);
        let before = is_watched.then(|| Energy::of(points, pull, h));
        let by = match robust {
            Some(robust) => {
                robust.refresh();
                &mut **robust
            }
            None => engine,
        };
        let may_miss = !has_surfaces || !(meets || by.meets_surfaces());
        let mut holds = by.step(points, pull, around, (t, h), counters) || may_miss;
        if holds && robust.is_some() {
            pull.project(points, counters);
        }
        holds &= !before.is_some_and(|before| before.is_exceeded(Energy::of(points, pull, h)));
        let is_number = |x: &[S; D]| x.iter().all(|x| x.is_finite());
        if !holds && points.position.iter().chain(&points.velocity).all(is_number) {
            points.restore(&self.before);
            points.stop();
            pull.contacts.clear();
        }
        self.engine.refresh();
    }
}
