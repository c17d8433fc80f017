//! One rigid body: what it is made of, its motion, and its flight where nothing touches it.
//!
//! ```text
//! free      c' = v,  v' = g - gamma v,  theta' = omega,  omega' = -gamma omega      in closed form
//! pinned    I omega' = d x m g                                                      by the middle of the way, composed to order 4
//! pushed    m v' = sum m_i a_i,  I omega' = sum r_i x m_i a_i                       by the middle of the way: the mouse, forces, gusts
//! ```

use std::cell::Cell;
use std::sync::Arc;

use super::course::{HANGING, TURN, within};
use super::fall::Fall;
use super::field::{Field, From, Push};
use super::hull::hull;
use super::inertia::{Inertia, Inertial};
use super::motion::{Motion, Pose, Twist};
use super::place::Place;
use super::shape::Shape;
use super::solid::{Parts, Solid, exact};
use super::touch::Near;
use crate::sim::force::wind::OF_A_GUST;
use crate::sim::integrate::composed::COMPOSED_4;
use crate::sim::ledger::Book;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, cross, dot, flat, length, scale, sub};

/// Share of its motion that drag takes in a part of a step, up to which a composition that goes back in time is of use.
const WEAK: f64 = 0.1;

/// A rigid body.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub(super) shape: Arc<Shape>,
    /// Its points in the group, in the order of the shape.
    pub(super) slots: Vec<u32>,
    /// The corners of its convex hull: what can meet planes.
    pub(super) hull: Vec<u32>,
    /// How far its points are from the origin of the shape, at most `[m]`.
    pub(super) reach: f64,
    pub(super) inertia: Inertia,
    /// Points of the shape that meet nothing, ascending.
    pub(super) deaf: Vec<u32>,
}

impl Body {
    pub(super) fn new(shape: Arc<Shape>, slots: Vec<u32>, deaf: Vec<u32>) -> Self {
        let reach = shape.places.iter().map(|q| dot(*q, *q)).fold(0.0, f64::max).sqrt();
        let ease = if shape.pin.is_some() { 0.0 } else { 1.0 / shape.mass };
        let inertia = Inertia { inverse: [ease, 1.0 / shape.inertia] };
        Body { hull: hull(&shape.places, 0.0), slots, reach, inertia, deaf, shape }
    }

    /// Where the shape fits the places of points best by mass, and the motion that has their momentum and angular momentum.
    ///
    /// Sums are taken about one point, and moved to the middle afterwards.
    pub(super) fn read<S: Real, const D: usize>(&self, points: &Points<S, D>) -> Motion {
        let Shape { places, masses, mass, inertia, pin, .. } = &*self.shape;
        let Points { position, velocity, position_lost, velocity_lost, .. } = points;
        let base = exact(position, position_lost, self.slots[pin.map_or(0, |(pin, _)| pin as usize)]);
        let (mut way, mut momentum, mut turning) = ([0.0; 2], [0.0; 2], 0.0);
        let mut fit = [0.0; 2];
        for ((&slot, &q), &m) in self.slots.iter().zip(places).zip(masses) {
            let r = scale(sub(exact(position, position_lost, slot), base), m);
            let v = exact(velocity, velocity_lost, slot);
            way = add(way, r);
            fit = add(fit, [dot(q, r), cross(q, r)]);
            momentum = add(momentum, scale(v, m));
            turning += cross(r, v);
        }
        way = scale(way, 1.0 / mass);
        let size = dot(fit, fit).sqrt();
        let turn = if size > 0.0 { scale(fit, 1.0 / size) } else { [1.0, 0.0] };
        let (middle, velocity, turning) = match pin {
            Some(_) => (base, [0.0; 2], turning),
            None => (add(base, way), scale(momentum, 1.0 / mass), turning - cross(way, momentum)),
        };
        Motion { place: Place { middle, angle: 0.0, turn }, twist: Twist { velocity, spin: turning / inertia } }
    }

    /// The middle of its mass `[m]`.
    pub(super) fn centre(&self, place: &Place) -> [f64; 2] {
        self.shape.pin.map_or(place.middle, |(_, centre)| add(place.middle, place.turned(centre)))
    }

    /// Half of the way says what pushes on all of it.
    fn go<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        book: Option<&mut Book>,
    ) -> Motion {
        let early = self.drift(motion, field, (&self.pushes(&motion.place, field, t), 0.5 * h), None);
        self.drift(motion, field, (&self.pushes(&early.place, field, t + 0.5 * h), h), book)
    }

    /// Under constant pushes, gravity and drag: in closed form.
    pub(super) fn drift<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (pushes, h): (&[Push], f64),
        book: Option<&mut Book>,
    ) -> Motion {
        let Motion { place, twist } = motion;
        let rate = field.pull.drag_rate;
        let Fall { keep, time, late } = Fall::of(rate, h);
        let is_pinned = self.shape.pin.is_some();
        let g = if is_pinned { [0.0; 2] } else { flat(field.pull.gravity) };
        let [ease, swing] = self.inertia.inverse;
        let sum =
            |sum: ([f64; 2], f64), push: &Push| (add(sum.0, scale(push.force, ease)), sum.1 + push.torque * swing);
        let (a, turning) = pushes.iter().fold((g, 0.0), sum);
        let way = add(scale(twist.velocity, time), scale(a, late));
        let turn = twist.spin * time + turning * late;
        let velocity = add(scale(twist.velocity, keep), scale(a, time));
        let end = Motion {
            place: place.moved(way, turn),
            twist: Twist { velocity, spin: twist.spin * keep + turning * time },
        };
        if let Some(book) = book {
            let still = if is_pinned { [0.0; 2] } else { flat(field.around.gravity) };
            let wind = self.shape.mass * dot(sub(g, still), way);
            let mut given = self.shape.mass * dot(g, way);
            book.wind += wind;
            for push in pushes {
                let work = dot(push.force, way) + push.torque * turn;
                given += work;
                push.from.book(book, work);
            }
            if rate != 0.0 {
                book.drag += given - (self.inertia.energy(&end.twist) - self.inertia.energy(twist));
            }
        }
        end
    }

    /// What pushes it at a place at time `t` `[s]`, but for gravity of what is free.
    pub(super) fn pushes<S: Real, const D: usize>(&self, place: &Place, field: &Field<S, D>, t: f64) -> Vec<Push> {
        let mut list = Vec::new();
        if let Some((_, centre)) = self.shape.pin {
            let torque = |g: [f64; 2]| self.shape.mass * cross(place.turned(centre), g);
            let mut note = |from: From, g: [f64; 2]| list.push(Push { from, force: [0.0; 2], torque: torque(g) });
            let (all, still) = (flat(field.pull.gravity), flat(field.around.gravity));
            note(From::Gravity, still);
            if all != still {
                note(From::Wind, sub(all, still));
            }
        }
        list.extend(field.on(self, place, t));
        list
    }
}

impl Solid<2> for Body {
    type Place = Place;
    type Inertia<'a> = Inertia;

    #[inline]
    fn parts(&self) -> Parts<'_, 2> {
        Parts { slots: &self.slots, places: &self.shape.places, masses: &self.shape.masses }
    }

    #[inline]
    fn reach(&self) -> f64 {
        self.reach
    }

    #[inline]
    fn corners(&self) -> &[u32] {
        &self.hull
    }

    #[inline]
    fn meets(&self, point: u32) -> bool {
        self.deaf.binary_search(&point).is_err()
    }

    #[inline]
    fn is_pinned(&self) -> bool {
        self.shape.pin.is_some()
    }

    #[inline]
    fn inertia(&self, _place: &Place) -> Inertia {
        self.inertia
    }

    #[inline]
    fn frame(normal: [f64; 2]) -> [[f64; 2]; 2] {
        [normal, [-normal[1], normal[0]]]
    }

    /// The first and the last along the surface.
    fn outermost(&self, place: &Place, [_, tangent]: &[[f64; 2]; 2], points: &[u32]) -> Vec<usize> {
        let along: Vec<f64> =
            points.iter().map(|&point| dot(*tangent, place.out(self.shape.places[point as usize]))).collect();
        let by = |a: &usize, b: &usize| along[*a].total_cmp(&along[*b]);
        let (low, high) = ((0..points.len()).min_by(by), (0..points.len()).max_by(by));
        low.into_iter().chain(high.filter(|high| Some(*high) != low)).collect()
    }

    fn swung(&self, place: &Place, arm: [f64; 2], normal: [f64; 2], gap: f64) -> Option<(Place, f64)> {
        let by = -gap / cross(arm, normal);
        Some((place.moved([0.0; 2], by), by))
    }

    /// Forces are taken as those of the middle of the way, and drag in closed form: order 2, and stable whatever the drag. A pendulum that
    /// hardly anything slows is composed of such steps to order 4.
    fn fly<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        (_, mut book): (&Cell<u64>, Option<&mut Book>),
    ) -> Motion {
        if self.shape.pin.is_none() && !field.pushes() {
            return self.drift(motion, field, (&[], h), book);
        }
        if field.pushes() || field.pull.drag_rate * h > WEAK {
            return self.go(motion, field, (t, h), book);
        }
        let (mut motion, mut now) = (*motion, t);
        for share in COMPOSED_4 {
            motion = self.go(&motion, field, (now, share * h), book.as_deref_mut());
            now += share * h;
        }
        motion
    }

    fn coast(&self, motion: &Motion, h: f64, _spent: &Cell<u64>) -> Motion {
        let Motion { place, twist } = motion;
        Motion { place: place.moved(scale(twist.velocity, h), twist.spin * h), twist: *twist }
    }

    fn kicked<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        span: (f64, f64),
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> Twist {
        self.fly(motion, field, span, spent).twist
    }

    fn longest<S: Real, const D: usize>(&self, field: &Field<S, D>, h: f64) -> f64 {
        let longest = field.longest(h);
        let Some((_, centre)) = self.shape.pin else { return longest };
        let torque = self.shape.mass * length(centre) * length(field.pull.gravity);
        longest.min(within(HANGING, h)).min(TURN / (torque * self.inertia.inverse[1]).sqrt())
    }

    fn longest_turned(&self, turned: f64) -> f64 {
        if self.shape.pin.is_some() { turned } else { f64::INFINITY }
    }

    fn work_in_flight<S: Real, const D: usize>(&self, field: &Field<S, D>) -> u64 {
        let of_gusts = if field.pull.gusts().is_some() { OF_A_GUST } else { 0 };
        let of_pushes = if field.pushes() { 30 } else { 0 };
        100 + 2 * (of_gusts + of_pushes) * self.slots.len() as u64
    }

    fn work_of_a_look(&self, near: &Near) -> u64 {
        20 * (self.hull.len() + self.slots.len() * usize::from(near.has_walls)) as u64
    }
}
