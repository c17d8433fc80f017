//! What is drawn over the world for the tools: what is led, and what a click would do.

use glam::{DVec2, DVec3};

use super::build::Maker;
use super::chosen::Chosen;
use super::pick::Scope;
use super::segments;
use super::selecting::{dragged, pins};
use super::{Doing, boxes, erase, hub, knot, skin};
use crate::app::action::Tool;
use crate::app::player::Probe;
use crate::sim::{BOX_EDGES, Figure, PointId};

/// What a mark says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Role {
    /// It is led.
    Lead,
    /// It will be held.
    Hold,
    /// It will be let go, cut or taken away.
    Away,
    /// It will be there.
    Come,
    /// A force that stays.
    Push,
    /// It is probed: by the first or the second probe.
    Probe(usize),
    /// The pointer is there too, in a world beside that which it is over; or it is hidden there.
    Ghost,
    /// It will have this colour.
    Paint([u8; 3]),
}

/// A line, a ring or a few words over the world `[px]`.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) enum Mark {
    /// From, to, width.
    Line(Role, DVec2, DVec2, f64),
    /// Middle, radius.
    Ring(Role, DVec2, f64),
    /// A box: its left upper and right lower corner.
    Frame(Role, DVec2, DVec2),
    /// A handle to turn by: middle, radius.
    Knob(Role, DVec2, f64),
    /// A handle to pull by: middle, half a side.
    Square(Role, DVec2, f64),
    /// The lower left corner, and what is written there.
    Words(DVec2, String),
    /// The middle of the lower edge, what is written there, and the part of the picture that it stays in: left, top, width and height.
    Label(DVec2, String, [u32; 4]),
}

impl Mark {
    /// The same in another role.
    pub(super) fn with(self, role: Role) -> Self {
        match self {
            Mark::Line(_, from, to, width) => Mark::Line(role, from, to, width),
            Mark::Ring(_, middle, radius) => Mark::Ring(role, middle, radius),
            Mark::Frame(_, low, high) => Mark::Frame(role, low, high),
            Mark::Knob(_, middle, radius) => Mark::Knob(role, middle, radius),
            Mark::Square(_, middle, half) => Mark::Square(role, middle, half),
            words @ (Mark::Words(..) | Mark::Label(..)) => words,
        }
    }

    /// The same where its pixels go.
    pub(super) fn mapped(self, place: impl Fn(DVec2) -> DVec2) -> Self {
        match self {
            Mark::Line(role, from, to, width) => Mark::Line(role, place(from), place(to), width),
            Mark::Ring(role, middle, radius) => Mark::Ring(role, place(middle), radius),
            Mark::Frame(role, low, high) => Mark::Frame(role, place(low), place(high)),
            Mark::Knob(role, middle, radius) => Mark::Knob(role, place(middle), radius),
            Mark::Square(role, middle, half) => Mark::Square(role, place(middle), half),
            Mark::Words(corner, words) => Mark::Words(place(corner), words),
            Mark::Label(foot, words, room) => Mark::Label(place(foot), words, room),
        }
    }
}

/// Width of a line for the least and the greatest force `[logical px]`.
const WIDTHS: [f64; 2] = [1.5, 7.0];
/// A force that is drawn at half the way between both `[N]`: the weight of three kilograms.
const HALF_FORCE: f64 = 30.0;
/// Radius of the ring around a point that is probed `[logical px]`.
const RING: f64 = 9.0;
/// Said of what is moved while time stands still: of a body with pins, before that too, and of a pin.
const ALONG: &str = "its pins move too; the Select tool (6) can turn it";
const WITH_PINS: &str = "paused: a drag moves it with its pins";
const ALONE: &str = "paused: a drag moves the pin, its body stays";
/// Said of an obstacle in space before it is dragged.
const IN_SPACE: &str = "drag: it moves up, down and sideways as you see it, no nearer and no farther";
/// Bonds of a body that are drawn at most.
const MOST: usize = 4000;

pub(super) fn of(
    (tool, maker, is_still): (Tool, Maker, bool),
    doing: &Doing,
    scope: Scope<'_>,
    at: Option<DVec2>,
) -> Vec<Mark> {
    match (doing, tool) {
        (Doing::Grabbing(points), _) => {
            let mut marks = led(scope, points, at);
            let ties = tool == Tool::Hand && !maker.is_free;
            marks.extend(at.filter(|_| ties).into_iter().flat_map(|at| knot::would_tie(scope, points, at)));
            marks
        }
        (Doing::Carrying(hold, what), _) => {
            let by = at.map_or(DVec3::ZERO, |at| scope.way(*hold, at));
            let what = what.left(scope);
            let (mut marks, said) = dragged(scope, by, &what, Role::Lead);
            let pins = what.points.iter().filter(|point| scope.is_pinned(**point)).count();
            let is_held = pins > 0 && pins < what.points.len();
            let words = said.or(is_held.then(|| ALONG.to_owned()));
            marks.extend(at.zip(words).map(|(at, words)| beside(scope, at, &words)));
            marks
        }
        // Shift is held.
        (Doing::Hauling(haul), _) => haul.marks(scope, at, maker.is_free),
        (Doing::Leading(lead), _) => led(scope, &[lead.point()], at),
        (Doing::Erasing(sweep), _) => sweep.marks(scope),
        (Doing::Cutting(slash), _) => at.map_or_else(Vec::new, |at| slash.marks(scope, at)),
        (Doing::Nothing, Tool::Hand) => at.map_or_else(Vec::new, |at| {
            let mut marks = would_grab(scope, at);
            marks.extend(Some(at).filter(|_| is_still).into_iter().flat_map(|at| would_carry(scope, at)));
            marks
        }),
        (Doing::Building(drag), _) => at.map_or_else(Vec::new, |at| maker.outline(scope, Some(drag), at)),
        (Doing::Drawing(path), _) => path.marks(maker, scope, at),
        (_, Tool::Build) => at.map_or_else(Vec::new, |at| maker.outline(scope, None, at)),
        (_, Tool::Pin) => at.and_then(|at| would_pin(scope, at)).into_iter().collect(),
        (Doing::Nothing, Tool::Select) => {
            let under = at.and_then(|at| Chosen::at(scope, at));
            under.map_or_else(Vec::new, |chosen| chosen.outline(scope, Role::Lead))
        }
        (Doing::Marking(region), _) => at.map_or_else(Vec::new, |at| region.marks(scope, at)),
        (_, Tool::Erase) => at.map_or_else(Vec::new, |at| erase::marks(scope, at)),
        _ => Vec::new(),
    }
}

/// A ring around a point that is probed, or along a bond, and the number of its probe.
pub(in crate::app) fn probe(scope: Scope<'_>, place: usize, probe: Probe) -> Vec<Mark> {
    let role = Role::Probe(place);
    let off = RING * scope.scale;
    let (at, mut marks) = match probe {
        Probe::Point(point) => {
            let Some(at) = scope.pixel(point) else { return Vec::new() };
            (at, vec![Mark::Ring(role, at, off)])
        }
        Probe::Bond(number) => {
            let ends = scope.shown.scenery.bond_ends(number);
            let Some([a, b]) = ends.and_then(|[a, b]| Some([scope.pixel(a)?, scope.pixel(b)?])) else {
                return Vec::new();
            };
            let ends = [a, b].map(|end| Mark::Ring(role, end, 0.6 * off));
            (0.5 * (a + b), std::iter::once(Mark::Line(role, a, b, 0.5 * off)).chain(ends).collect())
        }
        Probe::Corner([a, b, c]) => {
            let ends = scope.pixel(a).zip(scope.pixel(c));
            let Some((at, (a, c))) = scope.pixel(b).zip(ends) else { return Vec::new() };
            let legs = [a, c].map(|end| Mark::Line(role, at, end, 0.5 * off));
            (at, std::iter::once(Mark::Ring(role, at, off)).chain(legs).collect())
        }
    };
    marks.push(Mark::Words(at + DVec2::new(1.6 * off, -0.6 * off), (place + 1).to_string()));
    marks
}

/// From the middle of what is led to the cursor, as wide as the force is large; thin until the world has felt it.
fn led(scope: Scope<'_>, points: &[PointId], at: Option<DVec2>) -> Vec<Mark> {
    let Some(at) = at else { return Vec::new() };
    let (middle, force) = match &scope.shown.grab {
        Some(grab) => (DVec3::from(grab.middle), DVec3::from(grab.force).length()),
        None => (scope.middle(points), 0.0),
    };
    let Some(middle) = scope.camera.screen_from_world(middle).map(DVec2::from) else { return Vec::new() };
    let share = force / (force + HALF_FORCE);
    let width = WIDTHS[0] + share * (WIDTHS[1] - WIDTHS[0]);
    let scale = scope.scale;
    vec![Mark::Line(Role::Lead, middle, at, width * scale), Mark::Ring(Role::Lead, middle, 5.0 * scale)]
}

/// The outline of the obstacle that the hand would take, words where it is ground; a small ring where a click starts something; a ring around the point, and the bonds of the patch
/// that it is taken with; around a pin, and along the bar that goes with it.
fn would_grab(scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
    if scope.starts_at(at) {
        return vec![Mark::Ring(Role::Come, at, 5.0 * scope.scale)];
    }
    let Some(hit) = scope.nearest(at) else {
        let outline = |number| {
            let mut marks = obstacle(Role::Lead, scope, number);
            // In the plane it is seen where it goes.
            marks.extend((scope.shown.dimensions == 3).then(|| beside(scope, at, IN_SPACE)));
            marks
        };
        return scope.block(at).map_or_else(|| scope.ground_marks(at), outline);
    };
    let is_pin = scope.is_pinned(hit.point);
    let role = if is_pin { Role::Hold } else { Role::Lead };
    let ring = scope.pixel(hit.point).map(|middle| Mark::Ring(role, middle, 7.0 * scope.scale));
    let bar = if is_pin { super::lead::bar(scope, hit.point) } else { Vec::new() };
    let mut marks: Vec<Mark> = ring.into_iter().collect();
    let patch = if is_pin { None } else { scope.patch(hit.point, at) };
    marks.extend(patch.into_iter().flat_map(|patch| bonds(Role::Lead, scope, &patch)));
    if bar.len() > 1 {
        let mut pins = bar;
        pins.sort_unstable();
        let is_of = |ends: &&[PointId; 2]| ends.iter().all(|end| pins.binary_search(end).is_ok());
        let bonds = scope.shown.scenery.bonds.ends().iter().filter(is_of).take(MOST);
        marks.extend(bonds.filter_map(|&ends| line(Role::Hold, scope, ends)));
        let beside = at + DVec2::new(16.0, -12.0) * scope.scale;
        marks.push(Mark::Words(beside, "drag: the bar goes along; with Shift it turns".to_owned()));
    }
    marks
}

/// Words beside the pointer.
pub(super) fn beside(scope: Scope<'_>, at: DVec2, words: &str) -> Mark {
    Mark::Words(at + DVec2::new(16.0, -14.0) * scope.scale, words.to_owned())
}

/// While time stands still: the pins that go along with a body, or that a pin is moved alone.
fn would_carry(scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
    let Some(hit) = scope.nearest(at).filter(|_| !scope.starts_at(at)) else { return Vec::new() };
    if scope.is_pinned(hit.point) && !hub::is_hinged(scope, hit.point) {
        // Of a bar it is said already that it goes as a whole.
        let is_one = super::lead::bar(scope, hit.point).len() == 1 && scope.body(hit.point).len() > 1;
        return if is_one { vec![beside(scope, at, ALONE)] } else { Vec::new() };
    }
    let under = Chosen::at(scope, at).unwrap_or_default();
    let mut marks = pins(scope, DVec3::ZERO, &under);
    if !marks.is_empty() {
        marks.push(beside(scope, at, WITH_PINS));
    }
    marks
}

fn would_pin(scope: Scope<'_>, at: DVec2) -> Option<Mark> {
    let point = scope.nearest(at)?.point;
    let role = if scope.is_pinned(point) { Role::Away } else { Role::Hold };
    Some(Mark::Ring(role, scope.pixel(point)?, 8.0 * scope.scale))
}

pub(super) fn line(role: Role, scope: Scope<'_>, [a, b]: [PointId; 2]) -> Option<Mark> {
    Some(Mark::Line(role, scope.pixel(a)?, scope.pixel(b)?, 1.5 * scope.scale))
}

/// The bonds among points, which are ascending, and a ring about each that has none.
pub(super) fn bonds(role: Role, scope: Scope<'_>, points: &[PointId]) -> Vec<Mark> {
    let is_its = |ends: &&[PointId; 2]| ends.iter().all(|end| points.binary_search(end).is_ok());
    let bonds: Vec<[PointId; 2]> = scope.shown.scenery.bonds.ends().iter().filter(is_its).take(MOST).copied().collect();
    let mut bonded: Vec<PointId> = bonds.iter().flatten().copied().collect();
    bonded.sort_unstable();
    let is_bare = |point: &&PointId| bonds.len() < MOST && bonded.binary_search(point).is_err();
    let ring = |&point: &PointId| Some(Mark::Ring(role, scope.pixel(point)?, 6.0 * scope.scale));
    let rings = points.iter().filter(is_bare).filter_map(ring).take(MOST);
    bonds.iter().filter_map(|&ends| line(role, scope, ends)).chain(rings).collect()
}

/// The skin of bodies, whose points are ascending; their bonds where they cover nothing; boxes around them where that would be too many
/// lines.
pub(super) fn body(role: Role, scope: Scope<'_>, points: &[PointId]) -> Vec<Mark> {
    if points.len() > MOST {
        return boxes::around(role, scope, points);
    }
    let sides = skin::sides(scope, points);
    if sides.len() > MOST {
        return boxes::around(role, scope, points);
    }
    let lines: Vec<Mark> = sides.into_iter().filter_map(|ends| line(role, scope, ends)).collect();
    if lines.is_empty() {
        return bonds(role, scope, points);
    }
    let covered = skin::corners(scope, points);
    let bare: Vec<PointId> = points.iter().copied().filter(|point| covered.binary_search(point).is_err()).collect();
    if bare.is_empty() { lines } else { lines.into_iter().chain(bonds(role, scope, &bare)).collect() }
}

/// The places of a ball that lie farthest along the axes `[m]`.
pub(super) fn around_ball(center: [f64; 3], radius: f64) -> [DVec3; 6] {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    std::array::from_fn(|k| DVec3::from(center) + if k < 3 { radius } else { -radius } * axes[k % 3])
}

/// The edges of a box; a circle about a ball, as wide as it is seen from afar.
fn around(role: Role, scope: Scope<'_>, figure: &Figure) -> Vec<Mark> {
    let pixel = |x: [f64; 3]| scope.camera.screen_from_world(DVec3::from(x)).map(DVec2::from);
    if let &Figure::Ball { center, radius } = figure {
        let beside = |place: DVec3| Some(pixel(place.into())?.distance(pixel(center)?));
        let wide = around_ball(center, radius).into_iter().filter_map(beside).fold(0.0, f64::max);
        return pixel(center).map(|at| Mark::Ring(role, at, wide)).into_iter().collect();
    }
    let Some(frame) = figure.frame() else { return Vec::new() };
    let corners = frame.corners();
    let side = |ends: [u32; 2]| {
        let [from, to] = ends.map(|end| pixel(corners[end as usize]));
        Some(Mark::Line(role, from?, to?, 2.0 * scope.scale))
    };
    BOX_EDGES.into_iter().filter_map(side).collect()
}

/// The surface of a plane, as far as it is seen; in space the rim of a part of it.
fn surface(role: Role, scope: Scope<'_>, plane: &[[f64; 3]; 2]) -> Vec<Mark> {
    if scope.shown.dimensions == 3 {
        let side = |[from, to]: [DVec2; 2]| Mark::Line(role, from, to, 2.0 * scope.scale);
        return scope.rim(*plane).into_iter().map(side).collect();
    }
    let Some(middle) = scope.on_plane(plane) else { return Vec::new() };
    let along = DVec3::from(plane[1]).truncate().normalize_or_zero().perp();
    let [width, height] = scope.camera.viewport().map(f64::from);
    let far = width.hypot(height) / scope.camera.pixels_per_metre();
    let ends = [middle - far * along, middle + far * along].map(|end| scope.on_screen(end));
    let [Some(from), Some(to)] = ends else { return Vec::new() };
    vec![Mark::Line(role, from, to, 2.0 * scope.scale)]
}

/// The sides of a solid, or the surface of a plane.
pub(super) fn obstacle(role: Role, scope: Scope<'_>, number: u32) -> Vec<Mark> {
    let scenery = &scope.shown.scenery;
    if let Some(place) = scenery.plane_numbers.iter().position(|&other| other == number) {
        return surface(role, scope, &scenery.planes[place]);
    }
    let Some(place) = scenery.solid_numbers.iter().position(|&other| other == number) else { return Vec::new() };
    if let Some(convex) = scenery.convex.get(place) {
        return around(role, scope, &convex.figure);
    }
    let Some(polygon) = scenery.polygons.get(place) else { return Vec::new() };
    let side = |[from, to]: [DVec2; 2]| {
        Some(Mark::Line(role, scope.on_screen(from)?, scope.on_screen(to)?, 2.0 * scope.scale))
    };
    segments::sides(&polygon.loops).filter_map(side).take(MOST).collect()
}
