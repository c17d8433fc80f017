//! A group: islands that one method moves together, with their state.

mod attempt;
mod booking;
pub(crate) mod engine;
pub(crate) mod events;
pub(crate) mod grab;
pub(crate) mod guard;
mod impact;
pub(crate) mod sleep;
pub(crate) mod watch;

use super::account::Account;
use super::bulk::kernel::Kernel;
use super::contact::Contacts;
use super::counters::Counters;
use super::environment::Environment;
use super::force::form::Form;
use super::force::mouse::{self, Inside, Track};
use super::force::muscle::Driven;
use super::force::spring::Springs;
use super::moved::Moved;
use super::points::{Points, State};
use super::pull::Pull;
use super::real::Real;
use super::sizes::MOST_DIRECT;
use super::vector::{add, convert, dot, length, scale, sub, widen, zero};
pub(crate) use attempt::{MOST_EFFORT, Plain};
use booking::Cause;
use engine::Engine;
use events::edge::Edges;
use grab::Grabbed;
use guard::Guard;
use sleep::Sleep;
use watch::Watch;

/// Share of its velocity by which a point goes less far than that when a surface holds it.
const HELD: f64 = 0.02;
/// Roundings of the largest that a state may be off by which is the same.
const ROUNDED: f64 = 16.0;

/// A bond that breaks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Breakable<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    /// Square of the length at which it breaks `[m^2]`.
    pub(crate) most_square: S,
    /// Which bond of the world it is.
    pub(crate) bond: u32,
}

/// Points, what acts on them, and what moves them.
#[derive(Clone, Debug)]
pub(crate) struct Group<S: Real, const D: usize> {
    pub(crate) points: Points<S, D>,
    pub(crate) pull: Pull<S, D>,
    pub(crate) engine: Engine<S, D>,
    /// What takes what is too violent for an engine of high order.
    pub(crate) plain: Option<Plain<S, D>>,
    /// What takes substeps that neither can.
    pub(crate) robust: Option<Box<Engine<S, D>>>,
    /// Bonds that must not turn or stretch too far in a substep.
    pub(crate) guard: Guard<S>,
    pub(crate) breakable: Vec<Breakable<S>>,
    /// Lengths of bonds at which something happens, where events are located.
    pub(crate) edges: Edges<S>,
    /// Pinned points that are led along tracks.
    pub(crate) tracks: Vec<(u32, Track<D>)>,
    /// Longest substep `[s]`.
    pub(crate) substep: f64,
    /// Events are located in time.
    pub(crate) locates: bool,
    /// The state at the start of the step under way.
    pub(crate) before: State<S, D>,
    /// Accelerations, where events need them.
    pub(crate) acceleration: Vec<[S; D]>,
    pub(crate) sleep: Sleep<S, D>,
    /// Points that are led to the cursor.
    pub(crate) grabbed: Option<Grabbed<D>>,
    pub(crate) work: Work,
    /// Counted work at which the substep under way is not cut for its errors any more, and not taken back at all.
    pub(crate) patience: [u64; 2],
    /// The engine left some part of the substep under way to a more robust method.
    pub(crate) has_yielded: bool,
    /// Counted work at which the step under way is given up, as it may be where the group can be handed over.
    pub(crate) limit: u64,
    /// When the step under way was given up `[s]`.
    pub(crate) gave_up: Option<f64>,
    /// Who moves it.
    pub(crate) moved: Moved,
    /// Where it may be handed over, or was.
    pub(crate) watch: Option<Box<Watch<S, D>>>,
    /// Where a ledger is kept.
    pub(crate) account: Option<Box<Account>>,
}

/// Operations, about, of what a group does.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Work {
    /// A substep by its own method.
    pub(crate) step: u64,
    /// One by the more robust method.
    pub(crate) robust: u64,
    /// A look for events.
    pub(crate) look: u64,
    /// All substeps of a step of large bodies, where it is known beforehand how many there are; else 0.
    pub(crate) batch: u64,
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Makes the start fit the bonds and the surfaces: rigid bonds get their lengths, points outside come back.
    ///
    /// Returns whether rigid bonds could be held.
    pub(crate) fn begin(&mut self, around: &Environment<D>, t: f64) -> bool {
        self.lead_pins(t, 0.0);
        if let Engine::Bulk(bulk) = &mut self.engine {
            bulk.begin(&mut self.points, around, t);
            return true;
        }
        let mut counters = Counters::default();
        let mut is_held = self.pull.project(&mut self.points, &mut counters);
        if let Engine::KickDrift(method, _) = &mut self.engine {
            // Of a large mesh sweeps may only be slow: nothing says that its lengths contradict each other.
            is_held &= method.hold_start(&mut self.points) || method.swept.rigid.len() > MOST_DIRECT;
        }
        self.mark_inside(around, t);
        self.points.save(&mut self.before);
        self.meet_start(around, t, &mut counters);
        self.begin_edges(around, t, &mut counters);
        is_held
    }

    /// Goes on at time `t` `[s]` from a state in the middle of a run, as [`Group::begin`]; bonds of large bodies keep the strain that
    /// they have.
    pub(crate) fn resume(&mut self, around: &Environment<D>, t: f64) -> bool {
        if let Engine::Bulk(bulk) = &mut self.engine {
            if bulk.kernel().is_of_rigid_bodies() {
                bulk.begin(&mut self.points, around, t);
            }
            self.lead_pins(t, 0.0);
            return true;
        }
        self.beyond_rounding(|group| group.begin(around, t))
    }

    /// What makes the state fit its bonds, but for rounding: one that fits stays to the bit.
    pub(crate) fn beyond_rounding<T>(&mut self, change: impl FnOnce(&mut Self) -> T) -> T {
        let mut kept = State::default();
        self.points.save(&mut kept);
        let out = change(self);
        if self.is_as(&kept) {
            self.points.restore(&kept);
            self.engine.refresh();
        }
        out
    }

    /// Whether places and velocities are those of a state but for rounding.
    fn is_as(&self, kept: &State<S, D>) -> bool {
        let is_near = |list: &[[S; D]], others: &[[S; D]]| {
            let most = others.iter().fold(S::ZERO, |most, &x| most.max(dot(x, x)));
            let rounding = S::EPSILON * S::EPSILON * S::from_f64(ROUNDED * ROUNDED) * most;
            list.iter().zip(others).all(|(&x, &other)| dot(sub(x, other), sub(x, other)) <= rounding)
        };
        is_near(&self.points.position, &kept.position) && is_near(&self.points.velocity, &kept.velocity)
    }

    /// A bond between two of its points, of this rest length `[m]` and this number in the world, goes. Returns whether that was so: only
    /// large bodies can leave its lane idle.
    pub(crate) fn lose(&mut self, ends: [u32; 2], rest: f64, bond: u32) -> bool {
        let Engine::Bulk(bulk) = &mut self.engine else { return false };
        let is_lost = bulk.lose(ends, rest);
        if is_lost {
            self.breakable.retain(|breakable| breakable.bond != bond);
            self.account.iter_mut().for_each(|account| account.lose(ends, rest));
            self.wake();
        }
        is_lost
    }

    /// Pinned points go along their tracks: their velocity is the slope of the stretch that begins at `t`. One that may not be led so
    /// fast lags, and is on its way to where it should be `h` later.
    ///
    /// Rigid bonds to a pin that changes its velocity pass that on at once.
    pub(crate) fn lead_pins(&mut self, t: f64, h: f64) {
        let mut changed = false;
        for (point, track) in &self.tracks {
            let i = *point as usize;
            if let Some(lag) = self.lag(*point, track, (t, h)) {
                self.points.velocity[i] = lag;
                continue;
            }
            let slope: [S; D] = convert(track.slope(t));
            changed |= slope != self.points.velocity[i];
            self.points.velocity[i] = slope;
            if let Some(place) = track.at(t) {
                self.points.position[i] = convert(place);
                if let Some(lost) = self.points.position_lost.get_mut(i) {
                    *lost = zero();
                }
            }
        }
        if let Engine::Bulk(bulk) = &mut self.engine
            && !self.tracks.is_empty()
        {
            bulk.reload();
        } else if changed {
            let before = self.energy_if_kept();
            self.hold_velocity();
            self.book_change(before, Cause::Pins);
            self.engine.refresh();
        }
    }

    /// The velocity of a pin that is too far from where its track is at `t`, or would have to be too fast to be there `h` later.
    fn lag(&self, point: u32, track: &Track<D>, (t, h): (f64, f64)) -> Option<[S; D]> {
        // Share of the way that it may be led in a frame within which it is where it should be.
        const NEAR: f64 = 1e-6;
        let Engine::Bulk(bulk) = &self.engine else { return None };
        let most = bulk.most_lead(point)?;
        let (now, soon) = (track.at(t)?, track.at(t + h)?);
        let place = widen(self.points.position[point as usize]);
        if h == 0.0 {
            // At the start of a scene it is where its track begins; a world that goes on left it where it is.
            return (t > 0.0 && length(sub(now, place)) > NEAR * most).then_some(zero());
        }
        let way = sub(soon, place);
        let speed = length(way) / h;
        let is_late = length(sub(now, place)) > NEAR * most || length(track.slope(t)) > most;
        is_late.then(|| convert(scale(way, if speed > most { most / (speed * h) } else { 1.0 / h })))
    }

    /// A group without points, whose place is free.
    pub(crate) fn emptied(&self) -> Self {
        let mut pull = self.pull.clone();
        (pull.springs, pull.rigid, pull.inside) = (Springs::none(), None, None);
        pull.form = Form::none();
        pull.contacts = Contacts::new(&pull.contacts.obstacles, 0);
        (pull.led, pull.is_grabbed) = (Vec::new(), false);
        pull.thrusts.clear();
        pull.driven = Driven::none();
        Group {
            points: Points::new(State::default(), Vec::new()),
            pull,
            engine: Engine::Projected,
            plain: None,
            robust: None,
            guard: Guard { bonds: Vec::new(), follows_turns: false },
            breakable: Vec::new(),
            edges: Edges::none(),
            tracks: Vec::new(),
            substep: self.substep,
            locates: false,
            before: State::default(),
            acceleration: Vec::new(),
            sleep: Sleep::default(),
            grabbed: None,
            work: Work::default(),
            patience: [0; 2],
            has_yielded: false,
            limit: u64::MAX,
            gave_up: None,
            moved: Moved::default(),
            watch: None,
            account: None,
        }
    }

    /// What large bodies are made of and how their bonds are taken.
    pub(crate) fn kernel(&self) -> Option<Kernel> {
        if let Engine::Bulk(bulk) = &self.engine { Some(bulk.kernel()) } else { None }
    }

    /// Bytes that points, bonds that are watched, and large bodies take; what solvers of small bodies keep is estimated.
    pub(crate) fn heap_bytes(&self) -> usize {
        // Springs, rigid bonds, stages and factors, as measured on a rim of 24 points.
        const OF_A_SMALL_POINT: usize = 1_500;

        let before = &self.before;
        let lists =
            [&before.position, &before.velocity, &before.position_lost, &before.velocity_lost, &self.acceleration];
        let state: usize = lists.map(|list| list.capacity() * size_of::<[S; D]>()).iter().sum();
        let solver = match &self.engine {
            Engine::Bulk(bulk) => bulk.heap_bytes(),
            _ => OF_A_SMALL_POINT * self.points.len(),
        };
        let watch = self.watch.as_ref().map_or(0, |watch| watch.heap_bytes());
        size_of::<Self>() + watch + self.points.heap_bytes() + state + self.guard.heap_bytes() + solver
    }

    /// Velocities of large bodies are half a substep behind: brings them to the time of the positions, as the mean of those
    /// before and after it. A point that a surface holds goes as far as it gets: each substep gives it a velocity into the surface, and takes it.
    pub(crate) fn centre_velocity(&mut self, around: &Environment<D>, t: f64) {
        if self.is_asleep() {
            return;
        }
        let Group { points, pull, engine: Engine::Bulk(bulk), .. } = self else { return };
        let h = 2.0 * bulk.lag();
        if h == 0.0 {
            return;
        }
        let (position, before) = (points.position.clone(), points.velocity.clone());
        bulk.step(points, pull, around, (t, h), &mut Counters::default(), None);
        let ends = std::mem::replace(&mut points.position, position);
        bulk.reload();
        let (rate, has_surfaces) = (S::from_f64(1.0 / h), pull.contacts.has_surfaces());
        for (((v, before), from), to) in points.velocity.iter_mut().zip(before).zip(&points.position).zip(ends) {
            let gone = scale(sub(to, *from), rate);
            let (held, share) = (sub(*v, gone), S::from_f64(HELD));
            let is_held = has_surfaces && dot(held, held) > share * share * dot(*v, *v);
            *v = if is_held { gone } else { scale(add(*v, before), S::HALF) };
        }
    }

    /// Takes from the velocities what would change the length of rigid bonds.
    pub(crate) fn hold_velocity(&mut self) {
        if self.has_strings() {
            return self.jerk();
        }
        let Group { points, pull, engine, .. } = self;
        if let Some(rigid) = &mut pull.rigid {
            rigid.make_ready(points, &pull.contacts);
            rigid.project_velocity(points, &pull.contacts);
            engine.refresh();
        } else if let Engine::KickDrift(method, _) = engine {
            method.hold_velocity(points, pull);
        }
    }

    /// Decides anew which points are inside the mouse region: at the start, and when the cursor is moved from outside.
    pub(crate) fn mark_inside(&mut self, around: &Environment<D>, t: f64) {
        self.pull.inside = match around.mouse_at(t) {
            Some((force, cursor)) if self.locates => {
                let depth_of = mouse::gauge(force, cursor);
                let is_inside = |&x: &[S; D]| depth_of(x) > 0.0;
                Some(Inside::new(self.points.position.iter().map(is_inside).collect()))
            }
            _ => None,
        };
        self.engine.refresh();
    }

    /// Bonds that broke or are longer than they may be, by their numbers in the world.
    pub(crate) fn torn(&self) -> impl Iterator<Item = u32> {
        let overstretched = self.breakable.iter().filter_map(|bond| {
            let d = sub(self.points.position[bond.a as usize], self.points.position[bond.b as usize]);
            (dot(d, d) > bond.most_square).then_some(bond.bond)
        });
        self.edges.broken.iter().flat_map(|broken| broken.bonds.iter().copied()).chain(overstretched)
    }
}
