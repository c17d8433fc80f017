//! How far apart rigid bonds let pins be: where tracks lead them further, something is strained whatever the method.

use petgraph::algo::dijkstra;
use petgraph::graph::{NodeIndex, UnGraph};

use super::bond::{Bond, BondKind, Limit, PointId};

/// Most pins from which ways are looked for.
const MOST_PINS: usize = 64;

/// Two pins that rigid bonds join.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) pins: [PointId; 2],
    /// The largest distance that these bonds let them have `[m]`: the length of the shortest way along them.
    pub(crate) most: f64,
}

/// Two pins, of which one at least is led, and what hangs between them.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    pub(crate) reach: Reach,
    /// The free points that rigid bonds join to each of the pins, ascending.
    pub(crate) hung: [Vec<PointId>; 2],
}

/// The reaches of all pairs of pins, the first 64 of `from` and any of `to`, which are ascending.
pub(crate) fn reaches(bonds: impl Iterator<Item = Bond>, from: &[PointId], to: &[PointId]) -> Vec<Reach> {
    if from.is_empty() || to.len() < 2 {
        return Vec::new();
    }
    let holds = bonds.filter(|bond| bond.kind == BondKind::Rigid && bond.limit != Limit::Min);
    let ways = UnGraph::<(), f64, u32>::from_edges(holds.map(|bond| (bond.a.0, bond.b.0, bond.rest_length)));
    let mut list = Vec::new();
    for &pin in from.iter().take(MOST_PINS).filter(|pin| pin.index() < ways.node_count()) {
        let lengths = dijkstra(&ways, NodeIndex::from(pin.0), None, |edge| *edge.weight());
        let twice = |other: &PointId| from.binary_search(other).is_ok() && *other < pin;
        let others = to.iter().filter(|other| **other != pin && !twice(other));
        list.extend(others.filter_map(|&other| {
            let most = *lengths.get(&NodeIndex::from(other.0))?;
            Some(Reach { pins: [pin, other], most })
        }));
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reach_is_the_shortest_way_along_what_pulls() {
        let ids = [0, 1, 2, 3].map(PointId);
        let [a, b, c, d] = ids;
        let held = Bond::new(a, d, 1.0);
        let bonds =
            [Bond::new(a, b, 1.0), Bond::new(b, c, 2.0), Bond::new(a, c, 4.0), Bond { limit: Limit::Min, ..held }];
        let reaches = |from: &[PointId], to: &[PointId]| reaches(bonds.into_iter(), from, to);
        assert_eq!(reaches(&[a], &ids), [Reach { pins: [a, b], most: 1.0 }, Reach { pins: [a, c], most: 3.0 }]);
        assert_eq!(reaches(&[a, c], &[a, c]), [Reach { pins: [a, c], most: 3.0 }]);
        assert_eq!(reaches(&[], &ids), []);
    }
}
