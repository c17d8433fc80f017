//! A sparse factorisation A = L D L^T of symmetric matrices, one code path, with zero pivots skipped.
//!
//! The pattern is analysed once; factoring and solving then touch only what is not zero. L is made row by row from
//! what stands above it ("up-looking"); chains and trees, and what is small enough to be spelled out, have quicker ways
//! to the same numbers.
//! Source: T. A. Davis, Algorithm 849, ACM Trans. Math. Softw. 31, 587 (2005).

mod forest;
mod script;

use forest::Forest;
use script::Script;

use crate::sim::real::Real;
use crate::sim::vector::{scale, sub};

/// A factorisation of a matrix of fixed pattern. Unknowns are already in their order of elimination.
#[derive(Clone, Debug)]
pub(crate) struct Ldl<S> {
    /// Entries of the matrix left of the diagonal: columns, row by row, ascending.
    entry_starts: Vec<u32>,
    entry_columns: Vec<u32>,
    /// L by columns: rows below the diagonal, ascending, and values.
    column_starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<S>,
    /// L by rows: (column, place in `values`), columns ascending.
    row_starts: Vec<u32>,
    row_entries: Vec<[u32; 2]>,
    /// 1/D; 0 where the pivot was skipped.
    inverse_pivot: Vec<S>,
    work: Vec<S>,
    /// What takes over where unknowns are coupled as chains and trees.
    forest: Option<Forest<S>>,
    /// Where elimination is short enough to be spelled out.
    script: Option<Script>,
}

/// What a factorisation met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Inertia {
    /// Pivots too small to divide by: those unknowns come out as zero.
    pub(crate) skipped: u32,
    /// Pivots below zero.
    pub(crate) negative: u32,
}

impl Inertia {
    /// One over a pivot, counted; 0 where it is smaller than `least` times its diagonal entry in size, or not a number.
    #[inline(always)]
    fn invert<S: Real>(&mut self, pivot: S, diagonal: S, least: S) -> S {
        let is_sound = pivot.abs() > least * diagonal.abs() && pivot.is_finite();
        self.skipped += u32::from(!is_sound);
        self.negative += u32::from(is_sound && pivot < S::ZERO);
        if is_sound { S::ONE / pivot } else { S::ZERO }
    }
}

impl<S: Real> Ldl<S> {
    /// Analyses a pattern: `lower[k]` lists the columns j < k that row k has entries in, ascending, each once.
    pub(crate) fn analyse(lower: &[Vec<u32>]) -> Self {
        let count = lower.len();
        let patterns = row_patterns(lower);
        let mut column_starts = vec![0_u32; count + 1];
        for &j in patterns.iter().flatten() {
            column_starts[j as usize + 1] += 1;
        }
        for j in 0..count {
            column_starts[j + 1] += column_starts[j];
        }
        let mut next = column_starts.clone();
        let mut rows = vec![0; column_starts[count] as usize];
        let mut row_entries = Vec::with_capacity(rows.len());
        for (k, pattern) in patterns.iter().enumerate() {
            for &j in pattern {
                let at = next[j as usize];
                next[j as usize] += 1;
                rows[at as usize] = k as u32;
                row_entries.push([j, at]);
            }
        }
        Ldl {
            entry_starts: starts(lower),
            entry_columns: lower.iter().flatten().copied().collect(),
            column_starts,
            values: vec![S::ZERO; rows.len()],
            rows,
            row_starts: starts(&patterns),
            row_entries,
            inverse_pivot: vec![S::ZERO; count],
            work: vec![S::ZERO; count],
            forest: Forest::of(lower),
            script: None,
        }
        .scripted()
    }

    /// Number of unknowns.
    pub(crate) fn len(&self) -> usize {
        self.inverse_pivot.len()
    }

    /// Entries of L below the diagonal.
    pub(crate) fn fill(&self) -> usize {
        self.rows.len()
    }

    /// Multiplications of one factorisation: with c entries in a column c (c + 1)/2.
    pub(crate) fn multiplications(&self) -> usize {
        let counts = self.column_starts.windows(2).map(|ends| (ends[1] - ends[0]) as usize);
        counts.map(|count| count * (count + 1) / 2).sum()
    }

    /// Factors the matrix with this diagonal and these entries left of it, in the order of the pattern.
    ///
    /// A pivot that is smaller than `least` times its diagonal entry in size, or not a number, is skipped: its unknown
    /// comes out as zero, which solves a consistent system that repeats itself.
    pub(crate) fn factor(&mut self, diagonal: &[S], lower: &[S], least: S) -> Inertia {
        if let Some(forest) = &mut self.forest {
            return forest.factor(diagonal, lower, least, &mut self.inverse_pivot);
        }
        if self.script.is_some() {
            return self.follow_script(diagonal, lower, least);
        }
        let mut inertia = Inertia::default();
        for k in 0..self.len() {
            for e in self.entry_starts[k] as usize..self.entry_starts[k + 1] as usize {
                self.work[self.entry_columns[e] as usize] = lower[e];
            }
            let mut pivot = diagonal[k];
            for e in self.row_starts[k] as usize..self.row_starts[k + 1] as usize {
                let [j, at] = self.row_entries[e].map(|i| i as usize);
                let y = self.work[j];
                self.work[j] = S::ZERO;
                for p in self.column_starts[j] as usize..at {
                    let row = self.rows[p] as usize;
                    self.work[row] -= self.values[p] * y;
                }
                let l = y * self.inverse_pivot[j];
                pivot -= l * y;
                self.values[at] = l;
            }
            self.inverse_pivot[k] = inertia.invert(pivot, diagonal[k], least);
        }
        inertia
    }

    /// Factors the matrix and solves A x = b in place, for R right-hand sides at once.
    pub(crate) fn factor_and_solve<const R: usize>(&mut self, diagonal: &[S], lower: &[S], least: S, x: &mut [[S; R]]) {
        if let Some(forest) = &mut self.forest {
            return forest.factor_and_solve(diagonal, lower, least, &mut self.inverse_pivot, x);
        }
        self.factor(diagonal, lower, least);
        self.solve(x);
    }

    /// Solves A x = b in place.
    pub(crate) fn solve_one(&self, x: &mut [S]) {
        self.solve(x.as_chunks_mut::<1>().0);
    }

    /// Solves A x = b in place, for R right-hand sides at once.
    pub(crate) fn solve<const R: usize>(&self, x: &mut [[S; R]]) {
        if let Some(forest) = &self.forest {
            return forest.solve(&self.inverse_pivot, x);
        }
        let count = self.len();
        let x = &mut x[..count];
        for j in 0..count {
            let own = x[j];
            for p in self.column_starts[j] as usize..self.column_starts[j + 1] as usize {
                let row = self.rows[p] as usize;
                x[row] = sub(x[row], scale(own, self.values[p]));
            }
        }
        for k in (0..count).rev() {
            let mut sum = scale(x[k], self.inverse_pivot[k]);
            for p in self.column_starts[k] as usize..self.column_starts[k + 1] as usize {
                sum = sub(sum, scale(x[self.rows[p] as usize], self.values[p]));
            }
            x[k] = sum;
        }
    }
}

fn starts(lists: &[Vec<u32>]) -> Vec<u32> {
    let mut result = Vec::with_capacity(lists.len() + 1);
    let mut sum = 0;
    result.push(0);
    for list in lists {
        sum += list.len() as u32;
        result.push(sum);
    }
    result
}

/// Columns of every row of L, ascending: those that the elimination tree reaches from the entries of the matrix.
fn row_patterns(lower: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let count = lower.len();
    let mut parent = vec![u32::MAX; count];
    let mut mark = vec![u32::MAX; count];
    let mut patterns = Vec::with_capacity(count);
    for (k, columns) in lower.iter().enumerate() {
        let k = k as u32;
        mark[k as usize] = k;
        let mut pattern = Vec::new();
        for &column in columns {
            let mut j = column;
            while mark[j as usize] != k {
                mark[j as usize] = k;
                pattern.push(j);
                if parent[j as usize] == u32::MAX {
                    parent[j as usize] = k;
                }
                j = parent[j as usize];
            }
        }
        pattern.sort_unstable();
        patterns.push(pattern);
    }
    patterns
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solves a dense symmetric system through the sparse pattern of its entries.
    fn solved(matrix: &[[f64; 4]; 4], b: [f64; 4]) -> ([f64; 4], Inertia) {
        let lower: Vec<Vec<u32>> =
            (0..4).map(|k| (0..k).filter(|&j| matrix[k][j] != 0.0).map(|j| j as u32).collect()).collect();
        let entries: Vec<f64> =
            lower.iter().enumerate().flat_map(|(k, row)| row.iter().map(move |&j| matrix[k][j as usize])).collect();
        let diagonal: Vec<f64> = (0..4).map(|k| matrix[k][k]).collect();
        let mut ldl = Ldl::analyse(&lower);
        let inertia = ldl.factor(&diagonal, &entries, 1e-12);
        let mut x = b;
        ldl.solve_one(&mut x);
        (x, inertia)
    }

    fn residual(matrix: &[[f64; 4]; 4], x: [f64; 4], b: [f64; 4]) -> f64 {
        let row = |k: usize| (0..4).map(|j| matrix[k][j] * x[j]).sum::<f64>() - b[k];
        (0..4).map(|k| row(k).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_matrix_that_fills_in_is_solved() {
        let a = [[4.0, 1.0, 0.0, 1.0], [1.0, 3.0, 1.0, 0.0], [0.0, 1.0, 5.0, 1.0], [1.0, 0.0, 1.0, 4.0]];
        let (x, inertia) = solved(&a, [1.0, 2.0, 3.0, 4.0]);
        assert!(residual(&a, x, [1.0, 2.0, 3.0, 4.0]) < 1e-14);
        assert_eq!(inertia, Inertia::default());
    }

    #[test]
    fn an_indefinite_matrix_shows_its_inertia() {
        let a = [[2.0, 0.0, 0.0, 1.0], [0.0, 2.0, 0.0, 1.0], [0.0, 0.0, 2.0, 1.0], [1.0, 1.0, 1.0, 0.0]];
        let (x, inertia) = solved(&a, [1.0, 2.0, 3.0, 4.0]);
        assert!(residual(&a, x, [1.0, 2.0, 3.0, 4.0]) < 1e-14);
        assert_eq!(inertia, Inertia { skipped: 0, negative: 1 });
    }

    #[test]
    fn a_system_that_repeats_itself_is_solved_with_one_unknown_less() {
        let a = [[2.0, 2.0, 1.0, 0.0], [2.0, 2.0, 1.0, 0.0], [1.0, 1.0, 3.0, 1.0], [0.0, 0.0, 1.0, 3.0]];
        let b = [5.0, 5.0, 6.0, 4.0];
        let (x, inertia) = solved(&a, b);
        assert_eq!(inertia.skipped, 1);
        assert!(residual(&a, x, b) < 1e-14, "{x:?}");
    }
}
