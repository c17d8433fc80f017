//! Handles in space: a ring about each axis, which turns what is selected about it, and a knob beside them that scales it.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::Deed;
use super::chosen::Chosen;
use super::grown::Growth;
use super::handles::Change;
use super::lifted::{self, Lift};
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::distance_to_segment;
use crate::history::{Do, Factors, MoveKeys};
use crate::render::Pose;
use crate::scene::Vector;
use crate::sim::BOX_EDGES;
use crate::sim::Figure;

/// Rings are about this much larger than what is selected `[1]`, and so large on the screen at least and at most `[logical px]`.
const AROUND: f64 = 1.1;
const RADII: [f64; 2] = [48.0, 190.0];
/// Sides of a ring.
const SIDES: usize = 64;
/// A press so near to a ring or the knob takes it `[logical px]`.
const REACH: f64 = 8.0;
/// Half a side of the knob, and how far it is from the rings `[logical px]`.
const HALF: f64 = 4.5;
const OFF: f64 = 16.0;
/// Widths of a ring before the middle and behind it, and of one that is held `[logical px]`.
const WIDTHS: [f64; 3] = [2.0, 0.8, 3.0];
/// A ring that is seen so much from its side is turned by pulling along it: the cosine of the view to its axis `[1]`.
const SIDEWAYS: f64 = 0.25;
/// The least and the greatest factor of a drag `[1]`: past the least a body would be a speck.
const FACTORS: [f64; 2] = [0.1, 20.0];
/// Turns go in steps of this while Shift is held `[rad]`.
const STEP: f64 = PI / 12.0;
/// Axes and the colours of their rings, as in other programs for space: x red, y green, z blue.
const AXES: [(DVec3, [u8; 3], &str); 3] =
    [(DVec3::X, [236, 92, 92], "x"), (DVec3::Y, [110, 196, 92], "y"), (DVec3::Z, [92, 140, 246], "z")];
/// Lines of a preview at most.
const MOST: usize = 3000;

/// A handle in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Ring {
    /// About x, y or z.
    About(usize),
    /// It scales.
    Size,
}

/// The handles of what is selected in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rings {
    /// The middle of what is selected, and the radius of the rings about it `[m]`.
    middle: DVec3,
    radius: f64,
    /// Planes have no size.
    is_endless: bool,
}

/// A handle that is being dragged, from this pixel `[px]`, of rings that stay as they were.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RingGrip {
    pub(super) ring: Ring,
    from: DVec2,
    rings: Rings,
}

/// What a drag makes of what is selected, about its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Turned {
    /// About the axis of a ring `[rad]`.
    About(usize, f64),
    /// By this factor `[1]`.
    By(f64),
}

impl Rings {
    /// Around what is selected; `None` in the plane, or where nothing of it is seen.
    pub(super) fn of(scope: Scope<'_>, chosen: &Chosen) -> Option<Self> {
        let Pose::Orbit { .. } = scope.camera.pose else { return None };
        let [low, high] = extent(scope, chosen)?;
        let middle = 0.5 * (low + high);
        let metre = metre(scope, middle)?;
        let pixel = DVec2::from(scope.camera.screen_from_world(middle)?);
        let [least, most] = RADII.map(|radius| radius * scope.scale);
        // Where there is less room they are smaller, with room for the knob beside them.
        let room = (pixel - scope.free[0]).min(scope.free[1] - pixel).min_element() - HALF * scope.scale;
        let [least, most] = [least, most.min(room).max(least)].map(|radius| radius / metre);
        let is_endless = chosen.is_ground(scope);
        Some(Rings { is_endless, middle, radius: (0.5 * AROUND * low.distance(high)).clamp(least, most) })
    }

    /// The middle of what is selected `[m]`.
    pub(super) fn middle(&self) -> DVec3 {
        self.middle
    }

    /// Places on a ring `[m]`.
    fn places(&self, axis: usize) -> [DVec3; SIDES + 1] {
        let (u, v) = (AXES[(axis + 1) % 3].0, AXES[(axis + 2) % 3].0);
        std::array::from_fn(|k| {
            let (sin, cos) = (TAU * k as f64 / SIDES as f64).sin_cos();
            self.middle + self.radius * (cos * u + sin * v)
        })
    }

    /// The knob that scales `[px]`.
    fn knob(&self, scope: Scope<'_>) -> Option<DVec2> {
        if self.is_endless {
            return None;
        }
        let middle = DVec2::from(scope.camera.screen_from_world(self.middle)?);
        let far = self.radius * metre(scope, self.middle)? + OFF * scope.scale;
        let corners = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let places = corners.map(|corner| middle + far * 0.5_f64.sqrt() * DVec2::from(corner));
        // At the first side that has room for it.
        let free = places.into_iter().find(|at| scope.kept(*at, HALF) == *at);
        Some(free.unwrap_or(scope.kept(places[0], HALF)))
    }

    /// The handle that a pixel means: of rings that cross there the one whose part in front is nearest.
    pub(super) fn ring(&self, scope: Scope<'_>, at: DVec2) -> Option<Ring> {
        let reach = REACH * scope.scale;
        if self.knob(scope).is_some_and(|knob| knob.distance(at) <= reach + HALF * scope.scale) {
            return Some(Ring::Size);
        }
        let deep = scope.camera.depth(self.middle);
        let near = (0..3).filter_map(|axis| {
            let places = self.places(axis);
            let sides = places.windows(2).filter_map(|ends| {
                let pixels = [scope.camera.screen_from_world(ends[0])?, scope.camera.screen_from_world(ends[1])?];
                let [a, b] = pixels.map(DVec2::from);
                Some((scope.camera.depth(ends[0]) > deep, distance_to_segment(at, a, b)))
            });
            let sides = sides.filter(|(_, far)| *far <= reach);
            sides.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|best| (best, axis))
        });
        let best = near.min_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        best.map(|(_, axis)| Ring::About(axis))
    }

    /// A handle is taken at a pixel.
    pub(super) fn grip(self, ring: Ring, from: DVec2) -> RingGrip {
        RingGrip { ring, from, rings: self }
    }

    /// The rings and the knob.
    pub(super) fn marks(&self, scope: Scope<'_>, held: Option<Ring>) -> Vec<Mark> {
        let deep = scope.camera.depth(self.middle);
        let mut marks = Vec::new();
        for (axis, (_, color, _)) in AXES.into_iter().enumerate() {
            let is_held = held == Some(Ring::About(axis));
            let role = if is_held { Role::Lead } else { Role::Paint(color) };
            for ends in self.places(axis).windows(2) {
                let pixels = [ends[0], ends[1]].map(|end| scope.camera.screen_from_world(end).map(DVec2::from));
                let [Some(a), Some(b)] = pixels else { continue };
                let is_behind = scope.camera.depth(0.5 * (ends[0] + ends[1])) > deep;
                let width = if is_held { WIDTHS[2] } else { WIDTHS[usize::from(is_behind)] };
                marks.push(Mark::Line(role, a, b, width * scope.scale));
            }
        }
        let role = if held == Some(Ring::Size) { Role::Lead } else { Role::Hold };
        marks.extend(self.knob(scope).map(|at| Mark::Square(role, at, HALF * scope.scale)));
        marks
    }
}

/// One of the axes.
pub(super) fn axis_of(axis: usize) -> DVec3 {
    AXES[axis].0
}

impl RingGrip {
    /// The place that stays `[m]`.
    pub(super) fn about(&self) -> DVec3 {
        self.rings.middle()
    }

    /// The same drag for obstacles that go along with it.
    pub(super) fn change(&self, scope: Scope<'_>, to: DVec2, in_steps: bool) -> Change {
        match self.turned(scope, to, in_steps) {
            Turned::About(axis, angle) => Change::Spin(axis, angle),
            Turned::By(factor) => Change::Scale([factor; 2]),
        }
    }

    /// The rings, as they were taken.
    pub(super) fn marks(&self, scope: Scope<'_>) -> Vec<Mark> {
        self.rings.marks(scope, Some(self.ring))
    }

    /// What a drag to a pixel comes to; `in_steps`: by whole steps.
    pub(super) fn turned(&self, scope: Scope<'_>, to: DVec2, in_steps: bool) -> Turned {
        let Ring::About(axis) = self.ring else { return self.scaled(scope, to) };
        let angle = self.angle(scope, axis, to).unwrap_or(0.0);
        Turned::About(axis, if in_steps { STEP * (angle / STEP).round() } else { angle })
    }

    fn scaled(&self, scope: Scope<'_>, to: DVec2) -> Turned {
        let Some(middle) = scope.camera.screen_from_world(self.rings.middle).map(DVec2::from) else {
            return Turned::By(1.0);
        };
        let [from, to] = [self.from, to].map(|at| at - middle);
        let factor = to.dot(from) / from.length_squared();
        let [least, most] = FACTORS;
        Turned::By(if factor.is_finite() { factor.clamp(least, most) } else { 1.0 })
    }

    /// By which angle a ring is turned: as the pointer goes around in its plane; along it, where it is seen from its side.
    fn angle(&self, scope: Scope<'_>, axis: usize, to: DVec2) -> Option<f64> {
        let (normal, Rings { middle, radius, .. }) = (AXES[axis].0, self.rings);
        let around = |at: DVec2| {
            let cursor = scope.camera.cursor(at.to_array());
            let [origin, direction] = [cursor.origin, cursor.direction].map(DVec3::from);
            let slope = direction.normalize().dot(normal);
            let far = (middle - origin).dot(normal) / direction.dot(normal);
            (slope.abs() > SIDEWAYS && far > 0.0).then(|| origin + far * direction - middle)
        };
        if let (Some(a), Some(b)) = (around(self.from), around(to)) {
            return Some(normal.dot(a.cross(b)).atan2(a.dot(b)));
        }
        // The place of the ring that was taken.
        let places = self.rings.places(axis);
        let pixel = |place: DVec3| scope.camera.screen_from_world(place).map(DVec2::from);
        let seen: Vec<(f64, DVec3)> =
            places.iter().filter_map(|&place| Some((pixel(place)?.distance(self.from), place))).collect();
        let least = seen.iter().fold(f64::INFINITY, |least, (far, _)| least.min(*far));
        // Of two that are seen at the same pixel the one in front.
        let near = seen.into_iter().filter(|(far, _)| *far < least + 1.0).map(|(_, place)| place);
        let taken = near.min_by(|a, b| scope.camera.depth(*a).total_cmp(&scope.camera.depth(*b)))?;
        let along = normal.cross(taken - middle).normalize();
        let step = 1e-3 * radius;
        let way = (pixel(taken + step * along)? - pixel(taken)?) / step;
        let metres = (to - self.from).dot(way) / way.length_squared();
        Some(metres / radius).filter(|angle| angle.is_finite())
    }
}

impl Turned {
    /// Where a place goes `[m]`.
    fn place(self, about: DVec3, x: DVec3) -> DVec3 {
        match self {
            Turned::About(axis, angle) => about + glam::DQuat::from_axis_angle(AXES[axis].0, angle) * (x - about),
            Turned::By(factor) => about + factor * (x - about),
        }
    }

    /// In figures.
    pub(super) fn words(self) -> String {
        match self {
            Turned::About(axis, angle) => format!("{:.0}° about {}", angle.to_degrees(), AXES[axis].2),
            Turned::By(factor) if factor == FACTORS[0] => format!("× {factor:.2}: a tenth is the least"),
            Turned::By(factor) => format!("× {factor:.2}"),
        }
    }

    /// The command that does it to what is selected, about its middle now; nothing where nothing changes.
    pub(super) fn deed(self, scope: Scope<'_>, chosen: &Chosen) -> Deed {
        let Some([low, high]) = extent(scope, chosen) else { return Deed::default() };
        let vector = |x: DVec3| Some(Vector::Space(x.to_array()));
        let keys = MoveKeys {
            points: chosen.numbers(),
            obstacles: chosen.obstacles.clone(),
            about: vector(0.5 * (low + high)),
            ..MoveKeys::default()
        };
        let lift = self.lift(scope, chosen, 0.5 * (low + high));
        let deed = match self {
            Turned::About(_, 0.0) | Turned::By(1.0) => return Deed::default(),
            Turned::About(axis, angle) => {
                let keys = MoveKeys { turn: Some(angle), axis: vector(AXES[axis].0), ..keys };
                Deed::edit("turn", Do::Move(Box::new(keys)))
            }
            Turned::By(factor) => {
                let keys = MoveKeys { scale: Some(Factors::One(factor)), ..keys };
                let mut deed = Deed::edit("scale", Do::Move(Box::new(keys)));
                deed.commands.extend(Growth::of(scope, chosen, DVec3::splat(factor)).commands());
                deed
            }
        };
        let words = lift.said.map(str::to_owned);
        lifted::with(scope, lift.way, Deed { words, ..deed })
    }

    fn lift(self, scope: Scope<'_>, chosen: &Chosen, about: DVec3) -> Lift {
        lifted::lift(scope, chosen, |x| self.place(about, x))
    }

    /// What is said of it beside the pointer.
    pub(super) fn said(self, scope: Scope<'_>, chosen: &Chosen) -> String {
        let lift = extent(scope, chosen).map(|[low, high]| self.lift(scope, chosen, 0.5 * (low + high)));
        let more = lift.and_then(|lift| lift.said);
        let grown = match self {
            Turned::By(factor) => Growth::of(scope, chosen, DVec3::splat(factor)).words(scope),
            Turned::About(..) => String::new(),
        };
        format!("{}{grown}{}", self.words(), more.map_or_else(String::new, |more| format!(": {more}")))
    }

    /// Lines of what is selected where it would be.
    pub(super) fn preview(self, scope: Scope<'_>, chosen: &Chosen) -> Vec<Mark> {
        let Some([low, high]) = extent(scope, chosen) else { return Vec::new() };
        let about = 0.5 * (low + high);
        let lift = self.lift(scope, chosen, about).way;
        let pixel = |x: DVec3| scope.camera.screen_from_world(self.place(about, x) + lift).map(DVec2::from);
        let line = |[a, b]: [DVec3; 2]| Some(Mark::Line(Role::Come, pixel(a)?, pixel(b)?, 1.5 * scope.scale));
        let scenery = &scope.shown.scenery;
        let has = |point: &crate::sim::PointId| chosen.points.binary_search(point).is_ok();
        let bonds: Vec<_> = scenery.bonds.ends().iter().filter(|ends| ends.iter().all(has)).collect();
        let step = bonds.len() / MOST + 1;
        let place = |point: crate::sim::PointId| DVec3::from(scope.shown.place(point.index()));
        let bodies = bonds.into_iter().step_by(step).filter_map(|ends| line(ends.map(place)));
        let is_chosen = |(_, number): &(_, &u32)| chosen.obstacles.contains(number);
        let solids = scenery.convex.iter().zip(&scenery.solid_numbers).filter(|pair| is_chosen(&(0, pair.1)));
        let solids = solids.flat_map(|(convex, _)| edges(scope, &convex.figure)).filter_map(line);
        let planes = scenery.planes.iter().zip(&scenery.plane_numbers).filter(|pair| is_chosen(&(0, pair.1)));
        let planes = planes.flat_map(|([point, normal], _)| {
            let [point, normal] = [point, normal].map(|x| DVec3::from(*x));
            let [from, to] = [point, point + normal].map(|x| self.place(about, x));
            scope.rim([from.to_array(), (to - from).to_array()])
        });
        let planes = planes.map(|[a, b]| Mark::Line(Role::Come, a, b, 1.5 * scope.scale));
        bodies.chain(solids).chain(planes).collect()
    }
}

/// The edges of a box, and of a ball a circle that faces who plays `[m]`.
fn edges(scope: Scope<'_>, figure: &Figure) -> Vec<[DVec3; 2]> {
    if let (Some(frame), Figure::Box { .. }) = (figure.frame(), figure) {
        let corners = frame.corners().map(DVec3::from);
        return BOX_EDGES.iter().map(|ends| ends.map(|end| corners[end as usize])).collect();
    }
    let center = DVec3::from(figure.center());
    let Some([u, v]) = facing(scope, center) else { return Vec::new() };
    let radius = 0.5 * (figure.extent()[1][0] - figure.extent()[0][0]);
    let at = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / SIDES as f64).sin_cos();
        center + radius * (cos * u + sin * v)
    };
    (0..SIDES).map(|k| [at(k), at(k + 1)]).collect()
}

/// Two directions across the view of a place.
fn facing(scope: Scope<'_>, at: DVec3) -> Option<[DVec3; 2]> {
    let pixel = scope.camera.screen_from_world(at)?;
    let ahead = DVec3::from(scope.camera.cursor(pixel).direction).try_normalize()?;
    let u = ahead.any_orthonormal_vector();
    Some([u, ahead.cross(u)])
}

/// Pixels of a metre across the view at a place.
fn metre(scope: Scope<'_>, at: DVec3) -> Option<f64> {
    let [u, _] = facing(scope, at)?;
    let step = 1e-3 * scope.camera.distance().max(1e-9);
    let [a, b] = [at, at + step * u].map(|x| scope.camera.screen_from_world(x).map(DVec2::from));
    Some(a?.distance(b?) / step).filter(|pixels| *pixels > 0.0 && pixels.is_finite())
}

/// The box around what is selected `[m]`; of nothing but planes, which have no end, the place that is seen.
fn extent(scope: Scope<'_>, chosen: &Chosen) -> Option<[DVec3; 2]> {
    let points = chosen.points.iter().map(|point| DVec3::from(scope.shown.place(point.index())));
    let scenery = &scope.shown.scenery;
    let solids = scenery.convex.iter().zip(&scenery.solid_numbers);
    let solids = solids.filter(|(_, number)| chosen.obstacles.contains(number));
    let corners = solids.flat_map(|(convex, _)| convex.figure.extent()).map(DVec3::from);
    let around = points.chain(corners).filter(|x| x.is_finite()).fold(None, |around: Option<[DVec3; 2]>, x| {
        Some(around.map_or([x; 2], |[low, high]| [low.min(x), high.max(x)]))
    });
    around.or_else(|| {
        let mut planes = scenery.planes.iter().zip(&scenery.plane_numbers);
        let (plane, _) = planes.find(|(_, number)| chosen.obstacles.contains(number))?;
        Some([scope.floor_middle(*plane)?; 2])
    })
}
