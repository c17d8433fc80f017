//! What is a fault: one place for all limits.

use serde::Serialize;

use super::run::{Ended, Findings};
use crate::sim::ledger::{MOST_GAIN, MOST_LOSS};

/// What is wrong with a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// Positions left the finite numbers.
    NotFinite,
    /// It was stopped, for it would take too much counted work.
    TooDear,
    /// It was stopped by the clock, which no other judgement goes by.
    TooLong,
    /// Energy that nothing brought.
    Gain,
    /// Energy is missing that nothing took.
    Loss,
    /// Rigid bonds that are solved do not keep their lengths.
    Strain,
    /// The same while a guard splits substeps.
    GuardedStrain,
    /// Rigid bonds that are swept give way by more than they may.
    SweptStrain,
    /// Rigid bonds that the live step moves give way.
    LiveStrain,
    /// Triangles stay inside out.
    Inverted,
    /// Bodies that meet went through each other, or through themselves.
    Crossed,
    /// Points are inside what they cannot enter.
    Through,
    /// What slides isn't slowed by friction times what presses it.
    Friction,
    /// What rested moves, or what had to come to rest does not.
    Restless,
    /// Stepping takes more than half of the time that it simulates.
    Slow,
    /// A frame takes too long.
    Frame,
    /// No setting that is found gives the error that was asked for.
    Untold,
}

impl Fault {
    /// All.
    pub const ALL: [Fault; 17] = [
        Fault::NotFinite,
        Fault::TooDear,
        Fault::TooLong,
        Fault::Gain,
        Fault::Loss,
        Fault::Strain,
        Fault::GuardedStrain,
        Fault::SweptStrain,
        Fault::LiveStrain,
        Fault::Inverted,
        Fault::Crossed,
        Fault::Through,
        Fault::Friction,
        Fault::Restless,
        Fault::Slow,
        Fault::Frame,
        Fault::Untold,
    ];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Fault::NotFinite => "not finite",
            Fault::TooDear => "too much work",
            Fault::TooLong => "too long",
            Fault::Gain => "energy gained",
            Fault::Loss => "energy lost",
            Fault::Strain => "rigid strain",
            Fault::GuardedStrain => "guarded strain",
            Fault::SweptStrain => "swept strain",
            Fault::LiveStrain => "live strain",
            Fault::Inverted => "inside out",
            Fault::Crossed => "crossed",
            Fault::Through => "through a surface",
            Fault::Friction => "friction",
            Fault::Restless => "restless",
            Fault::Slow => "rate",
            Fault::Frame => "frame",
            Fault::Untold => "tolerance",
        }
    }

    /// What is measured, and what it must not exceed.
    pub fn figure(self) -> (&'static str, f64) {
        match self {
            Fault::NotFinite => ("not finite [0 or 1]", 0.0),
            Fault::TooDear | Fault::Slow => ("counted work a simulated second [s]", MOST_RATE),
            Fault::TooLong => ("stopped by the clock [0 or 1]", 0.0),
            Fault::Gain => ("energy from nowhere, of the largest kinetic so far", MOST_GAIN),
            Fault::Loss => ("energy gone without a reason in 10 s, of the largest kinetic so far", MOST_LOSS),
            Fault::Strain => ("largest strain of a rigid bond that is solved", MOST_STRAIN),
            Fault::GuardedStrain => ("the same in frames with substeps that were split", MOST_GUARDED_STRAIN),
            Fault::SweptStrain => ("largest strain of a rigid bond that is swept, over what it may have (0.02)", 1.0),
            Fault::LiveStrain => ("largest strain of a rigid bond that the live step moves", MOST_LIVE_STRAIN),
            Fault::Crossed => ("pairs of sides of skins that cross at the end and did not at the start", 0.0),
            Fault::Inverted => ("triangles inside out at the end, of all", MOST_INVERTED),
            Fault::Through => ("deepest point behind a surface [m]", MOST_DEPTH),
            Fault::Friction => ("share that friction is off by while something slides", MOST_FRICTION),
            Fault::Restless => ("way from where it rested [m], or speed at the end [m/s]", MOST_UNREST),
            Fault::Frame => ("counted work of the dearest frame [ms]", MOST_FRAME),
            Fault::Untold => (
                "error that the best setting found is told to have, or has beside a finer run, over the one asked for",
                1.0,
            ),
        }
    }

    /// How large the figure of a run is; infinite where the run left the numbers.
    pub fn measured(self, found: &Findings) -> f64 {
        match self {
            Fault::NotFinite => f64::from(u8::from(found.ended == Ended::NotFinite)),
            Fault::TooDear | Fault::Slow => found.work_rate,
            Fault::TooLong => f64::from(u8::from(found.ended == Ended::OutOfTime)),
            Fault::Gain => found.gain.unwrap_or(0.0),
            Fault::Loss => found.loss.unwrap_or(0.0),
            Fault::Strain => found.strains.solved,
            Fault::GuardedStrain => found.strains.guarded,
            Fault::SweptStrain => found.strains.swept,
            Fault::LiveStrain => found.strains.live,
            Fault::Inverted => found.inverted,
            Fault::Crossed => f64::from(found.crossed),
            Fault::Through => found.depth,
            Fault::Friction => found.friction.unwrap_or(0.0),
            Fault::Restless => found.unrest.unwrap_or(0.0),
            Fault::Frame => found.worst_work_ms,
            Fault::Untold => found.told.unwrap_or(0.0),
        }
    }

    /// How bad it is: a number to sort by, without a unit.
    pub fn weight(self, found: &Findings) -> f64 {
        let base = match self {
            Fault::NotFinite => 1e6,
            Fault::Gain => 10.0,
            Fault::TooDear
            | Fault::TooLong
            | Fault::Strain
            | Fault::GuardedStrain
            | Fault::SweptStrain
            | Fault::LiveStrain
            | Fault::Inverted
            | Fault::Crossed
            | Fault::Through
            | Fault::Loss
            | Fault::Friction
            | Fault::Restless
            | Fault::Untold => 1.0,
            Fault::Slow | Fault::Frame => 0.1,
        };
        let (_, most) = self.figure();
        base * (self.measured(found).min(1e12) / most.max(1e-3)).max(1.0).ln_1p()
    }
}

/// Strain at the end of any frame of rigid bonds in islands of up to 2,000 bonds, which are solved `[1]`.
const MOST_STRAIN: f64 = 1e-6;
/// The same where a guard had to split the substep or to take a more robust method `[1]`.
const MOST_GUARDED_STRAIN: f64 = 1e-3;
/// The same of what the live step moves `[1]`: it does fixed work in a frame and does not wait until bonds hold, so an impact leaves a
/// rest that later substeps take away. A twentieth of a length is about what is seen without a ruler.
const MOST_LIVE_STRAIN: f64 = 0.05;
/// Share of triangles that are inside out at the end `[1]`.
const MOST_INVERTED: f64 = 0.02;
/// Depth of a point behind a surface `[m]`.
const MOST_DEPTH: f64 = 1e-3;
/// Share that friction is off by `[1]`.
const MOST_FRICTION: f64 = 0.1;
/// Way of a point that started at rest `[m]`, speed at the end of what has to come to rest `[m/s]`.
const MOST_UNREST: f64 = 1e-3;
/// Counted work a simulated second `[s]`.
const MOST_RATE: f64 = 0.5;
/// Counted work of a frame of 1/60 s `[ms]`.
const MOST_FRAME: f64 = 8.0;

/// What is wrong with a run, ascending.
pub(super) fn faults(found: &Findings) -> Vec<Fault> {
    let is_there = |fault: &Fault| match fault {
        Fault::TooDear => found.ended == Ended::OutOfWork,
        other => other.measured(found) > other.figure().1,
    };
    Fault::ALL.into_iter().filter(is_there).collect()
}
