//! Events of a group: points that reach surfaces, cross the edge of the mouse region, or stop sliding.

use super::Group;
use crate::sim::contact::impact::{self, Hit};
use crate::sim::contact::place;
use crate::sim::counters::Counters;
use crate::sim::force::mouse;
use crate::sim::real::Real;
use crate::sim::solve::root::Root;
use crate::sim::surroundings::Surroundings;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Evaluations after which a root counts as found.
const MOST_GUESSES: u32 = 60;
/// Share of a substep below which a flight between two bounces counts as rest, where events are located.
const SHORTEST_FLIGHT: f64 = 1e-4;
/// Rounds in which points outside are put back to surfaces, and their bonds to their lengths.
const MOST_ROUNDS: u32 = 4;
/// Share of its acceleration that presses a point so little that it counts as let go.
const LOOSE: f64 = 1e-12;

impl<S: Real, const D: usize> Group<S, D> {
    /// How far the state is from the next event: below 0 one has been passed. Points that rest are left out.
    fn margin(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) -> f64 {
        let mut least = self.pressing_margin(around, t, counters);
        for (s, surface) in self.pull.contacts.surfaces.iter().enumerate() {
            let slack = surface.slack();
            for (i, &x) in self.points.position.iter().enumerate() {
                let gap = surface.gap(x);
                if gap < S::from_f64(least) && self.can_hit(i, s) {
                    // Within the slack is on the surface: there it counts where the point goes.
                    let comes = dot(self.points.velocity[i], surface.normal) < S::ZERO;
                    least = at_edge(gap.to_f64(), slack.to_f64(), comes);
                }
            }
        }
        least.min(self.mouse_margin(around, t)).min(self.sliding_margin())
    }

    /// How firmly resting points are pressed and sticking ones held, relative to their accelerations.
    fn pressing_margin(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) -> f64 {
        let mut least = f64::INFINITY;
        if self.pull.contacts.is_idle() || !self.locates {
            return least;
        }
        self.accelerations(around, t, counters);
        let contacts = &self.pull.contacts;
        for rest in &contacts.rests {
            let size = length(rest.pressing);
            if size == S::ZERO {
                continue;
            }
            for &s in rest.surfaces() {
                let press = -(dot(rest.pressing, contacts.surfaces[s as usize].normal) / size).to_f64();
                least = least.min(if press.abs() <= LOOSE { 0.0 } else { press });
            }
            if rest.sticks {
                let along = rest.along(rest.pressing);
                let most = rest.grip(&contacts.surfaces) * length(sub(rest.pressing, along));
                let hold = ((most - length(along)) / size).to_f64();
                least = least.min(if hold.abs() <= LOOSE { 0.0 } else { hold });
            }
        }
        least
    }

    fn can_hit(&self, point: usize, surface: usize) -> bool {
        self.points.inverse_mass[point] != S::ZERO && !self.pull.contacts.rests_on(point, surface)
    }

    /// The least depth of points that count as inside the mouse region, and of those outside with a minus.
    fn mouse_margin(&self, around: &Surroundings<D>, t: f64) -> f64 {
        let (Some(inside), Some((force, cursor))) = (&self.pull.inside, around.mouse_at(t)) else {
            return f64::INFINITY;
        };
        if inside.count == 0 && !mouse::reaches(&self.points, force, cursor) {
            return f64::INFINITY;
        }
        let slack = S::EPSILON.to_f64() * 64.0 * (1.0 + force.radius);
        let mut least = f64::INFINITY;
        for (i, &x) in self.points.position.iter().enumerate() {
            if self.points.inverse_mass[i] != S::ZERO {
                let depth = mouse::depth(force, cursor, x);
                let margin = if inside.points[i] { depth } else { -depth };
                if margin < least {
                    let crosses = || self.goes_in(around, t, i, depth) != inside.points[i];
                    least = at_edge(margin, slack, margin.abs() <= slack && crosses());
                }
            }
        }
        least
    }

    /// Whether a point gets deeper into the mouse region.
    fn goes_in(&self, around: &Surroundings<D>, t: f64, point: usize, depth: f64) -> bool {
        let ahead = 1e-6 * self.substep;
        let soon = add(self.points.position[point], scale(self.points.velocity[point], S::from_f64(ahead)));
        around.mouse_at(t + ahead).is_some_and(|(force, cursor)| mouse::depth(force, cursor, soon) > depth)
    }

    /// The least share of its velocity that a sliding point has kept in its direction: below 0 it would go back.
    fn sliding_margin(&self) -> f64 {
        let contacts = &self.pull.contacts;
        let mut least = f64::INFINITY;
        for rest in &contacts.rests {
            let i = rest.point as usize;
            if rest.sticks || rest.grip(&contacts.surfaces) == S::ZERO {
                continue;
            }
            let before = rest.along(self.before.velocity[i]);
            let square = dot(before, before);
            if square > S::ZERO {
                least = least.min((dot(before, self.points.velocity[i]) / square).to_f64());
            }
        }
        least
    }

    /// After a step from `t` to `t + h`: deals with the first event that it passed, if it passed one.
    ///
    /// Returns how much of the step was taken: events are located, and what follows is another step.
    pub(super) fn meet(
        &mut self,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        may_locate: bool,
        counters: &mut Counters,
    ) -> f64 {
        let passed = self.margin(around, t + h, counters);
        let mut taken = h;
        if passed < 0.0 && self.locates && may_locate {
            taken = self.locate(around, (t, h), passed, counters);
        }
        self.pull.contacts.settle(&mut self.points);
        if passed <= 0.0 {
            self.happen(around, (t, taken, h), taken < h || passed == 0.0, counters);
        } else if !self.pull.contacts.is_idle() {
            self.review(around, t + taken, counters);
        }
        taken
    }

    /// At the start: points outside come back to the surface, those that stand on one rest there.
    pub(super) fn meet_start(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) {
        let mut hits = Vec::new();
        for (s, surface) in self.pull.contacts.surfaces.iter().enumerate() {
            for (i, &x) in self.points.position.iter().enumerate() {
                if self.points.inverse_mass[i] != S::ZERO && surface.gap(x) <= surface.slack() {
                    hits.push(Hit { point: i, surface: s });
                }
            }
        }
        if hits.is_empty() {
            return;
        }
        self.push_out(&hits);
        let rigid = self.pull.rigid.as_mut();
        impact::strike(&mut self.points, &mut self.pull.contacts, rigid, &hits, |_, _| false);
        for hit in hits {
            let off = dot(self.points.velocity[hit.point], self.pull.contacts.surfaces[hit.surface].normal);
            if off == S::ZERO {
                self.pull.contacts.touch(hit.point, hit.surface);
            }
        }
        self.points.save(&mut self.before);
        self.review(around, t, counters);
    }

    /// Goes back and takes the part of the step that ends at the event. Returns that part.
    fn locate(&mut self, around: &Surroundings<D>, (t, h): (f64, f64), passed: f64, counters: &mut Counters) -> f64 {
        let mut low = (h, 0.0);
        while low.1 <= 0.0 {
            low.0 *= 0.5;
            if low.0 < h * SHORTEST_FLIGHT {
                self.retake(around, (t, h), counters);
                return h;
            }
            low.1 = self.retake(around, (t, low.0), counters);
        }
        let high = if low.0 > 0.4 * h { (h, passed) } else {
            let end = 2.0 * low.0;
            (end, self.retake(around, (t, end), counters))
        };
        if high.1 >= 0.0 {
            return self.locate_on(around, (t, h), (low, (h, passed)), counters);
        }
        self.locate_on(around, (t, h), (low, high), counters)
    }

    fn locate_on(
        &mut self,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        (low, high): ((f64, f64), (f64, f64)),
        counters: &mut Counters,
    ) -> f64 {
        let mut root = Root::between(low, high);
        let mut at = high.0;
        for _ in 0..MOST_GUESSES {
            at = root.guess();
            let value = self.retake(around, (t, at), counters);
            if value == 0.0 || root.width() < 1e-15 * h.max(t) {
                break;
            }
            root.narrow(at, value);
        }
        at
    }

    /// Takes a step of `h` from the state before. Returns the margin that it ends with.
    fn retake(&mut self, around: &Surroundings<D>, (t, h): (f64, f64), counters: &mut Counters) -> f64 {
        self.points.restore(&self.before);
        self.engine.refresh();
        self.take(around, (t, h), counters);
        self.margin(around, t + h, counters)
    }

    /// Deals with all events at the state reached.
    fn happen(
        &mut self,
        around: &Surroundings<D>,
        (t, taken, h): (f64, f64, f64),
        is_located: bool,
        counters: &mut Counters,
    ) {
        let hits = self.hits(is_located);
        counters.events += hits.len() as u64;
        if !is_located {
            self.push_out(&hits);
        }
        self.accelerations(around, t + taken, counters);
        let shortest = if is_located { SHORTEST_FLIGHT * h } else { 4.0 * h };
        let (accelerations, surfaces) = (std::mem::take(&mut self.acceleration), self.pull.contacts.surfaces.clone());
        let gentle = |hit: Hit, speed: S| {
            let pull = dot(accelerations[hit.point], surfaces[hit.surface].normal);
            (speed + speed).to_f64() <= -pull.to_f64() * shortest
        };
        impact::strike(&mut self.points, &mut self.pull.contacts, self.pull.rigid.as_mut(), &hits, gentle);
        self.acceleration = accelerations;
        self.cross(around, t + taken, counters);
        self.review(around, t + taken, counters);
        self.engine.refresh();
    }

    /// Points at or beyond a surface on their way into it.
    fn hits(&self, is_located: bool) -> Vec<Hit> {
        let mut hits = Vec::new();
        for (s, surface) in self.pull.contacts.surfaces.iter().enumerate() {
            let slack = surface.slack();
            let reach = if is_located { slack * S::from_f64(16.0) } else { -slack };
            for (i, &x) in self.points.position.iter().enumerate() {
                let comes = dot(self.points.velocity[i], surface.normal) < S::ZERO;
                if surface.gap(x) <= reach && self.can_hit(i, s) && (comes || !is_located) {
                    hits.push(Hit { point: i, surface: s });
                }
            }
        }
        hits
    }

    /// Where events are not located: points that went through a surface spend the rest of the way on the way back, at
    /// `restitution` of their speed, as far as their bonds let them.
    fn push_out(&mut self, hits: &[Hit]) {
        for hit in hits {
            let surface = &self.pull.contacts.surfaces[hit.surface];
            let (gap, start) = (surface.gap(self.points.position[hit.point]), self.before.position.get(hit.point));
            let was_inside = start.is_some_and(|&x| surface.gap(x) >= S::ZERO);
            if gap < S::ZERO && was_inside {
                let back = scale(surface.normal, -(surface.restitution * gap));
                self.points.position[hit.point] = add(self.points.position[hit.point], back);
            }
        }
        for _ in 0..MOST_ROUNDS {
            let out = self.hits(false);
            if out.is_empty() {
                return;
            }
            let mut held = self.pull.contacts.clone();
            for hit in out {
                place(&mut self.points, hit.point, &self.pull.contacts.surfaces[hit.surface]);
                held.touch(hit.point, hit.surface);
            }
            if let Some(rigid) = &mut self.pull.rigid {
                rigid.project(&mut self.points, &held);
            }
        }
    }

    /// Points that crossed the edge of the mouse region count as on its other side.
    fn cross(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) {
        let (Some(inside), Some((force, cursor))) = (&self.pull.inside, around.mouse_at(t)) else { return };
        let slack = S::EPSILON.to_f64() * 1024.0 * (1.0 + force.radius);
        let mut crossed = Vec::new();
        for (i, &x) in self.points.position.iter().enumerate() {
            let depth = mouse::depth(force, cursor, x);
            if depth.abs() <= slack && self.goes_in(around, t, i, depth) != inside.points[i] {
                crossed.push(i);
            }
        }
        counters.events += crossed.len() as u64;
        if let Some(inside) = &mut self.pull.inside {
            crossed.into_iter().for_each(|point| inside.toggle(point));
        }
    }

    /// The whole acceleration of every point at the present state, into `self.acceleration`.
    fn accelerations(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) {
        let Group { points, pull, acceleration, .. } = self;
        acceleration.resize(points.len(), [S::ZERO; D]);
        let state = (&points.position[..], &points.velocity[..], &points.inverse_mass[..]);
        pull.accelerate(around, t, state, acceleration, counters);
    }

    /// Lets go of points that are no longer pressed, and decides who sticks and who slides.
    fn review(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) {
        if self.pull.contacts.is_idle() {
            return;
        }
        self.accelerations(around, t, counters);
        let (velocity, before) = (&mut self.points.velocity, &self.before.velocity);
        self.pull.contacts.retain(|rest, surfaces| {
            let pressing = rest.pressing;
            let least = length(pressing) * S::from_f64(LOOSE);
            rest.keep(surfaces, |s| dot(pressing, surfaces[s].normal) < -least);
            let grip = rest.grip(surfaces);
            let along = rest.along(pressing);
            let most = grip * length(sub(pressing, along));
            if grip == S::ZERO || length(along) >= most * S::from_f64(1.0 - LOOSE) {
                rest.sticks = false;
                return;
            }
            let i = rest.point as usize;
            let (old, new) = (rest.along(before[i]), rest.along(velocity[i]));
            let scale = dot(old, old).max(S::EPSILON * S::EPSILON);
            if !rest.sticks && (dot(old, new) <= S::ZERO || dot(new, new) <= S::EPSILON * scale) {
                rest.sticks = true;
                velocity[i] = [S::ZERO; D];
            }
        });
        self.engine.refresh();
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
