//! What is added to a running world, made: bodies become points and bonds, numbers those of the world.

use std::ops::Range;

use super::check;
use super::error::{Fault, SceneError, Source, Within};
use super::keys::{AddKeys, BodyKeys, BondKeys, BondList, DrawnKeys, LookKeys, ObstacleKeys, PointKeys, Scene};
use super::model::{angle, anticlockwise, force, material, of_length, rest_length, skin};
use super::one_line;
use super::support;
use crate::picture::{Coat, Skin, Tint};
use crate::sim::vector::{embed, truncate};
use crate::sim::{self, Addition, Angle, Bond, Dynamics, Model, PointId, SkinMaterial};

/// What keys of an addition come to.
#[derive(Clone, Debug)]
pub(crate) struct Made {
    /// For the world.
    pub(crate) addition: Addition,
    /// What is drawn on new bodies, by the numbers of the world.
    pub(crate) skins: Vec<Skin>,
    /// Which bodies new points are of, counted from 0, by the numbers of the world.
    pub(crate) tints: Vec<Tint>,
    /// What is known of those, by their numbers.
    pub(crate) known: Vec<Known>,
    /// Points with the colours that they get.
    pub(crate) coats: Vec<(Vec<u32>, Coat)>,
}

/// What is known of a body that comes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Known {
    /// What it is called: see [`Scene::body_names`].
    pub(crate) name: Option<String>,
    /// Which colour of the palette it has, if it is to have one.
    pub(crate) hue: Option<u32>,
}

/// Pinned points with the knots of their tracks.
type Tracks = Vec<(PointId, Vec<(f64, [f64; 3])>)>;

/// What keys of the plane bring, without the world.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shape {
    /// Of new points `[m]`.
    pub(crate) places: Vec<[f64; 2]>,
    /// Between new points, counted from 0.
    pub(crate) bonds: Vec<[u32; 2]>,
    /// What bodies cover, by new points counted from 0.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// New points that pins or older points hold, counted from 0.
    pub(crate) pinned: Vec<u32>,
    /// A point and the normal of each plane.
    pub(crate) planes: Vec<[[f64; 3]; 2]>,
    /// The other obstacles.
    pub(crate) polygons: Vec<sim::Polygon>,
}

impl AddKeys {
    /// What the keys bring into a world of the plane whose next point gets the number `next`; `None` where they are not in order.
    pub(crate) fn shape(&self, next: u32) -> Option<Shape> {
        let model: Model<2> = self.alone(&Scene::default()).to_model().ok()?;
        let mut bonds: Vec<[u32; 2]> = model.bonds.ends().iter().map(|ends| ends.map(|end| end.0)).collect();
        let mut pinned: Vec<u32> = model.pinned.iter().map(|pin| pin.0).collect();
        pinned.extend(self.points.iter().flat_map(|points| &points.pinned).filter_map(|pin| pin.checked_sub(next)));
        for bond in &self.bonds {
            match [bond.a, bond.b].map(|end| end.checked_sub(next)) {
                [Some(a), Some(b)] => bonds.push([a, b]),
                ends => pinned.extend(ends.into_iter().flatten()),
            }
        }
        let count = model.position.len() as u32;
        pinned.retain(|pin| *pin < count);
        bonds.retain(|ends| ends.iter().all(|end| *end < count));
        let planes = model.planes.iter().map(|plane| [plane.point, plane.normal].map(embed)).collect();
        let explicit = self.triangles.iter().map(|corners| corners.0.map(|corner| corner.checked_sub(next)));
        let explicit = explicit.filter_map(|[a, b, c]| Some([a?, b?, c?]));
        let of_bodies = model.triangles.iter().map(|corners| corners.map(|corner| corner.0));
        let triangles = explicit.filter(|corners| corners.iter().all(|corner| *corner < count)).chain(of_bodies);
        let triangles = triangles.collect();
        Some(Shape { places: model.position, bonds, triangles, pinned, planes, polygons: model.polygons })
    }

    /// How many points the keys bring into a world of `scene`, as their makers count them: bodies that are not in order bring none. Nothing is
    /// made but the meshes of pictures, which are kept for what makes the bodies.
    pub(crate) fn point_count(&self, scene: &Scene) -> usize {
        let listed = self.points.as_ref().map_or(0, |points| points.position.len());
        let of_body = |keys: &BodyKeys| check::count_checked(keys, scene).map_or(0, |count| count as usize);
        listed + self.bodies.iter().map(of_body).sum::<usize>()
    }

    /// The balls and boxes that the keys bring into a world of space; none where they are not in order.
    pub(crate) fn figures(&self) -> Vec<sim::Figure> {
        let solids = AddKeys { obstacles: self.obstacles.clone(), ..AddKeys::default() };
        let model = solids.alone(&Scene { dimensions: Some(3), ..Scene::default() }).to_model::<3>();
        model.map_or_else(|_| Vec::new(), |model| model.convex.iter().map(|convex| convex.figure).collect())
    }

    /// Makes what the keys say, for a world of `scene` as it is now.
    ///
    /// Errors: as of a scene with these keys; bonds between points that the world will not have.
    pub(crate) fn make(&self, scene: &Scene, world: &dyn Dynamics) -> Result<Made, SceneError> {
        let made = match scene.dimensions() {
            2 => self.made::<2>(scene, world),
            _ => self.made::<3>(scene, world),
        };
        // The place is that of a command, not of the scene's file.
        made.map_err(|fault| Source::default().error(fault))
    }

    fn made<const D: usize>(&self, scene: &Scene, world: &dyn Dynamics) -> Result<Made, Fault> {
        let first = world.next_numbers()[0].max(world.point_count() as u32);
        let alone = self.alone(scene);
        let model: Model<D> = alone.to_model()?;
        let count = first.checked_add(model.position.len() as u32);
        let count = count.ok_or_else(|| Fault::invalid("would be more points than 32 bits can count"))?;
        let offset = |point: PointId| PointId(first + point.0);
        let position: Vec<[f64; 3]> = model.position.iter().map(|&x| embed(x)).collect();
        let of_bodies = model.bonds.iter().map(|bond| Bond { a: offset(bond.a), b: offset(bond.b), ..bond });
        let mut bonds = self.explicit_bonds(&alone, (world, first, count), &position)?;
        bonds.extend(of_bodies);
        let mut pinned: Vec<PointId> = model.pinned.iter().copied().map(offset).collect();
        pinned.extend(self.points.iter().flat_map(|points| &points.pinned).map(|&point| PointId(point)));
        for (i, motion) in self.pin_motion.iter().enumerate() {
            check::check_pin_motion(motion, D, &|_| true).item(i).at("pin_motion")?;
        }
        check::check_triangles(&self.triangles, count)?;
        check::check_skins(&self.skins, count)?;
        check::check_forces(&self.forces, count, D)?;
        let mut skins: Vec<(SkinMaterial, Vec<PointId>)> = Vec::new();
        for (material, points) in model.skins.lists() {
            skins.push((material, points.into_iter().map(|point| offset(PointId(point))).collect()));
        }
        // A colour alone is no material.
        skins.extend(self.skins.iter().map(skin).filter(|(material, _)| *material != SkinMaterial::default()));
        let explicit = self.triangles.iter().map(|corners| {
            let own = |corner: u32| place(world, (first, &position), corner);
            anticlockwise(corners.0, own).map(PointId)
        });
        let of_bodies = model.triangles.iter().map(|corners| corners.map(offset));
        let triangles = explicit.chain(of_bodies).collect();
        check::check_angles(&self.angles, count, D)?;
        let own = |point: u32| truncate(place(world, (first, &position), point));
        let mut angles = Vec::new();
        for (k, keys) in self.angles.iter().enumerate() {
            angles.push(angle(keys, own).item(k).at("angles")?);
        }
        angles.extend(model.angles.list.iter().map(|angle| Angle { points: angle.points.map(offset), ..*angle }));
        check::check_looks(&self.looks, first..count)?;
        let (tints, known) = self.tints(&alone, first..count)?;
        Ok(Made {
            skins: self.skins(&alone, (first, count), world)?,
            tints,
            known,
            coats: self
                .skins
                .iter()
                .map(|skin| (skin.points.clone(), skin.coat()))
                .filter(|(_, coat)| !coat.is_empty())
                .collect(),
            addition: Addition {
                position,
                velocity: model.velocity.iter().map(|&v| embed(v)).collect(),
                obstacles: self.solids(&model),
                mass: model.mass,
                pinned,
                bonds,
                pin_motion: self.tracks(D),
                triangles,
                forces: self.forces.iter().map(force).collect(),
                skins,
                angles,
            },
        })
    }

    /// The scene of the new points, bodies and obstacles alone, under the method of `scene`.
    fn alone(&self, scene: &Scene) -> Scene {
        let points = self.points.clone();
        Scene {
            dimensions: scene.dimensions,
            points: points.map(|points| PointKeys { pinned: Vec::new(), ..points }),
            bodies: self.bodies.clone(),
            obstacles: self.obstacles.clone(),
            method: scene.method.clone(),
            source: Source { text: None, ..scene.source.clone() },
            ..Scene::default()
        }
    }

    /// The bonds of the keys: between points of the world below `first` and new ones at `new`, `count` in all.
    fn explicit_bonds(
        &self,
        alone: &Scene,
        (world, first, count): (&dyn Dynamics, u32, u32),
        new: &[[f64; 3]],
    ) -> Result<Vec<Bond>, Fault> {
        let list: BondList = self.bonds.clone().into();
        check::check_bonds(&list, count).at("bonds")?;
        let with_bonds = Scene { bonds: list, ..alone.clone() };
        support::method(&with_bonds)?;
        let place = |point: u32| place(world, (first, new), point);
        let bond = |(k, keys): (usize, &BondKeys)| {
            let rest_length = match keys.rest {
                Some(rest) => rest,
                None => rest_length(place(keys.a), place(keys.b)).item(k).at("bonds")?,
            };
            of_length(material(keys), keys, rest_length).item(k).at("bonds")
        };
        self.bonds.iter().enumerate().map(bond).collect()
    }

    /// The obstacles in the order of the keys; a model has planes and all others apart.
    fn solids<const D: usize>(&self, model: &Model<D>) -> Vec<sim::Obstacle> {
        let mut planes = model.planes.iter().map(|plane| sim::Obstacle::Plane {
            point: embed(plane.point),
            normal: embed(plane.normal),
            restitution: plane.restitution,
            friction: plane.friction,
            penalty: plane.penalty,
        });
        let polygons = model.polygons.iter().cloned().map(sim::Obstacle::Polygon);
        let mut others = polygons.chain(model.convex.iter().copied().map(sim::Obstacle::Convex));
        let is_plane = |keys: &ObstacleKeys| keys.plane.is_some();
        let next = |keys| if is_plane(keys) { planes.next() } else { others.next() };
        self.obstacles.iter().filter_map(next).collect()
    }

    fn tracks(&self, dimensions: usize) -> Tracks {
        let place = |row: &Vec<f64>| std::array::from_fn(|axis| if axis < dimensions { row[axis + 1] } else { 0.0 });
        let knots = |track: &Vec<Vec<f64>>| track.iter().map(|row| (row[0], place(row))).collect();
        self.pin_motion.iter().map(|motion| (PointId(motion.point), knots(&motion.track))).collect()
    }

    fn skins(&self, alone: &Scene, (first, count): (u32, u32), world: &dyn Dynamics) -> Result<Vec<Skin>, Fault> {
        let mut skins = alone.all_skins()?;
        for skin in &mut skins {
            skin.first += first;
            skin.triangles.iter_mut().flatten().for_each(|corner| *corner += first);
        }
        for (i, texture) in self.textures.iter().enumerate() {
            skins.extend(self.drawn(texture, alone, (count, world)).item(i).at("textures")?);
        }
        Ok(skins)
    }

    /// What a picture is drawn on among the triangles of the keys and of the world: those with all corners among its points, of which there
    /// are `count`. `None`: on nothing.
    fn drawn(
        &self,
        texture: &DrawnKeys,
        alone: &Scene,
        (count, world): (u32, &dyn Dynamics),
    ) -> Result<Option<Skin>, Fault> {
        let DrawnKeys { image, points, uv } = texture;
        check::check_image(image).at("image")?;
        if points.len() != uv.len() {
            let message = format!("has {} places for {} points: give one each", uv.len(), points.len());
            return Err(Fault::invalid(message).at("uv"));
        }
        if let Some(other) = points.iter().find(|point| **point >= count) {
            let message = format!("names point {other}, and there are {count}: name points that are there");
            return Err(Fault::invalid(message).at("points"));
        }
        if let Some(k) = uv.iter().position(|uv| !uv.0.iter().all(|x| x.is_finite())) {
            return Err(Fault::invalid("is no place: give two numbers").item(k).at("uv"));
        }
        let picture = alone.source.picture(image).at("image")?;
        let Some(first) = points.iter().copied().min() else { return Ok(None) };
        let end = points.iter().copied().max().unwrap_or(first);
        let mut places = vec![None; (end - first) as usize + 1];
        for (point, uv) in points.iter().zip(uv) {
            places[(point - first) as usize] = Some(uv.0.map(|x| x as f32));
        }
        let has = |corner: &u32| corner.checked_sub(first).and_then(|k| *places.get(k as usize)?).is_some();
        let of_world = world.triangles().iter().map(|corners| corners.map(|corner| corner.0));
        let triangles = self.triangles.iter().map(|corners| corners.0).chain(of_world);
        let triangles = triangles.filter(|corners| corners.iter().all(has));
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let texture = places.iter().map(|place| place.unwrap_or_default()).collect();
        Ok((!triangles.is_empty()).then_some(Skin { picture, first, triangles, texture }))
    }
}

impl AddKeys {
    /// Which bodies new points are of, explicit ones by the bonds and triangles among them unless it is said; and what is known of these.
    fn tints(&self, alone: &Scene, new: Range<u32>) -> Result<(Vec<Tint>, Vec<Known>), Fault> {
        let own = |point: u32| point.checked_sub(new.start);
        let bonds = self.bonds.iter().filter_map(|bond| Some(BondKeys { a: own(bond.a)?, b: own(bond.b)?, ..*bond }));
        let bonds: Vec<BondKeys> = bonds.collect();
        let with_bonds = Scene { bonds: bonds.into(), ..alone.clone() };
        let mut tints = with_bonds.all_tints()?;
        tints.iter_mut().for_each(|tint| tint.first += new.start);
        let mut known: Vec<Known> = with_bonds.all_names()?.into_iter().map(|name| Known { name, hue: None }).collect();
        for LookKeys { points, title, hue } in &self.looks {
            Tint::part(&mut tints, points, known.len() as u32);
            known.push(Known { name: title.as_deref().map(one_line), hue: *hue });
        }
        tints.retain(|tint| new.contains(&tint.first));
        if !self.looks.is_empty() {
            compact(&mut tints, &mut known);
        }
        Ok((tints, known))
    }
}

/// Leaves out bodies that have no point any more.
fn compact(tints: &mut [Tint], known: &mut Vec<Known>) {
    let mut is_there = vec![false; known.len()];
    tints.iter().for_each(|tint| is_there[tint.body as usize] = true);
    let mut next = 0;
    let count = |is_there: &bool| {
        next += u32::from(*is_there);
        next
    };
    let place: Vec<u32> = is_there.iter().map(count).collect();
    tints.iter_mut().for_each(|tint| tint.body = place[tint.body as usize] - 1);
    let mut is_there = is_there.into_iter();
    known.retain(|_| is_there.next() == Some(true));
}

/// Where a point of the world is, or a new one from number `first` on `[m]`.
fn place(world: &dyn Dynamics, (first, new): (u32, &[[f64; 3]]), point: u32) -> [f64; 3] {
    if point >= first {
        return new[(point - first) as usize];
    }
    let (positions, dimensions) = (world.positions(), world.dimensions());
    let start = point as usize * dimensions;
    std::array::from_fn(|axis| if axis < dimensions { positions.get(start + axis) } else { 0.0 })
}
