//! A running world with its past: a start, the commands that were given with their times, and keyframes.
//!
//! ```text
//! Start (scene or recording) --> World --step--> World --give(Do)--> World …
//!                                   \ keyframes: copies, each with its place in the log
//! log: a tree of branches; undo, redo and going back are a keyframe, then the same steps and commands again
//! ```
//! Nothing changes a world but a step and a command, and both do the same bits again: whatever time is gone back to is worked
//! out from the nearest copy. This room knows no window and no clock.

mod autosave;
mod beside;
mod branch;
pub mod chunk;
mod clock;
mod command;
mod discard;
mod dress;
mod eased;
mod effort;
mod error;
mod fixed;
mod frame;
mod hand;
mod keyframes;
#[allow(unreachable_pub, reason = "a macro makes all objects of files public")]
mod keys;
mod last;
mod lines;
mod log;
mod mark;
mod method;
mod own;
mod pack;
mod parse;
mod past;
mod redo_file;
mod replay;
mod resolve;
mod session;
mod settings;
mod start;
mod state;
mod undo;
mod write;

pub use autosave::{Autosave, Called, EVERY, Left};
pub use beside::{Companion, distances, interpolate};
pub use branch::BranchView;
pub use clock::Clock;
pub use command::{
    AreasOrNone, DeleteKeys, Do, DriveOrNone, EndOrNone, Entry, Factors, MoveKeys, OneOrEach, PenaltyOrNone,
    RangeOrNone, SetKeys, VectorOrEach, Walls, Weather,
};
pub use dress::Group;
pub use error::{HistoryError, Refusal, Why};
pub use lines::Lines;
pub use log::Log;
pub use mark::{Difference, Mark, difference, hash_now};
pub use method::MethodChange;
pub use past::Reel;
pub use replay::{Replay, Visit, apart_from_last, replay};
pub use session::History;
pub use start::{About, Recording, Start};
pub use undo::{GivenUp, GoneBack, Undone};
