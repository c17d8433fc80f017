//! What hangs together: points that move and the bonds between them.

use crate::sim::{Dynamics, PointId};

/// The pieces of a world as it stands: points that bonds join, pins apart.
#[derive(Clone, Debug, Default)]
pub(super) struct Pieces {
    topology: Option<u64>,
    /// Of every point the lowest point of its piece; a pin's is itself.
    first: Vec<u32>,
    /// Bonds of a piece, by its lowest point; those to pins too.
    bonds: Vec<u32>,
    is_pinned: Vec<bool>,
}

impl Pieces {
    pub(super) fn of(world: &dyn Dynamics) -> Self {
        let mut pieces = Pieces::default();
        pieces.follow(world);
        pieces
    }

    /// Reads the world anew where something of it changed.
    pub(super) fn follow(&mut self, world: &dyn Dynamics) {
        if self.topology == Some(world.topology()) {
            return;
        }
        let count = world.point_count();
        self.topology = Some(world.topology());
        self.is_pinned = vec![false; count];
        world.pinned().iter().for_each(|pin| self.is_pinned[pin.index()] = true);
        self.first = (0..count as u32).collect();
        for bond in world.bonds().iter() {
            if !self.is_pinned(bond.a.0) && !self.is_pinned(bond.b.0) {
                let (a, b) = (self.root(bond.a.0), self.root(bond.b.0));
                self.first[a.max(b) as usize] = a.min(b);
            }
        }
        for point in 0..count as u32 {
            self.first[point as usize] = self.root(point);
        }
        self.bonds = vec![0; count];
        for bond in world.bonds().iter() {
            if let Some(piece) = self.piece([bond.a, bond.b]) {
                self.bonds[piece as usize] += 1;
            }
        }
    }

    /// The lowest point of what hangs on a point, with shorter ways for those that ask again.
    fn root(&mut self, mut point: u32) -> u32 {
        while self.first[point as usize] != point {
            let next = self.first[point as usize];
            self.first[point as usize] = self.first[next as usize];
            point = next;
        }
        point
    }

    pub(super) fn is_pinned(&self, point: u32) -> bool {
        self.is_pinned[point as usize]
    }

    /// Of two ends one that can move.
    pub(super) fn free_end(&self, [a, b]: [PointId; 2]) -> Option<PointId> {
        [a, b].into_iter().find(|end| !self.is_pinned(end.0))
    }

    /// The piece that a bond between two points belongs to; `None`: both are pinned.
    pub(super) fn piece(&self, ends: [PointId; 2]) -> Option<u32> {
        self.free_end(ends).map(|end| self.first[end.index()])
    }

    /// How many bonds a piece has.
    pub(super) fn bonds(&self, piece: u32) -> u32 {
        self.bonds[piece as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn what_hangs_on_one_pin_are_two_pieces() {
        let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0], [3, 0], [9, 0]], "pinned": [2]},
            "bonds": [{"a": 1, "b": 0}, {"a": 1, "b": 2}, {"a": 2, "b": 3}]}"#;
        let world = Scene::parse(text, "test").unwrap().world(None).unwrap();
        let pieces = Pieces::of(&*world);
        assert_eq!(pieces.first, [0, 0, 2, 3, 4]);
        assert_eq!([0, 3, 4].map(|piece| pieces.bonds(piece)), [2, 1, 0]);
        assert_eq!(pieces.piece([PointId(2), PointId(2)]), None);
    }
}
