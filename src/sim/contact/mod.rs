//! Points on surfaces: who rests on which, and what that takes from forces and velocities.

pub mod bounds;
pub mod convex;
pub(crate) mod coulomb;
pub(crate) mod geometry;
pub(crate) mod hinged;
pub(crate) mod obstacles;
pub(crate) mod passage;
pub mod penalty;
pub mod polygon;
pub(crate) mod rest;
pub mod skin;
pub mod surface;

use super::points::Points;
use super::real::Real;
use super::vector::{add, dot, length, scale, sub};
use obstacles::Obstacles;
use rest::Rest;
use surface::Surface;

/// Changes of friction that are rounding, in roundings of it.
const ROUNDED: f64 = 64.0;

/// The surfaces of a world and the points of a group that rest on them.
///
/// A resting point has lost the directions across its surfaces: accelerations, velocities and the answers of rigid bonds
/// are projected along them. One that sticks, by friction, has lost all of them.
#[derive(Clone, Debug)]
pub(crate) struct Contacts<S: Real, const D: usize> {
    pub(crate) obstacles: Obstacles<S, D>,
    /// One entry a resting point.
    pub(crate) rests: Vec<Rest<S, D>>,
    /// For every point 1 + its place in `rests`, 0 if it is in none; empty where there are no surfaces.
    place: Vec<u32>,
}

impl<S: Real, const D: usize> Contacts<S, D> {
    pub(crate) fn new(obstacles: &Obstacles<S, D>, points: usize) -> Self {
        let place = if obstacles.is_empty() { Vec::new() } else { vec![0; points] };
        Contacts { obstacles: obstacles.clone(), rests: Vec::new(), place }
    }

    /// Whether no point rests.
    #[inline(always)]
    pub(crate) fn is_idle(&self) -> bool {
        self.rests.is_empty()
    }

    /// The rest of a point, if it has one.
    #[inline(always)]
    pub(crate) fn of(&self, point: usize) -> Option<&Rest<S, D>> {
        if self.rests.is_empty() { None } else { self.rests.get((self.place[point] as usize).wrapping_sub(1)) }
    }

    /// The same, to be changed.
    pub(crate) fn of_mut(&mut self, point: usize) -> Option<&mut Rest<S, D>> {
        let at = (*self.place.get(point)? as usize).wrapping_sub(1);
        self.rests.get_mut(at)
    }

    /// Whether one of two points rests.
    #[inline(always)]
    pub(crate) fn touches_any(&self, points: [usize; 2]) -> bool {
        !self.is_idle() && points.iter().any(|&point| self.of(point).is_some())
    }

    /// What of a stiffness between two points is left of what they can follow.
    pub(crate) fn left_of(&self, [a, b]: [usize; 2], block: [[S; D]; D]) -> [[S; D]; D] {
        if !self.touches_any([a, b]) {
            return block;
        }
        let turned = |block: [[S; D]; D]| std::array::from_fn(|r| std::array::from_fn(|c| block[c][r]));
        let rows = turned(block.map(|row| self.free(b, row)));
        turned(rows.map(|column| self.free(a, column)))
    }

    /// Sliding friction `[m/s^2]` by what pressed a point when that was last asked, against where it heads for all of a step.
    pub(crate) fn rub_ahead(&self, rest: &Rest<S, D>) -> [S; D] {
        let size = length(rest.heading);
        if rest.sticks || size == S::ZERO {
            return [S::ZERO; D];
        }
        let press = length(sub(rest.pressing, rest.along(rest.pressing)));
        scale(rest.heading, -(rest.grip(&self.obstacles.surfaces) * press) / size)
    }

    /// The largest friction of the surfaces that a point rests on.
    pub(crate) fn grip_of(&self, point: usize) -> S {
        self.of(point).map_or(S::ZERO, |rest| rest.grip(&self.obstacles.surfaces))
    }

    /// What of an acceleration a point can follow, with sliding friction by what pressed it when this was last asked; what presses comes
    /// nearer to it by a share.
    pub(crate) fn rubbed(&mut self, point: usize, (total, share): ([S; D], S)) -> [S; D] {
        let Some(rest) = self.of(point) else { return total };
        let result = rest.free(add(total, self.rub_ahead(rest)));
        if let Some(rest) = self.of_mut(point) {
            rest.pressing = add(rest.pressing, scale(sub(total, rest.pressing), share));
        }
        result
    }

    /// What of a vector a point can follow.
    #[inline(always)]
    pub(crate) fn free(&self, point: usize, vector: [S; D]) -> [S; D] {
        self.of(point).map_or(vector, |rest| rest.free(vector))
    }

    /// Whether a point rests on a surface.
    pub(crate) fn rests_on(&self, point: usize, surface: usize) -> bool {
        self.of(point).is_some_and(|rest| rest.surfaces().contains(&(surface as u32)))
    }

    /// The point rests on the surface from now on.
    pub(crate) fn touch(&mut self, point: usize, surface: usize) {
        if self.place[point] == 0 {
            self.rests.push(Rest::new(point as u32));
            self.place[point] = self.rests.len() as u32;
        }
        let rest = &mut self.rests[self.place[point] as usize - 1];
        rest.add(surface as u32, &self.obstacles.surfaces);
    }

    /// Keeps the rests that `keep` says, and those of their surfaces that it leaves.
    pub(crate) fn retain(&mut self, mut keep: impl FnMut(&mut Rest<S, D>, &[Surface<S, D>])) {
        let surfaces = &self.obstacles.surfaces;
        for rest in &mut self.rests {
            keep(rest, surfaces);
        }
        if self.rests.iter().all(|rest| !rest.surfaces().is_empty()) {
            return;
        }
        self.place.fill(0);
        self.rests.retain(|rest| !rest.surfaces().is_empty());
        for (i, rest) in self.rests.iter().enumerate() {
            self.place[rest.point as usize] = i as u32 + 1;
        }
    }

    /// A point rests no more.
    pub(crate) fn release(&mut self, point: usize) {
        if self.of(point).is_some() {
            self.retain(|rest, surfaces| {
                if rest.point as usize == point {
                    rest.keep(surfaces, |_| false);
                }
            });
        }
    }

    /// Nothing rests any more.
    pub(crate) fn clear(&mut self) {
        self.rests.clear();
        self.place.fill(0);
    }

    /// Makes accelerations `a`, to which a kick adds `gravity`, such that the sum is what resting points can follow. `pressing`: all that
    /// presses on points, where bonds pass something on.
    pub(crate) fn hold_kick(&self, gravity: [f64; D], v: &[[S; D]], a: &mut [[S; D]], pressing: Option<&[[S; D]]>) {
        let gravity: [S; D] = super::vector::convert(gravity);
        for rest in &self.rests {
            let i = rest.point as usize;
            let total = add(a[i], gravity);
            let pressed = pressing.map_or(total, |pressing| pressing[i]);
            let total = rest.free(add(total, self.friction(rest, v[i], pressed)));
            a[i] = sub(total, gravity);
        }
    }

    /// Whether friction acts on a point that slides.
    pub(crate) fn rubs(&self) -> bool {
        self.rests.iter().any(|rest| !rest.sticks && rest.grip(&self.obstacles.surfaces) > S::ZERO)
    }

    /// Adds friction to accelerations that surfaces have not answered yet. Returns whether there is any.
    ///
    /// The accelerations before are remembered, to tell when points let go or slide.
    pub(crate) fn rub(&mut self, v: &[[S; D]], a: &mut [[S; D]]) -> bool {
        let mut any = false;
        for at in 0..self.rests.len() {
            let i = self.rests[at].point as usize;
            self.rests[at].pressing = a[i];
            let friction = self.friction(&self.rests[at], v[i], a[i]);
            any |= dot(friction, friction) > S::ZERO;
            a[i] = add(a[i], friction);
        }
        any
    }

    /// What presses on each resting point `[m/s^2]`, before friction and surfaces took their part.
    pub(crate) fn pressing(&self) -> impl Iterator<Item = [S; D]> + '_ {
        self.rests.iter().map(|rest| rest.pressing)
    }

    /// The same as it was.
    pub(crate) fn press_again(&mut self, pressing: &[[S; D]]) {
        self.rests.iter_mut().zip(pressing).for_each(|(rest, pressing)| rest.pressing = *pressing);
    }

    /// Makes friction that was added, and that bonds have answered to since, as large as what presses now allows. Returns the largest change
    /// `[m/s^2]`, 0 where all of it is rounding.
    pub(crate) fn rub_again(&mut self, v: &[[S; D]], a: &mut [[S; D]]) -> S {
        let mut largest = S::ZERO;
        for at in 0..self.rests.len() {
            let i = self.rests[at].point as usize;
            let before = self.friction(&self.rests[at], v[i], self.rests[at].pressing);
            self.rests[at].pressing = sub(a[i], before);
            let change = sub(self.friction(&self.rests[at], v[i], self.rests[at].pressing), before);
            let (size, rounded) = (length(change), length(before) * S::EPSILON * S::from_f64(ROUNDED));
            if size > rounded {
                a[i] = add(a[i], change);
                largest = largest.max(size);
            }
        }
        largest
    }

    /// What resting points can follow of their accelerations.
    pub(crate) fn hold(&self, a: &mut [[S; D]]) {
        for rest in &self.rests {
            let i = rest.point as usize;
            a[i] = rest.free(a[i]);
        }
    }

    /// Sliding friction `[m/s^2]`: against the velocity along the surface, as large as friction times what presses.
    pub(crate) fn friction(&self, rest: &Rest<S, D>, v: [S; D], total: [S; D]) -> [S; D] {
        let mu = rest.grip(&self.obstacles.surfaces);
        let none = [S::ZERO; D];
        if mu == S::ZERO || rest.sticks {
            return none;
        }
        let press = length(sub(total, rest.along(total)));
        let mut way = rest.along(v);
        let ahead = dot(way, rest.heading);
        if ahead == S::ZERO {
            let is_heading = dot(rest.heading, rest.heading) > S::ZERO;
            // From rest it goes where it is pushed.
            way = match (is_heading, dot(way, way) > S::ZERO) {
                (true, _) => rest.heading,
                (false, true) => way,
                (false, false) => rest.along(total),
            };
        } else if ahead < S::ZERO {
            way = scale(way, -S::ONE);
        }
        let speed = length(way);
        if speed == S::ZERO { none } else { scale(way, -(mu * press) / speed) }
    }

    /// A step begins: sliding points head where they go.
    pub(crate) fn set_out(&mut self, v: &[[S; D]]) {
        for rest in &mut self.rests {
            rest.heading = rest.along(v[rest.point as usize]);
        }
    }

    /// Puts resting points exactly on their surfaces, and takes from their velocities what leads off them.
    pub(crate) fn settle(&self, points: &mut Points<S, D>) {
        for rest in &self.rests {
            let i = rest.point as usize;
            for &surface in rest.surfaces() {
                place(points, i, &self.obstacles.surfaces[surface as usize]);
            }
            points.velocity[i] = rest.free(points.velocity[i]);
            points.velocity_lost[i] = rest.free(points.velocity_lost[i]);
        }
    }

    /// Whether there is any surface to meet.
    pub(crate) fn has_surfaces(&self) -> bool {
        !self.obstacles.is_empty()
    }
}

/// Puts a point on a surface.
pub(crate) fn place<S: Real, const D: usize>(points: &mut Points<S, D>, i: usize, surface: &Surface<S, D>) {
    let gap = surface.gap(points.position[i]);
    points.position[i] = sub(points.position[i], scale(surface.normal, gap));
    let lost = points.position_lost[i];
    points.position_lost[i] = sub(lost, scale(surface.normal, dot(surface.normal, lost)));
}
