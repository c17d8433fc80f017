//! One island with the pins that it hangs from: what acts on it, and its scales.

use super::hold::{Grip, Hold};
use crate::sim::bonds::Bonds;
use crate::sim::contact::surface::Surface;
use crate::sim::force::form::Form;
use crate::sim::force::spring::Spring;
use crate::sim::force::steady::Thrust;
use crate::sim::measure;
use crate::sim::vector::{add, length, scale, sub};

/// An island, its points numbered from 0.
#[derive(Clone, Debug)]
pub(super) struct Part<const D: usize> {
    /// For every point here the point of the model.
    pub(super) members: Vec<u32>,
    /// Positions at the start `[m]`.
    pub(super) position: Vec<[f64; D]>,
    /// Masses `[kg]`.
    pub(super) mass: Vec<f64>,
    pub(super) is_free: Vec<bool>,
    /// Gravity, and what the mean wind gives by drag `[m/s^2]`.
    pub(super) gravity: [f64; D],
    /// Constant forces on its points `[N]`.
    pub(super) pushes: Vec<[f64; D]>,
    /// Torques on some of its points, whose masses these are `[kg]`.
    pub(super) torques: Vec<Thrust<f64, D>>,
    /// The springs as bonds, whose energy is asked for, and as springs, whose force is.
    pub(super) bonds: Bonds,
    pub(super) springs: Vec<Spring<f64>>,
    /// Angles and areas that are forces.
    pub(super) form: Form<f64>,
    /// Rigid bonds, then every pair of a free point and a surface.
    pub(super) holds: Vec<Hold>,
    pub(super) surfaces: Vec<Surface<f64, D>>,
}

impl<const D: usize> Part<D> {
    /// Weight of all free points, and the constant forces on them `[N]`.
    pub(super) fn weight(&self) -> f64 {
        let mass: f64 = self.mass.iter().zip(&self.is_free).filter(|(_, free)| **free).map(|(m, _)| m).sum();
        mass * length(self.gravity) + self.pushes.iter().map(|&push| length(push)).sum::<f64>()
    }

    /// The acceleration of the whole, if it were free `[m/s^2]`.
    pub(super) fn drift(&self) -> [f64; D] {
        let free = || (0..self.mass.len()).filter(|&i| self.is_free[i]);
        let mass: f64 = free().map(|i| self.mass[i]).sum();
        let push = free().fold([0.0; D], |sum, i| add(sum, self.pushes[i]));
        if mass > 0.0 { add(self.gravity, scale(push, 1.0 / mass)) } else { self.gravity }
    }

    /// What torques give to its points where they are `[N]`.
    pub(super) fn twist(&self, x: &[[f64; D]]) -> Vec<[f64; D]> {
        let mut forces = vec![[0.0; D]; x.len()];
        let w: Vec<f64> =
            self.mass.iter().zip(&self.is_free).map(|(m, free)| if *free { 1.0 / m } else { 0.0 }).collect();
        for torque in &self.torques {
            torque.each(x, &w, |i, push| forces[i] = add(forces[i], scale(push, self.mass[i])));
        }
        forces
    }

    /// The scale of stiffness `[N/m]`: of springs, and of all weight on the shortest rigid bond; 1 where there is neither.
    pub(super) fn stiffest(&self) -> f64 {
        let springs = self.springs.iter().map(|spring| spring.stiffness).fold(0.0, f64::max);
        let shortest = self.holds.iter().fold(extent(&self.position), |shortest, hold| match hold.grip {
            Grip::Bond { rest, .. } => shortest.min(rest),
            Grip::Surface { .. } => shortest,
        });
        let stiffest = springs.max(self.form.stiffest(&self.position)).max(self.weight() / shortest);
        if stiffest > 0.0 { stiffest } else { 1.0 }
    }
}

/// Diagonal of the box around points `[m]`, 1 where they coincide.
pub(super) fn extent<const D: usize>(x: &[[f64; D]]) -> f64 {
    let size = measure::extent(x).map_or(0.0, |[low, high]| length(sub(high, low)));
    if size > 0.0 && size.is_finite() { size } else { 1.0 }
}

/// A distance that rounding can hardly tell from 0 `[m]`: a share of the extent, or of how far from the origin points are.
pub(super) fn grain<const D: usize>(x: &[[f64; D]]) -> f64 {
    let farthest = x.iter().flatten().fold(0.0_f64, |most, component| most.max(component.abs()));
    1e-14 * extent(x).max(farthest)
}
