//! Sweeps over equal small bodies, one a lane: no point is shared between lanes, so bonds are taken one after another.
//!
//! Bodies go in blocks of as many as the widest vector has lanes. The cells of a block lie point by point, each with the
//! point of every body of the block.

use fearless_simd::{Simd, SimdBase};

use super::cells::View;
use super::lanes::{Lanes, WIDEST, between, splat};
use super::pair::{Node, Work};
use crate::sim::real::Real;

/// A bond of every body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link<L, S> {
    /// Its ends, counted within the body.
    pub(crate) ends: [u32; 2],
    pub(crate) law: L,
    /// Rest length `[m]`.
    pub(crate) rest: S,
    /// Both ends have weight 1 in every body.
    pub(crate) is_plain: bool,
}

/// Does some work with all bonds of the block that the view shows, in their order; it has `count` bodies.
#[inline(always)]
pub(crate) fn block<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize>(
    m: M,
    work: &mut W,
    view: &mut View<'_, S, D>,
    links: &[Link<L, S>],
    count: usize,
) {
    for link in links {
        for lane in (0..count).step_by(Lanes::<M, S>::LEN) {
            if link.is_plain && count == WIDEST {
                bond::<M, S, L, W, D, false>(m, work, view, link, (lane, count));
            } else {
                bond::<M, S, L, W, D, true>(m, work, view, link, (lane, count));
            }
        }
    }
}

#[inline(always)]
fn bond<M: Simd, S: Real, L, W: Work<M, S, D, L>, const D: usize, const CAREFUL: bool>(
    m: M,
    work: &mut W,
    view: &mut View<'_, S, D>,
    link: &Link<L, S>,
    (lane, count): (usize, usize),
) {
    let [a, b] = link.ends.map(|end| end as usize * WIDEST + lane);
    let mut from = Node::<M, S, D>::load::<CAREFUL>(m, view, a);
    let mut to = Node::<M, S, D>::load::<CAREFUL>(m, view, b);
    let bodies = between::<M, S>(m, 0, count as isize - lane as isize);
    work.bond::<CAREFUL>(m, &link.law, splat(m, link.rest), &mut from, &mut to, bodies);
    from.keep::<W, L>(view, a);
    to.keep::<W, L>(view, b);
}
