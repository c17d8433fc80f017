//! Bodies whose rigid bonds are strained as no motion strains them: pins that are led too far apart tear at them, or did so until now; they were
//! made rigid while they were squeezed; or they are lighter than what they bear by more than sweeps can hold.
//!
//! Bonds, joints and skins cannot all be as they are to be there. What they push about by turns is no speed: what holds such a body makes
//! no point of it faster than forces made it, or than its pins go.

use super::body::Link;
use super::cluster::{Cluster, Common};
use super::strap::tautness;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Strain of a rigid bond from which on it is torn at `[1]`.
const TORN: f64 = 0.2;
/// Share of its reach beyond which a strap is longer, and how many times as fast as its pins what hangs between them may get `[1]`.
const OVER: f64 = 1e-4;
const FASTEST: f64 = 2.0;
/// Share of its reach by which a strap may be shorter and all that is between its pins is as good as straight: it gives way across, at any speed.
const STRAIGHT: f64 = 2e-3;
/// How quickly what hangs there comes to rest `[1/s]`: for each unit that it is stretched by, and at most.
const CALMING: f64 = 100.0;
const MOST_CALMING: f64 = 10.0;

/// A body of a cluster that may be torn at in this step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Torn {
    /// Its number in the cluster.
    member: u32,
    /// Some rigid bond is strained so far as the step begins, or was so and pins that are led hold it still.
    is_torn: bool,
}

/// Which bodies of a cluster may be torn at in a step that begins.
pub(super) fn look<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    let mut torn = std::mem::take(&mut state.torn);
    torn.clear();
    for (member, (body, base)) in (0..).zip(state.members(common)) {
        let (is_led, links) = (!body.straps.is_empty(), common.holds(body));
        state.counts.work += 5 * links.len() as u64;
        let is_strained = are_strained(links, &state.now[base..]);
        let was_torn = &mut state.tangle.torn[member as usize];
        *was_torn = if is_strained { is_led || *was_torn } else { is_led && *was_torn };
        let is_torn = is_strained || *was_torn;
        if is_torn || is_led {
            torn.push(Torn { member, is_torn });
        }
    }
    state.torn = torn;
}

/// Takes the speed from points that what holds a torn body made too fast, at the end of a substep of `h` `[s]`: where they are is left.
pub(super) fn keep<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    if state.torn.is_empty() {
        return;
    }
    let torn = std::mem::take(&mut state.torn);
    let bodies: Vec<_> = state.members(common).collect();
    for body in &torn {
        let (own, base) = bodies[body.member as usize];
        let points = base..base + own.points.len();
        let over = tautness(&own.straps, &state.now[base..]) - S::ONE;
        let fastest = |points: &mut dyn Iterator<Item = usize>| {
            points.map(|i| length(state.velocity[i])).fold(S::ZERO, |most, speed| most.max(speed))
        };
        let (floor, kept) = if over > S::from_f64(OVER) {
            let rate = (over * S::from_f64(CALMING)).min(S::from_f64(MOST_CALMING));
            let pins = fastest(&mut points.clone().filter(|&i| state.w[i] == S::ZERO));
            (pins * S::from_f64(FASTEST), S::ONE / (S::ONE + rate * h))
        } else if body.is_torn || over > S::from_f64(-STRAIGHT) {
            (fastest(&mut points.clone()), S::ONE)
        } else {
            continue;
        };
        for i in points.filter(|&i| state.w[i] != S::ZERO) {
            let most = h * floor.max(kept * length(state.velocity[i]));
            bound(state.way[i], &mut state.turned[i], most);
        }
    }
    state.torn = torn;
}

/// Whether a rigid bond of a body is strained as no motion strains it, between points at these places.
pub(super) fn are_strained<S: Real, const D: usize>(links: &[Link<S>], now: &[[S; D]]) -> bool {
    links.iter().any(|link| {
        let off = length(sub(now[link.a as usize], now[link.b as usize])) - link.rest;
        let is_rigid = !link.stiffness.is_finite() && link.relaxed.is_none() && link.rest > S::ZERO;
        is_rigid && link.limit.acts(off, S::ZERO) && off.abs() > S::from_f64(TORN) * link.rest
    })
}

/// What goes `way` and is turned besides `[m]` gets no faster than `most` a substep `[m]`: where it goes is left.
pub(super) fn bound<S: Real, const D: usize>(way: [S; D], turned: &mut [S; D], most: S) {
    let gets = add(way, *turned);
    let square = dot(gets, gets);
    if square > most * most {
        *turned = sub(scale(gets, most / square.sqrt()), way);
    }
}
