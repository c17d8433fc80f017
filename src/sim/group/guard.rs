//! What a substep must not do to a bond: such a substep is taken again in two halves.

use crate::sim::real::Real;
use crate::sim::vector::{dot, sub};

/// A bond that is watched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watched<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    /// Square of the rest length `[m^2]`, > 0.
    pub(crate) rest_square: S,
}

/// The bonds that a substep must not turn or move too far.
#[derive(Clone, Debug)]
pub(crate) struct Guard<S> {
    pub(crate) bonds: Vec<Watched<S>>,
    /// The method follows turns well: of what the ends of a bond move against each other only the change of its length
    /// counts. One of order 2 holds bonds along the directions at the start, where every move counts.
    pub(crate) follows_turns: bool,
}

/// Largest share of its rest length that the ends of a bond may move against each other in a substep, squared.
const MOST_MOVE: f64 = 1.0 / 16.0;

/// Cosine of the largest angle that a bond may turn by in a substep, 30 degrees, squared.
const LEAST_COSINE: f64 = 0.75;

impl<S: Real> Guard<S> {
    /// Bytes that the bonds take.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.bonds.capacity() * size_of::<Watched<S>>()
    }

    /// Whether no bond turned or moved too far between two states.
    ///
    /// A comparison with NaN is false: a state that is not finite does not pass.
    pub(crate) fn passes<const D: usize>(&self, before: &[[S; D]], after: &[[S; D]]) -> bool {
        if self.follows_turns { self.each::<D, true>(before, after) } else { self.each::<D, false>(before, after) }
    }

    fn each<const D: usize, const TURNS: bool>(&self, before: &[[S; D]], after: &[[S; D]]) -> bool {
        let (most, least) = (S::from_f64(MOST_MOVE), S::from_f64(LEAST_COSINE));
        let two = S::ONE + S::ONE;
        self.bonds.iter().all(|bond| {
            let (i, j) = (bond.a as usize, bond.b as usize);
            let (old, new) = (sub(before[i], before[j]), sub(after[i], after[j]));
            let (p, q, along) = (dot(old, old), dot(new, new), dot(old, new));
            let may_move = most * bond.rest_square;
            let is_near = if TURNS {
                // (|new| - |old|)^2 = p + q - 2 sqrt(p q) <= the square of the most, without the root.
                let over = p + q - may_move;
                over <= S::ZERO || over * over <= two * two * (p * q)
            } else {
                let moved = sub(new, old);
                dot(moved, moved) <= may_move
            };
            is_near && along >= S::ZERO && along * along >= least * (p * q)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passes(follows_turns: bool, x: f64, y: f64) -> bool {
        let guard = Guard { bonds: vec![Watched { a: 0, b: 1, rest_square: 1.0 }], follows_turns };
        guard.passes(&[[0.0, 0.0], [0.5, 0.0]], &[[0.0, 0.0], [x, y]])
    }

    #[test]
    fn turns_and_moves_are_bounded() {
        assert!(passes(false, 0.5, 0.1) && passes(false, 0.7, 0.0));
        assert!(!passes(false, 0.76, 0.0), "further than a quarter of the rest length");
        assert!(!passes(false, 0.3, 0.2), "turned by more than 30 degrees");
        assert!(!passes(false, f64::NAN, 0.0) && !passes(true, f64::NAN, 0.0));
    }

    #[test]
    fn where_turns_are_followed_only_the_length_counts() {
        let turned = |degrees: f64, length: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [length * cos, length * sin]
        };
        let passes = |[x, y]: [f64; 2]| passes(true, x, y);
        assert!(passes(turned(29.0, 0.5)) && !passes(turned(31.0, 0.5)));
        assert!(passes(turned(20.0, 0.74)) && !passes(turned(20.0, 0.76)));
        assert!(passes(turned(20.0, 0.26)) && !passes(turned(20.0, 0.24)));
        assert!(!passes(turned(180.0, 0.5)));
    }
}
