//! Constant forces and torques, and the wind, as groups feel them.

use std::sync::Arc;

use super::gather::Gathered;
use super::island::Island;
use super::make::Maker;
use crate::sim::bond::Bond;
use crate::sim::contact::penalty::{Cushion, Penalty};
use crate::sim::force::muscle::Driven;
use crate::sim::force::steady::Thrust;
use crate::sim::force::wind::Air;
use crate::sim::model::Model;
use crate::sim::real::Real;
use crate::sim::vector::{convert, scale};

/// Lets the rules know that surfaces push islands by depth, all at once at worst.
pub(super) fn press<const D: usize>(model: &Model<D>, islands: &mut [Island]) {
    let penalties: Vec<Penalty> = model.planes.iter().filter_map(|plane| plane.penalty).collect();
    let (k, c) = penalties.iter().fold((0.0, 0.0), |(k, c), one| (k + one.stiffness, c + one.damping));
    for island in islands.iter_mut().filter(|_| !penalties.is_empty()) {
        let most = island.points.iter().map(|&i| 1.0 / model.mass[i as usize]).fold(0.0, f64::max);
        island.frequency = (island.frequency * island.frequency + k * most).sqrt();
        island.decay += c * most;
        (island.is_driven, island.is_pressed) = (true, true);
        island.is_damped |= c > 0.0;
    }
}

/// What pushes the points of a model.
#[derive(Clone, Debug, Default)]
pub(super) struct Drives<const D: usize> {
    /// By the point that stands for one which a force names: that, the force, and the mass that it acts on there `[kg]`; ascending.
    entries: Vec<(u32, u32, f64)>,
    /// The force for each mass `[m/s^2]`, one entry a force.
    accelerations: Vec<[f64; D]>,
    /// The air, where it moves and there is drag.
    pub(super) air: Option<Arc<Air<D>>>,
}

impl<const D: usize> Drives<D> {
    /// Shapes: `w` `[1/kg]` has one entry a point, 0 where it is pinned; `stand_ins` likewise.
    pub(super) fn new(model: &Model<D>, w: &[f64], stand_ins: &[u32]) -> Self {
        let mut drives = Drives { air: air_of(model), ..Drives::default() };
        for (force, number) in model.forces.iter().zip(0..) {
            let members = force.members();
            let free = || members.iter().map(|point| point.index()).filter(|&i| w[i] > 0.0);
            let mass: f64 = free().map(|i| model.mass[i]).sum();
            drives.entries.extend(free().map(|i| (stand_ins[i], number, model.mass[i])));
            drives.accelerations.push(if mass > 0.0 { scale(force.force, 1.0 / mass) } else { [0.0; D] });
        }
        drives.entries.sort_unstable_by_key(|entry| (entry.0, entry.1));
        drives
    }

    /// Points that a torque holds together: how each is turned hangs on where the others are.
    pub(super) fn pairs(&self, model: &Model<D>) -> Vec<[u32; 2]> {
        let mut last = vec![u32::MAX; model.forces.len()];
        let mut pairs = Vec::new();
        for &(point, force, _) in &self.entries {
            let before = std::mem::replace(&mut last[force as usize], point);
            if model.forces[force as usize].torque != 0.0 && before != u32::MAX && before != point {
                pairs.push([before, point]);
            }
        }
        pairs
    }

    /// Notes which islands forces act on.
    pub(super) fn mark(&self, islands: &mut [Island]) {
        if self.entries.is_empty() {
            return;
        }
        for island in islands {
            island.is_driven = island.points.iter().any(|&point| !self.at(point).is_empty());
        }
    }

    /// What acts on a point that stands for others: forces with their masses there.
    fn at(&self, point: u32) -> &[(u32, u32, f64)] {
        let start = self.entries.partition_point(|entry| entry.0 < point);
        let count = self.entries[start..].partition_point(|entry| entry.0 == point);
        &self.entries[start..start + count]
    }
}

/// The air of a model, where it moves and there is drag.
fn air_of<const D: usize>(model: &Model<D>) -> Option<Arc<Air<D>>> {
    let wind = model.wind.filter(|_| model.drag_rate != 0.0)?;
    Some(Arc::new(Air::new(&wind)))
}

/// How fast gusts change where a point is at the most `[rad/s]`; `None`: there are none that push.
pub(crate) fn gust_rate<const D: usize>(model: &Model<D>) -> Option<f64> {
    air_of(model).filter(|air| air.has_gusts()).map(|air| air.bounds()[1])
}

impl<S: Real, const D: usize> Gathered<S, D> {
    /// The forces on the points of a group, in the order of the model.
    fn thrusts(&self, model: &Model<D>, points: &[u32]) -> Vec<Thrust<S, D>> {
        let mut on: Vec<(u32, u32, f64)> = Vec::new();
        for (&point, slot) in points.iter().zip(0..).filter(|_| !self.drives.entries.is_empty()) {
            for &(_, force, mass) in self.drives.at(point) {
                match on.last_mut() {
                    // Points that are welded together.
                    Some(last) if (last.0, last.1) == (force, slot) => last.2 += mass,
                    _ => on.push((force, slot, mass)),
                }
            }
        }
        on.sort_by_key(|entry| (entry.0, entry.1));
        let of = |list: &[(u32, u32, f64)]| {
            let force = list[0].0 as usize;
            // One that is not welded bears all of it.
            let share = |&(_, slot, mass): &(u32, u32, f64)| (mass * self.w[points[slot as usize] as usize]).min(1.0);
            Thrust {
                slots: list.iter().map(|entry| entry.1).collect(),
                shares: list.iter().map(|entry| S::from_f64(share(entry))).collect(),
                acceleration: convert(self.drives.accelerations[force]),
                torque: S::from_f64(model.forces[force].torque),
            }
        };
        on.chunk_by(|a, b| a.0 == b.0).map(of).collect()
    }
}

impl<S: Real, const D: usize> Maker<'_, S, D> {
    /// What drives move of the group.
    pub(super) fn driven(&self) -> Driven<S> {
        if !self.lot.islands.iter().any(|island| island.has_drives) {
            return Driven::none();
        }
        let bonds: Vec<Bond> = self.bonds().map(|(_, bond)| bond).filter(|bond| bond.drive.is_some()).collect();
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        Driven::of(bonds.iter(), self.form().hinges.into_iter(), &w)
    }

    /// The forces on the points of the group.
    pub(super) fn thrusts(&self) -> Vec<Thrust<S, D>> {
        self.gathered.thrusts(self.model, self.points)
    }

    /// Surfaces that push by depth.
    pub(super) fn cushions(&self) -> Arc<[Cushion<S, D>]> {
        self.model.planes.iter().filter_map(Cushion::of).collect()
    }
}
