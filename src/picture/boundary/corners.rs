//! Corners of a contour, which the polygon has to have.

use super::super::plane::{Point, cross, distance, dot, minus};
use super::path::Path;

/// How far to both sides a corner is looked for, in spacings: what turns within less is a corner at this spacing.
const SUPPORT: f64 = 0.3;

/// Least distance to look `[px]`: a contour of two values runs in steps of a pixel, which turn by 45 degrees.
const LEAST_SUPPORT: f64 = 3.5;

/// Cosine of the least turn that is a corner: 40 degrees. A circle turns as much within the support when its radius is
/// below 0.43 of the spacing.
const STRAIGHT: f64 = 0.766;

/// Numbers of the contour's points at which it has a corner, in order.
///
/// Model: at each point the turn between the chords to the places a support before and after it (k-cosine); a corner
/// turns most within a support.
/// Source: A. Rosenfeld, E. Johnston, "Angle detection on digital curves" (1973); support by arc length, not by points.
pub(super) fn corners(path: &Path<'_>, spacing: f64) -> Vec<usize> {
    let support = (SUPPORT * spacing).max(LEAST_SUPPORT);
    if path.length() < 8.0 * support {
        return Vec::new();
    }
    let (before, after) = (path.shifted(-support), path.shifted(support));
    let turns: Vec<(usize, f64, f64)> = (0..path.points.len())
        .filter_map(|k| {
            let (here, arc) = (path.points[k], path.arc[k]);
            let (u, v) = (minus(here, before[k]), minus(after[k], here));
            let cosine = dot(u, v) / (dot(u, u) * dot(v, v)).sqrt().max(f64::MIN_POSITIVE);
            (cosine < STRAIGHT).then(|| (k, arc, cosine + if cross(u, v) < 0.0 { 1e-9 } else { 0.0 }))
        })
        .collect();
    let is_sharpest = |&(k, arc, cosine): &(usize, f64, f64)| {
        let from = turns.partition_point(|turn| turn.1 < arc - support);
        let to = turns.partition_point(|turn| turn.1 <= arc + support);
        let beats = |other: &(usize, f64, f64)| other.2 < cosine || other.2 == cosine && other.0 < k;
        let length = path.length();
        let before = turns.partition_point(|turn| turn.1 < arc - support + length);
        let after = turns.partition_point(|turn| turn.1 <= arc + support - length);
        let around = turns[from..to].iter().chain(&turns[before..]).chain(&turns[..after]);
        !around.clone().any(beats)
    };
    turns.iter().filter(|turn| is_sharpest(turn)).map(|turn| turn.0).collect()
}

/// Where a corner was before pixels cut it off: where the lines on both sides of it meet, unless that is more than
/// `reach` px from the contour's own point.
///
/// Model: the lines run through the places a third of the support and a whole one away, beyond what is cut off.
pub(super) fn tip(path: &Path<'_>, corner: usize, spacing: f64, reach: f64) -> Point {
    let support = (SUPPORT * spacing).max(LEAST_SUPPORT);
    let (here, arc) = (path.points[corner], path.arc[corner]);
    let [a, b, c, d] = [-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0].map(|share| path.at(arc + share * support));
    let (before, after) = (minus(b, a), minus(c, d));
    let turned = cross(before, after);
    if turned.abs() < 1e-6 {
        return here;
    }
    let share = cross(minus(d, a), after) / turned;
    let tip = [a[0] + share * before[0], a[1] + share * before[1]];
    if share > 1.0 && distance(tip, here) <= reach { tip } else { here }
}

#[cfg(test)]
mod tests {
    use super::super::super::contour::contours;
    use super::super::super::{Coverage, plane::Point};
    use super::*;

    fn contour(ink: impl Fn(f64, f64) -> bool) -> Vec<Point> {
        let at = |k: usize| 255 * u8::from(ink((k % 200) as f64 + 0.5, (k / 200) as f64 + 0.5));
        let coverage = Coverage { width: 200, height: 200, values: (0..200 * 200).map(at).collect(), level: 127 };
        contours(&coverage).swap_remove(0).points
    }

    #[test]
    fn a_square_has_four_corners_however_it_is_turned_and_a_disc_none() {
        for turn in 0..12 {
            let (s, c) = (0.13 * f64::from(turn)).sin_cos();
            let points = contour(|x, y| {
                let (x, y) = (x - 100.0, y - 100.0);
                (c * x + s * y).abs() < 60.0 && (c * y - s * x).abs() < 60.0
            });
            for spacing in [4.0, 8.0, 16.0, 32.0] {
                assert_eq!(corners(&Path::new(&points), spacing).len(), 4, "turn {turn} spacing {spacing}");
            }
        }
        let disc = contour(|x, y| (x - 100.0).hypot(y - 100.0) < 60.0);
        for spacing in [2.0, 4.0, 8.0, 16.0, 32.0] {
            assert!(corners(&Path::new(&disc), spacing).is_empty(), "spacing {spacing}");
        }
    }
}
