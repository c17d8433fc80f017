//! No point passes a triangle within a substep: motion across the planes between both is cut where they would.
//!
//! The planes move with what they part, so that what goes together goes on; what is cut is shared, so that momentum stays. Where that
//! does not end it, ways about the common one are halved, until nothing passes.
//! Source: the planar divide-and-truncate of offset contact (A. Chen et al. 2025): each side keeps to its part of the gap.

use super::cluster::Cluster;
use super::geometry::{Passage, nearest, passage, volume};
use super::pair::{Pair, signed};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Share of the gap that may be used up.
const USED: f64 = 0.9;
/// Rounds in which motion across planes is cut, in which ways are halved, and in which what still passes goes together: after the last of these
/// nothing moves but together.
const ROUNDS: u32 = 3;
const HALVINGS: u32 = 6;
const STOPS: u32 = 8;

/// Cuts what would pass.
pub(super) fn cut<S: Real>(state: &mut Cluster<S>) {
    if state.chosen.is_empty() {
        return;
    }
    let before = state.counts.truncations;
    let pairs = std::mem::take(&mut state.pairs);
    let chosen: Vec<&Pair<S>> = state.chosen.iter().map(|&number| &pairs[number as usize]).collect();
    let close: Vec<&Pair<S>> = chosen.iter().copied().filter(|pair| closes(pair, state)).collect();
    for _ in 0..ROUNDS {
        let mut is_clear = true;
        for pair in &close {
            is_clear &= !divide(pair, state);
        }
        if is_clear {
            break;
        }
    }
    let looks = 1 + if close.is_empty() { 0 } else { halve(&chosen, state) };
    let cuts = state.counts.truncations - before;
    state.counts.work += 20 * looks * chosen.len() as u64 + 400 * close.len() as u64 + 2_000 * cuts;
    state.pairs = pairs;
}

/// Whether ways of this substep could bring the two together.
#[inline(always)]
fn closes<S: Real>(pair: &Pair<S>, state: &Cluster<S>) -> bool {
    excess(pair, state).is_some_and(|(excess, ..)| excess > S::ZERO)
}

/// By how much the ways use up more of the gap than they may `[m]`; the shares of the nearest place, and the direction from it.
#[inline(always)]
fn excess<S: Real>(pair: &Pair<S>, state: &Cluster<S>) -> Option<(S, [S; 3], [S; 3])> {
    let start = pair.of(&state.start);
    let found = nearest(start);
    let gap = dot(found.from, found.from).sqrt();
    if gap == S::ZERO {
        return None;
    }
    let normal = scale(found.from, S::ONE / gap);
    let foot = sub(start[0], found.from);
    let way = pair.of(&state.way);
    let rises = (1..4).map(|k| dot(way[k], normal) - dot(normal, sub(foot, start[k])));
    let rise = rises.fold(-S::INFINITY, S::max);
    Some((rise - dot(way[0], normal) - S::from_f64(USED) * gap, found.shares, normal))
}

/// Whether the point leaves its side through the triangle. What is on the wrong side may come back.
fn is_passed<S: Real>(pair: &Pair<S>, state: &Cluster<S>) -> bool {
    let start = pair.of(&state.start);
    pair.side * volume(start) >= S::ZERO && passage(start, pair.of(&state.now)) == Passage::Through
}

/// Cuts what one pair would pass, in the way of its nearest places. Returns whether there was any.
fn divide<S: Real>(pair: &Pair<S>, state: &mut Cluster<S>) -> bool {
    let Some((excess, shares, normal)) = excess(pair, state).filter(|found| found.0 > S::ZERO) else { return false };
    if !is_passed(pair, state) {
        return false;
    }
    let (shares, own) = (signed(shares), pair.of(&state.w));
    let w = (0..4).fold(S::ZERO, |sum, k| sum + shares[k] * shares[k] * own[k]);
    if w == S::ZERO {
        return false;
    }
    state.counts.truncations += 1;
    for k in 0..4 {
        state.shift(pair.points[k] as usize, scale(normal, excess / w * shares[k] * own[k]));
    }
    true
}

/// What would still pass goes with all others, more and more. Returns how often it looked at all pairs.
fn halve<S: Real>(pairs: &[&Pair<S>], state: &mut Cluster<S>) -> u64 {
    for round in 0..=HALVINGS + STOPS {
        let passing: Vec<&Pair<S>> =
            pairs.iter().copied().filter(|pair| closes(pair, state) && is_passed(pair, state)).collect();
        if passing.is_empty() {
            return u64::from(round) + 1;
        }
        let mut points: Vec<u32> = passing.iter().flat_map(|pair| pair.points).collect();
        points.sort_unstable();
        points.dedup();
        if round == HALVINGS + STOPS {
            points = (0..state.now.len() as u32).collect();
        }
        let is_held = points.iter().any(|&i| state.w[i as usize] == S::ZERO);
        let mean = if is_held { [S::ZERO; 3] } else { momentum(state, &points) };
        let kept = if round >= HALVINGS { S::ZERO } else { S::HALF };
        for i in points.into_iter().map(|i| i as usize).filter(|&i| state.w[i] != S::ZERO) {
            let way = add(mean, scale(sub(state.way[i], mean), kept));
            state.way[i] = way;
            state.now[i] = add(state.start[i], way);
        }
        state.counts.truncations += passing.len() as u64;
    }
    u64::from(HALVINGS + STOPS) + 1
}

/// The way that these points go together `[m]`.
fn momentum<S: Real>(state: &Cluster<S>, points: &[u32]) -> [S; 3] {
    let (mut sum, mut mass) = ([S::ZERO; 3], S::ZERO);
    for i in points.iter().map(|&i| i as usize) {
        sum = add(sum, scale(state.way[i], S::ONE / state.w[i]));
        mass += S::ONE / state.w[i];
    }
    scale(sum, S::ONE / mass)
}
