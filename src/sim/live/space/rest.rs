//! In space as in the plane: what touches and is slow settles, and clusters that stay where they are fall asleep.

use super::Space;
use super::cluster::Cluster;
use crate::sim::environment::Environment;
use crate::sim::measure;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{dot, zero};

/// How long a cluster stays where it is before it sleeps `[s]`.
const STILL_TIME: f64 = 0.5;
/// How far its points may get from where they were within that time, in mean edges of their skins: of bodies that touch something, and
/// of others, which nothing stops.
const STILL_WAY: [f64; 2] = [0.1, 5e-4];
/// The same at most `[m]`: 1 cm/s.
const MOST_WAY: f64 = 5e-3;
/// Mean speed below which what touches settles `[m/s]`.
const SLOW: f64 = 1.0;
/// How soon after it became slow `[s]`, how quickly the drag grows `[1/s^2]`, and how large it gets `[1/s]`.
const CALM: f64 = 0.1;
const GROWTH: f64 = 20.0;
const MOST_DRAG: f64 = 10.0;

/// What is known of a body's rest.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rest {
    pub(super) is_asleep: bool,
    /// It touched something in the last step.
    pub(super) touches: bool,
    /// Since when its points are about where they are `[s]`.
    since: Option<f64>,
    /// How long it has been slow and touched something `[s]`.
    calm: f64,
}

impl<S: Real> Space<S> {
    /// Wakes bodies that something was done to: the cursor reaches them, or they were given a velocity.
    pub(super) fn wake(&mut self, points: &Points<S, 3>, around: &Environment<3>, span: (f64, f64)) {
        for body in 0..self.rests.len() {
            if !self.rests[body].is_asleep {
                continue;
            }
            let slots = &self.bodies.order[self.bodies.list[body].points.range()];
            let moves = slots.iter().any(|&slot| points.velocity[slot as usize] != zero());
            let places: Vec<[S; 3]> = slots.iter().map(|&slot| points.position[slot as usize]).collect();
            let is_reached = || measure::extent(&places).is_some_and(|bounds| around.may_reach(bounds, span));
            if moves || is_reached() {
                self.rests[body] = Rest::default();
            }
        }
    }

    /// How much the bodies of a cluster are slowed down in the next step.
    pub(super) fn settle(&mut self, cluster: &Cluster<S>, h: f64) {
        let mut touches = vec![[0_u32; 2]; cluster.bodies.len()];
        let mut note = |i: u32, slips: bool| {
            if let Some(touches) = touches.get_mut(cluster.body_of[i as usize] as usize) {
                touches[usize::from(slips)] += 1;
            }
        };
        for pair in cluster.pairs.iter().filter(|pair| pair.pressed > S::ZERO) {
            note(pair.points[0], pair.slips);
            note(pair.points[1], pair.slips);
        }
        for touch in cluster.touches.iter().filter(|touch| touch.pressed > S::ZERO) {
            note(touch.points[0], touch.slips);
        }
        for (k, &body) in cluster.bodies.iter().enumerate() {
            let range = cluster.bases[k] as usize..cluster.bases[k + 1] as usize;
            let count = S::from_f64(range.len() as f64);
            let square = cluster.velocity[range].iter().fold(S::ZERO, |sum, &v| sum + dot(v, v)) / count;
            let [sticks, slips] = touches[k];
            let is_calm = square < S::from_f64(SLOW * SLOW) && sticks + slips > 0 && slips <= sticks;
            let rest = &mut self.rests[body];
            rest.touches = sticks + slips > 0;
            rest.calm = if is_calm && self.settles { rest.calm + h } else { 0.0 };
            self.settling[body] = S::from_f64((GROWTH * (rest.calm - CALM)).clamp(0.0, MOST_DRAG));
        }
    }

    /// Looks which clusters stayed where they are, at time `t` `[s]`.
    pub(super) fn doze(&mut self, clusters: &[Cluster<S>], points: &mut Points<S, 3>, t: f64) {
        if self.anchor.is_empty() {
            self.anchor = self.bodies.order.iter().map(|&slot| points.position[slot as usize]).collect();
        }
        for cluster in clusters {
            let mut is_still = true;
            for &body in &cluster.bodies {
                is_still &= self.is_still(body, points, t);
            }
            if !is_still {
                continue;
            }
            for &body in &cluster.bodies {
                self.rests[body] = Rest { is_asleep: true, ..Rest::default() };
                self.settling[body] = S::ZERO;
                for &slot in &self.bodies.order[self.bodies.list[body].points.range()] {
                    points.velocity[slot as usize] = zero();
                }
            }
        }
    }

    fn is_still(&mut self, body: usize, points: &Points<S, 3>, t: f64) -> bool {
        let of = &self.bodies.list[body];
        let scale = if of.edge_length > S::ZERO { of.edge_length } else { S::from_f64(0.1) };
        let share = S::from_f64(STILL_WAY[usize::from(!self.rests[body].touches)]);
        let most = (scale * share).min(S::from_f64(MOST_WAY));
        let slots = &self.bodies.order[of.points.range()];
        let anchor = &mut self.anchor[of.points.range()];
        let is_near =
            |(&slot, at): (&u32, &[S; 3])| (0..3).all(|k| (points.position[slot as usize][k] - at[k]).abs() <= most);
        let rest = &mut self.rests[body];
        match rest.since {
            Some(since) if slots.iter().zip(anchor.iter()).all(is_near) => t - since >= STILL_TIME,
            _ => {
                slots.iter().zip(anchor).for_each(|(&slot, at)| *at = points.position[slot as usize]);
                rest.since = Some(t);
                false
            }
        }
    }
}
