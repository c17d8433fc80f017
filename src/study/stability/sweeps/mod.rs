//! The sweeps: one quantity of a small scene from harmless to absurd, by every method.

mod limits;
mod scenes;
mod table;

use serde::Serialize;

use super::judge::Fault;
use super::run::{Bounds, Ended, Findings, run};
use super::subject::Subject;
use crate::scene::{PrecisionName, SolverName};

pub use limits::{LimitRow, limits};
pub use table::sweeps;

use table::Setup;

/// One quantity that is swept.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// Its name in calls and tables.
    pub name: &'static str,
    /// What its values are, with the unit.
    pub quantity: &'static str,
    /// The values, ascending.
    pub values: &'static [f64],
    /// The place of the most harmless value.
    pub home: usize,
    setup: fn(f64) -> Setup,
}

/// How a method takes a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Nothing is wrong.
    Holds,
    /// Something is wrong, and the motion is still one.
    Degrades,
    /// Not finite, twice the energy, bonds of twice their length, or no end.
    Breaks,
    /// The method does not take the scene.
    Refused,
}

impl Outcome {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Outcome::Holds => "holds",
            Outcome::Degrades => "degrades",
            Outcome::Breaks => "breaks",
            Outcome::Refused => "refused",
        }
    }

    /// What findings come to. What a small scene costs is no judgement here, but where it has no end; and soft bodies may fold where
    /// folding is not what is swept.
    fn of(found: &Findings, may_fold: bool) -> Outcome {
        let is_counted = |fault: &Fault| match fault {
            Fault::Slow | Fault::Frame => false,
            Fault::Inverted => !may_fold,
            _ => true,
        };
        match found.ended {
            Ended::Refused(_) => Outcome::Refused,
            Ended::NotFinite | Ended::OutOfWork | Ended::OutOfTime => Outcome::Breaks,
            Ended::Done if found.gain.is_some_and(|gain| gain > DOUBLED) || found.strain > 1.0 => Outcome::Breaks,
            Ended::Done if found.faults.iter().any(is_counted) => Outcome::Degrades,
            Ended::Done => Outcome::Holds,
        }
    }
}

/// Gain, as a share of the largest kinetic energy so far, at which half of that came from nowhere `[1]`.
const DOUBLED: f64 = 0.5;

/// A value of a sweep by a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SweepRun {
    /// The sweep.
    pub sweep: &'static str,
    /// The solver.
    pub method: &'static str,
    /// The value.
    pub value: f64,
    /// How it went.
    pub outcome: Outcome,
    /// What was found.
    pub found: Findings,
}

/// The sweep of a name.
///
/// Errors: one line with all names.
pub fn find_sweep(name: &str) -> Result<&'static Sweep, String> {
    let found = sweeps().iter().find(|sweep| sweep.name == name);
    found.ok_or_else(|| {
        let names: Vec<&str> = sweeps().iter().map(|sweep| sweep.name).collect();
        format!("`{name}` is no sweep: use one of {}", names.join(", "))
    })
}

/// The methods that are swept: all that a scene can name in this version.
pub fn methods(is_quick: bool) -> Vec<SolverName> {
    let named = crate::sim::Solver::ALL.iter().filter_map(|solver| solver.name().parse().ok());
    let few = [SolverName::Auto, SolverName::Verlet, SolverName::Rk4, SolverName::ImplicitMidpoint, SolverName::Xpbd];
    named.filter(|solver| !is_quick || few.contains(solver)).collect()
}

impl Sweep {
    /// The values that are run: of a quick study the ends and the most harmless one.
    pub fn taken(&self, is_quick: bool) -> Vec<f64> {
        let is_few = |place: usize| place == 0 || place == self.home || place + 1 == self.values.len();
        let of = |(place, value): (usize, &f64)| (!is_quick || is_few(place)).then_some(*value);
        self.values.iter().enumerate().filter_map(of).collect()
    }

    /// The subject of a value, by a solver; `None` where the scene itself is refused, which a test excludes.
    pub(super) fn subject(&self, value: f64, solver: SolverName) -> Option<Subject> {
        let setup = (self.setup)(value);
        let mut recording = super::battery::recording(&setup.scene, setup.commands).ok()?;
        if setup.is_laid && !super::battery::lay_down(&mut recording.scene) {
            return None;
        }
        let method = &mut recording.scene.method;
        method.solver = Some(solver);
        // `auto` has to know by itself, but where the substep is what is swept.
        method.substep = if solver == SolverName::Auto && !setup.is_forced { None } else { Some(setup.substep) };
        method.precision = Some(setup.precision.unwrap_or(PrecisionName::F64));
        method.sleep = Some(false);
        method.iterations = matches!(solver, SolverName::Xpbd | SolverName::Relaxation).then_some(SWEEPS);
        let name = format!("{}-{value:e}-{solver}", self.name);
        let (family, causes) = (self.name.to_owned(), Vec::new());
        let Setup { seconds: duration, rest, .. } = setup;
        Some(Subject { name, family, case: None, causes, recording, duration, rest, tolerance: None })
    }

    /// Runs a value by a solver.
    pub(super) fn run(&self, value: f64, solver: SolverName, bounds: Bounds) -> Option<SweepRun> {
        let subject = self.subject(value, solver)?;
        let (found, _) = run(&subject, bounds, true);
        let outcome = Outcome::of(&found, subject.recording.scene.triangles.is_empty());
        Some(SweepRun { sweep: self.name, method: solver.name(), value, outcome, found })
    }
}

/// Sweeps over the bonds in a substep, of the methods that sweep.
const SWEEPS: u32 = 16;

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds { work: 0.5, seconds: 60.0 };

    fn outcome(sweep: &str, value: f64, solver: SolverName) -> Outcome {
        find_sweep(sweep).unwrap().run(value, solver, BOUNDS).unwrap().outcome
    }

    #[test]
    fn every_value_makes_a_scene_that_auto_takes() {
        for sweep in sweeps() {
            assert!(sweep.values.is_sorted() && sweep.home < sweep.values.len(), "{}", sweep.name);
            for &value in sweep.values {
                let subject = sweep.subject(value, SolverName::Auto);
                let subject = subject.unwrap_or_else(|| panic!("{} at {value}", sweep.name));
                let world = subject.recording.scene.world(None);
                world.unwrap_or_else(|error| panic!("{} at {value}: {error}", sweep.name));
            }
        }
    }

    #[test]
    fn what_is_known_to_break_is_seen_to_break() {
        use SolverName::*;
        // omega h: 0.4 and 6; Euler's method gains at any step.
        assert_eq!(outcome("substep of springs", 1e-3, Verlet), Outcome::Holds);
        assert_eq!(outcome("substep of springs", 1.0 / 16.0, Verlet), Outcome::Breaks);
        assert_ne!(outcome("substep of springs", 4e-3, Euler), Outcome::Holds);
        assert_eq!(outcome("stiffness", 1e3, Rk4), Outcome::Breaks);
        assert_eq!(outcome("stiffness", 1e12, ImplicitMidpoint), Outcome::Holds);
        assert_eq!(outcome("stiffness", 100.0, Relaxation), Outcome::Refused);
        // It damps what it does not resolve.
        assert_eq!(outcome("minutes of springs", 10.0, BackwardEuler), Outcome::Degrades);
        assert_eq!(outcome("minutes of springs", 10.0, Pefrl), Outcome::Holds);
    }
}
