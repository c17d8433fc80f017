//! A copy of what is selected in a running world, as it is now: the keys that bring it again, here or in another scene.

mod dress;
mod keys;
mod led;
mod room;
mod space;
#[cfg(test)]
mod tests;

use super::matter::Among;
use super::player::Coming;
use super::tools::Chosen;
use crate::history::{Do, History};
use crate::render::Camera;
use crate::scene::{
    AddKeys, ContactKeys, ForceKeys, Fragment, MassKeys, ObstacleKeys, PointGroupKeys, PointKeys, Row, SkinKeys, Vector,
};
use crate::sim::{Dynamics, PointId};
use keys::{angle_keys, bond_keys, solid};
pub(super) use room::IN_ANOTHER;

/// What was copied: the keys that bring it, its points counted from 0, where it was.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Clip {
    keys: AddKeys,
    /// How bodies met where it was copied.
    contact: Option<ContactKeys>,
    /// Points that were selected as one.
    groups: Vec<PointGroupKeys>,
    pub(super) dimensions: usize,
    /// The middle of all of it `[m]`.
    pub(super) middle: [f64; 3],
}

/// Where a copy is to come.
#[derive(Clone, Debug)]
pub(super) struct Wish {
    /// What putting it there is called.
    pub(super) name: &'static str,
    /// From where it was `[m]`.
    pub(super) by: [f64; 3],
    /// It may be there though a part of it is out of view.
    pub(super) is_meant: bool,
    /// It is beside what it is of, at whichever side has room.
    pub(super) is_beside: bool,
    /// How the world is looked at.
    pub(super) camera: Camera,
    /// What panels leave free of the picture: left and upper, right and lower end `[px]`.
    pub(super) free: [[f64; 2]; 2],
}

impl Clip {
    /// What is chosen in a world: points with velocities, masses, pins, colours and what their skins are made of; bonds with their drives,
    /// triangles, angles and constant forces among them, the pictures that are drawn on them, their groups; obstacles. Its pins are led on
    /// as those of the original are from now on.
    pub(super) fn of(history: &History, chosen: &Chosen) -> Self {
        // What is led to other numbers is copied as it will be.
        let ahead = history.ahead();
        let world = ahead.as_deref().unwrap_or(history.world());
        let dimensions = world.dimensions();
        let points: Vec<PointId> =
            chosen.points.iter().copied().filter(|point| world.gone().binary_search(point).is_err()).collect();
        let sample = world.sample(world.time());
        let place = |point: PointId| points.binary_search(&point).ok().map(|place| place as u32);
        let vector = |x: [f64; 3]| Vector::new(x, dimensions);
        let of = |point: &PointId| point.index();
        let obstacles = world.obstacles().into_iter().filter(|(number, _)| chosen.obstacles.contains(number));
        let obstacles: Vec<ObstacleKeys> = obstacles.map(|(_, obstacle)| solid(&obstacle, dimensions)).collect();
        let covered = |corners: &[PointId; 3]| {
            let [a, b, c] = corners.map(place);
            Some(Row([a?, b?, c?]))
        };
        let force = |view: crate::sim::ForceView| {
            let points = view.points.iter().map(|&point| place(point)).collect::<Option<Vec<u32>>>()?;
            let torque = (view.torque != 0.0).then_some(view.torque);
            Some(ForceKeys { points, force: Some(vector(view.force)), torque })
        };
        let bonds = world.bonds().iter().filter_map(|bond| Some(bond_keys(bond, place(bond.a)?, place(bond.b)?)));
        let mut keys = AddKeys {
            bonds: bonds.collect(),
            triangles: world.triangles().iter().filter_map(covered).collect(),
            skins: dress::skins(history, &points),
            looks: dress::looks(history, &points),
            textures: dress::textures(history.skins(), &points),
            forces: world.forces().into_iter().filter_map(force).collect(),
            angles: world.angles().iter().filter_map(|angle| angle_keys(angle, place)).collect(),
            obstacles,
            pin_motion: led::ways(world, place),
            ..AddKeys::default()
        };
        if !points.is_empty() {
            keys.points = Some(PointKeys {
                position: points.iter().map(|point| vector(sample.position[of(point)])).collect(),
                velocity: Some(points.iter().map(|point| vector(sample.velocity[of(point)])).collect()),
                mass: Some(MassKeys::Each(points.iter().map(|point| world.masses()[of(point)]).collect())),
                pinned: world.pinned().iter().filter_map(|&pin| place(pin)).collect(),
            });
        }
        let middle = middle(&keys);
        let groups = dress::groups(history.groups(), place);
        Clip { keys, contact: world.contact().map(ContactKeys::from), groups, dimensions, middle }
    }

    /// The keys that bring it `by` `[m]` from where it was into a world. What its skins had from the scene that it was copied in travels with
    /// it, where that is not the same here.
    pub(super) fn placed(&self, world: &dyn Dynamics, by: [f64; 3]) -> AddKeys {
        let next = world.next_numbers()[0];
        let mut keys = self.keys.clone();
        self.keep_matter(&mut keys, world);
        let moved = |x: &mut Vector| {
            let place = x.embed();
            *x = Vector::new(std::array::from_fn(|axis| place[axis] + by[axis]), self.dimensions);
        };
        if let Some(points) = &mut keys.points {
            points.position.iter_mut().for_each(moved);
            points.pinned.iter_mut().for_each(|pin| *pin += next);
        }
        keys.bonds.iter_mut().for_each(|bond| (bond.a, bond.b) = (bond.a + next, bond.b + next));
        keys.triangles.iter_mut().flat_map(|corners| &mut corners.0).for_each(|corner| *corner += next);
        keys.angles.iter_mut().flat_map(|angle| &mut angle.points.0).for_each(|point| *point += next);
        keys.skins.iter_mut().flat_map(|skin| &mut skin.points).for_each(|point| *point += next);
        keys.looks.iter_mut().flat_map(|look| &mut look.points).for_each(|point| *point += next);
        keys.textures.iter_mut().flat_map(|texture| &mut texture.points).for_each(|point| *point += next);
        keys.forces.iter_mut().flat_map(|force| &mut force.points).for_each(|point| *point += next);
        led::put(&mut keys.pin_motion, (world.time(), by, next));
        for obstacle in &mut keys.obstacles {
            obstacle.plane.iter_mut().for_each(|plane| moved(&mut plane.point));
            obstacle.circle.iter_mut().for_each(|circle| moved(&mut circle.center));
            obstacle.polygon.iter_mut().flatten().flatten().for_each(moved);
            if let Some(solid) = &mut obstacle.r#box {
                [&mut solid.min, &mut solid.max].into_iter().for_each(moved);
            }
        }
        keys
    }

    /// What brings it where it is wished, or as near to that as there is room in view.
    ///
    /// Errors: in words, that there is no room for it.
    pub(super) fn coming(&self, history: &History, wish: &Wish) -> Result<Coming, String> {
        let world = history.world();
        let room::Place { by, lies_in } = room::place(self, history, wish)?;
        let [next, _, next_obstacle] = world.next_numbers();
        let mut commands = vec![Do::Add(Box::new(self.placed(world, by)))];
        commands.extend(dress::named(&self.groups, history.named(), next));
        let [points, obstacles] = self.counts();
        let came = Among {
            points: (next..next + points).map(PointId).collect(),
            obstacles: (next_obstacle..next_obstacle + obstacles).collect(),
            bonds: None,
        };
        Ok(Coming { commands, name: wish.name, came: Some((came, lies_in)) })
    }

    /// Skins that are as the scene said keep that where this one says otherwise.
    fn keep_matter(&self, keys: &mut AddKeys, world: &dyn Dynamics) {
        let Some(was) = self.contact else { return };
        // Where nothing meets, what comes makes all meet as is usual.
        let is = world.contact().unwrap_or_default();
        let friction = was.friction.filter(|friction| *friction != is.friction);
        let restitution = was.restitution.filter(|restitution| *restitution != is.restitution);
        let radius = was.radius.filter(|radius| is.radius != Some(*radius));
        if friction.is_none() && restitution.is_none() && radius.is_none() {
            return;
        }
        for skin in &mut keys.skins {
            skin.friction = skin.friction.or(friction);
            skin.restitution = skin.restitution.or(restitution);
            skin.radius = skin.radius.or(radius);
        }
        let mut is_said = vec![false; keys.points.as_ref().map_or(0, |points| points.position.len())];
        keys.skins.iter().flat_map(|skin| &skin.points).for_each(|&point| is_said[point as usize] = true);
        let points: Vec<u32> = (0..).zip(is_said).filter(|(_, is_said)| !is_said).map(|(point, _)| point).collect();
        if !points.is_empty() {
            keys.skins.push(SkinKeys { points, friction, restitution, radius, ..SkinKeys::default() });
        }
    }

    /// The same as a part of a scene, to be written as text.
    pub(super) fn fragment(&self) -> Fragment {
        let Clip { keys, contact, groups, dimensions, middle } = self.clone();
        Fragment { keys, contact, groups, dimensions, middle }
    }

    /// What a part of a scene brings.
    pub(super) fn of_fragment(Fragment { keys, contact, groups, dimensions, middle }: Fragment) -> Self {
        Clip { keys, contact, groups, dimensions, middle }
    }

    /// How many points it brings, and how many obstacles.
    pub(super) fn counts(&self) -> [u32; 2] {
        let points = self.keys.points.as_ref().map_or(0, |points| points.position.len());
        [points as u32, self.keys.obstacles.len() as u32]
    }
}

/// The middle of the box around points and solid obstacles, of the points of planes where there is nothing else `[m]`.
fn middle(keys: &AddKeys) -> [f64; 3] {
    let of_points = keys.points.iter().flat_map(|points| &points.position);
    let of_solids = keys.obstacles.iter().flat_map(|obstacle| {
        let corners = obstacle.polygon.iter().flatten().flatten();
        let ends = obstacle.r#box.iter().flat_map(|solid| [&solid.min, &solid.max]);
        corners.chain(obstacle.circle.iter().map(|circle| &circle.center)).chain(ends)
    });
    let solid: Vec<[f64; 3]> = of_points.chain(of_solids).map(Vector::embed).collect();
    let planes = || keys.obstacles.iter().filter_map(|obstacle| Some(obstacle.plane.as_ref()?.point.embed()));
    let places = if solid.is_empty() { planes().collect() } else { solid };
    let along = |axis: usize| {
        let ends = places
            .iter()
            .map(|x| x[axis])
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        0.5 * (ends[0] + ends[1])
    };
    if places.is_empty() { [0.0; 3] } else { [along(0), along(1), along(2)] }
}
