//! No point passes an edge within a substep: motion across a line between both is cut where they would.
//!
//! Source: the planar divide-and-truncate of offset contact (A. Chen et al. 2025): each side keeps to its part of the gap.

use super::cluster::Cluster;
use super::pair::{Pair, beside};
use super::rigid::Change;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Share of the gap that both sides may use up.
const USED: f64 = 0.9;
/// Least share of it that one of them is left.
const LEAST: f64 = 0.05;

/// Cuts what would pass.
pub(super) fn cut<S: Real>(state: &mut Cluster<S>) {
    let (pairs, chosen) = (std::mem::take(&mut state.pairs), std::mem::take(&mut state.chosen));
    let used = S::from_f64(USED);
    for &number in &chosen {
        let pair = &pairs[number as usize];
        if pair.side == S::ZERO {
            continue;
        }
        let [p, a, b] = pair.places();
        let Some(found) = beside([state.start[p], state.start[a], state.start[b]], pair.side) else { continue };
        if found.gap <= S::ZERO {
            continue;
        }
        let n = found.normal;
        // How fast the point comes down, and how fast the edge comes up.
        let down = (-dot(state.way[p], n)).max(S::ZERO);
        let (up_a, up_b) = (dot(state.way[a], n).max(S::ZERO), dot(state.way[b], n).max(S::ZERO));
        let up = up_a.max(up_b);
        if down + up <= used * found.gap {
            continue;
        }
        // Turning edges and points that run along with them come nearer in other ways: only what ends near is cut.
        let end = beside([state.now[p], state.now[a], state.now[b]], pair.side);
        if end.is_some_and(|end| end.gap > S::HALF * found.gap.min(pair.distance)) {
            continue;
        }
        if state.is_of_rigid([p, a]) {
            hold_apart(state, pair, (found.at, n, used * found.gap));
            continue;
        }
        let share = (down / (down + up)).max(S::from_f64(LEAST)).min(S::from_f64(1.0 - LEAST));
        let room = used * found.gap;
        let mut taken = [S::ZERO; 3];
        let limits =
            [(p, room * share, -S::ONE), (a, room * (S::ONE - share), S::ONE), (b, room * (S::ONE - share), S::ONE)];
        for (taken, (i, most, goes)) in taken.iter_mut().zip(limits) {
            let along = goes * dot(state.way[i], n);
            if along > most && state.w[i] != S::ZERO {
                *taken = goes * (most - along);
            }
        }
        if taken == [S::ZERO; 3] {
            continue;
        }
        state.counts.truncations += 1;
        // What is taken from one goes to all three, so that their momentum stays, unless something holds them.
        let mass = [p, a, b].map(|i| if state.w[i] > S::ZERO { S::ONE / state.w[i] } else { S::INFINITY });
        let sum = mass[0] + mass[1] + mass[2];
        let lost = (0..3).fold(S::ZERO, |sum, k| if taken[k] == S::ZERO { sum } else { sum + mass[k] * taken[k] });
        let common = if sum.is_finite() { lost / sum } else { S::ZERO };
        for (i, taken) in [p, a, b].into_iter().zip(taken) {
            let back = scale(n, taken - common);
            if let Some(tally) = state.tally.as_mut().filter(|_| state.w[i] != S::ZERO) {
                tally.push(i, pair.restitution, (back, [S::ZERO; 2]));
            }
            state.way[i] = add(state.way[i], back);
            state.now[i] = add(state.now[i], back);
        }
    }
    (state.pairs, state.chosen) = (pairs, chosen);
}

/// Of a pair with a rigid body what closes more than `room` `[m]` is pushed back, as a contact does that has no friction.
fn hold_apart<S: Real>(state: &mut Cluster<S>, pair: &Pair<S>, (at, n, room): (S, [S; 2], S)) {
    let [p, a, b] = pair.places();
    let rest = S::ONE - at;
    let way = sub(state.way[p], add(scale(state.way[a], rest), scale(state.way[b], at)));
    let (beyond, w) = (-dot(way, n) - room, state.weight([p, a, b], at, n));
    if beyond > S::ZERO && w > S::ZERO {
        state.counts.truncations += 1;
        let push = scale(n, beyond / w);
        state.note_push([p, a, b], at, pair.restitution, (push, [S::ZERO; 2]));
        state.push([p, a, b], at, push, Change::Way);
    }
}
