//! Motors of a selection: how fast and how strong they turn, and by which keys.

use std::collections::BTreeMap;

use super::facts::Span;
use super::{Among, AngleAs, Common};
use crate::app::alike::alike;
use crate::history::{Do, DriveOrNone, SetKeys};
use crate::scene::{DriveKeys, KeyName};
use crate::sim::{Angle, AngleDrive, Dynamics, Held, PointId};

/// What is changed of motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotorChange {
    /// Anticlockwise `[rad/s]`.
    Speed(f64),
    /// Of all that turns about one hinge together `[N m]`, > 0.
    Torque(f64),
    /// The key that has to be held, and the one that turns it back; `None`: always on.
    Keys(Option<KeyName>, Option<KeyName>),
}

/// The motors of a selection, by the hinges that have some.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Motors {
    /// Anticlockwise `[rad/s]`.
    pub(in crate::app) speed: Span,
    /// Of each hinge `[N m]`.
    pub(in crate::app) torque: Span,
    /// The key that has to be held, and the one that turns it back.
    pub(in crate::app) keys: Common<[Option<KeyName>; 2]>,
}

/// The angles with motors about each hub.
fn hinges(world: &dyn Dynamics, among: &Among) -> BTreeMap<PointId, Vec<Angle>> {
    let mut hinges: BTreeMap<PointId, Vec<Angle>> = BTreeMap::new();
    for angle in among.angles_of(world, AngleAs::Motor) {
        hinges.entry(angle.points[1]).or_default().push(angle);
    }
    hinges
}

/// Speed `[rad/s]`, torque `[N m]` and keys of a motor.
fn numbers(angle: &Angle) -> Option<(f64, f64, [Option<KeyName>; 2])> {
    let AngleDrive::Motor { speed, torque, signal } = angle.drive? else { return None };
    Some((speed, torque, keys(signal.held)))
}

fn keys(held: Option<Held>) -> [Option<KeyName>; 2] {
    let Some(Held { forth, back, .. }) = held else { return [None; 2] };
    [Some(forth), back].map(|key| key?.name().parse().ok())
}

/// What motors there are among points; `None`: none.
pub(super) fn shown(world: &dyn Dynamics, among: &Among) -> Option<Motors> {
    let hinges = hinges(world, among);
    let all = || hinges.values().flatten().filter_map(numbers);
    let torque = |angles: &Vec<Angle>| angles.iter().filter_map(numbers).map(|(_, torque, _)| torque).sum();
    Some(Motors {
        speed: Span::of(all().map(|(speed, ..)| speed))?.evened(),
        torque: Span::of(hinges.values().map(torque))?.evened(),
        keys: Common::of(all().map(|(_, _, keys)| keys))?,
    })
}

/// The commands of a change; all else of each motor stays.
pub(super) fn changed(world: &dyn Dynamics, among: &Among, change: MotorChange) -> Vec<Do> {
    let hinges = hinges(world, among);
    let of = |angles: &Vec<Angle>| -> Vec<(DriveKeys, u32)> {
        let count = angles.len() as f64;
        angles.iter().filter_map(|angle| Some((with(angle.drive?.into(), change, count), angle.number))).collect()
    };
    let set = |(drive, numbers): (DriveKeys, Vec<u32>)| {
        let drive = Some(DriveOrNone::This(drive));
        Do::Set(Box::new(SetKeys { angles: Some(numbers), drive, ..SetKeys::default() }))
    };
    alike(hinges.values().flat_map(of)).into_iter().map(set).collect()
}

/// The keys of a drive that is one of so many about a hinge, changed.
fn with(drive: DriveKeys, change: MotorChange, count: f64) -> DriveKeys {
    match change {
        MotorChange::Speed(speed) => DriveKeys { speed: Some(speed), ..drive },
        MotorChange::Torque(torque) => DriveKeys { torque: Some(torque / count), ..drive },
        MotorChange::Keys(key, back) => {
            let back = key.and(back).filter(|back| Some(*back) != key);
            DriveKeys { key, back, rate: key.and(drive.rate), ..drive }
        }
    }
}
