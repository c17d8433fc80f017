//! What a camera sees, as a question to boxes: in view or not, and how many pixels a metre there.

use glam::{DMat4, DVec3, DVec4};

use super::camera::Camera;

/// A box along the axes; one without points is inside out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

impl Extent {
    /// The box of no point.
    pub(super) const NONE: Extent = Extent { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Takes in a point. What is not a number is nowhere.
    pub(super) fn include<const D: usize>(&mut self, point: &[f32; D]) {
        for axis in 0..D {
            // Comparisons, not `min`: one instruction each.
            self.low[axis] = if point[axis] < self.low[axis] { point[axis] } else { self.low[axis] };
            self.high[axis] = if point[axis] > self.high[axis] { point[axis] } else { self.high[axis] };
        }
    }

    /// Takes in another box.
    pub(super) fn unite(&mut self, other: &Extent) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
    }

    /// Middle and half the size; an axis that nothing lies along is 0.
    fn middle_and_half(&self) -> (DVec3, DVec3) {
        let [low, high] = [self.low, self.high].map(|corner| DVec3::from_array(corner.map(f64::from)));
        let is_used = low.cmple(high);
        let pick = |value| DVec3::select(is_used, value, DVec3::ZERO);
        (pick(0.5 * (low + high)), pick(0.5 * (high - low)))
    }

    /// Whether there is a point in it.
    fn is_empty(&self) -> bool {
        self.low[0] > self.high[0]
    }
}

/// What a camera sees of positions relative to an origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sight {
    /// Planes to the left, right, below and above, `margin` pixels beyond the picture: positive inside.
    sides: [DVec4; 4],
    /// Distance from the camera: the last row of the matrix; 1 in the plane.
    distance: DVec4,
    near: f64,
    /// Pixels a metre at the distance 1.
    pixels: f64,
}

impl Sight {
    /// What `camera` sees of positions relative to `origin` `[m]`, and `margin` `[px]` around the picture.
    pub(super) fn new(camera: &Camera, origin: DVec3, margin: f64) -> Self {
        let matrix: DMat4 = camera.clip_from_relative(origin);
        let [width, height] = camera.viewport().map(f64::from);
        let [x, y, w] = [matrix.row(0), matrix.row(1), matrix.row(3)];
        let (across, up) = (w * (1.0 + 2.0 * margin / width), w * (1.0 + 2.0 * margin / height));
        Sight {
            sides: [across + x, across - x, up + y, up - y],
            distance: w,
            near: camera.near(),
            pixels: 0.5 * height * y.truncate().length(),
        }
    }

    /// Whether any of a box may be in view.
    pub(super) fn meets(&self, extent: &Extent) -> bool {
        let (middle, half) = extent.middle_and_half();
        // What is not a number is not known to be out of view.
        let is_beyond = |plane: &DVec4, least: f64| at(plane, middle) + plane.truncate().abs().dot(half) < least;
        let is_out = is_beyond(&self.distance, self.near) || self.sides.iter().any(|side| is_beyond(side, 0.0));
        !is_out && !extent.is_empty()
    }

    /// Whether all of a box is in view.
    pub(super) fn holds(&self, extent: &Extent) -> bool {
        let (middle, half) = extent.middle_and_half();
        self.sides.iter().all(|side| at(side, middle) - side.truncate().abs().dot(half) >= 0.0)
    }

    /// Pixels a metre where a box comes nearest to the camera.
    pub(super) fn pixels_per_metre(&self, extent: &Extent) -> f64 {
        let (middle, half) = extent.middle_and_half();
        let nearest = at(&self.distance, middle) - self.distance.truncate().abs().dot(half);
        self.pixels / nearest.max(self.near)
    }
}

fn at(plane: &DVec4, point: DVec3) -> f64 {
    plane.dot(point.extend(1.0))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::render::Pose;

    fn cube(middle: [f32; 3], half: f32) -> Extent {
        Extent { low: middle.map(|x| x - half), high: middle.map(|x| x + half) }
    }

    #[test]
    fn a_box_is_in_view_as_far_as_its_corners_are() {
        let pose = Pose::Plane { center: DVec2::new(10.0, 0.0), height: 4.0 };
        let sight = Sight::new(&Camera::new(pose, [200, 100]), DVec3::new(10.0, 0.0, 0.0), 0.0);
        for (x, y, meets, holds) in [
            (0.0, 0.0, true, true),
            (4.4, 0.0, true, false),
            (4.6, 0.0, false, false),
            (-4.6, 0.0, false, false),
            (0.0, 2.4, true, false),
            (0.0, -2.6, false, false),
        ] {
            let square = Extent { low: [x - 0.5, y - 0.5, 0.0], high: [x + 0.5, y + 0.5, 0.0] };
            assert_eq!((sight.meets(&square), sight.holds(&square)), (meets, holds), "{x} {y}");
        }
        assert!((sight.pixels_per_metre(&cube([0.0; 3], 1.0)) - 25.0).abs() < 1e-9);
        assert!(!sight.meets(&Extent::NONE));
        let mut endless = cube([0.0; 3], 1.0);
        endless.include(&[f32::INFINITY, f32::NAN]);
        assert!(sight.meets(&endless));
    }

    #[test]
    fn the_margin_is_in_pixels() {
        let pose = Pose::Plane { center: DVec2::ZERO, height: 100.0 };
        let camera = Camera::new(pose, [100, 100]);
        let beside = Extent { low: [53.0, 0.0, 0.0], high: [54.0, 1.0, 0.0] };
        assert!(!Sight::new(&camera, DVec3::ZERO, 2.9).meets(&beside));
        assert!(Sight::new(&camera, DVec3::ZERO, 3.1).meets(&beside));
    }

    #[test]
    fn in_space_what_is_behind_the_camera_is_out_of_view() {
        let pose = Pose::Orbit { target: DVec3::ZERO, distance: 10.0, yaw: 0.0, pitch: 0.0 };
        let sight = Sight::new(&Camera::new(pose, [100, 100]), DVec3::ZERO, 0.0);
        assert!(sight.meets(&cube([0.0; 3], 1.0)) && sight.holds(&cube([0.0; 3], 1.0)));
        assert!(!sight.meets(&cube([0.0, 0.0, 12.0], 1.0)), "behind");
        assert!(sight.meets(&cube([0.0, 0.0, 12.0], 3.0)), "around the camera");
        assert!(!sight.meets(&cube([20.0, 0.0, 0.0], 1.0)));
        let near = sight.pixels_per_metre(&cube([0.0, 0.0, 4.0], 1.0));
        let far = sight.pixels_per_metre(&cube([0.0, 0.0, -9.0], 1.0));
        assert!((near / far - 18.0 / 5.0).abs() < 1e-9);
    }
}
