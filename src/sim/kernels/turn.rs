//! Rows side by side: what lies along rows is turned, so that each row gets a lane.

use fearless_simd::{Simd, SimdBase};

use super::cells::{Cells, View};
use super::lanes::{Lanes, Mask, WIDEST, between, load, splat, store};
use super::path::Strip;
use super::rows::Shape;
use crate::sim::real::Real;

/// Rows from `first` on, one a lane, column after column; the view begins at row 0.
pub(crate) struct Turned<'a, M, S> {
    pub(crate) m: M,
    pub(crate) shape: &'a Shape,
    pub(crate) first: usize,
    /// Of every bond `[m]`.
    pub(crate) rest: S,
    /// Where bonds are gone: that of each, at the cell of its first point.
    pub(crate) rests: Option<&'a [S]>,
}

impl<M: Simd, S: Real> Turned<'_, M, S> {
    fn count(&self) -> usize {
        Lanes::<M, S>::LEN.min(self.shape.rows - self.first)
    }

    /// Copies the rows to `to`, where column c of all of them begins at c times the width of a vector.
    #[inline(always)]
    pub(crate) fn read<const D: usize>(&self, from: &View<'_, S, D>, to: &mut Cells<S, D>) {
        for axis in 0..D {
            self.turn(from.x[axis], &mut to.x[axis]);
            self.turn(&*from.d[axis], &mut to.d[axis]);
        }
        self.turn(from.w, &mut to.w);
    }

    #[inline(always)]
    fn turn(&self, from: &[S], to: &mut [S]) {
        let (count, width) = (self.count(), Lanes::<M, S>::LEN);
        for parity in 0..2 {
            for k in (0..(self.shape.columns + 1 - parity) / 2).step_by(width) {
                let mut rows = [splat(self.m, S::ZERO); WIDEST];
                for lane in 0..width {
                    if lane < count {
                        rows[lane] = load(self.m, from, self.cell(lane, parity, k));
                    }
                }
                let columns = transpose::<M, S>(rows);
                for place in 0..width {
                    store::<M, S>(columns[place], to, (2 * (k + place) + parity) * width);
                }
            }
        }
    }

    /// Copies displacements back.
    #[inline(always)]
    pub(crate) fn write<const D: usize>(&self, from: &Cells<S, D>, to: &mut View<'_, S, D>) {
        let (count, width) = (self.count(), Lanes::<M, S>::LEN);
        for axis in 0..D {
            for parity in 0..2 {
                for k in (0..(self.shape.columns + 1 - parity) / 2).step_by(width) {
                    let mut columns = [splat(self.m, S::ZERO); WIDEST];
                    for place in 0..width {
                        columns[place] = load(self.m, &from.d[axis], (2 * (k + place) + parity) * width);
                    }
                    let rows = transpose::<M, S>(columns);
                    for lane in 0..width {
                        if lane < count {
                            store::<M, S>(rows[lane], to.d[axis], self.cell(lane, parity, k));
                        }
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn cell(&self, lane: usize, parity: usize, k: usize) -> usize {
        (self.first + lane) * self.shape.pitch + parity * self.shape.half + k
    }
}

/// As many vectors as lanes, and what is not used.
type Block<M, S> = [Lanes<M, S>; WIDEST];

/// Lane j of vector i goes to lane i of vector j, for as many vectors as lanes: by interleaving the first half of them
/// with the second as many times as doubling leads from one lane to all.
#[inline(always)]
fn transpose<M: Simd, S: Real>(block: Block<M, S>) -> Block<M, S> {
    let width = Lanes::<M, S>::LEN;
    let once = if width > 1 { interleave::<M, S>(block) } else { block };
    let twice = if width > 2 { interleave::<M, S>(once) } else { once };
    let thrice = if width > 4 { interleave::<M, S>(twice) } else { twice };
    if width > 8 { interleave::<M, S>(thrice) } else { thrice }
}

#[inline(always)]
fn interleave<M: Simd, S: Real>(block: Block<M, S>) -> Block<M, S> {
    let half = Lanes::<M, S>::LEN / 2;
    let mut woven = block;
    for place in 0..half {
        woven[2 * place] = block[place].zip_low(block[place + half]);
        woven[2 * place + 1] = block[place].zip_high(block[place + half]);
    }
    woven
}

impl<M: Simd, S: Real> Strip<M, S> for Turned<'_, M, S> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.shape.columns
    }

    #[inline(always)]
    fn at(&self, k: usize) -> usize {
        k * Lanes::<M, S>::LEN
    }

    #[inline(always)]
    fn lanes(&self, _: usize) -> Mask<M, S> {
        between::<M, S>(self.m, 0, (self.shape.rows - self.first) as isize)
    }

    #[inline(always)]
    fn rest(&self, k: usize) -> Lanes<M, S> {
        let Some(rests) = self.rests else { return splat(self.m, self.rest) };
        let mut list = [self.rest; WIDEST];
        for lane in 0..self.count() {
            list[lane] = rests[self.cell(lane, k % 2, k / 2)];
        }
        load(self.m, &list, 0)
    }
}
