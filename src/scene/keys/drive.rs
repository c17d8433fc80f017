//! The keys of a drive, of a bond or an angle.

use super::macros::{names, object};
use crate::scene::error::{Fault, Source};
use crate::sim::{AngleDrive, Drive, Held, Key, Signal, Wave};

names! {
    /// A key of the keyboard that players hold.
    KeyName: "a key" {
        /// Arrow.
        Left = "left",
        /// Arrow.
        Right = "right",
        /// Arrow.
        Up = "up",
        /// Arrow.
        Down = "down",
        /// The space bar.
        Space = "space",
        /// A letter.
        A = "a",
        /// A letter.
        B = "b",
        /// A letter.
        C = "c",
        /// A letter.
        D = "d",
        /// A letter.
        E = "e",
        /// A letter.
        F = "f",
        /// A letter.
        G = "g",
        /// A letter.
        H = "h",
        /// A letter.
        I = "i",
        /// A letter.
        J = "j",
        /// A letter.
        K = "k",
        /// A letter.
        L = "l",
        /// A letter.
        M = "m",
        /// A letter.
        N = "n",
        /// A letter.
        O = "o",
        /// A letter.
        P = "p",
        /// A letter.
        Q = "q",
        /// A letter.
        R = "r",
        /// A letter.
        S = "s",
        /// A letter.
        T = "t",
        /// A letter.
        U = "u",
        /// A letter.
        V = "v",
        /// A letter.
        W = "w",
        /// A letter.
        X = "x",
        /// A letter.
        Y = "y",
        /// A letter.
        Z = "z",
        /// A digit.
        Digit0 = "0",
        /// A digit.
        Digit1 = "1",
        /// A digit.
        Digit2 = "2",
        /// A digit.
        Digit3 = "3",
        /// A digit.
        Digit4 = "4",
        /// A digit.
        Digit5 = "5",
        /// A digit.
        Digit6 = "6",
        /// A digit.
        Digit7 = "7",
        /// A digit.
        Digit8 = "8",
        /// A digit.
        Digit9 = "9",
    }
}

object! {
    /// What moves a bond or an angle: a muscle, a servo or a motor.
    #[derive(Copy, Default)]
    DriveKeys: "a drive: an object with keys such as `amplitude` and `period`" {
        optional {
            /// Of a bond: what its rest length changes by, as a share of it `[1]`, from -0.9 to 0.9. Of an angle that has a stiffness: what its
            /// angle at rest changes by `[rad]`, from -3 to 3.
            amplitude: f64,
            /// Of an angle, in place of an amplitude: how fast a motor turns it `[rad/s]`, anticlockwise above 0; at 0 it is a brake.
            speed: f64,
            /// Of a motor: the most that it gives `[N m]`, > 0.
            torque: f64,
            /// Of a wave `[s]`, from 0.02 to 1e6.
            period: f64,
            /// Of a wave, in place of its period `[1/s]`.
            frequency: f64,
            /// Of a wave at time 0 `[rad]`: 0 if not said.
            phase: f64,
            /// The key that has to be held: none if not said.
            key: KeyName,
            /// The key by which it goes the other way.
            back: KeyName,
            /// How quickly what is held comes and goes `[1/s]`, from 1e-3 to 100: 5 if not said.
            rate: f64,
        }
    }
}

impl DriveKeys {
    /// The drive of a bond.
    ///
    /// Errors: a key of a motor, none of a muscle, or a number outside its range.
    pub(in crate::scene) fn of_bond(&self) -> Result<Drive, Fault> {
        for (key, given) in [("speed", self.speed), ("torque", self.torque)] {
            if given.is_some() {
                let message = "is a key of a motor, which an angle has: leave it out, or give the drive to an angle";
                return Err(Fault::invalid(message).at(key));
            }
        }
        let Some(amplitude) = self.amplitude else {
            return Err(Fault::invalid("the key `amplitude` is missing: say by which share the rest length changes"));
        };
        let most = crate::sim::drive::MOST_STRETCH;
        if amplitude.is_nan() || amplitude.abs() > most {
            return Err(
                Fault::invalid(format!("is {amplitude:?}: give a share from -{most} to {most}")).at("amplitude")
            );
        }
        let signal = self.signal()?;
        if signal == Signal::default() {
            let message = "follows nothing: give `period` or `frequency` of a wave, or a `key` that is held";
            return Err(Fault::invalid(message));
        }
        Ok(Drive { amplitude, signal })
    }

    /// The drive of an angle.
    ///
    /// Errors: neither an amplitude nor a speed, or both; a motor without the most that it gives; a number outside its range.
    pub(in crate::scene) fn of_angle(&self) -> Result<AngleDrive, Fault> {
        let signal = self.signal()?;
        match (self.amplitude, self.speed) {
            (Some(_), Some(_)) => {
                Err(Fault::invalid("stands beside `amplitude`: a motor has a speed, a servo an amplitude").at("speed"))
            }
            (None, None) => Err(Fault::invalid(
                "does nothing: give `speed` [rad/s] and `torque` [N m] of a motor, or `amplitude` [rad] of a servo",
            )),
            (Some(amplitude), None) => {
                let most = crate::sim::drive::MOST_SWING;
                if amplitude.is_nan() || amplitude.abs() > most {
                    let message = format!("is {amplitude:?}: give an angle from -{most} to {most} rad");
                    return Err(Fault::invalid(message).at("amplitude"));
                }
                if self.torque.is_some() {
                    let message = "is a key of a motor: a servo pulls by the `stiffness` of its angle, so leave it out";
                    return Err(Fault::invalid(message).at("torque"));
                }
                if signal == Signal::default() {
                    let message = "follows nothing: give `period` or `frequency` of a wave, or a `key` that is held";
                    return Err(Fault::invalid(message));
                }
                Ok(AngleDrive::Servo { amplitude, signal })
            }
            (None, Some(speed)) if !speed.is_finite() => {
                Err(Fault::invalid(format!("is {speed:?}: give a finite number")).at("speed"))
            }
            (None, Some(speed)) => match self.torque {
                None => {
                    let message = "the key `torque` is missing: a motor needs the most that it gives [N m], above 0";
                    Err(Fault::invalid(message))
                }
                Some(torque) if !(torque > 0.0 && torque.is_finite()) => {
                    Err(Fault::invalid(format!("is {torque:?}: give a number above 0")).at("torque"))
                }
                Some(torque) => Ok(AngleDrive::Motor { speed, torque, signal }),
            },
        }
    }

    /// The drive of a bond that a command sets.
    ///
    /// Errors: as of a scene with these keys.
    pub(crate) fn told_bond(&self) -> Result<Drive, String> {
        self.of_bond().map_err(told)
    }

    /// The drive of an angle that a command sets.
    ///
    /// Errors: as of a scene with these keys.
    pub(crate) fn told_angle(&self) -> Result<AngleDrive, String> {
        self.of_angle().map_err(told)
    }

    fn signal(&self) -> Result<Signal, Fault> {
        let period = match (self.period, self.frequency) {
            (Some(_), Some(_)) => {
                let message = "stands beside `period`, its reciprocal: leave one of them out";
                return Err(Fault::invalid(message).at("frequency"));
            }
            (Some(period), None) => Some((period, "period")),
            (None, frequency) => frequency.map(|frequency| (1.0 / frequency, "frequency")),
        };
        let [least, most] = crate::sim::drive::PERIODS;
        if let Some((period, key)) = period.filter(|(period, _)| !(least..=most).contains(period)) {
            let message = format!("makes a period of {period:?} s: give one from {least} to {most} s");
            return Err(Fault::invalid(message).at(key));
        }
        if let Some(phase) = self.phase.filter(|phase| period.is_none() || !phase.is_finite()) {
            let message = format!("is {phase:?}: give a finite number, beside the `period` of a wave");
            return Err(Fault::invalid(message).at("phase"));
        }
        let [slowest, quickest] = crate::sim::drive::RATES;
        if let Some(rate) = self.rate.filter(|rate| !(slowest..=quickest).contains(rate)) {
            let message = format!("is {rate:?}: give a number from {slowest} to {quickest} 1/s");
            return Err(Fault::invalid(message).at("rate"));
        }
        for (key, is_there) in [("back", self.back.is_some()), ("rate", self.rate.is_some())] {
            if is_there && self.key.is_none() {
                return Err(Fault::invalid("stands without `key`: add it").at(key));
            }
        }
        if self.key.is_some() && self.back == self.key {
            return Err(Fault::invalid("is the same as `key`: give another").at("back"));
        }
        let wave = period.map(|(period, _)| Wave { period, phase: self.phase.unwrap_or(0.0) });
        let held = self.key.and_then(|key| {
            let back = self.back.and_then(|back| Key::of(back.name()));
            let rate = self.rate.unwrap_or(crate::sim::drive::RATE);
            Some(Held { forth: Key::of(key.name())?, back, rate })
        });
        Ok(Signal { wave, held })
    }

    /// Its bits, by which it is told from others.
    pub(super) fn bits(&self) -> [u64; 8] {
        let numbers = [self.amplitude, self.speed, self.torque, self.period, self.frequency, self.phase, self.rate];
        let mut bits = [0; 8];
        let of = |key: Option<KeyName>| key.map_or(0, |key| 1 + key as u64);
        bits[7] = of(self.key) + (of(self.back) << 8);
        for (k, number) in numbers.into_iter().enumerate() {
            bits[7] |= u64::from(number.is_some()) << (16 + k);
            bits[k] = number.unwrap_or(0.0).to_bits();
        }
        bits
    }
}

fn told(fault: Fault) -> String {
    Source::default().error(fault.at("drive")).to_string()
}

impl From<Signal> for DriveKeys {
    fn from(signal: Signal) -> Self {
        let name = |key: Key| key.name().parse().ok();
        DriveKeys {
            period: signal.wave.map(|wave| wave.period),
            phase: signal.wave.map(|wave| wave.phase),
            key: signal.held.and_then(|held| name(held.forth)),
            back: signal.held.and_then(|held| held.back).and_then(name),
            rate: signal.held.map(|held| held.rate),
            ..DriveKeys::default()
        }
    }
}

impl From<Drive> for DriveKeys {
    fn from(drive: Drive) -> Self {
        DriveKeys { amplitude: Some(drive.amplitude), ..drive.signal.into() }
    }
}

impl From<AngleDrive> for DriveKeys {
    fn from(drive: AngleDrive) -> Self {
        match drive {
            AngleDrive::Servo { amplitude, signal } => DriveKeys { amplitude: Some(amplitude), ..signal.into() },
            AngleDrive::Motor { speed, torque, signal } => {
                DriveKeys { speed: Some(speed), torque: Some(torque), ..signal.into() }
            }
        }
    }
}
