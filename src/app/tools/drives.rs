//! The tool for motors: bodies turn about a hinge, by a motor if one likes.

use std::borrow::Cow;

use glam::DVec2;

use super::Deed;
use super::hinge::{Hinge, IN_SPACE, Meant, pins};
use super::hub::{Hub, Hubs, props_of};
use super::marks::{Mark, Role};
use super::muscles::{MuscleChoice, no_muscles};
use super::pick::Scope;
use crate::app::action::Tool;
use crate::history::{DeleteKeys, Do};
use crate::scene::{AddKeys, DriveKeys, KeyName};
use crate::sim::drive::RATE;
use crate::sim::{Angle, AngleDrive, Driving, PointId};

/// A motor that is this much stronger or weaker than another is the same `[1]`.
const SAME_TORQUE: f64 = 0.1;

/// Said where nothing is clicked that could be hinged.
const NO_BODY: &str = "no body lies here that could be hinged";
/// Said of a hinge without a motor where the switch asks for none.
const HINGED: &str = "a hinge is here already: tick \"motor\" to give it one, Shift+click to take it away";

/// Said where two bodies overlap that are hinged elsewhere.
const JOINED: &str = "these two are hinged already, at the ring: Shift+click takes that hinge away";

/// Said where a hinge that a motor was offered for is gone, or has one.
const NO_HINGE: &str = "no hinge is here any more that could get a motor";

/// Said of a hinge that no other body holds.
const TO_BACKGROUND: &str = "its axle is pinned to the background, so what it is on turns in place; clicked where two bodies overlap it joins them";

/// What a hinge gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct MotorChoice {
    /// It has a motor, or has none; `None`: what is round has one on the ground, and all else has none.
    pub(in crate::app) is_on: Option<bool>,
    /// Anticlockwise `[rad/s]`.
    pub(in crate::app) speed: f64,
    /// `[N m]`; `None`: what moves the body that it is on, as `effort` works it out.
    pub(in crate::app) torque: Option<f64>,
    /// Its speed follows a wave of this period `[s]` and phase `[rad]`.
    pub(in crate::app) has_wave: bool,
    pub(in crate::app) period: f64,
    pub(in crate::app) phase: f64,
    pub(in crate::app) key: Option<KeyName>,
    pub(in crate::app) back: Option<KeyName>,
    /// How quickly it comes and goes with its key `[1/s]`.
    pub(in crate::app) rate: f64,
}

/// What both tools make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Drives {
    pub(in crate::app) muscle: MuscleChoice,
    pub(in crate::app) motor: MotorChoice,
}

impl Default for Drives {
    fn default() -> Self {
        Drives {
            muscle: MuscleChoice::default(),
            motor: MotorChoice {
                is_on: None,
                speed: -6.0,
                torque: None,
                has_wave: false,
                period: 1.0,
                phase: 0.0,
                key: None,
                back: None,
                rate: RATE,
            },
        }
    }
}

impl MotorChoice {
    /// Those of a motor that gives this torque `[N m]`.
    pub(super) fn keys(&self, torque: f64) -> DriveKeys {
        DriveKeys {
            speed: Some(self.speed),
            torque: Some(torque),
            period: self.has_wave.then_some(self.period),
            phase: self.has_wave.then_some(self.phase),
            key: self.key,
            back: self.key.and(self.back).filter(|back| Some(*back) != self.key),
            rate: self.key.map(|_| self.rate),
            ..DriveKeys::default()
        }
    }
}

impl Drives {
    /// A hinge comes where a body is clicked; one that is there gets a motor, or loses it, or goes as a whole.
    pub(super) fn press_motor(&self, scope: Scope<'_>, at: DVec2, takes_away: bool) -> Deed {
        match Meant::at(scope, at, self.motor.is_on) {
            None => Deed::words(NO_BODY.to_owned()),
            Some(Err(why)) => Deed::words(why.to_owned()),
            Some(Ok(Meant::There(hub))) => self.change(scope, &hub, takes_away).1,
            Some(Ok(Meant::Joined(hub))) if takes_away => self.change(scope, &hub, true).1,
            Some(Ok(Meant::Joined(_))) => Deed::words(JOINED.to_owned()),
            Some(Ok(Meant::New(hinge))) => {
                if let Some(why) = no_motors(scope.shown.driving).filter(|_| hinge.has_motor) {
                    return Deed::words(why);
                }
                let is_wanted = self.motor.is_on != Some(false);
                let can_turn = is_wanted && hinge.joins_a_wheel(scope) && no_motors(scope.shown.driving).is_none();
                let motor_for = can_turn.then_some(PointId(scope.shown.point_count() as u32));
                let name = if hinge.has_motor { "motor" } else { "hinge" };
                let words = hinge.struts.is_empty().then(|| format!("{name}: {TO_BACKGROUND}"));
                Deed {
                    commands: hinge.commands(scope, &self.motor),
                    edit: Some(name),
                    words,
                    motor_for,
                    ..Deed::default()
                }
            }
        }
    }

    /// Whether the hinge that a click would mean has a motor; `None`: it would mean none that is there.
    pub(super) fn hinge_at(&self, scope: Scope<'_>, at: DVec2) -> Option<bool> {
        match Meant::at(scope, at, self.motor.is_on)?.ok()? {
            Meant::There(hub) | Meant::Joined(hub) => Some(!hub.motors.is_empty()),
            Meant::New(_) => None,
        }
    }

    /// The hinge about a hub gets the motor of the panel, whatever the switch there says.
    pub(super) fn give_motor(&self, scope: Scope<'_>, hub: PointId) -> Deed {
        let motor = MotorChoice { is_on: Some(true), ..self.motor };
        let hubs = scope.is_there(hub).then(|| Hubs::of(scope, hub));
        match hubs.as_ref().and_then(|hubs| hubs.at(hub)).filter(|hub| hub.motors.is_empty()) {
            Some(hub) => Drives { motor, ..*self }.change(scope, hub, false).1,
            None => Deed::words(NO_HINGE.to_owned()),
        }
    }

    /// What a click does with a hinge that is there, in words and as a deed.
    fn change(&self, scope: Scope<'_>, hub: &Hub, takes_away: bool) -> (Cow<'static, str>, Deed) {
        if takes_away {
            let points = std::iter::once(hub.point).chain(props_of(scope, hub.point)).map(|point| point.0).collect();
            return (
                "a click takes the hinge away".into(),
                Deed::edit("hinge away", Do::Delete(DeleteKeys { points, ..DeleteKeys::default() })),
            );
        }
        let without = Do::Delete(DeleteKeys {
            points: hub.motor_props(scope).iter().map(|point| point.0).collect(),
            angles: hub.motors.iter().map(|angle| angle.number).collect(),
            ..DeleteKeys::default()
        });
        let hinge = Hinge::of(scope, hub);
        let is_off = self.motor.is_on == Some(false);
        match hub.motors.is_empty() {
            false if is_off || self.is_set(scope, hub, &hinge) => (
                "a click takes the motor off; Shift+click takes the hinge away".into(),
                Deed::edit("motor off", without),
            ),
            true if is_off => (HINGED.into(), Deed::words(HINGED.to_owned())),
            has_none => {
                if let Some(why) = no_motors(scope.shown.driving) {
                    return (why.clone().into(), Deed::words(why));
                }
                let props = Hinge::prop(scope, &hinge, hub.is_pinned);
                let reference = hinge.struts.first().map_or(scope.shown.point_count() as u32, |strut| strut.0);
                let keys = AddKeys {
                    points: (!props.is_empty())
                        .then(|| pins(props, hinge.mass(scope), scope.shown.point_count() as u32)),
                    angles: hinge.motors(scope, &self.motor, [reference, hub.point.0]),
                    ..AddKeys::default()
                };
                let mut deed = Deed::edit("motor", Do::Add(Box::new(keys)));
                if !has_none {
                    deed.commands.insert(0, without);
                }
                let words = if has_none {
                    "a click gives it a motor; Shift+click takes the hinge away"
                } else {
                    "a click gives it this motor instead"
                };
                (words.into(), deed)
            }
        }
    }

    /// Whether the motors of a hinge are what a click would make them.
    fn is_set(&self, scope: Scope<'_>, hub: &Hub, hinge: &Hinge) -> bool {
        let is_same = |angle: &Angle| {
            let Some(AngleDrive::Motor { torque, .. }) = angle.drive else { return false };
            self.motor.keys(torque).told_angle().ok() == angle.drive
        };
        // A soft body bears less than is wished, and by its shape of now: whatever it bears is the same wish.
        let (there, would) = (hub.torque(), hinge.torque(scope, &self.motor));
        let wished = hinge.wished(scope, &self.motor);
        let is_bounded = |torque: f64| torque < (1.0 - SAME_TORQUE) * wished;
        let is_as_strong = (there - would).abs() <= SAME_TORQUE * would || (is_bounded(there) && is_bounded(would));
        hub.motors.iter().all(is_same) && is_as_strong
    }

    /// What a click with the tool for motors would do.
    pub(super) fn mark_motor(&self, scope: Scope<'_>, at: DVec2, takes_away: bool) -> Vec<Mark> {
        let hinge = match Meant::at(scope, at, self.motor.is_on) {
            None => return Vec::new(),
            Some(Err(why)) => return vec![Mark::Words(beside(scope, at), why.to_owned())],
            Some(Ok(Meant::Joined(hub))) if !takes_away => {
                let mut marks = Hinge::of(scope, &hub).marks(scope, [Role::Hold; 2]);
                marks.push(Mark::Words(beside(scope, at), JOINED.to_owned()));
                return marks;
            }
            Some(Ok(Meant::There(hub) | Meant::Joined(hub))) => {
                let role = if takes_away { Role::Away } else { Role::Hold };
                let (words, _) = self.change(scope, &hub, takes_away);
                let mut marks = Hinge::of(scope, &hub).marks(scope, [role; 2]);
                marks.push(Mark::Words(beside(scope, at), words.into_owned()));
                return marks;
            }
            Some(Ok(Meant::New(hinge))) => hinge,
        };
        if let Some(why) = no_motors(scope.shown.driving).filter(|_| hinge.has_motor) {
            return vec![Mark::Words(beside(scope, at), why)];
        }
        let mut marks = hinge.marks(scope, [Role::Come, Role::Hold]);
        let what = if hinge.has_motor { "a motor" } else { "a hinge" };
        let on = match hinge.struts.is_empty() {
            false => "joins both bodies",
            true if hinge.has_motor && hinge.rests(scope) => {
                "on the ground: its axle is pinned to the background, just high enough to turn freely in place"
            }
            true if hinge.has_motor => "pinned to the background: it turns in place",
            true => "pinned to the background: it swings about it",
        };
        let strength = if hinge.has_motor { self.strength(scope, &hinge) } else { String::new() };
        marks.push(Mark::Words(beside(scope, at), format!("{what} {on}{strength}")));
        marks
    }

    /// How strong the motor of a hinge is going to be, as it ends a line; nothing of one that is as strong as was asked for and turns it.
    fn strength(&self, scope: Scope<'_>, hinge: &Hinge) -> String {
        let (torque, needed) = (hinge.torque(scope, &self.motor), hinge.needed(scope, self.motor.speed));
        let needs = if torque < needed { format!(", it needs about {needed:.0}") } else { String::new() };
        match torque < hinge.wished(scope, &self.motor) {
            true => format!(", {torque:.1} N m: more would tear it{needs}"),
            false if self.motor.torque.is_none() || torque < needed => format!(", {torque:.0} N m{needs}"),
            false => String::new(),
        }
    }
}

/// Why no hinge can have a motor in what is shown, if none can.
pub(in crate::app) fn no_motors(driving: Driving) -> Option<String> {
    let Driving { solver, is_in_space, .. } = driving;
    let knows_none = driving.of_motor().is_some() || solver.form_refusal().is_some();
    let words = || format!("solver {solver} knows no motors: \"automatic\" does");
    is_in_space.then(|| IN_SPACE.to_owned()).or_else(|| knows_none.then(words))
}

/// What a scene lacks for a tool, if it cannot be taken there.
pub(in crate::app) fn lack_of(tool: Tool, driving: Driving) -> Option<String> {
    match tool {
        Tool::Muscle => no_muscles(driving),
        Tool::Motor => no_motors(driving),
        _ => None,
    }
}

/// Where words beside the pointer begin.
pub(super) fn beside(scope: Scope<'_>, at: DVec2) -> DVec2 {
    at + DVec2::new(14.0, -10.0) * scope.scale
}
