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

use fearless_simd::{Simd, SimdBase};

use super::cells::View;
use super::lanes::{Lanes, Mask, between, load, splat, width};
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

/// Bonds of one kind: how they resist, and their rest length `[m]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut<'a, L, S> {
    pub(crate) law: L,
    pub(crate) rest: S,
    /// Where bonds are gone: the rest length of each at the cell of its first point, from the first cell of the view on.
    pub(crate) rests: Option<&'a [S]>,
}

impl<L, S: Real> Cut<'_, L, S> {
    /// Rest lengths of the bonds whose first points lie from a cell on, and which of them there are. Without `CAREFUL` all are.
    #[inline(always)]
    fn rest<M: Simd, const CAREFUL: bool>(&self, m: M, at: usize, mask: Mask<M, S>) -> (Lanes<M, S>, Mask<M, S>) {
        match self.rests {
            Some(rests) if CAREFUL => {
                let rest = load(m, rests, at);
                (rest, mask & rest.simd_gt(splat(m, S::ZERO)))
            }
            _ => (splat(m, self.rest), mask),
        }
    }
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
    /// Something of each kind and of the same kind of another, if there is another.
    pub(crate) fn with<'a, A, T>(&self, other: Option<&'a Kinds<A>>, of: impl Fn(&L, Option<&'a A>) -> T) -> Kinds<T> {
        let beside = |kind: &Option<L>, beside: Option<&'a Option<A>>| {
            kind.as_ref().map(|kind| of(kind, beside.and_then(Option::as_ref)))
        };
        Kinds {
            along: of(&self.along, other.map(|other| &other.along)),
            down: of(&self.down, other.map(|other| &other.down)),
            falling: beside(&self.falling, other.map(|other| &other.falling)),
            rising: beside(&self.rising, other.map(|other| &other.rising)),
        }
    }

    /// The same of each kind.
    pub(crate) fn map<T>(&self, of: impl Fn(&L) -> T) -> Kinds<T> {
        self.with(None::<&Kinds<()>>, |kind, _| of(kind))
    }
}

/// The bonds of the row that starts at `at`, and those to the next row if there is one. Where the rows are plain all their
/// points have weight 1, and no bond is gone.
#[inline(always)]
pub(crate) fn row<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize>(
    m: M,
    work: &mut W,
    view: &mut View<'_, S, D>,
    shape: &Shape,
    kinds: &Kinds<Cut<'_, L, S>>,
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
    kinds: &'a Kinds<Cut<'a, L, S>>,
    /// First cell of the row.
    at: usize,
    has_next: bool,
}

impl<M: Simd, L, S: Real> Pass<'_, M, L, S> {
    /// Bonds of one kind whose first points lie from a cell on.
    #[inline(always)]
    fn bond<W: Work<M, S, D, L>, const D: usize, const CAREFUL: bool>(
        &self,
        work: &mut W,
        (cut, from): (&Cut<'_, L, S>, usize),
        (a, b): (&mut Node<M, S, D>, &mut Node<M, S, D>),
        mask: Mask<M, S>,
    ) {
        let (rest, mask) = cut.rest::<M, CAREFUL>(self.m, from, mask);
        work.bond::<CAREFUL>(self.m, &cut.law, rest, a, b, mask);
    }

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
        let left = |count: usize| count as isize - k as isize;
        let (evens, odds) = (between::<M, S>(m, 0, left(even)), between::<M, S>(m, 0, left(odd)));
        let places = [at + k, at + shape.half + k, at + shape.pitch + k, at + shape.pitch + shape.half + k];
        let mut e = Node::<M, S, D>::load::<CAREFUL>(m, view, places[0]);
        let mut o = Node::<M, S, D>::load::<CAREFUL>(m, view, places[1]);
        self.bond::<W, D, CAREFUL>(work, (&kinds.along, places[0]), (&mut e, &mut o), odds);
        if has_next {
            let mut below_e = Node::<M, S, D>::load::<CAREFUL>(m, view, places[2]);
            let mut below_o = Node::<M, S, D>::load::<CAREFUL>(m, view, places[3]);
            self.bond::<W, D, CAREFUL>(work, (&kinds.down, places[0]), (&mut e, &mut below_e), evens);
            self.bond::<W, D, CAREFUL>(work, (&kinds.down, places[1]), (&mut o, &mut below_o), odds);
            if let Some(falling) = &kinds.falling {
                self.bond::<W, D, CAREFUL>(work, (falling, places[0]), (&mut e, &mut below_o), odds);
            }
            if let Some(rising) = &kinds.rising {
                self.bond::<W, D, CAREFUL>(work, (rising, places[1]), (&mut o, &mut below_e), odds);
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
        let mask = between::<M, S>(m, 0, count as isize - k as isize);
        let places = [at + k + 1, at + shape.half + k, at + shape.pitch + k + 1, at + shape.pitch + shape.half + k];
        let mut e = Node::<M, S, D>::load::<CAREFUL>(m, view, places[0]);
        let mut o = Node::<M, S, D>::load::<CAREFUL>(m, view, places[1]);
        self.bond::<W, D, CAREFUL>(work, (&kinds.along, places[1]), (&mut o, &mut e), mask);
        if has_next && let Some(falling) = &kinds.falling {
            let mut below = Node::<M, S, D>::load::<CAREFUL>(m, view, places[2]);
            self.bond::<W, D, CAREFUL>(work, (falling, places[1]), (&mut o, &mut below), mask);
            below.keep::<W, L>(view, places[2]);
        }
        if has_next && let Some(rising) = &kinds.rising {
            let mut below = Node::<M, S, D>::load::<CAREFUL>(m, view, places[3]);
            self.bond::<W, D, CAREFUL>(work, (rising, places[0]), (&mut e, &mut below), mask);
            below.keep::<W, L>(view, places[3]);
        }
        o.keep::<W, L>(view, places[1]);
        e.keep::<W, L>(view, places[0]);
    }
}
