//! How many points a boundary will have, told from the contours in one pass.

use super::super::contour::Loop;
use super::super::plane::{Point, cross, distance, dot, minus};
use super::tolerance;

/// Points that one more chord than the length asks for brings about: bends closer than the spacing make points closer
/// around them, and loops that come close to each other are followed closer again (5 to 10 in noise).
const EACH_BEND: u64 = 8;

/// About how many points the polygons of some contours have.
///
/// Model: from a point on, a chord grows along the contour while one direction passes all of its points within the
/// tolerance, and while it is no longer than the spacing. What that makes of smooth contours is their length over the
/// spacing; grain of a few pixels makes more chords, and each of them [`EACH_BEND`] points.
/// Source: J. Sklansky, V. Gonzalez, "Fast polygonal approximation of digitized curves" (1980): the cone of directions.
pub(in crate::picture) fn about_points(contours: &[Loop], spacing: f64) -> u64 {
    let reach = tolerance(spacing);
    contours.iter().map(|one| about(&one.points, spacing, reach).max(3)).sum()
}

fn about(points: &[Point], spacing: f64, reach: f64) -> u64 {
    let next = points.iter().skip(1).chain(&points[..1]);
    let length: f64 = points.iter().zip(next).map(|(&a, &b)| distance(a, b)).sum();
    let smooth = (length / spacing) as u64;
    smooth + EACH_BEND * chords(points, spacing, reach).saturating_sub(smooth + 3)
}

fn chords(points: &[Point], spacing: f64, reach: f64) -> u64 {
    let (mut count, mut from) = (0.0, points[0]);
    let (mut before, mut length) = (from, 0.0);
    // The directions that are left: none yet, or from one to the other, turning left.
    let mut cone: Option<[Point; 2]> = None;
    for &point in points.iter().skip(1).chain(&points[..1]) {
        let to = minus(point, from);
        let is_met = cone.is_none_or(|[right, left]| cross(right, to) >= 0.0 && cross(to, left) >= 0.0);
        length += distance(before, point);
        if !is_met || length > spacing {
            // Of the step that is too long, the share that the spacing does not cover belongs to the next chord.
            count += if is_met { length / spacing } else { 1.0 };
            (from, length, cone) = (if is_met { point } else { before }, 0.0, None);
        }
        before = point;
        cone = narrowed(cone, minus(point, from), reach);
    }
    (count + length / spacing).round() as u64
}

/// The directions of a cone that pass within `reach` of a place; from within `reach` all do.
fn narrowed(cone: Option<[Point; 2]>, to: Point, reach: f64) -> Option<[Point; 2]> {
    let square = dot(to, to);
    if square <= reach * reach {
        return cone;
    }
    // The tangents from here to the circle of this radius about the place.
    let (along, across) = ((square - reach * reach).sqrt(), reach);
    let turned = |side: f64| [along * to[0] - side * across * to[1], along * to[1] + side * across * to[0]];
    let (right, left) = (turned(-1.0), turned(1.0));
    Some(match cone {
        None => [right, left],
        Some([old_right, old_left]) => [
            if cross(old_right, right) > 0.0 { right } else { old_right },
            if cross(left, old_left) > 0.0 { left } else { old_left },
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_contours_have_their_length_over_the_spacing_and_grain_has_more() {
        let ring = |radius: f64, grain: f64| {
            let at = |k: u32| {
                let angle = std::f64::consts::TAU * f64::from(k) / 4000.0;
                let here = radius + grain * f64::from(k / 3 % 2);
                [here * libm::cos(angle), here * libm::sin(angle)]
            };
            Loop::new((0..4000).map(at).collect())
        };
        let length = std::f64::consts::TAU * 600.0;
        let smooth = about_points(&[ring(600.0, 0.0)], 16.0) as f64;
        assert!((smooth * 16.0 / length - 1.0).abs() < 0.05, "{smooth} points");
        assert!(about_points(&[ring(600.0, 8.0)], 16.0) > 3000, "grain");
    }
}
