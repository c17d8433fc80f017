//! Triangles that resist a change of their area, as forces in the plane.

use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// Share of its area that a triangle keeps where bodies meet, if nothing is said.
const LEAST: f64 = 0.3;
/// Triangles of less than this share of the square of their longest side have no inside.
const LEAST_AREA: f64 = 1e-6;

/// How triangles resist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Areas {
    /// `[N/m]`, >= 0; 0: not at all, infinite: they keep their areas.
    pub stiffness: f64,
    /// Share of its area that a triangle keeps in any case where bodies meet `[1]`, from 0 to below 1.
    pub least: f64,
}

impl Default for Areas {
    fn default() -> Self {
        Areas { stiffness: 0.0, least: LEAST }
    }
}

impl Areas {
    /// Whether areas are kept exactly.
    pub fn is_rigid(&self) -> bool {
        self.stiffness.is_infinite()
    }
}

/// Area of a triangle `[m^2]`, below 0 where it is inside out.
#[inline(always)]
pub(crate) fn size<S: Real, const D: usize>([a, b, c]: [[S; D]; 3]) -> S {
    let (u, v) = (sub(b, a), sub(c, a));
    S::HALF * (u[0] * v[1] - u[1] * v[0])
}

/// The slopes of a triangle's area by the places of its corners `[m]`.
#[inline(always)]
pub(crate) fn slopes<S: Real, const D: usize>([a, b, c]: [[S; D]; 3]) -> [[S; 2]; 3] {
    let slope = |from: [S; D], to: [S; D]| [S::HALF * (from[1] - to[1]), S::HALF * (to[0] - from[0])];
    [slope(b, c), slope(c, a), slope(a, b)]
}

/// The area that a triangle is made with `[m^2]`: that of the rest lengths of its sides, by Heron's formula, or the one that it has; `None`
/// of what has no inside.
pub(crate) fn rest<S: Real, const D: usize>(corners: [[S; D]; 3], sides: [Option<f64>; 3]) -> Option<f64> {
    let [a, b, c] = corners;
    let (area, longest) = match sides {
        [Some(x), Some(y), Some(z)] => {
            let half = 0.5 * (x + y + z);
            ((half * (half - x) * (half - y) * (half - z)).max(0.0).sqrt(), x.max(y).max(z))
        }
        _ => {
            let square = |u: [S; D]| dot(u, u);
            (size(corners).abs().to_f64(), square(sub(b, a)).max(square(sub(c, a))).to_f64().sqrt())
        }
    };
    (area > LEAST_AREA * longest * longest).then_some(area)
}

/// A triangle with an area as the kernel reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch<S> {
    pub(crate) corners: [u32; 3],
    /// Its area at rest `[m^2]`, > 0.
    pub(crate) rest: S,
    /// `[N/m]`
    pub(crate) stiffness: S,
}

impl<S: Real> Patch<S> {
    /// dE/dA `[N/m]`.
    #[inline(always)]
    fn pressure<const D: usize>(&self, x: [[S; D]; 3]) -> S {
        self.stiffness * (size(x) - self.rest) / self.rest
    }

    /// The forces on its corners `[N]`.
    ///
    /// Model: E = stiffness (A - A0)^2/(2 A0), A signed: a triangle that is inside out is pulled back through none.
    #[inline(always)]
    pub(crate) fn forces<const D: usize>(&self, x: [[S; D]; 3]) -> [[S; 2]; 3] {
        let pressure = self.pressure(x);
        slopes(x).map(|slope| scale(slope, -pressure))
    }

    /// Its energy `[J]`.
    pub(crate) fn energy<const D: usize>(&self, x: [[S; D]; 3]) -> S {
        let off = size(x) - self.rest;
        S::HALF * self.stiffness * off * off / self.rest
    }

    /// Minus the derivative of the forces by the places `[N/m]`; `is_cautious` leaves out what may be negative.
    pub(crate) fn stiffness_blocks<const D: usize>(&self, x: [[S; D]; 3], is_cautious: bool) -> [[[[S; 2]; 2]; 3]; 3] {
        let (g, along) = (slopes(x), self.stiffness / self.rest);
        let half = if is_cautious { S::ZERO } else { S::HALF * self.pressure(x) };
        let mut blocks = [[[[S::ZERO; 2]; 2]; 3]; 3];
        for (m, row) in blocks.iter_mut().enumerate() {
            for (n, block) in row.iter_mut().enumerate() {
                *block = g[m].map(|component| scale(g[n], along * component));
                // The area is linear in each corner: its second derivatives turn one into the next.
                let turn = match (n + 3 - m) % 3 {
                    0 => S::ZERO,
                    1 => half,
                    _ => -half,
                };
                block[0][1] += turn;
                block[1][0] -= turn;
            }
        }
        blocks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: [[f64; 2]; 3] = [[0.3, 1.1], [0.1, 0.2], [1.4, 0.9]];

    #[test]
    fn forces_and_their_derivatives_are_those_of_the_energy() {
        let [a, b, c] = X;
        for x in [X, [a, c, b]] {
            let patch = Patch { corners: [0, 1, 2], rest: 0.7, stiffness: 5.0 };
            let (force, blocks) = (patch.forces(x), patch.stiffness_blocks(x, false));
            let step = 1e-5;
            for n in 0..3 {
                for k in 0..2 {
                    let moved = |by: f64| {
                        let mut x = x;
                        x[n][k] += by;
                        x
                    };
                    let slope = (patch.energy(moved(step)) - patch.energy(moved(-step))) / (2.0 * step);
                    assert!((force[n][k] + slope).abs() < 1e-8, "{} {slope}", force[n][k]);
                    let (more, less) = (patch.forces(moved(step)), patch.forces(moved(-step)));
                    for m in 0..3 {
                        for r in 0..2 {
                            let stiff = -(more[m][r] - less[m][r]) / (2.0 * step);
                            assert!((blocks[m][n][r][k] - stiff).abs() < 1e-7, "{m}{n} {r}{k}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn an_area_is_that_of_the_rest_lengths_or_the_one_at_the_start() {
        let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
        assert_eq!(rest(corners, [None; 3]), Some(1.0));
        assert_eq!(rest(corners, [Some(3.0), None, None]), Some(1.0));
        assert_eq!(rest(corners, [Some(3.0), Some(4.0), Some(5.0)]), Some(6.0));
        assert_eq!(rest([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [None; 3]), None);
        assert_eq!(rest(corners, [Some(1.0), Some(1.0), Some(2.0)]), None);
    }
}
