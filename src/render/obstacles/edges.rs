//! Edges of obstacles: along them alone what is covered of a picture has to be looked at for a rim.

use std::ops::Range;

use glam::DVec2;

use crate::sim::vector::span_in_box;

/// How far from an edge beyond the width of a rim pixels may be other than beside none `[px]`: `BEYOND` in obstacles.wgsl.
const BEYOND: f64 = 2.2;
/// Most pixels about edges, beside all that obstacles may cover: where there are more, those are looked at without them `[1]`.
const MOST: f64 = 0.6;

/// The part of an edge in a square about 0, half of whose side is `reach`; `None`: it lies beside it.
pub(super) fn within([a, b]: [DVec2; 2], reach: f64) -> Option<[DVec2; 2]> {
    let way = b - a;
    let span = span_in_box([a, way].map(|of| of.to_array()), [[-reach; 2], [reach; 2]], 1.0)?;
    Some(span.map(|share| a + share * way))
}

/// The part in that square of the line along which `normal` . x is `depth`.
pub(super) fn line(normal: DVec2, depth: f64, reach: f64) -> Option<[DVec2; 2]> {
    let (foot, along) = (depth * normal, normal.perp());
    // Twice as far from its foot as from the square's middle to a corner, it is out of the square.
    let far = 4.0 * reach;
    within([foot - far * along, foot + far * along], reach)
}

/// Pixels about edges in view, counted one by one, and how many they may be.
pub(super) struct Room {
    low: DVec2,
    high: DVec2,
    reach: f64,
    pixels: f64,
}

impl Room {
    /// For edges within `bounds`: left, top, right and bottom of what obstacles may cover; with rims of a width. All `[px]`.
    pub(super) fn new(bounds: [f32; 4], outline: f32) -> Self {
        let [left, top, right, bottom] = bounds.map(f64::from);
        let reach = f64::from(outline) + BEYOND;
        Room { low: DVec2::new(left, top), high: DVec2::new(right, bottom), reach, pixels: 0.0 }
    }

    /// Counts the pixels about an edge between two places `[px]`: what of it is in view is no longer than its box is wide and high.
    pub(super) fn count(&mut self, [a, b]: [DVec2; 2]) {
        let low = (a.min(b) - self.reach).max(self.low);
        let high = (a.max(b) + self.reach).min(self.high);
        let size = high - low;
        if size.min_element() > 0.0 {
            // The box itself may be smaller: of an edge that leads across or down.
            self.pixels += (size.element_sum() * 2.0 * self.reach).min(size.element_product());
        }
    }

    /// Whether they are few beside all that obstacles may cover.
    pub(super) fn is_small(&self) -> bool {
        self.pixels < MOST * (self.high - self.low).element_product()
    }
}

/// Runs that follow on each other as one.
pub(super) fn join(runs: &mut Vec<Range<u32>>, next: Range<u32>) {
    match runs.last_mut() {
        Some(run) if run.end == next.start => run.end = next.end,
        _ => runs.push(next),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::fill_outline;
    use crate::sim::triangles::outer_sides;

    #[test]
    fn the_shader_looks_as_far_from_an_edge() {
        assert!(include_str!("../../../shaders/obstacles.wgsl").contains(&format!("const BEYOND: f32 = {BEYOND};")));
    }

    #[test]
    fn a_filling_ends_along_its_outlines() {
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
        let filling = fill_outline(&[square(0.0, 9.0), square(3.0, 6.0)]);
        assert!(filling.triangles.len() > 6);
        let sides: Vec<[u32; 2]> = outer_sides(filling.triangles).into_iter().map(|side| side.ends).collect();
        assert_eq!(sides, [[0, 1], [0, 3], [1, 2], [2, 3], [4, 5], [4, 7], [5, 6], [6, 7]], "the hole's too");
    }

    #[test]
    fn edges_are_cut_to_the_square() {
        let [a, b, c] = [DVec2::new(-3.0, 0.5), DVec2::new(5.0, 0.5), DVec2::new(5.0, 9.0)];
        assert_eq!(within([a, b], 1.0), Some([DVec2::new(-1.0, 0.5), DVec2::new(1.0, 0.5)]));
        assert_eq!(within([a, b], 10.0), Some([a, b]));
        assert_eq!((within([b, c], 1.0), within([b, b], 1.0)), (None, None));
        assert_eq!(within([DVec2::ZERO; 2], 1.0), Some([DVec2::ZERO; 2]), "of no length");
        let ends: Vec<DVec2> = line(DVec2::new(0.6, 0.8), 0.3, 1.0).into_iter().flatten().collect();
        assert_eq!(ends.len(), 2, "it goes through the square");
        for end in ends {
            assert!((end.dot(DVec2::new(0.6, 0.8)) - 0.3).abs() < 1e-12, "{end} is on it");
            assert!((end.abs().max_element() - 1.0).abs() < 1e-12, "{end} is where it leaves the square");
        }
        assert_eq!(line(DVec2::X, 2.0, 1.0), None);
    }

    #[test]
    fn many_edges_in_a_small_part_of_the_picture_are_more_than_all_of_it() {
        let mut room = Room::new([0.0, 0.0, 200.0, 100.0], 1.5);
        room.count([DVec2::new(-1e6, 50.0), DVec2::new(1e6, 50.0)]);
        assert!(room.is_small(), "what of it is in view is 200 px long");
        room.count([DVec2::new(-9.0, -9.0), DVec2::new(900.0, -9.0)]);
        assert!((room.pixels - 200.0 * 7.4).abs() < 1e-9, "{} px: nothing of the second is in view", room.pixels);
        (0..100).for_each(|k| room.count([DVec2::new(f64::from(k), 20.0), DVec2::new(f64::from(k), 60.0)]));
        assert!(!room.is_small());
        assert!(!Room::new([9.0, 9.0, 9.0, 9.0], 1.5).is_small(), "of nothing");
    }

    #[test]
    fn runs_that_follow_on_each_other_are_one() {
        let mut runs = Vec::new();
        [0..2, 2..6, 8..10].into_iter().for_each(|run| join(&mut runs, run));
        assert_eq!(runs, [0..6, 8..10]);
    }
}
