//! Points and obstacles change their place.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::check::finite;
use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::command::Motion;
use crate::sim::contact::convex::{Convex, Rotation};
use crate::sim::contact::polygon::Polygon;
use crate::sim::contact::surface::Plane;
use crate::sim::drive::AngleDrive;
use crate::sim::force::angle::{Angle, measured};
use crate::sim::model::Model;
use crate::sim::plan::{self, Sets};
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, embed, length, scale, sub, truncate, widen};
use crate::sim::world::World;

/// An angle at rest is no nearer to none, or to a whole turn `[rad]`.
const LEAST_ANGLE: f64 = 1e-6;

/// Rest lengths, angles, areas at rest, triangles and torques that follow a scale, by their places in their lists.
struct Scaled {
    /// `[m]`
    rests: Vec<(usize, f64)>,
    angles: Vec<(usize, Angle)>,
    /// `[m^2]`
    areas: Vec<(usize, f64)>,
    /// Corners of what is mirrored, anticlockwise again.
    triangles: Vec<(usize, [PointId; 3])>,
    /// Torques of constant forces on what is mirrored, which turn it the other way `[N m]`.
    torques: Vec<(usize, f64)>,
}

/// Scaled and turned about a place, then moved.
pub(super) struct Placement {
    about: [f64; 3],
    by: [f64; 3],
    /// The turn about an axis `[rad]`.
    angle: f64,
    axis: [f64; 3],
    turn: Turn,
    /// Along x, y and z.
    scale: [f64; 3],
}

/// A turn, ready to be done.
#[derive(Clone, Copy)]
enum Turn {
    /// About z: cos and sin.
    Upright([f64; 2]),
    /// About any axis.
    Free(Rotation),
}

impl Turn {
    fn about(axis: [f64; 3], angle: f64) -> Self {
        match axis == Motion::UPRIGHT {
            true => Turn::Upright([libm::cos(angle), libm::sin(angle)]),
            false => Turn::Free(Rotation::about(axis, angle)),
        }
    }
}

impl Placement {
    fn new(about: [f64; 3], by: [f64; 3], (axis, angle): ([f64; 3], f64), scale: [f64; 3]) -> Self {
        Placement { about, by, angle, axis, turn: Turn::about(axis, angle), scale }
    }

    fn turned(&self, at @ [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self.turn {
            Turn::Upright([cos, sin]) => [cos * x - sin * y, sin * x + cos * y, z],
            Turn::Free(rotation) => rotation.turned(at),
        }
    }

    /// What lengths are multiplied by, where it is the same in the plane whichever way one looks.
    fn even(&self) -> Option<f64> {
        let [x, y, _] = self.scale.map(f64::abs);
        (x == y).then_some(x)
    }

    /// Whether left becomes right in the plane: one factor of two is below 0.
    fn is_mirror(&self) -> bool {
        let [x, y, _] = self.scale;
        x * y < 0.0
    }

    fn scaled(&self, from: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| from[axis] * self.scale[axis])
    }

    /// A part of it, from a share of it to another, where it [`has parts`](Self::has_parts): one after the other they are all of it.
    pub(super) fn between(&self, from: f64, to: f64) -> Self {
        let share = to - from;
        Placement::new(
            add(self.about, scale(self.by, from)),
            scale(self.by, share),
            (self.axis, share * self.angle),
            self.scale.map(|factor| libm::pow(factor, share)),
        )
    }

    /// Whether its parts, one after the other, are all of it.
    pub(super) fn has_parts(&self) -> bool {
        let is_plain = self.scale.iter().all(|factor| *factor > 0.0);
        is_plain && (self.angle == 0.0 || self.even().is_some())
    }

    /// Places a plane.
    fn put_plane<const D: usize>(&self, plane: &mut Plane<D>) {
        plane.point = self.place(plane.point);
        plane.normal = self.normal(plane.normal);
    }

    fn put_polygon(&self, polygon: &mut Polygon) {
        polygon.loops.iter_mut().flatten().for_each(|corner| *corner = self.place(*corner));
    }

    fn put_convex(&self, convex: &mut Convex) {
        let center = self.place(convex.figure.center());
        convex.figure = convex.figure.placed(center, (self.axis, self.angle), self.scale[0]);
    }

    /// Places all obstacles of a model.
    pub(super) fn put<const D: usize>(&self, model: &mut Model<D>) {
        model.planes.iter_mut().for_each(|plane| self.put_plane(plane));
        model.polygons.iter_mut().for_each(|polygon| self.put_polygon(polygon));
        model.convex.iter_mut().for_each(|convex| self.put_convex(convex));
    }

    pub(super) fn place<const D: usize>(&self, x: [f64; D]) -> [f64; D] {
        let from = self.scaled(sub(embed(x), self.about));
        truncate(add(add(self.about, self.turned(from)), self.by))
    }

    /// What a stretch that is seen so far and in this direction gets longer by `[1]`; one of no length by the mean.
    fn stretch<const D: usize>(&self, along: [f64; D]) -> f64 {
        if let Some(factor) = self.even() {
            return factor;
        }
        let (before, after) = (length(embed(along)), length(self.scaled(embed(along))));
        let [x, y, _] = self.scale;
        if before > 0.0 { after / before } else { (x * y).abs().sqrt() }
    }

    /// The normal of a plane that is moved so.
    fn normal<const D: usize>(&self, normal: [f64; D]) -> [f64; D] {
        match self.even() {
            Some(_) => self.direction(normal),
            None => {
                let normal: [f64; 3] = embed(normal);
                self.direction(truncate(std::array::from_fn(|axis| normal[axis] / self.scale[axis].abs())))
            }
        }
    }

    /// Where a direction points afterwards: it is mirrored and turned, not scaled.
    fn direction<const D: usize>(&self, v: [f64; D]) -> [f64; D] {
        let v: [f64; 3] = embed(v);
        let mirrored = std::array::from_fn(|axis| if self.scale[axis] < 0.0 { -v[axis] } else { v[axis] });
        truncate(self.turned(mirrored))
    }
}

/// How far from the origin points may be put `[m]`: further off, a body is smaller than what places are rounded by.
const FARTHEST: f64 = 1e9;

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn shift(&mut self, motion: &Motion) -> Result<Applied, CommandError> {
        let Motion { points, obstacles, by, turn, axis, scale: factors, about, over } = motion;
        self.check_points(points)?;
        self.check_obstacles(obstacles)?;
        finite("by, turn, scale and about", by.iter().chain(about.iter().flatten()).chain(factors).chain([turn]))?;
        if let Some(factor) = factors.iter().find(|factor| **factor == 0.0 || (D == 3 && **factor < 0.0)) {
            let law = if D == 3 { "it must be > 0" } else { "it must not be 0" };
            return Err(invalid(format!("scale is {factor}: {law}")));
        }
        if over.is_some() && factors.iter().any(|factor| *factor < 0.0) {
            return Err(invalid("over is given with a scale below 0: what is mirrored is put there, leave it out"));
        }
        finite("axis", axis.iter())?;
        if *axis == [0.0; 3] {
            return Err(invalid("axis has no length: give it a direction"));
        }
        if D == 2 && axis[..2] != [0.0; 2] {
            return Err(invalid("axis is not z: in the plane all turns are about z"));
        }
        if let Some(over) = over.filter(|over| !(*over > 0.0 && over.is_finite())) {
            return Err(invalid(format!("over is {over}: it must be finite and > 0")));
        }
        if let Some(far) = by.iter().find(|far| far.abs() > 2.0 * FARTHEST) {
            return Err(invalid(format!("by is {far} m: places end at {FARTHEST:e} m")));
        }
        if D == 3 && factors.iter().any(|factor| *factor != factors[0]) {
            return Err(invalid("scale has several factors: give one in space"));
        }
        if points.is_empty() && obstacles.is_empty() {
            return Ok(done(false));
        }
        let about = about.unwrap_or_else(|| self.middle_of(motion));
        let placement = Placement::new(about, *by, (*axis, *turn), *factors);
        let mut numbers: Vec<u32> = points.iter().map(|point| point.0).collect();
        numbers.sort_unstable();
        numbers.dedup();
        // NaN is too far too.
        let is_near = |&i: &u32| placement.place(self.place(i as usize)).iter().all(|x| x.abs() <= FARTHEST);
        if !numbers.iter().all(is_near) {
            return Err(invalid(format!("points would be more than {FARTHEST:e} m away")));
        }
        let mut model = Model::clone(&self.model);
        self.place_obstacles(&mut model, obstacles, &placement);
        model.check_surroundings()?;
        let moved = if obstacles.is_empty() { None } else { Some(Self::obstacles_of(&model)?) };
        self.check_lengths(&numbers, &placement)?;
        let is_moved = |i: usize| numbers.binary_search(&(i as u32)).is_ok();
        let then = |i: usize| if is_moved(i) { placement.place(self.place(i)) } else { self.there(i) };
        if D == 2 && self.model.pinned.len() > 1 && !model.polygons.is_empty() {
            let position = (0..self.count()).map(then).collect();
            self.check_ways_round(&model, (position, &numbers, !obstacles.is_empty()))?;
        }
        let scaled = (*factors != [1.0; 3]).then(|| self.scaled(&numbers, &placement));
        let mut detached = self.detach(&numbers, moved.is_some());
        detached.mirrored = if placement.is_mirror() { numbers.clone() } else { Vec::new() };
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
        let (mut gone, mut jam) = (1.0, None);
        if let Some(mut moved) = moved {
            match *over {
                Some(seconds) => {
                    (gone, jam) = self.push_ahead((&model, obstacles), (&placement, seconds), &mut detached);
                    if gone < 1.0 {
                        self.take_obstacles_back(&mut model);
                        self.place_obstacles(&mut model, obstacles, &placement.between(0.0, gone));
                        // A part of a way that can be gone can cross too many.
                        moved = Self::obstacles_of(&model).unwrap_or_else(|_| {
                            self.take_obstacles_back(&mut model);
                            gone = 0.0;
                            self.obstacles.clone()
                        });
                    }
                }
                None => {
                    let fresh = self.only(&model, obstacles);
                    self.clear_of(&fresh, (&model, &moved), &mut detached);
                }
            }
            self.obstacles = moved;
        } else {
            self.clear_moved(&numbers, &mut model, &mut detached);
        }
        self.model = Arc::new(model);
        if let Some(scaled) = scaled {
            self.take_scaled(scaled);
        }
        self.attach(detached);
        Ok(Applied { gone, jam, ..done(true) })
    }

    /// Obstacles of a model are where those of the world are.
    fn take_obstacles_back(&self, model: &mut Model<D>) {
        model.planes.clone_from(&self.model.planes);
        model.polygons.clone_from(&self.model.polygons);
        model.convex.clone_from(&self.model.convex);
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
    pub(super) fn only(&self, model: &Model<D>, obstacles: &[u32]) -> Model<D> {
        self.chosen(model, |number| obstacles.contains(number))
    }

    /// The surroundings of a model, its walls too, without these obstacles.
    pub(super) fn all_but(&self, model: &Model<D>, obstacles: &[u32]) -> Model<D> {
        Model { bounds: model.bounds, ..self.chosen(model, |number| !obstacles.contains(number)) }
    }

    fn chosen(&self, model: &Model<D>, is_meant: impl Fn(&u32) -> bool) -> Model<D> {
        let [planes, others] = &self.numbers.obstacles;
        let of_planes = model.planes.iter().zip(planes).filter(|(_, number)| is_meant(number));
        let of_polygons = model.polygons.iter().zip(others).filter(|(_, number)| is_meant(number));
        let of_convex = model.convex.iter().zip(others).filter(|(_, number)| is_meant(number));
        Model {
            planes: of_planes.map(|(plane, _)| *plane).collect(),
            polygons: of_polygons.map(|(polygon, _)| polygon.clone()).collect(),
            convex: of_convex.map(|(convex, _)| *convex).collect(),
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
            let is_whole = is_moved(&bond.a) && is_moved(&bond.b);
            let scale = if is_whole { placement.stretch(self.along([bond.a, bond.b])) } else { 1.0 };
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
        let is_meant = |number: &u32| obstacles.contains(number);
        let of_planes = model.planes.iter_mut().zip(planes).filter(|(_, number)| is_meant(number));
        of_planes.for_each(|(plane, _)| placement.put_plane(plane));
        let of_polygons = model.polygons.iter_mut().zip(others).filter(|(_, number)| is_meant(number));
        of_polygons.for_each(|(polygon, _)| placement.put_polygon(polygon));
        let of_convex = model.convex.iter_mut().zip(others).filter(|(_, number)| is_meant(number));
        of_convex.for_each(|(convex, _)| placement.put_convex(convex));
    }

    /// From one point to another `[m]`.
    fn along(&self, [a, b]: [PointId; 2]) -> [f64; D] {
        sub(self.place(b.index()), self.place(a.index()))
    }

    /// What bonds, angles and areas of points alone are at rest once these are placed, and what turns them then.
    fn scaled(&self, points: &[u32], placement: &Placement) -> Scaled {
        let mut is_moved = vec![false; self.count()];
        points.iter().for_each(|&point| is_moved[point as usize] = true);
        let ends = self.bonds.ends().iter().enumerate();
        let ends = ends.filter(|(_, ends)| ends.iter().all(|end| is_moved[end.index()]));
        let rests =
            ends.map(|(k, &ends)| (k, self.bonds.get(k).rest_length * placement.stretch(self.along(ends)))).collect();
        let is_whole = |points: &[PointId; 3]| points.iter().all(|point| is_moved[point.index()]);
        let angles = self.model.angles.list.iter().enumerate().filter(|(_, angle)| is_whole(&angle.points));
        let angles = angles.map(|(k, angle)| (k, self.placed_angle(angle, placement))).collect();
        let [x, y, _] = placement.scale;
        let areas = self.model.rest_areas.iter().zip(&self.model.triangles).enumerate();
        let areas = areas.filter(|(_, (_, corners))| is_whole(corners));
        let areas = areas.map(|(k, (rest, _))| (k, rest * (x * y).abs())).collect();
        let covered = self.model.triangles.iter().enumerate();
        let covered = covered.filter(|(_, corners)| D == 2 && placement.is_mirror() && is_whole(corners));
        let turning = self.model.forces.iter().enumerate().filter(|(_, force)| force.torque != 0.0);
        let turning = turning.filter(|(_, force)| force.points.iter().all(|point| is_moved[point.index()]));
        let torques = turning.filter(|_| placement.is_mirror()).map(|(k, force)| (k, -force.torque)).collect();
        let triangles = covered.map(|(k, &[a, b, c])| (k, [a, c, b])).collect();
        Scaled { rests, angles, areas, triangles, torques }
    }

    /// An angle whose points are placed: at rest, and at its stops, it is turned by as much as it turns; mirrored, it is the rest of a turn, and
    /// what drives it goes the other way.
    fn placed_angle(&self, angle: &Angle, placement: &Placement) -> Angle {
        let [i, j, k] = angle.points;
        let stretches = [[j, i], [j, k]].map(|ends| placement.stretch(self.along(ends)));
        let arms = [0, 1].map(|arm| angle.arms[arm] * stretches[arm]);
        let angle = if placement.is_mirror() { mirrored(angle) } else { *angle };
        if placement.even().is_some() {
            return Angle { arms, ..angle };
        }
        let places: [[f64; D]; 3] = angle.points.map(|point| self.place(point.index()));
        let before = measured(places).0;
        let before = if placement.is_mirror() { -before } else { before };
        let turned = measured(places.map(|place| placement.place(place))).0 - before;
        let turned = libm::atan2(libm::sin(turned), libm::cos(turned));
        let rest = (angle.rest + turned).rem_euclid(TAU).clamp(LEAST_ANGLE, TAU - LEAST_ANGLE);
        Angle { arms, rest, range: angle.range.map(|range| range.map(|stop| stop + turned)), ..angle }
    }

    fn take_scaled(&mut self, Scaled { rests, angles, areas, triangles, torques }: Scaled) {
        let bonds = Arc::make_mut(&mut self.bonds);
        for (k, rest_length) in rests {
            bonds.set(k, Bond { rest_length, ..bonds.get(k) });
        }
        if angles.is_empty() && areas.is_empty() && triangles.is_empty() && torques.is_empty() {
            return;
        }
        let model = Arc::make_mut(&mut self.model);
        angles.into_iter().for_each(|(k, angle)| model.angles.list[k] = angle);
        areas.into_iter().for_each(|(k, rest)| model.rest_areas[k] = rest);
        triangles.into_iter().for_each(|(k, corners)| model.triangles[k] = corners);
        torques.into_iter().for_each(|(k, torque)| model.forces[k].torque = torque);
    }
}

/// An angle as a mirror shows it: between the same points, measured the same way round.
fn mirrored(angle: &Angle) -> Angle {
    // Not -0.
    let other = |x: f64| 0.0 - x;
    let drive = angle.drive.map(|drive| match drive {
        AngleDrive::Servo { amplitude, signal } => AngleDrive::Servo { amplitude: other(amplitude), signal },
        AngleDrive::Motor { speed, torque, signal } => AngleDrive::Motor { speed: other(speed), torque, signal },
    });
    let rest = (TAU - angle.rest).clamp(LEAST_ANGLE, TAU - LEAST_ANGLE);
    Angle { rest, range: angle.range.map(|[least, most]| [TAU - most, TAU - least]), drive, ..*angle }
}
