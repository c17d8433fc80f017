//! From coverage to what is meshed: contours that were kept, and the lines of thin strokes.

use super::bits::Bits;
use super::boundary::about_points;
use super::contour::{Loop, contours_of};
use super::nest::keep;
use super::strand::{Strands, strands};
use super::thin::{Pixel, Thin, thin_parts};
use super::{Coverage, PictureError, Settings, Strokes};

/// What is to be meshed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Contours of the ink that is meshed: outlines and holes.
    pub loops: Vec<Loop>,
    /// The lines of thin strokes.
    pub strands: Strands,
    /// Connected parts of the ink, strokes included, after specks were dropped.
    pub components: usize,
    /// Holes in it.
    pub holes: usize,
    /// Area inside of the loops `[px^2]`.
    pub ink_area: f64,
}

/// Width to which thin strokes are widened, in spacings: two rows of triangles would want more, one row needs no more.
const WIDENED: f64 = 0.8;

/// Traces the ink, drops what is small, and takes thin strokes off it.
///
/// The coverage becomes that of what is meshed.
///
/// Errors: nothing was large enough to be kept; nothing but strokes, which are dropped.
pub fn outline(coverage: &mut Coverage, settings: &Settings) -> Result<Outline, PictureError> {
    let ink = Bits::ink(coverage);
    let found = contours_of(coverage, &ink);
    let count = found.len();
    let loops = keep(coverage, found, settings.min_area, settings.fill_holes);
    let components = loops.iter().filter(|one| one.area > 0.0).count();
    if components == 0 {
        return Err(PictureError::Dropped { min_area: settings.min_area });
    }
    check_grain(&loops, settings)?;
    let holes = loops.len() - components;
    let ink = if loops.len() < count { Bits::ink(coverage) } else { ink };
    let (loops, strands) = take_strokes(coverage, loops, ink, settings);
    if loops.is_empty() && settings.strokes == Strokes::Drop {
        return Err(PictureError::Thin);
    }
    let ink_area = loops.iter().map(|one| one.area).sum();
    Ok(Outline { loops, strands, components, holes, ink_area })
}

/// Most points along all contours, strokes included, by an estimate: what has more is grain, and its strokes alone would take minutes.
const MOST_GRAIN: u64 = 1_000_000;

/// Errors: contours that are mere grain.
fn check_grain(loops: &[Loop], settings: &Settings) -> Result<(), PictureError> {
    let points = about_points(loops, settings.spacing());
    if points > MOST_GRAIN {
        return Err(PictureError::TooLongEdge { points, limit: MOST_GRAIN });
    }
    Ok(())
}

/// Deals with thin strokes; the loops are traced again where there were any.
fn take_strokes(coverage: &mut Coverage, loops: Vec<Loop>, mut ink: Bits, settings: &Settings) -> (Vec<Loop>, Strands) {
    let none = Strands::default();
    let spacing = settings.spacing();
    let Thin { strokes, hairs } = match settings.strokes {
        Strokes::Mesh => return (loops, none),
        _ => thin_parts(&ink, (settings.thin * spacing).round() as usize, spacing),
    };
    if strokes.is_empty() && hairs.is_empty() {
        return (loops, none);
    }
    hairs.iter().for_each(|&[x, y]| ink.set(x, y, false));
    let found = strands(&mut ink, &strokes, spacing);
    wipe(coverage, &ink, strokes.iter().flatten().chain(&hairs));
    if settings.strokes == Strokes::Widen {
        widen(coverage, &found, WIDENED * spacing);
    }
    let loops = contours_of(coverage, &Bits::ink(coverage));
    (loops, if settings.strokes == Strokes::Ropes { found } else { none })
}

/// Wipes pixels and the faint ones around them, but for thick ink.
fn wipe<'a>(coverage: &mut Coverage, thick: &Bits, pixels: impl Iterator<Item = &'a Pixel>) {
    let (width, height) = (coverage.width, coverage.height);
    for &[x, y] in pixels {
        for v in y.max(2) - 1..=(y + 1).min(height) {
            for u in x.max(2) - 1..=(x + 1).min(width) {
                if !thick.get(u, v) {
                    coverage.values[(v - 1) * width + u - 1] = 0;
                }
            }
        }
    }
}

/// Draws lines anew, with smooth edges, in this width `[px]`.
fn widen(coverage: &mut Coverage, strands: &Strands, width: f64) {
    let reach = 0.5 * width + 1.0;
    let points = strands.lines.iter().flat_map(|line| &line.points).chain(strands.nodes.iter().map(|node| &node.place));
    for &[x, y] in points {
        let range = |at: f64, size: usize| (at - reach).max(0.0) as usize..((at + reach).max(0.0) as usize).min(size);
        for v in range(y, coverage.height) {
            for u in range(x, coverage.width) {
                let (dx, dy) = (u as f64 + 0.5 - x, v as f64 + 0.5 - y);
                let share = (0.5 * width + 0.5 - (dx * dx + dy * dy).sqrt()).clamp(0.0, 1.0);
                let value = &mut coverage.values[v * coverage.width + u];
                *value = (*value).max((255.0 * share) as u8);
            }
        }
    }
}
