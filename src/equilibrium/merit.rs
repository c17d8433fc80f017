//! What a step has to lower: energy, and what holds add to it (an augmented Lagrangian).

use super::descent::Descent;
use super::friction::Rub;
use super::hold::Hold;
use super::part::{extent, grain};
use crate::sim::bond::Limit;
use crate::sim::measure;
use crate::sim::vector::{add, dot, sub};

impl<const D: usize> Descent<D> {
    /// Energy of springs, angles, areas and gravity, and that of forces as they are in this round `[J]`.
    pub(super) fn energy(&self, x: &[[f64; D]]) -> f64 {
        let part = &self.part;
        let lift = |i: usize| match part.is_free[i] {
            true => -part.mass[i] * dot(part.gravity, x[i]) - dot(add(part.pushes[i], self.twist[i]), x[i]),
            false => 0.0,
        };
        measure::springs_energy(&part.bonds, |i| x[i]) + part.form.energy(x) + (0..x.len()).map(lift).sum::<f64>()
    }

    /// Energy and what holds add to it: lambda C + C^2/2e, whose least value along the step is where the system leads to.
    /// A hold that acts one way adds no more where it would have to act the other way. Friction adds its work since the last
    /// round.
    pub(super) fn merit(&self, x: &[[f64; D]]) -> f64 {
        let of = |hold: &Hold| {
            let (grip, off) = (hold.grip_by(self.scale), hold.off(&self.part.surfaces, x).value);
            if hold.limit == Limit::Both || hold.can_have(hold.lambda + grip * off) {
                (hold.lambda + 0.5 * grip * off) * off
            } else {
                -0.5 * hold.lambda * hold.lambda / grip
            }
        };
        let rub = |rub: &Rub<D>| rub.work(sub(x[rub.point], self.x[rub.point]), self.scale);
        self.energy(x) + self.holds.iter().map(of).sum::<f64>() + self.rubs.iter().map(rub).sum::<f64>()
    }

    /// The violation of every hold `[m]`.
    pub(super) fn violations(&self, x: &[[f64; D]]) -> impl Iterator<Item = f64> {
        self.holds.iter().map(|hold| {
            let off = hold.off(&self.part.surfaces, x);
            hold.violation(off.value) / off.per_metre
        })
    }

    /// The largest violation of any hold `[m]`.
    pub(super) fn violation(&self, x: &[[f64; D]]) -> f64 {
        self.violations(x).fold(0.0, f64::max)
    }

    /// What rounding makes of differences of the merit `[J]`.
    pub(super) fn haze(&self, merit: f64) -> f64 {
        let held: f64 = self.holds.iter().map(|hold| hold.tension(hold.lambda)).sum();
        1e-13 * (merit.abs() + self.part.weight() * extent(&self.x)) + held * grain(&self.x)
    }
}
