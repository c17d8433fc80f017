//! Which loops cross or touch: found on a grid.

use super::super::plane::{Point, between, dot, minus, to_segment, turn};

/// Segments sorted into square cells.
#[derive(Clone, Debug)]
pub(crate) struct Bins {
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Where the segments of each cell begin, and, one more, where those of the last end.
    starts: Vec<u32>,
    members: Vec<u32>,
}

/// Most cells a segment: with wide gaps between loops, cells grow.
const CELLS_EACH: usize = 4;

impl Bins {
    /// Sorts segments into cells of about this size `[px]`.
    pub(crate) fn new(segments: &[[Point; 2]], size: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in segments.iter().flatten() {
            for k in 0..2 {
                (low[k], high[k]) = (low[k].min(point[k]), high[k].max(point[k]));
            }
        }
        let extent = if segments.is_empty() { [0.0; 2] } else { minus(high, low) };
        let least = (extent[0] * extent[1] / (CELLS_EACH * segments.len() + 64) as f64).sqrt();
        let cell = size.max(least).max(1e-3 * (extent[0] + extent[1])).max(1e-9);
        let count = |length: f64| (length / cell) as usize + 1;
        let (columns, rows) = (count(extent[0]), count(extent[1]));
        let mut bins =
            Bins { origin: low, cell, columns, rows, starts: vec![0; columns * rows + 1], members: Vec::new() };
        for segment in segments {
            bins.cells(*segment, 0.0).for_each(|at| bins.starts[at + 1] += 1);
        }
        (0..columns * rows).for_each(|at| bins.starts[at + 1] += bins.starts[at]);
        bins.members = vec![0; bins.starts[columns * rows] as usize];
        let mut free = bins.starts.clone();
        for (k, segment) in segments.iter().enumerate() {
            for at in bins.cells(*segment, 0.0) {
                bins.members[free[at] as usize] = k as u32;
                free[at] += 1;
            }
        }
        bins
    }

    /// Numbers of the segments within `reach` px of one, and some farther ones; one may come more than once.
    pub(crate) fn near(&self, segment: [Point; 2], reach: f64) -> impl Iterator<Item = usize> + '_ {
        self.cells(segment, reach).flat_map(|at| self.cell_members(at)).map(|&k| k as usize)
    }

    fn cell_members(&self, at: usize) -> &[u32] {
        &self.members[self.starts[at] as usize..self.starts[at + 1] as usize]
    }

    /// Cells under the box about a segment, which `reach` px are added to.
    fn cells(&self, [a, b]: [Point; 2], reach: f64) -> impl Iterator<Item = usize> + use<> {
        let range = |k: usize, count: usize| {
            let index = |at: f64| ((at - self.origin[k]) / self.cell).max(0.0) as usize;
            (index(a[k].min(b[k]) - reach).min(count - 1), index(a[k].max(b[k]) + reach).min(count - 1))
        };
        let ((left, right), (top, bottom)) = (range(0, self.columns), range(1, self.rows));
        let columns = self.columns;
        (top..=bottom).flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }
}

/// Segments nearer than this `[px]` count as crossing: a triangle between them would have next to no area.
const TOUCH: f64 = 1e-3;

/// Numbers of the loops that cross or touch themselves or another, in order.
pub(super) fn crossing_loops(loops: &[Vec<Point>]) -> Vec<usize> {
    let (mut segments, mut owner, mut next) = (Vec::new(), Vec::new(), Vec::new());
    for (k, points) in loops.iter().enumerate() {
        let first = segments.len();
        for i in 0..points.len() {
            segments.push([points[i], points[(i + 1) % points.len()]]);
            owner.push(k);
            next.push(first + (i + 1) % points.len());
        }
    }
    let total: f64 = segments.iter().map(|[a, b]| minus(*b, *a)).map(|d| dot(d, d).sqrt()).sum();
    let bins = Bins::new(&segments, total / segments.len().max(1) as f64);
    let mut is_bad = vec![false; loops.len()];
    for at in 0..bins.columns * bins.rows {
        let members = bins.cell_members(at);
        for (m, &i) in members.iter().enumerate() {
            for &j in &members[m + 1..] {
                let (i, j) = (i as usize, j as usize);
                let are_bad = if next[i] == j {
                    folds(segments[i], segments[j])
                } else if next[j] == i {
                    folds(segments[j], segments[i])
                } else {
                    touch(segments[i], segments[j])
                };
                if are_bad {
                    (is_bad[owner[i]], is_bad[owner[j]]) = (true, true);
                }
            }
        }
    }
    let is_flat = |k: &usize| is_bad[*k] || loops[*k].len() < 3;
    (0..loops.len()).filter(is_flat).collect()
}

/// Whether the second of two segments that follow each other turns straight back along the first.
fn folds([a, b]: [Point; 2], [_, c]: [Point; 2]) -> bool {
    to_segment(c, [a, b]).0 < TOUCH || to_segment(a, [b, c]).0 < TOUCH
}

/// Whether two segments cross or touch.
fn touch([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let apart = |k: usize| a[k].max(b[k]) + TOUCH < c[k].min(d[k]) || c[k].max(d[k]) + TOUCH < a[k].min(b[k]);
    if apart(0) || apart(1) {
        return false;
    }
    let crosses = (turn(a, b, c) > 0.0) != (turn(a, b, d) > 0.0) && (turn(c, d, a) > 0.0) != (turn(c, d, b) > 0.0);
    crosses || [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])].iter().any(|&(p, s)| to_segment(p, s).0 < TOUCH)
}

/// The middle of a segment.
pub(super) fn middle([a, b]: [Point; 2]) -> Point {
    between(a, b, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<Point> {
        vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    }

    #[test]
    fn loops_that_cross_or_touch_are_told() {
        let apart = [square(0.0, 0.0, 10.0), square(2.0, 2.0, 6.0), square(20.0, 0.0, 5.0)];
        assert!(crossing_loops(&apart).is_empty());
        assert_eq!(crossing_loops(&[square(0.0, 0.0, 10.0), square(50.0, 0.0, 9.0), square(5.0, 5.0, 10.0)]), [0, 2]);
        assert_eq!(crossing_loops(&[square(0.0, 0.0, 10.0), square(10.0, 3.0, 2.0)]), [0, 1]);
        let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
        assert_eq!(crossing_loops(&[square(10.0, 0.0, 3.0), bow]), [1]);
        let fold = vec![[0.0, 0.0], [4.0, 0.0], [8.0, 0.0], [4.0, 0.0005]];
        assert_eq!(crossing_loops(&[fold]), [0]);
        assert_eq!(crossing_loops(&[vec![[0.0, 0.0], [4.0, 0.0]]]), [0]);
        assert!(crossing_loops(&[]).is_empty());
    }
}
