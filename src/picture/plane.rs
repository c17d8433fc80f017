//! Plane geometry on pairs of coordinates.

/// A place `[px]`: x to the right, y down.
pub type Point = [f64; 2];

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// The point at `share` of the way from `a` to `b`.
pub(super) fn between(a: Point, b: Point, share: f64) -> Point {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Positive when `b` lies to the left of `a` in (x, y).
pub(super) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the area of a triangle, positive when its corners turn left in (x, y).
pub(super) fn turn(a: Point, b: Point, c: Point) -> f64 {
    cross(minus(b, a), minus(c, a))
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    let d = minus(b, a);
    dot(d, d).sqrt()
}

/// Twice the area of a polygon: about its first point, so that far from the origin no digits are lost.
pub(super) fn doubled_area(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| turn(points[0], pair[0], pair[1])).sum()
}

/// The distance of a point from a segment, in the unit of both, and at which share of it the nearest place lies.
///
/// Valid range: a segment of no length is a point, with share 0.
pub(crate) fn to_segment(point: Point, [a, b]: [Point; 2]) -> (f64, f64) {
    let (along, to) = (minus(b, a), minus(point, a));
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(along, to) / square).clamp(0.0, 1.0) } else { 0.0 };
    (distance(point, between(a, b, share)), share)
}

/// The angle at `a` between the directions to `b` and `c` `[degrees]`.
pub(super) fn angle_at(a: Point, b: Point, c: Point) -> f64 {
    let (u, v) = (minus(b, a), minus(c, a));
    libm::atan2(cross(u, v).abs(), dot(u, v)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_and_distances_of_a_known_triangle() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];
        assert!((angle_at(corners[1], corners[0], corners[2]) - 36.869_897_645_844_02).abs() < 1e-12);
        assert_eq!(angle_at(corners[0], corners[2], corners[1]), 90.0);
        assert_eq!(angle_at(corners[0], corners[0], corners[1]), 0.0);
        assert_eq!(doubled_area(&corners), 12.0);
        assert_eq!(to_segment([0.0, 0.0], [corners[1], corners[2]]), (2.4, 0.64));
        assert_eq!(to_segment([9.0, 0.0], [corners[0], corners[1]]), (5.0, 1.0));
        assert_eq!(to_segment([3.0, 4.0], [[0.0, 0.0], [0.0, 0.0]]), (5.0, 0.0));
    }
}
