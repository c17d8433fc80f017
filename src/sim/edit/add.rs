//! Points, bonds and obstacles come.

use std::sync::Arc;

use super::check::finite;
use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::command::{Addition, Obstacle};
use crate::sim::contact::surface::Plane;
use crate::sim::force::angle::Angle;
use crate::sim::force::mouse::Track;
use crate::sim::force::steady::Force;
use crate::sim::model::{Model, check_triangle};
use crate::sim::plan::{self, Cleared};
use crate::sim::real::Real;
use crate::sim::triangles::{repeats, turned, without};
use crate::sim::vector::{add, convert, truncate, zero};
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn add(&mut self, addition: &Addition) -> Result<Applied, CommandError> {
        let (first, count) = (self.count() as u32, addition.position.len() as u32);
        self.check_addition(addition)?;
        let (addition, fitted) = self.fitted(addition);
        let addition = &*addition;
        let mut model = Model::clone(&self.model);
        self.add_obstacles(&mut model, &addition.obstacles)?;
        self.add_points(&mut model, addition);
        let (old_areas, old_angle) = (model.rest_areas.len(), self.model.angles.next);
        let old_triangles = model.triangles.len() - addition.triangles.len();
        let mut repeated = if addition.triangles.is_empty() { Vec::new() } else { repeats(&model.triangles) };
        repeated.retain(|&number| number >= old_triangles);
        if !repeated.is_empty() {
            model.triangles = without(&model.triangles, &repeated);
        }
        self.add_form(&mut model, addition);
        model.check_surroundings()?;
        if addition.position.is_empty()
            && addition.bonds.is_empty()
            && addition.obstacles.is_empty()
            && addition.pinned.is_empty()
            && addition.pin_motion.is_empty()
            && addition.triangles.is_empty()
            && addition.forces.is_empty()
            && addition.skins.is_empty()
            && addition.angles.is_empty()
        {
            return Ok(done(false));
        }
        let obstacles = if addition.obstacles.is_empty() { None } else { Some(Self::obstacles_of(&model)?) };
        if D == 2 && !addition.obstacles.is_empty() && self.model.pinned.len() > 1 {
            let position = (0..self.count()).map(|i| self.there(i)).collect();
            self.check_ways_round(&model, (position, &[], true))?;
        }
        let is_old = |point: &PointId| point.0 < first;
        // What else is fastened to a pin is not touched.
        let is_free = |point: &PointId| self.inverse_mass.get(point.index()).is_some_and(|&w| w > 0.0);
        let ends = addition.bonds.iter().flat_map(|bond| [bond.a, bond.b]);
        let tied = addition.angles.iter().flat_map(|angle| angle.points);
        let resist = model.areas.is_some_and(|areas| areas.stiffness > 0.0);
        let covered = addition.triangles.iter().flatten().copied().filter(|_| resist);
        let ends = ends.chain(tied).chain(covered).filter(is_free);
        let led = addition.pin_motion.iter().map(|(point, _)| *point);
        let pushed = addition.forces.iter().flat_map(|force| &force.points).copied().filter(is_free);
        let covered = addition.skins.iter().flat_map(|(_, points)| points).copied().filter(is_free);
        let pinned = addition.pinned.iter().copied();
        let touched: Vec<u32> =
            ends.chain(pinned).chain(led).chain(pushed).chain(covered).filter(is_old).map(|point| point.0).collect();
        let mut detached = self.detach(&self.with_mates(touched.clone()), obstacles.is_some());
        if let Some(obstacles) = &obstacles {
            let mut fresh = Model::default();
            self.add_obstacles(&mut fresh, &addition.obstacles)?;
            self.clear_of(&fresh, (&model, obstacles), &mut detached);
        }
        let applied = self.number(addition);
        self.obstacles = obstacles.unwrap_or_else(|| self.obstacles.clone());
        let angles = old_angle..model.angles.next;
        self.model = Arc::new(model);
        repeated.iter_mut().for_each(|number| *number -= old_triangles);
        self.warn_of_repeats(&repeated);
        self.warn_of_areas(old_areas);
        self.weigh((first..first + count).chain(touched));
        let cleared = self.clear_new(first, addition);
        self.warn_of_overlap(&cleared, first);
        self.warn_of_fit(&fitted);
        for (k, (x, v)) in addition.position.iter().zip(&addition.velocity).enumerate() {
            let is_pinned = self.inverse_mass[first as usize + k] == 0.0;
            detached.points.push(first + k as u32);
            detached.state.position.push(convert(truncate(*x)));
            detached.state.velocity.push(if is_pinned { zero() } else { convert(truncate(*v)) });
            detached.state.position_lost.push(zero());
            detached.state.velocity_lost.push(zero());
        }
        for (points, way) in &cleared.moves {
            for place in detached.places(points.iter().map(|&point| first + point)) {
                let x = &mut detached.state.position[place];
                *x = add(*x, convert(*way));
            }
        }
        // Points that were pinned are at rest from now on.
        for place in detached.places(addition.pinned.iter().map(|point| point.0)) {
            detached.state.velocity[place] = zero();
        }
        self.spread();
        self.leave_out_idle_drives(&detached);
        self.attach(detached);
        self.warn_of_stops_now(angles.clone());
        if count > 0 {
            self.warn_of_new_crowds(first);
            self.warn_of_bare_bodies();
        }
        Ok(Applied { angles, ..applied })
    }

    fn check_addition(&self, addition: &Addition) -> Result<(), CommandError> {
        let Addition {
            position,
            velocity,
            mass,
            pinned,
            bonds,
            obstacles,
            pin_motion,
            triangles,
            forces,
            skins,
            angles,
        } = addition;
        let count = position.len();
        if velocity.len() != count || mass.len() != count {
            return Err(invalid(format!(
                "{count} points have {} velocities and {} masses",
                velocity.len(),
                mass.len()
            )));
        }
        let next = [self.count(), self.numbers.next_bond as usize, self.numbers.next_obstacle as usize];
        let counts = [count, bonds.len(), obstacles.len()];
        for ((next, count), what) in next.into_iter().zip(counts).zip(["points", "bonds", "obstacles"]) {
            if next + count > u32::MAX as usize {
                return Err(invalid(format!("there are more {what} than numbers for them")));
            }
        }
        finite("positions and velocities", position.iter().chain(velocity).flatten())?;
        if let Some(m) = mass.iter().find(|&&m| !(m > 0.0 && m.is_finite() && (1.0 / m).is_finite())) {
            return Err(invalid(format!("a mass is {m}: it must be finite and > 0")));
        }
        let named = pinned.iter().copied().chain(pin_motion.iter().map(|(point, _)| *point));
        let named = named.chain(triangles.iter().flatten().copied());
        let named = named.chain(forces.iter().flat_map(|force| force.points.iter().copied()));
        let named = named.chain(skins.iter().flat_map(|(_, points)| points.iter().copied()));
        let named = named.chain(angles.iter().flat_map(|angle| angle.points));
        for point in named.chain(bonds.iter().flat_map(|bond| [bond.a, bond.b])) {
            let is_new = (self.count()..self.count() + count).contains(&point.index());
            if !is_new {
                self.check_points(&[point])?;
            }
        }
        for (point, track) in pin_motion {
            if !pinned.contains(point) && !self.model.pinned.contains(point) {
                return Err(invalid(format!("`pin_motion` leads point {}, which is not pinned", point.0)));
            }
            finite("tracks", track.iter().flat_map(|(t, x)| std::iter::once(t).chain(x)))?;
            if track.is_empty() || !track.windows(2).all(|pair| pair[0].0 < pair[1].0) {
                return Err(invalid("a track needs a place or more, along times that ascend"));
            }
        }
        for (k, bond) in bonds.iter().enumerate() {
            self.model.check_added_bond(k, bond)?;
        }
        for (k, corners) in triangles.iter().enumerate() {
            check_triangle(k, *corners)?;
        }
        for (k, force) in forces.iter().enumerate() {
            self.force_of(k, force)?;
        }
        if self.numbers.next_force as usize + forces.len() > u32::MAX as usize {
            return Err(invalid("there are more forces than numbers for them"));
        }
        for angle in angles {
            self.model.check_angle(angle)?;
        }
        let is_polygon = |obstacle: &Obstacle| matches!(obstacle, Obstacle::Polygon(_));
        if D != 2 && obstacles.iter().any(is_polygon) {
            return Err(invalid("polygons are of the plane"));
        }
        let is_convex = |obstacle: &Obstacle| matches!(obstacle, Obstacle::Convex(_));
        if D != 3 && obstacles.iter().any(is_convex) {
            return Err(invalid("balls and boxes are of space: in the plane they are polygons"));
        }
        Ok(())
    }

    fn add_points(&self, model: &mut Model<D>, addition: &Addition) {
        model.mass.extend(&addition.mass);
        let first = self.count();
        let place = |point: PointId| match point.index().checked_sub(first) {
            Some(new) => truncate(addition.position[new]),
            None => self.place(point.index()),
        };
        let turned = turned(&addition.triangles, place);
        model.triangles.extend(turned.as_ref().unwrap_or(&addition.triangles));
        let old = model.angles.next;
        model.angles.list.extend(addition.angles.iter().zip(old..).map(|(angle, number)| Angle { number, ..*angle }));
        model.angles.next += addition.angles.len() as u32;
        for &point in &addition.pinned {
            if !model.pinned.contains(&point) {
                model.pinned.push(point);
            }
        }
        for (point, knots) in &addition.pin_motion {
            model.pin_motion.retain(|(led, _)| led != point);
            let knots = knots.iter().map(|&(t, x)| (t, truncate(x))).collect();
            model.pin_motion.push((*point, Track { knots }));
        }
        for force in &addition.forces {
            let Force { points, force, torque } = force;
            model.forces.push(Force { points: points.clone(), force: truncate(*force), torque: *torque });
        }
        for (material, points) in &addition.skins {
            points.iter().for_each(|&point| model.skins.set([point], model.skins.of(point).overlaid(*material)));
        }
    }

    /// Works out what is not said of angles and areas that come.
    fn add_form(&self, model: &mut Model<D>, addition: &Addition) {
        let is_joint = |angle: &Angle| angle.range.is_some() && angle.stop == 0.0;
        let has_areas = model.needs_areas() && !addition.triangles.is_empty();
        if !has_areas && !addition.angles.iter().any(is_joint) {
            return;
        }
        let place = |i: usize| match i.checked_sub(self.count()) {
            Some(new) => truncate(addition.position[new]),
            None if self.numbers.is_gone(i as u32) => zero(),
            None => self.place(i),
        };
        let count = model.mass.len();
        let (velocity, bonds) =
            (vec![zero(); count], self.bonds.iter().chain(addition.bonds.iter().copied()).collect());
        // Joints that are there keep how hard they stop; triangles their areas.
        let full = Model { position: (0..count).map(place).collect(), velocity, bonds, ..model.clone() };
        let fresh = full.areas_at_rest();
        model.rest_areas.extend(fresh.into_iter().skip(model.rest_areas.len()));
        if let Some((_, angles)) = full.form_missing() {
            model.angles = angles;
        }
    }

    fn add_obstacles(&self, model: &mut Model<D>, obstacles: &[Obstacle]) -> Result<(), CommandError> {
        for obstacle in obstacles {
            match obstacle {
                &Obstacle::Plane { point, normal, restitution, friction, penalty } => {
                    check_surface(restitution, friction)?;
                    model.planes.push(Plane {
                        point: truncate(point),
                        normal: truncate(normal),
                        restitution,
                        friction,
                        penalty,
                    });
                }
                Obstacle::Polygon(polygon) => {
                    check_surface(polygon.restitution, polygon.friction)?;
                    model.polygons.push(polygon.clone());
                }
                Obstacle::Convex(convex) => {
                    check_surface(convex.restitution, convex.friction)?;
                    model.convex.push(*convex);
                }
            }
        }
        Ok(())
    }

    /// Gives numbers to what comes, and takes the bonds in.
    fn number(&mut self, addition: &Addition) -> Applied {
        let first = self.count() as u32;
        let (bond, obstacle) = (self.numbers.next_bond, self.numbers.next_obstacle);
        let count = addition.bonds.len() as u32;
        if count > 0 {
            if let Some(numbers) = &mut self.numbers.bonds {
                Arc::make_mut(numbers).extend(bond..bond + count);
            }
            Arc::make_mut(&mut self.bonds).extend(addition.bonds.iter().copied());
            self.numbers.next_bond += count;
        }
        for made in &addition.obstacles {
            let list = usize::from(!matches!(made, Obstacle::Plane { .. }));
            self.numbers.obstacles[list].push(self.numbers.next_obstacle);
            self.numbers.next_obstacle += 1;
        }
        let force = self.numbers.next_force;
        self.numbers.next_force += addition.forces.len() as u32;
        self.numbers.forces.extend(force..self.numbers.next_force);
        Applied {
            is_something: true,
            points: first..first + addition.position.len() as u32,
            bonds: bond..self.numbers.next_bond,
            obstacles: obstacle..self.numbers.next_obstacle,
            forces: force..self.numbers.next_force,
            ..Applied::default()
        }
    }

    /// New bodies that would start inside obstacles, counted from the `first` new point on; what is bonded to older points stays.
    fn clear_new(&self, first: u32, addition: &Addition) -> Cleared<D> {
        if !self.model.has_surfaces() || addition.position.is_empty() {
            return Cleared::default();
        }
        let mut w = self.inverse_mass[first as usize..].to_vec();
        let mut bonds = Bonds::new();
        for bond in &addition.bonds {
            match [bond.a, bond.b].map(|end| end.0.checked_sub(first)) {
                [Some(a), Some(b)] => bonds.push(Bond { a: PointId(a), b: PointId(b), ..*bond }),
                ends => ends.into_iter().flatten().for_each(|end| w[end as usize] = 0.0),
            }
        }
        let position: Vec<[f64; D]> = addition.position.iter().map(|&x| truncate(x)).collect();
        plan::clear(&self.obstacles.widened(&*self.model), &bonds, (&position, &w), |_| false)
    }
}

/// Errors: restitution or friction below 0 or not finite.
pub(super) fn check_surface(restitution: f64, friction: f64) -> Result<(), CommandError> {
    let is_fine = |x: f64| x >= 0.0 && x.is_finite();
    if is_fine(restitution) && is_fine(friction) {
        return Ok(());
    }
    Err(invalid("restitution and friction must be finite and >= 0"))
}
