//! Constant forces come, go and get other numbers.

use std::sync::Arc;

use super::check::finite;
use super::{Applied, CommandError, done};
use crate::sim::bond::PointId;
use crate::sim::force::steady::Force;
use crate::sim::model::{Model, check_force};
use crate::sim::real::Real;
use crate::sim::vector::truncate;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// A force as this world has it.
    ///
    /// Errors: a number outside its range.
    pub(super) fn force_of(&self, k: usize, force: &Force<3>) -> Result<Force<D>, CommandError> {
        let own = Force { points: force.points.clone(), force: truncate(force.force), torque: force.torque };
        finite("force", &force.force)?;
        check_force(k, &own)?;
        Ok(own)
    }

    /// Forces get other numbers.
    pub(super) fn set_forces(
        &mut self,
        forces: &[u32],
        (force, torque): (Option<[f64; 3]>, Option<f64>),
    ) -> Result<Applied, CommandError> {
        let places = self.force_places(forces)?;
        if places.is_empty() || (force.is_none() && torque.is_none()) {
            return Ok(done(false));
        }
        let mut model = Model::clone(&self.model);
        for &place in &places {
            let own = &mut model.forces[place];
            own.force = force.map_or(own.force, truncate);
            own.torque = torque.unwrap_or(own.torque);
            check_force(self.numbers.forces[place] as usize, own)?;
        }
        let detached = self.detach(&self.pushed_by(&places), false);
        self.model = Arc::new(model);
        self.attach(detached);
        Ok(done(true))
    }

    /// The free points that forces at these places of the list act on.
    pub(super) fn pushed_by(&self, places: &[usize]) -> Vec<u32> {
        let points = places.iter().flat_map(|&place| &self.model.forces[place].points);
        points.filter(|point| self.inverse_mass[point.index()] > 0.0).map(|point| point.0).collect()
    }

    /// Those points, and the free ones that share a force with one of them: what each gets of it hangs on the mass of all.
    pub(super) fn with_mates(&self, mut points: Vec<u32>) -> Vec<u32> {
        if self.model.forces.is_empty() {
            return points;
        }
        let mut is_meant = vec![false; self.count()];
        points.iter().for_each(|&point| is_meant[point as usize] = true);
        let is_shared = |force: &Force<D>| force.points.iter().any(|point| is_meant[point.index()]);
        let places: Vec<usize> =
            (0..self.model.forces.len()).filter(|&place| is_shared(&self.model.forces[place])).collect();
        points.extend(self.pushed_by(&places));
        points
    }

    /// Forces at these places of the list go.
    pub(super) fn remove_forces(&mut self, places: &[usize]) {
        let mut place = 0;
        Arc::make_mut(&mut self.model).forces.retain(|_| {
            place += 1;
            !places.contains(&(place - 1))
        });
        let mut place = 0;
        self.numbers.forces.retain(|_| {
            place += 1;
            !places.contains(&(place - 1))
        });
    }

    /// Points that are gone leave forces, and forces that are left with none go.
    pub(super) fn free_forces(&mut self) {
        let numbers = &self.numbers;
        let is_left = |point: &PointId| !numbers.is_gone(point.0);
        if self.model.forces.iter().all(|force| force.points.iter().all(is_left)) {
            return;
        }
        let forces = &mut Arc::make_mut(&mut self.model).forces;
        forces.iter_mut().for_each(|force| force.points.retain(is_left));
        let empty: Vec<usize> =
            forces.iter().enumerate().filter(|(_, force)| force.points.is_empty()).map(|(place, _)| place).collect();
        self.remove_forces(&empty);
    }

    /// The forces of a part of the world, by the places of its points: of each as much as the mass there bears.
    pub(super) fn forces_among(&self, local: &[u32]) -> Vec<Force<D>> {
        let of = |force: &Force<D>| {
            let mass = |is_meant: &dyn Fn(&PointId) -> bool| -> f64 {
                let free = force.members().into_iter().filter(|point| self.inverse_mass[point.index()] > 0.0);
                free.filter(is_meant).map(|point| self.model.mass[point.index()]).sum()
            };
            let is_here = |point: &PointId| local[point.index()] != u32::MAX;
            let own = mass(&is_here);
            let share = own / mass(&|_| true);
            (own > 0.0).then(|| Force {
                points: force.points.iter().filter(|point| is_here(point)).map(|p| PointId(local[p.index()])).collect(),
                force: force.force.map(|f| f * share),
                torque: force.torque,
            })
        };
        self.model.forces.iter().filter_map(of).collect()
    }
}
