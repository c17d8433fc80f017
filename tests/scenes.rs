//! Scene files as they are read, refused, written, expanded and turned into models.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod files;
mod models;
mod mutations;
mod refusals;
mod round_trip;
