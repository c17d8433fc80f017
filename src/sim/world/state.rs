//! The state of a world in the order of the model, gathered from its groups.

use super::World;
use crate::sim::dynamics::Sample;
use crate::sim::ledger::{Energies, Totals};
use crate::sim::measure;
use crate::sim::plan::NOWHERE;
use crate::sim::points::{Points, State};
use crate::sim::real::Real;
use crate::sim::vector::{embed, length, widen, zero};

impl<S: Real, const D: usize> World<S, D> {
    /// How many points there are, those that are gone counted too.
    pub(crate) fn count(&self) -> usize {
        self.inverse_mass.len()
    }

    /// Where a point is: its group and its place there; `None` where it is gone.
    pub(crate) fn slot(&self, point: usize) -> Option<[usize; 2]> {
        if self.plan.is_plain {
            return Some([0, point]);
        }
        let slot = self.plan.slots[point];
        (slot != NOWHERE).then(|| slot.map(|place| place as usize))
    }

    /// Whether a point can move: no pin, and not held by bonds that are taut between pins.
    pub(crate) fn can_move(&self, point: usize) -> bool {
        let is_held = |[group, slot]: [usize; 2]| self.plan.groups[group].points.inverse_mass[slot] == S::ZERO;
        self.inverse_mass[point] > 0.0 && !self.slot(point).is_some_and(is_held)
    }

    /// Whether joints at a point stop by springs: in the live step they stop at once, and what they are beyond their stops is no energy.
    pub(super) fn stops_by_spring(&self, point: usize) -> bool {
        self.slot(point).is_none_or(|[group, _]| !self.model.is_live() && !self.plan.groups[group].is_live())
    }

    /// The state of some points.
    pub(crate) fn state_of(&self, points: impl Iterator<Item = usize> + Clone) -> State<S, D> {
        let pick = |list: fn(&Points<S, D>) -> &[[S; D]]| {
            // Large bodies have no list of what rounding takes; what is gone has nothing.
            let of = |point: usize| {
                let [group, slot] = self.slot(point)?;
                list(&self.plan.groups[group].points).get(slot).copied()
            };
            points.clone().map(|point| of(point).unwrap_or(zero())).collect()
        };
        State {
            position: pick(|points| &points.position),
            velocity: pick(|points| &points.velocity),
            position_lost: pick(|points| &points.position_lost),
            velocity_lost: pick(|points| &points.velocity_lost),
        }
    }

    /// Where a point is `[m]`.
    pub(crate) fn place(&self, point: usize) -> [f64; D] {
        self.slot(point).map_or([f64::NAN; D], |[group, slot]| widen(self.plan.groups[group].points.position[slot]))
    }

    /// The distance from a place to the farthest corner of the boxes about the groups `[m]`.
    pub(crate) fn farthest_from(&self, place: [f64; 3]) -> f64 {
        let corners = self.plan.groups.iter().filter_map(|group| measure::extent(&group.points.position));
        let of = |[low, high]: [[S; D]; 2]| {
            let [low, high] = [low, high].map(|corner| embed(widen(corner)));
            let side = |k: usize| (low[k] - place[k]).abs().max((high[k] - place[k]).abs());
            length([side(0), side(1), side(2)])
        };
        corners.map(of).fold(0.0, f64::max)
    }

    /// Copies positions into the order of the model, where the groups have another. Those of points that are gone are no numbers.
    pub(crate) fn gather(&mut self) {
        if self.plan.is_plain {
            return self.gathered.clear();
        }
        let World { plan, gathered, .. } = self;
        let of = |&[group, slot]: &[u32; 2]| match plan.groups.get(group as usize) {
            Some(group) => group.points.position[slot as usize],
            None => [S::from_f64(f64::NAN); D],
        };
        gathered.clear();
        gathered.extend(plan.slots.iter().map(of));
    }

    /// Energies by their kinds of points at these places `[m]` that move so `[m/s]`.
    pub(super) fn energies_of(
        &self,
        position: impl Fn(usize) -> [f64; D] + Copy,
        velocity: impl Fn(usize) -> [f64; D],
    ) -> Energies {
        let [angles, areas] = self.model.form_energies(position, |i| self.stops_by_spring(i));
        let surfaces = self.model.penalty_energy(self.free_places(&position));
        let gravity = self.around.gravity;
        let others = measure::energies(position, velocity, &self.inverse_mass, &self.bonds, gravity);
        Energies { angles, areas, surfaces, ..others }
    }

    /// The state now, in `f64`.
    pub(super) fn present(&self) -> Sample {
        let state = self.state_of(0..self.count());
        let position: Vec<[f64; D]> = state.position.iter().map(|&x| widen(x)).collect();
        let velocity: Vec<[f64; D]> = state.velocity.iter().map(|&v| widen(v)).collect();
        let is_gone = |i: usize| self.slot(i).is_none();
        let said = |(i, x): (usize, [f64; D])| if is_gone(i) { [f64::NAN; 3] } else { embed(x) };
        let energies = self.energies_of(|i| position[i], |i| velocity[i]);
        let time = self.timeline.time();
        Sample {
            time,
            energy: energies.sum(),
            ledger: self
                .ledger
                .map(|totals| Totals { book: self.book(), ..totals }.at(time, energies, S::EPSILON.to_f64())),
            max_strain: measure::max_strain(|i| position[i], &self.bonds, (time, &self.around.keys)),
            position: position.into_iter().enumerate().map(said).collect(),
            velocity: velocity.into_iter().enumerate().map(said).collect(),
        }
    }
}
