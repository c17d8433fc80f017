//! What rigid bonds answer to forces: accelerations with Lagrange's multipliers (index 1).

use super::super::shape::Row;
use super::{Direct, least_pivot};
use crate::sim::contact::Contacts;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Pivots below this share of their diagonal, in roundings, are of bonds that repeat others, where their forces are asked for.
const REPEATED: f64 = 1e5;

impl<S: Real, const D: usize> Direct<S, D> {
    /// Adds to accelerations what the bonds answer where the points are now.
    pub(crate) fn answer(&mut self, x: &[[S; D]], v: &[[S; D]], a: &mut [[S; D]], contacts: &Contacts<S, D>) {
        if self.has_limits || !contacts.is_idle() || !self.legs.is_empty() {
            self.aim(x);
            self.factor(contacts);
            return self.multiply(v, a, contacts);
        }
        for (k, row) in self.rows.iter().enumerate() {
            let (i, j) = (row.a as usize, row.b as usize);
            let (d, closing, apart) = (sub(x[i], x[j]), sub(v[i], v[j]), sub(a[i], a[j]));
            self.aims[k] = d;
            self.diagonal[k] = (row.w_a + row.w_b) * dot(d, d);
            self.lambda[k] = -(dot(d, apart) + dot(closing, closing));
        }
        self.fill_lower();
        let lambda = self.lambda.as_chunks_mut::<1>().0;
        self.ldl.factor_and_solve(&self.diagonal, &self.lower, least_pivot(), lambda);
        self.push(a);
    }

    /// Adds to accelerations what the bonds answer: d . (a_a - a_b) + |v_a - v_b|^2 = 0 for what points can follow.
    ///
    /// Rows are aimed and factored before.
    pub(crate) fn multiply(&mut self, v: &[[S; D]], a: &mut [[S; D]], contacts: &Contacts<S, D>) {
        let idle = contacts.is_idle();
        for (lambda, (row, aim)) in self.lambda.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
            let (i, j) = (row.a as usize, row.b as usize);
            let closing = sub(v[i], v[j]);
            let apart = if idle { sub(a[i], a[j]) } else { sub(contacts.free(i, a[i]), contacts.free(j, a[j])) };
            *lambda = if row.is_taut { -(dot(*aim, apart) + dot(closing, closing)) } else { S::ZERO };
        }
        self.area_bends(v, a, contacts);
        self.ldl.solve_one(&mut self.lambda);
        self.push(a);
    }

    /// By what force the bond between two points pulls them together `[N]`, where all others give these accelerations; `None` where there
    /// is none, or where bonds repeat each other, so that their forces are not one answer.
    pub(crate) fn bond_force(
        &mut self,
        ends: [u32; 2],
        (x, v): (&[[S; D]], &[[S; D]]),
        a: &mut [[S; D]],
        contacts: &Contacts<S, D>,
    ) -> Option<f64> {
        self.aim(x);
        self.fill(contacts);
        let inertia = self.ldl.factor(&self.diagonal, &self.lower, S::EPSILON * S::from_f64(REPEATED));
        if inertia.skipped > 0 {
            return None;
        }
        self.multiply(v, a, contacts);
        let place = self.rows.iter().position(|row| [row.a, row.b] == ends || [row.b, row.a] == ends)?;
        let pull = -self.lambda[place].to_f64() * dot(self.aims[place], self.aims[place]).to_f64().sqrt();
        pull.is_finite().then_some(pull)
    }

    /// Adds W G^T lambda to accelerations.
    #[inline(always)]
    fn push(&self, a: &mut [[S; D]]) {
        for ((&lambda, row), &aim) in self.lambda.iter().zip(&self.rows).zip(&self.aims) {
            let (i, j) = (row.a as usize, row.b as usize);
            a[i] = add(a[i], scale(aim, lambda * row.w_a));
            a[j] = sub(a[j], scale(aim, lambda * row.w_b));
        }
        for (point, way) in self.leg_shifts(&self.lambda) {
            a[point as usize] = add(a[point as usize], way);
        }
    }

    /// Bound on the square of the fastest oscillation that the tension of the bonds makes `[rad^2/s^2]`, by the last
    /// multipliers.
    ///
    /// A bond under the force lambda d is across as stiff as |lambda|: omega^2 <= max of 2 |lambda| (w_a + w_b), as of a
    /// taut string. Explicit methods are unstable beyond their limit of omega h, though every bond keeps its length.
    pub(crate) fn frequency_square(&self) -> S {
        let square = |(lambda, row): (&S, &Row<S>)| lambda.abs() * (row.w_a + row.w_b);
        let most = self.lambda.iter().zip(&self.rows).map(square).fold(S::ZERO, S::max);
        most + most
    }
}
