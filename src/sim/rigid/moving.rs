//! Bodies that joints hold together, in a step.
//!
//! RATTLE in the coordinates of the bodies: impulses at joints and at what lies on surfaces in the first half of a part lead to where all
//! joints fit and nothing overlaps, those in the second half leave no velocity apart at a joint nor into a surface. Without contacts, pushes and
//! dampers five such parts are composed to order 4.
//! Source: H. C. Andersen, J. Comput. Phys. 52, 24 (1983).

use std::cell::Cell;

use super::body::Body;
use super::field::{Field, Push};
use super::joints::Factored;
use super::link::{Anchor, Clock, End, Stand, are_led};
use super::linkage::{FITS, Linkage, ROUNDS, twists_of};
use super::meeting::Meeting;
use super::motion::{Motion, Pose, Twist};
use super::slide::BRIEF;
use super::solid::Solid;
use super::together::Together;
use super::touch::{Among, Touch};
use crate::sim::contact::coulomb::coupled::Speeds;
use crate::sim::contact::coulomb::line::Line;
use crate::sim::contact::coulomb::{Friction, Pressed, Rub};
use crate::sim::integrate::composed::COMPOSED_4;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// A gap at which a part has failed, in those that count as none.
const MISSES: f64 = 1e6;
/// Share of its motion that drag takes in a part of a step, up to which a composition that goes back in time is of use.
const WEAK: f64 = 0.1;

/// Halves of a part, and operations of joints in each, in those of a factorisation.
const OF_A_HALF: u64 = 2;
const OF_ROUNDS: u64 = 3;

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
    /// The step ends where a spring breaks.
    pub(super) locates: bool,
}

/// What touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spot {
    /// A point of one of the bodies on a surface.
    Lies { body: u32, touch: Touch },
    /// A string at its length, by its number.
    Taut(u32),
}

impl<'a, S: Real, const D: usize> Moving<'a, S, D> {
    pub(super) fn new(
        linkage: &'a Linkage,
        field: &'a Field<'a, S, D>,
        (anchors, start): (&'a [Anchor], f64),
        motions: &[Motion],
        locates: bool,
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
            locates,
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

    pub(super) fn stand<'b>(&'b self, motions: &'b [Motion], t: f64) -> Stand<'b> {
        let clock = Some(Clock { time: t, keys: &self.field.around.keys });
        Stand { motions, anchors: self.anchors, since: t - self.start, clock }
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
        let mut first = self.contacts((motions, t), lying);
        first.iter_mut().zip(&ways).for_each(|(contact, way)| contact.rub.slides = [0.0, *way]);
        let rubs = first.iter().map(|contact| contact.rub).collect();
        let together = Together::new(&joints, &first);
        let (half, pressed, passes) = self.arrive((motions, &pushed), (t, h), &together, (lying, rubs));
        let works = together.works((&pushed, &twists_of(&half)), &pressed.impulses);
        let joints = self.factored(&half, t + h);
        let arrived = self.kicked(&half, (t + h, 0.5 * h), &joints, book.as_deref_mut());
        let mut second = self.contacts((&half, t + h), lying);
        second.iter_mut().zip(&ways).for_each(|(contact, way)| contact.rub.slides = [0.0, *way]);
        let together = Together::new(&joints, &second);
        let (twists, last) = together.press((&arrived, &joints.leads), &together.rubs(), &pressed.impulses);
        let count = lying.len() as u64;
        let of_contacts = Line::OF_A_CONTACT * u64::from(passes + last.passes) * count * count;
        spent.set(spent.get() + of_contacts);
        if let Some(book) = book {
            let rubbed = |k: usize| {
                let [from, to] = [motions, &half].map(|motions| self.at(motions, lying[k]));
                let along = dot(sub(to, from), second[k].tangent()) / h;
                -along * (pressed.impulses[k][1] + last.impulses[k][1])
            };
            for [led, driven] in [works, together.works((&arrived, &twists), &last.impulses)] {
                book.pins += led;
                book.drives += driven;
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
        let over: Vec<f64> = lying.iter().map(|spot| self.over((motions, t), *spot)).collect();
        let mut targets = together.joints.leads.clone();
        let (mut guess, mut passes, mut last) = (Vec::new(), 0, f64::INFINITY);
        let touch = self.touch();
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
                let way = sub(self.at(&half, *spot), from[k]);
                let off = [self.gap((&half, t + h), *spot) + over[k], dot(way, together.tangent(k))];
                let gap = if pressed.impulses[k][0] > 0.0 { off[0].abs() } else { -off[0] };
                largest = largest.max(gap);
                if !pressed.has_converged {
                    continue;
                }
                let rub = &mut rubs[k];
                rub.target[0] -= if gap > 0.5 * touch { off[0] / h } else { 0.0 };
                rub.target[1] -= if rub.is_sliding() { 0.0 } else { off[1] / h };
            }
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
            let is_damped = linkage.ties.is_damped();
            if is_damped || book.is_some() && linkage.ties.are_driven() {
                // Dampers pull with the velocity in the middle of the kick, as the joints leave it, and drives work by it.
                let ahead: Vec<Vec<Push>> = pushes
                    .iter()
                    .zip(&pulled.pushes)
                    .map(|(pushes, force)| [&pushes[..], &[*force]].concat())
                    .collect();
                let mut twists = kick(&ahead, 0.5 * h, None);
                joints.hold(&mut twists, &joints.leads);
                let middle: Vec<Motion> =
                    motions.iter().zip(twists).map(|(motion, twist)| Motion { twist, ..*motion }).collect();
                let moving = linkage.ties.damped(self.stand(&middle, t));
                if is_damped {
                    pulled = moving;
                } else {
                    pulled.driven = moving.driven;
                }
            }
            if let Some(book) = book.as_mut() {
                book.dampers += pulled.taken * h;
                book.pins += pulled.led * h;
                book.drives += pulled.driven * h;
            }
            pushes.iter_mut().zip(pulled.pushes).for_each(|(pushes, force)| pushes.push(force));
        }
        kick(&pushes, h, book)
    }

    /// Where a point is `[m]`; of a string nobody asks.
    fn at(&self, motions: &[Motion], spot: Spot) -> [f64; 2] {
        let Spot::Lies { body, touch } = spot else { return [0.0; 2] };
        let places = &self.bodies()[body as usize].shape.places;
        motions[body as usize].place.out(places[touch.point as usize])
    }

    /// How far something is from where it touches at `t` `[s]`: in metres, below 0 beyond that.
    pub(super) fn gap(&self, (motions, t): (&[Motion], f64), spot: Spot) -> f64 {
        match spot {
            Spot::Lies { body, touch } => self.among[body as usize].gap(&motions[body as usize], touch),
            Spot::Taut(k) => self.linkage.strings[k as usize].gap(self.stand(motions, t)),
        }
    }

    /// By how much a string is beyond its length that could not be put right, for pins are too far apart `[m]`: it gets no longer.
    fn over(&self, at: (&[Motion], f64), spot: Spot) -> f64 {
        let gap = if matches!(spot, Spot::Taut(_)) { self.gap(at, spot) } else { 0.0 };
        if gap < -self.touch() { -gap } else { 0.0 }
    }

    /// A gap that counts as none where something touches `[m]`.
    pub(super) fn touch(&self) -> f64 {
        self.among.iter().fold(f64::INFINITY, |least, among| least.min(among.touch))
    }

    /// Which way a point slides, -1 or 1; 0: it does not.
    fn way_of(&self, motions: &[Motion], spot: Spot) -> f64 {
        let Spot::Lies { body, touch } = spot else { return 0.0 };
        let [_, along] = self.among[body as usize].speeds(&motions[body as usize], touch);
        let still = self.still(motions);
        if along.abs() > still { along.signum() } else { 0.0 }
    }

    /// A speed that counts as none `[m/s]`.
    pub(super) fn still(&self, motions: &[Motion]) -> f64 {
        self.bodies().iter().zip(motions).map(|(body, motion)| body.still(&motion.twist)).fold(0.0, f64::max)
    }

    /// What touches at `t` `[s]`, as the law has it.
    pub(super) fn contacts(&self, (motions, t): (&[Motion], f64), spots: &[Spot]) -> Vec<Meeting> {
        let of = |spot: &Spot| match *spot {
            Spot::Lies { body, touch } => {
                Meeting::surface(body, self.among[body as usize].contact(&motions[body as usize], touch))
            }
            Spot::Taut(k) => self.linkage.strings[k as usize].meeting(self.stand(motions, t)),
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
        let mut strings: Vec<Spot> = Vec::new();
        for _ in 0..ROUNDS {
            let mut spots = behind(&motions);
            if spots.is_empty() {
                return Some(motions);
            }
            // A string that was too long is no longer than it may be while others are shortened.
            let again: Vec<Spot> = strings.iter().copied().filter(|spot| !spots.contains(spot)).collect();
            let is_new = |spot: &&Spot| matches!(spot, Spot::Taut(_)) && !strings.contains(spot);
            let new: Vec<Spot> = spots.iter().filter(is_new).copied().collect();
            strings.extend(new);
            spots.extend(again);
            let mut contacts = self.contacts((&motions, t), &spots);
            for (contact, &spot) in contacts.iter_mut().zip(&spots) {
                contact.rub.friction = 0.0;
                let gap = self.gap((&motions, t), spot);
                contact.rub.target[0] = if contact.is_string() { -gap } else { -gap.min(0.0) };
            }
            let targets: Vec<f64> = self.linkage.joints.gaps(self.stand(&motions, t)).iter().map(|gap| -gap).collect();
            let rest = vec![Twist::STILL; motions.len()];
            let joints = self.factored(&motions, t);
            let together = Together::new(&joints, &contacts);
            let (ways, pressed) = together.press((&rest, &targets), &together.rubs(), &[]);
            let count = spots.len() as u64;
            let of_contacts = Line::OF_A_CONTACT * u64::from(pressed.passes) * count * count;
            self.spent.set(self.spent.get() + of_contacts + (count + 1) * self.linkage.joints.work());
            for (motion, way) in motions.iter_mut().zip(ways) {
                motion.place = motion.place.moved(way.velocity, way.spin);
            }
        }
        None
    }

    /// The shortest rod, or how far the smallest body reaches `[m]`; infinite without any.
    pub(super) fn shortest(&self) -> f64 {
        let rods = self.linkage.joints.links().iter().filter_map(|link| link.rest);
        let strings = self.linkage.strings.iter().map(|string| string.rest);
        let bodies = self.bodies().iter().map(|body| body.reach);
        rods.chain(strings).chain(bodies).filter(|&length| length > 0.0).fold(f64::INFINITY, f64::min)
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
        let taut = self.linkage.strings.iter().filter(|string| string.gap(stand) <= self.touch());
        let rods = taut.map(|string| string.turning(stand)).fold(rods, f64::max);
        motions.iter().map(|motion| motion.twist.spin.abs()).fold(rods, f64::max)
    }
}
