//! The integrators, one a file.

pub(crate) mod verlet;
