//! Obstacles that a drag takes along while time runs: they go after the pointer and push ahead what is in their way.

use glam::{DVec2, DVec3};

use super::chosen::Chosen;
use super::fastened::{pins_in, place};
use super::handles::{Change, Grip};
use super::marks::Mark;
use super::pick::Scope;
use super::rings::RingGrip;
use super::selecting::is_drag;
use super::{Doing, Hand, jam};
use crate::history::{Do, MoveKeys};
use crate::sim::{PointId, Reach};

/// They are sent on their way so often at most `[s]`: each time the world is compiled anew.
const EVERY: f64 = 1.0 / 30.0;
/// They push no faster than this, in heights of the picture and turns a second.
const FASTEST: f64 = 4.0;

/// Obstacles on their way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Haul {
    what: Chosen,
    /// What is stuck in them, and where it was when they were pressed on `[m]`.
    pins: Vec<(PointId, DVec2)>,
    by: By,
    /// What the drag meant as the pointer came to where it is `[px]`, and whether in steps: a view that changes under it means nothing new.
    meant: Option<((DVec2, bool), Change)>,
    /// Since they were sent last `[s]`.
    since: f64,
    goes_on: bool,
}

/// How they are dragged.
#[derive(Clone, Debug, PartialEq)]
enum By {
    /// From here, as deep as it is `[m]`.
    Way(DVec3),
    /// By a handle of the box around them.
    Handle(Grip),
    /// By a ring about them, or the knob beside it, in space.
    Ring(RingGrip),
}

/// Where a drag sends obstacles: all of the way since they were pressed on.
#[derive(Clone, Debug, PartialEq)]
pub struct HaulWay {
    what: Chosen,
    pins: Vec<(PointId, DVec2)>,
    all: Change,
    /// About a place that stays `[m]`.
    about: DVec3,
    /// How high the picture is `[m]`.
    height: f64,
    dimensions: usize,
    /// They were sent before, since they were pressed on.
    pub goes_on: bool,
}

/// How far obstacles went of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hauled(Change);

/// What obstacles have still to go of a way.
#[derive(Clone, Debug, PartialEq)]
pub struct HaulRest {
    pub keys: Box<MoveKeys>,
    /// What it is called when it is undone.
    pub name: &'static str,
    /// It takes at least so long `[s]`.
    pub least: f64,
    rest: Change,
}

impl HaulWay {
    /// Before any of it was gone.
    pub fn begin(&self) -> Hauled {
        Hauled(self.all.share(0.0))
    }

    /// What is stuck in the obstacles, and where it was before any of it was gone `[m]`.
    pub fn pins(&self) -> &[(PointId, DVec2)] {
        &self.pins
    }

    /// Where what goes along came, from where it was before any of the way was gone `[m]`.
    pub fn along(&self, hauled: Hauled, x: DVec2) -> DVec2 {
        hauled.0.place(self.about.truncate(), x)
    }

    /// What there is still to go; `None`: nothing.
    pub fn rest(&self, hauled: Hauled) -> Option<HaulRest> {
        let rest = self.all.after(hauled.0)?;
        let deed = rest.deed(&self.what, self.about, self.dimensions);
        let Some(Do::Move(keys)) = deed.commands.into_iter().next() else { return None };
        Some(HaulRest { keys, name: deed.edit?, least: rest.size(self.height) / FASTEST, rest })
    }
}

impl Hauled {
    /// After a share of what was left.
    pub fn then(self, HaulRest { rest, .. }: &HaulRest, gone: f64) -> Self {
        Hauled(self.0.then(rest.share(gone)))
    }
}

impl Haul {
    fn new(scope: Scope<'_>, what: Chosen, by: By) -> Self {
        let pins = pins_in(scope, &what.obstacles);
        let pins = pins.into_iter().map(|pin| (pin, place(scope, pin))).collect();
        Haul { what, pins, by, meant: None, since: f64::INFINITY, goes_on: false }
    }

    /// All that the drag means, with the pointer at a pixel.
    fn change(&self, scope: Scope<'_>, at: DVec2, in_steps: bool) -> Change {
        if let Some((_, change)) = self.meant.filter(|(from, _)| *from == (at, in_steps)) {
            return change;
        }
        match self.by {
            By::Way(from) => Change::Shift(scope.facing(from, at) - from),
            By::Handle(grip) => grip.change(scope, at, in_steps),
            By::Ring(grip) => grip.change(scope, at, in_steps),
        }
    }

    /// What has no room, or how far they are turned or scaled, with the rings that do it.
    pub(super) fn marks(&self, scope: Scope<'_>, at: Option<DVec2>, in_steps: bool) -> Vec<Mark> {
        let mut marks = jam::marks(scope, at);
        if let By::Ring(grip) = self.by {
            marks.extend(grip.marks(scope));
        }
        let is_handled = !matches!(self.by, By::Way(_)) && scope.shown.jam.is_none();
        marks.extend(at.filter(|_| is_handled).map(|at| {
            let beside = at + DVec2::new(16.0, -10.0) * scope.scale;
            Mark::Words(beside, self.change(scope, at, in_steps).words(scope, &self.what))
        }));
        marks
    }

    /// Time passes with the pointer at a pixel; infinitely much at the end. Returns where they are to go, if it is time to say so.
    fn pass(&mut self, scope: Scope<'_>, at: DVec2, (seconds, in_steps): (f64, bool)) -> Option<HaulWay> {
        self.since += seconds;
        if self.since < EVERY {
            return None;
        }
        // Whatever it does next begins now.
        self.since = 0.0;
        let all = self.change(scope, at, in_steps);
        self.meant = Some(((at, in_steps), all));
        let about = match self.by {
            By::Way(_) => DVec3::ZERO,
            By::Handle(grip) => grip.about().extend(0.0),
            By::Ring(grip) => grip.about(),
        };
        let height = scope.camera.viewport()[1] as f64 / scope.camera.pixels_per_metre();
        let (what, pins) = (self.what.clone(), self.pins.clone());
        let (dimensions, goes_on) = (scope.shown.dimensions, self.goes_on);
        let way = HaulWay { what, pins, all, about, height, dimensions, goes_on };
        if !self.goes_on && way.rest(way.begin()).is_none() {
            return None;
        }
        self.goes_on = true;
        Some(way)
    }
}

impl Hand {
    /// Whether obstacles go after the pointer.
    pub(in crate::app) fn is_hauling(&self) -> bool {
        matches!(self.doing, Doing::Hauling(_))
    }

    /// Where obstacles that are dragged go now, `seconds` after the last time: while time runs.
    pub(in crate::app) fn haul(&mut self, scope: Scope<'_>, at: DVec2, seconds: f64) -> Option<HaulWay> {
        if let Some(haul) = self.begins_to_haul(scope, at) {
            self.doing = Doing::Hauling(haul);
        }
        let in_steps = self.shift;
        match &mut self.doing {
            Doing::Hauling(haul) => haul.pass(scope, at, (seconds, in_steps)),
            _ => None,
        }
    }

    /// A drag of obstacles alone takes them along.
    fn begins_to_haul(&self, scope: Scope<'_>, at: DVec2) -> Option<Haul> {
        if self.is_still {
            return None;
        }
        if let Doing::Carrying(hold, what) = &self.doing {
            // What the hand pressed on.
            let is_dragged = what.points.is_empty() && is_drag(scope, [hold.at, at]);
            return is_dragged.then(|| Haul::new(scope, what.clone(), By::Way(hold.place)));
        }
        let what = self.chosen(scope).filter(|chosen| chosen.points.is_empty())?;
        match self.doing {
            Doing::Moving(hold, _) if is_drag(scope, [hold.at, at]) => {
                Some(Haul::new(scope, what, By::Way(hold.place)))
            }
            Doing::Handling(grip) => Some(Haul::new(scope, what, By::Handle(grip))),
            Doing::Turning(grip) => Some(Haul::new(scope, what, By::Ring(grip))),
            _ => None,
        }
    }

    /// A drag of bodies alone, none of them held, leads all of their points while time runs. Returns what is done first, if it begins now.
    pub(in crate::app) fn lead_bodies(&mut self, scope: Scope<'_>, at: DVec2) -> Option<Vec<Do>> {
        let Doing::Moving(hold, _) = self.doing else { return None };
        if self.is_still || !is_drag(scope, [hold.at, at]) {
            return None;
        }
        let chosen = self.chosen(scope).filter(|chosen| chosen.obstacles.is_empty())?;
        if chosen.points.iter().any(|point| scope.is_pinned(*point)) {
            return None;
        }
        let middle = chosen.middle(scope);
        self.beside = middle - scope.facing(middle, hold.at);
        self.doing = Doing::Grabbing(chosen.points.clone());
        let to = Some(self.led_to(scope.camera.cursor(at.to_array())));
        let commands = vec![Do::Cursor { to, by: None }, Do::Grab(Reach::Points(chosen.points))];
        Some(commands)
    }
}
