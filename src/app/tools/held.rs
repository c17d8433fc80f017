//! Rigid bonds whose ends other rigid bonds hold: a muscle there would work against all of them.

use std::collections::BTreeMap;

use crate::sim::{Bond, BondKind, Bonds, Limit, PointId};

/// Points of a rigid body that are looked at around a bond.
const MOST: usize = 64;

/// Who is joined to whom by rigid bonds: pairs of points, both ways, ascending.
pub(super) struct Frame(Vec<[PointId; 2]>);

impl Frame {
    pub(super) fn of(bonds: &Bonds) -> Self {
        let is_firm = |bond: &Bond| bond.kind == BondKind::Rigid && bond.limit == Limit::Both;
        let both = |bond: Bond| [[bond.a, bond.b], [bond.b, bond.a]];
        let mut pairs: Vec<[PointId; 2]> = bonds.iter().filter(is_firm).flat_map(both).collect();
        pairs.sort_unstable();
        Frame(pairs)
    }

    fn beside(&self, point: PointId) -> impl Iterator<Item = PointId> {
        let first = self.0.partition_point(|pair| pair[0] < point);
        self.0[first..].iter().take_while(move |pair| pair[0] == point).map(|pair| pair[1])
    }

    /// Whether two points that a bond joins keep their distance without it: a rigid body that grows from another bond of the first, by points that
    /// two bonds join to it, comes to the second.
    pub(super) fn holds(&self, [a, b]: [PointId; 2]) -> bool {
        self.beside(a).filter(|&other| other != b).any(|other| self.grows([a, other], b))
    }

    fn grows(&self, [a, other]: [PointId; 2], b: PointId) -> bool {
        let (mut body, mut links) = (vec![a, other], BTreeMap::new());
        let mut next = 0;
        while next < body.len().min(MOST) {
            let point = body[next];
            next += 1;
            for beside in self.beside(point) {
                let is_bond = [point, beside] == [a, b] || [point, beside] == [b, a];
                if is_bond || body.contains(&beside) {
                    continue;
                }
                let count = links.entry(beside).or_insert(0);
                *count += 1;
                if *count == 2 {
                    if beside == b {
                        return true;
                    }
                    body.push(beside);
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(ends: &[[u32; 2]]) -> Frame {
        let bond = |ends: &[u32; 2]| Bond::new(PointId(ends[0]), PointId(ends[1]), 1.0);
        Frame::of(&ends.iter().map(bond).collect::<Vec<_>>().into())
    }

    fn held(ends: &[[u32; 2]]) -> Vec<bool> {
        let frame = frame(ends);
        ends.iter().map(|&[a, b]| frame.holds([PointId(a), PointId(b)])).collect()
    }

    #[test]
    fn every_bond_of_a_braced_square_is_held_and_none_of_a_truss() {
        assert_eq!(held(&[[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]]), [true; 6]);
        // One more would hold the ends: a triangle, and two on a side.
        assert_eq!(held(&[[0, 1], [1, 2], [2, 0]]), [false; 3]);
        assert_eq!(held(&[[0, 1], [1, 2], [2, 0], [1, 3], [2, 3]]), [false; 5]);
        assert_eq!(held(&[[0, 1], [1, 2], [2, 3]]), [false; 3], "a rope");
    }

    #[test]
    fn the_inner_bonds_of_a_wheel_are_held() {
        let spokes = (1..7).map(|k| [0, k]);
        let rim = (1..7).map(|k| [k, k % 6 + 1]);
        assert!(held(&spokes.chain(rim).collect::<Vec<_>>()).into_iter().all(|is| is));
    }
}
