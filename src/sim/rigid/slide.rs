//! What lies on surfaces slides, rolls, tips or stays.
//!
//! RATTLE in two halves about a flight of its own motion: impulses before it lead to where nothing overlaps, those after it leave no velocity
//! into a surface. Each half keeps Coulomb's law by itself.

use std::cell::Cell;

use super::contact::{Alone, Contact};
use super::field::Field;
use super::inertia::Inertial;
use super::motion::Motion;
use super::solid::{MotionOf, Solid};
use super::touch::{Among, Touch};
use crate::sim::contact::coulomb::{Friction, press_or_stop};
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::{dot, sub};

/// Parts of a step that are shorter mend no gaps `[s]`: over so short a time that would be speed.
pub(super) const BRIEF: f64 = 1e-6;
/// Rounds in which the first half of a part finds the impulses that lead to where nothing overlaps.
const ROUNDS: u32 = 5;

impl<S: Real, const D: usize, B: Solid<N>, const N: usize> Among<'_, S, D, B, N> {
    /// On for `h` from `t` `[s]` with points that lie on surfaces. What that takes is counted as spent.
    pub(super) fn slide(
        &self,
        motion: &MotionOf<B, N>,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        lying: &[Touch],
        (spent, mut book): (&Cell<u64>, Option<&mut Book>),
    ) -> MotionOf<B, N> {
        if h == 0.0 {
            return *motion;
        }
        let body = self.body;
        let still = body.still(&motion.twist);
        let contacts = |motion: &MotionOf<B, N>| -> Vec<Contact<N>> {
            lying.iter().map(|&touch| self.contact(motion, touch)).collect()
        };
        let mut first = contacts(motion);
        first.iter_mut().for_each(|contact| contact.rub.slides = contact.direction(&motion.twist, still));
        let pushed = body.kicked(motion, field, (t, 0.5 * h), (spent, book.as_deref_mut()));
        let from: Vec<[f64; N]> = lying.iter().map(|touch| self.at(motion, touch.point)).collect();
        let press = |place, contacts: &[Contact<N>], from, guess: &[[f64; N]]| {
            let alone = Alone { inertia: body.inertia(place), contacts };
            press_or_stop(&alone, &from, &alone.rubs(), guess)
        };
        let mut pressed = press(&motion.place, &first, pushed, &[]);
        let (mut half, mut passes) = (*motion, 0);
        for _ in 0..ROUNDS {
            half = body.coast(&Motion { twist: pressed.motion, ..*motion }, h, spent);
            // Ways are bent: what is left of the gaps is asked for by the targets.
            let mut largest: f64 = 0.0;
            for (((contact, touch), from), impulse) in first.iter_mut().zip(lying).zip(&from).zip(&pressed.impulses) {
                let along = contact.seen(sub(self.at(&half, touch.point), *from));
                let off = self.gap(&half, *touch);
                let gap = if impulse[0] > 0.0 { off.abs() } else { -off };
                largest = largest.max(gap);
                let is_held = !contact.rub.is_sliding();
                let target = &mut contact.rub.target;
                target[0] -= if gap > 0.5 * self.touch { off / h } else { 0.0 };
                (1..N).filter(|_| is_held).for_each(|k| target[k] -= along[k] / h);
            }
            passes += pressed.passes;
            if largest <= 0.5 * self.touch || !pressed.has_converged || h < BRIEF {
                break;
            }
            pressed = press(&motion.place, &first, pushed, &pressed.impulses);
        }
        let arrived = body.kicked(&half, field, (t + 0.5 * h, 0.5 * h), (spent, book.as_deref_mut()));
        let mut second = contacts(&half);
        for (contact, before) in second.iter_mut().zip(&first) {
            let (now, before) = (contact.direction(&arrived, still), before.rub.slides);
            // What would turn back is rubbed against the way that it came.
            contact.rub.slides = if dot(now, before) > 0.0 { now } else { before };
        }
        let last = press(&half.place, &second, arrived, &pressed.impulses);
        let of_a_contact = <B::Inertia<'_> as Inertial<N>>::Friction::OF_A_CONTACT;
        spent.set(spent.get() + of_a_contact * u64::from(passes + last.passes) * lying.len() as u64);
        if let Some(book) = book {
            let rubbed = |k: usize| {
                let way = second[k].seen(sub(self.at(&half, lying[k].point), from[k]));
                (1..N).map(|axis| -way[axis] / h * (pressed.impulses[k][axis] + last.impulses[k][axis])).sum::<f64>()
            };
            book.friction += (0..lying.len()).map(rubbed).sum::<f64>().max(0.0);
        }
        Motion { place: half.place, twist: last.motion }
    }
}
