//! How a picture is shared by worlds side by side: equal panes that show the same part of each at the same scale.

use super::camera::{Camera, Pose};

/// Panes in a row, or in a column where a picture is higher than wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// How many there are, at least 1.
    count: usize,
    /// One below another.
    is_column: bool,
}

/// So much larger worlds are in a column at least, where they are in one `[1]`: side by side they are compared more easily.
const BETTER: f64 = 1.25;

impl Row {
    /// One world, which has the picture for itself.
    pub const ALONE: Row = Row { count: 1, is_column: false };

    /// `count` panes for worlds of a width and height: beside or below each other, whatever leaves them larger in a picture of `size` `[px]`.
    pub fn new(count: usize, [width, height]: [f64; 2], size: [u32; 2]) -> Self {
        let [across, down] = size.map(|side| f64::from(side.max(1)));
        let many = count.max(1) as f64;
        let beside = (across / (many * width)).min(down / height);
        let below = (across / width).min(down / (many * height));
        Row { count: count.max(1), is_column: below > BETTER * beside }
    }

    /// How many worlds there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether they lie below each other.
    pub fn is_column(&self) -> bool {
        self.is_column
    }

    fn axis(&self) -> usize {
        usize::from(self.is_column)
    }

    /// Where pane `place` begins along the row `[px]`, in a picture that is so long.
    fn edge(&self, place: usize, length: u32) -> u32 {
        (place as u64 * u64::from(length) / self.count as u64) as u32
    }

    /// Left, top, width and height of a pane in a picture of `size` `[px]`.
    pub fn clip(&self, place: usize, size: [u32; 2]) -> [u32; 4] {
        let axis = self.axis();
        let [from, to] = [place, place + 1].map(|place| self.edge(place, size[axis]));
        let mut clip = [0, 0, size[0], size[1]];
        (clip[axis], clip[2 + axis]) = (from, to - from);
        clip
    }

    /// Width and height of the first pane `[px]`, each at least 1.
    pub fn pane(&self, size: [u32; 2]) -> [u32; 2] {
        let [_, _, width, height] = self.clip(0, size);
        [width.max(1), height.max(1)]
    }

    /// The pane that a pixel lies in: beside the picture the nearest.
    pub fn pane_at(&self, pixel: [f64; 2], size: [u32; 2]) -> usize {
        let at = pixel[self.axis()];
        (1..self.count).filter(|&place| at >= f64::from(self.edge(place, size[self.axis()]))).count()
    }

    /// The camera of a whole picture of `size` `[px]` whose first pane shows what `own` does, which is a camera of that pane alone.
    pub fn whole(&self, own: &Camera, size: [u32; 2]) -> Camera {
        if self.count == 1 {
            return *own;
        }
        let pane = self.pane(size);
        let mut camera = Camera::new(enlarged(own.pose, f64::from(size[1].max(1)) / f64::from(pane[1])), size);
        camera = camera.moved(self.off(size));
        camera
    }

    /// The camera of the first pane alone, of a whole picture's: see [`Row::whole`].
    pub fn own(&self, camera: &Camera, size: [u32; 2]) -> Camera {
        if self.count == 1 {
            return *camera;
        }
        let pane = self.pane(size);
        let back = camera.moved(self.off(size).map(|off| -off));
        Camera::new(enlarged(back.pose, f64::from(pane[1]) / f64::from(size[1].max(1))), pane)
    }

    /// How far the middle of the first pane is from that of the picture `[px]`.
    fn off(&self, size: [u32; 2]) -> [f64; 2] {
        let pane = self.pane(size);
        std::array::from_fn(|axis| 0.5 * (f64::from(pane[axis]) - f64::from(size[axis].max(1))))
    }

    /// How far pane `place` is from the first `[px]`.
    pub fn shift(&self, place: usize, size: [u32; 2]) -> [f64; 2] {
        let mut shift = [0.0; 2];
        shift[self.axis()] = f64::from(self.edge(place, size[self.axis()]));
        shift
    }

    /// The camera of world `place` in a picture of `size` `[px]`, where `camera` is that of the first.
    pub fn camera(&self, place: usize, camera: &Camera, size: [u32; 2]) -> Camera {
        if place == 0 { *camera } else { camera.moved(self.shift(place, size)) }
    }
}

/// The same look at so many times as much.
fn enlarged(pose: Pose, factor: f64) -> Pose {
    match pose {
        Pose::Plane { center, height } => Pose::Plane { center, height: factor * height },
        Pose::Orbit { target, distance, yaw, pitch } => Pose::Orbit { target, distance: factor * distance, yaw, pitch },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    #[test]
    fn panes_share_a_picture_beside_each_other_where_it_is_wide_and_below_where_it_is_high() {
        let wide = Row::new(3, [8.0, 8.0], [1600, 900]);
        assert!(!wide.is_column());
        let clips = [0, 1, 2].map(|place| wide.clip(place, [1600, 900]));
        assert_eq!(clips, [[0, 0, 533, 900], [533, 0, 533, 900], [1066, 0, 534, 900]], "all of it, to the last pixel");
        let at = [[-5.0, 1.0], [532.0, 1.0], [533.0, 1.0], [9999.0, 1.0]];
        assert_eq!(at.map(|at| wide.pane_at(at, [1600, 900])), [0, 0, 1, 2]);
        let high = Row::new(2, [8.0, 3.0], [720, 1280]);
        assert!(high.is_column());
        assert_eq!(high.clip(1, [720, 1280]), [0, 640, 720, 640]);
        assert_eq!(Row::ALONE.clip(0, [720, 1280]), [0, 0, 720, 1280]);
        assert!((0..3).all(|place| wide.clip(place, [2, 0])[2] <= 1), "a picture of no room");
    }

    #[test]
    fn every_pane_shows_what_a_camera_of_its_own_does() {
        let plane = Pose::Plane { center: DVec2::new(4.0, 1.0), height: 9.0 };
        let orbit = Pose::Orbit { target: DVec3::new(1.0, 2.0, 3.0), distance: 7.0, yaw: 0.7, pitch: 0.4 };
        let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6;
        for (pose, size) in [(plane, [1600, 900]), (plane, [700, 1300]), (orbit, [1600, 900]), (orbit, [700, 1300])] {
            let row = Row::new(2, [8.0, 8.0], size);
            let own = Camera::new(pose, row.pane(size));
            let whole = row.whole(&own, size);
            // In a column a camera in space looks from further away: what lies beside its target is seen from another side.
            let is_same = pose == plane || !row.is_column();
            let point = if is_same { DVec3::new(1.5, 2.5, if pose == plane { 0.0 } else { 2.2 }) } else { own.focus() };
            let seen = own.screen_from_world(point).unwrap();
            for place in 0..2 {
                let [left, top, ..] = row.clip(place, size).map(f64::from);
                let camera = row.camera(place, &whole, size);
                let there = camera.screen_from_world(point).unwrap();
                assert!(
                    close([there[0] - left, there[1] - top], seen),
                    "{pose:?}: {there:?} for {seen:?} in pane {place}"
                );
                if !is_same {
                    continue;
                }
                let ray = camera.cursor(there);
                let same = own.cursor(seen);
                assert!((DVec3::from(ray.origin) - DVec3::from(same.origin)).length() < 1e-9, "{pose:?}");
                assert!((DVec3::from(ray.direction) - DVec3::from(same.direction)).length() < 1e-9, "{pose:?}");
            }
            let again = row.own(&whole, size).screen_from_world(point).unwrap();
            assert!(close(again, seen), "{pose:?}: {again:?} for {seen:?}");
        }
    }
}
