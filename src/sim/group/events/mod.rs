//! Events of a group: points that reach surfaces, cross the edge of the mouse region, or stop sliding; bonds that get
//! taut, go slack or break.

mod breaks;
pub(crate) mod edge;
mod graze;
mod locate;
mod reach;
mod region;
mod rests;
mod strings;
mod surfaces;
mod walls;

use std::sync::Arc;

use super::Group;
use super::booking::Cause;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::group::impact::{self, Hit};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, zero};

/// Share of a substep below which a flight between two bounces counts as rest, where events are located.
const SHORTEST_FLIGHT: f64 = 1e-4;

/// Something that happens when its margin falls to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Event {
    /// A point reaches a surface.
    Hit { point: usize, surface: usize },
    /// A point crosses the edge of the mouse region.
    Cross { point: usize },
    /// A resting point is no longer pressed onto a surface.
    Lift { point: u32, surface: u32 },
    /// A resting point comes to the end of a wall.
    Leave { point: u32, surface: u32 },
    /// A point that friction holds begins to slide.
    Slip { point: u32 },
    /// A sliding point stops.
    Stop { point: u32 },
    /// A bond reaches a length at which something happens to it.
    Reach { edge: usize },
    /// A taut string no longer pulls.
    LetGo { edge: usize },
}

impl Event {
    /// Whether it is of a bond.
    fn is_of_bond(self) -> bool {
        matches!(self, Event::Reach { .. } | Event::LetGo { .. })
    }
}

/// The least margin, and one of interest.
#[derive(Clone, Copy, Debug)]
struct Margins {
    least: f64,
    /// Whose margin is the least.
    next: Option<Event>,
    /// The margin of the event that was asked for.
    asked: f64,
}

impl Margins {
    fn see(&mut self, event: Event, margin: f64, asked: Option<Event>) {
        if margin < self.least {
            (self.least, self.next) = (margin, Some(event));
        }
        if asked == Some(event) {
            self.asked = margin;
        }
    }
}

impl<S: Real, const D: usize> Group<S, D> {
    /// How far the state is from its events: below 0 one has been passed. Points that rest hit nothing.
    fn margins(&mut self, around: &Environment<D>, t: f64, asked: Option<Event>, counters: &mut Counters) -> Margins {
        counters.work += self.work.look;
        let mut margins = Margins { least: f64::INFINITY, next: None, asked: f64::INFINITY };
        let mut see = |event, margin| margins.see(event, margin, asked);
        if self.locates && (!self.pull.contacts.is_idle() || self.has_taut()) {
            self.accelerations(around, t, counters);
            self.see_rests(&mut see);
            self.see_strings(asked, &mut see);
        }
        self.see_edges(&mut see);
        self.see_surfaces(asked, &mut see);
        self.see_mouse(around, t, &mut see);
        margins
    }

    /// After a step from `t` to `t + h`: deals with the first event that it passed, if it passed one.
    ///
    /// Returns how much of the step was taken: events are located, and what follows is another step.
    pub(super) fn meet(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        may_locate: bool,
        counters: &mut Counters,
    ) -> f64 {
        let passed = self.margins(around, t + h, None, counters);
        let (mut taken, mut event) = (h, passed.next.filter(|_| passed.least <= 0.0));
        if self.locates && may_locate && self.edges.may_turn() {
            if passed.least < 0.0
                && let Some(first) = passed.next
            {
                (taken, event) = self.locate(around, (t, h), (first, (h, passed.least)), counters);
            } else if passed.least > 0.0
                && let Some(grazed) = self.graze(around, (t, h))
            {
                (taken, event) = self.look_between(around, (t, h), grazed, counters);
            }
        }
        self.book_path(around, (t, taken));
        self.edges.restarts = if taken == 0.0 { self.edges.restarts + 1 } else { 0 };
        self.edges.turns += u32::from(event.is_some_and(Event::is_of_bond));
        self.pull.contacts.settle(&mut self.points);
        if event.is_some() {
            self.happen(around, (t, taken, h), (event, taken < h || passed.least == 0.0), counters);
        } else if !self.pull.contacts.is_idle() {
            self.leave(None);
            self.review(around, t + taken, counters);
        }
        taken
    }

    /// Deals with all events at the state reached.
    fn happen(
        &mut self,
        around: &Environment<D>,
        (t, taken, h): (f64, f64, f64),
        (event, is_located): (Option<Event>, bool),
        counters: &mut Counters,
    ) {
        let returns = taken == 0.0 && self.recedes(event);
        let before = self.energy_if_kept();
        let jerks = self.turn_edges(event, is_located, t + taken, counters);
        if returns {
            self.capture();
        }
        if jerks
            && !is_located
            && let Some(rigid) = &mut self.pull.rigid
        {
            rigid.project(&mut self.points, &self.pull.contacts);
        }
        if jerks || returns {
            self.book_change(before, Cause::Jerk);
        }
        let mut hits = self.hits(is_located);
        hits.extend(self.due(event).filter(|due| is_located && !hits.contains(due)));
        counters.events += hits.len() as u64;
        let mut late = Vec::new();
        if !is_located || self.is_sunk(&hits) {
            let fall = around.gravity.map(|g| S::from_f64(g * taken * taken));
            late = self.push_out(&mut hits, if is_located { zero() } else { fall });
        }
        let is_loose = !is_located && self.pull.rigid.is_none();
        late.retain(|(point, _)| is_loose && self.pull.contacts.of(*point).is_none());
        self.leave(event);
        self.add_gravity(around, &late, -taken);
        let shortest = if is_located { SHORTEST_FLIGHT * h } else { 4.0 * h };
        self.bounce(around, (t + taken, shortest), (&hits, is_located), counters);
        self.add_gravity(around, &late, taken);
        if !is_located
            && let Some(rigid) = &mut self.pull.rigid
            && rigid.holds_areas()
        {
            // What was put out of surfaces took areas along.
            rigid.project(&mut self.points, &self.pull.contacts);
        }
        self.note_strings();
        self.cross(around, t + taken, counters);
        self.review(around, t + taken, counters);
        if taken == 0.0 {
            self.take_due(event);
        }
        self.watch_taut();
        self.engine.refresh();
    }

    /// Points that hit surfaces get their velocities off them; those whose flight would be shorter than `shortest` `[s]`
    /// come to rest.
    fn bounce(
        &mut self,
        around: &Environment<D>,
        (t, shortest): (f64, f64),
        hits: (&[Hit], bool),
        counters: &mut Counters,
    ) {
        self.accelerations(around, t, counters);
        let (accelerations, surfaces) =
            (std::mem::take(&mut self.acceleration), Arc::clone(&self.pull.contacts.obstacles.surfaces));
        let gentle = |hit: Hit, speed: S| {
            let pull = dot(accelerations[hit.point], surfaces[hit.surface].normal);
            (speed + speed).to_f64() <= -pull.to_f64() * shortest
        };
        let book = self.account.as_mut().map(|account| &mut account.book);
        impact::strike(&mut self.points, &mut self.pull.contacts, self.pull.rigid.as_mut(), hits, gentle, book);
        self.acceleration = accelerations;
    }

    /// Points are as fast as gravity makes them in shares of `h` `[s]`.
    fn add_gravity(&mut self, around: &Environment<D>, shares: &[(usize, S)], h: f64) {
        for &(point, share) in shares {
            let gained = around.gravity.map(|g| S::from_f64(g * h) * share);
            let gained = self.pull.contacts.of(point).map_or(gained, |rest| rest.free(gained));
            self.points.velocity[point] = add(self.points.velocity[point], gained);
        }
    }

    /// The whole acceleration of every point at the present state, into `self.acceleration`.
    fn accelerations(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) {
        let Group { points, pull, acceleration, .. } = self;
        acceleration.resize(points.len(), [S::ZERO; D]);
        let state = (&points.position[..], &points.velocity[..], &points.inverse_mass[..]);
        pull.accelerate(around, t, state, acceleration, counters);
    }
}

/// A margin of an event that happens at 0: within the slack it is 0 where the point comes, else just not there yet.
fn at_edge(margin: f64, slack: f64, comes: bool) -> f64 {
    match margin.abs() <= slack {
        true if comes => 0.0,
        true => slack,
        false => margin,
    }
}
