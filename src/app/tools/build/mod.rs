//! The tool for building: a press and a release draw out a primitive, which comes into the world as one `add`.

mod chain;
mod corners;
#[cfg(test)]
mod drawn_tests;
mod fibre;
mod figure;
mod fill;
mod form;
#[cfg(test)]
mod form_tests;
mod grain;
#[cfg(test)]
mod grain_tests;
mod grid;
mod hatched;
mod hung;
#[cfg(test)]
mod hung_tests;
mod laid;
mod links;
mod matter;
#[cfg(test)]
mod matter_tests;
mod neighbours;
#[cfg(test)]
mod neighbours_tests;
mod outline;
#[cfg(test)]
mod outline_tests;
mod path;
mod plumb;
mod polygon;
#[cfg(test)]
mod rope_tests;
mod space;
#[cfg(test)]
mod tests;
mod tie;

use glam::{DVec2, DVec3};

use super::Deed;
use super::knot;
use super::marks::Mark;
use super::pick::Scope;
use crate::app::action::Primitive;
use crate::app::tools::room::coming;
use crate::history::{Do, SetKeys};
use crate::scene::Meeting;
use crate::sim::PointId;
pub(in crate::app) use fibre::{BuiltOf, Fibre};
pub(super) use form::short;
use form::{End, Form, Hold};
pub(in crate::app) use grain::Grain;
pub(in crate::app) use links::{Link, Links};
pub(in crate::app) use neighbours::REACHES;
pub(super) use path::Path;
pub(in crate::app) use space::is_of_space;

/// Said where nothing can be built.
pub(super) const OF_THE_PLANE: &str = "that is of the plane: in space ropes, cloths, boxes and balls are built, and all that is here can be copied (6, Ctrl+D)";
/// Said where a drag is so short that nothing is built.
const TOO_SMALL: &str = "too small: drag it out further, or click for one of the usual size";

/// Said of a rope that would hang from a wall to beyond the walls.
const BEYOND: &str = "beyond the walls: a rope begins within them";

/// A press that moves less than this is a click `[logical px]`.
const CLICK: f64 = 4.0;
/// What lies so near to a press is meant by it `[logical px]`.
const SNAP: f64 = 12.0;
/// The least side or radius of what is drawn out `[logical px]`: a hand could not take hold of less.
const LEAST: f64 = 8.0;
/// Usual sizes in the height of the view: what a click makes is seen whole, with room for some more.
const USUAL_IN_VIEW: f64 = 7.0;

/// What a press or a release comes to while something is drawn click by click.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    /// It goes on; words where there is something to be said.
    GoesOn(Option<String>),
    /// It has ended.
    Done(Deed),
}

/// What is made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Maker {
    pub(super) primitive: Primitive,
    /// What bodies are made of.
    pub(super) of: BuiltOf,
    /// What drawn bonds are made of.
    pub(super) links: Links,
    /// What hangs otherwise, ropes and cloths, is pinned nowhere.
    pub(super) is_free: bool,
    /// What has a middle is drawn from there, not from corner to corner.
    pub(super) is_from_middle: bool,
    /// How far the wheel turned while ropes were drawn.
    turned: i32,
}

/// Where a drag began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drag {
    /// `[px]`
    pressed: DVec2,
    /// `[m]`
    from: DVec2,
    /// The same, in space as deep as what lies there.
    deep: DVec3,
    /// The point of the world that was pressed on.
    point: Option<PointId>,
}

impl Drag {
    pub(super) fn new(scope: Scope<'_>, at: DVec2) -> Self {
        let is_plane = scope.shown.dimensions == 2;
        let point = if is_plane { tie::point_at(scope, at) } else { space::point_at(scope, at) };
        let seen = if is_plane { None } else { laid::surface(scope, at) };
        let deep = seen.unwrap_or_else(|| scope.facing(scope.camera.focus(), at));
        Drag { pressed: at, from: place(scope, at), deep, point }
    }
}

/// A rope between two points is longer than the way between them by this share for each step of the wheel, and by one step from the first `[1]`:
/// what is straight between two pins could not move.
const SLACK: f64 = 0.02;
/// The most steps.
const MOST_SLACK: i32 = 50;

impl Maker {
    /// By what share a rope between two points is longer than the straight way `[1]`.
    fn slack(self) -> f64 {
        SLACK * f64::from(1 + self.turned)
    }

    /// The wheel turned so many steps while something is drawn. Returns whether that means anything to it.
    pub(super) fn turn(&mut self, steps: i32) -> bool {
        let is_rope = self.primitive == Primitive::Rope;
        if is_rope {
            self.turned = self.turned.saturating_add(steps).clamp(-1, MOST_SLACK - 1);
        }
        is_rope
    }

    /// What a release at a pixel adds to the world; words where that would be too small.
    pub(super) fn build(self, scope: Scope<'_>, drag: &Drag, at: DVec2) -> Deed {
        if scope.shown.dimensions != 2 {
            return space::build(self, scope, drag, at);
        }
        match self.form(scope, Some(drag), at) {
            Ok(form) => {
                let keys = form.keys(scope.shown.point_count() as u32, self.of);
                let outcome = coming(scope, &keys);
                if let Some(why) = outcome.refused {
                    return Deed::words(why.to_owned());
                }
                let mut keys = keys;
                let held = self.held(scope, Some(drag), at);
                let knots =
                    if self.is_free { Vec::new() } else { knot::knots(scope, &keys, (outcome.way, Some(&held[..]))) };
                outcome.put(&mut keys);
                let ends = form.holds(drag.from).and_then(|holds| ends_said(scope, holds));
                let commands = knot::tied(scope, keys, &knots);
                let mut deed = Deed { commands, edit: Some(self.primitive.name()), ..Deed::default() };
                let meets = scope.shown.settings.contact.flatten().is_some();
                if self.primitive == Primitive::Figure && !meets {
                    deed.commands.insert(0, meeting());
                }
                deed.words = outcome.told().or(knot::words(scope, &knots)).or(ends);
                deed
            }
            Err(words) => Deed::words(words),
        }
    }

    /// The outline of what a release at a pixel would add, without a drag of what a click there would, and its size in words.
    pub(super) fn outline(self, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Vec<Mark> {
        if scope.shown.dimensions != 2 {
            return space::marks(self, scope, drag, at);
        }
        if self.primitive.is_drawn() {
            return Path::default().marks(self, scope, Some(at));
        }
        match self.form(scope, drag, at) {
            Ok(form) => outline::of((&form, self.of), scope, at, (!self.is_free).then(|| self.held(scope, drag, at))),
            Err(words) => vec![outline::label(scope, at, words)],
        }
    }

    /// What a drag that ends at a pixel comes to.
    ///
    /// Errors: in words, that it is too small.
    fn form(self, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Result<Form, String> {
        let usual = usual_size(scope.camera.height());
        let begun = drag.copied().unwrap_or_else(|| Drag::new(scope, at));
        if begun.pressed.distance(at) < CLICK * scope.scale {
            let from = self.inside(scope, (begun.pressed, begun.from));
            let form = Form::usual(self, self.end(scope, begun.point, from), usual);
            if let Some(Form::Rope { ends: [_, to], .. }) = &form
                && from != begun.from
                && tie::is_walled_off(scope, to.at)
            {
                return Err(BEYOND.to_owned());
            }
            return form.map(|form| self.hung(scope, form)).ok_or_else(String::new);
        }
        let (there, point) = (place(scope, at), tie::point_at(scope, at));
        let mut from = self.end(scope, begun.point, self.inside(scope, (begun.pressed, begun.from)));
        let mut to = self.end(scope, point, self.inside(scope, (at, there)));
        let along = [begun.pressed, 0.5 * (begun.pressed + at), at];
        let is_laid = self.primitive == Primitive::Rope && along.iter().all(|&at| tie::lies_on(scope, at));
        if is_laid && [from.hold, to.hold] == [Hold::Pin; 2] {
            // What is drawn along the ground lies there.
            (from.hold, to.hold) = (Hold::None, Hold::None);
        } else if to.hold == Hold::Pin {
            // Where it ends on nothing it hangs free.
            let surface = tie::surface_at(scope, at).filter(|_| self.primitive == Primitive::Rope);
            to = surface.map_or(End { hold: Hold::None, ..to }, |at| End { at, hold: Hold::Pin });
        }
        if matches!(self.primitive, Primitive::Box | Primitive::Frame) && !self.is_free {
            // A corner that is drawn from or to a pin is right there.
            let pins = [begun.point, point].map(|point| point.filter(|&point| scope.is_pinned(point)));
            for (end, pin) in [&mut from, &mut to].into_iter().zip(pins) {
                let there = pin.filter(|&pin| knot::can_hold(scope, pin)).map(|pin| scope.shown.place(pin.index()));
                end.at = there.map_or(end.at, |[x, y, _]| DVec2::new(x, y));
            }
        }
        [from.at, to.at] = self.spanned([from.at, to.at]);
        let drawn = match self.primitive {
            Primitive::Box | Primitive::Frame | Primitive::Cloth | Primitive::SolidBox => {
                (to.at - from.at).abs().min_element()
            }
            Primitive::Figure => (to.at - from.at).y.abs(),
            _ => from.at.distance(to.at),
        };
        if drawn * scope.camera.pixels_per_metre() < LEAST * scope.scale {
            return Err(TOO_SMALL.to_owned());
        }
        Form::drawn(self, [from, to], usual).map(|form| self.hung(scope, form)).ok_or_else(String::new)
    }

    /// A form where the loose end of a rope meets it, if it is to be tied to that.
    fn hung(self, scope: Scope<'_>, form: Form) -> Form {
        if self.is_free { form } else { form.hung(scope, self.of) }
    }

    /// The points that a drag to a pixel is drawn from and to, that what is drawn can be tied to.
    fn held(self, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Vec<PointId> {
        let from = drag.map_or_else(|| tie::point_at(scope, at), |drag| drag.point);
        from.into_iter().chain(tie::point_at(scope, at)).filter(|&point| knot::can_hold(scope, point)).collect()
    }

    /// What a drag spans `[m]`: of boxes two corners, of what is round its middle and a place on its rim. Both are drawn from corner to corner, what is
    /// round in a square as long as the drag is wide or high, or from the middle.
    fn spanned(self, [from, to]: [DVec2; 2]) -> [DVec2; 2] {
        let way = to - from;
        match (self.primitive, self.is_from_middle) {
            (Primitive::Box | Primitive::Frame | Primitive::Cloth | Primitive::SolidBox, true) => [from - way, to],
            (Primitive::Disc | Primitive::Rim | Primitive::SolidCircle, false) => {
                let radius = 0.5 * way.abs().max_element();
                let middle = from + radius * way.signum();
                [middle, middle + DVec2::new(radius, 0.0)]
            }
            _ => [from, to],
        }
    }

    /// A place under a pixel `[m]`; for the end of a rope beyond the walls the nearest on them.
    fn inside(self, scope: Scope<'_>, (at, place): (DVec2, DVec2)) -> DVec2 {
        let is_out = self.primitive == Primitive::Rope && tie::is_walled_off(scope, place);
        tie::surface_at(scope, at).filter(|_| is_out).unwrap_or(place)
    }

    /// The end of a drag at a place `[m]`: a rope is tied to the point that is seen there, and pinned where none is.
    fn end(self, scope: Scope<'_>, point: Option<PointId>, at: DVec2) -> End {
        let tied = |point: PointId| {
            let [x, y, _] = scope.shown.place(point.index());
            // A point that was deleted since is nowhere.
            (x.is_finite() && y.is_finite()).then_some(End { at: DVec2::new(x, y), hold: Hold::Point(point) })
        };
        let free = End { at, hold: if self.is_free { Hold::None } else { Hold::Pin } };
        point.filter(|_| self.primitive == Primitive::Rope).and_then(tied).unwrap_or(free)
    }
}

/// What the start and the end of a rope hang on, in words: that it holds itself is seen only once it hangs.
fn ends_said(scope: Scope<'_>, holds: [Hold; 2]) -> Option<String> {
    let said = |hold: Hold| match hold {
        Hold::None => None,
        Hold::Pin => Some("pinned"),
        Hold::Point(point) if scope.is_pinned(point) => Some("tied to the pin"),
        Hold::Point(point) if scope.body(point).len() > 1 => Some("tied to the body"),
        Hold::Point(_) => Some("tied to the point"),
    };
    match holds.map(said) {
        [None, None] => None,
        [Some(start), None] => Some(format!("its start is {start}")),
        [None, Some(end)] => Some(format!("its end is {end}")),
        [Some(start), Some(end)] if start == end && start == "pinned" => Some("both ends are pinned".to_owned()),
        [Some(start), Some(end)] => Some(format!("its start is {start}, its end is {end}")),
    }
}

/// Where nothing met before, bodies meet.
fn meeting() -> Do {
    Do::Set(Box::new(SetKeys { contact: Some(Meeting::Is(true)), ..SetKeys::default() }))
}

/// Where a pixel lies in the plane `[m]`.
fn place(scope: Scope<'_>, at: DVec2) -> DVec2 {
    scope.camera.world_from_screen(at.to_array()).truncate()
}

/// The side of what a click makes in a view so high `[m]`: 1, 2 or 5 times a power of ten.
fn usual_size(height: f64) -> f64 {
    let most = height / USUAL_IN_VIEW;
    let ten = 10f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].map(|times| times * ten).into_iter().find(|size| *size <= most).unwrap_or(ten)
}
