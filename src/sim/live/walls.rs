//! Obstacles as the live step meets them: sides and corners of polygons that do not move, and circles.

use super::circle::Circle;
use super::pair::{beside, is_right_of};
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::real::Real;
use crate::sim::vector::convert;

/// The sides of polygons between shared corners, and circles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Walls<S> {
    /// Corners of sides, then centres of circles.
    pub(super) corners: Vec<[S; 2]>,
    /// Ends among the corners, and the surface; the free side is on the left.
    pub(super) sides: Vec<([u32; 2], u32)>,
    pub(super) circles: Vec<Circle<S>>,
    /// A surface at every corner.
    at_corner: Vec<u32>,
}

impl<S: Real> Walls<S> {
    pub(super) fn of(obstacles: &Obstacles<S, 2>) -> Self {
        let (mut ends, mut rounds) = (Vec::new(), Vec::new());
        for surface in obstacles.planes().len()..obstacles.surfaces.len() {
            let Some(wall) = obstacles.wall(surface) else { continue };
            match obstacles.round(wall) {
                Some((polygon, round)) => rounds.push((polygon, round, surface as u32)),
                None => ends.push((wall.ends(), surface as u32)),
            }
        }
        // A circle all of whose sides are within other obstacles is met by nobody.
        rounds.sort_by_key(|round| round.0);
        rounds.dedup_by_key(|round| round.0);
        let bits = |x: &[f64; 2]| x.map(f64::to_bits);
        let mut corners: Vec<[f64; 2]> = ends.iter().flat_map(|side| side.0).collect();
        corners.sort_unstable_by_key(bits);
        corners.dedup_by_key(|x| bits(x));
        let place = |x: &[f64; 2]| corners.binary_search_by_key(&bits(x), bits).unwrap_or_default() as u32;
        let sides: Vec<([u32; 2], u32)> =
            ends.iter().map(|(ends, surface)| (ends.each_ref().map(place), *surface)).collect();
        let mut at_corner = vec![0; corners.len()];
        for &(ends, surface) in &sides {
            ends.into_iter().for_each(|end| at_corner[end as usize] = surface);
        }
        corners.extend(rounds.iter().map(|(_, round, _)| round.center));
        at_corner.extend(rounds.iter().map(|&(.., surface)| surface));
        let circle = |&(_, round, surface)| Circle::new(round, &obstacles.surfaces[surface as usize]);
        let circles = rounds.iter().map(circle).collect();
        Walls { sides, circles, at_corner, corners: corners.iter().map(|&x| convert(x)).collect() }
    }

    /// The surface of a side.
    pub(super) fn surface_of_side(&self, side: u32) -> usize {
        self.sides[side as usize].1 as usize
    }

    /// A surface that ends in a corner.
    pub(super) fn surface_of_corner(&self, corner: u32) -> usize {
        self.at_corner[corner as usize] as usize
    }

    /// The corner that is the centre of a circle.
    pub(super) fn corner_of_circle(&self, circle: u32) -> u32 {
        (self.corners.len() - self.circles.len()) as u32 + circle
    }

    /// How deep a place lies in one of them `[m]`; 0 outside.
    pub(super) fn depth(&self, x: [S; 2]) -> S {
        let (mut is_inside, mut nearest) = (false, S::INFINITY);
        for side in &self.sides {
            let [a, b] = side.0.map(|end| self.corners[end as usize]);
            is_inside ^= is_right_of([a, b], x);
            let gap = beside([x, a, b], -S::ONE).map_or(S::INFINITY, |found| found.gap);
            nearest = if gap >= S::ZERO { nearest.min(gap) } else { nearest };
        }
        let of_sides = if is_inside && nearest.is_finite() { nearest } else { S::ZERO };
        self.circles.iter().fold(of_sides, |most, circle| most.max(-circle.gap(x)))
    }

    /// The sides that may touch a box.
    pub(super) fn near(&self, [low, high]: [[S; 2]; 2]) -> impl Iterator<Item = u32> + '_ {
        (0..self.sides.len() as u32).filter(move |&side| {
            let [a, b] = self.sides[side as usize].0.map(|end| self.corners[end as usize]);
            (0..2).all(|k| a[k].min(b[k]) <= high[k] && a[k].max(b[k]) >= low[k])
        })
    }
}
