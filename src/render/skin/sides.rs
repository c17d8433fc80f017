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
    /// strands, but not what braces two of `all` triangles that share a side.
    pub(super) fn edges(&self, all: &[[u32; 3]], whole: &[[u32; 3]], are_meant: impl Fn(u32) -> bool) -> Vec<[u32; 2]> {
        let of_whole = triangles::sides(whole.iter().copied());
        let mut edges: Vec<[u32; 2]> = triangles::alone(&of_whole).map(|side| side.ends).collect();
        let is_side = |bond: &[u32; 2]| of_whole.binary_search_by_key(bond, |side| side.ends).is_ok();
        let is_loose = |bond: &&[u32; 2]| bond.iter().all(|&end| are_meant(end)) && !is_side(bond);
        let mut loose: Vec<[u32; 2]> = self.bonds.iter().filter(is_loose).copied().collect();
        if !loose.is_empty() {
            let braces = braces(all);
            loose.retain(|bond| braces.binary_search(bond).is_err());
        }
        edges.extend(loose);
        edges
    }
}

/// The far corners of every two triangles that share a side, sorted.
fn braces(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let with_far =
        |&[a, b, c]: &[u32; 3]| [(lower_first([a, b]), c), (lower_first([b, c]), a), (lower_first([c, a]), b)];
    let mut sides: Vec<([u32; 2], u32)> = triangles.iter().flat_map(with_far).collect();
    sides.sort_unstable();
    let pairs = sides.array_windows().filter(|[p, q]| p.0 == q.0);
    let mut braces: Vec<[u32; 2]> = pairs.map(|[p, q]| lower_first([p.1, q.1])).collect();
    braces.sort_unstable();
    braces
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
