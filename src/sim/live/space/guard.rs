//! The last line, as in the plane: a cluster has no more energy after a step than before, and what was done to it.

use super::bonds::{are_forces, is_slack};
use super::cluster::{Cluster, Common};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Share of the kinetic and elastic energy that contacts may make in a step without being seen: overlaps that are mended load springs. Of what has
/// none, rounding alone.
const SLACK: f64 = 1e-3;
const ROUNDING: f64 = 1e-7;

/// Share of the motion of its own that is taken of it in a step for what springs have as they are. Where that is not enough, they are strained by
/// what sweeps leave of them: what they can give back counts, else what is large and stiff would stop in mid-air.
const MOST: f64 = 0.25;

/// Kinetic, elastic and gravity's energy of springs as they are, and of what they can give back `[J]`.
pub(super) fn energy<S: Real>(state: &Cluster<S>, common: &Common<S>, gravity: [f64; 3]) -> [S; 2] {
    let (kinetic, fall) = moving(state, gravity);
    elastic(state, common).map(|elastic| kinetic + fall + elastic)
}

fn moving<S: Real>(state: &Cluster<S>, gravity: [f64; 3]) -> (S, S) {
    let gravity = gravity.map(S::from_f64);
    let (mut kinetic, mut fall) = (S::ZERO, S::ZERO);
    let middle = state.now.first().copied().unwrap_or(zero());
    for i in 0..state.now.len() {
        if state.w[i] != S::ZERO {
            let mass = S::ONE / state.w[i];
            kinetic += S::HALF * mass * dot(state.velocity[i], state.velocity[i]);
            fall -= mass * dot(gravity, sub(state.now[i], middle));
        }
    }
    let mass =
        (0..state.now.len()).filter(|&i| state.w[i] != S::ZERO).fold(S::ZERO, |sum, i| sum + S::ONE / state.w[i]);
    (kinetic, fall - mass * dot(gravity, middle))
}

/// What springs have, and what they can give back `[J]`: as in the plane, less of those that are projected.
fn elastic<S: Real>(state: &Cluster<S>, common: &Common<S>) -> [S; 2] {
    let [mut all, mut sum] = [S::ZERO; 2];
    let square = state.span * state.span;
    for ((body, base), &touched) in state.members(common).zip(&state.touched) {
        let slow = if are_forces(body, touched, state.span) { S::ZERO } else { square };
        for link in common.bodies.springs(body) {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let d = sub(state.now[a], state.now[b]);
            let length = dot(d, d).sqrt();
            if !is_slack(link.limit, length, link.rest) {
                let error = length - link.rest;
                let share = S::ONE + link.stiffness * slow * (state.w[a] + state.w[b]);
                let energy = S::HALF * link.stiffness * error * error;
                all += energy;
                sum += energy / share;
            }
        }
    }
    [all, sum]
}

/// Slows points down until the energy fits: about their mean velocity, whose momentum stays, unless something holds them.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>, (before, gravity): ([S; 2], [f64; 3])) {
    // Springs alone keep their energy, which swings about its mean within a substep. Sweeps over rigid bonds make some in flight too.
    let is_rigid = state.members(common).all(|(body, _)| common.bodies.springs(body).is_empty());
    if !state.has_pressed && !is_rigid {
        return;
    }
    // Pins that are led do work that nobody counts.
    let is_led =
        (0..state.now.len()).any(|i| state.w[i] == S::ZERO && dot(state.velocity[i], state.velocity[i]) > S::ZERO);
    if is_led {
        return;
    }
    let (kinetic, fall) = moving(state, gravity);
    let elastic = elastic(state, common);
    let [excess, less] = [0, 1].map(|k| {
        let excess = kinetic + fall + elastic[k] - before[k] - state.work;
        let slack = if is_rigid { ROUNDING } else { SLACK };
        if excess <= S::from_f64(slack) * (kinetic + elastic[k]) { S::ZERO } else { excess }
    });
    if excess <= S::ZERO && less <= S::ZERO || kinetic == S::ZERO {
        return;
    }
    let leans = state.touches.iter().any(|touch| touch.pressed > S::ZERO);
    let is_held = leans || (0..state.now.len()).any(|i| state.w[i] == S::ZERO);
    let (mut momentum, mut mass) = (zero::<S, 3>(), S::ZERO);
    for i in (0..state.now.len()).filter(|&i| state.w[i] != S::ZERO && !is_held) {
        momentum = add(momentum, scale(state.velocity[i], S::ONE / state.w[i]));
        mass += S::ONE / state.w[i];
    }
    let mean = if mass > S::ZERO { scale(momentum, S::ONE / mass) } else { zero() };
    let own = kinetic - S::HALF * mass * dot(mean, mean);
    let taken = excess.min(less.max(S::from_f64(MOST) * own)).max(less);
    let kept = if own > S::ZERO { (S::ONE - taken / own).max(S::ZERO).sqrt() } else { S::ONE };
    for i in 0..state.now.len() {
        if state.w[i] != S::ZERO {
            state.velocity[i] = add(mean, scale(sub(state.velocity[i], mean), kept));
        }
    }
    state.counts.guarded += 1;
}
