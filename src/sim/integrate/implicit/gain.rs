//! Whether an implicit step has made energy: a system that is stiff may have more than one solution, and of most bodies would fly apart.

use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{convert, dot};

/// Share of the energy that there is by which a step may have more afterwards: the method's own error.
const MOST_GAIN: f64 = 0.02;

/// The energy of a group `[J]`: kinetic, of springs, angles and areas, and that of gravity from the place that it is counted from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Energy {
    motion: f64,
    gravity: f64,
    /// The kinetic energy of a fall of one substep.
    fall: f64,
}

impl Energy {
    /// Of points in this state, which take substeps of `h` `[s]`.
    pub(crate) fn of<S: Real, const D: usize>(points: &Points<S, D>, pull: &Pull<S, D>, h: f64) -> Self {
        let (x, v, w) = (&points.position, &points.velocity, &points.inverse_mass);
        let field: [S; D] = convert(pull.gravity);
        let fall = 0.5 * h * h * dot(pull.gravity, pull.gravity);
        let mut sum = Energy { motion: pull.elastic(x), gravity: 0.0, fall: 0.0 };
        for i in (0..x.len()).filter(|&i| w[i] != S::ZERO) {
            let mass = 1.0 / w[i].to_f64();
            sum.motion += 0.5 * mass * dot(v[i], v[i]).to_f64();
            sum.gravity -= mass * dot(field, x[i]).to_f64();
            sum.fall += mass * fall;
        }
        sum
    }

    /// Whether `after` is more than the method's error allows.
    pub(crate) fn is_exceeded(self, after: Energy) -> bool {
        let most = self.motion + MOST_GAIN * (self.motion + self.fall);
        let now = after.motion + (after.gravity - self.gravity);
        now.is_nan() || now > most
    }
}

/// Whether nothing but gravity, springs and surfaces gives energy to a group around `t` `[s]`.
pub(crate) fn is_left_alone<S: Real, const D: usize>(
    points: &Points<S, D>,
    pull: &Pull<S, D>,
    around: &Environment<D>,
    t: f64,
) -> bool {
    let goes = |(w, v): (&S, &[S; D])| *w == S::ZERO && dot(*v, *v) != S::ZERO;
    let is_led = points.inverse_mass.iter().zip(&points.velocity).any(goes);
    !is_led && pull.led.is_empty() && !pull.has_fields() && pull.driven.is_empty() && around.mouse_at(t).is_none()
}
