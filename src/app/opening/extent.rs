//! The boxes about what a scene has, in the world.

use crate::render::View;

/// Corners of a box that nothing is in.
const EMPTY: [[f64; 3]; 2] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

/// Takes in a place. What has no number along an axis has no place there.
pub(super) fn include(corners: &mut [[f64; 3]; 2], place: &[f64]) {
    for (axis, &value) in place.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        corners[0][axis] = corners[0][axis].min(value);
        corners[1][axis] = corners[1][axis].max(value);
    }
}

/// The box about all points `[m]`.
pub(super) fn points(view: &View<'_>) -> [[f64; 3]; 2] {
    let (positions, dimensions) = (view.current, view.dimensions);
    let mut corners = EMPTY;
    for first in (0..positions.len()).step_by(dimensions.max(1)) {
        let place: [f64; 3] =
            std::array::from_fn(|axis| if axis < dimensions { positions.get(first + axis) } else { 0.0 });
        include(&mut corners, &place[..dimensions]);
    }
    corners
}

/// The box about walls and solid obstacles `[m]`.
pub(super) fn surroundings(view: &View<'_>) -> [[f64; 3]; 2] {
    let mut corners = EMPTY;
    view.bounds.iter().flatten().for_each(|corner| include(&mut corners, &corner[..view.dimensions]));
    for corner in view.polygons.iter().flat_map(|polygon| &polygon.loops).flatten() {
        include(&mut corners, corner);
    }
    view.convex.iter().flat_map(|convex| convex.figure.extent()).for_each(|corner| include(&mut corners, &corner));
    corners
}
