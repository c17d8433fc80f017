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

/// What ties do: to each body, what their dampers take, and power of the led pins that they pull at `[W]`.
pub(super) struct Pulled {
    pub(super) pushes: Vec<Push>,
    pub(super) taken: f64,
    pub(super) led: f64,
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

    /// What they do to each body, dampers apart, and what led pins do by them.
    pub(super) fn still(&self, stand: Stand) -> Pulled {
        let (x, mut force) = (self.places(stand), vec![[0.0; 2]; self.seats.len()]);
        pull_at_rest(self.springs.iter().as_slice(), &x, &mut force);
        self.form.pull_at_rest(&x, &mut force);
        Pulled { pushes: self.gathered(stand, &x, &force), taken: 0.0, led: self.led(stand, &force) }
    }

    /// What they do to each body, dampers included, what those take, and what led pins do.
    pub(super) fn damped(&self, stand: Stand) -> Pulled {
        let x = self.places(stand);
        let v: Vec<[f64; 2]> = self.seats.iter().map(|&end| stand.velocity(end)).collect();
        let mut both = [vec![[0.0; 2]; x.len()], vec![[0.0; 2]; x.len()]];
        self.springs.pull(&x, &v, &mut both[0]);
        self.form.pull(&x, &v, &mut both[0]);
        pull_at_rest(self.springs.iter().as_slice(), &x, &mut both[1]);
        self.form.pull_at_rest(&x, &mut both[1]);
        let [all, still] = &both;
        let taken = all.iter().zip(still).zip(&v).map(|((all, still), v)| dot(sub(*still, *all), *v)).sum();
        Pulled { pushes: self.gathered(stand, &x, all), taken, led: self.led(stand, all) }
    }

    /// Power of led pins that these forces pull at `[W]`.
    fn led(&self, stand: Stand, force: &[[f64; 2]]) -> f64 {
        let fixed = self.seats.iter().zip(force).filter(|(seat, _)| matches!(seat, End::Fixed(_)));
        -fixed.map(|(&seat, &force)| dot(force, stand.velocity(seat))).sum::<f64>()
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
