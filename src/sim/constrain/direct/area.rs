//! Rows that hold the areas of triangles: A = A0, beside bonds.
//!
//! With corners p, q, r the area is half the cross product of x_q - x_p and x_r - x_p. Its slopes add up to none, so that a row is made of
//! two legs as a bond has one: from p to q along the slope by q, and from p to r along that by r.

use super::Direct;
use crate::sim::constrain::shape::{Leg, Row};
use crate::sim::contact::Contacts;
use crate::sim::force::area::slopes;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

impl<S: Real, const D: usize> Direct<S, D> {
    /// Whether it holds areas.
    pub(crate) fn holds_areas(&self) -> bool {
        !self.legs.is_empty()
    }

    /// Points both legs along the slopes of the areas as the corners lie now.
    pub(super) fn aim_legs(&mut self, x: &[[S; D]]) {
        for (leg, second) in self.legs.iter().zip(&mut self.leg_aims) {
            let row = &self.rows[leg.row as usize];
            let [_, by_q, by_r] = slopes([x[row.b as usize], x[row.a as usize], x[leg.c as usize]]);
            self.aims[leg.row as usize] = wide(by_q);
            *second = wide(by_r);
        }
    }

    /// What second legs add to the matrix.
    pub(super) fn fill_legs(&mut self, contacts: &Contacts<S, D>) {
        let free = |point: u32, aim: [S; D]| dot(aim, contacts.free(point as usize, aim));
        for (leg, &second) in self.legs.iter().zip(&self.leg_aims) {
            let Row { a, b, w_a, w_b, .. } = self.rows[leg.row as usize];
            let first = self.aims[leg.row as usize];
            self.diagonal[leg.row as usize] =
                w_a * free(a, first) + leg.w_c * free(leg.c, second) + w_b * free(b, add(first, second));
        }
        for crossing in &self.crossings {
            let aim = |leg: u32| match self.leg_aims.get((leg as usize).wrapping_sub(self.rows.len())) {
                Some(aim) => *aim,
                None => self.aims[leg as usize],
            };
            let [d, e] = crossing.legs.map(aim);
            let mut sum = S::ZERO;
            for &(point, weight) in &crossing.shared {
                sum += weight * dot(d, contacts.free(point as usize, e));
            }
            self.lower[crossing.coupling as usize] += sum;
        }
    }

    /// lambda = -(A - A0) of every area, and the largest |error| relative to A0, or `largest` if that is more.
    pub(super) fn area_residual(&mut self, direction: impl Fn(&Row<S>) -> [S; D], mut largest: S) -> S {
        for leg in &self.legs {
            let row = self.rows[leg.row as usize];
            let (d, e) = (direction(&row), direction(&Row { a: leg.c, ..row }));
            let error = S::HALF * (d[0] * e[1] - d[1] * e[0]) - leg.area;
            self.lambda[leg.row as usize] = -error;
            let relative = error.abs() / leg.area;
            largest = if relative <= largest { largest } else { relative };
        }
        largest
    }

    /// The rate of the area of a row with a second leg `[m^2/s]`, or of what else these are rates of.
    fn rate(&self, k: usize, v: impl Fn(usize) -> [S; D]) -> S {
        let leg = &self.legs[k];
        let row = &self.rows[leg.row as usize];
        let from = v(row.b as usize);
        dot(self.aims[leg.row as usize], sub(v(row.a as usize), from))
            + dot(self.leg_aims[k], sub(v(leg.c as usize), from))
    }

    /// lambda = -A' of every area.
    pub(super) fn area_rates(&mut self, v: &[[S; D]]) {
        for k in 0..self.legs.len() {
            self.lambda[self.legs[k].row as usize] = -self.rate(k, |i| v[i]);
        }
    }

    /// lambda = -A'' of every area, by these accelerations `[m^2/s^2]`.
    pub(super) fn area_bends(&mut self, v: &[[S; D]], a: &[[S; D]], contacts: &Contacts<S, D>) {
        for k in 0..self.legs.len() {
            let Leg { row, c, .. } = self.legs[k];
            let Row { a: q, b: p, .. } = self.rows[row as usize];
            let [p, q, r] = [p, q, c].map(|point| v[point as usize]);
            let (d, e) = (sub(q, p), sub(r, p));
            let turning = d[0] * e[1] - d[1] * e[0];
            self.lambda[row as usize] = -(self.rate(k, |i| contacts.free(i, a[i])) + turning);
        }
    }

    /// What second legs add of W G^T lambda: a point and how far.
    pub(super) fn leg_shifts(&self, lambda: &[S]) -> impl Iterator<Item = (u32, [S; D])> {
        self.legs.iter().zip(&self.leg_aims).flat_map(move |(leg, &aim)| {
            let (lambda, row) = (lambda[leg.row as usize], &self.rows[leg.row as usize]);
            let ends = [(leg.c, leg.w_c), (row.b, -row.w_b)];
            ends.into_iter()
                .filter(|end| end.1 != S::ZERO)
                .map(move |(point, weight)| (point, scale(aim, lambda * weight)))
        })
    }
}

fn wide<S: Real, const D: usize>(slope: [S; 2]) -> [S; D] {
    std::array::from_fn(|k| if k < 2 { slope[k] } else { S::ZERO })
}
