//! Rigid bonds of rest length 0 weld points together: they become one.

use crate::sim::bond::{BondKind, Limit};
use crate::sim::bonds::Bonds;
use crate::sim::sets::Sets;

/// For every point the one that stands for it: the lowest that it is welded to.
///
/// Pinned points (w = 0) that are welded stay pinned; two pinned points are never welded, for they cannot meet.
pub(crate) fn merge(bonds: &Bonds, w: &[f64]) -> Vec<u32> {
    let mut sets = Sets::new(w.len());
    let mut is_pinned: Vec<bool> = w.iter().map(|&w| w == 0.0).collect();
    for bond in bonds {
        if bond.kind != BondKind::Rigid || bond.rest_length != 0.0 || bond.limit == Limit::Min {
            continue;
        }
        let (a, b) = (sets.find(bond.a.0), sets.find(bond.b.0));
        if a != b && !(is_pinned[a as usize] && is_pinned[b as usize]) {
            let pinned = is_pinned[a as usize] || is_pinned[b as usize];
            sets.join(a, b);
            is_pinned[sets.find(a) as usize] = pinned;
        }
    }
    (0..w.len() as u32).map(|i| sets.find(i)).collect()
}
