//! Large bodies behind one face.
//!
//! Their kernels are compiled for two scalars, two dimensions and every instruction set: here, once, and not again in
//! every program that makes a world. So what is generic ends here, and four functions that are not go on.

use std::any::Any;
use std::fmt::Debug;

use super::Bulk;
use super::draft::Order;
use super::kernel::Kernel;
use crate::sim::account::Account;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::swept::{Span, Swept};

/// Bodies that may meet.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Their points.
    pub(crate) slots: Vec<u32>,
    pub(crate) is_free: bool,
}

/// Large bodies that move in step.
pub(crate) trait Mover<S: Real, const D: usize>: Debug + Send + Sync {
    /// Gives rigid bonds that the state at time `t` `[s]` violates their lengths.
    fn begin(&mut self, points: &mut Points<S, D>, around: &Environment<D>, t: f64);

    /// Advances by `h` from time `t` `[s]`, and books the energy that came and went, where there is an account.
    fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        span: (f64, f64),
        counters: &mut Counters,
        account: Option<&mut Account>,
    );

    /// A bond between two points of the group, of this rest length `[m]`, goes. Returns whether that was so: large bodies that cannot
    /// leave its lane idle are as they were.
    fn lose(&mut self, ends: [u32; 2], rest: f64) -> bool;

    /// Points were changed from outside: their state is to be taken anew.
    fn reload(&mut self);

    /// How far velocities are behind positions `[s]`.
    fn lag(&self) -> f64;

    /// The fastest that a point of the group may be led `[m/s]`; `None`: it may be led anyhow.
    fn most_lead(&self, _slot: u32) -> Option<f64> {
        None
    }

    /// Where bodies may get to, with what their skins keep from each other; none of bodies that do not meet.
    fn reaches(&self, _points: &Points<S, D>, _span: Span) -> Vec<Swept<S, D>> {
        Vec::new()
    }

    /// The bodies that may meet within `h` `[s]`, by their slots; whether it is a single one, which meets nothing that its own method does not
    /// know of.
    fn parts(&self, _points: &Points<S, D>, _pull: &Pull<S, D>, _around: &Environment<D>, _h: f64) -> Vec<Part> {
        Vec::new()
    }

    /// Whether a body may meet itself within `h` `[s]`: asked in every step that somebody else takes with it.
    fn may_meet_itself(&mut self, _points: &Points<S, D>, _h: f64) -> bool {
        false
    }

    /// Whether it leads bodies out of obstacles that pins hold them over: other methods would put their points out at once.
    fn leads_out(&self) -> bool {
        false
    }

    /// The points of bodies that left the finite numbers, by their slots, since this was asked last: they are where the step began.
    fn take_lost(&mut self) -> Vec<u32> {
        Vec::new()
    }

    /// Bonds that broke within the last step, by their numbers in the world, and when `[s]`: it ended there.
    fn take_broken(&mut self) -> Option<(f64, Vec<u32>)> {
        None
    }

    /// Work that its next step may take: beyond that it ends early, where it can.
    fn bound(&mut self, _work: u64) {}

    /// When its last step ended early for what it took `[s]`.
    fn take_gave_up(&mut self) -> Option<f64> {
        None
    }

    /// Takes over what another one knew of points: slots there and here.
    fn inherit(&mut self, _other: &dyn Mover<S, D>, _slots: &[(u32, u32)]) {}

    /// Itself, for those who know what it is.
    fn any(&self) -> Option<&dyn Any> {
        None
    }

    /// What the bodies are and how their bonds are taken.
    fn kernel(&self) -> Kernel;

    /// Bytes that the bodies take.
    fn heap_bytes(&self) -> usize;

    /// How many bonds the bodies have.
    fn bonds(&self) -> usize;

    /// A copy that goes on by itself.
    fn boxed_clone(&self) -> Box<dyn Mover<S, D>>;
}

impl<S: Real, const D: usize> Clone for Box<dyn Mover<S, D>> {
    fn clone(&self) -> Self {
        (**self).boxed_clone()
    }
}

/// The large bodies of an order; `None` for a scalar or a dimension that there is not.
pub(crate) fn mover<S: Real, const D: usize>(order: Order<S, D>) -> Option<Box<dyn Mover<S, D>>> {
    let order: Box<dyn Any> = Box::new(order);
    let made: Box<dyn Any> = if order.is::<Order<f32, 2>>() {
        Box::new(plane_32(*order.downcast().ok()?))
    } else if order.is::<Order<f64, 2>>() {
        Box::new(plane_64(*order.downcast().ok()?))
    } else if order.is::<Order<f32, 3>>() {
        Box::new(space_32(*order.downcast().ok()?))
    } else {
        Box::new(space_64(*order.downcast().ok()?))
    };
    made.downcast().ok().map(|made| *made)
}

fn plane_32(order: Order<f32, 2>) -> Box<dyn Mover<f32, 2>> {
    Box::new(Bulk::new(order))
}

fn plane_64(order: Order<f64, 2>) -> Box<dyn Mover<f64, 2>> {
    Box::new(Bulk::new(order))
}

fn space_32(order: Order<f32, 3>) -> Box<dyn Mover<f32, 3>> {
    Box::new(Bulk::new(order))
}

fn space_64(order: Order<f64, 3>) -> Box<dyn Mover<f64, 3>> {
    Box::new(Bulk::new(order))
}
