//! A crowd: equal small bodies.

use super::Way;
use super::form::{Form, Run};
use super::spec::{Spec, Substep};
use crate::sim::bond::BondKind;
use crate::sim::kernels::cells::{Cells, View};
use crate::sim::kernels::crowd::{self, Link};
use crate::sim::kernels::lanes::{WIDEST, largest, splat};
use crate::sim::kernels::law::{Law, Rigid};
use crate::sim::kernels::level::vectorized;
use crate::sim::kernels::pair::{Correct, Measure};
use crate::sim::kernels::store::Drift;
use crate::sim::real::Real;
use crate::sim::threads;

/// Equal bodies, and the bonds of one of them.
#[derive(Clone, Debug)]
pub(crate) struct Crowd {
    bodies: usize,
    /// Points of a body.
    points: usize,
    /// In the order in which they are taken.
    links: Vec<Link<Spec, f64>>,
}

impl Crowd {
    /// So many bodies of so many points, with these bonds in each, in the order in which they are taken.
    ///
    /// All bonds are of one kind, but for their numbers.
    pub(crate) fn new(bodies: usize, points: usize, bonds: impl IntoIterator<Item = ([u32; 2], Spec)>) -> Self {
        let link = |(ends, spec): ([u32; 2], Spec)| Link { ends, law: spec, rest: spec.rest, is_plain: false };
        Crowd { bodies, points, links: bonds.into_iter().map(link).collect() }
    }

    /// Cells of a block.
    fn block(&self) -> usize {
        self.points * WIDEST
    }

    /// Blocks, with the bodies of each.
    fn blocks<'a, S, const D: usize>(&self, view: View<'a, S, D>) -> impl Iterator<Item = (View<'a, S, D>, usize)> {
        let bodies = self.bodies;
        let count = move |k: usize| WIDEST.min(bodies.saturating_sub(k * WIDEST));
        let blocks = view.parts(self.block()).enumerate().map(move |(k, block)| (block, count(k)));
        blocks.filter(|(_, count)| *count > 0)
    }

    fn bond_count(&self) -> usize {
        self.bodies * self.links.len()
    }

    /// Takes all substeps of one block after the other, while it lies in the innermost cache.
    fn run_by<S: Real, L: Law<S>, const D: usize>(
        &self,
        cells: &mut Cells<S, D>,
        law: impl Fn(&Spec) -> L,
        drifts: Option<(&Drift<S, D>, &Drift<S, D>)>,
        (substeps, sweeps): (u32, u32),
    ) {
        let links = self.links(law);
        let bodies = (0..self.bodies).step_by(WIDEST).map(|first| WIDEST.min(self.bodies - first));
        let work = self.bond_count() * (substeps * sweeps) as usize;
        threads::with_each(work, cells.parts(self.block()).zip(bodies), |(mut part, count)| {
            for substep in 0..substeps {
                match drifts {
                    Some((first, _)) if substep == 0 => part.set_out(first),
                    Some((_, next)) => part.go_on(next),
                    None => {}
                }
                for _ in 0..sweeps {
                    vectorized!(m => crowd::block(m, &mut Correct, &mut part.view(), &links, count));
                }
            }
        });
    }

    /// As [`Crowd::run_by`], by the law of its bonds.
    fn run_all<S: Real, const D: usize>(
        &self,
        cells: &mut Cells<S, D>,
        step: &Substep,
        drifts: Option<(&Drift<S, D>, &Drift<S, D>)>,
        counts: (u32, u32),
    ) {
        match self.links.first().map(|link| link.law.kind) {
            Some(BondKind::Rigid) => self.run_by(cells, |_| Rigid, drifts, counts),
            Some(_) => self.run_by(cells, |spec| spec.elastic::<S>(step), drifts, counts),
            None => {}
        }
    }

    fn links<S: Real, L>(&self, law: impl Fn(&Spec) -> L) -> Vec<Link<L, S>> {
        let of = |link: &Link<Spec, f64>| Link {
            ends: link.ends,
            law: law(&link.law),
            rest: S::from_f64(link.rest),
            is_plain: link.is_plain,
        };
        self.links.iter().map(of).collect()
    }
}

impl<S: Real, const D: usize> Form<S, D> for Crowd {
    type Store = Cells<S, D>;

    fn cells(&self) -> usize {
        self.bodies.div_ceil(WIDEST) * self.block()
    }

    #[inline(always)]
    fn runs(&self, mut visit: impl FnMut(Run)) {
        for body in 0..self.bodies {
            let (point, cell) = (body * self.points, body / WIDEST * self.block() + body % WIDEST);
            visit(Run { point, point_step: 1, cell, cell_step: WIDEST, count: self.points });
        }
    }

    fn weigh(&mut self, cells: &mut Cells<S, D>) {
        let mut is_plain = vec![true; self.points];
        Form::<S, D>::each(self, |point, cell| is_plain[point % self.points] &= cells.w[cell] == S::ONE);
        for link in &mut self.links {
            link.is_plain = link.ends.iter().all(|&end| is_plain[end as usize]);
        }
    }

    fn run(
        &mut self,
        cells: &mut Cells<S, D>,
        way: Way,
        step: &Substep,
        drifts: (&Drift<S, D>, &Drift<S, D>),
        count: u32,
    ) {
        self.run_all(cells, step, Some(drifts), (count, super::passes(way)));
    }

    fn sweep(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        self.run_all(cells, step, None, (1, 1));
    }

    /// Paths of small bodies are short: a sweep does as well.
    fn solve(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        self.sweep(cells, step);
    }

    fn stretch(&self, cells: &mut Cells<S, D>) -> S {
        let links = self.links::<S, ()>(|_| ());
        let blocks = self.blocks(cells.view()).collect();
        threads::largest_of(self.bond_count(), blocks, S::ZERO, |(mut view, count): (View<'_, S, D>, usize)| {
            vectorized!(m => {
                let mut measure = Measure { most: splat(m, S::ZERO) };
                crowd::block(m, &mut measure, &mut view, &links, count);
                largest::<_, S>(measure.most)
            })
        })
    }

    fn heap_bytes(&self) -> usize {
        self.links.capacity() * size_of::<Link<Spec, f64>>()
    }

    fn bonds(&self) -> usize {
        self.bond_count()
    }
}
