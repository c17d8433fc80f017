//! Circles that bodies meet, by points and by edges.
//!
//! A point meets a circle as the plane that touches it where the way of the point enters it. An edge meets the centre as a corner that
//! keeps the radius as distance, where it is nearest between its ends: these are points. Source of the way of a point into a circle: C.
//! Ericson, Real-Time Collision Detection, 2005, section 5.3.2.

use super::cluster::{Cluster, Common, OBSTACLE};
use super::detect::Search;
use super::pair::{OnPlane, Pair};
use super::rigid::Change;
use crate::sim::contact::polygon::round::Round;
use crate::sim::contact::surface::Surface;
use crate::sim::measure;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, scale, sub, zero};

/// Counted work of looking whether a point or an edge is near a circle.
const LOOKED: u64 = 4;

/// Sweeps over what is near circles in a pass, at most; and how much of what presses may change in the last one.
const SWEEPS: u32 = 16;
const STEADY: f64 = 1e-2;
/// Counted work of pressing an edge off a circle.
const PRESSED: u64 = 25;

/// A circle that does not move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle<S> {
    pub(super) center: [S; 2],
    pub(super) radius: S,
    pub(super) friction: S,
    pub(super) restitution: S,
}

impl<S: Real> Circle<S> {
    /// A circle with the friction and the restitution of a surface.
    pub(super) fn new(round: Round, surface: &Surface<S, 2>) -> Self {
        Circle {
            center: convert(round.center),
            radius: S::from_f64(round.radius),
            friction: surface.friction,
            restitution: surface.restitution,
        }
    }

    /// How far a place is from it `[m]`; below 0 inside.
    #[inline(always)]
    pub(super) fn gap(&self, x: [S; 2]) -> S {
        let from = sub(x, self.center);
        dot(from, from).sqrt() - self.radius
    }

    /// How far a place is above the plane that touches it where the normal points `[m]`.
    #[inline(always)]
    pub(super) fn gap_along(&self, normal: [S; 2], x: [S; 2]) -> S {
        dot(normal, sub(x, self.center)) - self.radius
    }

    /// The normal where a way enters it; `None` of a way that does not, or leads out. A way that begins at the centre leads up.
    #[inline(always)]
    pub(super) fn entry(&self, start: [S; 2], now: [S; 2]) -> Option<[S; 2]> {
        let (before, way) = (sub(start, self.center), sub(now, start));
        // |before + s way| = radius
        let (square, along) = (dot(before, before), dot(before, way));
        let outside = square - self.radius * self.radius;
        if outside <= S::ZERO {
            let length = square.sqrt();
            let normal = if length > S::ZERO { scale(before, S::ONE / length) } else { [S::ZERO, S::ONE] };
            return (self.gap_along(normal, now) < S::ZERO).then_some(normal);
        }
        if along >= S::ZERO {
            return None;
        }
        let root = along * along - dot(way, way) * outside;
        if root < S::ZERO {
            return None;
        }
        let share = outside / (root.sqrt() - along);
        if share > S::ONE {
            return None;
        }
        let enters = add(before, scale(way, share));
        Some(scale(enters, S::ONE / dot(enters, enters).sqrt()))
    }

    /// The normal where a way enters it that leads through: to beyond the centre, or out again.
    fn passed(&self, start: [S; 2], now: [S; 2]) -> Option<[S; 2]> {
        let is_beyond = dot(sub(start, self.center), sub(now, self.center)) <= S::ZERO;
        let comes_out = self.gap(start) > S::ZERO && self.gap(now) >= S::ZERO;
        if is_beyond || comes_out { self.entry(start, now) } else { None }
    }
}

impl<S: Real> Common<'_, S> {
    /// The circle whose centre has this number for ever.
    fn circle_at(&self, number: u32) -> u32 {
        number - self.bodies.order.len() as u32 - self.walls.corner_of_circle(0)
    }

    /// The radius of the circle about an obstacle's corner with this number `[m]`; `None`: there is none.
    pub(super) fn radius_at(&self, number: u32) -> Option<S> {
        let corner = number.checked_sub(self.bodies.order.len() as u32 + self.walls.corner_of_circle(0));
        corner.map(|circle| self.walls.circles[circle as usize].radius)
    }

    /// The circle that a point is on, if that is no plane.
    #[inline(always)]
    pub(super) fn circle_of(&self, on: &OnPlane<S>) -> Option<&Circle<S>> {
        (on.surface as usize).checked_sub(self.planes.len()).map(|circle| &self.walls.circles[circle])
    }
}

impl<S: Real> Cluster<S> {
    /// Circles in a box, their centres behind the corners.
    pub(super) fn include_circles(&mut self, common: &Common<S>, [low, high]: [[S; 2]; 2]) {
        for (circle, number) in common.walls.circles.iter().zip(common.walls.corner_of_circle(0)..) {
            let Circle { center, radius, .. } = *circle;
            if (0..2).all(|k| low[k] <= center[k] + radius && high[k] >= center[k] - radius) {
                self.circles.push((self.now.len() as u32, common.bodies.order.len() as u32 + number));
                self.now.push(center);
                self.velocity.push(zero());
                self.w.push(S::ZERO);
                self.body_of.push(OBSTACLE);
            }
        }
    }

    /// The boxes of its bodies, as far as their points may go; none where there is no circle to be near to.
    pub(super) fn boxes(&self) -> Boxes<S> {
        if self.circles.is_empty() {
            return Vec::new();
        }
        let of = |ends: &[u32]| {
            let own = ends[0] as usize..ends[1] as usize;
            let most = self.promised[own.clone()].iter().fold(S::ZERO, |most, &promised| most.max(promised));
            let [low, high] = measure::extent(&self.now[own]).unwrap_or([[S::INFINITY; 2], [-S::INFINITY; 2]]);
            [low.map(|x| x - most), high.map(|x| x + most)]
        };
        self.bases.windows(2).map(of).collect()
    }
}

/// Lower and upper corners, one box a body `[m]`.
pub(super) type Boxes<S> = Vec<[[S; 2]; 2]>;

/// The bodies that are near a circle, by their boxes.
fn near<S: Real>(circle: &Circle<S>, boxes: &[[[S; 2]; 2]]) -> Vec<u32> {
    let is_near = |[low, high]: &[[S; 2]; 2]| {
        let beside = [0, 1].map(|k| circle.center[k] - circle.center[k].max(low[k]).min(high[k]));
        dot(beside, beside) <= circle.radius * circle.radius
    };
    boxes.iter().zip(0..).filter(|(around, _)| is_near(around)).map(|(_, body)| body).collect()
}

/// Finds which points are near circles.
pub(super) fn near_points<S: Real>(state: &mut Cluster<S>, common: &Common<S>, boxes: &Boxes<S>) {
    if state.circles.is_empty() {
        return;
    }
    let mut looked = state.own() as u64 + (state.circles.len() * boxes.len()) as u64;
    for &(_, number) in &state.circles {
        let circle = common.circle_at(number);
        let of = common.walls.circles[circle as usize];
        for body in near(&of, boxes) {
            let [from, to] = [body, body + 1].map(|body| {
                let base = state.bases[body as usize];
                state.corners.partition_point(|corner| corner.0 < base)
            });
            for &(p, _) in &state.corners[from..to] {
                let i = p as usize;
                if state.w[i] != S::ZERO && of.gap(state.now[i]) < state.promised[i] && !state.passes_obstacles(&[p]) {
                    state.on_planes.push(OnPlane::new(p, common.planes.len() as u32 + circle, zero()));
                }
            }
            looked += (to - from) as u64;
        }
    }
    state.counts.work += LOOKED * looked;
}

/// Finds which edges are near circles.
pub(super) fn near_edges<S: Real>(
    state: &mut Cluster<S>,
    common: &Common<S>,
    (boxes, search): (&Boxes<S>, &mut Search<S>),
) {
    if state.circles.is_empty() {
        return;
    }
    let mut looked = 0;
    for &(p, number) in &state.circles {
        let of = common.walls.circles[common.circle_at(number) as usize];
        for body in near(&of, boxes) {
            let [from, to] = [body, body + 1].map(|body| state.edges.partition_point(|edge| edge.body < body));
            let meets = |edge: &usize| !state.passes_obstacles(&state.edges[*edge].ends);
            (from..to).filter(meets).for_each(|edge| search.see((edge, of.center), of.radius));
            looked += (to - from) as u64;
        }
        search.pair(state, common, (p, number), of.radius);
    }
    state.counts.work += LOOKED * looked;
}

/// Presses bodies off circles until that changes little: where one is wedged into a fold, each side of the fold pushes the point between
/// them so that the other one is pierced.
pub(super) fn press_again<S: Real>(
    state: &mut Cluster<S>,
    common: &Common<S>,
    (pairs, active): (&mut [Pair<S>], &[u32]),
    on_planes: &mut [OnPlane<S>],
) {
    if state.circles.is_empty() {
        return;
    }
    let mut near: Vec<usize> = active.iter().map(|&number| number as usize).collect();
    near.retain(|&number| pairs[number].is_round);
    if near.iter().all(|&number| pairs[number].contact.pressed == S::ZERO) {
        return;
    }
    let pressed = |pairs: &[Pair<S>]| near.iter().fold(S::ZERO, |sum, &number| sum + pairs[number].contact.pressed);
    for _ in 0..SWEEPS {
        let mut changed = S::ZERO;
        for &number in &near {
            let before = pairs[number].contact.pressed;
            pairs[number].press(state, S::ZERO);
            changed += (pairs[number].contact.pressed - before).abs();
        }
        for on in on_planes.iter_mut().filter(|on| common.circle_of(on).is_some()) {
            on.press(state, common);
        }
        state.counts.work += PRESSED * near.len() as u64;
        if changed <= S::from_f64(STEADY) * pressed(pairs) {
            return;
        }
    }
}

/// Cuts the ways of points that go through a circle.
pub(super) fn cut<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    if state.circles.is_empty() {
        return;
    }
    let on_planes = std::mem::take(&mut state.on_planes);
    for on in &on_planes {
        let (p, Some(circle)) = (on.p as usize, common.circle_of(on)) else { continue };
        let Some(normal) = circle.passed(state.start[p], state.now[p]) else { continue };
        let back = scale(normal, -circle.gap_along(normal, state.now[p]) / state.own_weight(p, normal));
        state.counts.truncations += 1;
        state.note_push_of_one(p, circle.restitution, (back, zero()));
        state.push_one(p, back, Change::Way);
    }
    state.on_planes = on_planes;
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    const CIRCLE: Circle<f64> = Circle { center: [2.0, 1.0], radius: 0.5, friction: 0.0, restitution: 0.0 };

    fn close(a: [f64; 2], b: [f64; 2]) -> bool {
        (0..2).all(|k| (a[k] - b[k]).abs() < 1e-12)
    }

    #[test]
    fn a_way_enters_a_circle_where_it_meets_it_first() {
        // Straight at the middle: to the near side, past the middle, and out again.
        for end in [1.6, 2.2, 9.0] {
            assert!(close(CIRCLE.entry([0.0, 1.0], [end, 1.0]).unwrap(), [-1.0, 0.0]), "to {end}");
        }
        // At 0.3 m above the middle: the normal of sides 4, 3, 5.
        let found = CIRCLE.entry([0.0, 1.3], [9.0, 1.3]).unwrap();
        assert!(close(found, [-0.8, 0.6]), "{found:?}");
        let beside = [
            ([0.0, 1.0], [1.4, 1.0]),
            ([0.0, 1.6], [9.0, 1.6]),
            ([0.0, 1.0], [-3.0, 1.0]),
            ([3.0, 1.0], [9.0, 1.0]),
            ([0.0, 1.0], [0.0, 1.0]),
        ];
        assert!(beside.iter().all(|&(start, now)| CIRCLE.entry(start, now).is_none()));
    }

    #[test]
    fn what_begins_inside_is_led_out_where_it_is_nearest() {
        assert!(close(CIRCLE.entry([2.1, 1.0], [2.0, 0.9]).unwrap(), [1.0, 0.0]));
        assert_eq!(CIRCLE.entry([2.1, 1.0], [2.6, 1.0]), None, "it gets out by itself");
        assert!(close(CIRCLE.entry(CIRCLE.center, CIRCLE.center).unwrap(), [0.0, 1.0]), "from the middle, up");
    }

    #[test]
    fn only_ways_that_lead_through_are_cut() {
        assert_eq!(CIRCLE.passed([0.0, 1.0], [1.7, 1.0]), None, "on the near side");
        assert!(CIRCLE.passed([0.0, 1.0], [2.1, 1.0]).is_some(), "beyond the middle");
        assert!(CIRCLE.passed([0.0, 1.3], [9.0, 1.3]).is_some(), "out again");
        assert_eq!(CIRCLE.passed([0.0, 1.6], [9.0, 1.6]), None, "beside it");
    }
}
