//! Bodies in the way of obstacles: soft ones are pushed point by point, those of one rigid piece as wholes.

use super::push::{Part, Touch};
use crate::sim::vector::{add, dot, length, scale, sub, zero};

/// Halvings of a part to where a point is out.
const HALVINGS: u32 = 10;
/// Rounds in which bonds that the obstacle still goes through are pushed, and rigid bodies are put out.
const ROUNDS: u32 = 6;
/// Rounds in which the speeds of a rigid body at all that pushes it are found.
const BLOWS: u32 = 24;
/// A bond is pressed together to this share of its length at most.
const CRUSHED: f64 = 0.4;
/// What gets shorter by less than this share does not get shorter.
const LESS: f64 = 1e-6;

/// What hangs together by bonds, by the places of its points in what was taken out.
#[derive(Default)]
pub(super) struct Hanging {
    pub(super) points: Vec<usize>,
    pub(super) bonds: Vec<[usize; 2]>,
    /// How long they are at rest `[m]`.
    pub(super) rests: Vec<f64>,
    /// Bonds hold it as one piece.
    pub(super) is_rigid: bool,
    /// Something of it is held.
    pub(super) is_pinned: bool,
}

/// A point as it was: its place in what was taken out, where `[m]`, how fast `[m/s]`, and whether it was pushed before.
type Before<const D: usize> = (usize, [f64; D], [f64; D], bool);

/// Points that are pushed.
pub(super) struct Crowd<const D: usize> {
    /// `[m]`
    pub(super) x: Vec<[f64; D]>,
    /// `[m/s]`
    pub(super) v: Vec<[f64; D]>,
    /// Inverse masses `[1/kg]`, 0 of what is held.
    pub(super) w: Vec<f64>,
    pub(super) is_changed: Vec<bool>,
}

impl<const D: usize> Crowd<D> {
    pub(super) fn extent(&self, body: &Hanging) -> Option<[[f64; D]; 2]> {
        let mut places = body.points.iter().map(|&i| self.x[i]);
        let first = places.next()?;
        Some(places.fold([first; 2], |[low, high], x| {
            [std::array::from_fn(|k| low[k].min(x[k])), std::array::from_fn(|k| high[k].max(x[k]))]
        }))
    }

    /// Obstacles go a part of their way: pushes all that they meet ahead. Returns whether there is room for it; all is as it was if not.
    pub(super) fn push(&mut self, bodies: &[Hanging], part: &Part<'_, D>) -> bool {
        let mut before = Vec::new();
        for body in bodies {
            if !self.extent(body).is_some_and(|around| part.after.may_touch(around)) {
                continue;
            }
            let first = before.len();
            before.extend(body.points.iter().map(|&i| (i, self.x[i], self.v[i], self.is_changed[i])));
            if !self.push_body(body, &before[first..], part) {
                self.put_back(&before);
                return false;
            }
        }
        true
    }

    fn put_back(&mut self, before: &[Before<D>]) {
        for &(i, x, v, is_changed) in before {
            (self.x[i], self.v[i], self.is_changed[i]) = (x, v, is_changed);
        }
    }

    /// Pushes a body ahead, whose points were so. Returns whether there is room for it.
    fn push_body(&mut self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) -> bool {
        if !body.is_rigid || body.is_pinned {
            self.push_points(body, part);
            let is_caught = self.is_caught(body, part);
            if body.is_pinned {
                return !is_caught;
            }
            if !is_caught && !self.is_crushed(body, before) {
                return true;
            }
            // Before it is pressed flat it goes as a whole.
            self.put_back(before);
        }
        self.push_whole(body, part);
        !self.is_caught(body, part)
    }

    /// Whether obstacles came to be around something of a body that can move.
    fn is_caught(&self, body: &Hanging, part: &Part<'_, D>) -> bool {
        let is_free = |i: usize| self.w[i] > 0.0;
        body.points.iter().any(|&i| is_free(i) && part.touch(self.x[i]).is_some())
            || body
                .bonds
                .iter()
                .any(|&ends| ends.into_iter().any(is_free) && part.pierced(ends.map(|end| self.x[end])).is_some())
    }

    /// Whether bonds are pressed together to less than [`CRUSHED`] of their length, and were longer before.
    fn is_crushed(&self, body: &Hanging, before: &[Before<D>]) -> bool {
        let was = |i: usize| before.binary_search_by_key(&i, |before| before.0).map(|place| before[place].1);
        let is_shorter = |[a, b]: [usize; 2], now: f64| {
            let Ok([a, b]) = was(a).and_then(|a| was(b).map(|b| [a, b])) else { return false };
            now < (1.0 - LESS) * length(sub(b, a))
        };
        body.bonds.iter().zip(&body.rests).any(|(&ends, &rest)| {
            let now = length(sub(self.x[ends[1]], self.x[ends[0]]));
            now < CRUSHED * rest && is_shorter(ends, now)
        })
    }

    /// Each point by itself, and each bond by both of its ends.
    fn push_points(&mut self, body: &Hanging, part: &Part<'_, D>) {
        for &i in &body.points {
            if self.w[i] == 0.0 {
                continue;
            }
            let Some(touch) = part.touch(self.x[i]) else { continue };
            let way = part.way(self.x[i]);
            let [mut short, mut far] = [0.0, 1.0];
            for _ in 0..HALVINGS {
                let middle = 0.5 * (short + far);
                *(if part.is_free(add(self.x[i], scale(way, middle))) { &mut far } else { &mut short }) = middle;
            }
            self.go(i, scale(way, far), part);
            self.hurry(i, &touch);
        }
        for _ in 0..ROUNDS {
            let mut is_done = true;
            for &ends in &body.bonds {
                let Some(touch) = part.pierced(ends.map(|end| self.x[end])) else { continue };
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

    /// All that pushes a body now.
    fn touches(&self, body: &Hanging, part: &Part<'_, D>) -> Vec<Touch<D>> {
        let mut touches: Vec<Touch<D>> = body.points.iter().filter_map(|&i| part.touch(self.x[i])).collect();
        if touches.is_empty() {
            touches.extend(body.bonds.iter().filter_map(|ends| part.pierced(ends.map(|end| self.x[end]))));
        }
        touches
    }

    /// A body of one piece: where it is pushed it goes and turns as its mass says, and gets the speeds.
    fn push_whole(&mut self, body: &Hanging, part: &Part<'_, D>) {
        let touches = self.touches(body, part);
        if touches.is_empty() {
            return;
        }
        let inert = self.inert(body);
        let before: Vec<[f64; D]> = body.points.iter().map(|&i| self.x[i]).collect();
        for _ in 0..ROUNDS {
            let deepest = self.touches(body, part).into_iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
            let Some(touch) = deepest else { break };
            let (arm, weight) = inert.at(&touch);
            let blow = touch.depth / weight;
            let (by, angle) = (scale(touch.normal, blow / inert.mass), blow * arm / inert.inertia);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            for &i in &body.points {
                let mut from = sub(self.x[i], inert.middle);
                (from[0], from[1]) = (cos * from[0] - sin * from[1], sin * from[0] + cos * from[1]);
                self.x[i] = add(add(inert.middle, from), by);
            }
        }
        if !self.touches(body, part).is_empty() {
            // As far as the obstacle goes it is as free as it was.
            let way = part.way(inert.middle);
            body.points.iter().zip(&before).for_each(|(&i, &x)| self.x[i] = add(x, way));
        }
        if body.points.iter().zip(&before).any(|(&i, &x)| !part.has_room(x, self.x[i])) {
            body.points.iter().zip(&before).for_each(|(&i, &x)| self.x[i] = x);
        }
        let (mut velocity, mut spin) = (inert.velocity, inert.spin);
        for _ in 0..BLOWS {
            for touch in &touches {
                let (arm, weight) = inert.at(touch);
                let lacking = touch.speed - dot(velocity, touch.normal) - spin * arm;
                if lacking > 0.0 {
                    let blow = lacking / weight;
                    velocity = add(velocity, scale(touch.normal, blow / inert.mass));
                    spin += blow * arm / inert.inertia;
                }
            }
        }
        let (faster, turns) = (sub(velocity, inert.velocity), spin - inert.spin);
        for (&i, &x) in body.points.iter().zip(&before) {
            let from = sub(x, inert.middle);
            let mut more = faster;
            (more[0], more[1]) = (more[0] - turns * from[1], more[1] + turns * from[0]);
            (self.v[i], self.is_changed[i]) = (add(self.v[i], more), true);
        }
    }

    /// A body as one piece.
    pub(super) fn inert(&self, body: &Hanging) -> Inert<D> {
        let mass = |i: usize| 1.0 / self.w[i];
        let whole: f64 = body.points.iter().map(|&i| mass(i)).sum();
        let mean = |of: &[[f64; D]]| {
            let sum = body.points.iter().fold(zero(), |sum, &i| add(sum, scale(of[i], mass(i))));
            scale(sum, 1.0 / whole)
        };
        let (middle, velocity) = (mean(&self.x), mean(&self.v));
        let (mut inertia, mut turning) = (0.0, 0.0);
        for &i in &body.points {
            let (from, v) = (sub(self.x[i], middle), sub(self.v[i], velocity));
            inertia += mass(i) * dot(from, from);
            turning += mass(i) * (from[0] * v[1] - from[1] * v[0]);
        }
        Inert { middle, velocity, mass: whole, inertia, spin: turning / inertia }
    }
}

/// A body as one piece: its middle `[m]`, mass `[kg]`, inertia `[kg m^2]` and motion.
pub(super) struct Inert<const D: usize> {
    pub(super) middle: [f64; D],
    pub(super) velocity: [f64; D],
    mass: f64,
    inertia: f64,
    spin: f64,
}

impl<const D: usize> Inert<D> {
    /// The arm of a blow there `[m]`, and what one of 1 kg m/s makes its place faster by `[1/kg]`.
    fn at(&self, touch: &Touch<D>) -> (f64, f64) {
        let from = sub(touch.at, self.middle);
        let arm = from[0] * touch.normal[1] - from[1] * touch.normal[0];
        (arm, 1.0 / self.mass + arm * arm / self.inertia)
    }
}
