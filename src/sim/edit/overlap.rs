//! Bodies that an obstacle is put onto.

use super::recompile::Detached;
use crate::sim::bonds::Bonds;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::model::Model;
use crate::sim::plan;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, widen, zero};
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// Bodies among what was taken out that lie inside `fresh` walls, planes or polygons are put beside them, each as a whole and out of
    /// all obstacles, those of `model`, as they are at the start of a scene: put out point by point they would be crushed.
    pub(super) fn clear_of(
        &mut self,
        fresh: &Model<D>,
        (model, obstacles): (&Model<D>, &Obstacles<S, D>),
        detached: &mut Detached<S, D>,
    ) {
        // Outlines that cross too often were refused before.
        let Ok(fresh) = Obstacles::<f64, D>::of(fresh) else { return };
        let mut position = vec![zero(); self.count()];
        for (&point, &x) in detached.points.iter().zip(&detached.state.position) {
            position[point as usize] = widen(x);
        }
        let bonds: &Bonds = &self.bonds;
        let hit = plan::clear(&fresh, bonds, &position, &self.inverse_mass);
        if hit.moves.is_empty() && hit.stuck.is_empty() {
            return;
        }
        let mut w = vec![0.0; self.count()];
        for &point in hit.moves.iter().flat_map(|(points, _)| points) {
            w[point as usize] = self.inverse_mass[point as usize];
        }
        // What is out of the fresh ones may be in others.
        let out = plan::clear(&obstacles.widened(model), bonds, &position, &w);
        let ways = if out.moves.is_empty() { &hit.moves } else { &out.moves };
        for (points, way) in ways {
            for place in detached.places(points.iter().copied()) {
                let x = &mut detached.state.position[place];
                *x = add(*x, convert(*way));
                detached.state.position_lost[place] = zero();
            }
        }
        self.warn_of_overlap(&hit);
        self.within.extend(hit.stuck);
    }
}
