//! What can be measured of a state: extent, energy, strain, momentum.

use super::bond::Bond;
use super::bonds::Bonds;
use super::force::spring;
use super::points::Points;
use super::real::Real;
use super::vector::{dot, length, sub};

/// The box around all positions: its lower and upper corner; `None` where there is no point.
pub(crate) fn extent<S: Real, const D: usize>(position: &[[S; D]]) -> Option<[[S; D]; 2]> {
    let mut low = *position.first()?;
    let mut high = low;
    for x in position {
        for k in 0..D {
            low[k] = if x[k] < low[k] { x[k] } else { low[k] };
            high[k] = if x[k] > high[k] { x[k] } else { high[k] };
        }
    }
    Some([low, high])
}

/// Kinetic + springs' + gravity's energy of the points that are not pinned [J]; gravity's is 0 at the origin.
///
/// Shapes: `position`, `velocity` and `w` have one entry a point; w = 0 is pinned.
pub(crate) fn energy<const D: usize>(
    position: &[[f64; D]],
    velocity: &[[f64; D]],
    w: &[f64],
    bonds: &Bonds,
    gravity: [f64; D],
) -> f64 {
    let mut sum = spring::energy(bonds, |i| position[i]);
    for ((&x, &v), &w) in position.iter().zip(velocity).zip(w) {
        if w > 0.0 {
            sum += (0.5 * dot(v, v) - dot(gravity, x)) / w;
        }
    }
    sum
}

/// Largest |length/rest - 1| over the bonds [1], those of rest length 0 left out.
pub(crate) fn max_strain<const D: usize>(position: &[[f64; D]], bonds: &Bonds) -> f64 {
    let of = |bond: Bond| {
        let d = sub(position[bond.a.index()], position[bond.b.index()]);
        if bond.rest_length > 0.0 { (length(d) / bond.rest_length - 1.0).abs() } else { 0.0 }
    };
    bonds.iter().map(of).fold(0.0, f64::max)
}

/// Whether no point is faster than `speed` [m/s]. Stops at the first that is.
pub(crate) fn is_slower<S: Real, const D: usize>(points: &Points<S, D>, speed: f64) -> bool {
    let square = S::from_f64(speed * speed);
    points.velocity.iter().all(|&v| dot(v, v) <= square)
}
