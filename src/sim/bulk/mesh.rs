//! Any mesh: bonds in colours, and in long paths where there are any.

use fearless_simd::Simd;

use super::form::{Form, MOST_IDLE, Run};
use super::spec::{Spec, Substep};
use super::trails::{self, Bundle, Segment, is_about};
use crate::sim::bond::BondKind;
use crate::sim::colour::colours;
use crate::sim::kernels::cells::Cells;
use crate::sim::kernels::lanes::{Lanes, Mask, WIDEST, between, largest, load, splat, width};
use crate::sim::kernels::law::{Law, Rigid};
use crate::sim::kernels::level::vectorized;
use crate::sim::kernels::mesh::{self, Colour, Rests};
use crate::sim::kernels::nodes::Nodes;
use crate::sim::kernels::pair::{Correct, Measure, Work};
use crate::sim::kernels::path::{self, Scratch, Strip};
use crate::sim::kernels::store::Store;
use crate::sim::real::Real;

/// Bonds of one colour and one kind.
#[derive(Clone, Debug)]
struct Batch<S> {
    spec: Spec,
    /// From and to in the lists of bonds.
    range: [usize; 2],
    /// The rest length of all of them, if it is one `[m]`.
    rest: Option<S>,
    is_plain: bool,
}

/// A mesh.
#[derive(Clone, Debug)]
pub(crate) struct Mesh<S: Real, const D: usize> {
    points: usize,
    /// Bonds as listed, until weights are known.
    segments: Vec<Segment>,
    /// Ends of bonds, batch by batch.
    ends: Vec<[u32; 2]>,
    /// Rest lengths of bonds `[m]`; empty where each batch has one.
    rests: Vec<S>,
    batches: Vec<Batch<S>>,
    /// Bonds that are gone.
    gone: usize,
    /// The first batch of the last colour.
    last: usize,
    bundles: Vec<Bundle<S>>,
    /// A bundle's points side by side.
    turned: Cells<S, D>,
    scratch: Scratch<S>,
}

impl<S: Real, const D: usize> Mesh<S, D> {
    /// A mesh of so many points.
    pub(crate) fn new(points: usize, segments: Vec<Segment>) -> Self {
        Mesh {
            points,
            segments,
            ends: Vec::new(),
            rests: Vec::new(),
            batches: Vec::new(),
            gone: 0,
            last: 0,
            bundles: Vec::new(),
            turned: Cells::new(0),
            scratch: Scratch::default(),
        }
    }

    /// Looks for long paths. Returns their mean length in bonds.
    pub(crate) fn lay_trails(&mut self, position: &[[f64; D]], down: [f64; D]) -> f64 {
        self.bundles = trails::bundles(&self.segments, position, down);
        let longest = self.bundles.iter().map(|bundle| bundle.len).max().unwrap_or(0);
        self.turned = Cells::new(longest * WIDEST);
        trails::mean_length(&self.bundles)
    }

    /// Forgets the paths: bonds are swept.
    pub(crate) fn forget_trails(&mut self) {
        (self.bundles, self.turned) = (Vec::new(), Cells::new(0));
    }

    fn colour(&self, batch: &Batch<S>) -> Colour<'_, S> {
        let [from, to] = batch.range;
        let rests = match batch.rest {
            Some(rest) => Rests::Same(rest),
            None => Rests::Each(&self.rests[from..to]),
        };
        Colour { ends: &self.ends[from..to], rests, is_plain: batch.is_plain }
    }

    fn sweep_batch(&self, nodes: &mut Nodes<S, D>, batch: &Batch<S>, step: &Substep) {
        match batch.spec.kind {
            BondKind::Rigid => self.correct(nodes, batch, Rigid),
            _ => self.correct(nodes, batch, batch.spec.elastic::<S>(step)),
        }
    }

    fn correct<L: Law<S>>(&self, nodes: &mut Nodes<S, D>, batch: &Batch<S>, law: L) {
        let colour = self.colour(batch);
        vectorized!(m => mesh::colour(m, &mut Correct, nodes, &law, &colour));
    }

    /// Solves the trails of a bundle. Returns their largest pull.
    fn solve_bundle(&mut self, nodes: &mut Nodes<S, D>, place: usize, step: &Substep) -> S {
        let Mesh { bundles, turned, scratch, .. } = self;
        let bundle = &bundles[place];
        let law = bundle.spec.path::<S>(step);
        let mut pull = S::ZERO;
        for (cell, &point) in bundle.points[..bundle.len * WIDEST].iter().enumerate() {
            let (x, d) = nodes.get(point as usize);
            turned.put(cell, x, d);
            turned.w[cell] = nodes.w[point as usize];
        }
        vectorized!(m => {
            for lane in (0..usize::from(bundle.counts[0])).step_by(width::<_, S>(m)) {
                let pulls = path::solve(m, &mut turned.view(), &Side { m, bundle, lane }, &law, scratch);
                pull = pull.max(largest::<_, S>(pulls));
            }
        });
        for (k, &count) in bundle.counts.iter().enumerate() {
            for cell in k * WIDEST..k * WIDEST + usize::from(count) {
                nodes.points[bundle.points[cell] as usize].d = turned.get(cell).1;
            }
        }
        pull
    }
}

/// Whether all of the bonds have one rest length, and which.
fn rest_of<S: Real>(segments: &[Segment]) -> Option<S> {
    let first = segments.first()?.spec;
    segments.iter().all(|segment| segment.spec.is_like(&first)).then(|| S::from_f64(first.rest))
}

impl<S: Real, const D: usize> Form<S, D> for Mesh<S, D> {
    type Store = Nodes<S, D>;

    fn cells(&self) -> usize {
        self.points
    }

    #[inline(always)]
    fn runs(&self, mut visit: impl FnMut(Run)) {
        visit(Run { point: 0, point_step: 1, cell: 0, cell_step: 1, count: self.points });
    }

    /// Weights decide which bonds need them: batches are made now.
    fn weigh(&mut self, nodes: &mut Nodes<S, D>) {
        let is_plain = |ends: [u32; 2]| ends.iter().all(|&end| nodes.w[end as usize] == S::ONE);
        let pairs: Vec<[u32; 2]> = self.segments.iter().map(|segment| segment.ends).collect();
        let (order, stops) = colours(&pairs, self.points);
        let mut kinds: Vec<Spec> = Vec::new();
        let mut kind_of = |spec: &Spec| {
            kinds.iter().position(|kind| kind.is_of_kind(spec)).unwrap_or_else(|| {
                kinds.push(*spec);
                kinds.len() - 1
            })
        };
        let mut start = 0;
        for stop in stops {
            self.last = self.batches.len();
            let mut colour: Vec<(usize, bool, u32)> = (order[start..stop].iter())
                .map(|&k| (kind_of(&self.segments[k as usize].spec), is_plain(pairs[k as usize]), k))
                .collect();
            colour.sort_by_key(|&(kind, plain, _)| (kind, plain));
            for some in colour.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
                let bonds: Vec<Segment> = some.iter().map(|&(.., k)| self.segments[k as usize]).collect();
                let range = [self.ends.len(), self.ends.len() + bonds.len()];
                self.ends.extend(bonds.iter().map(|bond| bond.ends));
                self.rests.extend(bonds.iter().map(|bond| S::from_f64(bond.spec.rest)));
                let rest = rest_of(&bonds);
                self.batches.push(Batch { spec: bonds[0].spec, range, rest, is_plain: some[0].1 });
            }
            start = stop;
        }
        if self.batches.iter().all(|batch| batch.rest.is_some()) {
            self.rests = Vec::new();
        }
        self.segments = Vec::new();
    }

    fn sweep(&mut self, nodes: &mut Nodes<S, D>, step: &Substep) {
        for batch in &self.batches {
            self.sweep_batch(nodes, batch, step);
        }
    }

    /// Paths, or sweeps where there are none; rigid bonds forth and back.
    ///
    /// A pass over rigid bonds is a product of projections, one for each colour or class. In the same order from substep to
    /// substep, with three of them or more, it can feed energy in; forth and back it is symmetric and cannot: Verlet's method
    /// multiplies what a pass multiplies by mu by z, z^2 - 2 mu z + mu = 0, and |z| <= 1 for every real mu in [0, 1].
    fn solve(&mut self, nodes: &mut Nodes<S, D>, step: &Substep) -> S {
        let is_rigid = |spec: &Spec| spec.kind == BondKind::Rigid;
        if self.bundles.is_empty() {
            self.sweep(nodes, step);
            for batch in self.batches[..self.last].iter().rev().filter(|batch| is_rigid(&batch.spec)) {
                self.sweep_batch(nodes, batch, step);
            }
            return S::ZERO;
        }
        let mut pull = S::ZERO;
        for place in (0..self.bundles.len()).rev() {
            if self.bundles[place].class > 0 && is_rigid(&self.bundles[place].spec) {
                pull = pull.max(self.solve_bundle(nodes, place, step));
            }
        }
        for place in 0..self.bundles.len() {
            pull = pull.max(self.solve_bundle(nodes, place, step));
        }
        pull
    }

    fn stretch(&self, nodes: &mut Nodes<S, D>) -> S {
        vectorized!(m => {
            let mut measure = Measure { most: splat(m, S::ZERO) };
            for batch in self.batches.iter().filter(|batch| batch.spec.kind == BondKind::Rigid) {
                all(m, &mut measure, nodes, &self.colour(batch));
            }
            largest::<_, S>(measure.most)
        })
    }

    fn heap_bytes(&self) -> usize {
        let bundle = |bundle: &Bundle<S>| {
            4 * bundle.points.capacity() + size_of::<S>() * bundle.rests.capacity() + bundle.counts.capacity()
        };
        8 * self.ends.capacity()
            + size_of::<S>() * self.rests.capacity()
            + size_of::<Batch<S>>() * self.batches.capacity()
            + self.bundles.iter().map(bundle).sum::<usize>()
            + self.turned.heap_bytes()
            + self.scratch.heap_bytes()
    }

    fn lose(&mut self, ends: [u32; 2], rest: f64) -> bool {
        if self.gone as f64 >= MOST_IDLE * self.ends.len() as f64 {
            return false;
        }
        let rest = S::from_f64(rest);
        let is_meant = |[a, b]: [u32; 2]| [a, b] == ends || [b, a] == ends;
        let of_batch = |batch: &Batch<S>| {
            let [from, to] = batch.range;
            let has_rest = |k: usize| is_about(batch.rest.unwrap_or_else(|| self.rests[k]), rest);
            (from..to).find(|&k| is_meant(self.ends[k]) && has_rest(k))
        };
        let found = self.batches.iter().enumerate().find_map(|(place, batch)| Some((place, of_batch(batch)?)));
        let Some((place, k)) = found else { return false };
        if !self.bundles.is_empty() && !self.bundles.iter_mut().any(|bundle| bundle.lose(is_meant, rest)) {
            return false;
        }
        // Bonds of a batch share no point: their order is nothing. What is gone lies behind its end.
        let last = self.batches[place].range[1] - 1;
        self.ends.swap(k, last);
        if !self.rests.is_empty() {
            self.rests.swap(k, last);
        }
        self.batches[place].range[1] = last;
        self.gone += 1;
        true
    }

    fn bonds(&self) -> usize {
        self.ends.len() - self.gone
    }
}

#[inline(always)]
fn all<M: Simd, S: Real, W: Work<M, S, D, ()>, const D: usize>(
    m: M,
    work: &mut W,
    nodes: &mut Nodes<S, D>,
    colour: &Colour<'_, S>,
) {
    mesh::colour(m, work, nodes, &(), colour);
}

/// Trails of a bundle from a lane on.
struct Side<'a, M, S> {
    m: M,
    bundle: &'a Bundle<S>,
    lane: usize,
}

impl<M: Simd, S: Real> Strip<M, S> for Side<'_, M, S> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.bundle.len
    }

    #[inline(always)]
    fn at(&self, k: usize) -> usize {
        k * WIDEST + self.lane
    }

    #[inline(always)]
    fn lanes(&self, k: usize) -> Mask<M, S> {
        between::<M, S>(self.m, 0, isize::from(self.bundle.counts[k]) - self.lane as isize)
    }

    #[inline(always)]
    fn rest(&self, k: usize) -> Lanes<M, S> {
        load(self.m, &self.bundle.rests, k * WIDEST + self.lane)
    }
}
