//! Drives of a model: whether bonds, angles and the method can have them.

use super::{Model, ModelError};
use crate::sim::bond::Bond;
use crate::sim::drive::{AngleDrive, MOST_STRETCH, MOST_SWING, PERIODS, RATES, Signal};
use crate::sim::force::angle::Angle;

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
        self.driving().of_bond(bond).map_or(Ok(()), |why| refuse(why.to_string()))
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
            AngleDrive::Motor { .. } => {
                if let Some(why) = self.driving().of_motor() {
                    return refuse(why.to_string());
                }
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
