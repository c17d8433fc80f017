//! The forces on points, one a file. Gravity and drag are so short that they live in the integrator.

pub mod angle;
pub mod area;
pub(crate) mod form;
pub(crate) mod mean;
pub mod mouse;
pub(crate) mod muscle;
pub(crate) mod spring;
pub mod steady;
pub mod wind;
