//! What the bodies of all forms can do.

use super::Way;
use super::spec::{Start, Substep};
pub(crate) use crate::sim::kernels::store::Run;
use crate::sim::kernels::store::Store;
use crate::sim::real::Real;

/// Share of the bonds of a body that may be idle.
pub(crate) const MOST_IDLE: f64 = 0.125;

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

    /// What bonds at pins bear of the weight, where nothing holds them across their direction: mass over rest length, for
    /// each pin [1/(w_0 m)]. 0 where there are no pins.
    fn bears(&self, _: &mut Self::Store) -> f64 {
        0.0
    }

    /// Takes `count` substeps without anything from outside: all but the arrival. Returns the largest pull.
    ///
    /// The bodies of some forms do not wait for each other.
    fn run(&mut self, store: &mut Self::Store, way: Way, (first, next): (&Start<S, D>, &Start<S, D>), count: u32) -> S {
        store.set_out(&first.drift);
        let mut pull = self.project(store, way, &first.step);
        for _ in 1..count {
            store.go_on(&next.drift);
            pull = pull.max(self.project(store, way, &next.step));
        }
        pull
    }

    /// The bonds of one substep. Returns the largest pull.
    fn project(&mut self, store: &mut Self::Store, way: Way, step: &Substep) -> S {
        match way {
            Way::Paths => self.solve(store, step),
            Way::Sweeps(_) | Way::Forces => {
                (0..super::passes(way)).for_each(|_| self.sweep(store, step));
                S::ZERO
            }
        }
    }

    /// Moves displacements by one sweep over all bonds.
    fn sweep(&mut self, store: &mut Self::Store, step: &Substep);

    /// Moves displacements by one pass of the path method over all bonds. Returns the largest pull of bonds that nothing
    /// holds across their direction, as [`path::solve`](crate::sim::kernels::path::solve).
    fn solve(&mut self, store: &mut Self::Store, step: &Substep) -> S;

    /// The largest |e.e/rest^2 - 1| of any rigid bond, about twice its strain.
    fn stretch(&self, store: &mut Self::Store) -> S;

    /// The bond between two points of the body, that has this rest length `[m]`, goes: its lane is idle from now on. Returns whether
    /// that was so: a form that has no idle lanes, or too many already, has to be made anew.
    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    /// Bytes that it takes, without the store.
    fn heap_bytes(&self) -> usize;

    /// How many bonds it has.
    fn bonds(&self) -> usize;
}
