//! Back to the lengths of rigid bonds: projection of positions and of velocities, weighted by mass.

use super::{Direct, Held, MOST_SOLVES, enough, least_pivot, tolerance};
use crate::sim::contact::Contacts;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{accumulate, add, dot, scale, sub, zero};

impl<S: Real, const D: usize> Direct<S, D> {
    /// Puts bonds back to their lengths, then takes from velocities what would change them.
    pub(crate) fn project_all(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        let held = self.project(points, contacts);
        self.project_velocity(points, contacts);
        held
    }

    /// The same where bonds are off by little, as after a step of high order: one solve for both.
    pub(crate) fn restore(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        if !self.has_limits && self.legs.is_empty() && contacts.is_idle() && self.nudge(points) {
            return Held { iterations: 1, is_held: true };
        }
        self.project_all(points, contacts)
    }

    /// One round of Newton's method for lengths and rates together, where that is enough: the error that it leaves is
    /// about the square of the one before. Returns whether it is.
    fn nudge(&mut self, points: &mut Points<S, D>) -> bool {
        let (x, v) = (&points.position, &points.velocity);
        let mut largest = S::ZERO;
        for (k, row) in self.rows.iter().enumerate() {
            let (i, j) = (row.a as usize, row.b as usize);
            let d = sub(x[i], x[j]);
            let square = dot(d, d);
            self.aims[k] = d;
            self.diagonal[k] = (row.w_a + row.w_b) * square;
            let error = S::HALF * (square - row.rest_length * row.rest_length);
            self.both[k] = [-error, -dot(d, sub(v[i], v[j]))];
            let relative = error.abs() * row.inverse_square;
            largest = if relative <= largest { largest } else { relative };
        }
        let is_near = largest * largest <= tolerance();
        if !is_near {
            return false;
        }
        self.fill_lower();
        self.ldl.factor_and_solve(&self.diagonal, &self.lower, least_pivot(), &mut self.both);
        let Points { position, position_lost, velocity, velocity_lost, .. } = points;
        for ((&[shift, kick], row), &aim) in self.both.iter().zip(&self.rows).zip(&self.aims) {
            for (point, weight) in [(row.a as usize, row.w_a), (row.b as usize, -row.w_b)] {
                if weight != S::ZERO {
                    accumulate(&mut position[point], &mut position_lost[point], scale(aim, shift * weight));
                    accumulate(&mut velocity[point], &mut velocity_lost[point], scale(aim, kick * weight));
                }
            }
        }
        true
    }

    /// Puts bonds back to their lengths, along their directions where the step ended.
    ///
    /// Newton's method with the matrix of its first round, made anew when that converges slowly; with a shifted matrix
    /// (least squares) where bonds contradict each other.
    pub(crate) fn project(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        let mut before = S::INFINITY;
        self.start.clone_from(&points.position);
        self.make_ready(points, contacts);
        for iterations in 0..MOST_SOLVES {
            let error = self.residual(|row| sub(points.position[row.a as usize], points.position[row.b as usize]));
            if error <= tolerance() {
                return Held { iterations, is_held: true };
            }
            if !error.is_finite() || (iterations > 4 && error > before) {
                break;
            }
            if iterations > 2 && error <= enough() && error > S::HALF * before {
                return Held { iterations, is_held: true };
            }
            if iterations > 0 && error > S::from_f64(0.1) * before {
                self.aim(&points.position);
                self.factor(contacts);
            }
            before = error;
            self.ldl.solve_one(&mut self.lambda);
            self.shift(contacts, |i, way| accumulate(&mut points.position[i], &mut points.position_lost[i], way));
        }
        let error = self.residual(|row| sub(points.position[row.a as usize], points.position[row.b as usize]));
        if error <= enough() {
            return Held { iterations: MOST_SOLVES, is_held: true };
        }
        points.position.copy_from_slice(&self.start);
        self.draw_near(points, contacts);
        Held { iterations: 2 * MOST_SOLVES, is_held: false }
    }

    /// Brings bonds that cannot all hold as near to their lengths as they get: a matrix with a larger diagonal makes
    /// every round a short step towards least squares, and never one into the distance.
    fn draw_near(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) {
        for _ in 0..MOST_SOLVES {
            self.aim(&points.position);
            self.fill(contacts);
            for diagonal in &mut self.diagonal {
                *diagonal *= S::from_f64(1.5);
            }
            self.eliminate();
            self.residual(|row| sub(points.position[row.a as usize], points.position[row.b as usize]));
            self.ldl.solve_one(&mut self.lambda);
            self.shift(contacts, |i, way| accumulate(&mut points.position[i], &mut points.position_lost[i], way));
        }
    }

    /// Takes from velocities what would lengthen or shorten a bond: d . (v_a - v_b) = 0, weighted by mass.
    ///
    /// Rows are aimed and factored before. A bond with a limit holds velocities one way only, unless events
    /// decide whether it acts.
    pub(crate) fn project_velocity(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) {
        self.total.fill(S::ZERO);
        for _ in 0..2 {
            let velocity = &points.velocity;
            for (lambda, (row, aim)) in self.lambda.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
                let rate = dot(*aim, sub(velocity[row.a as usize], velocity[row.b as usize]));
                let parts = !self.chooses || row.limit.acts(rate, S::ZERO);
                *lambda = if row.is_taut && parts { -rate } else { S::ZERO };
            }
            self.area_rates(&points.velocity);
            self.ldl.solve_one(&mut self.lambda);
            for (total, lambda) in self.total.iter_mut().zip(&self.lambda) {
                *total += *lambda;
            }
            self.shift(contacts, |i, way| accumulate(&mut points.velocity[i], &mut points.velocity_lost[i], way));
        }
    }

    /// As [`Direct::project_velocity`], for velocities that are only a look ahead.
    pub(crate) fn project_ahead(&mut self, v: &mut [[S; D]], contacts: &Contacts<S, D>) {
        for (lambda, (row, aim)) in self.lambda.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
            let rate = dot(*aim, sub(v[row.a as usize], v[row.b as usize]));
            *lambda = if row.is_taut { -rate } else { S::ZERO };
        }
        self.area_rates(v);
        self.ldl.solve_one(&mut self.lambda);
        self.shift(contacts, |i, way| v[i] = add(v[i], way));
    }

    /// The change of a point's velocity by the last projection of velocities, surfaces left aside `[m/s]`.
    pub(crate) fn push_on(&self, point: usize) -> [S; D] {
        let mut sum = zero();
        for ((&lambda, row), &aim) in self.total.iter().zip(&self.rows).zip(&self.aims) {
            if row.a as usize == point {
                sum = add(sum, scale(aim, lambda * row.w_a));
            } else if row.b as usize == point {
                sum = sub(sum, scale(aim, lambda * row.w_b));
            }
        }
        for (_, way) in self.leg_shifts(&self.total).filter(|(at, _)| *at as usize == point) {
            sum = add(sum, way);
        }
        sum
    }
}
