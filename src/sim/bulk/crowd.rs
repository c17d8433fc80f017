//! A crowd: equal small bodies.

use super::Way;
use super::form::{Form, Run};
use super::spec::{Spec, Start, Substep};
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
    /// They are not taken back as well in each substep of the path method.
    is_steady: bool,
}

/// What is done in a substep: points may be where they are.
struct Turn<'a, S, const D: usize> {
    drift: Option<&'a Drift<S, D>>,
    step: &'a Substep,
}

impl Crowd {
    /// So many bodies of so many points, with these bonds in each, in the order in which they are taken.
    ///
    /// All bonds are of one kind, but for their numbers.
    pub(crate) fn new(bodies: usize, points: usize, links: Vec<([u32; 2], Spec)>, is_steady: bool) -> Self {
        let link = |(ends, spec): ([u32; 2], Spec)| Link { ends, law: spec, rest: spec.rest, is_plain: false };
        Crowd { bodies, points, links: links.into_iter().map(link).collect(), is_steady }
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

    /// Takes all substeps of one block after the other, while it lies in the innermost cache: the first one as the first of
    /// `turns` says, the others as the last one does.
    fn run_by<S: Real, L: Law<S>, const D: usize>(
        &self,
        cells: &mut Cells<S, D>,
        law: impl Fn(&Spec, &Substep) -> L,
        turns: &[Turn<'_, S, D>],
        (way, count): (Way, u32),
    ) {
        let sweeps = super::passes(way);
        let links_of = |turn: &Turn<'_, S, D>| {
            let mut links = self.links(|spec| law(spec, turn.step));
            if way == Way::Paths && !self.is_steady {
                self.take_back(&mut links);
            }
            links
        };
        let links: Vec<_> = turns.iter().map(links_of).collect();
        let bodies = (0..self.bodies).step_by(WIDEST).map(|first| WIDEST.min(self.bodies - first));
        let work = self.bond_count() * (count * sweeps) as usize;
        threads::with_each(work, cells.parts(self.block()).zip(bodies), |(mut part, bodies)| {
            for substep in 0..count as usize {
                let turn = substep.min(turns.len() - 1);
                match turns[turn].drift {
                    Some(drift) if substep == 0 => part.set_out(drift),
                    Some(drift) => part.go_on(drift),
                    None => {}
                }
                for _ in 0..sweeps {
                    vectorized!(m => crowd::block(m, &mut Correct, &mut part.view(), &links[turn], bodies));
                }
            }
        });
    }

    /// As [`Crowd::run_by`], by the law of its bonds.
    fn run_all<S: Real, const D: usize>(&self, cells: &mut Cells<S, D>, turns: &[Turn<'_, S, D>], counts: (Way, u32)) {
        match self.links.first().map(|link| link.law.kind) {
            Some(BondKind::Rigid) => self.run_by(cells, |_, _| Rigid, turns, counts),
            Some(_) => self.run_by(cells, |spec, step| spec.elastic::<S>(step), turns, counts),
            None => {}
        }
    }

    /// Lets rigid bonds be taken back as well.
    fn take_back<S: Real, L: Copy>(&self, links: &mut Vec<Link<L, S>>) {
        if self.links.first().is_some_and(|link| link.law.kind == BondKind::Rigid) {
            let count = links.len();
            links.extend_from_within(..count - 1);
            links[count..].reverse();
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

    fn run(&mut self, cells: &mut Cells<S, D>, way: Way, (first, next): (&Start<S, D>, &Start<S, D>), count: u32) -> S {
        let turns = [first, next].map(|start| Turn { drift: Some(&start.drift), step: &start.step });
        self.run_all(cells, &turns, (way, count));
        S::ZERO
    }

    fn sweep(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        self.run_all(cells, &[Turn { drift: None, step }], (Way::Sweeps(1), 1));
    }

    /// Paths of small bodies are short: a sweep does as well.
    fn solve(&mut self, cells: &mut Cells<S, D>, step: &Substep) -> S {
        self.run_all(cells, &[Turn { drift: None, step }], (Way::Paths, 1));
        S::ZERO
    }

    fn stretch(&self, cells: &mut Cells<S, D>) -> S {
        if self.links.first().is_none_or(|link| link.law.kind != BondKind::Rigid) {
            return S::ZERO;
        }
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
