//! Islands that left the finite numbers stand still, and go on from there once a command touches them.

use std::sync::Arc;

use crate::sim::bond::{BondId, PointId};
use crate::sim::command::{Addition, Change, Command, Reach, Selection};
use crate::sim::real::Real;
use crate::sim::solver::Solver;
use crate::sim::vector::zero;
use crate::sim::world::World;
use crate::sim::world::frozen::Frozen;

impl<S: Real, const D: usize> World<S, D> {
    /// The islands of points, which are where they last were among the numbers, stand still from `t` on `[s]`; `solver` has failed.
    pub(crate) fn freeze(&mut self, points: &[u32], (solver, t): (Solver, f64)) {
        let islands = self.islands_with(points);
        let all: Vec<u32> = islands.iter().flatten().copied().collect();
        if all.is_empty() {
            return;
        }
        let mut detached = self.detach_at(&all, false, t);
        let w = Arc::make_mut(&mut self.inverse_mass);
        all.iter().for_each(|&point| w[point as usize] = 0.0);
        for place in detached.places(all) {
            detached.state.velocity[place] = zero();
            detached.state.velocity_lost[place] = zero();
            detached.state.position_lost[place] = zero();
        }
        self.counters.frozen += islands.len() as u64;
        self.frozen.extend(islands.into_iter().map(|points| Frozen { points, solver, since: t }));
        self.attach(detached);
    }

    /// Lets those of the frozen islands go that a command names.
    pub(super) fn thaw_for(&mut self, command: &Command) {
        let named = self.named_by(command);
        let is_all = matches!(command, Command::Clear | Command::Set(Change::Scene(_)));
        let is_meant = |frozen: &Frozen| is_all || named.iter().any(|point| frozen.points.binary_search(point).is_ok());
        let (thawed, still): (Vec<Frozen>, Vec<Frozen>) =
            std::mem::take(&mut self.frozen).into_iter().partition(is_meant);
        self.frozen = still;
        let points: Vec<u32> = thawed.into_iter().flat_map(|frozen| frozen.points).collect();
        if points.is_empty() {
            return;
        }
        // They weigh nothing until they are out: who shares their places is not touched.
        let detached = self.detach(&points, false);
        self.weigh(points);
        self.attach(detached);
    }

    /// The points that a command names, itself or by their bonds.
    fn named_by(&self, command: &Command) -> Vec<u32> {
        let ends = |bonds: &[BondId]| -> Vec<u32> {
            let places = bonds.iter().filter_map(|bond| self.numbers.place_of_bond(bond.0));
            places.flat_map(|place| self.bonds.ends()[place]).map(|end| end.0).collect()
        };
        let of = |points: &[PointId]| -> Vec<u32> { points.iter().map(|point| point.0).collect() };
        match command {
            Command::Cursor { .. } | Command::Mouse(_) | Command::Release | Command::Key { .. } | Command::Clear => {
                Vec::new()
            }
            Command::Grab(Reach::Points(points) | Reach::Patch { points, .. })
            | Command::Pin(points)
            | Command::Unpin(points) => of(points),
            Command::Grab(Reach::Within(radius)) => of(&self.points_within(*radius)),
            Command::Cut { from, to } => {
                let goes = self.crossed_by([*from, *to]).unwrap_or_default();
                let cut = self.bonds.ends().iter().zip(goes).filter(|(_, goes)| *goes);
                cut.flat_map(|(ends, _)| *ends).map(|end| end.0).collect()
            }
            Command::Split { points, bonds } => [of(points), ends(bonds)].concat(),
            Command::Add(addition) => named_by_addition(addition),
            Command::Delete(Selection { points, bonds, .. }) => [of(points), ends(bonds)].concat(),
            Command::Move(motion) => of(&motion.points),
            Command::Set(Change::Points { points, .. }) => of(points),
            Command::Set(Change::Bonds { bonds, .. }) => ends(bonds),
            Command::Set(_) => Vec::new(),
        }
    }
}

/// The points that something new is fastened to, acts on or covers.
fn named_by_addition(addition: &Addition) -> Vec<u32> {
    let bonds = addition.bonds.iter().flat_map(|bond| [bond.a, bond.b]);
    let forces = addition.forces.iter().flat_map(|force| force.points.iter().copied());
    let angles = addition.angles.iter().flat_map(|angle| angle.points);
    let pins = addition.pinned.iter().copied().chain(addition.pin_motion.iter().map(|led| led.0));
    let covered = addition.triangles.iter().flatten().copied();
    bonds.chain(forces).chain(angles).chain(pins).chain(covered).map(|point| point.0).collect()
}
