//! Makers of points and bonds: one a file, each a plain struct of parameters with a `make` method.
//!
//! A maker yields points in its own frame, in metres, z = 0 in the plane, and pairs of points to be bonded; where the
//! body stands, what it is made of and how heavy it is, is the scene's affair.

mod angle;
mod cloth;
mod frame;
mod lattice;
mod random;
mod rim;
mod rope;

pub use angle::{cos, sin};
pub use cloth::{Cloth, Diagonals};
pub use frame::Frame;
pub use lattice::Lattice;
pub use random::{RandomGraph, ScatteredPoints};
pub use rim::{Bracing, Rim};
pub use rope::Rope;

/// Most points that one maker makes: more is a slip of the keyboard, and would only fill the memory.
pub const MOST_POINTS: u64 = 20_000_000;

/// Points and the pairs to bond, in the maker's own frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Positions [m].
    pub position: Vec<[f64; 3]>,
    /// Pairs of points to bond, a pair once; rest lengths are the distances.
    pub bonds: Vec<[u32; 2]>,
    /// Share of the body's mass a point carries: the length or area around it [m or m^2]; empty: equal shares.
    pub share: Vec<f64>,
}

/// A parameter that a body cannot be made with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {problem}")]
pub struct BodyError {
    /// The parameter.
    pub key: &'static str,
    /// What is wrong and what would do.
    pub problem: String,
}

impl BodyError {
    pub(crate) fn new(key: &'static str, problem: impl Into<String>) -> Self {
        BodyError { key, problem: problem.into() }
    }
}

/// A length that must be finite and above 0.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<(), BodyError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(BodyError::new(key, format!("{value} is no length: give a number above 0")))
}

/// A number of points that must lie from `least` to [`MOST_POINTS`].
pub(crate) fn counted(key: &'static str, count: u64, least: u64) -> Result<(), BodyError> {
    if (least..=MOST_POINTS).contains(&count) {
        return Ok(());
    }
    Err(BodyError::new(key, format!("{count} will not do: give {least} to {MOST_POINTS}")))
}

/// The distance between two points [m].
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    crate::sim::vector::length(crate::sim::vector::sub(a, b))
}
