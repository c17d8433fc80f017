//! What a step of a cluster is written into the ledger as.
//!
//! Contacts, stops of joints and of triangles that are crushed, friction and dampers are booked by the work of their own impulses: J . (u0 + u1)/2, with u0 and u1 the velocities at both
//! ends of a substep; what restitution gives back is taken off again. Drag, and what settles what touches and is slow, is the change of
//! m v^2/2 that it makes. Nothing else explains a loss: what the method takes beyond that is left over, as its own error, and so is what
//! contacts take that are to give all back.

use super::cluster::{Cluster, Common};
use crate::sim::bond::Limit;
use crate::sim::force::form::at;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Works and losses of a step, there only where a ledger is kept.
#[derive(Clone, Debug)]
pub(super) struct Tally<S: Real> {
    /// How far contacts that do not give all back, and friction, pushed each point in the substep `[m]`.
    pressed: Vec<[S; 2]>,
    rubbed: Vec<[S; 2]>,
    /// The same of sweeps over relaxed bonds.
    relaxed: Vec<[S; 2]>,
    /// Works of the fields that stand in the cluster's work too `[J]`.
    apart: f64,
    taken: Book,
}

impl<S: Real> Tally<S> {
    pub(super) fn new(points: usize) -> Self {
        let none = || vec![zero(); points];
        Tally { pressed: none(), rubbed: none(), relaxed: none(), apart: 0.0, taken: Book::default() }
    }

    /// A substep begins.
    pub(super) fn begin(&mut self) {
        self.pressed.fill(zero());
        self.rubbed.fill(zero());
        self.relaxed.fill(zero());
    }

    /// Drag left the `kept` share of the velocity that a point had.
    pub(super) fn slow(&mut self, (velocity, w, kept): ([S; 2], S, S)) {
        self.taken.drag += (energy(velocity, w) * (S::ONE - kept * kept)).to_f64();
    }

    /// A contact pushed a point by `normal`, unless it gives all back, and friction by `along` `[m]`.
    #[inline(always)]
    pub(super) fn push(&mut self, i: usize, restitution: S, (normal, along): ([S; 2], [S; 2])) {
        if restitution < S::ONE {
            self.pressed[i] = add(self.pressed[i], normal);
        }
        self.rubbed[i] = add(self.rubbed[i], along);
    }

    /// Restitution gave back some of the energy `[J]`.
    pub(super) fn give_back(&mut self, energy: S) {
        self.taken.impacts -= energy.to_f64();
    }
}

fn energy<S: Real>(velocity: [S; 2], w: S) -> S {
    if w == S::ZERO { S::ZERO } else { S::HALF * dot(velocity, velocity) / w }
}

impl<S: Real> Cluster<S> {
    /// Kinetic energy `[J]`, where a ledger is kept.
    pub(super) fn kinetic(&self) -> Option<S> {
        let sum = || (0..self.own()).fold(S::ZERO, |sum, i| sum + energy(self.velocity[i], self.w[i]));
        self.tally.as_ref().map(|_| sum())
    }

    /// Notes what a contact, by `out`, and friction, by `aside`, push a point away from a place on an edge, as
    /// [`push`](Self::push) does, where a ledger is kept.
    #[inline(always)]
    pub(super) fn note_push(&mut self, [p, a, b]: [usize; 3], at: S, restitution: S, (out, aside): ([S; 2], [S; 2])) {
        self.note_shares(&[(p, S::ONE), (a, at - S::ONE), (b, -at)], restitution, (out, aside));
    }

    /// The same of points that take these shares of it.
    #[inline(always)]
    pub(super) fn note_shares(&mut self, shares: &[(usize, S)], restitution: S, (out, aside): ([S; 2], [S; 2])) {
        let Some(tally) = &mut self.tally else { return };
        for &(i, share) in shares {
            let share = share * self.w[i];
            if share != S::ZERO {
                tally.push(i, restitution, (scale(out, share), scale(aside, share)));
            }
        }
    }

    /// The same of a point alone, as [`push_one`](Self::push_one) has it.
    #[inline(always)]
    pub(super) fn note_push_of_one(&mut self, p: usize, restitution: S, (out, aside): ([S; 2], [S; 2])) {
        let share = if self.is_of_rigid([p, p]) { self.w[p] } else { S::ONE };
        if let Some(tally) = &mut self.tally {
            tally.push(p, restitution, (scale(out, share), scale(aside, share)));
        }
    }

    /// Notes how far a stop that gives nothing back pushes a point `[m]`: the end of a joint's range, or of what a triangle may be crushed to.
    #[inline(always)]
    pub(super) fn note_stop(&mut self, i: usize, way: [S; 2]) {
        if let Some(tally) = &mut self.tally {
            tally.push(i, S::ZERO, (way, zero()));
        }
    }

    /// Notes how far a relaxed bond moved a point `[m]`, by what it gave to its velocity.
    pub(super) fn note_relaxed(&mut self, i: usize, way: [S; 2]) {
        if let Some(tally) = &mut self.tally {
            tally.relaxed[i] = add(tally.relaxed[i], way);
        }
    }

    /// A sweep over relaxed bonds.
    pub(super) fn relax(&mut self, sweep: impl FnOnce(&mut Self)) {
        let ways = |state: &Self, sign: S| -> Vec<[S; 2]> {
            state.way.iter().zip(&state.turned).map(|(&way, &turned)| scale(add(way, turned), sign)).collect()
        };
        let before = self.tally.is_some().then(|| ways(self, -S::ONE));
        sweep(self);
        if let Some(before) = before {
            let after = ways(self, S::ONE);
            for (i, (&before, &after)) in before.iter().zip(&after).enumerate().take(self.own()) {
                self.note_relaxed(i, add(before, after));
            }
        }
    }

    /// What mouse, forces and wind did in a substep that is over.
    pub(super) fn book_given(&mut self) {
        let works = self.given.works(&self.velocity, &self.w);
        self.work += works.seen;
        if let Some(tally) = &mut self.tally {
            tally.apart += (works.seen - works.mouse).to_f64();
            tally.taken.forces += works.forces.to_f64();
            tally.taken.wind += works.wind.to_f64();
        }
    }

    /// What drives did in a substep, as the guard has it and by the springs' own rests, and what their dampers took `[J]`.
    pub(super) fn book_drives(&mut self, seen: S, booked: S, damped: S) {
        if let Some(tally) = &mut self.tally {
            tally.apart += seen.to_f64();
            tally.taken.drives += booked.to_f64();
            tally.taken.dampers += damped.to_f64();
        }
    }

    /// Of a step that led bodies out of others it made so much energy in all `[J]`: what nothing else brought or took, parting did.
    pub(super) fn book_parting(&mut self, made: S) {
        let mouse = self.work.to_f64();
        if let Some(tally) = &mut self.tally {
            let brought = tally.taken.brought() + mouse - tally.apart;
            tally.taken.parting += made.to_f64() - brought + tally.taken.taken();
        }
    }

    /// What contacts, friction and dampers took in a substep of `h` `[s]`, before anything bounces.
    pub(super) fn tally(&mut self, common: &Common<S>, h: f64) {
        let Some(mut tally) = self.tally.take() else { return };
        let rate = S::from_f64(1.0 / h);
        let mut taken = [0.0; 3];
        for i in (0..self.own()).filter(|&i| self.w[i] != S::ZERO) {
            let mean = scale(add(self.begun[i], self.velocity[i]), S::HALF);
            let of = |push: [S; 2]| (dot(mean, push) * rate / self.w[i]).to_f64();
            // What leads a rigid body out of something is booked as that, with all that comes of it: its joints and its pin press back.
            let is_led_out = self.sunk[self.body_of[i] as usize] && self.is_of_rigid([i, i]);
            if !is_led_out {
                taken[0] -= of(tally.pressed[i]);
                taken[1] -= of(tally.rubbed[i]);
            }
            taken[2] -= of(tally.relaxed[i]);
        }
        // What contacts make is the method's own error, and explains nothing.
        tally.taken.impacts += taken[0].max(0.0);
        tally.taken.friction += taken[1].max(0.0);
        tally.taken.relaxation += taken[2];
        tally.taken.dampers += self.damped(common, h);
        self.tally = Some(tally);
    }

    /// What dampers take within `h` `[s]`: their force by the way that their ends went, `[J]`.
    fn damped(&self, common: &Common<S>, h: f64) -> f64 {
        let mut sum = 0.0;
        let mut by_forces = self.by_forces.iter();
        for (body, base) in self.members(common) {
            let springs = common.springs(body).iter().zip(by_forces.by_ref());
            for (link, &is_force) in springs.filter(|(link, _)| link.damping > S::ZERO) {
                let (a, b) = (base + link.a as usize, base + link.b as usize);
                let d = sub(self.now[a], self.now[b]);
                let error = dot(d, d).sqrt() - link.rest;
                let is_slack = match link.limit {
                    Limit::Both => false,
                    Limit::Max => error < S::ZERO,
                    Limit::Min => error > S::ZERO,
                };
                // Where springs are projected those without stiffness do nothing.
                if is_slack || (!is_force && link.stiffness == S::ZERO) {
                    continue;
                }
                let closing = |v: &[[S; 2]]| along(sub(v[a], v[b]), d, if is_force { link.rest } else { S::ONE });
                let [begun, now] = [&self.begun, &self.velocity].map(|v| closing(v));
                let acts = if is_force { begun } else { now };
                sum += (link.damping * dot(acts, add(begun, now)) * S::HALF).to_f64();
            }
            for hinge in common.hinges(body).iter().filter(|hinge| hinge.damping > S::ZERO) {
                let points = hinge.points.map(|point| base as u32 + point);
                if let Some(stand) = hinge.stand(at(&self.now, points)) {
                    let [begun, now] = [&self.begun, &self.velocity].map(|v| stand.rate(at(v, points)));
                    sum += (stand.share() * hinge.damping * now * (begun + now) * S::HALF).to_f64();
                }
            }
        }
        h * sum
    }
}

/// The part of a velocity along a bond; of bonds that are to have no length, all of it.
fn along<S: Real>(velocity: [S; 2], d: [S; 2], rest: S) -> [S; 2] {
    let square = dot(d, d);
    match rest == S::ZERO {
        true => velocity,
        false if square == S::ZERO => zero(),
        false => scale(d, dot(velocity, d) / square),
    }
}

/// Books a step.
pub(super) fn book<S: Real>(state: &Cluster<S>, book: &mut Book) {
    let is_led = |i: usize| state.w[i] == S::ZERO && state.velocity[i] != zero();
    // Nobody knows what led pins did.
    book.untold += u64::from((0..state.own()).any(is_led));
    if let Some(tally) = &state.tally {
        book.mouse += state.work.to_f64() - tally.apart;
        book.add(&tally.taken, 1.0);
    }
}
