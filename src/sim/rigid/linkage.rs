//! Bodies that joints hold together: what they are made of, and how their motion is read from points.

use super::blueprint::{Blueprint, BodyPlan};
use super::body::Body;
use super::inertia::{Inertia, Inertial};
use super::joints::Joints;
use super::link::{Anchor, Clock, Stand};
use super::motion::Motion;
use super::motion::Twist;
use super::solid::lift;
use super::strings::Strand;
use super::ties::Ties;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, flat, scale, widen};

/// Rounds in which gaps at joints are closed.
pub(super) const ROUNDS: u32 = 30;
/// A gap that counts as none, as a share of where things are `[1]`.
pub(super) const FITS: f64 = 4e-15;

/// Bodies that joints hold together, or one alone.
#[derive(Clone, Debug)]
pub(super) struct Linkage {
    pub(super) bodies: Vec<Body>,
    pub(super) inertias: Vec<Inertia>,
    pub(super) joints: Joints,
    /// Strings between its bodies.
    pub(super) strings: Vec<Strand>,
    /// Points that do not move, as links count them, and those of bodies that stand still, by their places in the group.
    fixed: Vec<u32>,
    still: Vec<u32>,
    /// Springs and angles between its bodies.
    pub(super) ties: Ties,
}

impl Linkage {
    /// From a plan, with the places of its points in the group.
    pub(super) fn new(plan: &Blueprint, slots: &[u32], ties: Ties) -> Self {
        let placed = |points: &[u32]| points.iter().map(|&point| slots[point as usize]).collect::<Vec<u32>>();
        let body = |of: &BodyPlan| Body::new(of.shape.clone(), placed(&of.points), of.deaf.clone());
        let bodies: Vec<Body> = plan.bodies.iter().map(body).collect();
        Linkage {
            inertias: bodies.iter().map(|body| body.inertia).collect(),
            bodies,
            joints: Joints::new(plan.links.clone()),
            strings: plan.strings.clone(),
            fixed: placed(&plan.fixed),
            still: placed(&plan.still),
            ties,
        }
    }

    /// The body, where it is one that nothing joins to anything.
    pub(super) fn alone(&self) -> Option<&Body> {
        match &self.bodies[..] {
            [body] if self.joints.is_empty() && self.ties.is_empty() && self.strings.is_empty() => Some(body),
            _ => None,
        }
    }

    /// Whether drives change the lengths of rods.
    pub(super) fn is_driven(&self) -> bool {
        self.joints.are_driven()
    }

    /// Where the points are that do not move by themselves, and how they are led.
    pub(super) fn anchors<S: Real, const D: usize>(&self, points: &Points<S, D>) -> Vec<Anchor> {
        let of = |&slot: &u32| Anchor {
            place: flat(widen(points.position[slot as usize])),
            velocity: flat(widen(points.velocity[slot as usize])),
        };
        self.fixed.iter().map(of).collect()
    }

    /// The motion of all bodies, with no more than rounding between them at joints.
    pub(super) fn read<S: Real, const D: usize>(
        &self,
        points: &Points<S, D>,
        (anchors, clock): (&[Anchor], Clock),
    ) -> Vec<Motion> {
        let clock = Some(clock);
        let mut motions: Vec<Motion> = self.bodies.iter().map(|body| body.read(points)).collect();
        if self.joints.is_empty() {
            return motions;
        }
        let closed = 1e3 * FITS * self.size(&motions);
        self.joints.close(&self.inertias, (&mut motions, anchors, clock), (ROUNDS, closed), None);
        let mut twists = twists_of(&motions);
        let joints = self.joints.factored(&self.inertias, Stand { motions: &motions, anchors, since: 0.0, clock });
        joints.hold(&mut twists, &joints.leads);
        motions.iter_mut().zip(twists).for_each(|(motion, twist)| motion.twist = twist);
        motions
    }

    /// Kinetic energy of its bodies `[J]`, as points have it.
    pub(super) fn energy<S: Real, const D: usize>(&self, points: &Points<S, D>) -> f64 {
        self.bodies.iter().map(|body| body.inertia.energy(&body.read(points).twist)).sum()
    }

    /// The same, as it is `[J]`.
    pub(super) fn energy_of(&self, motions: &[Motion]) -> f64 {
        self.bodies.iter().zip(motions).map(|(body, motion)| body.inertia.energy(&motion.twist)).sum()
    }

    /// What stands still has no velocity.
    pub(super) fn stop<S: Real, const D: usize>(&self, points: &mut Points<S, D>) {
        for &slot in &self.still {
            points.velocity[slot as usize] = [S::ZERO; D];
            if let Some(lost) = points.velocity_lost.get_mut(slot as usize) {
                *lost = [S::ZERO; D];
            }
        }
    }

    /// Points that are led go on for `h` `[s]`.
    pub(super) fn lead<S: Real, const D: usize>(&self, points: &mut Points<S, D>, anchors: &[Anchor], h: f64) {
        for (&slot, anchor) in self.fixed.iter().zip(anchors) {
            if anchor.is_led() {
                points.position[slot as usize] = lift(add(anchor.place, scale(anchor.velocity, h)));
            }
        }
    }

    /// How far from the origin it reaches, and 1 `[m]`.
    pub(super) fn size(&self, motions: &[Motion]) -> f64 {
        let of = |(body, motion): (&Body, &Motion)| {
            1.0 + body.reach + motion.place.middle[0].abs() + motion.place.middle[1].abs()
        };
        self.bodies.iter().zip(motions).map(of).fold(0.0, f64::max)
    }

    /// Bytes on the heap, about.
    pub(super) fn heap_bytes(&self) -> usize {
        let of = |body: &Body| {
            body.slots.capacity() * size_of::<u32>() + body.shape.places.capacity() * 3 * size_of::<f64>()
        };
        self.bodies.iter().map(of).sum::<usize>() + 200 * self.joints.rows()
    }
}

/// How all bodies move.
pub(super) fn twists_of(motions: &[Motion]) -> Vec<Twist> {
    motions.iter().map(|motion| motion.twist).collect()
}
