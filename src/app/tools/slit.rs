//! A stroke over a cloth of space is a slit along the mesh lines that are nearest to it: the points there are doubled, and nothing of the cloth is
//! lost.
//!
//! ```text
//! lip     the ends, on one side of the stroke, of the sides of triangles that it crosses
//! tip     a triangle of which it crosses one side alone holds an end of the stroke: the corners of the lip at that stay one
//! ```

use glam::DVec2;

use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::{cross, distance_to_segment};
use crate::history::{DeleteKeys, Do};
use crate::sim::bond::lower_first;
use crate::sim::{BondId, PointId};

/// Width of the lip in the preview `[logical px]`.
const WIDTH: f64 = 3.0;
/// Lines of the preview at most.
const MOST: usize = 2_000;

/// A bond that a stroke crosses.
#[derive(Clone, Copy, Debug)]
struct Crossed {
    number: u32,
    /// Its ends: to the left of the stroke and to its right.
    ends: [PointId; 2],
    /// How far these are seen from the stroke `[px]`.
    far: [f64; 2],
    /// It is between corners of triangles.
    is_covered: bool,
}

/// What a stroke does to cloths.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slit {
    /// Points that are doubled, ascending.
    points: Vec<PointId>,
    /// Bonds that go to the copies.
    bonds: Vec<BondId>,
    /// Bonds of other bodies, which go.
    gone: Vec<u32>,
    /// Where it opens.
    path: Vec<[PointId; 2]>,
}

impl Slit {
    /// The slit along a stroke with these corners `[px]`; `None`: nothing is slit.
    pub(super) fn along(scope: Scope<'_>, corners: &[DVec2]) -> Option<Self> {
        if scope.shown.dimensions != 3 || scope.shown.scenery.triangles.is_empty() {
            return None;
        }
        let crossed = crossed(scope, corners);
        let [left, right] = [0, 1].map(|lip| slit(scope, &crossed, lip));
        // The lip with fewer pins, and of two with as many the one that is nearer to the stroke.
        let own = || crossed.iter().filter(|bond| bond.is_covered);
        let pins = [0, 1].map(|lip| own().filter(|bond| scope.is_pinned(bond.ends[lip])).count());
        let far = [0, 1].map(|lip| own().map(|bond| bond.far[lip]).sum::<f64>());
        let is_right = pins[1].cmp(&pins[0]).then(far[1].total_cmp(&far[0])).is_lt();
        let [first, second] = if is_right { [right, left] } else { [left, right] };
        [first, second].into_iter().find(|slit| !slit.points.is_empty())
    }

    /// What cuts it.
    pub(super) fn commands(self) -> Vec<Do> {
        let gone = DeleteKeys { bonds: self.gone, ..DeleteKeys::default() };
        let gone = (!gone.bonds.is_empty()).then_some(Do::Delete(gone));
        gone.into_iter().chain([Do::Split { points: self.points, bonds: self.bonds }]).collect()
    }

    /// Where it opens, and the other bonds that go.
    pub(super) fn marks(&self, scope: Scope<'_>) -> Vec<Mark> {
        let gone = self.gone.iter().filter_map(|&number| scope.shown.scenery.bond_ends(number));
        let line =
            |[a, b]: [PointId; 2]| Some(Mark::Line(Role::Away, scope.pixel(a)?, scope.pixel(b)?, WIDTH * scope.scale));
        self.path.iter().copied().chain(gone).take(MOST).filter_map(line).collect()
    }
}

/// Points in order, each once.
fn each_once(points: impl Iterator<Item = PointId>) -> Vec<PointId> {
    let mut points: Vec<PointId> = points.collect();
    points.sort_unstable();
    points.dedup();
    points
}

/// The bonds that a stroke crosses: one that it goes back over is not.
fn crossed(scope: Scope<'_>, corners: &[DVec2]) -> Vec<Crossed> {
    let scenery = &scope.shown.scenery;
    let covered = each_once(scenery.triangles.iter().flatten().copied());
    let is_corner = |point: &PointId| covered.binary_search(point).is_ok();
    let of = |(place, ends): (usize, &[PointId; 2])| {
        let seen = [scope.pixel(ends[0])?, scope.pixel(ends[1])?];
        let mut sides = corners.windows(2).map(|side| [side[0], side[1]]).filter(|side| cross(*side, seen));
        let [from, to] = sides.next()?;
        if sides.count() % 2 == 1 {
            return None;
        }
        let left = seen.map(|at| (to - from).perp_dot(at - from));
        let far = seen.map(|at| distance_to_segment(at, from, to));
        let ([a, b], [p, q]) = (*ends, far);
        let (ends, far) = if left[0] >= left[1] { ([a, b], [p, q]) } else { ([b, a], [q, p]) };
        let is_covered = ends.iter().all(is_corner);
        Some(Crossed { number: scenery.bond_number(place), ends, far, is_covered })
    };
    scenery.bonds.ends().iter().enumerate().filter_map(of).collect()
}

/// The slit whose lip is to the left of the stroke, 0, or to its right, 1.
fn slit(scope: Scope<'_>, crossed: &[Crossed], lip: usize) -> Slit {
    let (cloth, other): (Vec<&Crossed>, Vec<&Crossed>) = crossed.iter().partition(|bond| bond.is_covered);
    let mut by_ends: Vec<([PointId; 2], PointId)> =
        cloth.iter().map(|bond| (lower_first(bond.ends), bond.ends[lip])).collect();
    by_ends.sort_unstable();
    let end_at = |side: [PointId; 2]| {
        let found = by_ends.binary_search_by_key(&lower_first(side), |(ends, _)| *ends);
        found.ok().map(|place| by_ends[place].1)
    };
    let sides = |[a, b, c]: [PointId; 3]| [[a, b], [b, c], [c, a]];
    let (mut edge, mut tips, mut met) = (Vec::new(), Vec::new(), Vec::new());
    for &corners in scope.shown.scenery.triangles.iter() {
        let ends: Vec<PointId> = sides(corners).into_iter().filter_map(end_at).collect();
        if ends.len() % 2 == 1 {
            tips.extend(&ends);
        }
        if !ends.is_empty() {
            edge.extend(ends);
            met.push(corners);
        }
    }
    let (edge, tips) = (each_once(edge.into_iter()), each_once(tips.into_iter()));
    let across = each_once(cloth.iter().map(|bond| bond.ends[1 - lip]));
    let stays = |point: &PointId| {
        tips.binary_search(point).is_ok() || across.binary_search(point).is_ok() || scope.is_pinned(*point)
    };
    let mut points: Vec<PointId> = edge.iter().copied().filter(|point| !stays(point)).collect();
    // What has no triangle on its own side of the stroke is of the other one as it is.
    let going = |points: &[PointId], corners: [PointId; 3]| {
        let is_doubled = |end: PointId| points.binary_search(&end).is_ok();
        sides(corners).into_iter().filter_map(end_at).any(is_doubled)
    };
    let triangles = || scope.shown.scenery.triangles.iter().copied();
    let own = each_once(triangles().filter(|corners| !going(&points, *corners)).flatten());
    points.retain(|point| own.binary_search(point).is_ok());
    let mut staying: Vec<[PointId; 2]> =
        triangles().filter(|corners| !going(&points, *corners)).flat_map(sides).map(lower_first).collect();
    staying.sort_unstable();
    let is_doubled = |point: &PointId| points.binary_search(point).is_ok();
    let is_gone_along = |side: &[PointId; 2]| {
        end_at(*side).is_none() && side.iter().any(is_doubled) && staying.binary_search(&lower_first(*side)).is_err()
    };
    let mut beyond: Vec<[PointId; 2]> =
        met.iter().copied().flat_map(sides).filter(is_gone_along).map(lower_first).collect();
    beyond.sort_unstable();
    let scenery = &scope.shown.scenery;
    let bonds_beyond = scenery.bonds.ends().iter().enumerate();
    let bonds_beyond = bonds_beyond.filter(|(_, ends)| beyond.binary_search(&lower_first(**ends)).is_ok());
    let bonds = cloth.iter().filter(|bond| is_doubled(&bond.ends[lip])).map(|bond| BondId(bond.number));
    let bonds = bonds.chain(bonds_beyond.map(|(place, _)| BondId(scenery.bond_number(place))));
    let is_path = |side: &[PointId; 2]| {
        let is_on_edge = side.iter().all(|end| edge.binary_search(end).is_ok());
        is_on_edge && side.iter().any(is_doubled) && end_at(*side).is_none()
    };
    let mut path: Vec<[PointId; 2]> = met.into_iter().flat_map(sides).filter(is_path).map(lower_first).collect();
    path.sort_unstable();
    path.dedup();
    Slit { bonds: bonds.collect(), gone: other.iter().map(|bond| bond.number).collect(), path, points }
}
