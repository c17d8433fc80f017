//! The tools that drive: a bond becomes a muscle, and bodies turn about a hinge, by a motor if one likes.

use glam::{DVec2, DVec3};

use super::Deed;
use super::marks::{Mark, Role};
use super::pick::Scope;
use crate::history::{Do, DriveOrNone, SetKeys};
use crate::scene::{AddKeys, AngleKeys, BondKeys, DriveKeys, KeyName, KindName, MassKeys, PointKeys, Row, Vector};
use crate::sim::{Bond, BondKind, Limit, PointId};

/// Bonds of a hub to a body that turns about it, and to one that holds it.
const SPOKES: usize = 6;
const STRUTS: usize = 3;
/// Of the spokes those that a motor turns: a third of a turn apart, so that a soft wheel keeps its shape.
const TURNED: usize = 3;
/// A hub is held by a body no further than so many radii of what turns about it.
const NEAR: f64 = 1.6;
/// Points nearer to a hub than this share of that radius give it no direction.
const LEAST_SPOKE: f64 = 0.05;
/// Stiffness of the bonds of a hub where a body has no springs to take it from `[N/m]`.
const STIFFNESS: f64 = 4000.0;

/// Said where nothing is clicked that could be a muscle, or hinged.
const NO_BOND: &str = "no bond lies here that could be a muscle";
const NO_BODY: &str = "no body lies here that could be hinged";

/// What a muscle is to follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct MuscleChoice {
    /// Share that its length changes by `[1]`.
    pub(in crate::app) amplitude: f64,
    /// It follows a wave of this period `[s]` and phase `[rad]`.
    pub(in crate::app) has_wave: bool,
    pub(in crate::app) period: f64,
    pub(in crate::app) phase: f64,
    pub(in crate::app) key: Option<KeyName>,
    pub(in crate::app) back: Option<KeyName>,
}

/// What a hinge gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct MotorChoice {
    /// It has a motor.
    pub(in crate::app) is_on: bool,
    /// Anticlockwise `[rad/s]`.
    pub(in crate::app) speed: f64,
    /// `[N m]`
    pub(in crate::app) torque: f64,
    pub(in crate::app) key: Option<KeyName>,
    pub(in crate::app) back: Option<KeyName>,
}

/// What both tools make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Drives {
    pub(in crate::app) muscle: MuscleChoice,
    pub(in crate::app) motor: MotorChoice,
}

impl Default for Drives {
    fn default() -> Self {
        Drives {
            muscle: MuscleChoice { amplitude: 0.3, has_wave: true, period: 1.0, phase: 0.0, key: None, back: None },
            motor: MotorChoice { is_on: true, speed: -6.0, torque: 30.0, key: None, back: None },
        }
    }
}

impl MuscleChoice {
    fn keys(&self) -> DriveKeys {
        // What follows nothing would be none.
        let has_wave = self.has_wave || self.key.is_none();
        DriveKeys {
            amplitude: Some(self.amplitude),
            period: has_wave.then_some(self.period),
            phase: has_wave.then_some(self.phase),
            key: self.key,
            back: self.key.and(self.back).filter(|back| Some(*back) != self.key),
            ..DriveKeys::default()
        }
    }
}

impl MotorChoice {
    fn keys(&self, share: f64) -> DriveKeys {
        DriveKeys {
            speed: Some(self.speed),
            torque: Some(share * self.torque),
            key: self.key,
            back: self.key.and(self.back).filter(|back| Some(*back) != self.key),
            ..DriveKeys::default()
        }
    }
}

impl Drives {
    /// The bond under a pixel becomes a muscle; one that is just such a muscle none any more.
    pub(super) fn press_muscle(&self, scope: Scope<'_>, at: DVec2) -> Deed {
        let Some((place, _)) = scope.bond(at) else { return Deed::words(NO_BOND.to_owned()) };
        let bond = scope.shown.scenery.bonds.get(place);
        if let Some(why) = no_muscle(&bond) {
            return Deed::words(why.to_owned());
        }
        let (name, drive) = match self.takes_away(&bond) {
            true => ("muscle away", DriveOrNone::None(())),
            false => ("muscle", DriveOrNone::This(self.muscle.keys())),
        };
        let bonds = Some(vec![scope.shown.scenery.bond_number(place)]);
        Deed::edit(name, Do::Set(Box::new(SetKeys { bonds, drive: Some(drive), ..SetKeys::default() })))
    }

    fn takes_away(&self, bond: &Bond) -> bool {
        bond.drive.is_some_and(|drive| self.muscle.keys().told_bond() == Ok(drive))
    }

    /// What a click with the tool for muscles would do.
    pub(super) fn mark_muscle(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let Some((place, [a, b])) = scope.bond(at) else { return Vec::new() };
        let bond = scope.shown.scenery.bonds.get(place);
        let (role, words) = match no_muscle(&bond) {
            Some(why) => (Role::Away, why),
            None if self.takes_away(&bond) => (Role::Away, "no muscle any more"),
            None if bond.drive.is_some() => (Role::Come, "this muscle instead"),
            None => (Role::Come, "a muscle"),
        };
        let line = scope.pixel(a).zip(scope.pixel(b)).map(|(a, b)| Mark::Line(role, a, b, 4.0 * scope.scale));
        line.into_iter().chain([Mark::Words(beside(scope, at), words.to_owned())]).collect()
    }

    /// A hinge comes where a body is clicked.
    pub(super) fn press_motor(&self, scope: Scope<'_>, at: DVec2) -> Deed {
        match Hinge::at(scope, at) {
            None => Deed::words(NO_BODY.to_owned()),
            Some(Err(why)) => Deed::words(why.to_owned()),
            Some(Ok(hinge)) => {
                let name = if self.motor.is_on { "motor" } else { "hinge" };
                Deed::edit(name, Do::Add(Box::new(hinge.keys(scope, &self.motor))))
            }
        }
    }

    /// What a click with the tool for motors would do.
    pub(super) fn mark_motor(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let hinge = match Hinge::at(scope, at) {
            None => return Vec::new(),
            Some(Err(why)) => return vec![Mark::Words(beside(scope, at), why.to_owned())],
            Some(Ok(hinge)) => hinge,
        };
        let lines = hinge.spokes.iter().map(|spoke| (Role::Come, spoke));
        let lines = lines.chain(hinge.struts.iter().map(|strut| (Role::Hold, strut)));
        let mut marks: Vec<Mark> = lines
            .filter_map(|(role, &point)| Some(Mark::Line(role, at, scope.pixel(point)?, 2.0 * scope.scale)))
            .collect();
        marks.push(Mark::Ring(Role::Come, at, 7.0 * scope.scale));
        let what = if self.motor.is_on { "a motor" } else { "a hinge" };
        let on = if hinge.struts.is_empty() { "on the ground" } else { "between both bodies" };
        marks.push(Mark::Words(beside(scope, at), format!("{what} {on}")));
        marks
    }
}

fn beside(scope: Scope<'_>, at: DVec2) -> DVec2 {
    at + DVec2::new(14.0, -10.0) * scope.scale
}

/// Why a bond cannot be a muscle.
fn no_muscle(bond: &Bond) -> Option<&'static str> {
    match bond.kind {
        BondKind::Relaxed { .. } => Some("a relaxed bond is no muscle"),
        _ if bond.limit != Limit::Both => Some("a bond that acts on one side is no muscle"),
        _ if bond.rest_length == 0.0 => Some("a weld is no muscle"),
        _ => None,
    }
}

/// A hinge that is to come: its hub, what turns about it, and what holds it, if the ground does not.
struct Hinge {
    at: DVec2,
    spokes: Vec<PointId>,
    struts: Vec<PointId>,
}

impl Hinge {
    /// About a pixel: of the body that lies there and another one beside it, else of that and the ground. `None`: no body lies there.
    fn at(scope: Scope<'_>, pixel: DVec2) -> Option<Result<Self, &'static str>> {
        let hit = scope.nearest(pixel)?;
        if scope.shown.dimensions != 2 {
            return Some(Err("hinges are of the plane: this scene is in space"));
        }
        let at = scope.camera.world_from_screen(pixel.to_array()).truncate();
        let body = scope.body(hit.point);
        let far = |&point: &PointId| place(scope, point).distance(at);
        let radius = body.iter().map(far).fold(0.0, f64::max);
        let spokes = nearest(&body, far, (SPOKES, LEAST_SPOKE * radius));
        if spokes.len() < 2 {
            return Some(Err("a hinge needs a body of three points or more"));
        }
        let is_there = |point: &PointId| scope.shown.scenery.gone.binary_search(point).is_err();
        let others = (0..scope.shown.point_count() as u32).map(PointId).filter(is_there);
        let others = others.filter(|point| body.binary_search(point).is_err());
        let other = others.min_by(|a, b| far(a).total_cmp(&far(b))).filter(|point| far(point) <= NEAR * radius);
        let holder = other.map_or_else(Vec::new, |point| scope.body(point));
        let struts = nearest(&holder, far, (STRUTS, LEAST_SPOKE * radius));
        let meets = scope.shown.settings.contact.is_some_and(|contact| contact.is_some());
        if meets && overlap(scope, [&body, &holder]) {
            return Some(Err("they overlap and would push each other away: move one aside first"));
        }
        Some(Ok(Hinge { at, spokes, struts }))
    }

    /// The keys that bring it into the world.
    fn keys(&self, scope: Scope<'_>, motor: &MotorChoice) -> AddKeys {
        let hub = scope.shown.point_count() as u32;
        let is_grounded = self.struts.is_empty();
        let arm = self.spokes.first().map_or(1.0, |&spoke| place(scope, spoke).distance(self.at));
        let mut position = vec![self.at];
        // What a motor on the ground pushes against.
        position.extend((is_grounded && motor.is_on).then_some(self.at + DVec2::new(0.5 * arm, 0.0)));
        let reference = self.struts.first().map_or(hub + 1, |strut| strut.0);
        let kind = stuff(scope, &self.spokes);
        let spokes = self.spokes.iter().map(|spoke| bond(hub, spoke.0, kind));
        let struts = self.struts.iter().map(|strut| bond(hub, strut.0, stuff(scope, &self.struts)));
        let turned = if motor.is_on { self.turned(scope) } else { Vec::new() };
        let share = 1.0 / turned.len().max(1) as f64;
        let angle = |rim: PointId| AngleKeys {
            points: Row([reference, hub, rim.0]),
            rest: Some(std::f64::consts::PI),
            stiffness: None,
            damping: None,
            min: None,
            max: None,
            drive: Some(motor.keys(share)),
        };
        let pinned = if is_grounded { (hub..hub + position.len() as u32).collect() } else { Vec::new() };
        AddKeys {
            points: Some(PointKeys {
                mass: Some(MassKeys::Same(1.0)),
                position: position.into_iter().map(|at| Vector::Plane(at.to_array())).collect(),
                velocity: None,
                pinned,
            }),
            bonds: spokes.chain(struts).collect(),
            angles: turned.into_iter().map(angle).collect(),
            ..AddKeys::default()
        }
    }

    /// The spokes that a motor turns: as far apart as there are some.
    fn turned(&self, scope: Scope<'_>) -> Vec<PointId> {
        let angle = |point: &PointId| {
            let from = place(scope, *point) - self.at;
            from.y.atan2(from.x)
        };
        let mut around = self.spokes.clone();
        around.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        let every = around.len().div_ceil(TURNED).max(1);
        around.into_iter().step_by(every).collect()
    }
}

fn place(scope: Scope<'_>, point: PointId) -> DVec2 {
    DVec3::from(scope.shown.place(point.index())).truncate()
}

/// So many of some points that are nearest to a place, but none nearer than the least.
fn nearest(points: &[PointId], far: impl Fn(&PointId) -> f64, (count, least): (usize, f64)) -> Vec<PointId> {
    let mut list: Vec<PointId> = points.iter().copied().filter(|point| far(point) > least).collect();
    list.sort_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)));
    list.truncate(count);
    list
}

/// Whether a corner of one of two bodies lies on a triangle of the other.
fn overlap(scope: Scope<'_>, bodies: [&[PointId]; 2]) -> bool {
    let is_of = |body: &[PointId], corners: &[PointId; 3]| body.binary_search(&corners[0]).is_ok();
    let covers = |corners: &[PointId; 3], at: DVec2| {
        let [a, b, c] = corners.map(|corner| place(scope, corner));
        let sides = [(b - a).perp_dot(at - a), (c - b).perp_dot(at - b), (a - c).perp_dot(at - c)];
        sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0)
    };
    [bodies, [bodies[1], bodies[0]]].into_iter().any(|[body, other]| {
        let triangles = scope.shown.scenery.triangles.iter().filter(|corners| is_of(body, corners));
        triangles.into_iter().any(|corners| other.iter().any(|&point| covers(corners, place(scope, point))))
    })
}

/// What the bonds of a hub are made of: rigid at rigid points, else springs as stiff as those there.
fn stuff(scope: Scope<'_>, points: &[PointId]) -> BondKind {
    let bonds = &scope.shown.scenery.bonds;
    let at = |bond: &Bond| points.contains(&bond.a) || points.contains(&bond.b);
    let kinds = || bonds.iter().filter(at).map(|bond| bond.kind);
    if kinds().any(|kind| kind == BondKind::Rigid) {
        return BondKind::Rigid;
    }
    let springs = kinds().filter_map(|kind| match kind {
        BondKind::Spring { stiffness, damping } => Some((stiffness, damping)),
        _ => None,
    });
    let most = springs.max_by(|a, b| a.0.total_cmp(&b.0));
    most.map_or(BondKind::Spring { stiffness: STIFFNESS, damping: 0.0 }, |(stiffness, damping)| BondKind::Spring {
        stiffness,
        damping,
    })
}

fn bond(a: u32, b: u32, kind: BondKind) -> BondKeys {
    match kind {
        BondKind::Spring { stiffness, damping } => BondKeys {
            kind: Some(KindName::Spring),
            stiffness: Some(stiffness),
            damping: Some(damping),
            ..BondKeys::new(a, b)
        },
        _ => BondKeys::new(a, b),
    }
}
