//! Triangles that are pressed flat are opened again: what was missing before slowly and without speed, what is new at once.

use super::cluster::{Cluster, Common};
use super::pair::left;
use crate::sim::force::area::size;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Share of what was missing before a substep that comes back in it.
const MENDED: f64 = 0.1;

/// Least square of a slope that a triangle is opened along, as a share of its area at rest: a tenth of what it is at rest, about.
const LEAST_SLOPE: f64 = 0.06;

/// One pass over the triangles.
pub(super) fn unfold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    for (body, base) in state.members(common) {
        let areas = common.areas(body);
        state.counts.work += 8 * areas.len() as u64;
        for area in areas {
            let [a, b, c] = area.corners.map(|corner| base + corner as usize);
            if state.is_led([a, b, c]) {
                continue;
            }
            let least = S::from_f64(common.resist.least) * area.rest;
            let now = size([state.now[a], state.now[b], state.now[c]]);
            if now >= least {
                continue;
            }
            let missed = (least - size([state.start[a], state.start[b], state.start[c]])).max(S::ZERO);
            // Passes share the slow part.
            let slow = missed * S::from_f64(MENDED / 3.0);
            let quick = (least - now - missed).max(S::ZERO);
            let [x, y, z] = [state.now[a], state.now[b], state.now[c]];
            let slopes = [left(sub(z, y)), left(sub(x, z)), left(sub(y, x))].map(|slope| scale(slope, S::HALF));
            let sum =
                [a, b, c].iter().zip(&slopes).fold(S::ZERO, |sum, (&i, &slope)| sum + state.w[i] * dot(slope, slope));
            // What is crushed to a point has no slopes to be opened along: no corner goes further than they are long.
            let least = S::from_f64(LEAST_SLOPE) * area.rest * (state.w[a] + state.w[b] + state.w[c]);
            if sum == S::ZERO {
                continue;
            }
            let sum = sum.max(least);
            let (slow, quick) = (slow / sum, quick / sum);
            for (i, slope) in [a, b, c].into_iter().zip(slopes) {
                let turn = scale(slope, state.w[i]);
                let (creep, shift) = (scale(turn, slow), scale(turn, quick));
                state.start[i] = add(state.start[i], creep);
                state.way[i] = add(state.way[i], shift);
                state.now[i] = add(state.now[i], add(creep, shift));
            }
        }
    }
}
