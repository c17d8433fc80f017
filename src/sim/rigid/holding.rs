//! Which points of the plane rigid bonds hold at their distances: asked by whoever makes a muscle of a bond, or a bond between two points.

use std::collections::BTreeMap;

use super::pieces::all;
use super::shape::Held;
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::vector::{dot, sub};

/// Rigid pieces of the plane, by the points that each of them holds in its shape.
#[derive(Clone, Debug, Default)]
pub struct RigidPieces {
    list: Vec<Piece>,
    /// The numbers of the pieces that each point is in, ascending.
    homes: BTreeMap<PointId, Vec<u32>>,
}

/// A piece.
#[derive(Clone, Debug, Default)]
struct Piece {
    /// Ascending, and where they are `[m]`.
    points: Vec<PointId>,
    places: Vec<[f64; 2]>,
    /// The ends of its bonds, by the places of points in the list.
    bonds: Vec<[u32; 2]>,
}

impl RigidPieces {
    /// Of those bonds that are rigid and act both ways, between points at these places `[m]`: each bond as long as its ends are apart.
    pub fn of(bonds: impl Iterator<Item = Bond>, place: impl Fn(PointId) -> [f64; 2]) -> Self {
        let is_firm = |bond: &Bond| bond.kind == BondKind::Rigid && bond.limit == Limit::Both && bond.rest_length > 0.0;
        let bonds: Vec<[PointId; 2]> = bonds.filter(is_firm).map(|bond| [bond.a, bond.b]).collect();
        let mut points: Vec<PointId> = bonds.iter().flatten().copied().collect();
        points.sort_unstable();
        points.dedup();
        let among = |points: &[PointId], ends: &[PointId; 2]| {
            let [a, b] = ends.map(|end| points.binary_search(&end).ok());
            Some([a? as u32, b? as u32])
        };
        let places: Vec<[f64; 2]> = points.iter().map(|&point| place(point)).collect();
        let ends: Vec<[u32; 2]> = bonds.iter().filter_map(|ends| among(&points, ends)).collect();
        let mut pieces = RigidPieces::default();
        for found in held(&places, ends) {
            let number = pieces.list.len() as u32;
            let own: Vec<PointId> = found.iter().map(|&k| points[k as usize]).collect();
            own.iter().for_each(|&point| pieces.homes.entry(point).or_default().push(number));
            let places = found.iter().map(|&k| places[k as usize]).collect();
            pieces.list.push(Piece { points: own, places, bonds: Vec::new() });
        }
        for ends in &bonds {
            if let Some(number) = pieces.home(*ends) {
                let piece = &mut pieces.list[number as usize];
                piece.bonds.extend(among(&piece.points, ends));
            }
        }
        pieces
    }

    /// The piece that holds two points.
    fn home(&self, [a, b]: [PointId; 2]) -> Option<u32> {
        let [a, b] = [a, b].map(|point| self.homes.get(&point).map_or(&[][..], |list| list));
        a.iter().copied().find(|number| b.binary_search(number).is_ok())
    }

    /// Whether one piece holds two points.
    pub fn holds(&self, ends: [PointId; 2]) -> bool {
        self.home(ends).is_some()
    }

    /// How many bonds the piece has that holds two points; 0: none does.
    pub(crate) fn bonds_about(&self, ends: [PointId; 2]) -> usize {
        self.home(ends).map_or(0, |number| self.list[number as usize].bonds.len())
    }

    /// Whether one piece still does where no bond joins them: by what else it is made of.
    pub fn holds_without_bond(&self, ends: [PointId; 2]) -> bool {
        let Some(number) = self.home(ends) else { return false };
        let Piece { points, places, bonds } = &self.list[number as usize];
        let [a, b] = ends.map(|end| points.binary_search(&end).map_or(u32::MAX, |place| place as u32));
        let is_other = |bond: &&[u32; 2]| **bond != [a, b] && **bond != [b, a];
        let others: Vec<[u32; 2]> = bonds.iter().filter(is_other).copied().collect();
        // Of what just holds its shape no bond is too many.
        let may = others.len() + 3 >= 2 * points.len();
        may && held(places, others).iter().any(|piece| [a, b].iter().all(|end| piece.binary_search(end).is_ok()))
    }
}

/// The points of each piece that bonds make of points at these places `[m]`, ascending.
fn held(places: &[[f64; 2]], bonds: Vec<[u32; 2]>) -> Vec<Vec<u32>> {
    let length = |[a, b]: [u32; 2]| {
        let d = sub(places[a as usize], places[b as usize]);
        dot(d, d).sqrt()
    };
    let bonds = bonds.into_iter().map(|ends| (ends, length(ends))).collect();
    let pieces = all(&Held { now: places.to_vec(), masses: vec![1.0; places.len()], bonds, surface: &[] });
    pieces.unwrap_or_default().into_iter().map(|piece| piece.points).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];

    /// Whether each bond between these places is one that others make up for.
    fn others_hold(now: &[[f64; 2]], ends: &[[u32; 2]]) -> Vec<bool> {
        let bonds = ends.iter().map(|ends| Bond::new(PointId(ends[0]), PointId(ends[1]), 1.0));
        let pieces = RigidPieces::of(bonds, |point| now[point.index()]);
        ends.iter().map(|ends| pieces.holds_without_bond(ends.map(PointId))).collect()
    }

    #[test]
    fn every_bond_of_a_braced_square_is_held_and_none_of_a_truss() {
        assert_eq!(others_hold(&BOX, &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]]), [true; 6]);
        // One more would hold the ends: a triangle, and two on a side.
        assert_eq!(others_hold(&BOX, &[[0, 1], [1, 2], [2, 0]]), [false; 3]);
        assert_eq!(others_hold(&BOX, &[[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]), [false; 5]);
        assert_eq!(others_hold(&BOX, &[[0, 1], [1, 2], [2, 3]]), [false; 3], "a rope");
    }

    #[test]
    fn the_inner_bonds_of_a_wheel_are_held() {
        let place = |k: u32| [libm::cos(f64::from(k)), libm::sin(f64::from(k))];
        let now: Vec<[f64; 2]> = std::iter::once([0.0; 2]).chain((1..7).map(place)).collect();
        let ends: Vec<[u32; 2]> = (1..7).map(|k| [0, k]).chain((1..7).map(|k| [k, k % 6 + 1])).collect();
        assert_eq!(others_hold(&now, &ends), [true; 12]);
    }

    #[test]
    fn squares_that_share_a_side_are_one_piece_and_springs_make_none() {
        let now = [BOX.to_vec(), vec![[4.0, 0.3], [4.0, 1.7]]].concat();
        let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3], [1, 4], [4, 5], [5, 2], [4, 2], [1, 5]];
        let bonds = ends.iter().map(|ends: &[u32; 2]| Bond::new(PointId(ends[0]), PointId(ends[1]), 1.0));
        let pieces = RigidPieces::of(bonds, |point| now[point.index()]);
        let [left, right, shared] = [0, 4, 1].map(PointId);
        assert!(pieces.holds([left, right]) && pieces.holds([right, left]) && pieces.holds([shared, right]));
        assert!(!pieces.holds([left, PointId(6)]), "a point of no bond");
        let spring = |bond: Bond| Bond { kind: BondKind::Spring { stiffness: 1.0, damping: 0.0 }, ..bond };
        let soft = ends.iter().map(|ends| spring(Bond::new(PointId(ends[0]), PointId(ends[1]), 1.0)));
        assert!(!RigidPieces::of(soft, |point| now[point.index()]).holds([left, right]));
    }
}
