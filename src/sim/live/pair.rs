//! A point near an edge: on which side it belongs, how hard they press each other, how they rub.

use super::cluster::Cluster;
use super::contact::{Contact, within};
use super::rigid::Change;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Share of an overlap of skins that was there before a substep that is mended in it, without speed; obstacles put points out at once, but for
/// what began in them.
const MENDED: f64 = 0.2;

/// Share of the speed of two bodies at which parts of one body are led out of each other: joints may hold them there, and what leads against joints
/// creeps over its floor for ever.
const ITSELF: f64 = 0.1;

/// The side of an edge that a point belongs to: +1 on its left, -1 on its right, by the numbers of both.
pub(super) type Sides = Vec<(u64, i8)>;

/// A point near an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<S> {
    /// Places in the cluster.
    pub(super) p: u32,
    pub(super) a: u32,
    pub(super) b: u32,
    /// Numbers of point and edge for ever.
    pub(super) key: u64,
    /// +1: the point belongs on the left of the edge; -1: on its right; 0: it is behind what is closed, around an end, and belongs nowhere
    /// until it is in front again.
    pub(super) side: S,
    pub(super) is_closed: bool,
    /// The point is the centre of a circle.
    pub(super) is_round: bool,
    /// Distance that they keep `[m]`.
    pub(super) distance: S,
    /// How far they were from touching when they were found `[m]`; below 0 where the point was behind the edge.
    pub(super) room: S,
    pub(super) friction: S,
    pub(super) restitution: S,
    pub(super) contact: Contact<S>,
    /// Before which substep the side was last looked at: where they are too far apart to touch nobody does, and the point may go around.
    pub(super) seen: u32,
}

/// A point near a plane, or near a circle, which it meets as a plane in each substep.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnPlane<S> {
    pub(super) p: u32,
    /// Circles are numbered behind the planes.
    pub(super) surface: u32,
    pub(super) normal: [S; 2],
    pub(super) contact: Contact<S>,
    /// It slides on.
    pub(super) slips: bool,
}

/// Where a point is beside an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside<S> {
    /// Share of the edge from its first end on.
    pub(super) at: S,
    /// From the edge to the point.
    pub(super) normal: [S; 2],
    pub(super) gap: S,
}

#[inline(always)]
pub(super) fn wedge<S: Real>(a: [S; 2], b: [S; 2]) -> S {
    a[0] * b[1] - a[1] * b[0]
}

#[inline(always)]
pub(super) fn left<S: Real>(a: [S; 2]) -> [S; 2] {
    [-a[1], a[0]]
}

/// Whether an edge from `a` to `b` lies across the line from a place to the right: of what is closed an odd number of edges do where the place is
/// inside.
#[inline(always)]
pub(super) fn is_right_of<S: Real>([a, b]: [[S; 2]; 2], x: [S; 2]) -> bool {
    (a[1] > x[1]) != (b[1] > x[1]) && (wedge(sub(b, a), sub(x, a)) > S::ZERO) == (b[1] > a[1])
}

/// Where `p` is beside the edge from `a` to `b`; `None`: beyond an end on the wrong side, or the edge has no length.
#[inline(always)]
pub(super) fn beside<S: Real>([p, a, b]: [[S; 2]; 3], side: S) -> Option<Beside<S>> {
    let (u, r) = (sub(b, a), sub(p, a));
    let square = dot(u, u);
    if square == S::ZERO {
        return None;
    }
    let along = dot(r, u);
    let across = side * wedge(u, r);
    if along >= S::ZERO && along <= square {
        let length = square.sqrt();
        let scale_by = side / length;
        return Some(Beside { at: along / square, normal: scale(left(u), scale_by), gap: across / length });
    }
    if across < S::ZERO {
        return None;
    }
    let (at, from) = if along < S::ZERO { (S::ZERO, r) } else { (S::ONE, sub(p, b)) };
    let gap = dot(from, from).sqrt();
    (gap > S::ZERO).then(|| Beside { at, normal: scale(from, S::ONE / gap), gap })
}

/// Whether a point is further behind an edge than that is long: it does not come out there.
#[inline(always)]
pub(super) fn gap_is_hopeless<S: Real>(gap: S, [a, b]: [[S; 2]; 2]) -> bool {
    let u = sub(b, a);
    gap < S::ZERO && gap * gap > dot(u, u)
}

impl<S: Real> Pair<S> {
    /// Its places in the cluster: the point, and the ends of the edge.
    #[inline(always)]
    pub(super) fn places(&self) -> [usize; 3] {
        [self.p as usize, self.a as usize, self.b as usize]
    }

    /// How the point lies beside the edge now.
    #[inline(always)]
    pub(super) fn found(&self, state: &Cluster<S>) -> Option<Beside<S>> {
        let [p, a, b] = self.places();
        beside([state.now[p], state.now[a], state.now[b]], self.side)
    }

    /// Parts point and edge where they are nearer than they may be. Returns whether they are nearer than that and `slack` `[m]`, or
    /// nobody knows.
    #[inline(always)]
    pub(super) fn press(&mut self, state: &mut Cluster<S>, slack: S) -> bool {
        let [p, a, b] = self.places();
        if self.side == S::ZERO || self.seen != state.counts.substeps as u32 {
            self.see(state);
            if self.side == S::ZERO {
                return true;
            }
        }
        let Some(found) = beside([state.now[p], state.now[a], state.now[b]], self.side) else { return true };
        if found.gap >= self.distance && self.contact.pressed == S::ZERO {
            let is_free = found.gap - self.distance >= self.soon(state, [p, a, b], &found);
            if is_free {
                return found.gap < self.distance + slack;
            }
        }
        // Ends meet circles as points.
        if self.is_round && (found.at == S::ZERO || found.at == S::ONE) {
            return true;
        }
        if gap_is_hopeless(found.gap, [state.now[a], state.now[b]]) && p.max(a) < state.own() {
            return true;
        }
        let Beside { at, normal, gap } = found;
        let (points, rest) = ([p, a, b], S::ONE - at);
        let w = state.weight(points, at, normal);
        if w == S::ZERO {
            return true;
        }
        let mut gap = gap;
        if !self.contact.is_met {
            let Some(mended) = self.meet(state, &found, w) else { return true };
            gap += mended;
        }
        let push = self.contact.press(self.distance - self.contact.old - gap, w);
        let along = left(normal);
        let d = sub(state.way[p], add(scale(state.way[a], rest), scale(state.way[b], at)));
        let most = self.friction * self.contact.pressed;
        let rub = self.contact.rub(dot(d, along), (state.weight(points, at, along), most));
        let (out, aside) = (scale(normal, push), scale(along, rub));
        state.note_push(points, at, self.restitution, (out, aside));
        let impulse = add(out, aside);
        if impulse != [S::ZERO; 2] {
            state.push(points, at, impulse, Change::Way);
        }
        if state.may_creep() && self.contact.rubbed.abs() < most {
            let of_edge = add(scale(state.crept(a), rest), scale(state.crept(b), at));
            let crept = dot(sub(state.crept(p), of_edge), along) / state.weight(points, at, along);
            if crept != S::ZERO {
                state.push(points, at, scale(along, -within(crept, most)), Change::Place);
            }
        }
        true
    }

    /// The two meet for the first time in this substep. Returns by how much that mends what they overlapped before `[m]`; `None`: what comes from
    /// behind, around an end, is no contact.
    #[inline(always)]
    pub(super) fn meet(&mut self, state: &mut Cluster<S>, found: &Beside<S>, w: S) -> Option<S> {
        let (points, Beside { at, normal, .. }) = (self.places(), *found);
        let ([p, a, b], rest) = (points, S::ONE - at);
        let before = beside([state.start[p], state.start[a], state.start[b]], self.side)?;
        self.contact.is_met = true;
        let v = sub(state.begun[p], add(scale(state.begun[a], rest), scale(state.begun[b], at)));
        self.contact.approach = dot(v, normal);
        let overlap = (self.distance - before.gap).max(S::ZERO);
        if overlap <= S::ZERO {
            return Some(S::ZERO);
        }
        let mended = self.mends(state, (normal, before.gap));
        state.push(points, at, scale(normal, mended / w), Change::Place);
        self.contact.old = overlap - mended;
        Some(mended)
    }

    /// How much is mended at once of what the two overlapped before, where they were so far apart `[m]`.
    #[inline(always)]
    pub(super) fn mends(&self, state: &mut Cluster<S>, (normal, gap): ([S; 2], S)) -> S {
        let ([p, a, b], overlap) = (self.places(), self.distance - gap);
        // Between skins slowly: a body that is deep in another would be torn, its springs loaded from nowhere.
        if p.max(a) < state.own() {
            [p, a].into_iter().for_each(|i| _ = state.note_within(i, overlap));
            let is_itself = state.body_of[p] == state.body_of[a];
            let most = if is_itself { state.gentle * S::from_f64(ITSELF) } else { state.gentle };
            return (overlap * S::from_f64(MENDED)).min(most);
        }
        // A circle whose middle is behind the edge is as deep as it is large.
        if self.is_round && gap < S::ZERO {
            return overlap.min(state.gentle);
        }
        let is_point = p < state.own();
        let led = if is_point { [p, p] } else { [a, b] };
        let out = if is_point { normal } else { scale(normal, -S::ONE) };
        state.led_out(led, out, overlap)
    }

    /// How far the two may be from touching and yet be struck with what touches `[m]`.
    #[inline(always)]
    fn soon(&self, state: &Cluster<S>, [p, a, b]: [usize; 3], found: &Beside<S>) -> S {
        if !state.is_of_rigid([p, a]) {
            return S::ZERO;
        }
        let of_edge = add(scale(state.way[a], S::ONE - found.at), scale(state.way[b], found.at));
        state.at_once([p, a], -dot(sub(state.way[p], of_edge), found.normal))
    }

    /// The side on which the point is as the substep starts, of an edge that it did not touch. Behind what is closed it came around an end,
    /// unless it is of the same body.
    pub(super) fn see(&mut self, state: &Cluster<S>) {
        self.seen = state.counts.substeps as u32;
        let [p, a, b] = self.places();
        let (u, r) = (sub(state.start[b], state.start[a]), sub(state.start[p], state.start[a]));
        let along = dot(r, u);
        let is_inside = || state.body_of[p] == state.body_of[a] && along >= S::ZERO && along <= dot(u, u);
        self.side = match wedge(u, r) >= S::ZERO {
            true => S::ONE,
            false if !self.is_closed || is_inside() => -S::ONE,
            false => S::ZERO,
        };
    }

    /// Where the point went around an end of the edge in this substep the side is the other one; of what is closed, none until it is
    /// in front again.
    pub(super) fn follow(&mut self, state: &Cluster<S>) {
        self.seen = state.counts.substeps as u32 + 1;
        let [p, a, b] = self.places();
        let across = |x: &[[S; 2]]| wedge(sub(x[b], x[a]), sub(x[p], x[a]));
        if self.side * across(&state.now) >= S::ZERO || self.side * across(&state.start) < S::ZERO {
            return;
        }
        if let Some(at) = crossing([p, a, b], state)
            && !(at >= S::ZERO && at <= S::ONE)
        {
            self.side = if self.is_closed { S::ZERO } else { -self.side };
        }
    }

    /// Gives the normal velocity that restitution asks for, where they pressed each other and came faster than `least` `[m/s]`. Returns
    /// whether that lacked.
    pub(super) fn bounce(&mut self, state: &mut Cluster<S>, least: S) -> bool {
        let [p, a, b] = self.places();
        if !self.contact.bounces((self.restitution, state.is_of_rigid([p, a])), least) {
            return false;
        }
        let Some(Beside { at, normal, .. }) = beside([state.now[p], state.now[a], state.now[b]], self.side) else {
            return false;
        };
        let (points, rest) = ([p, a, b], S::ONE - at);
        let w = state.weight(points, at, normal);
        let v = sub(state.velocity[p], add(scale(state.velocity[a], rest), scale(state.velocity[b], at)));
        let (push, lacked) = self.contact.give_back(self.restitution, dot(v, normal), w);
        if push != S::ZERO {
            state.push(points, at, scale(normal, push), Change::Velocity);
        }
        lacked
    }
}

/// Where along the edge a point crosses its line between the start of a substep and now: a share of the edge, outside [0, 1]
/// beyond its ends.
fn crossing<S: Real>([p, a, b]: [usize; 3], state: &Cluster<S>) -> Option<S> {
    let (u, r) = (sub(state.start[b], state.start[a]), sub(state.start[p], state.start[a]));
    let (du, dr) = (sub(state.way[b], state.way[a]), sub(state.way[p], state.way[a]));
    // cross(u + s du, r + s dr) = c + s m + s^2 q
    let c = wedge(u, r);
    let m = wedge(u, dr) + wedge(du, r);
    let q = wedge(du, dr);
    let two = S::ONE + S::ONE;
    let root = (m * m - two * two * q * c).max(S::ZERO).sqrt();
    let half = -S::HALF * (if m < S::ZERO { m - root } else { m + root });
    let is_within = |s: &S| *s >= S::ZERO && *s <= S::ONE;
    let mut roots = [S::INFINITY; 2];
    if q != S::ZERO {
        roots[0] = half / q;
    }
    if half != S::ZERO {
        roots[1] = c / half;
    }
    let first = roots.into_iter().filter(is_within).fold(S::INFINITY, S::min);
    if !first.is_finite() {
        return None;
    }
    let (u, r) = (add(u, scale(du, first)), add(r, scale(dr, first)));
    let square = dot(u, u);
    (square > S::ZERO).then(|| dot(r, u) / square)
}
