//! Sparse systems of points and constraints: a block of D numbers a point, one number a constraint.
//!
//! ```text
//! [ H  G^T ] [ shift  ]   [ force ]
//! [ G   0  ] [ lambda ] = [ error ]
//! ```
//!
//! Multipliers are eliminated after the points that they hold, so that the factorisation needs no pivoting: pivots of
//! points are positive where H is, and those of multipliers negative.

use super::elimination;
use super::ldl::{Inertia, Ldl};
use crate::sim::real::Real;

/// Place of a point that is not in the system, and the third end of a constraint that has two.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Where the block of two coupled points lies: entry of its first column, row by row of the later point.
#[derive(Clone, Copy, Debug)]
struct Block<const D: usize> {
    starts: [u32; D],
    /// The first point of the pair is the later one.
    is_turned: bool,
}

/// Where the row of a constraint lies.
#[derive(Clone, Copy, Debug)]
struct Line {
    row: u32,
    /// Entry of the first column of each end.
    starts: [u32; 3],
}

/// A system of a fixed pattern.
#[derive(Clone, Debug)]
pub(crate) struct Blocks<S, const D: usize> {
    ldl: Ldl<S>,
    diagonal: Vec<S>,
    lower: Vec<S>,
    /// First row of every point.
    rows: Vec<u32>,
    /// Entry of the first column of a point's own block, row by row below the first.
    own: Vec<[u32; D]>,
    blocks: Vec<Block<D>>,
    lines: Vec<Line>,
}

impl<S: Real, const D: usize> Blocks<S, D> {
    /// The pattern of `pairs` of points that pull on each other and of constraints between `ends`.
    ///
    /// `is_free[i]`: point i is in the system. A pair may come more than once, and blocks of it add up; pairs with a pinned end have no block.
    pub(crate) fn new(is_free: &[bool], pairs: &[[u32; 2]], ends: &[[u32; 3]]) -> Self {
        let count = is_free.len();
        let free = |p: u32| p != NOWHERE && is_free[p as usize];
        let mut couples: Vec<[u32; 2]> = pairs.iter().copied().filter(|&[a, b]| free(a) && free(b)).collect();
        let mut waits_for = vec![Vec::new(); count + ends.len()];
        for (c, pair) in ends.iter().enumerate() {
            for &end in pair.iter().filter(|&&end| free(end)) {
                couples.push([end, (count + c) as u32]);
                waits_for[count + c].push(end);
            }
        }
        let order = elimination::order(count + ends.len(), &couples, &waits_for);
        let mut first = vec![NOWHERE; count + ends.len()];
        let mut size = 0;
        for &node in &order {
            if (node as usize) < count && !free(node) {
                continue;
            }
            first[node as usize] = size;
            size += if (node as usize) < count { D as u32 } else { 1 };
        }
        let width = |node: u32| if (node as usize) < count { D as u32 } else { 1 };
        let mut lower: Vec<Vec<u32>> = vec![Vec::new(); size as usize];
        for &[a, b] in &couples {
            let (early, late) = if first[a as usize] < first[b as usize] { (a, b) } else { (b, a) };
            for r in 0..width(late) {
                let columns = first[early as usize]..first[early as usize] + width(early);
                lower[(first[late as usize] + r) as usize].extend(columns);
            }
        }
        for p in (0..count as u32).filter(|&p| free(p)) {
            for r in 1..D as u32 {
                let row = first[p as usize];
                lower[(row + r) as usize].extend(row..row + r);
            }
        }
        let mut entry_starts = vec![0_u32; size as usize + 1];
        for (k, row) in lower.iter_mut().enumerate() {
            row.sort_unstable();
            row.dedup();
            entry_starts[k + 1] = entry_starts[k] + row.len() as u32;
        }
        let entry = |row: u32, column: u32| {
            let at = lower[row as usize].binary_search(&column).unwrap_or(0);
            entry_starts[row as usize] + at as u32
        };
        let block = |&[a, b]: &[u32; 2]| {
            if !free(a) || !free(b) {
                return Block { starts: [NOWHERE; D], is_turned: false };
            }
            let (early, late) = if first[a as usize] < first[b as usize] { (a, b) } else { (b, a) };
            let starts = std::array::from_fn(|r| entry(first[late as usize] + r as u32, first[early as usize]));
            Block { starts, is_turned: late == a }
        };
        let line = |(c, pair): (usize, &[u32; 3])| {
            let row = first[count + c];
            Line { row, starts: pair.map(|p| if free(p) { entry(row, first[p as usize]) } else { NOWHERE }) }
        };
        let own = |p: u32| {
            let row = first[p as usize];
            std::array::from_fn(|r| if r == 0 || !free(p) { NOWHERE } else { entry(row + r as u32, row) })
        };
        Blocks {
            blocks: pairs.iter().map(block).collect(),
            lines: ends.iter().enumerate().map(line).collect(),
            own: (0..count as u32).map(own).collect(),
            ldl: Ldl::analyse(&lower),
            diagonal: vec![S::ZERO; size as usize],
            lower: vec![S::ZERO; entry_starts[size as usize] as usize],
            rows: first[..count].to_vec(),
        }
    }

    /// How many numbers are unknown.
    pub(crate) fn len(&self) -> usize {
        self.diagonal.len()
    }

    /// Operations of one factorisation, about: where little fills in what it reads says how long it takes, else what it multiplies.
    pub(crate) fn work(&self) -> usize {
        (8 * self.ldl.fill()).max(5 * self.ldl.multiplications())
    }

    /// Sets everything to zero.
    pub(crate) fn clear(&mut self) {
        self.diagonal.fill(S::ZERO);
        self.lower.fill(S::ZERO);
    }

    /// Adds a symmetric block to a point's own.
    pub(crate) fn add_own(&mut self, point: usize, block: &[[S; D]; D]) {
        let row = self.rows[point];
        if row == NOWHERE {
            return;
        }
        for r in 0..D {
            self.diagonal[row as usize + r] += block[r][r];
            for c in 0..r {
                self.lower[self.own[point][r] as usize + c] += block[r][c];
            }
        }
    }

    /// Adds a symmetric block between the points of a pair.
    pub(crate) fn add_pair(&mut self, pair: usize, block: &[[S; D]; D]) {
        let starts = self.blocks[pair].starts;
        if starts[0] == NOWHERE {
            return;
        }
        for r in 0..D {
            for c in 0..D {
                self.lower[starts[r] as usize + c] += block[r][c];
            }
        }
    }

    /// Adds a block between the points of a pair, its rows those of the first.
    pub(crate) fn add_block(&mut self, pair: usize, block: &[[S; D]; D]) {
        let Block { starts, is_turned } = self.blocks[pair];
        if starts[0] == NOWHERE {
            return;
        }
        for r in 0..D {
            for c in 0..D {
                self.lower[starts[r] as usize + c] += if is_turned { block[r][c] } else { block[c][r] };
            }
        }
    }

    /// Sets the row of a constraint: `direction` at its first end, minus that at its second, `corner` on the diagonal.
    pub(crate) fn set_line(&mut self, constraint: usize, direction: [S; D], corner: S) {
        let line = self.lines[constraint];
        for (start, sign) in line.starts.into_iter().zip([S::ONE, -S::ONE]) {
            if start != NOWHERE {
                for c in 0..D {
                    self.lower[start as usize + c] = sign * direction[c];
                }
            }
        }
        self.diagonal[line.row as usize] = corner;
    }

    /// The same of a constraint of three ends, each with a direction of its own.
    pub(crate) fn set_three(&mut self, constraint: usize, directions: [[S; D]; 3], corner: S) {
        let line = self.lines[constraint];
        for (start, direction) in line.starts.into_iter().zip(directions) {
            if start != NOWHERE {
                self.lower[start as usize..start as usize + D].copy_from_slice(&direction);
            }
        }
        self.diagonal[line.row as usize] = corner;
    }

    /// Adds to all diagonals of points.
    pub(crate) fn shift(&mut self, by: S) {
        for &row in self.rows.iter().filter(|&&row| row != NOWHERE) {
            for r in 0..D {
                self.diagonal[row as usize + r] += by;
            }
        }
    }

    /// Factors the system.
    pub(crate) fn factor(&mut self) -> Inertia {
        self.ldl.factor(&self.diagonal, &self.lower, S::EPSILON * S::from_f64(64.0))
    }

    /// Factors the system, and skips only pivots below `least` of their diagonal.
    pub(crate) fn factor_down_to(&mut self, least: S) -> Inertia {
        self.ldl.factor(&self.diagonal, &self.lower, least)
    }

    /// Solves it: `force` of every point becomes its shift, `error` of every constraint its multiplier.
    pub(crate) fn solve(&self, force: &mut [[S; D]], error: &mut [S], work: &mut Vec<S>) {
        work.clear();
        work.resize(self.len(), S::ZERO);
        for (&row, force) in self.rows.iter().zip(force.iter()) {
            if row != NOWHERE {
                work[row as usize..row as usize + D].copy_from_slice(force);
            }
        }
        for (line, error) in self.lines.iter().zip(error.iter()) {
            work[line.row as usize] = *error;
        }
        self.ldl.solve_one(work);
        for (&row, force) in self.rows.iter().zip(force.iter_mut()) {
            *force = if row == NOWHERE { [S::ZERO; D] } else { std::array::from_fn(|k| work[row as usize + k]) };
        }
        for (line, error) in self.lines.iter().zip(error.iter_mut()) {
            *error = work[line.row as usize];
        }
    }
}
