//! Hinges about which bodies turn freely: the angles that stops would be of.

use super::extent::place;
use super::hubs::{Adjacency, LEAST_OF_BOTH, is_broad};
use super::joints::{Knee, knee};
use super::{Among, AngleAs};
use crate::sim::vector::sub;
use crate::sim::{Dynamics, PointId};

/// The angles that stops would be of, of hinges among the points that have none yet: each between an arm to either of the two pieces that
/// turn about a hub in no triangle. Motors are not in the way.
pub(super) fn free(world: &dyn Dynamics, among: &Among) -> Vec<Knee> {
    if world.dimensions() != 2 {
        return Vec::new();
    }
    let bonds = among.bonds_of(world).into_iter().map(|(_, bond)| [bond.a, bond.b]);
    let adjacency = Adjacency::of(world.point_count(), bonds, world.triangles());
    let mut has_stops = vec![false; world.point_count()];
    among.angles_of(world, AngleAs::Joint).iter().for_each(|angle| has_stops[angle.points[1].index()] = true);
    let points = among.points_of(world).into_iter().filter(|point| !has_stops[point.index()]);
    let loose = adjacency.loose(points, LEAST_OF_BOTH);
    loose.into_iter().filter_map(|hub| between(world, hub, &adjacency.sides(hub))).collect()
}

/// The angle of two pieces about a hub: of their arms those that span the most, so that it is told well and is far from 0 and half a turn.
fn between(world: &dyn Dynamics, hub: PointId, sides: &[Vec<PointId>]) -> Option<Knee> {
    let [one, other] = sides else { return None };
    if !is_broad(one) || !is_broad(other) {
        return None;
    }
    let arm = |point: PointId| sub(place(world, point), place(world, hub));
    let pairs = one.iter().flat_map(|&i| other.iter().map(move |&k| [i, k]));
    let spanned = |[i, k]: [PointId; 2]| {
        let [p, q] = [i, k].map(arm);
        (p[0] * q[1] - p[1] * q[0]).abs()
    };
    let widest = pairs.max_by(|a, b| spanned(*a).total_cmp(&spanned(*b)))?;
    knee(world, widest, hub)
}
