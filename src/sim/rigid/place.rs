//! Where a rigid body is, and how it is turned.

use super::motion::Pose;
use crate::sim::vector::{add, dot, scale};

/// Angle below which what is left out of its cosine is below rounding `[rad]`.
const SLIGHT: f64 = 5e-3;

/// Where a rigid body is: places of its shape are turned, then carried along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Where the origin of the shape is `[m]`.
    pub(crate) middle: [f64; 2],
    /// `[rad]`, counted from where somebody began to.
    pub(crate) angle: f64,
    /// Cosine and sine of the whole angle.
    pub(crate) turn: [f64; 2],
}

impl Place {
    /// There, not turned.
    pub(crate) fn at(middle: [f64; 2]) -> Self {
        Place { middle, angle: 0.0, turn: [1.0, 0.0] }
    }

    /// Moved on, and turned by an angle.
    #[inline(always)]
    pub(crate) fn moved(&self, by: [f64; 2], angle: f64) -> Self {
        let ([c, s], [x, y]) = (self.turn, direction(angle));
        let turn = [c * x - s * y, s * x + c * y];
        // Rounding must not make it grow.
        let turn = scale(turn, 1.5 - 0.5 * dot(turn, turn));
        Place { middle: add(self.middle, by), angle: self.angle + angle, turn }
    }
}

impl Pose<2> for Place {
    type Spin = f64;

    #[inline(always)]
    fn middle(&self) -> [f64; 2] {
        self.middle
    }

    #[inline(always)]
    fn turned(&self, q: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn;
        [c * q[0] - s * q[1], s * q[0] + c * q[1]]
    }

    #[inline(always)]
    fn back(&self, v: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn;
        [c * v[0] + s * v[1], c * v[1] - s * v[0]]
    }

    #[inline(always)]
    fn shifted(&self, by: [f64; 2]) -> Self {
        self.moved(by, 0.0)
    }

    fn is_finite(&self) -> bool {
        self.middle.iter().chain(&self.turn).all(|x| x.is_finite())
    }
}

/// Cosine and sine: most pushes turn a body so little that the first terms of their series are all that is left of them.
#[inline(always)]
fn direction(angle: f64) -> [f64; 2] {
    let square = angle * angle;
    if square < SLIGHT * SLIGHT {
        let cos = 1.0 - square * (1.0 / 2.0 - square * (1.0 / 24.0));
        return [cos, angle * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)))];
    }
    [libm::cos(angle), libm::sin(angle)]
}
