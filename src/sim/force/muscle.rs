//! Muscles, servos and motors, as forces: what drives add to the springs and angles that they drive.

use super::angle::Hinge;
use super::form::at;
use crate::sim::bond::{Bond, BondKind};
use crate::sim::drive::{AngleDrive, Keys, Signal};
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub, zero};

/// Frames in a second `[1/s]`.
const FRAMES: f64 = 60.0;

/// What the drive of a spring adds to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Muscle<S> {
    a: u32,
    b: u32,
    /// The push between its ends at level 1 `[N]`: stiffness times what the rest length grows.
    push: S,
    signal: Signal,
}

/// What is driven of a group.
#[derive(Clone, Debug)]
pub(crate) struct Driven<S> {
    muscles: Vec<Muscle<S>>,
    /// Angles with a drive.
    hinges: Vec<Hinge<S>>,
    /// What rigid bonds follow, which the live step moves.
    rigid: Vec<Signal>,
    /// A bound, about, on how it accelerates a point `[m/s^2]`.
    most: f64,
}

impl<S: Real> Driven<S> {
    /// Nothing.
    pub(crate) fn none() -> Self {
        Driven { muscles: Vec::new(), hinges: Vec::new(), rigid: Vec::new(), most: 0.0 }
    }

    /// The drives of these bonds and angles.
    ///
    /// Shapes: `w` has one entry a point `[1/kg]`.
    pub(crate) fn of<'a>(
        bonds: impl Iterator<Item = &'a Bond>,
        hinges: impl Iterator<Item = Hinge<S>>,
        w: &[f64],
    ) -> Self {
        let mut lengths = Vec::new();
        let mut driven = Driven { hinges: hinges.filter(|hinge| hinge.drive.is_some()).collect(), ..Driven::none() };
        for (bond, drive) in bonds.filter_map(|bond| Some((bond, bond.drive?))) {
            match bond.kind {
                BondKind::Spring { stiffness, .. } => {
                    lengths.push(bond.rest_length * drive.amplitude.abs());
                    driven.muscles.push(Muscle {
                        a: bond.a.0,
                        b: bond.b.0,
                        push: S::from_f64(stiffness * bond.rest_length * drive.amplitude),
                        signal: drive.signal,
                    });
                }
                _ => driven.rigid.push(drive.signal),
            }
        }
        driven.most = driven.bound(&lengths, w);
        driven
    }

    /// Whether there is nothing.
    pub(crate) fn is_empty(&self) -> bool {
        self.muscles.is_empty() && self.hinges.is_empty() && self.rigid.is_empty()
    }

    /// Whether any force depends on velocities.
    pub(crate) fn has_motors(&self) -> bool {
        self.hinges.iter().any(Hinge::is_motor)
    }

    /// Whether something of it goes on moving after time `t` `[s]`.
    pub(crate) fn moves_after(&self, t: f64, keys: &Keys) -> bool {
        let signals = self.muscles.iter().map(|muscle| &muscle.signal).chain(&self.rigid);
        signals.into_iter().any(|signal| signal.moves_after(t, keys))
            || self.hinges.iter().filter_map(|hinge| hinge.drive).any(|drive| drive.moves_after(t, keys))
    }

    /// Calls `give` with every place and the force that it has from a drive at time `t` `[N]`.
    ///
    /// Model: with d = x_a - x_b a muscle pushes a by stiffness rest amplitude level d/|d|, and b by the opposite: its spring has the energy
    /// of its own rest length, and the rest is the drive's work. Ends that coincide have no direction: no force.
    pub(crate) fn each<const D: usize>(
        &self,
        (t, keys): (f64, &Keys),
        (x, v): (&[[S; D]], &[[S; D]]),
        mut give: impl FnMut(usize, [S; D]),
    ) {
        for muscle in &self.muscles {
            let (a, b) = (muscle.a as usize, muscle.b as usize);
            let d = sub(x[a], x[b]);
            let length = dot(d, d).sqrt();
            let level = S::from_f64(muscle.signal.level(t, keys));
            if length > S::ZERO {
                let push = scale(d, muscle.push * level / length);
                give(a, push);
                give(b, scale(push, -S::ONE));
            }
        }
        for hinge in &self.hinges {
            let Some(stand) = hinge.stand(at(x, hinge.points)) else { continue };
            let level = hinge.level(t, keys);
            let torque = hinge.driving(stand.rate(at(v, hinge.points)), level) * stand.share();
            for (point, slope) in hinge.points.into_iter().zip(stand.slopes) {
                let mut push = zero();
                (push[0], push[1]) = (torque * slope[0], torque * slope[1]);
                give(point as usize, push);
            }
        }
    }

    /// A bound, about, on how it accelerates a point `[m/s^2]`.
    pub(crate) fn most_push(&self) -> f64 {
        self.most
    }

    /// Inverse masses `w` `[1/kg]`. What a muscle moves goes no faster than its rest length does, what a motor turns no faster than that.
    fn bound(&self, lengths: &[f64], w: &[f64]) -> f64 {
        let of = |i: u32| w[i as usize];
        let muscles = self.muscles.iter().zip(lengths).map(|(muscle, length)| {
            let rate = muscle.signal.fastest();
            (muscle.push.to_f64().abs() * of(muscle.a).max(of(muscle.b))).min(length * rate * rate)
        });
        let turns = self.hinges.iter().map(|hinge| {
            let lightest = hinge.points.into_iter().map(of).fold(0.0, f64::max);
            match hinge.drive {
                Some(AngleDrive::Motor { torque, speed, .. }) => {
                    (torque * hinge.steepest() * lightest).min(FRAMES * speed.abs() / hinge.shallowest())
                }
                Some(AngleDrive::Servo { amplitude, .. }) => {
                    hinge.stiffness.to_f64() * amplitude.abs() * hinge.steepest() * lightest
                }
                None => 0.0,
            }
        });
        muscles.chain(turns).fold(0.0, f64::max)
    }
}
