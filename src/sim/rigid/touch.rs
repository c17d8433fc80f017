//! What a rigid body touches: points on surfaces, and when the next one gets there.

use super::body::Body;
use super::contact::Contact;
use super::motion::Pose;
use super::solid::{MotionOf, Solid, lift};
use crate::sim::contact::coulomb::Rub;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::real::Real;
use crate::sim::solve::root::Root;
use crate::sim::vector::{dot, resized, scale, widen};

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
    pub(super) planes: Vec<usize>,
    /// Some polygon.
    pub(super) has_walls: bool,
}

impl Near {
    pub(super) fn is_empty(&self) -> bool {
        self.planes.is_empty() && !self.has_walls
    }
}

/// A body among obstacles.
pub(super) struct Among<'a, S: Real, const D: usize, B: Solid<N> = Body, const N: usize = 2> {
    pub(super) body: &'a B,
    pub(super) obstacles: &'a Obstacles<S, D>,
    /// A distance that counts as none `[m]`.
    pub(super) touch: f64,
}

impl<'a, S: Real, const D: usize, B: Solid<N>, const N: usize> Among<'a, S, D, B, N> {
    pub(super) fn new(body: &'a B, obstacles: &'a Obstacles<S, D>, motion: &MotionOf<B, N>) -> Self {
        let size = motion.place.middle().iter().fold(1.0 + body.reach(), |sum, x| sum + x.abs());
        Among { body, obstacles, touch: TOUCH * size }
    }

    /// What it may meet on a way of so many metres.
    pub(super) fn near(&self, motion: &MotionOf<B, N>, way: f64) -> Near {
        let (middle, far) = (motion.place.middle(), self.body.reach() + way + self.touch);
        let planes = self.obstacles.planes().iter().enumerate();
        let planes = planes.filter(|(_, plane)| plane.gap_of(middle) < far).map(|(surface, _)| surface).collect();
        let bounds = [-far, far].map(|far| lift(middle.map(|x| x + far)));
        Near { planes, has_walls: self.obstacles.has_walls_near(bounds) }
    }

    #[inline]
    fn normal(&self, surface: usize) -> [f64; N] {
        resized(widen(self.obstacles.surfaces[surface].normal))
    }

    /// A place of the body, by the number of a point.
    #[inline]
    fn place(&self, point: u32) -> [f64; N] {
        self.body.parts().places[point as usize]
    }

    /// Where a point of the body is.
    #[inline]
    pub(super) fn at(&self, motion: &MotionOf<B, N>, point: u32) -> [f64; N] {
        motion.place.out(self.place(point))
    }

    /// How far off a surface a point is `[m]`.
    #[inline]
    pub(super) fn gap(&self, motion: &MotionOf<B, N>, touch: Touch) -> f64 {
        self.obstacles.surfaces[touch.surface].gap_of(self.at(motion, touch.point))
    }

    /// Corners of the hull that may be no more than so far off a plane `[m]`, and no others that are clearly further off: the normal is turned
    /// into the shape once instead of each place out of it.
    fn low(&self, motion: &MotionOf<B, N>, surface: usize, most: f64) -> impl Iterator<Item = Touch> {
        let normal = motion.place.back(self.normal(surface));
        let room = most + self.touch - self.obstacles.surfaces[surface].gap_of(motion.place.middle());
        let is_low = move |&&point: &&u32| dot(normal, self.place(point)) <= room && self.body.meets(point);
        self.body.corners().iter().filter(is_low).map(move |&point| Touch { point, surface })
    }

    /// All points that may meet something.
    fn points(&self) -> impl Iterator<Item = u32> {
        (0..self.body.parts().places.len() as u32).filter(|&point| self.body.meets(point))
    }

    /// A point on a surface, as the law has it.
    #[inline]
    pub(super) fn contact(&self, motion: &MotionOf<B, N>, touch: Touch) -> Contact<N> {
        let surface = &self.obstacles.surfaces[touch.surface];
        let (friction, restitution) = (surface.friction.to_f64(), surface.restitution.to_f64());
        Contact {
            arm: motion.place.turned(self.place(touch.point)),
            ways: B::frame(self.normal(touch.surface)),
            rub: Rub { friction, restitution, ..Rub::SMOOTH },
        }
    }

    /// How fast a point goes across and along a surface `[m/s]`.
    #[inline]
    pub(super) fn speeds(&self, motion: &MotionOf<B, N>, touch: Touch) -> [f64; N] {
        self.contact(motion, touch).speeds(&motion.twist)
    }

    /// The points that lie on surfaces: of those on one, those that hold the others.
    pub(super) fn touching(&self, motion: &MotionOf<B, N>, near: &Near) -> Vec<Touch> {
        let mut list: Vec<Touch> = Vec::new();
        for &surface in &near.planes {
            let touches = self.low(motion, surface, self.touch);
            list.extend(touches.filter(|&touch| self.gap(motion, touch) <= self.touch));
        }
        if near.has_walls {
            let slacks = self.touch / self.obstacles.slack();
            for point in self.points() {
                let see = |surface: usize| list.push(Touch { point, surface });
                self.obstacles.touching(lift(self.at(motion, point)), slacks, see);
            }
        }
        list.sort_by_key(|touch| touch.surface);
        list.chunk_by(|a, b| a.surface == b.surface).flat_map(|of_one| self.outermost(motion, of_one)).collect()
    }

    /// Of points on one surface those that hold the others.
    fn outermost(&self, motion: &MotionOf<B, N>, on: &[Touch]) -> Vec<Touch> {
        let points: Vec<u32> = on.iter().map(|touch| touch.point).collect();
        let frame = B::frame(self.normal(on[0].surface));
        self.body.outermost(&motion.place, &frame, &points).into_iter().map(|k| on[k]).collect()
    }

    /// When within `h` `[s]` the first point gets to a surface along a path, whose ends are given; `lying` are on theirs already.
    pub(super) fn first_hit(
        &self,
        path: impl Fn(f64) -> MotionOf<B, N>,
        (start, end, h): (&MotionOf<B, N>, &MotionOf<B, N>, f64),
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
        let is_meant = |touch: &Touch| !lying.contains(touch) && self.gap(end, *touch) < -self.touch;
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
        path: impl Fn(f64) -> MotionOf<B, N>,
        (motion, end, h): (&MotionOf<B, N>, &MotionOf<B, N>, f64),
        lying: &[Touch],
    ) -> Option<f64> {
        let still = self.body.still(&motion.twist);
        let mut first = None;
        for touch in lying {
            let contact = self.contact(motion, *touch);
            let start = contact.direction(&motion.twist, still);
            let speed = dot(start, contact.speeds(&motion.twist));
            if speed == 0.0 {
                continue;
            }
            let latest = first.unwrap_or(h);
            let ahead = |motion: &MotionOf<B, N>| dot(start, self.speeds(motion, *touch));
            let last = if latest < h { ahead(&path(latest)) } else { ahead(end) };
            if last >= -0.5 * still {
                continue;
            }
            let root = Root::between((0.0, speed), (latest, last));
            first = Some(narrowed(root, |time| ahead(&path(time)), 0.5 * still));
        }
        first
    }

    /// The points that are behind surfaces, by more than counts as none.
    pub(super) fn behind(&self, motion: &MotionOf<B, N>, near: &Near) -> Vec<Touch> {
        let mut list = Vec::new();
        for &surface in &near.planes {
            list.extend(self.low(motion, surface, -self.touch));
        }
        if near.has_walls {
            for point in self.points() {
                let inside = self.obstacles.nearest(lift(self.at(motion, point)), self.touch);
                list.extend(inside.into_iter().map(|surface| Touch { point, surface }));
            }
        }
        list.retain(|&touch| self.gap(motion, touch) < -self.touch);
        list
    }

    /// It is put out of surfaces that it is behind, as a whole, without speed; `None`: there is no room for it, or it would have to be turned far
    /// about its pin, which is work that nobody does.
    pub(super) fn put_out(&self, motion: &MotionOf<B, N>, near: &Near) -> Option<MotionOf<B, N>> {
        let (mut motion, mut turned) = (*motion, 0.0);
        for _ in 0..ROUNDS {
            let all = self.behind(&motion, near);
            let gaps = all.into_iter().map(|touch| (self.gap(&motion, touch), touch));
            let Some((gap, touch)) = gaps.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Some(motion) };
            let normal = self.normal(touch.surface);
            if !self.body.is_pinned() {
                // Without turning it: what lies flat on a surface has more than one deepest point.
                motion.place = motion.place.shifted(scale(normal, -gap));
                continue;
            }
            let arm = motion.place.turned(self.place(touch.point));
            let (place, by) = self.body.swung(&motion.place, arm, normal, gap)?;
            turned += by.abs();
            if turned.is_nan() || turned > MOST_TURN {
                return None;
            }
            motion.place = place;
        }
        None
    }
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
