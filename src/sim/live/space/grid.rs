//! A uniform grid over triangles in space, filled by counting.

use super::cluster::Cluster;
use crate::sim::real::Real;

/// Cells that a triangle may touch before it is looked at by every point instead.
const MOST_CELLS: usize = 512;
/// Cells for each triangle, at most.
const MOST: f64 = 8.0;

/// Triangles in cells, each in all that it may be near to.
pub(super) struct Grid<S> {
    low: [S; 3],
    side: S,
    counts: [usize; 3],
    /// Where the list of each cell begins, and all lists.
    starts: Vec<u32>,
    entries: Vec<u32>,
    /// Triangles that are too large for it.
    large: Vec<u32>,
}

impl<S: Real> Grid<S> {
    /// The triangles of a cluster, each with all places that are no further from it than `reach` [m].
    pub(super) fn over(state: &Cluster<S>, reach: S) -> Self {
        let mut grid = Grid::empty(state, reach);
        let ranges: Vec<Option<[[usize; 2]; 3]>> = state
            .triangles
            .iter()
            .map(|(corners, ..)| grid.range(corners.map(|i| state.now[i as usize]), reach))
            .collect();
        grid.starts = vec![0; grid.counts.iter().product::<usize>() + 1];
        for (k, range) in ranges.iter().enumerate() {
            match range {
                Some(range) => cells(*range, grid.counts).for_each(|cell| grid.starts[cell + 1] += 1),
                None => grid.large.push(k as u32),
            }
        }
        for cell in 1..grid.starts.len() {
            grid.starts[cell] += grid.starts[cell - 1];
        }
        let mut next = grid.starts.clone();
        grid.entries = vec![0; grid.starts.last().map_or(0, |&end| end as usize)];
        for (k, range) in ranges.iter().enumerate() {
            let Some(range) = range else { continue };
            for cell in cells(*range, grid.counts) {
                grid.entries[next[cell] as usize] = k as u32;
                next[cell] += 1;
            }
        }
        grid
    }

    /// A grid over the points of skins, of cells about as wide as a triangle and its reach.
    fn empty(state: &Cluster<S>, reach: S) -> Self {
        let (mut low, mut high) = ([S::INFINITY; 3], [-S::INFINITY; 3]);
        for &(p, _) in &state.corners {
            for k in 0..3 {
                low[k] = low[k].min(state.now[p as usize][k]);
                high[k] = high[k].max(state.now[p as usize][k]);
            }
        }
        let wide = state.triangles.iter().fold(S::ZERO, |sum, (corners, ..)| {
            let [a, b, c] = corners.map(|i| state.now[i as usize]);
            sum + (0..3).fold(S::ZERO, |most, k| most.max((a[k] - b[k]).abs()).max((a[k] - c[k]).abs()))
        });
        let size = [0, 1, 2].map(|k| (high[k] - low[k]).max(S::ZERO).to_f64());
        let most = MOST * state.triangles.len() as f64 + 64.0;
        let mean = wide.to_f64() / state.triangles.len().max(1) as f64;
        let mut side = (mean + reach.to_f64()).max(1e-12);
        let many = |side: f64| size.iter().map(|size| size / side + 1.0).product::<f64>();
        while many(side) > most && side.is_finite() {
            side *= 1.25;
        }
        let counts = size.map(|size| (size / side) as usize + 1);
        Grid { low, side: S::from_f64(side), counts, starts: Vec::new(), entries: Vec::new(), large: Vec::new() }
    }

    /// The first cell along each axis, and the one behind the last; `None` of too many.
    fn range(&self, corners: [[S; 3]; 3], reach: S) -> Option<[[usize; 2]; 3]> {
        let range = [0, 1, 2].map(|k| {
            let places = corners.map(|x| x[k]);
            let low = places.into_iter().fold(S::INFINITY, S::min) - reach;
            let high = places.into_iter().fold(-S::INFINITY, S::max) + reach;
            let at = |x: S| ((x - self.low[k]) / self.side).to_f64().max(0.0).min(self.counts[k] as f64) as usize;
            [at(low), (at(high) + 1).min(self.counts[k])]
        });
        let many: usize = range.iter().map(|[first, end]| end.saturating_sub(*first)).product();
        (many <= MOST_CELLS).then_some(range)
    }

    /// The triangles that may be near a place.
    pub(super) fn near(&self, x: [S; 3]) -> impl Iterator<Item = u32> + '_ {
        let at = [0, 1, 2].map(|k| {
            let at = ((x[k] - self.low[k]) / self.side).to_f64().max(0.0) as usize;
            at.min(self.counts[k] - 1)
        });
        let cell = (at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0];
        let own = &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        own.iter().chain(&self.large).copied()
    }
}

fn cells([x, y, z]: [[usize; 2]; 3], counts: [usize; 3]) -> impl Iterator<Item = usize> {
    let rows = (z[0]..z[1]).flat_map(move |z| (y[0]..y[1]).map(move |y| (z * counts[1] + y) * counts[0]));
    rows.flat_map(move |row| (x[0]..x[1]).map(move |x| row + x))
}
