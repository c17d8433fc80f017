//! The camera: flat over the plane, or orbiting a target in space. Worlds are y up, screens y down in pixels.

use glam::{DMat4, DVec2, DVec3, DVec4, Mat4};

use crate::sim::Cursor;

/// What of the world is seen, and where a pixel lies in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// How it looks.
    pub pose: Pose,
    /// Width and height of the picture `[px]`.
    viewport: DVec2,
    /// How far what it looks at lies from the middle of the picture, in space: to the right and down, in sizes of the picture `[1]`.
    aside: DVec2,
}

/// How a camera looks at the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pose {
    /// Straight at the plane.
    Plane {
        /// Middle of the picture `[m]`.
        center: DVec2,
        /// Height of the picture `[m]`.
        height: f64,
    },
    /// At a target in space, in perspective.
    Orbit {
        /// What it looks at `[m]`.
        target: DVec3,
        /// Its distance from there `[m]`.
        distance: f64,
        /// Its angle about the vertical, 0 along -z `[rad]`.
        yaw: f64,
        /// Its angle above the level `[rad]`.
        pitch: f64,
    },
}

/// Smallest and largest height of the picture, or distance of the target `[m]`: beyond, coordinates lose their meaning.
const ZOOM: std::ops::RangeInclusive<f64> = 1e-6..=1e9;
/// Angle of view of a camera in space, from bottom to top `[rad]`.
const FIELD_OF_VIEW: f64 = 0.8;
/// Steepest pitch `[rad]`: at the pole, up would have no direction.
const STEEPEST: f64 = 1.55;
/// Least distance that is seen, as a share of the target's: nearer things would fill the picture.
const NEAR: f64 = 0.01;
/// How far off the middle a point behind the camera is pointed to, in sides of the picture `[1]`.
const BEHIND: f64 = 100.0;
/// How many times as far as the nearest the farthest is that is seen: more would cost depth its digits.
const DEPTH_OF_VIEW: f64 = 1e4;
/// Angle that a drag over one pixel turns the camera by `[rad]`.
const TURN: f64 = 0.008;
/// The eye keeps so far above a floor, in distances of the target `[1]`: lower, the floor would be a line.
const ABOVE: f64 = 0.03;
/// Halvings of the pitch that keeps it there.
const HALVINGS: u32 = 40;
/// Room around what is fitted `[1]`.
const MARGIN: f64 = 1.2;

impl Camera {
    /// A camera for a picture of `size` `[px]`.
    pub fn new(pose: Pose, size: [u32; 2]) -> Self {
        let mut camera = Camera { pose, viewport: DVec2::ONE, aside: DVec2::ZERO };
        camera.resize(size);
        camera
    }

    /// A camera that shows all of the box between two corners `[m]`, with some room; in space from ahead and above.
    ///
    /// Valid range: a corner that is not finite gives the box from -1 to 1; an empty box is taken as 1 mm wide.
    pub fn fit(corners: [[f64; 3]; 2], dimensions: usize, size: [u32; 2]) -> Self {
        let [mut low, mut high] = corners.map(DVec3::from);
        if !(low.is_finite() && high.is_finite()) {
            (low, high) = (DVec3::NEG_ONE, DVec3::ONE);
        }
        let (middle, extent) = (0.5 * low + 0.5 * high, (high - low).max(DVec3::splat(1e-3)));
        let pose = if dimensions == 2 {
            Pose::Plane { center: middle.truncate(), height: 1.0 }
        } else {
            Pose::Orbit { target: middle, distance: 1.0, yaw: 0.6, pitch: 0.35 }
        };
        let mut camera = Camera::new(pose, size);
        let aspect = camera.aspect();
        match &mut camera.pose {
            Pose::Plane { height, .. } => *height = clamp_zoom(MARGIN * extent.y.max(extent.x / aspect)),
            Pose::Orbit { distance, .. } => {
                let half = 0.5 * FIELD_OF_VIEW;
                let narrow = half.tan() * aspect.min(1.0);
                *distance = clamp_zoom(MARGIN * 0.5 * extent.length() / narrow.atan().sin());
            }
        }
        camera
    }

    /// The picture has another size `[px]`. A picture of no size keeps the camera sane.
    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        self.viewport = DVec2::new(f64::from(width.max(1)), f64::from(height.max(1)));
    }

    /// The picture has another size `[px]`: what is seen in its left upper corner stays there, as large as it is.
    pub fn resize_still(&mut self, size: [u32; 2]) {
        let (middle, before) = (self.middle(), self.viewport);
        let at = self.world_from_screen([0.0; 2]);
        self.resize(size);
        let ratio = self.viewport.y / before.y;
        match &mut self.pose {
            Pose::Plane { height, .. } => *height = clamp_zoom(*height * ratio),
            Pose::Orbit { distance, .. } => {
                *distance = clamp_zoom(*distance * ratio);
                self.aside = middle / self.viewport - 0.5;
            }
        }
        let mut next = *self;
        next.shift(at - next.world_from_screen([0.0; 2]));
        self.adopt(next);
    }

    /// The same picture moved to the right and down by some pixels: in space what it looks at is seen from the same side as before.
    pub fn moved(&self, [dx, dy]: [f64; 2]) -> Self {
        let mut next = *self;
        match next.pose {
            Pose::Plane { .. } => next.pan([dx, dy]),
            Pose::Orbit { .. } => next.aside += DVec2::new(dx, dy) / self.viewport,
        }
        next
    }

    /// The middle of what it looks at in the picture `[px]`.
    fn middle(&self) -> DVec2 {
        (0.5 + self.aside) * self.viewport
    }

    fn aspect(&self) -> f64 {
        self.viewport.x / self.viewport.y
    }

    /// Width and height of the picture `[px]`.
    pub fn viewport(&self) -> [f32; 2] {
        self.viewport.as_vec2().to_array()
    }

    /// A point near what is seen: positions given to the GPU relative to it keep their digits `[m]`.
    pub fn focus(&self) -> DVec3 {
        match self.pose {
            Pose::Plane { center, .. } => center.extend(0.0),
            Pose::Orbit { target, .. } => target,
        }
    }

    /// Height of the picture at the focus `[m]`.
    pub fn height(&self) -> f64 {
        match self.pose {
            Pose::Plane { height, .. } => height,
            Pose::Orbit { distance, .. } => 2.0 * distance * (0.5 * FIELD_OF_VIEW).tan(),
        }
    }

    /// Distance of what it looks at `[m]`; in the plane 0.
    pub fn distance(&self) -> f64 {
        match self.pose {
            Pose::Plane { .. } => 0.0,
            Pose::Orbit { distance, .. } => distance,
        }
    }

    /// Least distance from the camera that is seen `[m]`; 0 in the plane, where nothing is too near.
    pub fn near(&self) -> f64 {
        match self.pose {
            Pose::Plane { .. } => 0.0,
            Pose::Orbit { distance, .. } => NEAR * distance,
        }
    }

    /// Pixels a metre at the focus.
    pub fn pixels_per_metre(&self) -> f64 {
        self.viewport.y / self.height()
    }

    /// From the world, relative to `origin` `[m]`, to clip space (depth 0 near to 1 far).
    pub fn clip_from_world(&self, origin: DVec3) -> Mat4 {
        self.clip_from_relative(origin).as_mat4()
    }

    pub(in crate::render) fn clip_from_relative(&self, origin: DVec3) -> DMat4 {
        match self.pose {
            Pose::Plane { center, height } => {
                let scale = DVec3::new(2.0 / (height * self.aspect()), 2.0 / height, 0.0);
                let depth = DMat4::from_translation(DVec3::new(0.0, 0.0, 0.5));
                depth * DMat4::from_scale(scale) * DMat4::from_translation(origin - center.extend(0.0))
            }
            Pose::Orbit { target, distance, .. } => {
                let (near, far) = (self.near(), DEPTH_OF_VIEW * self.near());
                let lens = glam::dcamera::rh::proj::directx::perspective(FIELD_OF_VIEW, self.aspect(), near, far);
                let back = self.back();
                let up = self.right().cross(-back);
                // Far from the origin a distance is lost in the target's digits, but not in the offset's.
                let eye = (target - origin) + back * distance;
                let aside = DMat4::from_translation(DVec3::new(2.0 * self.aside.x, -2.0 * self.aside.y, 0.0));
                aside * lens * glam::dcamera::rh::view::look_to_mat4(eye, -back, up)
            }
        }
    }

    /// Unit vector from the focus towards the camera.
    fn back(&self) -> DVec3 {
        match self.pose {
            Pose::Plane { .. } => DVec3::Z,
            Pose::Orbit { yaw, pitch, .. } => DVec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos()),
        }
    }

    /// Unit vector to the right of the picture.
    fn right(&self) -> DVec3 {
        match self.pose {
            Pose::Plane { .. } => DVec3::X,
            Pose::Orbit { yaw, .. } => DVec3::new(yaw.cos(), 0.0, -yaw.sin()),
        }
    }

    /// The point at a pixel, in the plane through the focus that faces the camera `[m]`.
    pub fn world_from_screen(&self, pixel: [f64; 2]) -> DVec3 {
        let offset = (DVec2::from(pixel) - self.middle()) / self.pixels_per_metre();
        let up = self.back().cross(self.right());
        self.focus() + self.right() * offset.x - up * offset.y
    }

    /// The pixel that a point `[m]` is seen at; `None` behind the camera, or for a point that is not finite.
    pub fn screen_from_world(&self, point: DVec3) -> Option<[f64; 2]> {
        let clip: DVec4 = self.clip_from_relative(self.focus()) * (point - self.focus()).extend(1.0);
        // Not a number is nowhere either.
        if !(clip.w > 0.0 && clip.is_finite()) {
            return None;
        }
        let ndc = clip.truncate().truncate() / clip.w;
        Some(((ndc * DVec2::new(0.5, -0.5) + 0.5) * self.viewport).to_array())
    }

    /// Which way a point lies from the middle of the picture `[px]`: where it is seen, or far beyond the edge where it would come into view
    /// first as the camera turned to it. `None`: where it is not a number.
    pub fn way_to(&self, point: DVec3) -> Option<[f64; 2]> {
        if let Some(at) = self.screen_from_world(point) {
            return Some(at);
        }
        let clip: DVec4 = self.clip_from_relative(self.focus()) * (point - self.focus()).extend(1.0);
        let way = DVec2::new(clip.x, -clip.y).normalize_or(DVec2::Y);
        clip.is_finite().then(|| (0.5 * self.viewport + BEHIND * self.viewport.max_element() * way).to_array())
    }

    /// Whether a point is as far ahead of the camera as what is drawn: not behind it, nor beyond all depth.
    pub fn reaches(&self, point: DVec3) -> bool {
        match self.pose {
            Pose::Plane { .. } => true,
            Pose::Orbit { .. } => (self.near()..=DEPTH_OF_VIEW * self.near()).contains(&self.depth(point)),
        }
    }

    /// How far a point lies ahead of the camera `[m]`; in the plane 0.
    pub fn depth(&self, point: DVec3) -> f64 {
        match self.pose {
            Pose::Plane { .. } => 0.0,
            Pose::Orbit { target, distance, .. } => distance - (point - target).dot(self.back()),
        }
    }

    /// Where a pixel points.
    pub fn cursor(&self, pixel: [f64; 2]) -> Cursor {
        let at = self.world_from_screen(pixel);
        match self.pose {
            Pose::Plane { .. } => Cursor::at([at.x, at.y]),
            Pose::Orbit { target, distance, .. } => {
                let eye = target + self.back() * distance;
                Cursor { origin: eye.to_array(), direction: (at - eye).normalize().to_array() }
            }
        }
    }

    /// Zooms by `factor` (above 1: closer); what lies under `pixel` stays there. Does nothing where a number is not finite.
    pub fn zoom_at(&mut self, pixel: [f64; 2], factor: f64) {
        if !(factor > 0.0 && factor.is_finite()) {
            return;
        }
        let before = self.world_from_screen(pixel);
        let mut next = *self;
        match &mut next.pose {
            Pose::Plane { height, .. } => *height = clamp_zoom(*height / factor),
            Pose::Orbit { distance, .. } => *distance = clamp_zoom(*distance / factor),
        }
        next.shift(before - next.world_from_screen(pixel));
        self.adopt(next);
    }

    /// Drags the picture by some pixels. Does nothing where a number is not finite.
    pub fn pan(&mut self, [dx, dy]: [f64; 2]) {
        let middle = 0.5 * self.viewport;
        let from = self.world_from_screen(middle.to_array());
        let mut next = *self;
        next.shift(from - self.world_from_screen((middle + DVec2::new(dx, dy)).to_array()));
        self.adopt(next);
    }

    /// Takes the pose of another camera unless a number of it is not finite: it would never go away again.
    fn adopt(&mut self, next: Camera) {
        let is_finite = match next.pose {
            Pose::Plane { center, height } => center.is_finite() && height.is_finite(),
            Pose::Orbit { target, distance, yaw, pitch } => target.is_finite() && (distance + yaw + pitch).is_finite(),
        };
        if is_finite {
            self.pose = next.pose;
        }
    }

    fn shift(&mut self, by: DVec3) {
        match &mut self.pose {
            Pose::Plane { center, .. } => *center += by.truncate(),
            Pose::Orbit { target, .. } => *target += by,
        }
    }

    /// Turns about the target by a drag of some pixels; in the plane it pans. Does nothing where a number is not finite.
    pub fn orbit(&mut self, [dx, dy]: [f64; 2]) {
        let mut next = *self;
        match &mut next.pose {
            Pose::Plane { .. } => next.pan([dx, dy]),
            Pose::Orbit { yaw, pitch, .. } => {
                *yaw = (*yaw - TURN * dx).rem_euclid(std::f64::consts::TAU);
                // An endless drag would end at the pole, and is nonsense all the same.
                *pitch = if dy.is_finite() { (*pitch + TURN * dy).clamp(-STEEPEST, STEEPEST) } else { dy };
            }
        }
        self.adopt(next);
    }
}

impl Camera {
    /// The same, led here from `before`, with its eye above a floor, which is given by a place on it `[m]` and its unit normal: as it is turned
    /// the pitch ends there, else the target goes up with it. Where the eye was below the floor before, it may stay there.
    pub fn kept_above(self, floor: [DVec3; 2], before: &Camera) -> Self {
        let (Pose::Orbit { pitch, .. }, Pose::Orbit { pitch: was, .. }) = (self.pose, before.pose) else { return self };
        let height = |camera: &Camera| (camera.focus() + camera.back() * camera.distance() - floor[0]).dot(floor[1]);
        let lack = |camera: &Camera| ABOVE * camera.distance() - height(camera);
        if height(before) < 0.0 || lack(&self) <= 0.0 {
            return self;
        }
        let mut kept = self;
        if pitch == was {
            kept.shift(lack(&self) * floor[1]);
            return kept;
        }
        let at = |steep: f64| match self.pose {
            Pose::Orbit { target, distance, yaw, .. } => {
                Camera { pose: Pose::Orbit { target, distance, yaw, pitch: steep }, ..self }
            }
            Pose::Plane { .. } => self,
        };
        let (mut low, mut high) = (pitch, STEEPEST);
        if lack(&at(high)) > 0.0 {
            return *before;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if lack(&at(middle)) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        at(high)
    }
}

fn clamp_zoom(value: f64) -> f64 {
    if value.is_nan() { 1.0 } else { value.clamp(*ZOOM.start(), *ZOOM.end()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cameras() -> [Camera; 2] {
        let plane = Pose::Plane { center: DVec2::new(3.0, -2.0), height: 4.0 };
        let orbit = Pose::Orbit { target: DVec3::new(1.0, 2.0, 3.0), distance: 7.0, yaw: 0.7, pitch: 0.4 };
        [Camera::new(plane, [800, 400]), Camera::new(orbit, [800, 400])]
    }

    fn close(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6
    }

    #[test]
    fn there_and_back() {
        for camera in cameras() {
            for pixel in [[0.0, 0.0], [400.0, 200.0], [799.0, 17.5]] {
                let seen = camera.screen_from_world(camera.world_from_screen(pixel)).unwrap();
                assert!(close(seen, pixel), "{seen:?} {pixel:?}");
            }
        }
        assert_eq!(cameras()[0].world_from_screen([400.0, 0.0]), DVec3::new(3.0, 0.0, 0.0), "y is up");
    }

    #[test]
    fn what_is_under_the_cursor_stays_there() {
        for mut camera in cameras() {
            let at = camera.world_from_screen([100.0, 300.0]);
            camera.zoom_at([100.0, 300.0], 1.7);
            assert!(close(camera.screen_from_world(at).unwrap(), [100.0, 300.0]));
            camera.pan([30.0, -20.0]);
            assert!(close(camera.screen_from_world(at).unwrap(), [130.0, 280.0]));
        }
    }

    #[test]
    fn a_picture_that_gets_lower_shows_the_same_as_large_in_the_same_places() {
        for camera in cameras() {
            let camera = camera.moved([40.0, -10.0]);
            let mut lower = camera;
            lower.resize_still([760, 350]);
            for pixel in [[0.0, 0.0], [400.0, 200.0], [13.0, 340.0]] {
                let at = camera.world_from_screen(pixel);
                assert!(close(lower.screen_from_world(at).unwrap(), pixel), "{pixel:?}");
            }
            lower.resize_still([800, 400]);
            assert!(close(
                lower.screen_from_world(camera.focus()).unwrap(),
                camera.screen_from_world(camera.focus()).unwrap()
            ));
        }
    }

    #[test]
    fn the_cursor_in_space_is_a_ray_through_the_pixel() {
        let camera = cameras()[1];
        let ray = camera.cursor([120.0, 60.0]);
        let far = DVec3::from(ray.origin) + DVec3::from(ray.direction) * 20.0;
        assert!(close(camera.screen_from_world(far).unwrap(), [120.0, 60.0]));
        assert_eq!(cameras()[0].cursor([400.0, 200.0]), Cursor::at([3.0, -2.0]));
    }

    #[test]
    fn the_eye_is_kept_above_a_floor_however_it_is_turned_panned_and_zoomed() {
        let pose = Pose::Orbit { target: DVec3::new(1.0, 0.5, 0.0), distance: 7.0, yaw: 0.7, pitch: 0.4 };
        let floor = [DVec3::new(9.0, -0.5, 3.0), DVec3::Y];
        let height = |camera: &Camera| camera.cursor([0.0, 0.0]).origin[1] + 0.5;
        let start = Camera::new(pose, [800, 400]);
        let ways: [fn(&mut Camera); 3] = [
            |camera| camera.orbit([5.0, -9.0]),
            |camera| camera.pan([3.0, -40.0]),
            |camera| {
                camera.orbit([0.0, -20.0]);
                camera.zoom_at([200.0, 390.0], 0.9);
            },
        ];
        for (k, way) in ways.into_iter().enumerate() {
            let mut camera = start;
            for _ in 0..100 {
                let before = camera;
                way(&mut camera);
                camera = camera.kept_above(floor, &before);
                assert!(height(&camera) > 0.0, "{k}: {camera:?}");
            }
            let mut free = start;
            (0..100).for_each(|_| way(&mut free));
            assert!(height(&free) < 0.0, "{k}: it would be below");
            // Up again it goes at once.
            let (before, mut up) = (camera, camera);
            up.orbit([0.0, 9.0]);
            assert!(height(&up.kept_above(floor, &before)) > height(&camera));
            // Whoever begins below looks from there.
            assert_eq!(free.kept_above(floor, &free), free);
        }
    }

    #[test]
    fn fit_shows_every_corner() {
        let corners = [[-5.0, -5.0, -5.0], [5.0, 3.0, 5.0]];
        for dimensions in [2, 3] {
            for size in [[1280, 720], [300, 900]] {
                let camera = Camera::fit(corners, dimensions, size);
                for i in 0..8_usize {
                    let corner = DVec3::from_array(std::array::from_fn(|k| corners[(i >> k) & 1][k]));
                    let [x, y] = camera.screen_from_world(corner).unwrap();
                    assert!((0.0..f64::from(size[0])).contains(&x) && (0.0..f64::from(size[1])).contains(&y));
                }
            }
        }
    }

    #[test]
    fn numbers_that_are_not_finite_are_ignored() {
        for camera in cameras() {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308] {
                for pixel in [[bad, 10.0], [10.0, bad]] {
                    let mut moved = camera;
                    moved.zoom_at(pixel, 0.5);
                    moved.pan(pixel);
                    if !bad.is_finite() {
                        moved.orbit(pixel);
                    }
                    assert!(bad.is_finite() || moved == camera, "{pixel:?} gave {moved:?}");
                    moved.zoom_at([10.0, 10.0], 0.5);
                    moved.pan([3.0, 4.0]);
                    moved.orbit([3.0, 4.0]);
                    assert!(moved.focus().is_finite() && moved.clip_from_world(moved.focus()).is_finite());
                }
            }
            assert_eq!(camera.screen_from_world(DVec3::new(0.0, f64::NAN, 0.0)), None);
        }
    }

    #[test]
    fn a_box_that_is_not_finite_is_fitted_as_one_of_two_metres() {
        for dimensions in [2, 3] {
            let unit = Camera::fit([[-1.0; 3], [1.0; 3]], dimensions, [300, 200]);
            for bad in [f64::NAN, f64::INFINITY] {
                assert_eq!(Camera::fit([[-1.0, bad, 0.0], [1.0; 3]], dimensions, [300, 200]), unit);
            }
            let huge = Camera::fit([[-1e308; 3], [1e308; 3]], dimensions, [300, 200]);
            assert_eq!(huge.focus(), DVec3::ZERO);
            assert!(huge.height().is_finite() && huge.height() > 1e8, "as far out as there is");
        }
    }

    #[test]
    fn nonsense_leaves_the_camera_sane() {
        for mut camera in cameras() {
            camera.resize([0, 0]);
            camera.zoom_at([0.0, 0.0], f64::NAN);
            camera.zoom_at([0.0, 0.0], 1e-300);
            camera.zoom_at([0.0, 0.0], 1e300);
            camera.orbit([1e4, -1e4]);
            assert!(camera.clip_from_world(DVec3::ZERO).is_finite());
        }
        assert!(Camera::fit([[0.0; 3]; 2], 2, [10, 10]).clip_from_world(DVec3::ZERO).is_finite());
    }
}
