//! A list of values many of which are the same: each different one is kept once.

use std::collections::BTreeMap;

/// Different values up to which a search through all of them is quicker than a sorted map.
const FEW: usize = 16;

/// A value that is told from others by its bits.
pub(crate) trait Bits: Copy {
    /// What two values have in common only if they are the same.
    type Key: Ord + Copy;

    /// The bits.
    fn bits(&self) -> Self::Key;
}

/// A list of values that share a table of the different ones.
///
/// Shapes: an entry takes 4 bytes, and none as long as all entries are the same. Adding an entry that equals the one
/// before costs a comparison, another one a search through few values or a sorted map: never more than the logarithm
/// of their number.
#[derive(Clone, Debug)]
pub(crate) struct Shared<T: Bits> {
    count: usize,
    /// The different values, in the order in which they came.
    table: Vec<T>,
    /// Place in the table of each entry; empty while all have the first.
    places: Vec<u32>,
    /// Places by bits; kept beyond [`FEW`] values.
    index: BTreeMap<T::Key, u32>,
    /// Where the last value that came is in the table.
    last: usize,
}

impl<T: Bits> Default for Shared<T> {
    fn default() -> Self {
        Shared::new()
    }
}

impl<T: Bits> Shared<T> {
    /// No entries.
    pub(crate) const fn new() -> Self {
        Shared { count: 0, table: Vec::new(), places: Vec::new(), index: BTreeMap::new(), last: 0 }
    }

    /// How many entries there are.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Entry `k`, below [`Shared::len`].
    #[inline]
    pub(crate) fn get(&self, k: usize) -> &T {
        debug_assert!(k < self.count, "entry {k} of {}", self.count);
        &self.table[self.place(k)]
    }

    /// Where the value of entry `k` is in [`Shared::table`].
    #[inline]
    pub(crate) fn place(&self, k: usize) -> usize {
        if self.places.is_empty() { 0 } else { self.places[k] as usize }
    }

    /// The different values; after a change some may have no entry any more.
    pub(crate) fn table(&self) -> &[T] {
        &self.table
    }

    /// Adds an entry.
    #[inline]
    pub(crate) fn push(&mut self, value: T) {
        let place = self.place_of(value);
        if place != 0 || !self.places.is_empty() {
            self.places.resize(self.count, 0);
            self.places.push(place);
        }
        self.count += 1;
    }

    /// Puts another value in the place of entry `k`.
    pub(crate) fn set(&mut self, k: usize, value: T) {
        let place = self.place_of(value);
        if place != 0 || !self.places.is_empty() {
            self.places.resize(self.count, 0);
            self.places[k] = place;
        }
    }

    /// Keeps the entries that `keeps` says of their index.
    pub(crate) fn retain(&mut self, mut keeps: impl FnMut(usize) -> bool) {
        let mut kept = 0;
        for k in (0..self.count).filter(|&k| keeps(k)) {
            if !self.places.is_empty() {
                self.places[kept] = self.places[k];
            }
            kept += 1;
        }
        self.truncate(kept);
    }

    /// Leaves the first `count` entries.
    pub(crate) fn truncate(&mut self, count: usize) {
        self.count = self.count.min(count);
        self.places.truncate(count);
        if self.count == 0 {
            *self = Shared::new();
        }
    }

    /// Bytes on the heap; those of the sorted map are estimated.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.table.capacity() * size_of::<T>()
            + self.places.capacity() * size_of::<u32>()
            + self.index.len() * (size_of::<T::Key>() + size_of::<u32>())
    }

    /// Where a value is in the table; it is added if it is new.
    #[inline]
    fn place_of(&mut self, value: T) -> u32 {
        let bits = value.bits();
        if self.table.get(self.last).is_none_or(|last| last.bits() != bits) {
            self.last = self.find(bits).unwrap_or_else(|| self.add(value, bits));
        }
        self.last as u32
    }

    fn find(&self, bits: T::Key) -> Option<usize> {
        if self.table.len() <= FEW {
            self.table.iter().position(|value| value.bits() == bits)
        } else {
            self.index.get(&bits).map(|&place| place as usize)
        }
    }

    fn add(&mut self, value: T, bits: T::Key) -> usize {
        let place = self.table.len();
        self.table.push(value);
        if place == FEW {
            self.index = self.table.iter().zip(0..).map(|(value, place)| (value.bits(), place)).collect();
        } else if place > FEW {
            self.index.insert(bits, place as u32);
        }
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Bits for f64 {
        type Key = u64;

        fn bits(&self) -> u64 {
            self.to_bits()
        }
    }

    fn listed(values: &[f64]) -> Shared<f64> {
        let mut list = Shared::new();
        values.iter().for_each(|&value| list.push(value));
        list
    }

    fn entries(list: &Shared<f64>) -> Vec<f64> {
        (0..list.len()).map(|k| *list.get(k)).collect()
    }

    #[test]
    fn one_value_needs_no_list_and_many_are_found_again() {
        let same = listed(&[2.5; 9]);
        assert_eq!((same.len(), same.table.len(), same.places.len()), (9, 1, 0));
        for different in [2, FEW, FEW + 1, 5 * FEW] {
            let values: Vec<f64> = (0..3 * different).map(|k| (k * 7 % different) as f64).collect();
            let list = listed(&values);
            assert_eq!(entries(&list), values);
            assert_eq!(list.table.len(), different);
        }
    }

    #[test]
    fn entries_are_changed_and_left_out() {
        let mut list = listed(&[1.0, 1.0, 1.0, 1.0]);
        list.set(2, 1.0);
        assert!(list.places.is_empty());
        list.set(2, 3.0);
        assert_eq!(entries(&list), [1.0, 1.0, 3.0, 1.0]);
        list.retain(|k| k != 1);
        assert_eq!(entries(&list), [1.0, 3.0, 1.0]);
        list.push(3.0);
        list.truncate(2);
        assert_eq!(entries(&list), [1.0, 3.0]);
        list.retain(|_| false);
        list.push(4.0);
        assert_eq!((entries(&list), list.table.len()), (vec![4.0], 1));
    }

    #[test]
    fn values_differ_by_bits() {
        assert_eq!(listed(&[0.0, -0.0, f64::NAN, f64::NAN]).table.len(), 3);
    }
}
