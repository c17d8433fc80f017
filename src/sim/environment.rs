//! What surrounds all points of a world: gravity, the mouse force and its cursor.

use super::force::mouse::{Cursor, MouseForce};
use super::vector::{add, length, scale, sub};

/// The same for every group of points.
#[derive(Clone, Debug)]
pub(crate) struct Environment<const D: usize> {
    /// Gravity [m/s^2].
    pub(crate) gravity: [f64; D],
    /// The force around the cursor.
    pub(crate) mouse: Option<MouseForce>,
    /// The live cursor.
    pub(crate) cursor: Option<CursorPath>,
}

/// Where the live cursor goes: along a straight line, then it stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CursorPath {
    from: Cursor,
    to: Cursor,
    /// From when to when [s].
    span: [f64; 2],
}

impl CursorPath {
    /// On from where it is at time `t` [s] to `to`, until `by` [s]; at `to` at once where it was nowhere.
    pub(crate) fn onwards(path: Option<CursorPath>, to: Cursor, t: f64, by: f64) -> Self {
        CursorPath { from: path.map_or(to, |path| path.at(t)), to, span: [t, by] }
    }

    /// Where it is at time `t` [s].
    pub(crate) fn at(&self, t: f64) -> Cursor {
        let [start, end] = self.span;
        if t >= end {
            return self.to;
        }
        let share = ((t - start) / (end - start)).clamp(0.0, 1.0);
        let between = |a: [f64; 3], b: [f64; 3]| add(a, scale(sub(b, a), share));
        let along = between(self.from.direction, self.to.direction);
        let size = length(along);
        // Rays that look at each other have no middle.
        let direction = if size > 0.0 { scale(along, 1.0 / size) } else { self.to.direction };
        Cursor { origin: between(self.from.origin, self.to.origin), direction }
    }

    /// Whether it still moves after time `t` [s].
    pub(crate) fn moves_after(&self, t: f64) -> bool {
        t < self.span[1] && self.from != self.to
    }

    /// How far it goes in the plane of its start from `t` to `t + h` [m].
    pub(crate) fn way(&self, t: f64, h: f64) -> f64 {
        if self.moves_after(t) { length(sub(self.at(t + h).origin, self.at(t).origin)) } else { 0.0 }
    }
}

impl<const D: usize> Environment<D> {
    /// The mouse force with its cursor at time `t` [s]: on its track, or where the live one is.
    pub(crate) fn mouse_at(&self, t: f64) -> Option<(&MouseForce, Cursor)> {
        let mouse = self.mouse.as_ref()?;
        let cursor = mouse.track.at(t).map(Cursor::at).or(self.cursor.map(|path| path.at(t)))?;
        Some((mouse, cursor))
    }

    /// How far the cursor of the mouse force goes from `t` to `t + h`, in radii of it [1]; 0 where there is none.
    pub(crate) fn sweep(&self, t: f64, h: f64) -> f64 {
        let Some(mouse) = &self.mouse else { return 0.0 };
        let way = match (mouse.track.at(t), mouse.track.at(t + h)) {
            (Some(from), Some(to)) => length(sub(to, from)),
            _ => self.cursor.map_or(0.0, |path| path.way(t, h)),
        };
        way / mouse.radius
    }
}
