//! What lies on surfaces slides, rolls, tips or stays.
//!
//! RATTLE in two halves: impulses in the first lead to where nothing overlaps, those in the second leave no velocity into a surface. Each half
//! keeps Coulomb's law by itself.

use std::cell::Cell;

use super::body::{Body, Field};
use super::inertia::{Alone, Contact};
use super::motion::Motion;
use super::touch::{Among, Touch};
use crate::sim::contact::coulomb::{Impulse, OF_A_CONTACT, press_or_stop};
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// Parts of a step that are shorter mend no gaps `[s]`: over so short a time that would be speed.
pub(super) const BRIEF: f64 = 1e-6;
/// Rounds in which the first half of a part finds the impulses that lead to where nothing overlaps.
const ROUNDS: u32 = 4;

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
        let slides = |contact: &Contact| {
            let [_, along] = contact.speeds(&motion.twist);
            if along.abs() > still { along.signum() } else { 0.0 }
        };
        let mut first = contacts(motion);
        first.iter_mut().for_each(|contact| contact.rub.slides = slides(contact));
        let ways: Vec<f64> = first.iter().map(|contact| contact.rub.slides).collect();
        let pushed = self.fly(motion, field, (t, 0.5 * h), book.as_deref_mut()).twist;
        let from: Vec<[f64; 2]> =
            lying.iter().map(|touch| motion.place.out(self.shape.places[touch.point as usize])).collect();
        let press = |contacts: &[Contact], from, guess: &[Impulse]| {
            let body = Alone(&self.inertia, contacts);
            press_or_stop(&body, &from, &body.rubs(), guess)
        };
        let mut pressed = press(&first, pushed, &[]);
        let (mut place, mut passes) = (motion.place, 0);
        for _ in 0..ROUNDS {
            place = motion.place.moved(scale(pressed.motion.velocity, h), pressed.motion.spin * h);
            // Ways are bent: what is left of the gaps is asked for by the targets.
            let mut largest: f64 = 0.0;
            for (((contact, touch), from), impulse) in first.iter_mut().zip(lying).zip(&from).zip(&pressed.impulses) {
                let x = place.out(self.shape.places[touch.point as usize]);
                let surface = &among.obstacles.surfaces[touch.surface];
                let off = [surface.gap_of(x), dot(sub(x, *from), contact.tangent())];
                let gap = if impulse[0] > 0.0 { off[0].abs() } else { -off[0] };
                largest = largest.max(gap);
                contact.rub.target[0] -= if gap > 0.5 * among.touch { off[0] / h } else { 0.0 };
                contact.rub.target[1] -= if contact.rub.slides == 0.0 { off[1] / h } else { 0.0 };
            }
            passes += pressed.passes;
            if largest <= 0.5 * among.touch || !pressed.has_converged || h < BRIEF {
                break;
            }
            pressed = press(&first, pushed, &pressed.impulses);
        }
        let half = Motion { place, twist: pressed.motion };
        let arrived = self.fly(&half, field, (t + 0.5 * h, 0.5 * h), book.as_deref_mut()).twist;
        let mut second = contacts(&half);
        second.iter_mut().zip(ways).for_each(|(contact, way)| contact.rub.slides = way);
        let last = press(&second, arrived, &pressed.impulses);
        spent.set(spent.get() + OF_A_CONTACT * u64::from(passes + last.passes) * lying.len() as u64);
        if let Some(book) = book {
            let rubbed = |k: usize| {
                let x = place.out(self.shape.places[lying[k].point as usize]);
                let along = dot(sub(x, from[k]), second[k].tangent()) / h;
                -along * (pressed.impulses[k][1] + last.impulses[k][1])
            };
            book.friction += (0..lying.len()).map(rubbed).sum::<f64>().max(0.0);
        }
        Motion { place, twist: last.motion }
    }
}
