//! What lies on surfaces slides, rolls, tips or stays.
//!
//! RATTLE in two halves: impulses in the first lead to where nothing overlaps, those in the second leave no velocity into a surface. Each half
//! keeps Coulomb's law by itself.

use std::cell::Cell;

use super::body::{Body, Field, Motion};
use super::strike::{Contact, OF_A_CONTACT};
use super::touch::{Among, Touch};
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::{dot, flat, scale, sub, widen};

/// Parts of a step that are shorter mend no gaps [s]: over so short a time that would be speed.
const BRIEF: f64 = 1e-6;
/// Rounds in which the first half of a part finds the impulses that lead to where nothing overlaps.
const ROUNDS: u32 = 4;

impl Body {
    /// On for `h` from `t` [s] with points that lie on surfaces. What that takes is counted as spent.
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
        let slides = |contact: &Contact| {
            let [_, along] = contact.speeds(&motion.twist);
            if along.abs() > still { along.signum() } else { 0.0 }
        };
        let mut first = among.contacts(motion, lying);
        first.iter_mut().for_each(|contact| contact.slides = slides(contact));
        let ways: Vec<f64> = first.iter().map(|contact| contact.slides).collect();
        let pushed = self.fly(motion, field, (t, 0.5 * h), book.as_deref_mut()).twist;
        let from: Vec<[f64; 2]> =
            lying.iter().map(|touch| motion.place.out(self.shape.places[touch.point as usize])).collect();
        let mut pressed = self.inertia.press_or_stop(pushed, &first, &[]);
        let (mut place, mut passes) = (motion.place, 0);
        for _ in 0..ROUNDS {
            place = motion.place.moved(scale(pressed.twist.velocity, h), pressed.twist.spin * h);
            // Ways are bent: what is left of the gaps is asked for by the targets.
            let mut largest: f64 = 0.0;
            for (((contact, touch), from), impulse) in first.iter_mut().zip(lying).zip(&from).zip(&pressed.impulses) {
                let x = place.out(self.shape.places[touch.point as usize]);
                let surface = &among.obstacles.surfaces[touch.surface];
                let off = [surface.gap_of(x), dot(sub(x, *from), contact.tangent())];
                let gap = if impulse[0] > 0.0 { off[0].abs() } else { -off[0] };
                largest = largest.max(gap);
                contact.target[0] -= if gap > 0.5 * among.touch { off[0] / h } else { 0.0 };
                contact.target[1] -= if contact.slides == 0.0 { off[1] / h } else { 0.0 };
            }
            passes += pressed.passes;
            if largest <= 0.5 * among.touch || !pressed.has_converged || h < BRIEF {
                break;
            }
            pressed = self.inertia.press_or_stop(pushed, &first, &pressed.impulses);
        }
        let half = Motion { place, twist: pressed.twist };
        let arrived = self.fly(&half, field, (t + 0.5 * h, 0.5 * h), book.as_deref_mut()).twist;
        let mut second = among.contacts(&half, lying);
        second.iter_mut().zip(ways).for_each(|(contact, way)| contact.slides = way);
        let last = self.inertia.press_or_stop(arrived, &second, &pressed.impulses);
        spent.set(spent.get() + OF_A_CONTACT * u64::from(passes + last.passes) * lying.len() as u64);
        if let Some(book) = book {
            let rubbed = |k: usize| {
                let x = place.out(self.shape.places[lying[k].point as usize]);
                let along = dot(sub(x, from[k]), second[k].tangent()) / h;
                -along * (pressed.impulses[k][1] + last.impulses[k][1])
            };
            book.friction += (0..lying.len()).map(rubbed).sum::<f64>().max(0.0);
        }
        Motion { place, twist: last.twist }
    }
}

impl<S: Real, const D: usize> Among<'_, S, D> {
    /// What surfaces are at these points, as a motion begins.
    pub(super) fn contacts(&self, motion: &Motion, touches: &[Touch]) -> Vec<Contact> {
        let of = |touch: &Touch| {
            let surface = &self.obstacles.surfaces[touch.surface];
            Contact {
                arm: motion.place.turned(self.body.shape.places[touch.point as usize]),
                normal: flat(widen(surface.normal)),
                friction: surface.friction.to_f64(),
                restitution: surface.restitution.to_f64(),
                slides: 0.0,
                target: [0.0; 2],
            }
        };
        touches.iter().map(of).collect()
    }
}
