//! The left button goes down, and the pointer moves while it is.

use glam::{DVec2, DVec3};

use super::build::{self, Drag, Path};
use super::cutting::Slash;
use super::erase::Sweep;
use super::ground::GROUND;
use super::lead::Lead;
use super::muscles::Swipe;
use super::selecting::is_drag;
use super::throw::Throw;
use super::wind::Blow;
use super::{Chosen, Deed, Doing, Hand, PinWay, PushWay, Scope, hub};
use crate::app::action::Tool;
use crate::history::{DeleteKeys, Do};
use crate::sim::{PointId, Reach};

/// Said where the brush finds no numbers to take.
const NO_SPRINGS: &str = "no body of springs lies here whose numbers the brush could take";
/// Said where nothing is pinned.
const NO_POINT: &str = "no point lies here that could be pinned; a rope that is built (5) begins with a pin of its own";
/// Said where no pin is to be let go.
const NO_PIN: &str = "point at a pin (a red ring) and press T to let it go; hold T and click a point to pin it";
/// Said of a point that is pinned.
const PINNED: &str = "pinned";

impl Hand {
    /// The left button went down at a pixel.
    pub(in crate::app) fn press(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        self.beside = DVec3::ZERO;
        let is_there = !self.is_dragged && !is_drag(scope, [self.pressed, at]);
        let is_second = std::mem::take(&mut self.is_quick) && is_there;
        (self.pressed, self.is_dragged) = (at, false);
        self.has_clicked_pins |= self.pins;
        match self.tool() {
            Tool::Hand => self.take_hold(scope, at),
            Tool::Pin => pin(scope, at),
            Tool::Paint if self.alt => match self.brush.taking(scope, at) {
                Some((brush, words)) => {
                    self.brush = brush;
                    Deed::words(words)
                }
                None => Deed::words(NO_SPRINGS.to_owned()),
            },
            Tool::Paint => {
                self.doing = Doing::Painting(self.brush.begin(scope, at));
                Deed::default()
            }
            Tool::Cut => {
                self.doing = Doing::Cutting(Slash::new(at));
                Deed::default()
            }
            Tool::Erase => {
                self.doing = Doing::Erasing(Sweep::begin(scope, at));
                Deed::default()
            }
            Tool::Build => self.begin_to_build(scope, at),
            Tool::Muscle => {
                self.doing = Doing::Driving(Swipe::begin(scope, at));
                Deed::default()
            }
            Tool::Motor => self.drives.press_motor(scope, at, self.shift),
            Tool::Push if self.pushes() == PushWay::Wind => {
                self.doing = Doing::Blowing(Blow::press(scope, self.wind_at, at));
                Deed::default()
            }
            Tool::Push if self.pushes() == PushWay::Speed => match Throw::press(scope, at) {
                Ok(throw) => {
                    self.doing = Doing::Throwing(throw);
                    Deed::default()
                }
                Err(why) => Deed::words(why.words().to_owned()),
            },
            Tool::Push => match self.pushes().press(scope, at) {
                Ok(pull) => {
                    self.doing = Doing::Forcing(pull);
                    Deed::default()
                }
                Err(why) => Deed::words(why.words().to_owned()),
            },
            Tool::Select => {
                self.begin_to_select(scope, at, is_second);
                Deed::default()
            }
        }
    }

    /// The pointer moved to a pixel while the button is down.
    pub(in crate::app) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        self.is_dragged |= is_drag(scope, [self.pressed, at]);
        self.built_at.take_if(|was| is_drag(scope, [*was, at]));
        match &mut self.doing {
            Doing::Marking(region) => region.trace(scope, at),
            Doing::Cutting(slash) => slash.trace(scope, at),
            Doing::Erasing(sweep) => sweep.trace(scope, at),
            Doing::Driving(swipe) => swipe.trace(scope, at),
            Doing::Painting(stroke) => self.brush.trace(scope, stroke, at),
            Doing::Drawing(path) => path.trace(scope, at),
            _ => {}
        }
    }

    pub(super) fn begin_to_build(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        if scope.shown.dimensions != 2 && !build::is_of_space(self.maker.primitive) {
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
    /// pushed away comes to the hand; where nothing is in its reach, it pushes on, and in scenes where a click starts something it does there.
    pub(super) fn take_hold(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        if scope.starts_at(at) {
            self.doing = Doing::Pushing;
            return Deed::default();
        }
        // The pins of a hinge go with what turns on it while time stands still.
        let lead = Lead::of_pin(scope, at).filter(|lead| !self.is_still || !hub::is_hinged(scope, lead.point()));
        if let Some(lead) = lead {
            // While time stands still nothing can be led: pins are put where the drag ends.
            if self.is_still {
                self.doing = Doing::Carrying(scope.hold(at), Chosen { points: lead.pins(), obstacles: Vec::new() });
                return Deed::default();
            }
            let commands = self.calm_now();
            self.doing = Doing::Leading(lead);
            return Deed::plain(commands);
        }
        if self.is_still {
            return self.carry(scope, at);
        }
        let mut points = scope.grip(at);
        let is_under = !points.is_empty();
        if points.is_empty()
            && let Some(number) = scope.block(at)
        {
            let commands = self.calm_now();
            self.doing = Doing::Carrying(scope.hold(at), Chosen { obstacles: vec![number], ..Chosen::default() });
            return Deed::plain(commands);
        }
        if points.is_empty() && self.strength.is_some_and(|strength| strength > 0.0) {
            points = scope.pushed(at);
        }
        if points.is_empty() {
            self.doing = Doing::Pushing;
            return if scope.is_on_ground(at) { Deed::words(GROUND.to_owned()) } else { Deed::default() };
        }
        let mut commands = self.calm_now();
        let reach = scope.reach(&points);
        // A patch stays where it is below the pointer; what was pushed away comes to it.
        if is_under && matches!(reach, Reach::Patch { .. }) {
            let middle = scope.middle(&points);
            self.beside = middle - scope.facing(middle, at);
        }
        commands.push(Do::Grab(reach));
        self.doing = Doing::Grabbing(points);
        Deed::plain(commands)
    }

    /// The wheel turned while the button is down. Returns whether that means anything to what it does.
    pub(in crate::app) fn turn_wheel(&mut self, steps: i32) -> bool {
        matches!(self.doing, Doing::Building(_)) && self.maker.turn(steps)
    }

    /// Where the pin that is led is to go now, `seconds` after the last time.
    pub(in crate::app) fn lead(&mut self, scope: Scope<'_>, at: DVec2, seconds: f64) -> Option<PinWay> {
        match &mut self.doing {
            Doing::Leading(lead) => lead.pass(scope, at, (seconds, self.shift)),
            _ => None,
        }
    }
}

/// Holds the point under a pixel, or lets it go.
fn pin(scope: Scope<'_>, at: DVec2) -> Deed {
    match scope.nearest(at).map(|hit| hit.point) {
        Some(point) if scope.is_pinned(point) => unpin(scope, at),
        Some(point) => Deed { words: Some(PINNED.to_owned()), ..Deed::edit("pin", Do::Pin(vec![point])) },
        None => Deed::words(NO_POINT.to_owned()),
    }
}

/// Lets the pin go that lies at a pixel.
pub(in crate::app) fn unpin(scope: Scope<'_>, at: DVec2) -> Deed {
    let pin = scope.nearest(at).map(|hit| hit.point).filter(|&point| scope.is_pinned(point));
    pin.map_or_else(
        || Deed::words(NO_PIN.to_owned()),
        |pin| {
            let words = Some(let_go(scope, pin).to_owned());
            let mut deed = Deed { words, ..Deed::edit("unpin", Do::Unpin(vec![pin])) };
            // What turned about it pushes against nothing any more.
            let props: Vec<u32> = hub::props_of(scope, pin).into_iter().map(|prop| prop.0).collect();
            if !props.is_empty() {
                deed.commands.push(Do::Delete(DeleteKeys { points: props, ..DeleteKeys::default() }));
            }
            deed
        },
    )
}

/// What becomes of a pin that is let go: its body falls where nothing else holds that.
fn let_go(scope: Scope<'_>, pin: PointId) -> &'static str {
    let falls = scope.shown.settings.gravity.is_some_and(|gravity| gravity != [0.0; 3]);
    let body = scope.body(pin);
    let is_prop = |point: &PointId| scope.shown.scenery.props.binary_search(point).is_ok();
    let is_held = body.iter().any(|&point| point != pin && scope.is_pinned(point) && !is_prop(&point));
    match (is_held, falls) {
        (true, _) => "unpinned: other pins still hold it",
        (false, true) => "unpinned: it falls",
        (false, false) => "unpinned",
    }
}
