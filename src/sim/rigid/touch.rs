//! What a rigid body touches: points on surfaces, and when the next one gets there.

use super::body::{Body, lift};
use super::inertia::Contact;
use super::motion::Motion;
use super::place::Place;
use crate::sim::contact::coulomb::Rub;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::real::Real;
use crate::sim::solve::root::Root;
use crate::sim::vector::{cross, dot, flat, scale, sub, widen};

/// A distance that counts as none, as a share of where things are `[1]`.
const TOUCH: f64 = 1e-11;
/// Halvings of a way in which one that sets out from a surface is looked for off it.
const LOOKS: i32 = 12;
/// Most evaluations for one root.
const MOST_GUESSES: u32 = 100;
/// Rounds in which a body is put out of surfaces.
const ROUNDS: u32 = 100;
/// Most that a pinned one is turned by for it `[rad]`.
const MOST_TURN: f64 = 0.05;

/// A point of a body, by its number in the shape, on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Touch {
    pub(super) point: u32,
    pub(super) surface: usize,
}

/// The surfaces that a body may meet in a part of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct Near {
    planes: Vec<usize>,
    has_walls: bool,
}

impl Near {
    pub(super) fn has_walls(&self) -> bool {
        self.has_walls
    }

    pub(super) fn is_empty(&self) -> bool {
        self.planes.is_empty() && !self.has_walls
    }
}

/// A body among obstacles.
pub(super) struct Among<'a, S: Real, const D: usize> {
    pub(super) body: &'a Body,
    pub(super) obstacles: &'a Obstacles<S, D>,
    /// A distance that counts as none `[m]`.
    pub(super) touch: f64,
}

impl<'a, S: Real, const D: usize> Among<'a, S, D> {
    pub(super) fn new(body: &'a Body, obstacles: &'a Obstacles<S, D>, motion: &Motion) -> Self {
        let middle = motion.place.middle;
        let size = 1.0 + body.reach + middle[0].abs() + middle[1].abs();
        Among { body, obstacles, touch: TOUCH * size }
    }

    /// What it may meet on a way of so many metres.
    pub(super) fn near(&self, motion: &Motion, way: f64) -> Near {
        let (middle, far) = (motion.place.middle, self.body.reach + way + self.touch);
        let planes = self.obstacles.planes().iter().enumerate();
        let planes = planes.filter(|(_, plane)| plane.gap_of(middle) < far).map(|(surface, _)| surface).collect();
        let bounds = [-far, far].map(|far| lift([middle[0] + far, middle[1] + far]));
        Near { planes, has_walls: self.obstacles.has_walls_near(bounds) }
    }

    fn at(&self, motion: &Motion, point: u32) -> [f64; 2] {
        motion.place.out(self.body.shape.places[point as usize])
    }

    /// How far off a surface a point is `[m]`.
    pub(super) fn gap(&self, motion: &Motion, touch: Touch) -> f64 {
        self.obstacles.surfaces[touch.surface].gap_of(self.at(motion, touch.point))
    }

    /// Points of the hull that may be no more than so far off a plane `[m]`, and no others that are clearly further off: the normal is turned
    /// into the shape once instead of each place out of it.
    fn low(&self, motion: &Motion, surface: usize, most: f64) -> impl Iterator<Item = Touch> {
        let (plane, Place { middle, turn: [c, s], .. }) = (&self.obstacles.surfaces[surface], motion.place);
        let [x, y] = flat(widen(plane.normal));
        let (normal, room) = ([c * x + s * y, c * y - s * x], most + self.touch - plane.gap_of(middle));
        let is_low = move |&&point: &&u32| dot(normal, self.body.shape.places[point as usize]) <= room;
        self.body.hull.iter().filter(is_low).map(move |&point| Touch { point, surface })
    }

    /// A point on a surface, as the law has it.
    pub(super) fn contact(&self, motion: &Motion, touch: Touch) -> Contact {
        let surface = &self.obstacles.surfaces[touch.surface];
        Contact {
            arm: motion.place.turned(self.body.shape.places[touch.point as usize]),
            normal: flat(widen(surface.normal)),
            rub: Rub {
                friction: surface.friction.to_f64(),
                restitution: surface.restitution.to_f64(),
                slides: 0.0,
                target: [0.0; 2],
            },
        }
    }

    /// How fast a point goes across and along a surface `[m/s]`.
    pub(super) fn speeds(&self, motion: &Motion, touch: Touch) -> [f64; 2] {
        self.contact(motion, touch).speeds(&motion.twist)
    }

    fn points(&self) -> std::ops::Range<u32> {
        0..self.body.shape.places.len() as u32
    }

    fn is_free(&self, point: u32) -> bool {
        self.body.deaf.binary_search(&point).is_err()
    }

    /// The points that lie on surfaces: of those on one, the two that are furthest apart.
    pub(super) fn touching(&self, motion: &Motion, near: &Near) -> Vec<Touch> {
        let mut list: Vec<Touch> = Vec::new();
        for &surface in &near.planes {
            let touches = self.low(motion, surface, self.touch);
            list.extend(touches.filter(|&touch| self.is_free(touch.point) && self.gap(motion, touch) <= self.touch));
        }
        if near.has_walls {
            let slacks = self.touch / self.obstacles.slack();
            for point in self.points().filter(|&point| self.is_free(point)) {
                let see = |surface: usize| list.push(Touch { point, surface });
                self.obstacles.touching(lift(self.at(motion, point)), slacks, see);
            }
        }
        list.sort_by_key(|touch| touch.surface);
        list.chunk_by(|a, b| a.surface == b.surface).flat_map(|of_one| self.ends(motion, of_one)).collect()
    }

    /// The first and the last along the surface that they all are on.
    fn ends(&self, motion: &Motion, touches: &[Touch]) -> Vec<Touch> {
        let Some(first) = touches.first() else { return Vec::new() };
        let normal = flat(widen(self.obstacles.surfaces[first.surface].normal));
        let along = |touch: &&Touch| dot([-normal[1], normal[0]], self.at(motion, touch.point));
        let by = |a: &&Touch, b: &&Touch| along(a).total_cmp(&along(b));
        let (low, high) = (touches.iter().min_by(by), touches.iter().max_by(by));
        let both = low.into_iter().chain(high.filter(|high| Some(*high) != low));
        both.copied().collect()
    }

    /// When within `h` `[s]` the first point gets to a surface along a path, whose ends are given; `lying` are on theirs already.
    pub(super) fn first_hit(
        &self,
        path: impl Fn(f64) -> Motion,
        (start, end, h): (&Motion, &Motion, f64),
        (near, lying): (&Near, &[Touch]),
    ) -> Option<f64> {
        let mut candidates: Vec<Touch> = Vec::new();
        for &surface in &near.planes {
            candidates.extend(self.low(end, surface, -self.touch));
        }
        if near.has_walls {
            for point in self.points() {
                let [from, to] = [start, end].map(|motion| lift(self.at(motion, point)));
                let may = |surface: usize| !lying.contains(&Touch { point, surface });
                if let Some(met) = self.obstacles.meeting(from, to, may) {
                    candidates.push(Touch { point, surface: met.surface });
                }
            }
        }
        let is_meant =
            |touch: &Touch| self.is_free(touch.point) && !lying.contains(touch) && self.gap(end, *touch) < -self.touch;
        let mut first = None;
        for touch in candidates.into_iter().filter(is_meant) {
            let gap = |time: f64| self.gap(&path(time), touch);
            let latest = first.unwrap_or(h);
            let last = if latest < h { gap(latest) } else { self.gap(end, touch) };
            // What starts behind a surface is put out of it, not stopped.
            if last >= -self.touch || self.gap(start, touch) < -self.touch {
                continue;
            }
            first = Some(closing(gap, (latest, last), self.touch));
        }
        first
    }

    /// When within `h` `[s]` the first of the points that slide on their surfaces stops or turns back.
    pub(super) fn first_stop(
        &self,
        path: impl Fn(f64) -> Motion,
        (motion, end, h): (&Motion, &Motion, f64),
        lying: &[Touch],
    ) -> Option<f64> {
        let along = |motion: &Motion, touch: &Touch| {
            let normal = flat(widen(self.obstacles.surfaces[touch.surface].normal));
            let arm = motion.place.turned(self.body.shape.places[touch.point as usize]);
            dot(motion.twist.at(arm), [-normal[1], normal[0]])
        };
        let still = self.body.still(&motion.twist);
        let mut first = None;
        for touch in lying {
            let start = along(motion, touch);
            let latest = first.unwrap_or(h);
            let ahead = |time: f64| along(&path(time), touch) * start.signum();
            let last = if latest < h { ahead(latest) } else { along(end, touch) * start.signum() };
            if start.abs() <= still || last >= -0.5 * still {
                continue;
            }
            let root = Root::between((0.0, start.abs()), (latest, last));
            first = Some(narrowed(root, ahead, 0.5 * still));
        }
        first
    }

    /// The points that are behind surfaces, by more than counts as none.
    pub(super) fn behind(&self, motion: &Motion, near: &Near) -> Vec<Touch> {
        let mut list = Vec::new();
        for &surface in &near.planes {
            list.extend(self.low(motion, surface, -self.touch).filter(|touch| self.is_free(touch.point)));
        }
        if near.has_walls {
            for point in self.points().filter(|&point| self.is_free(point)) {
                let inside = self.obstacles.nearest(lift(self.at(motion, point)), self.touch);
                list.extend(inside.into_iter().map(|surface| Touch { point, surface }));
            }
        }
        list.retain(|&touch| self.gap(motion, touch) < -self.touch);
        list
    }

    /// It is put out of surfaces that it is behind, as a whole, without speed; `None`: there is no room for it, or it would have to be turned far
    /// about its pin, which is work that nobody does.
    pub(super) fn put_out(&self, motion: &Motion, near: &Near) -> Option<Motion> {
        let (mut motion, mut turned) = (*motion, 0.0);
        for _ in 0..ROUNDS {
            let all = self.behind(&motion, near);
            let gaps = all.into_iter().map(|touch| (self.gap(&motion, touch), touch));
            let Some((gap, touch)) = gaps.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Some(motion) };
            let normal = flat(widen(self.obstacles.surfaces[touch.surface].normal));
            if self.body.shape.pin.is_none() {
                // Without turning it: what lies flat on a surface has more than one deepest point.
                motion.place = motion.place.moved(scale(normal, -gap), 0.0);
                continue;
            }
            let lever = cross(sub(self.at(&motion, touch.point), motion.place.middle), normal);
            let by = -gap / lever;
            turned += by.abs();
            if turned.is_nan() || turned > MOST_TURN {
                return None;
            }
            motion.place = motion.place.moved([0.0; 2], by);
        }
        None
    }
}

/// Twice as far as it may get in `h` `[s]` with its speed `[m/s]` and what pushes it `[m/s^2]`.
pub(super) fn way(motion: &Motion, h: f64, pushed: f64) -> f64 {
    let v = motion.twist.velocity;
    2.0 * (dot(v, v).sqrt() * h + pushed * h * h)
}

/// When a gap closes that is below 0 at the end, up to what counts as none.
pub(super) fn closing(gap: impl Fn(f64) -> f64, end: (f64, f64), none: f64) -> f64 {
    let starts = std::iter::once(0.0).chain((1..=LOOKS).map(|k| end.0 * 0.5_f64.powi(k)));
    let Some(start) = starts.map(|time| (time, gap(time))).find(|(_, gap)| *gap > none) else { return 0.0 };
    narrowed(Root::between(start, end), gap, 0.5 * none)
}

/// Where a function is 0 within a bracket, or no further from it than `nothing`.
pub(super) fn narrowed(mut root: Root, of: impl Fn(f64) -> f64, nothing: f64) -> f64 {
    let mut time = root.guess();
    for _ in 0..MOST_GUESSES {
        let value = of(time);
        if value.abs() <= nothing || !root.contains(time) {
            break;
        }
        root.narrow(time, value);
        time = root.guess();
    }
    time
}
