//! From one moment to the next: flights, hits, and what lies on surfaces.

use std::cell::Cell;

use super::body::{Body, Field, Motion};
use super::strike::{Contact, OF_A_CONTACT, Twist};
use super::touch::{Among, Touch, way};
use crate::sim::bulk::control::FRAME;
use crate::sim::force::wind::OF_A_GUST;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::length;

/// Angle that a body near surfaces turns in a part of a step at most [rad].
const TURN: f64 = 0.05;
/// Longest part in which it lies on something or is pushed by the mouse, hangs on a pin, or is driven by forces and gusts, each so many of a
/// step at least; and the shortest that is asked for, however fast it spins [s].
const LYING: (f64, f64) = (1.0 / 960.0, 16.0);
const HANGING: (f64, f64) = (1.0 / 480.0, 8.0);
const DRIVEN: (f64, f64) = (1.0 / 240.0, 4.0);
const SHORTEST: f64 = 1.0 / 30_720.0;
/// Phase of the mouse force that a part spans [rad].
const PHASE: f64 = 0.25;
/// How long a bounce takes that is none any more [s]: slower hits give nothing back.
const GENTLE: f64 = 1e-4;
/// How high something is thrown that bounces, as a share of its size [1], at least.
const LEAST_BOUNCE: f64 = 2e-6;
/// Speed that counts as none, as a share of the body's own [1].
const STILL: f64 = 1e-11;
/// Hits in a frame after which nothing bounces that does not give all back, and after which none is located: what gets behind a surface is put out of it.
const MANY: f64 = 60.0;
const MOST: f64 = 400.0;

/// What a step counts and books.
pub(super) struct Log<'a> {
    pub(super) hits: u64,
    pub(super) work: u64,
    pub(super) book: Option<&'a mut Book>,
}

impl Body {
    /// The longest part of a step in flight [s].
    pub(super) fn longest<S: Real, const D: usize>(&self, field: &Field<S, D>, h: f64) -> f64 {
        let mut longest = f64::INFINITY;
        if let Some((_, centre)) = self.shape.pin {
            let torque = self.shape.mass * length(centre) * length(field.pull.gravity);
            longest = within(HANGING, h).min(TURN / (torque * self.inertia.inverse[1]).sqrt());
        }
        if field.pull.has_fields() {
            longest = longest.min(within(DRIVEN, h));
        }
        if field.is_reached {
            let strength = field.around.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs());
            longest = longest.min(within(LYING, h)).min(PHASE / strength.sqrt());
        }
        longest
    }

    /// On for `h` from `t` [s], in parts of at most `longest`.
    pub(super) fn advance<S: Real, const D: usize>(
        &self,
        mut motion: Motion,
        field: &Field<S, D>,
        (t, h, longest): (f64, f64, f64),
        log: &mut Log,
    ) -> Motion {
        let among = Among::new(self, &field.pull.contacts.obstacles, &motion);
        let pushed = length(field.pull.gravity) + field.pull.most_push();
        let most_pushed = pushed + if field.is_reached { field.around.most_push() } else { 0.0 };
        // What bounces no higher than a millionth of its size is at rest.
        let gentle = (GENTLE * pushed).min((LEAST_BOUNCE * self.reach * pushed).sqrt());
        let frames = (h / FRAME).ceil().max(1.0);
        let (mut done, mut hits, mut is_out) = (0.0, 0.0, false);
        while h - done > 1e-12 * h {
            let (now, left) = (t + done, h - done);
            let turned = (TURN / motion.twist.spin.abs()).max(SHORTEST);
            let mut part = left.min(longest.max(SHORTEST));
            if self.shape.pin.is_some() {
                part = part.min(turned);
            }
            let near = among.near(&motion, way(&motion, part, most_pushed));
            log.work += self.work(field);
            if near.is_empty() {
                motion = self.fly(&motion, field, (now, part), log.book.as_deref_mut());
                done += part;
                continue;
            }
            let locates = hits < MOST * frames;
            if !is_out || !locates {
                let Some(out) = among.put_out(&motion, &near) else {
                    // There is no room for it: it is held.
                    motion.twist = Twist { velocity: [0.0; 2], spin: 0.0 };
                    return motion;
                };
                motion = out;
                is_out = true;
            }
            part = part.min(turned).min(if locates { f64::INFINITY } else { LYING.0 });
            let touching = among.touching(&motion, &near);
            log.work += 20 * (self.hull.len() + self.slots.len() * usize::from(near.has_walls())) as u64;
            let contacts = among.contacts(&motion, &touching);
            if contacts.iter().any(|contact| contact.speeds(&motion.twist)[0] < -self.still(&motion.twist)) {
                hits += 1.0;
                motion.twist = self.strike(motion.twist, contacts.clone(), (gentle, hits > MANY * frames), log);
            }
            let most = gentle.max(self.still(&motion.twist));
            let lies = |contact: &Contact| contact.speeds(&motion.twist)[0] <= most;
            let lying: Vec<Touch> =
                touching.iter().zip(&contacts).filter(|(_, contact)| lies(contact)).map(|(touch, _)| *touch).collect();
            let spent = Cell::new(0);
            let go = |time: f64, book: Option<&mut Book>| {
                let ways = (now, time);
                if lying.is_empty() {
                    self.fly(&motion, field, ways, book)
                } else {
                    self.slide(&motion, field, ways, (&among, &lying), (&spent, book))
                }
            };
            part = if lying.is_empty() { part } else { part.min(within(LYING, h)) };
            let path = |time: f64| go(time, None);
            let end = path(part);
            let hit = among.first_hit(path, (&motion, &end, part), (&near, &lying)).filter(|_| locates);
            let until = hit.map_or((end, part), |time| (path(time), time));
            let stop = among.first_stop(path, (&motion, &until.0, until.1), &lying).filter(|_| locates);
            let first = stop.or(hit);
            let next = match (first, log.book.as_deref_mut()) {
                (None, None) => end,
                // Where a book is kept, that way is gone once more.
                (first, book) => go(first.unwrap_or(part), book),
            };
            motion = next;
            log.work += spent.get();
            done += first.unwrap_or(part);
            hits += if first.is_some() { 1.0 } else { 0.0 };
        }
        motion
    }

    /// An impact on what it touches. Hits that are slower than `gentle` [m/s] give nothing back, nor, when it `is_over`, those that are to
    /// give back some.
    fn strike(
        &self,
        before: Twist,
        mut contacts: Vec<Contact>,
        (gentle, is_over): (f64, bool),
        log: &mut Log,
    ) -> Twist {
        let is_elastic = contacts.iter().all(|contact| contact.restitution >= 1.0);
        for contact in &mut contacts {
            let is_slow = contact.speeds(&before)[0] > -gentle;
            if is_slow || (is_over && contact.restitution < 1.0) {
                contact.restitution = 0.0;
            }
        }
        let pressed = self.inertia.strike(before, &contacts);
        log.hits += 1;
        log.work += OF_A_CONTACT * u64::from(pressed.passes) * contacts.len() as u64;
        if let Some(book) = &mut log.book {
            let friction = pressed.taken[1].max(0.0);
            book.friction += friction;
            book.impacts += if is_elastic { 0.0 } else { (pressed.taken[0] + pressed.taken[1] - friction).max(0.0) };
        }
        pressed.twist
    }

    /// Operations of a part in flight, about.
    fn work<S: Real, const D: usize>(&self, field: &Field<S, D>) -> u64 {
        let of_gusts = if field.pull.gusts().is_some() { OF_A_GUST } else { 0 };
        let of_pushes = if field.pushes() { 30 } else { 0 };
        100 + 2 * (of_gusts + of_pushes) * self.slots.len() as u64
    }

    /// A speed that counts as none [m/s].
    pub(super) fn still(&self, twist: &Twist) -> f64 {
        STILL * (length(twist.velocity) + twist.spin.abs() * self.reach + 1e-3)
    }
}

/// The longest part of a step of `h` [s], of so many at least.
fn within((longest, count): (f64, f64), h: f64) -> f64 {
    longest.min(h / count)
}
