//! Polygons with so many equal sides that they are circles.

use super::Polygon;
use crate::sim::sizes::LEAST_SIDES;
use crate::sim::vector::{add, cross, dot, sub};

/// Share of its radius and of its coordinates by which a corner may lie beside the circle.
const ROUNDED: f64 = 1e-12;

/// A circle in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    /// Its centre `[m]`.
    pub(crate) center: [f64; 2],
    /// `[m]`, > 0.
    pub(crate) radius: f64,
}

impl Round {
    /// The circle through the corners of a regular polygon that goes round once; `None` of any other.
    pub(crate) fn of(polygon: &Polygon) -> Option<Self> {
        let [corners] = polygon.loops.as_slice() else { return None };
        let count = corners.len();
        if count < LEAST_SIDES {
            return None;
        }
        let first = corners[0];
        let mean = |k: usize| corners.iter().fold(0.0, |sum, x| sum + (x[k] - first[k])) / count as f64;
        let center = add(first, [mean(0), mean(1)]);
        let from: Vec<[f64; 2]> = corners.iter().map(|&corner| sub(corner, center)).collect();
        let radius = from.iter().fold(0.0, |sum, &r| sum + dot(r, r).sqrt()) / count as f64;
        let slack = ROUNDED * (radius + center[0].abs().max(center[1].abs()));
        let sine = libm::sin(std::f64::consts::TAU / count as f64).copysign(cross(from[0], from[1]));
        let is_on = |&r: &[f64; 2]| (dot(r, r).sqrt() - radius).abs() <= slack;
        let is_next = |k: usize| (cross(from[k], from[(k + 1) % count]) / radius - radius * sine).abs() <= 4.0 * slack;
        (radius > 0.0 && from.iter().all(is_on) && (0..count).all(is_next)).then_some(Round { center, radius })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    /// Corners on an ellipse, that go round it so many times.
    fn corners(count: u32, times: u32, [a, b]: [f64; 2]) -> Polygon {
        let angle = |k: u32| std::f64::consts::TAU * f64::from(times * k) / f64::from(count);
        let corner = |k: u32| [1e3 + a * libm::cos(angle(k)), b * libm::sin(angle(k)) - 7.0];
        Polygon { loops: vec![(0..count).map(corner).collect()], restitution: 0.0, friction: 0.0 }
    }

    #[test]
    fn a_regular_polygon_of_many_sides_is_a_circle() {
        for radius in [0.02, 1.0, 300.0] {
            let mut polygon = corners(2048, 1, [radius; 2]);
            let round = Round::of(&polygon).unwrap();
            let off = sub(round.center, [1e3, -7.0]);
            assert!((round.radius / radius - 1.0).abs() < 1e-10 && dot(off, off).sqrt() < 1e-10, "{round:?}");
            polygon.loops[0].reverse();
            assert_eq!(Round::of(&polygon).map(|round| round.radius > 0.0), Some(true), "the other way round");
        }
    }

    #[test]
    fn what_is_not_round_is_a_polygon() {
        let circle = || corners(2048, 1, [1.0; 2]);
        let mut dented = circle();
        dented.loops[0][5][0] += 1e-6;
        let mut lacking = circle();
        lacking.loops[0].pop();
        let mut hole = circle();
        hole.loops.push(vec![[1e3, -7.0], [1e3 + 0.1, -7.0], [1e3, -6.9]]);
        let others = [corners(512, 1, [1.0; 2]), corners(2049, 2, [1.0; 2]), corners(2048, 1, [1.0, 1.001])];
        let point = Polygon { loops: vec![vec![[1.0, 2.0]; 2048]], ..circle() };
        let none = Polygon { loops: Vec::new(), ..circle() };
        for (k, polygon) in others.iter().chain([&dented, &lacking, &hole, &point, &none]).enumerate() {
            assert_eq!(Round::of(polygon), None, "{k}");
        }
    }
}
