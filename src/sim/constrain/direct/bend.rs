//! Displacements that keep the lengths of rigid bonds: SHAKE with a direct solve.

use super::{Direct, Held, MOST_SOLVES, enough, tolerance};
use crate::sim::contact::Contacts;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, sub};

/// Times that bonds with a limit are let go or taken in within a substep.
const MOST_CHANGES: u32 = 16;

impl<S: Real, const D: usize> Direct<S, D> {
    /// Bends the displacements of a substep along the directions at its start until bonds keep their lengths (SHAKE).
    ///
    /// Rows are aimed and factored at the start of the substep. Source: J.-P. Ryckaert, G. Ciccotti,
    /// H. J. C. Berendsen, J. Comput. Phys. 23, 327 (1977); all bonds at once in place of one after the other.
    ///
    /// Bonds with a limit that would have to push are let go, those that became too long are taken in, and all begins
    /// again.
    pub(crate) fn bend(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        if !self.chooses {
            return self.bend_taut(points, contacts);
        }
        let free = points.displacement.clone();
        let mut held = self.bend_taut(points, contacts);
        for _ in 0..MOST_CHANGES {
            self.lambda.copy_from_slice(&self.total);
            if !self.slacken() && !self.take_in(points) {
                break;
            }
            points.displacement.copy_from_slice(&free);
            self.factor(contacts);
            let again = self.bend_taut(points, contacts);
            held = Held { iterations: held.iterations + again.iterations, ..again };
        }
        held
    }

    fn bend_taut(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        self.total.fill(S::ZERO);
        let Points { position, displacement, .. } = points;
        let mut before = S::INFINITY;
        for iterations in 0..MOST_SOLVES {
            let error = self.residual(|row| {
                let (i, j) = (row.a as usize, row.b as usize);
                add(sub(position[i], position[j]), sub(displacement[i], displacement[j]))
            });
            if error <= tolerance() || (error <= enough() && error > S::HALF * before) {
                return Held { iterations, is_held: true };
            }
            if !error.is_finite() || (iterations > 3 && error > before) {
                return Held { iterations, is_held: false };
            }
            before = error;
            self.ldl.solve_one(&mut self.lambda);
            for (total, lambda) in self.total.iter_mut().zip(&self.lambda) {
                *total += *lambda;
            }
            self.shift(contacts, |i, way| displacement[i] = add(displacement[i], way));
        }
        Held { iterations: MOST_SOLVES, is_held: false }
    }
}
