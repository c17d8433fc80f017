//! What is near what: skins near planes, balls and boxes, and points near triangles, by a grid of the triangles.
//!
//! What is found holds as long as no point goes further than was promised of it; against each other, further than its patch does, and
//! patches as they go against each other (`patches.rs`).

use super::cluster::{Cluster, Common};
use super::geometry::{nearest, volume};
use super::grid::{Grid, Seen};
use super::obstacle::{Shape, Solid};
use super::pair::{Pair, Sides};
use super::patches::Patches;
use super::touch::{Kind, Touch};
use crate::sim::contact::convex::BOX_EDGES;
use crate::sim::live::FRAMES;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Share of a frame after which it is looked anew at the soonest, however fast points are.
const LEAST_TIME: f64 = 0.25;
/// How long the sides of a triangle may get, as a multiple of its longest at rest: what is stretched further meets nothing of its own body,
/// so that bonds can untangle it.
const STRETCHED: f64 = 2.0;

/// Finds anew what obstacles touch.
pub(super) fn look_at_obstacles<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    state.gone_far.fill(S::ZERO);
    let time = S::from_f64(LEAST_TIME / FRAMES);
    // What is fast alone, or drags on others, has much near it, not all that goes with it.
    for (promised, &velocity) in state.promised_far.iter_mut().zip(&state.velocity) {
        *promised = state.least_promise + dot(velocity, velocity).sqrt() * time;
    }
    let mut touches = std::mem::take(&mut state.touches);
    touches.clear();
    // Bonds and contacts lead a point by as much within a substep as the fastest goes.
    let led = state.led_by(state.fastest());
    let farthest = led + state.promised_far.iter().fold(S::ZERO, |most, &promised| most.max(promised));
    let is_free = |i: &usize| state.w[*i] != S::ZERO;
    for (number, surface) in common.planes.iter().enumerate() {
        for i in
            (0..state.now.len()).filter(is_free).filter(|&i| surface.gap(state.now[i]) < led + state.promised_far[i])
        {
            touches.push(Touch::new(Kind::Plane(number as u32), [i as u32; 3], common));
        }
    }
    let Some(extent) = crate::sim::measure::extent(&state.now) else { return };
    for (number, solid) in common.solids.iter().enumerate().filter(|(_, solid)| solid.is_near(extent, farthest)) {
        near_solid(state, common, (number as u32, solid, led), &mut touches);
    }
    // Points last: what they say holds exactly.
    touches.sort_by_key(|touch| (std::cmp::Reverse(rank(touch.kind)), touch.points));
    state.counts.work += 10 * (state.now.len() * (common.planes.len() + common.solids.len())) as u64;
    state.counts.work += 60 * touches.len() as u64;
    state.touch_rooms.clear();
    state.touch_rooms.extend(touches.iter().map(|touch| touch.room(common, &state.now)));
    state.touches = touches;
    state.near.clear();
}

fn rank(kind: Kind) -> u32 {
    match kind {
        Kind::Plane(_) => 0,
        Kind::Point(_) => 1,
        Kind::Edge(_) | Kind::BoxEdge(..) => 2,
        Kind::Triangle(_) | Kind::Corner(..) => 3,
    }
}

/// What of skins is near a ball or a box, points of it led by so much within a substep `[m]`.
fn near_solid<S: Real>(
    state: &Cluster<S>,
    common: &Common<S>,
    (number, solid, led): (u32, &Solid<S>, S),
    touches: &mut Vec<Touch<S>>,
) {
    let reach = |points: &[u32]| led + points.iter().fold(S::ZERO, |most, &i| most.max(state.promised_far[i as usize]));
    let is_near = |points: &[u32]| {
        let mut extent = [[S::INFINITY; 3], [-S::INFINITY; 3]];
        for x in points.iter().map(|&i| state.now[i as usize]) {
            for k in 0..3 {
                extent[0][k] = extent[0][k].min(x[k]);
                extent[1][k] = extent[1][k].max(x[k]);
            }
        }
        solid.is_near(extent, reach(points)) && points.iter().any(|&i| state.w[i as usize] != S::ZERO)
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
                let apart = reach(&[a, b]) * S::from_f64(2.0);
                for (k, ends) in BOX_EDGES.iter().enumerate() {
                    if are_near(own, ends.map(|end| corners[end as usize]), apart) {
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
                let [a, b, c] = three(&state.now, points);
                let apart = reach(&points) * S::from_f64(2.0);
                for (k, &corner) in corners.iter().enumerate() {
                    let from = nearest([corner, a, b, c]).from;
                    if dot(from, from) < apart * apart {
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
    let bodies: Vec<_> = state.bodies.iter().map(|&body| &common.bodies.list[body]).collect();
    let widest = bodies.iter().fold(S::ZERO, |most, body| most.max(body.radius));
    let pushed = state.led();
    let nearing = promise(state, widest + widest + pushed);
    let mut pairs = std::mem::take(&mut state.pairs);
    pairs.clear();
    state.rooms.clear();
    let grid = Grid::over(state, widest + widest + state.least_promise + pushed);
    let reaches = Reaches::new(state);
    let stretched = Stretched::of(state, &common.bodies.sizes);
    let mut seen = Seen::of(state.triangles.len());
    let mut looked = 0;
    for &(p, number) in &state.corners {
        let body = state.body_of[p as usize];
        let beyond = state.promised[p as usize] - state.least_promise + nearing[state.patches.of(p as usize)];
        grid.near(state.now[p as usize], beyond, &mut seen);
        let first = pairs.len();
        let reach = beyond + widest + widest + state.least_promise + pushed;
        looked += seen.list.len() as u64;
        for &triangle in seen.list.iter().filter(|&&triangle| reaches.are_near(triangle, state.now[p as usize], reach))
        {
            let (corners, of_triangle, other) = state.triangles[triangle as usize];
            let meets_itself = || contact.with_itself && !stretched.has(p, triangle);
            let meets = if other == body { meets_itself() } else { contact.with_others };
            let points = [p, corners[0], corners[1], corners[2]];
            if !meets || corners.contains(&p) || points.iter().all(|&i| state.w[i as usize] == S::ZERO) {
                continue;
            }
            let own = &bodies[body as usize];
            let distance = if other == body { own.own_distance } else { own.radius + bodies[other as usize].radius };
            let [a, b, c] = three(&state.now, corners);
            let places = [state.now[p as usize], a, b, c];
            let from = nearest(places).from;
            let room = dot(from, from).sqrt() - distance;
            let nears = state.patches.promised(p, corners);
            if room > state.promised[p as usize] + farthest(&state.promised, corners) + nears + pushed {
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
    state.counts.detections += 1;
    state.counts.work += 200 * (state.triangles.len() + state.corners.len()) as u64;
    state.counts.work += 120 * pairs.len() as u64 + 4 * looked;
    state.rooms.extend(pairs.iter().map(|pair| pair.room));
    state.pairs = pairs;
    state.chosen.clear();
}

/// Promises how far points may go against their patches and those against each other, until it is looked anew. `reach`: how near is near,
/// beside that `[m]`. Returns of every patch how far others may come towards it.
fn promise<S: Real>(state: &mut Cluster<S>, reach: S) -> Vec<S> {
    let time = S::from_f64(LEAST_TIME / FRAMES);
    let mut patches = Patches::over(&state.now);
    let means = patches.means(&state.velocity);
    for (i, (&velocity, promised)) in state.velocity.iter().zip(&mut state.promised).enumerate() {
        let apart = sub(velocity, means[patches.of(i)]);
        *promised = state.least_promise + dot(apart, apart).sqrt() * time;
    }
    state.gone_apart.fill(S::ZERO);
    let longest = state.triangles.iter().fold(S::ZERO, |most, &(corners, ..)| {
        let [a, b, c] = three(&state.now, corners);
        [sub(a, b), sub(b, c), sub(c, a)].into_iter().fold(most, |most, side| most.max(dot(side, side)))
    });
    let of_points = (&state.now[..], &means[..], &state.promised[..]);
    let nearing = patches.promise(of_points, (time, state.least_promise * S::HALF, reach + longest.sqrt()));
    state.patches = patches;
    nearing
}

/// Triangles that are stretched beyond all measure, and their corners: nothing where there is none.
struct Stretched {
    triangles: Vec<bool>,
    points: Vec<bool>,
}

impl Stretched {
    /// `sizes`: longest sides at rest, by the numbers of triangles `[m]`.
    fn of<S: Real>(state: &Cluster<S>, sizes: &[S]) -> Self {
        let is_stretched = |&(corners, number, _): &([u32; 3], u32, u32)| {
            let [a, b, c] = three(&state.now, corners);
            let most = sizes[number as usize] * S::from_f64(STRETCHED);
            [sub(a, b), sub(b, c), sub(c, a)].into_iter().any(|side| dot(side, side) > most * most)
        };
        if !state.triangles.iter().any(is_stretched) {
            return Stretched { triangles: Vec::new(), points: Vec::new() };
        }
        let triangles: Vec<bool> = state.triangles.iter().map(is_stretched).collect();
        let mut points = vec![false; state.now.len()];
        for (&(corners, ..), _) in state.triangles.iter().zip(&triangles).filter(|(_, stretched)| **stretched) {
            corners.iter().for_each(|&corner| points[corner as usize] = true);
        }
        Stretched { triangles, points }
    }

    fn has(&self, point: u32, triangle: u32) -> bool {
        !self.triangles.is_empty() && (self.triangles[triangle as usize] || self.points[point as usize])
    }
}

/// Of triangles the middle, and how far corners are from it with what is promised of them `[m]`.
struct Reaches<S>(Vec<([S; 3], S)>);

impl<S: Real> Reaches<S> {
    fn new(state: &Cluster<S>) -> Self {
        let third = S::from_f64(1.0 / 3.0);
        let of = |&(corners, ..): &([u32; 3], u32, u32)| {
            let [a, b, c] = three(&state.now, corners);
            let middle = scale(add(add(a, b), c), third);
            let far = [sub(a, middle), sub(b, middle), sub(c, middle)];
            let far = dot(far[0], far[0]).max(dot(far[1], far[1])).max(dot(far[2], far[2]));
            (middle, far.sqrt() + farthest(&state.promised, corners))
        };
        Reaches(state.triangles.iter().map(of).collect())
    }

    /// Whether a place may come nearer than `reach` `[m]`: NaN is looked at.
    #[inline(always)]
    fn are_near(&self, triangle: u32, x: [S; 3], reach: S) -> bool {
        let (middle, far) = self.0[triangle as usize];
        let (d, most) = (sub(x, middle), far + reach);
        let is_far = dot(d, d) > most * most;
        !is_far
    }
}

/// Sides of pairs, by their numbers.
pub(super) fn known<S: Real>(pairs: &[Pair<S>]) -> Sides {
    pairs.iter().map(|pair| (pair.key, if pair.side > S::ZERO { 1 } else { -1 })).collect()
}

fn side_of(sides: &[(u64, i8)], key: u64) -> Option<i8> {
    sides.binary_search_by_key(&key, |side| side.0).ok().map(|found| sides[found].1)
}

/// Entries of three points.
#[inline(always)]
pub(super) fn three<T: Copy>(list: &[T], [a, b, c]: [u32; 3]) -> [T; 3] {
    [list[a as usize], list[b as usize], list[c as usize]]
}

/// The largest entry of three points.
#[inline(always)]
pub(super) fn farthest<S: Real>(list: &[S], [a, b, c]: [u32; 3]) -> S {
    list[a as usize].max(list[b as usize]).max(list[c as usize])
}

/// Whether more than what was promised would be gone after `h` `[s]` at the speeds of now: of obstacles, and of each other.
pub(super) fn is_due<S: Real>(state: &Cluster<S>, h: S) -> [bool; 2] {
    let goes_on = |i: usize| {
        let (velocity, left) = (state.velocity[i], state.promised_far[i] - state.gone_far[i]);
        left >= S::ZERO && h * h * dot(velocity, velocity) <= left * left
    };
    // NaN is looked at.
    let obstacles = !(0..state.now.len()).all(goes_on);
    if state.triangles.is_empty() {
        return [obstacles, false];
    }
    let means = state.patches.means(&state.velocity);
    let leaves = |i: usize| {
        let mean = means[state.patches.of(i)];
        let (apart, left) = (sub(state.velocity[i], mean), state.promised[i] - state.gone_apart[i]);
        // NaN is looked at.
        let stays = left >= S::ZERO && h * h * dot(apart, apart) <= left * left;
        !stays
    };
    let ways: Vec<[S; 3]> = means.iter().map(|&mean| scale(mean, h)).collect();
    [obstacles, state.patches.leave(&ways) || (0..state.now.len()).any(leaves)]
}

/// Counts the ways of a substep against the promises.
pub(super) fn count_ways<S: Real>(state: &mut Cluster<S>) {
    for (gone, &way) in state.gone_far.iter_mut().zip(&state.way) {
        *gone += dot(way, way).sqrt();
    }
    if state.triangles.is_empty() {
        return;
    }
    let means = state.patches.means(&state.way);
    for (i, (gone, &way)) in state.gone_apart.iter_mut().zip(&state.way).enumerate() {
        let apart = sub(way, means[state.patches.of(i)]);
        *gone += dot(apart, apart).sqrt();
    }
    state.patches.go(&means);
}
