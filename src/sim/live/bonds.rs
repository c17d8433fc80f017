//! Bonds of a cluster: forces where a substep resolves them, projections where it does not.

use super::body::{Body, Link};
use super::cluster::{Cluster, Common};
use super::{FRAMES, tree};
use crate::sim::bond::Limit;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Most of (w h)^2 and of the decay in a substep at which springs are forces: 4 and 2 would be the edge of stability.
pub(super) const MOST_PHASE: f64 = 2.0;
pub(super) const MOST_DECAY: f64 = 0.5;
/// Most substeps of a frame that a body is given so that its springs can be forces, which keep its energy: stiffer ones are projected.
const MOST_SUBSTEPS: f64 = 32.0;

/// Whether the springs of a body are forces in substeps of `h` [s]: in flight, where those keep its energy; what touches something is
/// to come to rest.
fn are_forces<S: Real>(body: &Body<S>, touches: bool, h: S) -> bool {
    !touches && body.stiffness * h * h <= S::from_f64(MOST_PHASE) && body.decay * h <= S::from_f64(MOST_DECAY)
}

/// Substeps of a frame that the springs of a body need to be forces, by bounds on the square of their fastest oscillation [1/s^2] and on
/// their fastest decay [1/s]; 0 where they would need too many.
pub(super) fn substeps(stiffness: f64, decay: f64) -> u32 {
    let wanted = ((stiffness / MOST_PHASE).sqrt().max(decay / MOST_DECAY) / FRAMES).ceil();
    if wanted <= MOST_SUBSTEPS { wanted as u32 } else { 0 }
}

/// What springs that are forces give to velocities in `h` [s].
pub(super) fn pull<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    for (k, (body, base)) in state.members(common).enumerate() {
        if !are_forces(body, state.touches[k], h) {
            continue;
        }
        let links = common.springs(body);
        state.counts.bonds += links.len() as u64;
        state.counts.work += 30 * links.len() as u64;
        for link in links {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let d = sub(state.now[a], state.now[b]);
            let length = dot(d, d).sqrt();
            let v = sub(state.velocity[a], state.velocity[b]);
            let force = match link.rest == S::ZERO {
                true => add(scale(d, link.stiffness), scale(v, link.damping)),
                false if length == S::ZERO || is_slack(link, length) => continue,
                false => {
                    let along = scale(d, S::ONE / length);
                    scale(along, link.stiffness * (length - link.rest) + link.damping * dot(v, along))
                }
            };
            state.velocity[a] = sub(state.velocity[a], scale(force, h * state.w[a]));
            state.velocity[b] = add(state.velocity[b], scale(force, h * state.w[b]));
        }
    }
}

fn is_slack<S: Real>(link: &Link<S>, length: S) -> bool {
    match link.limit {
        Limit::Both => false,
        Limit::Max => length <= link.rest,
        Limit::Min => length >= link.rest,
    }
}

/// What a bond that is projected needs, worked out once for all substeps of `h` [s].
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold<S> {
    a: u32,
    b: u32,
    rest: S,
    /// Of an error what the multiplier is.
    inverse: S,
    /// What the damper adds to an error for each metre of the way.
    drag: S,
    most: S,
    limit: Limit,
}

impl<S: Real> Hold<S> {
    /// `None` of a bond that cannot pull.
    fn new(link: &Link<S>, base: usize, w: &[S], h: S) -> Option<Self> {
        let (a, b) = (base as u32 + link.a, base as u32 + link.b);
        let sum = w[a as usize] + w[b as usize];
        let is_rigid = !link.stiffness.is_finite();
        let softness = if is_rigid { S::ZERO } else { S::ONE / (link.stiffness * h * h) };
        let drag = if is_rigid { S::ZERO } else { link.damping / (link.stiffness * h) };
        let inverse = link.share / ((S::ONE + drag) * sum + softness);
        (sum > S::ZERO && link.stiffness > S::ZERO).then_some(Hold {
            a,
            b,
            rest: link.rest,
            inverse,
            drag,
            most: link.most,
            limit: link.limit,
        })
    }
}

/// Works out what the bonds of a cluster that are projected need in substeps of `h` [s].
pub(super) fn prepare<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let mut holds = std::mem::take(&mut state.holds);
    holds.clear();
    for (k, (body, base)) in state.members(common).enumerate() {
        let springs = common.springs(body).iter().filter(|_| !are_forces(body, state.touches[k], h));
        let rigid = &common.holds(body)[body.tree as usize..];
        holds.extend(springs.chain(rigid).filter_map(|link| Hold::new(link, base, &state.w, h)));
    }
    state.holds = holds;
}

/// One sweep over the bonds that are held, and over springs too stiff to be forces, each along its present direction.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    for (body, base) in state.members(common).filter(|(body, _)| body.tree > 0) {
        tree::solve(state, &common.holds(body)[..body.tree as usize], (base, body.points.len()));
    }
    let holds = std::mem::take(&mut state.holds);
    project(state, &holds);
    state.holds = holds;
}

/// Each bond in turn as a compliant constraint whose multiplier starts at 0.
fn project<S: Real>(state: &mut Cluster<S>, holds: &[Hold<S>]) {
    state.counts.bonds += holds.len() as u64;
    state.counts.work += 30 * holds.len() as u64;
    let Cluster { now, way, w, .. } = state;
    for hold in holds {
        let (a, b) = (hold.a as usize, hold.b as usize);
        let d = sub(now[a], now[b]);
        let length = dot(d, d).sqrt();
        let is_slack = match hold.limit {
            Limit::Both => false,
            Limit::Max => length <= hold.rest,
            Limit::Min => length >= hold.rest,
        };
        if length == S::ZERO || is_slack {
            continue;
        }
        let along = scale(d, S::ONE / length);
        let mut error = length - hold.rest;
        if hold.drag != S::ZERO {
            error += hold.drag * dot(sub(way[a], way[b]), along);
        }
        if hold.most.is_finite() {
            let most = hold.most * length;
            error = error.max(-most).min(most);
        }
        let shift = scale(along, error * hold.inverse);
        for (i, share) in [(a, -w[a]), (b, w[b])] {
            let own = scale(shift, share);
            now[i] = add(now[i], own);
            way[i] = add(way[i], own);
        }
    }
}
