//! Meshes of one body that turn about a hinge pass through each other.

use crate::sim::bond::lower_first;
use crate::sim::sets::Sets;

/// Which meshes of bodies are hinged: those that share a corner and no side, such as the limbs of a figure at its joints, and those that a hub
/// holds, a point of no triangle with two bonds or more to each of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hinged {
    /// What each point is of: its mesh, numbered behind all points, or itself, of none or of several; empty where nothing is hinged.
    mesh: Vec<u32>,
    /// Couples of these, ascending, a hub with each of its meshes too.
    couples: Vec<[u32; 2]>,
}

impl Hinged {
    /// Of points 0 to `count` with triangles and bonds between them, in any order.
    pub(crate) fn of(count: usize, triangles: &[[u32; 3]], bonds: impl Iterator<Item = [u32; 2]>) -> Self {
        let corners = corners(triangles, count as u32);
        let meshes_of = |point: u32| {
            let first = corners.partition_point(|corner| corner.0 < point);
            corners[first..].iter().take_while(move |corner| corner.0 == point).map(|corner| corner.1)
        };
        let is_covered = |point: u32| meshes_of(point).next().is_some();
        // Each hub with the meshes at the other end of each of its bonds.
        let mut spokes: Vec<[u32; 2]> = bonds
            .filter_map(|[a, b]| match [is_covered(a), is_covered(b)] {
                [false, true] => Some([a, b]),
                [true, false] => Some([b, a]),
                _ => None,
            })
            .flat_map(|[hub, end]| meshes_of(end).map(move |mesh| [hub, mesh]))
            .collect();
        spokes.sort_unstable();
        let mut couples = Vec::new();
        let mut join = |hub: u32, meshes: &[u32]| {
            if meshes.len() > 1 {
                let all = || meshes.iter().copied().chain([hub]);
                couples.extend(all().flat_map(|a| all().filter(move |&b| a < b).map(move |b| [a, b])));
            }
        };
        for of_hub in spokes.chunk_by(|a, b| a[0] == b[0]) {
            let meshes = of_hub.chunk_by(|a, b| a[1] == b[1]).filter(|bonds| bonds.len() > 1);
            join(of_hub[0][0], &meshes.map(|bonds| bonds[0][1]).collect::<Vec<_>>());
        }
        for of_point in corners.chunk_by(|a, b| a.0 == b.0) {
            join(of_point[0].0, &of_point.iter().map(|corner| corner.1).collect::<Vec<_>>());
        }
        if couples.is_empty() {
            return Hinged::default();
        }
        couples.sort_unstable();
        couples.dedup();
        let mut mesh: Vec<u32> = (0..count as u32).collect();
        for of_point in corners.chunk_by(|a, b| a.0 == b.0) {
            if let [(point, one)] = *of_point {
                mesh[point as usize] = one;
            }
        }
        Hinged { mesh, couples }
    }

    /// Whether some points are of one side of a hinge, and some others of another one.
    pub(crate) fn pass<const A: usize, const B: usize>(&self, points: [u32; A], others: [u32; B]) -> bool {
        !self.couples.is_empty()
            && points.into_iter().any(|point| others.into_iter().any(|other| self.are_coupled(point, other)))
    }

    fn are_coupled(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a, b].map(|point| self.mesh[point as usize]);
        self.couples.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }
}

/// Every corner of every mesh, ascending: triangles that share a side are of one mesh, which is numbered from `first` on.
fn corners(triangles: &[[u32; 3]], first: u32) -> Vec<(u32, u32)> {
    let mut sides: Vec<([u32; 2], u32)> = triangles
        .iter()
        .zip(0..)
        .flat_map(|(&[a, b, c], k)| [[a, b], [b, c], [c, a]].map(|side| (lower_first(side), k)))
        .collect();
    sides.sort_unstable();
    let mut sets = Sets::new(triangles.len());
    sides.windows(2).filter(|pair| pair[0].0 == pair[1].0).for_each(|pair| sets.join(pair[0].1, pair[1].1));
    let mut list: Vec<(u32, u32)> = Vec::with_capacity(3 * triangles.len());
    for (corners, k) in triangles.iter().zip(0..) {
        let mesh = first + sets.find(k);
        list.extend(corners.map(|corner| (corner, mesh)));
    }
    list.sort_unstable();
    list.dedup();
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Meshes of points 0 to 2, 3 to 5 and 6 to 8, and a hub, 9.
    fn hinged(spokes: &[u32]) -> Hinged {
        let triangles = [[0, 1, 2], [3, 4, 5], [6, 7, 8]];
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        Hinged::of(10, &triangles, sides.chain(spokes.iter().map(|&end| [end, 9])))
    }

    #[test]
    fn meshes_with_two_bonds_to_one_hub_pass_through_each_other_and_through_its_spokes() {
        let hinged = hinged(&[0, 1, 4, 3, 7]);
        assert!(hinged.pass([2], [3, 4]) && hinged.pass([5], [1, 0]) && hinged.pass([9], [0, 1]));
        assert!(hinged.pass([2], [9, 3]) && hinged.pass([2], [9, 0]), "a spoke of its own, and of the other");
        assert!(!hinged.pass([2], [0, 1]) && !hinged.pass([6], [3, 4]) && !hinged.pass([9], [6, 7]));
    }

    #[test]
    fn a_string_between_two_meshes_is_no_hinge_and_neither_is_the_hub_of_one() {
        assert!(hinged(&[0, 3]).couples.is_empty() && hinged(&[0, 1, 2, 3]).couples.is_empty());
        assert!(!hinged(&[0, 3]).pass([0], [3, 4]));
    }

    #[test]
    fn meshes_that_share_a_corner_pass_through_each_other_and_those_that_share_a_side_are_one() {
        // Two triangles with a common side, a third at a corner of them, a fourth at a corner of that.
        let triangles = [[0, 1, 2], [1, 3, 2], [3, 4, 5], [5, 6, 7]];
        let hinged = Hinged::of(8, &triangles, std::iter::empty());
        assert!(hinged.pass([0], [4]) && hinged.pass([4], [6]) && hinged.pass([3], [0]));
        assert!(!hinged.pass([0], [1]) && !hinged.pass([0], [6]) && !hinged.pass([0], [5]));
        assert!(Hinged::of(8, &triangles[..2], std::iter::empty()).couples.is_empty());
    }
}
