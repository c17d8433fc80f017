//! What a rigid body touches in space: points on planes, and when the next one gets there.

use super::body::Body;
use super::law::Contact;
use super::motion::Motion;
use crate::sim::contact::coulomb::disc::Grip;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::contact::surface::Surface;
use crate::sim::real::Real;
use crate::sim::rigid::body::hull;
use crate::sim::rigid::touch::{Touch, closing, narrowed};
use crate::sim::solve::root::Root;
use crate::sim::vector::{add, cross3, dot, embed, length, scale, widen};

/// A distance that counts as none, as a share of where things are `[1]`.
const TOUCH: f64 = 1e-11;
/// Rounds in which a body is put out of surfaces.
const ROUNDS: u32 = 100;
/// Share of the square of a body's size by which a corner of what touches a surface is off the line of those beside it.
const CORNER: f64 = 1e-9;

/// The planes that a body may meet in a part of a step.
pub(super) type Near = Vec<usize>;

/// A body among obstacles.
pub(super) struct Among<'a, S: Real, const D: usize> {
    body: &'a Body,
    obstacles: &'a Obstacles<S, D>,
    /// A distance that counts as none `[m]`.
    pub(super) touch: f64,
}

impl<'a, S: Real, const D: usize> Among<'a, S, D> {
    pub(super) fn new(body: &'a Body, obstacles: &'a Obstacles<S, D>, motion: &Motion) -> Self {
        let size = 1.0 + body.reach + motion.place.middle.iter().map(|x| x.abs()).sum::<f64>();
        Among { body, obstacles, touch: TOUCH * size }
    }

    fn plane(&self, surface: usize) -> &Surface<S, D> {
        &self.obstacles.surfaces[surface]
    }

    fn normal(&self, surface: usize) -> [f64; 3] {
        embed(widen(self.plane(surface).normal))
    }

    /// What it may meet on a way of so many metres.
    pub(super) fn near(&self, motion: &Motion, way: f64) -> Near {
        let far = self.body.reach + way + self.touch;
        let is_near = |surface: &usize| self.plane(*surface).gap_in_space(motion.place.middle) < far;
        (0..self.obstacles.planes().len()).filter(is_near).collect()
    }

    /// Where a point of the body is.
    pub(super) fn at(&self, motion: &Motion, point: u32) -> [f64; 3] {
        motion.place.out(self.body.shape.places[point as usize])
    }

    /// How far off a surface a point is `[m]`.
    pub(super) fn gap(&self, motion: &Motion, touch: Touch) -> f64 {
        self.plane(touch.surface).gap_in_space(self.at(motion, touch.point))
    }

    /// Points that are no more than so far off a plane `[m]`: the normal is turned into the shape once instead of each place out of it.
    fn low(&self, motion: &Motion, surface: usize, most: f64) -> impl Iterator<Item = Touch> {
        let normal = motion.place.back(self.normal(surface));
        let room = most + self.touch - self.plane(surface).gap_in_space(motion.place.middle);
        let is_meant = move |(point, q): &(u32, &[f64; 3])| {
            dot(normal, **q) <= room && self.body.shape.pins.binary_search(point).is_err()
        };
        let all = (0..).zip(&self.body.shape.places);
        all.filter(is_meant).map(move |(point, _)| Touch { point, surface })
    }

    /// A point on a surface, as the law has it.
    pub(super) fn contact(&self, motion: &Motion, touch: Touch) -> Contact {
        let surface = self.plane(touch.surface);
        let grip = Grip {
            friction: surface.friction.to_f64(),
            restitution: surface.restitution.to_f64(),
            slides: None,
            target: [0.0; 3],
        };
        Contact::new(
            motion.place.turned(self.body.shape.places[touch.point as usize]),
            self.normal(touch.surface),
            grip,
        )
    }

    /// The points that lie on surfaces: of those on one, the corners around them.
    pub(super) fn touching(&self, motion: &Motion, near: &Near) -> Vec<Touch> {
        let mut list = Vec::new();
        for &surface in near {
            let on: Vec<Touch> =
                self.low(motion, surface, self.touch).filter(|&touch| self.gap(motion, touch) <= self.touch).collect();
            list.extend(self.corners(motion, surface, on));
        }
        list
    }

    fn corners(&self, motion: &Motion, surface: usize, on: Vec<Touch>) -> Vec<Touch> {
        if on.len() < 3 {
            return on;
        }
        let [x, y] = tangents(self.normal(surface));
        let at = |touch: &Touch| motion.place.turned(self.body.shape.places[touch.point as usize]);
        let places: Vec<[f64; 2]> = on.iter().map(at).map(|r| [dot(x, r), dot(y, r)]).collect();
        hull(&places, CORNER * self.body.reach * self.body.reach).into_iter().map(|k| on[k as usize]).collect()
    }

    /// When within `h` `[s]` the first point gets to a surface along a path, whose ends are given; `lying` are on theirs already.
    pub(super) fn first_hit(
        &self,
        path: impl Fn(f64) -> Motion,
        (start, end, h): (&Motion, &Motion, f64),
        (near, lying): (&Near, &[Touch]),
    ) -> Option<f64> {
        let candidates: Vec<Touch> = near.iter().flat_map(|&surface| self.low(end, surface, -self.touch)).collect();
        let mut first = None;
        for touch in candidates {
            let latest = first.unwrap_or(h);
            let gap = |time: f64| self.gap(&path(time), touch);
            // What starts behind a surface is put out of it, not stopped.
            if lying.contains(&touch) || self.gap(end, touch) >= -self.touch || self.gap(start, touch) < -self.touch {
                continue;
            }
            let last = if latest < h { gap(latest) } else { self.gap(end, touch) };
            if last < -self.touch {
                first = Some(closing(gap, (latest, last), self.touch));
            }
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
        let along = |motion: &Motion, touch: &Touch| self.contact(motion, *touch).sliding(&motion.twist);
        let still = self.body.still(&motion.twist);
        let mut first = None;
        for touch in lying {
            let start = along(motion, touch);
            let speed = length(start);
            let latest = first.unwrap_or(h);
            let ahead = |motion: &Motion| dot(along(motion, touch), start) / speed;
            if speed <= still {
                continue;
            }
            let last = if latest < h { ahead(&path(latest)) } else { ahead(end) };
            if last < -0.5 * still {
                let root = Root::between((0.0, speed), (latest, last));
                first = Some(narrowed(root, |time| ahead(&path(time)), 0.5 * still));
            }
        }
        first
    }

    /// It is put out of surfaces that it is behind, as a whole, without speed; `None`: there is no room for it, or a pin holds it there.
    pub(super) fn put_out(&self, motion: &Motion, near: &Near) -> Option<Motion> {
        let mut motion = *motion;
        for _ in 0..ROUNDS {
            let all = near.iter().flat_map(|&surface| self.low(&motion, surface, -self.touch));
            let gaps = all.map(|touch| (self.gap(&motion, touch), touch.surface)).filter(|(gap, _)| *gap < -self.touch);
            let Some((gap, surface)) = gaps.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Some(motion) };
            if self.body.ease == 0.0 {
                return None;
            }
            motion.place.middle = add(motion.place.middle, scale(self.normal(surface), -gap));
        }
        None
    }
}

/// Two unit vectors across a unit vector and each other: with it a right-handed three.
pub(super) fn tangents(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let [x, y, z] = normal.map(f64::abs);
    let away = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let first = cross3(normal, away);
    let first = scale(first, 1.0 / length(first));
    [first, cross3(normal, first)]
}
