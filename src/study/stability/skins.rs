//! Whether the skins of bodies that meet went through each other.

use std::collections::BTreeSet;

use super::pieces::Pieces;
use super::sides::crossings;
use crate::sim::bond::lower_first;
use crate::sim::triangles;
use crate::sim::{Dynamics, PointId};

/// The bodies of a world whose bodies meet, and which of them crossed at the start.
#[derive(Clone, Debug)]
pub(super) struct Skins {
    /// Points that there were.
    count: usize,
    pieces: Pieces,
    /// Couples of pieces that crossed, and pieces that crossed themselves, as couples with themselves.
    before: BTreeSet<[u32; 2]>,
}

impl Skins {
    /// At the start; `None` where bodies do not meet, and in space.
    pub(super) fn of(world: &dyn Dynamics, position: &[[f64; 3]]) -> Option<Self> {
        if world.contact().is_none() || world.dimensions() != 2 {
            return None;
        }
        let skins = Skins { count: world.point_count(), pieces: Pieces::of(world), before: BTreeSet::new() };
        let before = skins.couples(world, position).into_iter().collect();
        Some(Skins { before, ..skins })
    }

    /// Pairs of sides that cross now, of couples of bodies that crossed nowhere at the start and meet each other. What was added since is
    /// left out: it may have been put across others.
    pub(super) fn crossed(&self, world: &dyn Dynamics, position: &[[f64; 3]]) -> u32 {
        let Some(contact) = world.contact() else { return 0 };
        let meet = |[a, b]: &[u32; 2]| if a == b { contact.with_itself } else { contact.with_others };
        self.couples(world, position).iter().filter(|couple| meet(couple) && !self.before.contains(*couple)).count()
            as u32
    }

    /// The couple of pieces of every pair of sides that cross.
    fn couples(&self, world: &dyn Dynamics, position: &[[f64; 3]]) -> Vec<[u32; 2]> {
        let is_old = |ends: &[u32; 2]| ends.iter().all(|&end| (end as usize) < self.count);
        let piece = |ends: [u32; 2]| self.pieces.piece(ends.map(PointId)).map(|piece| (ends, piece));
        let (sides, pieces): (Vec<[u32; 2]>, Vec<u32>) =
            sides(world).into_iter().filter(is_old).filter_map(piece).unzip();
        let mut couples = Vec::new();
        let is_layer = |end: &u32| world.skin_of(PointId(*end)).is_layer();
        crossings(&sides, position, |a, b| {
            let passes = pieces[a] == pieces[b] && sides[a].iter().chain(&sides[b]).all(is_layer);
            couples.extend((!passes).then(|| [pieces[a].min(pieces[b]), pieces[a].max(pieces[b])]));
        });
        couples
    }
}

/// The skins of a world: sides that one triangle has alone, and bonds at points of no triangle; the lower ends first.
fn sides(world: &dyn Dynamics) -> Vec<[u32; 2]> {
    let triangles: Vec<[u32; 3]> = world.triangles().iter().map(|corners| corners.map(|corner| corner.0)).collect();
    let skin = triangles::skin(&triangles, world.bonds().iter().map(|bond| [bond.a.0, bond.b.0]));
    let closed = skin.closed.into_iter().map(lower_first);
    closed.chain(skin.open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    /// Two level ropes of three points, one above the other.
    fn world(contact: &str) -> Box<dyn Dynamics> {
        let rope = |y: f64| format!(r#"{{"make": "rope", "count": 3, "spacing": 1, "origin": [0, {y}]}}"#);
        let text = format!(r#"{{"wobble": 1, "bodies": [{}, {}], "contact": {contact}}}"#, rope(0.0), rope(1.0));
        Scene::parse(&text, "test").unwrap().world(None).unwrap()
    }

    #[test]
    fn what_crosses_and_did_not_is_counted() {
        let world = world("true");
        let apart = world.sample(0.0).position;
        let skins = Skins::of(&*world, &apart).unwrap();
        assert_eq!(skins.crossed(&*world, &apart), 0);
        let mut through = apart.clone();
        through[5][1] = -1.0;
        assert_eq!(skins.crossed(&*world, &through), 1);
        let from_there = Skins::of(&*world, &through).unwrap();
        assert_eq!(from_there.crossed(&*world, &through), 0, "they crossed at the start");
    }

    #[test]
    fn bodies_that_do_not_meet_may_cross() {
        let apart = world("true").sample(0.0).position;
        let mut through = apart.clone();
        through[5][1] = -1.0;
        let deaf = world(r#"{"bodies": false}"#);
        assert_eq!(Skins::of(&*deaf, &apart).unwrap().crossed(&*deaf, &through), 0);
        assert!(Skins::of(&*world("false"), &apart).is_none());
    }
}
