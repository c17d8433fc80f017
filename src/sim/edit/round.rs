//! Ropes between pins that polygons are put between: whether they are long enough to go round.

use super::segments::{segments_pass, side};
use super::{CommandError, invalid};
use crate::sim::bond::PointId;
use crate::sim::bonds::Bonds;
use crate::sim::contact::polygon::Polygon;
use crate::sim::model::Model;
use crate::sim::plan;
use crate::sim::reach::{Reach, reaches};
use crate::sim::real::Real;
use crate::sim::vector::{add, embed, truncate};
use crate::sim::world::World;

/// Of more corners no way round is looked for.
const MOST_CORNERS: usize = 200;
/// A rope is longer than it is by this share at most: by rounding `[1]`.
const ROUNDING: f64 = 1e-6;
/// Places along a straight way that are looked at whether they are inside `[1]`.
const LOOKS: [f64; 3] = [0.25, 0.5, 0.75];

impl<S: Real, const D: usize> World<S, D> {
    /// Where a point is `[m]`; at the origin, where nothing hangs on it, if it is gone.
    pub(super) fn there(&self, point: usize) -> [f64; D] {
        let place = self.place(point);
        if place.iter().all(|x| x.is_finite()) { place } else { [0.0; D] }
    }

    /// Errors: rigid bonds between two pins are shorter than the way round the polygons of `model` when points are at `position` `[m]`,
    /// and were not before. `moved` are ascending; `others`: polygons come or are moved.
    pub(super) fn check_ways_round(
        &self,
        model: &Model<D>,
        (position, moved, others): (Vec<[f64; D]>, &[u32], bool),
    ) -> Result<(), CommandError> {
        if D != 2 || model.polygons.is_empty() || model.pinned.len() < 2 {
            return Ok(());
        }
        let mut pinned = model.pinned.clone();
        pinned.sort_unstable();
        let from: Vec<PointId> =
            pinned.iter().copied().filter(|pin| others || moved.binary_search(&pin.0).is_ok()).collect();
        // Between pins a bond neither stretches nor goes round anything.
        let is_free = |end: &PointId| self.inverse_mass[end.index()] > 0.0;
        let bonds: Bonds = self.bonds.iter().filter(|bond| is_free(&bond.a) || is_free(&bond.b)).collect();
        let reaches = reaches(bonds.iter(), &from, &pinned);
        if reaches.is_empty() {
            return Ok(());
        }
        // Pins that are put into a wall go out of it first.
        let w = &self.inverse_mass[..];
        let is_moved = |point: u32| moved.binary_search(&point).is_ok();
        let obstacles = self.obstacles.widened(model);
        let cleared = if others {
            plan::Cleared::default()
        } else {
            plan::clear(&obstacles, &self.bonds, (&position, w), is_moved)
        };
        let mut after = position;
        for (points, way) in &cleared.moves {
            points.iter().for_each(|&point| after[point as usize] = add(after[point as usize], *way));
        }
        let flat = |x: [f64; D]| truncate(embed(x));
        let place = |pin: PointId| [flat(self.place(pin.index())), flat(after[pin.index()])];
        match blocked(&reaches, place, [&self.model.polygons, &model.polygons]) {
            None => Ok(()),
            Some(Reach { pins, most }) => Err(invalid(format!(
                "an obstacle would lie between pins {} and {}, and the {most:.2} m of rigid bonds between them cannot go round it: leave \
                 them more room, or take a pin away first",
                pins[0].0, pins[1].0
            ))),
        }
    }
}

/// The first pins that rigid bonds are too short for to go round polygons: with the pins and the polygons as they will be, and were not
/// with both as they are. `place` says where a pin is, and will be `[m]`.
pub(crate) fn blocked(
    reaches: &[Reach],
    place: impl Fn(PointId) -> [[f64; 2]; 2],
    [before, after]: [&[Polygon]; 2],
) -> Option<Reach> {
    let too_short = |ends: [[f64; 2]; 2], polygons: &[Polygon], most: f64| {
        way_round(ends, polygons).is_some_and(|way| way > most * (1.0 + ROUNDING))
    };
    let is_blocked = |reach: &&Reach| {
        let [[a, to_a], [b, to_b]] = reach.pins.map(&place);
        too_short([to_a, to_b], after, reach.most) && !too_short([a, b], before, reach.most)
    };
    reaches.iter().find(is_blocked).copied()
}

/// Length of the shortest way between two places round polygons, where the straight one leads through one `[m]`; `None`: it does not, none
/// is found, or there are too many corners.
fn way_round(ends: [[f64; 2]; 2], polygons: &[Polygon]) -> Option<f64> {
    let sides: Vec<[[f64; 2]; 2]> = polygons.iter().flat_map(sides_of).collect();
    let is_open = |a: [f64; 2], b: [f64; 2]| {
        !sides.iter().any(|&side| segments_pass([a, b], side))
            && !LOOKS.iter().any(|&share| {
                let at = [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
                polygons.iter().any(|polygon| is_within(&sides_of(polygon), at))
            })
    };
    let [start, end] = ends;
    if is_open(start, end) || sides.len() > MOST_CORNERS {
        return None;
    }
    let places: Vec<[f64; 2]> = ends.into_iter().chain(sides.iter().map(|side| side[0])).collect();
    let far = |a: usize, b: usize| (places[a][0] - places[b][0]).hypot(places[a][1] - places[b][1]);
    let mut length = vec![f64::INFINITY; places.len()];
    let mut is_done = vec![false; places.len()];
    length[0] = 0.0;
    loop {
        let open = (0..places.len()).filter(|&k| !is_done[k] && length[k].is_finite());
        let next = open.min_by(|&a, &b| length[a].total_cmp(&length[b]))?;
        if next == 1 {
            return Some(length[1]);
        }
        is_done[next] = true;
        for k in (0..places.len()).filter(|&k| !is_done[k]).collect::<Vec<_>>() {
            let way = length[next] + far(next, k);
            if way < length[k] && is_open(places[next], places[k]) {
                length[k] = way;
            }
        }
    }
}

fn sides_of(polygon: &Polygon) -> Vec<[[f64; 2]; 2]> {
    let loops = polygon.loops.iter();
    loops.flat_map(|corners| (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]])).collect()
}

/// Whether a place is within sides by the even-odd rule, and on none of them.
fn is_within(sides: &[[[f64; 2]; 2]], at: [f64; 2]) -> bool {
    let mut is_in = false;
    for &[a, b] in sides {
        let is_along =
            (0..2).all(|axis| at[axis] >= a[axis].min(b[axis]) - 1e-12 && at[axis] <= a[axis].max(b[axis]) + 1e-12);
        if is_along && side([a, b], at) == 0.0 {
            return false;
        }
        if (a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
            is_in = !is_in;
        }
    }
    is_in
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Polygon {
        Polygon {
            loops: vec![vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]],
            restitution: 0.0,
            friction: 0.0,
        }
    }

    #[test]
    fn the_way_round_a_square_is_past_its_corners_and_there_is_none_where_the_straight_one_is_open() {
        let way = |a, b| way_round([a, b], &[square()]);
        let past_two = 2.0 * 2.0_f64.sqrt() + 2.0;
        assert!(way([-2.0, 0.0], [2.0, 0.0]).is_some_and(|way| (way - past_two).abs() < 1e-12));
        let past_one = 2.0 * 0.5_f64.hypot(1.5);
        assert!(way([-1.5, -0.5], [0.5, 1.5]).is_some_and(|way| (way - past_one).abs() < 1e-12));
        assert_eq!(way([-2.0, 1.0], [2.0, 1.0]), None, "along a side");
        assert_eq!(way([-2.0, 3.0], [2.0, 3.0]), None);
        assert_eq!(way([0.0, 0.0], [2.0, 0.0]), None, "from within there is none");
    }
}
