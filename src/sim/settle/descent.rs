//! The state of a descent, and its rounds: a step of Newton's method, as far as that lowers the merit.

use super::BALANCED;
use super::hold::Hold;
use crate::sim::bond::{Bond, Limit};
use crate::sim::contact::surface::Surface;
use crate::sim::force::spring::Spring;
use crate::sim::plan::nudge;
use crate::sim::solve::blocks::Blocks;
use crate::sim::vector::{add, length, scale};

/// Times that a shape is pushed off a saddle, and how far, as a share of its extent.
const MOST_PUSHES: u32 = 3;
const PUSH: f64 = 1e-3;
/// Times that the shift is raised in one round: the last is beyond any stiffness.
const MOST_SHIFTS: u32 = 12;
/// Longest step, as a share of the diagonal of the box around all points: further out the model of the energy is none.
const REACH: f64 = 0.25;

/// Where the points are, what acts on them, and how far the descent has come.
pub(super) struct Descent<const D: usize> {
    /// For every point of the model the one that it is welded to.
    pub(super) stand_ins: Vec<u32>,
    pub(super) x: Vec<[f64; D]>,
    /// Masses of free points, 0 for pinned ones.
    pub(super) mass: Vec<f64>,
    pub(super) is_free: Vec<bool>,
    pub(super) gravity: [f64; D],
    pub(super) bonds: Vec<Bond>,
    pub(super) springs: Vec<Spring<f64>>,
    pub(super) pairs: Vec<[u32; 2]>,
    pub(super) rigid: Vec<Hold>,
    /// Rigid bonds that act one way: those that do are among the pressed.
    pub(super) limited: Vec<(Hold, Limit)>,
    pub(super) surfaces: Vec<Surface<f64, D>>,
    pub(super) pressed: Vec<Hold>,
    pub(super) system: Blocks<f64, D>,
    pub(super) lambda: Vec<f64>,
    pub(super) work: Vec<f64>,
    pub(super) shift: f64,
    pub(super) penalty: f64,
    pub(super) residual: f64,
    pub(super) is_done: bool,
    /// Some point falls for ever.
    pub(super) has_loose: bool,
    /// Times that it was pushed off a saddle.
    pub(super) pushes: u32,
}

impl<const D: usize> Descent<D> {
    /// One step of Newton's method, shortened where it has to be.
    pub(super) fn round(&mut self) {
        let holds = self.holds();
        let (mut force, largest) = self.forces();
        let stiffest = self.stiffest();
        let mut system = std::mem::replace(&mut self.system, Blocks::new(&[], &[], &[]));
        let mut error: Vec<f64> = holds.iter().map(|&hold| -self.off(hold, &self.x).0).collect();
        let wanted = force.clone();
        for _ in 0..MOST_SHIFTS {
            self.fill(&mut system, &holds, stiffest);
            let inertia = system.factor();
            // One negative pivot for every constraint, none for points: H is positive along the constraints.
            if inertia.negative as usize + inertia.skipped as usize <= holds.len() {
                break;
            }
            self.shift = (10.0 * self.shift).max(1e-4 * stiffest);
        }
        force.push([0.0; D]);
        system.solve(&mut force, &mut error, &mut self.work);
        self.residual = self.balance(&wanted, &holds, &error) / largest.max(f64::MIN_POSITIVE);
        self.take(&system, force, &error, stiffest);
        self.system = system;
        self.revise(&error);
    }

    /// Goes along a step as far as that lowers the merit.
    ///
    /// A step that leaves curved constraints is bent back to them before it is shortened.
    pub(super) fn take(&mut self, system: &Blocks<f64, D>, mut step: Vec<[f64; D]>, lambda: &[f64], stiffest: f64) {
        let most = lambda.iter().fold(self.weight(), |most, lambda| most.max(lambda.abs()));
        // It follows the multipliers down again: those of the first rounds may be far too large.
        self.penalty = (0.5 * self.penalty).max(2.0 * most);
        let (extent, holds) = (self.extent(), self.holds());
        let size = step.iter().map(|s| length(*s)).fold(0.0, f64::max);
        if size > REACH * extent {
            step.iter_mut().for_each(|s| *s = scale(*s, REACH * extent / size));
        }
        let off = holds.iter().map(|&hold| self.off(hold, &self.x).0.abs()).fold(0.0, f64::max);
        let before = self.merit(&self.x);
        let slack = 1e-13 * (before.abs() + self.energy_scale());
        let mut share = 1.0;
        while share > 1e-8 {
            let mut x: Vec<[f64; D]> = self.x.iter().zip(&step).map(|(&x, &s)| add(x, scale(s, share))).collect();
            if self.merit(&x) > before + slack {
                let mut force = vec![[0.0; D]; x.len() + 1];
                let mut error: Vec<f64> = holds.iter().map(|&hold| -self.off(hold, &x).0).collect();
                system.solve(&mut force, &mut error, &mut self.work);
                x.iter_mut().zip(&force).for_each(|(x, &back)| *x = add(*x, back));
            }
            if self.merit(&x) <= before + slack {
                self.x = x;
                break;
            }
            share *= 0.5;
        }
        for (old, new) in self.lambda.iter_mut().zip(lambda) {
            *old += share * (new - *old);
        }
        let is_still = size <= 1e-14 * extent || (self.residual <= BALANCED && off <= 1e-15 * extent * extent);
        // Balanced, but on a saddle: a push is all it needs.
        if is_still && self.shift > 1e-6 * stiffest && self.pushes < MOST_PUSHES {
            nudge(&mut self.x, &self.is_free, PUSH);
            self.pushes += 1;
            return;
        }
        self.is_done = (is_still && self.shift == 0.0) || (share <= 1e-8 && self.shift >= 1e3 * stiffest);
        self.shift = match share {
            1.0 if self.shift > 1e-6 * stiffest => 0.1 * self.shift,
            1.0 => 0.0,
            _ => (4.0 * self.shift).max(1e-4 * stiffest),
        };
    }
}
