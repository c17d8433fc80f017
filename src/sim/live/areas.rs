//! Triangles that are pressed flat are opened again: what was missing before slowly and without speed, what is new at once.
//!
//! Only those that may get thin are looked at: a body lists them, and lists them anew when its points have gone further, each against
//! the others, than it promised. What moves as a whole lists nothing.

use super::body::{Area, Body};
use super::cluster::{Cluster, Common};
use super::pair::left;
use crate::sim::force::area::size;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Share of what was missing before a substep that comes back in it.
const MENDED: f64 = 0.1;
/// Way of the points of a body against each other until it lists its thin triangles anew, in mean edges of its skin: further on more
/// triangles are listed, nearer it is done more often.
const PROMISE: f64 = 0.05;
/// Least square of a slope that a triangle is opened along, as a share of its area at rest: a tenth of what it is at rest, about.
const LEAST_SLOPE: f64 = 0.06;

/// The triangles of a body that may get thin.
#[derive(Clone, Debug)]
pub(super) struct Thin<S> {
    /// Places among all triangles.
    list: Vec<u32>,
    /// How far its points have gone against each other since `[m]`.
    gone: S,
}

impl<S: Real> Thin<S> {
    /// Nothing is known of it.
    pub(super) fn unknown() -> Self {
        Thin { list: Vec::new(), gone: S::INFINITY }
    }

    /// Its points have these ways in a substep, which is over.
    pub(super) fn go(&mut self, way: &[[S; 2]]) {
        self.gone += spread(way);
    }
}

/// Half the diagonal of the box that ways span `[m]`: no point goes further against its middle.
pub(super) fn spread<S: Real>(way: &[[S; 2]]) -> S {
    // Four boxes that do not wait for each other; the least of all is the same in any order.
    let (mut low, mut high) = ([[S::INFINITY; 2]; 4], [[-S::INFINITY; 2]; 4]);
    for ways in way.chunks(4) {
        for (j, way) in ways.iter().enumerate() {
            for k in 0..2 {
                low[j][k] = low[j][k].min(way[k]);
                high[j][k] = high[j][k].max(way[k]);
            }
        }
    }
    let mut size = [S::ZERO; 2];
    for k in 0..2 {
        let least = low[0][k].min(low[1][k]).min(low[2][k].min(low[3][k]));
        let most = high[0][k].max(high[1][k]).max(high[2][k].max(high[3][k]));
        size[k] = most - least;
    }
    S::HALF * dot(size, size).sqrt()
}

/// Lists the triangles of those bodies that have changed too much, or would by their ways in this substep.
pub(super) fn look<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    let mut thin = std::mem::take(&mut state.thin);
    for (k, (body, base)) in state.members(common).enumerate() {
        let (of, promise) = (&mut thin[k], S::from_f64(PROMISE) * body.edge_length);
        let is_kept = of.gone + spread(&state.way[base..state.bases[k + 1] as usize]) <= promise;
        if body.areas.len() > 0 && !is_kept {
            of.gone = S::ZERO;
            list(state, common, (body, base, promise), &mut of.list);
        }
    }
    state.thin = thin;
}

/// Those that get thin while no corner goes further than `promise` `[m]` against the others: sides u and v and ways e bound the area's
/// change by |e| (|u| + |v| + 2 |e|).
fn list<S: Real>(
    state: &mut Cluster<S>,
    common: &Common<S>,
    (body, base, promise): (&Body<S>, usize, S),
    list: &mut Vec<u32>,
) {
    let least = S::from_f64(common.resist.least);
    let two = S::ONE + S::ONE;
    list.clear();
    for (area, place) in common.areas(body).iter().zip(body.areas.first..) {
        let [a, b, c] = area.corners;
        let [a, b, c] = [state.now[base + a as usize], state.now[base + b as usize], state.now[base + c as usize]];
        let (u, v) = (sub(b, a), sub(c, a));
        let reach = (two * (dot(u, u) + dot(v, v))).sqrt() + two * promise;
        // NaN is listed.
        let is_safe = size([a, b, c]) - promise * reach > least * area.rest;
        if !is_safe {
            list.push(place);
        }
    }
    state.counts.work += 8 * body.areas.len() as u64;
}

/// One pass over the triangles that may get thin.
pub(super) fn unfold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    let thin = std::mem::take(&mut state.thin);
    for (k, thin) in thin.iter().enumerate() {
        let base = state.bases[k] as usize;
        state.counts.work += 8 * thin.list.len() as u64;
        for &place in &thin.list {
            open(state, &common.bodies.areas[place as usize], (base, S::from_f64(common.resist.least)));
        }
    }
    state.thin = thin;
}

/// Opens a triangle that has less than a share of its area at rest.
fn open<S: Real>(state: &mut Cluster<S>, area: &Area<S>, (base, share): (usize, S)) {
    let [a, b, c] = area.corners;
    let [a, b, c] = [base + a as usize, base + b as usize, base + c as usize];
    let [x, y, z] = [state.now[a], state.now[b], state.now[c]];
    let least = share * area.rest;
    let now = size([x, y, z]);
    if now >= least {
        return;
    }
    let before = size([state.start[a], state.start[b], state.start[c]]);
    if before <= S::ZERO && state.is_led([a, b, c]) {
        return;
    }
    let missed = (least - before).max(S::ZERO);
    state.counts.opened += u64::from(before < S::ZERO);
    // Passes share the slow part.
    let slow = missed * S::from_f64(MENDED / 3.0);
    let quick = (least - now - missed).max(S::ZERO);
    let slopes = [left(sub(z, y)), left(sub(x, z)), left(sub(y, x))].map(|slope| scale(slope, S::HALF));
    let sum = [a, b, c].iter().zip(&slopes).fold(S::ZERO, |sum, (&i, &slope)| sum + state.w[i] * dot(slope, slope));
    // What is crushed to a point has no slopes to be opened along: no corner goes further than they are long.
    let least = S::from_f64(LEAST_SLOPE) * area.rest * (state.w[a] + state.w[b] + state.w[c]);
    if sum == S::ZERO {
        return;
    }
    let sum = sum.max(least);
    let (slow, quick) = (slow / sum, quick / sum);
    for (i, slope) in [a, b, c].into_iter().zip(slopes) {
        let turn = scale(slope, state.w[i]);
        let (creep, shift) = (scale(turn, slow), scale(turn, quick));
        state.start[i] = add(state.start[i], creep);
        state.way[i] = add(state.way[i], shift);
        state.now[i] = add(state.now[i], add(creep, shift));
        state.note_stop(i, shift);
    }
}
