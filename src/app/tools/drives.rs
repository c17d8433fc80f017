//! The tools that drive: a bond becomes a muscle, and bodies turn about a hinge, by a motor if one likes.

use glam::{DVec2, DVec3};

use super::Deed;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::skin;
use crate::history::{Do, DriveOrNone, SetKeys};
use crate::scene::{
    AddKeys, AngleKeys, BondKeys, ContactKeys, DriveKeys, KeyName, KindName, MassKeys, Meeting, PointKeys, Row, Vector,
};
use crate::sim::{Bond, BondKind, Contact, Limit, PointId};

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

/// A body is round when its skin is nowhere nearer to its middle than this share of the farthest `[1]`, and has so many corners.
const ROUND: f64 = 0.85;
const LEAST_ROUND: usize = 8;
/// Without a motor a click this near to the middle of what is round means the middle, in its radius `[1]`.
const MIDDLE: f64 = 0.35;
/// A motor turns springs against each other by no more than this `[rad]`, about.
const SHEAR: f64 = 0.5;

/// Said where two bodies overlap that are hinged.
const PASSES: &str = "they overlap, so bodies meet themselves no more";

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
    /// It has a motor, or has none; `None`: what is round has one on the ground, and all else has none.
    pub(in crate::app) is_on: Option<bool>,
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
            motor: MotorChoice { is_on: None, speed: -6.0, torque: 30.0, key: None, back: None },
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
        match Hinge::at(scope, at, self.motor.is_on) {
            None => Deed::words(NO_BODY.to_owned()),
            Some(Err(why)) => Deed::words(why.to_owned()),
            Some(Ok(hinge)) => {
                let name = if hinge.has_motor { "motor" } else { "hinge" };
                let mut deed = Deed::edit(name, Do::Add(Box::new(hinge.keys(scope, &self.motor))));
                if let Some(contact) = hinge.parted {
                    deed.commands.insert(0, pass_through(contact));
                    deed.words = Some(format!("{PASSES}; Settings (G) change that back"));
                }
                deed
            }
        }
    }

    /// What a click with the tool for motors would do.
    pub(super) fn mark_motor(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let hinge = match Hinge::at(scope, at, self.motor.is_on) {
            None => return Vec::new(),
            Some(Err(why)) => return vec![Mark::Words(beside(scope, at), why.to_owned())],
            Some(Ok(hinge)) => hinge,
        };
        let Some(hub) = scope.on_screen(hinge.at) else { return Vec::new() };
        let lines = hinge.spokes.iter().map(|spoke| (Role::Come, spoke));
        let lines = lines.chain(hinge.struts.iter().map(|strut| (Role::Hold, strut)));
        let mut marks: Vec<Mark> = lines
            .filter_map(|(role, &point)| Some(Mark::Line(role, hub, scope.pixel(point)?, 2.0 * scope.scale)))
            .collect();
        marks.push(Mark::Ring(Role::Come, hub, 7.0 * scope.scale));
        let what = if hinge.has_motor { "a motor" } else { "a hinge" };
        let on = if hinge.struts.is_empty() { "on the ground" } else { "between both bodies" };
        let torque = hinge.torque(scope, &self.motor);
        let why = match hinge.parted {
            Some(_) => format!(": {PASSES}"),
            None if hinge.has_motor && torque < self.motor.torque => format!(", {torque:.1} N m: more would tear it"),
            None => String::new(),
        };
        marks.push(Mark::Words(beside(scope, at), format!("{what} {on}{why}")));
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
    has_motor: bool,
    /// Both overlap: how bodies meet, which are not to meet themselves any more.
    parted: Option<Contact>,
}

/// What is hinged is one body, which meets itself no more than others do.
fn pass_through(Contact { friction, restitution, radius, with_others, .. }: Contact) -> Do {
    let contact = ContactKeys {
        friction: Some(friction),
        restitution: Some(restitution),
        radius,
        with_itself: Some(false),
        bodies: Some(with_others),
    };
    Do::Set(Box::new(SetKeys { contact: Some(Meeting::As(contact)), ..SetKeys::default() }))
}

/// The middle of a body that is round, and its radius `[m]`.
fn round(scope: Scope<'_>, body: &[PointId]) -> Option<(DVec2, f64)> {
    let mut skin: Vec<PointId> = skin::sides(scope, body).into_iter().flatten().collect();
    skin.sort_unstable();
    skin.dedup();
    if skin.len() < LEAST_ROUND {
        return None;
    }
    let middle = skin.iter().map(|point| place(scope, *point)).sum::<DVec2>() / skin.len() as f64;
    let far = |point: &PointId| place(scope, *point).distance(middle);
    let least = skin.iter().map(far).fold(f64::INFINITY, f64::min);
    let most = skin.iter().map(far).fold(0.0, f64::max);
    (least >= ROUND * most).then_some((middle, most))
}

impl Hinge {
    /// About a pixel: of the body that lies there and another one beside it, else of that and the ground. `None`: no body lies there.
    fn at(scope: Scope<'_>, pixel: DVec2, wants_motor: Option<bool>) -> Option<Result<Self, &'static str>> {
        let hit = scope.nearest(pixel)?;
        if scope.shown.dimensions != 2 {
            return Some(Err("hinges are of the plane: this scene is in space"));
        }
        if scope.reached(pixel).into_iter().any(|point| scope.is_pinned(point)) {
            return Some(Err("a pin or a hinge is there already"));
        }
        let clicked = scope.in_plane(pixel);
        let body = scope.body(hit.point);
        // What is round turns about its middle; near its rim it can hang, without a motor.
        let round = round(scope, &body);
        let is_meant = |(middle, radius): &(DVec2, f64)| {
            wants_motor != Some(false) || clicked.distance(*middle) <= MIDDLE * radius
        };
        let at = round.filter(is_meant).map_or(clicked, |(middle, _)| middle);
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
        // What a motor on the ground pushes against is no body.
        let holder = other.map(|point| scope.body(point)).filter(|holder| holder.len() > 1).unwrap_or_default();
        let struts = nearest(&holder, far, (STRUTS, LEAST_SPOKE * radius));
        let contact = scope.shown.settings.contact.flatten().filter(|contact| contact.with_itself);
        let parted = contact.filter(|_| overlap(scope, [&body, &holder]));
        let has_motor = wants_motor.unwrap_or(round.is_some() && struts.is_empty());
        Some(Ok(Hinge { at, spokes, struts, has_motor, parted }))
    }

    /// The keys that bring it into the world.
    fn keys(&self, scope: Scope<'_>, motor: &MotorChoice) -> AddKeys {
        let hub = scope.shown.point_count() as u32;
        let is_grounded = self.struts.is_empty();
        let arm = self.spokes.first().map_or(1.0, |&spoke| place(scope, spoke).distance(self.at));
        let mut position = vec![self.at];
        // What a motor on the ground pushes against.
        position.extend((is_grounded && self.has_motor).then_some(self.at + DVec2::new(0.5 * arm, 0.0)));
        let reference = self.struts.first().map_or(hub + 1, |strut| strut.0);
        let kind = stuff(scope, &self.spokes);
        let spokes = self.spokes.iter().map(|spoke| bond(hub, spoke.0, kind));
        let struts = self.struts.iter().map(|strut| bond(hub, strut.0, stuff(scope, &self.struts)));
        let turned = if self.has_motor { self.turned(scope) } else { Vec::new() };
        let share = self.torque(scope, motor) / motor.torque / turned.len().max(1) as f64;
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

    /// The torque of its motor `[N m]`: of a soft body as much as shears what it turns by half.
    fn torque(&self, scope: Scope<'_>, motor: &MotorChoice) -> f64 {
        let BondKind::Spring { stiffness, .. } = stuff(scope, &self.spokes) else { return motor.torque };
        let arms = self.turned(scope).into_iter().map(|spoke| place(scope, spoke).distance_squared(self.at));
        motor.torque.min(SHEAR * stiffness * arms.sum::<f64>())
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
