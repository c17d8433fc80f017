//! A rigid body in space where nothing touches it.
//!
//! ```text
//! free      c' = v,  v' = g - gamma v    in closed form;  the turn by its series (`spin.rs`)
//! pinned    the turn with its weight, by its series
//! pushed    by forces and torques of the middle of the way: the mouse, forces, gusts
//! ```

use std::cell::Cell;

use super::body::Body;
use super::motion::{Motion, Twist};
use super::place::Place;
use super::spin::{OF_A_PART, Torque, turned};
use crate::sim::force::mouse;
use crate::sim::ledger::Book;
use crate::sim::real::Real;
use crate::sim::rigid::body::{Field, From, fallen};
use crate::sim::vector::{add, cross3, dot, embed, scale, sub, truncate, widen, zero};

/// What pushes a body: a force `[N]`, and a torque about the origin of the shape `[N m]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push {
    from: From,
    force: [f64; 3],
    torque: [f64; 3],
}

/// What drag and a push of 1 make of a motion in a time: the share of a velocity that is kept, and how far it leads; how fast such a push makes
/// it, and how far that leads.
struct Fall {
    keep: f64,
    time: f64,
    late: f64,
}

impl Fall {
    fn of(rate: f64, h: f64) -> Self {
        if rate == 0.0 {
            return Fall { keep: 1.0, time: h, late: 0.5 * h * h };
        }
        let time = -libm::expm1(-rate * h) / rate;
        Fall { keep: libm::exp(-rate * h), time, late: fallen(rate, h, time) }
    }
}

impl Body {
    /// On for `h` from `t` `[s]` where nothing touches it. Works and losses are booked where there is a book, and what it takes counts as spent.
    ///
    /// What is pushed takes forces as those of the middle of the way: order 2.
    pub(super) fn fly<S: Real, const D: usize>(
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
        let early = self.drift(motion, field, (&self.pushes(&motion.place, field, t), 0.5 * h), (spent, None));
        self.drift(motion, field, (&self.pushes(&early.place, field, t + 0.5 * h), h), (spent, book))
    }

    /// Under constant pushes, gravity and drag.
    fn drift<S: Real, const D: usize>(
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
    fn book<S: Real, const D: usize>(
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
            match push.from {
                From::Gravity | From::Ties => {}
                From::Mouse => book.mouse += work,
                From::Forces => book.forces += work,
                From::Wind => book.wind += work,
            }
        }
        if field.pull.drag_rate != 0.0 {
            book.drag += given - (self.energy(end) - self.energy(start));
        }
    }

    /// The motion after `h` `[s]` of what pushes it from `t` on where it is, as if it stood there: forces, gravity and drag.
    pub(super) fn kicked<S: Real, const D: usize>(
        &self,
        motion: &Motion,
        field: &Field<S, D>,
        (t, h): (f64, f64),
        book: Option<&mut Book>,
    ) -> Twist {
        let Motion { place, twist } = motion;
        let Fall { keep, time, .. } = Fall::of(field.pull.drag_rate, h);
        let g = embed(field.pull.gravity);
        let pushes = if field.pushes() { self.pushes(place, field, t) } else { Vec::new() };
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

    /// On for `h` `[s]` by its own motion alone: nothing pushes or slows it.
    pub(super) fn coast(&self, motion: &Motion, h: f64, spent: &Cell<u64>) -> Motion {
        let Motion { place, twist } = motion;
        let turned = turned(&self.shape, place.back(twist.spin), &Torque::NONE, h);
        spent.set(spent.get() + OF_A_PART * u64::from(turned.parts));
        let place = place.moved(scale(twist.velocity, h), turned.turn);
        Motion { place, twist: Twist { velocity: twist.velocity, spin: place.turned(turned.spin) } }
    }

    /// What pushes it at a place at time `t` `[s]`, but for gravity.
    fn pushes<S: Real, const D: usize>(&self, place: &Place, field: &Field<S, D>, t: f64) -> Vec<Push> {
        let mut list = Vec::new();
        let mut note = |from: From, (force, torque): ([f64; 3], [f64; 3])| list.push(Push { from, force, torque });
        if field.is_reached
            && let Some((force, cursor)) = field.around.mouse_at(t)
        {
            let push = mouse::Push::<f64, D>::new(force, cursor);
            note(From::Mouse, self.sum(place, |_, x| push.acceleration(truncate(x)).map(embed)));
        }
        if !field.pull.thrusts.is_empty() {
            note(From::Forces, self.driven(place, field));
        }
        if let Some(air) = field.pull.gusts() {
            let gust = |x: [f64; 3]| Some(scale(embed(air.gust(truncate(x), t)), field.pull.drag_rate));
            note(From::Wind, self.sum(place, |_, x| gust(x)));
        }
        list
    }

    /// Force `[N]` and torque `[N m]` of constant forces.
    fn driven<S: Real, const D: usize>(&self, place: &Place, field: &Field<S, D>) -> ([f64; 3], [f64; 3]) {
        let mut x: Vec<[S; D]> = vec![zero(); field.w.len()];
        for (&slot, &q) in self.slots.iter().zip(&self.shape.places) {
            x[slot as usize] = truncate::<D>(place.out(q)).map(S::from_f64);
        }
        let mut pushes = vec![[0.0; 3]; field.w.len()];
        for thrust in &field.pull.thrusts {
            thrust.each(&x, field.w, |i, push| pushes[i] = add(pushes[i], embed(widen(push))));
        }
        self.sum(place, |slot, _| Some(pushes[slot as usize]))
    }

    /// Force and torque of accelerations of its points, by their slots and places.
    fn sum(&self, place: &Place, of: impl Fn(u32, [f64; 3]) -> Option<[f64; 3]>) -> ([f64; 3], [f64; 3]) {
        let (mut force, mut torque) = ([0.0; 3], [0.0; 3]);
        for ((&slot, &q), &m) in self.slots.iter().zip(&self.shape.places).zip(&self.shape.masses) {
            let r = place.turned(q);
            if let Some(a) = of(slot, add(place.middle, r)) {
                let push = scale(a, m);
                force = add(force, push);
                torque = add(torque, cross3(r, push));
            }
        }
        (force, torque)
    }
}

fn sum_of(pushes: &[Push]) -> ([f64; 3], [f64; 3]) {
    pushes.iter().fold(([0.0; 3], [0.0; 3]), |sum, push| (add(sum.0, push.force), add(sum.1, push.torque)))
}
