//! The study of stability: where each method breaks, how often, and why.
//!
//! ```text
//! sweeps (scene, value, method) --run--> findings --judge--> holds, degrades, breaks --limits--> first value that fails
//! battery (number -> scene)     --run--> findings --judge--> faults --summary--> by family, path and cause
//! ```
//! Judgements go by counted work and by the motion, never by a clock: two runs agree in all of them. Times stand beside. A run has
//! bounds: it ends when it has cost too much counted work, and between two steps when it took too long.

pub mod battery;
mod causes;
mod counted;
mod files;
mod friction;
mod judge;
mod page;
mod pieces;
mod quantile;
mod report;
mod run;
mod shape;
mod sides;
mod skins;
mod strain;
mod subject;
mod summary;
mod surfaces;
mod sweeps;

use serde::Serialize;

use super::accuracy::Progress;
use super::machine::machine;
use crate::history::Recording;

pub use counted::Counted;
pub use files::SceneFile;
pub use judge::Fault;
pub(in crate::study) use page::short;
pub use report::StabilityReport;
pub use run::{Bounds, Ended, Findings, Timing};
pub use strain::Strains;
pub use subject::{Cause, Rest, Subject};
pub use summary::{FaultRow, Group};
pub use sweeps::{LimitRow, Outcome, Sweep, SweepRun, find_sweep, limits, methods, sweeps};

use battery::Family;

/// What is run, and within what bounds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StabilitySettings {
    /// The names of the sweeps.
    pub sweeps: Vec<&'static str>,
    /// The numbers of the cases of the battery.
    pub cases: Vec<u64>,
    /// Bounds of a value of a sweep.
    pub sweep_bounds: Bounds,
    /// Bounds of a case, or of a scene of the user's own.
    pub case_bounds: Bounds,
    /// How long a case runs `[s]`.
    pub case_seconds: f64,
    /// Whether this is a look only.
    pub is_quick: bool,
    /// How many of the worst scenes are kept.
    pub kept: usize,
    /// Whether times come from a run of their own, without the ledger that energy is judged by.
    pub is_timed_apart: bool,
}

/// Cases of a study.
const CASES: u64 = 1_000;
/// Cases of a look.
const FEW_CASES: u64 = 60;

impl StabilitySettings {
    /// All sweeps and the first `cases` of the battery, as many as a study or a look has if `None`; of these families alone if any are
    /// named.
    pub fn new(is_quick: bool, cases: Option<u64>, families: &[Family]) -> Self {
        let count = cases.unwrap_or(if is_quick { FEW_CASES } else { CASES });
        let is_wanted = |case: &u64| families.is_empty() || families.contains(&Family::of(*case));
        StabilitySettings {
            sweeps: sweeps().iter().map(|sweep| sweep.name).collect(),
            cases: (0..).filter(is_wanted).take(count as usize).collect(),
            sweep_bounds: Bounds { work: if is_quick { 0.1 } else { 5.0 }, seconds: 300.0 },
            case_bounds: Bounds { work: if is_quick { 0.3 } else { 20.0 }, seconds: 300.0 },
            case_seconds: if is_quick { 0.5 } else { battery::SECONDS },
            is_quick,
            kept: 20,
            is_timed_apart: !is_quick,
        }
    }
}

/// A subject with what was found.
#[derive(Clone, Debug, Serialize)]
pub struct Judged {
    /// What it is called by.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Its number in the battery.
    pub case: Option<u64>,
    /// What it has that may be to blame.
    pub causes: Vec<Cause>,
    /// What was found: the same in every run.
    pub found: Findings,
    /// What the clock says.
    pub timing: Timing,
    /// The scene of what was named, by its file or its number; those of the battery are made again by their numbers.
    #[serde(skip)]
    pub own: Option<Recording>,
}

/// Runs a subject within bounds and judges it.
pub fn judge(subject: &Subject, bounds: Bounds) -> Judged {
    let (found, timing) = run::run(subject, bounds, true);
    let Subject { name, family, case, causes, .. } = subject.clone();
    Judged { name, family, case, causes, found, timing, own: None }
}

/// Runs sweeps and battery; or, where there are `subjects` of the user's own, these alone. `progress` is told before each run, and
/// `keep` is given what there is after each.
///
/// Errors: those of `keep`.
pub fn measure_stability<E>(
    subjects: &[Subject],
    settings: &StabilitySettings,
    progress: &mut dyn FnMut(Progress<'_>),
    keep: &mut dyn FnMut(&mut StabilityReport) -> Result<(), E>,
) -> Result<StabilityReport, E> {
    let mut report = StabilityReport {
        version: env!("CARGO_PKG_VERSION"),
        commit: None,
        command: String::new(),
        machine: machine(),
        settings: settings.clone(),
        is_finished: false,
        sweeps: Vec::new(),
        limits: Vec::new(),
        judged: Vec::new(),
        groups: Vec::new(),
        faults: Vec::new(),
        scenes: Vec::new(),
        written: Vec::new(),
        takes_over: false,
    };
    let mut study = Study { settings, progress, keep, done: 0, total: 0 };
    if subjects.is_empty() {
        study.total = study.sweep_runs() + settings.cases.len() as u64;
        study.sweep(&mut report)?;
        study.battery(&mut report)?;
    } else {
        study.total = subjects.len() as u64;
        for subject in subjects {
            study.next(&subject.name);
            study.take(subject, Some(&subject.recording), &mut report)?;
        }
    }
    report.is_finished = true;
    report.sum_up();
    Ok(report)
}

/// A study under way.
struct Study<'a, E> {
    settings: &'a StabilitySettings,
    progress: &'a mut dyn FnMut(Progress<'_>),
    keep: &'a mut dyn FnMut(&mut StabilityReport) -> Result<(), E>,
    done: u64,
    total: u64,
}

impl<E> Study<'_, E> {
    fn next(&mut self, name: &str) {
        (self.progress)(Progress { problem: name, done: self.done, total: self.total });
        self.done += 1;
    }

    /// The sweeps that are run.
    fn swept(&self) -> Vec<&'static Sweep> {
        sweeps().iter().filter(|sweep| self.settings.sweeps.contains(&sweep.name)).collect()
    }

    fn sweep_runs(&self) -> u64 {
        let methods = methods(self.settings.is_quick).len();
        self.swept().iter().map(|sweep| (sweep.taken(self.settings.is_quick).len() * methods) as u64).sum()
    }

    fn sweep(&mut self, report: &mut StabilityReport) -> Result<(), E> {
        let is_quick = self.settings.is_quick;
        for sweep in self.swept() {
            for solver in methods(is_quick) {
                for value in sweep.taken(is_quick) {
                    self.next(sweep.name);
                    report.sweeps.extend(sweep.run(value, solver, self.settings.sweep_bounds));
                    (self.keep)(report)?;
                }
            }
        }
        Ok(())
    }

    fn battery(&mut self, report: &mut StabilityReport) -> Result<(), E> {
        for &case in &self.settings.cases {
            self.next(&format!("case {case}"));
            if let Ok(subject) = battery::subject(case) {
                let duration = self.settings.case_seconds;
                self.take(&Subject { duration, ..subject }, None, report)?;
            }
        }
        Ok(())
    }

    fn take(&mut self, subject: &Subject, own: Option<&Recording>, report: &mut StabilityReport) -> Result<(), E> {
        let bounds = self.settings.case_bounds;
        let mut judged = judge(subject, bounds);
        judged.own = own.cloned();
        if self.settings.is_timed_apart {
            judged.timing = run::run(subject, bounds, false).1;
        }
        report.judged.push(judged);
        (self.keep)(report)
    }
}

impl StabilityReport {
    /// Works out limits, groups, classes of faults and which scenes are written out from what there is.
    pub fn sum_up(&mut self) {
        self.limits = sweeps().iter().flat_map(|sweep| limits(sweep, &self.sweeps)).collect();
        self.groups = summary::groups(&self.judged);
        self.faults = summary::faults(&self.judged);
        self.scenes = files::scenes(&self.judged, self.settings.kept, &self.scenes);
    }
}
