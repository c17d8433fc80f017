//! How bodies move: closed forms, reference problems, conservation, events, walls, and what no scene should ask for. One program,
//! so that it is linked once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

#[path = "motion/accuracy.rs"]
mod accuracy;
#[path = "motion/conservation.rs"]
mod conservation;
#[path = "motion/contact.rs"]
mod contact;
#[path = "motion/events.rs"]
mod events;
#[path = "motion/overlap.rs"]
mod overlap;
#[path = "motion/physics.rs"]
mod physics;
#[path = "motion/polygons.rs"]
mod polygons;
#[path = "motion/rim.rs"]
mod rim;
#[path = "motion/robust.rs"]
mod robust;
