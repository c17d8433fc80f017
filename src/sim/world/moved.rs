//! Who moves what in a world.

use super::World;
use super::frozen::Frozen;
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
            let meets = part.solver == Solver::Live && why == Why::Plan && self.model.contact.is_some();
            let why = if meets { Why::Contact } else { why };
            MovedBy { first, count: part.points, islands: part.islands, method: part.solver, since, why }
        };
        let mut list: Vec<MovedBy> = self.lowest().into_iter().map(of).chain(self.standing()).collect();
        list.sort_by_key(|moved| moved.first);
        list
    }

    /// The same of some groups alone.
    pub(crate) fn firsts_of(&self, places: &[usize]) -> Vec<(usize, u32)> {
        let mut is_meant = vec![false; self.plan.groups.len()];
        places.iter().for_each(|&place| is_meant[place] = true);
        let list = self.lowest().into_iter().filter(|(place, _)| is_meant[*place]);
        list.map(|(place, point)| (place, point.0)).collect()
    }

    /// Frames may take more work from `t` on `[s]`. What the live step moves wakes: only what is awake goes back.
    pub(crate) fn allow_more(&mut self, t: f64) {
        let kept = self.kept.iter_mut().map(|kept| &mut kept.group);
        for group in self.plan.groups.iter_mut().chain(kept) {
            group.moved.allow(t);
            if group.is_live() {
                group.wake();
            }
        }
    }

    /// What is handed over or stands still, to be kept.
    pub(super) fn handed_over(&self) -> Vec<HandedOver> {
        let standing = self.frozen.iter().map(Frozen::to_keep);
        if !self.plan.groups.iter().any(|group| group.moved.is_handed_over()) {
            return standing.collect();
        }
        let is_free = |point: &PointId| self.inverse_mass[point.index()] > 0.0;
        let mut islands = self.hanging_together();
        let of = |first: PointId| {
            let [place, _] = self.slot(first.index())?;
            let Moved { since, why, until, times } = self.plan.groups[place].moved;
            (why != Why::Plan).then_some(HandedOver { first, since, why, until, times })
        };
        let firsts = (0..self.count() as u32).filter(|&point| islands.find(point) == point).map(PointId);
        firsts.filter(is_free).filter_map(of).chain(standing).collect()
    }

    /// Groups that were made for what was handed over know so.
    pub(super) fn note_handed_over(&mut self, list: &[HandedOver]) {
        for &HandedOver { first, since, why, until, times } in list.iter().filter(|entry| entry.why != Why::NotFinite) {
            if let Some([place, _]) = self.slot(first.index())
                && self.plan.own[place].solver == Solver::Live
            {
                self.plan.groups[place].moved = Moved { since, why, until, times };
            }
        }
    }
}
