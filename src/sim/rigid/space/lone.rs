//! A rigid body in space in a step, from one moment to the next (`course.rs`).

use std::cell::Cell;

use super::body::Body;
use super::law::{Alone, Contact};
use super::motion::{Motion, Twist};
use super::touch::{Among, Near};
use crate::sim::contact::coulomb::disc::{OF_A_CONTACT, strike};
use crate::sim::force::wind::OF_A_GUST;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::rigid::alone::{MOST_HITS, gentle};
use crate::sim::rigid::body::Field;
use crate::sim::rigid::course::{Assembly, Log, SHORTEST, TURN, book_strike, gives_back};
use crate::sim::rigid::touch::Touch;
use crate::sim::vector::{dot, length};

/// A body among what acts on it and what it may meet.
pub(super) struct Lone<'a, S: Real, const D: usize> {
    body: &'a Body,
    field: &'a Field<'a, S, D>,
    among: Among<'a, S, D>,
    /// What pushes it at most, and that but for the mouse `[m/s^2]`.
    pushed: [f64; 2],
    /// Operations of its flights since somebody asked.
    spent: Cell<u64>,
}

impl<'a, S: Real, const D: usize> Lone<'a, S, D> {
    pub(super) fn new(body: &'a Body, field: &'a Field<'a, S, D>, motion: &Motion) -> Self {
        let among = Among::new(body, &field.pull.contacts.obstacles, motion);
        Lone { body, field, among, pushed: field.pushed(), spent: Cell::new(0) }
    }

    /// Operations of its flights.
    pub(super) fn spent(&self) -> u64 {
        self.spent.get()
    }
}

/// Twice as far as it may get in `h` `[s]` with its speed `[m/s]` and what pushes it `[m/s^2]`.
pub(super) fn way(motion: &Motion, h: f64, pushed: f64) -> f64 {
    2.0 * (length(motion.twist.velocity) * h + pushed * h * h)
}

impl<S: Real, const D: usize> Assembly for Lone<'_, S, D> {
    type Motion = Motion;
    type Touch = Touch;
    type Near = Near;

    fn turned(&self, motion: &Motion) -> [f64; 2] {
        [f64::INFINITY, (TURN / length(motion.twist.spin)).max(SHORTEST)]
    }

    fn near(&self, motion: &Motion, (_, h): (f64, f64)) -> Option<Near> {
        let near = self.among.near(motion, way(motion, h, self.pushed[0]));
        (!near.is_empty() && !self.body.is_fixed()).then_some(near)
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
        let [across, along @ ..] = self.among.contact(motion, touch).speeds(&motion.twist);
        [across, dot(along, along).sqrt()]
    }

    fn still(&self, motion: &Motion) -> f64 {
        self.body.still(&motion.twist)
    }

    fn gentle(&self) -> f64 {
        gentle(self.body.reach, self.pushed[1])
    }

    fn strike(&self, motion: &Motion, _t: f64, touching: &[Touch], how: (f64, bool), log: &mut Log) -> Motion {
        let mut contacts: Vec<Contact> = touching.iter().map(|&touch| self.among.contact(motion, touch)).collect();
        let is_elastic = contacts.iter().all(|contact| contact.grip.restitution >= 1.0);
        for contact in &mut contacts {
            let [across, ..] = contact.speeds(&motion.twist);
            contact.grip.restitution = gives_back(contact.grip.restitution, across, how);
        }
        let alone = Alone { body: self.body, place: &motion.place, contacts: &contacts };
        let pressed = strike(&alone, &motion.twist, &alone.grips());
        log.hits += 1;
        log.work += OF_A_CONTACT * u64::from(pressed.passes) * contacts.len() as u64;
        book_strike(log.book.as_deref_mut(), pressed.taken, is_elastic);
        Motion { twist: pressed.motion, ..*motion }
    }

    fn fly(&self, motion: &Motion, span: (f64, f64), book: Option<&mut Book>) -> Motion {
        self.body.fly(motion, self.field, span, (&self.spent, book))
    }

    fn slide(
        &self,
        motion: &Motion,
        span: (f64, f64),
        lying: &[Touch],
        (_, book): (&Cell<u64>, Option<&mut Book>),
    ) -> Motion {
        self.body.slide(motion, self.field, span, (&self.among, lying), (&self.spent, book))
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
        let count = self.body.slots.len() as u64;
        let of_gusts = if self.field.pull.gusts().is_some() { OF_A_GUST } else { 0 };
        let of_pushes = if self.field.pushes() { 40 } else { 0 };
        near.map_or_else(|| 100 + 2 * (of_gusts + of_pushes) * count, |near| 12 * count * near.len() as u64)
    }
}
