//! From a picture to a body: its ink as a mesh of even triangles, its thin strokes as ropes.
//!
//! Stages, each a function that may be called, and timed, by itself:
//! [`decode()`] reads a file, [`cover`] tells ink from paper, [`outline()`] traces it and takes thin strokes off,
//! [`boundary()`] puts points on the contours, [`fill_boundary`] fills them with triangles, [`ropes`] divides
//! the strokes, [`assemble`] puts all together, [`stats()`] measures it. [`mesh_picture`] does all but the first.
//!
//! The same picture and settings make the same bits on any machine and any number of threads.

mod atlas;
mod bits;
mod body;
mod boundary;
mod brace;
mod brush;
mod contour;
mod coverage;
mod decode;
mod error;
mod fill;
mod ground;
mod ink;
mod jpeg;
mod mesh;
mod nest;
mod outline;
mod part;
mod pen;
mod plane;
mod png;
mod rope;
mod settings;
mod skeleton;
mod skin;
mod stats;
mod strand;
mod thin;
mod tint;
mod watch;

pub use atlas::Atlas;
pub use body::{PictureMesh, assemble};
pub use boundary::{Boundary, boundary, tolerance};
pub use brace::Brace;
pub use brush::{Brush, LEAST_RADIUS, MAX_CANVAS, Mask, Mirror, WIDEST_RADIUS};
pub use contour::{Loop, contours};
pub use coverage::{Coverage, cover, otsu};
pub use decode::{MAX_BYTES, MAX_PIXELS, MAX_SIDE, Picture, decode, encode, is_picture, is_picture_name, is_svg};
pub use error::PictureError;
pub use fill::{Filling, fill_outline};
pub use ground::{Ground, ground};
pub use ink::without_paper;
pub use mesh::{Mesh, fill_boundary};
pub use nest::keep;
pub use outline::{Outline, outline};
pub use pen::Pen;
pub use plane::Point;
pub(crate) use plane::to_segment;
pub(crate) use png::{PNG_MARK, png_parts};
pub use rope::{Ropes, ropes};
pub use settings::{LEAST_SPACING, MAX_POINTS, Settings, Size, Strokes, Threshold, WIDEST_SPACING};
pub use skin::Skin;
pub use stats::{Stats, stats};
pub use strand::{Line, Node, Strands};
pub use tint::{Coat, HUES, Tint, hue};
pub use watch::{Stage, Watch};

use settings::{MAX_EDGE_POINTS, UNIT_TRIANGLE};

/// A mesh with what it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// The mesh.
    pub mesh: PictureMesh,
    /// The ink's outline.
    pub outline: Outline,
    /// The polygons of the mesh.
    pub boundary: Boundary,
    /// The threshold that was used, as a share of full coverage.
    pub threshold: f64,
}

impl Made {
    /// Measures the mesh.
    pub fn stats(&self) -> Stats {
        stats(&self.mesh, &self.outline, &self.boundary)
    }
}

/// The mesh of a picture: all stages after decoding.
///
/// Errors: a setting out of range; no ink; nothing large enough; nothing but points that no bond holds; more points than
/// [`MAX_POINTS`]; an outline too long or too grainy; one that cannot be triangulated even as it is, which no picture is known
/// to have.
pub fn mesh_picture(picture: &Picture, settings: &Settings) -> Result<Made, PictureError> {
    mesh_in_stages(picture, settings, &Watch::default(), |_| {})
}

/// The same; `watch` is told each stage before it begins and may stop it, `done` the name of each when it has ended, so that the caller
/// may time it.
///
/// Errors: as of [`mesh_picture`]; more points than `watch` wants; it was stopped.
pub fn mesh_in_stages(
    picture: &Picture,
    settings: &Settings,
    watch: &Watch,
    mut done: impl FnMut(&'static str),
) -> Result<Made, PictureError> {
    settings.check()?;
    watch.enter(Stage::Ink)?;
    let mut coverage = cover(picture, settings)?;
    let threshold = coverage.threshold();
    done("cover");
    watch.enter(Stage::Outlines)?;
    let outline = outline(&mut coverage, settings)?;
    drop(coverage);
    done("contours");
    watch.enter(Stage::Triangles)?;
    check_count(&outline, settings, watch.most_points()).inspect_err(|error| watch.note(error))?;
    let (boundary, mesh) = triangulate(&outline, settings)?;
    done("triangles");
    watch.enter(Stage::Bonds)?;
    let ropes = ropes(&outline.strands, &mesh, settings.spacing());
    let mesh = assemble([picture.width, picture.height], mesh, ropes);
    done("bonds");
    if mesh.bonds.is_empty() {
        return Err(PictureError::NoBody);
    }
    Ok(Made { mesh, outline, boundary, threshold })
}

/// The outlines and holes of a picture's ink `[px]`, y down, with as few corners as the spacing asks for; thin strokes are ink as any.
///
/// Errors: a setting out of range; no ink; nothing large enough; an outline that is mere grain.
pub fn trace_picture(picture: &Picture, settings: &Settings) -> Result<Vec<Vec<Point>>, PictureError> {
    settings.check()?;
    let settings = Settings { strokes: Strokes::Mesh, ..*settings };
    let mut coverage = cover(picture, &settings)?;
    let outline = outline(&mut coverage, &settings)?;
    check_edge(&outline, &settings)?;
    Ok(boundary(&outline.loops, settings.spacing(), 0).loops)
}

/// Strictness of the boundary at each attempt to triangulate it: as asked for, closer to the contours, the contours.
const ATTEMPTS: [u32; 4] = [0, 1, 3, 5];

/// Boundary and triangles of an outline; where triangles cannot be made, the boundary follows the contours closer.
///
/// Errors: too many points; the last attempt's.
pub fn triangulate(outline: &Outline, settings: &Settings) -> Result<(Boundary, Mesh), PictureError> {
    check_count(outline, settings, MAX_POINTS)?;
    let mut last = PictureError::Mesh(String::new());
    for strictness in ATTEMPTS {
        let boundary = boundary(&outline.loops, settings.spacing(), strictness);
        match fill_boundary(&boundary, settings) {
            Ok(mesh) => return Ok((boundary, mesh)),
            Err(error) => last = error,
        }
    }
    Err(last)
}

/// About how many points a mesh has: by the area, the length and the grain of the contours, and the strokes.
fn about_points(outline: &Outline, spacing: f64) -> u64 {
    let inside = (outline.ink_area / (2.0 * UNIT_TRIANGLE * spacing * spacing)) as u64;
    let lines = outline.strands.lines.iter().map(|line| (line.points.len() as f64 / spacing) as u64);
    let strokes = outline.strands.nodes.len() as u64 + lines.sum::<u64>();
    inside + boundary::about_points(&outline.loops, spacing) + strokes
}

/// How much wider a spacing is than the one that was tried before it.
const WIDER: f64 = 1.25;

/// Errors: more points than `limit`; a boundary that is mere grain.
fn check_count(outline: &Outline, settings: &Settings, limit: u64) -> Result<(), PictureError> {
    let spacing = settings.spacing();
    let points = about_points(outline, spacing);
    if points <= limit {
        return check_edge(outline, settings);
    }
    let spacings = std::iter::successors(Some(WIDER * spacing), |spacing| Some(WIDER * spacing));
    let mut few_enough = spacings.take_while(|&spacing| spacing < WIDEST_SPACING).map(f64::ceil);
    let would_do = few_enough.find(|&spacing| about_points(outline, spacing) <= limit);
    let spacing = (100.0 * spacing).round() / 100.0;
    Err(PictureError::TooManyPoints { spacing, points, limit, would_do })
}

fn check_edge(outline: &Outline, settings: &Settings) -> Result<(), PictureError> {
    let points = boundary::about_points(&outline.loops, settings.spacing());
    if points > MAX_EDGE_POINTS {
        return Err(PictureError::TooLongEdge { points, limit: MAX_EDGE_POINTS });
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests;
