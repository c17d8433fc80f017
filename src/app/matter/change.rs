//! What is changed of the matter of bodies, and the commands that do it.

use super::Among;
use super::bending;
use super::extent::{areas, rest_length};
use super::facts::NEVER;
use super::former::Former;
use super::joints::{self, Stops};
use super::motors::{self, MotorChange};
use super::painted::Painted;
use super::preset::{Preset, Stuff};
use crate::history::{Do, OneOrEach, PenaltyOrNone, SetKeys, VectorOrEach};
use crate::picture::{Coat, Tint};
use crate::scene::{AddKeys, DriveKeys, KindName, LimitName, PenaltyKeys, SkinKeys, Vector};
use crate::sim::vector::{add, scale, sub};
use crate::sim::{Bond, BondKind, Dynamics, Limit, PointId};

/// Stiffness of springs that were rigid before, over the mass of their body `[1/s^2]`, and damping over stiffness `[s]`.
const SPRINGY: [f64; 2] = [600.0, 0.004];
/// Damping over stiffness of springs that are to bear something `[s]`, and how long they take to: before what lies on them has crushed them `[s]`.
const CALM: f64 = 0.02;
const SOON: f64 = 0.1;
/// Of what covers nothing, mass by length over density `[m]`: a rope as thick as that.
pub(super) const THICKNESS: f64 = 0.15;

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MatterChange {
    /// All of it together weighs so much `[kg]`, shared as before.
    Mass(f64),
    /// Of what has an area `[kg/m^2]`: each point weighs its share.
    Density(f64),
    /// Of springs `[N/m]`.
    Stiffness(f64),
    /// Of springs that are to bear something `[N/m]`: they are damped as well, so that it does not swing on them.
    Bears(f64),
    /// Of springs `[N s/m]`.
    Damping(f64),
    /// Strain at which bonds break `[1]`.
    Breaks(f64),
    /// On which sides of their lengths bonds act.
    Limit(Limit),
    /// The share of its error that a relaxed bond takes `[1]`, in (0, 1].
    Relaxation(f64),
    /// The largest correction of a relaxed bond, as a ratio `[1]`, > 0.
    MaxCorrection(f64),
    /// E I of chains and skins `[N m^2]`; where no angle bends yet, some come.
    Bending(f64),
    /// How long bonds are at rest `[m]`, > 0.
    RestLength(f64),
    /// Of angles that resist: where they are at rest `[rad]`, between 0 and 2 pi.
    RestAngle(f64),
    /// Of angles `[N m s]`, >= 0.
    AngleDamping(f64),
    /// Of angles that resist: what moves where they are at rest, as a servo does; `None`: nothing any more.
    Swings(Option<DriveKeys>),
    /// Of joints.
    Stops(Stops),
    /// Of motors.
    Motor(MotorChange),
    /// Of skins and obstacles `[1]`.
    Friction(f64),
    /// Of skins and obstacles `[1]`, to 1.
    Restitution(f64),
    /// How thick skins are `[m]`.
    Radius(f64),
    /// Whether parts of a body pass each other.
    Layered(bool),
    /// Their mean velocity `[m/s]`: how points move beside each other stays.
    Velocity([f64; 3]),
    /// Of planes: a depth pushes out by so much `[N/m]` and `[N s/m]` in place of contact; `None`: contact.
    Penalty(Option<[f64; 2]>),
    /// What it is filled in, or its picture is tinted by.
    Color([u8; 3]),
    /// How wide bonds are drawn `[m]`; 0: as is usual.
    Width(f64),
    /// Whether it is drawn.
    Visible(bool),
    /// Bonds keep their lengths.
    Rigid,
    /// Bonds that are not springs become some.
    Springy,
    /// Bonds take all of their error in a sweep, or a share of it that is set then.
    Relaxed,
    /// All of it, by name.
    Preset(Preset),
    /// Those numbers that are switched on.
    Painted(Painted),
}

impl MatterChange {
    /// What it is called when it is undone.
    pub(in crate::app) fn name(self) -> &'static str {
        match self {
            MatterChange::Mass(_) | MatterChange::Density(_) => "mass",
            MatterChange::Stiffness(_) | MatterChange::Bears(_) => "stiffness",
            MatterChange::Damping(_) => "damping",
            MatterChange::Breaks(_) => "break strain",
            MatterChange::Limit(_) => "where bonds act",
            MatterChange::Relaxation(_) => "relaxation",
            MatterChange::MaxCorrection(_) => "largest correction",
            MatterChange::Radius(_) => "skin",
            MatterChange::Layered(_) => "layers",
            MatterChange::Velocity(_) => "velocity",
            MatterChange::Bending(_) => "bending",
            MatterChange::RestLength(_) => "rest length",
            MatterChange::RestAngle(_) => "rest angle",
            MatterChange::AngleDamping(_) => "damping of angles",
            MatterChange::Swings(_) => "swings",
            MatterChange::Stops(_) => "stops",
            MatterChange::Motor(_) => "motor",
            MatterChange::Friction(_) => "friction",
            MatterChange::Restitution(_) => "restitution",
            MatterChange::Penalty(_) => "soft ground",
            MatterChange::Color(_) => "colour",
            MatterChange::Width(_) => "width",
            MatterChange::Visible(true) => "show",
            MatterChange::Visible(false) => "hide",
            MatterChange::Rigid => "rigid",
            MatterChange::Springy => "springy",
            MatterChange::Relaxed => "relaxed",
            MatterChange::Preset(preset) => preset.name(),
            MatterChange::Painted(numbers) => numbers.name(),
        }
    }
}

/// The commands of a change; joints get the stops back that they had.
///
/// Errors: in words, why what is meant has nothing that could be changed so.
pub(in crate::app) fn commands(
    (world, former): (&dyn Dynamics, &Former),
    among: &Among,
    change: MatterChange,
) -> Result<Vec<Do>, &'static str> {
    let points = among.points_of(world);
    let set = |keys: SetKeys| Do::Set(Box::new(keys));
    let springs = || numbers(&among.bonds_of(world), |bond| matches!(bond.kind, BondKind::Spring { .. }));
    let of_springs = |keys: SetKeys| match springs() {
        list if list.is_empty() => Err("its bonds are rigid: make them springy first"),
        list => Ok(vec![set(SetKeys { bonds: Some(list), ..keys })]),
    };
    let one = |x: f64| Some(OneOrEach::One(x));
    let all = match change {
        MatterChange::Mass(mass) => masses(world, &points, mass).map(set).into_iter().collect(),
        MatterChange::Density(density) => {
            let mass = Some(OneOrEach::Each(weights(world, &points, density)));
            vec![set(SetKeys { points: Some(point_numbers(&points)), mass, ..SetKeys::default() })]
        }
        MatterChange::Stiffness(stiffness) => of_springs(SetKeys { stiffness: one(stiffness), ..SetKeys::default() })?,
        MatterChange::Bears(stiffness) => {
            let damping = one(CALM * stiffness);
            of_springs(SetKeys { stiffness: one(stiffness), damping, over: Some(SOON), ..SetKeys::default() })?
        }
        MatterChange::Damping(damping) => of_springs(SetKeys { damping: one(damping), ..SetKeys::default() })?,
        MatterChange::Breaks(strain) => {
            let bonds = Some(numbers(&among.bonds_of(world), |_| true));
            vec![set(SetKeys { bonds, break_strain: one(strain.min(NEVER)), ..SetKeys::default() })]
        }
        MatterChange::Limit(limit) => {
            let bonds = Some(numbers(&among.bonds_of(world), |bond| bond.limit != limit));
            let limit = match limit {
                Limit::Both => LimitName::Both,
                Limit::Max => LimitName::Max,
                Limit::Min => LimitName::Min,
            };
            vec![set(SetKeys { bonds, limit: Some(limit), ..SetKeys::default() })]
        }
        MatterChange::Relaxation(share) => {
            let is_relaxed = |bond: &Bond| matches!(bond.kind, BondKind::Relaxed { .. });
            let bonds = Some(numbers(&among.bonds_of(world), is_relaxed));
            vec![set(SetKeys { bonds, relaxation: one(share), ..SetKeys::default() })]
        }
        MatterChange::MaxCorrection(most) => {
            let is_relaxed = |bond: &Bond| matches!(bond.kind, BondKind::Relaxed { .. });
            let bonds = Some(numbers(&among.bonds_of(world), is_relaxed));
            vec![set(SetKeys { bonds, max_correction: one(most), ..SetKeys::default() })]
        }
        MatterChange::Radius(radius) => {
            let points = Some(point_numbers(&points));
            vec![set(SetKeys { points, radius: Some(radius), ..SetKeys::default() })]
        }
        MatterChange::Layered(is) => {
            let points = Some(point_numbers(&points));
            vec![set(SetKeys { points, layered: Some(is), ..SetKeys::default() })]
        }
        MatterChange::Velocity(velocity) => vec![set(moving(world, &points, velocity))],
        MatterChange::Bending(rigidity) => bending::bent(world, among, rigidity)?,
        MatterChange::RestLength(length) => {
            let bonds = Some(numbers(&among.bonds_of(world), |_| true));
            vec![set(SetKeys { bonds, rest: one(length), ..SetKeys::default() })]
        }
        MatterChange::RestAngle(angle) => vec![joints::rest(world, among, angle)],
        MatterChange::AngleDamping(damping) => vec![joints::damped(world, among, damping)],
        MatterChange::Swings(drive) => vec![joints::swinging(world, among, drive)],
        MatterChange::Stops(stops) => joints::stops((world, former), among, stops)?,
        MatterChange::Motor(change) => motors::changed(world, among, change),
        MatterChange::Friction(friction) => {
            surfaces(world, (&points, among), SetKeys { friction: Some(friction), ..SetKeys::default() })
        }
        MatterChange::Restitution(restitution) => {
            surfaces(world, (&points, among), SetKeys { restitution: Some(restitution), ..SetKeys::default() })
        }
        MatterChange::Penalty(penalty) => {
            let keys = |[stiffness, damping]: [f64; 2]| PenaltyKeys { stiffness, damping: Some(damping) };
            let penalty = penalty.map_or(PenaltyOrNone::None(()), |numbers| PenaltyOrNone::This(keys(numbers)));
            let obstacles = Some(among.obstacles.clone());
            vec![set(SetKeys { obstacles, penalty: Some(penalty), ..SetKeys::default() })]
        }
        MatterChange::Color(_) | MatterChange::Width(_) | MatterChange::Visible(_) if points.is_empty() => Vec::new(),
        MatterChange::Color(color) => vec![coated(&points, Coat::of_color(color))],
        MatterChange::Width(width) => vec![coated(&points, Coat { width: Some(width), ..Coat::default() })],
        MatterChange::Visible(is) => vec![coated(&points, Coat { visible: Some(is), ..Coat::default() })],
        MatterChange::Rigid => {
            let bonds = without_muscles(&among.bonds_of(world), |bond| bond.kind != BondKind::Rigid);
            vec![set(SetKeys { bonds: Some(bonds), kind: Some(KindName::Rigid), ..SetKeys::default() })]
        }
        MatterChange::Relaxed => {
            let bonds = without_muscles(&among.bonds_of(world), |bond| !matches!(bond.kind, BondKind::Relaxed { .. }));
            vec![set(SetKeys { bonds: Some(bonds), kind: Some(KindName::Relaxed), ..SetKeys::default() })]
        }
        MatterChange::Springy => {
            let mass = |point: PointId| world.masses()[point.index()];
            let bonds = among.bonds_of(world).into_iter();
            let rigid = bonds.filter(|(_, bond)| !matches!(bond.kind, BondKind::Spring { .. })).collect();
            springy(world, rigid, mass, SPRINGY).map(set).into_iter().collect()
        }
        MatterChange::Preset(preset) => of_preset(world, (&points, among), preset),
        MatterChange::Painted(numbers) => painted((world, former), among, numbers)?,
    };
    let names_nothing = |act: &Do| {
        let Do::Set(keys) = act else { return false };
        let lists = [&keys.points, &keys.bonds, &keys.angles, &keys.obstacles];
        lists.into_iter().flatten().all(Vec::is_empty)
    };
    let all: Vec<Do> = all.into_iter().filter(|act| !names_nothing(act)).collect();
    if all.is_empty() { Err("nothing of what is selected can be changed so") } else { Ok(all) }
}

/// Each number that is switched on, of what has it.
///
/// Errors: nothing has any of them; why the first of them has nowhere to go.
fn painted(known: (&dyn Dynamics, &Former), among: &Among, numbers: Painted) -> Result<Vec<Do>, &'static str> {
    let (mut all, mut fault) = (Vec::new(), None);
    for change in numbers.changes() {
        match commands(known, among, change) {
            Ok(acts) => all.extend(acts),
            Err(why) => fault = fault.or(Some(why)),
        }
    }
    match fault.filter(|_| all.is_empty()) {
        Some(why) => Err(why),
        None => Ok(all),
    }
}

fn numbers(bonds: &[(u32, Bond)], is_meant: impl Fn(&Bond) -> bool) -> Vec<u32> {
    bonds.iter().filter(|(_, bond)| is_meant(bond)).map(|(number, _)| *number).collect()
}

/// Those that are made rigid or relaxed: muscles stay springs, for in a rigid body they would work against all others, unless there is nothing else.
fn without_muscles(bonds: &[(u32, Bond)], is_meant: impl Fn(&Bond) -> bool) -> Vec<u32> {
    let others = bonds.iter().any(|(_, bond)| bond.drive.is_none());
    numbers(bonds, |bond| is_meant(bond) && (bond.drive.is_none() || !others))
}

fn point_numbers(points: &[PointId]) -> Vec<u32> {
    points.iter().map(|point| point.0).collect()
}

/// Points weigh `mass` `[kg]` together, shared as before.
fn masses(world: &dyn Dynamics, points: &[PointId], mass: f64) -> Option<SetKeys> {
    let before: Vec<f64> = points.iter().map(|point| world.masses()[point.index()]).collect();
    let whole: f64 = before.iter().sum();
    let each = before.iter().map(|own| own * (mass / whole)).collect();
    let keys = SetKeys { points: Some(point_numbers(points)), mass: Some(OneOrEach::Each(each)), ..SetKeys::default() };
    (whole > 0.0).then_some(keys)
}

/// Points that are free get such a mean velocity `[m/s]`, weighed by mass.
fn moving(world: &dyn Dynamics, points: &[PointId], velocity: [f64; 3]) -> SetKeys {
    let free = free(world, points);
    let Some(mean) = mean_velocity(world, &free) else {
        return SetKeys { points: Some(Vec::new()), ..SetKeys::default() };
    };
    let more = sub(velocity, mean);
    let each = free.iter().map(|&point| Vector::new(add(world.velocity(point), more), world.dimensions())).collect();
    SetKeys { points: Some(point_numbers(&free)), velocity: Some(VectorOrEach::Each(each)), ..SetKeys::default() }
}

/// The points that no pin holds.
fn free(world: &dyn Dynamics, points: &[PointId]) -> Vec<PointId> {
    let mut pinned = world.pinned().to_vec();
    pinned.sort_unstable();
    points.iter().copied().filter(|point| pinned.binary_search(point).is_err()).collect()
}

/// The mean velocity of points that no pin holds, weighed by mass `[m/s]`; `None` of none.
pub(in crate::app) fn mean_velocity(world: &dyn Dynamics, points: &[PointId]) -> Option<[f64; 3]> {
    let there = Among { points: points.to_vec(), ..Among::default() }.points_of(world);
    let (mut momentum, mut mass) = ([0.0; 3], 0.0);
    for point in free(world, &there) {
        let own = world.masses()[point.index()];
        momentum = add(momentum, scale(world.velocity(point), own));
        mass += own;
    }
    (mass > 0.0).then(|| scale(momentum, 1.0 / mass))
}

/// Skins of points, in the plane, and obstacles get these keys.
fn surfaces(world: &dyn Dynamics, (points, among): (&[PointId], &Among), keys: SetKeys) -> Vec<Do> {
    let of_points = (world.dimensions() == 2).then(|| SetKeys { points: Some(point_numbers(points)), ..keys.clone() });
    let of_obstacles = SetKeys { obstacles: Some(among.obstacles.clone()), ..keys };
    of_points.into_iter().chain([of_obstacles]).map(|keys| Do::Set(Box::new(keys))).collect()
}

fn coated(points: &[PointId], coat: Coat) -> Do {
    let skin = SkinKeys::of_coat(point_numbers(points), coat);
    Do::Add(Box::new(AddKeys { skins: vec![skin], ..AddKeys::default() }))
}

/// Bonds become springs, as stiff for the mass of their body as said; those of chains, which pull one behind another, by as much more as
/// there are of them. `None` where there are none.
fn springy(
    world: &dyn Dynamics,
    bonds: Vec<(u32, Bond)>,
    mass: impl Fn(PointId) -> f64,
    [soft, damping]: [f64; 2],
) -> Option<SetKeys> {
    let count = world.point_count();
    let body = Tint::hanging(count, world.bonds().ends().iter().map(|ends| ends.map(|end| end.0)));
    let bodies = body.iter().max().map_or(0, |last| *last as usize + 1);
    let (mut weight, mut ends, mut links) = (vec![0.0; bodies], vec![0_usize; bodies], vec![0_usize; bodies]);
    for point in (0..count as u32).map(PointId) {
        weight[body[point.index()] as usize] += mass(point);
        ends[body[point.index()] as usize] += 1;
    }
    world.bonds().ends().iter().for_each(|[a, _]| links[body[a.index()] as usize] += 1);
    let stiffness = |(_, bond): &(u32, Bond)| {
        let own = body[bond.a.index()] as usize;
        let in_a_row = if links[own] <= ends[own] { links[own] } else { 1 };
        soft * weight[own] * in_a_row as f64
    };
    let each: Vec<f64> = bonds.iter().map(stiffness).collect();
    let keys = SetKeys {
        bonds: Some(numbers(&bonds, |_| true)),
        kind: Some(KindName::Spring),
        damping: Some(OneOrEach::Each(each.iter().map(|stiffness| damping * stiffness).collect())),
        stiffness: Some(OneOrEach::Each(each)),
        ..SetKeys::default()
    };
    (!bonds.is_empty()).then_some(keys)
}

/// All of a matter: masses by what points cover, or by the lengths of their bonds; bonds that act both ways; skins and colour.
fn of_preset(world: &dyn Dynamics, (points, among): (&[PointId], &Among), preset: Preset) -> Vec<Do> {
    let Stuff { density, springs, breaks, friction, restitution, color } = preset.stuff();
    let mass = weights(world, points, density);
    let of_point = |point: PointId| {
        points.binary_search(&point).map_or_else(|_| world.masses()[point.index()], |place| mass[place])
    };
    let bonds: Vec<(u32, Bond)> = among
        .bonds_of(world)
        .into_iter()
        .filter(|(_, bond)| bond.limit == Limit::Both && bond.rest_length > 0.0)
        .collect();
    let named = Some(numbers(&bonds, |_| true));
    let of_bonds = match springs {
        Some(springs) => springy(world, bonds, of_point, springs),
        None => {
            let rigid = Some(without_muscles(&bonds, |_| true));
            Some(SetKeys { bonds: rigid, kind: Some(KindName::Rigid), ..SetKeys::default() })
        }
    };
    // What it bears it bears at once; what breaks is as stiff first.
    let whole = SetKeys { bonds: named, break_strain: Some(OneOrEach::One(NEVER)), ..SetKeys::default() };
    let of_bonds = of_bonds.map(|keys| SetKeys { break_strain: breaks.map(OneOrEach::One), ..keys });
    let of_points =
        SetKeys { points: Some(point_numbers(points)), mass: Some(OneOrEach::Each(mass)), ..SetKeys::default() };
    let mut all: Vec<Do> =
        [Some(whole), Some(of_points), of_bonds].into_iter().flatten().map(|keys| Do::Set(Box::new(keys))).collect();
    let skin = SetKeys { friction: Some(friction), restitution: Some(restitution), ..SetKeys::default() };
    all.extend(surfaces(world, (points, among), skin));
    if !points.is_empty() {
        all.push(coated(points, Coat::of_color(color)));
    }
    all
}

/// What points weigh in a matter of this density `[kg/m^2]`, one each, by their shape at rest: a third of each triangle that they are
/// corners of, whichever body it is of; where there is none, half of each of their bonds, as a rope of it; a point without either weighs
/// what it did.
fn weights(world: &dyn Dynamics, points: &[PointId], density: f64) -> Vec<f64> {
    let mut area = vec![0.0; world.point_count()];
    let every: Vec<PointId> = (0..world.point_count() as u32).map(PointId).collect();
    for (corners, covered) in areas(world, &every) {
        corners.iter().for_each(|corner| area[corner.index()] += covered / 3.0);
    }
    let mut half = vec![0.0; world.point_count()];
    for bond in world.bonds().iter() {
        let long = rest_length(world, &bond);
        [bond.a, bond.b].into_iter().for_each(|end| half[end.index()] += 0.5 * long);
    }
    let weight = |point: &PointId| {
        let place = point.index();
        let own = if area[place] > 0.0 { area[place] } else { THICKNESS * half[place] };
        if own > 0.0 && own.is_finite() { density * own } else { world.masses()[place] }
    };
    points.iter().map(weight).collect()
}
