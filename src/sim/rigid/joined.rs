//! Bodies that joints hold together, on their course from one moment to the next.

use std::cell::Cell;

use super::alone::gentle;
use super::body::Body;
use super::course::{Assembly, Fault, HANGING, Log, SHORTEST, TURN, book_strike, gives_back, within};
use super::link::End;
use super::linkage::twists_of;
use super::motion::{Motion, Twist};
use super::moving::{Moving, Spot};
use super::solid::Solid;
use super::strings::Strand;
use super::together::Together;
use super::touch::{Near, Touch, closing, narrowed};
use crate::sim::contact::coulomb::line::Line;
use crate::sim::contact::coulomb::{Friction, strike};
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::solve::root::Root;
use crate::sim::vector::{add, dot, flat, length, scale, sub};

/// Longest part of a step in flight, so many of a step at least `[s]`; and the angle that a body or a rod turns in it at most `[rad]`: of order 4, so
/// that a swing of a second is right to a few 1e-7 of its size.
const IN_FLIGHT: (f64, f64) = (1.0 / 120.0, 2.0);
const TURN_IN_FLIGHT: f64 = 0.15;
/// How far it may get from where even accelerations lead, as a share of the shortest rod `[1]`: half a radian on a circle takes it that far, and
/// much less time where a chain gets taut and whips.
const MOST_JERK: f64 = 1.5e-2;
/// Share of its motion that a part in which nothing but gravity and drag acts may make or lose `[1]`, and what drag takes besides, of which ends
/// alone tell but so much.
const STRAYS: f64 = 3e-5;
const OF_DRAG: f64 = 0.05;
/// Hits in a frame as [`Assembly::most_hits`] has them: each takes a dozen ways of all bodies to locate.
const MOST_HITS: [f64; 2] = [20.0, 60.0];
/// How much heavier all of it is than a body from which on that swings like a string under the weight of the others, and the phase of that
/// which a part spans `[rad]`.
const LIGHT: f64 = 100.0;
const PHASE_OF_A_STRING: f64 = 0.3;
/// Phase of the fastest spring that a part spans `[rad]`, and share of the fastest decay.
const PHASE: f64 = 0.25;
const DECAY: f64 = 0.5;

impl<S: Real, const D: usize> Moving<'_, S, D> {
    /// The longest part of a step of `h` `[s]` in flight.
    pub(super) fn longest(&self, h: f64) -> f64 {
        let linkage = self.linkage;
        let [frequency, decay] = linkage.ties.rates;
        let driven = linkage.joints.links().iter().filter_map(|link| link.drive);
        let frequency = driven.map(|drive| drive.signal.fastest()).fold(frequency, f64::max);
        let ties = (PHASE / frequency).min(DECAY / decay);
        let g = length(self.field.pull.gravity);
        let swing = |(body, place): (u32, [f64; 2])| {
            let body = &linkage.bodies[body as usize];
            let lever = dot(place, place).sqrt();
            let inertia = 1.0 / body.inertia.inverse[1] + body.shape.mass * lever * lever;
            if lever > 0.0 { body.shape.mass * lever * g / inertia } else { 0.0 }
        };
        let links = linkage.joints.links().iter().map(|link| (link.ends, link.rest.map_or(0.0, |rest| g / rest)));
        let strings = linkage.strings.iter().map(|string| (string.ends, g / string.rest));
        let ends = links.chain(strings).flat_map(|(ends, of_rod)| {
            ends.map(|end| match end {
                End::On { body, place } => swing((body, place)).max(of_rod),
                End::Fixed(_) => of_rod,
            })
        });
        let fastest = ends.fold(0.0, f64::max);
        let in_flight = if linkage.ties.is_damped() { HANGING } else { IN_FLIGHT };
        let strings = PHASE_OF_A_STRING / self.strings(g).sqrt();
        self.field.longest(h).min(within(in_flight, h)).min(TURN_IN_FLIGHT / fastest.sqrt()).min(ties).min(strings)
    }

    /// The square of the fastest swing across a rod of what is light and carries what is heavy `[1/s^2]`, about: T (1/m_a + 1/m_b)/l with all
    /// the weight for a tension; 0: nothing is.
    fn strings(&self, g: f64) -> f64 {
        let masses = || self.linkage.bodies.iter().map(|body| body.shape.mass);
        let all: f64 = masses().sum();
        let inverse = |end: End| match end {
            End::On { body, .. } => 1.0 / self.linkage.bodies[body as usize].shape.mass,
            End::Fixed(_) => 0.0,
        };
        let rods = self.linkage.joints.links().iter().filter_map(|link| Some((link.rest?, link.ends)));
        let strings = self.linkage.strings.iter().map(|string| (string.rest, string.ends));
        let rods = rods.chain(strings).map(|(rest, ends)| (rest, ends.map(inverse)));
        let light = rods.filter(|(rest, [a, b])| *rest > 0.0 && all * a.max(*b) >= LIGHT);
        light.map(|(rest, [a, b])| g * all * (a + b) / rest).fold(0.0, f64::max)
    }

    /// Whether nothing but gravity and drag gives energy to what touches nothing, or takes some.
    fn is_conserved(&self) -> bool {
        !(self.field.pushes() || self.is_led() || self.linkage.is_driven()) && self.linkage.ties.is_empty()
    }

    /// Whether it made or lost more energy than is right in `h` `[s]` in which this is so.
    fn makes_energy(&self, (start, end): (&[Motion], &[Motion]), h: f64) -> bool {
        let rate = self.field.pull.drag_rate;
        let [before, after] = [start, end].map(|motions| self.linkage.energy_of(motions));
        let gravity = flat(self.field.pull.gravity);
        let falls = |((body, from), to): ((&Body, &Motion), &Motion)| {
            let way = sub(body.centre(&to.place), body.centre(&from.place));
            body.shape.mass * dot(way, gravity)
        };
        let given: f64 = self.linkage.bodies.iter().zip(start).zip(end).map(falls).sum();
        let made = after - before - given + rate * h * (before + after);
        made.abs() > (STRAYS + OF_DRAG * rate * h) * before.max(after)
    }

    /// Points on surfaces, of those bodies that are near some.
    fn spots(&self, near: &[Near], of: impl Fn(usize, &Near) -> Vec<Touch>) -> Vec<Spot> {
        let spots = |(body, near): (usize, &Near)| {
            let touches = if near.is_empty() { Vec::new() } else { of(body, near) };
            touches.into_iter().map(move |touch| Spot::Lies { body: body as u32, touch })
        };
        near.iter().enumerate().flat_map(spots).collect()
    }

    /// When within `h` `[s]` the first string gets taut along a path from `t` on, whose ends are given; `lying` are so already.
    fn first_taut(
        &self,
        path: &dyn Fn(f64) -> Vec<Motion>,
        (start, end, h): (&[Motion], &[Motion], f64),
        lying: &[Spot],
        t: f64,
    ) -> Option<f64> {
        let mut first: Option<f64> = None;
        for spot in self.strings_where((end, t + h), |gap| gap < -self.touch()) {
            let gap = |time: f64| self.gap((&path(time), t + time), spot);
            let latest = first.unwrap_or(h);
            let last = if latest < h { gap(latest) } else { self.gap((end, t + h), spot) };
            if lying.contains(&spot) || last >= -self.touch() || self.gap((start, t), spot) < -self.touch() {
                continue;
            }
            first = Some(closing(gap, (latest, last), self.touch()));
        }
        first
    }

    /// Strings whose gaps at `t` `[s]` are such.
    fn strings_where(&self, (motions, t): (&[Motion], f64), is_meant: impl Fn(f64) -> bool) -> Vec<Spot> {
        let all = (0..self.linkage.strings.len() as u32).map(Spot::Taut);
        all.filter(|&spot| is_meant(self.gap((motions, t), spot))).collect()
    }
}

/// How far the middle of a body is from where even accelerations would have led it in `h` `[s]`, by the speeds at both ends, at most `[m]`.
fn jerk(start: &[Motion], end: &[Motion], h: f64) -> f64 {
    let off = |(from, to): (&Motion, &Motion)| {
        let way = sub(to.place.middle, from.place.middle);
        let off = sub(way, scale(add(from.twist.velocity, to.twist.velocity), 0.5 * h));
        dot(off, off)
    };
    start.iter().zip(end).map(off).fold(0.0, f64::max).sqrt()
}

/// The touches of one body.
fn of(body: usize, spots: &[Spot]) -> Vec<Touch> {
    let own = |spot: &Spot| match *spot {
        Spot::Lies { body: of, touch } if of as usize == body => Some(touch),
        _ => None,
    };
    spots.iter().filter_map(own).collect()
}

impl<S: Real, const D: usize> Assembly for Moving<'_, S, D> {
    type Motion = Vec<Motion>;
    type Touch = Spot;
    type Near = Vec<Near>;

    fn turned(&self, motions: &Vec<Motion>) -> [f64; 2] {
        [TURN_IN_FLIGHT, TURN].map(|turn| (turn / self.turning(motions)).max(SHORTEST))
    }

    fn near(&self, motions: &Vec<Motion>, (t, h): (f64, f64)) -> Option<Vec<Near>> {
        let pushed = self.field.pushed()[0];
        // Joints pull bodies along.
        let far = motions.iter().map(|motion| motion.way(h, pushed)).fold(0.0, f64::max);
        let near: Vec<Near> =
            self.among.iter().zip(motions).map(|(among, motion)| among.near(motion, 2.0 * far)).collect();
        let stand = self.stand(motions, t);
        let may_get_taut =
            |string: &Strand| string.gap(stand) <= 2.0 * string.most_rate(stand) * h + 4.0 * far + 4.0 * pushed * h * h;
        (near.iter().any(|near| !near.is_empty()) || self.linkage.strings.iter().any(may_get_taut)).then_some(near)
    }

    fn most_hits(&self) -> [f64; 2] {
        MOST_HITS
    }

    fn put_out(&self, motions: &Vec<Motion>, t: f64, near: &Vec<Near>) -> Option<Vec<Motion>> {
        let behind = |motions: &[Motion]| self.spots(near, |body, near| self.among[body].behind(&motions[body], near));
        let beyond = |motions: &[Motion]| self.strings_where((motions, t), |gap| gap < -self.touch());
        // A string that is longer by a trifle is no reason to stop.
        let with_strings = self.mended(motions, t, |motions| [behind(motions), beyond(motions)].concat());
        match with_strings {
            None if !self.linkage.strings.is_empty() => self.mended(motions, t, behind),
            out => out,
        }
    }

    fn stopped(&self, mut motions: Vec<Motion>) -> Vec<Motion> {
        motions.iter_mut().for_each(|motion| motion.twist = Twist::STILL);
        motions
    }

    fn touching(&self, motions: &Vec<Motion>, t: f64, near: &Vec<Near>) -> Vec<Spot> {
        let mut spots = self.spots(near, |body, near| self.among[body].touching(&motions[body], near));
        spots.extend(self.strings_where((motions, t), |gap| gap <= self.touch()));
        spots
    }

    fn speed(&self, motions: &Vec<Motion>, t: f64, spot: Spot) -> f64 {
        let [across, _] = match spot {
            Spot::Lies { body, touch } => self.among[body as usize].speeds(&motions[body as usize], touch),
            Spot::Taut(k) => {
                self.linkage.strings[k as usize].meeting(self.stand(motions, t)).speeds(&twists_of(motions))
            }
        };
        across
    }

    fn still(&self, motions: &Vec<Motion>) -> f64 {
        Moving::still(self, motions)
    }

    fn gentle(&self) -> f64 {
        let reach = self.linkage.bodies.iter().map(|body| body.reach).fold(0.0, f64::max);
        gentle(reach, self.field.pushed()[1])
    }

    fn strike(&self, motions: &Vec<Motion>, t: f64, touching: &[Spot], how: (f64, bool), log: &mut Log) -> Vec<Motion> {
        let mut contacts = self.contacts((motions, t), touching);
        let twists = twists_of(motions);
        let is_elastic = contacts.iter().all(|contact| contact.rub.restitution >= 1.0);
        for contact in &mut contacts {
            let speed = contact.speeds(&twists)[0];
            contact.rub.restitution = gives_back(contact.rub.restitution, speed, how);
        }
        let joints = self.factored(motions, t);
        let together = Together::new(&joints, &contacts);
        let pressed = strike(&together.coupled, &together.seen(&twists), &together.rubs());
        log.hits += 1;
        log.work += Line::OF_A_CONTACT * u64::from(pressed.passes) * (contacts.len() * contacts.len()) as u64;
        log.work += contacts.len() as u64 * self.linkage.joints.work();
        book_strike(log.book.as_deref_mut(), pressed.taken, is_elastic);
        let after = together.moved(&twists, &pressed);
        if let Some(book) = log.book.as_deref_mut().filter(|_| !pressed.is_stopped && pressed.share == 1.0) {
            let [led, driven] = together.works((&twists, &after), &pressed.impulses);
            book.pins += led;
            book.drives += driven;
        }
        motions.iter().zip(after).map(|(motion, twist)| Motion { twist, ..*motion }).collect()
    }

    fn fly(&self, motions: &Vec<Motion>, span: (f64, f64), book: Option<&mut Book>) -> Vec<Motion> {
        Moving::fly(self, motions, span, book)
    }

    fn slide(
        &self,
        motions: &Vec<Motion>,
        span: (f64, f64),
        lying: &[Spot],
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> Vec<Motion> {
        Moving::slide(self, motions, span, lying, spent)
    }

    fn first_hit(
        &self,
        path: &dyn Fn(f64) -> Vec<Motion>,
        (start, end, h): (&Vec<Motion>, &Vec<Motion>, f64),
        (near, lying): (&Vec<Near>, &[Spot]),
        t: f64,
    ) -> Option<f64> {
        let mut first = self.first_taut(path, (start, end, h), lying, t);
        for (body, near) in near.iter().enumerate().filter(|(_, near)| !near.is_empty()) {
            let latest = first.unwrap_or(h);
            let until = if latest < h { path(latest) } else { end.clone() };
            let ends = (&start[body], &until[body], latest);
            first = self.among[body].first_hit(|time| path(time)[body], ends, (near, &of(body, lying))).or(first);
        }
        first
    }

    fn first_stop(
        &self,
        path: &dyn Fn(f64) -> Vec<Motion>,
        (start, end, h): (&Vec<Motion>, &Vec<Motion>, f64),
        lying: &[Spot],
    ) -> Option<f64> {
        let mut first = None;
        for body in 0..self.among.len() {
            let own = of(body, lying);
            if own.is_empty() {
                continue;
            }
            let latest = first.unwrap_or(h);
            let until = if latest < h { path(latest) } else { end.clone() };
            let ends = (&start[body], &until[body], latest);
            first = self.among[body].first_stop(|time| path(time)[body], ends, &own).or(first);
        }
        first
    }

    fn first_break(
        &self,
        path: &dyn Fn(f64) -> Vec<Motion>,
        (start, end, h): (&Vec<Motion>, &Vec<Motion>, f64),
        from: f64,
    ) -> Option<f64> {
        if !self.locates || !self.linkage.ties.may_break() {
            return None;
        }
        let spare = |motions: &[Motion], time: f64| -> Vec<f64> {
            self.linkage.ties.spare(self.stand(motions, from + time)).collect()
        };
        let [begun, ended] = [spare(start, 0.0), spare(end, h)];
        let mut first: Option<f64> = None;
        for k in (0..ended.len()).filter(|&k| ended[k] < 0.0) {
            let of = |time: f64| spare(&path(time), time)[k];
            let latest = first.unwrap_or(h);
            let last = if latest < h { of(latest) } else { ended[k] };
            if last >= 0.0 {
                continue;
            }
            // What is too long already breaks at once.
            let at = if begun[k] > 0.0 {
                narrowed(Root::between((0.0, begun[k]), (latest, last)), of, self.fits)
            } else {
                0.0
            };
            first = Some(at);
        }
        first
    }

    fn fault(&self, (start, end): (&Vec<Motion>, &Vec<Motion>), h: f64, is_free: bool) -> Option<Fault> {
        if self.take_failed() {
            return Some(Fault::Misses);
        }
        let strays = self.turning(end) * h > 2.0 * TURN_IN_FLIGHT
            || jerk(start, end, h) > MOST_JERK * self.shortest()
            || is_free && self.is_conserved() && self.makes_energy((start, end), h);
        strays.then_some(Fault::Strays)
    }

    fn rests(&self, (start, end): (&Vec<Motion>, &Vec<Motion>)) -> bool {
        let is_still = |motions: &[Motion]| {
            self.linkage.bodies.iter().zip(motions).all(|(body, motion)| body.is_still(&motion.twist))
        };
        self.is_conserved() && is_still(start) && is_still(end)
    }

    fn work(&self, near: Option<&Vec<Near>>) -> u64 {
        let bodies = &self.linkage.bodies;
        match near {
            None => self.take_spent(),
            Some(near) => bodies.iter().zip(near).map(|(body, near)| body.work_of_a_look(near)).sum(),
        }
    }
}
