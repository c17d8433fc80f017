//! Contacts that answer to each other's impulses through what holds them together.

use super::line::Line;
use super::{Answers, Impulse, Pressed, stop};

/// Times that one contact is gone through at most; of several each that much less often.
const PASSES: u32 = 2_000;

/// Contacts, and what impulses at each of them change at all.
#[derive(Clone, Debug)]
pub(crate) struct Coupled {
    /// What an impulse of 1 changes of all velocities, across and along `[1/kg]`: one entry a contact and direction of the impulse, across
    /// first.
    pub(crate) gives: Vec<Vec<[f64; 2]>>,
    /// All that may move `[kg]`, and of what turns its moments of inertia `[kg m^2]`.
    pub(crate) mass: f64,
    /// Share of an energy that is rounding: it is summed up push by push.
    pub(crate) rounding: f64,
    /// Those without friction whose impulses are found together, by their numbers.
    pub(crate) smooth: Vec<usize>,
}

/// Velocities of all contacts, across and along `[m/s]`, and the energy of the motion that they belong to `[J]`.
#[derive(Clone, Debug)]
pub(crate) struct Speeds {
    pub(crate) speeds: Vec<[f64; 2]>,
    pub(crate) energy: f64,
}

impl Answers<2> for Coupled {
    type Motion = Speeds;
    type Friction = Line;

    fn speeds(&self, contact: usize, motion: &Speeds) -> [f64; 2] {
        motion.speeds[contact]
    }

    fn gives(&self, contact: usize) -> [Impulse; 2] {
        let [normal, along] = [self.gives[2 * contact][contact], self.gives[2 * contact + 1][contact]];
        [[normal[0], along[0]], [normal[1], along[1]]]
    }

    fn pushed(&self, contact: usize, impulse: Impulse, mut motion: Speeds) -> Speeds {
        let before = motion.speeds[contact];
        for (axis, push) in impulse.into_iter().enumerate() {
            for (speed, gives) in motion.speeds.iter_mut().zip(&self.gives[2 * contact + axis]) {
                speed[0] += gives[0] * push;
                speed[1] += gives[1] * push;
            }
        }
        let after = motion.speeds[contact];
        motion.energy += 0.5 * (0..2).map(|k| impulse[k] * (before[k] + after[k])).sum::<f64>();
        motion
    }

    fn energy(&self, motion: &Speeds) -> f64 {
        motion.energy
    }

    fn stopped(&self, motion: &Speeds) -> Speeds {
        Speeds { speeds: vec![[0.0; 2]; motion.speeds.len()], energy: 0.0 }
    }

    /// Contacts that are coupled strongly need many.
    fn most_passes(&self, contacts: usize) -> u32 {
        PASSES / (contacts as u32).max(1)
    }

    fn rounding(&self) -> f64 {
        self.rounding
    }

    /// It is slowed down as a whole, which joints, bonds and surfaces bear.
    fn give_up(&self, before: &Speeds, found: Pressed<Speeds>) -> Pressed<Speeds> {
        let share = (before.energy / found.motion.energy).sqrt();
        if !share.is_finite() {
            return stop(self, before, found.impulses.len());
        }
        Pressed { share: share.min(1.0), ..found }
    }

    fn heaviest(&self) -> f64 {
        self.mass
    }

    fn smooth(&self) -> &[usize] {
        &self.smooth
    }

    fn crosses(&self, contact: usize, other: usize) -> f64 {
        self.gives[2 * contact][other][0]
    }
}
