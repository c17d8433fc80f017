//! Convex hulls in the plane.

use crate::sim::vector::{cross, sub};

/// The corners of the convex hull of places (Andrew's monotone chain), in the order around it; `least`: twice the area that one has at least
/// with those beside it `[m^2]`.
pub(super) fn hull(places: &[[f64; 2]], least: f64) -> Vec<u32> {
    if places.len() == 1 {
        return vec![0];
    }
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    let at = |k: u32| places[k as usize];
    order.sort_by(|&a, &b| at(a)[0].total_cmp(&at(b)[0]).then(at(a)[1].total_cmp(&at(b)[1])));
    let mut corners: Vec<u32> = Vec::new();
    for half in [order.clone(), order.into_iter().rev().collect()] {
        let start = corners.len();
        for k in half {
            while corners.len() >= start + 2 {
                let [a, b] = [corners[corners.len() - 2], corners[corners.len() - 1]];
                if cross(sub(at(b), at(a)), sub(at(k), at(b))) > least {
                    break;
                }
                corners.pop();
            }
            corners.push(k);
        }
        corners.pop();
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_square_with_points_within_is_its_corners() {
        let places = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [0.5, 1.5]];
        assert_eq!(hull(&places, 0.0), [0, 1, 3, 4]);
    }
}
