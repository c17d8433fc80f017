//! Rigid bodies in joints in the live step: what rigid bonds hold of a body moves as frames (`rigid.rs`), and what joins them is solved at once.
//!
//! A substep takes frames and points on as if nothing joined them; then, and after each pass of contacts, the gaps of all joints are closed
//! together by elimination, along new directions, with the inverse masses and inertias of what they join; at its end velocities at joints are
//! made one, else those of points that two frames share would feed one with what the other has.
//! Source: M. Müller and others, Detailed Rigid Body Simulation with Extended Position Based Dynamics, 2020; the joints are solved at once in
//! place of one after the other, so that a light chain bears a heavy load.

use std::sync::Arc;

use super::cluster::Cluster;
use super::rigid::{Frame, Held};
use crate::sim::kernels::links::MOST_TURN;
use crate::sim::real::Real;
use crate::sim::rigid::blueprint::{Blueprint, BodyPlan};
use crate::sim::rigid::inertia::Inertia;
use crate::sim::rigid::joints::{Joints, Pull, Rows};
use crate::sim::rigid::link::{Anchor, End, Link, Stand};
use crate::sim::rigid::motion::{Motion, Pose, Twist};
use crate::sim::rigid::place::Place;
use crate::sim::rigid::shape::Shape;
use crate::sim::vector::{add, convert, cross, dot, scale, sub, widen};

/// Rounds in which gaps are closed, each with new directions.
const ROUNDS: u32 = 3;
/// A gap that counts as closed, as a share of where things are `[1]`.
const CLOSED: f64 = 1e-13;

/// Times as heavy as the lightest of its members the heaviest of a rig may be that goes on with rows of its joints from before: what light ones bear
/// of a heavy one changes with the least turn.
const MOST_UNEQUAL: f64 = 50.0;

/// A gap of a joint that no motion makes, as a share of the largest radius of gyration of what is joined, and rounds in which such are closed.
const TORN: f64 = 0.05;
const MENDING: u32 = 24;

/// The frames of a body of several, and what joins them.
#[derive(Clone, Debug)]
pub(super) struct Rig {
    pub(super) members: Vec<Member>,
    pub(super) joints: Joints,
    inertias: Vec<Inertia>,
    /// Rows of its joints do from a place near by.
    keeps_rows: bool,
    /// Points that do not move by themselves, as joints count them, and those that links are at.
    pub(super) fixed: Vec<u32>,
    fastened: Vec<u32>,
    /// Points of what two pins hold, which are as good as pins.
    still: Vec<u32>,
}

/// A frame or a point of a rig, points numbered in its body.
#[derive(Clone, Debug)]
pub(super) enum Member {
    Frame(Arc<Shape>, Vec<u32>),
    Point(u32),
}

impl Rig {
    /// The square of the phase that a pull `[kg m]` at a link swings what it joins in the substep that it acts in `[1]`: T h^2 (r/I + (1/m + r^2/I)/l)
    /// of an end at the arm r of a body, where a bar of length l joins it.
    fn swings(&self, link: &Link, pull: [f64; 2]) -> f64 {
        let of = |end: End| match end {
            End::On { body, place } => {
                let ([ease, swing], arm) = (self.inertias[body as usize].inverse, dot(place, place).sqrt());
                swing * arm + link.rest.filter(|rest| *rest > 0.0).map_or(0.0, |rest| (ease + swing * arm * arm) / rest)
            }
            End::Fixed(_) => 0.0,
        };
        dot(pull, pull).sqrt() * of(link.ends[0]).max(of(link.ends[1]))
    }

    /// `None` where rigid bonds make no body and are more than `most_alone`, contradict each other, or leave too much loose.
    pub(super) fn of(held: &Held<'_>, most_alone: usize, is_led: impl Fn(u32) -> bool) -> Option<Self> {
        let mut plan = Blueprint::of(held, &[], most_alone, is_led)?;
        let is_fastened = |seat: &End| plan.links.iter().any(|link| link.ends.contains(seat));
        let fastened = (0..).zip(&plan.seats).filter(|(_, seat)| is_fastened(seat)).map(|(point, _)| point).collect();
        leave_loose(&mut plan);
        let member = |body: &BodyPlan| match body.points[..] {
            [point] => Member::Point(point),
            _ => Member::Frame(body.shape.clone(), body.points.clone()),
        };
        let inertia = |body: &BodyPlan| Inertia { inverse: [1.0 / body.shape.mass, 1.0 / body.shape.inertia] };
        let (least, most) = plan.bodies.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), body| {
            (least.min(body.shape.mass), most.max(body.shape.mass))
        });
        Some(Rig {
            keeps_rows: most <= MOST_UNEQUAL * least,
            members: plan.bodies.iter().map(member).collect(),
            inertias: plan.bodies.iter().map(inertia).collect(),
            fastened,
            joints: Joints::new(plan.links),
            fixed: plan.fixed,
            still: plan.still,
        })
    }

    /// Counted work of a substep, about, that nothing presses.
    pub(super) fn work(&self) -> u64 {
        2 * self.joints.work() + 3 * self.joints.work_of_a_round()
    }

    /// Whether all of some points go with one frame.
    pub(super) fn holds(&self, points: &[u32]) -> bool {
        self.frames().any(|(_, list)| points.iter().all(|point| list.binary_search(point).is_ok()))
    }

    fn frames(&self) -> impl Iterator<Item = (&Arc<Shape>, &Vec<u32>)> {
        self.members.iter().filter_map(|member| match member {
            Member::Frame(shape, points) => Some((shape, points)),
            Member::Point(_) => None,
        })
    }
}

/// Points alone that nothing joins, as those of a soft wheel on its axle, are no members: joints do nothing to them, and how heavy they are says
/// nothing of the rows.
fn leave_loose(plan: &mut Blueprint) {
    let mut is_joined: Vec<bool> = plan.bodies.iter().map(|body| body.points.len() > 1).collect();
    for end in plan.links.iter().flat_map(|link| link.ends) {
        if let End::On { body, .. } = end {
            is_joined[body as usize] = true;
        }
    }
    let before = |left: &mut u32, is: &bool| Some(std::mem::replace(left, *left + u32::from(*is)));
    let numbers: Vec<u32> = is_joined.iter().scan(0, before).collect();
    for end in plan.links.iter_mut().flat_map(|link| &mut link.ends) {
        if let End::On { body, .. } = end {
            *body = numbers[*body as usize];
        }
    }
    let mut is_member = is_joined.into_iter();
    plan.bodies.retain(|_| is_member.next().unwrap_or(true));
}

/// A rig in a cluster: where its points and its frames begin.
#[derive(Clone, Debug)]
pub(super) struct Rigged {
    pub(super) rig: Arc<Rig>,
    pub(super) base: usize,
    pub(super) first: usize,
    /// The joints' rows as they were last worked out, and whether bodies are still where they were then.
    rows: Option<Rows>,
    is_there: bool,
}

impl<S: Real> Cluster<S> {
    /// Where a point is as the step begins.
    fn found(&self, i: usize) -> [f64; 2] {
        add(widen(self.now[i]), widen(self.lost[i]))
    }

    /// One of its bodies, which comes last, is a rig; others pull at these of its points, counted in the body.
    pub(super) fn include_rig(&mut self, rig: &Arc<Rig>, base: usize, pulled: impl Iterator<Item = u32>) {
        let first = self.frames.len();
        for &point in &rig.still {
            let i = base + point as usize;
            (self.w[i], self.velocity[i]) = (S::ZERO, [S::ZERO; 2]);
        }
        for (shape, points) in rig.frames() {
            let points: Vec<u32> = points.iter().map(|&point| base as u32 + point).collect();
            let at: Vec<[f64; 2]> = points.iter().map(|&i| self.found(i as usize)).collect();
            self.include_frame(shape, points, |k| at[k]);
        }
        for point in pulled.chain(rig.fastened.iter().copied()) {
            self.fasten(base + point as usize);
        }
        self.rigs.push(Rigged { rig: rig.clone(), base, first, rows: None, is_there: false });
    }

    /// Whether one of its bodies is a rig.
    pub(super) fn is_in_joints(&self, body: usize) -> bool {
        self.bases.get(body).is_some_and(|&base| self.rigs.iter().any(|rigged| rigged.base == base as usize))
    }

    /// All points of frames are where those are, before contacts look at them.
    pub(super) fn follow_rigs(&mut self) {
        if !self.rigs.is_empty() {
            self.follow_rigid();
        }
    }

    /// Joints that were torn open before these bodies were in joints, as by pins that were let go, are closed before anything moves: as a way that
    /// is gone in a substep that would throw the body.
    pub(super) fn mend_rigs(&mut self) {
        for k in 0..self.rigs.len() {
            let rigged = self.rigs[k].clone();
            let (rig, mut motions, anchors) = (&rigged.rig, self.still(&rigged), self.anchors(&rigged));
            let gyration = |inertia: &Inertia| (inertia.inverse[0] / inertia.inverse[1]).sqrt();
            let radii = rig.inertias.iter().map(gyration).filter(|radius| radius.is_finite());
            let most = TORN * radii.fold(0.0, f64::max);
            let gaps = rig.joints.gaps(Stand { motions: &motions, anchors: &anchors, since: 0.0, clock: None });
            if gaps.iter().all(|gap| gap.abs() <= most) {
                continue;
            }
            rig.joints.close(&rig.inertias, (&mut motions, &anchors, None), (MENDING, CLOSED), None);
            let mut frame = rigged.first;
            for (member, motion) in rig.members.iter().zip(motions) {
                match *member {
                    Member::Frame(..) => {
                        self.begin_at(frame, motion.place);
                        frame += 1;
                    }
                    Member::Point(point) => {
                        let i = rigged.base + point as usize;
                        self.now[i] = convert(motion.place.middle);
                        self.start[i] = self.now[i];
                    }
                }
            }
        }
    }

    /// The members of a rig where they are, as if they stood still.
    fn still(&self, rigged: &Rigged) -> Vec<Motion> {
        self.stations(rigged).map(|place| Motion { place, twist: Twist::STILL }).collect()
    }

    /// The points that hold a rig, as if they stood still.
    fn anchors(&self, Rigged { rig, base, .. }: &Rigged) -> Vec<Anchor> {
        let anchor = |&point: &u32| Anchor { place: widen(self.now[base + point as usize]), velocity: [0.0; 2] };
        rig.fixed.iter().map(anchor).collect()
    }

    /// The gaps of all joints are closed for the first time in a substep: what their pulls swing is noted.
    pub(super) fn close_rigs(&mut self) {
        for k in 0..self.rigs.len() {
            let pulls = self.straighten(k);
            let rig = &self.rigs[k].rig;
            let square = rig.joints.links().iter().zip(&pulls).map(|(link, pull)| rig.swings(link, pull.push));
            let phase = square.fold(0.0, f64::max).sqrt();
            let body = self.bases.partition_point(|&base| (base as usize) < self.rigs[k].base);
            self.swings[body].seen += phase / self.span.to_f64();
        }
    }

    /// The gaps of all joints are closed once more.
    pub(super) fn straighten_rigs(&mut self) {
        for k in 0..self.rigs.len() {
            self.straighten(k);
        }
    }

    /// The rows of a rig, which are put back by who takes them, and all else of it.
    fn open(&mut self, k: usize) -> (Option<Rows>, Rigged) {
        let rows = self.rigs[k].rows.take();
        (rows, self.rigs[k].clone())
    }

    /// Closes the gaps of a rig. Returns what its links did.
    fn straighten(&mut self, k: usize) -> Vec<Pull> {
        let (mut rows, rigged) = self.open(k);
        let rig = &rigged.rig;
        let (mut motions, anchors) = (self.still(&rigged), self.anchors(&rigged));
        let size = motions.iter().fold(1.0, |most: f64, motion| {
            let [x, y] = motion.place.middle;
            most.max(x.abs()).max(y.abs())
        });
        let closed = CLOSED.max(S::EPSILON.to_f64()) * size;
        let kept = if rig.keeps_rows { Some(&mut rows) } else { None };
        let closing = rig.joints.close(&rig.inertias, (&mut motions, &anchors, None), (ROUNDS, closed), kept);
        if !rig.keeps_rows {
            rows = None;
        }
        self.counts.work += u64::from(closing.factored) * rig.joints.work();
        self.counts.work += u64::from(closing.rounds + 1) * rig.joints.work_of_a_round();
        if closing.rounds > 0 {
            self.put(&rigged, &motions);
            self.turn_back(&rigged, &closing.pulls, &anchors);
        }
        (self.rigs[k].rows, self.rigs[k].is_there) = (rows, false);
        closing.pulls
    }

    /// Notes what joints that pulled so would have changed of velocities by the arms, and bars by the directions, that they had as the substep
    /// began: see [`Turned`](crate::sim::kernels::links::Turned).
    fn turn_back(&mut self, rigged: &Rigged, pulls: &[Pull], anchors: &[Anchor]) {
        let begun: Vec<Place> =
            self.stations_at(rigged, |frame| frame.begun(), |state, i| widen(state.start[i])).collect();
        let now: Vec<Place> = self.stations(rigged).collect();
        let rig = &rigged.rig;
        for (link, &Pull { push: pull, turns }) in rig.joints.links().iter().zip(pulls) {
            let arm = |places: &[Place], end: End| match end {
                End::On { body, place } => Some((body as usize, places[body as usize].turned(place))),
                End::Fixed(_) => None,
            };
            let at = |places: &[Place], end: End| match end {
                End::On { body, place } => places[body as usize].out(place),
                End::Fixed(anchor) => anchors[anchor as usize].place,
            };
            let strength = dot(pull, pull).sqrt();
            let is_gentle = |end: End| {
                arm(&now, end).is_none_or(|(body, arm)| {
                    let [ease, swing] = rig.inertias[body].inverse;
                    let length = dot(arm, arm).sqrt();
                    let turn = if length > 0.0 { swing * strength * length } else { 0.0 };
                    turn <= MOST_TURN && (link.rest.is_none_or(|rest| ease * strength <= MOST_TURN * rest))
                })
            };
            if !link.ends.into_iter().all(is_gentle) {
                continue;
            }
            let other = match link.rest {
                None => pull,
                Some(_) => {
                    let d = sub(at(&begun, link.ends[0]), at(&begun, link.ends[1]));
                    let length = dot(d, d).sqrt();
                    let size = if dot(d, pull) < 0.0 { -strength } else { strength };
                    if length > 0.0 { scale(d, size / length) } else { pull }
                }
            };
            for ((end, sign), turn) in link.ends.into_iter().zip([1.0, -1.0]).zip(turns) {
                let Some((body, old)) = arm(&begun, end) else { continue };
                let [ease, swing] = rig.inertias[body].inverse;
                let change = Twist {
                    velocity: scale(sub(other, pull), sign * ease),
                    spin: sign * swing * cross(old, other) - turn,
                };
                self.turn_member(rigged, body, change);
            }
        }
    }

    /// Adds to what a member of a rig is turned back by in this substep `[m, rad]`.
    fn turn_member(&mut self, rigged: &Rigged, body: usize, change: Twist) {
        let members = &rigged.rig.members;
        match members[body] {
            Member::Frame(..) => {
                let before = members[..body].iter().filter(|member| matches!(member, Member::Frame(..))).count();
                self.frames[rigged.first + before].turn_back(change);
            }
            Member::Point(point) => {
                let turned = &mut self.turned[rigged.base + point as usize];
                *turned = add(*turned, convert(change.velocity));
            }
        }
    }

    /// Where the members of a rig are now.
    fn stations<'a>(&'a self, rigged: &'a Rigged) -> impl Iterator<Item = Place> + 'a {
        self.stations_at(rigged, Frame::place, |state, i| add(widen(state.start[i]), widen(state.way[i])))
    }

    /// Where the members of a rig are by what is said of a frame and of a point.
    fn stations_at<'a>(
        &'a self,
        rigged: &'a Rigged,
        place: impl Fn(&Frame) -> Place + 'a,
        point_at: impl Fn(&Self, usize) -> [f64; 2] + 'a,
    ) -> impl Iterator<Item = Place> + 'a {
        let mut frames = self.frames[rigged.first..].iter();
        rigged.rig.members.iter().map(move |member| match member {
            Member::Frame(..) => frames.next().map_or_else(|| Place::at([0.0; 2]), &place),
            Member::Point(point) => Place::at(point_at(self, rigged.base + *point as usize)),
        })
    }

    fn put(&mut self, rigged: &Rigged, motions: &[Motion]) {
        let mut frame = rigged.first;
        for (member, motion) in rigged.rig.members.iter().zip(motions) {
            match member {
                Member::Frame(..) => {
                    self.set_frame(frame, motion.place);
                    frame += 1;
                }
                Member::Point(point) => {
                    let i = rigged.base + *point as usize;
                    self.now[i] = convert(motion.place.middle);
                    self.way[i] = convert(sub(motion.place.middle, widen(self.start[i])));
                }
            }
        }
    }

    /// Velocities that joints bear, of all rigs. Returns how many rows there are.
    pub(super) fn stiffen_rigs(&mut self) -> u64 {
        let mut count = 0;
        for k in 0..self.rigs.len() {
            let (rows, rigged) = self.open(k);
            let is_known = rigged.is_there && rows.is_some();
            let rows = self.stiffen(&rigged, rows.filter(|_| is_known));
            (self.rigs[k].rows, self.rigs[k].is_there) = (Some(rows), true);
            let joints = &rigged.rig.joints;
            self.counts.work += joints.work_of_a_round() + if is_known { 0 } else { joints.work() };
            count += rigged.rig.joints.rows() as u64;
        }
        count
    }

    /// Returns the rows by which it did so.
    fn stiffen(&mut self, rigged: &Rigged, rows: Option<Rows>) -> Rows {
        let Rigged { rig, base, first, .. } = rigged;
        let mut twists = self.twists(rigged);
        let motions: Vec<Motion> =
            self.stations(rigged).zip(&twists).map(|(place, &twist)| Motion { place, twist }).collect();
        let anchor = |&point: &u32| {
            let i = base + point as usize;
            Anchor { place: widen(self.now[i]), velocity: widen(self.velocity[i]) }
        };
        let anchors: Vec<Anchor> = rig.fixed.iter().map(anchor).collect();
        let stand = Stand { motions: &motions, anchors: &anchors, since: 0.0, clock: None };
        let rows = rows.unwrap_or_else(|| rig.joints.rows_at(&rig.inertias, stand));
        rows.hold(&rig.inertias, &mut twists, &rig.joints.leads(stand));
        let mut frame = *first;
        for (member, twist) in rig.members.iter().zip(twists) {
            match *member {
                Member::Frame(..) => {
                    self.set_twist(frame, twist);
                    frame += 1;
                }
                Member::Point(point) => self.velocity[base + point as usize] = convert(twist.velocity),
            }
        }
        rows
    }

    /// What pushes of three points of a rig by their slopes, as large as those, change along all of them when its joints have answered
    /// `[1/kg]`; `None`: they are of none.
    pub(super) fn felt_through_joints(&self, points: [usize; 3], slopes: [[S; 2]; 3]) -> Option<S> {
        let base = self.bases[self.body_of[points[1]] as usize] as usize;
        let rigged = self.rigs.iter().find(|rigged| rigged.base == base)?;
        let rig = &rigged.rig;
        // What no joint holds answers by itself.
        let mut alone = S::ZERO;
        let pushes = points.iter().zip(slopes).filter_map(|(&i, slope)| {
            let Some(member) = self.member_of(rigged, i) else {
                alone += self.w[i] * dot(slope, slope);
                return None;
            };
            Some((member, widen(self.now[i]), widen(slope)))
        });
        let pushes: Vec<(usize, [f64; 2], [f64; 2])> = pushes.collect();
        let motions = self.still(rigged);
        let mut twists = vec![Twist::STILL; motions.len()];
        for &(member, at, push) in &pushes {
            let [ease, swing] = rig.inertias[member].inverse;
            twists[member].velocity = add(twists[member].velocity, scale(push, ease));
            twists[member].spin += swing * cross(sub(at, motions[member].place.middle), push);
        }
        match &rigged.rows {
            Some(rows) => rows.hold(&rig.inertias, &mut twists, &[]),
            None => {
                let anchors = self.anchors(rigged);
                let stand = Stand { motions: &motions, anchors: &anchors, since: 0.0, clock: None };
                rig.joints.rows_at(&rig.inertias, stand).hold(&rig.inertias, &mut twists, &[])
            }
        };
        let along = |&(member, at, push): &(usize, [f64; 2], [f64; 2])| {
            dot(push, twists[member].at(sub(at, motions[member].place.middle)))
        };
        Some(alone + S::from_f64(pushes.iter().map(along).sum()))
    }

    /// Which member of a rig a point goes with; `None`: it is held, or no joint holds it.
    fn member_of(&self, rigged: &Rigged, i: usize) -> Option<usize> {
        let frame = self.frame_of.get(i).map(|home| home[0] as usize).filter(|&number| number >= rigged.first);
        let mut members = rigged.rig.members.iter().enumerate();
        match frame.filter(|&number| number < self.frames.len()) {
            Some(number) => {
                let frames = members.filter(|(_, member)| matches!(member, Member::Frame(..)));
                frames.map(|(place, _)| place).nth(number - rigged.first)
            }
            None => {
                let own = i.checked_sub(rigged.base)? as u32;
                members
                    .find(|(_, member)| matches!(member, Member::Point(point) if *point == own))
                    .map(|(place, _)| place)
            }
        }
    }

    /// How the members of a rig move.
    fn twists(&self, rigged: &Rigged) -> Vec<Twist> {
        let mut frames = self.frames[rigged.first..].iter();
        let of = |member: &Member| match member {
            Member::Frame(..) => frames.next().map_or(Twist::STILL, Frame::twist),
            Member::Point(point) => Twist { velocity: widen(self.velocity[rigged.base + *point as usize]), spin: 0.0 },
        };
        rigged.rig.members.iter().map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_alone_that_nothing_joins_are_no_members() {
        let body = |points: &[u32]| BodyPlan {
            shape: Arc::new(Shape::free(vec![[0.0; 2]; points.len()], vec![1.0; points.len()])),
            points: points.to_vec(),
            deaf: Vec::new(),
        };
        let on = |body: u32| End::On { body, place: [0.0; 2] };
        let mut plan = Blueprint {
            bodies: vec![body(&[0, 1, 2]), body(&[3]), body(&[4]), body(&[5])],
            links: vec![Link { ends: [on(0), on(2)], rest: None, drive: None }],
            ..Blueprint::default()
        };
        leave_loose(&mut plan);
        let members: Vec<Vec<u32>> = plan.bodies.into_iter().map(|body| body.points).collect();
        assert_eq!(members, [vec![0, 1, 2], vec![4]]);
        assert_eq!(plan.links[0].ends, [on(0), on(1)], "a link goes to where its end is now");
    }
}
