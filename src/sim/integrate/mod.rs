//! The integrators, one a file.

pub(crate) mod composed;
pub(crate) mod flight;
pub(crate) mod implicit;
pub(crate) mod kick_drift;
pub(crate) mod runge_kutta;
pub(crate) mod splitting;
pub(crate) mod tableau;
pub(crate) mod verlet;
