//! Points that rigid bonds hold at their distances already.

use std::collections::BTreeMap;

use crate::app::tools::pick::Scope;
use crate::sim::{BondKind, Limit, PointId};

/// Which rigid piece each point is of: triangles of rigid bonds that have a side in common are one piece.
pub(super) struct Firm(Vec<[u32; 4]>);

impl Firm {
    pub(super) fn of(scope: Scope<'_>) -> Self {
        let scenery = &scope.shown.scenery;
        let held = scenery.bonds.iter().filter(|bond| bond.kind == BondKind::Rigid && bond.limit == Limit::Both);
        // Of each rigid side the first triangle that has it.
        let mut of: BTreeMap<[u32; 2], Option<u32>> = held.map(|bond| (side(bond.a, bond.b), None)).collect();
        let mut firm: Vec<[u32; 4]> = Vec::new();
        let mut up: Vec<u32> = Vec::new();
        let triangles = if of.is_empty() { &[][..] } else { &scenery.triangles[..] };
        for &[a, b, c] in triangles {
            let sides = [side(a, b), side(b, c), side(c, a)];
            if !sides.iter().all(|side| of.contains_key(side)) {
                continue;
            }
            let own = firm.len() as u32;
            up.push(own);
            for ends in sides {
                match of.get_mut(&ends) {
                    Some(Some(first)) => {
                        let (top, other) = (root(&up, *first), root(&up, own));
                        up[other as usize] = top;
                    }
                    Some(none) => *none = Some(own),
                    None => {}
                }
            }
            firm.push([a.0, b.0, c.0, own]);
        }
        firm.iter_mut().for_each(|triangle| triangle[3] = root(&up, triangle[3]));
        Firm(firm)
    }

    /// Whether two points are of one rigid piece.
    pub(super) fn holds(&self, [a, b]: [u32; 2]) -> bool {
        let pieces = |point: u32| self.0.iter().filter(move |triangle| triangle[..3].contains(&point));
        pieces(a).any(|one| pieces(b).any(|other| one[3] == other[3]))
    }
}

fn side(a: PointId, b: PointId) -> [u32; 2] {
    [a.0.min(b.0), a.0.max(b.0)]
}

fn root(up: &[u32], mut at: u32) -> u32 {
    while up[at as usize] != at {
        at = up[at as usize];
    }
    at
}
