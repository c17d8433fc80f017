//! The interactive program: window, clock, input, panels.

pub mod player;
