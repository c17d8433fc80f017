//! What acts on rigid bodies in a step, and what of it pushes one.

use super::course::{DRIVEN, LYING, PHASE, within};
use super::motion::{Axial, Pose};
use super::solid::{MotionOf, Parts, Solid, SpinOf, lift};
use crate::sim::environment::Environment;
use crate::sim::force::mouse;
use crate::sim::ledger::Book;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{add, length, resized, scale, widen, zero};

/// What acts on a body in a step.
pub(super) struct Field<'a, S: Real, const D: usize> {
    pub(super) pull: &'a Pull<S, D>,
    pub(super) around: &'a Environment<D>,
    /// Inverse masses of the group's points `[1/kg]`.
    pub(super) w: &'a [S],
    /// The mouse may push some of its points in the step.
    pub(super) is_reached: bool,
}

/// What pushes a body: a force `[N]`, and a torque about the origin of the shape `[N m]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push<W = f64, const N: usize = 2> {
    pub(super) from: From,
    pub(super) force: [f64; N],
    pub(super) torque: W,
}

/// Where a push comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum From {
    Gravity,
    Ties,
    Mouse,
    Forces,
    Wind,
}

impl From {
    /// Work of it is booked `[J]`.
    pub(super) fn book(self, book: &mut Book, work: f64) {
        match self {
            From::Gravity | From::Ties => {}
            From::Mouse => book.mouse += work,
            From::Forces => book.forces += work,
            From::Wind => book.wind += work,
        }
    }
}

impl<S: Real, const D: usize> Field<'_, S, D> {
    /// Whether anything pushes points that is not the same everywhere.
    pub(super) fn pushes(&self) -> bool {
        self.is_reached || self.pull.has_fields()
    }

    /// What pushes at most, and that but for the mouse `[m/s^2]`.
    pub(super) fn pushed(&self) -> [f64; 2] {
        let pushed = length(self.pull.gravity) + self.pull.most_push();
        [pushed + if self.is_reached { self.around.most_push() } else { 0.0 }, pushed]
    }

    /// The longest part of a step of `h` `[s]` that pushes allow.
    pub(super) fn longest(&self, h: f64) -> f64 {
        let mut longest = f64::INFINITY;
        if self.pull.has_fields() {
            longest = longest.min(within(DRIVEN, h));
        }
        if self.is_reached {
            let strength = self.around.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs());
            longest = longest.min(within(LYING, h)).min(PHASE / strength.sqrt());
        }
        longest
    }

    /// What pushes a body at a place at time `t` `[s]`, but for gravity.
    pub(super) fn on<B: Solid<N>, const N: usize>(
        &self,
        body: &B,
        place: &B::Place,
        t: f64,
    ) -> Vec<Push<SpinOf<B, N>, N>> {
        let mut list = Vec::new();
        let mut note = |from: From, (force, torque)| list.push(Push { from, force, torque });
        if self.is_reached
            && let Some((force, cursor)) = self.around.mouse_at(t)
        {
            let push = mouse::Push::<f64, D>::new(force, cursor);
            note(From::Mouse, sum(body, place, |_, x| push.acceleration(resized(x)).map(resized)));
        }
        if !self.pull.thrusts.is_empty() {
            note(From::Forces, self.driven(body, place));
        }
        if let Some(air) = self.pull.gusts() {
            let gust = |x: [f64; N]| Some(scale(resized(air.gust(resized(x), t)), self.pull.drag_rate));
            note(From::Wind, sum(body, place, |_, x| gust(x)));
        }
        list
    }

    /// Force `[N]` and torque `[N m]` of constant forces.
    fn driven<B: Solid<N>, const N: usize>(&self, body: &B, place: &B::Place) -> ([f64; N], SpinOf<B, N>) {
        let mut x: Vec<[S; D]> = vec![zero(); self.w.len()];
        let Parts { slots, places, .. } = body.parts();
        for (&slot, &q) in slots.iter().zip(places) {
            x[slot as usize] = lift(place.out(q));
        }
        let mut pushes = vec![[0.0; N]; self.w.len()];
        for thrust in &self.pull.thrusts {
            thrust.each(&x, self.w, |i, push| pushes[i] = add(pushes[i], resized(widen(push))));
        }
        sum(body, place, |slot, _| Some(pushes[slot as usize]))
    }
}

/// Whether the mouse may push some of a body's points within `h` from `t` on `[s]`.
pub(super) fn is_reached<S: Real, const D: usize, B: Solid<N>, const N: usize>(
    (body, motion): (&B, &MotionOf<B, N>),
    (pull, around): (&Pull<S, D>, &Environment<D>),
    (t, h): (f64, f64),
) -> bool {
    let pushed = length(pull.gravity) + pull.most_push() + around.most_push();
    let far = body.reach() + motion.way(h, pushed);
    around.may_reach([-far, far].map(|far| lift::<S, D, N>(motion.place.middle().map(|x| x + far))), (t, h))
}

/// Force and torque of accelerations of a body's points, by their slots and places.
fn sum<B: Solid<N>, const N: usize>(
    body: &B,
    place: &B::Place,
    of: impl Fn(u32, [f64; N]) -> Option<[f64; N]>,
) -> ([f64; N], SpinOf<B, N>) {
    let (mut force, mut torque) = ([0.0; N], SpinOf::<B, N>::ZERO);
    let Parts { slots, places, masses } = body.parts();
    for ((&slot, &q), &m) in slots.iter().zip(places).zip(masses) {
        let r = place.turned(q);
        if let Some(a) = of(slot, add(place.middle(), r)) {
            force = add(force, scale(a, m));
            torque = torque.plus(SpinOf::<B, N>::moment(r, a).times(m));
        }
    }
    (force, torque)
}
