//! Large bodies: the same bits however they are computed, what they are taken for, how they move.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod bits;
mod idle;
mod impacts;
pub(crate) mod models;
mod outside;
mod physics;
mod program;
mod recognition;
mod sizes;
mod steady;
mod violence;
