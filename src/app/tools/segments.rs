//! Segments of the plane, and the loops that they close: what is nearest on them, what they meet, what lies within.

use glam::DVec2;

use crate::picture::to_segment;
use crate::sim::segments_meet;

/// The place on a segment that is nearest to another one.
///
/// Valid range: a segment of no length is its one place.
pub(super) fn nearest_on_segment(at: DVec2, from: DVec2, to: DVec2) -> DVec2 {
    let (_, share) = to_segment(at.to_array(), [from, to].map(|end| end.to_array()));
    from + share * (to - from)
}

/// How far a place is from a segment, in the unit of both.
pub(in crate::app) fn distance_to_segment(at: DVec2, from: DVec2, to: DVec2) -> f64 {
    let (distance, _) = to_segment(at.to_array(), [from, to].map(|end| end.to_array()));
    distance
}

/// Whether two segments cross, or touch: as the cut sees it.
pub(super) fn cross(first: [DVec2; 2], second: [DVec2; 2]) -> bool {
    segments_meet(first.map(|end| end.to_array()), second.map(|end| end.to_array()))
}

/// The sides of loops, from end to end `[m]`.
pub(super) fn sides(loops: &[Vec<[f64; 2]>]) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    loops.iter().flat_map(|corners| {
        (0..corners.len()).map(move |k| [corners[k], corners[(k + 1) % corners.len()]].map(DVec2::from))
    })
}

/// How far a place is from the nearest of such sides `[m]`; infinite of none.
pub(super) fn distance_to_sides(at: DVec2, loops: &[Vec<[f64; 2]>]) -> f64 {
    sides(loops).map(|[from, to]| distance_to_segment(at, from, to)).fold(f64::INFINITY, f64::min)
}

/// Whether a place lies within loops by the even-odd rule.
pub(super) fn is_inside(loops: &[Vec<[f64; 2]>], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for corners in loops {
        for (k, &[x1, y1]) in corners.iter().enumerate() {
            let [x0, y0] = corners[(k + corners.len() - 1) % corners.len()];
            if (y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0) {
                inside = !inside;
            }
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_place_of_a_segment_lies_across_or_at_an_end_however_short_it_is() {
        for size in [1.0, 0.5_f64.powi(30)] {
            let [from, to] = [DVec2::new(size, size), DVec2::new(5.0 * size, size)];
            let near = |x: f64, y: f64| {
                let at = size * DVec2::new(x, y);
                let nearest = nearest_on_segment(at, from, to);
                assert_eq!(distance_to_segment(at, from, to), at.distance(nearest), "{at}");
                nearest
            };
            let across = size * DVec2::new(2.0, 1.0);
            assert_eq!([near(2.0, 9.0), near(-2.0, 4.0), near(9.0, -4.0)], [across, from, to]);
        }
        let place = DVec2::new(3.0, 4.0);
        assert_eq!(nearest_on_segment(DVec2::ZERO, place, place), place);
        assert_eq!(distance_to_segment(DVec2::ZERO, place, place), 5.0);
    }

    #[test]
    fn a_place_in_a_hole_is_not_inside_and_is_near_its_sides() {
        let square = |half: f64| vec![[-half, -half], [half, -half], [half, half], [-half, half]];
        let ring = [square(3.0), square(1.0)];
        assert_eq!([0.5, 2.0, 4.0].map(|x| is_inside(&ring, [x, 0.0])), [false, true, false]);
        assert_eq!([0.0, 1.5, 5.0].map(|x| distance_to_sides(DVec2::new(x, 0.0), &ring)), [1.0, 0.5, 2.0]);
        assert_eq!(distance_to_sides(DVec2::ZERO, &[]), f64::INFINITY);
    }
}
