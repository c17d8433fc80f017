//! What can be done to a running world, between two substeps.

use super::force::mouse::Cursor;

/// One action on a world. A list of them with their times replays a session without a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// The live cursor is here; `None`: it left. A mouse force with a track of its own ignores it.
    MoveCursor(Option<Cursor>),
    /// The mouse force takes this strength [1/s^2] and radius [m].
    ShapeMouse {
        /// Strength [1/s^2], positive repels.
        strength: f64,
        /// Radius [m], > 0.
        radius: f64,
    },
}
