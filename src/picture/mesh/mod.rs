//! Polygons to triangles: a layer of points along the boundary, a lattice inside, Delaunay between, then polish.

mod delaunay;
mod front;
mod lattice;
mod smooth;

use super::boundary::Boundary;
use super::plane::Point;
use super::{PictureError, Settings, Size};
use delaunay::{Filled, Load, fill};
use front::front;
use lattice::Lattice;
use smooth::smooth;

/// Points and triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Points: the loops' first, one loop after the other, then the inner ones `[px]`.
    pub points: Vec<Point>,
    /// Corners of the triangles, turning left in (x, y): clockwise as seen, for y points down.
    pub triangles: Vec<[u32; 3]>,
    /// Points of each loop in order; the ink lies to the left in (x, y).
    pub loops: Vec<Vec<u32>>,
}

/// Sweeps of smoothing: the fourth moves next to nothing.
const SWEEPS: usize = 3;

/// Fills polygons with triangles of the size asked for.
///
/// Model: a front of points one layer inside of the boundary, a hexagonal lattice beyond it, the constrained Delaunay
/// triangulation of both, refined until no angle is below 30 degrees (or the budget is spent), smoothed. Far from the
/// boundary the triangles of a uniform lattice are known beforehand; there nothing is triangulated.
///
/// Errors: the polygons cross, lie in each other in the wrong way, or are too finely cut to be triangulated.
pub fn fill_boundary(boundary: &Boundary, settings: &Settings) -> Result<Mesh, PictureError> {
    if boundary.loops.is_empty() {
        return Ok(Mesh::default());
    }
    let mut last = PictureError::Mesh(String::new());
    for known_from in KNOWN_FROM {
        match fill_with(boundary, settings, known_from) {
            Err(error @ PictureError::Mesh(_)) => last = error,
            other => return other,
        }
    }
    Err(last)
}

/// Rows from the end of the lattice after which its triangles are taken for known, at each attempt: few rows are quick,
/// but a boundary with fine bends is refined deeper. At last none is.
const KNOWN_FROM: [Option<u8>; 3] = [Some(4), Some(12), None];

fn fill_with(boundary: &Boundary, settings: &Settings, known_from: Option<u8>) -> Result<Mesh, PictureError> {
    let spacing = settings.spacing();
    let (front, edges) = front(&boundary.loops, spacing);
    let mut lattice = Lattice::new(&boundary.loops, spacing);
    lattice.clear(&edges, &front);
    let mut load = Load::new(&boundary.loops, front);
    if let Size::Graded { ratio, .. } = settings.size {
        lattice.thin_out(ratio);
    }
    match known_from {
        Some(rows) if !matches!(settings.size, Size::Graded { .. }) => load.add_lattice_but_known(&mut lattice, rows),
        _ => {
            load.add_lattice(&lattice);
        }
    }
    let max_area = if let Size::MaxArea(area) = settings.size { Some(area) } else { None };
    let mut filled = fill(load, spacing, max_area)?;
    for _ in 0..SWEEPS {
        smooth(&mut filled, max_area);
    }
    number(filled)
}

/// Numbers points anew: loop by loop along the boundary of the triangles, then those inside; points of no triangle go.
fn number(filled: Filled) -> Result<Mesh, PictureError> {
    const NONE: u32 = u32::MAX;
    let next = boundary_next(&filled)?;
    let mut numbers = vec![NONE; filled.points.len()];
    let (mut points, mut loops) = (Vec::with_capacity(filled.points.len()), Vec::new());
    for start in 0..next.len() {
        let mut one = Vec::new();
        let mut at = start;
        while next[at] != NONE && numbers[at] == NONE {
            numbers[at] = points.len() as u32;
            one.push(points.len() as u32);
            points.push(filled.points[at]);
            at = next[at] as usize;
        }
        if !one.is_empty() {
            loops.push(one);
        }
    }
    for &corner in filled.triangles.iter().flatten() {
        let number = &mut numbers[corner as usize];
        if *number == NONE {
            *number = NONE - 1;
        }
    }
    for (number, &point) in numbers.iter_mut().zip(&filled.points) {
        if *number == NONE - 1 {
            *number = points.len() as u32;
            points.push(point);
        }
    }
    let triangles = filled.triangles.iter().map(|corners| corners.map(|k| numbers[k as usize])).collect();
    Ok(Mesh { points, triangles, loops })
}

/// The point that follows each along the boundary; `u32::MAX` for those inside.
///
/// Errors: a point has two: parts of the mesh touch in it.
fn boundary_next(filled: &Filled) -> Result<Vec<u32>, PictureError> {
    let mut next = vec![u32::MAX; filled.points.len()];
    for &[from, to] in &filled.rim {
        let place = &mut next[from as usize];
        if *place != u32::MAX {
            return Err(PictureError::Mesh("parts of it touch in a point".into()));
        }
        *place = to;
    }
    Ok(next)
}
