//! Bodies that may touch each other within a step: their state, side by side, and what is near what.

use super::body::{Bodies, Body};
use super::bonds::Held;
use super::obstacle::Solid;
use super::pair::{Pair, Sides};
use super::patches::Patches;
use super::touch::Touch;
use crate::sim::contact::skin::Contact;
use crate::sim::contact::surface::Surface;
use crate::sim::kernels::links::Turned;
use crate::sim::live::given::Given;
use crate::sim::live::substep::PUSHED;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Bodies that go together, in lists of their own: nothing else is read or written while they move.
///
/// Shapes: one entry a point, body after body.
#[derive(Clone, Debug)]
pub(super) struct Cluster<S: Real> {
    /// Which bodies, ascending.
    pub(super) bodies: Vec<usize>,
    /// Where the points of each begin here; one more entry at the end.
    pub(super) bases: Vec<u32>,
    /// Which of its bodies are torn at.
    pub(super) torn: Vec<bool>,
    /// Which of its bodies touched something in the last step.
    pub(super) touched: Vec<bool>,
    /// Positions at the start of the substep `[m]`.
    pub(super) start: Vec<[S; 3]>,
    /// Positions as far as the substep is solved `[m]`.
    pub(super) now: Vec<[S; 3]>,
    /// From one to the other `[m]`: exact where the difference of both is not.
    pub(super) way: Vec<[S; 3]>,
    /// What the velocities are to be changed by beyond what the way says, times the substep `[m]`: see [`Turned`].
    pub(super) turned: Vec<[S; 3]>,
    pub(super) velocity: Vec<[S; 3]>,
    /// What rounding has taken from positions `[m]`.
    pub(super) lost: Vec<[S; 3]>,
    pub(super) w: Vec<S>,
    /// What constant forces give every point `[m/s^2]`; empty without any.
    pub(super) thrust: Vec<[S; 3]>,
    /// Which of its bodies every point is of.
    pub(super) body_of: Vec<u32>,
    /// Triangles of skins, corners counted here; number for ever; body.
    pub(super) triangles: Vec<([u32; 3], u32, u32)>,
    pub(super) edges: Vec<[u32; 2]>,
    /// Points of skins: place here, and number for ever.
    pub(super) corners: Vec<(u32, u32)>,
    /// Bonds that are projected.
    pub(super) held: Held<S>,
    /// Points near triangles.
    pub(super) pairs: Vec<Pair<S>>,
    /// How far the two of each were from touching when they were found `[m]`.
    pub(super) rooms: Vec<S>,
    /// Which of them may touch in this substep.
    pub(super) chosen: Vec<u32>,
    /// What is near planes, balls and boxes, how far it was from touching when it was found `[m]`, and which may touch in this substep.
    pub(super) touches: Vec<Touch<S>>,
    pub(super) touch_rooms: Vec<S>,
    pub(super) near: Vec<u32>,
    /// How far every point may go until what is near obstacles is looked for anew `[m]`, and how far it has gone since.
    pub(super) promised_far: Vec<S>,
    pub(super) gone_far: Vec<S>,
    /// What goes together, for what is near each other.
    pub(super) patches: Patches<S>,
    /// The same of each point against its patch; how far it gets by the end of this substep, and within it.
    pub(super) promised: Vec<S>,
    pub(super) gone_apart: Vec<S>,
    pub(super) goes: Vec<S>,
    pub(super) ways: Vec<S>,
    /// The least of what is promised `[m]`.
    pub(super) least_promise: S,
    /// Substeps of a frame that there is work for.
    pub(super) most_substeps: u32,
    /// How long a substep is `[s]`.
    pub(super) span: S,
    /// Something pressed something in this step.
    pub(super) has_pressed: bool,
    /// Work that the mouse did in this step `[J]`.
    pub(super) work: S,
    /// What mouse, forces and wind gave to its points in this substep.
    pub(super) given: Given<S, 3>,
    pub(super) counts: Counts,
}

/// What a cluster did in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) substeps: u64,
    pub(super) points: u64,
    pub(super) bonds: u64,
    pub(super) contacts: u64,
    pub(super) truncations: u64,
    pub(super) guarded: u64,
    pub(super) mouse_points: u64,
    pub(super) detections: u64,
    pub(super) work: u64,
}

/// What all clusters share.
pub(super) struct Common<'a, S: Real> {
    pub(super) bodies: &'a Bodies<S>,
    pub(super) solids: &'a [Solid<S>],
    pub(super) contact: Option<&'a Contact>,
    pub(super) planes: &'a [Surface<S, 3>],
    /// Sides that points had of triangles, from before.
    pub(super) sides: &'a Sides,
}

impl<S: Real> Cluster<S> {
    /// Its bodies with the places at which their points begin.
    pub(super) fn members<'a>(
        &self,
        common: &Common<'a, S>,
    ) -> impl Iterator<Item = (&'a Body<S>, usize)> + use<'a, S> {
        let list = &common.bodies.list;
        let pairs: Vec<(usize, usize)> =
            self.bodies.iter().zip(&self.bases).map(|(&body, &base)| (body, base as usize)).collect();
        pairs.into_iter().map(move |(body, base)| (&list[body], base))
    }

    /// Whether its points are among the finite numbers, their squares included.
    pub(super) fn is_finite(&self) -> bool {
        self.lost().next().is_none()
    }

    /// The bodies of which this is not so.
    pub(super) fn lost(&self) -> impl Iterator<Item = usize> {
        super::super::lost((&self.bodies, &self.bases), (&self.now, &self.velocity))
    }

    /// A point goes further.
    #[inline(always)]
    pub(super) fn shift(&mut self, i: usize, by: [S; 3]) {
        self.now[i] = add(self.now[i], by);
        self.way[i] = add(self.way[i], by);
    }

    /// A bond moves its ends a and b by -w_a `push` and w_b `push`.
    #[inline(always)]
    pub(super) fn turn(&mut self, [a, b]: [usize; 2], push: [S; 3]) {
        let Cluster { start, turned, w, .. } = self;
        Turned { start, turned }.note([a, b], [w[a], w[b]], push);
    }

    /// A point is put elsewhere without speed.
    #[inline(always)]
    pub(super) fn put(&mut self, i: usize, by: [S; 3]) {
        self.now[i] = add(self.now[i], by);
        self.start[i] = add(self.start[i], by);
        let way = dot(by, by).sqrt();
        self.gone_apart[i] += way;
        self.gone_far[i] += way;
    }

    /// How far contacts may push a point beyond its way within a substep `[m]` without having been seen to push it.
    pub(super) fn pushed(&self) -> S {
        self.least_promise * S::from_f64(PUSHED)
    }

    /// How far bonds and contacts may lead a point beyond its way within a substep `[m]`: as far as the fastest goes, against all others where
    /// there is no obstacle.
    pub(super) fn led(&self) -> S {
        let fastest = match self.touches.is_empty() {
            false => self.fastest(),
            true => {
                let sum = self.velocity.iter().fold(zero(), |sum, &v| add(sum, v));
                let mean = scale(sum, S::ONE / S::from_f64(self.velocity.len().max(1) as f64));
                let apart = |&v: &[S; 3]| dot(sub(v, mean), sub(v, mean));
                self.velocity.iter().map(apart).fold(S::ZERO, S::max).sqrt()
            }
        };
        self.led_by(fastest)
    }

    /// The same where the fastest is so fast `[m/s]`.
    pub(super) fn led_by(&self, fastest: S) -> S {
        self.pushed().max(fastest * self.span)
    }

    /// The largest speed `[m/s]`.
    pub(super) fn fastest(&self) -> S {
        self.velocity.iter().fold(S::ZERO, |most, &v| most.max(dot(v, v))).sqrt()
    }
}
