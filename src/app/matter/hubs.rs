//! Points about which pieces of a body may turn: those in no triangle from which bonds lead to pieces that nothing else joins nearby.

use crate::sim::PointId;

/// Neighbours of a hub belong to one piece when bonds lead from one to the other past the hub in so many steps.
const STEPS: usize = 4;
/// A hub that no pin holds has so many bonds to each piece.
const LEAST_BONDS: usize = 2;
/// The bonds of a hub that no pin holds, at least.
pub(super) const LEAST_OF_BOTH: usize = 2 * LEAST_BONDS;
/// Of more points in no triangle none is looked at: nets are made of such.
const MOST_LOOSE: usize = 400;

/// Whether a piece holds on to its hub by enough bonds to turn about it.
pub(in crate::app) fn is_broad(side: &[PointId]) -> bool {
    side.len() >= LEAST_BONDS
}

/// Which points are bonded to which, and which of them triangles cover.
#[derive(Debug)]
pub(in crate::app) struct Adjacency {
    neighbours: Vec<Vec<PointId>>,
    is_covered: Vec<bool>,
}

impl Adjacency {
    /// Of so many points; what names others counts for nothing.
    pub(in crate::app) fn of(
        count: usize,
        bonds: impl IntoIterator<Item = [PointId; 2]>,
        triangles: &[[PointId; 3]],
    ) -> Self {
        let (mut neighbours, mut is_covered) = (vec![Vec::new(); count], vec![false; count]);
        for [a, b] in bonds {
            if a.index().max(b.index()) < count {
                neighbours[a.index()].push(b);
                neighbours[b.index()].push(a);
            }
        }
        for corner in triangles.iter().flatten().filter(|corner| corner.index() < count) {
            is_covered[corner.index()] = true;
        }
        Adjacency { neighbours, is_covered }
    }

    /// The points that one is bonded to, once for each bond.
    pub(in crate::app) fn neighbours(&self, point: PointId) -> &[PointId] {
        &self.neighbours[point.index()]
    }

    /// Whether a point is a corner of a triangle.
    pub(in crate::app) fn is_covered(&self, point: PointId) -> bool {
        self.is_covered[point.index()]
    }

    /// Those among points that may be hubs: in no triangle, with at least so many bonds. None where they are too many to look at.
    pub(in crate::app) fn loose(&self, among: impl IntoIterator<Item = PointId>, least: usize) -> Vec<PointId> {
        let is_loose = |point: &PointId| !self.is_covered(*point) && self.neighbours(*point).len() >= least;
        let loose: Vec<PointId> = among.into_iter().filter(is_loose).take(MOST_LOOSE + 1).collect();
        if loose.len() > MOST_LOOSE { Vec::new() } else { loose }
    }

    /// The points that one is bonded to, each once, in sets that hang together nearby without it.
    pub(in crate::app) fn sides(&self, point: PointId) -> Vec<Vec<PointId>> {
        let mut left = self.neighbours(point).to_vec();
        left.sort_unstable();
        left.dedup();
        let mut sides = Vec::new();
        while let Some(first) = left.first().copied() {
            let near = self.near(first, point);
            let (side, others) = left.into_iter().partition(|end| near.contains(end));
            sides.push(side);
            left = others;
        }
        sides
    }

    /// The points that a few bonds lead to from one, past a hub.
    fn near(&self, from: PointId, hub: PointId) -> Vec<PointId> {
        let mut seen = vec![from];
        let mut begin = 0;
        for _ in 0..STEPS {
            let end = seen.len();
            for k in begin..end {
                for &next in self.neighbours(seen[k]) {
                    if next != hub && !seen.contains(&next) {
                        seen.push(next);
                    }
                }
            }
            begin = end;
        }
        seen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adjacency(count: usize, bonds: &[[u32; 2]], triangles: &[[u32; 3]]) -> Adjacency {
        let triangles: Vec<[PointId; 3]> = triangles.iter().map(|corners| corners.map(PointId)).collect();
        Adjacency::of(count, bonds.iter().map(|ends| ends.map(PointId)), &triangles)
    }

    #[test]
    fn neighbours_of_a_hub_are_of_one_side_where_bonds_join_them_past_it() {
        // Two triangles of bonds about point 0, one of them covered, and a tail.
        let bonds = [[0, 1], [0, 2], [1, 2], [0, 3], [0, 4], [3, 4], [0, 5]];
        let found = adjacency(6, &bonds, &[[1, 2, 5]]);
        let [one, other, tail] = [[1, 2], [3, 4], [5, 5]].map(|ends| ends.map(PointId));
        assert_eq!(found.sides(PointId(0)), [one.to_vec(), other.to_vec(), tail[..1].to_vec()]);
        assert!(is_broad(&one) && !is_broad(&tail[..1]));
        assert_eq!(found.loose((0..6).map(PointId), LEAST_OF_BOTH), [PointId(0)]);
        assert_eq!(found.loose((0..6).map(PointId), 2), [0, 3, 4].map(PointId), "all others are covered");
    }

    #[test]
    fn what_a_long_way_joins_are_two_sides() {
        let ring = |count: u32| (0..count).map(|k| [k, (k + 1) % count]).collect::<Vec<_>>();
        assert_eq!(adjacency(6, &ring(6), &[]).sides(PointId(0)).len(), 1, "four steps past it");
        assert_eq!(adjacency(7, &ring(7), &[]).sides(PointId(0)).len(), 2, "five");
    }

    #[test]
    fn where_many_points_are_loose_none_is_looked_at() {
        let count = MOST_LOOSE as u32;
        let ring = |count: u32| (0..count).map(|k| [k, (k + 1) % count]).collect::<Vec<_>>();
        let loose = |count: u32| adjacency(count as usize, &ring(count), &[]).loose((0..count).map(PointId), 2).len();
        assert_eq!([loose(count), loose(count + 1)], [MOST_LOOSE, 0]);
    }

    #[test]
    fn what_names_points_that_are_not_there_counts_for_nothing() {
        let found = adjacency(2, &[[0, 1], [1, 2]], &[[1, 2, 3]]);
        assert_eq!(found.neighbours(PointId(1)), [PointId(0)]);
        assert!(found.is_covered(PointId(1)) && !found.is_covered(PointId(0)));
    }
}
