//! Outlines with holes to triangles that fill them, for drawing: as few as there can be, of any shape.

mod crossed;

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::Point;
use super::plane::{dot, doubled_area, minus, turn};

/// A loop with less than this share of the square about it is a line `[1]`: what rounding leaves of one is below 1e-15,
/// and a strip of a thousand pixels by a millionth of one is still filled.
const LEAST_SHARE: f64 = 1e-12;

/// A closed loop, the last point followed by the first.
struct Ring<'a> {
    points: &'a [Point],
    /// Number of its first point among those of all loops.
    first: usize,
    /// `[px^2]`
    area: f64,
    /// Left, top, right, bottom `[px]`.
    bounds: [f64; 4],
    /// A place inside.
    inside: Point,
}

/// Triangles that fill outlines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filling {
    /// The points of all loops in their order, `loops.concat()`, then those where edges cross `[px]`.
    pub points: Vec<Point>,
    /// Triangles, by the numbers of their points. How they turn is not defined.
    pub triangles: Vec<[u32; 3]>,
}

/// Triangles that fill the outlines by the even-odd rule: a loop in a loop is a hole, one in a hole is filled again, and
/// of loops that cross each other or themselves what an odd number of them runs around is filled.
///
/// Valid range: any loops; they may touch. Loops of fewer than 3 points, along a line, or with a coordinate that is no
/// number or infinite are left out, and so is an outline that cannot be divided.
/// Accuracy: the areas of triangles sum up to that of the outline but for rounding, and they do not overlap, see the tests.
/// Cost: n log n for n points of an outline with its holes as a rule, n^2 at worst; m^2 for m loops, to tell what lies
/// in what. Where edges cross, n for each part that they cut the plane into, too.
pub fn fill_outline(loops: &[Vec<Point>]) -> Filling {
    let rings = rings(loops);
    let points = loops.concat();
    if cross(&rings) {
        // Should it ever panic on numbers that are next to each other, that is no reason for us to.
        let filled = catch_unwind(AssertUnwindSafe(|| crossed::fill(&rings, points.clone())));
        return filled.ok().flatten().unwrap_or(Filling { points, triangles: Vec::new() });
    }
    let around = containers(&rings);
    let mut triangles = Vec::new();
    for (k, outer) in rings.iter().enumerate().filter(|&(k, _)| around[k].0.is_multiple_of(2)) {
        let holes = rings.iter().zip(&around).filter(|(_, (depth, within))| depth % 2 == 1 && *within == Some(k));
        let family: Vec<&Ring> = std::iter::once(outer).chain(holes.map(|(ring, _)| ring)).collect();
        triangles.extend(divide(&family));
    }
    Filling { points, triangles }
}

/// The loops that have area, largest first.
fn rings(loops: &[Vec<Point>]) -> Vec<Ring<'_>> {
    let mut first = 0;
    let mut rings = Vec::new();
    for points in loops {
        rings.extend(ring(points, first));
        first += points.len();
    }
    rings.sort_by(|a, b| b.area.total_cmp(&a.area));
    rings
}

fn ring(points: &[Point], first: usize) -> Option<Ring<'_>> {
    if points.len() < 3 || !points.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for &[x, y] in points {
        bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
    }
    let area = 0.5 * doubled_area(points).abs();
    let side = (bounds[2] - bounds[0]).max(bounds[3] - bounds[1]);
    // Of a loop that crosses itself parts may cancel each other: their sizes count. A product that overflows is no
    // number or infinite, and fails too.
    let swept: f64 = points.windows(2).map(|pair| 0.5 * turn(points[0], pair[0], pair[1]).abs()).sum();
    let has_area = swept.is_finite() && swept > LEAST_SHARE * side * side;
    let inside = has_area.then(|| inside(points, bounds)).flatten()?;
    Some(Ring { points, first, area, bounds, inside })
}

/// A place inside of a loop: amid its widest stretch on a level line near its middle that meets no point of it.
fn inside(points: &[Point], [_, top, _, bottom]: [f64; 4]) -> Option<Point> {
    let middle = 0.5 * (top + bottom);
    // Between the points next above the middle and next below it there are none.
    let above = points.iter().map(|p| p[1]).filter(|&y| y <= middle).fold(top, f64::max);
    let below = points.iter().map(|p| p[1]).filter(|&y| y > middle).fold(bottom, f64::min);
    let y = 0.5 * (above + below);
    let mut crossings: Vec<f64> = crossings(points, y).collect();
    crossings.sort_by(f64::total_cmp);
    let (pairs, _) = crossings.as_chunks::<2>();
    let widest = pairs.iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    Some([0.5 * (widest[0] + widest[1]), y])
}

/// Where a loop crosses the level line at `y`.
fn crossings(points: &[Point], y: f64) -> impl Iterator<Item = f64> + '_ {
    let before = points.iter().cycle().skip(points.len() - 1);
    before.zip(points).filter(move |(a, b)| (a[1] <= y) != (b[1] <= y)).map(move |(a, b)| {
        // From the same end whichever way the loop turns, so that loops along the same edge cross at the same place.
        let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    })
}

/// How many rings each one lies in, and the smallest of them. A ring may lie only in those before it, which are larger.
fn containers(rings: &[Ring]) -> Vec<(usize, Option<usize>)> {
    let around = |(k, ring): (usize, &Ring)| {
        let within = (0..k).filter(|&m| contains(&rings[m], ring.inside));
        within.fold((0, None), |(depth, _), m| (depth + 1, Some(m)))
    };
    rings.iter().enumerate().map(around).collect()
}

fn contains(ring: &Ring, [x, y]: Point) -> bool {
    let [left, top, right, bottom] = ring.bounds;
    (left..=right).contains(&x)
        && (top..=bottom).contains(&y)
        && crossings(ring.points, y).filter(|&crossing| crossing < x).count() % 2 == 1
}

/// Edges that cross by less than this share of their lengths touch `[1]`: rounding is below 1e-12 where coordinates are
/// not far larger than the outline.
const LEAST_CROSSING: f64 = 1e-9;

/// Whether any two edges of some rings cross: each is compared with those that start above its end.
fn cross(rings: &[Ring]) -> bool {
    let edges_of = |ring: &Ring| {
        let before = ring.points.iter().cycle().skip(ring.points.len() - 1);
        before.zip(ring.points).map(|(&a, &b)| if a[1] <= b[1] { [a, b] } else { [b, a] }).collect::<Vec<_>>()
    };
    let mut edges: Vec<[Point; 2]> = rings.iter().flat_map(edges_of).collect();
    edges.sort_by(|a, b| a[0][1].total_cmp(&b[0][1]));
    let mut active: Vec<[Point; 2]> = Vec::new();
    edges.iter().any(|&edge| {
        active.retain(|other| other[1][1] >= edge[0][1]);
        let is_crossed = active.iter().any(|&other| do_cross(edge, other));
        active.push(edge);
        is_crossed
    })
}

fn do_cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let [ab, cd] = [minus(b, a), minus(d, c)];
    let least = LEAST_CROSSING * dot(ab, ab).max(dot(cd, cd));
    let is_between = |one: f64, other: f64| one.min(other) < -least && one.max(other) > least;
    a[0].min(b[0]) <= c[0].max(d[0])
        && c[0].min(d[0]) <= a[0].max(b[0])
        && is_between(turn(a, b, c), turn(a, b, d))
        && is_between(turn(c, d, a), turn(c, d, b))
}

/// Triangles of a ring without its holes.
fn divide(family: &[&Ring]) -> Vec<[u32; 3]> {
    let coordinates: Vec<f64> = family.iter().flat_map(|ring| ring.points.as_flattened()).copied().collect();
    let numbers: Vec<u32> =
        family.iter().flat_map(|ring| (ring.first..ring.first + ring.points.len()).map(|k| k as u32)).collect();
    let ends = family.iter().scan(0, |sum, ring| {
        *sum += ring.points.len();
        Some(*sum)
    });
    let holes: Vec<usize> = ends.take(family.len() - 1).collect();
    // It gives up with an error; should it ever panic, that is no reason for us to.
    let ears = catch_unwind(AssertUnwindSafe(|| earcutr::earcut(&coordinates, &holes, 2)));
    let ears = ears.ok().and_then(Result::ok).unwrap_or_default();
    ears.as_chunks::<3>().0.iter().map(|ear| ear.map(|k| numbers[k])).collect()
}

#[cfg(test)]
#[path = "fill_tests.rs"]
mod tests;
