//! Motors that give all their torque and turn nothing.

use std::collections::BTreeMap;

use glam::DVec2;

use super::effort;
use super::hinge::{Hinge, place};
use super::hub::Hubs;
use super::marks::Mark;
use super::pick::Scope;
use super::touching::{stands_against, touches};
use crate::app::player::Shown;
use crate::sim::{Angle, AngleDrive, Key, PointId};

/// A motor stalls that turns less than this share of its speed `[1]` for so long `[s]`.
const SHARE: f64 = 0.1;
const PATIENCE: f64 = 1.0;
/// How far below a hub the words about it stand `[logical px]`.
const BELOW: f64 = 34.0;
/// Of more motors none is looked at.
const MOST: usize = 64;

/// A motor as it was last seen to turn.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    /// `[s]`
    time: f64,
    /// `[rad]`
    angle: f64,
}

/// Which motors stall, from one frame to the next.
#[derive(Clone, Debug, Default)]
pub(in crate::app) struct Stalls {
    /// By the numbers of their angles.
    seen: BTreeMap<u32, Seen>,
    /// The last time of the scene `[s]`, and of which topology it was.
    last: (f64, u64),
    /// The hubs of those that stall and how fast they are to turn `[rad/s]`.
    stalled: BTreeMap<PointId, f64>,
}

impl Stalls {
    /// Looks at what is shown, while these keys are held; returns whether other motors stall than before.
    pub(in crate::app) fn look(&mut self, shown: &Shown, held: &[Key]) -> bool {
        let now = (shown.figures.time, shown.topology);
        if now.0 < self.last.0 || now.1 != self.last.1 {
            self.seen.clear();
        }
        self.last = now;
        let motors = shown.scenery.angles.iter().filter_map(|angle| Some((angle, wanted(angle, held)?)));
        let motors: Vec<(&Angle, f64)> = motors.take(MOST + 1).collect();
        let mut stalled = BTreeMap::new();
        if motors.len() <= MOST {
            self.seen.retain(|number, _| motors.iter().any(|(angle, _)| angle.number == *number));
            for (angle, speed) in motors {
                if self.stands(shown, angle, speed) {
                    stalled.insert(angle.points[1], speed);
                }
            }
        }
        let is_new = !stalled.keys().eq(self.stalled.keys());
        self.stalled = stalled;
        is_new
    }

    /// Whether a motor has not turned for a while.
    fn stands(&mut self, shown: &Shown, angle: &Angle, speed: f64) -> bool {
        let now = Seen { time: shown.figures.time, angle: turned(shown, angle) };
        let seen = self.seen.entry(angle.number).or_insert(now);
        let apart = (now.angle - seen.angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
        if (apart - std::f64::consts::PI).abs() > SHARE * speed.abs() * PATIENCE {
            *seen = now;
        }
        now.time - seen.time > PATIENCE
    }

    /// What is said beside those that stall; the words of two that stand side by side keep off each other.
    pub(in crate::app) fn marks(&self, scope: Scope<'_>) -> Vec<Mark> {
        let [width, height] = scope.camera.viewport().map(|side| side as u32);
        let words = |(&hub, &speed): (&PointId, &f64)| {
            let at = scope.pixel(hub)? + DVec2::new(0.0, BELOW) * scope.scale;
            Some(Mark::Label(at, words(scope, hub, speed)?, [0, 0, width, height]))
        };
        self.stalled.iter().filter_map(words).collect()
    }
}

/// How fast a motor is to turn while these keys are held `[rad/s]`; `None`: not at all, or by a wave.
fn wanted(angle: &Angle, held: &[Key]) -> Option<f64> {
    let AngleDrive::Motor { speed, signal, .. } = angle.drive? else { return None };
    let is_on =
        signal.held.is_none_or(|keys| held.contains(&keys.forth) != keys.back.is_some_and(|key| held.contains(&key)));
    (is_on && signal.wave.is_none() && speed != 0.0).then_some(speed)
}

/// The angle between its arms `[rad]`.
fn turned(shown: &Shown, angle: &Angle) -> f64 {
    let [reference, hub, rim] = angle.points.map(|point| {
        let [x, y, _] = shown.place(point.index());
        DVec2::new(x, y)
    });
    (reference - hub).angle_to(rim - hub)
}

/// What a motor gives that stalls, and what it needs.
fn words(scope: Scope<'_>, hub: PointId, speed: f64) -> Option<String> {
    let hubs = Hubs::of(scope, hub);
    let hub = hubs.at(hub)?;
    let rim = hub.motors.first()?.points[2];
    let turning = hubs.piece(rim);
    let holder = hub.sides.iter().flatten().find(|point| turning.binary_search(point).is_err());
    let holder = holder.map(|&point| hubs.piece(point)).unwrap_or_default();
    let at = place(scope, hub.point);
    let reach = turning.iter().map(|&point| place(scope, point).distance(at)).fold(0.0, f64::max);
    let rubs = !holder.is_empty() || touches(scope, &turning, reach);
    let (given, needed) = (hub.torque(), effort::needed(scope, at, [&turning, &holder], (speed, rubs)));
    let bears = Hinge::of(scope, hub).bears(scope);
    let is_against = [&turning, &holder].into_iter().any(|points| stands_against(scope, points, reach));
    let why = match given < needed {
        _ if is_against => "it stands against a wall".to_owned(),
        true if bears < needed => format!(
            "needs about {:.0} N m, more than its soft body bears: make that wood or steel",
            effort::said(needed)
        ),
        true => format!("needs about {:.0} N m", effort::said(needed)),
        false => "something holds it".to_owned(),
    };
    Some(format!("stalls with {given:.0} N m: {why}"))
}
