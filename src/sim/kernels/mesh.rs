//! Sweeps over any mesh: bonds of a colour share no point, so that a vector of them is gathered, corrected and
//! scattered.

use fearless_simd::{Simd, SimdBase};

use super::lanes::{Lanes, between, load, splat};
use super::nodes::Nodes;
use super::pair::{Node, Work};
use crate::sim::real::Real;

/// Bonds of one colour that one law serves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Colour<'a, S> {
    /// The points of each bond; no point twice.
    pub(crate) ends: &'a [[u32; 2]],
    /// Rest length of each bond [m].
    pub(crate) rests: Rests<'a, S>,
    /// All points have weight 1.
    pub(crate) is_plain: bool,
}

/// Rest lengths of a row of bonds [m].
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rests<'a, S> {
    /// All the same.
    Same(S),
    /// One a bond.
    Each(&'a [S]),
}

/// Does some work with every bond of a colour.
#[inline(always)]
pub(crate) fn colour<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize>(
    m: M,
    work: &mut W,
    nodes: &mut Nodes<S, D>,
    law: &L,
    colour: &Colour<'_, S>,
) {
    if colour.is_plain {
        all::<M, S, L, W, D, false>(m, work, nodes, law, colour);
    } else {
        all::<M, S, L, W, D, true>(m, work, nodes, law, colour);
    }
}

#[inline(always)]
fn all<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize, const WEIGHTED: bool>(
    m: M,
    work: &mut W,
    nodes: &mut Nodes<S, D>,
    law: &L,
    colour: &Colour<'_, S>,
) {
    let width = Lanes::<M, S>::LEN;
    let whole = colour.ends.len() / width * width;
    for at in (0..whole).step_by(width) {
        some::<M, S, L, W, D, WEIGHTED, false>(m, work, nodes, law, colour, (at, width));
    }
    if whole < colour.ends.len() {
        some::<M, S, L, W, D, WEIGHTED, true>(m, work, nodes, law, colour, (whole, colour.ends.len() - whole));
    }
}

/// `count` bonds from `at` on. Lanes beyond take the first one's place, and nothing is done with them.
#[inline(always)]
fn some<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize, const WEIGHTED: bool, const LAST: bool>(
    m: M,
    work: &mut W,
    nodes: &mut Nodes<S, D>,
    law: &L,
    colour: &Colour<'_, S>,
    (at, count): (usize, usize),
) {
    let ends = &colour.ends[at..at + count];
    let place = |lane: usize| if LAST && lane >= count { 0 } else { lane };
    let mut a = gather::<M, S, D, WEIGHTED>(m, nodes, |lane| ends[place(lane)][0]);
    let mut b = gather::<M, S, D, WEIGHTED>(m, nodes, |lane| ends[place(lane)][1]);
    let rest = match colour.rests {
        Rests::Same(rest) => splat(m, rest),
        Rests::Each(list) if LAST => {
            let mut padded = [list[at]; super::lanes::WIDEST];
            padded[..count].copy_from_slice(&list[at..at + count]);
            load(m, &padded, 0)
        }
        Rests::Each(list) => load(m, list, at),
    };
    work.bond::<WEIGHTED, LAST>(m, law, rest, &mut a, &mut b, between::<M, S>(m, 0, count as isize));
    if W::MOVES {
        nodes.scatter::<M>(a.d, count, |lane| ends[lane][0]);
        nodes.scatter::<M>(b.d, count, |lane| ends[lane][1]);
    }
}

#[inline(always)]
fn gather<M: Simd, S: Real, const D: usize, const WEIGHTED: bool>(
    m: M,
    nodes: &Nodes<S, D>,
    of: impl Fn(usize) -> u32,
) -> Node<M, S, D> {
    let w = if WEIGHTED { weights(m, nodes, &of) } else { splat(m, S::ONE) };
    let (x, d) = nodes.gather(m, of);
    Node { x, d, w }
}

#[inline(always)]
fn weights<M: Simd, S: Real, const D: usize>(m: M, nodes: &Nodes<S, D>, of: impl Fn(usize) -> u32) -> Lanes<M, S> {
    let mut list = [S::ZERO; super::lanes::WIDEST];
    for lane in 0..Lanes::<M, S>::LEN {
        list[lane] = nodes.w[of(lane) as usize];
    }
    load(m, &list, 0)
}
