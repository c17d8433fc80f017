//! The tool that selects: what presses, drags and regions choose, and what becomes of it.

use glam::{DVec2, DVec3};

use super::chosen::Chosen;
use super::facing::{self, Hold};
use super::ground::GROUND;
use super::handles::{Change, Frame, Grip, Handle};
use super::lifted::Lift;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::region::Region;
use super::rings::{Ring, RingGrip, Rings};
use super::{Deed, Doing, Hand, Stop, stops};
use crate::app::action::Tool;
use crate::sim::{Knots, PointId};

/// Said where nothing is selected.
pub(super) const NOTHING: &str = "select something first, with the Select tool (6)";
/// Said of what cannot be mirrored: it is in space.
const FLAT: &str = "only in the plane can it be flipped";

/// A press that moves less than this is a click `[logical px]`.
const CLICK: f64 = 4.0;

/// Radius of a ring about a pin `[logical px]`, and of how many pins there are rings at most.
const PIN: f64 = 7.0;
const MOST_PINS: usize = 100;

impl Hand {
    /// With Ctrl, or by the second press of a double click, a bond or a point is selected; else a handle is taken; else what lies under the
    /// pixel is selected and can be moved; else a region begins.
    pub(super) fn begin_to_select(&mut self, scope: Scope<'_>, at: DVec2, is_second: bool) {
        let chosen = self.selection.begin(scope);
        let before = self.before.take().filter(|_| is_second && !self.command);
        let is_part = !self.alt && (self.command || before.is_some());
        if let Some(part) = is_part.then(|| Chosen::part_at(scope, at)).flatten() {
            return self.begin_with_part(scope, at, (part, chosen, before));
        }
        let frame = Frame::of(scope, &chosen);
        if let Some((frame, handle)) = frame.and_then(|frame| Some((frame, frame.handle(scope, at)?))) {
            self.before = beside(scope, &chosen, at);
            self.doing = Doing::Handling(frame.grip(scope, handle, at));
            return;
        }
        let rings = Rings::of(scope, &chosen);
        if let Some((rings, ring)) = rings.and_then(|rings| Some((rings, rings.ring(scope, at)?))) {
            self.before = beside(scope, &chosen, at);
            self.doing = Doing::Turning(rings.grip(ring, at));
            return;
        }
        if let Some(stop) = Stop::at(scope, &chosen.points, at).filter(|_| !self.shift && !self.alt) {
            self.before = Some(chosen);
            self.doing = Doing::Stopping(stop);
            return;
        }
        let is_free = self.alt || self.draws_lasso;
        let Some(under) = self.meant(scope, at) else {
            self.doing = Doing::Marking(Region::begin(at, is_free));
            return;
        };
        self.before = Some(chosen.clone());
        let own = under.clicked(scope, at);
        if self.shift {
            self.selection.set(chosen.joined(&own, true));
            self.doing = Doing::Nothing;
            return;
        }
        if !chosen.has(&own) {
            self.selection.set(under.clone());
        }
        self.doing = Doing::Moving(scope.hold(at), under);
    }

    /// A bond or a point is selected: with Shift beside what was, or no more. A drag moves it; a drag by the second press of a double click,
    /// before which its body was selected, moves that.
    fn begin_with_part(
        &mut self,
        scope: Scope<'_>,
        at: DVec2,
        (part, chosen, before): (Chosen, Chosen, Option<Chosen>),
    ) {
        let is_second = before.is_some();
        self.before.clone_from(&before);
        if self.shift {
            let chosen = before.map_or(chosen, |before| before.left(scope));
            self.selection.set(chosen.with_part(scope, &part));
            self.doing = Doing::Nothing;
            return;
        }
        if !is_second {
            self.selection.set(part.clone());
        }
        self.doing = Doing::Moving(scope.hold(at), part);
    }

    /// What a press on a pixel takes hold of: of planes of space only what is selected, for a drag over others draws a region.
    fn meant(&self, scope: Scope<'_>, at: DVec2) -> Option<Chosen> {
        let is_chosen = |under: &Chosen| self.selection.now(scope).has(under);
        let is_meant = |under: &Chosen| !self.alt && (!under.is_ground(scope) || is_chosen(under));
        Chosen::at(scope, at).filter(is_meant)
    }

    /// Whether a drag from a pixel would move something.
    pub(in crate::app) fn would_move(&self, scope: Scope<'_>, at: DVec2) -> bool {
        self.meant(scope, at).is_some()
    }

    /// What is selected was dragged, or what lies under the pixel clicked: that alone is selected then, of what hangs on a rope the rope.
    pub(super) fn end_move(&mut self, scope: Scope<'_>, (hold, to): (Hold, DVec2), under: Chosen) -> Deed {
        if !is_drag(scope, [hold.at, to]) {
            self.selection.set(under.clicked(scope, to));
            return Deed::default();
        }
        let chosen = self.chosen(scope).unwrap_or_default();
        moved(scope, (hold, to), &chosen)
    }

    /// What lies under the pixel is moved by a drag of the hand, while time stands still, but for ground; a click does nothing.
    pub(super) fn carry(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        if scope.nearest(at).is_none() && scope.is_on_ground(at) {
            return Deed::words(GROUND.to_owned());
        }
        if let Some(under) = Chosen::at(scope, at).filter(|under| !under.is_ground(scope)) {
            self.doing = Doing::Carrying(scope.hold(at), under);
        }
        Deed::default()
    }

    pub(super) fn end_grip(&self, scope: Scope<'_>, grip: Grip, to: DVec2) -> Deed {
        let Some(chosen) = self.chosen(scope) else { return Deed::default() };
        let Some(frame) = Frame::of(scope, &chosen) else { return Deed::default() };
        let change = grip.change(scope, to, self.shift);
        change.fitted(scope, &chosen, change.about(&frame, grip.handle))
    }

    /// What is selected is mirrored about its middle: left and right, axis 0, or up and down, axis 1.
    pub(in crate::app) fn flip(&self, scope: Scope<'_>, axis: usize) -> Deed {
        let Some(chosen) = self.chosen(scope) else { return Deed::words(NOTHING.to_owned()) };
        let Some(frame) = Frame::of(scope, &chosen) else { return Deed::words(FLAT.to_owned()) };
        Change::flip(axis).fitted(scope, &chosen, frame.middle())
    }

    pub(super) fn end_turn(&self, scope: Scope<'_>, grip: RingGrip, to: DVec2) -> Deed {
        let Some(chosen) = self.chosen(scope) else { return Deed::default() };
        grip.turned(scope, to, self.shift).deed(scope, &chosen)
    }

    /// What lies in a region is selected: with what was, while Shift is held; a click selects nothing.
    pub(super) fn mark(&mut self, scope: Scope<'_>, region: &Region, to: DVec2) {
        let ground = || Chosen::at(scope, region.from()).filter(|under| !self.alt && under.is_ground(scope));
        let found = match region.reach(to) >= CLICK * scope.scale {
            true => Chosen::within(scope, |at| region.has(to, at)),
            false => ground().unwrap_or_default(),
        };
        self.selection.set(if self.shift { self.selection.now(scope).joined(&found, false) } else { found });
    }

    /// These are selected, as soon as they are there.
    pub(in crate::app) fn select(&mut self, chosen: Chosen) {
        self.selection.set(chosen);
    }

    /// The same, of copies of what was selected: that is selected again where they are taken away.
    pub(in crate::app) fn select_copy(&mut self, copies: Chosen) {
        self.selection.come(copies);
    }

    /// What was taken away is selected again, where it has come back.
    pub(in crate::app) fn settle(&mut self, scope: Scope<'_>) {
        self.selection.settle(scope);
    }

    /// All bodies and obstacles are selected, with the tool for that.
    pub(in crate::app) fn select_all(&mut self, scope: Scope<'_>) {
        self.tool = Tool::Select;
        self.selection.set(Chosen::all(scope));
    }

    /// What is selected and there, if the tool for that is in the hand.
    pub(in crate::app) fn chosen(&self, scope: Scope<'_>) -> Option<Chosen> {
        if self.tool() != Tool::Select {
            return None;
        }
        Some(self.selection.now(scope)).filter(|chosen| !chosen.is_empty())
    }

    /// The handle under a pixel, or the one that is held.
    pub(in crate::app) fn handle(&self, scope: Scope<'_>, at: DVec2) -> Option<Handle> {
        match &self.doing {
            Doing::Handling(grip) => Some(grip.handle),
            Doing::Nothing => Frame::of(scope, &self.chosen(scope)?)?.handle(scope, at),
            _ => None,
        }
    }

    /// The handle in space under a pixel, or the one that is held.
    pub(in crate::app) fn ring(&self, scope: Scope<'_>, at: DVec2) -> Option<Ring> {
        match &self.doing {
            Doing::Turning(grip) => Some(grip.ring),
            Doing::Nothing => Rings::of(scope, &self.chosen(scope)?)?.ring(scope, at),
            _ => None,
        }
    }

    /// The outline of what is selected, where a drag would bring it, with its box and its handles.
    pub(super) fn selection_marks(&self, scope: Scope<'_>, chosen: &Chosen, at: Option<DVec2>) -> Vec<Mark> {
        let outline = chosen.outline(scope, Role::Hold);
        let frame = Frame::of(scope, chosen);
        match (&self.doing, at) {
            (Doing::Moving(hold, _), Some(at)) if is_drag(scope, [hold.at, at]) => {
                let (mut marks, said) = dragged(scope, scope.way(*hold, at), chosen, Role::Hold);
                marks.extend(said.map(|words| Mark::Words(at + DVec2::new(16.0, -10.0) * scope.scale, words)));
                marks
            }
            (Doing::Handling(grip), Some(at)) => {
                let Some(frame) = frame else { return outline };
                let change = grip.change(scope, at, self.shift);
                let about = change.about(&frame, grip.handle);
                let words = at + DVec2::new(16.0, -10.0) * scope.scale;
                let box_too = frame.marks(scope, Some(grip.handle));
                let outcome = change.outcome(scope, chosen, about);
                let placed = |mark: Mark| outcome.lines(scope, change.preview(scope, about, mark));
                let moved = outline.into_iter().chain(box_too).map(placed);
                let more = outcome.words().map_or_else(String::new, |more| format!(": {more}"));
                let words = Mark::Words(words, format!("{}{more}", change.words(scope, chosen)));
                moved.chain(outcome.others(scope)).chain([words]).collect()
            }
            (Doing::Stopping(stop), Some(at)) => {
                let arcs = stop.marks(scope, &chosen.points, (at, self.shift));
                outline.into_iter().chain(arcs).collect()
            }
            (Doing::Turning(grip), Some(at)) => {
                let turned = grip.turned(scope, at, self.shift);
                let words = Mark::Words(at + DVec2::new(16.0, -10.0) * scope.scale, turned.said(scope, chosen));
                let rings = Rings::of(scope, chosen).into_iter().flat_map(|rings| rings.marks(scope, Some(grip.ring)));
                outline.into_iter().chain(turned.preview(scope, chosen)).chain(rings).chain([words]).collect()
            }
            (Doing::Nothing, _) => {
                let near = at.and_then(|at| frame?.handle(scope, at));
                let rings = Rings::of(scope, chosen);
                let ring = at.and_then(|at| rings?.ring(scope, at));
                let rings = rings.iter().flat_map(|rings| rings.marks(scope, ring));
                let handles = frame.iter().flat_map(|frame| frame.marks(scope, near)).chain(rings);
                let stops = stops::marks(scope, &chosen.points);
                outline.into_iter().chain(handles).chain(ways(scope)).chain(stops).collect()
            }
            _ => outline,
        }
    }
}

/// What is selected, where a handle of it lies over a bond or a point of something else: a double click there means that.
fn beside(scope: Scope<'_>, chosen: &Chosen, at: DVec2) -> Option<Chosen> {
    Chosen::part_at(scope, at).filter(|part| !chosen.has(part)).map(|_| chosen.clone())
}

/// The ways that pins of what is selected are led along, with their places.
fn ways(scope: Scope<'_>) -> Vec<Mark> {
    let pixel = |(_, place): &(f64, [f64; 3])| scope.camera.screen_from_world(DVec3::from(*place)).map(DVec2::from);
    let pins = scope.shown.matter.iter().flat_map(|matter| &matter.pins);
    let of = |knots: &Knots| {
        let places: Vec<DVec2> = knots.iter().filter_map(pixel).collect();
        let line = |pair: &[DVec2]| Mark::Line(Role::Hold, pair[0], pair[1], 1.2 * scope.scale);
        let lines: Vec<Mark> = places.windows(2).map(line).collect();
        lines.into_iter().chain(places.into_iter().map(|at| Mark::Square(Role::Hold, at, 2.5 * scope.scale)))
    };
    pins.flat_map(|pin| of(&pin.knots)).collect()
}

/// Bodies and obstacles are dragged from where they were taken to a pixel: in space in the plane that faces the camera.
pub(super) fn moved(scope: Scope<'_>, (hold, to): (Hold, DVec2), chosen: &Chosen) -> Deed {
    let chosen = chosen.left(scope);
    if !is_drag(scope, [hold.at, to]) || chosen.is_empty() {
        return Deed::default();
    }
    Change::Shift(scope.way(hold, to)).fitted(scope, &chosen, DVec2::ZERO)
}

/// What is seen of bodies and obstacles that are dragged so far `[m]`: the outline where they will be, with their pins, what they push aside, and
/// what is to be known of it.
pub(super) fn dragged(scope: Scope<'_>, by: DVec3, chosen: &Chosen, role: Role) -> (Vec<Mark>, Option<String>) {
    let (change, about) = (Change::Shift(by), DVec2::ZERO);
    let outcome = change.outcome(scope, chosen, about);
    // In the plane the outcome has it.
    let is_plane = scope.shown.dimensions == 2;
    let Lift { way, said } = if is_plane { Lift::default() } else { change.lift(scope, chosen, about) };
    let outline = carried(scope, by + way, chosen, role).into_iter();
    let moved = outline.chain(pins(scope, by + way, chosen)).map(|mark| outcome.lines(scope, mark));
    let marks = moved.chain(outcome.others(scope)).collect();
    (marks, outcome.words().or(said.map(str::to_owned)))
}

/// The outline of bodies and obstacles where they are once they went so far `[m]`.
fn carried(scope: Scope<'_>, by: DVec3, chosen: &Chosen, role: Role) -> Vec<Mark> {
    chosen.outline(Scope { camera: &facing::before(scope.camera, by), ..scope }, role)
}

/// Rings about the pins that go along with bodies, where they are once those went so far `[m]`.
pub(super) fn pins(scope: Scope<'_>, by: DVec3, chosen: &Chosen) -> Vec<Mark> {
    let pins = chosen.points.iter().filter(|point| scope.is_pinned(**point)).take(MOST_PINS);
    let at = |point: &PointId| scope.camera.screen_from_world(DVec3::from(scope.shown.place(point.index())) + by);
    pins.filter_map(at).map(|at| Mark::Ring(Role::Hold, DVec2::from(at), PIN * scope.scale)).collect()
}

/// Whether a press that ends elsewhere moves what it was on.
pub(super) fn is_drag(scope: Scope<'_>, [from, to]: [DVec2; 2]) -> bool {
    from.distance(to) >= CLICK * scope.scale
}
