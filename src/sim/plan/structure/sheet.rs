//! Rows and columns.

use super::Structure;
use crate::sim::bonds::Bonds;
use crate::sim::bulk::spec::Spec;
use crate::sim::kernels::rows::Kinds;
use crate::sim::plan::island::Island;

/// Fewest columns and rows: with two columns a bond along the row and a rising one have the same ends.
const FEWEST: usize = 3;

/// The sheet that an island is, if its points are numbered row by row without a gap and every cell has the same bonds.
///
/// Bonds between two pins may be missing: nothing can move their ends.
pub(crate) fn sheet(island: &Island, bonds: &Bonds, w: &[f64]) -> Option<Structure> {
    let steps = steps(island, bonds)?;
    let (mut first, mut last) = (u32::MAX, 0);
    for &k in &island.bonds {
        for end in bonds.ends()[k as usize] {
            (first, last) = (first.min(end.0), last.max(end.0));
        }
    }
    let count = (last - first) as usize + 1;
    candidates(&steps).into_iter().find_map(|(columns, [has_rising, has_falling])| {
        let fits = columns >= FEWEST && count.is_multiple_of(columns) && count / columns >= FEWEST;
        fits.then(|| Draft { first, columns, rows: count / columns, has_rising, has_falling }.check(island, bonds, w))?
    })
}

/// The differences between the numbers of a bond's ends, ascending; `None` where there are too many for a sheet.
fn steps(island: &Island, bonds: &Bonds) -> Option<Vec<u32>> {
    let mut steps: Vec<u32> = Vec::with_capacity(5);
    for &k in &island.bonds {
        let [a, b] = bonds.ends()[k as usize];
        let step = a.0.abs_diff(b.0);
        if !steps.contains(&step) {
            steps.push(step);
            if steps.len() > 4 {
                return None;
            }
        }
    }
    steps.sort_unstable();
    Some(steps)
}

/// Columns, and whether there are rising and falling bonds, that these differences may mean.
fn candidates(steps: &[u32]) -> Vec<(usize, [bool; 2])> {
    match *steps {
        [1, down] => vec![(down as usize, [false, false])],
        [1, a, b] if b == a + 1 => vec![(a as usize, [false, true]), (b as usize, [true, false])],
        [1, a, b, c] if b == a + 1 && c == b + 1 => vec![(b as usize, [true, true])],
        _ => Vec::new(),
    }
}

/// A sheet that an island may be.
struct Draft {
    first: u32,
    columns: usize,
    rows: usize,
    has_rising: bool,
    has_falling: bool,
}

/// Kinds of bonds, as bits.
const ALONG: u8 = 1;
const DOWN: u8 = 2;
const FALLING: u8 = 4;
const RISING: u8 = 8;

impl Draft {
    /// The sheet, if every bond is one of its, each is there once, and those of a kind are alike.
    fn check(&self, island: &Island, bonds: &Bonds, w: &[f64]) -> Option<Structure> {
        let count = self.columns * self.rows;
        let mut seen = vec![0_u8; count];
        let mut specs: [Option<Spec>; 4] = [None; 4];
        for &k in &island.bonds {
            let [a, b] = bonds.ends()[k as usize].map(|end| end.0);
            let from = (a.min(b) - self.first) as usize;
            let (kind, cell) = self.kind(from, a.abs_diff(b) as usize)?;
            if seen[cell] & kind != 0 {
                return None;
            }
            seen[cell] |= kind;
            let spec = Spec::of(&bonds.get(k as usize));
            let of_kind = &mut specs[kind.trailing_zeros() as usize];
            if !of_kind.get_or_insert(spec).is_like(&spec) || spec.rest <= 0.0 {
                return None;
            }
        }
        let [along, down, falling, rising] = specs;
        let specs = Kinds { along: along?, down: down?, falling, rising };
        let is_one = [falling, rising].iter().flatten().chain([&specs.down]).all(|spec| spec.is_of_kind(&specs.along));
        (is_one && self.is_complete(&seen, w)).then_some(Structure::Sheet {
            first: self.first,
            columns: self.columns,
            rows: self.rows,
            specs,
        })
    }

    /// The kind of a bond and the cell that it belongs to: the one of its upper left point.
    fn kind(&self, from: usize, step: usize) -> Option<(u8, usize)> {
        let (columns, column) = (self.columns, from % self.columns);
        match step {
            1 => (column + 1 < columns).then_some((ALONG, from)),
            _ if step == columns => Some((DOWN, from)),
            _ if step == columns + 1 => (column + 1 < columns).then_some((FALLING, from)),
            _ if step + 1 == columns => (column > 0).then(|| (RISING, from - 1)),
            _ => None,
        }
    }

    /// Whether every bond is there that has an end which can move.
    fn is_complete(&self, seen: &[u8], w: &[f64]) -> bool {
        let (first, columns) = (self.first as usize, self.columns);
        let is_fixed = |a: usize, b: usize| w[first + a] == 0.0 && w[first + b] == 0.0;
        (0..columns * self.rows).all(|i| {
            let (has_right, has_below) = (i % columns + 1 < columns, i / columns + 1 < self.rows);
            let wants = [
                (ALONG, has_right, i, i + 1),
                (DOWN, has_below, i, i + columns),
                (FALLING, self.has_falling && has_right && has_below, i, i + columns + 1),
                (RISING, self.has_rising && has_right && has_below, i + 1, i + columns),
            ];
            wants.into_iter().all(|(kind, wanted, a, b)| !wanted || seen[i] & kind != 0 || is_fixed(a, b))
        })
    }
}
