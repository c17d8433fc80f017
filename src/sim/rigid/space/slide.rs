//! What lies on planes in space slides, rolls, tips or stays.
//!
//! RATTLE in two halves about a flight of its own motion: impulses before it lead to where nothing overlaps, those after it leave no velocity
//! into a surface. Each half keeps Coulomb's law by itself.

use std::cell::Cell;

use super::body::Body;
use super::law::{Alone, Contact};
use super::motion::{Motion, Twist};
use super::touch::Among;
use crate::sim::contact::coulomb::disc::{OF_A_CONTACT, Trio, press_or_stop};
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::rigid::body::Field;
use crate::sim::rigid::slide::BRIEF;
use crate::sim::rigid::touch::Touch;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Rounds in which the first half of a part finds the impulses that lead to where nothing overlaps.
const ROUNDS: u32 = 5;

impl Body {
    /// On for `h` from `t` `[s]` with points that lie on surfaces. What that takes is counted as spent.
    pub(super) fn slide<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        (among, lying): (&Among<S, D>, &[Touch]),
        (spent, mut book): (&Cell<u64>, Option<&mut Book>),
    ) -> Motion {
        if h == 0.0 {
            return *motion;
        }
        let still = self.still(&motion.twist);
        let contacts =
            |motion: &Motion| -> Vec<Contact> { lying.iter().map(|&touch| among.contact(motion, touch)).collect() };
        let mut first = contacts(motion);
        first.iter_mut().for_each(|contact| contact.grip.slides = direction(contact, &motion.twist, still));
        let pushed = self.kicked(motion, field, (t, 0.5 * h), book.as_deref_mut());
        let from: Vec<[f64; 3]> = lying.iter().map(|touch| among.at(motion, touch.point)).collect();
        let press = |place, contacts: &[Contact], from: &Twist, guess: &[Trio]| {
            let alone = Alone { body: self, place, contacts };
            press_or_stop(&alone, from, &alone.grips(), guess)
        };
        let mut pressed = press(&motion.place, &first, &pushed, &[]);
        let (mut half, mut passes) = (*motion, 0);
        for _ in 0..ROUNDS {
            half = self.coast(&Motion { twist: pressed.motion, ..*motion }, h, spent);
            // Ways are bent: what is left of the gaps is asked for by the targets.
            let mut largest: f64 = 0.0;
            for (((contact, touch), from), impulse) in first.iter_mut().zip(lying).zip(&from).zip(&pressed.impulses) {
                let x = among.at(&half, touch.point);
                let [_, along @ ..] = contact.seen(sub(x, *from));
                let off = among.gap(&half, *touch);
                let gap = if impulse[0] > 0.0 { off.abs() } else { -off };
                largest = largest.max(gap);
                let target = &mut contact.grip.target;
                target[0] -= if gap > 0.5 * among.touch { off / h } else { 0.0 };
                if contact.grip.slides.is_none() {
                    (target[1], target[2]) = (target[1] - along[0] / h, target[2] - along[1] / h);
                }
            }
            passes += pressed.passes;
            if largest <= 0.5 * among.touch || !pressed.has_converged || h < BRIEF {
                break;
            }
            pressed = press(&motion.place, &first, &pushed, &pressed.impulses);
        }
        let arrived = self.kicked(&half, field, (t + 0.5 * h, 0.5 * h), book.as_deref_mut());
        let mut second = contacts(&half);
        for (contact, before) in second.iter_mut().zip(&first) {
            let now = before.grip.slides.and_then(|_| direction(contact, &arrived, still));
            // What would turn back is rubbed against the way that it came.
            let is_on = |[x, y]: &[f64; 2]| before.grip.slides.is_some_and(|[u, v]| u * x + v * y > 0.0);
            contact.grip.slides = now.filter(is_on).or(before.grip.slides);
        }
        let last = press(&half.place, &second, &arrived, &pressed.impulses);
        spent.set(spent.get() + OF_A_CONTACT * u64::from(passes + last.passes) * lying.len() as u64);
        if let Some(book) = book {
            let rubbed = |k: usize| {
                let [_, x, y] = second[k].seen(scale(sub(among.at(&half, lying[k].point), from[k]), 1.0 / h));
                let [_, u, v] = add(pressed.impulses[k], last.impulses[k]);
                -(x * u + y * v)
            };
            book.friction += (0..lying.len()).map(rubbed).sum::<f64>().max(0.0);
        }
        Motion { place: half.place, twist: last.motion }
    }

    /// A speed that counts as none `[m/s]`.
    pub(super) fn still(&self, twist: &Twist) -> f64 {
        crate::sim::rigid::course::STILL * (self.fastest(twist) + 1e-3)
    }

    /// Whether it has no speed that counts.
    pub(super) fn is_still(&self, twist: &Twist) -> bool {
        self.fastest(twist) <= self.still(twist)
    }

    /// A bound on the speed of its points `[m/s]`.
    fn fastest(&self, twist: &Twist) -> f64 {
        length(twist.velocity) + length(twist.spin) * self.reach
    }
}

/// Which way a contact slides along its tangents, if it does.
fn direction(contact: &Contact, twist: &Twist, still: f64) -> Option<[f64; 2]> {
    let [_, along @ ..] = contact.speeds(twist);
    let speed = dot(along, along).sqrt();
    (speed > still).then(|| scale(along, 1.0 / speed))
}
