//! The system that a round solves: its pattern, and the matrix with the shift.

use super::descent::Descent;
use super::hold::Hold;
use crate::sim::solve::blocks::Blocks;
use crate::sim::vector::{dot, scale, sub};

impl<const D: usize> Descent<D> {
    /// The pattern of the system, for the holds that there are now.
    pub(super) fn arrange(&mut self) {
        let mut pairs = self.pairs.clone();
        let mut ends = Vec::new();
        for hold in self.holds() {
            match hold {
                Hold::Bond { a, b, .. } => {
                    pairs.push([a as u32, b as u32]);
                    ends.push([a as u32, b as u32]);
                }
                // The other end of a surface's row is a point that is not in the system: any pinned or left-out one.
                Hold::Surface { point, .. } => ends.push([point as u32, self.nowhere()]),
            }
        }
        self.system = Blocks::new(&self.free(), &pairs, &ends);
        self.lambda.resize(ends.len(), 0.0);
    }

    /// Whether points are in the system, with one more that is not.
    pub(super) fn free(&self) -> Vec<bool> {
        self.is_free.iter().copied().chain([false]).collect()
    }

    pub(super) fn nowhere(&self) -> u32 {
        self.is_free.len() as u32
    }

    /// The matrix, with the shift.
    pub(super) fn fill(&self, system: &mut Blocks<f64, D>, holds: &[Hold], stiffest: f64) {
        system.clear();
        system.shift(self.shift + 1e-12 * stiffest);
        let mut couple = |pair: usize, [a, b]: [usize; 2], block: [[f64; D]; D]| {
            system.add_own(a, &block);
            system.add_own(b, &block);
            system.add_pair(pair, &block.map(|row| scale(row, -1.0)));
        };
        for (pair, spring) in self.springs.iter().enumerate() {
            let (a, b) = (spring.a as usize, spring.b as usize);
            couple(pair, [a, b], spring.stiffness_block(sub(self.x[a], self.x[b]), 0.0, false));
        }
        let mut pair = self.springs.len();
        for (c, &hold) in holds.iter().enumerate() {
            if let Hold::Bond { a, b, .. } = hold {
                let mut block = [[0.0; D]; D];
                for (k, row) in block.iter_mut().enumerate() {
                    row[k] = self.lambda[c];
                }
                couple(pair, [a, b], block);
                pair += 1;
            }
        }
        for (c, &hold) in holds.iter().enumerate() {
            let (_, direction) = self.off(hold, &self.x);
            system.set_line(c, direction, -1e-14 * dot(direction, direction) / stiffest.max(f64::MIN_POSITIVE));
        }
    }
}
