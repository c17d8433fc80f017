//! The system that a round solves: its pattern, the matrix with the shift, and its solution.

use super::descent::Descent;
use super::hold::{Grip, Hold};
use super::part::Part;
use crate::sim::contact::surface::Surface;
use crate::sim::force::form::Block;
use crate::sim::solve::blocks::Blocks;
use crate::sim::vector::{length, scale, sub};

/// Stiffness of holds, in those of the stiffest spring or tension: a round leaves the inverse of it of an error in the
/// multipliers. More of it drowns soft directions in rounding.
pub(super) const GRIP: f64 = 1e4;
/// Shift that is no more than rounding, in the same measure: a direction that is not stiffer than this is neutral, and
/// one that falls away less steeply counts as level.
pub(super) const NEUTRAL: f64 = 1e-9;
/// The next shift after that.
pub(super) const FIRST: f64 = 1e-6;
/// Share of its diagonal below which a pivot counts as none.
const LEAST_PIVOT: f64 = 4.0 * f64::EPSILON;
/// Times that the shift is raised in one round: the last is beyond any stiffness.
const MOST_SHIFTS: u32 = 14;

/// What a round comes to.
pub(super) struct Step<const D: usize> {
    /// How far every point goes `[m]`.
    pub(super) displacement: Vec<[f64; D]>,
    /// The multipliers at its end, one a hold.
    pub(super) lambda: Vec<f64>,
    /// What friction takes at its end `[N]`, one entry a point and rough surface.
    pub(super) rubs: Vec<[f64; D]>,
}

/// The pattern: every bond couples its ends, whether it is taut or not.
pub(super) fn pattern<const D: usize>(part: &Part<D>) -> Blocks<f64, D> {
    let mut pairs: Vec<[u32; 2]> = part.springs.iter().map(|spring| [spring.a, spring.b]).collect();
    pairs.extend(part.holds.iter().filter_map(|hold| match hold.grip {
        Grip::Bond { a, b, .. } => Some([a as u32, b as u32]),
        Grip::Surface { .. } => None,
    }));
    pairs.extend(part.form.pairs());
    Blocks::new(&part.is_free, &pairs, &[])
}

impl<const D: usize> Descent<D> {
    /// Factors the matrix with the least shift, from the present one up, that makes it positive.
    pub(super) fn factor(&mut self) {
        let scale = self.scale;
        for _ in 0..MOST_SHIFTS {
            self.fill();
            let inertia = self.system.factor_down_to(LEAST_PIVOT);
            if inertia.negative + inertia.skipped == 0 {
                return;
            }
            self.shift = match self.shift {
                0.0 => NEUTRAL * scale,
                shift => (10.0 * shift).max(FIRST * scale),
            };
        }
    }

    /// The matrix: H + shift + G^T G/e.
    fn fill(&mut self) {
        let Descent { part, x, holds, rubs, system, shift, scale: firm, .. } = self;
        system.clear();
        system.shift(*shift);
        let mut couple = |pair: usize, [a, b]: [usize; 2], block: [[f64; D]; D]| {
            system.add_own(a, &block);
            system.add_own(b, &block);
            system.add_pair(pair, &block.map(|row| scale(row, -1.0)));
        };
        for (pair, spring) in part.springs.iter().enumerate() {
            let (a, b) = (spring.a as usize, spring.b as usize);
            let d = sub(x[a], x[b]);
            couple(pair, [a, b], spring.stiffness_block((d, length(d)), 0.0, false));
        }
        let bonds = holds.iter().filter(|hold| matches!(hold.grip, Grip::Bond { .. }));
        for (k, hold) in bonds.enumerate().filter(|(_, hold)| hold.is_active) {
            if let Grip::Bond { a, b, .. } = hold.grip {
                couple(part.springs.len() + k, [a, b], hold.block(&part.surfaces, x, *firm));
            }
        }
        let first = part.springs.len() + holds.iter().filter(|hold| matches!(hold.grip, Grip::Bond { .. })).count();
        part.form.stiffen((x, 0.0, false), |place, block| match place {
            Block::Own(point) => system.add_own(point, &block),
            Block::Pair(pair) => system.add_block(first + pair, &block),
        });
        for hold in holds.iter().filter(|hold| hold.is_active) {
            if let Grip::Surface { point, .. } = hold.grip {
                system.add_own(point, &hold.block(&part.surfaces, x, *firm));
            }
        }
        for rub in rubs.iter() {
            system.add_own(rub.point, &rub.block(*firm));
        }
    }

    /// Where points go under a force, by the matrix as it was last factored.
    pub(super) fn solve(&mut self, mut force: Vec<[f64; D]>) -> Vec<[f64; D]> {
        self.system.solve(&mut force, &mut [], &mut self.work);
        force
    }

    /// The step to where forces balance and holds are kept, by the matrix as it was last factored.
    pub(super) fn newton_step(&mut self, force: Vec<[f64; D]>) -> Step<D> {
        let pulls = self.pulls(&self.x);
        let before: Vec<[f64; D]> = self.rubs.iter().map(|rub| rub.force).collect();
        let displacement = self.solve(self.rubbed(self.left(force, &pulls, &self.x), &before));
        let surfaces = &self.part.surfaces;
        let more = |(hold, pull): (&Hold, f64)| match hold.is_active {
            true => pull + hold.grip_by(self.scale) * hold.off(surfaces, &self.x).change(hold.grip, &displacement),
            false => 0.0,
        };
        let lambda = self.holds.iter().zip(pulls).map(more).collect();
        let rubs = self.rubs.iter().map(|rub| rub.force_after(displacement[rub.point], self.scale)).collect();
        Step { displacement, lambda, rubs }
    }

    /// lambda + C/e of every hold, 0 where it is not active.
    pub(super) fn pulls(&self, x: &[[f64; D]]) -> Vec<f64> {
        let pull = |hold: &Hold| match hold.is_active {
            true => hold.lambda + hold.grip_by(self.scale) * hold.off(&self.part.surfaces, x).value,
            false => 0.0,
        };
        self.holds.iter().map(pull).collect()
    }
}

impl Hold {
    /// 1/e [N/m^3 for bonds, N/m for surfaces].
    pub(super) fn grip_by(&self, scale: f64) -> f64 {
        match self.grip {
            Grip::Bond { rest, .. } => GRIP * self.firmness * scale.max(self.lambda.abs()) / (rest * rest),
            Grip::Surface { .. } => GRIP * self.firmness * scale,
        }
    }

    /// Its block of the matrix `[N/m]`: curvature by its multiplier, and its grip.
    fn block<const D: usize>(&self, surfaces: &[Surface<f64, D>], x: &[[f64; D]], firm: f64) -> [[f64; D]; D] {
        let gradient = self.off(surfaces, x).gradient;
        let mut block = gradient.map(|g| scale(gradient, self.grip_by(firm) * g));
        if let Grip::Bond { .. } = self.grip {
            for (k, row) in block.iter_mut().enumerate() {
                row[k] += self.lambda;
            }
        }
        block
    }
}
