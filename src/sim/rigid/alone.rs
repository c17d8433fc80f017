//! A rigid body that nothing joins to others, in a step, from one moment to the next (`course.rs`).

use std::cell::Cell;

use super::contact::{Alone, Contact};
use super::course::{Assembly, GENTLE, LEAST_BOUNCE, Log, SHORTEST, TURN, book_strike, gives_back};
use super::field::Field;
use super::inertia::Inertial;
use super::motion::{Axial, Motion, Twist};
use super::solid::{MotionOf, Solid};
use super::touch::{Among, Near, Touch};
use crate::sim::contact::coulomb::{Friction, strike};
use crate::sim::ledger::Book;
use crate::sim::real::Real;

/// Hits in a frame as [`Assembly::most_hits`] has them.
const MOST_HITS: [f64; 2] = [60.0, 400.0];

/// A body among what acts on it and what it may meet.
pub(super) struct Lone<'a, S: Real, const D: usize, B: Solid<N>, const N: usize> {
    body: &'a B,
    field: &'a Field<'a, S, D>,
    among: Among<'a, S, D, B, N>,
    /// What pushes it at most, and that but for the mouse `[m/s^2]`.
    pushed: [f64; 2],
    /// Operations of its flights.
    spent: Cell<u64>,
}

impl<'a, S: Real, const D: usize, B: Solid<N>, const N: usize> Lone<'a, S, D, B, N> {
    pub(super) fn new(body: &'a B, field: &'a Field<'a, S, D>, motion: &MotionOf<B, N>) -> Self {
        let among = Among::new(body, &field.pull.contacts.obstacles, motion);
        Lone { body, field, among, pushed: field.pushed(), spent: Cell::new(0) }
    }

    /// Operations of its flights.
    pub(super) fn spent(&self) -> u64 {
        self.spent.get()
    }
}

/// A speed below which hits of what is so large `[m]` give nothing back, pushed by so much `[m/s^2]`.
pub(super) fn gentle(reach: f64, pushed: f64) -> f64 {
    (GENTLE * pushed).min((LEAST_BOUNCE * reach * pushed).sqrt())
}

impl<S: Real, const D: usize, B: Solid<N>, const N: usize> Assembly for Lone<'_, S, D, B, N> {
    type Motion = MotionOf<B, N>;
    type Touch = Touch;
    type Near = Near;

    fn turned(&self, motion: &Self::Motion) -> [f64; 2] {
        let turned = (TURN / motion.twist.spin.size()).max(SHORTEST);
        [self.body.longest_turned(turned), turned]
    }

    fn near(&self, motion: &Self::Motion, (_, h): (f64, f64)) -> Option<Near> {
        let near = self.among.near(motion, motion.way(h, self.pushed[0]));
        (!near.is_empty() && !self.body.is_fixed()).then_some(near)
    }

    fn most_hits(&self) -> [f64; 2] {
        MOST_HITS
    }

    fn put_out(&self, motion: &Self::Motion, _t: f64, near: &Near) -> Option<Self::Motion> {
        self.among.put_out(motion, near)
    }

    fn stopped(&self, motion: Self::Motion) -> Self::Motion {
        Motion { twist: Twist::STILL, ..motion }
    }

    fn touching(&self, motion: &Self::Motion, _t: f64, near: &Near) -> Vec<Touch> {
        self.among.touching(motion, near)
    }

    fn speed(&self, motion: &Self::Motion, _t: f64, touch: Touch) -> f64 {
        self.among.speeds(motion, touch)[0]
    }

    fn still(&self, motion: &Self::Motion) -> f64 {
        self.body.still(&motion.twist)
    }

    fn gentle(&self) -> f64 {
        gentle(self.body.reach(), self.pushed[1])
    }

    fn strike(
        &self,
        motion: &Self::Motion,
        _t: f64,
        touching: &[Touch],
        how: (f64, bool),
        log: &mut Log,
    ) -> Self::Motion {
        let mut contacts: Vec<Contact<N>> = touching.iter().map(|&touch| self.among.contact(motion, touch)).collect();
        let is_elastic = contacts.iter().all(|contact| contact.rub.restitution >= 1.0);
        for contact in &mut contacts {
            contact.rub.restitution = gives_back(contact.rub.restitution, contact.speeds(&motion.twist)[0], how);
        }
        let alone = Alone { inertia: self.body.inertia(&motion.place), contacts: &contacts };
        let pressed = strike(&alone, &motion.twist, &alone.rubs());
        log.hits += 1;
        let of_a_contact = <B::Inertia<'_> as Inertial<N>>::Friction::OF_A_CONTACT;
        log.work += of_a_contact * u64::from(pressed.passes) * contacts.len() as u64;
        book_strike(log.book.as_deref_mut(), pressed.taken, is_elastic);
        Motion { twist: pressed.motion, ..*motion }
    }

    fn fly(&self, motion: &Self::Motion, span: (f64, f64), book: Option<&mut Book>) -> Self::Motion {
        self.body.fly(motion, self.field, span, (&self.spent, book))
    }

    fn slide(
        &self,
        motion: &Self::Motion,
        span: (f64, f64),
        lying: &[Touch],
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> Self::Motion {
        self.among.slide(motion, self.field, span, lying, spent)
    }

    fn first_hit(
        &self,
        path: &dyn Fn(f64) -> Self::Motion,
        ends: (&Self::Motion, &Self::Motion, f64),
        among: (&Near, &[Touch]),
        _t: f64,
    ) -> Option<f64> {
        self.among.first_hit(path, ends, among)
    }

    fn first_stop(
        &self,
        path: &dyn Fn(f64) -> Self::Motion,
        ends: (&Self::Motion, &Self::Motion, f64),
        lying: &[Touch],
    ) -> Option<f64> {
        self.among.first_stop(path, ends, lying)
    }

    fn rests(&self, (start, end): (&Self::Motion, &Self::Motion)) -> bool {
        !self.field.pushes() && [start, end].iter().all(|motion| self.body.is_still(&motion.twist))
    }

    fn work(&self, near: Option<&Near>) -> u64 {
        near.map_or_else(|| self.body.work_in_flight(self.field), |near| self.body.work_of_a_look(near))
    }
}
