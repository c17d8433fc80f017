//! How deep bodies are in each other: points of one inside the outline of another.

/// The deepest that a point of one skin is inside another skin: its distance from the nearest edge there [m].
///
/// Infinite where a point is nowhere.
pub(crate) fn deepest(positions: &[[f64; 2]], skins: &[Vec<usize>]) -> f64 {
    let outlines: Vec<Vec<[f64; 2]>> = skins.iter().map(|skin| skin.iter().map(|&i| positions[i]).collect()).collect();
    if outlines.iter().flatten().flatten().any(|coordinate| !coordinate.is_finite()) {
        return f64::INFINITY;
    }
    let boxes: Vec<[[f64; 2]; 2]> = outlines.iter().map(|outline| bounds(outline)).collect();
    let mut most: f64 = 0.0;
    for (i, outline) in outlines.iter().enumerate() {
        for (j, own) in outlines.iter().enumerate().filter(|(j, _)| *j != i) {
            if !overlap(boxes[i], boxes[j]) {
                continue;
            }
            let near = own.iter().filter(|&&x| overlap(boxes[i], [x, x]));
            most = near.map(|&x| inside(outline, x)).fold(most, f64::max);
        }
    }
    most
}

/// How far a point is inside an outline [m]; 0 outside.
fn inside(outline: &[[f64; 2]], x: [f64; 2]) -> f64 {
    let (mut is_inside, mut nearest) = (false, f64::INFINITY);
    for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let u = [b[0] - a[0], b[1] - a[1]];
        if (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + u[0] * (x[1] - a[1]) / u[1] {
            is_inside = !is_inside;
        }
        let squared = (u[0] * u[0] + u[1] * u[1]).max(f64::MIN_POSITIVE);
        let t = (((x[0] - a[0]) * u[0] + (x[1] - a[1]) * u[1]) / squared).clamp(0.0, 1.0);
        nearest = nearest.min((x[0] - a[0] - t * u[0]).hypot(x[1] - a[1] - t * u[1]));
    }
    if is_inside { nearest } else { 0.0 }
}

fn bounds(outline: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    outline
        .iter()
        .fold(nothing, |[low, high], x| [[low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])]])
}

fn overlap([low, high]: [[f64; 2]; 2], [other_low, other_high]: [[f64; 2]; 2]) -> bool {
    (0..2).all(|axis| low[axis] < other_high[axis] && other_low[axis] < high[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Squares of side 2 with a corner at each of the places.
    fn squares(corners: &[[f64; 2]]) -> (Vec<[f64; 2]>, Vec<Vec<usize>>) {
        let square = |&[x, y]: &[f64; 2]| [[x, y], [x + 2.0, y], [x + 2.0, y + 2.0], [x, y + 2.0]];
        let skins = (0..corners.len()).map(|k| (4 * k..4 * k + 4).collect()).collect();
        (corners.iter().flat_map(square).collect(), skins)
    }

    fn depth(corners: &[[f64; 2]]) -> f64 {
        let (positions, skins) = squares(corners);
        deepest(&positions, &skins)
    }

    #[test]
    fn the_depth_of_a_corner_is_its_distance_from_the_nearest_edge() {
        assert_eq!(depth(&[[0.0, 0.0], [1.5, 1.25]]), 0.5);
        assert_eq!(depth(&[[1.5, 1.25], [0.0, 0.0]]), 0.5);
        assert_eq!(depth(&[[10.0, 0.0], [10.25, 1.0], [0.0, 0.0], [1.5, 1.25]]), 0.5, "of several the deepest");
    }

    #[test]
    fn apart_and_side_by_side_are_no_depth() {
        assert_eq!(depth(&[[0.0, 0.0], [2.5, 0.0]]), 0.0);
        assert_eq!(depth(&[[0.0, 0.0], [2.0, 0.0]]), 0.0);
    }

    #[test]
    fn a_point_in_the_bay_of_an_outline_is_outside() {
        let bay = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]];
        assert_eq!(inside(&bay, [2.0, 2.0]), 0.0);
        assert_eq!(inside(&bay, [2.0, 0.25]), 0.25);
    }

    #[test]
    fn a_point_that_is_nowhere_is_infinitely_deep() {
        assert_eq!(depth(&[[0.0, 0.0], [f64::NAN, 0.0]]), f64::INFINITY);
    }
}
