//! How good a mesh is.

use super::PictureMesh;
use super::boundary::Boundary;
use super::outline::Outline;
use super::plane::{Point, angle_at, distance, turn};

/// Measures of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// Points, those of ropes among them.
    pub points: usize,
    /// Triangles.
    pub triangles: usize,
    /// Bonds: sides of triangles and bonds of ropes.
    pub bonds: usize,
    /// The smallest angle of any triangle `[degrees]`; 0 without triangles.
    pub min_angle_deg: f64,
    /// One in a hundred of all angles of all triangles is below this `[degrees]`.
    pub p1_angle_deg: f64,
    /// Standard deviation of the sides of triangles over their mean.
    pub edge_cv: f64,
    /// The shortest side of a triangle `[px]`.
    pub shortest_edge: f64,
    /// Area of the triangles `[px^2]`.
    pub area_px: f64,
    /// Area inside of the contours that were to be meshed `[px^2]`.
    pub ink_px: f64,
    /// |area - ink| / ink; 0 without ink.
    pub area_error: f64,
    /// Largest distance between contour and boundary, both ways `[px]`.
    pub boundary_deviation_px: f64,
    /// Connected parts of the mesh and its ropes.
    pub components: usize,
    /// Independent rings in them that no triangles fill: parts + sides - points - triangles.
    pub holes: usize,
    /// Connected parts of the ink, after specks were dropped.
    pub ink_components: usize,
    /// Holes of the ink.
    pub ink_holes: usize,
}

/// Measures a mesh against what it was made from.
pub fn stats(mesh: &PictureMesh, outline: &Outline, boundary: &Boundary) -> Stats {
    let at = |k: u32| mesh.points[k as usize];
    let corners = |k: &[u32; 3]| k.map(at);
    let mut angles: Vec<f64> = mesh.triangles.iter().flat_map(|k| angles(corners(k))).collect();
    let rank = angles.len() / 100;
    let p1_angle_deg = if angles.is_empty() { 0.0 } else { *angles.select_nth_unstable_by(rank, f64::total_cmp).1 };
    let sides: Vec<f64> = mesh.bonds[..mesh.mesh_bonds].iter().map(|&[a, b]| distance(at(a), at(b))).collect();
    let area_px: f64 = mesh.triangles.iter().map(corners).map(|[a, b, c]| 0.5 * turn(a, c, b)).sum();
    // The sum of nothing is -0.
    let (area_px, ink_px) = (area_px + 0.0, outline.ink_area + 0.0);
    Stats {
        points: mesh.points.len(),
        triangles: mesh.triangles.len(),
        bonds: mesh.bonds.len(),
        min_angle_deg: angles.iter().copied().reduce(f64::min).unwrap_or(0.0),
        p1_angle_deg,
        edge_cv: variation(&sides),
        shortest_edge: sides.iter().copied().reduce(f64::min).unwrap_or(0.0),
        area_px,
        ink_px,
        area_error: if ink_px > 0.0 { (area_px - ink_px).abs() / ink_px } else { 0.0 },
        boundary_deviation_px: boundary.deviation,
        components: mesh.components,
        holes: (mesh.components + mesh.bonds.len()).saturating_sub(mesh.points.len() + mesh.triangles.len()),
        ink_components: outline.components,
        ink_holes: outline.holes,
    }
}

fn angles([a, b, c]: [Point; 3]) -> [f64; 3] {
    [angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)]
}

/// Standard deviation over mean; 0 of nothing.
fn variation(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count;
    square.sqrt() / mean
}
