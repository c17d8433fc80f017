//! What is watched of a group that may be handed over to the live step, or was: what its frames cost, and whether its own method
//! keeps energy, holds bonds and stays among the numbers.
//!
//! Looks read and change nothing. They are taken at the ends of frames, as often as their cost is a small share of what the group's
//! own steps cost, and only of groups that something may go wrong with: where there are walls, a mouse, led pins or rigid bonds.

use std::sync::Arc;

use super::Group;
use super::engine::Engine;
use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::bulk::control::FRAME;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::bulk::mover::Mover;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::force::{area, mouse};
use crate::sim::ledger::{Book, MOST_GAIN};
use crate::sim::measure;
use crate::sim::points::{Points, State};
use crate::sim::real::Real;
use crate::sim::timeline::frame_of;
use crate::sim::vector::{add, dot, length, scale, sub, widen, zero};

/// Roundings that the energy of a point gathers until it is seen.
const ROUNDINGS: f64 = 256.0;
/// Roundings of a position that a bond's length is off by.
const OF_A_LENGTH: f64 = 4.0;
/// Share of what may be gained from which on a group is handed over: what is looked at once in some frames goes on rising until then.
const ALARMING: f64 = 0.7;
/// Share of the largest energy from which on a gain is not taken out of velocities any more: the group goes back to before it.
const LARGE_GAIN: f64 = 0.1;
/// Strain that no rigid bond may have `[1]`, and one from which on nothing is mended any more: the group goes back to before it.
const MOST_STRAIN: f64 = 0.1;
const LARGE_STRAIN: f64 = 0.5;
/// Substeps between two looks that may go to a more robust method.
const MOST_FALLBACKS: u64 = 8;
/// Looks in a row that a large body has to fail at: its velocities are means over substeps, and its strain swings.
const DOUBTED: u32 = 3;
/// Share of what a group's steps cost that looks at it may cost, inverse.
const COST_SHARE: u64 = 100;
/// Most frames between two looks.
const MOST_FRAMES: u64 = 4;
/// Speed below which a gain of energy is nothing that anybody sees `[m/s]`.
const UNSEEN: f64 = 0.01;
/// Points of a group whose state is kept at the end of every frame, in case that it leaves the numbers; of more points every so many
/// frames.
const FEW: usize = 10_000;
const RARELY: u64 = 8;
/// How long a triangle may be inside out before that is not left to its springs any more `[s]`.
const MOST_FOLDED: f64 = 0.1;
/// Operations of a look for each bond, each point and each triangle.
const OF_A_LOOK: u64 = 10;

/// What went wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Alarm {
    /// Energy came from nowhere: there should be no more than this `[J]`. `is_large`: there is far more.
    Gain { most: f64, is_large: bool },
    /// Rigid bonds do not hold; `is_large`: they are far from it.
    Strain { is_large: bool },
    /// Substeps do not converge.
    Stuck,
    /// Triangles stay inside out.
    Folded,
    /// Positions or velocities are no numbers.
    NotFinite,
}

/// What is watched of a group.
#[derive(Clone, Debug)]
pub(crate) struct Watch<S: Real, const D: usize> {
    /// Points that can move, bonds and triangles.
    pub(crate) size: [usize; 3],
    /// Mean rest length of its bonds `[m]`; 0 without any.
    pub(crate) edge: f64,
    /// Whether it may be handed over at all.
    pub(crate) may_go: bool,
    /// The frame in which it stepped last.
    frame: u64,
    /// Counted work of its steps that ended in that.
    spent: u64,
    /// `None`: nothing but that it leaves the numbers can go wrong.
    eyes: Option<Eyes<S, D>>,
    /// Looks whether it comes near itself; `None`: it does not matter.
    scout: Option<Box<dyn Mover<S, D>>>,
    /// Where there are no eyes: a state among the numbers.
    good: Option<Anchor<S, D>>,
}

/// What is looked at.
#[derive(Clone, Debug)]
struct Eyes<S, const D: usize> {
    /// Springs, and rigid bonds with an infinite stiffness, between places in the group.
    links: Arc<[Link]>,
    /// Corners of triangles, anticlockwise, and since when one of them is inside out `[s]`.
    triangles: Arc<[[u32; 3]]>,
    folded: Option<f64>,
    /// Energy is kept, but for what is known to come and go.
    keeps_energy: bool,
    /// Energy at the first look, less works until then; `None`: there was none yet `[J]`.
    start: Option<f64>,
    /// What a grab did since then `[J]`.
    work: f64,
    /// The largest kinetic and elastic energy so far, at least what free fall brings in a frame, or what is too slow to be seen `[J]`.
    most: f64,
    /// Pins were led or the mouse was in reach since the last look: nobody knows what they did.
    is_led: bool,
    /// Looks in a row that were bad.
    bad: u32,
    /// Counted work and fallbacks since the last look, and its frame.
    since: u64,
    fallbacks: u64,
    looked: u64,
    /// The state at the last look that was good.
    anchor: Option<Anchor<S, D>>,
}

/// A state that a group can go back to.
#[derive(Clone, Debug)]
pub(crate) struct Anchor<S, const D: usize> {
    /// When `[s]`.
    pub(crate) time: f64,
    state: State<S, D>,
    book: Option<Book>,
}

/// A bond that energy or strain is looked at of.
#[derive(Clone, Copy, Debug)]
struct Link {
    a: u32,
    b: u32,
    rest: f64,
    /// `[N/m]`; infinite: rigid.
    stiffness: f64,
    limit: Limit,
}

/// Kinetic, elastic and gravity's energy `[J]`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    pub(crate) kinetic: f64,
    pub(crate) elastic: f64,
    gravity: f64,
    /// What free fall from rest brings in a frame, or what is too slow to be seen.
    fall: f64,
    /// By how much they may be off by rounding.
    pub(crate) rounding: f64,
    /// The largest strain of a rigid bond `[1]`.
    pub(crate) strain: f64,
}

impl<S: Real, const D: usize> Watch<S, D> {
    /// Of a group with so many points that can move, and these bonds and triangles; `has_eyes` where something may go wrong, `keeps_energy` where nothing but mouse, pins and grab brings any.
    pub(crate) fn new(
        points: usize,
        (bonds, triangles): (&[Bond], &[[u32; 3]]),
        may_go: bool,
        (has_eyes, keeps_energy): (bool, bool),
    ) -> Self {
        let links = || bonds.iter().filter_map(Link::of).collect();
        let total: f64 = bonds.iter().map(|bond| bond.rest_length).sum();
        let eyes = has_eyes.then(|| Eyes {
            links: links(),
            triangles: triangles.into(),
            folded: None,
            keeps_energy,
            start: None,
            work: 0.0,
            most: 0.0,
            is_led: false,
            bad: 0,
            since: 0,
            fallbacks: 0,
            looked: 0,
            anchor: None,
        });
        let edge = if bonds.is_empty() { 0.0 } else { total / bonds.len() as f64 };
        Watch {
            size: [points, bonds.len(), triangles.len()],
            edge,
            may_go,
            frame: 0,
            spent: 0,
            eyes,
            scout: None,
            good: None,
        }
    }

    /// With what looks whether it comes near itself.
    pub(crate) fn with_scout(self, scout: Option<Box<dyn Mover<S, D>>>) -> Self {
        Watch { scout, ..self }
    }

    /// Counted work of its steps that ended in a frame.
    pub(crate) fn spent_in(&self, frame: u64) -> u64 {
        if self.frame == frame { self.spent } else { 0 }
    }

    /// The energy that the group may have now `[J]`, where that is known.
    pub(crate) fn most_energy(&self) -> Option<f64> {
        let eyes = self.eyes.as_ref().filter(|eyes| eyes.keeps_energy && !eyes.is_led)?;
        Some(eyes.start? + eyes.work + MOST_GAIN * eyes.most)
    }

    /// Bytes that it takes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let anchor = self.good.as_ref().or(self.eyes.as_ref().and_then(|eyes| eyes.anchor.as_ref()));
        let vectors: usize = anchor.map_or(0, |anchor| {
            let State { position, velocity, position_lost, velocity_lost } = &anchor.state;
            [position, velocity, position_lost, velocity_lost].map(Vec::capacity).iter().sum()
        });
        let links = self.eyes.as_ref().map_or(0, |eyes| eyes.links.len());
        let corners = 3 * self.eyes.as_ref().map_or(0, |eyes| eyes.triangles.len());
        size_of::<Self>() + links * size_of::<Link>() + 4 * corners + vectors * size_of::<[S; D]>()
    }
}

impl Alarm {
    /// Whether the state is past mending: an earlier one has to be gone back to.
    pub(crate) fn is_lost(self) -> bool {
        matches!(self, Alarm::NotFinite | Alarm::Gain { is_large: true, .. } | Alarm::Strain { is_large: true })
    }
}

impl Link {
    fn of(bond: &Bond) -> Option<Self> {
        let stiffness = match bond.kind {
            BondKind::Spring { stiffness, .. } => stiffness,
            // That of one with a drive goes where that leads it.
            BondKind::Rigid if bond.rest_length > 0.0 && bond.drive.is_none() => f64::INFINITY,
            _ => return None,
        };
        Some(Link { a: bond.a.0, b: bond.b.0, rest: bond.rest_length, stiffness, limit: bond.limit })
    }
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Whether the live step moves it.
    pub(crate) fn is_live(&self) -> bool {
        self.moved.is_handed_over()
    }

    /// Whether it may meet itself within `h` `[s]`, where that matters.
    pub(crate) fn meets_itself(&mut self, h: f64) -> bool {
        let scout = self.watch.as_mut().and_then(|watch| watch.scout.as_mut());
        scout.is_some_and(|scout| scout.may_meet_itself(&self.points, h))
    }

    /// It is about to step from `t` on `[s]`: its first look is taken, and where it is noted that the mouse is in reach.
    pub(crate) fn watch_start(&mut self, around: &Environment<D>, t: f64) {
        let Some(mut watch) = self.watch.take() else { return };
        if let Some(eyes) = &mut watch.eyes {
            if eyes.start.is_none() {
                let sums = self.sums(&eyes.links, around);
                (eyes.start, eyes.most) = (Some(sums.total()), sums.most());
                eyes.looked = frame_of(t);
                self.keep_anchor(eyes, t);
            }
            eyes.is_led = eyes.is_led || (eyes.keeps_energy && self.is_reached(around, t));
        } else if watch.good.is_none() && !self.keeps_itself() {
            watch.good = Some(self.anchor(None, t));
        }
        self.watch = Some(watch);
    }

    /// It stepped for `h` from `t` `[s]`, which took this counted work and these fallbacks.
    pub(crate) fn watch_end(&mut self, around: &Environment<D>, (t, h): (f64, f64), (work, fallbacks): (u64, u64)) {
        let Some(mut watch) = self.watch.take() else { return };
        let frame = frame_of(t + h);
        watch.spent = watch.spent_in(frame) + work;
        watch.frame = frame;
        if let Some(eyes) = &mut watch.eyes {
            eyes.since += work;
            eyes.fallbacks += fallbacks;
            let is_led = || self.tracks.iter().any(|(_, track)| track.moves_after(t));
            eyes.is_led = eyes.is_led || (eyes.keeps_energy && (is_led() || self.is_reached(around, t + h)));
        }
        self.watch = Some(watch);
    }

    /// A grab gave points this energy `[J]`.
    pub(crate) fn watch_grab(&mut self, work: f64) {
        if let Some(eyes) = self.watch.as_mut().and_then(|watch| watch.eyes.as_mut()) {
            eyes.work += work;
        }
    }

    /// Whether the mouse is in reach: what it does to a body that it just enters is a large share of all the energy there is.
    fn is_reached(&self, around: &Environment<D>, t: f64) -> bool {
        around.mouse_at(t).is_some_and(|(force, cursor)| mouse::reaches(&self.points, force, cursor))
    }

    /// Looks whether something is wrong, after the step that ends a frame at `t` `[s]`, if it is time to.
    pub(crate) fn look(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) -> Option<Alarm> {
        let mut watch = self.watch.take()?;
        let alarm = watch.eyes.as_mut().and_then(|eyes| self.look_by(eyes, around, t, counters));
        self.watch = Some(watch);
        alarm
    }

    fn look_by(
        &self,
        eyes: &mut Eyes<S, D>,
        around: &Environment<D>,
        t: f64,
        counters: &mut Counters,
    ) -> Option<Alarm> {
        let cost = OF_A_LOOK * (eyes.links.len() + self.points.len() + eyes.triangles.len()) as u64;
        let frame = frame_of(t);
        if eyes.bad == 0 && eyes.since < COST_SHARE * cost && frame < eyes.looked + MOST_FRAMES {
            return None;
        }
        counters.work += cost;
        let fallbacks = std::mem::take(&mut eyes.fallbacks);
        (eyes.since, eyes.looked) = (0, frame);
        let sums = self.sums(&eyes.links, around);
        let total = sums.total();
        if !total.is_finite() {
            return Some(Alarm::NotFinite);
        }
        eyes.most = eyes.most.max(sums.most());
        let start = match eyes.start {
            Some(start) if !std::mem::take(&mut eyes.is_led) => start,
            _ => *eyes.start.insert(total - eyes.work),
        };
        let is_folded = eyes.triangles.iter().any(|corners| self.is_inside_out(corners));
        eyes.folded = eyes.folded.or(Some(t)).filter(|_| is_folded);
        let doubt = sums.rounding;
        let allowed = ALARMING * MOST_GAIN * eyes.most + doubt;
        let excess = total - start - eyes.work;
        let is_doubtful = matches!(self.engine, Engine::Bulk(_));
        let is_large = excess > LARGE_GAIN * eyes.most + doubt;
        let gains = eyes.keeps_energy && !self.is_live() && excess > allowed;
        let alarm = match () {
            () if gains => Some(Alarm::Gain { most: start + eyes.work, is_large }),
            () if sums.strain > MOST_STRAIN => Some(Alarm::Strain { is_large: sums.strain > LARGE_STRAIN }),
            () if fallbacks > MOST_FALLBACKS => Some(Alarm::Stuck),
            () if eyes.folded.is_some_and(|since| t - since >= MOST_FOLDED) => Some(Alarm::Folded),
            () => None,
        };
        eyes.bad = if alarm.is_some() { eyes.bad + 1 } else { 0 };
        if alarm.is_none() {
            self.keep_anchor(eyes, t);
        }
        let is_sure = !is_doubtful || alarm.is_some_and(Alarm::is_lost) || eyes.bad >= DOUBTED;
        alarm.filter(|_| is_sure)
    }

    fn is_inside_out(&self, corners: &[u32; 3]) -> bool {
        area::size(corners.map(|corner| self.points.position[corner as usize])) < S::ZERO
    }

    fn keep_anchor(&self, eyes: &mut Eyes<S, D>, t: f64) {
        eyes.anchor = Some(self.anchor(eyes.anchor.take(), t));
    }

    /// Whether its mover leaves bodies that left the numbers where its step began.
    fn keeps_itself(&self) -> bool {
        self.kernel().is_some_and(|kernel| matches!(kernel, Kernel::Live) || kernel.is_of_rigid_bodies())
    }

    /// The state now, in the memory of an older one.
    fn anchor(&self, old: Option<Anchor<S, D>>, t: f64) -> Anchor<S, D> {
        let mut state = old.map_or_else(State::default, |anchor| anchor.state);
        self.points.save(&mut state);
        Anchor { time: t, state, book: self.account.as_ref().map(|account| account.book) }
    }

    /// It is among the numbers after a step, which `ends_frame`: where nothing else is looked at, that is what it goes back to.
    pub(crate) fn keep_good(&mut self, ends_frame: bool, t: f64) {
        let is_due = ends_frame && (self.points.len() <= FEW || frame_of(t).is_multiple_of(RARELY));
        let Some(mut watch) = self.watch.take() else { return };
        if is_due && watch.eyes.is_none() && !self.keeps_itself() {
            watch.good = Some(self.anchor(watch.good.take(), t));
        }
        self.watch = Some(watch);
    }

    /// Takes the state out that was the last good one.
    pub(crate) fn take_anchor(&mut self) -> Option<Anchor<S, D>> {
        let watch = self.watch.as_mut()?;
        watch.good.take().or_else(|| watch.eyes.as_mut()?.anchor.take())
    }

    /// Goes back to a state. Returns when that was `[s]`.
    pub(crate) fn go_back(&mut self, anchor: &Anchor<S, D>) -> f64 {
        self.points.restore(&anchor.state);
        if let (Some(account), Some(book)) = (&mut self.account, anchor.book) {
            account.book = book;
        }
        if let Engine::Bulk(bulk) = &mut self.engine {
            bulk.reload();
        }
        self.engine.refresh();
        anchor.time
    }

    /// Whether every position and velocity is a finite number.
    pub(crate) fn is_finite(&self) -> bool {
        (0..self.points.len()).all(|slot| self.is_finite_at(slot))
    }

    /// The same of a point, their squares included: nothing can be worked out of what is so large.
    pub(crate) fn is_finite_at(&self, slot: usize) -> bool {
        measure::is_among_numbers(self.points.position[slot], self.points.velocity[slot])
    }

    /// Some of its points go back to where they were in a state, at rest.
    pub(crate) fn put_back(&mut self, anchor: &Anchor<S, D>, slots: &[usize]) {
        for &slot in slots {
            self.points.position[slot] = anchor.state.position[slot];
            self.points.velocity[slot] = zero();
        }
        if let Engine::Bulk(bulk) = &mut self.engine {
            bulk.reload();
        }
        self.engine.refresh();
    }

    /// Takes `excess` `[J]` out of the velocities: about their mean, whose momentum stays, where nothing holds or stops the points.
    pub(crate) fn slow_down(&mut self, excess: f64) {
        let Group { points, tracks, pull, .. } = self;
        let is_held =
            !tracks.is_empty() || !pull.contacts.obstacles.is_empty() || points.inverse_mass.contains(&S::ZERO);
        let (mut momentum, mut mass, mut kinetic) = ([0.0; D], 0.0, 0.0);
        for (&v, &w) in points.velocity.iter().zip(&points.inverse_mass).filter(|(_, w)| **w != S::ZERO) {
            let (v, m) = (widen(v), 1.0 / w.to_f64());
            (momentum, mass, kinetic) = (add(momentum, scale(v, m)), mass + m, kinetic + 0.5 * m * dot(v, v));
        }
        let mean = if is_held || mass == 0.0 { [0.0; D] } else { scale(momentum, 1.0 / mass) };
        let own = kinetic - 0.5 * mass * dot(mean, mean);
        if own <= 0.0 {
            return;
        }
        let kept = (1.0 - excess / own).max(0.0).sqrt();
        for (v, _) in points.velocity.iter_mut().zip(&points.inverse_mass).filter(|(_, w)| **w != S::ZERO) {
            *v = add(mean, scale(sub(widen(*v), mean), kept)).map(S::from_f64);
        }
        if let Engine::Bulk(bulk) = &mut self.engine {
            bulk.reload();
        }
        self.engine.refresh();
    }

    /// Its energy, and the largest strain of its rigid bonds; 0 of what is not watched.
    pub(crate) fn energy_and_strain(&self, around: &Environment<D>) -> Sums {
        let eyes = self.watch.as_ref().and_then(|watch| watch.eyes.as_ref());
        eyes.map_or_else(Sums::default, |eyes| self.sums(&eyes.links, around))
    }

    fn sums(&self, links: &[Link], around: &Environment<D>) -> Sums {
        let Points { position: x, velocity: v, inverse_mass: w, .. } = &self.points;
        let mut sums = Sums::default();
        let (eps, pull) = (S::EPSILON.to_f64(), length(around.gravity));
        for i in (0..x.len()).filter(|&i| w[i] != S::ZERO) {
            let (mass, velocity) = (1.0 / w[i].to_f64(), widen(v[i]));
            sums.kinetic += 0.5 * mass * dot(velocity, velocity);
            sums.gravity -= mass * dot(around.gravity, widen(x[i]));
            let speed = UNSEEN.max(pull * FRAME);
            sums.fall += 0.5 * mass * speed * speed;
            // Parts above and below cancel in the sum; their roundings do not.
            sums.rounding += ROUNDINGS * eps * mass * (0.5 * dot(velocity, velocity) + pull * length(widen(x[i])));
        }
        for link in links {
            let (a, b) = (link.a as usize, link.b as usize);
            let stretch = length(widen(sub(x[a], x[b]))) - link.rest;
            let acts = match link.limit {
                Limit::Both => true,
                Limit::Max => stretch > 0.0,
                Limit::Min => stretch < 0.0,
            };
            if !acts {
                continue;
            }
            if link.stiffness.is_finite() {
                let off = OF_A_LENGTH * eps * (length(widen(x[a])) + length(widen(x[b])));
                sums.elastic += 0.5 * link.stiffness * stretch * stretch;
                sums.rounding += link.stiffness * (off * (stretch.abs() + off) + ROUNDINGS * eps * stretch * stretch);
            } else if w[a] + w[b] > S::ZERO {
                sums.strain = sums.strain.max((stretch / link.rest).abs());
            }
        }
        sums
    }
}

impl Sums {
    pub(crate) fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.gravity
    }

    /// What a gain is measured by: 1 % of almost nothing would be noise.
    fn most(&self) -> f64 {
        (self.kinetic + self.elastic).max(self.fall)
    }
}
