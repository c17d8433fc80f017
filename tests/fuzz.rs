//! Files and calls that were damaged: whatever they hold, reading them ends in what they mean or in one line, within bounded memory.
//!
//! Cases have numbers, and a number is a case for ever. Variables of the environment ask for more than CI runs:
//! `WOBBLE_FUZZ_CASES` how many, `WOBBLE_FUZZ_FROM` from which number on, `WOBBLE_FUZZ_SHOW` prints each.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

#[path = "fuzz/calls.rs"]
mod calls;
#[path = "fuzz/driver.rs"]
mod driver;
#[path = "fuzz/pictures.rs"]
mod pictures;
#[path = "fuzz/recordings.rs"]
mod recordings;
#[path = "fuzz/scenes.rs"]
mod scenes;
#[path = "fuzz/soak.rs"]
mod soak;

/// Counts the bytes on the heap.
#[global_allocator]
static HEAP: peak_alloc::PeakAlloc = peak_alloc::PeakAlloc;
