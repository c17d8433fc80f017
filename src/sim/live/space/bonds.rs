//! Bonds of a cluster in space: forces where a substep resolves them, projections where it does not, by the rules of the plane.

use super::body::Body;
use super::cluster::{Cluster, Common};
use super::path;
use crate::sim::bond::Limit;
use crate::sim::live::body::Link;
use crate::sim::live::bonds::bears;
use crate::sim::live::strap::{stretch, stretches};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Whether the springs of a body are forces in substeps of `h` `[s]`: in flight, where those keep its energy; what touches something is
/// to come to rest.
pub(super) fn are_forces<S: Real>(body: &Body<S>, touched: bool, h: S) -> bool {
    !touched && bears(body.swing, h)
}

/// What springs that are forces give to velocities in `h` `[s]`.
pub(super) fn pull<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    for (k, (body, base)) in state.members(common).enumerate() {
        if !are_forces(body, state.touched[k], h) {
            continue;
        }
        let links = common.bodies.springs(body);
        state.counts.bonds += links.len() as u64;
        state.counts.work += 30 * links.len() as u64;
        for link in links {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let d = sub(state.now[a], state.now[b]);
            let length = dot(d, d).sqrt();
            let v = sub(state.velocity[a], state.velocity[b]);
            let force = match link.rest == S::ZERO {
                true => add(scale(d, link.stiffness), scale(v, link.damping)),
                false if length == S::ZERO || is_slack(link.limit, length, link.rest) => continue,
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

/// Whether a bond with a limit does not act.
pub(super) fn is_slack<S: Real>(limit: Limit, length: S, rest: S) -> bool {
    match limit {
        Limit::Both => false,
        Limit::Max => length <= rest,
        Limit::Min => length >= rest,
    }
}

/// What a bond that is projected needs, worked out once for all substeps.
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
    is_rigid: bool,
    /// Which member of the cluster it is of, if the rest lengths of that are stretched where pins are led too far apart.
    strapped: Option<u32>,
}

impl<S: Real> Hold<S> {
    /// `None` of a bond that cannot pull.
    fn new(link: &Link<S>, (base, strapped): (usize, Option<u32>), w: &[S], h: S) -> Option<Self> {
        let (a, b) = (base as u32 + link.a, base as u32 + link.b);
        let sum = w[a as usize] + w[b as usize];
        let is_rigid = !link.stiffness.is_finite();
        let softness = if is_rigid { S::ZERO } else { S::ONE / (link.stiffness * h * h) };
        let drag = if is_rigid { S::ZERO } else { link.damping / (link.stiffness * h) };
        let [share, most] = link.relaxed.map_or([S::ONE, S::INFINITY], |relaxed| relaxed.within(h));
        let inverse = share / ((S::ONE + drag) * sum + softness);
        let Link { rest, limit, .. } = *link;
        (sum > S::ZERO && link.stiffness > S::ZERO).then_some(Hold {
            a,
            b,
            rest,
            inverse,
            drag,
            most,
            limit,
            is_rigid,
            strapped: strapped.filter(|_| is_rigid),
        })
    }
}

/// Works out what the bonds of a cluster that are projected need in substeps of `h` `[s]`.
pub(super) fn prepare<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let mut holds = std::mem::take(&mut state.holds);
    holds.clear();
    for (k, (body, base)) in state.members(common).enumerate() {
        let springs = common.bodies.springs(body).iter().filter(|_| !are_forces(body, state.touched[k], h));
        let links = common.bodies.holds(body);
        let rigid = &links[if body.is_path { path::length(links) } else { 0 }..];
        let own = (base, (!body.straps.is_empty()).then_some(k as u32));
        holds.extend(springs.chain(rigid).filter_map(|link| Hold::new(link, own, &state.w, h)));
    }
    state.holds = holds;
}

/// One sweep over the bonds that are held, and over springs too stiff to be forces, each along its present direction.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    for (body, base) in state.members(common).filter(|(body, _)| body.is_path) {
        path::solve(state, common.bodies.holds(body), (base, stretch(&body.straps, &state.now[base..])));
    }
    let holds = std::mem::take(&mut state.holds);
    let stretches = stretches(state.members(common).map(|(body, base)| (&body.straps[..], base)), &state.now);
    // Where something presses, one sweep leaves errors that velocities must not follow.
    let does_turn = !state.has_pressed && !state.touched.contains(&true);
    for hold in &holds {
        let rest = hold.strapped.map_or(hold.rest, |member| hold.rest * stretches[member as usize]);
        hold.project(state, rest, does_turn);
    }
    state.counts.bonds += holds.len() as u64;
    state.counts.work += 30 * holds.len() as u64;
    state.holds = holds;
}

impl<S: Real> Hold<S> {
    /// A compliant constraint whose multiplier starts at 0, of this rest length `[m]`, and whether what it turns is
    /// noted.
    #[inline(always)]
    fn project(&self, state: &mut Cluster<S>, rest: S, does_turn: bool) {
        let (a, b) = (self.a as usize, self.b as usize);
        let d = sub(state.now[a], state.now[b]);
        let length = dot(d, d).sqrt();
        if length == S::ZERO || is_slack(self.limit, length, rest) {
            return;
        }
        let along = scale(d, S::ONE / length);
        let mut error = length - rest;
        if self.drag != S::ZERO {
            error += self.drag * dot(sub(state.way[a], state.way[b]), along);
        }
        if self.most.is_finite() {
            let most = self.most * length;
            error = error.max(-most).min(most);
        }
        let shift = scale(along, error * self.inverse);
        if self.is_rigid && does_turn {
            state.turn([a, b], shift);
        }
        state.shift(a, scale(shift, -state.w[a]));
        state.shift(b, scale(shift, state.w[b]));
    }
}
