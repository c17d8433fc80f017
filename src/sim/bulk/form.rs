//! What the bodies of all forms can do.

use super::Way;
use super::spec::Substep;
pub(crate) use crate::sim::kernels::store::Run;
use crate::sim::kernels::store::{Drift, Store};
use crate::sim::real::Real;

/// The structure of a large body: where its points lie in a store, and how its bonds are taken.
///
/// A form holds no state of motion: that lies in the store.
pub(crate) trait Form<S: Real, const D: usize> {
    /// How it keeps its points.
    type Store: Store<S, D>;

    /// How many places its points and their padding take.
    fn cells(&self) -> usize;

    /// Calls `visit` with rows of points that together are all.
    fn runs(&self, visit: impl FnMut(Run));

    /// Calls `visit` with every point, counted within the body, and its place in the store.
    #[inline(always)]
    fn each(&self, mut visit: impl FnMut(usize, usize)) {
        self.runs(|run| {
            for i in 0..run.count {
                visit(run.point + i * run.point_step, run.cell + i * run.cell_step);
            }
        });
    }

    /// Looks at the weights: the store has been given them.
    fn weigh(&mut self, store: &mut Self::Store);

    /// Takes `count` substeps without anything from outside: all but the arrival.
    ///
    /// The bodies of some forms do not wait for each other.
    fn run(
        &mut self,
        store: &mut Self::Store,
        way: Way,
        step: &Substep,
        (first, next): (&Drift<S, D>, &Drift<S, D>),
        count: u32,
    ) {
        store.set_out(first);
        for substep in 0..count {
            if substep > 0 {
                store.go_on(next);
            }
            self.project(store, way, step);
        }
    }

    /// The bonds of one substep.
    fn project(&mut self, store: &mut Self::Store, way: Way, step: &Substep) {
        match way {
            Way::Paths => self.solve(store, step),
            Way::Sweeps(sweeps) => (0..sweeps).for_each(|_| self.sweep(store, step)),
        }
    }

    /// Moves displacements by one sweep over all bonds.
    fn sweep(&mut self, store: &mut Self::Store, step: &Substep);

    /// Moves displacements by one pass of the path method over all bonds.
    fn solve(&mut self, store: &mut Self::Store, step: &Substep);

    /// The largest |e.e/rest^2 - 1| of any bond, about twice its strain.
    fn stretch(&self, store: &mut Self::Store) -> S;

    /// Bytes that it takes, without the store.
    fn heap_bytes(&self) -> usize;

    /// How many bonds it has.
    fn bonds(&self) -> usize;
}
