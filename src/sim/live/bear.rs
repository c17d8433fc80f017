//! What is heavy sinks no further into what is light than that gives way.
//!
//! A light body between a heavy one and a floor takes the push of each whole and bears neither: passes over contacts push it to and fro, as often
//! as the one is heavier than the other, and press its triangles flat and its bonds short. So after them these are opened and held, and the
//! light body put out of obstacles and of others like it, once more; then the heavy one is stopped where it would go on into it, as by an
//! obstacle that moves as the light one does. What stops it in truth is what stands behind: nothing is done where the light body is not pressed
//! the other way, by an obstacle or by what is so itself, and the momentum of others stays.
//! Source of the idea: shock propagation, in E. Guendelman and others, Nonconvex Rigid Bodies with Stacking, 2003.

use super::areas;
use super::bonds;
use super::cluster::{Cluster, Common};
use super::contact::{pressed, rubbed};
use super::pair::{Beside, Pair, left};
use super::props::{Met, Props};
use super::rigid::{Change, Frame};
use super::tree;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// How many times as heavy the one has to be.
pub(super) const HEAVIER: f64 = 16.0;
/// Share of their distance by which two may be nearer.
const SLACK: f64 = 0.1;
/// How often light bodies are opened and what lies on them is stopped, and sweeps over that: its touches hang together where it is rigid.
const ROUNDS: u32 = 2;
const SWEEPS: u32 = 8;

/// Whether some of its points, or bodies that move as one, are so much heavier than others; those that are held count for none.
pub(super) fn is_uneven<S: Real>(state: &Cluster<S>) -> bool {
    let loose = (0..state.own()).filter(|&i| !state.is_of_rigid([i, i])).map(|i| state.w[i].to_f64());
    let all = loose.chain(state.frames.iter().map(Frame::ease)).filter(|&w| w > 0.0);
    let (least, most) = all.fold((f64::INFINITY, 0.0_f64), |(least, most), w| (least.min(w), most.max(w)));
    most > least * HEAVIER
}

/// Stops what is heavy at what is light, once all passes are over.
pub(super) fn stop<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    if !state.is_uneven {
        return;
    }
    state.counts.work += 15 * state.active.len() as u64;
    let met = met(state);
    let mut heavy: Vec<Touch<S>> = met.iter().filter_map(|met| Touch::of(state, met)).collect();
    if heavy.is_empty() {
        return;
    }
    let props = Props::of(state, common, &met);
    heavy.retain(|touch| props.has(touch.light, touch.way));
    if heavy.is_empty() {
        return;
    }
    let mut is_heavy = vec![false; state.bodies.len()];
    heavy.iter().for_each(|touch| is_heavy[touch.heavy as usize] = true);
    let grips: Vec<S> = heavy.iter().map(|touch| props.grip(touch.light)).collect();
    let mut pushed = vec![[S::ZERO; 2]; heavy.len()];
    for _ in 0..ROUNDS {
        // What gave way to what lies on it comes back.
        areas::unfold(state, common);
        bonds::hold_again(state);
        state.press_others(common, &is_heavy);
        let pairs = std::mem::take(&mut state.pairs);
        state.counts.work += 25 * heavy.len() as u64;
        if heavy.iter().any(|touch| touch.is_deep(state, &pairs)) {
            state.counts.work += 30 * u64::from(SWEEPS) * heavy.len() as u64;
            for _ in 0..SWEEPS {
                let touches = heavy.iter().zip(&grips).zip(&mut pushed);
                touches.for_each(|((touch, &grip), pushed)| touch.press(state, (&pairs, grip), pushed));
            }
        }
        state.pairs = pairs;
    }
    state.straighten_rigs();
    tree::straighten(state, common, true);
}

impl<S: Real> Cluster<S> {
    /// One pass over contacts with what does not move, and of those that are not heavy with each other.
    fn press_others(&mut self, common: &Common<S>, is_heavy: &[bool]) {
        let (mut pairs, active) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.active));
        self.counts.work += 2 * active.len() as u64;
        for &number in &active {
            let pair = &mut pairs[number as usize];
            let [p, a, b] = pair.places();
            let is_fixed = self.w[p] == S::ZERO || self.w[a] == S::ZERO && self.w[b] == S::ZERO;
            if is_fixed || ![p, a].iter().any(|&i| is_heavy[self.body_of[i] as usize]) {
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

/// What presses each other, and how it lies.
fn met<S: Real>(state: &Cluster<S>) -> Vec<Met<S>> {
    let pressed = state.active.iter().filter(|&&number| state.pairs[number as usize].contact.pressed > S::ZERO);
    pressed.filter_map(|&pair| Some(Met { pair, found: state.pairs[pair as usize].found(state)? })).collect()
}

/// A touch of something heavy and something light.
#[derive(Clone, Copy)]
struct Touch<S> {
    pair: u32,
    /// The point is the heavy one.
    is_of_point: bool,
    /// The body of each.
    heavy: u32,
    light: u32,
    /// From the light one to the heavy one.
    way: [S; 2],
}

impl<S: Real> Touch<S> {
    fn of(state: &Cluster<S>, &Met { pair, found }: &Met<S>) -> Option<Self> {
        let [p, a, b] = state.pairs[pair as usize].places();
        if p.max(a) >= state.own() {
            return None;
        }
        let Beside { at, normal, .. } = found;
        let (of_point, of_edge) = (state.felt(p, normal), state.felt_on_edge([a, b], at, normal));
        let heavier = S::from_f64(HEAVIER);
        let is_of_point = of_point * heavier < of_edge;
        let is_any = is_of_point && of_point > S::ZERO || of_edge > S::ZERO && of_edge * heavier < of_point;
        let (heavy, light, way) = if is_of_point { (p, a, normal) } else { (a, p, scale(normal, -S::ONE)) };
        let [heavy, light] = [heavy, light].map(|i| state.body_of[i]);
        is_any.then_some(Touch { pair, is_of_point, heavy, light, way })
    }

    /// Whether the two are nearer than they may be, what was so before the substep included.
    fn is_deep(self, state: &Cluster<S>, pairs: &[Pair<S>]) -> bool {
        let pair = &pairs[self.pair as usize];
        pair.found(state).is_some_and(|found| pair.distance - found.gap > S::from_f64(SLACK) * pair.distance)
    }

    /// Inverse mass of the heavy one along a direction `[1/kg]`.
    fn weight(self, state: &Cluster<S>, pair: &Pair<S>, (at, n): (S, [S; 2])) -> S {
        let [p, a, b] = pair.places();
        if self.is_of_point { state.felt(p, n) } else { state.felt_on_edge([a, b], at, n) }
    }

    /// Pushes the heavy one alone, out and aside `[kg m]`.
    fn push(self, state: &mut Cluster<S>, (pair, at): (&Pair<S>, S), [out, aside]: [[S; 2]; 2]) {
        let [p, a, b] = pair.places();
        let rest = S::ONE - at;
        let shares = [(p, S::ONE), (a, -rest), (b, -at)];
        let own = if self.is_of_point { &shares[..1] } else { &shares[1..] };
        state.note_shares(own, pair.restitution, (out, aside));
        let push = add(out, aside);
        if self.is_of_point {
            return state.push_point(p, push, Change::Way);
        }
        let place = add(scale(state.now[a], rest), scale(state.now[b], at));
        state.push_edge(([a, b], at, place), scale(push, -S::ONE), Change::Way);
    }

    /// Stops the heavy one where it would go on into the light one, and rubs it with all that presses it. `pushed`: out and aside `[kg m]`.
    fn press(self, state: &mut Cluster<S>, (pairs, grip): (&[Pair<S>], S), pushed: &mut [S; 2]) {
        let pair = &pairs[self.pair as usize];
        let [p, a, b] = pair.places();
        let Some(Beside { at, normal, gap }) = pair.found(state) else { return };
        let lacking = pair.distance - pair.contact.old - gap;
        let of_edge = add(scale(state.way[a], S::ONE - at), scale(state.way[b], at));
        let own = if self.is_of_point { state.way[p] } else { scale(of_edge, -S::ONE) };
        let comes = (-dot(own, normal)).max(S::ZERO);
        let was = *pushed;
        pushed[0] = pressed(was[0], lacking.min(comes), self.weight(state, pair, (at, normal)));
        let along = left(normal);
        // What rubs it already counts; no more than holds the light one.
        let most =
            (pair.friction.min(grip) * (pair.contact.pressed + pushed[0]) - pair.contact.rubbed.abs()).max(S::ZERO);
        let slides = dot(sub(state.way[p], of_edge), along);
        pushed[1] = rubbed(was[1], slides, (self.weight(state, pair, (at, along)), most));
        self.push(state, (pair, at), [scale(normal, pushed[0] - was[0]), scale(along, pushed[1] - was[1])]);
    }
}
