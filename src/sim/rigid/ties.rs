//! Springs and angles between the bodies of a linkage, as forces on them.

use super::body::{From, Push};
use super::joints::{End, Stand};
use crate::sim::bond::Bond;
use crate::sim::force::angle::Angle;
use crate::sim::force::angle::Hinge;
use crate::sim::force::form::Form;
use crate::sim::force::spring::{Springs, pull_at_rest};
use crate::sim::vector::{add, cross, dot, sub};

/// Springs and angles, with the points that they are at.
#[derive(Clone, Debug)]
pub(crate) struct Ties {
    seats: Vec<End>,
    springs: Springs<f64>,
    form: Form<f64>,
    /// Bounds on their fastest oscillation `[rad/s]` and decay `[1/s]`.
    pub(super) rates: [f64; 2],
}

impl Ties {
    /// None.
    pub(crate) fn none() -> Self {
        Ties { seats: Vec::new(), springs: Springs::none(), form: Form::none(), rates: [0.0; 2] }
    }

    /// Springs and angles between these seats, which they count; `rates`: bounds on their fastest oscillation `[rad/s]` and decay `[1/s]`.
    pub(crate) fn new(seats: Vec<End>, springs: &[Bond], angles: &[Angle], rates: [f64; 2]) -> Self {
        let hinges = angles.iter().map(|angle| Hinge::new(angle, angle.points.map(|point| point.0))).collect();
        let springs = Springs::new(springs.iter(), seats.len());
        Ties { seats, springs, form: Form { hinges, patches: Vec::new() }, rates }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.springs.is_empty() && self.form.is_empty()
    }

    /// Whether any has a damper.
    pub(super) fn is_damped(&self) -> bool {
        self.springs.is_damped() || self.form.is_damped()
    }

    /// What they do to each body, dampers apart.
    pub(super) fn still(&self, stand: Stand) -> Vec<Push> {
        let (x, mut force) = (self.places(stand), vec![[0.0; 2]; self.seats.len()]);
        pull_at_rest(self.springs.iter().as_slice(), &x, &mut force);
        self.form.pull_at_rest(&x, &mut force);
        self.gathered(stand, &x, &force)
    }

    /// What they do to each body, dampers included, and what those take `[W]`.
    pub(super) fn damped(&self, stand: Stand) -> (Vec<Push>, f64) {
        let x = self.places(stand);
        let v: Vec<[f64; 2]> = self.seats.iter().map(|&end| stand.velocity(end)).collect();
        let mut both = [vec![[0.0; 2]; x.len()], vec![[0.0; 2]; x.len()]];
        self.springs.pull(&x, &v, &mut both[0]);
        self.form.pull(&x, &v, &mut both[0]);
        pull_at_rest(self.springs.iter().as_slice(), &x, &mut both[1]);
        self.form.pull_at_rest(&x, &mut both[1]);
        let [all, still] = &both;
        let taken = all.iter().zip(still).zip(&v).map(|((all, still), v)| dot(sub(*still, *all), *v)).sum();
        (self.gathered(stand, &x, all), taken)
    }

    fn places(&self, stand: Stand) -> Vec<[f64; 2]> {
        self.seats.iter().map(|&end| stand.at(end)).collect()
    }

    /// Force and torque on each body.
    fn gathered(&self, stand: Stand, x: &[[f64; 2]], force: &[[f64; 2]]) -> Vec<Push> {
        let mut list = vec![Push { from: From::Ties, force: [0.0; 2], torque: 0.0 }; stand.motions.len()];
        for ((&seat, &x), &force) in self.seats.iter().zip(x).zip(force) {
            if let End::On { body, .. } = seat {
                let push = &mut list[body as usize];
                push.force = add(push.force, force);
                push.torque += cross(sub(x, stand.motions[body as usize].place.middle), force);
            }
        }
        list
    }
}
