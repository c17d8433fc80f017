//! What a substep must not do to a bond: such a substep is taken again in two halves.

use crate::sim::real::Real;
use crate::sim::vector::{dot, sub};

/// A bond that is watched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watched<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    /// Square of the rest length [m^2], > 0.
    pub(crate) rest_square: S,
}

/// Largest share of its rest length that the ends of a bond may move against each other in a substep, squared.
const MOST_MOVE: f64 = 1.0 / 16.0;

/// Cosine of the largest angle that a bond may turn by in a substep, 30 degrees, squared.
const LEAST_COSINE: f64 = 0.75;

/// Whether no bond turned or moved too far between two states.
///
/// A comparison with NaN is false: a state that is not finite does not pass.
pub(crate) fn is_gentle<S: Real, const D: usize>(bonds: &[Watched<S>], before: &[[S; D]], after: &[[S; D]]) -> bool {
    let (most, least) = (S::from_f64(MOST_MOVE), S::from_f64(LEAST_COSINE));
    bonds.iter().all(|bond| {
        let (i, j) = (bond.a as usize, bond.b as usize);
        let (old, new) = (sub(before[i], before[j]), sub(after[i], after[j]));
        let moved = sub(new, old);
        let along = dot(old, new);
        dot(moved, moved) <= most * bond.rest_square
            && (along * along >= least * dot(old, old) * dot(new, new) && along >= S::ZERO)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_and_moves_are_bounded() {
        let bond = [Watched { a: 0, b: 1, rest_square: 1.0 }];
        let after = |x: f64, y: f64| is_gentle(&bond, &[[0.0, 0.0], [0.5, 0.0]], &[[0.0, 0.0], [x, y]]);
        assert!(after(0.5, 0.1) && after(0.7, 0.0));
        assert!(!after(0.76, 0.0), "further than a quarter of the rest length");
        assert!(!after(0.3, 0.2), "turned by more than 30 degrees");
        assert!(!after(f64::NAN, 0.0));
    }
}
