//! Points and obstacles change their place.

use std::sync::Arc;

use super::check::finite;
use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::command::Motion;
use crate::sim::model::Model;
use crate::sim::plan::{self, Sets};
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, embed, scale, sub, truncate, widen};
use crate::sim::world::World;

/// Scaled and turned about a place, then moved.
struct Placement {
    about: [f64; 3],
    by: [f64; 3],
    /// The turn about z `[rad]`, and its cos and sin.
    angle: f64,
    turn: [f64; 2],
    scale: f64,
}

impl Placement {
    fn turned(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [cos, sin] = self.turn;
        [cos * x - sin * y, sin * x + cos * y, z]
    }

    fn place<const D: usize>(&self, x: [f64; D]) -> [f64; D] {
        let from = scale(sub(embed(x), self.about), self.scale);
        truncate(add(add(self.about, self.turned(from)), self.by))
    }

    fn direction<const D: usize>(&self, v: [f64; D]) -> [f64; D] {
        truncate(self.turned(embed(v)))
    }
}

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn shift(&mut self, motion: &Motion) -> Result<Applied, CommandError> {
        let Motion { points, obstacles, by, turn, scale: factor, about } = motion;
        self.check_points(points)?;
        self.check_obstacles(obstacles)?;
        finite("by, turn, scale and about", by.iter().chain(about.iter().flatten()).chain([turn, factor]))?;
        if *factor <= 0.0 {
            return Err(invalid(format!("scale is {factor}: it must be > 0")));
        }
        if points.is_empty() && obstacles.is_empty() {
            return Ok(done(false));
        }
        let about = about.unwrap_or_else(|| self.middle_of(motion));
        let placement =
            Placement { about, by: *by, angle: *turn, turn: [libm::cos(*turn), libm::sin(*turn)], scale: *factor };
        let mut numbers: Vec<u32> = points.iter().map(|point| point.0).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let is_finite = |&i: &u32| placement.place(self.place(i as usize)).iter().all(|x| x.is_finite());
        if !numbers.iter().all(is_finite) {
            return Err(invalid("points would be too far away for a number"));
        }
        let mut model = Model::clone(&self.model);
        self.place_obstacles(&mut model, obstacles, &placement);
        model.check_surroundings().map_err(|error| invalid(error.to_string()))?;
        let moved = if obstacles.is_empty() { None } else { Some(Self::obstacles_of(&model)?) };
        self.check_lengths(&numbers, &placement)?;
        let mut detached = self.detach(&numbers, moved.is_some());
        for (point, track) in &mut model.pin_motion {
            if numbers.binary_search(&point.0).is_ok() {
                track.knots.iter_mut().for_each(|(_, x)| *x = placement.place(*x));
            }
        }
        for place in detached.places(numbers.iter().copied()) {
            let state = &mut detached.state;
            state.position[place] = convert(placement.place(widen(state.position[place])));
            state.velocity[place] = convert(placement.direction(widen(state.velocity[place])));
            state.position_lost[place] = [S::ZERO; D];
            state.velocity_lost[place] = [S::ZERO; D];
        }
        if let Some(moved) = moved {
            let fresh = self.only(&model, obstacles);
            self.clear_of(&fresh, (&model, &moved), &mut detached);
            self.obstacles = moved;
        }
        self.model = Arc::new(model);
        if *factor != 1.0 {
            self.scale_bonds(&numbers, *factor);
        }
        self.attach(detached);
        Ok(done(true))
    }

    /// The mean of the points, or of the corners of the obstacles where there are none.
    fn middle_of(&self, motion: &Motion) -> [f64; 3] {
        let mean = |places: &[[f64; 3]]| {
            let sum = places.iter().fold([0.0; 3], |sum, &x| add(sum, x));
            scale(sum, 1.0 / places.len().max(1) as f64)
        };
        if !motion.points.is_empty() {
            let places: Vec<[f64; 3]> = motion.points.iter().map(|point| embed(self.place(point.index()))).collect();
            return mean(&places);
        }
        let [planes, others] = &self.numbers.obstacles;
        let is_meant = |number: &&u32| motion.obstacles.contains(number);
        let named = |list: &[u32]| -> Vec<usize> {
            list.iter().enumerate().filter(|(_, number)| is_meant(number)).map(|(place, _)| place).collect()
        };
        let mut places: Vec<[f64; 3]> =
            named(planes).into_iter().map(|place| embed(self.model.planes[place].point)).collect();
        for place in named(others) {
            let polygon = self.model.polygons.get(place).into_iter();
            places.extend(polygon.flat_map(|polygon| &polygon.loops).flatten().map(|&x| embed(x)));
            places.extend(self.model.convex.get(place).map(|convex| convex.figure.center()));
        }
        mean(&places)
    }

    /// The surroundings of a model, with these obstacles of it alone.
    fn only(&self, model: &Model<D>, obstacles: &[u32]) -> Model<D> {
        let [planes, others] = &self.numbers.obstacles;
        let is_meant = |number: &u32| obstacles.contains(number);
        Model {
            planes: model.planes.iter().zip(planes).filter(|(_, n)| is_meant(n)).map(|(plane, _)| *plane).collect(),
            polygons: model
                .polygons
                .iter()
                .zip(others)
                .filter(|(_, n)| is_meant(n))
                .map(|(on, _)| on.clone())
                .collect(),
            convex: model.convex.iter().zip(others).filter(|(_, n)| is_meant(n)).map(|(on, _)| *on).collect(),
            ..Model::default()
        }
    }

    /// Errors: a part of a body is moved whose rigid bonds to the rest of it hold it where it is.
    fn check_lengths(&self, points: &[u32], placement: &Placement) -> Result<(), CommandError> {
        let is_moved = |end: &PointId| points.binary_search(&end.0).is_ok();
        let is_torn = |ends: &[PointId; 2]| is_moved(&ends[0]) != is_moved(&ends[1]);
        let torn: Vec<u32> = (0..self.bonds.len())
            .filter(|&k| is_torn(&self.bonds.ends()[k]) && self.bonds.get(k).is_held())
            .flat_map(|k| self.bonds.ends()[k].map(|end| end.0))
            .collect();
        if torn.is_empty() {
            return Ok(());
        }
        let mut sets = Sets::new(self.count());
        self.bonds.ends().iter().for_each(|[a, b]| sets.join(a.0, b.0));
        let mut roots: Vec<u32> = torn.iter().map(|&point| sets.find(point)).collect();
        roots.sort_unstable();
        roots.dedup();
        let mut local = vec![u32::MAX; self.count()];
        let (mut position, mut w) = (Vec::new(), Vec::new());
        for i in 0..self.count() as u32 {
            if roots.binary_search(&sets.find(i)).is_ok() {
                local[i as usize] = position.len() as u32;
                let place = self.place(i as usize);
                position.push(if points.binary_search(&i).is_ok() { placement.place(place) } else { place });
                w.push(self.inverse_mass[i as usize]);
            }
        }
        let mut bonds = Bonds::new();
        for bond in self.bonds.iter().filter(|bond| bond.is_held() && local[bond.a.index()] != u32::MAX) {
            let scale = if is_moved(&bond.a) && is_moved(&bond.b) { placement.scale } else { 1.0 };
            let [a, b] = [bond.a, bond.b].map(|end| PointId(local[end.index()]));
            bonds.push(Bond { a, b, rest_length: scale * bond.rest_length, ..bond });
        }
        // Larger bodies keep their lengths to a strain, and find back to it by themselves.
        if !plan::is_direct(bonds.len()) || plan::reconcile(&mut bonds, &mut position, &w).is_empty() {
            return Ok(());
        }
        Err(invalid(
            "rigid bonds to the rest of the body do not let these points be moved so: move the whole body, or grab it",
        ))
    }

    fn place_obstacles(&self, model: &mut Model<D>, obstacles: &[u32], placement: &Placement) {
        let [planes, others] = &self.numbers.obstacles;
        for (plane, _) in model.planes.iter_mut().zip(planes).filter(|(_, number)| obstacles.contains(number)) {
            plane.point = placement.place(plane.point);
            plane.normal = placement.direction(plane.normal);
        }
        for (polygon, _) in model.polygons.iter_mut().zip(others).filter(|(_, number)| obstacles.contains(number)) {
            polygon.loops.iter_mut().flatten().for_each(|corner| *corner = placement.place(*corner));
        }
        for (convex, _) in model.convex.iter_mut().zip(others).filter(|(_, number)| obstacles.contains(number)) {
            let center = placement.place(convex.figure.center());
            convex.figure = convex.figure.placed(center, placement.angle, placement.scale);
        }
    }

    /// Rest lengths of bonds with both ends among points are multiplied, arms of angles and areas likewise.
    fn scale_bonds(&mut self, points: &[u32], factor: f64) {
        let mut is_moved = vec![false; self.count()];
        points.iter().for_each(|&point| is_moved[point as usize] = true);
        let bonds = Arc::make_mut(&mut self.bonds);
        for k in 0..bonds.len() {
            if bonds.ends()[k].iter().all(|end| is_moved[end.index()]) {
                let bond = bonds.get(k);
                bonds.set(k, Bond { rest_length: bond.rest_length * factor, ..bond });
            }
        }
        if self.model.angles.list.is_empty() && self.model.rest_areas.is_empty() {
            return;
        }
        let is_whole = |points: &[PointId; 3]| points.iter().all(|point| is_moved[point.index()]);
        let model = Arc::make_mut(&mut self.model);
        for angle in model.angles.list.iter_mut().filter(|angle| is_whole(&angle.points)) {
            angle.arms = angle.arms.map(|arm| factor * arm);
        }
        let areas = model.rest_areas.iter_mut().zip(&model.triangles).filter(|(_, corners)| is_whole(corners));
        areas.for_each(|(rest, _)| *rest *= factor * factor);
    }
}
