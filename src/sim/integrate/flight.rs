//! Flights: the exact motion of points under gravity and drag alone.

use super::verlet::{Kick, Split, parts};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{accumulate, add, scale};

/// Constants of a flight over one stretch of time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight<S, const D: usize> {
    /// Displacement is v times this `[s]`.
    reach: Split<S>,
    /// Velocities keep this share.
    keep: S,
    /// Displacement by gravity `[m]`, in two parts.
    fall: [[S; D]; 2],
    /// Change of velocity by gravity `[m/s]`, in two parts.
    gain: [[S; D]; 2],
    /// The stretch `[s]`: how far pins go.
    time: Split<S>,
}

impl<S: Real, const D: usize> Flight<S, D> {
    /// v' = g - r v: v(h) = v e + g phi, x(h) = x + v phi + g psi; e = exp(-r h), phi = (1 - e)/r, psi = (h - phi)/r.
    pub(crate) fn new(gravity: [f64; D], rate: f64, h: f64) -> Self {
        let (keep, phi, psi) = if rate == 0.0 {
            (1.0, h, 0.5 * h * h)
        } else {
            let phi = -libm::expm1(-rate * h) / rate;
            (libm::exp(-rate * h), phi, fall_time(rate * h) * h * h)
        };
        Flight {
            reach: Split::new(phi),
            keep: S::from_f64(keep),
            fall: parts(gravity.map(|g| g * psi)),
            gain: parts(gravity.map(|g| g * phi)),
            time: Split::new(h),
        }
    }

    /// Moves every point by its flight; pins go straight on.
    pub(crate) fn take(&self, points: &mut Points<S, D>) {
        self.go::<false>(points, &Kick::new([0.0; D], 0.0));
    }

    /// Gives every point that is free a kick, then moves it by its flight.
    pub(crate) fn take_kicked(&self, points: &mut Points<S, D>, kick: &Kick<S, D>) {
        if points.acceleration.is_empty() {
            kick.give(points);
            return self.take(points);
        }
        self.go::<true>(points, kick);
    }

    #[inline(always)]
    fn go<const KICKED: bool>(&self, points: &mut Points<S, D>, kick: &Kick<S, D>) {
        let drags = self.keep != S::ONE;
        let falls = self.gain != [[S::ZERO; D]; 2];
        let Points { position, velocity, inverse_mass, position_lost, velocity_lost, acceleration, .. } = points;
        let count = position.len();
        let (velocity, velocity_lost) = (&mut velocity[..count], &mut velocity_lost[..count]);
        let (position_lost, inverse_mass) = (&mut position_lost[..count], &inverse_mass[..count]);
        let acceleration = if KICKED { &acceleration[..count] } else { &[] };
        for i in 0..count {
            let (mut v, mut lost) = (velocity[i], velocity_lost[i]);
            if inverse_mass[i] == S::ZERO {
                self.time.go(&mut position[i], &mut position_lost[i], v, lost);
                continue;
            }
            if KICKED {
                kick.change(&mut v, &mut lost, acceleration[i]);
            }
            let (x, owed) = (&mut position[i], &mut position_lost[i]);
            if falls {
                *owed = add(*owed, add(self.fall[0], self.fall[1]));
            }
            self.reach.go(x, owed, v, lost);
            if drags {
                (v, lost) = (scale(v, self.keep), scale(lost, self.keep));
            }
            if falls {
                lost = add(lost, self.gain[1]);
                accumulate(&mut v, &mut lost, self.gain[0]);
            }
            (velocity[i], velocity_lost[i]) = (v, lost);
        }
    }
}

/// (z - 1 + exp(-z))/z^2, by its series where the difference would cancel.
fn fall_time(z: f64) -> f64 {
    if z.abs() > 0.1 {
        return (z + libm::expm1(-z)) / (z * z);
    }
    let mut term = 0.5;
    let mut sum = term;
    for n in 3..14 {
        term *= -z / f64::from(n);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flight_with_little_drag_is_one_without() {
        let (with, without) = (fall_time(1e-9), 0.5);
        assert!((with - without).abs() < 1e-9);
        assert!((fall_time(0.0999) - fall_time(0.1001)).abs() < 1e-4);
        assert!((fall_time(0.1) - (0.1 - 1.0 + (-0.1_f64).exp()) / 0.01).abs() < 1e-13);
    }
}
