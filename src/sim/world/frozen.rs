//! Islands that left the finite numbers: they stand still where they last were among them, until a command touches them.

use super::World;
use crate::sim::bond::PointId;
use crate::sim::moved::{HandedOver, MovedBy, Why};
use crate::sim::plan::Sets;
use crate::sim::real::Real;
use crate::sim::solver::Solver;

/// An island that stands still: its points weigh as much as pins do meanwhile.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frozen {
    /// All that could move, ascending; never empty.
    pub(crate) points: Vec<u32>,
    /// The method that failed.
    pub(crate) solver: Solver,
    /// `[s]`
    pub(crate) since: f64,
}

impl Frozen {
    fn first(&self) -> PointId {
        PointId(self.points.first().copied().unwrap_or_default())
    }

    /// As a kept world has it.
    pub(super) fn to_keep(&self) -> HandedOver {
        HandedOver { first: self.first(), since: self.since, why: Why::NotFinite, until: self.since, times: 0 }
    }
}

impl<S: Real, const D: usize> World<S, D> {
    /// What stands still, for those who ask who moves what.
    pub(super) fn standing(&self) -> impl Iterator<Item = MovedBy> {
        self.frozen.iter().map(|frozen| MovedBy {
            first: frozen.first(),
            count: frozen.points.len(),
            islands: 1,
            method: frozen.solver,
            since: frozen.since,
            why: Why::NotFinite,
        })
    }

    /// Which points that can move hang together, by bonds, angles and triangles.
    pub(crate) fn hanging_together(&self) -> Sets {
        let is_free = |point: &PointId| self.inverse_mass[point.index()] > 0.0;
        let mut islands = Sets::new(self.count());
        let tied = self.model.ties().flat_map(|[a, b, c]| [[a, b], [b, c], [a, c]]);
        let pairs = self.bonds.ends().iter().copied().chain(tied);
        pairs.filter(|ends| ends.iter().all(is_free)).for_each(|[a, b]| islands.join(a.0, b.0));
        islands
    }

    /// The islands that have one of these points: all of their points that can move, ascending.
    pub(crate) fn islands_with(&self, points: &[u32]) -> Vec<Vec<u32>> {
        let mut together = self.hanging_together();
        let mut firsts: Vec<u32> = points.iter().map(|&point| together.find(point)).collect();
        firsts.sort_unstable();
        firsts.dedup();
        let mut islands = vec![Vec::new(); firsts.len()];
        for point in (0..self.count() as u32).filter(|&point| self.inverse_mass[point as usize] > 0.0) {
            if let Ok(found) = firsts.binary_search(&together.find(point)) {
                islands[found].push(point);
            }
        }
        islands.retain(|island| !island.is_empty());
        islands
    }
}
