//! Bonds side by side, whose ends lie side by side: one bond a lane.

use fearless_simd::{Select, Simd, SimdBase};

use super::cells::View;
use super::lanes::{Lanes, Mask, Vectors, add, dot, each, load, scale, select, splat, store, sub};
use super::law::{Law, Measured};
use crate::sim::real::Real;

/// A point a lane.
#[derive(Clone, Copy)]
pub(crate) struct Node<M: Simd, S: Real, const D: usize> {
    pub(crate) x: Vectors<M, S, D>,
    pub(crate) d: Vectors<M, S, D>,
    pub(crate) w: Lanes<M, S>,
}

impl<M: Simd, S: Real, const D: usize> Node<M, S, D> {
    /// The points from a cell on; without `CAREFUL` their weight is 1.
    #[inline(always)]
    pub(crate) fn load<const CAREFUL: bool>(m: M, view: &View<'_, S, D>, at: usize) -> Self {
        Node {
            x: each::<M, S, D>(m, |k| load(m, view.x[k], at)),
            d: each::<M, S, D>(m, |k| load(m, &*view.d[k], at)),
            w: if CAREFUL { load(m, view.w, at) } else { splat(m, S::ONE) },
        }
    }

    /// Writes the displacements that work of this sort changes.
    #[inline(always)]
    pub(crate) fn keep<W: Work<M, S, D, L>, L>(&self, view: &mut View<'_, S, D>, at: usize) {
        if W::MOVES {
            for k in 0..D {
                store::<M, S>(self.d[k], view.d[k], at);
            }
        }
    }
}

/// What is done with a bond: it is corrected, or measured.
pub(crate) trait Work<M: Simd, S: Real, const D: usize, L> {
    /// Whether it moves the ends.
    const MOVES: bool;

    /// Does it for the bonds between `a` and `b`, in the lanes of the mask; without `CAREFUL` in all of them, with weights
    /// of 1.
    fn bond<const CAREFUL: bool>(
        &mut self,
        m: M,
        law: &L,
        rest: Lanes<M, S>,
        a: &mut Node<M, S, D>,
        b: &mut Node<M, S, D>,
        mask: Mask<M, S>,
    );
}

/// Moves the ends as the law says.
pub(crate) struct Correct;

impl<M: Simd, S: Real, const D: usize, L: Law<S>> Work<M, S, D, L> for Correct {
    const MOVES: bool = true;

    #[inline(always)]
    fn bond<const CAREFUL: bool>(
        &mut self,
        m: M,
        law: &L,
        rest: Lanes<M, S>,
        a: &mut Node<M, S, D>,
        b: &mut Node<M, S, D>,
        mask: Mask<M, S>,
    ) {
        let zero = splat(m, S::ZERO);
        let change = sub::<M, S, D>(a.d, b.d);
        let start = sub::<M, S, D>(a.x, b.x);
        let e = if law.is_force() { start } else { add::<M, S, D>(start, change) };
        let closing = if L::IS_DAMPED { dot::<M, S, D>(e, change) } else { zero };
        let sum = if CAREFUL { a.w + b.w } else { splat(m, S::ONE + S::ONE) };
        let factor = law.factor(m, &Measured { rest, square: dot::<M, S, D>(e, e), sum, closing });
        let (way_a, way_b) = if CAREFUL { (factor * a.w, factor * b.w) } else { (factor, factor) };
        let to_a = add::<M, S, D>(a.d, scale::<M, S, D>(e, way_a));
        let to_b = sub::<M, S, D>(b.d, scale::<M, S, D>(e, way_b));
        if CAREFUL {
            // Two pinned ends have no share in anything.
            let mask = mask & sum.simd_gt(zero);
            a.d = select::<M, S, D>(mask, to_a, a.d);
            b.d = select::<M, S, D>(mask, to_b, b.d);
        } else {
            (a.d, b.d) = (to_a, to_b);
        }
    }
}

/// Finds the largest |e.e/rest^2 - 1|, which is about twice the strain. Bonds between two pins count as any other.
pub(crate) struct Measure<M: Simd, S: Real> {
    pub(crate) most: Lanes<M, S>,
}

impl<M: Simd, S: Real, const D: usize> Work<M, S, D, ()> for Measure<M, S> {
    const MOVES: bool = false;

    #[inline(always)]
    fn bond<const CAREFUL: bool>(
        &mut self,
        _: M,
        _: &(),
        rest: Lanes<M, S>,
        a: &mut Node<M, S, D>,
        b: &mut Node<M, S, D>,
        mask: Mask<M, S>,
    ) {
        let e = add::<M, S, D>(sub::<M, S, D>(a.x, b.x), sub::<M, S, D>(a.d, b.d));
        let square = rest * rest;
        let off = (dot::<M, S, D>(e, e) - square).abs() / square;
        let most = self.most.max(off);
        self.most = if CAREFUL { mask.select(most, self.most) } else { most };
    }
}
