//! What joins rigid bodies, and where its ends are: joints and rods, whose lengths may follow drives, and points that do not move by themselves.

use super::motion::{Motion, Pose};
use crate::sim::drive::{Drive, Keys};
use crate::sim::vector::{add, scale};

/// An end of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    /// A place of a body, in its shape.
    On {
        /// Which one.
        body: u32,
        /// `[m]`
        place: [f64; 2],
    },
    /// One of the points that do not move by themselves.
    Fixed(u32),
}

/// Two ends that are one point, or keep their distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    pub(crate) ends: [End; 2],
    /// `[m]`; `None`: a joint.
    pub(crate) rest: Option<f64>,
    /// What the length follows.
    pub(crate) drive: Option<Drive>,
}

/// When it is, for lengths that follow drives.
#[derive(Clone, Copy)]
pub(crate) struct Clock<'a> {
    /// `[s]`
    pub(crate) time: f64,
    pub(crate) keys: &'a Keys,
}

impl Link {
    /// How long a rod is `[m]`.
    pub(super) fn length(&self, clock: Option<Clock>) -> Option<f64> {
        match (self.drive, clock) {
            (Some(drive), Some(Clock { time, keys })) => self.rest.map(|rest| drive.rest(rest, time, keys)),
            _ => self.rest,
        }
    }

    /// How fast that grows `[m/s]`.
    pub(super) fn growth(&self, clock: Option<Clock>) -> f64 {
        match (self.drive, clock, self.rest) {
            (Some(drive), Some(Clock { time, keys }), Some(rest)) => drive.growth(rest, time, keys),
            _ => 0.0,
        }
    }
}

/// A point that does not move by itself: where it is as a step begins `[m]`, and how fast it is led in it `[m/s]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anchor {
    pub(crate) place: [f64; 2],
    pub(crate) velocity: [f64; 2],
}

impl Anchor {
    pub(super) fn is_led(&self) -> bool {
        self.velocity != [0.0; 2]
    }
}

/// Whether any of these points is led.
pub(super) fn are_led(anchors: &[Anchor]) -> bool {
    anchors.iter().any(Anchor::is_led)
}

/// Where bodies are, and fixed points, so long `[s]` after the step began.
#[derive(Clone, Copy)]
pub(crate) struct Stand<'a> {
    pub(crate) motions: &'a [Motion],
    pub(crate) anchors: &'a [Anchor],
    pub(crate) since: f64,
    /// `None`: nothing is driven.
    pub(crate) clock: Option<Clock<'a>>,
}

impl Stand<'_> {
    /// Where an end is `[m]`.
    pub(super) fn at(&self, end: End) -> [f64; 2] {
        match end {
            End::On { body, place } => self.motions[body as usize].place.out(place),
            End::Fixed(k) => {
                let Anchor { place, velocity } = self.anchors[k as usize];
                add(place, scale(velocity, self.since))
            }
        }
    }

    /// How fast it goes `[m/s]`.
    pub(super) fn velocity(&self, end: End) -> [f64; 2] {
        match end {
            End::On { body, place } => {
                let Motion { place: at, twist } = self.motions[body as usize];
                twist.at(at.turned(place))
            }
            End::Fixed(k) => self.anchors[k as usize].velocity,
        }
    }
}
