//! Points, edges and triangles on planes, balls and boxes: how hard they press, how they rub.

use super::cluster::{Cluster, Common};
use super::detect::three;
use super::obstacle::Off;
use crate::sim::contact::convex::BOX_EDGES;
use crate::sim::live::contact::{lacking, pressed};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub, zero};

/// Share of a depth from before a substep that is mended in it, without speed.
pub(super) const MENDED: f64 = 0.2;

/// What is touched, and by what.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// A plane, by a point.
    Plane(u32),
    /// A ball or a box, by a point.
    Point(u32),
    /// A ball, by an edge.
    Edge(u32),
    /// A ball, by a triangle.
    Triangle(u32),
    /// A corner of a box, by a triangle.
    Corner(u32, u32),
    /// An edge of a box, by an edge.
    BoxEdge(u32, u32),
}

/// Something near an obstacle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch<S> {
    pub(super) kind: Kind,
    /// Places in the cluster; those that are none repeat the first.
    pub(super) points: [u32; 3],
    pub(super) friction: S,
    restitution: S,
    /// What presses it off in this substep `[kg m]`, and what rubs.
    pub(super) pressed: S,
    rubbed: [S; 3],
    /// It slides on.
    pub(super) slips: bool,
    /// Depth from before the substep, which is not to become speed `[m]`.
    old: S,
    /// Normal speed before it was solved `[m/s]`.
    approach: S,
    is_met: bool,
}

impl<S: Real> Touch<S> {
    pub(super) fn new(kind: Kind, points: [u32; 3], common: &Common<S>) -> Self {
        let (friction, restitution) = match kind {
            Kind::Plane(k) => (common.planes[k as usize].friction, common.planes[k as usize].restitution),
            Kind::Point(k) | Kind::Edge(k) | Kind::Triangle(k) | Kind::Corner(k, _) | Kind::BoxEdge(k, _) => {
                (common.solids[k as usize].friction, common.solids[k as usize].restitution)
            }
        };
        Touch {
            kind,
            points,
            friction,
            restitution,
            pressed: S::ZERO,
            rubbed: zero(),
            slips: false,
            old: S::ZERO,
            approach: S::ZERO,
            is_met: false,
        }
    }

    /// The substep begins anew.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        (self.pressed, self.rubbed, self.old, self.is_met) = (S::ZERO, zero(), S::ZERO, false);
    }

    /// Where it is, having been at `before` at the start of the substep.
    #[inline(always)]
    pub(super) fn look(&self, common: &Common<S>, (before, now): (&[[S; 3]], &[[S; 3]])) -> Option<Off<S>> {
        let [p, q, r] = [self.points[0] as usize, self.points[1] as usize, self.points[2] as usize];
        let solid = |k: u32| &common.solids[k as usize];
        match self.kind {
            Kind::Plane(k) => {
                let surface = &common.planes[k as usize];
                let (normal, gap) = (surface.normal, surface.gap(now[p]));
                Some(Off { shares: [S::ONE, S::ZERO, S::ZERO], normal, gap })
            }
            Kind::Point(k) => solid(k).of_point(before[p], now[p]),
            Kind::Edge(k) => solid(k).of_edge([before[p], before[q]], [now[p], now[q]]),
            Kind::Triangle(k) => solid(k).of_triangle([before[p], before[q], before[r]], [now[p], now[q], now[r]]),
            Kind::Corner(k, corner) => {
                solid(k).of_corner(corner, [before[p], before[q], before[r]], [now[p], now[q], now[r]])
            }
            Kind::BoxEdge(k, edge) => solid(k).of_box_edge(edge, [before[p], before[q]], [now[p], now[q]]),
        }
    }

    /// How far it may go until it may touch, at least `[m]`: 0 of what does.
    pub(super) fn room(&self, common: &Common<S>, now: &[[S; 3]]) -> S {
        match self.look(common, (now, now)) {
            Some(off) if off.gap <= S::ZERO => return S::ZERO,
            Some(off) if matches!(self.kind, Kind::Plane(_) | Kind::Point(_)) => return off.gap,
            _ => {}
        }
        let places = three(now, self.points);
        let far = match self.kind {
            Kind::Plane(_) | Kind::Point(_) => S::ZERO,
            Kind::Edge(k) | Kind::Triangle(k) => common.solids[k as usize].gap_of_ball(places),
            Kind::Corner(k, corner) => common.solids[k as usize].gap_of_corners(&[corner], places),
            Kind::BoxEdge(k, edge) => common.solids[k as usize].gap_of_corners(&BOX_EDGES[edge as usize], places),
        };
        // NaN is looked at.
        if far > S::ZERO { far } else { S::ZERO }
    }

    /// Puts it out, and rubs.
    #[inline(always)]
    pub(super) fn press(&mut self, state: &mut Cluster<S>, common: &Common<S>) {
        let Some(Off { shares, normal, mut gap }) = self.look(common, (&state.start, &state.now)) else { return };
        if gap >= S::ZERO && self.pressed == S::ZERO {
            return;
        }
        let each = |k: usize| (self.points[k] as usize, shares[k]);
        let w = (0..3).map(each).fold(S::ZERO, |sum, (i, share)| sum + share * share * state.w[i]);
        if w == S::ZERO {
            return;
        }
        if !self.is_met {
            self.is_met = true;
            let v = (0..3).map(each).fold(zero(), |sum, (i, share)| add(sum, scale(state.velocity[i], share)));
            self.approach = dot(v, normal);
            // What it did not go in this substep was there before, whatever else was nearest then.
            let d = (0..3).map(each).fold(zero(), |sum, (i, share)| add(sum, scale(state.way[i], share)));
            let depth = (dot(d, normal) - gap).max(S::ZERO);
            if depth > S::ZERO {
                let mended = depth * S::from_f64(MENDED);
                for (i, share) in (0..3).map(each) {
                    state.put(i, scale(normal, mended / w * share * state.w[i]));
                }
                gap += mended;
                self.old = depth - mended;
            }
        }
        let before = self.pressed;
        self.pressed = pressed(before, -(self.old + gap), w);
        let d = (0..3).map(each).fold(zero(), |sum, (i, share)| add(sum, scale(state.way[i], share)));
        let rubbed = rub(self.rubbed, (d, normal), (w, self.friction * self.pressed));
        self.slips = rubbed.1;
        let impulse = add(scale(normal, self.pressed - before), sub(rubbed.0, self.rubbed));
        self.rubbed = rubbed.0;
        for (i, share) in (0..3).map(each) {
            state.shift(i, scale(impulse, share * state.w[i]));
        }
    }

    /// Gives the normal velocity that restitution asks for, where it came faster than `least` `[m/s]`.
    pub(super) fn bounce(&self, state: &mut Cluster<S>, common: &Common<S>, least: S) {
        if self.restitution == S::ZERO || self.pressed == S::ZERO || self.approach > -least {
            return;
        }
        let Some(Off { shares, normal, .. }) = self.look(common, (&state.now, &state.now)) else { return };
        let each = |k: usize| (self.points[k] as usize, shares[k]);
        let w = (0..3).map(each).fold(S::ZERO, |sum, (i, share)| sum + share * share * state.w[i]);
        let v = (0..3).map(each).fold(zero(), |sum, (i, share)| add(sum, scale(state.velocity[i], share)));
        let lacking = lacking(self.restitution, self.approach, dot(v, normal));
        if lacking > S::ZERO && w > S::ZERO {
            for (i, share) in (0..3).map(each) {
                state.velocity[i] = add(state.velocity[i], scale(normal, lacking / w * share * state.w[i]));
            }
        }
    }
}

/// What rubs after the way `d` of one against the other since the start of the substep, and whether that is all that friction gives:
/// Coulomb's cone.
#[inline(always)]
pub(super) fn rub<S: Real>(rubbed: [S; 3], (d, normal): ([S; 3], [S; 3]), (w, most): (S, S)) -> ([S; 3], bool) {
    let across = |v: [S; 3]| sub(v, scale(normal, dot(normal, v)));
    let wanted = sub(across(rubbed), scale(across(d), S::ONE / w));
    let size = length(wanted);
    if size > most { (scale(wanted, most / size), true) } else { (wanted, false) }
}
