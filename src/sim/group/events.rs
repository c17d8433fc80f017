//! Events of a group: points that reach surfaces, cross the edge of the mouse region, or stop sliding.

use super::Group;
use crate::sim::contact::impact::{self, Hit};
use crate::sim::contact::place;
use crate::sim::contact::surface::Surface;
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

/// Something that happens when its margin falls to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Event {
    /// A point reaches a surface.
    Hit { point: usize, surface: usize },
    /// A point crosses the edge of the mouse region.
    Cross { point: usize },
    /// A resting point is no longer pressed onto a surface.
    Lift { point: u32, surface: u32 },
    /// A point that friction holds begins to slide.
    Slip { point: u32 },
    /// A sliding point stops.
    Stop { point: u32 },
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
    fn margins(&mut self, around: &Surroundings<D>, t: f64, asked: Option<Event>, counters: &mut Counters) -> Margins {
        let mut margins = Margins { least: f64::INFINITY, next: None, asked: f64::INFINITY };
        let mut see = |event, margin| margins.see(event, margin, asked);
        self.see_rests(around, t, counters, &mut see);
        self.see_surfaces(&mut see);
        self.see_mouse(around, t, &mut see);
        margins
    }

    fn see_surfaces(&self, see: &mut impl FnMut(Event, f64)) {
        for (s, surface) in self.pull.contacts.surfaces.iter().enumerate() {
            let slack = surface.slack();
            for (i, &x) in self.points.position.iter().enumerate() {
                let gap = surface.gap(x);
                if self.can_hit(i, s) {
                    // Within the slack is on the surface: there it counts where the point goes.
                    let margin = at_edge(gap.to_f64(), slack.to_f64(), self.comes(i, surface));
                    see(Event::Hit { point: i, surface: s }, margin);
                }
            }
        }
    }

    /// How firmly resting points are pressed, sticking ones held, and how much sliding ones have kept of their speed.
    fn see_rests(
        &mut self,
        around: &Surroundings<D>,
        t: f64,
        counters: &mut Counters,
        see: &mut impl FnMut(Event, f64),
    ) {
        if self.pull.contacts.is_idle() || !self.locates {
            return;
        }
        self.accelerations(around, t, counters);
        let contacts = &self.pull.contacts;
        for rest in &contacts.rests {
            let (point, size) = (rest.point, length(rest.pressing));
            let along = rest.along(rest.pressing);
            let grip = rest.grip(&contacts.surfaces);
            if size > S::ZERO {
                for &surface in rest.surfaces() {
                    let press = -(dot(rest.pressing, contacts.surfaces[surface as usize].normal) / size).to_f64();
                    see(Event::Lift { point, surface }, at_edge(press, LOOSE, true));
                }
                if rest.sticks {
                    let most = grip * length(sub(rest.pressing, along));
                    let margin = ((most - length(along)) / size).to_f64();
                    see(Event::Slip { point }, at_edge(margin, LOOSE, true));
                }
            }
            let square = dot(rest.heading, rest.heading);
            if !rest.sticks && grip > S::ZERO && square > S::ZERO {
                let kept = dot(rest.heading, self.points.velocity[point as usize]) / square;
                see(Event::Stop { point }, at_edge(kept.to_f64(), LOOSE, true));
            }
        }
    }

    /// The depth of points that count as inside the mouse region, and of those outside with a minus.
    fn see_mouse(&self, around: &Surroundings<D>, t: f64, see: &mut impl FnMut(Event, f64)) {
        let (Some(inside), Some((force, cursor))) = (&self.pull.inside, around.mouse_at(t)) else { return };
        if inside.count == 0 && !mouse::reaches(&self.points, force, cursor) {
            return;
        }
        let slack = S::EPSILON.to_f64() * 64.0 * (1.0 + force.radius);
        for (i, &x) in self.points.position.iter().enumerate() {
            if self.points.inverse_mass[i] != S::ZERO {
                let depth = mouse::depth(force, cursor, x);
                let margin = if inside.points[i] { depth } else { -depth };
                let crosses = margin.abs() <= slack && self.goes_in(around, t, i, depth) != inside.points[i];
                see(Event::Cross { point: i }, at_edge(margin, slack, crosses));
            }
        }
    }

    /// Whether a point moves into a surface, faster than rounding does.
    fn comes(&self, point: usize, surface: &Surface<S, D>) -> bool {
        let off = dot(self.points.velocity[point], surface.normal);
        off * S::from_f64(self.substep) < -surface.slack()
    }

    fn can_hit(&self, point: usize, surface: usize) -> bool {
        self.points.inverse_mass[point] != S::ZERO && !self.pull.contacts.rests_on(point, surface)
    }

    /// Whether a point gets deeper into the mouse region.
    fn goes_in(&self, around: &Surroundings<D>, t: f64, point: usize, depth: f64) -> bool {
        let ahead = 1e-6 * self.substep;
        let soon = add(self.points.position[point], scale(self.points.velocity[point], S::from_f64(ahead)));
        around.mouse_at(t + ahead).is_some_and(|(force, cursor)| mouse::depth(force, cursor, soon) > depth)
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
        let passed = self.margins(around, t + h, None, counters);
        let mut taken = h;
        if passed.least < 0.0
            && self.locates
            && may_locate
            && let Some(event) = passed.next
        {
            taken = self.locate(around, (t, h), (event, passed.least), counters);
        }
        self.pull.contacts.settle(&mut self.points);
        if passed.least <= 0.0 {
            self.happen(around, (t, taken, h), taken < h || passed.least == 0.0, counters);
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

    /// Goes back and takes the part of the step that ends at the first event. Returns that part, or `h` where none can
    /// be told from the start.
    fn locate(
        &mut self,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        (event, value): (Event, f64),
        counters: &mut Counters,
    ) -> f64 {
        let (mut event, mut high) = (event, (h, value));
        loop {
            let mut low = (0.5 * high.0, 0.0);
            loop {
                let seen = self.retake(around, (t, low.0), event, counters);
                low.1 = seen.asked;
                if low.1 > 0.0 {
                    break;
                }
                high = if low.1 < 0.0 { low } else { high };
                low.0 *= 0.5;
                if low.0 < h * SHORTEST_FLIGHT {
                    self.retake(around, (t, h), event, counters);
                    return h;
                }
            }
            match self.close_in(around, t, event, (low, high), counters) {
                (at, None) => return at,
                // Another event comes first.
                (at, Some((earlier, value))) => (event, high) = (earlier, (at, value)),
            }
        }
    }

    /// The root of an event's margin; or where another event was found to have been passed already.
    fn close_in(
        &mut self,
        around: &Surroundings<D>,
        t: f64,
        event: Event,
        (low, high): ((f64, f64), (f64, f64)),
        counters: &mut Counters,
    ) -> (f64, Option<(Event, f64)>) {
        let mut root = Root::between(low, high);
        let mut at = high.0;
        for _ in 0..MOST_GUESSES {
            at = root.guess();
            let seen = self.retake(around, (t, at), event, counters);
            if let Some(earlier) = seen.next.filter(|&next| seen.least < 0.0 && next != event && seen.asked > 0.0) {
                return (at, Some((earlier, seen.least)));
            }
            if seen.asked == 0.0 || root.width() < 4.0 * f64::EPSILON * (t + high.0) {
                break;
            }
            root.narrow(at, seen.asked);
        }
        (at, None)
    }

    /// Takes a step of `h` from the state before. Returns the margins that it ends with.
    fn retake(
        &mut self,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        event: Event,
        counters: &mut Counters,
    ) -> Margins {
        self.points.restore(&self.before);
        self.engine.refresh();
        self.take(around, (t, h), counters);
        self.margins(around, t + h, Some(event), counters)
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
                let comes = self.comes(i, surface);
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
            // A point that is well across was not caught at the edge: it counts as where it is.
            let is_inside = if depth.abs() <= slack { self.goes_in(around, t, i, depth) } else { depth > 0.0 };
            if is_inside != inside.points[i] {
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
