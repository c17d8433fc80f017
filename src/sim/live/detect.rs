//! What is near what: points of skins near edges, by a grid of the edges, and points near planes.
//!
//! What is found holds as long as no point goes further than was promised.

use super::FRAMES;
use super::build::Bodies;
use super::cells::grid;
use super::circle;
use super::cluster::{Cluster, Common, OBSTACLE, Side};
use super::contact::Contact;
use super::cross;
use super::pair::{OnPlane, Pair, Sides, wedge};
use super::part;
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// Share of a frame after which it is looked anew at the soonest, unless points are so fast that too much would be near: then after each
/// substep.
const LEAST_TIME: f64 = 0.25;
/// Least and most that a point may go until then, in quarters of the shortest mean edge, and how much further than in one substep in any
/// case.
const PROMISES: [f64; 2] = [1.0, 2.0];
const ONE_SUBSTEP: f64 = 1.1;
/// Pairs for each point of a skin from which on less is promised until the step ends, and the least share of it.
const MANY: usize = 16;
const LEAST_SHARE: f64 = 0.25;

/// Edges that all points look at together, each at so many at least, and pairs that they make, each so many at least: where a crowd lies in
/// one place every point meets those that are nearest, of as many as it can be expected to look at.
const MOST_LOOKS: [usize; 2] = [500_000, 64];
const MOST_PAIRS: [usize; 2] = [32_000, 16];

/// Corners up to which each looks at all edges: a grid would take more.
const FEW: usize = 4;

/// Counted work of a search for each edge and each cell that it is in, each edge that a corner looks at and that it is near, and each pair.
const OF_AN_EDGE: u64 = 20;
const OF_A_LOOK: u64 = 8;
const OF_A_FIND: u64 = 60;
const OF_A_PAIR: u64 = 300;

/// Share of the radius of its skin that an edge keeps from corners of obstacles: one that lies right on a corner is slid over it.
const CLEAR: f64 = 0.2;

/// An edge as points look at it.
pub(super) struct Line<S> {
    pub(super) from: [S; 2],
    pub(super) along: [S; 2],
    pub(super) square: S,
    /// How far from it a point may be that has no radius and goes nowhere `[m]`.
    pub(super) reach: S,
    pub(super) body: u32,
    ends: [u32; 2],
}

/// Where a point lies of an edge.
#[derive(Clone, Copy)]
pub(super) struct Found<S> {
    pub(super) edge: usize,
    /// Square of the distance `[m^2]`.
    pub(super) square: S,
    /// > 0 on the left of the edge.
    across: S,
    /// The nearest place is an end.
    pub(super) is_end: bool,
}

/// Finds pairs of points and edges anew; those that were there keep their sides. Points are looked at as far around as they may go: what
/// is slow in a crowd has few pairs, however fast others are. Where all are crowded less is promised, until the step ends.
pub(super) fn look<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    if state.edges.is_empty() && state.circles.is_empty() && common.surfaces.is_empty() {
        // There is nothing to find, wherever points go.
        let own = state.own();
        return state.promised[..own].fill(S::INFINITY);
    }
    let old = known(state);
    loop {
        promise(state, state.share);
        let is_least = 0.5 * state.share < LEAST_SHARE;
        let most = if is_least { usize::MAX } else { MANY * state.corners.len() };
        if find_pairs(state, common, (&old, most)) {
            return;
        }
        state.share *= 0.5;
    }
}

/// The same for points that go at most this far `[m]`.
pub(super) fn look_within<S: Real>(state: &mut Cluster<S>, common: &Common<S>, promise: S) {
    let own = state.own();
    state.promised[..own].fill(promise);
    let old = known(state);
    find_pairs(state, common, (&old, usize::MAX));
}

/// How far each point may go: a share of what is usual, further where it is fast.
fn promise<S: Real>(state: &mut Cluster<S>, share: f64) {
    let (soon, substep) = (S::from_f64(LEAST_TIME / FRAMES), state.span * S::from_f64(ONE_SUBSTEP));
    let [least, most] = PROMISES.map(|promise| state.least_promise * S::from_f64(share * promise));
    for i in 0..state.own() {
        let speed = dot(state.velocity[i], state.velocity[i]).sqrt();
        state.promised[i] = least.max((soon * speed).min(most.max(substep * speed)));
    }
}

/// Finds all pairs, whose sides were `old` before. Returns whether they are no more than `most`; where there are more, it has none.
fn find_pairs<S: Real>(state: &mut Cluster<S>, common: &Common<S>, (old, most): (&Sides, usize)) -> bool {
    let own = state.own();
    state.gone[..own].fill(S::ZERO);
    state.counts.detections += 1;
    let boxes = state.boxes();
    let loads = state.loads(common.bodies);
    near_planes(state, common, &boxes);
    if state.edges.is_empty() {
        state.load_again(common, loads);
        return true;
    }
    let mut pairs = std::mem::take(&mut state.pairs);
    pairs.clear();
    let first = state.corners.first().map_or(0, |corner| u64::from(corner.1) << 32);
    // Sides from before the step hold at its start: later what is not followed any more went around an end.
    let stored: &[(u64, i8)] = if state.counts.substeps == 0 { common.sides } else { &[] };
    let known = [Seen::from(old, first), Seen::from(stored, first)];
    let least = state.promised[..own].iter().fold(S::INFINITY, |least, &promised| least.min(promised));
    let most_looks = most_each(MOST_LOOKS, state.corners.len());
    let most_pairs = most_each(MOST_PAIRS, state.corners.len());
    let mut search = Search { lines: lines(state, common), known, least, most_pairs, near: Vec::new(), pairs };
    // Corners of obstacles meet edges of bodies alone.
    let has_own = state.edges.first().is_some_and(|edge| edge.body != OBSTACLE);
    let is_own = |&(p, _): &(u32, u32)| state.body_of[p as usize] != OBSTACLE;
    let count = if has_own { state.corners.len() } else { state.corners.partition_point(is_own) };
    let grid = (count > FEW).then(|| grid(state, &search.lines));
    let entered = grid.as_ref().map_or(0, |(_, _, entries, _)| entries.len());
    state.counts.work += OF_AN_EDGE * (state.edges.len() + entered) as u64;
    let (mut looked, mut found) = (0, 0);
    for &(p, number) in &state.corners[..count] {
        let (x, body) = (state.now[p as usize], state.body_of[p as usize]);
        let around = radius(state, common, body) + state.promised[p as usize];
        let mut see = |edge: usize| {
            looked += 1;
            if let Some(found) = find(&search.lines[edge], edge, x, around)
                && may_meet(state, common, (p, body), &search.lines[edge])
            {
                search.near.push(found);
            }
        };
        match &grid {
            Some((cells, starts, entries, long)) => {
                if let Some(cell) = cells.place(x) {
                    let own = &entries[starts[cell] as usize..starts[cell + 1] as usize];
                    own.iter().take(most_looks).for_each(|&edge| see(edge as usize));
                }
                long.iter().for_each(|&edge| see(edge));
            }
            None => (0..state.edges.len()).for_each(&mut see),
        }
        found += search.near.len() as u64;
        search.pair(state, common, (p, number), around);
        if search.pairs.len() > most {
            break;
        }
    }
    state.counts.work += OF_A_LOOK * looked + OF_A_FIND * found + OF_A_PAIR * search.pairs.len() as u64;
    if search.pairs.len() > most {
        state.pairs = search.pairs;
        state.pairs.clear();
        return false;
    }
    search.lead_out(state, common);
    circle::near_edges(state, common, (&boxes, &mut search));
    let mut pairs = search.pairs;
    pairs.sort_unstable_by_key(|pair| pair.key);
    part::suspend(state, &mut pairs);
    state.list(pairs);
    state.load_again(common, loads);
    true
}

/// What of a crowd each corner gets: its share of all, but not less than the second number.
fn most_each([all, least]: [usize; 2], corners: usize) -> usize {
    (all / corners.max(1)).max(least)
}

/// What is looked through for edges around corners.
pub(super) struct Search<'a, S> {
    pub(super) lines: Vec<Line<S>>,
    /// Sides from this step, and from before it.
    known: [Seen<'a>; 2],
    /// The least way that a point may go `[m]`.
    least: S,
    /// Pairs that a corner makes at most: those with the nearest edges.
    most_pairs: usize,
    /// Edges near the corner that is looked at.
    near: Vec<Found<S>>,
    pub(super) pairs: Vec<Pair<S>>,
}

impl<S: Real> Search<'_, S> {
    /// Notes an edge if it is nearer to a place than `around` `[m]`.
    pub(super) fn see(&mut self, (edge, x): (usize, [S; 2]), around: S) {
        self.near.extend(find(&self.lines[edge], edge, x, around));
    }

    /// Makes pairs of a corner and the edges that were noted, all those nearer than `around` `[m]`.
    pub(super) fn pair(&mut self, state: &Cluster<S>, common: &Common<S>, (p, number): (u32, u32), around: S) {
        let body = state.body_of[p as usize];
        // Edges that are nearer than that were found.
        let sure = |edge: usize| match state.edges[edge].body {
            OBSTACLE => around,
            of => around + self.least + radius(state, common, of),
        };
        if self.near.len() > self.most_pairs {
            let squares = |a: &Found<S>, b: &Found<S>| a.square.to_f64().total_cmp(&b.square.to_f64());
            let order = |a: &Found<S>, b: &Found<S>| squares(a, b).then(a.edge.cmp(&b.edge));
            self.near.select_nth_unstable_by(self.most_pairs, order);
            self.near.truncate(self.most_pairs);
        }
        self.near.sort_unstable_by_key(|found| state.edges[found.edge].number);
        let [before, sides] = &mut self.known;
        for found in &self.near {
            let key = u64::from(number) << 32 | u64::from(state.edges[found.edge].number);
            let known = before.side(key).or_else(|| sides.side(key));
            let side = known.unwrap_or_else(|| side(state, p, found, (&self.near, sure(found.edge))));
            if side == 0 && body == state.edges[found.edge].body {
                continue;
            }
            let mut pair = pair(state, common, (p, found.edge, key), side);
            let is_behind = pair.side * found.across < S::ZERO;
            pair.room = if is_behind { -S::INFINITY } else { found.square.sqrt() - pair.distance };
            self.pairs.push(pair);
        }
        self.near.clear();
    }
}

/// Sides of pairs that may touch, by their numbers: of others they are seen.
pub(super) fn known<S: Real>(state: &Cluster<S>) -> Vec<(u64, i8)> {
    let is_followed = |pair: &&Pair<S>| pair.seen == state.counts.substeps as u32 && pair.side != S::ZERO;
    let of = |pair: &Pair<S>| (pair.key, if pair.side > S::ZERO { 1 } else { -1 });
    state.pairs.iter().filter(is_followed).map(of).collect()
}

/// Sides that are asked for by numbers which ascend, but for a few.
struct Seen<'a> {
    sides: &'a [(u64, i8)],
    at: usize,
}

impl<'a> Seen<'a> {
    /// From the first number that is asked for on.
    fn from(sides: &'a [(u64, i8)], key: u64) -> Self {
        Seen { sides, at: sides.partition_point(|side| side.0 < key) }
    }

    fn side(&mut self, key: u64) -> Option<i8> {
        if self.at > 0 && self.sides[self.at - 1].0 >= key {
            self.at = self.sides.partition_point(|side| side.0 < key);
        }
        while self.sides.get(self.at).is_some_and(|side| side.0 < key) {
            self.at += 1;
        }
        self.sides.get(self.at).filter(|side| side.0 == key).map(|side| side.1)
    }
}

/// The side that a point belongs to of an edge that it was not near before.
///
/// In front of what is closed it stays in front. Behind it is inside only if no other edge of that body is nearer, of those nearer than
/// `sure` `[m]`, which were all found; then it is to come out there. Otherwise it belongs nowhere: 0. So does the middle of a circle behind what
/// is folded, unless it is inside: it is too far away to be put out at once.
fn side<S: Real>(state: &Cluster<S>, p: u32, found: &Found<S>, (near, sure): (&[Found<S>], S)) -> i8 {
    let edge = &state.edges[found.edge];
    if !edge.is_closed {
        return if found.across >= S::ZERO { 1 } else { -1 };
    }
    if found.across >= S::ZERO {
        return 1;
    }
    if found.is_end {
        return 0;
    }
    if state.body_of[p as usize] == edge.body {
        return -1;
    }
    if found.square > sure * sure {
        return 0;
    }
    let is_nearer = |other: &Found<S>| state.edges[other.edge].body == edge.body && other.square < found.square;
    if near.iter().any(is_nearer) {
        return 0;
    }
    let is_round = state.circles.binary_search_by_key(&p, |circle| circle.0).is_ok();
    i8::from(!is_round || cross::is_inside(state, state.now[p as usize], edge.body))
}

pub(super) fn pair<S: Real>(
    state: &Cluster<S>,
    common: &Common<S>,
    (p, edge, key): (u32, usize, u64),
    side: i8,
) -> Pair<S> {
    let of = &state.edges[edge];
    let (edge_of, round) = (of.body, common.radius_at((key >> 32) as u32));
    let contact = common.contact.copied().unwrap_or_default();
    let body = state.body_of[p as usize];
    let surface = match (of.body, body) {
        (OBSTACLE, _) => Some(common.walls.surface_of_side(of.number - common.bodies.edges.len() as u32)),
        (_, OBSTACLE) => Some(common.walls.surface_of_corner((key >> 32) as u32 - common.bodies.order.len() as u32)),
        _ => None,
    };
    let own = || common.bodies.between([(key >> 32) as u32, number(state, common.bodies, of.ends[0])]);
    let [friction, restitution, distance] = match surface {
        Some(surface) => {
            let of = &common.surfaces[surface];
            let clear = if body == OBSTACLE { radius(state, common, edge_of) * S::from_f64(CLEAR) } else { S::ZERO };
            [of.friction, of.restitution, round.unwrap_or(clear)]
        }
        None => own().unwrap_or_else(|| {
            let [friction, restitution] = [contact.friction, contact.restitution].map(S::from_f64);
            [friction, restitution, distance(state, common, body, of)]
        }),
    };
    Pair {
        p,
        a: of.ends[0],
        b: of.ends[1],
        key,
        side: S::from_f64(f64::from(side)),
        is_closed: of.is_closed,
        is_round: round.is_some(),
        distance,
        room: S::ZERO,
        friction,
        restitution,
        contact: Contact::new(),
        seen: state.counts.substeps as u32,
    }
}

/// The number for ever of a point of a body.
pub(super) fn number<S: Real>(state: &Cluster<S>, bodies: &Bodies<S>, point: u32) -> u32 {
    let body = state.body_of[point as usize] as usize;
    point - state.bases[body] + bodies.list[state.bodies[body]].points.first
}

/// The distance that a point keeps from an edge `[m]`: the sum of the radii; of obstacles none.
fn distance<S: Real>(state: &Cluster<S>, common: &Common<S>, body: u32, edge: &Side) -> S {
    if body == OBSTACLE || edge.body == OBSTACLE {
        return S::ZERO;
    }
    radius(state, common, body) + radius(state, common, edge.body)
}

/// The radius of the skin of a body `[m]`; of obstacles none.
fn radius<S: Real>(state: &Cluster<S>, common: &Common<S>, body: u32) -> S {
    if body == OBSTACLE { S::ZERO } else { common.bodies.list[state.bodies[body as usize]].radius }
}

/// Where a point lies of an edge, if that is near.
#[inline(always)]
pub(super) fn find<S: Real>(line: &Line<S>, edge: usize, x: [S; 2], around: S) -> Option<Found<S>> {
    let (u, r) = (line.along, sub(x, line.from));
    let most = line.reach + around;
    let along = dot(r, u);
    let is_end = along < S::ZERO || along > line.square;
    let from = match is_end {
        true if along < S::ZERO => r,
        true => sub(r, u),
        false if line.square > S::ZERO => sub(r, scale(u, along / line.square)),
        false => r,
    };
    let far = dot(from, from);
    (far <= most * most).then(|| Found { edge, square: far, across: wedge(u, r), is_end })
}

/// Whether a point and an edge are of those that meet.
fn may_meet<S: Real>(state: &Cluster<S>, common: &Common<S>, (p, body): (u32, u32), line: &Line<S>) -> bool {
    if body == OBSTACLE || line.body == OBSTACLE {
        let passes = if body == OBSTACLE { state.passes_obstacles(&line.ends) } else { state.passes_obstacles(&[p]) };
        return body != line.body && !passes;
    }
    let Some(contact) = common.contact else { return false };
    if body != line.body {
        return contact.with_others;
    }
    let ends = line.ends.map(|end| end as usize);
    contact.with_itself
        && !state.is_rigid(body)
        && !line.ends.contains(&p)
        && !state.go_together([p as usize, ends[0], ends[1]])
        && !common.bodies.is_passed(state, (p as usize, ends))
}

/// All edges, to be met within their radii and as far as their ends may go.
fn lines<S: Real>(state: &Cluster<S>, common: &Common<S>) -> Vec<Line<S>> {
    let line = |edge: &Side| {
        let [a, b] = edge.ends.map(|end| state.now[end as usize]);
        let along = sub(b, a);
        let [goes_a, goes_b] = edge.ends.map(|end| state.promised[end as usize]);
        let reach = radius(state, common, edge.body) + goes_a.max(goes_b);
        Line { from: a, along, square: dot(along, along), reach, body: edge.body, ends: edge.ends }
    };
    state.edges.iter().map(line).collect()
}

/// Finds which points are near planes and circles.
fn near_planes<S: Real>(state: &mut Cluster<S>, common: &Common<S>, boxes: &circle::Boxes<S>) {
    state.on_planes.clear();
    for (number, surface) in common.planes.iter().enumerate() {
        for i in 0..state.own() {
            if state.w[i] != S::ZERO && !state.is_inner(i) && surface.gap(state.now[i]) < state.promised[i] {
                state.on_planes.push(OnPlane::new(i as u32, number as u32, surface.normal));
            }
        }
    }
    circle::near_points(state, common, boxes);
    state.on_planes.sort_unstable_by_key(|on| (on.p, on.surface));
}
