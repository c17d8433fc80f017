//! Bodies that may touch each other within a step: their state, side by side, and what is near what.

use super::areas::Thin;
use super::bend::Bends;
use super::body::{Area, Body, Edge, Link};
use super::bonds::Hold;
use super::booking::Tally;
use super::build::Bodies;
use super::calm::Torn;
use super::drives::{Muscle, Turn};
use super::given::Given;
use super::loads::Loads;
use super::pair::{OnPlane, Pair, Sides};
use super::rest::Lies;
use super::rig::Rigged;
use super::rigid::Frame;
use super::tangle::Tangle;
use super::tether::Tethers;
use super::touches::Touches;
use super::walls::Walls;
use crate::sim::contact::skin::Contact;
use crate::sim::contact::surface::Surface;
use crate::sim::force::angle::Hinge;
use crate::sim::force::area::Areas;
use crate::sim::force::steady::Thrust;
use crate::sim::kernels::links::Links;
use crate::sim::real::Real;

/// Bodies that go together, in lists of their own: nothing else is read or written while they move.
///
/// Shapes: one entry a point, body after body; corners of obstacles come behind them.
#[derive(Clone, Debug)]
pub(super) struct Cluster<S: Real> {
    /// Which bodies, ascending.
    pub(super) bodies: Vec<usize>,
    /// Where the points of each begin here; one more entry at the end.
    pub(super) bases: Vec<u32>,
    /// Which of its bodies are coming to rest on something.
    pub(super) settles: Vec<bool>,
    /// Which of their springs are forces in this step, body after body; the others are projected.
    pub(super) by_forces: Vec<bool>,
    /// Positions at the start of the substep `[m]`.
    pub(super) start: Vec<[S; 2]>,
    /// Positions as far as the substep is solved `[m]`.
    pub(super) now: Vec<[S; 2]>,
    /// From one to the other `[m]`: exact where the difference of both is not.
    pub(super) way: Vec<[S; 2]>,
    /// What the velocities are to be changed by beyond what the way says, times the substep `[m]`: see [`Turned`](crate::sim::kernels::links::Turned).
    pub(super) turned: Vec<[S; 2]>,
    pub(super) velocity: Vec<[S; 2]>,
    /// Velocities at the start of the substep, before forces `[m/s]`.
    pub(super) begun: Vec<[S; 2]>,
    /// What rounding has taken from positions `[m]`.
    pub(super) lost: Vec<[S; 2]>,
    pub(super) w: Vec<S>,
    /// Which of its bodies every point is of; corners of obstacles: of none.
    pub(super) body_of: Vec<u32>,
    /// Edges of skins and of obstacles near by, ends counted here.
    pub(super) edges: Vec<Side>,
    /// Points of skins and corners of obstacles: place here, and number for ever.
    pub(super) corners: Vec<(u32, u32)>,
    /// The same of centres of circles.
    pub(super) circles: Vec<(u32, u32)>,
    /// Springs that are forces, and those that kernels do not take: their bodies here, and their places among all springs.
    pub(super) pulls: Links<S>,
    pub(super) odd_pulls: Vec<(u32, u32)>,
    /// Bonds that are projected, and those that kernels do not take.
    pub(super) firm: Links<S>,
    /// Those that take but a share of their errors, apart from them.
    pub(super) slow: Links<S>,
    /// All of those that kernels take are rigid, and they turn in this substep.
    pub(super) is_all_rigid: bool,
    pub(super) does_turn: bool,
    /// Those of them that hardly give.
    pub(super) hard: Links<S>,
    pub(super) holds: Vec<Hold<S>>,
    /// What drives move: bonds and angles.
    pub(super) muscles: Vec<Muscle<S>>,
    pub(super) turns: Vec<Turn<S>>,
    /// What mouse, forces and wind gave to its points in this substep.
    pub(super) given: Given<S, 2>,
    /// How the angles of each body are bent together; empty where none are.
    pub(super) bends: Vec<Option<Bends>>,
    /// Forces on some of its points.
    pub(super) thrusts: Vec<Thrust<S, 2>>,
    /// Triangles that may get thin, one list a body.
    pub(super) thin: Vec<Thin<S>>,
    pub(super) pairs: Vec<Pair<S>>,
    /// How far the two of each were from touching when they were found `[m]`; below 0 where the point was behind the edge.
    pub(super) rooms: Vec<S>,
    /// Which of them may touch in this substep, and which of these a pass still looks at.
    pub(super) chosen: Vec<u32>,
    pub(super) active: Vec<u32>,
    pub(super) on_planes: Vec<OnPlane<S>>,
    /// Of both what is solved on the motions of rigid bodies.
    pub(super) touches: Touches<S>,
    /// How far each point may go until what is near what is looked for anew `[m]`; corners of obstacles nowhere.
    pub(super) promised: Vec<S>,
    /// How far each has gone since, and gets in this substep `[m]`.
    pub(super) gone: Vec<S>,
    pub(super) goes: Vec<S>,
    /// A quarter of the shortest mean edge of its skins `[m]`.
    pub(super) least_promise: S,
    /// Share of what is usual that points are promised in this step: less where all are crowded.
    pub(super) share: f64,
    /// Substeps of a frame that it is given at most so that springs can be forces.
    pub(super) most_substeps: u32,
    /// How fast what rigid bonds that are solved at once pull at swings across them, body by body.
    pub(super) swings: Vec<Swing>,
    /// Something is so fast that springs are projected, which bears more.
    pub(super) is_violent: bool,
    /// Some points are so much heavier than others that these cannot bear them.
    pub(super) is_uneven: bool,
    /// How long a substep is `[s]`.
    pub(super) span: S,
    /// How long the one was in which contacts were pressed last `[s]`; 0: none was.
    pub(super) pressed_in: S,
    /// Speed below which nothing bounces `[m/s]`.
    pub(super) least_bounce: S,
    /// The largest radius of its skins `[m]`.
    pub(super) widest: S,
    /// How far an overlap of two skins, or of what began in an obstacle, is mended in a substep at most `[m]`.
    pub(super) gentle: S,
    /// How its bodies lie in others as the step begins, and which of them were led out but not far enough.
    pub(super) lies: Vec<Lies>,
    pub(super) sunk: Vec<bool>,
    /// What holds those of them that are pinned.
    pub(super) tethers: Tethers<S>,
    /// Something pressed something in this step.
    pub(super) has_pressed: bool,
    /// Obstacles pressed it in some substep of the step: they may have given it any momentum.
    pub(super) has_leaned: bool,
    /// Work that mouse and other forces did in this step `[J]`.
    pub(super) work: S,
    /// What was made from nowhere and could not be taken back yet `[J]`: springs that something led loaded.
    pub(super) debt: S,
    /// What gravity got back from bodies that were lifted out of each other in this step `[J]`.
    pub(super) lifted: S,
    /// What it took, where a ledger is kept.
    pub(super) tally: Option<Box<Tally<S>>>,
    pub(super) counts: Counts,
    /// What is inside out or crosses.
    pub(super) tangle: Tangle<S>,
    /// Bodies that led pins may tear at in this step.
    pub(super) torn: Vec<Torn>,
    /// What moves as one; the frame that each point goes with and its place there, where there is any; which bodies are one frame, and which
    /// points lie within those.
    pub(super) frames: Vec<Frame>,
    pub(super) frame_of: Vec<[u32; 2]>,
    pub(super) is_one: Vec<bool>,
    pub(super) inner: Vec<bool>,
    /// Its bodies of several frames in joints.
    pub(super) rigs: Vec<Rigged>,
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
    pub(super) looks: u64,
    pub(super) mended: u64,
    pub(super) parted: u64,
    /// Passes over triangles that were inside out as a substep began.
    pub(super) opened: u64,
    pub(super) mouse_points: u64,
    pub(super) detections: u64,
    pub(super) work: u64,
}

/// How fast what the rigid bonds of a body pull at swings across them `[rad/s]`: what is known from before the step, and the sum of its substeps.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Swing {
    pub(super) known: f64,
    pub(super) seen: f64,
}

/// An edge near which points may come.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) ends: [u32; 2],
    /// Number for ever.
    pub(super) number: u32,
    /// Of which of the cluster's bodies; `u32::MAX`: of an obstacle.
    pub(super) body: u32,
    pub(super) is_closed: bool,
}

/// No body.
pub(super) const OBSTACLE: u32 = u32::MAX;

/// What all clusters share.
pub(super) struct Common<'a, S: Real> {
    pub(super) bodies: &'a Bodies<S>,
    pub(super) walls: &'a Walls<S>,
    pub(super) contact: Option<&'a Contact>,
    /// How triangles resist.
    pub(super) resist: Areas,
    /// All surfaces, planes first.
    pub(super) surfaces: &'a [Surface<S, 2>],
    pub(super) planes: &'a [Surface<S, 2>],
    /// A bound on what gravity, forces and wind give, torques apart `[m/s^2]`.
    pub(super) most_push: f64,
    /// Sides that points had of edges, from before.
    pub(super) sides: &'a Sides,
    /// What contacts bore, from before.
    pub(super) loads: &'a Loads<S>,
}

impl<S: Real> Common<'_, S> {
    pub(super) fn springs(&self, body: &Body<S>) -> &[Link<S>] {
        &self.bodies.springs[body.springs.range()]
    }

    /// Of every spring bounds on what its ends do (`Bodies::swings`).
    pub(super) fn swings(&self, body: &Body<S>) -> &[[S; 2]] {
        &self.bodies.swings[body.springs.range()]
    }

    pub(super) fn holds(&self, body: &Body<S>) -> &[Link<S>] {
        &self.bodies.holds[body.holds.range()]
    }

    pub(super) fn areas(&self, body: &Body<S>) -> &[Area<S>] {
        &self.bodies.areas[body.areas.range()]
    }

    pub(super) fn hinges(&self, body: &Body<S>) -> &[Hinge<S>] {
        &self.bodies.hinges[body.hinges.range()]
    }

    pub(super) fn edges(&self, body: &Body<S>) -> &[Edge] {
        &self.bodies.edges[body.edges.range()]
    }
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

    /// These are the pairs that may touch from now on; which of them do is chosen in each substep.
    pub(super) fn list(&mut self, pairs: Vec<Pair<S>>) {
        self.chosen.clear();
        self.active.clear();
        self.rooms.clear();
        self.rooms.extend(pairs.iter().map(|pair| pair.room));
        self.pairs = pairs;
    }

    /// Whether something presses in this substep.
    pub(super) fn is_pressed(&self) -> bool {
        let mut pairs = self.active.iter().map(|&number| &self.pairs[number as usize]);
        pairs.any(|pair| pair.contact.pressed > S::ZERO)
            || self.on_planes.iter().any(|on| on.contact.pressed > S::ZERO)
            || self.touches.press()
    }

    /// Whether obstacles press it in this substep.
    pub(super) fn leans(&self) -> bool {
        let is_obstacle = |pair: &Pair<S>| pair.p.max(pair.a) as usize >= self.own();
        self.on_planes.iter().any(|on| on.contact.pressed > S::ZERO)
            || self.pairs.iter().any(|pair| pair.contact.pressed > S::ZERO && is_obstacle(pair))
    }

    /// Whether its points are among the finite numbers, their squares included.
    pub(super) fn is_finite(&self) -> bool {
        self.lost().next().is_none()
    }

    /// The bodies of which this is not so.
    pub(super) fn lost(&self) -> impl Iterator<Item = usize> {
        super::lost((&self.bodies, &self.bases), (&self.now, &self.velocity))
    }

    /// How many points its bodies have.
    pub(super) fn own(&self) -> usize {
        self.bases.last().map_or(0, |&end| end as usize)
    }
}
