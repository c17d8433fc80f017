//! Sweeps over a sheet, row by row, without indices.
//!
//! A row lies in two halves, its even columns and its odd ones, each padded:
//!
//! ```text
//! row r     e0 e1 e2 … | o0 o1 o2 …      column 2k = e_k, column 2k + 1 = o_k
//! row r+1   E0 E1 E2 … | O0 O1 O2 …
//! ```
//!
//! so that the ends of bonds of one kind lie side by side. Of the bonds of a row and to the next one, these lie in the
//! same place of all four halves: e-o, e-E, o-O, e-O, o-E; and these reach one place further: o_k-e_k+1, o_k-E_k+1,
//! e_k+1-O_k. The first five are taken with each cell loaded once, then the other three.
//!
//! A sweep takes the even rows, each with the next one, then the odd ones: pairs of rows do not touch each other.

use fearless_simd::Simd;

use super::cells::View;
use super::lanes::{between, splat, width};
use super::pair::{Node, Work};
use crate::sim::real::Real;

/// Where the rows of a sheet lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Cells from the even columns of a row to its odd ones.
    pub(crate) half: usize,
    /// Cells from row to row.
    pub(crate) pitch: usize,
}

/// Bonds of one kind: how they resist, and their rest length [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut<L, S> {
    pub(crate) law: L,
    pub(crate) rest: S,
}

/// The bonds of a sheet: each kind is there for all cells that it fits, or for none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kinds<L> {
    /// From each column to the next.
    pub(crate) along: L,
    /// From each row to the next.
    pub(crate) down: L,
    /// To the next column of the next row.
    pub(crate) falling: Option<L>,
    /// From the next column to the next row.
    pub(crate) rising: Option<L>,
}

impl<L> Kinds<L> {
    /// The same of each kind.
    pub(crate) fn map<T>(&self, of: impl Fn(&L) -> T) -> Kinds<T> {
        Kinds {
            along: of(&self.along),
            down: of(&self.down),
            falling: self.falling.as_ref().map(&of),
            rising: self.rising.as_ref().map(&of),
        }
    }
}

/// The bonds of the row that starts at `at`, and those to the next row if there is one. Where the rows are plain all their
/// points have weight 1.
#[inline(always)]
pub(crate) fn row<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize>(
    m: M,
    work: &mut W,
    view: &mut View<'_, S, D>,
    shape: &Shape,
    kinds: &Kinds<Cut<L, S>>,
    (at, has_next, is_plain): (usize, bool, bool),
) {
    let (even, odd) = (shape.columns.div_ceil(2), shape.columns / 2);
    let pass = Pass { m, shape, kinds, at, has_next };
    let width = width::<M, S>(m);
    let mut k = 0;
    while is_plain && k + width <= odd {
        pass.level::<W, D, false>(work, view, k, (even, odd));
        k += width;
    }
    while k < even {
        pass.level::<W, D, true>(work, view, k, (even, odd));
        k += width;
    }
    k = 0;
    while is_plain && k + width < even {
        pass.onward::<W, D, false>(work, view, k, even - 1);
        k += width;
    }
    while k + 1 < even {
        pass.onward::<W, D, true>(work, view, k, even - 1);
        k += width;
    }
}

struct Pass<'a, M, L, S> {
    m: M,
    shape: &'a Shape,
    kinds: &'a Kinds<Cut<L, S>>,
    /// First cell of the row.
    at: usize,
    has_next: bool,
}

impl<M: Simd, L, S: Real> Pass<'_, M, L, S> {
    /// Bonds whose ends lie in the same place of the halves.
    #[inline(always)]
    fn level<W: Work<M, S, D, L>, const D: usize, const CAREFUL: bool>(
        &self,
        work: &mut W,
        view: &mut View<'_, S, D>,
        k: usize,
        (even, odd): (usize, usize),
    ) {
        let Pass { m, shape, kinds, at, has_next } = *self;
        let rest = |cut: &Cut<L, S>| splat(m, cut.rest);
        let up_to = |count: usize| between::<M, S>(m, 0, count as isize - k as isize);
        let (evens, odds) = (up_to(even), up_to(odd));
        let places = [at + k, at + shape.half + k, at + shape.pitch + k, at + shape.pitch + shape.half + k];
        let mut e = Node::<M, S, D>::load::<CAREFUL>(m, view, places[0]);
        let mut o = Node::<M, S, D>::load::<CAREFUL>(m, view, places[1]);
        work.bond::<CAREFUL>(m, &kinds.along.law, rest(&kinds.along), &mut e, &mut o, odds);
        if has_next {
            let mut below_e = Node::<M, S, D>::load::<CAREFUL>(m, view, places[2]);
            let mut below_o = Node::<M, S, D>::load::<CAREFUL>(m, view, places[3]);
            work.bond::<CAREFUL>(m, &kinds.down.law, rest(&kinds.down), &mut e, &mut below_e, evens);
            work.bond::<CAREFUL>(m, &kinds.down.law, rest(&kinds.down), &mut o, &mut below_o, odds);
            if let Some(falling) = &kinds.falling {
                work.bond::<CAREFUL>(m, &falling.law, rest(falling), &mut e, &mut below_o, odds);
            }
            if let Some(rising) = &kinds.rising {
                work.bond::<CAREFUL>(m, &rising.law, rest(rising), &mut o, &mut below_e, odds);
            }
            below_e.keep::<W, L>(view, places[2]);
            below_o.keep::<W, L>(view, places[3]);
        }
        e.keep::<W, L>(view, places[0]);
        o.keep::<W, L>(view, places[1]);
    }

    /// Bonds that reach one place further.
    #[inline(always)]
    fn onward<W: Work<M, S, D, L>, const D: usize, const CAREFUL: bool>(
        &self,
        work: &mut W,
        view: &mut View<'_, S, D>,
        k: usize,
        count: usize,
    ) {
        let Pass { m, shape, kinds, at, has_next } = *self;
        let rest = |cut: &Cut<L, S>| splat(m, cut.rest);
        let mask = between::<M, S>(m, 0, count as isize - k as isize);
        let places = [at + k + 1, at + shape.half + k, at + shape.pitch + k + 1, at + shape.pitch + shape.half + k];
        let mut e = Node::<M, S, D>::load::<CAREFUL>(m, view, places[0]);
        let mut o = Node::<M, S, D>::load::<CAREFUL>(m, view, places[1]);
        work.bond::<CAREFUL>(m, &kinds.along.law, rest(&kinds.along), &mut o, &mut e, mask);
        if has_next && let Some(falling) = &kinds.falling {
            let mut below = Node::<M, S, D>::load::<CAREFUL>(m, view, places[2]);
            work.bond::<CAREFUL>(m, &falling.law, rest(falling), &mut o, &mut below, mask);
            below.keep::<W, L>(view, places[2]);
        }
        if has_next && let Some(rising) = &kinds.rising {
            let mut below = Node::<M, S, D>::load::<CAREFUL>(m, view, places[3]);
            work.bond::<CAREFUL>(m, &rising.law, rest(rising), &mut e, &mut below, mask);
            below.keep::<W, L>(view, places[3]);
        }
        o.keep::<W, L>(view, places[1]);
        e.keep::<W, L>(view, places[0]);
    }
}
