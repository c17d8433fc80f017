//! Corners of outlines: which sides cross, what lies between them, and a free stroke with as few of them as show its form.

use glam::DVec2;

use crate::app::tools::segments::distance_to_segment;

/// Whether two stretches have a place in common.
fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let side = |from: DVec2, to: DVec2, at: DVec2| (to - from).perp_dot(at - from);
    // Stretches of one line are on no side of each other.
    let is_near = a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all();
    is_near && side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

/// Which sides meet another than the ones beside them; the last side leads back to the first corner where it is `closed`.
pub(super) fn crossing(corners: &[DVec2], closed: bool) -> Vec<bool> {
    let count = if closed { corners.len() } else { corners.len().saturating_sub(1) };
    let side = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
    let mut is_crossed = vec![false; count];
    for k in 0..count {
        let are_beside = |other: usize| other == k + 1 || (closed && k == 0 && other + 1 == count);
        for other in (k + 1..count).filter(|&other| !are_beside(other)) {
            if meet(side(k), side(other)) {
                (is_crossed[k], is_crossed[other]) = (true, true);
            }
        }
    }
    is_crossed
}

/// Area within corners, positive where they go anticlockwise.
pub(super) fn area(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
}

/// The corners of a stroke, from its first place to its last: no place of it is further than the tolerance from the line between them.
///
/// Source: D. Douglas, T. Peucker, Algorithms for the reduction of the number of points required to represent a digitized line, 1973.
pub(super) fn simplified(stroke: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let Some(last) = stroke.len().checked_sub(1).filter(|last| *last > 0) else { return stroke.to_vec() };
    let mut stays = vec![false; stroke.len()];
    (stays[0], stays[last]) = (true, true);
    let mut spans = vec![[0, last]];
    while let Some([first, last]) = spans.pop() {
        let off = |k: &usize| distance_to_segment(stroke[*k], stroke[first], stroke[last]);
        let Some(far) = (first + 1..last).max_by(|a, b| off(a).total_cmp(&off(b))) else { continue };
        if off(&far) > tolerance {
            stays[far] = true;
            spans.extend([[first, far], [far, last]]);
        }
    }
    stroke.iter().zip(stays).filter(|(_, stays)| *stays).map(|(at, _)| *at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners<const N: usize>(list: [[f64; 2]; N]) -> Vec<DVec2> {
        list.map(DVec2::from).to_vec()
    }

    #[test]
    fn what_crosses_is_found_and_what_lies_in_a_row_is_not() {
        let bow = corners([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(crossing(&bow, true), [true, false, true, false]);
        assert_eq!(crossing(&bow[..3], true), [false; 3], "a triangle");
        assert_eq!(crossing(&bow[..3], false), [false; 2]);
        // A U, whose ends lie on one line.
        let cup =
            corners([[0.0, 2.0], [0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0]]);
        assert_eq!(crossing(&cup, true), [false; 8]);
        assert!((area(&cup) - 5.0).abs() < 1e-12, "{}", area(&cup));
    }

    #[test]
    fn a_stroke_keeps_its_corners_alone() {
        let along = |from: DVec2, to: DVec2| (0..50).map(move |k| from.lerp(to, f64::from(k) / 50.0));
        let [a, b, c] = [DVec2::ZERO, DVec2::new(10.0, 0.0), DVec2::new(10.0, 7.0)];
        let stroke: Vec<DVec2> = along(a, b).chain(along(b, c)).chain([c]).collect();
        assert_eq!(simplified(&stroke, 0.1), [a, b, c]);
        assert_eq!(simplified(&stroke[..1], 0.1), [a]);
        let round: Vec<DVec2> = (0..=200).map(|k| DVec2::from_angle(0.03 * f64::from(k)) * 10.0).collect();
        let few = simplified(&round, 0.1);
        assert!((8..60).contains(&few.len()), "{}", few.len());
        let chords = few.windows(2).map(|pair| 10.0 - (0.5 * (pair[0] + pair[1])).length());
        assert!(chords.fold(0.0, f64::max) < 0.11, "the sagitta of a chord");
    }
}
