//! Equal small bodies.

use std::collections::BTreeMap;

use crate::sim::bond::BondKind;
use crate::sim::bonds::Bonds;
use crate::sim::bulk::spec::Spec;
use crate::sim::plan::island::Island;
use crate::sim::sizes::{FEWEST_ALIKE, MOST_ALIKE_BONDS};

/// Islands that are equal but for where their points are numbered.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Crowd {
    /// Points of every body, body after body, each in ascending order.
    pub(crate) points: Vec<u32>,
    pub(crate) bodies: usize,
    /// Bonds of a body, their ends counted within it.
    pub(crate) bonds: Vec<([u32; 2], Spec)>,
}

/// What two equal islands have in common: for every bond its ends within the island and its numbers' bits.
type Likeness = Vec<u64>;

/// Crowds among some islands, and the places of those islands that are in none. `is_meant` says which islands may be.
pub(crate) fn crowds(islands: &[Island], bonds: &Bonds, is_meant: impl Fn(usize) -> bool) -> (Vec<Crowd>, Vec<usize>) {
    let mut alike: BTreeMap<Likeness, Vec<usize>> = BTreeMap::new();
    let mut others = Vec::new();
    for (place, island) in islands.iter().enumerate() {
        match likeness(island, bonds).filter(|_| is_meant(place)) {
            Some(key) => alike.entry(key).or_default().push(place),
            None => others.push(place),
        }
    }
    let mut found: Vec<Vec<usize>> = alike.into_values().collect();
    found.sort();
    let mut crowds = Vec::new();
    for places in found {
        if places.len() < FEWEST_ALIKE {
            others.extend(places);
            continue;
        }
        let points = places.iter().flat_map(|&place| members(&islands[place], bonds)).collect();
        let body = members(&islands[places[0]], bonds);
        let bonds = islands[places[0]]
            .bonds
            .iter()
            .map(|&k| (bonds.ends()[k as usize].map(|end| within(&body, end.0)), Spec::of(&bonds.get(k as usize))));
        crowds.push(Crowd { points, bodies: places.len(), bonds: bonds.collect() });
    }
    others.sort_unstable();
    (crowds, others)
}

/// The points of an island and the pins that it is fastened to, ascending.
pub(crate) fn members(island: &Island, bonds: &Bonds) -> Vec<u32> {
    let mut members: Vec<u32> = island.bonds.iter().flat_map(|&k| bonds.ends()[k as usize].map(|end| end.0)).collect();
    members.sort_unstable();
    members.dedup();
    members
}

fn within(members: &[u32], point: u32) -> u32 {
    members.partition_point(|&member| member < point) as u32
}

/// `None` where the island is too large or its bonds are of more than one kind.
fn likeness(island: &Island, bonds: &Bonds) -> Option<Likeness> {
    if island.bonds.is_empty() || island.bonds.len() > MOST_ALIKE_BONDS {
        return None;
    }
    let members = members(island, bonds);
    let mut key = vec![members.len() as u64];
    let first = Spec::of(&bonds.get(island.bonds[0] as usize));
    for &k in &island.bonds {
        let bond = bonds.get(k as usize);
        let spec = Spec::of(&bond);
        if std::mem::discriminant(&spec.kind) != std::mem::discriminant(&first.kind) || spec.rest <= 0.0 {
            return None;
        }
        let [a, b] = [bond.a, bond.b].map(|end| within(&members, end.0));
        // Equal bodies elsewhere have rest lengths that differ by rounding: f32 is enough to tell bodies apart.
        key.push(u64::from(a) << 32 | u64::from(b));
        key.push(u64::from((spec.rest as f32).to_bits()) << 2 | spec.limit as u64);
        match spec.kind {
            BondKind::Rigid => {}
            BondKind::Spring { stiffness, damping } => key.extend([stiffness.to_bits(), damping.to_bits()]),
            BondKind::Relaxed { relaxation, max_correction } => {
                key.extend([relaxation.to_bits(), max_correction.to_bits()]);
            }
        }
    }
    Some(key)
}
