//! Elimination spelled out: which entries of L change in what order, written down once for a pattern.

use super::{Inertia, Ldl};
use crate::sim::real::Real;

/// Which entries of L change in what order when one unknown after the other is eliminated.
#[derive(Clone, Debug)]
pub(super) struct Script {
    /// Place in `values` of every entry of the matrix.
    entries: Vec<u32>,
    /// Column by column, for every pair of its entries, the place in `values` that their product goes to.
    targets: Vec<u32>,
}

/// Pairs of entries for each entry of L up to which a script is worth its memory.
const MOST_PAIRS: usize = 8;

impl<S: Real> Ldl<S> {
    /// Writes the script, unless that is long.
    pub(super) fn scripted(mut self) -> Self {
        let count = self.len();
        let columns = |j: usize| self.column_starts[j] as usize..self.column_starts[j + 1] as usize;
        let pairs: usize = (0..count).map(|j| columns(j).len()).map(|n| n * n.saturating_sub(1) / 2).sum();
        if self.forest.is_some() || pairs > MOST_PAIRS * (count + self.fill()) {
            return self;
        }
        // An entry that is in the pattern of L by its row; the places of a row ascend with its columns.
        let place = |row: u32, column: u32| {
            let of_row = self.row_starts[row as usize] as usize..self.row_starts[row as usize + 1] as usize;
            let entries = &self.row_entries[of_row];
            entries.binary_search_by_key(&column, |entry| entry[0]).map_or(0, |at| entries[at][1])
        };
        let mut entries = Vec::with_capacity(self.entry_columns.len());
        for k in 0..count {
            let of_row = self.entry_starts[k] as usize..self.entry_starts[k + 1] as usize;
            entries.extend(self.entry_columns[of_row].iter().map(|&j| place(k as u32, j)));
        }
        let mut targets = Vec::with_capacity(pairs);
        for j in 0..count {
            let rows = &self.rows[columns(j)];
            for (p, &column) in rows.iter().enumerate() {
                targets.extend(rows[p + 1..].iter().map(|&row| place(row, column)));
            }
        }
        self.script = Some(Script { entries, targets });
        self
    }

    /// Eliminates one unknown after the other from what stands below it ("right-looking"): the same sums in the same
    /// order as row by row.
    pub(super) fn follow_script(&mut self, diagonal: &[S], lower: &[S], least: S) -> Inertia {
        let mut inertia = Inertia::default();
        let Ldl { script: Some(script), values, rows, column_starts, work, inverse_pivot, .. } = self else {
            return inertia;
        };
        values.fill(S::ZERO);
        for (&at, &entry) in script.entries.iter().zip(lower) {
            values[at as usize] = entry;
        }
        let mut targets = script.targets.iter();
        work.copy_from_slice(diagonal);
        for j in 0..work.len() {
            let over = inertia.invert(work[j], diagonal[j], least);
            inverse_pivot[j] = over;
            let (start, end) = (column_starts[j] as usize, column_starts[j + 1] as usize);
            for p in start..end {
                let y = values[p];
                let l = y * over;
                values[p] = l;
                work[rows[p] as usize] -= l * y;
                for (q, &target) in (p + 1..end).zip(targets.by_ref()) {
                    let product = l * values[q];
                    values[target as usize] -= product;
                }
            }
        }
        inertia
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of this many unknowns a side, each coupled to its neighbours, and more than that to itself.
    fn grid(side: u32) -> (Vec<Vec<u32>>, Vec<f64>, Vec<f64>) {
        let near = |k: u32| [(!k.is_multiple_of(side)).then(|| k - 1), (k >= side).then(|| k - side)];
        let lower: Vec<Vec<u32>> = (0..side * side).map(|k| near(k).into_iter().flatten().rev().collect()).collect();
        let entries = lower.iter().flatten().map(|&j| -1.0 - 0.01 * f64::from(j)).collect();
        (lower, (0..side * side).map(|k| 5.0 + 0.1 * f64::from(k)).collect(), entries)
    }

    #[test]
    fn a_script_has_the_bits_of_elimination_row_by_row() {
        let (lower, diagonal, entries) = grid(4);
        let mut scripted = Ldl::analyse(&lower);
        let mut plain = Ldl { script: None, ..scripted.clone() };
        assert!(scripted.script.is_some(), "short enough to be spelled out");
        let least = 1e-12;
        assert_eq!(scripted.factor(&diagonal, &entries, least), plain.factor(&diagonal, &entries, least));
        assert_eq!(scripted.values, plain.values);
        assert_eq!(scripted.inverse_pivot, plain.inverse_pivot);
    }

    #[test]
    fn long_scripts_are_not_written() {
        assert!(Ldl::<f64>::analyse(&grid(40).0).script.is_none());
    }
}
