//! Large bodies: the same bits however they are computed, what they are taken for, how they move.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

#[path = "large/bits.rs"]
mod bits;
#[path = "large/idle.rs"]
mod idle;
#[path = "large/impacts.rs"]
mod impacts;
#[path = "large/models.rs"]
mod models;
#[path = "large/outside.rs"]
mod outside;
#[path = "large/physics.rs"]
mod physics;
#[path = "large/program.rs"]
mod program;
#[path = "large/recognition.rs"]
mod recognition;
#[path = "large/sizes.rs"]
mod sizes;
#[path = "large/steady.rs"]
mod steady;
#[path = "large/violence.rs"]
mod violence;
