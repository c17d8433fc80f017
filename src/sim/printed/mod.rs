//! The loops of the sources as they are printed, each with its faults: laws of their own, beside which the other methods can be seen.
//!
//! ```text
//! notebook   000   clip, sweep; or sweep, clip
//! segments   001   six moves, a sweep, walls
//! rope       002   a move, fifty sweeps; the old place of what is locked stays
//! spring     003   v += h f/m, x += h v
//! cloth      004   a move, out of boxes, fifteen sweeps
//! ```
//!
//! All but 003 keep the place that a point had one move before and no velocity: what is told of one is that difference over the time
//! of the move. A state that leaves the finite numbers is put back to where its step began, and stands still there.

mod cloth;
mod gust;
mod link;
mod notebook;
mod rope;
mod segments;
mod spring;

use std::any::Any;

use super::account::Account;
use super::bond::Bond;
use super::bulk::kernel::Kernel;
use super::bulk::mover::Mover;
use super::constrain::order::Sweeper;
use super::contact::obstacles::Obstacles;
use super::counters::Counters;
use super::environment::Environment;
use super::force::mouse;
use super::force::wind::Wind;
use super::points::Points;
use super::pull::Pull;
use super::real::Real;
use super::solver::Order;
use super::source::Source;
use super::vector::{add, convert, scale, sub};
use gust::Gust;
use link::Link;

/// Points that the loop of a source moves.
#[derive(Clone, Debug)]
pub(crate) struct Printed<S: Real, const D: usize> {
    source: Source,
    links: Vec<Link<S>>,
    sweeper: Sweeper,
    sweeps: u32,
    /// How long the last step took `[s]`.
    last: f64,
    /// The old places of points that are locked, or were until the last step; of 002 alone.
    stale: Vec<Option<[S; D]>>,
    /// Left the finite numbers.
    lost: Vec<u32>,
    /// What pushes a point a frame; of 001 alone.
    gust: Option<Gust<D>>,
}

/// What a source's loop is made for.
pub(crate) struct Setup<const D: usize> {
    /// Which.
    pub(crate) source: Source,
    /// Sweeps in a step; `None`: as many as the source has.
    pub(crate) sweeps: Option<u32>,
    /// [`Order::Auto`]: that of the source.
    pub(crate) order: Order,
    pub(crate) seed: u64,
    /// How long a step takes `[s]`.
    pub(crate) substep: f64,
    pub(crate) wind: Option<Wind<D>>,
}

/// The state that a loop works on.
struct State<'a, S: Real, const D: usize> {
    /// Where points are now `[m]`.
    x: &'a mut [[S; D]],
    /// Where they were one move before `[m]`.
    old: Vec<[S; D]>,
    /// 1/m, 0 where a point is locked `[1/kg]`.
    w: &'a [S],
    /// Accelerations at the start of the step `[m/s^2]`.
    a: Vec<[S; D]>,
    obstacles: &'a Obstacles<S, D>,
}

impl<S: Real, const D: usize> State<'_, S, D> {
    fn is_free(&self, point: usize) -> bool {
        self.w[point] != S::ZERO
    }

    /// x + keep (x - x_old) + share a h^2 for all that is free.
    fn move_points(&mut self, keep: f64, (share, h): (f64, f64)) {
        let (keep, push) = (S::from_f64(keep), S::from_f64(share * h * h));
        for i in 0..self.x.len() {
            if self.is_free(i) {
                let go = add(scale(sub(self.x[i], self.old[i]), keep), scale(self.a[i], push));
                self.old[i] = self.x[i];
                self.x[i] = add(self.x[i], go);
            }
        }
    }
}

impl<S: Real, const D: usize> Printed<S, D> {
    /// Of bonds between points of a group.
    pub(crate) fn new(setup: &Setup<D>, bonds: impl Iterator<Item = Bond>, points: &Points<S, D>) -> Self {
        let Setup { source, .. } = *setup;
        let mut links: Vec<Link<S>> = bonds.map(|bond| Link::of(&bond)).collect();
        let own = match source {
            Source::Notebook | Source::NotebookGraph => Order::Shuffled,
            _ => Order::Fixed,
        };
        let order = if setup.order == Order::Auto { own } else { setup.order };
        let sweeper = Sweeper::new(order, setup.seed, &mut links, Link::ends, points.len());
        let is_stale = |(&x, &w): (&[S; D], &S)| (source == Source::Rope && w == S::ZERO).then_some(x);
        Printed {
            source,
            links,
            sweeper,
            sweeps: setup.sweeps.unwrap_or(source.sweeps()),
            last: setup.substep,
            stale: points.position.iter().zip(&points.inverse_mass).map(is_stale).collect(),
            lost: Vec::new(),
            gust: setup.wind.as_ref().filter(|_| source == Source::Segments).map(Gust::of),
        }
    }

    /// Moves of the points in a step.
    fn moves(&self) -> u32 {
        if self.source == Source::Segments { segments::MOVES } else { 1 }
    }

    /// How long the move took that led to the present state `[s]`: 004 takes the difference of places as it is, however long its next step.
    fn since(&self, h: f64) -> f64 {
        if self.source == Source::Cloth { self.last } else { h / f64::from(self.moves()) }
    }

    fn take(&mut self, points: &mut Points<S, D>, pull: &Pull<S, D>, push: Vec<[S; D]>, h: f64) {
        let Points { position, velocity, inverse_mass, .. } = points;
        if self.source.has_springs() {
            let is_relative = self.source == Source::SpringRelative;
            return spring::step((position, velocity, inverse_mass), &self.links, is_relative, (push, h));
        }
        let (since, inner) = (S::from_f64(self.since(h)), h / f64::from(self.moves()));
        let old = position.iter().zip(velocity.iter()).map(|(&x, &v)| sub(x, scale(v, since))).collect();
        let obstacles = &pull.contacts.obstacles;
        let mut state = State { x: position, old, w: inverse_mass, a: push, obstacles };
        let Printed { source, links, sweeper, sweeps, stale, .. } = self;
        let sweep = (&links[..], sweeper, *sweeps);
        match source {
            Source::Notebook => notebook::step(&mut state, sweep, h, true),
            Source::NotebookGraph => notebook::step(&mut state, sweep, h, false),
            Source::Segments => segments::step(&mut state, sweep, h),
            Source::Rope => rope::step(&mut state, sweep, h, stale),
            _ => cloth::step(&mut state, sweep, h),
        }
        let State { old, .. } = state;
        let rate = S::from_f64(1.0 / inner);
        for i in (0..position.len()).filter(|&i| inverse_mass[i] != S::ZERO) {
            velocity[i] = scale(sub(position[i], old[i]), rate);
        }
    }
}

impl<S: Real, const D: usize> Mover<S, D> for Printed<S, D> {
    fn begin(&mut self, _points: &mut Points<S, D>, _around: &Environment<D>, _t: f64) {}

    fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        _account: Option<&mut Account>,
    ) {
        let before = (points.position.clone(), points.velocity.clone());
        let mut push = vec![convert(pull.gravity); points.len()];
        if let Some((force, cursor)) = around.mouse_at(t) {
            let Points { position, inverse_mass, .. } = points;
            counters.mouse_points += mouse::push(force, cursor, None, position, inverse_mass, &mut push);
        }
        if let Some(gust) = &self.gust {
            gust.push(&mut push, (t, h));
        }
        // What is led is where it should be before all else moves.
        for i in (0..points.len()).filter(|&i| points.inverse_mass[i] == S::ZERO) {
            points.position[i] = add(points.position[i], scale(points.velocity[i], S::from_f64(h)));
        }
        self.take(points, pull, push, h);
        self.last = h;
        counters.substeps += 1;
        counters.points_moved += points.len() as u64 * u64::from(self.moves());
        counters.sweep(self.sweeps, self.links.len());
        let is_finite = |list: &[[S; D]]| list.iter().flatten().all(|x| x.is_finite());
        if !is_finite(&points.position) || !is_finite(&points.velocity) {
            (points.position, points.velocity) = before;
            self.lost.extend((0..points.len() as u32).filter(|&i| points.inverse_mass[i as usize] != S::ZERO));
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn inherit(&mut self, other: &dyn Mover<S, D>, slots: &[(u32, u32)]) {
        let Some(other) = other.any().and_then(<dyn Any>::downcast_ref::<Printed<S, D>>) else { return };
        self.last = other.last;
        for &(from, to) in slots {
            if let Some(place) = other.stale[from as usize] {
                self.stale[to as usize] = Some(place);
            }
        }
    }

    fn any(&self) -> Option<&dyn Any> {
        Some(self)
    }

    fn kernel(&self) -> Kernel {
        Kernel::Printed(self.source)
    }

    fn heap_bytes(&self) -> usize {
        self.links.capacity() * size_of::<Link<S>>() + self.stale.capacity() * size_of::<Option<[S; D]>>()
    }

    fn bonds(&self) -> usize {
        self.links.len() * self.sweeps as usize
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, D>> {
        Box::new(self.clone())
    }
}
