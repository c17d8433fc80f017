//! A canvas that one paints by hand: ink as coverage of pixels, round brushes, fills, and steps to be taken back.
//!
//! There is no window in it. A pointer's press, moves and release become [`Mask::begin`], [`Mask::drag_to`] and
//! [`Mask::end`]; [`Mask::changed`] tells what to draw again; [`Mask::to_picture`] hands the ink to the mesh.

mod capsule;
mod flood;
mod history;
mod surface;

use super::{Coverage, Picture, PictureError, Point, Settings, Threshold, cover};
use capsule::Capsule;
use flood::flood;
use history::Grid;
use surface::Surface;

/// Longest side of a canvas `[px]`: its pixels take 16 MiB, its history 64 MiB, a step under way 16 MiB at most.
pub const MAX_CANVAS: u32 = 4096;

/// Thinnest brush `[px]`: a line of one pixel.
pub const LEAST_RADIUS: f64 = 0.5;

/// Thickest brush `[px]`.
pub const WIDEST_RADIUS: f64 = 512.0;

/// Coverage from which on the ink of a stroke hides what is below it.
const HALF: u8 = 128;

/// Farthest place of a pointer, either way `[px]`: farther ones are moved here, where a pixel's fraction is still exact
/// to nine digits.
const FARTHEST: f64 = 1e6;

/// What paints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Radius `[px]`, [`LEAST_RADIUS`] to [`WIDEST_RADIUS`]; one outside is moved to the nearer end, no number to the
    /// least.
    pub radius: f64,
    /// Whether it takes ink away.
    pub erases: bool,
}

impl Default for Brush {
    fn default() -> Self {
        Brush { radius: 12.0, erases: false }
    }
}

/// Where strokes and fills are repeated, mirrored about the middle of the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mirror {
    /// Nowhere.
    #[default]
    None,
    /// Left is right.
    Vertical,
    /// Top is bottom.
    Horizontal,
    /// In all four quarters.
    Both,
}

impl Mirror {
    /// Whether each copy has its left and right, and its top and bottom, exchanged.
    fn copies(self) -> &'static [[bool; 2]] {
        match self {
            Mirror::None => &[[false, false]],
            Mirror::Vertical => &[[false, false], [true, false]],
            Mirror::Horizontal => &[[false, false], [false, true]],
            Mirror::Both => &[[false, false], [true, false], [false, true], [true, true]],
        }
    }
}

/// A stroke that has not ended.
#[derive(Debug)]
struct Stroke {
    brush: Brush,
    /// Where it has come to, if anywhere yet.
    at: Option<Point>,
}

/// Ink on a canvas, painted by hand.
///
/// Model: each pixel holds how much of it is covered, 0 to 255. Its middle lies at (x + 1/2, y + 1/2). What is painted
/// is joined to what is there by the larger coverage, so that neither a stroke that crosses itself nor a second one
/// makes an edge darker; what is erased leaves the smaller of what is there and what the eraser does not cover.
#[derive(Debug)]
pub struct Mask {
    /// Where strokes and fills are repeated from now on.
    pub mirror: Mirror,
    surface: Surface,
    stroke: Option<Stroke>,
    /// Coverage of one row of a stroke; kept for its memory.
    line: Vec<u8>,
}

impl Mask {
    /// A clear canvas.
    ///
    /// Errors: a side of 0 or above [`MAX_CANVAS`] px.
    pub fn new(width: u32, height: u32) -> Result<Self, PictureError> {
        let range = 1..=MAX_CANVAS;
        if !range.contains(&width) || !range.contains(&height) {
            return Err(PictureError::Canvas { width, height, side: MAX_CANVAS });
        }
        let grid = Grid { width: width as usize, height: height as usize };
        Ok(Mask::of(grid, vec![0; grid.width * grid.height]))
    }

    /// A canvas with the ink of a picture: its alpha where any pixel is not opaque, else its darkness.
    ///
    /// Errors: as for [`Mask::new`].
    pub fn from_picture(picture: &Picture) -> Result<Self, PictureError> {
        let clear = Mask::new(picture.width, picture.height)?;
        let settings = Settings { threshold: Threshold::At(0.0), ..Settings::default() };
        match cover(picture, &settings) {
            Ok(Coverage { values, .. }) => Ok(Mask::of(clear.surface.grid, values)),
            Err(PictureError::Empty { .. }) => Ok(clear),
            Err(error) => Err(error),
        }
    }

    fn of(grid: Grid, values: Vec<u8>) -> Self {
        Mask { mirror: Mirror::None, surface: Surface::new(grid, values), stroke: None, line: Vec::new() }
    }

    /// Width and height `[px]`.
    pub fn size(&self) -> [u32; 2] {
        [self.surface.grid.width as u32, self.surface.grid.height as u32]
    }

    /// Coverage of each pixel, row by row from the top.
    pub fn coverage(&self) -> &[u8] {
        self.surface.values()
    }

    /// The number of the ink that strokes and fills have from now on, 0 at first: what colours numbers stand for is for whoever shows them.
    pub fn set_ink(&mut self, number: u8) {
        self.surface.ink = number;
    }

    /// The number of each pixel's ink, as [`Mask::coverage`]; empty: 0 everywhere.
    ///
    /// Model: a pixel is of the last ink that covered half of it, or more of it than was covered before.
    pub fn inks(&self) -> &[u8] {
        self.surface.inks()
    }

    /// A number that increases with every change.
    pub fn version(&self) -> u64 {
        self.surface.version()
    }

    /// What changed since this was last asked `[px]`: left, top, width, height. At first it is the whole canvas.
    pub fn changed(&mut self) -> Option<[u32; 4]> {
        let [left, top, right, bottom] = self.surface.take_changed()?;
        Some([left, top, right - left, bottom - top].map(|side| side as u32))
    }

    /// The ink as a picture that the mesh can be made of: of one colour, with coverage as alpha.
    ///
    /// Valid range: a canvas that is ink all over has no transparent pixel, and [`cover`] then goes by darkness: to be
    /// seen there, its colour has to be dark.
    pub fn to_picture(&self, [red, green, blue]: [u8; 3]) -> Picture {
        let [width, height] = self.size();
        let rgba = self.coverage().iter().flat_map(|&alpha| [red, green, blue, alpha]).collect();
        Picture { width, height, rgba }
    }

    /// Sets the brush down: a stroke begins, and one that had not ended does.
    ///
    /// Valid range: any place, on the canvas or off it `[px]`. One that is no number is waited out: the stroke begins
    /// where the brush is dragged to.
    pub fn begin(&mut self, brush: Brush, at: Point) {
        self.end();
        let radius = if brush.radius.is_nan() { LEAST_RADIUS } else { brush.radius };
        let radius = radius.clamp(LEAST_RADIUS, WIDEST_RADIUS);
        self.stroke = Some(Stroke { brush: Brush { radius, ..brush }, at: None });
        self.drag_to(at);
    }

    /// Draws the stroke on, straight to a place `[px]`.
    ///
    /// Valid range: any place; one that is no number or infinite is left out. Without a stroke nothing happens.
    pub fn drag_to(&mut self, at: Point) {
        let Some(stroke) = &mut self.stroke else { return };
        if !at.iter().all(|x| x.is_finite()) {
            return;
        }
        let at = at.map(|x| x.clamp(-FARTHEST, FARTHEST));
        let from = stroke.at.replace(at).unwrap_or(at);
        let Brush { radius, erases } = stroke.brush;
        self.draw(&Capsule::new([from, at], radius), erases);
    }

    /// Lifts the brush: the stroke is a step that can be taken back, unless it changed nothing.
    pub fn end(&mut self) {
        if self.stroke.take().is_some() {
            self.surface.commit();
        }
    }

    /// Fills the clear region around a place `[px]` with ink, or with an eraser the ink around it with clear, and so it
    /// does in mirrored places.
    ///
    /// Model: a region is 4-connected, of pixels on the same side of 128. The rims of strokes around it are filled up
    /// to where they are full, so that no seam shows; so are pockets of up to 8 pixels that it touches across corners.
    /// Valid range: off the canvas, or on the wrong side of 128, nothing is filled. The brush's radius plays no part.
    pub fn fill(&mut self, brush: Brush, at: Point) {
        self.end();
        let Grid { width, height } = self.surface.grid;
        let is_within = |x: f64, side: usize| (0.0..side as f64).contains(&x);
        if !is_within(at[0], width) || !is_within(at[1], height) {
            return;
        }
        let [x, y] = [at[0] as usize, at[1] as usize];
        let turned = |&[x_turned, y_turned]: &[bool; 2]| {
            [if x_turned { width - 1 - x } else { x }, if y_turned { height - 1 - y } else { y }]
        };
        let pixels: Vec<[usize; 2]> = self.mirror.copies().iter().map(turned).collect();
        flood(&mut self.surface, &pixels, brush.erases);
        self.surface.commit();
    }

    /// Takes all ink away, as one step.
    pub fn clear(&mut self) {
        self.end();
        self.surface.change_all(|_| 0);
        self.surface.commit();
    }

    /// Makes ink of what is clear and takes the ink away, as one step.
    pub fn invert(&mut self) {
        self.end();
        self.surface.change_all(|value| 255 - value);
        self.surface.commit();
    }

    /// Takes the last step back; whether there was one. A stroke that has not ended ends, and is the last step.
    pub fn undo(&mut self) -> bool {
        self.end();
        self.surface.undo()
    }

    /// Does the step that was taken back last once more; whether there was one.
    pub fn redo(&mut self) -> bool {
        self.end();
        self.surface.redo()
    }

    /// Whether there is a step to take back. A stroke is none before it ends. The oldest steps are forgotten when all
    /// of them hold more than 64 MiB.
    pub fn can_undo(&self) -> bool {
        self.surface.has_steps()[0]
    }

    /// Whether a step was taken back and nothing was changed since.
    pub fn can_redo(&self) -> bool {
        self.surface.has_steps()[1]
    }

    /// Draws a part of a stroke and its mirrored copies, which have the same bits for they are worked out once.
    fn draw(&mut self, capsule: &Capsule, erases: bool) {
        let Grid { width, height } = self.surface.grid;
        let join = if erases { take_away } else { put_on };
        for row in capsule.rows(height) {
            let columns = capsule.cover(row, width, &mut self.line);
            let mut is_reversed = false;
            for &[x_turned, y_turned] in self.mirror.copies() {
                if x_turned != is_reversed {
                    self.line.reverse();
                    is_reversed = x_turned;
                }
                let row = if y_turned { height - 1 - row } else { row };
                let columns = if x_turned { width - columns.end..width - columns.start } else { columns.clone() };
                if !erases {
                    let line = &self.line;
                    self.surface.dye(row, columns.clone(), |k, old| line[k] >= HALF || line[k] > old);
                }
                self.surface.change(row, columns, |run| join(run, &self.line));
            }
        }
    }
}

/// The larger coverage of each pixel; whether any changed.
fn put_on(run: &mut [u8], line: &[u8]) -> bool {
    let mut differs = 0;
    for (old, &new) in run.iter_mut().zip(line) {
        let joined = new.max(*old);
        differs |= joined ^ *old;
        *old = joined;
    }
    differs != 0
}

/// The smaller of what is there and what is not covered; whether any changed.
fn take_away(run: &mut [u8], line: &[u8]) -> bool {
    let mut differs = 0;
    for (old, &new) in run.iter_mut().zip(line) {
        let joined = (255 - new).min(*old);
        differs |= joined ^ *old;
        *old = joined;
    }
    differs != 0
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests;
