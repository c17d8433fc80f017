//! A pin that is led by the hand: it stays a pin, which bears any load, and goes along short straight ways after the cursor.

use glam::{DVec2, DVec3};

use super::Scope;
use crate::sim::PointId;

/// A pin is sent on its way so often at most `[s]`: each time its body is compiled anew.
const EVERY: f64 = 0.1;
/// A cursor that moved less has not been dragged yet `[logical px]`: a click moves no pin.
const LEAST: f64 = 3.0;

/// A pin, and the plane that it is led in: in space the one across the ray of the press.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lead {
    point: PointId,
    place: DVec3,
    normal: DVec3,
    /// Where the press was, and where the cursor was when it was sent last `[px]`.
    pressed: DVec2,
    sent: Option<DVec2>,
    /// Since then `[s]`.
    since: f64,
}

/// Where a pin is to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct PinWay {
    pub(in crate::app) point: PointId,
    /// `[m]`
    pub(in crate::app) to: [f64; 3],
    /// It was sent before, since it was pressed on.
    pub(in crate::app) goes_on: bool,
}

impl Lead {
    /// The pin that a pixel means, if it means one.
    pub(super) fn of_pin(scope: Scope<'_>, at: DVec2) -> Option<Self> {
        let point = scope.nearest(at)?.point;
        if !scope.is_pinned(point) {
            return None;
        }
        let place = DVec3::from(scope.shown.place(point.index()));
        let normal = DVec3::from(scope.camera.cursor(at.to_array()).direction);
        Some(Lead { point, place, normal, pressed: at, sent: None, since: f64::INFINITY })
    }

    pub(super) fn point(&self) -> PointId {
        self.point
    }

    /// Time passes with the cursor at a pixel; infinitely much at the end. Returns where the pin is to go now, if that is new.
    pub(super) fn pass(&mut self, scope: Scope<'_>, at: DVec2, seconds: f64) -> Option<PinWay> {
        self.since += seconds;
        let is_dragged = self.sent.is_some() || at.distance(self.pressed) >= LEAST * scope.scale;
        if !is_dragged || self.sent == Some(at) || self.since < EVERY {
            return None;
        }
        let cursor = scope.camera.cursor(at.to_array());
        let (origin, direction) = (DVec3::from(cursor.origin), DVec3::from(cursor.direction));
        let along = direction.dot(self.normal);
        if along.abs() < 1e-6 {
            return None;
        }
        let to = origin + ((self.place - origin).dot(self.normal) / along) * direction;
        let goes_on = self.sent.replace(at).is_some();
        self.since = 0.0;
        Some(PinWay { point: self.point, to: to.to_array(), goes_on })
    }
}
