//! Tools: what presses and strokes of the left button become. They return commands and change nothing.

#[cfg(test)]
mod bad_tests;
mod boxes;
mod brush;
mod build;
mod chosen;
mod cutting;
mod drives;
#[cfg(test)]
mod drives_tests;
mod erase;
#[cfg(test)]
mod grab_tests;
mod handles;
mod haul;
#[cfg(test)]
mod haul_tests;
mod hub;
mod knot;
mod lead;
mod marks;
#[cfg(test)]
mod matrix_tests;
mod pick;
mod push;
#[cfg(test)]
mod push_tests;
mod region;
mod room;
#[cfg(test)]
mod select_tests;
mod selecting;
mod skin;
#[cfg(test)]
mod tests;
mod wind;
#[cfg(test)]
mod wind_tests;

use glam::{DVec2, DVec3};

use super::action::{Primitive, Tool};
use super::matter::Among;
use super::player::Probe;
use crate::history::Do;
use crate::sim::{Cursor, MouseChange, PointId, Reach};
use brush::Stroke;
pub(super) use brush::{Brush, RADII};
use build::{Drag, Maker, Path, Step};
pub(super) use build::{Link, Links};
pub(super) use chosen::Chosen;
use cutting::Slash;
pub(super) use drives::Drives;
use erase::{delete_points, erase};
use handles::Grip;
pub(super) use handles::Handle;
use haul::Haul;
pub(super) use haul::{HaulWay, Hauled};
use lead::Lead;
pub(super) use lead::PinWay;
pub(super) use marks::{Mark, Role, probe};
pub(super) use pick::Scope;
pub(super) use push::PushWay;
use region::Region;
pub(super) use room::Walls;
use selecting::is_drag;
use wind::Blow;

/// Said of pins in space that are led while time stands still.
const LATER: &str = "time stands still: it goes there as soon as time goes on";
/// The hover force stays away so long after a grab `[s]`: what was thrown is not blown off its way.
const CALM: f64 = 0.2;

/// Commands, and what they are called when they are undone.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Deed {
    pub(super) commands: Vec<Do>,
    pub(super) edit: Option<&'static str>,
    /// Why there are none, where that is not seen.
    pub(super) words: Option<String>,
    /// What is to be of the matter that the brush paints with.
    pub(super) painted: Option<Among>,
}

impl Deed {
    fn edit(name: &'static str, command: Do) -> Self {
        Deed { commands: vec![command], edit: Some(name), ..Deed::default() }
    }

    /// What the hand does on the way, which is no edit.
    fn plain(commands: Vec<Do>) -> Self {
        Deed { commands, ..Deed::default() }
    }

    fn words(words: String) -> Self {
        Deed { words: Some(words), ..Deed::default() }
    }

    /// Whether there is nothing to do.
    pub(super) fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }
}

/// What is in the hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Held {
    /// It is led.
    Grip,
    /// It goes with the pointer.
    Move,
}

/// What the left button is doing.
#[derive(Clone, Debug, Default, PartialEq)]
enum Doing {
    #[default]
    Nothing,
    /// These points are led.
    Grabbing(Vec<PointId>),
    /// A pin is led.
    Leading(Lead),
    /// The hover force pushes through bodies.
    Pushing,
    /// A stroke, to cut what it crosses.
    Cutting(Slash),
    /// A primitive is drawn out.
    Building(Drag),
    /// Something is drawn click by click, also while the button is up.
    Drawing(Path),
    /// What is selected is moved, from where it was pressed on `[px]`; a click selects what lies there alone.
    Moving(DVec2, Chosen),
    /// What the hand pressed on from here `[px]` is moved as a whole: while time stands still all, else an obstacle, which then is hauled.
    Carrying(DVec2, Chosen),
    /// What is selected is turned or scaled by a handle.
    Handling(Grip),
    /// Obstacles go after the pointer while time runs.
    Hauling(Haul),
    /// A region is drawn, whose bodies are selected.
    Marking(Region),
    /// Bodies get another matter.
    Painting(Stroke),
    /// The arrow of a force is drawn or changed.
    Forcing(push::Pull),
    /// The arrow of the wind is.
    Blowing(Blow),
}

/// The left button's tool and what it is doing.
#[derive(Clone, Debug, Default)]
pub(super) struct Hand {
    tool: Tool,
    /// The tool for pins is held by its key.
    pins: bool,
    /// What the tool for building makes.
    maker: Maker,
    /// What the tools for muscles and motors make.
    drives: Drives,
    /// What the brush paints with.
    brush: Brush,
    /// What the tool for forces makes, and where the arrow of the wind was drawn `[m]`.
    push: PushWay,
    wind_at: Option<DVec3>,
    /// What is selected, or will be as soon as it is there.
    chosen: Chosen,
    /// A drag beside all bodies is a free stroke, not a box.
    draws_lasso: bool,
    shift: bool,
    alt: bool,
    doing: Doing,
    /// Where something was built last, until the pointer moves on `[px]`.
    built_at: Option<DVec2>,
    /// Time stands still: the hand moves bodies in place of leading them.
    is_still: bool,
    /// How far from the pointer the middle of what is led is to be `[m]`.
    beside: DVec2,
    /// What the hover force is when nothing is grabbed; `None`: the scene has none, or it goes along a track.
    strength: Option<f64>,
    /// How long the hover force stays away yet `[s]`; infinite while something is grabbed.
    calm: Option<f64>,
}

impl Hand {
    /// The tool that the next press uses.
    pub(super) fn tool(&self) -> Tool {
        if self.pins { Tool::Pin } else { self.tool }
    }

    /// Takes another tool.
    pub(super) fn take(&mut self, tool: Tool) {
        self.tool = tool;
    }

    /// The key that takes the tool for pins is held, or let go.
    pub(super) fn hold_pins(&mut self, is_held: bool) {
        self.pins = is_held;
    }

    /// What the tool for building makes.
    pub(super) fn primitive(&self) -> Primitive {
        self.maker.primitive
    }

    /// What drawn bonds are made of.
    pub(super) fn links(&self) -> Links {
        self.maker.links
    }

    /// They are made of something else from now on.
    pub(super) fn set_links(&mut self, links: Links) {
        self.maker.links = links;
    }

    /// Whether something is drawn click by click.
    pub(super) fn is_drawing(&self) -> bool {
        matches!(self.doing, Doing::Drawing(_))
    }

    /// Ends what is drawn click by click, if it can end here.
    pub(super) fn finish(&mut self, scope: Scope<'_>) -> Deed {
        match std::mem::take(&mut self.doing) {
            Doing::Drawing(mut path) => {
                let step = path.finish(self.maker, scope);
                self.go_on(path, step)
            }
            doing => {
                self.doing = doing;
                Deed::default()
            }
        }
    }

    /// Leaves what is drawn click by click: bonds that were drawn come into the world.
    pub(super) fn leave_drawing(&mut self, scope: Scope<'_>) -> Deed {
        match std::mem::take(&mut self.doing) {
            Doing::Drawing(path) => path.leave(self.maker, scope),
            doing => {
                self.doing = doing;
                Deed::default()
            }
        }
    }

    /// Takes the last click of it back.
    pub(super) fn step_back(&mut self) {
        if let Doing::Drawing(path) = &mut self.doing
            && !path.step_back(self.maker)
        {
            self.doing = Doing::Nothing;
        }
    }

    fn go_on(&mut self, path: Path, step: Step) -> Deed {
        match step {
            Step::GoesOn(words) => {
                self.doing = Doing::Drawing(path);
                words.map_or_else(Deed::default, Deed::words)
            }
            Step::Done(deed) => deed,
        }
    }

    /// Another primitive is to be built: with the tool for that.
    pub(super) fn choose(&mut self, primitive: Primitive) {
        self.built_at = None;
        self.maker.primitive = primitive;
        self.tool = Tool::Build;
    }

    /// What the tools for muscles and motors make.
    pub(super) fn drives(&self) -> Drives {
        self.drives
    }

    /// They make something else from now on.
    pub(super) fn set_drives(&mut self, drives: Drives) {
        self.drives = drives;
    }

    /// What the tool for forces makes.
    pub(super) fn push_way(&self) -> PushWay {
        self.push
    }

    /// It makes something else from now on.
    pub(super) fn set_push_way(&mut self, way: PushWay) {
        self.push = way;
    }

    /// What a press makes, with the keys that are held.
    fn pushes(&self) -> PushWay {
        match (self.shift, self.alt) {
            _ if self.push == PushWay::Wind => PushWay::Wind,
            (_, true) => PushWay::Turn,
            (true, false) => PushWay::Body,
            _ => self.push,
        }
    }

    /// What the brush paints with.
    pub(super) fn brush(&self) -> Brush {
        self.brush
    }

    /// It paints with something else from now on.
    pub(super) fn set_brush(&mut self, brush: Brush) {
        self.brush = brush;
    }

    /// Whether a drag beside all bodies is a free stroke.
    pub(super) fn draws_lasso(&self) -> bool {
        self.draws_lasso
    }

    /// It is from now on, or a box.
    pub(super) fn draw_lasso(&mut self, is_lasso: bool) {
        self.draws_lasso = is_lasso;
    }

    /// Shift and Alt are held, or let go.
    pub(super) fn hold(&mut self, [shift, alt]: [bool; 2]) {
        (self.shift, self.alt, self.maker.is_free) = (shift, alt, shift);
    }

    /// Time stands still from now on, or runs.
    pub(super) fn stand_still(&mut self, is_still: bool) {
        self.is_still = is_still;
    }

    /// Another scene, or another strength by hand.
    pub(super) fn set_strength(&mut self, strength: Option<f64>) {
        self.strength = strength;
    }

    /// What the hover force is when nothing is grabbed.
    pub(super) fn strength(&self) -> Option<f64> {
        self.strength
    }

    /// A history begins: nothing is held any more, and nothing selected.
    pub(super) fn let_go(&mut self) {
        self.drop_all();
        self.chosen = Chosen::default();
    }

    /// Time was gone through: nothing is held any more; what is selected stays so where it is there.
    pub(super) fn drop_all(&mut self) {
        (self.doing, self.calm) = (Doing::Nothing, None);
    }

    /// Another history is gone to: what this one has in hand is let go first, and the hover force comes back at once.
    pub(super) fn leave(&mut self) -> Deed {
        let mut commands = Vec::new();
        if self.is_grabbing() {
            commands.push(Do::Release);
        }
        if self.calm.is_some() {
            commands.extend(self.strength.map(strength));
        }
        self.let_go();
        Deed::plain(commands)
    }

    /// Whether the hover force pushes while the button is down.
    pub(super) fn is_pushing(&self) -> bool {
        self.doing == Doing::Pushing
    }

    /// Whether something is led.
    pub(super) fn is_grabbing(&self) -> bool {
        matches!(self.doing, Doing::Grabbing(_))
    }

    /// Whether the hand moves something as a whole.
    pub(super) fn is_carrying(&self) -> bool {
        matches!(self.doing, Doing::Carrying(..))
    }

    /// Whether a pin is led.
    pub(super) fn is_leading(&self) -> bool {
        matches!(self.doing, Doing::Leading(_))
    }

    /// Where what is led goes, with the cursor here.
    pub(super) fn led_to(&self, cursor: Cursor) -> Cursor {
        if !self.is_grabbing() {
            return cursor;
        }
        let [x, y, z] = cursor.origin;
        Cursor { origin: [x + self.beside.x, y + self.beside.y, z], ..cursor }
    }

    /// How the pointer looks while the button does something; `None`: as before.
    pub(super) fn holds(&self) -> Option<Held> {
        match self.doing {
            Doing::Grabbing(_) | Doing::Leading(_) => Some(Held::Grip),
            Doing::Moving(..) | Doing::Carrying(..) | Doing::Hauling(_) => Some(Held::Move),
            _ => None,
        }
    }

    /// Whether the button is doing anything.
    pub(super) fn is_busy(&self) -> bool {
        self.doing != Doing::Nothing
    }

    /// Whether the hover force stays away.
    pub(super) fn is_calm(&self) -> bool {
        self.calm.is_some()
    }

    /// The left button went down at a pixel.
    pub(super) fn press(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        self.beside = DVec2::ZERO;
        match self.tool() {
            Tool::Hand => self.take_hold(scope, at),
            Tool::Pin => pin(scope, at),
            Tool::Paint => {
                self.doing = Doing::Painting(self.brush.begin(scope, at));
                Deed::default()
            }
            Tool::Cut => {
                self.doing = Doing::Cutting(Slash::new(at));
                Deed::default()
            }
            Tool::Erase => erase(scope, at),
            Tool::Build => self.begin_to_build(scope, at),
            Tool::Muscle => self.drives.press_muscle(scope, at),
            Tool::Motor => self.drives.press_motor(scope, at, self.shift),
            Tool::Push if self.pushes() == PushWay::Wind => {
                self.doing = Doing::Blowing(Blow::press(scope, self.wind_at, at));
                Deed::default()
            }
            Tool::Push => match self.pushes().press(scope, at) {
                Ok(pull) => {
                    self.doing = Doing::Forcing(pull);
                    Deed::default()
                }
                Err(why) => Deed::words(why.to_owned()),
            },
            Tool::Select => {
                self.begin_to_select(scope, at);
                Deed::default()
            }
        }
    }

    /// The pointer moved to a pixel while the button is down.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        self.built_at.take_if(|was| is_drag(scope, [*was, at]));
        match &mut self.doing {
            Doing::Marking(region) => region.trace(scope, at),
            Doing::Cutting(slash) => slash.trace(scope, at),
            Doing::Painting(stroke) => self.brush.trace(scope, stroke, at),
            Doing::Drawing(path) => path.trace(scope, at),
            _ => {}
        }
    }

    fn begin_to_build(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        if scope.shown.dimensions != 2 {
            return Deed::words(build::OF_THE_PLANE.to_owned());
        }
        if self.maker.primitive.is_drawn() {
            let doing = std::mem::take(&mut self.doing);
            let mut path = if let Doing::Drawing(path) = doing { path } else { Path::default() };
            let step = path.press(self.maker, scope, at);
            return self.go_on(path, step);
        }
        self.doing = Doing::Building(Drag::new(scope, at));
        Deed::default()
    }

    /// What lies under the pixel is led: a pin along its way, all else by its points. Where nothing does, what the hover force has
    /// pushed away comes to the hand; where nothing is in its reach, it pushes on.
    fn take_hold(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        // The pins of a hinge go with what turns on it while time stands still.
        let lead = Lead::of_pin(scope, at).filter(|lead| !self.is_still || !hub::is_hinged(scope, lead.point()));
        if let Some(lead) = lead {
            // While time stands still nothing can be led: pins are put where the drag ends, in the plane.
            if self.is_still && scope.shown.dimensions == 2 {
                self.doing = Doing::Carrying(at, Chosen { points: lead.pins(), obstacles: Vec::new() });
                return Deed::default();
            }
            let words = if self.is_still { Some(LATER.to_owned()) } else { None };
            let commands = self.calm_now();
            self.doing = Doing::Leading(lead);
            return Deed { words, ..Deed::plain(commands) };
        }
        if self.is_still {
            return self.carry(scope, at);
        }
        let mut points = scope.grip(at);
        if points.is_empty()
            && let Some(number) = scope.block(at)
        {
            let commands = self.calm_now();
            self.doing = Doing::Carrying(at, Chosen { obstacles: vec![number], ..Chosen::default() });
            return Deed::plain(commands);
        }
        if points.is_empty() && self.strength.is_some_and(|strength| strength > 0.0) {
            points = scope.pushed(at);
        }
        if points.is_empty() {
            self.doing = Doing::Pushing;
            let is_solid = scope.solid(at).is_some();
            return if is_solid { Deed::words(SOLID.to_owned()) } else { Deed::default() };
        }
        let mut commands = self.calm_now();
        commands.push(Do::Grab(Reach::Points(points.clone())));
        self.doing = Doing::Grabbing(points);
        Deed::plain(commands)
    }

    /// The hover force goes away, if it is there.
    fn calm_now(&mut self) -> Vec<Do> {
        let is_there = self.strength.is_some() && self.calm.is_none();
        self.calm = Some(f64::INFINITY);
        if is_there { vec![strength(0.0)] } else { Vec::new() }
    }

    /// The wheel turned while the button is down. Returns whether that means anything to what it does.
    pub(super) fn turn_wheel(&mut self, steps: i32) -> bool {
        matches!(self.doing, Doing::Building(_)) && self.maker.turn(steps)
    }

    /// Where the pin that is led is to go now, `seconds` after the last time.
    pub(super) fn lead(&mut self, scope: Scope<'_>, at: DVec2, seconds: f64) -> Option<PinWay> {
        match &mut self.doing {
            Doing::Leading(lead) => lead.pass(scope, at, (seconds, self.shift)),
            _ => None,
        }
    }

    /// The left button was let go at a pixel.
    pub(super) fn release(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        match std::mem::take(&mut self.doing) {
            Doing::Grabbing(led) => {
                self.calm = Some(CALM);
                let ties = self.tool() == Tool::Hand && !self.shift;
                if ties { knot::let_go(scope, &led, at) } else { Deed::plain(vec![Do::Release]) }
            }
            Doing::Leading(_) => {
                self.calm = Some(CALM);
                Deed::default()
            }
            Doing::Cutting(slash) => slash.release(scope, at),
            Doing::Building(drag) => {
                self.built_at = Some(at);
                self.maker.build(scope, &drag, at)
            }
            Doing::Drawing(mut path) => {
                let step = path.release(self.maker, scope, at);
                self.go_on(path, step)
            }
            Doing::Forcing(pull) => pull.release(scope, at),
            Doing::Blowing(blow) => {
                self.wind_at = Some(blow.from());
                blow.release(scope, at)
            }
            Doing::Moving(from, under) => self.end_move(scope, [from, at], under),
            Doing::Carrying(from, what) => selecting::moved(scope, [from, at], &what),
            Doing::Handling(grip) => self.end_grip(scope, grip, at),
            Doing::Marking(region) => {
                self.mark(scope, &region, at);
                Deed::default()
            }
            Doing::Painting(mut stroke) => {
                self.brush.trace(scope, &mut stroke, at);
                let among = stroke.among();
                match among.is_empty() {
                    true if scope.solid(at).is_some() => Deed::words(brush::SOLID.to_owned()),
                    true => Deed::words(brush::NOTHING.to_owned()),
                    false => Deed { painted: Some(among), ..Deed::default() },
                }
            }
            _ => Deed::default(),
        }
    }

    /// The point that the button, which is about to be let go at a pixel, clicked on with the tool for selecting.
    pub(super) fn clicked(&self, scope: Scope<'_>, at: DVec2) -> Option<Probe> {
        let is_click = matches!(self.doing, Doing::Moving(from, _) if !is_drag(scope, [from, at]));
        let bond = || scope.bond(at).map(|(place, _)| Probe::Bond(scope.shown.scenery.bond_number(place)));
        let probe = scope.point(at).map(Probe::Point).or_else(bond);
        probe.filter(|_| is_click && self.tool() == Tool::Select)
    }

    /// Ends what is under way without doing it. Returns whether anything was.
    pub(super) fn cancel(&mut self) -> (bool, Deed) {
        let was = self.is_busy() || !std::mem::take(&mut self.chosen).is_empty();
        let deed = match std::mem::take(&mut self.doing) {
            Doing::Grabbing(_) => {
                self.calm = Some(CALM);
                Deed::plain(vec![Do::Release])
            }
            Doing::Leading(_) => {
                self.calm = Some(CALM);
                Deed::default()
            }
            _ => Deed::default(),
        };
        (was, deed)
    }

    /// Whether the hover force is about to come or go.
    pub(super) fn is_fading(&self) -> bool {
        match (self.tool(), self.calm) {
            (Tool::Hand, Some(_)) => !self.leads(),
            (Tool::Hand, None) => false,
            (_, calm) => self.strength.is_some() && calm.is_none_or(f64::is_finite),
        }
    }

    /// Whether anything follows the cursor.
    fn leads(&self) -> bool {
        self.is_grabbing() || self.is_leading() || self.is_carrying() || self.is_hauling()
    }

    /// A frame passes. The hover force is the hand's: with another tool it goes, and a while after a grab it comes back.
    pub(super) fn pass(&mut self, seconds: f64) -> Deed {
        if self.tool() != Tool::Hand {
            return Deed::plain(self.calm_now());
        }
        if !self.leads() {
            // Nothing keeps it away any more.
            self.calm = self.calm.map(|calm| calm.min(CALM));
        }
        let Some(calm) = &mut self.calm else { return Deed::default() };
        *calm -= seconds;
        if *calm > 0.0 {
            return Deed::default();
        }
        self.calm = None;
        Deed::plain(self.strength.map(strength).into_iter().collect())
    }

    /// Takes away what is led, or what lies under the pixel.
    pub(super) fn delete(&mut self, scope: Scope<'_>, at: Option<DVec2>) -> Deed {
        if let Doing::Grabbing(points) = &self.doing {
            let Some(&point) = points.first() else { return Deed::default() };
            let deed = delete_points(scope.body(point));
            self.calm = Some(CALM);
            self.doing = Doing::Nothing;
            return deed;
        }
        if let Some(chosen) = self.chosen(scope) {
            self.chosen = Chosen::default();
            return chosen.deleted();
        }
        at.map_or_else(Deed::default, |at| erase(scope, at))
    }

    /// Where the middle of what is led goes, with the pointer at a pixel.
    fn led_at(&self, scope: Scope<'_>, at: DVec2) -> DVec2 {
        if !self.is_grabbing() || self.beside == DVec2::ZERO {
            return at;
        }
        scope.on_screen(scope.in_plane(at) + self.beside).unwrap_or(at)
    }

    /// What a click at the pixel would do, to be drawn.
    pub(super) fn marks(&self, scope: Scope<'_>, at: Option<DVec2>) -> Vec<Mark> {
        let mut marks = match (self.tool(), at) {
            (Tool::Muscle, Some(at)) => self.drives.mark_muscle(scope, at),
            (Tool::Motor, Some(at)) => self.drives.mark_motor(scope, at, self.shift),
            (Tool::Paint, Some(at)) => self.brush.marks(scope, at),
            (Tool::Push, at) if self.pushes() == PushWay::Wind => match (&self.doing, at) {
                (Doing::Blowing(blow), Some(at)) => blow.marks(scope, at),
                (_, at) => wind::marks(scope, self.wind_at, at),
            },
            (Tool::Push, Some(at)) if self.doing == Doing::Nothing => self.pushes().marks(scope, at),
            // What would come next is not shown over what has just come.
            (Tool::Build, _) if self.built_at.is_some() && !self.is_busy() => Vec::new(),
            _ => marks::of((self.tool(), self.maker), &self.doing, scope, at.map(|at| self.led_at(scope, at))),
        };
        let pull = if let Doing::Forcing(pull) = &self.doing { Some(pull) } else { None };
        marks.splice(0..0, push::arrows(scope, pull));
        marks.extend(pull.zip(at).into_iter().flat_map(|(pull, at)| pull.marks(scope, at)));
        if let Doing::Painting(stroke) = &self.doing {
            marks.extend(stroke.marks(scope, self.brush.preset.color()));
        }
        if let Some(chosen) = self.chosen(scope) {
            marks.extend(self.selection_marks(scope, &chosen, at));
        }
        marks
    }
}

/// Said where a plane, or an obstacle in space, is pressed on by the hand.
const SOLID: &str = "it stands: the tool that selects (6) moves it";
/// Said where nothing is pinned.
const NO_POINT: &str = "no point lies here that could be pinned; a rope that is built (5) begins with a pin of its own";
/// Said where a stroke cuts nothing.
const NO_CUT: &str = "the stroke crosses no bond";
/// Said where a stroke is drawn in space.
const CUT_IN_SPACE: &str = "cuts are made in the plane only: this scene is in space";

/// The hover force gets another strength.
pub(super) fn strength(strength: f64) -> Do {
    Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() })
}

/// Holds the point under a pixel, or lets it go.
fn pin(scope: Scope<'_>, at: DVec2) -> Deed {
    match scope.nearest(at).map(|hit| hit.point) {
        Some(point) if scope.is_pinned(point) => Deed::edit("unpin", Do::Unpin(vec![point])),
        Some(point) => Deed::edit("pin", Do::Pin(vec![point])),
        None => Deed::words(NO_POINT.to_owned()),
    }
}
