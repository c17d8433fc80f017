//! Skins that cross: edges of bodies that pass through each other, and bodies that lie inside others.

use super::build::Bodies;
use super::cluster::{Cluster, OBSTACLE, Side};
use super::pair::{is_right_of, wedge};
use crate::sim::real::Real;
use crate::sim::vector::{add, scale, sub};

/// Two edges that cross.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing<S> {
    /// Their bodies in the cluster, ascending.
    pub(super) bodies: [u32; 2],
    /// Where `[m]`.
    pub(super) at: [S; 2],
    /// +1 where the second body's edge leaves the first body, -1 where it enters it.
    pub(super) turn: S,
    /// Both edges.
    pub(super) ends: [[u32; 2]; 2],
    /// Both have something on their right.
    pub(super) is_closed: bool,
}

/// A box about an edge.
struct Span<S> {
    low: [S; 2],
    high: [S; 2],
    edge: usize,
}

/// Couples of edges that are looked at for each edge, and at least in all: of a crowd in one place some crossings are enough.
const MOST_LOOKS: [usize; 2] = [64, 1_000_000];

/// The crossings of the skins of a cluster, by their bodies: boxes about the edges are swept along x.
pub(super) fn list<S: Real>(state: &Cluster<S>, bodies: &Bodies<S>) -> Vec<Crossing<S>> {
    let mut spans: Vec<Span<S>> = (0..state.edges.len())
        .filter(|&edge| state.edges[edge].body != OBSTACLE)
        .map(|edge| {
            let [a, b] = state.edges[edge].ends.map(|end| state.now[end as usize]);
            let [low, high] = [[a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]];
            Span { low, high, edge }
        })
        .collect();
    spans.sort_by(|a, b| a.low[0].partial_cmp(&b.low[0]).unwrap_or(std::cmp::Ordering::Equal));
    let mut found = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut left = (MOST_LOOKS[0] * spans.len()).max(MOST_LOOKS[1]);
    for k in 0..spans.len() {
        let own = &spans[k];
        open.retain(|&other| spans[other].high[0] >= own.low[0]);
        if open.len() > left {
            break;
        }
        left -= open.len();
        for &other in &open {
            let other = &spans[other];
            if other.low[1] <= own.high[1] && other.high[1] >= own.low[1] {
                let edges = [other, own].map(|span| &state.edges[span.edge]);
                let passes = edges[0].body == edges[1].body && bodies.pass(state, edges);
                found.extend(if passes { None } else { crossing(state, edges) });
            }
        }
        open.push(k);
    }
    found.sort_by_key(|crossing| crossing.bodies);
    found
}

/// Where two edges cross; `None`: they do not, or share an end.
fn crossing<S: Real>(state: &Cluster<S>, [first, second]: [&Side; 2]) -> Option<Crossing<S>> {
    let [first, second] = if first.body <= second.body { [first, second] } else { [second, first] };
    if first.ends.iter().any(|end| second.ends.contains(end)) {
        return None;
    }
    let [a, b] = first.ends.map(|end| state.now[end as usize]);
    let [c, d] = second.ends.map(|end| state.now[end as usize]);
    let (u, v) = (sub(b, a), sub(d, c));
    let [from, to] = [wedge(u, sub(c, a)), wedge(u, sub(d, a))];
    let is_through = |x: S, y: S| (x < S::ZERO && y > S::ZERO) || (x > S::ZERO && y < S::ZERO);
    if !is_through(from, to) || !is_through(wedge(v, sub(a, c)), wedge(v, sub(b, c))) {
        return None;
    }
    Some(Crossing {
        bodies: [first.body, second.body],
        ends: [first.ends, second.ends],
        at: add(c, scale(v, from / (from - to))),
        turn: if to > S::ZERO { S::ONE } else { -S::ONE },
        is_closed: first.is_closed && second.is_closed,
    })
}

/// Edges between two that cross up to which the skin is creased there, and no more.
const CREASE: u32 = 3;

/// Whether two edges of a skin that cross have so few others between them that it is creased there: what is led back for that crosses more.
pub(super) fn is_crease<S: Real>(state: &Cluster<S>, crossing: &Crossing<S>) -> bool {
    let [first, second] = crossing.ends;
    let skin = &state.edges[edges_of(state, crossing.bodies[0])];
    let mut reached = first.to_vec();
    (0..CREASE).any(|_| {
        let from = reached.clone();
        let next = skin.iter().filter(|edge| edge.ends.iter().any(|end| from.contains(end)));
        reached.extend(next.flat_map(|edge| edge.ends));
        reached.iter().any(|end| second.contains(end))
    })
}

/// Couples of bodies, ascending, one of which lies inside the skin of the other without crossing it: only what is closed has an inside.
pub(super) fn swallowed<S: Real>(state: &mut Cluster<S>) -> Vec<[u32; 2]> {
    let count = state.bodies.len();
    let has_inside = |k: usize| state.edges[edges_of(state, k as u32)].iter().any(|edge| edge.is_closed);
    let outers: Vec<usize> = (0..count).filter(|&k| has_inside(k)).collect();
    let boxes: Vec<[[S; 2]; 2]> =
        if outers.is_empty() { Vec::new() } else { (0..count).map(|k| extent(state, k)).collect() };
    let mut found = Vec::new();
    let mut left = (MOST_LOOKS[0] * count).max(MOST_LOOKS[1]);
    for outer in outers {
        let own = edges_of(state, outer as u32).len();
        for inner in (0..count).filter(|&inner| inner != outer) {
            let is_within =
                (0..2).all(|k| boxes[outer][0][k] <= boxes[inner][0][k] && boxes[inner][1][k] <= boxes[outer][1][k]);
            if !is_within {
                continue;
            }
            if own > left {
                break;
            }
            left -= own;
            if is_inside(state, state.now[state.bases[inner] as usize], outer as u32) {
                found.push([inner.min(outer) as u32, inner.max(outer) as u32]);
            }
        }
        state.counts.work += 4 * count as u64;
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// The edges of a body among those of its cluster.
fn edges_of<S: Real>(state: &Cluster<S>, body: u32) -> std::ops::Range<usize> {
    let [first, end] = [body, body + 1].map(|body| state.edges.partition_point(|edge| edge.body < body));
    first..end
}

fn extent<S: Real>(state: &Cluster<S>, k: usize) -> [[S; 2]; 2] {
    let mut bounds = [[S::INFINITY; 2], [-S::INFINITY; 2]];
    for x in &state.now[state.bases[k] as usize..state.bases[k + 1] as usize] {
        for k in 0..2 {
            bounds[0][k] = bounds[0][k].min(x[k]);
            bounds[1][k] = bounds[1][k].max(x[k]);
        }
    }
    bounds
}

/// Whether a place is inside what the closed edges of a body bound, by the even-odd rule.
pub(super) fn is_inside<S: Real>(state: &Cluster<S>, x: [S; 2], body: u32) -> bool {
    let own = state.edges[edges_of(state, body)].iter().filter(|edge| edge.is_closed);
    own.filter(|edge| is_right_of(edge.ends.map(|end| state.now[end as usize]), x)).count() % 2 == 1
}
