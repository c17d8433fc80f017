//! Rigid bodies in space: what rigid bonds hold in its shape has six degrees of freedom, on pins three, one or none.
//!
//! ```text
//! found      points that three bonds each hold to those before (`layout.rs`), or few points by their rank (`rank.rs`)
//! read       place, turn, velocity and spin from the points: best fit, momentum and angular momentum (`body.rs`)
//! flight     in closed form, the turn by its power series (`flight.rs`, `spin.rs`)
//! hit, rest  on planes, as bodies in the plane do, by what both are (`../solid.rs`): `../alone.rs`, `../touch.rs`, `../slide.rs`
//! write      points follow, once a step
//! ```
//!
//! Nothing is kept between steps but the points themselves: any copy goes on with the same bits.

mod body;
mod flight;
mod hull;
mod inertia;
pub(crate) mod layout;
mod place;
mod rank;
pub(crate) mod shape;
mod solid;
mod spin;

use std::sync::Arc;

use super::alone::Lone;
use super::course::{Log, advance};
use super::field::{Field, is_reached};
use super::motion;
use super::solid::Solid;
use crate::sim::account::Account;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::bulk::mover::Mover;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use body::Body;
use place::Place;
use shape::Shape;

/// How a body moves in space, and where it is.
type Twist = motion::Twist<[f64; 3], 3>;
type Motion = motion::Motion<Place, 3>;

/// Rigid bodies in space that step together, each alone.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    bodies: Arc<[Body]>,
    /// Bonds that they are made of.
    bonds: usize,
    /// Points of those that left the finite numbers: they are where their step began.
    lost: Vec<u32>,
}

impl Rigid {
    /// Of shapes, each with the places of its points in the group, made of so many bonds.
    pub(crate) fn new(shapes: Vec<(Arc<Shape>, Vec<u32>)>, bonds: usize) -> Self {
        let bodies = shapes.into_iter().map(|(shape, slots)| Body::new(shape, slots)).collect();
        Rigid { bodies, bonds, lost: Vec::new() }
    }
}

impl<S: Real, const D: usize> Mover<S, D> for Rigid {
    /// Points that are elsewhere get the places that the shape has for them.
    fn begin(&mut self, points: &mut Points<S, D>, _around: &Environment<D>, _t: f64) {
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
            let is_reached = is_reached((body, &motion), (pull, around), (t, h));
            let slots = || body.slots.iter().map(|&slot| slot as usize);
            let moving = || slots().map(|i| (points.position[i], points.velocity[i]));
            let parts = if is_reached { around.parts_near(moving(), (t, h)) } else { 1 };
            let mut log = Log::new(book.as_deref_mut());
            let (end, work) = {
                let field = Field { pull, around, w: &points.inverse_mass, is_reached };
                let lone = Lone::new(body, &field, &motion);
                let longest = body.longest(&field, h).min(h / f64::from(parts));
                let end = advance(&lone, motion, (t, h, longest), &mut log);
                (end, lone.spent())
            };
            let count = body.slots.len() as u64;
            let stands = body.is_fixed() && body.fits(&end, points);
            if stands {
                // What is written anew in each step creeps by rounding.
            } else if end.is_finite() {
                body.write(&end, points);
            } else {
                self.lost.extend(&body.slots);
            }
            counters.substeps += 1;
            counters.points_moved += count;
            counters.mouse_points += if is_reached { count } else { 0 };
            counters.events += log.hits;
            counters.work += 60 * count + log.work + work;
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn kernel(&self) -> Kernel {
        Kernel::Rigid(self.bodies.len())
    }

    fn heap_bytes(&self) -> usize {
        let of = |body: &Body| size_of::<Body>() + body.slots.capacity() * 4 + body.shape.heap_bytes();
        self.bodies.iter().map(of).sum()
    }

    fn bonds(&self) -> usize {
        self.bonds
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, D>> {
        Box::new(self.clone())
    }
}
