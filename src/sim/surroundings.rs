//! What surrounds all points of a world: gravity, drag, the mouse force and its cursor, surfaces.

use super::force::mouse::{Cursor, MouseForce};

/// The same for every group of points.
#[derive(Clone, Debug)]
pub(crate) struct Surroundings<const D: usize> {
    /// Gravity [m/s^2].
    pub(crate) gravity: [f64; D],
    /// The force around the cursor.
    pub(crate) mouse: Option<MouseForce>,
    /// The live cursor.
    pub(crate) cursor: Option<Cursor>,
}

impl<const D: usize> Surroundings<D> {
    /// The mouse force with its cursor at time `t` [s]: on its track, or where the live one is.
    pub(crate) fn mouse_at(&self, t: f64) -> Option<(&MouseForce, Cursor)> {
        let mouse = self.mouse.as_ref()?;
        let cursor = mouse.track.at(t).map(Cursor::at).or(self.cursor)?;
        Some((mouse, cursor))
    }
}
