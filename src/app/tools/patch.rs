//! What the hand holds of cloths and nets that tear: a patch about the pointer, which the force is shared by, in place of a point that it
//! would pluck out.

use glam::DVec2;

use super::pick::Scope;
use crate::sim::{PointId, Reach};

/// A patch has the points that are so near to the pointer and hang together `[logical px]`.
const REACH: f64 = 28.0;
/// And all that one bond joins to the nearest of them, but for bonds so many times as long as the shortest: a diagonal is of the cloth, a
/// stay is not.
const LONGER: f64 = 2.0;
/// It is torn off only by a pointer that is so far from it `[logical px]`: farther than a cloth lags behind a hand that plays with it.
const TORN_BEYOND: f64 = 120.0;

impl Scope<'_> {
    /// Whether any of some points is of a cloth or a net that tears: in space, or of what no triangles cover. What does not
    /// tear is held by more than a patch.
    fn are_woven(&self, points: &[PointId]) -> bool {
        let is_thin = |point: &PointId| self.shown.dimensions == 3 || !self.is_a_corner(*point);
        let mut thin: Vec<PointId> = points.iter().copied().filter(is_thin).collect();
        thin.sort_unstable();
        !thin.is_empty() && self.may_tear(&thin)
    }

    /// Whether any bond of these points, which are ascending, may break.
    fn may_tear(&self, points: &[PointId]) -> bool {
        let is_of = |end: PointId| points.binary_search(&end).is_ok();
        let bonds = &self.shown.scenery.bonds;
        let of = bonds.ends().iter().enumerate().filter(|(_, ends)| ends.iter().any(|end| is_of(*end)));
        of.map(|(place, _)| bonds.get(place)).any(|bond| bond.break_strain.is_finite())
    }

    /// The points that a press takes of a cloth or a net, by the one that is nearest to the pixel, ascending: those in reach that hang
    /// together with it, and its neighbours; no pins. `None`: it is of no such body.
    pub(super) fn patch(&self, nearest: PointId, at: DVec2) -> Option<Vec<PointId>> {
        if !self.are_woven(&[nearest]) {
            return None;
        }
        let count = self.shown.point_count();
        let mut is_near = vec![false; count];
        self.near(at, REACH * self.scale).iter().for_each(|hit| is_near[hit.point.index()] = true);
        let ends = self.shown.scenery.bonds.ends().iter().copied();
        let pairs = ends.filter(|ends| ends.iter().all(|end| end.index() < count));
        let (mut among, mut beside) = (Vec::new(), Vec::new());
        for [a, b] in pairs {
            if a == nearest || b == nearest {
                beside.push(if a == nearest { b } else { a });
            }
            if is_near[a.index()] && is_near[b.index()] {
                among.push([a, b]);
            }
        }
        let place = |point: PointId| glam::DVec3::from(self.shown.place(point.index()));
        let long = |point: &PointId| place(*point).distance(place(nearest));
        let shortest = beside.iter().map(long).fold(f64::INFINITY, f64::min);
        let mut is_held = vec![false; count];
        is_held[nearest.index()] = true;
        beside.iter().filter(|point| long(point) <= LONGER * shortest).for_each(|point| is_held[point.index()] = true);
        while let Some([a, b]) = among.iter().find(|[a, b]| is_held[a.index()] != is_held[b.index()]) {
            (is_held[a.index()], is_held[b.index()]) = (true, true);
        }
        let held = (0..count as u32).map(PointId).filter(|point| is_held[point.index()] && !self.is_pinned(*point));
        Some(held.collect())
    }

    /// How points are taken that a press takes.
    pub(super) fn reach(&self, points: &[PointId]) -> Reach {
        let (is_patch, points) = (self.are_woven(points), points.to_vec());
        match is_patch {
            true => {
                let torn_beyond = TORN_BEYOND * self.scale / self.camera.pixels_per_metre();
                Reach::Patch { points, torn_beyond }
            }
            false => Reach::Points(points),
        }
    }
}
