//! What steps changed, in tiles, to be taken back and done again.

use std::collections::VecDeque;
use std::ops::Range;

/// Side of a tile `[px]`: a dab of usual size touches four, and 4 KiB are copied in less than a microsecond.
pub(super) const TILE: usize = 64;

/// Most memory that steps may hold `[bytes]`: four whole canvases of the largest size, or thousands of strokes.
pub(super) const LIMIT: usize = 64 << 20;

/// Divides a canvas into tiles, row by row from the top; the last ones of a row and of a column may be smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Grid {
    /// `[px]`
    pub(super) width: usize,
    /// `[px]`
    pub(super) height: usize,
}

impl Grid {
    fn count(self) -> usize {
        self.width.div_ceil(TILE) * self.height.div_ceil(TILE)
    }

    /// The tiles that a run of pixels, at least one, lies in.
    fn of_run(self, row: usize, columns: &Range<usize>) -> Range<usize> {
        let first = row / TILE * self.width.div_ceil(TILE);
        first + columns.start / TILE..first + (columns.end - 1) / TILE + 1
    }

    /// Left, top, right, bottom of a tile `[px]`.
    pub(super) fn bounds(self, tile: usize) -> [usize; 4] {
        let across = self.width.div_ceil(TILE);
        let (left, top) = (tile % across * TILE, tile / across * TILE);
        [left, top, (left + TILE).min(self.width), (top + TILE).min(self.height)]
    }

    /// Where the rows of a tile lie among all pixels.
    fn rows(self, tile: usize) -> impl Iterator<Item = Range<usize>> {
        let [left, top, right, bottom] = self.bounds(tile);
        (top..bottom).map(move |row| row * self.width + left..row * self.width + right)
    }

    fn copy(self, values: &[u8], tile: usize) -> Vec<u8> {
        let mut pixels = Vec::with_capacity(TILE * TILE);
        self.rows(tile).for_each(|row| pixels.extend_from_slice(&values[row]));
        pixels
    }
}

/// Pixels of a tile.
#[derive(Debug)]
enum Tile {
    /// All the same: most of what a large fill changes.
    Even(u8),
    /// Row by row.
    Mixed(Vec<u8>),
}

impl Tile {
    fn new(mut pixels: Vec<u8>) -> Self {
        if pixels.iter().all(|&value| value == pixels[0]) {
            return Tile::Even(pixels[0]);
        }
        pixels.shrink_to_fit();
        Tile::Mixed(pixels)
    }

    fn put(&self, grid: Grid, values: &mut [u8], tile: usize) {
        match self {
            Tile::Even(value) => grid.rows(tile).for_each(|row| values[row].fill(*value)),
            Tile::Mixed(pixels) => {
                let width = grid.bounds(tile)[2] - grid.bounds(tile)[0];
                let rows = grid.rows(tile).zip(pixels.chunks_exact(width));
                rows.for_each(|(row, pixels)| values[row].copy_from_slice(pixels));
            }
        }
    }
}

/// What one step changed: each tile as it is on the other side of the step.
#[derive(Debug)]
struct Step(Vec<(usize, Tile)>);

impl Step {
    fn bytes(&self) -> usize {
        let pixels = |(_, tile): &(usize, Tile)| match tile {
            Tile::Even(_) => 0,
            Tile::Mixed(pixels) => pixels.len(),
        };
        size_of::<Self>() + self.0.iter().map(|tile| size_of_val(tile) + pixels(tile)).sum::<usize>()
    }

    /// Puts the step's tiles in place, and keeps those that were there.
    fn swap(&mut self, grid: Grid, values: &mut [u8]) {
        for (place, tile) in &mut self.0 {
            let now = Tile::new(grid.copy(values, *place));
            tile.put(grid, values, *place);
            *tile = now;
        }
    }
}

/// Steps that were done, steps that were taken back, and the one that is under way.
#[derive(Debug)]
pub(super) struct History {
    /// Of each tile that the step under way has touched, what was there before.
    before: Vec<Option<Vec<u8>>>,
    /// Those tiles, in the order in which they were touched.
    touched: Vec<usize>,
    past: VecDeque<Step>,
    future: Vec<Step>,
    /// Held by past and future `[bytes]`.
    bytes: usize,
    /// Most of it `[bytes]`.
    limit: usize,
}

impl History {
    pub(super) fn new(grid: Grid, limit: usize) -> Self {
        let before = (0..grid.count()).map(|_| None).collect();
        let (past, future) = (VecDeque::new(), Vec::new());
        History { before, touched: Vec::new(), past, future, bytes: 0, limit }
    }

    /// Keeps what a run of pixels, at least one, is about to lose.
    pub(super) fn keep(&mut self, grid: Grid, values: &[u8], row: usize, columns: &Range<usize>) {
        for tile in grid.of_run(row, columns) {
            if self.before[tile].is_none() {
                self.before[tile] = Some(grid.copy(values, tile));
                self.touched.push(tile);
            }
        }
    }

    /// Ends the step under way; whether there is one. One that changed nothing is none, and leaves those that were taken back.
    pub(super) fn commit(&mut self, grid: Grid, values: &[u8]) -> bool {
        let mut step = Vec::new();
        for tile in self.touched.drain(..) {
            let before = self.before[tile].take().filter(|before| {
                let now = grid.rows(tile).flat_map(|row| &values[row]);
                !before.iter().eq(now)
            });
            step.extend(before.map(|pixels| (tile, Tile::new(pixels))));
        }
        if step.is_empty() {
            return false;
        }
        let step = Step(step);
        self.forget_ahead();
        self.bytes += step.bytes();
        self.past.push_back(step);
        self.drop_oldest();
        true
    }

    /// Steps that were taken back are not done again.
    pub(super) fn forget_ahead(&mut self) {
        self.bytes -= self.future.drain(..).map(|step| step.bytes()).sum::<usize>();
    }

    /// Takes the last step back; returns the tiles that changed.
    pub(super) fn undo(&mut self, grid: Grid, values: &mut [u8]) -> Option<Vec<usize>> {
        let step = self.past.pop_back()?;
        let (step, tiles) = self.swap(step, grid, values);
        self.future.push(step);
        self.drop_oldest();
        Some(tiles)
    }

    /// Does the step that was taken back last once more; returns the tiles that changed.
    pub(super) fn redo(&mut self, grid: Grid, values: &mut [u8]) -> Option<Vec<usize>> {
        let step = self.future.pop()?;
        let (step, tiles) = self.swap(step, grid, values);
        self.past.push_back(step);
        self.drop_oldest();
        Some(tiles)
    }

    /// Whether there is a step to take back, and one to do again.
    pub(super) fn has(&self) -> [bool; 2] {
        [!self.past.is_empty(), !self.future.is_empty()]
    }

    fn swap(&mut self, mut step: Step, grid: Grid, values: &mut [u8]) -> (Step, Vec<usize>) {
        self.bytes -= step.bytes();
        step.swap(grid, values);
        self.bytes += step.bytes();
        let tiles = step.0.iter().map(|(place, _)| *place).collect();
        (step, tiles)
    }

    /// The oldest step goes first; of those that were taken back, the one farthest ahead.
    fn drop_oldest(&mut self) {
        while self.bytes > self.limit {
            let ahead = |future: &mut Vec<Step>| (!future.is_empty()).then(|| future.remove(0));
            let Some(step) = self.past.pop_front().or_else(|| ahead(&mut self.future)) else { return };
            self.bytes -= step.bytes();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { width: 150, height: 70 };

    /// Writes `value` into a run, as one step.
    fn write(history: &mut History, values: &mut [u8], row: usize, columns: Range<usize>, value: u8) {
        history.keep(GRID, values, row, &columns);
        values[row * GRID.width..][columns].fill(value);
        history.commit(GRID, values);
    }

    #[test]
    fn tiles_cover_every_pixel_once() {
        let mut seen = vec![0; GRID.width * GRID.height];
        for tile in 0..GRID.count() {
            GRID.rows(tile).flatten().for_each(|k| seen[k] += 1);
        }
        assert!(GRID.count() == 6 && seen.iter().all(|&count| count == 1));
        assert_eq!((GRID.of_run(63, &(0..64)), GRID.of_run(64, &(63..150))), (0..1, 3..6));
        assert_eq!(GRID.bounds(5), [128, 64, 150, 70]);
    }

    #[test]
    fn steps_hold_the_tiles_that_changed_and_no_more() {
        let (mut history, mut values) = (History::new(GRID, LIMIT), vec![0; GRID.width * GRID.height]);
        write(&mut history, &mut values, 3, 60..70, 9);
        let changed = |history: &History| history.past.iter().map(|step| step.0.len()).collect::<Vec<_>>();
        assert_eq!(changed(&history), [2]);
        assert!(history.past[0].0.iter().all(|(_, tile)| matches!(tile, Tile::Even(0))));
        write(&mut history, &mut values, 3, 60..70, 9);
        assert_eq!(changed(&history), [2]);
        write(&mut history, &mut values, 3, 60..150, 9);
        assert_eq!(changed(&history), [2, 2]);
        assert_eq!(history.undo(GRID, &mut values), Some(vec![1, 2]));
        assert_eq!(values.iter().filter(|&&value| value == 9).count(), 10);
    }

    #[test]
    fn memory_is_bounded_and_the_oldest_step_goes_first() {
        let limit = 20_000;
        let (mut history, mut values) = (History::new(GRID, limit), vec![0; GRID.width * GRID.height]);
        let mut seen = Vec::new();
        for k in 0..40_usize {
            seen.push(values.clone());
            write(&mut history, &mut values, k % 64, 10 + k..20 + k, 1 + k as u8);
            let held = |history: &History| history.past.iter().chain(&history.future).map(Step::bytes).sum::<usize>();
            assert_eq!(held(&history), history.bytes);
            assert!(history.bytes <= limit);
        }
        let mut count = 0;
        while history.undo(GRID, &mut values).is_some() {
            count += 1;
            assert_eq!(values, seen[40 - count]);
            assert!(history.bytes <= limit);
        }
        assert_eq!(count, 4);
    }
}
