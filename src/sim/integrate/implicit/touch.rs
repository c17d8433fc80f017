//! Surfaces in an implicit step: what presses and what rubs is found together with all other forces.
//!
//! ```text
//! across:  the gap at the end is 0, and the surface pushes              or it is open, and the surface does nothing
//! along:   the velocity at the end is 0, and |friction| <= mu |push|    or it goes on, and friction = mu |push| against it
//! ```
//!
//! Which of these holds for whom is decided after Newton's method has converged with what was thought before, until nobody changes
//! sides (primal-dual active sets; S. Hüeber, B. Wohlmuth, Comput. Methods Appl. Mech. Engrg. 194, 3147 (2005)). Each may let go, and
//! begin to slide, once in a step, but while places are rough: so that ends.
//!
//! A point that comes from `gap` away is stopped at the surface, and the work that this takes from it and what hangs on it is given back
//! to it times restitution^2 (energetic restitution; W. J. Stronge, Proc. R. Soc. Lond. A 431, 169 (1990)): of a point alone
//! v -> -restitution v, and never more than there was.

use crate::sim::contact::{Contacts, place};
use crate::sim::measure::extent;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, length, scale, sub};

/// Times that sides are changed in a step, and while places are rough.
const MOST_SETS: u32 = 64;
const MOST_ROUGH_SETS: u32 = 8;
/// Share of an acceleration that presses so little that it counts as let go, or holds by so much more than friction may.
const LOOSE: f64 = 1e-9;
/// Substeps: a bounce that would be over sooner is none.
const SHORTEST_BOUNCE: f64 = 4.0;

/// Where in a step forces are taken, and what that makes of its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace<S> {
    is_midpoint: bool,
    /// Velocity there over the way to there `[1/s]`.
    pub(super) rate: S,
    /// The way to the end over the way to there `[1]`.
    pub(super) reach: S,
    /// Share of the step at which that is `[1]`.
    pub(super) share: f64,
    /// The step `[s]`.
    h: f64,
}

impl<S: Real> Pace<S> {
    pub(super) fn new(is_midpoint: bool, h: f64) -> Self {
        let (rate, reach, share) = if is_midpoint { (2.0 / h, S::ONE + S::ONE, 0.5) } else { (1.0 / h, S::ONE, 1.0) };
        Pace { is_midpoint, rate: S::from_f64(rate), reach, share, h }
    }

    /// The way to the end, of a way to where forces are taken.
    pub(super) fn way<const D: usize>(self, way: [S; D]) -> [S; D] {
        if self.is_midpoint { add(way, way) } else { way }
    }

    /// The velocity at the end, with velocity `before` at the start.
    pub(super) fn velocity<const D: usize>(self, way: [S; D], before: [S; D]) -> [S; D] {
        let speed = scale(way, self.rate);
        if self.is_midpoint { sub(add(speed, speed), before) } else { speed }
    }

    /// The way of a point that stands still at the end.
    fn stopping<const D: usize>(self, before: [S; D]) -> [S; D] {
        let share = if self.is_midpoint { S::HALF / self.rate } else { S::ZERO };
        scale(before, share)
    }
}

/// A point that comes to a surface in the step.
#[derive(Clone, Copy, Debug)]
struct Struck<S> {
    point: u32,
    surface: u32,
    /// How far it was from it when the step began `[m]`.
    gap: S,
}

/// What surfaces do in a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touches<S: Real, const D: usize> {
    struck: Vec<Struck<S>>,
    /// Points and surfaces that let go of each other in this step, and points that began to slide.
    freed: Vec<[u32; 2]>,
    slipped: Vec<u32>,
    sets: u32,
    /// Velocities at the end that surfaces have a part in `[m/s]`.
    after: Vec<(u32, [S; D])>,
    /// What friction and impacts took `[J]`.
    pub(crate) taken: [f64; 2],
}

impl<S: Real, const D: usize> Touches<S, D> {
    /// A step begins. Points that stand still are held, as far as friction goes.
    pub(super) fn begin(&mut self, points: &Points<S, D>, pull: &mut Pull<S, D>) {
        self.struck.clear();
        self.freed.clear();
        self.slipped.clear();
        self.after.clear();
        (self.sets, self.taken) = (0, [0.0; 2]);
        pull.contacts.retain(|rest, surfaces| {
            let along = rest.along(points.velocity[rest.point as usize]);
            rest.heading = along;
            rest.sticks = rest.grip(surfaces) > S::ZERO && (rest.sticks || dot(along, along) == S::ZERO);
        });
    }

    /// Puts points where surfaces have them.
    pub(super) fn put(&self, points: &Points<S, D>, contacts: &Contacts<S, D>, at: &mut [[S; D]], pace: Pace<S>) {
        let surfaces = &contacts.obstacles.surfaces;
        for rest in &contacts.rests {
            let i = rest.point as usize;
            let (x, v) = (points.position[i], points.velocity[i]);
            let across = rest.across(surfaces, |surface| {
                let gap = surfaces[surface].gap(x);
                // What is inside of it already goes no deeper.
                let end = if gap < -surfaces[surface].slack() { gap } else { S::ZERO };
                (end - gap) / pace.reach
            });
            let way = if rest.sticks { pace.stopping(v) } else { sub(at[i], x) };
            at[i] = add(x, add(across, rest.along(way)));
        }
    }

    /// Decides anew who touches, slides and is held, where forces balance at these places: as nearly as rounding lets them, or roughly.
    /// Returns whether anything changed.
    pub(super) fn decide(
        &mut self,
        (points, pull): (&Points<S, D>, &mut Pull<S, D>),
        at: &[[S; D]],
        (pace, is_fine): (Pace<S>, bool),
    ) -> bool {
        let contacts = &mut pull.contacts;
        self.sets += 1;
        if !contacts.has_surfaces() || self.sets > if is_fine { MOST_SETS } else { MOST_ROUGH_SETS } {
            return false;
        }
        let met = self.met(points, contacts, at, pace);
        let mut has_changed = !met.is_empty();
        let Touches { freed, slipped, .. } = self;
        contacts.retain(|rest, surfaces| {
            let pressing = rest.pressing;
            let least = length(pressing) * S::from_f64(LOOSE);
            let point = rest.point;
            let lets_go = |s: usize| dot(pressing, surfaces[s].normal) >= least && !freed.contains(&[point, s as u32]);
            let free: Vec<[u32; 2]> =
                rest.surfaces().iter().filter(|&&s| lets_go(s as usize)).map(|&s| [point, s]).collect();
            if !free.is_empty() {
                rest.keep(surfaces, |s| !free.contains(&[point, s as u32]));
                freed.extend(free.into_iter().filter(|_| is_fine));
                has_changed = true;
                return;
            }
            let along = rest.along(pressing);
            let most = rest.grip(surfaces) * length(sub(pressing, along));
            if rest.sticks {
                if length(along) > most * S::from_f64(1.0 + LOOSE) && !slipped.contains(&point) {
                    (rest.sticks, rest.heading) = (false, along);
                    slipped.extend(is_fine.then_some(point));
                    has_changed = true;
                }
                return;
            }
            let i = point as usize;
            let end = pace.velocity(sub(at[i], points.position[i]), points.velocity[i]);
            if most > S::ZERO && dot(rest.along(end), rest.heading) < S::ZERO {
                rest.sticks = true;
                has_changed = true;
            }
        });
        for struck in met {
            self.touch(points, contacts, struck);
        }
        has_changed
    }

    /// Points whose ways lead into surfaces that they do not touch yet.
    fn met(&self, points: &Points<S, D>, contacts: &Contacts<S, D>, at: &[[S; D]], pace: Pace<S>) -> Vec<Struck<S>> {
        let x = &points.position;
        let obstacles = &contacts.obstacles;
        let end = |i: usize| add(x[i], pace.way(sub(at[i], x[i])));
        let ends: Vec<[S; D]> = (0..x.len()).map(end).collect();
        let (Some([low, high]), Some([from, to])) = (extent(&ends), extent(x)) else { return Vec::new() };
        let mut met = Vec::new();
        let mut see = |i: usize, surface: usize| {
            let gap = obstacles.surfaces[surface].gap(x[i]);
            met.push(Struck { point: i as u32, surface: surface as u32, gap });
        };
        let is_free = |i: usize, surface: usize| points.inverse_mass[i] != S::ZERO && !contacts.rests_on(i, surface);
        for (s, surface) in obstacles.planes().iter().enumerate() {
            if surface.least_gap([low, high]) < -surface.slack() {
                (0..x.len())
                    .filter(|&i| surface.gap(ends[i]) < -surface.slack() && is_free(i, s))
                    .for_each(|i| see(i, s));
            }
        }
        let around = [std::array::from_fn(|k| low[k].min(from[k])), std::array::from_fn(|k| high[k].max(to[k]))];
        if obstacles.has_walls_near(around) {
            for i in 0..x.len() {
                if let Some(met) = obstacles.meeting(x[i], ends[i], |surface| is_free(i, surface)) {
                    see(i, met.surface);
                }
            }
        }
        met
    }

    /// A point touches a surface from now on.
    fn touch(&mut self, points: &Points<S, D>, contacts: &mut Contacts<S, D>, struck: Struck<S>) {
        let (i, surface) = (struck.point as usize, struck.surface as usize);
        let v = points.velocity[i];
        contacts.touch(i, surface);
        let grip = contacts.grip_of(i);
        if let Some(rest) = contacts.of_mut(i) {
            rest.heading = rest.along(v);
            rest.sticks = grip > S::ZERO && dot(rest.heading, rest.heading) == S::ZERO;
        }
        if !self.struck.iter().any(|other| [other.point, other.surface] == [struck.point, struck.surface]) {
            self.struck.push(struck);
        }
    }

    /// The step is found: what impacts make of velocities, and what they and friction took.
    pub(super) fn end(&mut self, points: &Points<S, D>, pull: &mut Pull<S, D>, at: &[[S; D]], pace: Pace<S>) {
        let gravity: [S; D] = convert(pull.gravity);
        let contacts = &mut pull.contacts;
        let mut bounced = Vec::new();
        for rest in &contacts.rests {
            let i = rest.point as usize;
            let surfaces = &contacts.obstacles.surfaces;
            let (way, mass) = (sub(at[i], points.position[i]), S::ONE / points.inverse_mass[i]);
            let mut v = pace.velocity(way, points.velocity[i]);
            let rubbed = match rest.sticks {
                true => scale(rest.along(rest.pressing), -S::ONE),
                false => contacts.rub_ahead(rest),
            };
            self.taken[0] -= (dot(rubbed, pace.way(way)) * mass).to_f64();
            let of_point =
                |struck: &&Struck<S>| struck.point == rest.point && rest.surfaces().contains(&struck.surface);
            let mut rests = true;
            for struck in self.struck.iter().filter(of_point) {
                let surface = &surfaces[struck.surface as usize];
                let press = (-dot(rest.pressing, surface.normal)).max(S::ZERO);
                let off = dot(v, surface.normal);
                let gap = struck.gap.max(S::ZERO);
                let most = (off * off + (press + press) * gap).sqrt();
                let mut back = surface.restitution * most;
                let fall = -dot(gravity, surface.normal) * S::from_f64(SHORTEST_BOUNCE * pace.h);
                if back + back <= fall {
                    back = S::ZERO;
                }
                self.taken[1] += (mass * (press * gap + S::HALF * (off * off - back * back))).to_f64();
                v = add(v, scale(surface.normal, back - off));
                if back > S::ZERO {
                    rests = false;
                    let along = sub(v, scale(surface.normal, back));
                    let speed = length(along);
                    let slower = (speed - surface.friction * back).max(S::ZERO);
                    if speed > S::ZERO {
                        v = add(scale(surface.normal, back), scale(along, slower / speed));
                        self.taken[0] += (S::HALF * mass * (speed * speed - slower * slower)).to_f64();
                    }
                }
            }
            if rests {
                v = rest.free(v);
            } else {
                bounced.push(i);
            }
            self.after.push((rest.point, v));
        }
        bounced.into_iter().for_each(|i| contacts.release(i));
    }

    /// Points that surfaces have a part in get their velocities, and are on those that they lie on to the last bit.
    pub(super) fn give(&self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) {
        for &(point, v) in &self.after {
            let i = point as usize;
            points.velocity[i] = v;
            for &surface in contacts.of(i).into_iter().flat_map(|rest| rest.surfaces()) {
                let surface = &contacts.obstacles.surfaces[surface as usize];
                let near = surface.slack() * (S::ONE + length(points.position[i]));
                if surface.gap(points.position[i]).abs() <= near {
                    place(points, i, surface);
                }
            }
        }
    }
}
