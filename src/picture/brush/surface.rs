//! Pixels that know what changed in them, and can change back.

use std::ops::Range;

use super::history::{Grid, History, LIMIT};

/// Coverage and ink of each pixel, with their history.
#[derive(Debug)]
pub(super) struct Surface {
    pub(super) grid: Grid,
    /// The number of the ink that is painted with from now on.
    pub(super) ink: u8,
    /// Row by row from the top.
    values: Vec<u8>,
    history: History,
    /// The number of each pixel's ink; empty: 0 everywhere.
    inks: Vec<u8>,
    of_inks: History,
    /// Whether steps changed coverage and inks: those that were done, and those that were taken back, the nearest last.
    past: Vec<[bool; 2]>,
    future: Vec<[bool; 2]>,
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
        let [history, of_inks] = [(); 2].map(|()| History::new(grid, LIMIT));
        let (inks, past, future) = (Vec::new(), Vec::new(), Vec::new());
        Surface { grid, ink: 0, values, history, inks, of_inks, past, future, changed, version: 0 }
    }

    /// The number of each pixel's ink; empty: 0 everywhere.
    pub(super) fn inks(&self) -> &[u8] {
        &self.inks
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

    /// Those pixels of a run of a row are of the present ink, within the step under way, of whose place in the run and coverage `takes` says so.
    pub(super) fn dye(&mut self, row: usize, columns: Range<usize>, takes: impl Fn(usize, u8) -> bool) {
        if columns.is_empty() || self.ink == 0 && self.inks.is_empty() {
            return;
        }
        if self.inks.is_empty() {
            self.inks = vec![0; self.values.len()];
        }
        self.of_inks.keep(self.grid, &self.inks, row, &columns);
        let first = row * self.grid.width;
        let run = first + columns.start..first + columns.end;
        let mut differs = false;
        for (k, (ink, covered)) in self.inks[run.clone()].iter_mut().zip(&self.values[run]).enumerate() {
            if *ink != self.ink && takes(k, *covered) {
                (*ink, differs) = (self.ink, true);
            }
        }
        if differs {
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
        let step = [self.history.commit(self.grid, &self.values), self.of_inks.commit(self.grid, &self.inks)];
        if step.contains(&true) {
            self.history.forget_ahead();
            self.of_inks.forget_ahead();
            self.future.clear();
            self.past.push(step);
        }
    }

    /// Takes the last step back; whether there was one.
    pub(super) fn undo(&mut self) -> bool {
        let Some([covers, dyes]) = self.past.pop_if(|step| known(*step, [&self.history, &self.of_inks], 0)) else {
            return false;
        };
        self.future.push([covers, dyes]);
        let covered = covers.then(|| self.history.undo(self.grid, &mut self.values)).flatten();
        let dyed = dyes.then(|| self.of_inks.undo(self.grid, &mut self.inks)).flatten();
        self.touch_tiles([covered, dyed]);
        true
    }

    /// Does the step that was taken back last once more; whether there was one.
    pub(super) fn redo(&mut self) -> bool {
        let Some([covers, dyes]) = self.future.pop_if(|step| known(*step, [&self.history, &self.of_inks], 1)) else {
            return false;
        };
        self.past.push([covers, dyes]);
        let covered = covers.then(|| self.history.redo(self.grid, &mut self.values)).flatten();
        let dyed = dyes.then(|| self.of_inks.redo(self.grid, &mut self.inks)).flatten();
        self.touch_tiles([covered, dyed]);
        true
    }

    /// Whether there is a step to take back, and one to do again.
    pub(super) fn has_steps(&self) -> [bool; 2] {
        let both = [&self.history, &self.of_inks];
        [(&self.past, 0), (&self.future, 1)]
            .map(|(steps, way)| steps.last().is_some_and(|step| known(*step, both, way)))
    }

    /// Left, top, right, bottom of what changed since last asked `[px]`.
    pub(super) fn take_changed(&mut self) -> Option<[usize; 4]> {
        self.changed.take()
    }

    fn touch_tiles(&mut self, tiles: [Option<Vec<usize>>; 2]) {
        tiles.iter().flatten().flatten().for_each(|&tile| self.touch(self.grid.bounds(tile)));
    }

    fn touch(&mut self, [left, top, right, bottom]: [usize; 4]) {
        let old = self.changed.unwrap_or([left, top, right, bottom]);
        self.changed = Some([old[0].min(left), old[1].min(top), old[2].max(right), old[3].max(bottom)]);
        self.version += 1;
    }
}

/// Whether the histories of coverage and inks have what a step changed, behind them (0) or ahead (1): the oldest are forgotten.
fn known(step: [bool; 2], histories: [&History; 2], way: usize) -> bool {
    step.into_iter().zip(histories).all(|(is_of, history)| !is_of || history.has()[way])
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
