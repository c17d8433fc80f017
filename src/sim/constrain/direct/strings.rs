//! Rigid bonds with a limit where events decide which of them act: a bond that acts is held both ways until it is let go.

use super::Direct;
use crate::sim::bond::Limit;
use crate::sim::constrain::shape::Row;
use crate::sim::real::Real;
use crate::sim::vector::length;

/// Share of the largest impulse below which one that pushes may be rounding.
const FAINT: f64 = 1e-9;

impl<S: Real, const D: usize> Direct<S, D> {
    /// From now on solves leave open which bonds with a limit act.
    pub(crate) fn leave_limits_to_events(&mut self) {
        self.chooses = false;
    }

    /// Whether solves decide which bonds with a limit act.
    pub(crate) fn chooses_itself(&self) -> bool {
        self.chooses
    }

    /// Bonds with a limit and a length, by their rows.
    pub(crate) fn strings(&self) -> impl Iterator<Item = (usize, &Row<S>)> {
        let is_string = |row: &Row<S>| row.limit != Limit::Both && row.rest_length > S::ZERO;
        self.rows.iter().enumerate().filter(move |(_, row)| is_string(row))
    }

    /// Whether a bond acts.
    pub(crate) fn is_taut(&self, row: usize) -> bool {
        self.rows[row].is_taut
    }

    /// A bond acts from now on, or no longer.
    pub(crate) fn set_taut(&mut self, row: usize, is_taut: bool) {
        self.rows[row].is_taut = is_taut;
    }

    /// How strongly a bond answers the way it may `[m/s^2]`, by the last multipliers: below 0 a string would push.
    pub(crate) fn grip(&self, row: usize) -> S {
        self.tension(row, self.lambda[row])
    }

    /// The acting bond with a limit whose part in the last projection of velocities was most against its kind, and how
    /// much that was `[m/s]`, below 0; `None` if all did what they may.
    pub(crate) fn most_wrong(&self) -> Option<(S, usize)> {
        if self.chooses {
            return None;
        }
        let blow = |row: usize| self.tension(row, self.total[row]);
        let largest = (0..self.rows.len()).map(|row| blow(row).abs()).fold(S::ZERO, S::max);
        let faint = (largest * S::from_f64(FAINT)).max(S::EPSILON * S::from_f64(4096.0));
        let mut worst = (-faint, None);
        for (row, _) in self.strings().filter(|(_, row)| row.is_taut) {
            worst = if blow(row) < worst.0 { (blow(row), Some(row)) } else { worst };
        }
        worst.1.map(|row| (worst.0, row))
    }

    fn tension(&self, row: usize, lambda: S) -> S {
        let Row { w_a, w_b, limit, .. } = self.rows[row];
        let size = lambda * length(self.aims[row]) * (w_a + w_b);
        // The force on end a is lambda d: below 0 the bond pulls.
        if limit == Limit::Max { -size } else { size }
    }
}
