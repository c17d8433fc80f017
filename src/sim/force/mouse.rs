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
    /// Strength [1/s^2]: positive repels, negative attracts.
    pub strength: f64,
    /// Radius of the region, half the side of a square one [m], > 0.
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
pub struct Track {
    /// (t [s], [x, y] [m]), times ascending.
    pub knots: Vec<(f64, [f64; 2])>,
}

/// Where the cursor points: a ray in space; in the plane its origin is the cursor and z is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cursor {
    /// A point of the ray [m].
    pub origin: [f64; 3],
    /// Unit vector along the ray.
    pub direction: [f64; 3],
}

impl Track {
    /// Where the track is at time `t`; `None` where it has no knot.
    pub fn at(&self, t: f64) -> Option<[f64; 2]> {
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
        Some([a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s])
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
struct Push<S, const D: usize> {
    origin: [S; D],
    direction: [S; D],
    strength: S,
    radius: S,
    region: Region,
    profile: Profile,
}

impl<S: Real, const D: usize> Push<S, D> {
    fn new(force: &MouseForce, cursor: Cursor) -> Self {
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

    /// The acceleration of a point [m/s^2]; `None` outside the region.
    #[inline(always)]
    fn acceleration(&self, position: [S; D]) -> Option<[S; D]> {
        let r = self.offset(position);
        let distance = match self.region {
            Region::Round => length(r),
            Region::Square => r.into_iter().fold(S::ZERO, |largest, c| largest.max(c.abs())),
        };
        if distance >= self.radius {
            return None;
        }
        let share = match self.profile {
            Profile::Linear => S::ONE,
            Profile::Smooth => {
                let q = distance / self.radius;
                let fall = S::ONE - q * q;
                fall * fall
            }
        };
        Some(scale(r, self.strength * share))
    }

    /// Whether the region can reach a box: a sphere about the box stands in for it in space.
    fn reaches(&self, [low, high]: [[S; D]; 2]) -> bool {
        if D == 2 {
            return (0..D).all(|k| low[k] - self.origin[k] < self.radius && self.origin[k] - high[k] < self.radius);
        }
        let middle = scale(add(low, high), S::HALF);
        length(self.offset(middle)) < self.radius + length(sub(high, middle))
    }
}

/// Adds the acceleration by the mouse to `points.acceleration` and tells how many points were looked at.
///
/// Where the region does not reach the box around all points, no point is looked at.
pub(crate) fn push<S: Real, const D: usize>(points: &mut Points<S, D>, force: &MouseForce, cursor: Cursor) -> u64 {
    if !reaches(points, force, cursor) {
        return 0;
    }
    let push = Push::new(force, cursor);
    for i in 0..points.len() {
        if points.inverse_mass[i] != S::ZERO
            && let Some(a) = push.acceleration(points.position[i])
        {
            points.acceleration[i] = add(points.acceleration[i], a);
        }
    }
    points.len() as u64
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
        assert_eq!(Track::default().at(0.0), None);
    }
}
