//! A constant force or torque on chosen points.

use crate::sim::bond::PointId;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub, zero};

/// A constant force, shared by mass, and a constant torque about the middle of chosen points.
///
/// Model: of those points that are free, with masses m_i `[kg]`, M = sum m_i, c their middle by mass `[m]` and
/// I = sum m_i |x_i - c|^2 `[kg m^2]`, each is accelerated by
///
/// ```text
/// a_i = force/M + torque/I left(x_i - c)        left(x, y) = (-y, x)
/// ```
///
/// so that a body of these points that keeps its shape has the acceleration force/M and the angular one torque/I. Pinned points
/// take none. A torque does nothing where all points lie in one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Force<const D: usize> {
    /// The points that it acts on, one or more; one that is named twice counts once.
    pub points: Vec<PointId>,
    /// `[N]`, finite.
    pub force: [f64; D],
    /// About their middle, anticlockwise `[N m]`, finite; 0 in space.
    pub torque: f64,
}

impl<const D: usize> Force<D> {
    /// The points that it acts on, ascending, each once.
    pub(crate) fn members(&self) -> Vec<PointId> {
        let mut points = self.points.clone();
        points.sort_unstable();
        points.dedup();
        points
    }
}

/// A force as the points of a group feel it.
#[derive(Clone, Debug)]
pub(crate) struct Thrust<S, const D: usize> {
    /// Places of its points.
    pub(crate) slots: Vec<u32>,
    /// Share of the mass at each place that it acts on `[1]`: below 1 where points that it does not name are welded to one.
    pub(crate) shares: Vec<S>,
    /// What the force gives to a share of 1 `[m/s^2]`.
    pub(crate) acceleration: [S; D],
    /// `[N m]`
    pub(crate) torque: S,
}

impl<S: Real, const D: usize> Thrust<S, D> {
    /// Calls `give` with every free place and its acceleration `[m/s^2]`.
    ///
    /// Shapes: `x` `[m]` and `w` `[1/kg]` have one entry a place.
    pub(crate) fn each(&self, x: &[[S; D]], w: &[S], mut give: impl FnMut(usize, [S; D])) {
        let (middle, spin) = if self.torque == S::ZERO { (zero(), S::ZERO) } else { self.spin(x, w) };
        for (&slot, &share) in self.slots.iter().zip(&self.shares) {
            let i = slot as usize;
            if w[i] == S::ZERO {
                continue;
            }
            let turn = if spin == S::ZERO { zero() } else { scale(left(sub(x[i], middle)), spin) };
            give(i, scale(add(self.acceleration, turn), share));
        }
    }

    /// The middle of the free points `[m]` and their angular acceleration `[1/s^2]`.
    fn spin(&self, x: &[[S; D]], w: &[S]) -> ([S; D], S) {
        let free = || self.slots.iter().zip(&self.shares).filter(|(slot, _)| w[**slot as usize] != S::ZERO);
        let Some((&first, _)) = free().next() else { return (zero(), S::ZERO) };
        // Far from the origin places lose digits that their differences have.
        let origin = x[first as usize];
        let from = |i: u32| sub(x[i as usize], origin);
        let mass = |i: u32, share: S| share / w[i as usize];
        let (sum, total) = free().fold((zero(), S::ZERO), |(sum, total), (&i, &share)| {
            (add(sum, scale(from(i), mass(i, share))), total + mass(i, share))
        });
        let middle = scale(sum, S::ONE / total);
        let inertia = free().fold(S::ZERO, |inertia, (&i, &share)| {
            let arm = sub(from(i), middle);
            inertia + mass(i, share) * dot(arm, arm)
        });
        let spin = self.torque / inertia;
        (add(origin, middle), if spin.is_finite() { spin } else { S::ZERO })
    }

    /// How strongly it accelerates, its torque apart `[m/s^2]`.
    pub(crate) fn size(&self) -> f64 {
        length(self.acceleration).to_f64()
    }
}

/// Turned by a quarter anticlockwise; in space nothing is.
#[inline(always)]
fn left<S: Real, const D: usize>(a: [S; D]) -> [S; D] {
    let mut turned = zero();
    if D == 2 {
        (turned[0], turned[1]) = (-a[1], a[0]);
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pushes(thrust: &Thrust<f64, 2>, x: &[[f64; 2]], w: &[f64]) -> Vec<[f64; 2]> {
        let mut list = vec![[0.0; 2]; x.len()];
        thrust.each(x, w, |i, push| list[i] = push);
        list
    }

    #[test]
    fn a_torque_has_its_moment_and_no_force_far_from_the_origin_too() {
        let x = [[1e6, 2.0], [1e6 + 2.0, 2.0], [1e6, 3.0], [1e6 + 0.5, 0.5]];
        let w = [1.0, 0.5, 0.25, 2.0];
        let thrust = Thrust { slots: vec![0, 1, 2, 3], shares: vec![1.0; 4], acceleration: [0.0; 2], torque: 6.0 };
        let (mut force, mut moment) = ([0.0; 2], 0.0);
        for (i, push) in pushes(&thrust, &x, &w).into_iter().enumerate() {
            force = add(force, scale(push, 1.0 / w[i]));
            moment += ((x[i][0] - 1e6) * push[1] - x[i][1] * push[0]) / w[i];
        }
        // The middle is known to the last place of a million metres.
        assert!(length(force) < 1e-9 && (moment - 6.0).abs() < 1e-9, "{force:?} {moment}");
    }

    #[test]
    fn pins_take_none_and_a_torque_in_one_place_does_nothing() {
        let thrust = Thrust { slots: vec![0, 2], shares: vec![1.0, 0.5], acceleration: [3.0, 0.0], torque: 1.0 };
        assert_eq!(pushes(&thrust, &[[1.0; 2]; 3], &[0.0, 1.0, 1.0]), [[0.0; 2], [0.0; 2], [1.5, 0.0]]);
        assert_eq!(pushes(&thrust, &[[1.0; 2]; 3], &[0.0; 3]), [[0.0; 2]; 3]);
    }
}
