//! Large bodies: state in the order of vectors, bonds by the kernel that fits what the body is made of.
//!
//! A step of a large body is cut into equal substeps of h. With d the displacement of a point in a substep,
//!
//! ```text
//! d <- keep d + g h^2        gravity and drag, from the middle of one substep to the middle of the next
//! d <- d + …                 bonds: sweeps or passes of the path method
//! x <- x + d
//! ```
//!
//! which is Verlet's method with the velocity v = d/h in the middle of substeps: half a substep behind the positions.

pub(crate) mod body;
pub(crate) mod chain;
pub(crate) mod control;
pub(crate) mod crowd;
pub(crate) mod draft;
pub(crate) mod form;
pub(crate) mod impact;
pub(crate) mod kernel;
pub(crate) mod mesh;
pub(crate) mod mover;
pub(crate) mod outside;
pub(crate) mod sheet;
pub(crate) mod spec;
#[cfg(test)]
mod tests;
pub(crate) mod trails;

use super::account::Account;
use super::counters::Counters;
use super::environment::Environment;
use super::force::mouse::Push;
use super::kernels::store::Drift;
use super::points::Points;
use super::pull::Pull;
use super::real::Real;
use super::threads::Help;
use super::vector::{add, convert, scale, sub};
use body::{AnyBody, Middle};
use control::{Control, FRAME, Load};
use draft::Order;
use kernel::Kernel;
use mover::Mover;
use outside::{Clear, Outside, Toll};
use spec::{Start, Substep};

/// Share of a substep below which a step is none.
const SHORTEST: f64 = 0.5;

/// Passes over the bonds that a start gets which violates them.
const MOST_PASSES: u32 = 200;

/// How bonds are taken in a substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// One pass of the path method.
    Paths,
    /// So many sweeps.
    Sweeps(u32),
    /// Springs push: the velocity form of Verlet's method.
    Forces,
}

/// Large bodies that move in step.
#[derive(Clone, Debug)]
pub(crate) struct Bulk<S: Real, const D: usize> {
    pub(crate) bodies: Vec<AnyBody<S, D>>,
    pub(crate) way: Way,
    pub(crate) control: Control,
    /// The substep that relaxed bonds are relative to `[s]`.
    pub(crate) nominal: f64,
    /// How far velocities are behind positions, when they come from the stores `[s]`.
    pub(crate) lag: f64,
    /// How far the points are ahead of the stores `[s]`.
    ahead: f64,
    /// The substep that the motions in the stores are of `[s]`; `None`: they are to be taken from the points.
    pub(crate) loaded: Option<f64>,
    /// Nothing from outside is in reach for a while.
    clear: Option<Clear>,
    help: Help,
}

impl<S: Real, const D: usize> Bulk<S, D> {
    pub(crate) fn new(order: Order<S, D>) -> Self {
        let Order { bodies, inverse_mass, way, mut control, gravity, nominal } = order;
        let mut bodies: Vec<AnyBody<S, D>> = bodies.into_iter().map(|draft| draft.make(&inverse_mass)).collect();
        let borne = bodies.iter_mut().map(AnyBody::bears).fold(0.0, f64::max);
        let mass = bodies.iter_mut().map(AnyBody::mass).fold(0.0, f64::max);
        control.bear(borne * gravity * FRAME * FRAME, mass * gravity);
        Bulk { bodies, way, control, nominal, lag: 0.0, ahead: 0.0, loaded: None, clear: None, help: Help::default() }
    }
}

impl<S: Real, const D: usize> Mover<S, D> for Bulk<S, D> {
    fn lag(&self) -> f64 {
        self.lag + self.ahead
    }

    fn reload(&mut self) {
        self.clear = None;
        self.forget();
    }

    fn lose(&mut self, ends: [u32; 2], rest: f64) -> bool {
        self.bodies.iter_mut().any(|body| body.lose(ends, rest))
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, D>> {
        Box::new(self.clone())
    }

    fn bonds(&self) -> usize {
        self.bodies.iter().map(AnyBody::bonds).sum()
    }

    fn kernel(&self) -> Kernel {
        let mut counts = [0; 4];
        self.bodies.iter().for_each(|body| counts[body.place()] += 1);
        Kernel::Forms(counts, self.way)
    }

    fn heap_bytes(&self) -> usize {
        self.bodies.iter().map(AnyBody::heap_bytes).sum()
    }

    fn begin(&mut self, points: &mut Points<S, D>, _around: &Environment<D>, _t: f64) {
        self.loaded = None;
        const ENOUGH: f64 = 1e-5;
        if self.strain_of(points) <= ENOUGH {
            return;
        }
        let velocity = points.velocity.clone();
        points.velocity.fill([S::ZERO; D]);
        for _ in 0..MOST_PASSES {
            self.bodies.iter_mut().for_each(|body| body.load(points, S::ONE));
            self.project((1.0, 1.0), &mut Counters::default());
            let strain = self.strain();
            self.bodies.iter_mut().for_each(|body| body.arrive(points, S::ZERO));
            if strain <= self.control.tolerance() {
                break;
            }
        }
        points.velocity = velocity;
    }

    /// A step much shorter than a substep waits for the next one: what strain bonds have would be mended within it, at any speed.
    /// Where a strain is asked for and not reached, the step is taken again in more substeps.
    fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        mut account: Option<&mut Account>,
    ) {
        if self.way != Way::Forces && self.ahead + h < SHORTEST * self.loaded.unwrap_or(self.control.substep()) {
            return self.wait(points, pull, h);
        }
        let span = (t - self.ahead, self.ahead + h);
        let outside = Outside::in_reach(points, pull, around, span, (&mut self.clear, self.way == Way::Forces));
        let parts = outside.parts(points, span);
        let booked = account.as_ref().map(|account| account.book);
        loop {
            let h = h + self.ahead;
            let count = self.control.follow(parts, h);
            let substep = h / f64::from(count);
            let work = self.bonds() * (count * passes(self.way)) as usize;
            let mut help = self.help;
            let ledger = account.as_deref_mut().map(|account| (account, around));
            let taut =
                help.with(work, || self.run((points, pull, &outside), (span.0, substep, count), counters, ledger));
            self.help = help;
            counters.substeps += u64::from(count);
            counters.points_moved += u64::from(count) * points.len() as u64;
            let strain = if self.control.follows() { self.strain() } else { 0.0 };
            let is_disturbed = !outside.is_nothing();
            if self.control.accepts(strain, Load { pull: taut.to_f64(), is_disturbed, is_grabbed: pull.is_grabbed }) {
                self.arrive(points, substep);
                (self.lag, self.ahead) = (0.5 * substep, 0.0);
                self.loaded = Some(substep);
                return;
            }
            // The points still have the state before.
            if let (Some(account), Some(booked)) = (&mut account, booked) {
                account.book = booked;
            }
            self.forget();
            counters.guard_splits += 1;
        }
    }
}

impl<S: Real, const D: usize> Bulk<S, D> {
    /// The points are what counts, not the stores.
    fn forget(&mut self) {
        (self.lag, self.ahead, self.loaded) = (self.lag + self.ahead, 0.0, None);
    }

    /// Points fly for `h` `[s]`, and end on the free side of surfaces; the stores stay behind.
    fn wait(&mut self, points: &mut Points<S, D>, pull: &Pull<S, D>, h: f64) {
        let flight = drift(pull, (1.0, 1.0), self.lag() + 0.5 * h);
        for ((x, &v), &w) in points.position.iter_mut().zip(&points.velocity).zip(&points.inverse_mass) {
            let way = if w > S::ZERO { add(scale(v, flight.keep), flight.fall) } else { v };
            let from = *x;
            *x = add(from, scale(way, S::from_f64(h)));
            if w == S::ZERO {
                continue;
            }
            let obstacles = &pull.contacts.obstacles;
            if let Some(end) = obstacles.led(from, *x, [S::ZERO; D], |_, _| [S::ONE, S::ZERO]) {
                *x = end;
            }
            for surface in obstacles.planes() {
                *x = sub(*x, scale(surface.normal, surface.gap(*x).min(S::ZERO)));
            }
        }
        match self.loaded {
            Some(_) => self.ahead += h,
            None => self.lag += h,
        }
    }

    /// The largest strain of rigid bonds of points as they lie.
    fn strain_of(&mut self, points: &Points<S, D>) -> f64 {
        self.bodies.iter_mut().for_each(|body| body.load(points, S::ZERO));
        self.strain()
    }

    /// Takes `count` substeps of `h` `[s]` from the state of the points: all but the arrival. Returns the largest pull of a
    /// bond, as [`path::solve`](super::kernels::path::solve). `begin` is when the first begins `[s]`. A ledger, where one is kept, is with what is around.
    fn run(
        &mut self,
        (points, pull, outside): (&Points<S, D>, &Pull<S, D>, &Outside<S, D>),
        (begin, h, count): (f64, f64, u32),
        counters: &mut Counters,
        mut ledger: Option<(&mut Account, &Environment<D>)>,
    ) -> S {
        let mut taut = S::ZERO;
        let old = *self.loaded.get_or_insert_with(|| {
            self.bodies.iter_mut().for_each(|body| body.load(points, S::from_f64(h)));
            h
        });
        let early = self.lag + 0.5 * h;
        let (first, next) = (drift(pull, (old, h), early), drift(pull, (h, h), h));
        let mut fields = pull.has_fields().then(|| (points.position.clone(), vec![[S::ZERO; D]; points.len()]));
        if outside.is_nothing() && ledger.is_none() && fields.is_none() {
            let starts = self.substeps(h, early).into_iter().zip(self.substeps(h, h));
            for (body, (early, late)) in self.bodies.iter_mut().zip(starts) {
                let (first, next) = (Start { drift: first, step: early }, Start { drift: next, step: late });
                taut = taut.max(body.run(self.way, (&first, &next), count));
                counters.sweep(count * passes(self.way), body.bonds());
            }
            return taut;
        }
        let near: Vec<Vec<usize>> = match outside.mouse {
            Some(_) => self.bodies.iter_mut().map(|body| body.near(outside)).collect(),
            None => Vec::new(),
        };
        self.bodies.iter_mut().for_each(|body| body.set_out(&first));
        for substep in 0..count {
            if substep > 0 {
                self.bodies.iter_mut().for_each(|body| body.go_on(&next));
            }
            let time = if substep == 0 { early } else { h };
            let now = begin + f64::from(substep) * h;
            self.push((outside, &near), (now, h * time), counters);
            if let Some(room) = &mut fields {
                self.drive((pull, &points.inverse_mass), now, h * gain(pull.drag_rate, time), room);
            }
            let before = ledger.as_ref().filter(|ledger| ledger.0.pulls_rigid).map(|_| self.middle(points, h));
            taut = taut.max(self.project((h, time), counters));
            if let (Some((account, _)), Some(before)) = (&mut ledger, before) {
                self.book_pins(h, &before.1, account);
            }
            let account = ledger.as_mut().map(|(account, ..)| &mut **account);
            self.meet(outside, (scale(pull.gravity, h * h), h), counters, account);
            if let Some((account, around)) = &mut ledger {
                let middle = begin + (f64::from(substep) + 0.5) * h;
                self.book((points, pull, around), (middle, h), account);
            }
        }
        taut
    }

    /// Places and velocities of the points in the middle of the substep of `h` `[s]` under way.
    fn middle(&mut self, points: &Points<S, D>, h: f64) -> Middle<S, D> {
        let mut middle = (points.position.clone(), points.velocity.clone());
        self.bodies.iter_mut().for_each(|body| body.read_middle(S::from_f64(1.0 / h), &mut middle));
        middle
    }

    /// Books a substep of `h` whose middle is at a time `[s]`, with the motions that surfaces left: what lies on one goes nowhere.
    fn book(
        &mut self,
        (points, pull, around): (&Points<S, D>, &Pull<S, D>, &Environment<D>),
        (time, h): (f64, f64),
        account: &mut Account,
    ) {
        let (x, v) = self.middle(points, h);
        account.book_middle((pull, around), (time, h), (&x, &v, &points.inverse_mass));
    }

    /// Books what bonds do at pins that are led in a substep of `h` `[s]`; `before` are the velocities before they pulled.
    fn book_pins(&mut self, h: f64, before: &[[S; D]], account: &mut Account) {
        for body in &mut self.bodies {
            match body.work_at_pins(S::from_f64(1.0 / h), before) {
                Some(work) => account.book.pins += work,
                None => account.book.untold += 1,
            }
        }
    }

    /// What a substep of `h` `[s]` gives to the bonds of each body; forces push for `time` `[s]`.
    fn substeps(&self, h: f64, time: f64) -> Vec<Substep> {
        let share = (2.0 * h / self.nominal).powi(2).min(1.0);
        let (tolerance, tautness) = (self.control.tolerance(), self.control.tautness());
        let kick = (self.way == Way::Forces).then_some(time);
        let of = |body: &AnyBody<S, D>| Substep { h, reference: body.reference(), share, tolerance, tautness, kick };
        self.bodies.iter().map(of).collect()
    }

    /// The mouse as it is at a time, where it is in reach, pushes points near it, those of each body in its store: `share` is what an
    /// acceleration adds to a displacement `[s^2]`.
    fn push(
        &mut self,
        (outside, near): (&Outside<S, D>, &[Vec<usize>]),
        (t, share): (f64, f64),
        counters: &mut Counters,
    ) {
        let Some((force, cursor)) = outside.mouse.and_then(|around| around.mouse_at(t)) else { return };
        let push = Push::new(force, cursor);
        for (body, near) in self.bodies.iter_mut().zip(near) {
            counters.mouse_points += near.len() as u64;
            body.push(&push, S::from_f64(share), near);
        }
    }

    /// Forces and gusts at time `t` `[s]` change the motions of points: `share` is what an acceleration adds to a displacement `[s^2]`.
    /// `room`: places and accelerations, one entry a point of the group.
    fn drive(
        &mut self,
        (pull, w): (&Pull<S, D>, &[S]),
        t: f64,
        share: f64,
        (places, pushes): &mut (Vec<[S; D]>, Vec<[S; D]>),
    ) {
        self.bodies.iter_mut().for_each(|body| body.read_places(places));
        pushes.fill([S::ZERO; D]);
        pull.drive(t, (places, w), pushes);
        self.bodies.iter_mut().for_each(|body| body.give(pushes, S::from_f64(share)));
    }

    /// Surfaces, where they are in reach; `fall` is what gravity adds to a motion `[m]` in a substep of `h` `[s]`.
    fn meet(
        &mut self,
        outside: &Outside<S, D>,
        (fall, h): ([f64; D], f64),
        counters: &mut Counters,
        mut account: Option<&mut Account>,
    ) {
        if !outside.has_surfaces() {
            return;
        }
        for body in &mut self.bodies {
            let mut toll = account.is_some().then(Toll::default);
            counters.events += body.meet(outside, convert(fall), toll.as_mut());
            if let (Some(account), Some(toll)) = (&mut account, toll) {
                // Masses are those of the reference, motions are of a substep.
                let scale = 1.0 / (body.reference() * h * h);
                account.book.impacts += scale * toll.impacts;
                account.book.friction += scale * toll.friction;
            }
        }
    }

    fn arrive(&mut self, points: &mut Points<S, D>, h: f64) {
        for body in &mut self.bodies {
            body.arrive(points, S::from_f64(1.0 / h));
        }
    }

    /// Bonds of one substep of `h`, in which forces push for `time` `[s]`. Returns the largest pull.
    fn project(&mut self, (h, time): (f64, f64), counters: &mut Counters) -> S {
        let steps = self.substeps(h, time);
        let mut taut = S::ZERO;
        for (body, step) in self.bodies.iter_mut().zip(steps) {
            taut = taut.max(body.project(self.way, &step));
            counters.sweep(passes(self.way), body.bonds());
        }
        taut
    }

    /// The largest strain of rigid bonds, about: half of |e.e/rest^2 - 1|.
    fn strain(&mut self) -> f64 {
        0.5 * self.bodies.iter_mut().map(|body| body.stretch().to_f64()).fold(0.0, f64::max)
    }
}

/// Passes over the bonds in a substep.
fn passes(way: Way) -> u32 {
    match way {
        Way::Sweeps(sweeps) => sweeps,
        Way::Paths | Way::Forces => 1,
    }
}

/// What gravity and drag do to displacements of substeps of `old` when velocities are taken on by `time` and the next
/// substep is `h` `[s]`.
fn drift<S: Real, const D: usize>(pull: &Pull<S, D>, (old, h): (f64, f64), time: f64) -> Drift<S, D> {
    let rate = pull.drag_rate;
    // v' = g - rate v over `time`: v keep + g gain.
    let keep = if rate == 0.0 { 1.0 } else { libm::exp(-rate * time) };
    let gain = gain(rate, time);
    Drift {
        keep: S::from_f64(keep * (h / old)),
        ratio: S::from_f64(h / old),
        fall: pull.gravity.map(|g| S::from_f64(g * gain * h)),
    }
}

/// What an acceleration adds to a velocity over `time`, over that acceleration `[s]`, under a drag of this rate `[1/s]`.
fn gain(rate: f64, time: f64) -> f64 {
    if rate == 0.0 { time } else { -libm::expm1(-rate * time) / rate }
}
