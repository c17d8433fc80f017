//! Springs and angles between the bodies of a linkage, as forces on them.

use super::field::{From, Push};
use super::link::{Clock, End, Stand};
use crate::sim::bond::Bond;
use crate::sim::force::angle::Angle;
use crate::sim::force::angle::Hinge;
use crate::sim::force::form::Form;
use crate::sim::force::muscle::Driven;
use crate::sim::force::spring::{Springs, pull_at_rest};
use crate::sim::vector::{add, cross, dot, length, sub};

/// By how much a spring may be shorter than it may be and breaks, as a share of its length and of 1 m: what is left where that moment is located.
const ROUNDED: f64 = 1e-10;

/// Springs and angles, with the points that they are at.
#[derive(Clone, Debug)]
pub(crate) struct Ties {
    seats: Vec<End>,
    springs: Springs<f64>,
    form: Form<f64>,
    /// What drives add to them.
    driven: Driven<f64>,
    /// Springs that break.
    fragile: Vec<Fragile>,
    /// Bounds on their fastest oscillation `[rad/s]` and decay `[1/s]`.
    pub(super) rates: [f64; 2],
}

/// A spring that breaks.
#[derive(Clone, Copy, Debug)]
struct Fragile {
    /// Places among the seats.
    ends: [u32; 2],
    /// The length at which it does `[m]`.
    most: f64,
    /// Which bond of the world it is.
    bond: u32,
}

impl Fragile {
    fn of(&(name, bond): &(u32, Bond)) -> Option<Self> {
        let Bond { rest_length: rest, break_strain: strain, .. } = bond;
        let most = if rest > 0.0 { rest * (1.0 + strain) } else { strain };
        most.is_finite().then_some(Fragile { ends: [bond.a.0, bond.b.0], most, bond: name })
    }
}

/// What ties do: to each body; what their dampers take, power of the led pins that they pull at, and of their drives `[W]`.
pub(super) struct Pulled {
    pub(super) pushes: Vec<Push>,
    pub(super) taken: f64,
    pub(super) led: f64,
    pub(super) driven: f64,
}

impl Ties {
    /// None.
    pub(crate) fn none() -> Self {
        Ties {
            seats: Vec::new(),
            springs: Springs::none(),
            form: Form::none(),
            driven: Driven::none(),
            fragile: Vec::new(),
            rates: [0.0; 2],
        }
    }

    /// Springs, with their numbers in the world, and angles between these seats, which they count.
    ///
    /// `w`: inverse masses of the points there `[1/kg]`; `rates`: bounds on their fastest oscillation `[rad/s]` and decay `[1/s]`.
    pub(crate) fn new(
        seats: Vec<End>,
        springs: &[(u32, Bond)],
        angles: &[Angle],
        (w, rates): (&[f64], [f64; 2]),
    ) -> Self {
        let hinges: Vec<Hinge<f64>> =
            angles.iter().map(|angle| Hinge::new(angle, angle.points.map(|point| point.0))).collect();
        let driven = Driven::of(springs.iter().map(|(_, bond)| bond), hinges.iter().copied(), w);
        let fragile = springs.iter().filter_map(Fragile::of).collect();
        let springs = Springs::new(springs.iter().map(|(_, bond)| bond), seats.len());
        Ties { seats, springs, form: Form { hinges, patches: Vec::new() }, driven, fragile, rates }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.springs.is_empty() && self.form.is_empty()
    }

    /// Whether any has a damper.
    pub(super) fn is_damped(&self) -> bool {
        self.springs.is_damped() || self.form.is_damped() || self.driven.has_motors()
    }

    /// Whether drives push by any.
    pub(super) fn are_driven(&self) -> bool {
        !self.driven.is_empty()
    }

    /// Whether any may break.
    pub(super) fn may_break(&self) -> bool {
        !self.fragile.is_empty()
    }

    /// By how much each that breaks is shorter than it may be `[m]`: below 0 it is gone.
    pub(super) fn spare(&self, stand: Stand) -> impl Iterator<Item = f64> {
        self.fragile.iter().map(move |fragile| {
            let [a, b] = fragile.ends.map(|end| stand.at(self.seats[end as usize]));
            fragile.most - length(sub(a, b))
        })
    }

    /// The numbers in the world of those that break where they are so long, but for rounding.
    pub(super) fn broken(&self, stand: Stand) -> Vec<u32> {
        let is_gone =
            |(fragile, spare): (&Fragile, f64)| (spare <= ROUNDED * (1.0 + fragile.most)).then_some(fragile.bond);
        self.fragile.iter().zip(self.spare(stand)).filter_map(is_gone).collect()
    }

    /// What they do to each body, dampers apart, and what led pins do by them.
    pub(super) fn still(&self, stand: Stand) -> Pulled {
        let (x, mut force) = (self.places(stand), vec![[0.0; 2]; self.seats.len()]);
        pull_at_rest(self.springs.iter().as_slice(), &x, &mut force);
        self.form.pull_at_rest(&x, &mut force);
        // Motors push by how fast their angles turn.
        let v = if self.are_driven() { self.velocities(stand) } else { Vec::new() };
        self.drive(stand, (&x, &v), &mut force);
        Pulled { pushes: self.gathered(stand, &x, &force), taken: 0.0, led: self.led(stand, &force), driven: 0.0 }
    }

    /// What they do to each body, dampers included, what those take, and what led pins do.
    pub(super) fn damped(&self, stand: Stand) -> Pulled {
        let x = self.places(stand);
        let v = self.velocities(stand);
        let mut both = [vec![[0.0; 2]; x.len()], vec![[0.0; 2]; x.len()]];
        self.springs.pull(&x, &v, &mut both[0]);
        self.form.pull(&x, &v, &mut both[0]);
        pull_at_rest(self.springs.iter().as_slice(), &x, &mut both[1]);
        self.form.pull_at_rest(&x, &mut both[1]);
        let [mut all, still] = both;
        let taken = all.iter().zip(&still).zip(&v).map(|((all, still), v)| dot(sub(*still, *all), *v)).sum();
        let driven = self.drive(stand, (&x, &v), &mut all);
        Pulled { pushes: self.gathered(stand, &x, &all), taken, led: self.led(stand, &all), driven }
    }

    /// Adds what drives push, and returns their power `[W]` at these velocities.
    fn drive(&self, stand: Stand, (x, v): (&[[f64; 2]], &[[f64; 2]]), force: &mut [[f64; 2]]) -> f64 {
        let Some(Clock { time, keys }) = stand.clock.filter(|_| self.are_driven()) else { return 0.0 };
        let mut power = 0.0;
        self.driven.each((time, keys), (x, v), |i, push| {
            force[i] = add(force[i], push);
            power += dot(push, v[i]);
        });
        power
    }

    /// Power of led pins that these forces pull at `[W]`.
    fn led(&self, stand: Stand, force: &[[f64; 2]]) -> f64 {
        let fixed = self.seats.iter().zip(force).filter(|(seat, _)| matches!(seat, End::Fixed(_)));
        -fixed.map(|(&seat, &force)| dot(force, stand.velocity(seat))).sum::<f64>()
    }

    fn velocities(&self, stand: Stand) -> Vec<[f64; 2]> {
        self.seats.iter().map(|&end| stand.velocity(end)).collect()
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
