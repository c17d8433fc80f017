//! Strings between bodies: rigid bonds that act on one side of their length only.
//!
//! ```text
//! longest     |x_a - x_b| <= rest      pulls its ends together, never apart
//! shortest    |x_a - x_b| >= rest      pushes them apart
//! ```
//!
//! That is a contact without friction: where it gets to its length is located, it gives nothing back, and it lets go when it would have to act
//! the other way.

use super::body::Body;
use super::contact::Contact;
use super::link::{End, Stand};
use super::meeting::Meeting;
use super::motion::Pose;
use super::solid::Solid;
use crate::sim::contact::coulomb::Rub;
use crate::sim::vector::{add, cross, dot, scale, sub};

/// A string, or a strut that may part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strand {
    pub(crate) ends: [End; 2],
    /// `[m]`, > 0.
    pub(crate) rest: f64,
    /// It keeps its ends no further apart; else no nearer.
    pub(crate) is_longest: bool,
}

impl Strand {
    /// By how much it may still give `[m]`; below 0 it is beyond its length.
    pub(super) fn gap(&self, stand: Stand) -> f64 {
        let [a, b] = self.ends.map(|end| stand.at(end));
        let over = self.rest - dot(sub(a, b), sub(a, b)).sqrt();
        if self.is_longest { over } else { -over }
    }

    /// The direction in which it pushes its first end.
    fn normal(&self, stand: Stand) -> [f64; 2] {
        let [a, b] = self.ends.map(|end| stand.at(end));
        let d = sub(b, a);
        let length = dot(d, d).sqrt();
        let along = if length > 0.0 { scale(d, 1.0 / length) } else { [1.0, 0.0] };
        if self.is_longest { along } else { scale(along, -1.0) }
    }

    /// Its ends as the law has them.
    pub(super) fn meeting(&self, stand: Stand) -> Meeting {
        let normal = self.normal(stand);
        let (mut legs, mut lead) = (Vec::new(), 0.0);
        for (end, sign) in self.ends.into_iter().zip([1.0, -1.0]) {
            let normal = scale(normal, sign);
            match end {
                End::On { body, place } => {
                    let arm = stand.motions[body as usize].place.turned(place);
                    legs.push((body, Contact { arm, ways: Body::frame(normal), rub: Rub::SMOOTH }));
                }
                End::Fixed(_) => lead += dot(stand.velocity(end), normal),
            }
        }
        Meeting::string(legs, lead)
    }

    /// How fast its ends go, one with the other's speed `[m/s]`, at most: what turns bodies, and joints that pull them along, apart.
    pub(super) fn most_rate(&self, stand: Stand) -> f64 {
        let speed = |end: End| {
            let v = stand.velocity(end);
            dot(v, v).sqrt()
        };
        self.ends.map(speed).iter().sum()
    }

    /// How fast it turns `[rad/s]`.
    pub(super) fn turning(&self, stand: Stand) -> f64 {
        let [a, b] = self.ends.map(|end| stand.at(end));
        let [u, v] = self.ends.map(|end| stand.velocity(end));
        let (d, rate) = (sub(a, b), add(u, scale(v, -1.0)));
        let square = dot(d, d);
        if square > 0.0 { cross(d, rate).abs() / square } else { 0.0 }
    }
}
