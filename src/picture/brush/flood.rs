//! Pouring ink into a clear region, or clear into a region of ink.

use std::collections::VecDeque;
use std::ops::Range;

use super::surface::Surface;

/// A pixel: column, row.
type Pixel = [usize; 2];

/// From this value on a pixel is ink.
const INK: u8 = 128;

/// A clear pocket of at most so many pixels that the region touches across corners is filled as well. Where two strokes
/// meet at a sharp angle the wedge between them ends in such pockets. Larger ones are regions of their own, which only
/// a thin stroke divides from this one.
const POCKET: usize = 8;

/// How deep a rim is filled `[px]`. Along a stroke it is a pixel deep; where two strokes meet at an angle `a` the wedge
/// between their edges goes on for 1 / (2 tan(a / 2)) px, 11 px at 5 degrees. Deeper, fills would thicken hairlines,
/// which have no full pixel, far from where they were poured.
const RIM: usize = 12;

/// How far from a rim small hollows are looked for `[px]`: how far apart they lie in a notch of 10 degrees.
const NEAR: usize = 3;

/// A run of pixels of one row: from a column up to another.
#[derive(Clone, Copy)]
struct Run {
    row: u16,
    from: u16,
    to: u16,
}

/// A surface as it is seen while it is filled: what is poured in counts as 255.
struct Flood<'a> {
    surface: &'a mut Surface,
    /// 255 turns ink to clear and back, for filling ink with clear.
    flip: u8,
    /// What was poured in, in no order.
    runs: Vec<Run>,
}

/// Fills the regions around some pixels, within the step under way: with ink, or ink with clear.
///
/// Model: a region is 4-connected, of pixels on the same side of 128. Pixels around it that are not full are its rim,
/// joined at all 8 sides and up to [`RIM`] px deep: they are filled too, so that no seam stays between fill and stroke,
/// not even in the notch where strokes meet. Full pixels divide a rim from the one on the stroke's other side.
/// Valid range: pixels of the surface; one that is on the other side of 128 fills nothing.
pub(super) fn flood(surface: &mut Surface, pixels: &[Pixel], erases: bool) {
    let mut flood = Flood { surface, flip: if erases { 255 } else { 0 }, runs: Vec::new() };
    pixels.iter().for_each(|&pixel| flood.pour(pixel));
    flood.climb();
}

impl Flood<'_> {
    fn at(&self, pixel: Pixel) -> u8 {
        self.surface.at(pixel) ^ self.flip
    }

    fn set(&mut self, row: usize, from: usize, to: usize) {
        let value = 255 ^ self.flip;
        if self.flip == 0 {
            // The rims of strokes keep theirs.
            self.surface.dye(row, from..to, |_, old| old < INK);
        }
        self.surface.change(row, from..to, |run| {
            run.fill(value);
            true
        });
    }

    /// Fills the clear region around a pixel, run by run.
    fn pour(&mut self, pixel: Pixel) {
        let mut open = vec![pixel];
        while let Some([x, y]) = open.pop() {
            if self.at([x, y]) >= INK {
                continue;
            }
            let row = self.row(y);
            let from = row[..x].iter().rposition(|&value| value ^ self.flip >= INK).map_or(0, |k| k + 1);
            let to = row[x..].iter().position(|&value| value ^ self.flip >= INK).map_or(row.len(), |k| x + k);
            self.set(y, from, to);
            self.runs.push(Run { row: y as u16, from: from as u16, to: to as u16 });
            for next in self.rows_beside(y).filter(|&next| next != y) {
                let (row, flip) = (self.row(next), self.flip);
                let is_clear = |x: usize| row[x] ^ flip < INK;
                open.extend((from..to).filter(|&x| is_clear(x) && (x == from || !is_clear(x - 1))).map(|x| [x, next]));
            }
        }
    }

    /// From all that was poured in, into the rims and pockets, one ring of pixels after the other.
    fn climb(&mut self) {
        let mut open: VecDeque<(Pixel, usize)> = VecDeque::new();
        for k in 0..self.runs.len() {
            let Run { row, from, to } = self.runs[k];
            let columns = usize::from(from).saturating_sub(1)..usize::from(to) + 1;
            self.take_around(usize::from(row), columns, 1, &mut open);
        }
        while let Some(([x, y], depth)) = open.pop_front() {
            if depth < RIM {
                self.take_around(y, x.saturating_sub(1)..x + 2, depth + 1, &mut open);
                self.take_hollows([x, y], depth + 1, &mut open);
            }
        }
    }

    /// Fills what is not full yet of some columns of a row and its neighbours: pixels of a rim, and whole pockets.
    fn take_around(&mut self, row: usize, columns: Range<usize>, depth: usize, open: &mut VecDeque<(Pixel, usize)>) {
        for y in self.rows_beside(row) {
            for x in columns.start..columns.end.min(self.surface.grid.width) {
                let value = self.at([x, y]);
                let pixels = match value {
                    255 => continue,
                    INK.. => vec![[x, y]],
                    _ => self.pocket([x, y], INK, false),
                };
                for [x, y] in pixels {
                    self.set(y, x, x + 1);
                    open.push_back(([x, y], depth));
                }
            }
        }
    }

    /// Fills small hollows near a pixel of a rim that full pixels divide from it: so a sharp notch ends.
    fn take_hollows(&mut self, [x, y]: Pixel, depth: usize, open: &mut VecDeque<(Pixel, usize)>) {
        let beside = |x: usize, side: usize| x.saturating_sub(NEAR)..(x + NEAR + 1).min(side);
        for y in beside(y, self.surface.grid.height) {
            for x in beside(x, self.surface.grid.width) {
                let pixels = if self.at([x, y]) == 255 { Vec::new() } else { self.pocket([x, y], 255, true) };
                for [x, y] in pixels {
                    self.set(y, x, x + 1);
                    open.push_back(([x, y], depth));
                }
            }
        }
    }

    /// The region of values below a limit around a pixel, across corners or not, if it is small; else nothing.
    fn pocket(&self, pixel: Pixel, limit: u8, across: bool) -> Vec<Pixel> {
        let mut found = vec![pixel];
        let mut k = 0;
        while k < found.len() {
            let [x, y] = found[k];
            for below in self.rows_beside(y) {
                for right in x.saturating_sub(1)..(x + 2).min(self.surface.grid.width) {
                    let next = [right, below];
                    let is_joined = across || right == x || below == y;
                    if is_joined && self.at(next) < limit && !found.contains(&next) {
                        found.push(next);
                    }
                }
            }
            if found.len() > POCKET {
                return Vec::new();
            }
            k += 1;
        }
        found
    }

    fn row(&self, y: usize) -> &[u8] {
        &self.surface.values()[y * self.surface.grid.width..][..self.surface.grid.width]
    }

    /// A row and its neighbours.
    fn rows_beside(&self, y: usize) -> Range<usize> {
        y.saturating_sub(1)..(y + 2).min(self.surface.grid.height)
    }
}
