//! Bodies whose rigid bonds are strained as no motion strains them, as in the plane: contacts that hold them back did it. What holds such a
//! body makes no point of it faster than forces made the fastest.

use super::cluster::{Cluster, Common};
use crate::sim::live::calm::{are_strained, bound};
use crate::sim::real::Real;
use crate::sim::vector::length;

/// Looks which bodies of a cluster are torn at as a substep begins, if anything may have touched something in the last one.
pub(super) fn look<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    state.torn.clear();
    if !state.chosen.is_empty() || !state.near.is_empty() {
        let is_torn = |(body, base)| are_strained(common.bodies.holds(body), &state.now[base..]);
        let torn: Vec<bool> = state.members(common).map(is_torn).collect();
        state.torn = torn;
    }
}

/// Takes the speed from points that what holds a torn body made too fast, at the end of a substep of `h` `[s]`: where they are is left.
pub(super) fn keep<S: Real>(state: &mut Cluster<S>, h: S) {
    for body in (0..state.torn.len()).filter(|&body| state.torn[body]) {
        let points = state.bases[body] as usize..state.bases[body + 1] as usize;
        let fastest = state.velocity[points.clone()].iter().fold(S::ZERO, |most, &v| most.max(length(v)));
        for i in points.filter(|&i| state.w[i] != S::ZERO) {
            bound(state.way[i], &mut state.turned[i], h * fastest);
        }
    }
}
