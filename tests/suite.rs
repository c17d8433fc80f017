//! All tests that need no process of their own: one program, so that what they share is compiled and linked once.
//! Beside it stand `fuzz`, which counts its memory, and `window`, which is alone on its display.

mod common;

mod architecture;
mod cli;
mod colors;
mod commands;
mod determinism;
mod documents;
mod drives;
mod examples;
mod fields;
mod fills;
mod handover;
mod history;
mod large;
mod large_scenes;
mod ledger;
mod lessons;
mod linkages;
mod live;
mod motion;
mod obstacles;
mod panels;
mod pictures;
mod pieces;
mod plays;
mod printed;
mod recordings;
mod replay;
mod scenes;
mod screenshots;
mod settable;
mod shaders;
mod shape;
mod sizes;
mod space;
mod stability;
mod study;
