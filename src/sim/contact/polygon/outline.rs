//! From outlines to sides with the solid on their right, by the even-odd rule.
//!
//! Outlines may cross themselves and each other, and share sides: they are cut where they cross, and what has the solid on
//! both sides, or on none, is no side.

use super::grid::Grid;
use super::{Polygon, Segment, Side};
use crate::sim::vector::{cross, dot, sub};
use std::collections::BTreeMap;

/// Crossings for each segment, and in all, of which an outline is cut: drawings have fewer.
const MOST_CROSSINGS: usize = 64;
/// Share of a segment's length next to its ends where it is not cut.
const END: f64 = 1e-12;

/// All sides of the polygons. Where polygons touch side to side, neither has a side there.
pub(super) fn sides(polygons: &[Polygon]) -> Vec<Side> {
    let mut list = Vec::new();
    for (k, polygon) in polygons.iter().enumerate() {
        list.extend(sides_of(&polygon.loops).into_iter().map(|ends| Side { ends, polygon: k as u32 }));
    }
    let mut ends: BTreeMap<[u64; 4], Vec<bool>> = BTreeMap::new();
    for side in &list {
        let (key, is_turned) = key(side.ends);
        ends.entry(key).or_default().push(is_turned);
    }
    list.retain(|side| {
        let (key, is_turned) = key(side.ends);
        ends.get(&key).is_none_or(|others| others.iter().all(|&other| other == is_turned))
    });
    list
}

/// The sides of one polygon.
fn sides_of(loops: &[Vec<[f64; 2]>]) -> Vec<Segment> {
    let mut segments = Vec::new();
    for corners in loops {
        for (k, &corner) in corners.iter().enumerate() {
            let next = corners[(k + 1) % corners.len()];
            if next != corner {
                segments.push([corner, next]);
            }
        }
    }
    let segments = odd(cut(&segments));
    let grid = Grid::new(&segments);
    let turned = |&[a, b]: &Segment| if is_solid_on_the_left(&segments, &grid, [a, b]) { [b, a] } else { [a, b] };
    segments.iter().map(turned).collect()
}

/// Segments cut where they cross or touch others.
fn cut(segments: &[Segment]) -> Vec<Segment> {
    let grid = Grid::new(segments);
    let mut cuts: Vec<Vec<f64>> = vec![Vec::new(); segments.len()];
    let mut left = MOST_CROSSINGS * (segments.len() + MOST_CROSSINGS);
    for (k, &[a, b]) in segments.iter().enumerate() {
        for other in grid.near(a, b, 0.0) {
            if left > 0 && other as usize != k {
                let before = cuts[k].len();
                meetings([a, b], segments[other as usize], &mut cuts[k]);
                left -= (cuts[k].len() - before).min(left);
            }
        }
    }
    let mut list = Vec::with_capacity(segments.len());
    for (&[a, b], cuts) in segments.iter().zip(&mut cuts) {
        cuts.sort_by(f64::total_cmp);
        let mut from = a;
        for &share in cuts.iter() {
            let at = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
            if at != from {
                list.push([from, at]);
                from = at;
            }
        }
        if from != b {
            list.push([from, b]);
        }
    }
    list
}

/// Adds the shares of a segment at which another one crosses it, or ends on it.
fn meetings([a, b]: Segment, [c, d]: Segment, cuts: &mut Vec<f64>) {
    let (along, other, apart) = (sub(b, a), sub(d, c), sub(c, a));
    let across = cross(along, other);
    let square = along[0] * along[0] + along[1] * along[1];
    let is_inner = |share: f64| (END..=1.0 - END).contains(&share);
    if across * across <= (END * END) * square * (other[0] * other[0] + other[1] * other[1]) {
        if cross(along, apart).abs() <= END * square {
            let share = |x: [f64; 2]| dot(sub(x, a), along) / square;
            cuts.extend([share(c), share(d)].into_iter().filter(|&share| is_inner(share)));
        }
        return;
    }
    let (share, of_other) = (cross(apart, other) / across, cross(apart, along) / across);
    if is_inner(share) && (-END..=1.0 + END).contains(&of_other) {
        cuts.push(share);
    }
}

/// Segments that lie on each other count once if there is an odd number of them, else not at all.
fn odd(segments: Vec<Segment>) -> Vec<Segment> {
    let mut counts: BTreeMap<[u64; 4], usize> = BTreeMap::new();
    for &segment in &segments {
        *counts.entry(key(segment).0).or_default() += 1;
    }
    let mut list = segments;
    list.retain(|&segment| counts.get_mut(&key(segment).0).is_some_and(|count| std::mem::take(count) % 2 == 1));
    list
}

/// The same for both directions; and whether it was turned.
fn key([a, b]: Segment) -> ([u64; 4], bool) {
    let bits = |x: [f64; 2]| x.map(|x| (x + 0.0).to_bits());
    let ([a, b], is_turned) = if bits(a) <= bits(b) { ([bits(a), bits(b)], false) } else { ([bits(b), bits(a)], true) };
    ([a[0], a[1], b[0], b[1]], is_turned)
}

/// Whether the solid lies to the left of the way from `a` to `b`: by how many segments a ray from its middle crosses, along x
/// where the segment is steep, else along y.
fn is_solid_on_the_left(segments: &[Segment], grid: &Grid, [a, b]: Segment) -> bool {
    let [dx, dy] = sub(b, a);
    // Along x the ray goes to the left of the picture, along y down: which side of the segment is that?
    let (axis, is_left) = if dy.abs() >= dx.abs() { (0, dy > 0.0) } else { (1, dx < 0.0) };
    let from = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let mut to = from;
    to[axis] = grid.cells.low[axis] - grid.cells.side;
    let across = 1 - axis;
    let mut crossings = 0;
    for k in grid.near(from, to, 0.0) {
        let [c, d] = segments[k as usize];
        if [c, d] == [a, b] || (c[across] > from[across]) == (d[across] > from[across]) {
            continue;
        }
        let share = (from[across] - c[across]) / (d[across] - c[across]);
        crossings += usize::from(c[axis] + share * (d[axis] - c[axis]) < from[axis]);
    }
    (crossings % 2 == 1) == is_left
}
