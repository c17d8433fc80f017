//! What stores of points have in common, in whatever order they keep them.

use crate::sim::real::Real;

/// What a substep does to displacements of points that are free: d -> keep d + fall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drift<S, const D: usize> {
    /// What drag leaves of a displacement, times the new substep over the old one `[1]`.
    pub(crate) keep: S,
    /// The new substep over the old one `[1]`: what becomes of the motion of pins.
    pub(crate) ratio: S,
    /// What gravity adds `[m]`.
    pub(crate) fall: [S; D],
}

/// Points that follow each other at equal steps, in the body's numbering and in its store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) point: usize,
    pub(crate) point_step: usize,
    pub(crate) cell: usize,
    pub(crate) cell_step: usize,
    pub(crate) count: usize,
}

/// Positions, displacements and weights of points.
///
/// A sum x + d is rounded, and what rounding takes from a position would come back as a push: bonds would correct it. So
/// it is carried over, as a part of the next displacement that is no motion.
pub(crate) trait Store<S: Real, const D: usize> {
    /// Room for `count` points, all pinned at the origin.
    fn new(count: usize) -> Self;

    /// A point gets this position at the start of the substep and this motion of the substep `[m]`.
    fn put(&mut self, at: usize, x: [S; D], motion: [S; D]);

    /// Position at the start of the substep, and displacement `[m]`.
    fn get(&self, at: usize) -> ([S; D], [S; D]);

    /// Displacement without what was carried over `[m]`.
    fn motion(&self, at: usize) -> [S; D];

    /// A point starts here and goes by this motion instead: nothing is carried over `[m]`.
    fn set(&mut self, at: usize, x: [S; D], motion: [S; D]);

    /// Bytes that it takes.
    fn heap_bytes(&self) -> usize;

    /// w/w_0 of a point; 0 = pinned.
    fn weight(&mut self, at: usize) -> &mut S;

    /// d -> keep d + fall for free points: what begins the first substep of a step.
    fn set_out(&mut self, drift: &Drift<S, D>);

    /// x += d, and d stays: what ends the last substep of a step.
    fn arrive(&mut self);

    /// Positions and motions of a run of cells, at some steps from each other.
    fn read(&self, run: &Run, visit: impl FnMut(usize, [S; D], [S; D]));

    /// x += d, then d -> keep d + fall for free points: from one substep to the next.
    fn go_on(&mut self, drift: &Drift<S, D>);
}

/// The position after a substep, what rounding took from it, and the motion that led there.
#[inline(always)]
pub(crate) fn arrive<S: Real>(x: S, d: S, carried: S) -> (S, S, S) {
    let next = x + d;
    (next, d - (next - x), d - carried)
}
