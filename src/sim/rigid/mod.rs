//! Rigid bodies: what rigid bonds hold in its shape has three degrees of freedom in the plane, whatever it is made of.
//!
//! ```text
//! read       place, angle, velocity and spin from the points: best fit, momentum and angular momentum
//! part       of the step: all of it in flight, shorter near surfaces, under the mouse, on a pin
//! flight     in closed form, or a composition of order 4 (`body.rs`)
//! hit        the moment when a point gets to a surface is located (`course.rs`, `touch.rs`); the impact is Coulomb's law (`strike.rs`)
//! rest       what lies on surfaces slides, rolls, tips or stays (`slide.rs`); where sliding ends is located
//! write      points follow, once a step
//! ```
//!
//! Nothing is kept between steps but the points themselves: any copy goes on with the same bits.

mod body;
mod course;
pub(crate) mod place;
pub(crate) mod shape;
mod slide;
mod strike;
mod touch;

use std::sync::Arc;

use super::account::Account;
use super::bulk::kernel::Kernel;
use super::bulk::mover::Mover;
use super::counters::Counters;
use super::environment::Environment;
use super::points::Points;
use super::pull::Pull;
use super::real::Real;
use super::swept::Swept;
use super::vector::{add, length};
use body::{Body, Field, Motion, lift};
use course::Log;
use shape::Shape;
use touch::way;

/// Rigid bodies that step together.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    bodies: Arc<[Body]>,
    /// Rigid bonds that they are made of.
    bonds: usize,
    /// Points of those that left the finite numbers: they are where their step began.
    lost: Vec<u32>,
}

impl Rigid {
    /// Of shapes, each with its points in the group, made of so many bonds.
    pub(crate) fn new(shapes: Vec<(Arc<Shape>, Vec<u32>)>, bonds: usize) -> Self {
        Rigid {
            bodies: shapes.into_iter().map(|(shape, slots)| Body::new(shape, slots)).collect(),
            bonds,
            lost: Vec::new(),
        }
    }
}

impl<S: Real, const D: usize> Mover<S, D> for Rigid {
    /// Points that are elsewhere get the places that the shape has for them.
    fn begin(&mut self, points: &mut Points<S, D>) {
        for body in self.bodies.iter() {
            let motion = body.read(points);
            if !body.fits(&motion, points) {
                body.write(&motion, points);
            }
        }
    }

    fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        account: Option<&mut Account>,
    ) {
        let mut book = account.map(|account| &mut account.book);
        for body in self.bodies.iter() {
            let motion = body.read(points);
            let far = body.reach + way(&motion, h, length(pull.gravity) + pull.most_push() + around.most_push());
            let middle = motion.place.middle;
            let bounds = [-far, far].map(|far| lift::<S, D>([middle[0] + far, middle[1] + far]));
            let field = Field { pull, around, w: &points.inverse_mass, is_reached: around.may_reach(bounds, (t, h)) };
            let moving = || {
                let each = body.slots.iter().map(|&slot| slot as usize);
                each.map(|i| (points.position[i], points.velocity[i]))
            };
            let parts = if field.is_reached { around.parts_near(moving(), (t, h)) } else { 1 };
            let mut log = Log { hits: 0, work: 0, book: book.as_deref_mut() };
            let longest = body.longest(&field, h).min(h / f64::from(parts));
            let end = body.advance(motion, &field, (t, h, longest), &mut log);
            let is_reached = field.is_reached;
            if end.is_finite() {
                body.write(&end, points);
            } else {
                self.lost.extend(&body.slots);
            }
            let count = body.slots.len() as u64;
            counters.substeps += 1;
            counters.points_moved += count;
            counters.mouse_points += if is_reached { count } else { 0 };
            counters.events += log.hits;
            counters.work += 60 * count + log.work;
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    /// A body that spins leaves the straight ways of its points: it stays in a circle around its middle.
    fn reaches(&self, points: &Points<S, D>, (h, pushed): (f64, f64)) -> Vec<Swept<S, D>> {
        let swept = |body: &Body| {
            let Motion { place, twist } = body.read(points);
            let bent = pushed + twist.spin * twist.spin * body.reach;
            let at = |&slot: &u32| (points.position[slot as usize], points.velocity[slot as usize]);
            let tight = Swept::new(body.slots.iter().map(at), (h, bent), S::ZERO)?;
            let corner = |sign: f64| {
                let x = add(place.middle, [sign * body.reach; 2]);
                (lift(x), lift(twist.velocity))
            };
            let round = Swept::new([-1.0, 1.0].map(corner).into_iter(), (h, pushed), S::ZERO)?;
            Some(tight.within(&round))
        };
        self.bodies.iter().filter_map(swept).collect()
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn kernel(&self) -> Kernel {
        Kernel::Rigid(self.bodies.len())
    }

    fn heap_bytes(&self) -> usize {
        let of = |body: &Body| {
            body.slots.capacity() * size_of::<u32>() + body.shape.places.capacity() * 3 * size_of::<f64>()
        };
        self.bodies.iter().map(of).sum()
    }

    fn bonds(&self) -> usize {
        self.bonds
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, D>> {
        Box::new(self.clone())
    }
}
