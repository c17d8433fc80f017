//! What a rigid body is in space, for all that bodies in the plane and in space do alike.

use std::cell::Cell;

use super::body::Body;
use super::flight::sum_of;
use super::inertia::Inertia;
use super::place::Place;
use super::shape::Hold;
use super::spin::{OF_A_PART, Torque, turned};
use super::{Motion, Twist};
use crate::sim::force::wind::OF_A_GUST;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::rigid::fall::Fall;
use crate::sim::rigid::field::Field;
use crate::sim::rigid::hull::hull;
use crate::sim::rigid::motion::Pose;
use crate::sim::rigid::solid::{Parts, Solid};
use crate::sim::rigid::touch::Near;
use crate::sim::vector::{add, cross3, dot, embed, length, scale};

/// Share of the square of a body's size by which a corner of what touches a surface is off the line of those beside it.
const CORNER: f64 = 1e-9;

impl Solid<3> for Body {
    type Place = Place;
    type Inertia<'a> = Inertia<'a>;

    #[inline]
    fn parts(&self) -> Parts<'_, 3> {
        Parts { slots: &self.slots, places: &self.shape.places, masses: &self.shape.masses }
    }

    #[inline]
    fn reach(&self) -> f64 {
        self.reach
    }

    #[inline]
    fn corners(&self) -> &[u32] {
        &self.shape.corners
    }

    #[inline]
    fn meets(&self, point: u32) -> bool {
        self.shape.pins.binary_search(&point).is_err()
    }

    #[inline]
    fn is_pinned(&self) -> bool {
        self.shape.hold != Hold::Free
    }

    fn is_fixed(&self) -> bool {
        self.shape.hold == Hold::Fixed
    }

    #[inline]
    fn inertia<'a>(&'a self, place: &'a Place) -> Inertia<'a> {
        Inertia { body: self, place }
    }

    #[inline]
    fn frame(normal: [f64; 3]) -> [[f64; 3]; 3] {
        let [x, y] = tangents(normal);
        [normal, x, y]
    }

    /// The corners around them.
    fn outermost(&self, place: &Place, [_, x, y]: &[[f64; 3]; 3], points: &[u32]) -> Vec<usize> {
        if points.len() < 3 {
            return (0..points.len()).collect();
        }
        let at = |&point: &u32| place.turned(self.shape.places[point as usize]);
        let places: Vec<[f64; 2]> = points.iter().map(at).map(|r| [dot(*x, r), dot(*y, r)]).collect();
        hull(&places, CORNER * self.reach * self.reach).into_iter().map(|k| k as usize).collect()
    }

    /// A pin holds it there.
    fn swung(&self, _place: &Place, _arm: [f64; 3], _normal: [f64; 3], _gap: f64) -> Option<(Place, f64)> {
        None
    }

    /// What is pushed takes forces as those of the middle of the way: order 2.
    fn fly<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        (spent, book): (&Cell<u64>, Option<&mut Book>),
    ) -> Motion {
        if self.is_fixed() {
            return Motion { twist: Twist::STILL, ..*motion };
        }
        if !field.pushes() {
            return self.drift(motion, field, (&[], h), (spent, book));
        }
        let early = self.drift(motion, field, (&field.on(self, &motion.place, t), 0.5 * h), (spent, None));
        self.drift(motion, field, (&field.on(self, &early.place, t + 0.5 * h), h), (spent, book))
    }

    fn coast(&self, motion: &Motion, h: f64, spent: &Cell<u64>) -> Motion {
        let Motion { place, twist } = motion;
        let turned = turned(&self.shape, place.back(twist.spin), &Torque::NONE, h);
        spent.set(spent.get() + OF_A_PART * u64::from(turned.parts));
        let place = place.moved(scale(twist.velocity, h), turned.turn);
        Motion { place, twist: Twist { velocity: twist.velocity, spin: place.turned(turned.spin) } }
    }

    fn kicked<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        (_, book): (&Cell<u64>, Option<&mut Book>),
    ) -> Twist {
        let Motion { place, twist } = motion;
        let Fall { keep, time, .. } = Fall::of(field.pull.drag_rate, h);
        let g = embed(field.pull.gravity);
        let pushes = if field.pushes() { field.on(self, place, t) } else { Vec::new() };
        let (force, mut torque) = sum_of(&pushes);
        let is_free = self.ease > 0.0;
        let a = if is_free { add(g, scale(force, self.ease)) } else { [0.0; 3] };
        if !is_free {
            torque = add(torque, cross3(place.turned(self.shape.centre), scale(g, self.shape.mass)));
        }
        let turning = add(scale(self.turning(place, twist.spin), keep), scale(torque, time));
        let velocity = add(scale(twist.velocity, keep), scale(a, time));
        let end = Twist { velocity, spin: self.spin(place, turning) };
        if let Some(book) = book {
            // As far as it gets by the mean of both motions.
            let [way, turn] =
                [(twist.velocity, end.velocity), (twist.spin, end.spin)].map(|(a, b)| scale(add(a, b), 0.5 * h));
            let fallen = Twist { velocity: way, spin: turn }.at(place.turned(self.shape.centre));
            self.book(book, field, (motion, &Motion { twist: end, ..*motion }), (&pushes, [fallen, way, turn]));
        }
        end
    }

    fn longest<S: Real, const D: usize>(&self, field: &Field<S, D>, h: f64) -> f64 {
        field.longest(h)
    }

    /// Flights are right however far it turns.
    fn longest_turned(&self, _turned: f64) -> f64 {
        f64::INFINITY
    }

    fn work_in_flight<S: Real, const D: usize>(&self, field: &Field<S, D>) -> u64 {
        let of_gusts = if field.pull.gusts().is_some() { OF_A_GUST } else { 0 };
        let of_pushes = if field.pushes() { 40 } else { 0 };
        100 + 2 * (of_gusts + of_pushes) * self.slots.len() as u64
    }

    fn work_of_a_look(&self, near: &Near) -> u64 {
        12 * (self.shape.corners.len() * near.planes.len()) as u64
    }
}

/// Two unit vectors across a unit vector and each other: with it a right-handed three.
fn tangents(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let [x, y, z] = normal.map(f64::abs);
    let away = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let first = cross3(normal, away);
    let first = scale(first, 1.0 / length(first));
    [first, cross3(normal, first)]
}
