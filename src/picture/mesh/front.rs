//! The first layer of points inside of the boundary: apexes of triangles on its edges.

use super::super::boundary::Bins;
use super::super::plane::{Point, between, distance, dot, minus, to_segment, turn};

/// Height of a point above its edge, in lengths of the edge: that of an equilateral triangle.
const HEIGHT: f64 = 0.87;

/// Least distance from any edge, in heights: below that it would be another edge's apex, or outside.
const CLEAR: f64 = 0.75;

/// Least distance from other points of the front, in lengths of the edge. Where the front is shorter than the boundary,
/// as inside of a bend, points give way.
const APART: f64 = 0.7;

/// The points of the front, each with the length of its edge, and all edges.
pub(super) fn front(loops: &[Vec<Point>], spacing: f64) -> (Vec<(Point, f64)>, Vec<[Point; 2]>) {
    let edges: Vec<[Point; 2]> = loops.iter().flat_map(|points| edges(points)).collect();
    let bins = Bins::new(&edges, spacing);
    let mut candidates = Vec::with_capacity(edges.len());
    for (k, &[a, b]) in edges.iter().enumerate() {
        let along = minus(b, a);
        let length = dot(along, along).sqrt();
        let middle = between(a, b, 0.5);
        let apex = [middle[0] - HEIGHT * along[1], middle[1] + HEIGHT * along[0]];
        let is_clear = bins.near([apex, apex], HEIGHT * length).filter(|&other| other != k).all(|other| {
            let (off, _) = to_segment(apex, edges[other]);
            let is_inside = turn(edges[other][0], edges[other][1], apex) > 0.0;
            off > HEIGHT * length || is_inside && off >= CLEAR * HEIGHT * length
        });
        if is_clear {
            candidates.push((apex, length));
        }
    }
    (spread(candidates, spacing), edges)
}

/// Edges of a closed polygon.
fn edges(points: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    (0..points.len()).map(|k| [points[k], points[(k + 1) % points.len()]])
}

/// Drops points that are too near to an earlier one.
fn spread(candidates: Vec<(Point, f64)>, spacing: f64) -> Vec<(Point, f64)> {
    let segments: Vec<[Point; 2]> = candidates.iter().map(|&(point, _)| [point, point]).collect();
    let bins = Bins::new(&segments, spacing);
    let mut is_kept = vec![false; candidates.len()];
    for (k, &(point, length)) in candidates.iter().enumerate() {
        let reach = APART * length;
        is_kept[k] = bins
            .near(segments[k], reach)
            .all(|other| other == k || !is_kept[other] || distance(point, candidates[other].0) >= reach);
    }
    candidates.into_iter().zip(is_kept).filter(|(_, is_kept)| *is_kept).map(|(one, _)| one).collect()
}
