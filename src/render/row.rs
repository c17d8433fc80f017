//! Where worlds that are drawn side by side lie in a picture: each in a cell of its own, all at one scale.

use glam::DVec3;

use super::camera::Camera;

/// Worlds in a row, or in a column where a picture is higher than wide. The first lies where the camera looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// How many worlds there are, at least 1.
    count: usize,
    /// The middle of the first cell `[m]`.
    center: DVec3,
    /// Width or height of a cell `[m]`.
    length: f64,
    /// One below another.
    is_column: bool,
}

/// So much larger worlds are in a column at least, where they are in one `[1]`: side by side they are compared more easily.
const BETTER: f64 = 1.25;

impl Row {
    /// One world, which has the picture for itself.
    pub const ALONE: Row = Row { count: 1, center: DVec3::ZERO, length: 0.0, is_column: false };

    /// `count` cells of a width and height `[m]`, the first about `center` `[m]`: beside or below each other, whatever leaves them larger in a
    /// picture of `size` `[px]`.
    pub fn new(count: usize, center: DVec3, [width, height]: [f64; 2], size: [u32; 2]) -> Self {
        let [across, down] = size.map(|side| f64::from(side.max(1)));
        let many = count.max(1) as f64;
        let beside = (across / (many * width)).min(down / height);
        let below = (across / width).min(down / (many * height));
        let is_column = below > BETTER * beside;
        Row { count: count.max(1), center, length: if is_column { height } else { width }, is_column }
    }

    /// How many worlds there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether they lie below each other.
    pub fn is_column(&self) -> bool {
        self.is_column
    }

    /// How far world `place` is moved `[px]`.
    fn moved(&self, place: usize, camera: &Camera) -> [f64; 2] {
        let far = place as f64 * self.length * camera.pixels_per_metre();
        if self.is_column { [0.0, far] } else { [far, 0.0] }
    }

    /// The camera of world `place`, where `camera` is that of the first.
    pub fn camera(&self, place: usize, camera: &Camera) -> Camera {
        if place == 0 { *camera } else { camera.moved(self.moved(place, camera)) }
    }

    /// Where cells meet along the row `[px]`: before the first and behind the last there is no end.
    fn edges(&self, camera: &Camera) -> Vec<f64> {
        let axis = usize::from(self.is_column);
        let middle = camera.screen_from_world(self.center).map_or(0.0, |at| at[axis]);
        let pixels = self.length * camera.pixels_per_metre();
        (1..self.count).map(|place| middle + (place as f64 - 0.5) * pixels).collect()
    }

    /// The cell that a pixel lies in.
    pub fn cell_at(&self, pixel: [f64; 2], camera: &Camera) -> usize {
        let at = pixel[usize::from(self.is_column)];
        self.edges(camera).iter().filter(|&&edge| at >= edge).count()
    }

    /// Left, top, width and height of a cell in a picture `[px]`: none where it is out of view.
    pub fn clip(&self, place: usize, camera: &Camera, size: [u32; 2]) -> [u32; 4] {
        let axis = usize::from(self.is_column);
        let most = f64::from(size[axis]);
        let edges = self.edges(camera);
        let edge = |place: Option<usize>, beyond: f64| place.and_then(|k| edges.get(k)).copied().unwrap_or(beyond);
        let [from, to] = [edge(place.checked_sub(1), 0.0), edge(Some(place), most)];
        let [from, to] = [from, to].map(|at| if at.is_nan() { 0.0 } else { at.clamp(0.0, most).round() });
        let mut clip = [0, 0, size[0], size[1]];
        (clip[axis], clip[2 + axis]) = (from as u32, (to - from).max(0.0) as u32);
        clip
    }

    /// The middle of a cell's upper edge, or its upper left corner in a column `[px]`.
    pub fn head(&self, place: usize, camera: &Camera, size: [u32; 2]) -> [f64; 2] {
        let [left, top, width, _] = self.clip(place, camera, size).map(f64::from);
        [left + 0.5 * width, top]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Pose;
    use glam::DVec2;

    #[test]
    fn cells_lie_beside_each_other_where_a_picture_is_wide_and_below_where_it_is_high() {
        let camera = |size| Camera::new(Pose::Plane { center: DVec2::new(4.0, 0.0), height: 9.0 }, size);
        let row = Row::new(2, DVec3::ZERO, [8.0, 8.0], [1600, 900]);
        let wide = camera([1600, 900]);
        assert!(!row.is_column());
        assert_eq!([0, 1].map(|place| row.clip(place, &wide, [1600, 900])), [[0, 0, 800, 900], [800, 0, 800, 900]]);
        assert_eq!([[10.0, 5.0], [799.0, 5.0], [801.0, 5.0]].map(|at| row.cell_at(at, &wide)), [0, 0, 1]);
        // What lies at the same place of both worlds is a cell apart.
        let at = |place: usize| row.camera(place, &wide).screen_from_world(DVec3::new(1.0, 2.0, 0.0)).unwrap();
        assert_eq!([at(1)[0] - at(0)[0], at(1)[1] - at(0)[1]], [800.0, 0.0]);
        let column = Row::new(3, DVec3::new(4.0, 3.0, 0.0), [8.0, 3.0], [720, 1280]);
        assert!(column.is_column());
        let tall = Camera::new(Pose::Plane { center: DVec2::new(4.0, 0.0), height: 12.8 }, [720, 1280]);
        assert_eq!(column.clip(1, &tall, [720, 1280]), [0, 490, 720, 300]);
        assert_eq!(column.clip(2, &tall, [720, 1280]), [0, 790, 720, 490], "the last has all the rest");
        assert_eq!(Row::ALONE.clip(0, &tall, [720, 1280]), [0, 0, 720, 1280]);
    }
}
