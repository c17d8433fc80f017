//! Which contours are kept, and what that makes of the coverage.

use super::contour::Loop;
use super::{Coverage, plane::Point};

/// Drops specks and holes that are smaller than `min_area` `[px^2]`, and all holes with what lies in them if they are to
/// be filled. The coverage is changed as if they had never been there. The loops that are kept stay in their order.
pub fn keep(coverage: &mut Coverage, loops: Vec<Loop>, min_area: f64, fill_holes: bool) -> Vec<Loop> {
    let inner = if fill_holes { nested(&loops) } else { vec![false; loops.len()] };
    let (mut kept, mut dropped) = (Vec::new(), Vec::new());
    for (one, is_inner) in loops.into_iter().zip(inner) {
        let to = if one.area.abs() < min_area || is_inner { &mut dropped } else { &mut kept };
        to.push(one);
    }
    // What lies in a loop is smaller than it, and is painted over by it.
    dropped.sort_by(|a, b| a.area.abs().total_cmp(&b.area.abs()));
    dropped.iter().for_each(|one| paint(coverage, one));
    kept
}

/// Gives all pixels in a loop the value that those around it have: holes are filled, specks wiped.
fn paint(coverage: &mut Coverage, one: &Loop) {
    let value = if one.area < 0.0 { 255 } else { 0 };
    let mut crossings: Vec<(usize, f64)> = row_crossings(&one.points).collect();
    crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let (pairs, _) = crossings.as_chunks::<2>();
    for [(row, from), (_, to)] in pairs {
        let column = |x: f64| (x + 0.5).max(0.0) as usize;
        let (from, to) = (column(*from), column(*to).min(coverage.width));
        coverage.values[row * coverage.width + from..row * coverage.width + to].fill(value);
    }
}

/// Where a contour crosses the middles of pixel rows: the row, and x `[px]`. Every contour does: it surrounds a pixel.
fn row_crossings(points: &[Point]) -> impl Iterator<Item = (usize, f64)> + '_ {
    points.iter().filter(|[_, y]| y.fract() == 0.5).map(|&[x, y]| (y as usize, x))
}

/// Whether each loop is a hole, or lies in one.
///
/// Model: what lies to the left of a loop's first crossing is known from the next crossing there. If that one's loop is
/// the outline of ink, both lie in the same hole or in none; if it is a hole, this one lies in it, or beside it in the
/// same ink, and is inner in any case.
fn nested(loops: &[Loop]) -> Vec<bool> {
    let of = |(k, one): (usize, &Loop)| row_crossings(&one.points).map(move |(row, x)| (row, x, k)).collect::<Vec<_>>();
    let mut crossings: Vec<(usize, f64, usize)> = loops.iter().enumerate().flat_map(of).collect();
    crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut inner: Vec<Option<bool>> = loops.iter().map(|one| (one.area < 0.0).then_some(true)).collect();
    let mut before: Option<(usize, usize)> = None;
    for (row, _, k) in crossings {
        if inner[k].is_none() {
            let left = before.filter(|(other, _)| *other == row).and_then(|(_, m)| inner[m]);
            inner[k] = Some(left.unwrap_or(false));
        }
        before = Some((row, k));
    }
    inner.into_iter().map(|one| one.unwrap_or(false)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::contour::contours;
    use super::*;

    /// Squares in squares, each a step smaller, ink and none in turn; a speck in the middle.
    fn target() -> Coverage {
        let ring = |k: usize| {
            let (x, y) = (k % 41, k / 41);
            let depth = x.min(y).min(40 - x).min(40 - y);
            if depth == 20 { 255 } else { [0, 255, 255, 0, 0][depth % 5] }
        };
        Coverage { width: 41, height: 41, values: (0..41 * 41).map(ring).collect(), level: 127 }
    }

    #[test]
    fn small_loops_are_dropped_and_painted_over() {
        let mut coverage = target();
        let loops = contours(&coverage);
        assert_eq!(loops.len(), 9);
        let kept = keep(&mut coverage, loops, 1.0, false);
        assert_eq!(kept.len(), 8);
        assert_eq!(contours(&coverage), kept);
        let kept = keep(&mut coverage, kept, 200.0, false);
        assert_eq!(kept.len(), 6);
        assert_eq!(contours(&coverage), kept);
    }

    #[test]
    fn filling_leaves_the_outermost_loops_and_solid_ink() {
        let mut coverage = target();
        let loops = contours(&coverage);
        let kept = keep(&mut coverage, loops.clone(), 0.0, true);
        assert_eq!(kept, loops[..1]);
        assert_eq!(contours(&coverage), kept);
        assert!((1..40).all(|y| (1..40).all(|x| coverage.values[y * 41 + x] == 255)));
    }

    #[test]
    fn neighbours_of_a_hole_are_not_in_it() {
        let mut values = vec![0; 20 * 5];
        for x in [1, 3, 5, 7] {
            (0..5).for_each(|y| values[20 * y + x] = 255);
        }
        (1..7).for_each(|x| (values[x], values[80 + x]) = (255, 255));
        let mut coverage = Coverage { width: 20, height: 5, values, level: 127 };
        coverage.values[2 * 20 + 12] = 255;
        let loops = contours(&coverage);
        assert_eq!(loops.len(), 5);
        assert_eq!(keep(&mut coverage, loops, 0.0, true).len(), 2);
    }
}
