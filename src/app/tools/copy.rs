//! A copy of what is selected in a running world, as it is now: the keys that bring it again, here or in another scene.

use super::chosen::Chosen;
use crate::picture::Tint;
use crate::scene::{
    AddKeys, AngleKeys, BondKeys, BoxKeys, CircleKeys, ColorKey, ContactKeys, ForceKeys, Fragment, KindName, LimitName,
    MassKeys, ObstacleKeys, PlaneKeys, PointKeys, RotationKeys, Row, SkinKeys, Vector,
};
use crate::sim::{Angle, Bond, BondKind, Convex, Dynamics, Figure, Limit, Obstacle, PointId, SkinMaterial};

/// What was copied: the keys that bring it, its points counted from 0, where it was.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Clip {
    keys: AddKeys,
    /// How bodies met where it was copied.
    contact: Option<ContactKeys>,
    pub(in crate::app) dimensions: usize,
    /// The middle of all of it `[m]`.
    pub(in crate::app) middle: [f64; 3],
}

impl Clip {
    /// What is chosen in a world: points with velocities, masses, pins, colours and what their skins are made of; bonds with their drives,
    /// triangles, angles and constant forces among them; obstacles. Not what is painted on them.
    pub(in crate::app) fn of(world: &dyn Dynamics, tints: &[Tint], chosen: &Chosen) -> Self {
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
            skins: skins(world, tints, &points),
            forces: world.forces().into_iter().filter_map(force).collect(),
            angles: world.angles().iter().filter_map(|angle| angle_keys(angle, place)).collect(),
            obstacles,
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
        Clip { keys, contact: world.contact().map(ContactKeys::from), dimensions, middle }
    }

    /// The keys that bring it `by` `[m]` from where it was into a world. What its skins had from the scene that it was copied in travels with
    /// it, where that is not the same here.
    pub(in crate::app) fn placed(&self, world: &dyn Dynamics, by: [f64; 3]) -> AddKeys {
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
        keys.forces.iter_mut().flat_map(|force| &mut force.points).for_each(|point| *point += next);
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
            keys.skins.push(SkinKeys { points, friction, restitution, radius, color: None });
        }
    }

    /// The same as a part of a scene, to be written as text.
    pub(in crate::app) fn fragment(&self) -> Fragment {
        let Clip { keys, contact, dimensions, middle } = self.clone();
        Fragment { keys, contact, dimensions, middle }
    }

    /// What a part of a scene brings.
    pub(in crate::app) fn of_fragment(Fragment { keys, contact, dimensions, middle }: Fragment) -> Self {
        Clip { keys, contact, dimensions, middle }
    }

    /// How many points it brings, and how many obstacles.
    pub(in crate::app) fn counts(&self) -> [u32; 2] {
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

/// Runs of points, counted in their order, that have the same.
fn runs<T: PartialEq>(points: &[PointId], of: impl Fn(&PointId) -> T) -> Vec<(T, Vec<u32>)> {
    let mut first = 0;
    let mut list = Vec::new();
    for same in points.chunk_by(|a, b| of(a) == of(b)) {
        let copies = first..first + same.len() as u32;
        first = copies.end;
        list.push((of(&same[0]), copies.collect()));
    }
    list
}

/// The colours that points have of their own, and what their skins are made of.
fn skins(world: &dyn Dynamics, tints: &[Tint], points: &[PointId]) -> Vec<SkinKeys> {
    let look = |point: &PointId| (Tint::of(tints, point.0).and_then(|tint| tint.color), world.skin_of(*point));
    let keys = |((color, material), points): ((Option<[u8; 3]>, SkinMaterial), Vec<u32>)| {
        let SkinMaterial { friction, restitution, radius } = material;
        let is_said = color.is_some() || material != SkinMaterial::default();
        is_said.then(|| SkinKeys { points, friction, restitution, radius, color: color.map(ColorKey) })
    };
    runs(points, look).into_iter().filter_map(keys).collect()
}

/// A bond between other points.
fn bond_keys(bond: Bond, a: u32, b: u32) -> BondKeys {
    let keys = BondKeys { rest: Some(bond.rest_length), ..BondKeys::new(a, b) };
    let keys = match bond.kind {
        BondKind::Rigid => BondKeys { kind: Some(KindName::Rigid), ..keys },
        BondKind::Spring { stiffness, damping } => {
            BondKeys { kind: Some(KindName::Spring), stiffness: Some(stiffness), damping: Some(damping), ..keys }
        }
        BondKind::Relaxed { relaxation, max_correction } => BondKeys {
            kind: Some(KindName::Relaxed),
            relaxation: Some(relaxation),
            max_correction: max_correction.is_finite().then_some(max_correction),
            ..keys
        },
    };
    let limit = match bond.limit {
        Limit::Both => None,
        Limit::Max => Some(LimitName::Max),
        Limit::Min => Some(LimitName::Min),
    };
    let drive = bond.drive.map(Into::into);
    BondKeys { drive, break_strain: bond.break_strain.is_finite().then_some(bond.break_strain), limit, ..keys }
}

/// An angle between other points; `None` where one of its own is not among them.
fn angle_keys(angle: &Angle, place: impl Fn(PointId) -> Option<u32>) -> Option<AngleKeys> {
    let [i, j, k] = angle.points.map(place);
    let above_0 = |x: f64| (x > 0.0).then_some(x);
    Some(AngleKeys {
        points: Row([i?, j?, k?]),
        rest: Some(angle.rest),
        stiffness: above_0(angle.stiffness),
        damping: above_0(angle.damping),
        min: angle.range.map(|[least, _]| least),
        max: angle.range.map(|[_, most]| most),
        drive: angle.drive.map(Into::into),
    })
}

/// An obstacle as keys have it.
fn solid(obstacle: &Obstacle, dimensions: usize) -> ObstacleKeys {
    let vector = |x: [f64; 3]| Vector::new(x, dimensions);
    let (keys, restitution, friction) = match obstacle {
        Obstacle::Plane { point, normal, restitution, friction } => {
            let plane = Some(PlaneKeys { point: vector(*point), normal: vector(*normal) });
            (ObstacleKeys { plane, ..ObstacleKeys::default() }, restitution, friction)
        }
        Obstacle::Polygon(polygon) => {
            let corners = |corners: &Vec<[f64; 2]>| corners.iter().map(|&corner| Vector::Plane(corner)).collect();
            let polygon_keys = Some(polygon.loops.iter().map(corners).collect());
            let keys = ObstacleKeys { polygon: polygon_keys, ..ObstacleKeys::default() };
            (keys, &polygon.restitution, &polygon.friction)
        }
        Obstacle::Convex(Convex { figure, restitution, friction }) => (figure_keys(figure), restitution, friction),
    };
    ObstacleKeys { restitution: Some(*restitution), friction: Some(*friction), ..keys }
}

/// A ball or a box of space.
fn figure_keys(figure: &Figure) -> ObstacleKeys {
    match *figure {
        Figure::Ball { center, radius } => ObstacleKeys {
            circle: Some(CircleKeys { center: Vector::Space(center), radius }),
            ..ObstacleKeys::default()
        },
        Figure::Box { min, max, axis, angle } => ObstacleKeys {
            r#box: Some(BoxKeys {
                min: Vector::Space(min),
                max: Vector::Space(max),
                angle: None,
                rotation: Some(RotationKeys { axis: Vector::Space(axis), angle }),
            }),
            ..ObstacleKeys::default()
        },
    }
}
