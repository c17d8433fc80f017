//! Seeded random numbers: the same draws for a seed on every machine and in every version.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A stream of random numbers from a seed.
///
/// The bits come from PCG (M. E. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms
/// for Random Number Generation", 2014); numbers are formed here and not by a crate's distributions, which may change
/// between releases.
pub(crate) struct Draw(Pcg64);

impl Draw {
    /// The stream of a seed.
    pub(crate) fn new(seed: u64) -> Self {
        Draw(Pcg64::seed_from_u64(seed))
    }

    /// A number in [0, 1), a multiple of 2^-53.
    pub(crate) fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        (self.0.next_u64() >> 11) as f64 * STEP
    }

    /// A whole number in [0, bound); `bound` > 0.
    ///
    /// Accuracy: the high half of a product; a value is off its share by less than bound/2^64.
    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        debug_assert!(bound > 0, "nothing can be drawn from an empty range");
        ((u128::from(self.0.next_u64()) * u128::from(bound)) >> 64) as u64
    }

    /// A point in the box between two corners, one draw an axis: an axis without extent draws too, so that the plane
    /// takes three numbers a point as space does.
    pub(crate) fn point(&mut self, min: [f64; 3], max: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| min[k] + (max[k] - min[k]) * self.unit())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_draws_the_same_numbers_for_ever() {
        let mut draw = Draw::new(7);
        let first: Vec<u64> = (0..4).map(|_| draw.below(1000)).collect();
        let mut again = Draw::new(7);
        assert_eq!(first, (0..4).map(|_| again.below(1000)).collect::<Vec<_>>());
        let mut other = Draw::new(8);
        assert_ne!(first, (0..4).map(|_| other.below(1000)).collect::<Vec<_>>());
    }

    #[test]
    fn numbers_fill_their_range_and_stay_inside() {
        let mut draw = Draw::new(1);
        let numbers: Vec<f64> = (0..10_000).map(|_| draw.unit()).collect();
        assert!(numbers.iter().all(|x| (0.0..1.0).contains(x)));
        let mean = numbers.iter().sum::<f64>() / 10_000.0;
        assert!((mean - 0.5).abs() < 0.02, "mean {mean}");
        assert!((0..10_000).all(|_| draw.below(3) < 3));
    }
}
