//! Rigid bonds that act on one side only: strings and struts that may part.

use super::{Direct, tolerance};
use crate::sim::bond::Limit;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, sub};

impl<S: Real, const D: usize> Direct<S, D> {
    /// Bonds with a limit that do not act take no part.
    pub(super) fn leave_slack_out(&mut self) {
        for (diagonal, row) in self.diagonal.iter_mut().zip(&self.rows) {
            if !row.is_taut {
                *diagonal = S::ONE;
            }
        }
        for (lower, coupling) in self.lower.iter_mut().zip(&self.couplings) {
            if !self.rows[coupling.row as usize].is_taut || !self.rows[coupling.column as usize].is_taut {
                *lower = S::ZERO;
            }
        }
    }

    /// Slack bonds that the displacements make too long (or too short) act from now on. Returns whether there are any.
    pub(super) fn take_in(&mut self, points: &Points<S, D>) -> bool {
        let mut any = false;
        for row in self.rows.iter_mut().filter(|row| !row.is_taut) {
            let (i, j) = (row.a as usize, row.b as usize);
            let (x, way) = (&points.position, &points.displacement);
            let d = add(sub(x[i], x[j]), sub(way[i], way[j]));
            let over = (dot(d, d) - row.rest_length * row.rest_length) * row.inverse_square;
            row.is_taut = row.limit.acts(over, tolerance::<S>() * S::from_f64(16.0));
            any |= row.is_taut;
        }
        any
    }

    /// Lets go of bonds with a limit whose last multiplier would push where they pull, or pull where they push.
    ///
    /// Returns whether there were any: then everything has to be solved again.
    pub(crate) fn slacken(&mut self) -> bool {
        if !self.chooses {
            return false;
        }
        let mut any = false;
        for (row, &lambda) in self.rows.iter_mut().zip(&self.lambda) {
            // The force on end a is lambda d: below 0 the bond pulls.
            let wrong = row.limit != Limit::Both && row.limit.acts(lambda, S::ZERO);
            any |= wrong && row.is_taut;
            row.is_taut &= !wrong;
        }
        any
    }

    /// Decides which bonds with a limit act: those that are at their rest length or beyond it, and do not come back from
    /// there by themselves.
    pub(crate) fn tighten(&mut self, x: &[[S; D]], v: &[[S; D]]) {
        if !self.chooses {
            return;
        }
        let slow = S::from_f64(1e-9).max(S::EPSILON * S::from_f64(64.0));
        for row in &mut self.rows {
            let (a, b) = (row.a as usize, row.b as usize);
            let d = sub(x[a], x[b]);
            let rate = dot(d, sub(v[a], v[b])) * row.inverse_square;
            let rest = row.rest_length * row.rest_length;
            let over = (dot(d, d) - rest) * row.inverse_square;
            let is_near = row.limit.acts(over, -tolerance::<S>() * S::from_f64(16.0));
            row.is_taut = row.limit.acts(over, tolerance()) || (is_near && row.limit.acts(rate, -slow));
        }
    }
}
