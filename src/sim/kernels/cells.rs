//! The state of points as the kernels read it: a list for every component.

use aligned_vec::AVec;
use fearless_simd::{Select, Simd, SimdBase};

use super::lanes::{self, WIDEST};
use super::level::vectorized;
use super::store::{Drift, Store};
use crate::sim::real::Real;

/// Positions, displacements and weights of points, in the order that a kernel wants: neighbours in a vector are
/// neighbours in the lists.
///
/// A cell that no point owns has weight 0 and lies at the origin.
#[derive(Clone, Debug)]
pub(crate) struct Cells<S, const D: usize> {
    /// x at the start of the substep [m], component by component.
    pub(crate) x: [AVec<S>; D],
    /// Displacement of the substep under way [m].
    pub(crate) d: [AVec<S>; D],
    /// The part of it that was carried over [m].
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

    fn go_on(&mut self, drift: &Drift<S, D>) {
        let Cells { x, d, carried, w } = self;
        for k in 0..D {
            let lists = (&mut x[k][..], &mut d[k][..], &mut carried[k][..]);
            vectorized!(m => go_on(m, lists, w, (drift.keep, drift.fall[k])));
        }
    }
}

impl<S: Real, const D: usize> Cells<S, D> {
    /// All of it for a kernel.
    pub(crate) fn view(&mut self) -> View<'_, S, D> {
        let Cells { x, d, w, .. } = self;
        View { x: x.each_ref().map(|list| &list[..]), d: d.each_mut().map(|list| &mut list[..]), w }
    }
}

impl<S, const D: usize> View<'_, S, D> {
    /// `count` cells from `at` on.
    pub(crate) fn part(&mut self, at: usize, count: usize) -> View<'_, S, D> {
        View {
            x: self.x.map(|list| &list[at..at + count]),
            d: self.d.each_mut().map(|list| &mut list[at..at + count]),
            w: &self.w[at..at + count],
        }
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
