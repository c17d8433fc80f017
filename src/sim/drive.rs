//! Drives: rest lengths and angles that follow a wave or a key that players hold, and motors.
//!
//! What a drive asks for is a *level* of time, in [-1, 1]:
//!
//! ```text
//! wave            level = sin(2 pi t/period + phase)
//! key             level = s(forth) - s(back), s from 0 to 1 while its key is held: 3 r^2 - 2 r^3, r a ramp of `rate`
//! both            level = |s| sin(sign(s) 2 pi t/period + phase), s as of the keys: `back` lets a wave run backwards
//! neither         level = 1
//! ```

use std::f64::consts::PI;

/// Names of the keys that drives may have, each at the place that is its number.
const NAMES: [&str; 41] = [
    "left", "right", "up", "down", "space", "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o",
    "p", "q", "r", "s", "t", "u", "v", "w", "x", "y", "z", "0", "1", "2", "3", "4", "5", "6", "7", "8", "9",
];

/// How quickly a key's share comes and goes where nothing is said `[1/s]`.
pub const RATE: f64 = 5.0;
/// Range of periods `[s]`: a step follows no quicker wave, and a longer one is none.
pub const PERIODS: [f64; 2] = [0.02, 1e6];
/// Range of rates `[1/s]`.
pub const RATES: [f64; 2] = [1e-3, 100.0];
/// Largest amplitude of a rest length `[1]`: of a bond that shrinks to nothing no direction is left.
pub const MOST_STRETCH: f64 = 0.9;
/// Largest amplitude of an angle `[rad]`.
pub const MOST_SWING: f64 = 3.0;
/// Share of its speed below its target within which a motor gives less than all of its torque, and the least that is taken for that `[rad/s]`.
const DROOP: (f64, f64) = (0.05, 0.05);

/// A key that players hold, by its place in a list of names that only ever grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Key(u8);

impl Key {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Key> {
        (0..NAMES.len() as u8).map(Key)
    }

    /// The key of this name: an arrow, "space", a letter or a digit.
    pub fn of(name: &str) -> Option<Key> {
        NAMES.iter().position(|own| *own == name).map(|place| Key(place as u8))
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        NAMES[usize::from(self.0)]
    }

    /// Its number.
    pub fn number(self) -> u8 {
        self.0
    }
}

/// The keys of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// The one that brings the level to 1.
    pub forth: Key,
    /// The one that brings it to -1.
    pub back: Option<Key>,
    /// How quickly both come and go `[1/s]`, within [`RATES`].
    pub rate: f64,
}

/// A wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// `[s]`, within [`PERIODS`].
    pub period: f64,
    /// At time 0 `[rad]`.
    pub phase: f64,
}

/// What a drive's level follows: nothing, a wave, keys, or a wave that runs while a key is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signal {
    /// The wave.
    pub wave: Option<Wave>,
    /// The keys.
    pub held: Option<Held>,
}

impl Signal {
    /// Its level at time `t` `[s]`, from -1 to 1.
    pub(crate) fn level(&self, t: f64, keys: &Keys) -> f64 {
        let held = self.held.map_or(1.0, |held| keys.share(held.forth, held.rate, t) - held.back_share(keys, t));
        match self.wave {
            None => held,
            Some(_) if held == 0.0 => 0.0,
            Some(Wave { period, phase }) => {
                let turns = t / period;
                held.abs() * libm::sin(2.0 * PI * (turns - turns.floor()) * held.signum() + phase)
            }
        }
    }

    /// How fast its level changes at time `t` `[1/s]`.
    pub(crate) fn rate(&self, t: f64, keys: &Keys) -> f64 {
        let share = |key: Key, rate: f64| [keys.share(key, rate, t), keys.share_rate(key, rate, t)];
        let [held, change] = self.held.map_or([1.0, 0.0], |held| {
            let [forth, comes] = share(held.forth, held.rate);
            let [back, goes] = held.back.map_or([0.0; 2], |back| share(back, held.rate));
            [forth - back, comes - goes]
        });
        match self.wave {
            None => change,
            Some(_) if held == 0.0 => 0.0,
            Some(Wave { period, phase }) => {
                let (turns, sign) = (t / period, held.signum());
                let angle = 2.0 * PI * (turns - turns.floor()) * sign + phase;
                sign * (change * libm::sin(angle) + held * sign * (2.0 * PI / period) * libm::cos(angle))
            }
        }
    }

    /// Whether its level changes after time `t` `[s]` by itself.
    pub(crate) fn moves_after(&self, t: f64, keys: &Keys) -> bool {
        let comes = self.held.is_some_and(|held| held.keys().any(|key| keys.ramps_after(key, held.rate, t)));
        comes || (self.wave.is_some() && self.held.is_none_or(|_| self.is_on(t, keys)))
    }

    /// Whether anything is held at time `t` `[s]`, if a key has to be.
    pub(crate) fn is_on(&self, t: f64, keys: &Keys) -> bool {
        self.held.is_none_or(|held| held.keys().any(|key| keys.share(key, held.rate, t) > 0.0))
    }

    /// How fast its level changes at the most `[rad/s]`; 0 of one that stays.
    pub(crate) fn fastest(&self) -> f64 {
        let wave = self.wave.map_or(0.0, |wave| 2.0 * PI / wave.period);
        // A ramp is half a swing.
        wave.max(self.held.map_or(0.0, |held| PI * held.rate))
    }

    /// Whether all its numbers are within their ranges.
    pub(crate) fn is_fine(&self) -> bool {
        let within = |[least, most]: [f64; 2], x: f64| (least..=most).contains(&x);
        self.wave.is_none_or(|wave| within(PERIODS, wave.period) && wave.phase.is_finite())
            && self.held.is_none_or(|held| within(RATES, held.rate) && held.back != Some(held.forth))
    }

    /// Its bits, by which it is told from others.
    pub(crate) fn bits(&self) -> [u64; 4] {
        let wave = self.wave.map_or([0; 2], |wave| [wave.period, wave.phase].map(f64::to_bits));
        let held = self.held.map_or([0; 2], |held| {
            let back = held.back.map_or(0, |key| 2 + u64::from(key.0));
            [1 + u64::from(held.forth.0) + (back << 16), held.rate.to_bits()]
        });
        [wave[0], wave[1], held[0], held[1]]
    }
}

impl Held {
    /// Its keys.
    pub fn keys(self) -> impl Iterator<Item = Key> {
        std::iter::once(self.forth).chain(self.back)
    }

    fn back_share(&self, keys: &Keys, t: f64) -> f64 {
        self.back.map_or(0.0, |back| keys.share(back, self.rate, t))
    }
}

/// A drive of a bond: a muscle. Its rest length is rest (1 + amplitude level).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// `[1]`, within [`MOST_STRETCH`] of 0.
    pub amplitude: f64,
    /// What it follows.
    pub signal: Signal,
}

impl Drive {
    /// What a rest length of `own` `[m]` is at time `t` `[s]`.
    pub(crate) fn rest(&self, own: f64, t: f64, keys: &Keys) -> f64 {
        own * (1.0 + self.amplitude * self.signal.level(t, keys))
    }

    /// How fast that grows `[m/s]`.
    pub(crate) fn growth(&self, own: f64, t: f64, keys: &Keys) -> f64 {
        own * self.amplitude * self.signal.rate(t, keys)
    }
}

/// A drive of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngleDrive {
    /// The angle at rest goes by amplitude times the level to either side: the angle's stiffness pulls it there.
    Servo {
        /// `[rad]`, within [`MOST_SWING`] of 0.
        amplitude: f64,
        /// What it follows.
        signal: Signal,
    },
    /// A torque that brings the angle to change at speed times the level.
    ///
    /// Model: torque clamp((speed level - theta')/d, -1, 1), d a twentieth of the speed: all of the torque until the speed is nearly reached.
    Motor {
        /// `[rad/s]`, anticlockwise where it is above 0; at 0 it is a brake.
        speed: f64,
        /// The most that it gives `[N m]`, > 0.
        torque: f64,
        /// What it follows.
        signal: Signal,
    },
}

impl AngleDrive {
    /// What it follows.
    pub fn signal(&self) -> Signal {
        match *self {
            AngleDrive::Servo { signal, .. } | AngleDrive::Motor { signal, .. } => signal,
        }
    }

    /// What its torque loses for each rad/s that the angle is nearer to its target `[N m s]`; 0 of a servo.
    pub(crate) fn slope(&self) -> f64 {
        match *self {
            AngleDrive::Servo { .. } => 0.0,
            AngleDrive::Motor { speed, torque, .. } => torque / (DROOP.0 * speed.abs()).max(DROOP.1),
        }
    }

    /// Whether it goes on moving what it drives after time `t` `[s]`.
    pub(crate) fn moves_after(&self, t: f64, keys: &Keys) -> bool {
        let turns = matches!(*self, AngleDrive::Motor { speed, .. } if speed != 0.0);
        self.signal().moves_after(t, keys) || (turns && self.signal().is_on(t, keys))
    }
}

/// How far a key has come, for drives of one rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// The key.
    pub key: Key,
    /// `[1/s]`
    pub rate: f64,
    /// Where it was when it last changed `[1]`, and when that was `[s]`.
    pub from: f64,
    /// See [`Ramp::from`].
    pub since: f64,
    /// Where it goes: 1 while the key is held, else 0.
    pub to: f64,
}

impl Ramp {
    fn at(&self, t: f64) -> f64 {
        let way = self.to - self.from;
        let gone = (self.rate * (t - self.since)).clamp(0.0, way.abs());
        if gone == way.abs() { self.to } else { self.from + gone * way.signum() }
    }
}

/// The keys that players hold, as drives follow them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Keys {
    /// Those that are held, ascending.
    pub held: Vec<Key>,
    /// Those that were held since the start, by the rates of drives.
    pub ramps: Vec<Ramp>,
}

impl Keys {
    /// A key goes down or up at time `t` `[s]`, where these keys have drives of these rates. Returns whether that changed anything.
    pub(crate) fn press(&mut self, key: Key, down: bool, t: f64, rates: impl Iterator<Item = (Key, f64)>) -> bool {
        match (self.held.binary_search(&key), down) {
            (Err(place), true) => self.held.insert(place, key),
            (Ok(place), false) => _ = self.held.remove(place),
            _ => return false,
        }
        for ramp in self.ramps.iter_mut().filter(|ramp| ramp.key == key) {
            *ramp = Ramp { from: ramp.at(t), since: t, to: if down { 1.0 } else { 0.0 }, ..*ramp };
        }
        self.include(rates, t);
        true
    }

    /// Drives of these keys and rates are there from time `t` on `[s]`.
    pub(crate) fn include(&mut self, rates: impl Iterator<Item = (Key, f64)>, t: f64) {
        for (key, rate) in rates {
            let is_held = self.held.binary_search(&key).is_ok();
            if is_held && !self.ramps.iter().any(|ramp| ramp.key == key && ramp.rate == rate) {
                self.ramps.push(Ramp { key, rate, from: 0.0, since: t, to: 1.0 });
            }
        }
    }

    fn ramp(&self, key: Key, rate: f64) -> Option<&Ramp> {
        self.ramps.iter().find(|ramp| ramp.key == key && ramp.rate == rate)
    }

    fn share(&self, key: Key, rate: f64, t: f64) -> f64 {
        let r = self.ramp(key, rate).map_or(0.0, |ramp| ramp.at(t));
        r * r * (3.0 - 2.0 * r)
    }

    /// How fast a key's share changes `[1/s]`.
    fn share_rate(&self, key: Key, rate: f64, t: f64) -> f64 {
        let Some(ramp) = self.ramp(key, rate) else { return 0.0 };
        let r = ramp.at(t);
        if r == ramp.to { 0.0 } else { 6.0 * r * (1.0 - r) * rate * (ramp.to - r).signum() }
    }

    fn ramps_after(&self, key: Key, rate: f64, t: f64) -> bool {
        self.ramp(key, rate).is_some_and(|ramp| ramp.at(t) != ramp.to)
    }

    /// Whether all numbers are such as may be.
    pub(crate) fn is_fine(&self) -> bool {
        let is_share = |x: f64| (0.0..=1.0).contains(&x);
        let is_ramp = |ramp: &Ramp| {
            is_share(ramp.from)
                && is_share(ramp.to)
                && ramp.since.is_finite()
                && ramp.rate > 0.0
                && ramp.rate.is_finite()
        };
        self.held.windows(2).all(|pair| pair[0] < pair[1]) && self.ramps.iter().all(is_ramp)
    }
}

impl Key {
    /// The key of this number.
    pub fn numbered(number: u8) -> Option<Key> {
        (usize::from(number) < NAMES.len()).then_some(Key(number))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn right() -> Key {
        Key::of("right").unwrap()
    }

    #[test]
    fn a_level_comes_and_goes_with_its_key_without_a_jump() {
        let held = Held { forth: right(), back: Key::of("left"), rate: 4.0 };
        let signal = Signal { held: Some(held), wave: None };
        let mut keys = Keys::default();
        let rates = || held.keys().map(|key| (key, 4.0));
        assert!(keys.press(right(), true, 1.0, rates()) && !keys.press(right(), true, 1.1, rates()));
        let level = |keys: &Keys, t: f64| signal.level(t, keys);
        assert_eq!([0.5, 1.0, 1.125, 1.25, 9.0].map(|t| level(&keys, t)), [0.0, 0.0, 0.5, 1.0, 1.0]);
        assert!(signal.moves_after(1.1, &keys) && !signal.moves_after(1.25, &keys));
        let half = level(&keys, 1.125);
        assert!(keys.press(right(), false, 1.125, rates()));
        assert_eq!((level(&keys, 1.125), level(&keys, 1.25)), (half, 0.0));
        keys.press(Key::of("left").unwrap(), true, 2.0, rates());
        assert_eq!(level(&keys, 3.0), -1.0);
    }

    #[test]
    fn the_rate_of_a_level_is_its_slope() {
        let held = Held { forth: right(), back: Key::of("left"), rate: 3.0 };
        let mut keys = Keys::default();
        keys.press(right(), true, 0.1, held.keys().map(|key| (key, 3.0)));
        keys.press(Key::of("left").unwrap(), true, 0.3, held.keys().map(|key| (key, 3.0)));
        let wave = Wave { period: 0.7, phase: 0.4 };
        for signal in [(Some(wave), None), (None, Some(held)), (Some(wave), Some(held)), (None, None)] {
            let signal = Signal { wave: signal.0, held: signal.1 };
            for t in [0.05, 0.15, 0.35, 0.5, 0.9] {
                let slope = (signal.level(t + 1e-6, &keys) - signal.level(t - 1e-6, &keys)) / 2e-6;
                let rate = signal.rate(t, &keys);
                assert!((rate - slope).abs() < 1e-8 * (1.0 + slope.abs()), "{signal:?} at {t}: {rate} {slope}");
            }
        }
    }

    #[test]
    fn a_wave_under_a_key_runs_backwards_under_the_other() {
        let held = Held { forth: right(), back: Key::of("left"), rate: 10.0 };
        let signal = Signal { held: Some(held), wave: Some(Wave { period: 2.0, phase: 0.3 }) };
        let of = |name: &str| {
            let mut keys = Keys::default();
            keys.press(Key::of(name).unwrap(), true, 0.0, held.keys().map(|key| (key, 10.0)));
            signal.level(5.2, &keys)
        };
        assert!((of("right") - libm::sin(5.2 * PI + 0.3)).abs() < 1e-12);
        assert!((of("left") - libm::sin(-5.2 * PI + 0.3)).abs() < 1e-12);
        assert_eq!(signal.level(5.2, &Keys::default()), 0.0);
    }
}
