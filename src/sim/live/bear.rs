//! What is heavy sinks no further into what is light than that gives way.
//!
//! A light body between a heavy one and a floor takes the push of each whole and bears neither: passes over contacts push it to and fro, as often
//! as the one is heavier than the other. So what is left of an overlap after them is taken from the heavy one alone, as off an
//! obstacle that moves as the light one does. What bears it in truth is the floor: nothing is done to what leans on none.
//! Source of the idea: shock propagation, in E. Guendelman and others, Nonconvex Rigid Bodies with Stacking, 2003.

use super::cluster::Cluster;
use super::pair::{Beside, MENDED, Pair, beside, left};
use super::rigid::Change;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// How many times as heavy the one has to be.
const HEAVIER: f64 = 8.0;
/// Share of their distance by which two may be nearer.
const SLACK: f64 = 0.1;
/// Sweeps over what lies on light bodies: its touches hang together where it is rigid.
const SWEEPS: u32 = 8;

/// Whether points of these inverse masses `[1/kg]` are uneven enough; those that are held count for none.
pub(super) fn is_uneven<S: Real>(w: &[S]) -> bool {
    let free = || w.iter().copied().filter(|&w| w > S::ZERO);
    let (least, most) = (free().fold(S::INFINITY, S::min), free().fold(S::ZERO, S::max));
    most > least * S::from_f64(HEAVIER)
}

/// A touch of something heavy and something light.
struct Touch<'a, S> {
    pair: &'a Pair<S>,
    /// The point is the heavy one.
    is_of_point: bool,
    /// What pushes the heavy one off, and what rubs it `[kg m]`.
    pressed: S,
    rubbed: S,
}

/// Lifts what is heavy out of what is light, once all passes are over.
pub(super) fn lift<S: Real>(state: &mut Cluster<S>) {
    if !state.is_uneven || !state.leans() {
        return;
    }
    let (pairs, active) = (std::mem::take(&mut state.pairs), std::mem::take(&mut state.active));
    state.counts.work += 15 * active.len() as u64;
    let mut touches: Vec<Touch<S>> =
        active.iter().filter_map(|&number| Touch::of(state, &pairs[number as usize])).collect();
    if touches.iter().any(|touch| touch.overlap(state) > S::from_f64(SLACK) * touch.pair.distance) {
        touches.iter().for_each(|touch| touch.mend(state));
        for _ in 0..SWEEPS {
            state.counts.work += 30 * touches.len() as u64;
            touches.iter_mut().for_each(|touch| touch.press(state));
        }
    }
    (state.pairs, state.active) = (pairs, active);
}

impl<'a, S: Real> Touch<'a, S> {
    fn of(state: &Cluster<S>, pair: &'a Pair<S>) -> Option<Self> {
        let [p, a, b] = places(pair);
        if pair.pressed == S::ZERO || p.max(a) >= state.own() {
            return None;
        }
        let Beside { at, normal, .. } = beside([p, a, b].map(|i| state.now[i]), pair.side)?;
        let (of_point, of_edge) = (state.felt(p, normal), state.felt_on_edge([a, b], at, normal));
        let heavier = S::from_f64(HEAVIER);
        let is_of_point = of_point * heavier < of_edge;
        let is_any = is_of_point && of_point > S::ZERO || of_edge > S::ZERO && of_edge * heavier < of_point;
        is_any.then_some(Touch { pair, is_of_point, pressed: S::ZERO, rubbed: S::ZERO })
    }

    /// How much nearer they are than they may be `[m]`.
    fn overlap(&self, state: &Cluster<S>) -> S {
        beside(places(self.pair).map(|i| state.now[i]), self.pair.side)
            .map_or(S::ZERO, |found| self.pair.distance - found.gap)
    }

    /// Inverse mass of the heavy one along a direction `[1/kg]`.
    fn weight(&self, state: &Cluster<S>, at: S, n: [S; 2]) -> S {
        let [p, a, b] = places(self.pair);
        if self.is_of_point { state.felt(p, n) } else { state.felt_on_edge([a, b], at, n) }
    }

    /// Pushes the heavy one alone `[kg m]`.
    fn push(&self, state: &mut Cluster<S>, at: S, (out, aside): ([S; 2], [S; 2]), change: Change) {
        let [p, a, b] = places(self.pair);
        let push = add(out, aside);
        if self.is_of_point {
            if change == Change::Way {
                state.note_shares(&[(p, S::ONE)], self.pair.restitution, (out, aside));
            }
            return state.push_point(p, push, change);
        }
        let rest = S::ONE - at;
        if change == Change::Way {
            state.note_shares(&[(a, -rest), (b, -at)], self.pair.restitution, (out, aside));
        }
        let place = add(scale(state.now[a], rest), scale(state.now[b], at));
        state.push_edge(([a, b], at, place), scale(push, -S::ONE), change);
    }

    /// What was there before the substep comes out slowly and without speed.
    fn mend(&self, state: &mut Cluster<S>) {
        let far = (self.pair.old * S::from_f64(MENDED)).min(state.gentle);
        let found = beside(places(self.pair).map(|i| state.now[i]), self.pair.side);
        if let Some(Beside { at, normal, .. }) = found.filter(|_| far > S::ZERO) {
            let push = scale(normal, far / self.weight(state, at, normal));
            self.push(state, at, (push, zero()), Change::Place);
        }
    }

    /// What is new is pushed out at once, and rubs.
    fn press(&mut self, state: &mut Cluster<S>) {
        let [p, a, b] = places(self.pair);
        let Some(found) = beside([p, a, b].map(|i| state.now[i]), self.pair.side) else { return };
        let Beside { at, normal, gap } = found;
        let was = [self.pressed, self.rubbed];
        let lacking = self.pair.distance - self.pair.old - gap;
        self.pressed = (was[0] + lacking / self.weight(state, at, normal)).max(S::ZERO);
        let along = left(normal);
        let of_edge = add(scale(state.way[a], S::ONE - at), scale(state.way[b], at));
        let slides = dot(sub(state.way[p], of_edge), along);
        let most = self.pair.friction * self.pressed;
        self.rubbed = (was[1] - slides / self.weight(state, at, along)).max(-most).min(most);
        let (out, aside) = (scale(normal, self.pressed - was[0]), scale(along, self.rubbed - was[1]));
        self.push(state, at, (out, aside), Change::Way);
    }
}

fn places<S>(pair: &Pair<S>) -> [usize; 3] {
    [pair.p, pair.a, pair.b].map(|i| i as usize)
}
