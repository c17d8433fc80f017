//! The walls around the world: an axis-parallel box that points stay inside.

use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::convert;

/// The box and what its walls are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<const D: usize> {
    /// Lower corner [m].
    pub min: [f64; D],
    /// Upper corner [m], above `min` on every axis.
    pub max: [f64; D],
    /// v_n -> -restitution v_n on touching [1], >= 0.
    pub restitution: f64,
    /// |change of v_t| <= friction |change of v_n| [1], >= 0.
    pub friction: f64,
}

/// A point that touched a wall in this substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch<S> {
    point: u32,
    axis: u8,
    /// The wall is the upper one on its axis.
    upper: bool,
    /// The point stays on the wall (instead of bouncing off it).
    rests: bool,
    wall: S,
}

/// The walls as the kernel reads them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walls<S, const D: usize> {
    min: [S; D],
    max: [S; D],
    restitution: S,
    friction: S,
}

impl<S: Real, const D: usize> Walls<S, D> {
    pub(crate) fn new(bounds: &Bounds<D>) -> Self {
        Walls {
            min: convert(bounds.min),
            max: convert(bounds.max),
            restitution: S::from_f64(bounds.restitution),
            friction: S::from_f64(bounds.friction),
        }
    }

    /// Cuts displacements short at the walls and turns velocities round; lists who touched which wall.
    ///
    /// A point that reaches a wall spends the rest of its substep on the way back, at -restitution of its speed. One
    /// that comes no faster than gravity (or the force on it) makes it within a substep does not bounce but rests: a
    /// bounce that small cannot be told from rounding and would go on for ever.
    pub(crate) fn stop(&self, points: &mut Points<S, D>, gravity: [f64; D], h: f64, touches: &mut Vec<Touch<S>>) {
        touches.clear();
        let gravity: [S; D] = convert(gravity);
        let h = S::from_f64(h);
        for i in 0..points.len() {
            if points.inverse_mass[i] == S::ZERO {
                continue;
            }
            for k in 0..D {
                let x = points.position[i][k];
                let next = x + points.displacement[i][k];
                let upper = next > self.max[k];
                if !upper && next >= self.min[k] {
                    continue;
                }
                let wall = if upper { self.max[k] } else { self.min[k] };
                let speed = points.velocity[i][k];
                let force = points.acceleration.get(i).map_or(S::ZERO, |a| a[k]);
                let rests = self.restitution == S::ZERO || speed.abs() <= (gravity[k] + force).abs() * (h + h);
                self.reflect(points, i, k, upper, rests);
                touches.push(Touch { point: i as u32, axis: k as u8, upper, rests, wall });
            }
        }
    }

    /// One point meets one wall: its displacement and velocity across the wall, then friction along it.
    fn reflect(&self, points: &mut Points<S, D>, i: usize, k: usize, upper: bool, rests: bool) {
        let x = points.position[i][k];
        let (wall, opposite) = if upper { (self.max[k], self.min[k]) } else { (self.min[k], self.max[k]) };
        let bounce = if rests { S::ZERO } else { self.restitution };
        // A point that starts outside is put on the wall: it has no way back to spend.
        let was_inside = if upper { x <= wall } else { x >= wall };
        let beyond = if was_inside { points.displacement[i][k] - (wall - x) } else { S::ZERO };
        let back = wall - bounce * beyond;
        let next = if upper { back.max(opposite) } else { back.min(opposite) };
        points.displacement[i][k] = next - x;
        // Where a projection pushed the point through the wall its velocity may already point inward: keep that.
        let speed = points.velocity[i][k];
        let outward = speed != S::ZERO && (speed > S::ZERO) == upper;
        let after = if outward { -(bounce * speed) } else { speed };
        points.velocity[i][k] = after;
        self.rub(points, i, k, (after - speed).abs());
    }

    /// Friction: the velocity along the wall loses at most `friction` times the change across it.
    fn rub(&self, points: &mut Points<S, D>, i: usize, k: usize, change: S) {
        let mut square = S::ZERO;
        for t in (0..D).filter(|&t| t != k) {
            square += points.velocity[i][t] * points.velocity[i][t];
        }
        let speed = square.sqrt();
        if self.friction == S::ZERO || speed == S::ZERO {
            return;
        }
        let keep = (S::ONE - self.friction * change / speed).max(S::ZERO);
        for t in (0..D).filter(|&t| t != k) {
            points.velocity[i][t] *= keep;
            points.displacement[i][t] *= keep;
        }
    }

    /// Puts resting points exactly on their wall: what rounding left of the way is taken off.
    pub(crate) fn place(points: &mut Points<S, D>, touches: &[Touch<S>]) {
        for touch in touches.iter().filter(|touch| touch.rests) {
            let (i, k) = (touch.point as usize, usize::from(touch.axis));
            points.position[i][k] = touch.wall;
            points.position_lost[i][k] = S::ZERO;
        }
    }

    /// After the closing half kick: a resting point that is pressed against its wall has no velocity into it.
    pub(crate) fn rest(&self, points: &mut Points<S, D>, touches: &[Touch<S>]) {
        for touch in touches.iter().filter(|touch| touch.rests) {
            let (i, k) = (touch.point as usize, usize::from(touch.axis));
            let speed = points.velocity[i][k];
            if speed != S::ZERO && (speed > S::ZERO) == touch.upper {
                points.velocity[i][k] = S::ZERO;
                points.velocity_lost[i][k] = S::ZERO;
                self.rub(points, i, k, speed.abs());
            }
        }
    }
}
