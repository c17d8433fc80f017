//! A rigid body in space where nothing touches it.
//!
//! ```text
//! free      c' = v,  v' = g - gamma v    in closed form;  the turn by its series (`spin.rs`)
//! pinned    the turn with its weight, by its series
//! pushed    by forces and torques of the middle of the way: the mouse, forces, gusts
//! ```

use std::cell::Cell;

use super::body::Body;
use super::place::Place;
use super::spin::{OF_A_PART, Torque, turned};
use super::{Motion, Twist};
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::rigid::fall::Fall;
use crate::sim::rigid::field::{self, Field};
use crate::sim::rigid::inertia::Inertial;
use crate::sim::rigid::motion::Pose;
use crate::sim::rigid::solid::Solid;
use crate::sim::vector::{add, dot, embed, scale, sub};

/// What pushes a body in space.
type Push = field::Push<[f64; 3], 3>;

impl Body {
    /// Under constant pushes, gravity and drag.
    pub(super) fn drift<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (pushes, h): (&[Push], f64),
        (spent, book): (&Cell<u64>, Option<&mut Book>),
    ) -> Motion {
        let Motion { place, twist } = motion;
        let rate = field.pull.drag_rate;
        let Fall { keep, time, late } = Fall::of(rate, h);
        let g = embed(field.pull.gravity);
        let is_free = self.ease > 0.0;
        let (force, torque) = sum_of(pushes);
        let a = if is_free { add(g, scale(force, self.ease)) } else { [0.0; 3] };
        let way = add(scale(twist.velocity, time), scale(a, late));
        let velocity = add(scale(twist.velocity, keep), scale(a, time));
        let weight = if is_free { [0.0; 3] } else { place.back(scale(g, self.shape.mass)) };
        let by = Torque { torque: place.back(torque), weight, drag_rate: rate };
        let turned = turned(&self.shape, place.back(twist.spin), &by, h);
        spent.set(spent.get() + OF_A_PART * u64::from(turned.parts));
        let place = if turned.parts == 0 {
            Place { middle: add(place.middle, way), ..*place }
        } else {
            place.moved(way, turned.turn)
        };
        let end = Motion { place, twist: Twist { velocity, spin: place.turned(turned.spin) } };
        if let Some(book) = book {
            let fallen = sub(self.centre(&end.place), self.centre(&motion.place));
            // Works of torques are those by the mean spin.
            let turn = scale(add(twist.spin, end.twist.spin), 0.5 * h);
            self.book(book, field, (motion, &end), (pushes, [fallen, way, turn]));
        }
        end
    }

    /// What gravity, wind and pushes gave on a way of the middle of the mass, and of the origin, and by a turn; drag took the rest.
    pub(super) fn book<S: Real, const D: usize>(
        &self,
        book: &mut Book,
        field: &Field<S, D>,
        (start, end): (&Motion, &Motion),
        (pushes, [fallen, way, turn]): (&[Push], [[f64; 3]; 3]),
    ) {
        let (g, still) = (embed(field.pull.gravity), embed(field.around.gravity));
        let mut given = self.shape.mass * dot(g, fallen);
        book.wind += self.shape.mass * dot(sub(g, still), fallen);
        for push in pushes {
            let work = dot(push.force, way) + dot(push.torque, turn);
            given += work;
            push.from.book(book, work);
        }
        if field.pull.drag_rate != 0.0 {
            let energy = |motion: &Motion| self.inertia(&motion.place).energy(&motion.twist);
            book.drag += given - (energy(end) - energy(start));
        }
    }
}

pub(super) fn sum_of(pushes: &[Push]) -> ([f64; 3], [f64; 3]) {
    pushes.iter().fold(([0.0; 3], [0.0; 3]), |sum, push| (add(sum.0, push.force), add(sum.1, push.torque)))
}
