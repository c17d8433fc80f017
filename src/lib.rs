//! **wobble**: a soft-body sandbox in the plane, with space as a guest.
//!
//! Points and bonds are moved by Verlet's method; forces, walls and the mouse act on them. Metres, kilograms, seconds
//! and radians throughout; y is up. The library simulates, makes bodies and measures without a GPU or a window;
//! drawing and the program stand on top.

pub mod app;
pub mod body;
pub mod cli;
pub mod equilibrium;
pub mod history;
pub mod output;
pub mod picture;
pub mod render;
pub mod scene;
pub mod search;
pub mod sim;
pub mod study;
