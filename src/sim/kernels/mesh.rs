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
    /// Rest length of each bond `[m]`.
    pub(crate) rests: Rests<'a, S>,
    /// All points have weight 1.
    pub(crate) is_plain: bool,
}

/// Rest lengths of a row of bonds `[m]`.
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
    let width = Lanes::<M, S>::LEN;
    for at in (0..colour.ends.len()).step_by(width) {
        let count = width.min(colour.ends.len() - at);
        if colour.is_plain && count == width {
            some::<M, S, L, W, D, false>(m, work, nodes, law, colour, (at, width));
        } else {
            some::<M, S, L, W, D, true>(m, work, nodes, law, colour, (at, count));
        }
    }
}

/// `count` bonds from `at` on. Lanes beyond take the first one's place, and nothing is done with them.
#[inline(always)]
fn some<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize, const CAREFUL: bool>(
    m: M,
    work: &mut W,
    nodes: &mut Nodes<S, D>,
    law: &L,
    colour: &Colour<'_, S>,
    (at, count): (usize, usize),
) {
    let ends = &colour.ends[at..at + count];
    let place = |lane: usize| if CAREFUL && lane >= count { 0 } else { lane };
    let mut a = gather::<M, S, D, CAREFUL>(m, nodes, |lane| ends[place(lane)][0]);
    let mut b = gather::<M, S, D, CAREFUL>(m, nodes, |lane| ends[place(lane)][1]);
    let rest = match colour.rests {
        Rests::Same(rest) => splat(m, rest),
        Rests::Each(list) if CAREFUL => {
            let mut padded = [list[at]; super::lanes::WIDEST];
            padded[..count].copy_from_slice(&list[at..at + count]);
            load(m, &padded, 0)
        }
        Rests::Each(list) => load(m, list, at),
    };
    work.bond::<CAREFUL>(m, law, rest, &mut a, &mut b, between::<M, S>(m, 0, count as isize));
    if W::MOVES {
        nodes.scatter::<M>(a.d, count, |lane| ends[lane][0]);
        nodes.scatter::<M>(b.d, count, |lane| ends[lane][1]);
    }
}

#[inline(always)]
fn gather<M: Simd, S: Real, const D: usize, const CAREFUL: bool>(
    m: M,
    nodes: &Nodes<S, D>,
    of: impl Fn(usize) -> u32,
) -> Node<M, S, D> {
    let w = if CAREFUL { weights(m, nodes, &of) } else { splat(m, S::ONE) };
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
