//! How long a spring is in a step of the midpoint rule: the mean of both ends of the step.
//!
//! With its length at the middle, the rule would stretch a stiff spring that turns: the chord between two directions is shorter than the arc.
//! With the mean the work of its force is what its energy falls by, at any substep.
//!
//! ```text
//! f_a = -stiffness (l - rest) (d_0 + d_1) / (2 l),   l = (|d_0| + |d_1|) / 2
//! f_a . (d_1 - d_0) = -(stiffness/2) ((|d_1| - rest)^2 - (|d_0| - rest)^2)
//! ```
//!
//! Source: O. Gonzalez, Time Integration and Discrete Hamiltonian Systems, J. Nonlinear Sci. 6, 449 (1996); for springs first R. A. LaBudde
//! and D. Greenspan, Numer. Math. 25, 323 (1976).

use crate::sim::bond::Limit;
use crate::sim::force::spring::Spring;
use crate::sim::real::Real;
use crate::sim::vector::{add, length, scale, sub, zero};

/// The length by which a spring pulls `[m]`, its ends `start` apart at the start of a step and `middle` in its middle: one that may let go has
/// that of the middle, and so has one without a length at rest, which is linear.
pub(crate) fn mean<S: Real, const D: usize>(spring: &Spring<S>, start: [S; D], middle: [S; D]) -> S {
    if spring.limit != Limit::Both || spring.rest_length == S::ZERO {
        return length(middle);
    }
    let end = sub(add(middle, middle), start);
    S::HALF * (length(start) + length(end))
}

/// What that adds to the force on end a `[N]` by the length in the middle.
pub(crate) fn amendment<S: Real, const D: usize>(spring: &Spring<S>, start: [S; D], middle: [S; D]) -> [S; D] {
    let (mean, chord) = (mean(spring, start, middle), length(middle));
    if chord == S::ZERO || mean == chord {
        return zero();
    }
    // stiffness (rest/mean - 1) instead of stiffness (rest/chord - 1).
    scale(middle, spring.stiffness * spring.rest_length * ((chord - mean) / (mean * chord)))
}
