//! The walls around the world: an axis-parallel box that points stay inside.

/// The box and what its walls are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<const D: usize> {
    /// Lower corner `[m]`.
    pub min: [f64; D],
    /// Upper corner `[m]`, above `min` on every axis.
    pub max: [f64; D],
    /// v_n -> -restitution v_n on touching `[1]`, >= 0.
    pub restitution: f64,
    /// |change of v_t| <= friction |change of v_n| `[1]`, >= 0.
    pub friction: f64,
}
