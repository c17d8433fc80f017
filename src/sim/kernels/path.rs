//! Paths of bonds solved at once, one path a lane: the path method.
//!
//! A path is a row of points p_0, p_1, … with a bond between each and the next. With n_k the direction of bond k from
//! p_k+1 to p_k and C_k = |p_k - p_k+1| - rest_k, multipliers lambda that bring all C to 0 at once, to first order, obey
//!
//! ```text
//! -w_k n_k-1.n_k lambda_k-1 + (w_k + w_k+1 + alpha) lambda_k - w_k+1 n_k.n_k+1 lambda_k+1 = -C_k
//! ```
//!
//! which is tridiagonal: eliminated from the first bond on and put in from the last one back. Points then move by
//! w_k (n_k lambda_k - n_k-1 lambda_k-1). Rounds of this (Newton's method) follow where a bond is still off.
//! A taut path that is pinned at both ends has more bonds than its points can move for: pivots have a floor.

use aligned_vec::AVec;
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask};

use super::cells::View;
use super::lanes::{Lanes, Mask, Vectors, add, dot, each, load, scale, select, splat, store, sub};
use crate::sim::real::Real;

/// Least pivot as a share of w_k + w_k+1: below, a taut path pinned at both ends has no answer in `f32`; a larger one
/// makes taut paths soft.
pub(crate) const LEAST_PIVOT: f64 = 1e-3;
/// Farthest that two neighbours may move against each other in a round, in rest lengths: directions are of no use beyond.
pub(crate) const MOST_JUMP: f64 = 0.25;
/// Rounds after which a path goes on with what it has.
pub(crate) const MOST_ROUNDS: u32 = 8;

/// The rest length of a bond that is gone: its lane is idle.
pub(crate) const GONE: f64 = f64::NEG_INFINITY;

/// Where the points of paths lie that are solved side by side.
pub(crate) trait Strip<M: Simd, S: Real> {
    /// Points of the longest path.
    fn len(&self) -> usize;
    /// The cell of point `k` of the path in lane 0; the other lanes follow it.
    fn at(&self, k: usize) -> usize;
    /// The lanes whose path has a point `k`.
    fn lanes(&self, k: usize) -> Mask<M, S>;
    /// Rest lengths of bond `k` of the paths `[m]`, > 0; [`GONE`] where there is none any more.
    fn rest(&self, k: usize) -> Lanes<M, S>;
}

/// How the bonds of paths resist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathLaw<S> {
    /// 1/(stiffness h^2 w_0 (1 + gamma)) `[1]`, gamma = damping/(stiffness h); 0 is rigid.
    pub(crate) alpha: S,
    /// 1/(1 + gamma).
    pub(crate) share: S,
    /// Strain above which another round follows `[1]`; springs take one.
    pub(crate) tolerance: S,
}

/// What a solve keeps from its way there for its way back; grows to the longest path.
#[derive(Clone, Debug)]
pub(crate) struct Scratch<S>(AVec<S>);

impl<S> Scratch<S> {
    /// Bytes that it takes.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.0.capacity() * size_of::<S>()
    }
}

impl<S: Real> Default for Scratch<S> {
    fn default() -> Self {
        Scratch(AVec::new(64))
    }
}

/// One bond of a path on the way back.
struct Bond<M: Simd, S: Real, const D: usize> {
    /// n.
    way: Vectors<M, S, D>,
    length: Lanes<M, S>,
    /// C/pivot, with what the elimination added to C.
    answer: Lanes<M, S>,
    /// How the multiplier before depends on this one.
    link: Lanes<M, S>,
}

impl<M: Simd, S: Real, const D: usize> Bond<M, S, D> {
    /// Numbers that a bond takes, in vectors.
    const SIZE: usize = D + 3;

    #[inline(always)]
    fn save(&self, scratch: &mut [S], k: usize) {
        let width = Lanes::<M, S>::LEN;
        let at = k * Self::SIZE * width;
        for axis in 0..D {
            store::<M, S>(self.way[axis], scratch, at + axis * width);
        }
        store::<M, S>(self.length, scratch, at + D * width);
        store::<M, S>(self.answer, scratch, at + (D + 1) * width);
        store::<M, S>(self.link, scratch, at + (D + 2) * width);
    }

    #[inline(always)]
    fn read(m: M, scratch: &[S], k: usize) -> Self {
        let width = Lanes::<M, S>::LEN;
        let at = k * Self::SIZE * width;
        Bond {
            way: each::<M, S, D>(m, |axis| load(m, scratch, at + axis * width)),
            length: load(m, scratch, at + D * width),
            answer: load(m, scratch, at + (D + 1) * width),
            link: load(m, scratch, at + (D + 2) * width),
        }
    }
}

/// Solves the paths of a strip: moves the displacements of their points. Returns each path's largest pull: w times
/// multiplier over rest length `[1]`. Across its direction a bond that pulls holds its ends like a spring of that stiffness.
#[inline(always)]
pub(crate) fn solve<M: Simd, S: Real, T: Strip<M, S>, const D: usize>(
    m: M,
    view: &mut View<'_, S, D>,
    strip: &T,
    law: &PathLaw<S>,
    scratch: &mut Scratch<S>,
) -> Lanes<M, S> {
    let bonds = strip.len().saturating_sub(1);
    let needed = bonds * Bond::<M, S, D>::SIZE * Lanes::<M, S>::LEN;
    if scratch.0.len() < needed {
        scratch.0.resize(needed, S::ZERO);
    }
    let mut active = Mask::<M, S>::splat(m, true);
    let mut pull = splat(m, S::ZERO);
    for _ in 0..MOST_ROUNDS {
        there(m, view, strip, law, &mut scratch.0);
        let [zero, one] = [S::ZERO, S::ONE].map(|value| splat(m, value));
        let (is_off, jump, pulled) = back(m, view, strip, law, active.select(one, zero), &scratch.0);
        let most = splat(m, S::from_f64(MOST_JUMP));
        let is_wild = active & jump.simd_gt(most * most);
        if is_wild.to_bitmask() != 0 {
            // Back to a part of the way.
            let back_by = is_wild.select(most / jump.sqrt() - one, zero);
            back(m, view, strip, law, back_by, &scratch.0);
        }
        pull = pull.max(pulled);
        active &= is_off | is_wild;
        if law.alpha > S::ZERO || active.to_bitmask() == 0 {
            return pull;
        }
    }
    pull
}

/// Eliminates from the first bond on.
#[inline(always)]
fn there<M: Simd, S: Real, T: Strip<M, S>, const D: usize>(
    m: M,
    view: &View<'_, S, D>,
    strip: &T,
    law: &PathLaw<S>,
    scratch: &mut [S],
) {
    let [zero, one] = [S::ZERO, S::ONE].map(|value| splat(m, value));
    let (alpha, floor) = (splat(m, law.alpha), splat(m, S::from_f64(LEAST_PIVOT)));
    let (share, damped) = (splat(m, law.share), splat(m, S::ONE - law.share));
    let (mut x, mut d, mut w) = node::<M, S, D>(m, view, strip.at(0));
    let mut lanes = strip.lanes(0);
    // The bond before the first one: none.
    let (mut way_before, mut inverse_before, mut answer_before) = ([zero; D], zero, zero);
    for k in 0..strip.len() - 1 {
        let (x_next, d_next, w_next) = node::<M, S, D>(m, view, strip.at(k + 1));
        let lanes_next = strip.lanes(k + 1);
        let change = sub::<M, S, D>(d, d_next);
        let e = add::<M, S, D>(sub::<M, S, D>(x, x_next), change);
        let square = dot::<M, S, D>(e, e);
        let sum = w + w_next;
        let rest = strip.rest(k);
        // No bond where there is no point, where two pins leave nothing to move, where length 0 has no direction, and where it is gone.
        let is_bond = lanes & lanes_next & square.simd_gt(zero) & sum.simd_gt(zero) & rest.simd_gt(zero);
        let length = is_bond.select(square.sqrt(), zero);
        let way = select::<M, S, D>(is_bond, scale::<M, S, D>(e, one / length), [zero; D]);
        let mut error = is_bond.select((length - rest) * share, zero);
        if law.share < S::ONE {
            error += dot::<M, S, D>(way, change) * damped;
        }
        let beside = -(w * dot::<M, S, D>(way_before, way));
        let link = beside * inverse_before;
        let pivot = is_bond.select((sum + alpha - link * beside).max(floor * sum), one);
        let inverse = one / pivot;
        let answer = (error - beside * answer_before) * inverse;
        Bond::<M, S, D> { way, length, answer, link }.save(scratch, k);
        (way_before, inverse_before, answer_before) = (way, inverse, answer);
        (x, d, w, lanes) = (x_next, d_next, w_next, lanes_next);
    }
}

/// Puts in from the last bond back and moves points by a factor times what they should. Returns the lanes where a bond is
/// left with a strain above the tolerance, the largest square of a move of two neighbours against each other, in rest
/// lengths, and the largest pull.
#[inline(always)]
fn back<M: Simd, S: Real, T: Strip<M, S>, const D: usize>(
    m: M,
    view: &mut View<'_, S, D>,
    strip: &T,
    law: &PathLaw<S>,
    factor: Lanes<M, S>,
    scratch: &[S],
) -> (Mask<M, S>, Lanes<M, S>, Lanes<M, S>) {
    let zero = splat(m, S::ZERO);
    let twice = splat(m, law.tolerance + law.tolerance);
    let last = strip.len() - 1;
    // Of the bond behind: its push on the point before it, how the point behind it moved, how it lay.
    let (mut push_behind, mut move_behind, mut lambda_behind) = ([zero; D], [zero; D], zero);
    let (mut link_behind, mut length_behind, mut span_behind) = (zero, zero, [zero; D]);
    let (mut is_off, mut jump, mut pull) = (Mask::<M, S>::splat(m, false), zero, zero);
    for k in (0..=last).rev() {
        // Point k: behind it lies bond k, before it bond k - 1.
        let (push, span, link, length) = match k {
            0 => ([zero; D], [zero; D], zero, zero),
            _ => {
                let bond = Bond::<M, S, D>::read(m, scratch, k - 1);
                let lambda = -bond.answer - link_behind * lambda_behind;
                lambda_behind = lambda;
                let span = scale::<M, S, D>(bond.way, bond.length);
                (scale::<M, S, D>(bond.way, lambda), span, bond.link, bond.length)
            }
        };
        let at = strip.at(k);
        let w = load(m, view.w, at);
        if k > 0 {
            pull = pull.max(-(w * lambda_behind) * (splat(m, S::ONE) / strip.rest(k - 1)));
        }
        let moved = scale::<M, S, D>(sub::<M, S, D>(push_behind, push), w * factor);
        for axis in 0..D {
            let d = load(m, &*view.d[axis], at) + moved[axis];
            store::<M, S>(d, view.d[axis], at);
        }
        if k < last {
            let change = sub::<M, S, D>(moved, move_behind);
            let e = add::<M, S, D>(span_behind, change);
            let rest = strip.rest(k);
            let square = rest * rest;
            let off = (dot::<M, S, D>(e, e) - square).abs();
            jump = jump.max(dot::<M, S, D>(change, change) / square);
            is_off |= length_behind.simd_gt(zero) & off.simd_gt(twice * square);
        }
        (push_behind, move_behind, span_behind) = (push, moved, span);
        (link_behind, length_behind) = (link, length);
    }
    (is_off, jump, pull)
}

/// Position, displacement and weight of points side by side.
#[inline(always)]
pub(crate) fn node<M: Simd, S: Real, const D: usize>(
    m: M,
    view: &View<'_, S, D>,
    at: usize,
) -> (Vectors<M, S, D>, Vectors<M, S, D>, Lanes<M, S>) {
    (
        each::<M, S, D>(m, |k| load(m, view.x[k], at)),
        each::<M, S, D>(m, |k| load(m, &*view.d[k], at)),
        load(m, view.w, at),
    )
}
