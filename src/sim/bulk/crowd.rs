//! A crowd: equal small bodies.

use super::form::Form;
use super::spec::{Spec, Substep};
use crate::sim::bond::BondKind;
use crate::sim::kernels::cells::Cells;
use crate::sim::kernels::crowd::{self, Link};
use crate::sim::kernels::lanes::{WIDEST, largest, splat};
use crate::sim::kernels::law::{Law, Rigid};
use crate::sim::kernels::level::vectorized;
use crate::sim::kernels::pair::{Correct, Measure};
use crate::sim::real::Real;

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
    fn blocks(&self) -> impl Iterator<Item = (usize, usize)> {
        let (block, bodies) = (self.block(), self.bodies);
        (0..bodies.div_ceil(WIDEST)).map(move |k| (k * block, WIDEST.min(bodies - k * WIDEST)))
    }

    fn sweep_by<S: Real, L: Law<S>, const D: usize>(&self, cells: &mut Cells<S, D>, law: impl Fn(&Spec) -> L) {
        let links = self.links(law);
        let mut view = cells.view();
        vectorized!(m => {
            for (at, count) in self.blocks() {
                crowd::block(m, &mut Correct, &mut view.part(at, self.block()), &links, count);
            }
        });
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
    fn each(&self, mut visit: impl FnMut(usize, usize)) {
        for body in 0..self.bodies {
            let cell = body / WIDEST * self.block() + body % WIDEST;
            for point in 0..self.points {
                visit(body * self.points + point, cell + point * WIDEST);
            }
        }
    }

    fn weigh(&mut self, cells: &mut Cells<S, D>) {
        let mut is_plain = vec![true; self.points];
        Form::<S, D>::each(self, |point, cell| is_plain[point % self.points] &= cells.w[cell] == S::ONE);
        for link in &mut self.links {
            link.is_plain = link.ends.iter().all(|&end| is_plain[end as usize]);
        }
    }

    fn sweep(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        match self.links.first().map(|link| link.law.kind) {
            Some(BondKind::Rigid) => self.sweep_by(cells, |_| Rigid),
            Some(BondKind::Relaxed { .. }) => self.sweep_by(cells, |spec| spec.relaxed::<S>(step)),
            Some(BondKind::Spring { .. }) => self.sweep_by(cells, |spec| spec.compliant::<S>(step)),
            None => {}
        }
    }

    /// Paths of small bodies are short: a sweep does as well.
    fn solve(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        self.sweep(cells, step);
    }

    fn stretch(&self, cells: &mut Cells<S, D>) -> S {
        let links = self.links::<S, ()>(|_| ());
        let mut view = cells.view();
        vectorized!(m => {
            let mut measure = Measure { most: splat(m, S::ZERO) };
            for (at, count) in self.blocks() {
                crowd::block(m, &mut measure, &mut view.part(at, self.block()), &links, count);
            }
            largest::<_, S>(measure.most)
        })
    }

    fn heap_bytes(&self) -> usize {
        self.links.capacity() * size_of::<Link<Spec, f64>>()
    }

    fn bonds(&self) -> usize {
        self.bodies * self.links.len()
    }
}
