//! The forces on points, one a file.

pub mod mouse;
