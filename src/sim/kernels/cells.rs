//! The state of points as the kernels read it: a list for every component.

use aligned_vec::AVec;
use fearless_simd::{Select, Simd, SimdBase};

use super::lanes::{self, WIDEST};
use super::level::vectorized;
use super::store::{Drift, Run, Store};
use crate::sim::real::Real;
use crate::sim::threads;

/// Cells that one thread takes at a time from one substep to the next.
const PART: usize = 1 << 15;

/// Positions, displacements and weights of points, in the order that a kernel wants: neighbours in a vector are
/// neighbours in the lists.
///
/// A cell that no point owns has weight 0 and lies at the origin.
#[derive(Clone, Debug)]
pub(crate) struct Cells<S, const D: usize> {
    /// x at the start of the substep `[m]`, component by component.
    pub(crate) x: [AVec<S>; D],
    /// Displacement of the substep under way `[m]`.
    pub(crate) d: [AVec<S>; D],
    /// The part of it that was carried over `[m]`.
    carried: [AVec<S>; D],
    /// w/w_0: inverse masses relative to a reference; 0 = pinned.
    pub(crate) w: AVec<S>,
}

/// What a kernel reads and writes of cells.
pub(crate) struct View<'a, S, const D: usize> {
    pub(crate) x: [&'a [S]; D],
    pub(crate) d: [&'a mut [S]; D],
    pub(crate) w: &'a [S],
}

impl<S: Real, const D: usize> Store<S, D> for Cells<S, D> {
    /// `count` cells that no point owns, and room for a vector behind them.
    fn new(count: usize) -> Self {
        let list = || AVec::from_iter(64, std::iter::repeat_n(S::ZERO, count.next_multiple_of(WIDEST) + WIDEST));
        let lists = || std::array::from_fn(|_| list());
        Cells { x: lists(), d: lists(), carried: lists(), w: list() }
    }

    #[inline(always)]
    fn put(&mut self, at: usize, x: [S; D], motion: [S; D]) {
        for k in 0..D {
            if self.x[k][at] != x[k] {
                self.carried[k][at] = S::ZERO;
            }
            self.x[k][at] = x[k];
            self.d[k][at] = motion[k] + self.carried[k][at];
        }
    }

    #[inline(always)]
    fn get(&self, at: usize) -> ([S; D], [S; D]) {
        (std::array::from_fn(|k| self.x[k][at]), std::array::from_fn(|k| self.d[k][at]))
    }

    #[inline(always)]
    fn motion(&self, at: usize) -> [S; D] {
        std::array::from_fn(|k| self.d[k][at] - self.carried[k][at])
    }

    fn heap_bytes(&self) -> usize {
        (3 * D + 1) * self.w.capacity() * size_of::<S>()
    }

    fn set(&mut self, at: usize, x: [S; D], motion: [S; D]) {
        for k in 0..D {
            (self.x[k][at], self.d[k][at], self.carried[k][at]) = (x[k], motion[k], S::ZERO);
        }
    }

    #[inline(always)]
    fn weight(&mut self, at: usize) -> &mut S {
        &mut self.w[at]
    }

    fn set_out(&mut self, drift: &Drift<S, D>) {
        let work = self.w.len();
        threads::with_each(work, self.parts(PART), |mut part| part.set_out(drift));
    }

    fn go_on(&mut self, drift: &Drift<S, D>) {
        let work = self.w.len();
        threads::with_each(work, self.parts(PART), |mut part| part.go_on(drift));
    }

    fn arrive(&mut self) {
        let work = self.w.len();
        threads::with_each(work, self.parts(PART), |mut part| part.arrive());
    }

    #[inline(always)]
    fn read(&self, run: &Run, mut visit: impl FnMut(usize, [S; D], [S; D])) {
        let end = run.cell + (run.count - 1) * run.cell_step + 1;
        let x = self.x.each_ref().map(|list| &list[run.cell..end]);
        let d = self.d.each_ref().map(|list| &list[run.cell..end]);
        let carried = self.carried.each_ref().map(|list| &list[run.cell..end]);
        for i in 0..run.count {
            let (mut place, mut motion) = ([S::ZERO; D], [S::ZERO; D]);
            for k in 0..D {
                place[k] = x[k][i * run.cell_step];
                motion[k] = d[k][i * run.cell_step] - carried[k][i * run.cell_step];
            }
            visit(i, place, motion);
        }
    }
}

impl<S: Real, const D: usize> Cells<S, D> {
    /// All of it for a kernel.
    pub(crate) fn view(&mut self) -> View<'_, S, D> {
        let Cells { x, d, w, .. } = self;
        View { x: x.each_ref().map(|list| &list[..]), d: d.each_mut().map(|list| &mut list[..]), w }
    }

    /// Parts of `size` cells each, and what is left over.
    pub(crate) fn parts(&mut self, size: usize) -> impl Iterator<Item = Part<'_, S, D>> {
        let Cells { x, d, carried, w } = self;
        let mut lists = [x, d, carried].map(|lists| lists.each_mut().map(|list| list.chunks_mut(size)));
        w.chunks(size).map(move |w| {
            let [x, d, carried] =
                lists.each_mut().map(|lists| lists.each_mut().map(|list| list.next().unwrap_or_default()));
            Part { x, d, carried, w }
        })
    }
}

/// Some cells, with all that a substep changes.
pub(crate) struct Part<'a, S, const D: usize> {
    x: [&'a mut [S]; D],
    d: [&'a mut [S]; D],
    carried: [&'a mut [S]; D],
    w: &'a [S],
}

impl<S: Real, const D: usize> Part<'_, S, D> {
    /// For a kernel.
    pub(crate) fn view(&mut self) -> View<'_, S, D> {
        View { x: self.x.each_ref().map(|list| &**list), d: self.d.each_mut().map(|list| &mut **list), w: self.w }
    }

    /// d -> keep d + fall for free points.
    pub(crate) fn set_out(&mut self, drift: &Drift<S, D>) {
        for k in 0..D {
            vectorized!(m => set_out(m, self.d[k], self.carried[k], self.w, (drift.keep, drift.ratio, drift.fall[k])));
        }
    }

    /// x += d, then d -> keep d + fall for free points.
    pub(crate) fn go_on(&mut self, drift: &Drift<S, D>) {
        for k in 0..D {
            let lists = (&mut *self.x[k], &mut *self.d[k], &mut *self.carried[k]);
            vectorized!(m => go_on(m, lists, self.w, (drift.keep, drift.fall[k])));
        }
    }

    /// x += d, and d stays.
    fn arrive(&mut self) {
        for k in 0..D {
            vectorized!(m => arrive(m, self.x[k], self.d[k], self.carried[k]));
        }
    }
}

impl<'a, S, const D: usize> View<'a, S, D> {
    /// Leaves out the first cells.
    pub(crate) fn after(self, count: usize) -> Self {
        View { x: self.x.map(|list| &list[count..]), d: self.d.map(|list| &mut list[count..]), w: &self.w[count..] }
    }

    /// Parts of `size` cells each, and what is left over.
    pub(crate) fn parts(self, size: usize) -> impl Iterator<Item = Self> {
        let mut x = self.x.map(|list| list.chunks(size));
        let mut d = self.d.map(|list| list.chunks_mut(size));
        self.w.chunks(size).map(move |w| View {
            x: x.each_mut().map(|list| list.next().unwrap_or_default()),
            d: d.each_mut().map(|list| list.next().unwrap_or_default()),
            w,
        })
    }
}

#[inline(always)]
fn set_out<M: Simd, S: Real>(m: M, d: &mut [S], carried: &[S], w: &[S], (keep, ratio, fall): (S, S, S)) {
    let [keep, ratio, fall, zero] = [keep, ratio, fall, S::ZERO].map(|value| lanes::splat(m, value));
    for at in (0..d.len()).step_by(lanes::width::<M, S>(m)) {
        let owed = lanes::load(m, carried, at);
        let motion = lanes::load(m, d, at) - owed;
        let is_free = lanes::load(m, w, at).simd_gt(zero);
        lanes::store::<M, S>(is_free.select(motion * keep + fall, motion * ratio) + owed, d, at);
    }
}

#[inline(always)]
fn arrive<M: Simd, S: Real>(m: M, x: &mut [S], d: &mut [S], carried: &mut [S]) {
    for at in (0..x.len()).step_by(lanes::width::<M, S>(m)) {
        let (from, way, old) = (lanes::load(m, x, at), lanes::load(m, d, at), lanes::load(m, carried, at));
        let to = from + way;
        let owed = way - (to - from);
        lanes::store::<M, S>(to, x, at);
        lanes::store::<M, S>(owed, carried, at);
        lanes::store::<M, S>((way - old) + owed, d, at);
    }
}

#[inline(always)]
fn go_on<M: Simd, S: Real>(m: M, (x, d, carried): (&mut [S], &mut [S], &mut [S]), w: &[S], (keep, fall): (S, S)) {
    let (keep, fall, zero) = (lanes::splat(m, keep), lanes::splat(m, fall), lanes::splat(m, S::ZERO));
    for at in (0..x.len()).step_by(lanes::width::<M, S>(m)) {
        let (from, way, old) = (lanes::load(m, x, at), lanes::load(m, d, at), lanes::load(m, carried, at));
        let to = from + way;
        let owed = way - (to - from);
        let motion = way - old;
        let is_free = lanes::load(m, w, at).simd_gt(zero);
        lanes::store::<M, S>(to, x, at);
        lanes::store::<M, S>(owed, carried, at);
        lanes::store::<M, S>(is_free.select(motion * keep + fall, motion) + owed, d, at);
    }
}
