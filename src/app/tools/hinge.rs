//! Hinges that come and that are there: what a click means, what they are bonded to, and the keys that bring them.

use glam::{DVec2, DVec3};

use super::areas::is_in;
use super::drives::MotorChoice;
use super::effort;
use super::hub::{Hub, Hubs, props_of};
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::distance_to_segment;
use super::skin;
use super::touching::{gap, touches};
use crate::app::matter::IN_HUB;
use crate::history::{Do, MoveKeys};
use crate::scene::{AddKeys, AngleKeys, BondKeys, KindName, MassKeys, PointKeys, Row, Vector};
use crate::sim::{Bond, BondKind, PointId};

/// Bonds of a hub to a body that turns about it, and to one that holds it, by which the two are told apart: with three that lie along its edge
/// that sags by a wheel.
const SPOKES: usize = 6;
const STRUTS: usize = 5;
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

/// A hinge this near to the middle of what is round is its own, in its radius `[1]`: also of a wheel that is squashed, which is round as far as
/// [`SQUASHED`] says, where it is clicked as near to it.
const HINGED_AT: f64 = 0.5;
const SQUASHED: f64 = 0.5;
/// What lies so near is meant by a click `[logical px]`.
const SNAP: f64 = 12.0;
/// A click lies on a body whose edge is no farther from it `[logical px]`.
const EDGE: f64 = 4.0;
/// What is lifted off a floor to be turned stands so far above it, and is lifted no further, in its radius `[1]`.
const CLEAR: f64 = 0.02;
const MOST_LIFT: f64 = 0.25;
/// Said in space.
pub(super) const IN_SPACE: &str = "in the plane only: this scene is in space";
/// Said where something holds the body already.
const PINNED: &str = "a pin is here already: press T on it to let it go";
const JOINT: &str = "a joint is here already: its limbs turn about it";
/// A hinge that is to come: its hub, what turns about it, and what holds it, if the ground does not.
#[derive(Clone)]
pub(super) struct Hinge {
    at: DVec2,
    spokes: Vec<PointId>,
    pub(super) struts: Vec<PointId>,
    pub(super) has_motor: bool,
}

/// The middle of a body that is round, and its radius `[m]`.
fn round(scope: Scope<'_>, body: &[PointId]) -> Option<(DVec2, f64)> {
    round_by(scope, body, ROUND)
}

/// The same, by how near to its middle its skin may be `[1]`.
fn round_by(scope: Scope<'_>, body: &[PointId], share: f64) -> Option<(DVec2, f64)> {
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
    (least >= share * most).then_some((middle, most))
}

/// Whether the body that these points are of is round.
fn is_round(scope: Scope<'_>, side: &[PointId]) -> bool {
    side.first().is_some_and(|&point| round(scope, &Hubs::of(scope, point).piece(point)).is_some())
}

/// What a click with the tool for motors means.
pub(super) enum Meant {
    /// A hinge that is there.
    There(Hub),
    /// Two bodies that are hinged elsewhere: a second hinge would lock them.
    Joined(Hub),
    /// One that is to come.
    New(Hinge),
}

impl Meant {
    /// At a pixel: a hinge that is there, at its hub or on what is round about it; else of the body that lies there and another one beside
    /// it, or of that and the background. `None`: no body lies there.
    pub(super) fn at(scope: Scope<'_>, pixel: DVec2, wants_motor: Option<bool>) -> Option<Result<Self, &'static str>> {
        if scope.shown.dimensions != 2 {
            return Some(Err(IN_SPACE));
        }
        let hit = scope.nearest(pixel)?;
        let hubs = Hubs::of(scope, hit.point);
        let reached = scope.reached(pixel);
        // What a motor or a stop pushes against belongs to its hinge.
        let is_of = |hub: &&Hub| {
            let props = props_of(scope, hub.point);
            reached.iter().any(|point| hub.pushes_against(*point) || props.contains(point))
        };
        let hub = reached.iter().find_map(|point| hubs.at(*point)).or_else(|| hubs.all.iter().find(is_of));
        if let Some(hub) = hub {
            return Some(Ok(Meant::There(hub.clone())));
        }
        if reached.iter().any(|&point| scope.is_pinned(point)) {
            return Some(Err(PINNED));
        }
        if reached.iter().any(|point| scope.shown.scenery.joints.contains(point)) {
            return Some(Err(JOINT));
        }
        Hinge::at(scope, (pixel, hit.point), &hubs, wants_motor)
    }
}

impl Hinge {
    /// About a pixel near a point of a body.
    fn at(
        scope: Scope<'_>,
        (pixel, point): (DVec2, PointId),
        hubs: &Hubs<'_>,
        wants_motor: Option<bool>,
    ) -> Option<Result<Meant, &'static str>> {
        let clicked = scope.in_plane(pixel);
        let body = hubs.piece(point);
        // What is round turns about its middle; near its rim it can hang, without a motor.
        let round = round(scope, &body);
        let is_meant = |(middle, radius): &(DVec2, f64)| {
            wants_motor != Some(false) || clicked.distance(*middle) <= MIDDLE * radius
        };
        let meant = round.filter(is_meant);
        let is_clicked = |(middle, radius): &(DVec2, f64)| clicked.distance(*middle) <= HINGED_AT * radius;
        let wheel = meant.or_else(|| round_by(scope, &body, SQUASHED).filter(is_clicked));
        if let Some((middle, radius)) = wheel
            && let Some(hub) = hubs.near(middle, HINGED_AT * radius)
        {
            return Some(Ok(Meant::There(hub.clone())));
        }
        let at = meant.map_or(clicked, |(middle, _)| middle);
        let far = |&point: &PointId| place(scope, point).distance(at);
        let radius = body.iter().map(far).fold(0.0, f64::max);
        let spokes = nearest(&body, far, (SPOKES, LEAST_SPOKE * radius));
        if spokes.len() < 2 {
            return Some(Err("a hinge needs a body of three points or more"));
        }
        let most = NEAR * radius;
        let is_other =
            |point: &PointId| scope.is_there(*point) && body.binary_search(point).is_err() && hubs.at(*point).is_none();
        // What holds a wheel may lie beside it; all else is joined where the click lies on both.
        let others: Vec<PointId> = match meant {
            Some(_) => (0..scope.shown.point_count() as u32).map(PointId).filter(is_other).collect(),
            None => touched(scope, pixel).into_iter().filter(is_other).collect(),
        };
        let nearest_other = others.into_iter().min_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)));
        let other = nearest_other.filter(|point| meant.is_none() || far(point) <= most);
        // What a motor on the ground pushes against is no body.
        let holder = other.map(|point| Hubs::of(scope, point).piece(point)).filter(|holder| holder.len() > 1);
        let holder = holder.unwrap_or_default();
        if let Some(hub) = hubs.between(&body, &holder) {
            let in_wheel = |side: &[PointId]| {
                let round = round_by(scope, side, SQUASHED);
                let most = if wants_motor == Some(false) { HINGED_AT } else { 1.0 };
                round.is_some_and(|(middle, radius)| clicked.distance(middle) <= most * radius)
            };
            let is_of_wheel = in_wheel(&body) || in_wheel(&holder);
            return Some(Ok(if is_of_wheel { Meant::There(hub.clone()) } else { Meant::Joined(hub.clone()) }));
        }
        let struts = nearest(&holder, far, (STRUTS, LEAST_SPOKE * radius));
        let has_motor = wants_motor.unwrap_or(round.is_some() && struts.is_empty());
        Some(Ok(Meant::New(Hinge { at, spokes, struts, has_motor })))
    }

    /// One that is there: what is round turns, or what has the most bonds.
    pub(super) fn of(scope: Scope<'_>, hub: &Hub) -> Self {
        let turning = hub.sides.iter().position(|side| is_round(scope, side)).unwrap_or(0);
        let side = |k: usize| hub.sides.get(k).cloned().unwrap_or_default();
        let struts = if hub.is_pinned { Vec::new() } else { side(if turning == 0 { 1 } else { 0 }) };
        Hinge { at: place(scope, hub.point), spokes: side(turning), struts, has_motor: true }
    }

    /// Whether it is to join a wheel to another body without turning it.
    pub(super) fn joins_a_wheel(&self, scope: Scope<'_>) -> bool {
        let sides = [&self.spokes, &self.struts];
        !self.has_motor && !self.struts.is_empty() && sides.into_iter().any(|side| is_round(scope, side))
    }

    /// What a motor on the background pushes against: a pin in the hub, so near that both are seen and meant as one `[m]`.
    pub(super) fn prop(scope: Scope<'_>, hinge: &Hinge, is_pinned: bool) -> Vec<DVec2> {
        let arm = hinge.spokes.first().map_or(1.0, |&spoke| place(scope, spoke).distance(hinge.at));
        is_pinned.then_some(hinge.at + DVec2::new(IN_HUB * arm, 0.0)).into_iter().collect()
    }

    /// Its lines and its hub: what turns and what holds it.
    pub(super) fn marks(&self, scope: Scope<'_>, [turns, holds]: [Role; 2]) -> Vec<Mark> {
        let Some(hub) = scope.on_screen(self.at) else { return Vec::new() };
        let lines = self.spokes.iter().map(|spoke| (turns, spoke));
        let lines = lines.chain(self.struts.iter().map(|strut| (holds, strut)));
        let mut marks: Vec<Mark> = lines
            .filter_map(|(role, &point)| Some(Mark::Line(role, hub, scope.pixel(point)?, 2.0 * scope.scale)))
            .collect();
        marks.push(Mark::Ring(turns, hub, 7.0 * scope.scale));
        marks
    }

    /// Whether what turns about it lies on a floor or a wall.
    pub(super) fn rests(&self, scope: Scope<'_>) -> bool {
        let Some(&first) = self.spokes.first() else { return false };
        let near = SNAP * scope.scale / scope.camera.pixels_per_metre();
        let body = Hubs::of(scope, first).piece(first);
        body.into_iter().any(|point| gap(scope, place(scope, point)) <= near)
    }

    /// What it turns, and how far that goes up before its axle is pinned, so that it turns freely `[m]`: a rigid wheel has corners, which the
    /// floor that it lies on would hold.
    fn lift(&self, scope: Scope<'_>) -> Option<(Vec<PointId>, DVec2)> {
        if !(self.struts.is_empty() && self.has_motor && self.rests(scope)) {
            return None;
        }
        let up = -scope.shown.settings.gravity.map(|[x, y, _]| DVec2::new(x, y))?.try_normalize()?;
        let body = Hubs::of(scope, *self.spokes.first()?).piece(self.spokes[0]);
        let radius = body.iter().map(|&point| place(scope, point).distance(self.at)).fold(0.0, f64::max);
        let far = (1.0 + CLEAR) * radius - gap(scope, self.at);
        (far > 0.0 && far < MOST_LIFT * radius).then_some((body, far * up))
    }

    /// What brings it into the world.
    pub(super) fn commands(&self, scope: Scope<'_>, motor: &MotorChoice) -> Vec<Do> {
        let Some((body, by)) = self.lift(scope) else { return vec![Do::Add(Box::new(self.keys(scope, motor)))] };
        let lifted = Hinge { at: self.at + by, ..self.clone() };
        let points = body.into_iter().map(|point| point.0).collect();
        let lift = MoveKeys { points, by: Some(Vector::Plane(by.to_array())), ..MoveKeys::default() };
        vec![Do::Move(Box::new(lift)), Do::Add(Box::new(lifted.keys(scope, motor)))]
    }

    /// The keys that bring it into the world.
    fn keys(&self, scope: Scope<'_>, motor: &MotorChoice) -> AddKeys {
        let hub = scope.shown.point_count() as u32;
        let is_grounded = self.struts.is_empty();
        let mut position = vec![self.at];
        position.extend(Hinge::prop(scope, self, is_grounded && self.has_motor));
        let reference = self.struts.first().map_or(hub + 1, |strut| strut.0);
        let kind = stuff(scope, &self.spokes);
        let spokes = self.spokes.iter().map(|spoke| bond(hub, spoke.0, kind));
        let struts = self.struts.iter().map(|strut| bond(hub, strut.0, stuff(scope, &self.struts)));
        let mut points = pins(position, self.mass(scope), hub);
        if !is_grounded {
            points.pinned.clear();
        }
        AddKeys {
            points: Some(points),
            bonds: spokes.chain(struts).collect(),
            angles: if self.has_motor { self.motors(scope, motor, [reference, hub]) } else { Vec::new() },
            ..AddKeys::default()
        }
    }

    /// Its motors, which turn its spokes about a hub against what is there already.
    pub(super) fn motors(&self, scope: Scope<'_>, motor: &MotorChoice, [reference, hub]: [u32; 2]) -> Vec<AngleKeys> {
        let turned = self.turned(scope);
        let each = self.torque(scope, motor) / turned.len().max(1) as f64;
        let angle = |rim: PointId| AngleKeys {
            points: Row([reference, hub, rim.0]),
            rest: Some(std::f64::consts::PI),
            stiffness: None,
            damping: None,
            min: None,
            max: None,
            drive: Some(motor.keys(each)),
        };
        turned.into_iter().map(angle).collect()
    }

    /// The torque of its motor `[N m]`: of a soft body as much as shears what it turns by half.
    pub(super) fn torque(&self, scope: Scope<'_>, motor: &MotorChoice) -> f64 {
        self.wished(scope, motor).min(self.bears(scope))
    }

    /// The torque that what it turns bears `[N m]`: of a rigid body any.
    pub(super) fn bears(&self, scope: Scope<'_>) -> f64 {
        let BondKind::Spring { stiffness, .. } = stuff(scope, &self.spokes) else { return f64::INFINITY };
        let arms = self.turned(scope).into_iter().map(|spoke| place(scope, spoke).distance_squared(self.at));
        SHEAR * stiffness * arms.sum::<f64>()
    }

    /// The torque that is asked for `[N m]`: where none is said, what moves the body.
    pub(super) fn wished(&self, scope: Scope<'_>, motor: &MotorChoice) -> f64 {
        motor.torque.unwrap_or_else(|| effort::proposed(self.needed(scope, motor.speed)))
    }

    /// The torque that turns it at a speed `[rad/s]`, about `[N m]`.
    pub(super) fn needed(&self, scope: Scope<'_>, speed: f64) -> f64 {
        let body = |points: &[PointId]| points.first().map(|&point| Hubs::of(scope, point).piece(point));
        let (turning, holder) = (body(&self.spokes).unwrap_or_default(), body(&self.struts).unwrap_or_default());
        // What hangs in the air on the background rubs on nothing.
        let reach = turning.iter().map(|&point| place(scope, point).distance(self.at)).fold(0.0, f64::max);
        let rubs = !holder.is_empty() || touches(scope, &turning, reach);
        effort::needed(scope, self.at, [&turning, &holder], (speed, rubs))
    }

    /// What its hub weighs, as the points do that it is bonded to `[kg]`: a heavier one would press soft wheels flat.
    pub(super) fn mass(&self, scope: Scope<'_>) -> f64 {
        let masses = &scope.shown.scenery.masses;
        let of = self.spokes.iter().filter_map(|spoke| masses.get(spoke.index()));
        of.sum::<f64>() / self.spokes.len().max(1) as f64
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

/// The corners and ends of what a pixel lies on: triangles that cover it, bonds that pass it within [`EDGE`].
fn touched(scope: Scope<'_>, pixel: DVec2) -> Vec<PointId> {
    let scenery = &scope.shown.scenery;
    let covers = |corners: &&[PointId; 3]| {
        let [Some(a), Some(b), Some(c)] = corners.map(|corner| scope.pixel(corner)) else { return false };
        is_in([a, b, c], pixel)
    };
    let passes = |ends: &&[PointId; 2]| {
        let [Some(from), Some(to)] = ends.map(|end| scope.pixel(end)) else { return false };
        distance_to_segment(pixel, from, to) <= EDGE * scope.scale
    };
    let corners = scenery.triangles.iter().filter(covers).flatten();
    corners.chain(scenery.bonds.ends().iter().filter(passes).flatten()).copied().collect()
}

/// Pins of this mass `[kg]` at these places `[m]`, numbered from the next on.
pub(super) fn pins(position: Vec<DVec2>, mass: f64, next: u32) -> PointKeys {
    PointKeys {
        mass: Some(MassKeys::Same(mass)),
        velocity: None,
        pinned: (next..next + position.len() as u32).collect(),
        position: position.into_iter().map(|at| Vector::Plane(at.to_array())).collect(),
    }
}

pub(super) fn place(scope: Scope<'_>, point: PointId) -> DVec2 {
    DVec3::from(scope.shown.place(point.index())).truncate()
}

/// So many of some points that are nearest to a place, but none nearer than the least.
fn nearest(points: &[PointId], far: impl Fn(&PointId) -> f64, (count, least): (usize, f64)) -> Vec<PointId> {
    let mut list: Vec<PointId> = points.iter().copied().filter(|point| far(point) > least).collect();
    list.sort_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)));
    list.truncate(count);
    list
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
