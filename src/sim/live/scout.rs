//! What bodies may meet soon: for those who ask whether the live step has to move them.

use super::Live;
use super::detect;
use super::gather::Motion;
use super::pair::Pair;
use crate::sim::bulk::mover::Part;
use crate::sim::environment::Environment;
use crate::sim::force::area::size;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::swept::{Span, Swept};
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Steps until a body is looked at again, if all goes on as it does, and how much faster it may get meanwhile.
const STEPS: f64 = 8.0;
const FASTER: f64 = 1.5;
/// How much more of its area than it has to keep a triangle has as long as somebody else moves it, and until somebody else may `[1]`.
const SPARE: f64 = 0.05;
const AMPLE: f64 = 0.15;
/// Share of the mean edge that is left between skins which do not touch yet.
const APART: f64 = 0.05;

impl<S: Real> Live<S> {
    /// The boxes of all bodies, as [`Mover::reaches`](crate::sim::bulk::mover::Mover::reaches).
    pub(super) fn all_reaches(&self, points: &Points<S, 2>, span: Span) -> Vec<Swept<S, 2>> {
        if !self.contact.is_some_and(|contact| contact.with_others) {
            return Vec::new();
        }
        let of = |body: usize| self.reach(body, points, span, S::from_f64(APART));
        (0..self.bodies.list.len()).filter_map(of).collect()
    }

    /// The bodies that may meet within `h` `[s]`.
    pub(super) fn all_parts(
        &self,
        points: &Points<S, 2>,
        (pull, around): (&Pull<S, 2>, &Environment<2>),
        h: f64,
    ) -> Vec<Part> {
        let common = self.common(pull, (&self.sides, &self.loads));
        let of = |bodies: Vec<usize>| {
            let own = bodies.iter().flat_map(|&body| &self.bodies.order[self.bodies.list[body].points.range()]);
            let slots = own.copied().collect();
            if bodies.len() > 1 {
                return Part { slots, is_free: false };
            }
            let own_bodies = bodies.clone();
            let mut cluster = self.cluster(bodies, points, &common, |_| Motion::OfPoints);
            detect::look(&mut cluster, &common);
            // Sides of obstacles are met by points in all methods; what is around a corner is no nearer than that.
            let own = cluster.own() as u32;
            let is_known = |pair: &Pair<S>| pair.a >= own && pair.p < own || pair.side == S::ZERO;
            let is_whole = cluster.tangle.is_empty() && !self.is_flat(points, &own_bodies, AMPLE);
            Part { slots, is_free: is_whole && cluster.pairs.iter().all(is_known) }
        };
        self.together(points, (pull, around), h).into_iter().map(of).collect()
    }

    /// Whether a triangle of some bodies has hardly more of its area than it has to keep.
    fn is_flat(&self, points: &Points<S, 2>, bodies: &[usize], spare: f64) -> bool {
        let least = S::from_f64(self.resist.least + spare);
        bodies.iter().any(|&body| {
            let of = &self.bodies.list[body];
            let slots = &self.bodies.order[of.points.range()];
            let place = |corner: u32| points.position[slots[corner as usize] as usize];
            self.bodies.areas[of.areas.range()].iter().any(|area| size(area.corners.map(place)) < least * area.rest)
        })
    }

    /// Whether a body that somebody else moves may meet itself within `h` `[s]`, or is pressed flat. What it does as a whole brings it no
    /// nearer to itself.
    pub(super) fn scout(&mut self, points: &Points<S, 2>, h: f64) -> bool {
        let all: Vec<usize> = (0..self.bodies.list.len()).collect();
        if self.is_flat(points, &all, SPARE) {
            return true;
        }
        if self.bodies.edges.is_empty() || !self.contact.is_some_and(|contact| contact.with_itself) {
            return false;
        }
        let fastest = self.bodies.list.iter().map(|body| {
            let slots = &self.bodies.order[body.points.range()];
            deformation(slots.iter().map(|&slot| (points.position[slot as usize], points.velocity[slot as usize])))
        });
        let fastest = fastest.fold(S::ZERO, S::max);
        let way = fastest * S::from_f64(2.0 * FASTER * h);
        let edge = self.bodies.list.iter().fold(S::ZERO, |most, body| most.max(body.edge_length));
        let least = way + edge * S::from_f64(2.0 * APART);
        self.room -= way;
        if self.room > least {
            return false;
        }
        let walls = super::Walls::default();
        let common = super::Common {
            bodies: &self.bodies,
            walls: &walls,
            contact: self.contact.as_ref(),
            resist: self.resist,
            surfaces: &[],
            planes: &[],
            sides: &self.sides,
            loads: &self.loads,
            most_push: 0.0,
        };
        let mut cluster = self.cluster(all, points, &common, |_| Motion::OfPoints);
        let promise = cluster.least_promise.max(way * S::from_f64(STEPS));
        detect::look_within(&mut cluster, &common, promise);
        self.room = cluster.pairs.iter().fold(promise + promise, |least, pair| least.min(pair.room));
        self.room <= least
    }
}

/// How fast the fastest of these points, each with its velocity, goes besides what all do together `[m/s]`.
fn deformation<S: Real>(points: impl Iterator<Item = ([S; 2], [S; 2])> + Clone) -> S {
    let (mut count, mut middle, mut drift) = (S::ZERO, zero::<S, 2>(), zero::<S, 2>());
    for (x, v) in points.clone() {
        count += S::ONE;
        middle = add(middle, x);
        drift = add(drift, v);
    }
    let (middle, drift) = (scale(middle, S::ONE / count), scale(drift, S::ONE / count));
    let (mut moment, mut inertia) = (S::ZERO, S::ZERO);
    for (x, v) in points.clone() {
        let (r, u) = (sub(x, middle), sub(v, drift));
        moment += r[0] * u[1] - r[1] * u[0];
        inertia += dot(r, r);
    }
    let turn = if inertia > S::ZERO { moment / inertia } else { S::ZERO };
    let own = points.map(|(x, v)| {
        let r = sub(x, middle);
        let u = sub(sub(v, drift), [-turn * r[1], turn * r[0]]);
        dot(u, u)
    });
    own.fold(S::ZERO, S::max).sqrt()
}
