//! Obstacles as the live step meets them: sides and corners of polygons that do not move.

use crate::sim::contact::obstacles::Obstacles;
use crate::sim::real::Real;
use crate::sim::vector::convert;

/// The sides of polygons between shared corners.
#[derive(Clone, Debug, Default)]
pub(super) struct Walls<S> {
    pub(super) corners: Vec<[S; 2]>,
    /// Ends among the corners, and the surface; the free side is on the left.
    pub(super) sides: Vec<([u32; 2], u32)>,
    /// A surface at every corner.
    at_corner: Vec<u32>,
}

impl<S: Real> Walls<S> {
    pub(super) fn of(obstacles: &Obstacles<S, 2>) -> Self {
        let first = obstacles.planes().len();
        let ends: Vec<[[f64; 2]; 2]> = (first..obstacles.surfaces.len())
            .filter_map(|surface| obstacles.wall(surface))
            .map(|wall| wall.ends())
            .collect();
        let bits = |x: &[f64; 2]| x.map(f64::to_bits);
        let mut corners: Vec<[f64; 2]> = ends.iter().flatten().copied().collect();
        corners.sort_unstable_by_key(bits);
        corners.dedup_by_key(|x| bits(x));
        let place = |x: &[f64; 2]| corners.binary_search_by_key(&bits(x), bits).unwrap_or_default() as u32;
        let sides: Vec<([u32; 2], u32)> =
            ends.iter().zip(first as u32..).map(|(ends, surface)| (ends.each_ref().map(place), surface)).collect();
        let mut at_corner = vec![0; corners.len()];
        for &(ends, surface) in &sides {
            ends.into_iter().for_each(|end| at_corner[end as usize] = surface);
        }
        Walls { sides, at_corner, corners: corners.iter().map(|&x| convert(x)).collect() }
    }

    /// The surface of a side.
    pub(super) fn surface_of_side(&self, side: u32) -> usize {
        self.sides[side as usize].1 as usize
    }

    /// A surface that ends in a corner.
    pub(super) fn surface_of_corner(&self, corner: u32) -> usize {
        self.at_corner[corner as usize] as usize
    }

    /// The sides that may touch a box.
    pub(super) fn near(&self, [low, high]: [[S; 2]; 2]) -> impl Iterator<Item = u32> + '_ {
        (0..self.sides.len() as u32).filter(move |&side| {
            let [a, b] = self.sides[side as usize].0.map(|end| self.corners[end as usize]);
            (0..2).all(|k| a[k].min(b[k]) <= high[k] && a[k].max(b[k]) >= low[k])
        })
    }
}
