//! Draws of a case.

use crate::body::draw::Draw;

/// A stream of draws.
pub(super) struct Dice(Draw);

impl Dice {
    /// The stream of a case.
    pub(super) fn new(case: u64) -> Self {
        // Seeds side by side begin alike in their last bits: a factor without a common divisor with 2^64 spreads them.
        Dice(Draw::new(case.wrapping_mul(0x9E37_79B9_7F4A_7C15)))
    }

    /// Another stream of a case: what is drawn from it changes nothing of the first.
    pub(super) fn apart(case: u64) -> Self {
        Dice::new(!case)
    }

    /// True with a probability.
    pub(super) fn chance(&mut self, share: f64) -> bool {
        self.0.unit() < share
    }

    /// Even in [low, high).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        round(low + (high - low) * self.0.unit())
    }

    /// Even in the logarithm, in [low, high); 0 < low.
    pub(super) fn decades(&mut self, low: f64, high: f64) -> f64 {
        let (from, to) = (libm::log(low), libm::log(high));
        round(libm::exp(from + (to - from) * self.0.unit()))
    }

    /// A whole number in [low, high], even in the logarithm; 0 < low.
    pub(super) fn count(&mut self, low: u64, high: u64) -> u64 {
        (self.decades(low as f64, high as f64 + 1.0) as u64).clamp(low, high)
    }

    /// One of a list that is not empty.
    pub(super) fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.0.below(list.len() as u64) as usize]
    }

    /// A seed for something else.
    pub(super) fn seed(&mut self) -> u64 {
        self.0.below(1 << 32)
    }
}

/// Seven digits: scenes are to be read, and written numbers are to mean the same.
fn round(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
