//! Points and obstacles change their place.

use std::sync::Arc;

use super::check::finite;
use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::Bond;
use crate::sim::command::Motion;
use crate::sim::model::Model;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, embed, scale, sub, truncate, widen};
use crate::sim::world::World;

/// Scaled and turned about a place, then moved.
struct Placement {
    about: [f64; 3],
    by: [f64; 3],
    /// cos and sin of the turn about z.
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
        let placement = Placement { about, by: *by, turn: [libm::cos(*turn), libm::sin(*turn)], scale: *factor };
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
        let mut detached = self.detach(&numbers, moved.is_some());
        for (point, track) in &mut model.pin_motion {
            if numbers.binary_search(&point.0).is_ok() {
                track.knots.iter_mut().for_each(|(_, x)| *x = placement.place(*x));
            }
        }
        self.model = Arc::new(model);
        self.obstacles = moved.unwrap_or_else(|| self.obstacles.clone());
        for place in detached.places(numbers.iter().copied()) {
            let state = &mut detached.state;
            state.position[place] = convert(placement.place(widen(state.position[place])));
            state.velocity[place] = convert(placement.direction(widen(state.velocity[place])));
            state.position_lost[place] = [S::ZERO; D];
            state.velocity_lost[place] = [S::ZERO; D];
        }
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
        let [planes, polygons] = &self.numbers.obstacles;
        let is_meant = |number: &&u32| motion.obstacles.contains(number);
        let named = |list: &[u32]| -> Vec<usize> {
            list.iter().enumerate().filter(|(_, number)| is_meant(number)).map(|(place, _)| place).collect()
        };
        let mut places: Vec<[f64; 3]> =
            named(planes).into_iter().map(|place| embed(self.model.planes[place].point)).collect();
        for place in named(polygons) {
            places.extend(self.model.polygons[place].loops.iter().flatten().map(|&x| embed(x)));
        }
        mean(&places)
    }

    fn place_obstacles(&self, model: &mut Model<D>, obstacles: &[u32], placement: &Placement) {
        let [planes, polygons] = &self.numbers.obstacles;
        for (plane, _) in model.planes.iter_mut().zip(planes).filter(|(_, number)| obstacles.contains(number)) {
            plane.point = placement.place(plane.point);
            plane.normal = placement.direction(plane.normal);
        }
        for (polygon, _) in model.polygons.iter_mut().zip(polygons).filter(|(_, number)| obstacles.contains(number)) {
            polygon.loops.iter_mut().flatten().for_each(|corner| *corner = placement.place(*corner));
        }
    }

    /// Rest lengths of bonds with both ends among points are multiplied.
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
    }
}
