//! One long path, cut into pieces that are solved side by side, one a lane.
//!
//! The path's points lie row by row: piece s has the points s L, s L + 1, …, and point j of every piece lies in row j.
//! Between two pieces lies a bond that belongs to neither. Eliminating the bonds of a piece ([`super::path`] has the
//! system) leaves what they do to the bonds on both sides of it: the bond on the left is coupled to the first bond of
//! the piece, by elimination to the second, and so on to the last, so it is carried along as a second answer.
//! The bonds between the pieces, a small tridiagonal system, are solved then, and put in on the way back.
//! Source: H. H. Wang, A parallel method for tridiagonal equations, ACM Trans. Math. Softw. 7, 170 (1981).

use aligned_vec::AVec;
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask};

use super::cells::{Cells, View};
use super::lanes::{Lanes, Mask, WIDEST, add, dot, each, largest, load, scale, select, splat, store, sub};
use super::level::vectorized;
use super::path::{LEAST_PIVOT, MOST_JUMP, MOST_ROUNDS, PathLaw, node};
use super::store::Store;
use crate::sim::real::Real;
use crate::sim::vector;

/// Pieces of a path: one a lane of the widest vector, whatever the machine's.
pub(crate) const PIECES: usize = WIDEST;

/// A path in pieces.
#[derive(Clone, Debug)]
pub(crate) struct Split<S> {
    /// Points of the path.
    count: usize,
    /// Points of a piece.
    rows: usize,
    /// Rest length of the bond behind each point `[m]`, laid out like the points; 0: no bond.
    rest: AVec<S>,
    /// What the way there keeps for the way back: direction, length, answer, link, side of every bond.
    kept: AVec<S>,
}

/// A bond between two pieces, and what eliminating the pieces made of its row.
#[derive(Clone, Copy, Debug)]
struct Joint<S, const D: usize> {
    way: [S; D],
    diagonal: S,
    error: S,
    /// Coupling to the joint before.
    beside: S,
    /// How the last bond of the piece on its left depends on it.
    link: S,
    lambda: S,
}

/// How a round left the bonds within the pieces.
struct Reached<S> {
    /// One has a strain above the tolerance.
    is_off: bool,
    /// The largest pull.
    pull: S,
    /// The largest square of a move of two neighbours against each other, in rest lengths.
    jump: S,
}

/// What eliminating the pieces leaves, piece by piece.
struct Left<S> {
    /// To be taken from the diagonal of the joint on the left, and from its error.
    before: [[S; PIECES]; 2],
    /// The last bond: pivot's inverse, answer, side.
    last: [[S; PIECES]; 3],
}

impl<S: Real> Split<S> {
    /// A path with these rest lengths, from its first bond on: more than [`PIECES`] of them.
    pub(crate) fn new(rests: &[S]) -> Self {
        let count = rests.len() + 1;
        let rows = count.div_ceil(PIECES);
        let list = |size: usize| AVec::from_iter(64, std::iter::repeat_n(S::ZERO, size));
        let mut split = Split { count, rows, rest: list(rows * PIECES), kept: list(0) };
        for (i, &rest) in rests.iter().enumerate() {
            let at = split.at(i);
            split.rest[at] = rest;
        }
        split
    }

    /// The cell of a point.
    pub(crate) fn at(&self, point: usize) -> usize {
        point % self.rows * PIECES + point / self.rows
    }

    /// The first point of every piece, its cell, and how many points the piece has; they follow each other at [`PIECES`] cells.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let (count, rows) = (self.count, self.rows);
        let of = move |piece: usize| (piece * rows, piece, rows.min(count.saturating_sub(piece * rows)));
        (0..PIECES).map(of).filter(|piece| piece.2 > 0)
    }

    /// How many cells there are.
    pub(crate) fn cells(&self) -> usize {
        self.rows * PIECES
    }

    /// Bytes that it takes.
    pub(crate) fn heap_bytes(&self) -> usize {
        (self.rest.capacity() + self.kept.capacity()) * size_of::<S>()
    }

    /// Solves the path: moves the displacements of its points. Returns its largest pull, as
    /// [`path::solve`](super::path::solve).
    pub(crate) fn solve<const D: usize>(&mut self, cells: &mut Cells<S, D>, law: &PathLaw<S>) -> S {
        let mut pull = S::ZERO;
        self.kept.resize(self.cells() * (D + 4), S::ZERO);
        for _ in 0..MOST_ROUNDS {
            let mut joints = self.joints(cells, law);
            let mut left = Left { before: [[S::ZERO; PIECES]; 2], last: [[S::ZERO; PIECES]; 3] };
            let view = cells.view();
            vectorized!(m => self.there(m, &view, law, &joints, &mut left));
            self.join(cells, &mut joints, &left);
            let mut view = cells.view();
            let mut reached = vectorized!(m => self.back(m, &mut view, law, &joints, S::ONE));
            pull = pull.max(reached.pull);
            let most = S::from_f64(MOST_JUMP);
            let is_wild = reached.jump > most * most;
            if is_wild {
                // Back to a part of the way.
                let back_by = most / reached.jump.sqrt() - S::ONE;
                vectorized!(m => self.back(m, &mut view, law, &joints, back_by));
            }
            reached.is_off |= is_wild || self.are_joints_off(cells, law.tolerance);
            if law.alpha > S::ZERO || !reached.is_off {
                break;
            }
        }
        pull
    }

    /// The bonds between the pieces, as they lie.
    fn joints<const D: usize>(&self, cells: &Cells<S, D>, law: &PathLaw<S>) -> [Joint<S, D>; PIECES] {
        let [zero, one] = [S::ZERO, S::ONE];
        let none = Joint { way: [zero; D], diagonal: one, error: zero, beside: zero, link: zero, lambda: zero };
        let mut joints = [none; PIECES];
        let base = (self.rows - 1) * PIECES;
        for (piece, joint) in joints.iter_mut().enumerate().take(PIECES - 1) {
            let rest = self.rest[base + piece];
            let (a, b) = (base + piece, piece + 1);
            let sum = cells.w[a] + cells.w[b];
            let ((xa, da), (xb, db)) = (cells.get(a), cells.get(b));
            let mut e = [zero; D];
            for k in 0..D {
                e[k] = (xa[k] - xb[k]) + (da[k] - db[k]);
            }
            let length = vector::length(e);
            if rest > zero && sum > zero && length > zero {
                joint.way = vector::scale(e, one / length);
                joint.diagonal = sum + law.alpha;
                let change = vector::sub(da, db);
                let damped = vector::dot(joint.way, change) * (one - law.share);
                joint.error = (length - rest) * law.share + damped;
            }
        }
        joints
    }

    /// Whether a bond between two pieces has a strain above the tolerance.
    fn are_joints_off<const D: usize>(&self, cells: &Cells<S, D>, tolerance: S) -> bool {
        let base = (self.rows - 1) * PIECES;
        (0..PIECES - 1).any(|piece| {
            let rest = self.rest[base + piece];
            let ((xa, da), (xb, db)) = (cells.get(base + piece), cells.get(piece + 1));
            let e = vector::add(vector::sub(xa, xb), vector::sub(da, db));
            let off = (vector::dot(e, e) - rest * rest).abs();
            rest > S::ZERO
                && cells.w[base + piece] + cells.w[piece + 1] > S::ZERO
                && off > (tolerance + tolerance) * rest * rest
        })
    }

    /// Solves the bonds between the pieces.
    fn join<const D: usize>(&self, cells: &Cells<S, D>, joints: &mut [Joint<S, D>; PIECES], left: &Left<S>) {
        let floor = S::from_f64(LEAST_PIVOT);
        let base = (self.rows - 1) * PIECES;
        for s in 0..PIECES {
            let [inverse, answer, side] = left.last.map(|list| list[s]);
            // What the last bond of the piece is to the joint on its right.
            let right = -(cells.w[base + s] * vector::dot(self.last_way::<D>(s), joints[s].way));
            joints[s].diagonal -= right * right * inverse;
            joints[s].error -= right * answer;
            joints[s].beside = -(right * side);
            joints[s].link = right * inverse;
            if s > 0 {
                joints[s - 1].diagonal -= left.before[0][s];
                joints[s - 1].error -= left.before[1][s];
            }
        }
        for s in 0..PIECES {
            if s > 0 {
                let link = joints[s].beside / joints[s - 1].diagonal;
                joints[s].diagonal -= link * joints[s].beside;
                joints[s].error -= link * joints[s - 1].error;
            }
            let least = floor * (cells.w[base + s] + cells.w[(s + 1) % PIECES]);
            joints[s].diagonal = if least > S::ZERO { joints[s].diagonal.max(least) } else { S::ONE };
        }
        for s in (0..PIECES).rev() {
            let behind = if s + 1 < PIECES { joints[s + 1].beside * joints[s + 1].lambda } else { S::ZERO };
            joints[s].lambda = -(joints[s].error + behind) / joints[s].diagonal;
        }
    }

    /// Direction of the last bond of a piece.
    fn last_way<const D: usize>(&self, piece: usize) -> [S; D] {
        let mut way = [S::ZERO; D];
        for k in 0..D {
            way[k] = self.kept[self.slot::<D>(self.rows - 2, k) + piece];
        }
        way
    }

    /// Where a number of the bonds of a row is kept.
    #[inline(always)]
    fn slot<const D: usize>(&self, row: usize, number: usize) -> usize {
        (row * (D + 4) + number) * PIECES
    }

    /// Eliminates the bonds of all pieces from their first ones on.
    #[inline(always)]
    fn there<M: Simd, const D: usize>(
        &mut self,
        m: M,
        view: &View<'_, S, D>,
        law: &PathLaw<S>,
        joints: &[Joint<S, D>; PIECES],
        left: &mut Left<S>,
    ) {
        for lane in (0..PIECES).step_by(Lanes::<M, S>::LEN) {
            self.eliminate(m, view, law, joints, lane, left);
        }
    }

    #[inline(always)]
    fn eliminate<M: Simd, const D: usize>(
        &mut self,
        m: M,
        view: &View<'_, S, D>,
        law: &PathLaw<S>,
        joints: &[Joint<S, D>; PIECES],
        lane: usize,
        left: &mut Left<S>,
    ) {
        let [zero, one] = [S::ZERO, S::ONE].map(|value| splat(m, value));
        let (alpha, floor) = (splat(m, law.alpha), splat(m, S::from_f64(LEAST_PIVOT)));
        let (share, damped) = (splat(m, law.share), splat(m, S::ONE - law.share));
        let (mut x, mut d, mut w) = node::<M, S, D>(m, view, lane);
        // The bond before the first one is the joint on the left; the first one is coupled to it through `side`.
        let joint = each::<M, S, D>(m, |k| {
            let mut ways = [S::ZERO; PIECES];
            for s in 1..PIECES {
                ways[s] = joints[s - 1].way[k];
            }
            load(m, &ways, lane)
        });
        let (mut way_before, mut inverse_before, mut answer_before, mut side) = ([zero; D], zero, zero, zero);
        let (mut taken, mut taken_error) = (zero, zero);
        for row in 0..self.rows - 1 {
            let (x_next, d_next, w_next) = node::<M, S, D>(m, view, (row + 1) * PIECES + lane);
            let rest = load(m, &self.rest, row * PIECES + lane);
            let change = sub::<M, S, D>(d, d_next);
            let e = add::<M, S, D>(sub::<M, S, D>(x, x_next), change);
            let square = dot::<M, S, D>(e, e);
            let sum = w + w_next;
            let is_bond = rest.simd_gt(zero) & square.simd_gt(zero) & sum.simd_gt(zero);
            let length = is_bond.select(square.sqrt(), zero);
            let way = select::<M, S, D>(is_bond, scale::<M, S, D>(e, one / length), [zero; D]);
            let mut error = is_bond.select((length - rest) * share, zero);
            if law.share < S::ONE {
                error += dot::<M, S, D>(way, change) * damped;
            }
            let beside = -(w * dot::<M, S, D>(way_before, way));
            let link = beside * inverse_before;
            side = if row == 0 { -(w * dot::<M, S, D>(joint, way)) } else { -(link * side) };
            let pivot = is_bond.select((sum + alpha - link * beside).max(floor * sum), one);
            let inverse = one / pivot;
            let answer = (error - beside * answer_before) * inverse;
            taken += side * side * inverse;
            taken_error += side * answer;
            for k in 0..D {
                let at = self.slot::<D>(row, k) + lane;
                store::<M, S>(way[k], &mut self.kept, at);
            }
            for (number, value) in [length, answer, link, side * inverse].into_iter().enumerate() {
                let at = self.slot::<D>(row, D + number) + lane;
                store::<M, S>(value, &mut self.kept, at);
            }
            (way_before, inverse_before, answer_before) = (way, inverse, answer);
            (x, d, w) = (x_next, d_next, w_next);
        }
        store::<M, S>(taken, &mut left.before[0], lane);
        store::<M, S>(taken_error, &mut left.before[1], lane);
        store::<M, S>(inverse_before, &mut left.last[0], lane);
        store::<M, S>(answer_before, &mut left.last[1], lane);
        store::<M, S>(side * inverse_before, &mut left.last[2], lane);
    }

    /// Puts in from the last bonds back and moves points by a factor times what they should.
    #[inline(always)]
    fn back<M: Simd, const D: usize>(
        &self,
        m: M,
        view: &mut View<'_, S, D>,
        law: &PathLaw<S>,
        joints: &[Joint<S, D>; PIECES],
        factor: S,
    ) -> Reached<S> {
        let zero = splat(m, S::ZERO);
        let (mut is_off, mut pull, mut jump) = (false, zero, zero);
        for lane in (0..PIECES).step_by(Lanes::<M, S>::LEN) {
            let (off, pulled, jumped) = self.put_in(m, view, law, joints, (lane, factor));
            is_off |= off.to_bitmask() != 0;
            (pull, jump) = (pull.max(pulled), jump.max(jumped));
        }
        Reached { is_off, pull: largest::<M, S>(pull), jump: largest::<M, S>(jump) }
    }

    #[inline(always)]
    fn put_in<M: Simd, const D: usize>(
        &self,
        m: M,
        view: &mut View<'_, S, D>,
        law: &PathLaw<S>,
        joints: &[Joint<S, D>; PIECES],
        (lane, factor): (usize, S),
    ) -> (Mask<M, S>, Lanes<M, S>, Lanes<M, S>) {
        let zero = splat(m, S::ZERO);
        let twice = splat(m, law.tolerance + law.tolerance);
        let of = |pick: &dyn Fn(usize) -> S| {
            let mut list = [S::ZERO; PIECES];
            for s in 0..PIECES {
                list[s] = pick(s);
            }
            load(m, &list, lane)
        };
        let before = |s: usize| s.checked_sub(1).map_or(joints[PIECES - 1], |s| joints[s]);
        let lambda_left = of(&|s| before(s).lambda);
        let push_left = each::<M, S, D>(m, |k| of(&|s| before(s).way[k] * before(s).lambda));
        let last = self.rows - 1;
        let mut push_behind = each::<M, S, D>(m, |k| of(&|s| joints[s].way[k] * joints[s].lambda));
        let (mut lambda_behind, mut link_behind) = (of(&|s| joints[s].lambda), of(&|s| joints[s].link));
        let (mut move_behind, mut span_behind, mut rest_behind) = ([zero; D], [zero; D], zero);
        let (mut is_off, mut pull, mut jump) = (Mask::<M, S>::splat(m, false), zero, zero);
        for row in (0..=last).rev() {
            let at = row * PIECES + lane;
            let (push, span, link) = if row == 0 {
                (push_left, [zero; D], zero)
            } else {
                let kept = |number: usize| load(m, &self.kept, self.slot::<D>(row - 1, number) + lane);
                let way = each::<M, S, D>(m, kept);
                let (length, answer, link, side) = (kept(D), kept(D + 1), kept(D + 2), kept(D + 3));
                let lambda = -answer - link_behind * lambda_behind - side * lambda_left;
                lambda_behind = lambda;
                (scale::<M, S, D>(way, lambda), scale::<M, S, D>(way, length), link)
            };
            let w = load(m, view.w, at);
            let moved = scale::<M, S, D>(sub::<M, S, D>(push_behind, push), w * splat(m, factor));
            for k in 0..D {
                let d = load(m, &*view.d[k], at) + moved[k];
                store::<M, S>(d, view.d[k], at);
            }
            if row < last {
                let change = sub::<M, S, D>(moved, move_behind);
                let e = add::<M, S, D>(span_behind, change);
                let square = rest_behind * rest_behind;
                let off = (dot::<M, S, D>(e, e) - square).abs();
                let is_bond = dot::<M, S, D>(span_behind, span_behind).simd_gt(zero);
                is_off |= is_bond & off.simd_gt(twice * square);
                jump = is_bond.select(jump.max(dot::<M, S, D>(change, change) / square), jump);
            }
            if row > 0 {
                rest_behind = load(m, &self.rest, (row - 1) * PIECES + lane);
                let pulled = -(w * lambda_behind) / rest_behind;
                pull = rest_behind.simd_gt(zero).select(pull.max(pulled), pull);
            }
            (push_behind, move_behind, span_behind, link_behind) = (push, moved, span, link);
        }
        (is_off, pull, jump)
    }
}
