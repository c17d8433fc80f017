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
    let close: Vec<Gap<S>> = chosen.iter().filter_map(|pair| Gap::of(pair, state)).collect();
    let mut looks = chosen.len();
    if !close.is_empty() {
        let mut moved = vec![false; state.now.len()];
        divide_all(&close, &mut moved, state);
        looks += halve(&chosen, (&close, moved), state);
    }
    let cuts = state.counts.truncations - before;
    state.counts.work += 20 * looks as u64 + 400 * close.len() as u64 + 2_000 * cuts;
    state.pairs = pairs;
}

/// Where a point and a triangle are nearest at the start of the substep, of those whose ways could bring the two together.
struct Gap<'a, S> {
    pair: &'a Pair<S>,
    shares: [S; 3],
    /// From the triangle to the point, and how far they are from each other `[m]`.
    normal: [S; 3],
    wide: S,
    /// How far the corners are behind the place `[m]`.
    behind: [S; 3],
}

impl<'a, S: Real> Gap<'a, S> {
    #[inline(always)]
    fn of(pair: &'a Pair<S>, state: &Cluster<S>) -> Option<Self> {
        let start = pair.of(&state.start);
        let found = nearest(start);
        let wide = dot(found.from, found.from).sqrt();
        if wide == S::ZERO {
            return None;
        }
        let normal = scale(found.from, S::ONE / wide);
        let foot = sub(start[0], found.from);
        let behind = [1, 2, 3].map(|k| dot(normal, sub(foot, start[k])));
        let gap = Gap { pair, shares: found.shares, normal, wide, behind };
        (gap.excess(state) > S::ZERO).then_some(gap)
    }

    /// By how much the ways use up more of the gap than they may `[m]`.
    #[inline(always)]
    fn excess(&self, state: &Cluster<S>) -> S {
        let way = self.pair.of(&state.way);
        let rises = (0..3).map(|k| dot(way[k + 1], self.normal) - self.behind[k]);
        let rise = rises.fold(-S::INFINITY, S::max);
        rise - dot(way[0], self.normal) - S::from_f64(USED) * self.wide
    }

    /// Whether the point leaves its side through the triangle. What is on the wrong side may come back.
    fn is_passed(&self, state: &Cluster<S>) -> bool {
        let start = self.pair.of(&state.start);
        self.excess(state) > S::ZERO
            && self.pair.side * volume(start) >= S::ZERO
            && passage(start, self.pair.of(&state.now)) == Passage::Through
    }

    /// Cuts what would pass, in the way of the nearest places. Returns whether there was any.
    fn divide(&self, state: &mut Cluster<S>) -> bool {
        if !self.is_passed(state) {
            return false;
        }
        let (shares, own) = (signed(self.shares), self.pair.of(&state.w));
        let w = (0..4).fold(S::ZERO, |sum, k| sum + shares[k] * shares[k] * own[k]);
        if w == S::ZERO {
            return false;
        }
        let excess = self.excess(state);
        state.counts.truncations += 1;
        for k in 0..4 {
            state.shift(self.pair.points[k] as usize, scale(self.normal, excess / w * shares[k] * own[k]));
        }
        true
    }
}

/// Cuts what would pass a few times over; notes whose ways it changes.
fn divide_all<S: Real>(close: &[Gap<S>], moved: &mut [bool], state: &mut Cluster<S>) {
    for _ in 0..ROUNDS {
        let mut is_clear = true;
        for gap in close {
            if gap.divide(state) {
                is_clear = false;
                gap.pair.points.iter().for_each(|&i| moved[i as usize] = true);
            }
        }
        if is_clear {
            break;
        }
    }
}

/// What would still pass goes with all others, more and more: of pairs of which no point's way changed nothing new passes. Returns how many
/// it looked at.
fn halve<S: Real>(pairs: &[&Pair<S>], (close, mut moved): (&[Gap<S>], Vec<bool>), state: &mut Cluster<S>) -> usize {
    let is_moved = |pair: &Pair<S>, moved: &[bool]| pair.points.iter().any(|&i| moved[i as usize]);
    let mut looks = close.len();
    let still = close.iter().filter(|gap| !is_moved(gap.pair, &moved) && gap.is_passed(state));
    let mut passing: Vec<&Pair<S>> = still.map(|gap| gap.pair).collect();
    for round in 0..=HALVINGS + STOPS {
        let anew = pairs.iter().copied().filter(|pair| is_moved(pair, &moved)).inspect(|_| looks += 1);
        passing.extend(anew.filter(|pair| Gap::of(pair, state).is_some_and(|gap| gap.is_passed(state))));
        if passing.is_empty() {
            break;
        }
        state.counts.truncations += passing.len() as u64;
        let mut points: Vec<u32> = passing.drain(..).flat_map(|pair| pair.points).collect();
        points.sort_unstable();
        points.dedup();
        if round == HALVINGS + STOPS {
            points = (0..state.now.len() as u32).collect();
        }
        let is_held = points.iter().any(|&i| state.w[i as usize] == S::ZERO);
        let mean = if is_held { [S::ZERO; 3] } else { momentum(state, &points) };
        let kept = if round >= HALVINGS { S::ZERO } else { S::HALF };
        moved.fill(false);
        for i in points.into_iter().map(|i| i as usize) {
            moved[i] = true;
            if state.w[i] != S::ZERO {
                let way = add(mean, scale(sub(state.way[i], mean), kept));
                state.way[i] = way;
                state.now[i] = add(state.start[i], way);
            }
        }
    }
    looks
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
