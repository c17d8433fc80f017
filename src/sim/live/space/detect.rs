//! What is near what: skins near planes, balls and boxes, and points near triangles, by a grid of the triangles.
//!
//! What is found holds as long as no point goes further than was promised of it; against each other, further than the mean of all.

use super::cluster::{Cluster, Common};
use super::geometry::{nearest, volume};
use super::grid::Grid;
use super::obstacle::{Shape, Solid};
use super::pair::{Pair, Sides};
use super::touch::{Kind, Touch};
use crate::sim::contact::convex::BOX_EDGES;
use crate::sim::live::FRAMES;
use crate::sim::real::Real;
use crate::sim::vector::{dot, sub, zero};

/// Share of a frame after which it is looked anew at the soonest, however fast points are.
const LEAST_TIME: f64 = 0.25;

/// Finds anew what obstacles touch.
pub(super) fn look_at_obstacles<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    state.gone = S::ZERO;
    state.promise = state.least_promise.max(state.fastest() * S::from_f64(LEAST_TIME / FRAMES));
    let mut touches = std::mem::take(&mut state.touches);
    touches.clear();
    let reach = state.promise;
    let is_free = |i: &usize| state.w[*i] != S::ZERO;
    for (number, surface) in common.planes.iter().enumerate() {
        for i in (0..state.now.len()).filter(is_free).filter(|&i| surface.gap(state.now[i]) < reach) {
            touches.push(Touch::new(Kind::Plane(number as u32), [i as u32; 3], common));
        }
    }
    let Some(extent) = crate::sim::measure::extent(&state.now) else { return };
    for (number, solid) in common.solids.iter().enumerate().filter(|(_, solid)| solid.is_near(extent, reach)) {
        near_solid(state, common, (number as u32, solid), &mut touches);
    }
    // Points last: what they say holds exactly.
    touches.sort_by_key(|touch| (std::cmp::Reverse(rank(touch.kind)), touch.points));
    state.counts.work += 10 * (state.now.len() * (common.planes.len() + common.solids.len())) as u64;
    state.touches = touches;
}

fn rank(kind: Kind) -> u32 {
    match kind {
        Kind::Plane(_) => 0,
        Kind::Point(_) => 1,
        Kind::Edge(_) | Kind::BoxEdge(..) => 2,
        Kind::Triangle(_) | Kind::Corner(..) => 3,
    }
}

/// What of skins is near a ball or a box.
fn near_solid<S: Real>(
    state: &Cluster<S>,
    common: &Common<S>,
    (number, solid): (u32, &Solid<S>),
    touches: &mut Vec<Touch<S>>,
) {
    let reach = state.promise;
    let is_near = |points: &[u32]| {
        let mut extent = [[S::INFINITY; 3], [-S::INFINITY; 3]];
        for x in points.iter().map(|&i| state.now[i as usize]) {
            for k in 0..3 {
                extent[0][k] = extent[0][k].min(x[k]);
                extent[1][k] = extent[1][k].max(x[k]);
            }
        }
        solid.is_near(extent, reach) && points.iter().any(|&i| state.w[i as usize] != S::ZERO)
    };
    let mut note = |kind: Kind, points: [u32; 3]| touches.push(Touch::new(kind, points, common));
    for i in (0..state.now.len() as u32).filter(|&i| is_near(&[i])) {
        note(Kind::Point(number), [i; 3]);
    }
    for &[a, b] in state.edges.iter().filter(|ends| is_near(&ends[..])) {
        match &solid.shape {
            Shape::Ball { .. } => note(Kind::Edge(number), [a, b, a]),
            Shape::Box { corners, .. } => {
                let own = [a, b].map(|end| state.now[end as usize]);
                for (k, ends) in BOX_EDGES.iter().enumerate() {
                    if are_near(own, ends.map(|end| corners[end as usize]), reach + reach) {
                        note(Kind::BoxEdge(number, k as u32), [a, b, a]);
                    }
                }
            }
        }
    }
    for &(points, ..) in state.triangles.iter().filter(|triangle| is_near(&triangle.0)) {
        match &solid.shape {
            Shape::Ball { .. } => note(Kind::Triangle(number), points),
            Shape::Box { corners, .. } => {
                let [a, b, c] = points.map(|i| state.now[i as usize]);
                for (k, &corner) in corners.iter().enumerate() {
                    let from = nearest([corner, a, b, c]).from;
                    if dot(from, from) < reach * reach * S::from_f64(4.0) {
                        note(Kind::Corner(number, k as u32), points);
                    }
                }
            }
        }
    }
}

/// Whether the boxes along the axes around two segments come nearer than `reach` `[m]`.
fn are_near<S: Real>([a, b]: [[S; 3]; 2], [c, d]: [[S; 3]; 2], reach: S) -> bool {
    (0..3).all(|k| a[k].min(b[k]) - reach <= c[k].max(d[k]) && a[k].max(b[k]) + reach >= c[k].min(d[k]))
}

/// Finds pairs of points and triangles anew; those that were there keep their sides.
pub(super) fn look_at_skins<S: Real>(state: &mut Cluster<S>, common: &Common<S>, old: &Sides) {
    let Some(contact) = common.contact else { return };
    if state.triangles.is_empty() {
        return;
    }
    let (mean, time) = (Cluster::mean(&state.velocity), S::from_f64(LEAST_TIME / FRAMES));
    for i in 0..state.now.len() {
        let apart = sub(state.velocity[i], mean);
        state.promised[i] = state.least_promise.max(dot(apart, apart).sqrt() * time);
        state.gone_apart[i] = S::ZERO;
    }
    let mut pairs = std::mem::take(&mut state.pairs);
    pairs.clear();
    let bodies: Vec<_> = state.bodies.iter().map(|&body| &common.bodies.list[body]).collect();
    let widest = bodies.iter().fold(S::ZERO, |most, body| most.max(body.radius));
    state.rooms.clear();
    let pushed = state.pushed();
    let grid = Grid::over(state, widest + widest + state.least_promise + pushed);
    let mut seen: Vec<u32> = Vec::new();
    for &(p, number) in &state.corners {
        let body = state.body_of[p as usize];
        seen.clear();
        grid.near(state.now[p as usize], state.promised[p as usize] - state.least_promise, &mut seen);
        let first = pairs.len();
        for &triangle in &seen {
            let (corners, of_triangle, other) = state.triangles[triangle as usize];
            let meets = if other == body { contact.with_itself } else { contact.with_others };
            let points = [p, corners[0], corners[1], corners[2]];
            if !meets || corners.contains(&p) || points.iter().all(|&i| state.w[i as usize] == S::ZERO) {
                continue;
            }
            let own = &bodies[body as usize];
            let distance = if other == body { own.own_distance } else { own.radius + bodies[other as usize].radius };
            let places = points.map(|i| state.now[i as usize]);
            let from = nearest(places).from;
            let room = dot(from, from).sqrt() - distance;
            if room > state.promised[p as usize] + farthest(&state.promised, corners) + pushed {
                continue;
            }
            let key = u64::from(number) << 32 | u64::from(of_triangle);
            let side = side_of(old, key).unwrap_or(if volume(places) >= S::ZERO { 1 } else { -1 });
            pairs.push(Pair {
                points,
                key,
                side: if side > 0 { S::ONE } else { -S::ONE },
                distance,
                room,
                friction: S::from_f64(contact.friction),
                restitution: S::from_f64(contact.restitution),
                pressed: S::ZERO,
                rubbed: zero(),
                slips: false,
                old: S::ZERO,
                approach: S::ZERO,
                is_met: false,
            });
        }
        pairs[first..].sort_unstable_by_key(|pair| pair.key);
    }
    // Corners are listed by their numbers, so this finds all in order.
    pairs.sort_unstable_by_key(|pair| pair.key);
    state.counts.work += 60 * (state.triangles.len() + state.corners.len()) as u64 + 30 * pairs.len() as u64;
    state.rooms.extend(pairs.iter().map(|pair| pair.room));
    state.pairs = pairs;
    state.chosen.clear();
}

/// Sides of pairs, by their numbers.
pub(super) fn known<S: Real>(pairs: &[Pair<S>]) -> Sides {
    pairs.iter().map(|pair| (pair.key, if pair.side > S::ZERO { 1 } else { -1 })).collect()
}

fn side_of(sides: &[(u64, i8)], key: u64) -> Option<i8> {
    sides.binary_search_by_key(&key, |side| side.0).ok().map(|found| sides[found].1)
}

/// The largest entry of three points.
#[inline(always)]
pub(super) fn farthest<S: Real>(list: &[S], [a, b, c]: [u32; 3]) -> S {
    list[a as usize].max(list[b as usize]).max(list[c as usize])
}

/// Whether more than what was promised would be gone after `h` `[s]` at the speeds of now: of obstacles, and of each other.
pub(super) fn is_due<S: Real>(state: &Cluster<S>, h: S) -> [bool; 2] {
    let mean = Cluster::mean(&state.velocity);
    let leaves = |i: usize| {
        let (apart, left) = (sub(state.velocity[i], mean), state.promised[i] - state.gone_apart[i]);
        // NaN is looked at.
        let stays = left >= S::ZERO && h * h * dot(apart, apart) <= left * left;
        !stays
    };
    let skins = !state.triangles.is_empty() && (0..state.now.len()).any(leaves);
    [state.gone + h * state.fastest() > state.promise, skins]
}

/// Counts the ways of a substep against the promises.
pub(super) fn count_ways<S: Real>(state: &mut Cluster<S>) {
    state.gone += state.way.iter().fold(S::ZERO, |most, &way| most.max(dot(way, way))).sqrt();
    let mean = Cluster::mean(&state.way);
    for (gone, &way) in state.gone_apart.iter_mut().zip(&state.way) {
        let apart = sub(way, mean);
        *gone += dot(apart, apart).sqrt();
    }
}
