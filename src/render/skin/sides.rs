//! Which sides of triangles are bonds, and which are free.

use crate::render::view::View;
use crate::sim::bond::lower_first;
use crate::sim::triangles;

/// The bonds of a world by their ends, to be looked up.
pub(super) struct Sides {
    /// Both ends of each, the lower one first, ascending.
    bonds: Vec<[u32; 2]>,
}

impl Sides {
    /// Those of a world; none where no skin asks.
    pub(super) fn of(view: &View<'_>) -> Self {
        if view.skins.is_empty() {
            return Sides { bonds: Vec::new() };
        }
        Sides::new(view.bonds.iter().map(|bond| [bond.a.0, bond.b.0]))
    }

    fn new(ends: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut bonds: Vec<[u32; 2]> = ends.map(lower_first).collect();
        bonds.sort_unstable();
        bonds.dedup();
        Sides { bonds }
    }

    fn has(&self, side: [u32; 2]) -> bool {
        self.bonds.binary_search(&lower_first(side)).is_ok()
    }

    /// The triangles of which no side broke. What never was bonded, in a scene that has triangles without bonds, is whole.
    pub(super) fn whole(&self, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        if self.bonds.is_empty() {
            return triangles.to_vec();
        }
        triangles.iter().copied().filter(|&corners| sides(corners).into_iter().all(|side| self.has(side))).collect()
    }

    /// The sides that belong to one of the `whole` triangles only, then bonds that belong to none between points that `are_meant`:
    /// strands, but not what braces two of `all` triangles that share a side, or did before one of these went.
    pub(super) fn edges(&self, all: &[[u32; 3]], whole: &[[u32; 3]], are_meant: impl Fn(u32) -> bool) -> Vec<[u32; 2]> {
        let of_whole = triangles::sides(whole.iter().copied());
        let mut edges: Vec<[u32; 2]> = triangles::alone(&of_whole).map(|side| side.ends).collect();
        let is_side = |bond: &[u32; 2]| of_whole.binary_search_by_key(bond, |side| side.ends).is_ok();
        let is_loose = |bond: &&[u32; 2]| bond.iter().all(|&end| are_meant(end)) && !is_side(bond);
        let mut loose: Vec<[u32; 2]> = self.bonds.iter().filter(is_loose).copied().collect();
        if !loose.is_empty() {
            let braces = triangles::far_corners(all);
            loose.retain(|bond| braces.binary_search(bond).is_err());
        }
        if !loose.is_empty() {
            let beside = Beside::of(&of_whole);
            loose.retain(|&[a, b]| !beside.have_one_between(a, b));
        }
        edges.extend(loose);
        edges
    }
}

/// Points that sides of triangles lead to, from each of their ends, ascending.
struct Beside(Vec<[u32; 2]>);

impl Beside {
    fn of(sides: &[triangles::Side]) -> Self {
        let mut ways: Vec<[u32; 2]> = sides.iter().flat_map(|side| [side.ends, [side.ends[1], side.ends[0]]]).collect();
        ways.sort_unstable();
        Beside(ways)
    }

    /// Whether sides lead from both points to a third.
    fn have_one_between(&self, a: u32, b: u32) -> bool {
        let first = self.0.partition_point(|way| way[0] < a);
        let mut of_a = self.0[first..].iter().take_while(|way| way[0] == a);
        of_a.any(|way| self.0.binary_search(&[way[1], b]).is_ok())
    }
}

/// Of a triangle.
pub(super) fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles that share a side, and a tail.
    const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [2, 1, 3]];
    const BONDS: [[u32; 2]; 6] = [[0, 1], [1, 2], [0, 2], [1, 3], [3, 2], [3, 4]];

    #[test]
    fn a_whole_skin_has_its_rim_and_its_ropes_for_edges() {
        let sides = Sides::new(BONDS.into_iter());
        assert_eq!(sides.whole(&TRIANGLES), TRIANGLES);
        assert_eq!(sides.edges(&TRIANGLES, &TRIANGLES, |_| true), [[0, 1], [0, 2], [1, 3], [2, 3], [3, 4]]);
        assert_eq!(sides.edges(&TRIANGLES, &TRIANGLES, |point| point < 4).len(), 4, "the tail is another's");
    }

    #[test]
    fn a_brace_is_no_edge() {
        let braced = BONDS.into_iter().chain([[0, 3]]);
        let sides = Sides::new(braced.clone());
        assert_eq!(sides.edges(&TRIANGLES, &TRIANGLES, |_| true), [[0, 1], [0, 2], [1, 3], [2, 3], [3, 4]]);
        let torn = Sides::new(braced.filter(|bond| *bond != [1, 2]));
        let whole = torn.whole(&TRIANGLES);
        let edges = torn.edges(&TRIANGLES, &whole, |_| true);
        assert!(whole.is_empty() && !edges.contains(&[0, 3]), "nor where it is all that is left");
    }

    #[test]
    fn a_brace_whose_triangles_are_gone_is_no_edge_and_a_strand_between_two_pieces_is() {
        // A third triangle, at 2 and 3, went with its side from 2 to 5; a brace of it and one of the others is left.
        let bonds = BONDS.into_iter().chain([[3, 5], [1, 5], [0, 6], [6, 7], [0, 7], [4, 6]]);
        let all = [TRIANGLES[0], TRIANGLES[1], [0, 6, 7]];
        let edges = Sides::new(bonds.clone()).edges(&all, &all, |_| true);
        assert!(edges.contains(&[3, 4]) && edges.contains(&[4, 6]), "strands: {edges:?}");
        assert!(edges.contains(&[1, 5]), "it leads to no triangle: {edges:?}");
        let edges = Sides::new(bonds.chain([[0, 3]])).edges(&all[..1], &all, |_| true);
        assert!(!edges.contains(&[0, 3]), "it joins what is whole with what is: {edges:?}");
    }

    #[test]
    fn a_torn_bond_opens_the_triangles_that_it_was_a_side_of() {
        let torn = BONDS.into_iter().filter(|bond| *bond != [1, 3]);
        let sides = Sides::new(torn);
        let whole = sides.whole(&TRIANGLES);
        assert_eq!(whole, [[0, 1, 2]]);
        assert_eq!(
            sides.edges(&TRIANGLES, &whole, |_| true),
            [[0, 1], [0, 2], [1, 2], [2, 3], [3, 4]],
            "what is left is drawn"
        );
    }
}
