//! Loops that cross: edges are cut where they do, and what lies between them is in or out as a whole.

use spade::handles::{FixedFaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::{Filling, Ring, crossings};
use crate::picture::Point;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Face = FixedFaceHandle<InnerTag>;

/// The triangles between the edges that an odd number of loops runs around; `points` are those of all loops.
///
/// `None`: a coordinate is too large or too small for a triangulation.
pub(super) fn fill(rings: &[Ring], mut points: Vec<Point>) -> Option<Filling> {
    let mut numbers = Vec::new();
    let cdt = cut(rings, &mut numbers)?;
    // The points at which edges cross come last.
    for vertex in cdt.fixed_vertices().skip(numbers.len()) {
        numbers.push(points.len() as u32);
        let at = cdt.vertex(vertex).position();
        points.push([at.x, at.y]);
    }
    let mut triangles = Vec::new();
    let mut is_seen = vec![false; cdt.num_all_faces()];
    for first in cdt.fixed_inner_faces() {
        if is_seen[first.index()] {
            continue;
        }
        let part = part(&cdt, first, &mut is_seen);
        if is_inside(rings, &cdt, &part) {
            let corners = |&face: &Face| cdt.face(face).vertices().map(|vertex| numbers[vertex.index()]);
            triangles.extend(part.iter().map(corners));
        }
    }
    Some(Filling { points, triangles })
}

/// All edges in one triangulation, cut where they cross. `numbers` are those of its points among the points of all loops.
fn cut(rings: &[Ring], numbers: &mut Vec<u32>) -> Option<Cdt> {
    let mut cdt = Cdt::new();
    let mut handles = Vec::new();
    for ring in rings {
        for (k, &[x, y]) in (ring.first..).zip(ring.points) {
            let handle = cdt.insert(Point2::new(x, y)).ok()?;
            // A point that is there already is the same one.
            if handle.index() == numbers.len() {
                numbers.push(k as u32);
            }
            handles.push(handle);
        }
    }
    let mut start = 0;
    for ring in rings {
        let corners = &handles[start..start + ring.points.len()];
        start += corners.len();
        for (k, &from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            if from != to {
                cdt.add_constraint_and_split(from, to, |at| at);
            }
        }
    }
    Some(cdt)
}

/// The triangles that can be reached from one without crossing an edge of a loop.
fn part(cdt: &Cdt, first: Face, is_seen: &mut [bool]) -> Vec<Face> {
    is_seen[first.index()] = true;
    let mut part = vec![first];
    let mut next = 0;
    while let Some(&face) = part.get(next) {
        next += 1;
        for edge in cdt.face(face).adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge()) {
            if let Some(beyond) = edge.rev().face().as_inner()
                && !std::mem::replace(&mut is_seen[beyond.index()], true)
            {
                part.push(beyond.fix());
            }
        }
    }
    part
}

/// Whether the middle of its largest triangle lies inside of an odd number of loops.
fn is_inside(rings: &[Ring], cdt: &Cdt, part: &[Face]) -> bool {
    let area = |face: &&Face| cdt.face(**face).area();
    let Some(&largest) = part.iter().max_by(|a, b| area(a).total_cmp(&area(b))) else { return false };
    let middle = cdt.face(largest).center();
    let to_the_left = |ring: &Ring| crossings(ring.points, middle.y).filter(|&x| x < middle.x).count();
    rings.iter().map(to_the_left).sum::<usize>() % 2 == 1
}
