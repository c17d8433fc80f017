//! From the keys of a scene to the engine's model, and what keys mean that are not said.

use super::check::{self, Resistance};
use super::error::{Fault, SceneError, Within};
use super::keys::{
    AngleKeys, AreaKeys, AreaKindName, BondKeys, ForceKeys, LimitName, Meeting, MouseKeys, ObstacleKeys, PinMotionKeys,
    ProfileName, RegionName, Row, Scene, SkinKeys, WindKeys,
};
use super::start::Start;
use super::support;
use crate::body::distance;
use crate::sim::vector::{cross, sub, truncate};
use crate::sim::{
    Angle, Angles, Areas, Bond, BondKind, Bonds, Bounds, Dynamics, Force, Limit, Model, ModelError, MouseForce,
    Penalty, Plane, PointId, Profile, Region, SkinMaterial, SkinMaterials, Track, Wind, angle_at, build,
};

impl Scene {
    /// Its name, else that of its file without the ending, else "scene".
    pub fn name(&self) -> &str {
        let file = || std::path::Path::new(&self.source.label).file_name()?.to_str();
        match &self.name {
            Some(name) => name,
            None => file()
                .map(|file| file.strip_suffix(".json").unwrap_or(file))
                .map(|stem| stem.strip_suffix(".scene").unwrap_or(stem))
                .filter(|stem| !stem.is_empty())
                .unwrap_or("scene"),
        }
    }

    /// 2 in the plane, 3 in space.
    pub fn dimensions(&self) -> usize {
        if self.dimensions == Some(3) { 3 } else { 2 }
    }

    /// Seconds of the scene in a second of wall time `[1]`.
    pub fn rate(&self) -> f64 {
        self.rate.unwrap_or(1.0)
    }

    /// The times to report `[s]`: the samples, else the duration; none if neither is said.
    pub fn sample_times(&self) -> Vec<f64> {
        if self.samples.is_empty() { self.duration.into_iter().collect() } else { self.samples.clone() }
    }

    /// Refuses what the form of a scene file excludes; a scene that was read has passed.
    ///
    /// Errors: the first fault, with its place.
    pub fn check(&self) -> Result<(), SceneError> {
        check::check(self).map_err(|fault| self.source.error(fault))
    }

    /// The model that the scene means; `D` must be its [`Scene::dimensions`].
    ///
    /// The same scene yields the same bits, with its bodies or [`Scene::expanded`]. Set `method` first where a call
    /// overrides it: what bonds need of it is checked here.
    ///
    /// Errors: those of [`Scene::check`]; what this version cannot run; springs under `relaxation`; relaxed bonds
    /// without `substep` and `iterations`; numbers that overflow.
    pub fn model<const D: usize>(&self) -> Result<Model<D>, SceneError> {
        self.to_model().map_err(|fault| self.source.error(fault))
    }

    /// A world at the start of the scene; its last substep before `duration` `[s]` ends there.
    ///
    /// Errors: those of [`Scene::model`]; `duration` is below 0 or not finite; the solver does not take the bonds.
    pub fn world(&self, duration: Option<f64>) -> Result<Box<dyn Dynamics>, SceneError> {
        fn made<const D: usize>(model: Model<D>, duration: Option<f64>) -> Result<Box<dyn Dynamics>, ModelError> {
            build(&Model { duration, ..model })
        }
        let world = match self.dimensions() {
            2 => made(self.model::<2>()?, duration),
            _ => made(self.model::<3>()?, duration),
        };
        world.map_err(|error| self.refused(&error))
    }

    /// What the engine says of this scene's model, with the place that the scene came from.
    pub fn refused(&self, error: &ModelError) -> SceneError {
        self.source.error(Fault::invalid(error.to_string()))
    }

    pub(super) fn to_model<const D: usize>(&self) -> Result<Model<D>, Fault> {
        if D != self.dimensions() {
            let message = format!("the scene has {} dimensions, not {D}", self.dimensions());
            return Err(Fault::invalid(message).at("dimensions"));
        }
        check::check(self)?;
        support::check(self)?;
        let method = support::method(self)?;
        let start = Start::new(self)?;
        Ok(Model {
            bonds: self.model_bonds(&start)?,
            triangles: triangles(&self.triangles, &start),
            areas: self.areas.map(AreaKeys::resolve),
            rest_areas: Vec::new(),
            angles: Angles::of(self.model_angles(&start)?),
            contact: self.contact.and_then(Meeting::resolve),
            skins: skins(&self.skins, &start),
            forces: self.forces.iter().map(force).collect(),
            position: start.position.into_iter().map(truncate).collect(),
            velocity: start.velocity.into_iter().map(truncate).collect(),
            mass: start.mass,
            pinned: start.pinned.into_iter().map(PointId).collect(),
            gravity: self.gravity.map_or([0.0; D], |g| truncate(g.embed())),
            drag_rate: self.drag_rate.unwrap_or(0.0),
            wind: self.wind.as_ref().map(wind),
            mouse: self.mouse_force(),
            bounds: self.bounds.as_ref().map(|bounds| Bounds {
                min: truncate(bounds.min.embed()),
                max: truncate(bounds.max.embed()),
                restitution: bounds.restitution.unwrap_or(0.0),
                friction: bounds.friction.unwrap_or(0.0),
            }),
            duration: self.duration,
            planes: planes(self),
            polygons: super::obstacle::polygons(self)?,
            convex: super::obstacle::convex(self),
            obstacle_numbers: obstacle_numbers(self),
            pin_motion: pin_motion(self),
            method,
        })
    }

    /// The explicit bonds, then those of the bodies.
    fn model_bonds(&self, start: &Start) -> Result<Bonds, Fault> {
        let in_bodies: usize = start.bodies.iter().map(|body| body.len()).sum();
        let mut bonds = Bonds::with_capacity(self.bonds.len() + in_bodies);
        let materials: Vec<Bond> = self.bonds.materials().iter().map(material).collect();
        for k in 0..self.bonds.len() {
            let [a, b] = self.bonds.ends(k);
            let rest_length = match self.bonds.rest(k) {
                Some(rest) => rest,
                None => rest_length(start.position[a as usize], start.position[b as usize]).item(k).at("bonds")?,
            };
            let keys = &self.bonds.materials()[self.bonds.material(k)];
            let made = Bond { a: PointId(a), b: PointId(b), ..materials[self.bonds.material(k)] };
            bonds.push(of_length(made, keys, rest_length).item(k).at("bonds")?);
        }
        for (keys, body) in self.bodies.iter().zip(&start.bodies) {
            let breaks = break_strain(keys.material.as_ref().and_then(|material| material.break_strain));
            bonds.extend(body.links().map(|link| Bond {
                a: PointId(link.a),
                b: PointId(link.b),
                rest_length: link.rest_length,
                kind: body.kind(&link),
                limit: Limit::Both,
                break_strain: breaks,
                drive: None,
            }));
        }
        Ok(bonds)
    }
}

/// What skins are made of: as bodies say it, then as is listed.
pub(super) fn skins(explicit: &[SkinKeys], start: &Start) -> SkinMaterials {
    let mut skins = SkinMaterials::default();
    for (material, points) in start.bodies.iter().filter_map(|body| body.skin()) {
        skins.set(points.map(PointId), material);
    }
    for (radius, points) in start.bodies.iter().flat_map(|body| body.strokes()) {
        let mut points = points.map(PointId).peekable();
        // What the body says of its skin is the same for all of them.
        let of_body = points.peek().map(|point| skins.of(*point)).unwrap_or_default();
        skins.set(points, SkinMaterial { radius: Some(radius), ..of_body });
    }
    for (material, points) in explicit.iter().map(skin) {
        points.into_iter().for_each(|point| skins.set([point], skins.of(point).overlaid(material)));
    }
    skins
}

/// What a listed skin is made of, and its points.
pub(super) fn skin(keys: &SkinKeys) -> (SkinMaterial, Vec<PointId>) {
    let &SkinKeys { ref points, friction, restitution, radius, layered, color: _, width: _, visible: _ } = keys;
    let material = SkinMaterial { friction, restitution, radius, layered };
    (material, points.iter().copied().map(PointId).collect())
}

/// A constant force; one of other dimensions was refused.
pub(super) fn force<const D: usize>(keys: &ForceKeys) -> Force<D> {
    Force {
        points: keys.points.iter().copied().map(PointId).collect(),
        force: keys.force.map_or([0.0; D], |force| truncate(force.embed())),
        torque: keys.torque.unwrap_or(0.0),
    }
}

/// The wind; one of other dimensions was refused.
pub(super) fn wind<const D: usize>(keys: &WindKeys) -> Wind<D> {
    Wind {
        velocity: truncate(keys.velocity.embed()),
        turbulence: keys.turbulence.unwrap_or(0.0),
        seed: keys.seed.unwrap_or(0),
    }
}

impl Scene {
    /// The explicit angles, then those of the bodies.
    fn model_angles(&self, start: &Start) -> Result<Vec<Angle>, Fault> {
        let place = |point: u32| truncate::<2>(start.position[point as usize]);
        let mut angles = Vec::new();
        for (k, keys) in self.angles.iter().enumerate() {
            angles.push(angle(keys, place).item(k).at("angles")?);
        }
        let of_bodies = start.bodies.iter().flat_map(|body| body.bends());
        angles.extend(of_bodies.map(|bend| Angle {
            stiffness: bend.stiffness,
            range: bend.range,
            ..angle_at(bend.points.map(PointId), bend.points.map(place))
        }));
        Ok(angles)
    }
}

/// An angle between points at these places.
///
/// Errors: an arm has no length, or, where no rest is said, there is no angle between them.
pub(super) fn angle(keys: &AngleKeys, place: impl Fn(u32) -> [f64; 2]) -> Result<Angle, Fault> {
    let found = angle_at(keys.points.0.map(PointId), keys.points.0.map(place));
    if !found.arms.iter().all(|&arm| arm > 0.0 && arm.is_finite()) {
        return Err(Fault::invalid("an arm has no length: put its points apart").at("points"));
    }
    let rest = keys.rest.unwrap_or(found.rest);
    if rest == 0.0 {
        return Err(Fault::invalid("its arms lie on each other at the start: give `rest`, between 0 and 2 pi"));
    }
    Ok(Angle {
        rest,
        stiffness: keys.stiffness.unwrap_or(0.0),
        damping: keys.damping.unwrap_or(0.0),
        range: keys.min.zip(keys.max).map(|(min, max)| [min, max]),
        drive: keys.drive.and_then(|drive| drive.of_angle().ok()),
        ..found
    })
}

/// How triangles resist.
impl AreaKeys {
    /// The same in the engine's words.
    pub(crate) fn resolve(self) -> Areas {
        let usual = Areas::default();
        Areas {
            stiffness: match self.kind {
                Some(AreaKindName::Rigid) => f64::INFINITY,
                _ => self.stiffness.unwrap_or(0.0),
            },
            least: self.least.unwrap_or(usual.least),
        }
    }
}

/// The explicit triangles, then those of the bodies.
fn triangles(explicit: &[Row<u32, 3>], start: &Start) -> Vec<[PointId; 3]> {
    let place = |corner: u32| start.position[corner as usize];
    let explicit = explicit.iter().map(|corners| anticlockwise(corners.0, place));
    explicit.chain(start.bodies.iter().flat_map(|body| body.triangles())).map(|corners| corners.map(PointId)).collect()
}

/// A triangle with its corners anticlockwise, seen along z.
pub(super) fn anticlockwise([a, b, c]: [u32; 3], place: impl Fn(u32) -> [f64; 3]) -> [u32; 3] {
    let [from, to, other] = [a, b, c].map(|corner| truncate::<2>(place(corner)));
    let twice_area = cross(sub(to, from), sub(other, from));
    if twice_area < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// The distance at the start `[m]`, where no rest length is said.
///
/// Errors: it overflows.
pub(super) fn rest_length(a: [f64; 3], b: [f64; 3]) -> Result<f64, Fault> {
    let length = distance(a, b);
    if length.is_finite() {
        return Ok(length);
    }
    Err(Fault::invalid("its points are too far apart for a number: move them together"))
}

/// A bond made of what the keys say, its ends and its rest length still open.
pub(super) fn material(keys: &BondKeys) -> Bond {
    Bond {
        kind: Resistance::from(keys).resolve(),
        limit: match keys.limit {
            None | Some(LimitName::Both) => Limit::Both,
            Some(LimitName::Max) => Limit::Max,
            Some(LimitName::Min) => Limit::Min,
        },
        break_strain: break_strain(keys.break_strain),
        // One that is none was refused.
        drive: keys.drive.and_then(|drive| drive.of_bond().ok()),
        ..Bond::new(PointId(keys.a), PointId(keys.b), 0.0)
    }
}

/// The same bond of a rest length `[m]`.
///
/// Errors: an axial stiffness where that is 0.
pub(super) fn of_length(bond: Bond, keys: &BondKeys, rest_length: f64) -> Result<Bond, Fault> {
    let kind = match (keys.axial_stiffness, bond.kind) {
        (Some(axial), BondKind::Spring { damping, .. }) => {
            let stiffness = axial / rest_length;
            if !stiffness.is_finite() {
                let message = "is of a bond whose rest length is 0, or too short to divide by: give `stiffness`";
                return Err(Fault::invalid(message).at("axial_stiffness"));
            }
            BondKind::Spring { stiffness, damping }
        }
        (_, kind) => kind,
    };
    Ok(Bond { rest_length, kind, ..bond })
}

/// What is not said never breaks.
fn break_strain(said: Option<f64>) -> f64 {
    said.unwrap_or(f64::INFINITY)
}

/// Planes among the obstacles.
fn planes<const D: usize>(scene: &Scene) -> Vec<Plane<D>> {
    let of = |keys: &ObstacleKeys| {
        let plane = keys.plane.as_ref()?;
        Some(Plane {
            point: truncate(plane.point.embed()),
            normal: truncate(plane.normal.embed()),
            restitution: keys.restitution.unwrap_or(0.0),
            friction: keys.friction.unwrap_or(0.0),
            penalty: keys.penalty.map(Penalty::from),
        })
    };
    scene.obstacles.iter().filter_map(of).collect()
}

/// The places of planes, then of all others, among the obstacles.
fn obstacle_numbers(scene: &Scene) -> [Vec<u32>; 2] {
    let numbered = || scene.obstacles.iter().zip(0..);
    let planes = numbered().filter(|(keys, _)| keys.plane.is_some()).map(|(_, number)| number);
    let others = numbered().filter(|(keys, _)| keys.plane.is_none()).map(|(_, number)| number);
    [planes.collect(), others.collect()]
}

/// The tracks of pinned points.
pub(super) fn pin_motion<const D: usize>(scene: &Scene) -> Vec<(PointId, Track<D>)> {
    let knot = |row: &Vec<f64>| (row[0], std::array::from_fn(|k| row[k + 1]));
    let of = |keys: &PinMotionKeys| (PointId(keys.point), Track { knots: keys.track.iter().map(knot).collect() });
    scene.pin_motion.iter().map(of).collect()
}

impl Scene {
    /// The mouse force that it begins with.
    pub fn mouse_force(&self) -> Option<MouseForce> {
        self.mouse.as_ref().map(mouse_force)
    }
}

fn mouse_force(keys: &MouseKeys) -> MouseForce {
    let knot = |&Row([t, x, y]): &Row<f64, 3>| (t, [x, y]);
    MouseForce {
        strength: keys.strength,
        radius: keys.radius,
        region: match keys.region {
            None | Some(RegionName::Round) => Region::Round,
            Some(RegionName::Square) => Region::Square,
        },
        profile: match keys.profile {
            None | Some(ProfileName::Smooth) => Profile::Smooth,
            Some(ProfileName::Linear) => Profile::Linear,
        },
        track: Track { knots: keys.track.iter().map(knot).collect() },
    }
}
