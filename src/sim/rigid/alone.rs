//! A rigid body that nothing joins to others, in a step.

use std::cell::Cell;

use super::body::{Body, Field};
use super::course::{
    Assembly, DRIVEN, GENTLE, HANGING, LEAST_BOUNCE, LYING, Log, PHASE, SHORTEST, STILL, TURN, book_strike, gives_back,
    within,
};
use super::inertia::{Alone, Contact};
use super::motion::Motion;
use super::motion::Twist;
use super::touch::{Among, Near, Touch, way};
use crate::sim::contact::coulomb::{OF_A_CONTACT, strike};
use crate::sim::force::wind::OF_A_GUST;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::length;

/// Hits in a frame as [`Assembly::most_hits`] has them.
pub(super) const MOST_HITS: [f64; 2] = [60.0, 400.0];

/// A body among what acts on it and what it may meet.
pub(super) struct Lone<'a, S: Real, const D: usize> {
    body: &'a Body,
    field: &'a Field<'a, S, D>,
    among: Among<'a, S, D>,
    /// What pushes it at most, and that but for the mouse `[m/s^2]`.
    pushed: [f64; 2],
}

impl<'a, S: Real, const D: usize> Lone<'a, S, D> {
    pub(super) fn new(body: &'a Body, field: &'a Field<'a, S, D>, motion: &Motion) -> Self {
        let among = Among::new(body, &field.pull.contacts.obstacles, motion);
        Lone { body, field, among, pushed: field.pushed() }
    }
}

impl<S: Real, const D: usize> Field<'_, S, D> {
    /// What pushes at most, and that but for the mouse `[m/s^2]`.
    pub(super) fn pushed(&self) -> [f64; 2] {
        let pushed = length(self.pull.gravity) + self.pull.most_push();
        [pushed + if self.is_reached { self.around.most_push() } else { 0.0 }, pushed]
    }

    /// The longest part of a step of `h` `[s]` that pushes allow.
    pub(super) fn longest(&self, h: f64) -> f64 {
        let mut longest = f64::INFINITY;
        if self.pull.has_fields() {
            longest = longest.min(within(DRIVEN, h));
        }
        if self.is_reached {
            let strength = self.around.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs());
            longest = longest.min(within(LYING, h)).min(PHASE / strength.sqrt());
        }
        longest
    }
}

/// A speed below which hits of what is so large `[m]` give nothing back, pushed by so much `[m/s^2]`.
pub(super) fn gentle(reach: f64, pushed: f64) -> f64 {
    (GENTLE * pushed).min((LEAST_BOUNCE * reach * pushed).sqrt())
}

impl Body {
    /// The longest part of a step in flight `[s]`.
    pub(super) fn longest<S: Real, const D: usize>(&self, field: &Field<S, D>, h: f64) -> f64 {
        let longest = field.longest(h);
        let Some((_, centre)) = self.shape.pin else { return longest };
        let torque = self.shape.mass * length(centre) * length(field.pull.gravity);
        longest.min(within(HANGING, h)).min(TURN / (torque * self.inertia.inverse[1]).sqrt())
    }

    /// A speed that counts as none `[m/s]`.
    pub(super) fn still(&self, twist: &Twist) -> f64 {
        STILL * (length(twist.velocity) + twist.spin.abs() * self.reach + 1e-3)
    }

    /// Whether it has no speed that counts.
    pub(super) fn is_still(&self, twist: &Twist) -> bool {
        length(twist.velocity) + twist.spin.abs() * self.reach <= self.still(twist)
    }

    /// Operations of a part in flight, about.
    pub(super) fn work_in_flight<S: Real, const D: usize>(&self, field: &Field<S, D>) -> u64 {
        let of_gusts = if field.pull.gusts().is_some() { OF_A_GUST } else { 0 };
        let of_pushes = if field.pushes() { 30 } else { 0 };
        100 + 2 * (of_gusts + of_pushes) * self.slots.len() as u64
    }

    /// Operations of a look at what it touches, about.
    pub(super) fn work_of_a_look(&self, near: &Near) -> u64 {
        20 * (self.hull.len() + self.slots.len() * usize::from(near.has_walls())) as u64
    }
}

impl<S: Real, const D: usize> Assembly for Lone<'_, S, D> {
    type Motion = Motion;
    type Touch = Touch;
    type Near = Near;

    fn turned(&self, motion: &Motion) -> [f64; 2] {
        let turned = (TURN / motion.twist.spin.abs()).max(SHORTEST);
        [if self.body.shape.pin.is_some() { turned } else { f64::INFINITY }, turned]
    }

    fn near(&self, motion: &Motion, (_, h): (f64, f64)) -> Option<Near> {
        let near = self.among.near(motion, way(motion, h, self.pushed[0]));
        (!near.is_empty()).then_some(near)
    }

    fn most_hits(&self) -> [f64; 2] {
        MOST_HITS
    }

    fn put_out(&self, motion: &Motion, _t: f64, near: &Near) -> Option<Motion> {
        self.among.put_out(motion, near)
    }

    fn stopped(&self, motion: Motion) -> Motion {
        Motion { twist: Twist::STILL, ..motion }
    }

    fn touching(&self, motion: &Motion, _t: f64, near: &Near) -> Vec<Touch> {
        self.among.touching(motion, near)
    }

    fn speeds(&self, motion: &Motion, _t: f64, touch: Touch) -> [f64; 2] {
        self.among.speeds(motion, touch)
    }

    fn still(&self, motion: &Motion) -> f64 {
        self.body.still(&motion.twist)
    }

    fn gentle(&self) -> f64 {
        gentle(self.body.reach, self.pushed[1])
    }

    fn strike(&self, motion: &Motion, _t: f64, touching: &[Touch], how: (f64, bool), log: &mut Log) -> Motion {
        let mut contacts: Vec<Contact> = touching.iter().map(|&touch| self.among.contact(motion, touch)).collect();
        let is_elastic = contacts.iter().all(|contact| contact.rub.restitution >= 1.0);
        for contact in &mut contacts {
            contact.rub.restitution = gives_back(contact.rub.restitution, contact.speeds(&motion.twist)[0], how);
        }
        let body = Alone(&self.body.inertia, &contacts);
        let pressed = strike(&body, &motion.twist, &body.rubs());
        log.hits += 1;
        log.work += OF_A_CONTACT * u64::from(pressed.passes) * contacts.len() as u64;
        book_strike(log.book.as_deref_mut(), pressed.taken, is_elastic);
        Motion { twist: pressed.motion, ..*motion }
    }

    fn fly(&self, motion: &Motion, span: (f64, f64), book: Option<&mut Book>) -> Motion {
        self.body.fly(motion, self.field, span, book)
    }

    fn slide(
        &self,
        motion: &Motion,
        span: (f64, f64),
        lying: &[Touch],
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> Motion {
        self.body.slide(motion, self.field, span, (&self.among, lying), spent)
    }

    fn first_hit(
        &self,
        path: &dyn Fn(f64) -> Motion,
        ends: (&Motion, &Motion, f64),
        among: (&Near, &[Touch]),
        _t: f64,
    ) -> Option<f64> {
        self.among.first_hit(path, ends, among)
    }

    fn first_stop(&self, path: &dyn Fn(f64) -> Motion, ends: (&Motion, &Motion, f64), lying: &[Touch]) -> Option<f64> {
        self.among.first_stop(path, ends, lying)
    }

    fn rests(&self, (start, end): (&Motion, &Motion)) -> bool {
        !self.field.pushes() && [start, end].iter().all(|motion| self.body.is_still(&motion.twist))
    }

    fn work(&self, near: Option<&Near>) -> u64 {
        near.map_or_else(|| self.body.work_in_flight(self.field), |near| self.body.work_of_a_look(near))
    }
}
