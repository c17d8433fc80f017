//! Meshes of one body that turn about a hinge pass through each other.

use crate::sim::sets::Sets;

/// Which meshes of bodies are hinged: those that a hub holds, a point of no triangle with two bonds or more to each of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hinged {
    /// What each point is of: the lowest point of its mesh, or itself; empty where nothing is hinged.
    mesh: Vec<u32>,
    /// Couples of these, ascending, a hub with each of its meshes too.
    couples: Vec<[u32; 2]>,
}

impl Hinged {
    /// Of points 0 to `count` with triangles and bonds between them, in any order.
    pub(crate) fn of(count: usize, triangles: &[[u32; 3]], bonds: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut sets = Sets::new(count);
        let mut is_covered = vec![false; count];
        for &[a, b, c] in triangles {
            sets.join(a, b);
            sets.join(b, c);
            [a, b, c].into_iter().for_each(|corner| is_covered[corner as usize] = true);
        }
        let covered = |end: u32| is_covered[end as usize];
        // Each hub with the mesh at the other end of each of its bonds.
        let mut spokes: Vec<[u32; 2]> = bonds
            .filter_map(|[a, b]| match [covered(a), covered(b)] {
                [false, true] => Some([a, b]),
                [true, false] => Some([b, a]),
                _ => None,
            })
            .map(|[hub, end]| [hub, sets.find(end)])
            .collect();
        spokes.sort_unstable();
        let mut couples = Vec::new();
        for of_hub in spokes.chunk_by(|a, b| a[0] == b[0]) {
            let meshes = of_hub.chunk_by(|a, b| a[1] == b[1]).filter(|bonds| bonds.len() > 1);
            let meshes: Vec<u32> = meshes.map(|bonds| bonds[0][1]).collect();
            if meshes.len() > 1 {
                let all = || meshes.iter().copied().chain([of_hub[0][0]]);
                couples.extend(all().flat_map(|a| all().filter(move |&b| a < b).map(move |b| [a, b])));
            }
        }
        if couples.is_empty() {
            return Hinged::default();
        }
        couples.sort_unstable();
        couples.dedup();
        Hinged { mesh: (0..count as u32).map(|point| sets.find(point)).collect(), couples }
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
}
