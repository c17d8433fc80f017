//! A grid of cells over the edges of a cluster: each edge lies in all that it may be near to.

use super::cluster::{Cluster, OBSTACLE};
use super::detect::Line;
use crate::sim::real::Real;
use crate::sim::vector::add;

/// Cells that an edge may touch before it is looked at by every point instead.
const MOST_CELLS: usize = 64;
/// Edges for each cell that make a heap, and how large cells are in one, in mean edges.
const HEAPED: f64 = 4.0;
const SHARES: [f64; 3] = [1.0, 0.5, 0.25];

/// A grid over a box.
pub(super) struct Cells<S> {
    low: [S; 2],
    side: S,
    counts: [usize; 2],
}

pub(super) type Grid<S> = (Cells<S>, Vec<u32>, Vec<u32>, Vec<usize>);

/// The edges in cells, each in all that it may be near to, and those that are too long for it.
pub(super) fn grid<S: Real>(state: &Cluster<S>, lines: &[Line<S>]) -> Grid<S> {
    let farthest = state.promised.iter().fold(S::ZERO, |most, &promised| most.max(promised));
    let mut low = [S::INFINITY; 2];
    let mut high = [-S::INFINITY; 2];
    for &(p, _) in &state.corners {
        for k in 0..2 {
            low[k] = low[k].min(state.now[p as usize][k]);
            high[k] = high[k].max(state.now[p as usize][k]);
        }
    }
    let own = lines.iter().filter(|line| line.body != OBSTACLE);
    let (sum, count) = own.fold((S::ZERO, 0), |(sum, count), line| (sum + line.square.sqrt(), count + 1));
    let mean = if count > 0 { sum / S::from_f64(f64::from(count)) } else { S::ONE };
    let cells = Cells::over((low, high), (mean, farthest + farthest), state.edges.len());
    let mut starts = vec![0_u32; cells.counts[0] * cells.counts[1] + 1];
    let mut long = Vec::new();
    let mut ranges = Vec::with_capacity(state.edges.len());
    for (k, line) in lines.iter().enumerate() {
        let (a, b) = (line.from, add(line.from, line.along));
        let grown = line.reach + state.widest + farthest;
        let from = [0, 1].map(|k| a[k].min(b[k]) - grown);
        let to = [0, 1].map(|k| a[k].max(b[k]) + grown);
        let range = cells.range(from, to);
        let many = range.as_ref().map_or(0, |[x, y]| x.len() * y.len());
        if many > MOST_CELLS {
            long.push(k);
            ranges.push(None);
            continue;
        }
        if let Some([x, y]) = &range {
            for row in y.clone() {
                for column in x.clone() {
                    starts[row * cells.counts[0] + column + 1] += 1;
                }
            }
        }
        ranges.push(range);
    }
    for cell in 1..starts.len() {
        starts[cell] += starts[cell - 1];
    }
    let mut next = starts.clone();
    let mut entries = vec![0_u32; starts.last().map_or(0, |&end| end as usize)];
    for (k, range) in ranges.iter().enumerate() {
        let Some([x, y]) = range else { continue };
        for row in y.clone() {
            for column in x.clone() {
                let place = &mut next[row * cells.counts[0] + column];
                entries[*place as usize] = k as u32;
                *place += 1;
            }
        }
    }
    (cells, starts, entries, long)
}

impl<S: Real> Cells<S> {
    /// Cells over a box for so many edges of about this length, with so much room around each: of the sum of both, smaller ones where edges lie in
    /// a heap, and not many more than there are edges.
    fn over((low, high): ([S; 2], [S; 2]), (length, room): (S, S), edges: usize) -> Self {
        let size = [0, 1].map(|k| (high[k] - low[k]).max(S::ZERO).to_f64());
        let many = |side: f64| (size[0] / side + 1.0) * (size[1] / side + 1.0);
        let (edges, [length, room]) = (edges as f64, [length, room].map(Real::to_f64));
        let of = |share: f64| (share * length + room).max(1e-12);
        let is_crowded = |share: &f64| edges > HEAPED * many(of(*share));
        let mut side = of(SHARES.into_iter().find(|share| !is_crowded(share)).unwrap_or(SHARES[2]));
        let most = 4.0 * edges + 16.0;
        while many(side) > most && side.is_finite() {
            side *= 1.5;
        }
        let counts = size.map(|size| (size / side) as usize + 1);
        Cells { low, side: S::from_f64(side), counts }
    }

    pub(super) fn place(&self, x: [S; 2]) -> Option<usize> {
        let at = [0, 1].map(|k| ((x[k] - self.low[k]) / self.side).to_f64());
        let is_in = (0..2).all(|k| at[k] >= 0.0 && at[k] < self.counts[k] as f64 + 0.5);
        let [column, row] = [0, 1].map(|k| (at[k] as usize).min(self.counts[k] - 1));
        is_in.then_some(row * self.counts[0] + column)
    }

    fn range(&self, from: [S; 2], to: [S; 2]) -> Option<[std::ops::Range<usize>; 2]> {
        let of = |k: usize| {
            let [first, last] = [from[k], to[k]].map(|x| ((x - self.low[k]) / self.side).to_f64());
            let end = (last + 1.0).max(0.0).min(self.counts[k] as f64) as usize;
            let start = first.max(0.0).min(self.counts[k] as f64) as usize;
            (start < end).then_some(start..end)
        };
        Some([of(0)?, of(1)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_smaller_where_edges_lie_in_a_heap() {
        let square = ([0.0; 2], [1.0; 2]);
        let over = |edges| Cells::over(square, (0.1, 0.02), edges);
        assert!((over(40).side - 0.12).abs() < 1e-12, "{} of 40 in 80 cells", over(40).side);
        assert!((over(600).side - 0.07).abs() < 1e-12, "{} of 600, more than 4 a cell", over(600).side);
        assert!((over(4_000).side - 0.045).abs() < 1e-12, "{} of 4,000", over(4_000).side);
    }

    #[test]
    fn there_are_not_many_more_cells_than_edges() {
        let cells = Cells::over(([0.0; 2], [1e3; 2]), (0.1, 0.0), 10);
        assert!(cells.counts[0] * cells.counts[1] <= 60, "{:?}", cells.counts);
        assert_eq!(cells.place([1e3; 2]), Some(cells.counts[0] * cells.counts[1] - 1), "the last corner");
        assert_eq!(cells.place([-1.0, 0.0]), None);
    }
}
