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
        let position = self.places_of(detached);
        let bonds: &Bonds = &self.bonds;
        let hit = plan::clear(&fresh, bonds, (&position, &self.inverse_mass), |_| false);
        if hit.moves.is_empty() && hit.stuck.is_empty() {
            return;
        }
        let mut w = vec![0.0; self.count()];
        for &point in hit.moves.iter().flat_map(|(points, _)| points) {
            w[point as usize] = self.inverse_mass[point as usize];
        }
        // What is out of the fresh ones may be in others.
        let out = plan::clear(&obstacles.widened(model), bonds, (&position, &w), |_| false);
        carry(detached, if out.moves.is_empty() { &hit.moves } else { &out.moves });
        self.warn_of_overlap(&hit, 0);
        self.within.extend(hit.stuck);
    }

    /// Bodies among what was taken out that lie inside obstacles since these points, ascending, were moved are put beside them, as what an
    /// obstacle is put onto; pins that were moved likewise, and the tracks of `model` with them.
    pub(super) fn clear_moved(&mut self, moved: &[u32], model: &mut Model<D>, detached: &mut Detached<S, D>) {
        let position = self.places_of(detached);
        let mut w = vec![0.0; self.count()];
        for &point in &detached.points {
            w[point as usize] = self.inverse_mass[point as usize];
        }
        let is_moved = |point: u32| moved.binary_search(&point).is_ok();
        let hit = plan::clear(&self.obstacles.widened(&*model), &self.bonds, (&position, &w), is_moved);
        if hit.moves.is_empty() && hit.stuck.is_empty() {
            return;
        }
        carry(detached, &hit.moves);
        for (points, way) in &hit.moves {
            let led = model.pin_motion.iter_mut().filter(|(point, _)| points.binary_search(&point.0).is_ok());
            led.flat_map(|(_, track)| &mut track.knots).for_each(|(_, x)| *x = add(*x, *way));
        }
        self.warn_of_overlap(&hit, 0);
        self.within.extend(hit.stuck);
    }

    /// Where the points are that were taken out `[m]`; all others at the origin.
    fn places_of(&self, detached: &Detached<S, D>) -> Vec<[f64; D]> {
        let mut position = vec![zero(); self.count()];
        for (&point, &x) in detached.points.iter().zip(&detached.state.position) {
            position[point as usize] = widen(x);
        }
        position
    }
}

/// Moves bodies among what was taken out, each as a whole `[m]`.
fn carry<S: Real, const D: usize>(detached: &mut Detached<S, D>, moves: &[(Vec<u32>, [f64; D])]) {
    for (points, way) in moves {
        for place in detached.places(points.iter().copied()) {
            let x = &mut detached.state.position[place];
            *x = add(*x, convert(*way));
            detached.state.position_lost[place] = zero();
        }
    }
}
