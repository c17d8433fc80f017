//! Pixels that know what changed in them, and can change back.

use std::ops::Range;

use super::history::{Grid, History, LIMIT};

/// Coverage of each pixel, with its history.
#[derive(Debug)]
pub(super) struct Surface {
    pub(super) grid: Grid,
    /// Row by row from the top.
    values: Vec<u8>,
    history: History,
    /// Left, top, right, bottom of what changed since last asked `[px]`.
    changed: Option<[usize; 4]>,
    version: u64,
}

impl Surface {
    /// All of it counts as changed.
    ///
    /// Shapes: a value for each pixel of the grid.
    pub(super) fn new(grid: Grid, values: Vec<u8>) -> Self {
        debug_assert_eq!(values.len(), grid.width * grid.height);
        let changed = Some([0, 0, grid.width, grid.height]);
        Surface { grid, values, history: History::new(grid, LIMIT), changed, version: 0 }
    }

    pub(super) fn values(&self) -> &[u8] {
        &self.values
    }

    /// Increases with every change.
    pub(super) fn version(&self) -> u64 {
        self.version
    }

    /// The value at a column and a row.
    pub(super) fn at(&self, [x, y]: [usize; 2]) -> u8 {
        self.values[y * self.grid.width + x]
    }

    /// Changes a run of pixels of a row, within the step under way; `change` tells whether it did.
    pub(super) fn change(&mut self, row: usize, columns: Range<usize>, change: impl FnOnce(&mut [u8]) -> bool) {
        if columns.is_empty() {
            return;
        }
        self.history.keep(self.grid, &self.values, row, &columns);
        if change(&mut self.values[row * self.grid.width..][columns.clone()]) {
            self.touch([columns.start, row, columns.end, row + 1]);
        }
    }

    /// Changes all pixels to what `value` makes of them, within the step under way.
    pub(super) fn change_all(&mut self, value: impl Fn(u8) -> u8) {
        for row in 0..self.grid.height {
            self.change(row, 0..self.grid.width, |run| {
                let is_other = run.iter().any(|&old| value(old) != old);
                run.iter_mut().for_each(|old| *old = value(*old));
                is_other
            });
        }
    }

    /// Ends the step under way.
    pub(super) fn commit(&mut self) {
        self.history.commit(self.grid, &self.values);
    }

    /// Takes the last step back; whether there was one.
    pub(super) fn undo(&mut self) -> bool {
        let tiles = self.history.undo(self.grid, &mut self.values);
        self.touch_tiles(tiles)
    }

    /// Does the step that was taken back last once more; whether there was one.
    pub(super) fn redo(&mut self) -> bool {
        let tiles = self.history.redo(self.grid, &mut self.values);
        self.touch_tiles(tiles)
    }

    /// Whether there is a step to take back, and one to do again.
    pub(super) fn has_steps(&self) -> [bool; 2] {
        self.history.has()
    }

    /// Left, top, right, bottom of what changed since last asked `[px]`.
    pub(super) fn take_changed(&mut self) -> Option<[usize; 4]> {
        self.changed.take()
    }

    fn touch_tiles(&mut self, tiles: Option<Vec<usize>>) -> bool {
        tiles.iter().flatten().for_each(|&tile| self.touch(self.grid.bounds(tile)));
        tiles.is_some()
    }

    fn touch(&mut self, [left, top, right, bottom]: [usize; 4]) {
        let old = self.changed.unwrap_or([left, top, right, bottom]);
        self.changed = Some([old[0].min(left), old[1].min(top), old[2].max(right), old[3].max(bottom)]);
        self.version += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_told_as_a_rectangle() {
        let grid = Grid { width: 200, height: 100 };
        let mut surface = Surface::new(grid, vec![0; 20_000]);
        assert_eq!(surface.take_changed(), Some([0, 0, 200, 100]));
        let set = |run: &mut [u8]| {
            run.fill(7);
            true
        };
        surface.change(5, 10..12, set);
        surface.change(9, 190..200, set);
        surface.change(50, 20..20, set);
        surface.change(51, 20..30, |_| false);
        assert_eq!((surface.take_changed(), surface.version()), (Some([10, 5, 200, 10]), 2));
        assert_eq!((surface.take_changed(), surface.version()), (None, 2));
        surface.commit();
        assert!(surface.undo() && !surface.undo());
        assert_eq!(surface.take_changed(), Some([0, 0, 200, 64]));
        assert!(surface.version() > 2 && surface.values().iter().all(|&value| value == 0));
    }
}
