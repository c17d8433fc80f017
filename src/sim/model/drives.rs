//! Drives of a model: whether bonds, angles and the method can have them.

use super::{Model, ModelError};
use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::drive::{AngleDrive, MOST_STRETCH, MOST_SWING, PERIODS, RATES, Signal};
use crate::sim::force::angle::Angle;
use crate::sim::solver::Solver;

/// Solvers that move what is driven.
const OTHERS: &str = "auto, verlet, velocity-verlet, pefrl, rk4 or live";

impl<const D: usize> Model<D> {
    /// Errors: a drive that bond `i` cannot have, or that the method cannot follow.
    pub(super) fn check_drive(&self, i: usize, bond: &Bond) -> Result<(), ModelError> {
        let Some(drive) = bond.drive else { return Ok(()) };
        let refuse = |why: String| Err(ModelError::Drive { place: format!("the drive of bond {i}"), why });
        if drive.amplitude.is_nan() || drive.amplitude.abs() > MOST_STRETCH {
            return refuse(format!(
                "amplitude is {}: give a share from -{MOST_STRETCH} to {MOST_STRETCH}",
                drive.amplitude
            ));
        }
        if let Some(why) = fault(&drive.signal) {
            return refuse(why);
        }
        if matches!(bond.kind, BondKind::Relaxed { .. }) {
            return refuse("a relaxed bond has none: make it a spring or rigid".to_owned());
        }
        if bond.limit != Limit::Both || bond.rest_length == 0.0 {
            return refuse(
                "a bond needs a length, and to act both ways: give it `rest` above 0 and no `limit`".to_owned(),
            );
        }
        let (solver, is_rigid) = (self.method.solver, bond.kind == BondKind::Rigid);
        if is_rigid && !matches!(solver, Solver::Auto | Solver::Live) {
            return refuse(format!(
                "solver {solver} moves no rigid bond by a drive: use auto or live, or make it a spring"
            ));
        }
        if is_rigid && self.method.tolerance.is_some() {
            return refuse("no tolerance is held to where a rigid bond has a drive: make it a spring".to_owned());
        }
        if D == 3 && (is_rigid || self.contact.is_some() || !self.convex.is_empty() || solver == Solver::Live) {
            let why = "in space springs alone have drives, where no bodies, balls or boxes are met: leave it out";
            return refuse(why.to_owned());
        }
        if matches!(solver, Solver::Relaxation | Solver::Xpbd | Solver::Path | Solver::Flight) {
            return refuse(format!("solver {solver} knows no drives: use {OTHERS}"));
        }
        Ok(())
    }

    /// Errors: a drive that an angle cannot have, or that the method cannot follow.
    pub(super) fn check_angle_drive(&self, angle: &Angle) -> Result<(), ModelError> {
        let Some(drive) = angle.drive else { return Ok(()) };
        let refuse =
            |why: String| Err(ModelError::Drive { place: format!("the drive of angle {}", angle.number), why });
        if let Some(why) = fault(&drive.signal()) {
            return refuse(why);
        }
        match drive {
            AngleDrive::Servo { amplitude, .. } if amplitude.is_nan() || amplitude.abs() > MOST_SWING => {
                return refuse(format!(
                    "amplitude is {amplitude}: give an angle from -{MOST_SWING} to {MOST_SWING} rad"
                ));
            }
            AngleDrive::Servo { .. } if angle.stiffness == 0.0 => {
                return refuse("nothing pulls the angle to it: give the angle a `stiffness` above 0".to_owned());
            }
            AngleDrive::Motor { speed, torque, .. } if !(speed.is_finite() && torque > 0.0 && torque.is_finite()) => {
                return refuse(format!("speed {speed}, torque {torque}: give a finite speed and a torque above 0"));
            }
            AngleDrive::Motor { .. }
                if matches!(self.method.solver, Solver::ImplicitMidpoint | Solver::BackwardEuler) =>
            {
                return refuse(format!("solver {} knows no motors: use {OTHERS}", self.method.solver));
            }
            _ => {}
        }
        Ok(())
    }
}

/// What of a signal is outside its range.
fn fault(signal: &Signal) -> Option<String> {
    let [[least, most], [slowest, quickest]] = [PERIODS, RATES];
    (!signal.is_fine()).then(|| {
        format!(
            "give a period from {least} to {most} s, a finite phase, a rate from {slowest} to {quickest} 1/s, and \
             another key as `back` than as `key`"
        )
    })
}
