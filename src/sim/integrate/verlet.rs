//! Verlet's method on increments.
//!
//! Position Verlet, x(t+h) = 2 x(t) - x(t-h) + a h^2 with x(h) = x0 + v0 h + a0 h^2/2, is the same motion as
//!
//! ```text
//! v += a(x) h/2      half kick
//! x += v h           drift
//! v += a(x) h/2      half kick
//! ```
//!
//! (insert one into the next and v drops out). This form starts right by itself, has position and velocity at the
//! same time, and adds small increments to large numbers only by [`accumulate`]. Second order, symplectic.
//! Source: L. Verlet, Phys. Rev. 159, 98 (1967); W. C. Swope et al., J. Chem. Phys. 76, 637 (1982).

use crate::sim::points::Points;
use crate::sim::real::{Precision, Real};
use crate::sim::vector::{accumulate, add, convert, scale, sub, widen, zero};

/// A number in two parts, so that a constant of the substep loses nothing to the world's scalar.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split<S> {
    /// The nearest number of the world's scalar.
    pub(crate) high: S,
    /// What that leaves; 0 in `f64`.
    pub(crate) low: S,
}

impl<S: Real> Split<S> {
    pub(crate) fn new(value: f64) -> Self {
        let high = S::from_f64(value);
        Split { high, low: S::from_f64(value - high.to_f64()) }
    }

    /// sum += v times this number, with the part of v that rounding had taken, compensated.
    ///
    /// What is small comes together first: it does not wait for v.
    #[inline(always)]
    pub(crate) fn go<const D: usize>(self, sum: &mut [S; D], owed: &mut [S; D], v: [S; D], lost: [S; D]) {
        *owed = add(*owed, scale(lost, self.high));
        let way = scale(v, self.high);
        if S::PRECISION == Precision::F32 {
            *owed = add(*owed, scale(v, self.low));
        }
        accumulate(sum, owed, way);
    }

    /// v times this number, with the part of v that rounding had taken.
    #[inline(always)]
    pub(crate) fn times<const D: usize>(self, v: [S; D], lost: [S; D]) -> [S; D] {
        let mut fine = scale(lost, self.high);
        if S::PRECISION == Precision::F32 {
            fine = add(scale(v, self.low), fine);
        }
        add(scale(v, self.high), fine)
    }
}

/// A vector in two parts.
pub(crate) fn parts<S: Real, const D: usize>(vector: [f64; D]) -> [[S; D]; 2] {
    let high = convert(vector);
    [high, convert(sub(vector, widen(high)))]
}

/// What a kick gives to every point: v += (gravity + acceleration) h.
///
/// Gravity's kick is formed in `f64` and given in two parts: as one rounded constant, the same error would be made in
/// every substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kick<S, const D: usize> {
    fall: [[S; D]; 2],
    h: S,
}

impl<S: Real, const D: usize> Kick<S, D> {
    pub(crate) fn new(gravity: [f64; D], h: f64) -> Self {
        Kick { fall: parts(gravity.map(|g| g * h)), h: S::from_f64(h) }
    }

    /// What it makes of one velocity.
    #[inline(always)]
    pub(crate) fn change(&self, v: &mut [S; D], lost: &mut [S; D], acceleration: [S; D]) {
        // In 64 bits the second part is 0, and the first one may well take in what is owed.
        *lost = add(*lost, if S::PRECISION == Precision::F32 { self.fall[1] } else { self.fall[0] });
        let push = scale(acceleration, self.h);
        accumulate(v, lost, if S::PRECISION == Precision::F32 { add(self.fall[0], push) } else { push });
    }

    /// Gives it to every point that is free. Their acceleration may be empty: gravity alone.
    pub(crate) fn give(&self, points: &mut Points<S, D>) {
        for i in 0..points.len() {
            if points.inverse_mass[i] == S::ZERO {
                continue;
            }
            let acceleration = points.acceleration.get(i).copied().unwrap_or(zero());
            self.change(&mut points.velocity[i], &mut points.velocity_lost[i], acceleration);
        }
    }
}

/// v += (gravity + acceleration) h for every point that is free.
pub(crate) fn kick<S: Real, const D: usize>(points: &mut Points<S, D>, gravity: [f64; D], h: f64) {
    Kick::new(gravity, h).give(points);
}

/// Drag over a time h, exactly: v *= exp(-rate h) for every point that is free.
pub(crate) fn slow<S: Real, const D: usize>(points: &mut Points<S, D>, rate: f64, h: f64) {
    if rate == 0.0 {
        return;
    }
    let factor = S::from_f64(libm::exp(-rate * h));
    for i in 0..points.len() {
        if points.inverse_mass[i] != S::ZERO {
            points.velocity[i] = scale(points.velocity[i], factor);
            points.velocity_lost[i] = scale(points.velocity_lost[i], factor);
        }
    }
}

/// displacement = v h: where the substep would take each point if nothing held it.
pub(crate) fn predict<S: Real, const D: usize>(points: &mut Points<S, D>, h: f64) {
    let h = Split::new(h);
    for i in 0..points.len() {
        points.displacement[i] = h.times(points.velocity[i], points.velocity_lost[i]);
    }
}

/// Velocities follow what projection made of the displacements: v += (displacement - v h)/h.
///
/// A point whose displacement nothing changed gets exactly 0.
pub(crate) fn follow<S: Real, const D: usize>(points: &mut Points<S, D>, h: f64) {
    let rate = S::from_f64(1.0 / h);
    let h = Split::new(h);
    for i in 0..points.len() {
        if points.inverse_mass[i] == S::ZERO {
            continue;
        }
        let free = h.times(points.velocity[i], points.velocity_lost[i]);
        let change = scale(sub(points.displacement[i], free), rate);
        accumulate(&mut points.velocity[i], &mut points.velocity_lost[i], change);
    }
}

/// x += displacement for every point.
pub(crate) fn advance<S: Real, const D: usize>(points: &mut Points<S, D>) {
    for i in 0..points.len() {
        shift(points, i, points.displacement[i]);
    }
}

#[inline(always)]
fn shift<S: Real, const D: usize>(points: &mut Points<S, D>, i: usize, d: [S; D]) {
    accumulate(&mut points.position[i], &mut points.position_lost[i], d);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_a_split_make_the_whole() {
        let h = Split::<f32>::new(1.0 / 3840.0);
        assert!((f64::from(h.high) + f64::from(h.low) - 1.0 / 3840.0).abs() < 1e-18);
        assert_eq!(Split::<f64>::new(1.0 / 3840.0).low, 0.0);
    }
}
