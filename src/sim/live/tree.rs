//! Rigid bonds that make trees, solved together along the directions that they have after the prediction: a step of Newton's method
//! by elimination from the leaves to the root.
//!
//! Model: of a point the motion without what is above it is d, and W f what a force f `[kg m]` from above adds. A bond of direction n to
//! a child asks of its parent's motion x that n . x = t with compliance s, where s = n . W_c n and t = length - rest + n . d_c; so
//! W <- W - (W n)(W n)^T/(s + n . W n), d <- d + W n (t - n . d)/(s + n . W n). Back from the root x_c = d_c - W_c n (t - n . x)/s.

use super::body::{Body, Link};
use super::cluster::{Cluster, Common};
use super::strap::stretch;
use crate::sim::bond::Bond;
use crate::sim::kernels::links::Turned;
use crate::sim::real::Real;
use crate::sim::sizes::MOST_LIVE_TREE;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Passes over contacts where bodies are rigid, whose touches hang together, and where each is followed by a round: a crumpled rope that
/// strikes itself at 40 m/s is strained by 0.5 with 3. Trees of more bonds than these have as many passes as all others: eight would take
/// them over the time of a frame.
const PASSES: u32 = 8;
/// Rounds of it before contacts, and one after each pass over them.
const ROUNDS: u32 = 2;
/// Counted work of a round for each bond.
const OF_A_BOND: u64 = 80;
/// Phase that the tension T of a bond of length l swings a point of mass m across in a substep h at most, h sqrt(T/(m l)) `[rad]`: a weight that
/// whirls on a rope of light points loses a tenth of its energy in 2 s from 0.4 on, and gains without end from 1.5 on. And the same where there is
/// work for that many substeps: what wobbles on a rope shakes it, and what is shaken so is lost.
const MOST_SWING: f64 = 0.3;
const FINE_SWING: f64 = 0.1;

/// Of these bonds the forest that they make, every bond from parent to child and parents first, if they make one: what is held is a root.
///
/// Nothing with branches that hangs between pins: where it is taut, it swings faster than substeps can follow, and sweeps bear that.
pub(super) fn forest(rigid: &[Bond], is_pinned: impl Fn(u32) -> bool) -> Option<Vec<Bond>> {
    // A sweep over a bond alone is exact.
    if rigid.len() < 2 {
        return None;
    }
    let mut at: Vec<(u32, u32)> = rigid.iter().zip(0..).flat_map(|(bond, k)| [(bond.a.0, k), (bond.b.0, k)]).collect();
    at.sort_unstable();
    let mut points: Vec<u32> = at.iter().map(|entry| entry.0).collect();
    points.dedup();
    let of = |point: u32| {
        let start = at.partition_point(|entry| entry.0 < point);
        at[start..].iter().take_while(move |entry| entry.0 == point).map(|entry| entry.1)
    };
    let [pinned, free]: [Vec<u32>; 2] = {
        let (pinned, free) = points.iter().partition(|&&point| is_pinned(point));
        [pinned, free]
    };
    let (leaves, others): (Vec<u32>, Vec<u32>) = free.into_iter().partition(|&point| of(point).count() == 1);
    let mut is_seen = vec![false; points.len()];
    let place = |point: u32| points.partition_point(|&other| other < point);
    let mut done = vec![false; rigid.len()];
    let mut list: Vec<Bond> = Vec::with_capacity(rigid.len());
    for root in pinned.into_iter().chain(leaves).chain(others) {
        if std::mem::replace(&mut is_seen[place(root)], true) {
            continue;
        }
        let (mut next, mut parent) = (list.len(), root);
        loop {
            for k in of(parent) {
                if std::mem::replace(&mut done[k as usize], true) {
                    continue;
                }
                let bond = rigid[k as usize];
                let bond = if bond.a.0 == parent { bond } else { Bond { a: bond.b, b: bond.a, ..bond } };
                if std::mem::replace(&mut is_seen[place(bond.b.0)], true) {
                    return None;
                }
                list.push(bond);
            }
            let Some(bond) = list.get(next) else { break };
            (parent, next) = (bond.b.0, next + 1);
        }
    }
    let has_branches = points.iter().any(|&point| of(point).count() > 2);
    let is_between_pins = list.iter().any(|bond| is_pinned(bond.b.0));
    (!has_branches || !is_between_pins).then_some(list)
}

/// A bond on its way up.
#[derive(Clone, Copy)]
struct Step<S> {
    normal: [S; 2],
    target: S,
    give: S,
}

/// What a point does without what is above it.
#[derive(Clone, Copy)]
struct Loose<S> {
    /// xx, xy, yy `[1/kg]`
    w: [S; 3],
    /// `[m]`
    d: [S; 2],
}

impl<S: Real> Loose<S> {
    #[inline(always)]
    fn by(&self, n: [S; 2]) -> [S; 2] {
        let [xx, xy, yy] = self.w;
        [xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]]
    }
}

/// Solves the forest of a body before contacts are. Returns the largest phase that what it pulls at swings across it in the substep `[rad]`.
pub(super) fn solve<S: Real>(state: &mut Cluster<S>, links: &[Link<S>], body: (&Body<S>, usize)) -> S {
    let square = round::<S, true>(state, links, body);
    (1..ROUNDS).for_each(|_| {
        round::<S, false>(state, links, body);
    });
    square.sqrt()
}

/// Counted work of a substep, about, of trees of so many bonds that nothing presses.
pub(super) fn work(bonds: u32) -> u64 {
    OF_A_BOND * u64::from(ROUNDS * bonds)
}

/// Substeps of a frame that this frequency of what swings across a taut tree asks for, and would have where they are affordable `[rad/s]`.
pub(super) fn substeps(swing: f64) -> [f64; 2] {
    [MOST_SWING, FINE_SWING].map(|most| swing / super::FRAMES / most)
}

/// Passes over areas and contacts, more where something near has trees, whose bonds each of them pulls at; and how far a pass may push
/// what is not near yet `[m]`.
pub(super) fn passes<S: Real>(state: &Cluster<S>, common: &Common<S>) -> (u32, S) {
    let usual = (super::substep::PASSES, S::from_f64(super::substep::PUSHED) * state.least_promise);
    if state.pairs.is_empty() && state.on_planes.is_empty() {
        return usual;
    }
    // A round pulls slow points half an edge along.
    let pulled = state.least_promise + state.least_promise;
    let largest = state.members(common).map(|(body, _)| body.tree).max().unwrap_or_default();
    match largest {
        0 if state.rigid_count() > 0 => (PASSES, usual.1),
        0 => usual,
        1..=MOST_LIVE_TREE => (PASSES, pulled),
        _ => (usual.0, pulled),
    }
}

/// One round over the forests of what was pressed in this substep, over large ones before the last pass alone, and so over what angles bend.
pub(super) fn straighten<S: Real>(state: &mut Cluster<S>, common: &Common<S>, is_last: bool) {
    let is_pressed = state.is_pressed();
    let is_due = |body: &Body<S>| match is_pressed {
        true => is_last || body.tree <= MOST_LIVE_TREE,
        false => is_last && body.hinges.len() > 0,
    };
    for (body, base) in state.members(common).filter(|(body, _)| body.tree > 0 && is_due(body)) {
        round::<S, false>(state, &common.holds(body)[..body.tree as usize], (body, base));
    }
}

/// One round over a forest of a body whose points begin at `base`. Returns the largest h^2 T/(m l) of what it pulls at `[1]` where that is asked for.
fn round<S: Real, const LOOKS: bool>(state: &mut Cluster<S>, links: &[Link<S>], (body, base): (&Body<S>, usize)) -> S {
    let (count, stretched) = (body.points.len(), stretch(&body.straps, &state.now[base..]));
    let own = |w: S| Loose { w: [w, S::ZERO, w], d: zero() };
    let mut loose: Vec<Loose<S>> = state.w[base..base + count].iter().map(|&w| own(w)).collect();
    let mut steps = vec![Step { normal: zero(), target: S::ZERO, give: S::ZERO }; links.len()];
    for (link, step) in links.iter().zip(&mut steps).rev() {
        let (a, b) = (link.a as usize, link.b as usize);
        let r = sub(state.now[base + b], state.now[base + a]);
        let length = dot(r, r).sqrt();
        let n = if length > S::ZERO { scale(r, S::ONE / length) } else { [S::ONE, S::ZERO] };
        let child = loose[b];
        let give = dot(n, child.by(n));
        let target = length - link.rest * stretched + dot(n, child.d);
        let parent = &mut loose[a];
        let turned = parent.by(n);
        let sum = give + dot(n, turned);
        *step = Step { normal: n, target, give };
        if sum > S::ZERO {
            let [x, y] = turned;
            let [xx, xy, yy] = parent.w;
            parent.w = [xx - x * x / sum, xy - x * y / sum, yy - y * y / sum];
            parent.d = add(parent.d, scale(turned, (target - dot(n, parent.d)) / sum));
        }
    }
    let Cluster { start, turned, w, .. } = &mut *state;
    let mut swings = S::ZERO;
    for (link, step) in links.iter().zip(&steps) {
        let (a, b) = (link.a as usize, link.b as usize);
        if step.give > S::ZERO {
            let n = step.normal;
            let force = (step.target - dot(n, loose[a].d)) / step.give;
            loose[b].d = sub(loose[b].d, scale(loose[b].by(n), force));
            let ends = [base + a, base + b];
            // A pull of `force` shortens the bond: it is T h^2.
            if LOOKS && link.rest > S::ZERO {
                swings = swings.max(force * w[ends[0]].max(w[ends[1]]) / link.rest);
            }
            Turned { start, turned }.note(ends, ends.map(|end| w[end]), scale(n, -force));
        }
    }
    for (i, loose) in (base..).zip(&loose) {
        if state.w[i] != S::ZERO {
            state.now[i] = add(state.now[i], loose.d);
            state.way[i] = add(state.way[i], loose.d);
        }
    }
    state.counts.bonds += links.len() as u64;
    state.counts.work += OF_A_BOND * links.len() as u64;
    swings
}
