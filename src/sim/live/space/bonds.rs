//! Bonds of a cluster in space: forces where a substep resolves them, projections where it does not, by the rules of the plane.

use super::body::Body;
use super::cluster::{Cluster, Common};
use super::path;
use crate::sim::bond::Limit;
use crate::sim::live::FRAMES;
use crate::sim::live::body::Link;
use crate::sim::live::bonds::bears;
use crate::sim::live::gather::SUBSTEPS;
use crate::sim::live::strap::{stretch, stretches};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Points along a side of a body of which bonds are swept once in the longest substep; and bonds that are projected in a frame, about, beyond which
/// they are swept less often.
const POINTS_OF_A_SWEEP: f64 = 6.0;
const MOST_PROJECTED: f64 = 6e5;

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
    /// By how much it gives to a multiplier of 1: compliance over the square of the substep `[1/kg]`.
    softness: S,
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
            softness,
            drag,
            most,
            limit,
            is_rigid,
            strapped: strapped.filter(|_| is_rigid),
        })
    }
}

/// Bonds that are projected, and what they pull with in a substep.
#[derive(Clone, Debug, Default)]
pub(super) struct Held<S> {
    /// Relaxed ones, which are defined by their sweeps, and all others.
    relaxed: Vec<Hold<S>>,
    firm: Vec<Hold<S>>,
    /// How many sweeps over those a substep takes.
    sweeps: u32,
    /// What each of those pulls with in this substep, as its multiplier.
    pulls: Vec<S>,
}

/// Works out what the bonds of a cluster that are projected need in substeps of `h` `[s]`.
pub(super) fn prepare<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let mut held = std::mem::take(&mut state.held);
    held.relaxed.clear();
    held.firm.clear();
    let mut most = 0;
    for (k, (body, base)) in state.members(common).enumerate() {
        let springs = common.bodies.springs(body).iter().filter(|_| !are_forces(body, state.touched[k], h));
        let links = common.bodies.holds(body);
        let rigid = &links[if body.is_path { path::length(links) } else { 0 }..];
        let own = (base, (!body.straps.is_empty()).then_some(k as u32));
        let before = held.firm.len();
        for link in springs.chain(rigid) {
            let list = if link.relaxed.is_some() { &mut held.relaxed } else { &mut held.firm };
            list.extend(Hold::new(link, own, &state.w, h));
        }
        if held.firm.len() > before {
            most = most.max(body.points.len());
        }
    }
    held.sweeps = sweeps(most, held.firm.len(), h.to_f64());
    held.pulls.resize(held.firm.len(), S::ZERO);
    state.held = held;
}

/// How many sweeps a substep of `h` `[s]` takes over so many bonds of a body of so many points: one leaves what hangs or lies on something as soft
/// as springs of about m/(2 h^2), and the larger it is the lighter is a point of it.
fn sweeps(points: usize, bonds: usize, h: f64) -> u32 {
    let share = h * FRAMES * f64::from(SUBSTEPS[0]);
    let wanted = (points as f64).sqrt() / POINTS_OF_A_SWEEP * share * share;
    let most = MOST_PROJECTED * h * FRAMES / bonds.max(1) as f64;
    wanted.min(most).ceil().max(1.0) as u32
}

/// Sweeps over the bonds that are held, and over springs too stiff to be forces, forth and back, each along its present direction.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    for (body, base) in state.members(common).filter(|(body, _)| body.is_path) {
        path::solve(state, common.bodies.holds(body), (base, stretch(&body.straps, &state.now[base..])));
    }
    let mut held = std::mem::take(&mut state.held);
    let stretches = stretches(state.members(common).map(|(body, base)| (&body.straps[..], base)), &state.now);
    // Where something presses, a few sweeps leave errors that velocities must not follow.
    let does_turn = !state.has_pressed && !state.touched.contains(&true);
    held.pulls.fill(S::ZERO);
    for round in 0..held.sweeps {
        held.sweep(state, &stretches, does_turn, round % 2 == 1);
    }
    for hold in &held.relaxed {
        let mut pull = S::ZERO;
        hold.project(state, (hold.rest, &mut pull), false);
    }
    let count = held.relaxed.len() as u64 + u64::from(held.sweeps) * held.firm.len() as u64;
    state.counts.bonds += count;
    state.counts.work += 30 * count;
    state.held = held;
}

impl<S: Real> Held<S> {
    /// One sweep over those that are firm, from the last one on if it goes `back`.
    fn sweep(&mut self, state: &mut Cluster<S>, stretches: &[S], does_turn: bool, back: bool) {
        let mut one = |(hold, pull): (&Hold<S>, &mut S)| {
            let rest = hold.strapped.map_or(hold.rest, |member| hold.rest * stretches[member as usize]);
            hold.project(state, (rest, pull), does_turn);
        };
        let all = self.firm.iter().zip(&mut self.pulls);
        if back { all.rev().for_each(&mut one) } else { all.for_each(&mut one) }
    }
}

impl<S: Real> Hold<S> {
    /// A compliant constraint whose multiplier starts at 0 and stands at `pull`, of this rest length `[m]`, and whether what it turns is noted.
    #[inline(always)]
    fn project(&self, state: &mut Cluster<S>, (rest, pull): (S, &mut S), does_turn: bool) {
        let (a, b) = (self.a as usize, self.b as usize);
        let d = sub(state.now[a], state.now[b]);
        let length = dot(d, d).sqrt();
        if length == S::ZERO || is_slack(self.limit, length, rest) {
            return;
        }
        let along = scale(d, S::ONE / length);
        let mut error = length - rest - self.softness * *pull;
        if self.drag != S::ZERO {
            error += self.drag * dot(sub(state.way[a], state.way[b]), along);
        }
        if self.most.is_finite() {
            let most = self.most * length;
            error = error.max(-most).min(most);
        }
        let more = error * self.inverse;
        *pull += more;
        let shift = scale(along, more);
        if self.is_rigid && does_turn {
            state.turn([a, b], shift);
        }
        state.shift(a, scale(shift, -state.w[a]));
        state.shift(b, scale(shift, state.w[b]));
    }
}
