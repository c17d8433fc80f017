//! Hinges about which bodies turn freely: their hubs, and the angle that stops would be of.

use super::extent::place;
use super::joints::{Knee, knee};
use super::{Among, AngleAs};
use crate::sim::vector::sub;
use crate::sim::{Dynamics, PointId};

/// Neighbours of a hub belong to one piece when bonds lead from one to the other past the hub in so many steps.
const STEPS: usize = 4;
/// A hub that no pin holds has so many bonds to each piece.
pub(in crate::app) const LEAST_BONDS: usize = 2;
/// Of more points in no triangle none is looked at: nets are made of such.
pub(in crate::app) const MOST_LOOSE: usize = 400;

/// The points that one is bonded to, in sets that hang together nearby without it.
pub(in crate::app) fn sides(beside: &[Vec<PointId>], point: PointId) -> Vec<Vec<PointId>> {
    let mut left = beside[point.index()].clone();
    left.sort_unstable();
    left.dedup();
    let mut sides = Vec::new();
    while let Some(first) = left.first().copied() {
        let mut seen = vec![first];
        let mut from = 0;
        for _ in 0..STEPS {
            let to = seen.len();
            for k in from..to {
                for &next in &beside[seen[k].index()] {
                    if next != point && !seen.contains(&next) {
                        seen.push(next);
                    }
                }
            }
            from = to;
        }
        let side: Vec<PointId> = left.iter().copied().filter(|end| seen.contains(end)).collect();
        left.retain(|end| !side.contains(end));
        sides.push(side);
    }
    sides
}

/// The angles that stops would be of, of hinges among the points that have none yet: each between an arm to either of the two pieces that
/// turn about a hub in no triangle. Motors are not in the way.
pub(super) fn free(world: &dyn Dynamics, among: &Among) -> Vec<Knee> {
    if world.dimensions() != 2 {
        return Vec::new();
    }
    let mut beside = vec![Vec::new(); world.point_count()];
    for (_, bond) in among.bonds_of(world) {
        beside[bond.a.index()].push(bond.b);
        beside[bond.b.index()].push(bond.a);
    }
    let mut is_taken = vec![false; world.point_count()];
    world.triangles().iter().flatten().for_each(|corner| is_taken[corner.index()] = true);
    among.angles_of(world, AngleAs::Joint).iter().for_each(|angle| is_taken[angle.points[1].index()] = true);
    let is_loose = |point: &PointId| !is_taken[point.index()] && beside[point.index()].len() >= 2 * LEAST_BONDS;
    let loose: Vec<PointId> = among.points_of(world).into_iter().filter(is_loose).take(MOST_LOOSE + 1).collect();
    if loose.len() > MOST_LOOSE {
        return Vec::new();
    }
    loose.into_iter().filter_map(|hub| between(world, hub, &sides(&beside, hub))).collect()
}

/// The angle of two pieces about a hub: of their arms those that span the most, so that it is told well and is far from 0 and half a turn.
fn between(world: &dyn Dynamics, hub: PointId, sides: &[Vec<PointId>]) -> Option<Knee> {
    let [one, other] = sides else { return None };
    if one.len().min(other.len()) < LEAST_BONDS {
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
