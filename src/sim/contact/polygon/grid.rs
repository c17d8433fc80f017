//! A grid of square cells over line segments: which of them are near.

use super::Segment;

/// Cells along a side at most.
const MOST_CELLS: f64 = 2048.0;
/// Cells for each segment, about.
const CELLS_EACH: f64 = 8.0;
/// What is added to ways on both sides, so that rounding loses no cell, as a share of a cell.
const MARGIN: f64 = 1e-6;

/// Square cells over a part of the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    /// The lower left corner `[m]`.
    pub(super) low: [f64; 2],
    /// Side of a cell `[m]`.
    pub(super) side: f64,
    /// Cells along x and y.
    pub(super) counts: [usize; 2],
}

/// For every cell the segments that touch it.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub(super) cells: Cells,
    /// Where the list of each cell begins in `items`, and where the last ends.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Grid {
    /// Valid range: all numbers finite.
    pub(super) fn new(segments: &[Segment]) -> Self {
        let cells = Cells::over(segments);
        let mut starts = vec![0_u32; cells.count() + 1];
        for &[a, b] in segments {
            cells.along(a, b, 0.0, |cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut items = vec![0; starts[starts.len() - 1] as usize];
        let mut places = starts.clone();
        for (k, &[a, b]) in segments.iter().enumerate() {
            cells.along(a, b, 0.0, |cell| {
                items[places[cell] as usize] = k as u32;
                places[cell] += 1;
            });
        }
        Grid { cells, starts, items }
    }

    /// The segments that touch a cell.
    #[inline]
    pub(super) fn of(&self, cell: usize) -> &[u32] {
        &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// The segments in the cells along a way, once each, ascending.
    pub(super) fn near(&self, a: [f64; 2], b: [f64; 2], margin: f64) -> Vec<u32> {
        let mut list = Vec::new();
        self.cells.along(a, b, margin, |cell| list.extend(self.of(cell)));
        list.sort_unstable();
        list.dedup();
        list
    }
}

impl Cells {
    fn over(segments: &[Segment]) -> Self {
        let [low, high] = extent(segments);
        let size = [high[0] - low[0], high[1] - low[1]];
        let wanted = CELLS_EACH * segments.len() as f64;
        let side = (size[0] * size[1] / wanted).sqrt().max(size[0].max(size[1]) / wanted.clamp(1.0, MOST_CELLS));
        let side = if side > 0.0 { side } else { 1.0 };
        Cells { low, side, counts: size.map(|size| (size / side).floor() as usize + 1) }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// How many cells a square of half side `reach` `[m]` touches, about and at most.
    pub(super) fn many(&self, reach: f64) -> usize {
        let along = 2.0 * reach / self.side + 2.0;
        (along.min(self.counts[0] as f64) * along.min(self.counts[1] as f64)) as usize
    }

    /// Column and row of a point's cell, if it is in one.
    #[inline]
    pub(super) fn place(&self, x: [f64; 2]) -> Option<[usize; 2]> {
        let at = [0, 1].map(|k| (x[k] - self.low[k]) / self.side);
        let is_in = (0..2).all(|k| at[k] >= 0.0 && at[k] < self.counts[k] as f64);
        is_in.then(|| at.map(|at| at as usize))
    }

    /// Visits the cells nearer than `margin` `[m]` to the way from `a` to `b`, and a few more.
    #[inline]
    pub(super) fn along(&self, a: [f64; 2], b: [f64; 2], margin: f64, mut visit: impl FnMut(usize)) {
        let margin = margin + MARGIN * self.side;
        let Some([first, last]) = self.range(1, a[1].min(b[1]) - margin, a[1].max(b[1]) + margin) else { return };
        let rise = b[1] - a[1];
        for row in first..=last {
            // The part of the way within the row.
            let floor = self.low[1] + row as f64 * self.side - margin;
            let share = |y: f64| ((y - a[1]) / rise).clamp(0.0, 1.0);
            let is_within = rise == 0.0 || first == last;
            let shares = if is_within { [0.0, 1.0] } else { [share(floor), share(floor + self.side + 2.0 * margin)] };
            let ends = shares.map(|share| a[0] + share * (b[0] - a[0]));
            let (left, right) = (ends[0].min(ends[1]) - margin, ends[0].max(ends[1]) + margin);
            if let Some([from, to]) = self.range(0, left, right) {
                (from..=to).for_each(|column| visit(row * self.counts[0] + column));
            }
        }
    }

    /// Visits the cells that the square of half side `reach` `[m]` about `x` touches.
    #[inline]
    pub(super) fn around(&self, x: [f64; 2], reach: f64, mut visit: impl FnMut(usize)) {
        let range = |axis: usize| self.range(axis, x[axis] - reach, x[axis] + reach);
        let (Some([left, right]), Some([low, high])) = (range(0), range(1)) else { return };
        for row in low..=high {
            (left..=right).for_each(|column| visit(row * self.counts[0] + column));
        }
    }

    /// First and last cell along an axis between two places `[m]`; `None` where all lie outside.
    #[inline]
    fn range(&self, axis: usize, from: f64, to: f64) -> Option<[usize; 2]> {
        let count = self.counts[axis];
        let [from, to] = [from, to].map(|x| (x - self.low[axis]) / self.side);
        (to >= 0.0 && from < count as f64).then(|| [from.max(0.0) as usize, (to as usize).min(count - 1)])
    }
}

/// The box around segments; of none it is empty at the origin.
pub(super) fn extent(segments: &[Segment]) -> [[f64; 2]; 2] {
    let Some(&[first, _]) = segments.first() else { return [[0.0; 2]; 2] };
    segments.iter().flatten().fold([first, first], |[low, high], x| {
        [[low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])]]
    })
}
