//! Who moves what in a world.

use super::World;
use crate::sim::bond::PointId;
use crate::sim::moved::{HandedOver, Moved, MovedBy, Why};
use crate::sim::real::Real;
use crate::sim::solver::Solver;

impl<S: Real, const D: usize> World<S, D> {
    /// The places of groups with points that can move, each with the lowest of these, in the order of these.
    pub(crate) fn lowest(&self) -> Vec<(usize, PointId)> {
        let mut is_listed = vec![false; self.plan.groups.len()];
        let mut list = Vec::new();
        for point in (0..self.count()).filter(|&point| self.inverse_mass[point] > 0.0) {
            if let Some([place, _]) = self.slot(point)
                && !std::mem::replace(&mut is_listed[place], true)
            {
                list.push((place, PointId(point as u32)));
            }
        }
        list
    }

    /// See [`Dynamics::moved_by`](crate::sim::dynamics::Dynamics::moved_by).
    pub(super) fn movers(&self) -> Vec<MovedBy> {
        let of = |(place, first): (usize, PointId)| {
            let (part, Moved { since, why, .. }) = (&self.plan.own[place], self.plan.groups[place].moved);
            let meets = part.solver == Solver::Live && self.model.contact.is_some();
            let why = if meets { Why::Contact } else { why };
            MovedBy { first, count: part.points, method: part.solver, since, why }
        };
        self.lowest().into_iter().map(of).collect()
    }

    /// The lowest point of a group that can move.
    pub(crate) fn lowest_of(&self, place: usize) -> Option<u32> {
        let is_of = |point: &usize| {
            self.inverse_mass[*point] > 0.0 && self.slot(*point).is_some_and(|[group, _]| group == place)
        };
        (0..self.count()).find(is_of).map(|point| point as u32)
    }

    /// What is handed over, to be kept.
    pub(super) fn handed_over(&self) -> Vec<HandedOver> {
        let of = |(place, first): (usize, PointId)| {
            let moved = self.plan.groups[place].moved;
            let Moved { since, why, until, times } = moved;
            moved.is_handed_over().then_some(HandedOver { first, since, why, until, times })
        };
        self.lowest().into_iter().filter_map(of).collect()
    }

    /// Groups that were made for what was handed over know so.
    pub(super) fn note_handed_over(&mut self, list: &[HandedOver]) {
        for &HandedOver { first, since, why, until, times } in list {
            if let Some([place, _]) = self.slot(first.index())
                && self.plan.own[place].solver == Solver::Live
            {
                self.plan.groups[place].moved = Moved { since, why, until, times };
            }
        }
    }
}
