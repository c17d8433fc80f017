//! Bodies that hang on one pin and swing about it: the arm that stops against the background would be of.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use super::extent::place;
use super::hubs::{Adjacency, is_broad};
use super::joints::Knee;
use super::{Among, AngleAs};
use crate::sim::vector::{length, sub};
use crate::sim::{Dynamics, Knots, PointId};

/// How far a prop is off its hub, in the arm that turns: so near that both are seen and meant as one `[1]`.
pub(in crate::app) const IN_HUB: f64 = 0.05;
/// Of more pins none is looked at: nets are held by such.
const MOST_PINS: usize = 64;

/// The pins of a world, ascending.
fn pinned(world: &dyn Dynamics) -> Vec<PointId> {
    let mut pinned = world.pinned().to_vec();
    pinned.sort_unstable();
    pinned
}

/// The angles that stops against the background would be of, where no point is a joint yet: each from a prop that comes beside a pin to what of
/// the body that hangs on that is farthest from it. A pin may be meant alone; one that is on its way gets none, for a prop stands still.
pub(super) fn hung(world: &dyn Dynamics, among: &Among) -> Vec<Knee> {
    if world.dimensions() != 2 || among.bonds.is_some() {
        return Vec::new();
    }
    let (mut points, props) = (among.points_of(world), world.props());
    points.retain(|point| props.binary_search(point).is_err());
    let is_meant = |point: &PointId| points.binary_search(point).is_ok();
    let pins: Vec<PointId> = pinned(world).into_iter().filter(is_meant).collect();
    let is_joint = |angle: &crate::sim::Angle| angle.range.is_some() || angle.stiffness == 0.0;
    if pins.is_empty() || pins.len() > MOST_PINS || among.angles_of(world, AngleAs::Joint).iter().any(is_joint) {
        return Vec::new();
    }
    let (net, tracks, mut held) = (Net::of(world), world.pin_tracks(), BTreeSet::new());
    let goes_on = |knots: &Knots| knots.last().is_some_and(|(t, _)| *t > world.time());
    let is_led = |pin: PointId| tracks.iter().any(|(led, knots)| *led == pin && goes_on(knots));
    let arms = pins.into_iter().filter(|pin| !is_led(*pin));
    let arms = arms.filter_map(|pin| Some([pin, net.arm(pin, &mut held)?]));
    let arms = arms.filter(|[_, arm]| points.len() == 1 || is_meant(arm));
    let knee = |([pin, arm], number): ([PointId; 2], u32)| {
        let (at, [x, y, _]) = (place(world, pin), sub(place(world, arm), place(world, pin)));
        // A quarter turn from the arm, clockwise.
        let prop = Some([at[0] + IN_HUB * y, at[1] - IN_HUB * x]);
        Knee { points: [PointId(number), pin, arm], rest: FRAC_PI_2, prop }
    };
    arms.zip(world.next_numbers()[0]..).map(knee).collect()
}

/// What hangs together in a world.
struct Net<'a> {
    world: &'a dyn Dynamics,
    pinned: Vec<PointId>,
    beside: Adjacency,
    /// The triangles that each is a corner of.
    covering: Vec<Vec<u32>>,
}

impl<'a> Net<'a> {
    fn of(world: &'a dyn Dynamics) -> Self {
        let count = world.point_count();
        let beside = Adjacency::of(count, world.bonds().ends().iter().copied(), world.triangles());
        let mut covering = vec![Vec::new(); count];
        for (number, corners) in (0..).zip(world.triangles()) {
            corners.iter().for_each(|corner| covering[corner.index()].push(number));
        }
        Net { world, pinned: pinned(world), beside, covering }
    }

    /// The point by whose direction it is told how the body stands that hangs on a pin; `None`: none does that turns about it as one. `held` are pins of
    /// bodies that others hold too: a body is gone through once, however many hold it.
    fn arm(&self, pin: PointId, held: &mut BTreeSet<PointId>) -> Option<PointId> {
        if held.contains(&pin) {
            return None;
        }
        let sides = self.beside.sides(pin);
        let [side] = &sides[..] else { return None };
        let is_covered = |point: &PointId| !self.covering[point.index()].is_empty();
        let candidates = if is_covered(&pin) {
            self.piece(&[pin])
        } else if is_broad(side) && side.iter().all(is_covered) {
            self.piece(side)
        } else {
            return self.braced(pin).then(|| self.farthest(pin, side)).flatten();
        };
        let is_other_pin = |point: &PointId| *point != pin && self.pinned.binary_search(point).is_ok();
        let others: Vec<PointId> = candidates.iter().copied().filter(is_other_pin).collect();
        if others.is_empty() {
            return self.farthest(pin, &candidates);
        }
        // What goes out from one of these comes to this pin.
        if is_covered(&pin) {
            held.extend(others);
        }
        None
    }

    /// The corners of the triangles at some points, and of those that hang together with them by sides.
    fn piece(&self, from: &[PointId]) -> Vec<PointId> {
        let triangles = self.world.triangles();
        let mut all: Vec<u32> = from.iter().flat_map(|point| &self.covering[point.index()]).copied().collect();
        let mut is_seen = vec![false; triangles.len()];
        all.retain(|&number| !std::mem::replace(&mut is_seen[number as usize], true));
        let mut looked = 0;
        while let Some(&number) = all.get(looked) {
            looked += 1;
            let corners = triangles[number as usize];
            for &other in corners.iter().flat_map(|corner| &self.covering[corner.index()]) {
                let shared = triangles[other as usize].iter().filter(|corner| corners.contains(corner)).count();
                if shared > 1 && !std::mem::replace(&mut is_seen[other as usize], true) {
                    all.push(other);
                }
            }
        }
        let mut points: Vec<PointId> = all.iter().flat_map(|&number| triangles[number as usize]).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    /// Whether all that bonds hold to a pin has no triangle and no other pin, and as many bonds as keep a shape: three less than two a point.
    ///
    /// Source: J. C. Maxwell, On the calculation of the equilibrium and stiffness of frames (1864).
    fn braced(&self, pin: PointId) -> bool {
        let mut is_seen = vec![false; self.covering.len()];
        is_seen[pin.index()] = true;
        let (mut all, mut looked, mut ends) = (vec![pin], 0, 0);
        while let Some(&point) = all.get(looked) {
            looked += 1;
            let is_pinned = self.pinned.binary_search(&point).is_ok();
            if (is_pinned && point != pin) || !self.covering[point.index()].is_empty() {
                return false;
            }
            ends += self.beside.neighbours(point).len();
            for &next in self.beside.neighbours(point) {
                if !std::mem::replace(&mut is_seen[next.index()], true) {
                    all.push(next);
                }
            }
        }
        ends / 2 + 3 >= 2 * all.len()
    }

    /// The first of those points that are farthest from a pin; `None`: all lie where it does.
    fn farthest(&self, pin: PointId, points: &[PointId]) -> Option<PointId> {
        let far = |point: PointId| length(sub(place(self.world, point), place(self.world, pin)));
        let all = points.iter().map(|&point| (point, far(point))).filter(|(_, far)| *far > 0.0);
        all.min_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0))).map(|(point, _)| point)
    }
}
