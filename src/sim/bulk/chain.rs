//! A chain: one long path.

use super::form::{Form, Run};
use super::spec::{Spec, Substep};
use crate::sim::bond::BondKind;
use crate::sim::kernels::cells::Cells;
use crate::sim::kernels::split::{PIECES, Split};
use crate::sim::kernels::store::Store;
use crate::sim::real::Real;

/// A chain of bonds of one kind, each with its own rest length.
#[derive(Clone, Debug)]
pub(crate) struct Chain<S> {
    spec: Spec,
    path: Split<S>,
    /// Rest lengths along the chain `[m]`.
    rests: Vec<S>,
}

impl<S: Real> Chain<S> {
    /// A chain of bonds like `spec` with these rest lengths `[m]`, each > 0.
    pub(crate) fn new(spec: Spec, rests: &[f64]) -> Self {
        let rests: Vec<S> = rests.iter().map(|&rest| S::from_f64(rest)).collect();
        Chain { spec, path: Split::new(&rests), rests }
    }
}

impl<S: Real, const D: usize> Form<S, D> for Chain<S> {
    type Store = Cells<S, D>;

    fn cells(&self) -> usize {
        self.path.cells()
    }

    #[inline(always)]
    fn runs(&self, visit: impl FnMut(Run)) {
        self.path
            .pieces()
            .map(|(point, cell, count)| Run { point, point_step: 1, cell, cell_step: PIECES, count })
            .for_each(visit);
    }

    fn weigh(&mut self, _: &mut Cells<S, D>) {}

    fn sweep(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        self.path.solve(cells, &self.spec.path(step));
    }

    fn solve(&mut self, cells: &mut Cells<S, D>, step: &Substep) -> S {
        self.path.solve(cells, &self.spec.path(step))
    }

    fn stretch(&self, cells: &mut Cells<S, D>) -> S {
        let mut most = S::ZERO;
        if self.spec.kind != BondKind::Rigid {
            return most;
        }
        for (i, &rest) in self.rests.iter().enumerate() {
            let ((xa, da), (xb, db)) = (cells.get(self.path.at(i)), cells.get(self.path.at(i + 1)));
            let mut square = S::ZERO;
            for k in 0..D {
                let e = (xa[k] - xb[k]) + (da[k] - db[k]);
                square += e * e;
            }
            let off = (square / (rest * rest) - S::ONE).abs();
            most = if off <= most { most } else { off };
        }
        most
    }

    fn heap_bytes(&self) -> usize {
        self.rests.capacity() * size_of::<S>() + self.path.heap_bytes()
    }

    fn bonds(&self) -> usize {
        self.rests.len()
    }
}
