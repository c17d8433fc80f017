//! The box around what is selected, with handles: corners scale it, the one above turns it.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::Deed;
use super::chosen::Chosen;
use super::fastened::with_pins;
use super::grown::Growth;
use super::lifted::{self, Lift};
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::rings::{Turned, axis_of};
use super::room::{Outcome, here, under};
use crate::history::{Do, Factors, MoveKeys};
use crate::scene::Vector;
use crate::sim::PointId;

/// The box keeps so far off what is in it `[logical px]`.
const MARGIN: f64 = 9.0;
/// What lies no further beyond what is free lies at its edge `[logical px]`: as far as outlines reach.
const EDGE: f64 = 2.0;
/// The handle that turns is so far above the box `[logical px]`.
const ABOVE: f64 = 28.0;
/// Half the side of a corner's handle, radius of the one that turns `[logical px]`.
const HALF: f64 = 4.5;
const RADIUS: f64 = 6.0;
/// A press so near to a handle takes it `[logical px]`.
const REACH: f64 = 10.0;
/// What is less wide or high on the screen cannot be scaled that way `[logical px]`.
const LEAST: f64 = 2.0;
/// The least and the greatest factor of a drag `[1]`: past the least a body would be a sliver.
const FACTORS: [f64; 2] = [0.1, 20.0];
/// Said of a drag that would make it smaller, or lead it past the side that stays.
const LEAST_SIZE: &str = "a tenth is the least: Flip in the panel mirrors it";
/// Turns go in steps of this while Shift is held `[rad]`.
const STEP: f64 = PI / 12.0;

/// A handle of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Handle {
    /// From the lower left, anticlockwise: 0 to 3.
    Corner(usize),
    /// Above the box.
    Turn,
}

/// The box around what is selected `[m]`, in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    low: DVec2,
    high: DVec2,
}

/// A handle that is being dragged: from which pixel `[px]`, and about which place the drag is measured `[m]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grip {
    pub(super) handle: Handle,
    from: DVec2,
    about: DVec2,
    /// Which ways the box is too thin to be scaled.
    thin: [bool; 2],
}

/// What becomes of a selection: about a place `[m]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// By so far `[m]`.
    Shift(DVec3),
    /// Anticlockwise `[rad]`.
    Turn(f64),
    /// In space, about x, y or z `[rad]`.
    Spin(usize, f64),
    /// Along x and y `[1]`, below 0 where it is mirrored; in space the same along all axes.
    Scale([f64; 2]),
}

impl Frame {
    /// Around what is selected; `None` in space, or where nothing of it has a place.
    pub(super) fn of(scope: Scope<'_>, chosen: &Chosen) -> Option<Self> {
        if scope.shown.dimensions != 2 {
            return None;
        }
        chosen.extent(scope).map(|[low, high]| Frame { low, high })
    }

    /// Its corners on the screen, a little outside, in the order of their handles `[px]`: of a box of which something is seen where they can be
    /// taken.
    fn corners(&self, scope: Scope<'_>) -> Option<[DVec2; 4]> {
        let [low, high] = [scope.on_screen(self.low)?, scope.on_screen(self.high)?];
        let off = MARGIN * scope.scale;
        let [left, right, below, above] = [low.x - off, high.x + off, low.y + off, high.y - off];
        let corners = [[left, below], [right, below], [right, above], [left, above]].map(DVec2::from);
        let is_seen = corners[3].cmplt(scope.free[1]).all() && corners[1].cmpgt(scope.free[0]).all();
        // Around what lies right at the edge of what is free, as on a floor there, it goes a little beyond.
        let edges = [[low.x, low.y], [high.x, low.y], [high.x, high.y], [low.x, high.y]].map(DVec2::from);
        let near = DVec2::splat(EDGE * scope.scale);
        let kept = |(at, edge): (DVec2, DVec2)| {
            let is_free = edge.cmpge(scope.free[0] - near) & edge.cmple(scope.free[1] + near);
            DVec2::select(is_free, at, scope.kept(at, RADIUS))
        };
        Some(if is_seen { std::array::from_fn(|k| kept((corners[k], edges[k]))) } else { corners })
    }

    /// Which ways it is too thin to be scaled.
    fn thin(&self, scope: Scope<'_>) -> [bool; 2] {
        let size = (self.high - self.low) * scope.camera.pixels_per_metre();
        size.to_array().map(|side| side < LEAST * scope.scale)
    }

    /// The handles that it has, with their pixels.
    pub(super) fn handles(&self, scope: Scope<'_>) -> Vec<(Handle, DVec2)> {
        let Some(corners) = self.corners(scope) else { return Vec::new() };
        let top = 0.5 * (corners[2] + corners[3]);
        let above = top - DVec2::new(0.0, ABOVE * scope.scale);
        // With a box that is seen, as far as there is room.
        let is_near = top.distance(scope.kept(top, RADIUS)) <= (MARGIN + EDGE + RADIUS) * scope.scale;
        let above = if is_near { scope.kept(above, RADIUS) } else { above };
        let mut handles = vec![(Handle::Turn, above)];
        if self.thin(scope) != [true; 2] {
            handles.extend(corners.into_iter().enumerate().map(|(k, at)| (Handle::Corner(k), at)));
        }
        handles
    }

    /// The handle that a pixel means.
    pub(super) fn handle(&self, scope: Scope<'_>, at: DVec2) -> Option<Handle> {
        let near = self.handles(scope).into_iter().map(|(handle, place)| (place.distance(at), handle));
        let near = near.filter(|(distance, _)| *distance <= REACH * scope.scale);
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, handle)| handle)
    }

    /// The place in its middle `[m]`.
    pub(super) fn middle(&self) -> DVec2 {
        0.5 * (self.low + self.high)
    }

    /// A handle is taken at a pixel.
    pub(super) fn grip(&self, scope: Scope<'_>, handle: Handle, from: DVec2) -> Grip {
        Grip { handle, from, about: self.still(handle), thin: self.thin(scope) }
    }

    /// The place that stays where it is when a handle is dragged `[m]`.
    fn still(&self, handle: Handle) -> DVec2 {
        let Frame { low, high } = *self;
        match handle {
            Handle::Turn => self.middle(),
            Handle::Corner(0) => high,
            Handle::Corner(1) => DVec2::new(low.x, high.y),
            Handle::Corner(2) => low,
            Handle::Corner(_) => DVec2::new(high.x, low.y),
        }
    }

    /// The box and its handles.
    pub(super) fn marks(&self, scope: Scope<'_>, held: Option<Handle>) -> Vec<Mark> {
        let Some(corners) = self.corners(scope) else { return Vec::new() };
        let thin = 1.0 * scope.scale;
        let mut marks: Vec<Mark> =
            (0..4).map(|k| Mark::Line(Role::Hold, corners[k], corners[(k + 1) % 4], thin)).collect();
        let top = 0.5 * (corners[2] + corners[3]);
        for (handle, at) in self.handles(scope) {
            let role = if held == Some(handle) { Role::Lead } else { Role::Hold };
            match handle {
                Handle::Turn => {
                    let stalk = at + DVec2::new(0.0, RADIUS * scope.scale);
                    if stalk.y < top.y {
                        marks.push(Mark::Line(Role::Hold, top, stalk, thin));
                    }
                    marks.push(Mark::Knob(role, at, RADIUS * scope.scale));
                }
                Handle::Corner(_) => marks.push(Mark::Square(role, at, HALF * scope.scale)),
            }
        }
        marks
    }
}

impl Grip {
    /// The place that stays `[m]`.
    pub(super) fn about(&self) -> DVec2 {
        self.about
    }

    /// What a drag to a pixel makes of the selection; `in_steps`: turned by whole steps, scaled in proportion.
    pub(super) fn change(&self, scope: Scope<'_>, to: DVec2, in_steps: bool) -> Change {
        let [from, to] = [self.from, to].map(|at| scope.in_plane(at) - self.about);
        if self.handle == Handle::Turn {
            let angle = if from.length() > 0.0 && to.length() > 0.0 { from.angle_to(to) } else { 0.0 };
            return Change::Turn(if in_steps { STEP * (angle / STEP).round() } else { angle });
        }
        let [least, most] = FACTORS;
        if in_steps || self.thin != [false; 2] {
            let factor = (to.dot(from) / from.length_squared().max(f64::MIN_POSITIVE)).clamp(least, most);
            return Change::Scale([factor; 2]);
        }
        let along = |axis: usize| {
            let factor = to[axis] / from[axis];
            if factor.is_finite() { factor.clamp(least, most) } else { 1.0 }
        };
        Change::Scale([along(0), along(1)])
    }
}

impl Change {
    /// What is left and right is exchanged, axis 0, or what is up and down, axis 1.
    pub(super) fn flip(axis: usize) -> Self {
        let mut factors = [1.0; 2];
        factors[axis] = -1.0;
        Change::Scale(factors)
    }

    /// Whether it makes a left hand a right one.
    fn is_mirror(self) -> bool {
        matches!(self, Change::Scale([x, y]) if x * y < 0.0)
    }

    /// What is left of it to be done after another one of its kind; `None`: nothing.
    pub(super) fn after(self, done: Change) -> Option<Self> {
        match (self, done) {
            (Change::Shift(all), Change::Shift(done)) => Some(Change::Shift(all - done)).filter(|_| all != done),
            (Change::Turn(all), Change::Turn(done)) => turn_left(all, done).map(Change::Turn),
            (Change::Spin(axis, all), Change::Spin(same, done)) if axis == same => {
                turn_left(all, done).map(|left| Change::Spin(axis, left))
            }
            (Change::Scale(all), Change::Scale(done)) => {
                (all != done).then(|| Change::Scale([all[0] / done[0], all[1] / done[1]]))
            }
            _ => None,
        }
    }

    /// A share of it.
    pub(super) fn share(self, share: f64) -> Self {
        match self {
            Change::Shift(by) => Change::Shift(share * by),
            Change::Turn(angle) => Change::Turn(share * angle),
            Change::Spin(axis, angle) => Change::Spin(axis, share * angle),
            Change::Scale(factors) => Change::Scale(factors.map(|factor| factor.powf(share))),
        }
    }

    /// It, and another of its kind after it.
    pub(super) fn then(self, next: Change) -> Self {
        match (self, next) {
            (Change::Shift(by), Change::Shift(more)) => Change::Shift(by + more),
            (Change::Turn(angle), Change::Turn(more)) => Change::Turn(angle + more),
            (Change::Spin(axis, angle), Change::Spin(same, more)) if axis == same => Change::Spin(axis, angle + more),
            (Change::Scale(by), Change::Scale(more)) => Change::Scale([by[0] * more[0], by[1] * more[1]]),
            _ => self,
        }
    }

    /// How much it is: in heights of a picture that is so high `[m]`, in turns, or by which factors.
    pub(super) fn size(self, height: f64) -> f64 {
        match self {
            Change::Shift(by) => by.length() / height,
            Change::Turn(angle) | Change::Spin(_, angle) => angle.abs() / TAU,
            Change::Scale(factors) => factors.into_iter().map(|factor| factor.ln().abs()).fold(0.0, f64::max),
        }
    }

    /// The place that stays where it is: for a selection as it is now `[m]`.
    pub(super) fn about(self, frame: &Frame, handle: Handle) -> DVec2 {
        match self {
            Change::Shift(_) => frame.low,
            Change::Turn(_) | Change::Spin(..) | Change::Scale(_) => frame.still(handle),
        }
    }

    /// Where a place of the plane goes `[m]`.
    pub(super) fn place(self, about: DVec2, x: DVec2) -> DVec2 {
        match self {
            Change::Shift(by) => x + by.truncate(),
            Change::Turn(angle) | Change::Spin(_, angle) => about + DVec2::from_angle(angle).rotate(x - about),
            Change::Scale(factors) => about + DVec2::from(factors) * (x - about),
        }
    }

    /// A mark where it goes.
    pub(super) fn preview(self, scope: Scope<'_>, about: DVec2, mark: Mark) -> Mark {
        mark.mapped(|at| scope.on_screen(self.place(about, scope.in_plane(at))).unwrap_or(at))
    }

    /// In figures: an angle from -180 to 180 degrees, one factor or two.
    pub(super) fn words(self, scope: Scope<'_>, chosen: &Chosen) -> String {
        let grown = self.grown(scope, chosen).map_or_else(String::new, |grown| grown.words(scope));
        match self {
            Change::Shift(by) => format!("{:.2} {:.2} m", by.x, by.y),
            Change::Turn(angle) => format!("{:.0}°", angle.to_degrees()),
            Change::Spin(axis, angle) => Turned::About(axis, angle).words(),
            Change::Scale(factors) => {
                let [x, y] = factors;
                let size = if x == y { format!("× {x:.2}") } else { format!("{x:.2} × {y:.2}") };
                let least = if factors.contains(&FACTORS[0]) { format!(": {LEAST_SIZE}") } else { String::new() };
                format!("{size}{grown}{least}")
            }
        }
    }

    /// What becomes of the masses and springs of what is scaled.
    fn grown(self, scope: Scope<'_>, chosen: &Chosen) -> Option<Growth> {
        let Change::Scale([x, y]) = self else { return None };
        let z = if scope.shown.dimensions == 2 { 1.0 } else { x };
        Some(Growth::of(scope, chosen, DVec3::new(x, y, z)))
    }

    /// How bodies that are selected are put beside that, so that they keep clear of what stands there.
    pub(super) fn lift(self, scope: Scope<'_>, chosen: &Chosen, about: DVec2) -> Lift {
        lifted::lift(scope, chosen, |x| match self {
            Change::Shift(by) => x + by,
            _ => self.place(about, x.truncate()).extend(x.z),
        })
    }

    /// What becomes of bodies that are selected, or that lie under obstacles that are.
    pub(super) fn outcome(self, scope: Scope<'_>, chosen: &Chosen, about: DVec2) -> Outcome {
        if scope.shown.dimensions != 2 {
            return Outcome::default();
        }
        let Lift { way, said } = self.lift(scope, chosen, about);
        let way = way.truncate();
        if chosen.obstacles.is_empty() {
            return Outcome { way, own: way, said, ..Outcome::default() };
        }
        let chosen = &with_pins(scope, chosen);
        let scenery = &scope.shown.scenery;
        let is_chosen = |number: &&u32| chosen.obstacles.contains(number);
        let moved = |x: DVec2| self.place(about, x) + way;
        let polygons = scenery.polygons.iter().zip(&scenery.solid_numbers).filter(|(_, number)| is_chosen(number));
        let polygons = polygons.map(|(polygon, _)| {
            let mut polygon = polygon.clone();
            polygon.loops.iter_mut().flatten().for_each(|corner| *corner = moved(DVec2::from(*corner)).to_array());
            polygon
        });
        let planes = scenery.planes.iter().zip(&scenery.plane_numbers).filter(|(_, number)| is_chosen(number));
        let planes: Vec<_> = planes
            .map(|([point, normal], _)| {
                let [point, normal] = [point, normal].map(|x| DVec2::new(x[0], x[1]));
                let along = moved(point + normal.perp()) - moved(point);
                // A mirror leads the free side to the other hand.
                let hand = if self.is_mirror() { 1.0 } else { -1.0 };
                [moved(point), hand * along.perp()].map(|x| x.extend(0.0).to_array())
            })
            .collect();
        let is_moved = |point: PointId| chosen.points.binary_search(&point).is_ok();
        let place = |point: PointId| {
            let at = here(scope, point);
            if is_moved(point) { moved(at) } else { at }
        };
        let outcome = under(scope, (&planes, polygons.collect()), &chosen.obstacles, place);
        Outcome { way, own: way, said: outcome.said.or(said), ..outcome }
    }

    /// The command that does it to what is selected and to the pins that are stuck in it, or why it cannot be.
    pub(super) fn fitted(self, scope: Scope<'_>, chosen: &Chosen, about: DVec2) -> Deed {
        let outcome = self.outcome(scope, chosen, about);
        match outcome.refused {
            Some(why) => Deed::words(why.to_owned()),
            None => {
                let dimensions = scope.shown.dimensions;
                let (lift, words) = match dimensions {
                    2 => (outcome.way.extend(0.0), outcome.told()),
                    _ => {
                        let Lift { way, said } = self.lift(scope, chosen, about);
                        (way, said.map(str::to_owned))
                    }
                };
                let chosen = &with_pins(scope, chosen);
                let mut deed = self.deed(chosen, about.extend(0.0), dimensions);
                if !deed.is_empty() {
                    deed.commands.extend(self.grown(scope, chosen).iter().flat_map(Growth::commands));
                }
                lifted::with(scope, lift, Deed { words, ..deed })
            }
        }
    }

    /// The command that does it to what is selected, in so many dimensions; nothing where nothing changes.
    pub(super) fn deed(self, chosen: &Chosen, about: DVec3, dimensions: usize) -> Deed {
        let keys = MoveKeys { points: chosen.numbers(), obstacles: chosen.obstacles.clone(), ..MoveKeys::default() };
        let about = Some(Vector::new(about.to_array(), dimensions));
        let (name, keys) = match self {
            Change::Shift(by) => ("move", MoveKeys { by: Some(Vector::new(by.to_array(), dimensions)), ..keys }),
            Change::Turn(angle) | Change::Spin(_, angle) if angle.rem_euclid(TAU) == 0.0 => return Deed::default(),
            Change::Turn(angle) => ("turn", MoveKeys { turn: Some(angle), about, ..keys }),
            Change::Spin(axis, angle) => {
                let axis = Some(Vector::new(axis_of(axis).to_array(), dimensions));
                ("turn", MoveKeys { turn: Some(angle), axis, about, ..keys })
            }
            Change::Scale([1.0, 1.0]) => return Deed::default(),
            Change::Scale([x, y]) if x == y => ("scale", MoveKeys { scale: Some(Factors::One(x)), about, ..keys }),
            Change::Scale(factors) if self.is_mirror() => {
                ("flip", MoveKeys { scale: Some(Factors::Each(factors)), about, ..keys })
            }
            Change::Scale(factors) => ("scale", MoveKeys { scale: Some(Factors::Each(factors)), about, ..keys }),
        };
        Deed::edit(name, Do::Move(Box::new(keys)))
    }
}

/// What is left of a turn `[rad]`, the shorter way round; `None`: nothing.
fn turn_left(all: f64, done: f64) -> Option<f64> {
    let left = (all - done + PI).rem_euclid(TAU) - PI;
    (left != 0.0).then_some(left)
}
