//! The forces on points, one a file. Gravity and drag are so short that they live in the integrator.

pub mod mouse;
pub(crate) mod spring;
pub mod steady;
pub mod wind;
