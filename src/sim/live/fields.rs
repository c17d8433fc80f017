//! Constant forces, torques and wind in a cluster.

use super::build::Bodies;
use super::cluster::Cluster;
use super::given::Giver;
use super::substep::Outside;
use crate::sim::force::steady::Thrust;
use crate::sim::force::wind::OF_A_GUST;
use crate::sim::real::Real;
use crate::sim::sets::Sets;
use crate::sim::vector::{add, convert, scale, widen};

/// A force, with its points by body: they go together.
#[derive(Clone, Debug)]
pub(super) struct Field<S> {
    thrust: Thrust<S, 2>,
    /// Body and place in it of every point.
    points: Vec<(u32, u32)>,
}

impl<S: Real> Field<S> {
    /// Those of a group, whose points are numbered there.
    pub(super) fn list(thrusts: &[Thrust<S, 2>], bodies: &Bodies<S>) -> Vec<Self> {
        if thrusts.is_empty() {
            return Vec::new();
        }
        let mut places = vec![(0, 0); bodies.order.len()];
        for (body, number) in bodies.list.iter().zip(0..) {
            let slots = &bodies.order[body.points.range()];
            slots.iter().zip(0..).for_each(|(&slot, local)| places[slot as usize] = (number, local));
        }
        let of = |thrust: &Thrust<S, 2>| Field {
            points: thrust.slots.iter().map(|&slot| places[slot as usize]).collect(),
            thrust: thrust.clone(),
        };
        thrusts.iter().map(of).collect()
    }

    /// Whether it acts on a body.
    pub(super) fn is_at(&self, body: usize) -> bool {
        self.points.iter().any(|point| point.0 as usize == body)
    }

    /// Bodies that it acts on are of one cluster.
    pub(super) fn join(&self, together: &mut Sets) {
        self.points.windows(2).for_each(|pair| together.join(pair[0].0, pair[1].0));
    }

    /// As a cluster of these bodies, whose points begin at `bases`, feels it; `None`: it acts on none of them.
    pub(super) fn within(&self, bodies: &[usize], bases: &[u32]) -> Option<Thrust<S, 2>> {
        let slot =
            |&(body, local): &(u32, u32)| bodies.binary_search(&(body as usize)).ok().map(|place| bases[place] + local);
        let slots: Option<Vec<u32>> = self.points.iter().map(slot).collect();
        slots.map(|slots| Thrust { slots, ..self.thrust.clone() })
    }
}

/// What forces and wind make of velocities in `h` `[s]` from `t` `[s]`, after drag: it is exact in the drag towards the wind.
pub(super) fn blow<S: Real>(state: &mut Cluster<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let pull = outside.pull;
    let time = S::from_f64(h);
    let thrusts = std::mem::take(&mut state.thrusts);
    for thrust in &thrusts {
        let Cluster { now, velocity, w, given, .. } = &mut *state;
        thrust.each(now, w, |i, push| {
            let gain = scale(push, time);
            given.give(velocity, i, Giver::Forces, [gain, gain]);
        });
    }
    state.thrusts = thrusts;
    let Some(air) = &pull.air else { return };
    let share = -libm::expm1(-h * pull.drag_rate);
    if air.has_gusts() {
        state.counts.work += OF_A_GUST * state.own() as u64;
    }
    for i in (0..state.own()).filter(|&i| state.w[i] != S::ZERO) {
        let gust = air.gust(widen(state.now[i]), t + 0.5 * h);
        // What the mean wind does is a part of the energy that the guard looks at.
        let all: [S; 2] = convert(scale(add(air.mean, gust), share));
        state.given.give(&mut state.velocity, i, Giver::Wind, [all, convert(scale(gust, share))]);
    }
}
