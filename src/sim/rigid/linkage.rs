//! Bodies that joints hold together: what they are made of, and their motion.
//!
//! RATTLE in the coordinates of the bodies: impulses at joints and at what lies on surfaces in the first half of a part lead to where all
//! joints fit and nothing overlaps, those in the second half leave no velocity apart at a joint nor into a surface. Without contacts, pushes and
//! dampers five such parts are composed to order 4.
//! Source: H. C. Andersen, J. Comput. Phys. 52, 24 (1983).

use std::cell::Cell;

use super::blueprint::{Blueprint, BodyPlan};
use super::body::{Body, Field, Push, lift};
use super::inertia::{Contact, Inertia};
use super::joints::{Anchor, End, Factored, Joints, Stand, are_led};
use super::motion::Motion;
use super::motion::Twist;
use super::ties::Ties;
use super::together::Together;
use super::touch::{Among, Touch};
use crate::sim::contact::coulomb::coupled::Speeds;
use crate::sim::contact::coulomb::{OF_A_CONTACT, Pressed, Rub};
use crate::sim::integrate::composed::COMPOSED_4;
use crate::sim::ledger::Book;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, flat, scale, sub, widen};

/// Parts of a step that are shorter mend no gaps `[s]`: over so short a time that would be speed.
const BRIEF: f64 = 1e-6;
/// Rounds in which the first half of a part finds the impulses that lead to where everything fits.
const ROUNDS: u32 = 30;
/// A gap that counts as none, as a share of where things are `[1]`.
const FITS: f64 = 4e-15;
/// A gap at which a part has failed, in those that count as none.
const MISSES: f64 = 1e6;
/// Share of its motion that drag takes in a part of a step, up to which a composition that goes back in time is of use.
const WEAK: f64 = 0.1;

/// Halves of a part, and operations of joints in each, in those of a factorisation.
const OF_A_HALF: u64 = 2;
const OF_ROUNDS: u64 = 3;

/// Bodies that joints hold together, or one alone.
#[derive(Clone, Debug)]
pub(super) struct Linkage {
    pub(super) bodies: Vec<Body>,
    inertias: Vec<Inertia>,
    pub(super) joints: Joints,
    /// Points that do not move, as links count them, and those of bodies that stand still, by their places in the group.
    fixed: Vec<u32>,
    still: Vec<u32>,
    /// Springs and angles between its bodies.
    pub(super) ties: Ties,
}

impl Linkage {
    /// From a plan, with the places of its points in the group.
    pub(super) fn new(plan: &Blueprint, slots: &[u32], ties: Ties) -> Self {
        let placed = |points: &[u32]| points.iter().map(|&point| slots[point as usize]).collect::<Vec<u32>>();
        let body = |of: &BodyPlan| Body::new(of.shape.clone(), placed(&of.points), of.deaf.clone());
        let bodies: Vec<Body> = plan.bodies.iter().map(body).collect();
        Linkage {
            inertias: bodies.iter().map(|body| body.inertia).collect(),
            bodies,
            joints: Joints::new(plan.links.clone()),
            fixed: placed(&plan.fixed),
            still: placed(&plan.still),
            ties,
        }
    }

    /// The body, where it is one that nothing joins to anything.
    pub(super) fn alone(&self) -> Option<&Body> {
        match &self.bodies[..] {
            [body] if self.joints.is_empty() && self.ties.is_empty() => Some(body),
            _ => None,
        }
    }

    /// Where the points are that do not move by themselves, and how they are led.
    pub(super) fn anchors<S: Real, const D: usize>(&self, points: &Points<S, D>) -> Vec<Anchor> {
        let of = |&slot: &u32| Anchor {
            place: flat(widen(points.position[slot as usize])),
            velocity: flat(widen(points.velocity[slot as usize])),
        };
        self.fixed.iter().map(of).collect()
    }

    /// The motion of all bodies, with no more than rounding between them at joints.
    pub(super) fn read<S: Real, const D: usize>(&self, points: &Points<S, D>, anchors: &[Anchor]) -> Vec<Motion> {
        let mut motions: Vec<Motion> = self.bodies.iter().map(|body| body.read(points)).collect();
        if self.joints.is_empty() {
            return motions;
        }
        let closed = 1e3 * FITS * self.size(&motions);
        self.joints.close(&self.inertias, (&mut motions, anchors), (ROUNDS, closed), None);
        let mut twists = twists_of(&motions);
        let joints = self.joints.factored(&self.inertias, Stand { motions: &motions, anchors, since: 0.0 });
        joints.hold(&mut twists, &joints.leads);
        motions.iter_mut().zip(twists).for_each(|(motion, twist)| motion.twist = twist);
        motions
    }

    /// Kinetic energy of its bodies `[J]`, as points have it.
    pub(super) fn energy<S: Real, const D: usize>(&self, points: &Points<S, D>) -> f64 {
        self.bodies.iter().map(|body| body.inertia.energy(&body.read(points).twist)).sum()
    }

    /// The same, as it is `[J]`.
    pub(super) fn energy_of(&self, motions: &[Motion]) -> f64 {
        self.bodies.iter().zip(motions).map(|(body, motion)| body.inertia.energy(&motion.twist)).sum()
    }

    /// What stands still has no velocity.
    pub(super) fn stop<S: Real, const D: usize>(&self, points: &mut Points<S, D>) {
        for &slot in &self.still {
            points.velocity[slot as usize] = [S::ZERO; D];
            if let Some(lost) = points.velocity_lost.get_mut(slot as usize) {
                *lost = [S::ZERO; D];
            }
        }
    }

    /// Points that are led go on for `h` `[s]`.
    pub(super) fn lead<S: Real, const D: usize>(&self, points: &mut Points<S, D>, anchors: &[Anchor], h: f64) {
        for (&slot, anchor) in self.fixed.iter().zip(anchors) {
            if anchor.is_led() {
                points.position[slot as usize] = lift(add(anchor.place, scale(anchor.velocity, h)));
            }
        }
    }

    /// How far from the origin it reaches, and 1 `[m]`.
    pub(super) fn size(&self, motions: &[Motion]) -> f64 {
        let of = |(body, motion): (&Body, &Motion)| {
            1.0 + body.reach + motion.place.middle[0].abs() + motion.place.middle[1].abs()
        };
        self.bodies.iter().zip(motions).map(of).fold(0.0, f64::max)
    }

    /// Bytes on the heap, about.
    pub(super) fn heap_bytes(&self) -> usize {
        let of = |body: &Body| {
            body.slots.capacity() * size_of::<u32>() + body.shape.places.capacity() * 3 * size_of::<f64>()
        };
        self.bodies.iter().map(of).sum::<usize>() + 200 * self.joints.rows()
    }
}

/// A linkage in a step.
pub(super) struct Moving<'a, S: Real, const D: usize> {
    pub(super) linkage: &'a Linkage,
    pub(super) field: &'a Field<'a, S, D>,
    /// What it hangs on, and when the step began `[s]`.
    anchors: &'a [Anchor],
    start: f64,
    /// Its bodies among obstacles.
    pub(super) among: Vec<Among<'a, S, D>>,
    /// A gap that counts as none `[m]`.
    pub(super) fits: f64,
    /// Operations that a half of a part takes, about, and those of all parts that were taken or tried.
    work: u64,
    spent: Cell<u64>,
    /// Some part did not come to where all joints fit.
    failed: Cell<bool>,
}

/// A point of one of the bodies on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Spot {
    pub(super) body: u32,
    pub(super) touch: Touch,
}

impl<'a, S: Real, const D: usize> Moving<'a, S, D> {
    pub(super) fn new(
        linkage: &'a Linkage,
        field: &'a Field<'a, S, D>,
        (anchors, start): (&'a [Anchor], f64),
        motions: &[Motion],
    ) -> Self {
        let obstacles = &field.pull.contacts.obstacles;
        let among =
            linkage.bodies.iter().zip(motions).map(|(body, motion)| Among::new(body, obstacles, motion)).collect();
        let of_bodies: u64 = linkage.bodies.iter().map(|body| body.work_in_flight(field)).sum();
        let work = of_bodies + OF_ROUNDS * linkage.joints.work();
        Moving {
            linkage,
            field,
            anchors,
            start,
            among,
            fits: FITS * linkage.size(motions),
            work,
            spent: Cell::new(0),
            failed: Cell::new(false),
        }
    }

    /// Operations of all that was taken or tried since this was asked last, about.
    pub(super) fn take_spent(&self) -> u64 {
        self.spent.take()
    }

    /// Whether some part did not come to where all joints fit, since this was asked last.
    pub(super) fn take_failed(&self) -> bool {
        self.failed.take()
    }

    fn bodies(&self) -> &'a [Body] {
        &self.linkage.bodies
    }

    /// Whether some point that it hangs on is led.
    pub(super) fn is_led(&self) -> bool {
        are_led(self.anchors)
    }

    fn stand<'b>(&'b self, motions: &'b [Motion], t: f64) -> Stand<'b> {
        Stand { motions, anchors: self.anchors, since: t - self.start }
    }

    pub(super) fn factored(&self, motions: &[Motion], t: f64) -> Factored<'a> {
        self.linkage.joints.factored(&self.linkage.inertias, self.stand(motions, t))
    }

    /// On for `h` `[s]` where nothing touches it. Works and losses are booked where there is a book.
    pub(super) fn fly(&self, motions: &[Motion], (t, h): (f64, f64), mut book: Option<&mut Book>) -> Vec<Motion> {
        let spent = Cell::new(0);
        let is_slowed = self.field.pushes() || self.field.pull.drag_rate * h > WEAK || self.linkage.ties.is_damped();
        if is_slowed {
            return self.slide(motions, (t, h), &[], (&spent, book));
        }
        let (mut motions, mut now) = (motions.to_vec(), t);
        for share in COMPOSED_4 {
            motions = self.slide(&motions, (now, share * h), &[], (&spent, book.as_deref_mut()));
            now += share * h;
        }
        motions
    }

    /// On for `h` from `t` `[s]` with points that lie on surfaces. What that takes is counted as spent.
    pub(super) fn slide(
        &self,
        motions: &[Motion],
        (t, h): (f64, f64),
        lying: &[Spot],
        (spent, mut book): (&Cell<u64>, Option<&mut Book>),
    ) -> Vec<Motion> {
        if h == 0.0 {
            return motions.to_vec();
        }
        let of_contacts = 2 * lying.len() as u64 * self.linkage.joints.work();
        self.spent.set(self.spent.get() + OF_A_HALF * (self.work + of_contacts));
        let joints = self.factored(motions, t);
        let pushed = self.kicked(motions, (t, 0.5 * h), &joints, book.as_deref_mut());
        let ways: Vec<f64> = lying.iter().map(|spot| self.way_of(motions, *spot)).collect();
        let mut first = self.contacts(motions, lying);
        first.iter_mut().zip(&ways).for_each(|(contact, way)| contact.1.rub.slides = *way);
        let rubs = first.iter().map(|contact| contact.1.rub).collect();
        let together = Together::new(&joints, &first);
        let (half, pressed, passes) = self.arrive((motions, &pushed), (t, h), &together, (lying, rubs));
        let led = together.work_of_leads((&pushed, &twists_of(&half)), &pressed.impulses);
        let joints = self.factored(&half, t + h);
        let arrived = self.kicked(&half, (t + h, 0.5 * h), &joints, book.as_deref_mut());
        let mut second = self.contacts(&half, lying);
        second.iter_mut().zip(&ways).for_each(|(contact, way)| contact.1.rub.slides = *way);
        let together = Together::new(&joints, &second);
        let (twists, last) = together.press((&arrived, &joints.leads), &together.rubs(), &pressed.impulses);
        let count = lying.len() as u64;
        let of_contacts = OF_A_CONTACT * u64::from(passes + last.passes) * count * count;
        spent.set(spent.get() + of_contacts);
        if let Some(book) = book {
            let rubbed = |k: usize| {
                let [from, to] = [motions, &half].map(|motions| self.at(motions, lying[k]));
                let along = dot(sub(to, from), second[k].1.tangent()) / h;
                -along * (pressed.impulses[k][1] + last.impulses[k][1])
            };
            if joints.is_led {
                book.pins += together.work_of_leads((&arrived, &twists), &last.impulses) + led;
            }
            book.friction += (0..lying.len()).map(rubbed).sum::<f64>().max(0.0);
        }
        half.iter().zip(twists).map(|(motion, twist)| Motion { twist, ..*motion }).collect()
    }

    /// The impulses of the first half of a part, and where they lead: ways are bent, so what is left of gaps is asked for by targets.
    fn arrive(
        &self,
        (motions, pushed): (&[Motion], &[Twist]),
        (t, h): (f64, f64),
        together: &Together,
        (lying, mut rubs): (&[Spot], Vec<Rub>),
    ) -> (Vec<Motion>, Pressed<Speeds>, u32) {
        let from: Vec<[f64; 2]> = lying.iter().map(|spot| self.at(motions, *spot)).collect();
        let mut targets = together.joints.leads.clone();
        let (mut guess, mut passes, mut last) = (Vec::new(), 0, f64::INFINITY);
        for round in 1.. {
            let (twists, pressed) = together.press((pushed, &targets), &rubs, &guess);
            let on = |(motion, twist): (&Motion, &Twist)| Motion {
                place: motion.place.moved(scale(twist.velocity, h), twist.spin * h),
                twist: *twist,
            };
            let half: Vec<Motion> = motions.iter().zip(&twists).map(on).collect();
            passes += pressed.passes;
            let gaps = self.linkage.joints.gaps(self.stand(&half, t + h));
            let apart = gaps.iter().fold(0.0, |most: f64, gap| most.max(gap.abs()));
            let mut largest: f64 = 0.0;
            for (k, spot) in lying.iter().enumerate() {
                let among = &self.among[spot.body as usize];
                let x = self.at(&half, *spot);
                let surface = among.obstacles.surfaces[spot.touch.surface].gap_of(x);
                let off = [surface, dot(sub(x, from[k]), together.tangent(k))];
                let gap = if pressed.impulses[k][0] > 0.0 { off[0].abs() } else { -off[0] };
                largest = largest.max(gap);
                if !pressed.has_converged {
                    continue;
                }
                let rub = &mut rubs[k];
                rub.target[0] -= if gap > 0.5 * among.touch { off[0] / h } else { 0.0 };
                rub.target[1] -= if rub.slides == 0.0 { off[1] / h } else { 0.0 };
            }
            let touch = self.among.iter().fold(f64::INFINITY, |least, among| least.min(among.touch));
            let fits = apart <= self.fits && largest <= 0.5 * touch;
            // Rounding is all that is left where it comes no nearer.
            let is_stuck = apart > 0.5 * last && apart <= 1e3 * self.fits && largest <= 0.5 * touch;
            if fits || is_stuck || round >= ROUNDS || h.abs() < BRIEF {
                // NaN does not fit.
                let is_near = apart <= MISSES * self.fits;
                self.failed.set(self.failed.get() || !is_near && h.abs() >= BRIEF);
                self.spent.set(self.spent.get() + u64::from(round) * self.linkage.joints.work() / 3);
                return (half, pressed, passes);
            }
            last = apart;
            targets.iter_mut().zip(&gaps).for_each(|(target, gap)| *target -= gap / h);
            guess.clone_from(&pressed.impulses);
        }
        unreachable!("the last round returns")
    }

    /// The motion after a time of gravity, drag and pushes as they are now; joints do not answer yet.
    fn kicked(
        &self,
        motions: &[Motion],
        (t, h): (f64, f64),
        joints: &Factored,
        mut book: Option<&mut Book>,
    ) -> Vec<Twist> {
        let Moving { linkage, field, .. } = self;
        let mut pushes: Vec<Vec<Push>> =
            linkage.bodies.iter().zip(motions).map(|(body, motion)| body.pushes(&motion.place, field, t)).collect();
        let kick = |pushes: &[Vec<Push>], h: f64, mut book: Option<&mut Book>| -> Vec<Twist> {
            let each = linkage.bodies.iter().zip(motions).zip(pushes);
            each.map(|((body, motion), pushes)| body.drift(motion, field, (pushes, h), book.as_deref_mut()).twist)
                .collect()
        };
        if !linkage.ties.is_empty() {
            let mut pulled = linkage.ties.still(self.stand(motions, t));
            if linkage.ties.is_damped() {
                // Dampers pull with the velocity in the middle of the kick, as the joints leave it.
                let ahead: Vec<Vec<Push>> = pushes
                    .iter()
                    .zip(&pulled.pushes)
                    .map(|(pushes, force)| [&pushes[..], &[*force]].concat())
                    .collect();
                let mut twists = kick(&ahead, 0.5 * h, None);
                joints.hold(&mut twists, &joints.leads);
                let middle: Vec<Motion> =
                    motions.iter().zip(twists).map(|(motion, twist)| Motion { twist, ..*motion }).collect();
                pulled = linkage.ties.damped(self.stand(&middle, t));
            }
            if let Some(book) = book.as_mut() {
                book.dampers += pulled.taken * h;
                book.pins += pulled.led * h;
            }
            pushes.iter_mut().zip(pulled.pushes).for_each(|(pushes, force)| pushes.push(force));
        }
        kick(&pushes, h, book)
    }

    /// Where a point is `[m]`.
    fn at(&self, motions: &[Motion], spot: Spot) -> [f64; 2] {
        let body = &self.bodies()[spot.body as usize];
        motions[spot.body as usize].place.out(body.shape.places[spot.touch.point as usize])
    }

    /// Which way a point slides, -1 or 1; 0: it does not.
    fn way_of(&self, motions: &[Motion], spot: Spot) -> f64 {
        let [_, along] = self.among[spot.body as usize].speeds(&motions[spot.body as usize], spot.touch);
        let still = self.still(motions);
        if along.abs() > still { along.signum() } else { 0.0 }
    }

    /// A speed that counts as none `[m/s]`.
    pub(super) fn still(&self, motions: &[Motion]) -> f64 {
        self.bodies().iter().zip(motions).map(|(body, motion)| body.still(&motion.twist)).fold(0.0, f64::max)
    }

    /// What surfaces are at these points.
    pub(super) fn contacts(&self, motions: &[Motion], spots: &[Spot]) -> Vec<(u32, Contact)> {
        let of = |spot: &Spot| {
            let body = spot.body as usize;
            (spot.body, self.among[body].contact(&motions[body], spot.touch))
        };
        spots.iter().map(of).collect()
    }

    /// Bodies are where joints fit and no point is behind a surface by more than counts as none; without speed.
    pub(super) fn mended(
        &self,
        motions: &[Motion],
        t: f64,
        behind: impl Fn(&[Motion]) -> Vec<Spot>,
    ) -> Option<Vec<Motion>> {
        let mut motions = motions.to_vec();
        for _ in 0..ROUNDS {
            let spots = behind(&motions);
            if spots.is_empty() {
                return Some(motions);
            }
            let mut contacts = self.contacts(&motions, &spots);
            for ((body, contact), spot) in contacts.iter_mut().zip(&spots) {
                contact.rub.friction = 0.0;
                let x = self.at(&motions, *spot);
                contact.rub.target[0] =
                    -self.among[*body as usize].obstacles.surfaces[spot.touch.surface].gap_of(x).min(0.0);
            }
            let targets: Vec<f64> = self.linkage.joints.gaps(self.stand(&motions, t)).iter().map(|gap| -gap).collect();
            let rest = vec![Twist::STILL; motions.len()];
            let joints = self.factored(&motions, t);
            let together = Together::new(&joints, &contacts);
            let (ways, _) = together.press((&rest, &targets), &together.rubs(), &[]);
            for (motion, way) in motions.iter_mut().zip(ways) {
                motion.place = motion.place.moved(way.velocity, way.spin);
            }
        }
        None
    }

    /// The shortest rod, or how far the smallest body reaches `[m]`; infinite without any.
    pub(super) fn shortest(&self) -> f64 {
        let rods = self.linkage.joints.links().iter().filter_map(|link| link.rest);
        let bodies = self.bodies().iter().map(|body| body.reach);
        rods.chain(bodies).filter(|&length| length > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The fastest that a rod turns `[rad/s]`.
    pub(super) fn turning(&self, motions: &[Motion]) -> f64 {
        let stand = self.stand(motions, self.start);
        let of = |rest: f64, ends: [End; 2]| {
            let [a, b] = ends.map(|end| stand.velocity(end));
            let v = sub(a, b);
            if rest > 0.0 { dot(v, v).sqrt() / rest } else { 0.0 }
        };
        let links = self.linkage.joints.links().iter();
        let rods = links.filter_map(|link| Some(of(link.rest?, link.ends))).fold(0.0, f64::max);
        motions.iter().map(|motion| motion.twist.spin.abs()).fold(rods, f64::max)
    }
}

/// How all bodies move.
pub(super) fn twists_of(motions: &[Motion]) -> Vec<Twist> {
    motions.iter().map(|motion| motion.twist).collect()
}
