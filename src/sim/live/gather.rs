//! Which bodies go together, and their state: copied for the step and back.

use super::Live;
use super::areas::Thin;
use super::bear;
use super::bend::Bends;
use super::body::Body;
use super::cluster::{Cluster, Common, Counts, OBSTACLE, Side, Swing};
use super::given::Given;
use super::rigid::Frame;
use super::tether::Tethers;
use super::touches::Touches;
use super::tree;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::kernels::links::Links;
use crate::sim::measure;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::swept::{self, Span, Swept};
use crate::sim::vector::{add, convert, sub, widen, zero};

/// Share of the shortest mean edge that points may go until what is near what is looked for anew.
pub(super) const PROMISE: f64 = 0.25;
/// Share of it that the fastest point may go in a substep.
pub(super) const WAY: f64 = 0.5;
/// Substeps of a frame that speeds ask for: one of these numbers.
const BY_SPEED: [u32; 4] = [16, 32, 64, 128];
const MOST_BY_SPEED: u32 = BY_SPEED[BY_SPEED.len() - 1];
/// The same of rigid bodies alone that are all slower than this `[m/s]`: their contacts begin with what they bore before. Blows are the more exact the
/// shorter the substep is.
const FEWEST: u32 = 8;
const SLOW: f64 = 1.0;
/// The same of what swings faster than those resolve: bodies that are small enough have more of them.
pub(super) const SUBSTEPS: [u32; 13] = [16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024];
pub(super) const MOST_SUBSTEPS: u32 = SUBSTEPS[SUBSTEPS.len() - 1];
/// Most that rigid bonds which are swept are given: what they strain falls with the square of that number, to 1e-4 in a net of 9 by 9 with a weight.
const FOR_SWEEPS: u32 = 256;
/// Substeps that springs are given whatever they take.
const LEAST_AFFORDED: u32 = 32;

/// Substeps that speed alone asks for from which on a blow is too hard for springs that are forces.
const VIOLENT: f64 = 32.0;
/// Counted work of a frame up to which there are more substeps than speeds ask for, so that springs can be forces, and up to which there
/// are more than [`MOST_BY_SPEED`]; and of a substep for each pair that may touch, about.
const AFFORDED: f64 = 8e6;
const MANY: f64 = 4e6;
const OF_A_PAIR: f64 = 120.0;

/// Substeps of a frame at a speed `[m/s]`, with skins whose edges have this mean length `[m]`.
pub(super) fn substeps_at(speed: f64, edge: f64) -> u32 {
    by_speed(speed / super::FRAMES / (WAY * if edge > 0.0 { edge } else { 0.1 }))
}

/// Substeps of a frame where speeds want so many.
fn by_speed(wanted: f64) -> u32 {
    BY_SPEED.into_iter().find(|&count| f64::from(count) >= wanted).unwrap_or(MOST_BY_SPEED)
}

/// The same where something else asks for `least`.
pub(super) fn enough(wanted: f64, least: u32) -> u32 {
    let most = by_speed(wanted).max(least);
    SUBSTEPS.into_iter().find(|&count| count >= most).unwrap_or(MOST_SUBSTEPS)
}

/// Substeps of a frame that bodies are given so that their springs can be forces, whose substep takes this counted work: few bodies, many.
pub(super) fn affordable(work: f64) -> u32 {
    let room = |count: u32| if count > MOST_BY_SPEED { MANY } else { AFFORDED };
    SUBSTEPS.into_iter().rev().find(|&count| f64::from(count) * work <= room(count)).unwrap_or(SUBSTEPS[0])
}

/// Pairs of a cluster that might touch in the step before.
fn known_pairs<S: Real>(cluster: &Cluster<S>, common: &Common<S>) -> usize {
    let first_of = |number: u32| common.sides.partition_point(|side| side.0 < u64::from(number) << 32);
    let of = |&(_, number): &(u32, u32)| {
        common.sides[first_of(number)..].iter().take_while(move |side| side.0 >> 32 == u64::from(number))
    };
    cluster.corners.iter().flat_map(of).count()
}

/// What a body asks for of so many substeps: those in which all its springs are exact forces, or most are forces, or as many as there are, for
/// springs that no number of substeps makes forces are the softer the fewer there are, where they are to be `firm`.
pub(super) fn asked([few, fine]: [u32; 2], affordable: u32, is_firm: bool) -> Option<u32> {
    let most = affordable.max(LEAST_AFFORDED);
    let is_within = |most: u32| move |count: &u32| *count > 0 && *count <= most;
    Some(fine).filter(is_within(affordable)).or(Some(few).filter(is_within(most))).or(is_firm.then_some(most))
}

impl<S: Real> Live<S> {
    /// The clusters of what is awake, in the order of their lowest bodies.
    pub(super) fn gather(
        &self,
        points: &Points<S, 2>,
        common: &Common<S>,
        (outside, is_told): ((&Pull<S, 2>, &Environment<2>), bool),
        (t, h): (f64, f64),
    ) -> Vec<Cluster<S>> {
        let is_awake = |bodies: &Vec<usize>| bodies.iter().any(|&body| !self.rests[body].is_asleep);
        let together: Vec<Vec<usize>> = self.together(points, outside, h).into_iter().filter(is_awake).collect();
        let most_substeps = self.affordable(together.iter().flatten());
        let motion = |body: usize| match self.is_left_alone(body, points, outside, (t, h)) {
            // A ledger is kept point by point.
            true if is_told => Motion::Carried,
            true => Motion::Lean,
            false => Motion::OfPoints,
        };
        let cluster = |bodies| {
            let cluster = self.cluster(bodies, points, common, motion);
            // What is crumpled has more contacts than bonds. Few sides in all take nothing from anybody.
            let most = OF_A_PAIR * common.sides.len() as f64;
            let is_any = affordable(most) < most_substeps;
            let pairs = if is_any { known_pairs(&cluster, common) } else { 0 };
            Cluster { most_substeps: most_substeps.min(affordable(OF_A_PAIR * pairs as f64)), ..cluster }
        };
        together.into_iter().map(cluster).collect()
    }

    /// Whether nothing but gravity, drag and contacts acts on a rigid body within `h` from `t` on `[s]`.
    fn is_left_alone(
        &self,
        body: usize,
        points: &Points<S, 2>,
        (pull, around): (&Pull<S, 2>, &Environment<2>),
        span: (f64, f64),
    ) -> bool {
        let of = &self.bodies.list[body];
        let is_rigid = of.rigid.is_some() && self.contact.is_some();
        if !is_rigid
            || pull.air.is_some()
            || !pull.cushions.is_empty()
            || self.fields.iter().any(|field| field.is_at(body))
        {
            return false;
        }
        let is_driven = of.muscles.len() + of.turns.len() > 0;
        !is_driven && (around.mouse.is_none() || !self.is_reached(body, points, (around, span)))
    }

    /// Substeps of a frame that these bodies are given so that their springs can be forces.
    fn affordable<'a>(&self, bodies: impl Iterator<Item = &'a usize>) -> u32 {
        let of = |&body: &usize| {
            let body = &self.bodies.list[body];
            let free = body.springs.len() + body.holds.len() - body.tree as usize;
            let joined = tree::work(body.tree) + body.rig.as_ref().map_or(0, |rig| rig.work());
            super::work_of_a_substep([body.points.len(), free, body.areas.len()]) + joined as f64
        };
        affordable(bodies.map(of).sum())
    }

    /// The bodies that may meet within `h` `[s]`, in the order of the lowest of each.
    pub(super) fn together(
        &self,
        points: &Points<S, 2>,
        (pull, around): (&Pull<S, 2>, &Environment<2>),
        h: f64,
    ) -> Vec<Vec<usize>> {
        let mut together = crate::sim::sets::Sets::new(self.bodies.list.len());
        if self.contact.is_some_and(|contact| contact.with_others) {
            let span = pull.span(around, h);
            let obstacles = &pull.contacts.obstacles;
            let settled = |swept: Swept<S, 2>| swept.settled(|bounds| obstacles.may_touch(bounds));
            let reach = |body| Some((body, settled(self.reach(body, points, span, S::from_f64(2.0 * PROMISE))?)));
            swept::join(&mut together, (0..self.bodies.list.len()).filter_map(reach).collect(), settled);
        }
        self.fields.iter().for_each(|field| field.join(&mut together));
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); self.bodies.list.len()];
        for body in 0..self.bodies.list.len() {
            if self.bodies.list[body].points.len() > 0 {
                members[together.find(body as u32) as usize].push(body);
            }
        }
        members.retain(|bodies| !bodies.is_empty());
        members
    }

    /// Where the points of a body may get to, and what is near: within this share of an edge.
    pub(super) fn reach(&self, body: usize, points: &Points<S, 2>, span: Span, apart: S) -> Option<Swept<S, 2>> {
        let of = &self.bodies.list[body];
        let margin = of.edge_length * apart + of.radius;
        let own = self.bodies.order[of.points.range()].iter().map(|&slot| slot as usize);
        Swept::of(points, own, span, margin)
    }

    /// What bends the angles of these bodies; nothing where none do so together.
    fn bends(&self, bodies: &[usize]) -> Vec<Option<Bends>> {
        let of = |&body: &usize| self.bodies.list[body].bends.as_deref();
        let is_any = bodies.iter().any(|body| of(body).is_some());
        if is_any { bodies.iter().map(|body| of(body).cloned()).collect() } else { Vec::new() }
    }

    pub(super) fn cluster(
        &self,
        bodies: Vec<usize>,
        points: &Points<S, 2>,
        common: &Common<S>,
        motion: impl Fn(usize) -> Motion,
    ) -> Cluster<S> {
        let own: usize = bodies.iter().map(|&body| self.bodies.list[body].points.len()).sum();
        let mut cluster = Cluster {
            settles: bodies.iter().map(|&body| self.rests[body].settles()).collect(),
            by_forces: Vec::new(),
            bends: self.bends(&bodies),
            bases: Vec::with_capacity(bodies.len() + 1),
            start: Vec::with_capacity(own),
            now: Vec::with_capacity(own),
            way: Vec::new(),
            turned: Vec::new(),
            velocity: Vec::with_capacity(own),
            begun: Vec::new(),
            lost: Vec::with_capacity(own),
            w: Vec::with_capacity(own),
            body_of: Vec::with_capacity(own),
            edges: Vec::new(),
            corners: Vec::new(),
            circles: Vec::new(),
            pulls: Links::default(),
            odd_pulls: Vec::new(),
            firm: Links::default(),
            slow: Links::default(),
            is_all_rigid: false,
            does_turn: false,
            hard: Links::default(),
            holds: Vec::new(),
            muscles: Vec::new(),
            turns: Vec::new(),
            given: Given::none(),
            thrusts: Vec::new(),
            thin: vec![Thin::unknown(); bodies.len()],
            pairs: Vec::new(),
            rooms: Vec::new(),
            chosen: Vec::new(),
            active: Vec::new(),
            on_planes: Vec::new(),
            touches: Touches::default(),
            promised: Vec::new(),
            gone: Vec::new(),
            goes: Vec::new(),
            least_promise: S::INFINITY,
            most_substeps: SUBSTEPS[0],
            swings: bodies.iter().map(|&body| Swing { known: self.rests[body].swing, seen: 0.0 }).collect(),
            is_violent: false,
            is_uneven: false,
            share: 1.0,
            span: S::ZERO,
            pressed_in: S::ZERO,
            least_bounce: S::ZERO,
            widest: S::ZERO,
            gentle: S::ZERO,
            lies: bodies.iter().map(|&body| self.rests[body].lies).collect(),
            sunk: vec![false; bodies.len()],
            tethers: Tethers::none(),
            has_pressed: false,
            has_leaned: false,
            work: S::ZERO,
            debt: S::from_f64(bodies.iter().map(|&body| self.rests[body].debt).sum()),
            lifted: S::ZERO,
            tally: None,
            counts: Counts::default(),
            tangle: self.tangle.of(&bodies),
            torn: Vec::new(),
            frames: Vec::new(),
            frame_of: Vec::new(),
            is_one: Vec::new(),
            rigs: Vec::new(),
            inner: Vec::new(),
            bodies,
        };
        for k in 0..cluster.bodies.len() {
            let body = &self.bodies.list[cluster.bodies[k]];
            let base = cluster.now.len() as u32;
            cluster.bases.push(base);
            let (slots, moves) = (&self.bodies.order[body.points.range()], motion(cluster.bodies[k]));
            let inside = match &body.rigid {
                Some(shape) if moves == Motion::Lean => &slots[..shape.surface.len()],
                _ => slots,
            };
            for &slot in inside {
                let i = slot as usize;
                cluster.now.push(points.position[i]);
                cluster.velocity.push(points.velocity[i]);
                cluster.lost.push(points.position_lost.get(i).copied().unwrap_or(zero()));
                cluster.w.push(points.inverse_mass[i]);
                cluster.body_of.push(k as u32);
            }
            if let Some(shape) = &body.rigid {
                let lost = |i: usize| points.position_lost.get(i).copied().map_or([0.0; 2], widen);
                let state = |k: usize| {
                    let i = slots[k] as usize;
                    [add(widen(points.position[i]), lost(i)), widen(points.velocity[i])]
                };
                cluster.include_rigid(shape, base as usize, state, moves);
            }
            if let Some(rig) = &body.rig {
                let bonds = common.springs(body).iter().chain(common.holds(body)).flat_map(|link| [link.a, link.b]);
                let angles = common.hinges(body).iter().flat_map(|hinge| hinge.points);
                let muscles = self.bodies.muscles[body.muscles.range()].iter().flat_map(|muscle| muscle.ends);
                let turns = self.bodies.turns[body.turns.range()].iter().flat_map(|turn| turn.now.points);
                cluster.include_rig(rig, base as usize, bonds.chain(angles).chain(muscles).chain(turns));
            }
            let number = |local: u32| (base + local, body.points.first + local);
            cluster.corners.extend(self.bodies.corners[body.corners.range()].iter().map(|&corner| number(corner)));
            for (edge, number) in common.edges(body).iter().zip(body.edges.first..) {
                let ends = edge.ends.map(|end| base + end);
                cluster.edges.push(Side { ends, number, body: k as u32, is_closed: edge.is_closed });
            }
            if body.edge_length > S::ZERO {
                cluster.least_promise = cluster.least_promise.min(body.edge_length * S::from_f64(PROMISE));
            }
            cluster.widest = cluster.widest.max(body.radius);
        }
        cluster.bases.push(cluster.now.len() as u32);
        let Cluster { bodies, bases, .. } = &cluster;
        cluster.thrusts = self.fields.iter().filter_map(|field| field.within(bodies, bases)).collect();
        if !cluster.least_promise.is_finite() {
            cluster.least_promise = S::from_f64(PROMISE * 0.1);
        }
        if self.contact.is_none() {
            // Points meet obstacles alone.
            cluster.edges.clear();
            cluster.corners.clear();
            for (k, &body) in cluster.bodies.iter().enumerate() {
                let number = |i: u32| (i, i - cluster.bases[k] + self.bodies.list[body].points.first);
                cluster.corners.extend((cluster.bases[k]..cluster.bases[k + 1]).map(number));
            }
        }
        cluster.include_walls(common);
        cluster.start.clone_from(&cluster.now);
        cluster.begun.clone_from(&cluster.velocity);
        cluster.way = vec![zero(); cluster.now.len()];
        cluster.turned = vec![zero(); cluster.now.len()];
        for list in [&mut cluster.promised, &mut cluster.gone, &mut cluster.goes] {
            *list = vec![S::ZERO; cluster.now.len()];
        }
        cluster.is_uneven = bear::is_uneven(&cluster);
        cluster.mend_rigs();
        cluster
    }

    /// Writes the state of a cluster back.
    pub(super) fn scatter(&self, cluster: &Cluster<S>, points: &mut Points<S, 2>) {
        for (k, &body) in cluster.bodies.iter().enumerate() {
            let slots = &self.bodies.order[self.bodies.list[body].points.range()];
            if let Some(frame) = cluster.free_whole(k as u32) {
                scatter_all(frame, slots, points);
                continue;
            }
            let base = cluster.bases[k] as usize;
            for (i, &slot) in (base..).zip(slots) {
                points.position[slot as usize] = cluster.now[i];
                points.velocity[slot as usize] = cluster.velocity[i];
                if let Some(lost) = points.position_lost.get_mut(slot as usize) {
                    *lost = cluster.lost[i];
                }
            }
        }
    }
}

/// How a body of a cluster moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// As its points do.
    OfPoints,
    /// By itself, and its points follow.
    Carried,
    /// The same, and only those points are in the cluster that may touch something.
    Lean,
}

/// The points of a rigid body that moves by itself follow it.
fn scatter_all<S: Real>(frame: &Frame, slots: &[u32], points: &mut Points<S, 2>) {
    for ([x, v], &slot) in frame.state().zip(slots) {
        let slot = slot as usize;
        points.position[slot] = convert(x);
        points.velocity[slot] = convert(v);
        if let Some(lost) = points.position_lost.get_mut(slot) {
            *lost = convert(sub(x, widen(points.position[slot])));
        }
    }
}

impl<S: Real> Cluster<S> {
    /// Sides of polygons and circles near by, their corners behind the points.
    fn include_walls(&mut self, common: &Common<S>) {
        if common.walls.corners.is_empty() {
            return;
        }
        let Some([low, high]) = measure::extent(&self.now) else { return };
        let size = [0, 1].map(|k| high[k] - low[k]);
        // What is fast gets further than the box is wide: those walls are looked for again in the next step.
        let way = super::substep::fastest(self) * S::from_f64(1.0 / 30.0)
            + self.least_promise * S::from_f64(8.0)
            + size[0].max(size[1]) * S::HALF;
        let around = [low.map(|x| x - way), high.map(|x| x + way)];
        let sides: Vec<u32> = common.walls.near(around).collect();
        let mut corners: Vec<u32> = sides.iter().flat_map(|&side| common.walls.sides[side as usize].0).collect();
        corners.sort_unstable();
        corners.dedup();
        let first = self.now.len() as u32;
        let place = |corner: u32| first + corners.binary_search(&corner).unwrap_or_default() as u32;
        for &side in &sides {
            let ends = common.walls.sides[side as usize].0.map(place);
            let number = common.bodies.edges.len() as u32 + side;
            self.edges.push(Side { ends, number, body: OBSTACLE, is_closed: true });
        }
        for &corner in &corners {
            self.now.push(common.walls.corners[corner as usize]);
            self.velocity.push(zero());
            self.w.push(S::ZERO);
            self.body_of.push(OBSTACLE);
            if common.contact.is_some() {
                self.corners.push((place(corner), common.bodies.order.len() as u32 + corner));
            }
        }
        self.include_circles(common, around);
    }

    /// Substeps of a frame that the fastest point needs, and springs.
    pub(super) fn substeps(&self, common: &Common<S>, around: &Environment<2>, t: f64) -> u32 {
        let frame = 1.0 / super::FRAMES;
        let pushed = around.mouse_at(t).map_or(0.0, |(force, _)| force.strength.abs() * force.radius);
        let speed = super::substep::fastest(self).to_f64() + frame * (common.most_push + pushed);
        let shortest = self.least_promise.to_f64() / PROMISE;
        let wanted = speed * frame / (WAY * shortest);
        let moving = self.members(common).zip(&self.settles).filter(|(_, settles)| !**settles);
        let asked = |body: &Body<S>| {
            // What is folded is the easier to open.
            let is_soft = body.springs.len() > 0 && (body.least_substeps[0] == 0 || self.tangle.knots.is_empty());
            let of_springs = asked(body.least_substeps, self.most_substeps, is_soft);
            of_springs.max(body.is_swept.then(|| self.most_substeps.min(FOR_SWEEPS)))
        };
        let least = moving.filter_map(|((body, _), _)| asked(body)).max().unwrap_or_default();
        // What is struck by something that fast is projected.
        let least = if wanted > VIOLENT { least.min(MOST_BY_SPEED) } else { least };
        let has_skins = self.widest > S::ZERO;
        if self.is_all_whole() && has_skins && !self.is_uneven && speed < SLOW {
            return FEWEST;
        }
        enough(wanted, least.max(self.for_swings(common)))
    }

    /// Substeps of a frame that what swings across taut trees and joints is given: nobody knows how fast in the first step of all, and what pins that are
    /// led tear at is as taut as nothing is.
    fn for_swings(&self, common: &Common<S>) -> u32 {
        let affordable = f64::from(self.most_substeps);
        let of = |(body, swing, is_torn): (&Body<S>, &Swing, bool)| {
            let [few, fine] = tree::substeps(swing.known);
            // What is in joints is struck through all of them.
            let is_any = body.rig.is_none() && (!is_torn || body.straps.is_empty());
            let most = if is_any { fine.min(affordable) } else { 0.0 };
            most.max(few.min(f64::from(MOST_BY_SPEED))).ceil() as u32
        };
        let all = self.members(common).zip(self.swings.iter().zip(&self.tangle.torn));
        let pulling = all.filter(|((body, _), _)| body.tree > 0 || body.rig.is_some());
        pulling.map(|((body, _), (swing, &is_torn))| of((body, swing, is_torn))).max().unwrap_or_default()
    }

    /// Whether something that is near something is so fast that springs are projected.
    pub(super) fn is_struck(&self) -> bool {
        let is_near = !self.pairs.is_empty() || !self.on_planes.is_empty();
        let shortest = self.least_promise.to_f64() / PROMISE;
        is_near && super::substep::fastest(self).to_f64() > VIOLENT * super::FRAMES * WAY * shortest
    }

    /// Adds what it did.
    pub(super) fn count(&self, counters: &mut Counters) {
        let counts = &self.counts;
        counters.substeps += counts.substeps;
        counters.points_moved += counts.points;
        counters.bonds_solved += counts.bonds;
        counters.mouse_points += counts.mouse_points;
        counters.contacts += counts.contacts;
        counters.truncations += counts.truncations;
        counters.guarded += counts.guarded;
        counters.detections += counts.detections;
        counters.looks += counts.looks;
        counters.mended += counts.mended;
        counters.parted += counts.parted;
        counters.work += counts.work;
    }
}
