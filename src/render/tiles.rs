//! How a picture is shared by worlds side by side: panes that show the same part of each at the same scale. They are equal but for what lies over
//! the upper edge of the picture: of several rows the first is higher by that.

use super::camera::{Camera, Pose};

/// Panes in rows of the same number, of which the last may have fewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiles {
    /// How many there are, at least 1.
    count: usize,
    /// How many stand in a row, from 1 to all.
    columns: usize,
    /// Height of what lies over the upper edge of the picture, which is no room for worlds `[px]`.
    head: u32,
}

/// So much larger worlds are in more rows at least, where they are in more `[1]`: side by side they are compared more easily.
const BETTER: f64 = 1.1;

impl Tiles {
    /// One world, which has the picture for itself.
    pub const ALONE: Tiles = Tiles { count: 1, columns: 1, head: 0 };

    /// `count` panes for worlds of a width and height, in as many rows as leave them largest in a picture of `size` `[px]`. `taken` is what
    /// of each pane's width and height is not for the world `[px]`, below `head`, the height of what lies over the picture's upper edge `[px]`.
    pub fn new(count: usize, [width, height]: [f64; 2], size: [u32; 2], (taken, head): ([f64; 2], f64)) -> Self {
        let (count, head) = (count.max(1), head.round() as u32);
        let shared = [size[0], size[1].saturating_sub(head)];
        let scale = |columns: usize| {
            let parts = [columns, count.div_ceil(columns)].map(|parts| parts as f64);
            let [across, down] = [0, 1].map(|axis| (f64::from(shared[axis]) / parts[axis] - taken[axis]).max(1.0));
            (across / width).min(down / height)
        };
        let mut best = count;
        // Three have no row of their own for the last one: a quarter of the picture would be empty.
        let is_full = |columns: &usize| count.is_multiple_of(*columns) || count > 4;
        for columns in (1..=count).map(|rows| count.div_ceil(rows)).filter(is_full) {
            if scale(columns) > BETTER * scale(best) {
                best = columns;
            }
        }
        Tiles { count, columns: best, head }
    }

    /// The same in a picture of another size: what lies over its upper edge is so many times as high.
    pub fn at_scale(&self, factor: f64) -> Tiles {
        Tiles { head: (factor * f64::from(self.head)).round() as u32, ..*self }
    }

    /// How many worlds there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many stand side by side.
    pub fn columns(&self) -> usize {
        self.columns
    }

    fn parts(&self) -> [usize; 2] {
        [self.columns, self.count.div_ceil(self.columns)]
    }

    /// In which column and which row pane `place` is.
    fn cell(&self, place: usize) -> [usize; 2] {
        [place % self.columns, place / self.columns]
    }

    /// How far a column or a row is from the first `[px]`, in a picture that is so long.
    fn way(&self, axis: usize, cell: usize, length: u32) -> u32 {
        let shared = length - self.head_of(axis, length);
        (cell as u64 * u64::from(shared) / self.parts()[axis] as u64) as u32
    }

    /// By how much the first column or row is longer than the others `[px]`.
    fn head_of(&self, axis: usize, length: u32) -> u32 {
        if axis == 1 { self.head.min(length) } else { 0 }
    }

    /// Where a column or a row begins `[px]`, in a picture that is so long.
    fn edge(&self, axis: usize, cell: usize, length: u32) -> u32 {
        if cell == 0 { 0 } else { self.head_of(axis, length) + self.way(axis, cell, length) }
    }

    /// Left, top, width and height of a pane in a picture of `size` `[px]`.
    pub fn clip(&self, place: usize, size: [u32; 2]) -> [u32; 4] {
        let cell = self.cell(place);
        let [[left, right], [top, bottom]] =
            [0, 1].map(|axis| [0, 1].map(|end| self.edge(axis, cell[axis] + end, size[axis])));
        [left, top, right - left, bottom - top]
    }

    /// Width and height of the first pane `[px]`, each at least 1.
    pub fn pane(&self, size: [u32; 2]) -> [u32; 2] {
        let [_, _, width, height] = self.clip(0, size);
        [width.max(1), height.max(1)]
    }

    /// The pane that a pixel lies in: beside all of them the nearest.
    pub fn pane_at(&self, pixel: [f64; 2], size: [u32; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis| {
            let begins = |cell: &usize| pixel[axis] >= f64::from(self.edge(axis, *cell, size[axis]));
            (1..self.parts()[axis]).filter(begins).count()
        });
        (row * self.columns + column).min(self.count - 1)
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

    /// The camera of the first pane alone, of a whole picture's: see [`Tiles::whole`].
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
        let cell = self.cell(place);
        [0, 1].map(|axis| f64::from(self.way(axis, cell[axis], size[axis])))
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

    fn tiles(count: usize, world: [f64; 2], size: [u32; 2]) -> Tiles {
        Tiles::new(count, world, size, ([0.0; 2], 0.0))
    }

    #[test]
    fn panes_share_a_picture_in_as_many_rows_as_leave_worlds_largest() {
        let wide = tiles(3, [8.0, 8.0], [1600, 600]);
        assert_eq!(wide.columns(), 3);
        let clips = [0, 1, 2].map(|place| wide.clip(place, [1600, 900]));
        assert_eq!(clips, [[0, 0, 533, 900], [533, 0, 533, 900], [1066, 0, 534, 900]], "all of it, to the last pixel");
        let at = [[-5.0, 1.0], [532.0, 1.0], [533.0, 1.0], [9999.0, 1.0]];
        assert_eq!(at.map(|at| wide.pane_at(at, [1600, 900])), [0, 0, 1, 2]);
        // Three leave no part of it empty: they stand beside or below each other.
        let three = [[1280, 720], [900, 1000], [720, 1280]].map(|size| tiles(3, [1.0, 1.0], size).columns());
        assert_eq!(three, [3, 1, 1]);
        let high = tiles(2, [8.0, 3.0], [720, 1280]);
        assert_eq!(high.columns(), 1);
        assert_eq!(high.clip(1, [720, 1280]), [0, 640, 720, 640]);
        assert_eq!(Tiles::ALONE.clip(0, [720, 1280]), [0, 0, 720, 1280]);
        assert!((0..3).all(|place| wide.clip(place, [2, 0])[2] <= 1), "a picture of no room");
        // Five stand in three and two where it is wide, in two, two and one where it is high.
        let five = [[1280, 720], [720, 1280]].map(|size| tiles(5, [1.0, 1.0], size));
        assert_eq!(five.map(|tiles| tiles.columns()), [3, 2]);
        assert_eq!(five[0].clip(4, [1280, 720]), [426, 360, 427, 360]);
        let at = [[1279.0, 1.0], [1.0, 719.0], [430.0, 400.0], [1279.0, 719.0]];
        assert_eq!(at.map(|at| five[0].pane_at(at, [1280, 720])), [2, 3, 4, 4]);
        // Where titles take most of what is left, there are fewer rows.
        assert_eq!(Tiles::new(5, [1.0, 1.0], [1280, 720], ([0.0, 300.0], 0.0)).columns(), 5);
    }

    #[test]
    fn below_what_lies_over_the_upper_edge_all_rows_are_alike() {
        let size = [720, 1280];
        let tiles = Tiles::new(3, [8.0, 3.0], size, ([0.0; 2], 200.0));
        let clips = [0, 1, 2].map(|place| tiles.clip(place, size));
        assert_eq!(clips, [[0, 0, 720, 560], [0, 560, 720, 360], [0, 920, 720, 360]]);
        assert_eq!([199.0, 559.0, 560.0, 921.0].map(|y| tiles.pane_at([9.0, y], size)), [0, 0, 1, 2]);
        let own = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 9.0 }, tiles.pane(size));
        let whole = tiles.whole(&own, size);
        // What is seen so far below the head in the first is so far below the upper edge of the others.
        let at = own.world_from_screen([100.0, 250.0]);
        for place in 1..3 {
            let there = tiles.camera(place, &whole, size).screen_from_world(at).unwrap();
            let top = f64::from(clips[place][1]);
            assert!((there[1] - top - 50.0).abs() < 1e-6, "{there:?} in pane {place}");
        }
        let low = [720, 100];
        assert!((0..3).all(|place| tiles.clip(place, low)[3] <= 100), "a picture lower than what lies over it");
    }

    #[test]
    fn every_pane_shows_what_a_camera_of_its_own_does() {
        let plane = Pose::Plane { center: DVec2::new(4.0, 1.0), height: 9.0 };
        let orbit = Pose::Orbit { target: DVec3::new(1.0, 2.0, 3.0), distance: 7.0, yaw: 0.7, pitch: 0.4 };
        let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6;
        let of_pose = |pose: Pose| [[1600, 900], [700, 1300]].map(|size| (pose, size));
        let all = [plane, orbit].into_iter().flat_map(of_pose);
        for ((pose, size), count) in all.flat_map(|one| [(one, 2), (one, 5)]) {
            let tiles = tiles(count, [8.0, 8.0], size);
            let own = Camera::new(pose, tiles.pane(size));
            let whole = tiles.whole(&own, size);
            // In several rows a camera in space looks from further away: what lies beside its target is seen from another side.
            let is_same = pose == plane || tiles.columns() == count;
            let point = if is_same { DVec3::new(1.5, 2.5, if pose == plane { 0.0 } else { 2.2 }) } else { own.focus() };
            let seen = own.screen_from_world(point).unwrap();
            for place in 0..count {
                let [left, top, ..] = tiles.clip(place, size).map(f64::from);
                let camera = tiles.camera(place, &whole, size);
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
            let again = tiles.own(&whole, size).screen_from_world(point).unwrap();
            assert!(close(again, seen), "{pose:?}: {again:?} for {seen:?}");
        }
    }
}
