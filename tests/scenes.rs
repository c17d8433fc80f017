//! Scene files as they are read, refused, written, expanded and turned into models.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

#[path = "scenes/files.rs"]
mod files;
#[path = "scenes/models.rs"]
mod models;
#[path = "scenes/mutations.rs"]
mod mutations;
#[path = "scenes/refusals.rs"]
mod refusals;
#[path = "scenes/round_trip.rs"]
mod round_trip;
