//! One rigid body: what it is made of, its motion, and its flight where nothing touches it.
//!
//! ```text
//! free      c' = v,  v' = g - gamma v,  theta' = omega,  omega' = -gamma omega      in closed form
//! pinned    I omega' = d x m g                                                      by the middle of the way, composed to order 4
//! pushed    m v' = sum m_i a_i,  I omega' = sum r_i x m_i a_i                       by the middle of the way: the mouse, forces, gusts
//! ```

use std::sync::Arc;

use super::inertia::Inertia;
use super::motion::{Motion, Twist};
use super::place::Place;
use super::shape::Shape;
use crate::sim::environment::Environment;
use crate::sim::force::mouse;
use crate::sim::integrate::composed::COMPOSED_4;
use crate::sim::ledger::Book;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{add, cross, dot, flat, scale, sub, widen};

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

/// What acts on a body in a step.
pub(super) struct Field<'a, S: Real, const D: usize> {
    pub(super) pull: &'a Pull<S, D>,
    pub(super) around: &'a Environment<D>,
    /// Inverse masses of the group's points `[1/kg]`.
    pub(super) w: &'a [S],
    /// The mouse may push some of its points in the step.
    pub(super) is_reached: bool,
}

impl<S: Real, const D: usize> Field<'_, S, D> {
    /// Whether anything pushes points that is not the same everywhere.
    pub(super) fn pushes(&self) -> bool {
        self.is_reached || self.pull.has_fields()
    }

    fn gravity(&self) -> [f64; 2] {
        flat(self.pull.gravity)
    }
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

    /// Whether its points are where the shape has them and go as it does, but for rounding.
    pub(super) fn fits<S: Real, const D: usize>(&self, motion: &Motion, points: &Points<S, D>) -> bool {
        const ROUNDED: f64 = 64.0;
        let Motion { place, twist } = motion;
        let size = |x: [f64; 2]| 1.0 + self.reach + x[0].abs() + x[1].abs();
        let rounded = ROUNDED * S::EPSILON.to_f64();
        let near = rounded * size(place.middle);
        let slow = rounded * (size(twist.velocity) + self.reach * twist.spin.abs());
        let is_there = |(&slot, &q): (&u32, &[f64; 2])| {
            let r = place.turned(q);
            let at = |list: &[[S; D]]| flat(widen(list[slot as usize]));
            let off = sub(at(&points.position), add(place.middle, r));
            let faster = sub(at(&points.velocity), twist.at(r));
            off.iter().all(|off| off.abs() <= near) && faster.iter().all(|faster| faster.abs() <= slow)
        };
        self.slots.iter().zip(&self.shape.places).all(is_there)
    }

    /// Its points follow.
    pub(super) fn write<S: Real, const D: usize>(&self, motion: &Motion, points: &mut Points<S, D>) {
        let Motion { place, twist } = motion;
        for (&slot, &q) in self.slots.iter().zip(&self.shape.places) {
            let i = slot as usize;
            if points.inverse_mass[i] == S::ZERO {
                continue;
            }
            let r = place.turned(q);
            set(&mut points.position[i], points.position_lost.get_mut(i), add(place.middle, r));
            set(&mut points.velocity[i], points.velocity_lost.get_mut(i), twist.at(r));
        }
    }

    /// The middle of its mass `[m]`.
    pub(super) fn centre(&self, place: &Place) -> [f64; 2] {
        self.shape.pin.map_or(place.middle, |(_, centre)| add(place.middle, place.turned(centre)))
    }

    /// On for `h` `[s]` where nothing touches it. Works and losses are booked where there is a book.
    ///
    /// Forces are taken as those of the middle of the way, and drag in closed form: order 2, and stable whatever the drag. A pendulum that
    /// hardly anything slows is composed of such steps to order 4.
    pub(super) fn fly<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        mut book: Option<&mut Book>,
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
        let (keep, time) = if rate == 0.0 { (1.0, h) } else { (libm::exp(-rate * h), -libm::expm1(-rate * h) / rate) };
        // The integral of what a push of 1 has given by then.
        let late = if rate == 0.0 { 0.5 * h * h } else { fallen(rate, h, time) };
        let is_pinned = self.shape.pin.is_some();
        let g = if is_pinned { [0.0; 2] } else { field.gravity() };
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
                match push.from {
                    From::Gravity | From::Ties => {}
                    From::Mouse => book.mouse += work,
                    From::Forces => book.forces += work,
                    From::Wind => book.wind += work,
                }
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
        let mut note = |from: From, (force, torque): ([f64; 2], f64)| list.push(Push { from, force, torque });
        if let Some((_, centre)) = self.shape.pin {
            let of = |g: [f64; 2]| ([0.0; 2], self.shape.mass * cross(place.turned(centre), g));
            let (all, still) = (field.gravity(), flat(field.around.gravity));
            note(From::Gravity, of(still));
            if all != still {
                note(From::Wind, of(sub(all, still)));
            }
        }
        if field.is_reached
            && let Some((force, cursor)) = field.around.mouse_at(t)
        {
            let push = mouse::Push::<f64, D>::new(force, cursor);
            note(From::Mouse, self.sum(place, |_, x| push.acceleration(lift(x)).map(flat)));
        }
        if !field.pull.thrusts.is_empty() {
            note(From::Forces, self.driven(place, field));
        }
        if let Some(air) = field.pull.gusts() {
            let gust = |x: [f64; 2]| Some(scale(flat(air.gust(lift(x), t)), field.pull.drag_rate));
            note(From::Wind, self.sum(place, |_, x| gust(x)));
        }
        list
    }

    /// Force `[N]` and torque `[N m]` of constant forces.
    fn driven<S: Real, const D: usize>(&self, place: &Place, field: &Field<S, D>) -> ([f64; 2], f64) {
        let mut x = vec![[S::ZERO; D]; field.w.len()];
        for (&slot, &q) in self.slots.iter().zip(&self.shape.places) {
            x[slot as usize] = lift(place.out(q));
        }
        let mut pushes = vec![[0.0; 2]; field.w.len()];
        for thrust in &field.pull.thrusts {
            thrust.each(&x, field.w, |i, push| pushes[i] = add(pushes[i], flat(widen(push))));
        }
        self.sum(place, |slot, _| Some(pushes[slot as usize]))
    }

    /// Force and torque of accelerations of its points, by their slots and places.
    fn sum(&self, place: &Place, of: impl Fn(u32, [f64; 2]) -> Option<[f64; 2]>) -> ([f64; 2], f64) {
        let (mut force, mut torque) = ([0.0; 2], 0.0);
        for ((&slot, &q), &m) in self.slots.iter().zip(&self.shape.places).zip(&self.shape.masses) {
            let r = place.turned(q);
            if let Some(a) = of(slot, add(place.middle, r)) {
                force = add(force, scale(a, m));
                torque += m * cross(r, a);
            }
        }
        (force, torque)
    }
}

/// What pushes a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push {
    pub(super) from: From,
    /// `[N]`, and about the origin of the shape `[N m]`.
    pub(super) force: [f64; 2],
    pub(super) torque: f64,
}

/// Where a push comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum From {
    Gravity,
    Ties,
    Mouse,
    Forces,
    Wind,
}

/// The integral of (1 - exp(-rate s))/rate over s from 0 to h, `time` its integrand at h: by its series where the difference rounds.
pub(super) fn fallen(rate: f64, h: f64, time: f64) -> f64 {
    let x = rate * h;
    if x.abs() > 1e-2 {
        return (h - time) / rate;
    }
    h * h * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0 - x / 5040.0)))))
}

/// What is known of a number, with what rounding took from it where that is kept.
#[inline(always)]
fn exact<S: Real, const D: usize>(list: &[[S; D]], lost: &[[S; D]], slot: u32) -> [f64; 2] {
    let i = slot as usize;
    let x = [list[i][0].to_f64(), list[i][1].to_f64()];
    if lost.is_empty() { x } else { [x[0] + lost[i][0].to_f64(), x[1] + lost[i][1].to_f64()] }
}

/// In the plane of a world.
#[inline(always)]
pub(super) fn lift<S: Real, const D: usize>(x: [f64; 2]) -> [S; D] {
    std::array::from_fn(|k| if k < 2 { S::from_f64(x[k]) } else { S::ZERO })
}

/// A vector and what rounding takes from it, where that is kept, along the axes that both have.
#[inline(always)]
pub(super) fn set<S: Real, const D: usize, const E: usize>(
    value: &mut [S; D],
    lost: Option<&mut [S; D]>,
    exact: [f64; E],
) {
    for (value, exact) in value.iter_mut().zip(exact) {
        *value = S::from_f64(exact);
    }
    for (lost, (value, exact)) in lost.into_iter().flatten().zip(value.iter().zip(exact)) {
        *lost = S::from_f64(exact - value.to_f64());
    }
}

/// The corners of the convex hull of places (Andrew's monotone chain), in the order around it; `least`: twice the area that one has at least
/// with those beside it `[m^2]`.
pub(super) fn hull(places: &[[f64; 2]], least: f64) -> Vec<u32> {
    if places.len() == 1 {
        return vec![0];
    }
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    let at = |k: u32| places[k as usize];
    order.sort_by(|&a, &b| at(a)[0].total_cmp(&at(b)[0]).then(at(a)[1].total_cmp(&at(b)[1])));
    let mut corners: Vec<u32> = Vec::new();
    for half in [order.clone(), order.into_iter().rev().collect()] {
        let start = corners.len();
        for k in half {
            while corners.len() >= start + 2 {
                let [a, b] = [corners[corners.len() - 2], corners[corners.len() - 1]];
                if cross(sub(at(b), at(a)), sub(at(k), at(b))) > least {
                    break;
                }
                corners.pop();
            }
            corners.push(k);
        }
        corners.pop();
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_square_with_points_within_is_its_corners() {
        let places = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [0.5, 1.5]];
        assert_eq!(hull(&places, 0.0), [0, 1, 3, 4]);
    }

    #[test]
    fn what_falls_against_drag_is_in_closed_form_on_both_sides_of_the_series() {
        for rate in [1e-9, 0.3, 0.59, 0.61, 40.0] {
            let h = 1.0 / 60.0;
            let time = -libm::expm1(-rate * h) / rate;
            // Simpson's rule over many parts.
            let parts = 1000;
            let at = |k: i32| {
                let s = h * f64::from(k) / f64::from(2 * parts);
                -libm::expm1(-rate * s) / rate
            };
            let sum: f64 = (0..parts).map(|k| at(2 * k) + 4.0 * at(2 * k + 1) + at(2 * k + 2)).sum();
            let expected = sum * h / f64::from(6 * parts);
            assert!((fallen(rate, h, time) / expected - 1.0).abs() < 1e-11, "{rate}");
        }
    }
}
