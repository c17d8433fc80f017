//! Bodies that pins hold over an obstacle are led out of it only as far as their bonds yield: a spring that leading stretched would have its
//! energy from nowhere.

use super::cluster::{Cluster, Common};
use super::rest::Lies;
use crate::sim::bond::Limit;
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// What leading a point may pull against its springs, in what gravity and forces give to it: its own weight and as much again, which lifts
/// what hangs on it.
const LIFTS: f64 = 2.0;
/// Share of its length by which leading may strain a rigid bond, which the next substeps take back, and a spring of what has no inside: that gets
/// around what lies on it, or folds.
const STRAINED: f64 = 1e-2;
const STRETCHED: f64 = 0.04;

/// A bond of a point that is led.
#[derive(Clone, Copy, Debug)]
struct Tether<S> {
    point: u32,
    other: u32,
    rest: S,
    /// `[N/m]`; infinite: rigid.
    stiffness: S,
    limit: Limit,
    /// It is of what has no inside, and folds.
    folds: bool,
}

/// The bonds of bodies that are pinned and began in something, in the order of the points.
#[derive(Clone, Debug)]
pub(super) struct Tethers<S> {
    list: Vec<Tether<S>>,
    /// Which of the cluster's bodies.
    bodies: Vec<bool>,
    /// A bound on what gravity and forces give `[m/s^2]`.
    push: S,
}

impl<S: Real> Tethers<S> {
    pub(super) fn none() -> Self {
        Tethers { list: Vec::new(), bodies: Vec::new(), push: S::ZERO }
    }

    /// Whether pins hold one of the cluster's bodies over something.
    #[inline(always)]
    pub(super) fn holds(&self, body: usize) -> bool {
        self.bodies.get(body) == Some(&true)
    }
}

impl<S: Real> Cluster<S> {
    /// Looks which bonds hold what is to be led out in this step.
    pub(super) fn tether(&mut self, common: &Common<S>) {
        let pinned = |ends: &[u32]| (ends[0]..ends[1]).any(|i| self.w[i as usize] == S::ZERO);
        let bodies = self.bases.windows(2).zip(&self.lies).map(|(ends, &lies)| lies == Lies::Within && pinned(ends));
        let bodies: Vec<bool> = bodies.collect();
        self.tethers.list.clear();
        if bodies.contains(&true) {
            for ((body, base), _) in self.members(common).zip(&bodies).filter(|(_, is_held)| **is_held) {
                for link in common.springs(body).iter().chain(common.holds(body)) {
                    let [a, b] = [link.a, link.b].map(|end| base as u32 + end);
                    let tether = |[point, other]: [u32; 2]| Tether {
                        point,
                        other,
                        rest: link.rest,
                        // What is relaxed gives way as slowly as it likes.
                        stiffness: if link.relaxed.is_some() { S::INFINITY } else { link.stiffness },
                        limit: link.limit,
                        folds: body.areas.len() == 0,
                    };
                    self.tethers.list.extend([[a, b], [b, a]].map(tether));
                }
            }
            self.tethers.list.sort_by_key(|tether| tether.point);
        }
        self.tethers.bodies = bodies;
        self.tethers.push = S::from_f64(common.most_push);
    }

    /// Whether a point is of a body that is held so.
    #[inline(always)]
    pub(super) fn is_tethered(&self, i: usize) -> bool {
        self.tethers.holds(self.body_of[i] as usize)
    }

    /// How far a point goes the way `out`, a unit vector, `most` at most, until its bonds hold it `[m]`.
    pub(super) fn yields(&self, i: usize, out: [S; 2], most: S) -> S {
        let first = self.tethers.list.partition_point(|tether| (tether.point as usize) < i);
        let (mut answer, mut stiffness) = (S::ZERO, S::ZERO);
        // As rigid bonds let it, and as springs of what folds.
        let (mut way, mut folding) = (most, most);
        for tether in self.tethers.list[first..].iter().take_while(|tether| tether.point as usize == i) {
            let d = sub(self.start[i], self.start[tether.other as usize]);
            let length = dot(d, d).sqrt();
            let longer = length - tether.rest;
            // At its length it is about to.
            let acts = tether.limit.acts(longer, -S::EPSILON * tether.rest);
            if !acts || length == S::ZERO {
                continue;
            }
            let along = dot(scale(d, S::ONE / length), out);
            let strained = if along > S::ZERO { longer } else { -longer };
            let is_spring = tether.stiffness.is_finite();
            let share = if is_spring { STRETCHED } else { STRAINED };
            let until_strained = match along == S::ZERO {
                true => most,
                false => (tether.rest * S::from_f64(share) - strained) / along.abs(),
            };
            if is_spring {
                answer += tether.stiffness * longer * along;
                stiffness += tether.stiffness;
                folding = folding.min(if tether.folds { until_strained } else { S::ZERO });
            } else {
                way = way.min(until_strained);
            }
        }
        if stiffness > S::ZERO && self.w[i] != S::ZERO {
            let lifting = (self.tethers.push * S::from_f64(LIFTS) / self.w[i] - answer) / stiffness;
            way = way.min(lifting.max(folding));
        }
        way.max(S::ZERO)
    }
}
