//! A group of bodies that may meet.

use super::make::{Maker, breakable};
use crate::sim::group::Group;
use crate::sim::live::{Draft, mover};
use crate::sim::real::Real;

impl<S: Real, const D: usize> Maker<'_, S, D> {
    /// `None` in a dimension that the live step is not made for.
    pub(super) fn make_live(&self) -> Option<Group<S, D>> {
        let (points, pull) = (self.batched_state(), self.batched_pull());
        let draft = Draft {
            bonds: self.bonds().map(|(_, bond)| bond).collect(),
            body_of: self.body_of(),
            triangles: self.triangles(),
            contact: self.model.contact,
        };
        let mover = mover(draft, &points, &pull)?;
        Some(self.batched(points, pull, mover, breakable(self.bonds(), |_| true)))
    }

    /// The island of every point of the group; a pin belongs to the first that is fastened to it, one that nothing is fastened to is a
    /// body of its own.
    fn body_of(&self) -> Vec<u32> {
        let mut body_of = vec![u32::MAX; self.points.len()];
        for (island, body) in self.lot.islands.iter().zip(0..) {
            let bonds = island.bonds.iter().map(|&k| self.gathered.bonds.ends()[k as usize]);
            let ends = bonds.flatten().map(|end| end.0);
            for point in island.points.iter().copied().chain(ends) {
                let of = &mut body_of[self.place[point as usize] as usize];
                *of = body.min(*of);
            }
        }
        let alone = body_of.iter_mut().filter(|of| **of == u32::MAX);
        alone.zip(self.lot.islands.len() as u32..).for_each(|(of, next)| *of = next);
        body_of
    }

    /// The triangles of the group, without those that welds leave no area.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let slot = |corner: u32| self.place[self.gathered.stand_ins[corner as usize] as usize];
        let slots = self.model.triangles.iter().map(|corners| corners.map(|corner| slot(corner.0)));
        slots.filter(|&[a, b, c]| a.max(b).max(c) != u32::MAX && a != b && b != c && c != a).collect()
    }
}
