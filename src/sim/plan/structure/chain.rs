//! One path.

use super::Structure;
use crate::sim::bonds::Bonds;
use crate::sim::bulk::spec::Spec;
use crate::sim::plan::island::Island;
use crate::sim::sizes::SHORTEST_CHAIN;

/// The chain that an island is, if each point has at most two bonds, there is no ring, and the bonds are alike but for
/// their rest lengths.
///
/// A pin ends a chain, and may do so at both ends.
pub(crate) fn chain(island: &Island, bonds: &Bonds, w: &[f64]) -> Option<Structure> {
    if island.bonds.len() < SHORTEST_CHAIN {
        return None;
    }
    let low = *island.points.first()? as usize;
    let high = *island.points.last()? as usize;
    // Up to two bonds of every free point.
    let mut at = vec![[u32::MAX; 2]; high - low + 1];
    let spec = Spec::of(&bonds.get(island.bonds[0] as usize));
    for &k in &island.bonds {
        let bond = bonds.get(k as usize);
        if !Spec::of(&bond).is_of_kind(&spec) || bond.rest_length <= 0.0 {
            return None;
        }
        for end in [bond.a, bond.b].into_iter().filter(|end| w[end.index()] > 0.0) {
            let slots = &mut at[end.index() - low];
            *slots.iter_mut().find(|slot| **slot == u32::MAX)? = k;
        }
    }
    let start = start(island, bonds, w, |point| at[point - low])?;
    walk(start, island, bonds, w, |point| at[point - low], spec)
}

/// Where the walk begins: the lowest pinned end, else the lowest free one.
fn start(island: &Island, bonds: &Bonds, w: &[f64], at: impl Fn(usize) -> [u32; 2]) -> Option<(u32, u32)> {
    let pinned = island.bonds.iter().flat_map(|&k| bonds.ends()[k as usize].map(|end| (end.0, k)));
    let pinned = pinned.filter(|(point, _)| w[*point as usize] == 0.0).min();
    pinned.or_else(|| {
        let loose = |&point: &u32| at(point as usize)[1] == u32::MAX;
        island.points.iter().copied().find(loose).map(|point| (point, at(point as usize)[0]))
    })
}

/// Follows the bonds from a point and its first bond on.
fn walk(
    (mut point, mut bond): (u32, u32),
    island: &Island,
    bonds: &Bonds,
    w: &[f64],
    at: impl Fn(usize) -> [u32; 2],
    spec: Spec,
) -> Option<Structure> {
    let mut points = Vec::with_capacity(island.bonds.len() + 1);
    let mut rests = Vec::with_capacity(island.bonds.len());
    points.push(point);
    while bond != u32::MAX {
        let [a, b] = bonds.ends()[bond as usize].map(|end| end.0);
        rests.push(bonds.rest_lengths()[bond as usize]);
        point = if a == point { b } else { a };
        points.push(point);
        if w[point as usize] == 0.0 || rests.len() > island.bonds.len() {
            break;
        }
        let [first, second] = at(point as usize);
        bond = if first == bond { second } else { first };
    }
    (rests.len() == island.bonds.len()).then_some(Structure::Chain { points, spec, rests })
}
