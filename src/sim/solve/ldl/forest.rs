//! The factorisation of a matrix whose unknowns are coupled as a forest: chains and trees.
//!
//! Every unknown has at most one neighbour that is eliminated after it, so that L has one entry a column, and factoring
//! and solving are three short loops: Thomas's algorithm, from all leaves at once.

use super::Inertia;
use crate::sim::real::Real;
use crate::sim::vector::{scale, sub};

/// A factorisation L D L^T with at most one entry a column of L.
#[derive(Clone, Debug)]
pub(super) struct Forest<S> {
    /// Of every unknown the neighbour that is eliminated after it; itself where there is none.
    next: Vec<u32>,
    /// Which entry of the matrix couples the two; none where there is no neighbour.
    entry: Vec<u32>,
    /// The entry of L; 0 where there is no neighbour.
    link: Vec<S>,
    pivot: Vec<S>,
}

const NONE: u32 = u32::MAX;

impl<S: Real> Forest<S> {
    /// The forest of a pattern, if it is one: `lower[k]` lists the columns j < k that row k has entries in.
    pub(super) fn of(lower: &[Vec<u32>]) -> Option<Self> {
        let count = lower.len();
        let mut next: Vec<u32> = (0..count as u32).collect();
        let mut entry = vec![NONE; count];
        let rows = lower.iter().enumerate().flat_map(|(k, columns)| columns.iter().map(move |&j| (k, j as usize)));
        for (e, (k, j)) in rows.enumerate() {
            if entry[j] != NONE {
                return None;
            }
            (next[j], entry[j]) = (k as u32, e as u32);
        }
        Some(Forest { next, entry, link: vec![S::ZERO; count], pivot: vec![S::ZERO; count] })
    }

    /// As [`Ldl::factor`](super::Ldl::factor); `inverse` becomes 1/D, 0 where the pivot was skipped.
    pub(super) fn factor(&mut self, diagonal: &[S], lower: &[S], least: S, inverse: &mut [S]) -> Inertia {
        self.eliminate(diagonal, lower, least, inverse, |_, _, _| {})
    }

    /// Eliminates one unknown after the other; `each` is told the unknown, the one after it and the entry of L.
    #[inline(always)]
    fn eliminate(
        &mut self,
        diagonal: &[S],
        lower: &[S],
        least: S,
        inverse: &mut [S],
        mut each: impl FnMut(usize, usize, S),
    ) -> Inertia {
        let mut inertia = Inertia::default();
        let Forest { next, entry, link, pivot } = self;
        let count = next.len();
        let (entry, link, inverse) = (&entry[..count], &mut link[..count], &mut inverse[..count]);
        let diagonal = &diagonal[..count];
        pivot.copy_from_slice(diagonal);
        for j in 0..count {
            let over = inertia.invert(pivot[j], diagonal[j], least);
            inverse[j] = over;
            if let Some(&y) = lower.get(entry[j] as usize) {
                let (after, l) = (next[j] as usize, y * over);
                link[j] = l;
                pivot[after] -= l * y;
                each(j, after, l);
            }
        }
        inertia
    }

    /// Solves A x = b in place, for R right-hand sides at once.
    pub(super) fn solve<const R: usize>(&self, inverse: &[S], x: &mut [[S; R]]) {
        let count = self.next.len();
        let (next, link, x) = (&self.next[..count], &self.link[..count], &mut x[..count]);
        for j in 0..count {
            let after = next[j] as usize;
            x[after] = sub(x[after], scale(x[j], link[j]));
        }
        self.solve_back(inverse, x);
    }

    /// Factors and solves in one go: what eliminates an unknown from the matrix eliminates it from the right-hand sides.
    pub(super) fn factor_and_solve<const R: usize>(
        &mut self,
        diagonal: &[S],
        lower: &[S],
        least: S,
        inverse: &mut [S],
        x: &mut [[S; R]],
    ) {
        self.eliminate(diagonal, lower, least, inverse, |j, after, link| x[after] = sub(x[after], scale(x[j], link)));
        self.solve_back(inverse, x);
    }

    fn solve_back<const R: usize>(&self, inverse: &[S], x: &mut [[S; R]]) {
        let count = self.next.len();
        let (next, link, inverse, x) = (&self.next[..count], &self.link[..count], &inverse[..count], &mut x[..count]);
        for j in (0..count).rev() {
            x[j] = sub(scale(x[j], inverse[j]), scale(x[next[j] as usize], link[j]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Ldl;
    use super::*;

    /// A tree of unknowns: each but the last is coupled to one later one.
    const PARENTS: [u32; 7] = [2, 2, 4, 4, 6, 6, 6];

    #[test]
    fn a_forest_has_the_bits_of_elimination_row_by_row() {
        let mut lower: Vec<Vec<u32>> = vec![Vec::new(); 7];
        for (j, &parent) in PARENTS.iter().enumerate().take(6) {
            lower[parent as usize].push(j as u32);
        }
        let entries: Vec<f64> = (0..6).map(|e| 0.3 + 0.1 * f64::from(e)).collect();
        let diagonal: Vec<f64> = (0..7).map(|k| 2.0 + 0.2 * f64::from(k)).collect();
        let mut quick = Ldl::analyse(&lower);
        let mut plain = Ldl { forest: None, script: None, ..quick.clone() };
        assert!(quick.forest.is_some());
        let b: Vec<[f64; 2]> = (0..7).map(|k| [1.0 + f64::from(k), -0.5 * f64::from(k)]).collect();
        let (mut x, mut y, mut z) = (b.clone(), b.clone(), b);
        plain.factor(&diagonal, &entries, 1e-12);
        plain.solve(&mut x);
        quick.factor(&diagonal, &entries, 1e-12);
        quick.solve(&mut y);
        quick.factor_and_solve(&diagonal, &entries, 1e-12, &mut z);
        assert_eq!(x, y);
        assert_eq!(x, z);
    }

    #[test]
    fn what_is_no_forest_is_told() {
        assert!(Forest::<f64>::of(&[vec![], vec![0], vec![0]]).is_none());
        assert!(Forest::<f64>::of(&[vec![], vec![], vec![0, 1]]).is_some());
    }
}
