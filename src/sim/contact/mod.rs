//! Contact of points with what does not move.

pub mod bounds;
