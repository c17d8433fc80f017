//! What is heavy sinks no further into what is light than that gives way.
//!
//! A light body between a heavy one and a floor takes the push of each whole and bears neither: passes over contacts push it to and fro, as often
//! as the one is heavier than the other, and press its triangles flat and its bonds short. So after them these are opened and held, and the
//! light body put out of obstacles, once more; what is left of an overlap then is taken from the heavy one alone, which is stopped by it, and
//! lifted slowly and without speed where that is not enough. What bears it in truth is the floor: nothing is done where the light body rests
//! on none.
//! Source of the idea: shock propagation, in E. Guendelman and others, Nonconvex Rigid Bodies with Stacking, 2003.

use super::areas;
use super::bonds;
use super::cluster::{Cluster, Common, OBSTACLE};
use super::pair::{Beside, MENDED, Pair, beside, left};
use super::rigid::Change;
use super::tree;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// How many times as heavy the one has to be.
const HEAVIER: f64 = 8.0;
/// Share of their distance by which two may be nearer.
const SLACK: f64 = 0.1;
/// How often light bodies are opened and what lies on them is lifted, and sweeps over that: its touches hang together where it is rigid.
const ROUNDS: u32 = 2;
const SWEEPS: u32 = 8;

/// Whether points of these inverse masses `[1/kg]` are uneven enough; those that are held count for none.
pub(super) fn is_uneven<S: Real>(w: &[S]) -> bool {
    let free = || w.iter().copied().filter(|&w| w > S::ZERO);
    let (least, most) = (free().fold(S::INFINITY, S::min), free().fold(S::ZERO, S::max));
    most > least * S::from_f64(HEAVIER)
}

/// Lifts what is heavy out of what is light, once all passes are over.
pub(super) fn lift<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    if !state.is_uneven {
        return;
    }
    state.counts.work += 15 * state.active.len() as u64;
    let mut heavy: Vec<Touch> = state.active.iter().filter_map(|&number| Touch::of(state, number)).collect();
    if heavy.is_empty() {
        return;
    }
    let levels = levels(state);
    heavy.retain(|touch| touch.is_borne(state, &levels));
    if heavy.is_empty() {
        return;
    }
    let mut pushed = vec![[S::ZERO; 2]; heavy.len()];
    let mut is_lifted = false;
    for round in 0..ROUNDS {
        // What gave way to what lies on it comes back.
        areas::unfold(state, common);
        bonds::hold_again(state);
        state.press_obstacles(common);
        let pairs = std::mem::take(&mut state.pairs);
        if round == 0 {
            heavy.iter().for_each(|touch| touch.mend(state, &pairs));
        }
        state.counts.work += 25 * heavy.len() as u64;
        if heavy.iter().any(|touch| touch.is_deep(state, &pairs)) {
            is_lifted = true;
            state.counts.work += 30 * u64::from(SWEEPS) * heavy.len() as u64;
            for _ in 0..SWEEPS {
                heavy.iter().zip(&mut pushed).for_each(|(touch, pushed)| touch.press(state, &pairs, pushed));
            }
        }
        state.pairs = pairs;
    }
    if is_lifted {
        state.straighten_rigs();
        tree::straighten(state, common, true);
    }
}

impl<S: Real> Cluster<S> {
    /// One pass over contacts with obstacles.
    fn press_obstacles(&mut self, common: &Common<S>) {
        let (mut pairs, own) = (std::mem::take(&mut self.pairs), self.own());
        let active = std::mem::take(&mut self.active);
        self.counts.work += 2 * active.len() as u64;
        for &number in &active {
            let pair = &mut pairs[number as usize];
            if pair.p.max(pair.a) as usize >= own {
                self.counts.work += 25;
                pair.press(self, S::ZERO);
            }
        }
        (self.pairs, self.active) = (pairs, active);
        let mut on_planes = std::mem::take(&mut self.on_planes);
        on_planes.iter_mut().for_each(|on| on.press(self, common));
        self.on_planes = on_planes;
    }
}

/// Over how many others each body of a cluster rests on what does not move: 0 on an obstacle or a pin of its own; `u32::MAX`: on nothing.
fn levels<S: Real>(state: &Cluster<S>) -> Vec<u32> {
    let mut levels = vec![u32::MAX; state.bodies.len()];
    let mut couples: Vec<[u32; 2]> = Vec::new();
    let pressed =
        state.active.iter().map(|&number| &state.pairs[number as usize]).filter(|pair| pair.pressed > S::ZERO);
    for pair in pressed {
        match [pair.p, pair.a].map(|i| state.body_of[i as usize]) {
            [OBSTACLE, body] | [body, OBSTACLE] => levels[body as usize] = 0,
            [a, b] if a != b => couples.extend([[a, b], [b, a]]),
            _ => {}
        }
    }
    let on_planes = state.on_planes.iter().filter(|on| on.pressed > S::ZERO).map(|on| on.p as usize);
    let pinned = (0..state.own()).filter(|&i| state.w[i] == S::ZERO);
    on_planes.chain(pinned).for_each(|i| levels[state.body_of[i] as usize] = 0);
    couples.sort_unstable();
    couples.dedup();
    let mut changes = true;
    while changes {
        changes = false;
        for &[a, b] in &couples {
            let over = levels[a as usize].saturating_add(1);
            changes |= over < levels[b as usize];
            levels[b as usize] = levels[b as usize].min(over);
        }
    }
    levels
}

/// A touch of something heavy and something light.
#[derive(Clone, Copy)]
struct Touch {
    pair: u32,
    /// The point is the heavy one.
    is_of_point: bool,
}

impl Touch {
    fn of<S: Real>(state: &Cluster<S>, number: u32) -> Option<Self> {
        let pair = &state.pairs[number as usize];
        let [p, a, b] = places(pair);
        if pair.pressed == S::ZERO || p.max(a) >= state.own() {
            return None;
        }
        let Beside { at, normal, .. } = beside([p, a, b].map(|i| state.now[i]), pair.side)?;
        let (of_point, of_edge) = (state.felt(p, normal), state.felt_on_edge([a, b], at, normal));
        let heavier = S::from_f64(HEAVIER);
        let is_of_point = of_point * heavier < of_edge;
        let is_any = is_of_point && of_point > S::ZERO || of_edge > S::ZERO && of_edge * heavier < of_point;
        is_any.then_some(Touch { pair: number, is_of_point })
    }

    /// Whether the light one rests on something, and not on the heavy one.
    fn is_borne<S: Real>(self, state: &Cluster<S>, levels: &[u32]) -> bool {
        let pair = &state.pairs[self.pair as usize];
        let [of_point, of_edge] = [pair.p, pair.a].map(|i| levels[state.body_of[i as usize] as usize]);
        let [heavy, light] = if self.is_of_point { [of_point, of_edge] } else { [of_edge, of_point] };
        light < u32::MAX && light <= heavy
    }

    /// Whether the two are nearer than they may be, what was so before the substep included.
    fn is_deep<S: Real>(self, state: &Cluster<S>, pairs: &[Pair<S>]) -> bool {
        let pair = &pairs[self.pair as usize];
        let found = beside(places(pair).map(|i| state.now[i]), pair.side);
        found.is_some_and(|found| pair.distance - found.gap > S::from_f64(SLACK) * pair.distance)
    }

    /// Inverse mass of the heavy one along a direction `[1/kg]`.
    fn weight<S: Real>(self, state: &Cluster<S>, pair: &Pair<S>, (at, n): (S, [S; 2])) -> S {
        let [p, a, b] = places(pair);
        if self.is_of_point { state.felt(p, n) } else { state.felt_on_edge([a, b], at, n) }
    }

    /// Pushes the heavy one alone, out and aside `[kg m]`.
    fn push<S: Real>(
        self,
        state: &mut Cluster<S>,
        (pair, at): (&Pair<S>, S),
        [out, aside]: [[S; 2]; 2],
        change: Change,
    ) {
        let [p, a, b] = places(pair);
        let rest = S::ONE - at;
        let shares = [(p, S::ONE), (a, -rest), (b, -at)];
        let own = if self.is_of_point { &shares[..1] } else { &shares[1..] };
        if change == Change::Way {
            state.note_shares(own, pair.restitution, (out, aside));
        }
        let push = add(out, aside);
        if self.is_of_point {
            return state.push_point(p, push, change);
        }
        let place = add(scale(state.now[a], rest), scale(state.now[b], at));
        state.push_edge(([a, b], at, place), scale(push, -S::ONE), change);
    }

    /// What was there before the substep comes out slowly and without speed.
    fn mend<S: Real>(self, state: &mut Cluster<S>, pairs: &[Pair<S>]) {
        let pair = &pairs[self.pair as usize];
        let far = (pair.old * S::from_f64(MENDED)).min(state.gentle);
        let found = beside(places(pair).map(|i| state.now[i]), pair.side);
        if let Some(Beside { at, normal, .. }) = found.filter(|_| far > S::ZERO) {
            let push = scale(normal, far / self.weight(state, pair, (at, normal)));
            self.push(state, (pair, at), [push, zero()], Change::Place);
        }
    }

    /// What is new is stopped at once, and rubs; what that leaves is lifted as slowly as overlaps are mended. `pushed`: out and aside `[kg m]`.
    fn press<S: Real>(self, state: &mut Cluster<S>, pairs: &[Pair<S>], pushed: &mut [S; 2]) {
        let pair = &pairs[self.pair as usize];
        let [p, a, b] = places(pair);
        let Some(Beside { at, normal, gap }) = beside([p, a, b].map(|i| state.now[i]), pair.side) else { return };
        let lacking = pair.distance - pair.old - gap;
        let of_edge = add(scale(state.way[a], S::ONE - at), scale(state.way[b], at));
        let own = if self.is_of_point { state.way[p] } else { scale(of_edge, -S::ONE) };
        let comes = (-dot(own, normal)).max(S::ZERO);
        let weight = self.weight(state, pair, (at, normal));
        let was = *pushed;
        pushed[0] = (was[0] + lacking.min(comes) / weight).max(S::ZERO);
        let along = left(normal);
        let most = pair.friction * pushed[0];
        let slides = dot(sub(state.way[p], of_edge), along);
        pushed[1] = (was[1] - slides / self.weight(state, pair, (at, along))).max(-most).min(most);
        let (out, aside) = (scale(normal, pushed[0] - was[0]), scale(along, pushed[1] - was[1]));
        self.push(state, (pair, at), [out, aside], Change::Way);
        let slow = (lacking - comes).min(state.gentle / S::from_f64(f64::from(ROUNDS * SWEEPS)));
        if slow > S::ZERO {
            self.push(state, (pair, at), [scale(normal, slow / weight), zero()], Change::Place);
        }
    }
}

fn places<S>(pair: &Pair<S>) -> [usize; 3] {
    [pair.p, pair.a, pair.b].map(|i| i as usize)
}
