//! The state of points of any mesh: all that a bond reads of a point lies together.

use fearless_simd::{Simd, SimdBase};

use super::lanes::{Lanes, Vectors, WIDEST, load, splat};
use super::store::{Drift, Run, Store, arrive};
use crate::sim::real::Real;
use crate::sim::vector::{add, sub};

/// A point: x at the start of the substep and its displacement `[m]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point<S, const D: usize> {
    pub(crate) x: [S; D],
    pub(crate) d: [S; D],
}

/// Points in memory order, and their weights.
#[derive(Clone, Debug)]
pub(crate) struct Nodes<S, const D: usize> {
    pub(crate) points: Vec<Point<S, D>>,
    /// The part of each displacement that was carried over `[m]`.
    carried: Vec<[S; D]>,
    /// w/w_0; 0 = pinned.
    pub(crate) w: Vec<S>,
}

impl<S: Real, const D: usize> Store<S, D> for Nodes<S, D> {
    fn new(count: usize) -> Self {
        let point = Point { x: [S::ZERO; D], d: [S::ZERO; D] };
        Nodes { points: vec![point; count], carried: vec![[S::ZERO; D]; count], w: vec![S::ZERO; count] }
    }

    #[inline(always)]
    fn put(&mut self, at: usize, x: [S; D], motion: [S; D]) {
        if self.points[at].x != x {
            self.carried[at] = [S::ZERO; D];
        }
        self.points[at] = Point { x, d: add(motion, self.carried[at]) };
    }

    #[inline(always)]
    fn get(&self, at: usize) -> ([S; D], [S; D]) {
        (self.points[at].x, self.points[at].d)
    }

    #[inline(always)]
    fn motion(&self, at: usize) -> [S; D] {
        sub(self.points[at].d, self.carried[at])
    }

    fn heap_bytes(&self) -> usize {
        (3 * D + 1) * self.w.capacity() * size_of::<S>()
    }

    fn set(&mut self, at: usize, x: [S; D], motion: [S; D]) {
        (self.points[at], self.carried[at]) = (Point { x, d: motion }, [S::ZERO; D]);
    }

    #[inline(always)]
    fn weight(&mut self, at: usize) -> &mut S {
        &mut self.w[at]
    }

    fn set_out(&mut self, drift: &Drift<S, D>) {
        for ((point, &carried), &w) in self.points.iter_mut().zip(&self.carried).zip(&self.w) {
            for k in 0..D {
                let motion = point.d[k] - carried[k];
                let motion = if w > S::ZERO { motion * drift.keep + drift.fall[k] } else { motion * drift.ratio };
                point.d[k] = motion + carried[k];
            }
        }
    }

    fn arrive(&mut self) {
        for (point, carried) in self.points.iter_mut().zip(&mut self.carried) {
            for k in 0..D {
                let (to, owed, motion) = arrive(point.x[k], point.d[k], carried[k]);
                (point.x[k], carried[k], point.d[k]) = (to, owed, motion + owed);
            }
        }
    }

    #[inline(always)]
    fn read(&self, run: &Run, mut visit: impl FnMut(usize, [S; D], [S; D])) {
        for i in 0..run.count {
            let cell = run.cell + i * run.cell_step;
            visit(i, self.points[cell].x, sub(self.points[cell].d, self.carried[cell]));
        }
    }

    fn go_on(&mut self, drift: &Drift<S, D>) {
        for ((point, carried), &w) in self.points.iter_mut().zip(&mut self.carried).zip(&self.w) {
            for k in 0..D {
                let (to, owed, motion) = arrive(point.x[k], point.d[k], carried[k]);
                let motion = if w > S::ZERO { motion * drift.keep + drift.fall[k] } else { motion };
                (point.x[k], carried[k], point.d[k]) = (to, owed, motion + owed);
            }
        }
    }
}

/// Numbers of the points of a vector of bonds.
type Numbers<S> = [S; 6 * WIDEST];

impl<S: Real, const D: usize> Nodes<S, D> {
    /// The points that `of` names, one for each lane.
    #[inline(always)]
    pub(crate) fn gather<M: Simd>(&self, m: M, of: impl Fn(usize) -> u32) -> (Vectors<M, S, D>, Vectors<M, S, D>) {
        let width = Lanes::<M, S>::LEN;
        let mut numbers: Numbers<S> = [S::ZERO; 6 * WIDEST];
        for lane in 0..width {
            let point = &self.points[of(lane) as usize];
            for k in 0..D {
                numbers[2 * D * lane + k] = point.x[k];
                numbers[2 * D * lane + D + k] = point.d[k];
            }
        }
        let zero = splat(m, S::ZERO);
        let (mut x, mut d) = ([zero; D], [zero; D]);
        if D == 2 {
            let part = |k: usize| load(m, &numbers, k * width);
            let (even, odd) = part(0).deinterleave(part(1));
            let (even_behind, odd_behind) = part(2).deinterleave(part(3));
            (x[0], d[0]) = even.deinterleave(even_behind);
            (x[1], d[1]) = odd.deinterleave(odd_behind);
        } else {
            let mut turned: Numbers<S> = [S::ZERO; 6 * WIDEST];
            for lane in 0..width {
                for k in 0..2 * D {
                    turned[k * width + lane] = numbers[2 * D * lane + k];
                }
            }
            for k in 0..D {
                x[k] = load(m, &turned, k * width);
                d[k] = load(m, &turned, (D + k) * width);
            }
        }
        (x, d)
    }

    /// Gives the displacements of the first `count` lanes to the points that `of` names.
    #[inline(always)]
    pub(crate) fn scatter<M: Simd>(&mut self, d: Vectors<M, S, D>, count: usize, of: impl Fn(usize) -> u32) {
        let width = Lanes::<M, S>::LEN;
        let mut numbers: Numbers<S> = [S::ZERO; 6 * WIDEST];
        if D == 2 {
            let (low, high) = d[0].interleave(d[1]);
            low.store_slice(&mut numbers[..width]);
            high.store_slice(&mut numbers[width..2 * width]);
            for lane in 0..count {
                self.points[of(lane) as usize].d[0] = numbers[2 * lane];
                self.points[of(lane) as usize].d[1] = numbers[2 * lane + 1];
            }
        } else {
            for k in 0..D {
                d[k].store_slice(&mut numbers[k * width..(k + 1) * width]);
            }
            for lane in 0..count {
                for k in 0..D {
                    self.points[of(lane) as usize].d[k] = numbers[k * width + lane];
                }
            }
        }
    }
}
