//! How a rigid body in space answers to impulses at the points that touch something.

use super::body::Body;
use super::motion::{Motion, Twist};
use super::place::Place;
use super::touch::tangents;
use crate::sim::contact::coulomb::disc::{Grip, Trio, Yields};
use crate::sim::vector::{add, cross3, dot, scale, sub};

/// A point of the body on a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// From the origin `[m]`.
    pub(super) arm: [f64; 3],
    /// Away from the surface, then the two tangents.
    pub(super) ways: [[f64; 3]; 3],
    pub(super) grip: Grip,
}

impl Contact {
    pub(super) fn new(arm: [f64; 3], normal: [f64; 3], grip: Grip) -> Self {
        let [x, y] = tangents(normal);
        Contact { arm, ways: [normal, x, y], grip }
    }

    /// A vector along the normal and the tangents.
    #[inline(always)]
    pub(super) fn seen(&self, v: [f64; 3]) -> Trio {
        let [n, x, y] = self.ways;
        [dot(n, v), dot(x, v), dot(y, v)]
    }

    /// Its velocity along the normal and the tangents.
    #[inline(always)]
    pub(super) fn speeds(&self, twist: &Twist) -> Trio {
        self.seen(twist.at(self.arm))
    }

    /// Its velocity along the surface, in the world.
    pub(super) fn sliding(&self, twist: &Twist) -> [f64; 3] {
        let v = twist.at(self.arm);
        sub(v, scale(self.ways[0], dot(self.ways[0], v)))
    }

    /// The same as a vector of the world.
    #[inline(always)]
    pub(super) fn out(&self, [n, x, y]: Trio) -> [f64; 3] {
        add(scale(self.ways[0], n), add(scale(self.ways[1], x), scale(self.ways[2], y)))
    }
}

/// One body, where it is, and where it touches.
pub(super) struct Alone<'a> {
    pub(super) body: &'a Body,
    pub(super) place: &'a Place,
    pub(super) contacts: &'a [Contact],
}

impl Alone<'_> {
    /// What the law asks of each contact.
    pub(super) fn grips(&self) -> Vec<Grip> {
        self.contacts.iter().map(|contact| contact.grip).collect()
    }
}

impl Yields for Alone<'_> {
    type Motion = Twist;

    fn speeds(&self, contact: usize, twist: &Twist) -> Trio {
        self.contacts[contact].speeds(twist)
    }

    fn gives(&self, contact: usize) -> [Trio; 3] {
        let Contact { arm, ways, .. } = &self.contacts[contact];
        let spins = ways.map(|way| self.body.spin(self.place, cross3(*arm, way)));
        std::array::from_fn(|r| {
            std::array::from_fn(|c| {
                let ease = if r == c { self.body.ease } else { 0.0 };
                ease + dot(cross3(*arm, ways[r]), spins[c])
            })
        })
    }

    fn pushed(&self, contact: usize, impulse: Trio, twist: &Twist) -> Twist {
        let contact = &self.contacts[contact];
        let impulse = contact.out(impulse);
        Twist {
            velocity: add(twist.velocity, scale(impulse, self.body.ease)),
            spin: add(twist.spin, self.body.spin(self.place, cross3(contact.arm, impulse))),
        }
    }

    fn energy(&self, twist: &Twist) -> f64 {
        self.body.energy(&Motion { place: *self.place, twist: *twist })
    }

    fn stopped(&self) -> Twist {
        Twist::STILL
    }

    fn mass(&self) -> f64 {
        self.body.shape.mass
    }
}
