//! Bodies in the way of obstacles: soft ones are pushed point by point, those of one rigid piece as wholes.

use super::push::{Part, Touch};
use crate::sim::command::NoRoom;
use crate::sim::force::area;
use crate::sim::triangles::holds;
use crate::sim::vector::{add, dot, length, scale, sub, zero};

/// Halvings of a part to where a point is out.
const HALVINGS: u32 = 10;
/// Rounds in which bonds that the obstacle still goes through are pushed, and rigid bodies are put out.
const ROUNDS: u32 = 6;
/// Rounds in which the speeds of a rigid body at all that pushes it are found.
const BLOWS: u32 = 24;
/// A bond is pressed together to this share of its length at most, a triangle to this share of its area.
const CRUSHED: f64 = 0.4;
/// A held bond of what has limbs is changed by this share of its length at most.
const STRAINED: f64 = 0.02;
/// What gets shorter by less than this share does not get shorter.
const LESS: f64 = 1e-6;

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
struct Before<const D: usize> {
    /// Its place in what was taken out.
    i: usize,
    /// `[m]`
    x: [f64; D],
    /// `[m/s]`
    v: [f64; D],
    is_changed: bool,
    /// How deep it was in the obstacles `[m]`.
    depth: f64,
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

    /// Whether obstacles came to be around something of a body, or deeper in it.
    fn is_caught(&self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) -> bool {
        let is_caught = |was: &Before<D>| match self.w[was.i] > 0.0 {
            true => !part.is_free(self.x[was.i], was.depth),
            false => was.depth == 0.0 && part.holds(self.x[was.i]),
        };
        let is_free = |i: usize| self.w[i] > 0.0;
        let was = |i: usize| was(before, i).map_or(self.x[i], |was| was.x);
        // What they went through already goes along with them.
        let goes_along = |i: usize| length(sub(self.x[i], was(i))) >= 0.5 * length(part.way(was(i)));
        let is_pierced = |ends: [usize; 2]| {
            let (now, before) = (ends.map(|end| self.x[end]), ends.map(was));
            let is_stopped = before != now && part.stops(now) && !part.stops(before);
            let went_along = || part.was_pierced(before) && ends.into_iter().filter(|&i| is_free(i)).all(goes_along);
            is_stopped || (part.pierced(now).is_some() && !went_along())
        };
        let mut bonds = body.bonds.iter().filter(|ends| ends.iter().any(|&end| is_free(end)));
        before.iter().any(is_caught) || bonds.any(|&ends| is_pierced(ends))
    }

    /// The body that one was pushed into, or over its points.
    fn entered(&self, bodies: &[Hanging], number: usize, before: &[Before<D>]) -> Option<usize> {
        let own = &bodies[number];
        if D != 2 || !self.meets || own.triangles.is_empty() {
            return None;
        }
        let around = self.extent(own)?;
        let was = |i: usize| was(before, i).map_or(self.x[i], |was| was.x);
        let now = |i: usize| self.x[i];
        let lies = |x: [f64; D], [low, high]: [[f64; D]; 2]| (0..D).all(|k| low[k] <= x[k] && x[k] <= high[k]);
        let others = bodies.iter().enumerate().filter(|(other, body)| *other != number && !body.triangles.is_empty());
        let mut others = others.filter(|(_, other)| {
            let Some(beside) = self
                .extent(other)
                .filter(|reach| (0..D).all(|k| reach[0][k] <= around[1][k] && around[0][k] <= reach[1][k]))
            else {
                return false;
            };
            let comes = |body: &Hanging, i: usize| {
                covers(&body.triangles, now, now(i)) && !covers(&body.triangles, was, was(i))
            };
            own.points.iter().any(|&i| lies(now(i), beside) && comes(other, i))
                || other.points.iter().any(|&i| lies(now(i), around) && comes(own, i))
        });
        others.next().map(|(other, _)| other)
    }

    /// Whether bonds or triangles are pressed together to less than [`CRUSHED`] of what they are at rest, and were larger before.
    fn is_crushed(&self, body: &Hanging, before: &[Before<D>]) -> bool {
        let was = |i: usize| was(before, i).map(|was| was.x);
        let has_limbs = !body.triangles.is_empty();
        body.bonds.iter().zip(&body.rests).any(|(&ends, &(rest, is_held))| {
            let now = length(sub(self.x[ends[1]], self.x[ends[0]]));
            let [Some(a), Some(b)] = ends.map(was) else { return false };
            let before = length(sub(b, a));
            let is_pressed = now < CRUSHED * rest && now < (1.0 - LESS) * before;
            let error = |length: f64| (length - rest).abs();
            is_pressed
                || (is_held && has_limbs && error(now) > STRAINED * rest && error(now) > error(before) + LESS * rest)
        }) || body.triangles.iter().zip(&body.areas).any(|(&corners, &rest)| {
            let now = area::size(corners.map(|corner| self.x[corner]));
            now < CRUSHED * rest
                && matches!(corners.map(was), [Some(a), Some(b), Some(c)] if now < area::size([a, b, c]) - LESS * rest)
        })
    }

    /// Each point by itself, and each bond by both of its ends.
    fn push_points(&mut self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) {
        for &Before { i, depth, .. } in before {
            if self.w[i] == 0.0 {
                continue;
            }
            let Some(touch) = part.touch(self.x[i], depth) else { continue };
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
    fn touches(&self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) -> Vec<Touch<D>> {
        let mut touches: Vec<Touch<D>> = before.iter().filter_map(|was| part.touch(self.x[was.i], was.depth)).collect();
        if touches.is_empty() {
            touches.extend(body.bonds.iter().filter_map(|ends| part.pierced(ends.map(|end| self.x[end]))));
        }
        touches
    }

    /// A body of one piece: where it is pushed it goes and turns as its mass says, and gets the speeds.
    fn push_whole(&mut self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) {
        let touches = self.touches(body, before, part);
        if touches.is_empty() {
            return;
        }
        let inert = self.inert(body);
        for _ in 0..ROUNDS {
            let deepest = self.touches(body, before, part).into_iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
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
        if !self.touches(body, before, part).is_empty() {
            // As far as the obstacle goes it is as free as it was.
            let way = part.way(inert.middle);
            before.iter().for_each(|was| self.x[was.i] = add(was.x, way));
        }
        if before.iter().any(|was| !part.has_room(was.x, self.x[was.i])) {
            before.iter().for_each(|was| self.x[was.i] = was.x);
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
        for &Before { i, x, .. } in before {
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

/// How a point was of those that are here, by their places ascending.
fn was<const D: usize>(before: &[Before<D>], i: usize) -> Option<&Before<D>> {
    before.binary_search_by_key(&i, |was| was.i).ok().map(|place| &before[place])
}

/// Whether triangles cover a place, with their corners at `place` `[m]`.
fn covers<const D: usize>(triangles: &[[usize; 3]], place: impl Fn(usize) -> [f64; D], x: [f64; D]) -> bool {
    triangles.iter().any(|corners| holds(corners.map(&place), x))
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
