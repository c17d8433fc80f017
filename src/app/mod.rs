//! The interactive program: window, clock, input, panels.

pub mod opening;
pub mod player;
