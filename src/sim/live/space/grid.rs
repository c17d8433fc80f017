//! A uniform grid over triangles in space, filled by counting.

use super::cluster::Cluster;
use super::detect::{farthest, three};
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
    /// The triangles of a cluster, each with all places that are no further from it than `apart` `[m]` and what is promised of its corners.
    pub(super) fn over(state: &Cluster<S>, apart: S) -> Self {
        let mut grid = Grid::empty(state, apart + state.least_promise);
        let ranges: Vec<Option<[[usize; 2]; 3]>> = state
            .triangles
            .iter()
            .map(|(corners, ..)| {
                let reach = apart + farthest(&state.promised, *corners);
                grid.range(&three(&state.now, *corners), reach).filter(|range| size(range) <= MOST_CELLS)
            })
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
            let [a, b, c] = three(&state.now, *corners);
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

    /// The first cell along each axis that places or what is no further than `reach` `[m]` from them lie in, and the one behind the last.
    fn range(&self, places: &[[S; 3]], reach: S) -> Option<[[usize; 2]; 3]> {
        let along = |k: usize| {
            let low = places.iter().fold(S::INFINITY, |least, x| least.min(x[k])) - reach;
            let high = places.iter().fold(-S::INFINITY, |most, x| most.max(x[k])) + reach;
            let last = self.counts[k] - 1;
            let at = |x: S| (((x - self.low[k]) / self.side).to_f64().max(0.0) as usize).min(last);
            [at(low), at(high) + 1]
        };
        let range = [along(0), along(1), along(2)];
        places.iter().flatten().all(|x| x.is_finite()).then_some(range)
    }

    /// Notes the triangles that may be near a place, or near what is no further than `beyond` `[m]` from it: each once.
    pub(super) fn near(&self, x: [S; 3], beyond: S, seen: &mut Seen) {
        seen.begin();
        if let Some([along, across, up]) = self.range(&[x], beyond) {
            for z in up[0]..up[1] {
                for y in across[0]..across[1] {
                    // Cells of a row follow each other.
                    let row = (z * self.counts[1] + y) * self.counts[0];
                    let [first, end] = [self.starts[row + along[0]], self.starts[row + along[1]]];
                    self.entries[first as usize..end as usize].iter().for_each(|&triangle| seen.note(triangle));
                }
            }
        }
        self.large.iter().for_each(|&triangle| seen.note(triangle));
    }
}

/// Triangles that are seen from a place, each once.
pub(super) struct Seen {
    /// For which place each was seen last.
    last: Vec<u32>,
    place: u32,
    pub(super) list: Vec<u32>,
}

impl Seen {
    /// Of so many triangles none.
    pub(super) fn of(triangles: usize) -> Self {
        Seen { last: vec![0; triangles], place: 0, list: Vec::new() }
    }

    fn begin(&mut self) {
        self.place += 1;
        self.list.clear();
    }

    #[inline(always)]
    fn note(&mut self, triangle: u32) {
        let last = &mut self.last[triangle as usize];
        if *last != self.place {
            *last = self.place;
            self.list.push(triangle);
        }
    }
}

fn size(range: &[[usize; 2]; 3]) -> usize {
    range.iter().map(|[first, end]| end - first).product()
}

fn cells([x, y, z]: [[usize; 2]; 3], counts: [usize; 3]) -> impl Iterator<Item = usize> {
    let rows = (z[0]..z[1]).flat_map(move |z| (y[0]..y[1]).map(move |y| (z * counts[1] + y) * counts[0]));
    rows.flat_map(move |row| (x[0]..x[1]).map(move |x| row + x))
}
