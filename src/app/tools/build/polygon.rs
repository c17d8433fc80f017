//! A solid polygon, drawn corner by corner or with a free stroke.

use glam::DVec2;

use super::corners::{area, crossing, simplified};
use super::outline::{label, line, pixel};
use super::{CLICK, LEAST, SNAP, Step, TOO_SMALL};
use crate::app::action::Primitive;
use crate::app::tools::Deed;
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;
use crate::app::tools::room::{Outcome, coming};
use crate::history::Do;
use crate::scene::{AddKeys, ObstacleKeys, Vector};

/// Said where an outline crosses itself.
const CROSSES: &str = "it would cross itself";
/// Said where too few corners are closed.
const TOO_FEW: &str = "an outline needs three corners";
/// A free stroke gets a place so far from its last one `[logical px]`.
const STEP: f64 = 3.0;
/// Corners of a free stroke leave out what is this near to them `[logical px]`.
const TOLERANCE: f64 = 1.5;
/// Friction of it `[1]`.
const FRICTION: f64 = 0.5;

/// An outline that is being drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app::tools) struct Outline {
    /// `[m]`
    corners: Vec<DVec2>,
    /// While the button is down: where it was pressed `[px]`, and where the pointer went from there `[m]`.
    stroke: Option<(DVec2, Vec<DVec2>)>,
}

impl Outline {
    /// The button goes down: a corner comes, or the outline is closed.
    pub(in crate::app::tools) fn press(&mut self, scope: Scope<'_>, at: DVec2) -> Step {
        let place = scope.in_plane(at);
        let is_last = is_near(scope, self.corners.last(), at, CLICK);
        if self.closes(scope, at) || (is_last && self.corners.len() >= 3) {
            return self.close(scope);
        }
        if !is_last {
            self.corners.push(place);
            if crossing(&self.corners, false).contains(&true) {
                self.corners.pop();
                return Step::GoesOn(Some(CROSSES.to_owned()));
            }
        }
        self.stroke = Some((at, vec![place]));
        Step::GoesOn(None)
    }

    /// The pointer moves while the button is down.
    pub(in crate::app::tools) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        let far = STEP * scope.scale / scope.camera.pixels_per_metre();
        let place = scope.in_plane(at);
        if let Some((_, stroke)) = &mut self.stroke
            && stroke.last().is_none_or(|last| last.distance(place) >= far)
        {
            stroke.push(place);
        }
    }

    /// The button goes up: a drag that is straight was a side, another one closes the outline.
    pub(in crate::app::tools) fn release(&mut self, scope: Scope<'_>, at: DVec2) -> Step {
        let drawn = self.drawn(scope, at);
        if self.stroke.take().is_none() || drawn.len() < 2 {
            return Step::GoesOn(None);
        }
        let before = self.corners.len();
        self.corners.extend(&drawn[1..]);
        let is_back = before + drawn.len() > 3 && is_near(scope, self.corners.first(), at, SNAP);
        if is_back {
            self.corners.pop();
        }
        if drawn.len() == 2 && !is_back {
            if !crossing(&self.corners, false).contains(&true) {
                return Step::GoesOn(None);
            }
            self.corners.truncate(before);
            return Step::GoesOn(Some(CROSSES.to_owned()));
        }
        let step = self.close(scope);
        if let Step::GoesOn(words) = step {
            // A stroke that closes nothing goes as a whole, with the corner that it began at.
            self.corners.truncate(before - 1);
            let words = words.unwrap_or_default();
            return if self.corners.is_empty() { Step::Done(Deed::words(words)) } else { Step::GoesOn(Some(words)) };
        }
        step
    }

    /// Closes it, if it can be.
    pub(in crate::app::tools) fn close(&mut self, scope: Scope<'_>) -> Step {
        let size = area(&self.corners).abs() * scope.camera.pixels_per_metre().powi(2);
        let why = match () {
            () if self.corners.len() < 3 => TOO_FEW,
            () if crossing(&self.corners, true).contains(&true) => CROSSES,
            () if size < (LEAST * scope.scale).powi(2) => TOO_SMALL,
            () => "",
        };
        if !why.is_empty() {
            return Step::GoesOn(Some(why.to_owned()));
        }
        let keys = within(&self.corners);
        let outcome = coming(scope, &keys);
        if let Some(why) = outcome.refused {
            return Step::GoesOn(Some(why.to_owned()));
        }
        let deed = Deed::edit(Primitive::Polygon.name(), Do::Add(Box::new(keys)));
        Step::Done(Deed { words: outcome.told(), ..deed })
    }

    /// Takes the last corner back. Returns whether there is one left.
    pub(in crate::app::tools) fn step_back(&mut self) -> bool {
        self.corners.pop();
        self.stroke = None;
        !self.corners.is_empty()
    }

    /// Whether a press at a pixel is on the first corner of what can be closed.
    fn closes(&self, scope: Scope<'_>, at: DVec2) -> bool {
        self.corners.len() >= 3 && is_near(scope, self.corners.first(), at, SNAP)
    }

    /// The corners of what is drawn with the button down, the one that it was pressed at first; none of a click.
    fn drawn(&self, scope: Scope<'_>, at: DVec2) -> Vec<DVec2> {
        let Some((pressed, stroke)) = &self.stroke else { return Vec::new() };
        let metre = scope.camera.pixels_per_metre();
        let all: Vec<DVec2> = stroke.iter().copied().chain([scope.in_plane(at)]).collect();
        let far = all.iter().map(|place| place.distance(all[0]) * metre).fold(pressed.distance(at), f64::max);
        if far < CLICK * scope.scale {
            return Vec::new();
        }
        simplified(&all, TOLERANCE * scope.scale / metre)
    }

    /// What it is so far, and what a press at the pixel would make of it: red where it would cross itself.
    pub(in crate::app::tools) fn marks(&self, scope: Scope<'_>, at: Option<DVec2>) -> Vec<Mark> {
        let drawn = at.map_or_else(Vec::new, |at| self.drawn(scope, at));
        let closes = at.is_some_and(|at| self.closes(scope, at));
        let mut all = self.corners.clone();
        match at {
            _ if drawn.len() > 1 => all.extend(&drawn[1..]),
            // Right on the last corner a click closes it.
            Some(at) if !closes && self.stroke.is_none() && !is_near(scope, self.corners.last(), at, CLICK) => {
                all.push(scope.in_plane(at));
            }
            _ => {}
        }
        let (open, closed) = (crossing(&all, false), crossing(&all, true));
        // A free stroke is closed by its end; else closing is yet to be asked for.
        let is_free = drawn.len() > 2;
        // What it would do to bodies is known once it has three corners.
        let outcome =
            if all.len() > 2 && !closed.contains(&true) { coming(scope, &within(&all)) } else { Outcome::default() };
        let role = |is_crossed: bool| if is_crossed || outcome.refused.is_some() { Role::Away } else { Role::Come };
        let flags = if is_free || closes { &closed } else { &open };
        let is_wrong = flags.contains(&true);
        let sides = all.windows(2).zip(flags);
        let ends = |from: DVec2, to: DVec2| Some([pixel(scope, from)?, pixel(scope, to)?]);
        let mut marks: Vec<Mark> = sides
            .filter_map(|(pair, &is_crossed)| {
                let [from, to] = ends(pair[0], pair[1])?;
                Some(line(scope, role(is_crossed), [from, to]))
            })
            .collect();
        if let (Some([from, to]), true) = (all.last().and_then(|last| ends(*last, all[0])), all.len() > 2) {
            let is_crossed = closed.last() == Some(&true);
            marks.push(Mark::Line(role(is_crossed), from, to, 0.6 * scope.scale));
        }
        let knobs = self.corners.iter().filter_map(|corner| pixel(scope, *corner));
        marks.extend(knobs.map(|at| Mark::Knob(Role::Come, at, 3.0 * scope.scale)));
        let first = self.corners.first().and_then(|first| pixel(scope, *first));
        marks.extend(first.filter(|_| closes).map(|first| Mark::Ring(Role::Hold, first, 9.0 * scope.scale)));
        let words = match self.corners.len() {
            _ if is_wrong => CROSSES.to_owned(),
            count if closes => format!("closes it: {count} corners"),
            0 => "click corner by corner, or draw around it".to_owned(),
            _ if is_free => format!("{} corners: let go", all.len()),
            1 | 2 => "the next corner".to_owned(),
            count if crossing(&self.corners, true).contains(&true) => format!("{count} corners: closed now {CROSSES}"),
            count => format!("{count} corners: Enter closes it"),
        };
        marks.extend(outcome.others(scope));
        let words = outcome.words().map_or(words.clone(), |more| format!("{words}: {more}"));
        marks.extend(at.map(|at| label(scope, at, words)));
        marks
    }
}

/// The keys of what lies within corners.
fn within(corners: &[DVec2]) -> AddKeys {
    let corners = corners.iter().map(|corner| Vector::Plane(corner.to_array())).collect();
    let obstacle = ObstacleKeys { polygon: Some(vec![corners]), friction: Some(FRICTION), ..ObstacleKeys::default() };
    AddKeys { obstacles: vec![obstacle], ..AddKeys::default() }
}

/// Whether a place is so near to a pixel.
fn is_near(scope: Scope<'_>, place: Option<&DVec2>, at: DVec2, most: f64) -> bool {
    place.and_then(|place| pixel(scope, *place)).is_some_and(|there| there.distance(at) <= most * scope.scale)
}
