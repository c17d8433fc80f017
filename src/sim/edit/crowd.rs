//! Bodies in the way of obstacles: soft ones are pushed point by point, those of one rigid piece as wholes.

use super::push::{Part, Touch};
use crate::sim::command::NoRoom;
use crate::sim::vector::{add, dot, scale};

/// Halvings of a part to where a point is out.
const HALVINGS: u32 = 10;
/// Rounds in which bonds that the obstacle still goes through are pushed, and rigid bodies are put out.
pub(super) const ROUNDS: u32 = 6;

/// What hangs together by bonds, by the places of its points in what was taken out.
#[derive(Default)]
pub(super) struct Hanging {
    pub(super) points: Vec<usize>,
    pub(super) bonds: Vec<[usize; 2]>,
    /// How long they are at rest `[m]`, and whether they are held so.
    pub(super) rests: Vec<(f64, bool)>,
    pub(super) triangles: Vec<[usize; 3]>,
    /// How large they are at rest `[m^2]`, 0 where that is not known.
    pub(super) areas: Vec<f64>,
    /// Bonds hold it as one piece.
    pub(super) is_rigid: bool,
    /// Something of it is held.
    pub(super) is_pinned: bool,
}

/// A point as it was.
#[derive(Clone, Copy)]
pub(super) struct Before<const D: usize> {
    /// Its place in what was taken out.
    pub(super) i: usize,
    /// `[m]`
    pub(super) x: [f64; D],
    /// `[m/s]`
    pub(super) v: [f64; D],
    pub(super) is_changed: bool,
    /// How deep it was in the obstacles `[m]`.
    pub(super) depth: f64,
}

/// Why obstacles stop: bodies that have no room.
pub(super) struct Stop {
    /// By their places in the list of what is in the way.
    pub(super) bodies: Vec<usize>,
    pub(super) why: NoRoom,
}

/// Points that are pushed.
pub(super) struct Crowd<const D: usize> {
    /// `[m]`
    pub(super) x: Vec<[f64; D]>,
    /// `[m/s]`
    pub(super) v: Vec<[f64; D]>,
    /// Inverse masses `[1/kg]`, 0 of what is held.
    pub(super) w: Vec<f64>,
    pub(super) is_changed: Vec<bool>,
    /// Bodies meet each other.
    pub(super) meets: bool,
}

impl<const D: usize> Crowd<D> {
    pub(super) fn extent(&self, body: &Hanging) -> Option<[[f64; D]; 2]> {
        let mut places = body.points.iter().map(|&i| self.x[i]);
        let first = places.next()?;
        Some(places.fold([first; 2], |[low, high], x| {
            [std::array::from_fn(|k| low[k].min(x[k])), std::array::from_fn(|k| high[k].max(x[k]))]
        }))
    }

    /// Obstacles go a part of their way: pushes all that they meet ahead.
    ///
    /// Errors: there is no room for it; all is where it was then.
    pub(super) fn push(&mut self, bodies: &[Hanging], part: &Part<'_, D>) -> Result<(), Stop> {
        let mut before = Vec::new();
        for (number, body) in bodies.iter().enumerate() {
            if !self.extent(body).is_some_and(|around| part.after.may_touch(around)) {
                continue;
            }
            let first = before.len();
            before.extend(body.points.iter().map(|&i| {
                let (x, v, is_changed) = (self.x[i], self.v[i], self.is_changed[i]);
                Before { i, x, v, is_changed, depth: part.was_deep(x) }
            }));
            let fits = self.push_body(body, &before[first..], part);
            let entered = if fits { self.entered(bodies, number, &before[first..]) } else { None };
            if fits && entered.is_none() {
                continue;
            }
            // What others are in the way of pushes them by its speed.
            let speeds: Vec<[f64; D]> = body.points.iter().map(|&i| self.v[i]).collect();
            self.put_back(&before);
            if fits {
                for (&i, v) in body.points.iter().zip(speeds) {
                    (self.v[i], self.is_changed[i]) = (v, true);
                }
            }
            let why = match (entered, body.is_pinned) {
                (Some(_), _) => NoRoom::Crowded,
                (None, true) => NoRoom::Pinned,
                (None, false) => NoRoom::Pressed,
            };
            return Err(Stop { bodies: std::iter::once(number).chain(entered).collect(), why });
        }
        Ok(())
    }

    fn put_back(&mut self, before: &[Before<D>]) {
        for &Before { i, x, v, is_changed, .. } in before {
            (self.x[i], self.v[i], self.is_changed[i]) = (x, v, is_changed);
        }
    }

    /// Pushes a body ahead, whose points were so. Returns whether there is room for it.
    fn push_body(&mut self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) -> bool {
        if !body.is_rigid || body.is_pinned {
            self.push_points(body, before, part);
            let is_caught = self.is_caught(body, before, part);
            if body.is_pinned {
                return !is_caught;
            }
            if !is_caught && !self.is_crushed(body, before) {
                return true;
            }
            // Before it is pressed flat it goes as a whole.
            self.put_back(before);
        }
        self.push_whole(body, before, part);
        !self.is_caught(body, before, part)
    }

    /// Each point by itself, and each bond by both of its ends.
    fn push_points(&mut self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) {
        for &Before { i, depth, .. } in before {
            if self.w[i] == 0.0 {
                continue;
            }
            let Some(touch) = part.touch(self.x[i], depth) else { continue };
            // In space a sheet goes around what pushes it: along the way of that it would be pressed together within itself.
            if D == 3 && self.goes_aside(i, &touch, depth, part) {
                self.hurry(i, &touch);
                continue;
            }
            let way = part.way(self.x[i]);
            let [mut short, mut far] = [0.0, 1.0];
            for _ in 0..HALVINGS {
                let middle = 0.5 * (short + far);
                *(if part.is_free(add(self.x[i], scale(way, middle)), depth) { &mut far } else { &mut short }) = middle;
            }
            self.go(i, scale(way, far), part);
            self.hurry(i, &touch);
        }
        let was = |i: usize| was(before, i).map(|was| was.x);
        let was_pierced = |ends: [usize; 2]| matches!(ends.map(was), [Some(a), Some(b)] if part.was_pierced([a, b]));
        for round in 0..ROUNDS {
            let mut is_done = true;
            for &ends in &body.bonds {
                let Some(touch) = part.pierced(ends.map(|end| self.x[end])) else { continue };
                // What they went through already goes along with them once.
                if round > 0 && was_pierced(ends) {
                    continue;
                }
                for i in ends {
                    if self.w[i] == 0.0 {
                        continue;
                    }
                    is_done = false;
                    self.go(i, part.way(self.x[i]), part);
                    self.hurry(i, &touch);
                }
            }
            if is_done {
                return;
            }
        }
    }

    /// A point goes the shortest way out of what pushes it, if there is room.
    fn goes_aside(&mut self, i: usize, touch: &Touch<D>, was: f64, part: &Part<'_, D>) -> bool {
        let to = add(self.x[i], scale(touch.normal, touch.depth + part.after.slack()));
        let has_room = part.is_free(to, was) && part.has_room(self.x[i], to);
        if has_room {
            (self.x[i], self.is_changed[i]) = (to, true);
        }
        has_room
    }

    /// A point goes so far `[m]`, if there is room.
    fn go(&mut self, i: usize, way: [f64; D], part: &Part<'_, D>) {
        let to = add(self.x[i], way);
        if part.has_room(self.x[i], to) {
            (self.x[i], self.is_changed[i]) = (to, true);
        }
    }

    /// A point gets the speed of what pushes it.
    fn hurry(&mut self, i: usize, touch: &Touch<D>) {
        let lacking = touch.speed - dot(self.v[i], touch.normal);
        if lacking > 0.0 {
            (self.v[i], self.is_changed[i]) = (add(self.v[i], scale(touch.normal, lacking)), true);
        }
    }
}

/// How a point was of those that are here, by their places ascending.
pub(super) fn was<const D: usize>(before: &[Before<D>], i: usize) -> Option<&Before<D>> {
    before.binary_search_by_key(&i, |was| was.i).ok().map(|place| &before[place])
}
