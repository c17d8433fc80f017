//! What is asked of a mesh.

use super::{Ground, Picture, PictureError};

/// From which coverage on a pixel is ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// Where the histogram splits best.
    Otsu,
    /// Above this share of full coverage, 0 to 1.
    At(f64),
    /// Every pixel is: the whole picture, a rectangle.
    Whole,
}

/// How large the triangles are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// Distance of neighbours `[px]`, the same everywhere: [`LEAST_SPACING`] to [`WIDEST_SPACING`].
    Spacing(f64),
    /// Finer by the boundary than inside.
    Graded {
        /// Distance of neighbours along the boundary `[px]`.
        spacing: f64,
        /// How many times as far neighbours are apart deep inside, at most: 1 to 9. It grows by sqrt(3) at a time.
        ratio: f64,
    },
    /// No triangle is larger than this `[px^2]`.
    MaxArea(f64),
}

/// What becomes of strokes that are too thin for triangles of the size asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strokes {
    /// Chains of points and bonds along their middle, tied to the mesh where the stroke meets it.
    Ropes,
    /// Drawn wider, so that they are meshed.
    Widen,
    /// Left out.
    Drop,
    /// Meshed as they are, with triangles as small as that takes.
    Mesh,
}

/// All that a mesh of a picture depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// From which coverage on a pixel is ink.
    pub threshold: Threshold,
    /// Whether what is not covered is ink instead.
    pub invert: bool,
    /// How far coverage is averaged to all sides before the threshold `[px]`, 0 to 64: the grain of a photograph, which
    /// else frays every outline.
    pub blur: u32,
    /// Whether holes are filled.
    pub fill_holes: bool,
    /// Specks and holes smaller than this are dropped `[px^2]`, 0 and up.
    pub min_area: f64,
    /// How large the triangles are.
    pub size: Size,
    /// What becomes of thin strokes.
    pub strokes: Strokes,
    /// A stroke is thin when it is narrower than this share of the spacing: 0 to 1. Down to half a spacing a strip is
    /// meshed well by one row of triangles; at 0 nothing is thin.
    pub thin: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            threshold: Threshold::Otsu,
            invert: false,
            blur: 0,
            fill_holes: false,
            min_area: 12.0,
            size: Size::Spacing(16.0),
            strokes: Strokes::Ropes,
            thin: 0.5,
        }
    }
}

/// Closest points `[px]`: closer than a pixel there is nothing to be seen in a picture.
pub const LEAST_SPACING: f64 = 1.0;

/// Farthest points `[px]`.
pub const WIDEST_SPACING: f64 = 4096.0;

/// Most points of a mesh, by an estimate before it is made.
pub const MAX_POINTS: u64 = 4_000_000;

/// Most points along the boundary, by an estimate too: each costs many times what one inside does, and what has more is
/// grain. A smooth outline of four million pixels has as many at the usual spacing.
pub(super) const MAX_EDGE_POINTS: u64 = 250_000;

/// Area of an equilateral triangle with sides of 1: sqrt(3) / 4.
pub(super) const UNIT_TRIANGLE: f64 = 0.433_012_701_892_219_3;

/// Share of the largest area allowed that a triangle of the lattice takes up: the rest is for those that fit the
/// boundary, which vary by a fifth of their sides. At more, many are split; at less, there are more than needed.
const LATTICE_SHARE: f64 = 0.62;

impl Size {
    /// Triangles of at most such an area that neighbours are about this far apart `[px]`.
    pub fn of_area(spacing: f64) -> Self {
        Size::MaxArea(spacing * spacing * UNIT_TRIANGLE / LATTICE_SHARE)
    }
}

/// Neighbours along the longer side of a picture at first: of shapes cut out of it, and of the whole picture, which has more inside.
const NEIGHBOURS: f64 = 40.0;
const NEIGHBOURS_OF_WHOLE: f64 = 24.0;

impl Settings {
    /// What is asked for where nobody has said anything: what stands out from the picture's ground, or all of it where it has none.
    pub fn of(picture: &Picture, ground: Ground) -> Self {
        let threshold = if ground == Ground::Nothing { Threshold::Whole } else { Threshold::Otsu };
        let size = Size::Spacing(Settings::first_spacing(picture, threshold));
        Settings { threshold, invert: ground == Ground::Dark, size, ..Settings::default() }
    }

    /// Distance of neighbours at first `[px]`.
    pub fn first_spacing(picture: &Picture, threshold: Threshold) -> f64 {
        let side = f64::from(picture.width.max(picture.height));
        let count = if threshold == Threshold::Whole { NEIGHBOURS_OF_WHOLE } else { NEIGHBOURS };
        (side / count).max(2.0)
    }

    /// Distance of neighbours along the boundary `[px]`.
    pub fn spacing(&self) -> f64 {
        match self.size {
            Size::Spacing(spacing) | Size::Graded { spacing, .. } => spacing,
            Size::MaxArea(area) => (LATTICE_SHARE * area / UNIT_TRIANGLE).sqrt(),
        }
    }

    /// Checks every number.
    ///
    /// Errors: a number outside of its range, or none.
    pub fn check(&self) -> Result<(), PictureError> {
        let within = |name, value: f64, least: f64, most: f64, range| {
            let is_right = (least..=most).contains(&value);
            if is_right { Ok(()) } else { Err(PictureError::Setting { name, value, range }) }
        };
        if let Threshold::At(share) = self.threshold {
            within("threshold", share, 0.0, 1.0, "it must be from 0 to 1")?;
        }
        within("min_area", self.min_area, 0.0, 1e9, "it must be from 0 to 1e9 px^2")?;
        within("blur", f64::from(self.blur), 0.0, 64.0, "it must be from 0 to 64 px")?;
        within("thin", self.thin, 0.0, 1.0, "it must be from 0 to 1")?;
        if let Size::Graded { ratio, .. } = self.size {
            within("grading", ratio, 1.0, 9.0, "it must be from 1 to 9")?;
        }
        match self.size {
            Size::MaxArea(area) => within("max_area", area, 0.7, 1e7, "it must be from 0.7 to 1e7 px^2"),
            _ => within("spacing", self.spacing(), LEAST_SPACING, WIDEST_SPACING, "it must be from 1 to 4096 px"),
        }
    }
}
