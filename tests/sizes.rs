//! On either side of each size at which the method changes: the motion is the same within the error of the coarser method, and the work
//! jumps by no more than the page says.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod across;
mod forms;
mod live;
mod page;
mod rigid;
mod springs;
