//! What surrounds all points of a world: gravity, the mouse force and its cursor.

use super::drive::Keys;
use super::force::mouse::{Cursor, MouseForce, Push};
use super::real::Real;
use super::swept::{Span, Swept};
use super::vector::{add, dot, length, scale, sub, truncate, widen};

/// Share of its radius that the cursor goes in a part of a step: a point that it passes is pushed on its way.
const SWEEP: f64 = 0.25;
/// Most parts of a frame, however fast the cursor goes.
const MOST_PARTS: u32 = 64;
/// A frame `[s]`.
const FRAME: f64 = 1.0 / 60.0;

/// The same for every group of points.
#[derive(Clone, Debug)]
pub(crate) struct Environment<const D: usize> {
    /// Gravity `[m/s^2]`.
    pub(crate) gravity: [f64; D],
    /// The force around the cursor.
    pub(crate) mouse: Option<MouseForce>,
    /// The live cursor.
    pub(crate) cursor: Option<CursorPath>,
    /// The plane in which the cursor leads what is grabbed, in space.
    pub(crate) lead: Option<Lead>,
    /// The keys that players hold.
    pub(crate) keys: Keys,
}

/// How far a ray is followed to what is led, in distances from the eye when it was grabbed: one along the plane would lead it away.
const FARTHEST: f64 = 4.0;

/// The plane across the ray of the moment when something was grabbed, in which the cursor leads it: in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lead {
    /// A point of the plane `[m]`.
    pub(crate) point: [f64; 3],
    /// Its normal.
    pub(crate) normal: [f64; 3],
}

/// Where the live cursor goes: along a straight line, then it stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CursorPath {
    from: Cursor,
    to: Cursor,
    /// From when to when `[s]`.
    span: [f64; 2],
}

impl CursorPath {
    /// On from where it is at time `t` `[s]` to `to`, until `by` `[s]`; at `to` at once where it was nowhere.
    pub(crate) fn onwards(path: Option<CursorPath>, to: Cursor, t: f64, by: f64) -> Self {
        CursorPath { from: path.map_or(to, |path| path.at(t)), to, span: [t, by] }
    }

    /// From where to where, and from when to when `[s]`.
    pub(crate) fn parts(&self) -> ([Cursor; 2], [f64; 2]) {
        ([self.from, self.to], self.span)
    }

    /// The path that has these parts.
    pub(crate) fn of(([from, to], span): ([Cursor; 2], [f64; 2])) -> Self {
        CursorPath { from, to, span }
    }

    /// Where it is at time `t` `[s]`.
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

    /// Whether it still moves after time `t` `[s]`.
    pub(crate) fn moves_after(&self, t: f64) -> bool {
        t < self.span[1] && self.from != self.to
    }

    /// How far it goes from `t` to `t + h` `[m]`; in space that of its ray at the distance `far` `[m]`.
    pub(crate) fn way(&self, t: f64, h: f64, far: f64) -> f64 {
        if !self.moves_after(t) {
            return 0.0;
        }
        let [from, to] = [self.at(t), self.at(t + h)];
        length(sub(to.origin, from.origin)) + far * length(sub(to.direction, from.direction))
    }
}

impl<const D: usize> Environment<D> {
    /// The mouse force with its cursor at time `t` `[s]`: on its track, or where the live one is.
    pub(crate) fn mouse_at(&self, t: f64) -> Option<(&MouseForce, Cursor)> {
        let mouse = self.mouse.as_ref()?;
        let cursor = mouse.track.at(t).map(Cursor::at).or(self.cursor.map(|path| path.at(t)))?;
        Some((mouse, cursor))
    }

    /// What the mouse force gives a point at most, wherever its cursor is `[m/s^2]`.
    pub(crate) fn most_push(&self) -> f64 {
        self.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs() * mouse.radius)
    }

    /// How far the cursor of the mouse force goes from `t` to `t + h`, in radii of it `[1]`; 0 where there is none. `far` says for a ray
    /// from a place how far away the last of the points is `[m]`.
    pub(crate) fn sweep(&self, t: f64, h: f64, far: impl FnOnce([f64; 3]) -> f64) -> f64 {
        let Some(mouse) = &self.mouse else { return 0.0 };
        let way = match (mouse.track.at(t), mouse.track.at(t + h)) {
            (Some(from), Some(to)) => length(sub(to, from)),
            _ => match self.cursor.filter(|path| path.moves_after(t)) {
                Some(path) if D == 3 => path.way(t, h, far(path.at(t).origin)),
                Some(path) => path.way(t, h, 0.0),
                None => 0.0,
            },
        };
        way / mouse.radius
    }

    /// In how many equal parts of the step of `h` from `t` `[s]` the cursor is followed, so that what it passes is pushed on its way; `far`
    /// as for [`sweep`](Self::sweep).
    pub(crate) fn parts(&self, (t, h): (f64, f64), far: impl FnOnce([f64; 3]) -> f64) -> u32 {
        let most = (f64::from(MOST_PARTS) * h / FRAME).ceil().max(1.0);
        (self.sweep(t, h, far) / SWEEP).ceil().clamp(1.0, most) as u32
    }

    /// The same for these points, each with its velocity: one where the cursor stays or does not come near them.
    pub(crate) fn parts_near<S: Real>(
        &self,
        points: impl Iterator<Item = ([S; D], [S; D])>,
        (t, h): (f64, f64),
    ) -> u32 {
        let span = Span { h, fall: 0.0, pushed: 0.0 };
        let bounds = if self.moves(t, h) { Swept::new(points, span, S::ZERO) } else { None };
        let Some([low, high]) = bounds.map(|swept| swept.held().bounds()) else { return 1 };
        let far = |eye: [f64; 3]| {
            let [low, high] = [widen(low), widen(high)];
            length(std::array::from_fn::<f64, D, _>(|k| (low[k] - eye[k]).abs().max((high[k] - eye[k]).abs())))
        };
        let parts = self.parts((t, h), far);
        if parts > 1 && self.may_reach([low, high], (t, h)) { parts } else { 1 }
    }

    /// A box in which the mouse force acts in the `h` from `t` on `[s]` on what goes no further than `way` `[m]` meanwhile; in space, where it
    /// acts along a ray, all of it.
    pub(crate) fn swept<S: Real>(&self, (t, h): (f64, f64), way: S) -> [[S; D]; 2] {
        let all = [[-S::INFINITY; D], [S::INFINITY; D]];
        let (Some((force, from)), Some((_, to))) = (self.mouse_at(t), self.mouse_at(t + h)) else { return all };
        if D == 3 {
            return all;
        }
        let [from, to]: [[f64; D]; 2] = [from, to].map(|cursor| truncate(cursor.origin));
        let grown = S::from_f64(force.radius + h * h * force.strength.abs() * force.radius) + way;
        [
            std::array::from_fn(|k| S::from_f64(from[k].min(to[k])) - grown),
            std::array::from_fn(|k| S::from_f64(from[k].max(to[k])) + grown),
        ]
    }

    /// Whether the cursor of the mouse force moves from `t` to `t + h`.
    fn moves(&self, t: f64, h: f64) -> bool {
        self.sweep(t, h, |_| 1.0) > 0.0
    }

    /// Whether the mouse force may reach a box at some time of the `h` from `t` on `[s]`.
    pub(crate) fn may_reach<S: Real>(&self, bounds: [[S; D]; 2], (t, h): (f64, f64)) -> bool {
        let looks = if self.moves(t, h) { MOST_PARTS } else { 0 };
        (0..=looks).any(|look| {
            let time = t + h * (f64::from(look) / f64::from(looks.max(1)));
            self.mouse_at(time).is_some_and(|(force, cursor)| Push::new(force, cursor).reaches(bounds))
        })
    }

    /// Where the cursor leads to at time `t` `[s]`.
    pub(crate) fn target(&self, t: f64) -> Option<[f64; D]> {
        let cursor = self.cursor?.at(t);
        if D == 2 {
            return Some(truncate(cursor.origin));
        }
        let lead = self.lead?;
        let slope = dot(cursor.direction, lead.normal);
        // A ray along the plane does not meet it.
        if slope.abs() < 1e-9 {
            return None;
        }
        let from = sub(lead.point, cursor.origin);
        let most = FARTHEST * length(from);
        let way = (dot(from, lead.normal) / slope).clamp(-most, most);
        Some(truncate(add(cursor.origin, scale(cursor.direction, way))))
    }
}
