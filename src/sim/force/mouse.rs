//! The mouse force: an acceleration away from the cursor (or towards it) inside a region around it.

use crate::sim::measure::extent;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, length, scale, sub, truncate};

/// Strength, reach and shape of the mouse force, the same for every mass.
///
/// Model: a = strength * profile(q) * (x - mouse) inside the region; q = |x - mouse|/radius, in a square region
/// max(|dx|, |dy|)/radius. In space x - mouse is the vector from the cursor's ray to the point.
#[derive(Clone, Debug, PartialEq)]
pub struct MouseForce {
    /// Strength `[1/s^2]`: positive repels, negative attracts.
    pub strength: f64,
    /// Radius of the region, half the side of a square one `[m]`, > 0.
    pub radius: f64,
    /// Shape of the region.
    pub region: Region,
    /// How the force falls off towards the edge.
    pub profile: Profile,
    /// Where the cursor goes by itself; empty: it is the live cursor.
    pub track: Track,
}

/// Shape of the region that the mouse force acts in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Region {
    /// |x - mouse| < radius.
    #[default]
    Round,
    /// max(|dx|, |dy|) < radius; in the plane only.
    Square,
}

/// How the mouse force falls off towards the edge of its region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Profile {
    /// (1 - q^2)^2: smooth down to zero at the edge.
    #[default]
    Smooth,
    /// 1 up to the edge, where the force jumps to zero.
    Linear,
}

/// A path over time, linear between its knots and held at both ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track<const D: usize = 2> {
    /// (t `[s]`, place `[m]`), times ascending.
    pub knots: Vec<(f64, [f64; D])>,
}

/// Where the cursor points: a ray in space; in the plane its origin is the cursor and z is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cursor {
    /// A point of the ray `[m]`.
    pub origin: [f64; 3],
    /// Unit vector along the ray.
    pub direction: [f64; 3],
}

impl<const D: usize> Track<D> {
    /// Where the track is at time `t`; `None` where it has no knot.
    pub fn at(&self, t: f64) -> Option<[f64; D]> {
        let next = self.knots.partition_point(|&(knot, _)| knot <= t);
        let (first, last) = (self.knots.first()?, self.knots.last()?);
        if next == 0 {
            return Some(first.1);
        }
        if next == self.knots.len() {
            return Some(last.1);
        }
        let ((t0, a), (t1, b)) = (self.knots[next - 1], self.knots[next]);
        let s = (t - t0) / (t1 - t0);
        Some(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * s))
    }

    /// The slope of the stretch that starts at time `t` or holds it `[m/s]`; 0 before the first knot and after the last.
    pub fn slope(&self, t: f64) -> [f64; D] {
        let next = self.knots.partition_point(|&(knot, _)| knot <= t);
        if next == 0 || next == self.knots.len() {
            return [0.0; D];
        }
        let ((t0, a), (t1, b)) = (self.knots[next - 1], self.knots[next]);
        std::array::from_fn(|k| (b[k] - a[k]) / (t1 - t0))
    }

    /// Whether the track has a knot after time `t`.
    pub fn moves_after(&self, t: f64) -> bool {
        self.knots.last().is_some_and(|&(last, _)| last > t)
    }
}

impl Cursor {
    /// The cursor at (x, y): in space the ray through it along -z.
    pub fn at([x, y]: [f64; 2]) -> Self {
        Cursor { origin: [x, y, 0.0], direction: [0.0, 0.0, -1.0] }
    }
}

/// The force as the kernel reads it, with its cursor.
pub(crate) struct Push<S, const D: usize> {
    origin: [S; D],
    direction: [S; D],
    strength: S,
    radius: S,
    region: Region,
    profile: Profile,
}

impl<S: Real, const D: usize> Push<S, D> {
    pub(crate) fn new(force: &MouseForce, cursor: Cursor) -> Self {
        Push {
            origin: convert(truncate(cursor.origin)),
            direction: convert(truncate(cursor.direction)),
            strength: S::from_f64(force.strength),
            radius: S::from_f64(force.radius),
            region: force.region,
            profile: force.profile,
        }
    }

    /// From the cursor (in space: from its ray) to the point.
    #[inline(always)]
    fn offset(&self, position: [S; D]) -> [S; D] {
        let r = sub(position, self.origin);
        if D == 2 { r } else { sub(r, scale(self.direction, dot(r, self.direction))) }
    }

    /// How far from the middle of the region `[m]`, as its shape measures it.
    #[inline(always)]
    fn distance(&self, r: [S; D]) -> S {
        match self.region {
            Region::Round => length(r),
            Region::Square => r.into_iter().fold(S::ZERO, |largest, c| largest.max(c.abs())),
        }
    }

    /// The acceleration of a point `[m/s^2]`; `None` outside the region.
    #[inline(always)]
    pub(crate) fn acceleration(&self, position: [S; D]) -> Option<[S; D]> {
        (self.distance(self.offset(position)) < self.radius).then(|| self.along(position))
    }

    /// The acceleration inside the region `[m/s^2]`, continued beyond its edge to twice the radius.
    #[inline(always)]
    fn along(&self, position: [S; D]) -> [S; D] {
        let r = self.offset(position);
        let q = self.distance(r) / self.radius;
        if q > S::ONE + S::ONE {
            return [S::ZERO; D];
        }
        let share = match self.profile {
            Profile::Linear => S::ONE,
            Profile::Smooth => {
                let fall = S::ONE - q * q;
                fall * fall
            }
        };
        scale(r, self.strength * share)
    }

    /// Whether the region can reach a box: a sphere about the box stands in for it in space.
    pub(crate) fn reaches(&self, [low, high]: [[S; D]; 2]) -> bool {
        if D == 2 {
            return (0..D).all(|k| low[k] - self.origin[k] < self.radius && self.origin[k] - high[k] < self.radius);
        }
        let middle = scale(add(low, high), S::HALF);
        length(self.offset(middle)) < self.radius + length(sub(high, middle))
    }
}

/// Which points are inside the region, where that changes at located events only.
#[derive(Clone, Debug)]
pub(crate) struct Inside {
    /// One entry a point.
    pub(crate) points: Vec<bool>,
    /// How many are inside.
    pub(crate) count: usize,
}

impl Inside {
    pub(crate) fn new(points: Vec<bool>) -> Self {
        Inside { count: points.iter().filter(|&&is_inside| is_inside).count(), points }
    }

    /// The point is on the other side now.
    pub(crate) fn toggle(&mut self, point: usize) {
        let is_inside = &mut self.points[point];
        *is_inside = !*is_inside;
        self.count = if *is_inside { self.count + 1 } else { self.count - 1 };
    }
}

/// Adds the acceleration by the mouse to `a` and tells how many points were looked at.
///
/// Where the region does not reach the box around all points, no point is looked at. `inside` decides in place of the
/// region's edge: the force goes on smoothly beyond it until an event says so.
pub(crate) fn push<S: Real, const D: usize>(
    force: &MouseForce,
    cursor: Cursor,
    inside: Option<&Inside>,
    x: &[[S; D]],
    w: &[S],
    a: &mut [[S; D]],
) -> u64 {
    let push = Push::new(force, cursor);
    if let Some(inside) = inside {
        if inside.count == 0 {
            return 0;
        }
        for i in 0..x.len() {
            if inside.points[i] && w[i] != S::ZERO {
                a[i] = add(a[i], push.along(x[i]));
            }
        }
        return x.len() as u64;
    }
    if !extent(x).is_some_and(|bounds| push.reaches(bounds)) {
        return 0;
    }
    for i in 0..x.len() {
        if w[i] != S::ZERO
            && let Some(more) = push.acceleration(x[i])
        {
            a[i] = add(a[i], more);
        }
    }
    x.len() as u64
}

/// How far inside the region points are `[m]`; below 0 outside.
pub(crate) fn gauge<S: Real, const D: usize>(force: &MouseForce, cursor: Cursor) -> impl Fn([S; D]) -> f64 {
    let push = Push::<S, D>::new(force, cursor);
    move |x| (push.radius - push.distance(push.offset(x))).to_f64()
}

/// Whether the region can reach any point.
pub(crate) fn reaches<S: Real, const D: usize>(points: &Points<S, D>, force: &MouseForce, cursor: Cursor) -> bool {
    extent(&points.position).is_some_and(|bounds| Push::new(force, cursor).reaches(bounds))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn force(strength: f64, region: Region, profile: Profile) -> MouseForce {
        MouseForce { strength, radius: 2.0, region, profile, track: Track::default() }
    }

    fn push_at(force: &MouseForce, position: [f64; 2]) -> Option<[f64; 2]> {
        Push::<f64, 2>::new(force, Cursor::at([1.0, 0.0])).acceleration(position)
    }

    #[test]
    fn positive_strength_repels_and_falls_off_smoothly() {
        let force = force(8.0, Region::Round, Profile::Smooth);
        assert_eq!(push_at(&force, [2.0, 0.0]), Some([8.0 * 0.5625, 0.0]));
        assert_eq!(push_at(&force, [1.0, 0.0]), Some([0.0, 0.0]));
        assert_eq!(push_at(&force, [3.0, 0.0]), None);
    }

    #[test]
    fn a_square_region_has_corners() {
        let force = force(-7.0, Region::Square, Profile::Linear);
        assert_eq!(push_at(&force, [2.9, 1.9]), Some([-7.0 * 1.9, -7.0 * 1.9]));
        assert_eq!(push_at(&force, [2.9, 2.1]), None);
    }

    #[test]
    fn in_space_the_push_is_away_from_the_ray() {
        let force = force(1.0, Region::Round, Profile::Linear);
        let push = Push::<f64, 3>::new(&force, Cursor::at([1.0, 0.0]));
        assert_eq!(push.acceleration([1.5, 0.0, 70.0]), Some([0.5, 0.0, 0.0]));
    }

    #[test]
    fn a_track_is_linear_and_held_at_its_ends() {
        let track = Track { knots: vec![(1.0, [0.0, 0.0]), (2.0, [4.0, 2.0])] };
        assert_eq!(track.at(0.0), Some([0.0, 0.0]));
        assert_eq!(track.at(1.5), Some([2.0, 1.0]));
        assert_eq!(track.at(9.0), Some([4.0, 2.0]));
        assert_eq!(Track::<2>::default().at(0.0), None);
        assert_eq!([0.5, 1.0, 2.0].map(|t| track.slope(t)), [[0.0, 0.0], [4.0, 2.0], [0.0, 0.0]]);
    }
}
