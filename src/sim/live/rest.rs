//! What touches and is slow settles, and clusters that stay where they are fall asleep.

use super::Live;
use super::cluster::Cluster;
use super::ground::supported;
use crate::sim::environment::Environment;
use crate::sim::measure;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{dot, zero};

/// How long a cluster stays where it is before it sleeps `[s]`; and so long what touches something while all of it hangs, which swings: at its
/// turning points it is slow for less.
const STILL_TIME: f64 = 0.5;
const HANGING_TIME: f64 = 4.0;
/// How far its points may get from where they were within that time, in mean edges of their skins: of bodies that touch something, hops
/// apart, and of others, which nothing stops.
const STILL_WAY: [f64; 2] = [0.1, 5e-4];
/// The same at most `[m]`: 1 cm/s.
const MOST_WAY: f64 = 5e-3;
/// How many times as far a body gets that keeps no speed from step to step, for what is squeezed so that its contacts never all agree trembles;
/// and one that has been slow for so long and does not slide `[s]`: it rolls on as slowly as what settles it lets it.
const TREMBLE: f64 = 5.0;
const LONG: f64 = 2.0;
/// Mean speed below which what touches settles `[m/s]`, and below which what is rigid does: that does not swing, and is to tip and roll.
const SLOW: [f64; 2] = [1.0, 0.1];
/// How long it may touch nothing meanwhile `[s]`: it hops.
const HOP: f64 = 0.25;
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
    /// How long it has been slow and touched something, hops apart `[s]`, and how long of that it did not slide.
    slow: f64,
    calm: f64,
    /// How long more of its contacts have slid than held `[s]`.
    slid: f64,
    /// How long it has touched nothing `[s]`, and how long it has been unsupported.
    aloft: f64,
    hung: f64,
    /// Its share of the energy that its cluster owes `[J]`.
    pub(super) debt: f64,
    /// How it lies in others, and whether pins hold it there.
    pub(super) lies: Lies,
    pub(super) is_tethered: bool,
    /// How fast what its rigid bonds pull at swings across them, where they are solved at once, in the mean of the last step `[rad/s]`; infinite where nobody looked.
    pub(super) swing: f64,
}

/// How a body lies in obstacles, in others or in itself since it began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Lies {
    /// Nobody looked.
    Anyhow,
    /// It began in them, and is led out slowly.
    Within,
    /// It is out: what gets in from now on is put out at once.
    #[default]
    Clear,
}

impl Rest {
    /// Of a body that nobody looked at yet.
    pub(super) fn fresh() -> Self {
        Rest { lies: Lies::Anyhow, swing: f64::INFINITY, ..Rest::default() }
    }

    /// It has been slow and touched something for a while: its springs are damped.
    pub(super) fn settles(self) -> bool {
        self.slow > CALM
    }

    /// The same, awake.
    pub(super) fn awake(self) -> Self {
        Rest { is_asleep: false, since: None, ..self }
    }

    /// Nothing is known but how it lies in others, which does not end by itself.
    fn anew(self) -> Self {
        Rest { lies: self.lies, is_tethered: self.is_tethered, swing: self.swing, ..Rest::default() }
    }
}

impl<S: Real> Live<S> {
    /// Wakes bodies that something was done to: the cursor reaches them in the step that begins, or they were given a velocity.
    pub(super) fn wake(&mut self, points: &Points<S, 2>, around: &Environment<2>, span: (f64, f64)) {
        for body in 0..self.rests.len() {
            if !self.rests[body].is_asleep {
                continue;
            }
            let slots = &self.bodies.order[self.bodies.list[body].points.range()];
            let moves = slots.iter().any(|&slot| points.velocity[slot as usize] != zero());
            if moves || self.is_reached(body, points, (around, span)) {
                self.rests[body] = self.rests[body].anew();
            }
        }
    }

    /// Whether the mouse force may reach a body within a span `[s]`.
    pub(super) fn is_reached(
        &self,
        body: usize,
        points: &Points<S, 2>,
        (around, span): (&Environment<2>, (f64, f64)),
    ) -> bool {
        let slots = &self.bodies.order[self.bodies.list[body].points.range()];
        let places: Vec<[S; 2]> = slots.iter().map(|&slot| points.position[slot as usize]).collect();
        measure::extent(&places).is_some_and(|bounds| around.may_reach(bounds, span))
    }

    /// Wakes bodies that a drive moves from time `t` on `[s]`.
    pub(super) fn wake_driven(&mut self, around: &Environment<2>, t: f64) {
        let Live { sources, rests, .. } = self;
        for body in sources.iter().filter_map(|source| source.moves(t, &around.keys)) {
            if rests[body].is_asleep {
                rests[body] = rests[body].anew();
            }
        }
    }

    /// How much the bodies of a cluster are slowed down in the next step; what a drive moves is not.
    pub(super) fn settle(&mut self, cluster: &Cluster<S>, (around, t): (&Environment<2>, f64), h: f64) {
        let driven: Vec<usize> = self.sources.iter().filter_map(|source| source.moves(t, &around.keys)).collect();
        let mut touches = vec![[0_u32; 2]; cluster.bodies.len()];
        let mut note = |i: u32, slips: bool| {
            if let Some(touches) = touches.get_mut(cluster.body_of[i as usize] as usize) {
                touches[usize::from(slips)] += 1;
            }
        };
        for pair in cluster.pairs.iter().filter(|pair| pair.contact.pressed > S::ZERO) {
            let slips = pair.contact.slips(pair.friction);
            note(pair.p, slips);
            note(pair.a, slips);
        }
        for on in cluster.on_planes.iter().filter(|on| on.contact.pressed > S::ZERO) {
            note(on.p, on.slips);
        }
        // What touches nothing is not asked.
        let is_any = touches.iter().any(|of| of.iter().sum::<u32>() > 0);
        let supported = if is_any { supported(cluster, around.gravity) } else { vec![false; cluster.bodies.len()] };
        let all = cluster.bodies.iter().map(|&body| self.bodies.list[body].points.len() as f64).sum::<f64>();
        for (k, &body) in cluster.bodies.iter().enumerate() {
            let range = cluster.bases[k] as usize..cluster.bases[k + 1] as usize;
            let square = match cluster.whole(k as u32) {
                Some(frame) => S::from_f64(frame.mean_square()),
                None => {
                    let count = S::from_f64(range.len() as f64);
                    cluster.velocity[range].iter().fold(S::ZERO, |sum, &v| sum + dot(v, v)) / count
                }
            };
            let count = S::from_f64(self.bodies.list[body].points.len() as f64);
            let [sticks, slips] = touches[k];
            let rest = &mut self.rests[body];
            rest.debt = (cluster.debt * count).to_f64() / all;
            rest.lies = match cluster.stands(k) {
                true => rest.lies,
                false if cluster.sunk[k] => Lies::Within,
                false => Lies::Clear,
            };
            rest.is_tethered = cluster.sunk[k] && cluster.tethers.holds(k);
            rest.touches = sticks + slips > 0;
            rest.aloft = if rest.touches { 0.0 } else { rest.aloft + h };
            rest.hung = if rest.touches && supported[k] { 0.0 } else { rest.hung + h };
            let slow = S::from_f64(SLOW[usize::from(cluster.is_rigid(k as u32))]);
            let is_slow = square < slow * slow && rest.hung < HOP && self.settles && !driven.contains(&body);
            // What hops settles where it touches, and what slides on is slowed down by friction alone.
            let goes_on = if rest.touches { h } else { 0.0 };
            rest.slow = if is_slow { rest.slow + goes_on } else { 0.0 };
            rest.calm = if is_slow && slips <= sticks { rest.calm + goes_on } else { 0.0 };
            rest.slid = if slips > sticks { rest.slid + h } else { 0.0 };
            let drag = if rest.touches { GROWTH * (rest.calm - CALM) } else { 0.0 };
            self.settling[body] = S::from_f64(drag.clamp(0.0, MOST_DRAG));
        }
    }

    /// Looks which clusters stayed where they are, at time `t` `[s]`. What is inside out is led back before it sleeps.
    pub(super) fn doze(
        &mut self,
        clusters: &[Cluster<S>],
        points: &mut Points<S, 2>,
        (around, t): (&Environment<2>, f64),
    ) {
        if self.anchor.is_empty() {
            self.anchor = self.bodies.order.iter().map(|&slot| points.position[slot as usize]).collect();
        }
        let driven: Vec<usize> = self.sources.iter().filter_map(|source| source.moves(t, &around.keys)).collect();
        for cluster in clusters {
            let mut is_still = true;
            for &body in &cluster.bodies {
                is_still &= self.is_still(body, points, t) && !driven.contains(&body) && !self.tangle.is_opened(body);
            }
            if !is_still {
                continue;
            }
            for &body in &cluster.bodies {
                self.rests[body] = Rest { is_asleep: true, ..self.rests[body].anew() };
                self.settling[body] = S::ZERO;
                for &slot in &self.bodies.order[self.bodies.list[body].points.range()] {
                    points.velocity[slot as usize] = zero();
                }
            }
        }
    }

    fn is_still(&mut self, body: usize, points: &Points<S, 2>, t: f64) -> bool {
        let of = &self.bodies.list[body];
        let scale = if of.edge_length > S::ZERO { of.edge_length } else { S::from_f64(0.1) };
        let rest = self.rests[body];
        let lies = rest.hung < HOP;
        let hangs = !lies && rest.aloft < HOP;
        let share = S::from_f64(STILL_WAY[usize::from(!lies && !hangs)]);
        let time = if hangs { HANGING_TIME } else { STILL_TIME };
        let slots = &self.bodies.order[of.points.range()];
        let is_speedless = || slots.iter().all(|&slot| points.velocity[slot as usize] == zero());
        let is_lazy = lies && ((rest.slow > LONG && rest.slid < HOP) || is_speedless());
        let times = S::from_f64(if is_lazy { TREMBLE } else { 1.0 });
        let most = times * (scale * share).min(S::from_f64(MOST_WAY));
        let anchor = &mut self.anchor[of.points.range()];
        let is_near =
            |(&slot, at): (&u32, &[S; 2])| (0..2).all(|k| (points.position[slot as usize][k] - at[k]).abs() <= most);
        let rest = &mut self.rests[body];
        match rest.since {
            Some(since) if slots.iter().zip(anchor.iter()).all(is_near) => t - since >= time,
            _ => {
                slots.iter().zip(anchor).for_each(|(&slot, at)| *at = points.position[slot as usize]);
                rest.since = Some(t);
                false
            }
        }
    }
}
