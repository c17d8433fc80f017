//! The last line: a cluster has no more energy after a step than before, and what was done to it.

use super::body::Body;
use super::cluster::{Cluster, Common};
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, scale, sub, widen, zero};

/// How quickly what is owed is forgotten `[1/s]`: gravity's energy that overlaps cost as they were mended is not asked back for ever.
const FORGIVEN: f64 = 0.5;
/// Speed that is left to what is led or owes energy, in the mean `[m/s]`.
const LEFT: f64 = 0.3;
/// Share of the kinetic and elastic energy that contacts may make in a step without being seen: overlaps that are mended load springs. Of
/// what is rigid as a whole, which has none, rounding alone.
const SLACK: f64 = 1e-3;
const ROUNDING: f64 = 1e-7;
/// The same of bodies in joints that nothing touches: what closes those errs by less in a step, unless it fails.
const FAILING: f64 = 0.05;

/// Kinetic and gravity's energy `[J]`.
pub(super) fn energy<S: Real>(state: &Cluster<S>, gravity: [f64; 2]) -> S {
    let (kinetic, fall) = moving(state, gravity);
    kinetic + fall
}

fn moving<S: Real>(state: &Cluster<S>, gravity: [f64; 2]) -> (S, S) {
    let gravity = gravity.map(S::from_f64);
    let (mut kinetic, mut fall) = (S::ZERO, S::ZERO);
    let middle = state.now.first().copied().unwrap_or(zero());
    for i in moved(state) {
        let mass = S::ONE / state.w[i];
        kinetic += S::HALF * mass * dot(state.velocity[i], state.velocity[i]);
        fall -= mass * dot(gravity, sub(state.now[i], middle));
    }
    for frame in state.free() {
        kinetic += S::from_f64(frame.kinetic());
        let from = sub(frame.place().middle, widen(middle));
        fall -= S::from_f64(frame.mass() * dot(widen(gravity), from));
    }
    (kinetic, fall - mass(state) * dot(gravity, middle))
}

/// The points that move, but those that follow bodies which move by themselves.
fn moved<S: Real>(state: &Cluster<S>) -> impl Iterator<Item = usize> + '_ {
    (0..state.own()).filter(|&i| state.w[i] != S::ZERO && !state.is_carried(i))
}

/// The mass of all that moves `[kg]`.
pub(super) fn mass<S: Real>(state: &Cluster<S>) -> S {
    let points = moved(state).fold(S::ZERO, |sum, i| sum + S::ONE / state.w[i]);
    state.free().fold(points, |sum, frame| sum + S::from_f64(frame.mass()))
}

/// What bonds, angles and areas can give back `[J]`: of a spring e longer that is projected in substeps of h, k e^2/(2 (1 + k h^2 w)), for it
/// takes several to give way, and does so the slower the stiffer it is.
pub(super) fn elastic<S: Real>(state: &Cluster<S>, common: &Common<S>) -> S {
    let mut sum = super::drives::elastic(state);
    let square = state.span * state.span;
    let mut by_forces = state.by_forces.iter();
    for (body, base) in state.members(common) {
        sum += super::shape::energy(state, common, (body, base));
        for (link, &is_force) in common.springs(body).iter().zip(by_forces.by_ref()) {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let d = sub(state.now[a], state.now[b]);
            let error = dot(d, d).sqrt() - link.rest;
            if link.limit.acts(error, S::ZERO) {
                let slow = if is_force { S::ZERO } else { link.stiffness * square * (state.w[a] + state.w[b]) };
                sum += S::HALF * link.stiffness / (S::ONE + slow) * error * error;
            }
        }
    }
    sum
}

/// All energy, of springs as they are `[J]`.
pub(super) fn all<S: Real>(state: &mut Cluster<S>, common: &Common<S>, gravity: [f64; 2]) -> S {
    let span = std::mem::replace(&mut state.span, S::ZERO);
    let sum = energy(state, gravity) + elastic(state, common);
    state.span = span;
    sum
}

/// Whether all that holds its points together are rigid bonds that are swept, or solved along directions from before.
fn is_swept<S: Real>(state: &Cluster<S>, common: &Common<S>) -> bool {
    let is_driven = !state.muscles.is_empty() || !state.turns.is_empty();
    let has_trees = || state.members(common).any(|(body, _)| body.tree > 0);
    let has_sweeps = state.is_all_rigid || !state.holds.is_empty() || has_trees();
    // What bends while it is swept takes several steps to give way.
    let gives_at_once = |body: &Body<S>| body.hinges.len() == 0 || body.tree as usize == body.holds.len();
    has_sweeps && !is_driven && state.by_forces.is_empty() && state.members(common).all(|(body, _)| gives_at_once(body))
}

/// Slows points down until the energy fits: about their mean velocity, whose momentum stays, unless something holds them. What they do
/// not have yet is owed: bodies that are led out of each other may squeeze others, whose springs let go later.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>, (before, gravity, h): (S, [f64; 2], f64)) {
    // Springs alone keep their energy, which swings about its mean within a substep.
    let is_led_back = state.counts.mended + state.counts.parted > 0;
    let debt = state.debt * S::from_f64(libm::exp(-h * FORGIVEN));
    state.debt = debt;
    // Rigid bonds alone have none that may swing: what sweeps over them make is seen in flight too.
    let is_swept = is_swept(state, common);
    let is_watched = state.has_pressed || is_led_back || is_swept;
    let is_joined = !state.rigs.is_empty();
    if !is_watched && debt == S::ZERO && !is_joined {
        return;
    }
    // Pins that are led do work that nobody counts.
    let is_led = (0..state.own()).any(|i| state.w[i] == S::ZERO && dot(state.velocity[i], state.velocity[i]) > S::ZERO);
    if is_led {
        return;
    }
    let (kinetic, fall) = moving(state, gravity);
    let elastic = elastic(state, common);
    let excess = kinetic + fall + elastic - before - state.work + debt;
    let is_rigid = elastic == S::ZERO && (0..state.bodies.len() as u32).all(|body| state.is_rigid(body));
    let slack = match is_rigid {
        true => ROUNDING,
        false if is_watched || debt > S::ZERO => SLACK,
        false => FAILING,
    };
    if excess <= S::from_f64(slack) * (kinetic + elastic) {
        state.debt = S::ZERO;
        return;
    }
    let is_held = state.has_leaned || (0..state.own()).any(|i| state.w[i] == S::ZERO);
    let free = mass(state);
    let mut momentum = zero::<S, 2>();
    if !is_held {
        for i in moved(state) {
            momentum = add(momentum, scale(state.velocity[i], S::ONE / state.w[i]));
        }
        for frame in state.free() {
            momentum = add(momentum, convert(scale(frame.twist().velocity, frame.mass())));
        }
    }
    let mass = if is_held { S::ZERO } else { free };
    let mean = if mass > S::ZERO { scale(momentum, S::ONE / mass) } else { zero() };
    let own = kinetic - S::HALF * mass * dot(mean, mean);
    // Bodies that are led, and springs that are to let go, need some speed.
    let left = if debt > S::ZERO || is_led_back { S::HALF * free * S::from_f64(LEFT * LEFT) } else { S::ZERO };
    // In flight springs swing, and only what is owed is asked back.
    let asked = if is_watched || is_joined { excess } else { excess.min(debt) };
    let taken = asked.min((own - left).max(S::ZERO));
    let kept = if taken > S::ZERO { (S::ONE - taken / own).max(S::ZERO).sqrt() } else { S::ONE };
    // What is lifted out of another one is not asked back.
    let missing = (excess - state.lifted - taken).max(S::ZERO);
    state.debt = if is_led_back { missing } else { missing.min(debt) };
    for i in 0..state.own() {
        if state.w[i] != S::ZERO {
            state.velocity[i] = add(mean, scale(sub(state.velocity[i], mean), kept));
        }
    }
    state.frames.iter_mut().filter(|frame| frame.is_free).for_each(|frame| frame.slow(widen(mean), kept.to_f64()));
    state.turn_free();
    state.counts.guarded += 1;
}
