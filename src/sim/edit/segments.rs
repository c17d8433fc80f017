//! Whether two segments of the plane meet: what a stroke cuts, and what is in the way of a rope.

use crate::sim::vector::{cross, sub};

/// Two ends `[m]`, or in pixels.
type Segment = [[f64; 2]; 2];

/// Twice the area of the triangle from a segment to a place: above 0 to the left of it.
fn area([a, b]: Segment, at: [f64; 2]) -> f64 {
    cross(sub(b, a), sub(at, a))
}

/// On which side of the line through a segment a place is: above 0 to the left; 0 where it is on it but for rounding.
pub(super) fn side(segment @ [a, b]: Segment, at: [f64; 2]) -> f64 {
    let product = area(segment, at);
    let scale = ((b[0] - a[0]).abs() + (b[1] - a[1]).abs()) * ((at[0] - a[0]).abs() + (at[1] - a[1]).abs());
    if product.abs() <= 1e-9 * scale { 0.0 } else { product }
}

/// Whether two segments have a point in common: also where they only touch, or lie on each other in one line.
pub(crate) fn segments_meet(first @ [a, b]: Segment, second @ [c, d]: Segment) -> bool {
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    if apart(area(first, c), area(first, d)) || apart(area(second, a), area(second, b)) {
        return false;
    }
    // In one line they may lie side by side.
    (0..2).all(|k| a[k].min(b[k]) <= c[k].max(d[k]) && c[k].min(d[k]) <= a[k].max(b[k]))
}

/// Whether two segments pass through each other, each from one side of the other to its other side: not where they only touch.
pub(crate) fn segments_pass(first @ [a, b]: Segment, second @ [c, d]: Segment) -> bool {
    side(first, c) * side(first, d) < 0.0 && side(second, a) * side(second, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_meet_or_do_not_and_pass_through_each_other_only_where_neither_ends() {
        let stroke = [[0.0, 0.0], [2.0, 0.0]];
        for (other, meet, pass, why) in [
            ([[1.0, -1.0], [1.0, 1.0]], true, true, "across"),
            ([[2.0, 0.0], [3.0, 1.0]], true, false, "end to end"),
            ([[1.0, 0.0], [1.0, 1.0]], true, false, "an end on it"),
            ([[1.0, 0.0], [3.0, 0.0]], true, false, "in one line, on each other"),
            ([[3.0, 0.0], [4.0, 0.0]], false, false, "in one line, side by side"),
            ([[3.0, -1.0], [3.0, 1.0]], false, false, "beside it"),
            ([[1.0, 1.0], [2.0, 1.0]], false, false, "along it"),
            ([[2.0, 0.0], [2.0, 0.0]], true, false, "a place on it"),
            ([[1.0, 1.0], [1.0, 1.0]], false, false, "a place off it"),
        ] {
            for [a, b] in [[stroke, other], [other, stroke]] {
                let turned = [b[1], b[0]];
                assert_eq!([segments_meet(a, b), segments_meet(a, turned)], [meet; 2], "{why}");
                assert_eq!([segments_pass(a, b), segments_pass(a, turned)], [pass; 2], "{why}");
            }
        }
    }
}
