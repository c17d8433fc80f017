//! Bonds of a model or a world, as structure of arrays.

use std::ops::Range;

use super::bond::{Bond, BondKind, Limit, PointId};
use super::drive::Drive;
use super::shared::{Bits, Shared};

/// A list of bonds: 16 bytes each where all are of one material, else 20. [`Bond`] is what goes in and comes out.
///
/// Shapes: ends and rest lengths have one entry a bond; kinds, limits and break strains are kept once for all bonds that
/// have the same.
#[derive(Clone, Debug, Default)]
pub struct Bonds {
    ends: Vec<[PointId; 2]>,
    rest_lengths: Vec<f64>,
    materials: Shared<Material>,
}

/// What bonds have in common.
#[derive(Clone, Copy, Debug)]
struct Material {
    kind: BondKind,
    limit: Limit,
    break_strain: f64,
    drive: Option<Drive>,
}

impl Bits for Material {
    type Key = [u64; 9];

    #[inline]
    fn bits(&self) -> [u64; 9] {
        let (tag, p, q) = match self.kind {
            BondKind::Rigid => (0, 0.0, 0.0),
            BondKind::Spring { stiffness, damping } => (1, stiffness, damping),
            BondKind::Relaxed { relaxation, max_correction } => (2, relaxation, max_correction),
        };
        let tag = tag + 3 * self.limit as u64 + (u64::from(self.drive.is_some()) << 8);
        let (amplitude, signal) =
            self.drive.map_or((0, [0; 4]), |drive| (drive.amplitude.to_bits(), drive.signal.bits()));
        let [r, s, t, u] = signal;
        [tag, p.to_bits(), q.to_bits(), self.break_strain.to_bits(), amplitude, r, s, t, u]
    }
}

impl Bonds {
    /// No bonds.
    pub const fn new() -> Self {
        Bonds { ends: Vec::new(), rest_lengths: Vec::new(), materials: Shared::new() }
    }

    /// No bonds, with room for `count`.
    pub fn with_capacity(count: usize) -> Self {
        Bonds { ends: Vec::with_capacity(count), rest_lengths: Vec::with_capacity(count), materials: Shared::default() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Bond `k`, below [`Bonds::len`].
    #[inline]
    pub fn get(&self, k: usize) -> Bond {
        let [a, b] = self.ends[k];
        let &Material { kind, limit, break_strain, drive } = self.materials.get(k);
        Bond { a, b, rest_length: self.rest_lengths[k], kind, limit, break_strain, drive }
    }

    /// All bonds, in order, by value.
    pub fn iter(&self) -> Iter<'_> {
        Iter { bonds: self, rest: 0..self.len() }
    }

    /// Whether any may be a spring: looks at kinds, not at bonds.
    pub(crate) fn may_have_springs(&self) -> bool {
        self.materials.table().iter().any(|material| matches!(material.kind, BondKind::Spring { .. }))
    }

    /// The drives that some may have: looks at what bonds are made of, not at bonds.
    pub(crate) fn drives(&self) -> impl Iterator<Item = Drive> {
        self.materials.table().iter().filter_map(|material| material.drive)
    }

    /// Both ends of every bond.
    pub fn ends(&self) -> &[[PointId; 2]] {
        &self.ends
    }

    /// The rest length of every bond `[m]`.
    pub fn rest_lengths(&self) -> &[f64] {
        &self.rest_lengths
    }

    /// Adds a bond.
    #[inline]
    pub fn push(&mut self, bond: Bond) {
        let Bond { a, b, rest_length, kind, limit, break_strain, drive } = bond;
        self.ends.push([a, b]);
        self.rest_lengths.push(rest_length);
        self.materials.push(Material { kind, limit, break_strain, drive });
        debug_assert_eq!(self.materials.len(), self.ends.len(), "one entry a bond");
    }

    /// Puts another bond in the place of bond `k`, below [`Bonds::len`].
    pub fn set(&mut self, k: usize, bond: Bond) {
        let Bond { a, b, rest_length, kind, limit, break_strain, drive } = bond;
        self.ends[k] = [a, b];
        self.rest_lengths[k] = rest_length;
        self.materials.set(k, Material { kind, limit, break_strain, drive });
    }

    /// Keeps the bonds that `keeps` says, in their order; it is asked for each once, in order.
    pub fn retain(&mut self, mut keeps: impl FnMut(Bond) -> bool) {
        let kept: Vec<bool> = self.iter().map(&mut keeps).collect();
        let stays = |k: &mut usize| {
            *k += 1;
            kept[*k - 1]
        };
        let (mut e, mut r) = (0, 0);
        self.ends.retain(|_| stays(&mut e));
        self.rest_lengths.retain(|_| stays(&mut r));
        self.materials.retain(|k| kept[k]);
    }

    /// Leaves the first `count` bonds.
    pub fn truncate(&mut self, count: usize) {
        self.ends.truncate(count);
        self.rest_lengths.truncate(count);
        self.materials.truncate(count);
    }

    /// Memory that the lists hold on the heap `[bytes]`.
    pub fn heap_bytes(&self) -> usize {
        self.ends.capacity() * size_of::<[PointId; 2]>()
            + self.rest_lengths.capacity() * size_of::<f64>()
            + self.materials.heap_bytes()
    }
}

/// Bonds one after another, by value.
#[derive(Clone, Debug)]
pub struct Iter<'a> {
    bonds: &'a Bonds,
    rest: Range<usize>,
}

impl Iterator for Iter<'_> {
    type Item = Bond;

    #[inline]
    fn next(&mut self) -> Option<Bond> {
        self.rest.next().map(|k| self.bonds.get(k))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.rest.size_hint()
    }

    fn nth(&mut self, skipped: usize) -> Option<Bond> {
        self.rest.nth(skipped).map(|k| self.bonds.get(k))
    }
}

impl DoubleEndedIterator for Iter<'_> {
    fn next_back(&mut self) -> Option<Bond> {
        self.rest.next_back().map(|k| self.bonds.get(k))
    }
}

impl ExactSizeIterator for Iter<'_> {}

impl<'a> IntoIterator for &'a Bonds {
    type Item = Bond;
    type IntoIter = Iter<'a>;

    fn into_iter(self) -> Iter<'a> {
        self.iter()
    }
}

impl PartialEq for Bonds {
    /// Whether the bonds are the same, one by one.
    fn eq(&self, other: &Self) -> bool {
        self.ends == other.ends && self.rest_lengths == other.rest_lengths && self.iter().eq(other.iter())
    }
}

impl Extend<Bond> for Bonds {
    fn extend<I: IntoIterator<Item = Bond>>(&mut self, bonds: I) {
        let bonds = bonds.into_iter();
        let (least, _) = bonds.size_hint();
        self.ends.reserve(least);
        self.rest_lengths.reserve(least);
        bonds.for_each(|bond| self.push(bond));
    }
}

impl FromIterator<Bond> for Bonds {
    fn from_iter<I: IntoIterator<Item = Bond>>(bonds: I) -> Self {
        let mut list = Bonds::new();
        list.extend(bonds);
        list
    }
}

impl From<Vec<Bond>> for Bonds {
    fn from(bonds: Vec<Bond>) -> Self {
        bonds.into_iter().collect()
    }
}

impl<const N: usize> From<[Bond; N]> for Bonds {
    fn from(bonds: [Bond; N]) -> Self {
        bonds.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bond(k: u32, stiffness: f64) -> Bond {
        let kind = if stiffness > 0.0 { BondKind::Spring { stiffness, damping: 0.5 } } else { BondKind::Rigid };
        Bond { kind, ..Bond::new(PointId(k), PointId(k + 1), f64::from(k)) }
    }

    #[test]
    fn what_goes_in_comes_out() {
        let mut listed: Vec<Bond> = (0..100).map(|k| bond(k, f64::from(k % 3))).collect();
        listed[7].limit = Limit::Max;
        listed[8].break_strain = 0.25;
        let bonds = Bonds::from(listed.clone());
        assert_eq!(bonds.iter().collect::<Vec<_>>(), listed);
        assert_eq!(bonds.iter().rev().step_by(7).len(), 15);
        assert_eq!((bonds.len(), bonds.get(7)), (100, listed[7]));
        assert_eq!((bonds.ends()[9], bonds.rest_lengths()[9]), ([PointId(9), PointId(10)], 9.0));
    }

    #[test]
    fn a_bond_of_one_material_takes_16_bytes_and_of_several_20() {
        let count = 1000;
        let mut bonds = Bonds::with_capacity(count);
        bonds.extend((0..count as u32).map(|k| bond(k, 2.0)));
        assert!(bonds.heap_bytes() < 17 * count, "{}", bonds.heap_bytes());
        bonds.set(count - 1, bond(0, 3.0));
        assert!(bonds.heap_bytes() < 21 * count, "{}", bonds.heap_bytes());
    }

    #[test]
    fn lists_are_equal_by_what_they_hold() {
        let mut once_mixed = Bonds::from([bond(0, 1.0), bond(1, 2.0)]);
        once_mixed.set(1, bond(1, 1.0));
        let plain = Bonds::from([bond(0, 1.0), bond(1, 1.0)]);
        assert_eq!(once_mixed, plain);
        assert_ne!(plain, Bonds::from([bond(0, 1.0), bond(1, 3.0)]));
        assert_ne!(plain, Bonds::from([bond(0, 1.0)]));
    }

    #[test]
    fn bonds_are_left_out_in_order() {
        let mut bonds: Bonds = (0..10).map(|k| bond(k, f64::from(k % 4))).collect();
        bonds.retain(|bond| bond.a.0 % 2 == 1);
        let left: Vec<Bond> = [1, 3, 5, 7, 9].map(|k| bond(k, f64::from(k % 4))).to_vec();
        assert_eq!(bonds, Bonds::from(left));
        bonds.truncate(1);
        assert_eq!(bonds.iter().collect::<Vec<_>>(), [bond(1, 1.0)]);
        bonds.retain(|_| false);
        assert!(bonds.is_empty());
    }

    #[test]
    fn a_material_for_every_bond_stays_quick() {
        let bonds: Bonds = (0..100_000).map(|k| bond(k, f64::from(k + 1))).collect();
        assert_eq!(bonds.get(70_000), bond(70_000, 70_001.0));
    }
}
