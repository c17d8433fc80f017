//! How bodies move: closed forms, reference problems, conservation, events, walls, and what no scene should ask for. One program,
//! so that it is linked once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use crate::common;

mod accuracy;
mod conservation;
mod contact;
mod events;
mod overlap;
mod physics;
mod polygons;
mod push;
mod rim;
mod robust;
mod rubbing;
mod taut;
mod toys;
mod violent;
