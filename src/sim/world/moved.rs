//! Who moves what in a world.

use super::World;
use crate::sim::bond::PointId;
use crate::sim::moved::{HandedOver, Moved, MovedBy, Why};
use crate::sim::plan::Sets;
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
            let meets = part.solver == Solver::Live && why == Why::Plan && self.model.contact.is_some();
            let why = if meets { Why::Contact } else { why };
            MovedBy { first, count: part.points, method: part.solver, since, why }
        };
        self.lowest().into_iter().map(of).collect()
    }

    /// The same of some groups alone.
    pub(crate) fn firsts_of(&self, places: &[usize]) -> Vec<(usize, u32)> {
        let mut is_meant = vec![false; self.plan.groups.len()];
        places.iter().for_each(|&place| is_meant[place] = true);
        let list = self.lowest().into_iter().filter(|(place, _)| is_meant[*place]);
        list.map(|(place, point)| (place, point.0)).collect()
    }

    /// What is handed over, to be kept.
    pub(super) fn handed_over(&self) -> Vec<HandedOver> {
        if !self.plan.groups.iter().any(|group| group.moved.is_handed_over()) {
            return Vec::new();
        }
        let is_free = |point: &PointId| self.inverse_mass[point.index()] > 0.0;
        let mut islands = Sets::new(self.count());
        let pairs =
            self.bonds.ends().iter().copied().chain(self.model.ties().flat_map(|[a, b, c]| [[a, b], [b, c], [a, c]]));
        pairs.filter(|ends| ends.iter().all(is_free)).for_each(|[a, b]| islands.join(a.0, b.0));
        let of = |first: PointId| {
            let [place, _] = self.slot(first.index())?;
            let Moved { since, why, until, times } = self.plan.groups[place].moved;
            (why != Why::Plan).then_some(HandedOver { first, since, why, until, times })
        };
        let firsts = (0..self.count() as u32).filter(|&point| islands.find(point) == point).map(PointId);
        firsts.filter(is_free).filter_map(of).collect()
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
