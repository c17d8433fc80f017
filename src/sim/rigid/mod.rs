//! Rigid bodies: what rigid bonds hold in its shape has three degrees of freedom in the plane, whatever it is made of.
//!
//! ```text
//! read       place, angle, velocity and spin from the points: best fit, momentum and angular momentum
//! part       of the step: all of it in flight, shorter near surfaces, under the mouse, on a pin
//! flight     in closed form, or a composition of order 4 (`body.rs`)
//! hit        the moment when a point gets to a surface is located (`touch.rs`); the impact is Coulomb's law (`strike.rs`)
//! rest       what lies on surfaces slides, rolls, tips or stays: RATTLE's two halves, each with Coulomb's law; where sliding ends is located
//! write      points follow, once a step
//! ```
//!
//! Nothing is kept between steps but the points themselves: any copy goes on with the same bits.

mod body;
pub(crate) mod place;
pub(crate) mod shape;
mod strike;
mod touch;

use std::cell::Cell;
use std::sync::Arc;

use super::account::Account;
use super::bulk::control::FRAME;
use super::bulk::kernel::Kernel;
use super::bulk::mover::Mover;
use super::counters::Counters;
use super::environment::Environment;
use super::force::wind::OF_A_GUST;
use super::ledger::Book;
use super::points::Points;
use super::pull::Pull;
use super::real::Real;
use super::swept::Swept;
use super::vector::{add, dot, flat, length, scale, sub, widen};
use body::{Body, Field, Motion, lift};
use shape::Shape;
use strike::{Contact, Twist};
use touch::{Among, Touch, way};

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
/// Parts of a step that are shorter mend no gaps [s]: over so short a time that would be speed.
const BRIEF: f64 = 1e-6;
/// Speed that counts as none, as a share of the body's own [1].
const STILL: f64 = 1e-11;
/// Hits in a frame after which nothing bounces that does not give all back, and after which none is located: what gets behind a surface is put out of it.
const MANY: f64 = 60.0;
const MOST: f64 = 400.0;
/// Rounds in which the first half of a part finds the impulses that lead to where nothing overlaps.
const ROUNDS: u32 = 4;
/// Operations of a contact that is gone through once, about.
const OF_A_CONTACT: u64 = 40;

/// Rigid bodies that step together.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    bodies: Arc<[Body]>,
    /// Rigid bonds that they are made of.
    bonds: usize,
    /// Points of those that left the finite numbers: they are where their step began.
    lost: Vec<u32>,
}

/// What a step counts and books.
struct Log<'a> {
    hits: u64,
    work: u64,
    book: Option<&'a mut Book>,
}

impl Rigid {
    /// Of shapes, each with its points in the group, made of so many bonds.
    pub(crate) fn new(shapes: Vec<(Shape, Vec<u32>)>, bonds: usize) -> Self {
        Rigid {
            bodies: shapes.into_iter().map(|(shape, slots)| Body::new(shape, slots)).collect(),
            bonds,
            lost: Vec::new(),
        }
    }
}

impl<S: Real, const D: usize> Mover<S, D> for Rigid {
    /// Points that are elsewhere get the places that the shape has for them.
    fn begin(&mut self, points: &mut Points<S, D>) {
        for body in self.bodies.iter() {
            let motion = body.read(points);
            if !body.fits(&motion, points) {
                body.write(&motion, points);
            }
        }
    }

    fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        account: Option<&mut Account>,
    ) {
        let mut book = account.map(|account| &mut account.book);
        for body in self.bodies.iter() {
            let motion = body.read(points);
            let far = body.reach + way(&motion, h, length(pull.gravity) + pull.most_push() + around.most_push());
            let middle = motion.place.middle;
            let bounds = [-far, far].map(|far| lift::<S, D>([middle[0] + far, middle[1] + far]));
            let field = Field { pull, around, w: &points.inverse_mass, is_reached: around.may_reach(bounds, (t, h)) };
            let moving = || {
                let each = body.slots.iter().map(|&slot| slot as usize);
                each.map(|i| (points.position[i], points.velocity[i]))
            };
            let parts = if field.is_reached { around.parts_near(moving(), (t, h)) } else { 1 };
            let mut log = Log { hits: 0, work: 0, book: book.as_deref_mut() };
            let longest = body.longest(&field, h).min(h / f64::from(parts));
            let end = body.advance(motion, &field, (t, h, longest), &mut log);
            let is_reached = field.is_reached;
            if end.is_finite() {
                body.write(&end, points);
            } else {
                self.lost.extend(&body.slots);
            }
            let count = body.slots.len() as u64;
            counters.substeps += 1;
            counters.points_moved += count;
            counters.mouse_points += if is_reached { count } else { 0 };
            counters.events += log.hits;
            counters.work += 60 * count + log.work;
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    /// A body that spins leaves the straight ways of its points: it stays in a circle around its middle.
    fn reaches(&self, points: &Points<S, D>, (h, pushed): (f64, f64)) -> Vec<Swept<S, D>> {
        let swept = |body: &Body| {
            let Motion { place, twist } = body.read(points);
            let bent = pushed + twist.spin * twist.spin * body.reach;
            let at = |&slot: &u32| (points.position[slot as usize], points.velocity[slot as usize]);
            let tight = Swept::new(body.slots.iter().map(at), (h, bent), S::ZERO)?;
            let corner = |sign: f64| {
                let x = add(place.middle, [sign * body.reach; 2]);
                (lift(x), lift(twist.velocity))
            };
            let round = Swept::new([-1.0, 1.0].map(corner).into_iter(), (h, pushed), S::ZERO)?;
            Some(tight.within(&round))
        };
        self.bodies.iter().filter_map(swept).collect()
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn kernel(&self) -> Kernel {
        Kernel::Rigid(self.bodies.len())
    }

    fn heap_bytes(&self) -> usize {
        let of = |body: &Body| {
            body.slots.capacity() * size_of::<u32>() + body.shape.places.capacity() * 3 * size_of::<f64>()
        };
        self.bodies.iter().map(of).sum()
    }

    fn bonds(&self) -> usize {
        self.bonds
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, D>> {
        Box::new(self.clone())
    }
}

impl Body {
    /// The longest part of a step in flight [s].
    fn longest<S: Real, const D: usize>(&self, field: &Field<S, D>, h: f64) -> f64 {
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
    fn advance<S: Real, const D: usize>(
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
    fn still(&self, twist: &Twist) -> f64 {
        STILL * (length(twist.velocity) + twist.spin.abs() * self.reach + 1e-3)
    }

    /// On for `h` with points that lie on surfaces. RATTLE: impulses in the first half lead to where none overlaps, those in the second leave
    /// no velocity into a surface.
    fn slide<S: Real, const D: usize>(
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

/// The longest part of a step of `h` [s], of so many at least.
fn within((longest, count): (f64, f64), h: f64) -> f64 {
    longest.min(h / count)
}

impl<S: Real, const D: usize> Among<'_, S, D> {
    /// What surfaces are at these points, as a motion begins.
    fn contacts(&self, motion: &Motion, touches: &[Touch]) -> Vec<Contact> {
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
