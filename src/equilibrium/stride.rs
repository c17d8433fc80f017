//! Going along a step as far as that lowers the merit.

use super::descent::{Descent, REACH};
use super::hold::Hold;
use super::part::extent;
use super::system::{FIRST, NEUTRAL, Step};
use crate::sim::vector::{add, dot, length, scale, sub};

/// Times that a step is bent: bonds turn, and a straight step stretches what turns.
const MOST_BENDS: u32 = 3;
/// Share of a step below which it is given up.
const LEAST_SHARE: f64 = 1e-8;

impl<const D: usize> Descent<D> {
    /// Goes along a step, shortened until it lowers the merit, and follows the multipliers as far. Returns whether
    /// the whole step was.
    pub(super) fn stride(&mut self, step: &Step<D>) -> bool {
        let size = step.displacement.iter().map(|s| length(*s)).fold(0.0, f64::max);
        let cut = if size > self.reach { self.reach / size } else { 1.0 };
        let mut share = 1.0;
        while share > LEAST_SHARE && !self.goes(step, share * cut) {
            share *= 0.5;
        }
        for (hold, new) in self.holds.iter_mut().zip(&step.lambda).filter(|(hold, _)| hold.is_active) {
            hold.lambda += share * (new - hold.lambda);
        }
        for (rub, &new) in self.rubs.iter_mut().zip(&step.rubs) {
            rub.force = add(rub.force, scale(sub(new, rub.force), share));
        }
        // A slope that goes on is followed with longer and longer steps.
        self.reach = if cut < 1.0 && share == 1.0 { 2.0 * self.reach } else { REACH * extent(&self.x) };
        if share <= LEAST_SHARE && self.shift >= 1e3 * self.scale {
            self.give_up();
        }
        self.shift = match share {
            1.0 if self.shift > 10.0 * NEUTRAL * self.scale => 0.1 * self.shift,
            1.0 => 0.0,
            _ => (4.0 * self.shift).max(FIRST * self.scale),
        };
        share * cut == 1.0
    }

    /// Takes a share of a step if that lowers the merit, bent where it has to be.
    fn goes(&mut self, step: &Step<D>, share: f64) -> bool {
        let before = self.merit(&self.x);
        let most = before + self.haze(before);
        let mut x: Vec<[f64; D]> =
            self.x.iter().zip(&step.displacement).map(|(&x, &s)| add(x, scale(s, share))).collect();
        for bends in 0..=MOST_BENDS {
            if self.merit(&x) <= most {
                self.x = x;
                return true;
            }
            if bends < MOST_BENDS {
                self.project_displacements(&mut x, step, share);
            }
        }
        false
    }

    /// Moves points from where a straight step led to where bonds have the lengths that it was to bring: along the
    /// directions that they had before it, so that nothing turns once more.
    fn project_displacements(&mut self, x: &mut [[f64; D]], step: &Step<D>, share: f64) {
        let mut force = vec![[0.0; D]; x.len()];
        for spring in self.part.springs.iter().filter(|spring| spring.rest_length > 0.0) {
            let (a, b) = (spring.a as usize, spring.b as usize);
            let (before, after) = (sub(self.x[a], self.x[b]), sub(x[a], x[b]));
            let long = length(before);
            if long > 0.0 && !spring.is_slack(long) {
                let along = dot(before, sub(step.displacement[a], step.displacement[b])) / long;
                let excess = length(after) - long - share * along;
                let pull = scale(before, spring.stiffness * excess / long);
                force[a] = sub(force[a], pull);
                force[b] = add(force[b], pull);
            }
        }
        let excess = |hold: &Hold| {
            let (before, after) = (hold.off(&self.part.surfaces, &self.x), hold.off(&self.part.surfaces, x));
            let excess = after.value - before.value - share * before.change(hold.grip, &step.displacement);
            if hold.is_active { hold.grip_by(self.scale) * excess } else { 0.0 }
        };
        let pulls: Vec<f64> = self.holds.iter().map(excess).collect();
        let corrections = self.solve(self.left(force, &pulls, &self.x));
        x.iter_mut().zip(corrections).for_each(|(x, correction)| *x = add(*x, correction));
    }
}

/// The largest displacement of any point `[m]`.
pub(super) fn largest_displacement<const D: usize>(from: &[[f64; D]], to: &[[f64; D]]) -> f64 {
    from.iter().zip(to).map(|(&a, &b)| length(sub(a, b))).fold(0.0, f64::max)
}
