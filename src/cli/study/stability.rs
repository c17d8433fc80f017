//! `wobble study stability`: where methods break, how often, and why.

use std::io::Write;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::Args;

use super::{command, commit};
use crate::cli::{progress, stop, values};
use crate::history::Start;
use crate::study::stability::battery::{self, Family};
use crate::study::stability::{
    Ended, Fault, Judged, StabilityReport, StabilitySettings, Subject, Sweep, find_sweep, measure_stability, sweeps,
};
use crate::study::{self, StudyError};

/// Least time between two copies of what was found: an interrupt loses what was done since, and the run under way.
const COPIED_EVERY: Duration = Duration::from_millis(500);
/// The same of files, which are for the case that the program is killed.
const KEPT_EVERY: Duration = Duration::from_secs(5);
/// How many times as long as it took to write it is not written again, up to [`KEPT_AT_LEAST_EVERY`].
const APART: u32 = 20;
/// The most that a program that is killed loses, but for the run under way.
const KEPT_AT_LEAST_EVERY: Duration = Duration::from_secs(60);

/// What to judge and where to write it.
#[derive(Args)]
#[command(after_help = after_help())]
pub(super) struct Stability {
    /// Scenes of your own, recordings or names of the gallery, to be judged instead of the sweeps and the battery.
    #[arg(value_name = "SCENE", conflicts_with_all = ["cases", "case", "sweep", "family"])]
    scenes: Vec<String>,
    /// Folder to write to; it is made if need be.
    #[arg(long, value_name = "DIR", default_value = "stability")]
    out: PathBuf,
    /// Fewer methods and values, 60 cases and tight bounds, for a look.
    #[arg(long)]
    quick: bool,
    /// So many cases of the battery, from the first on; 1,000 if not said.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    cases: Option<u64>,
    /// This case of the battery by its number alone; may be given several times. Its scene is written out as case-N.json.
    #[arg(long, value_name = "N", conflicts_with_all = ["cases", "family", "sweep"])]
    case: Vec<u64>,
    /// Cases of this family alone; may be given several times.
    #[arg(long, value_name = "NAME", value_parser = family)]
    family: Vec<Family>,
    /// This sweep alone, and no battery unless --cases or --family ask for it; may be given several times.
    #[arg(long, value_name = "NAME", value_parser = sweep)]
    sweep: Vec<&'static Sweep>,
    /// Judge as well whether a setting is found that keeps this error, in metres, at all samples of the scenes of one's own.
    #[arg(long, value_name = "ERROR", requires = "scenes", value_parser = values::above_zero)]
    tolerance: Option<f64>,
    /// Commit of the source, to be noted; the variable WOBBLE_COMMIT if not said.
    #[arg(long, value_name = "HASH")]
    commit: Option<String>,
}

fn after_help() -> String {
    let sweeps: Vec<&str> = sweeps().iter().map(|sweep| sweep.name).collect();
    format!(
        "Writes README.md and stability.json; limits.csv (where each method holds, degrades and breaks), sweeps.csv, cases.csv,\n\
         groups.csv (by family, path and cause), faults.csv; plots as SVG and PNG; the worst scenes in worst/.\n\
         An interrupt keeps what there is.\n\n\
         Examples:\n  wobble study stability --out stability\n  \
         wobble study stability my-scene.json --tolerance 1e-4\n  \
         wobble study stability --case 189 --out look\n  \
         wobble study stability --cases 200 --family rope --family comb\n  \
         wobble study stability --sweep stiffness --quick\n\n\
         Families:\n  {}\n\nSweeps:\n  {}",
        Family::ALL.map(Family::name).join(", "),
        sweeps.join("\n  ")
    )
}

fn family(text: &str) -> Result<Family, String> {
    let found = Family::ALL.into_iter().find(|family| family.name() == text);
    found.ok_or_else(|| format!("`{text}` is no family: use one of {}", Family::ALL.map(Family::name).join(", ")))
}

fn sweep(text: &str) -> Result<&'static Sweep, String> {
    find_sweep(text)
}

impl Stability {
    pub(super) fn run(&self, quiet: bool) -> anyhow::Result<()> {
        let (settings, subjects) = (self.settings(), self.subjects()?);
        StabilityReport::ready(&self.out)?;
        let bar = progress::tasks(quiet);
        let read: Vec<PathBuf> = self.scenes.iter().map(PathBuf::from).collect();
        let latest: Arc<Mutex<Option<StabilityReport>>> = Arc::default();
        let (mut copied, mut written, mut apart, mut is_new) = (None, Instant::now(), KEPT_EVERY, true);
        let mut keep = |report: &mut StabilityReport| {
            if std::mem::take(&mut is_new) {
                report.take_over(&self.out, &read);
                self.sign(report);
            }
            if copied.is_none_or(|at: Instant| at.elapsed() >= COPIED_EVERY) {
                *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(report.clone());
                copied = Some(Instant::now());
            }
            if written.elapsed() < apart {
                return Ok(());
            }
            let begun = Instant::now();
            report.sum_up();
            // An interrupt that waits for this to be written writes nothing older over it.
            *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(report.clone());
            report.write(&self.out)?;
            *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(report.clone());
            (written, apart) = (Instant::now(), (APART * begun.elapsed()).clamp(KEPT_EVERY, KEPT_AT_LEAST_EVERY));
            Ok(())
        };
        let keeping = stop::keeping({
            let (latest, out) = (Arc::clone(&latest), self.out.clone());
            move || {
                let mut report = latest.lock().unwrap_or_else(PoisonError::into_inner).take()?;
                report.sum_up();
                Some(match report.write(&out) {
                    Ok(()) => format!("what was judged until then ({}) is in {}", report.done(), out.display()),
                    Err(error) => format!("what was judged until then is lost: {error}"),
                })
            }
        });
        let mut show = |now: study::Progress<'_>| {
            bar.set_length(now.total);
            bar.set_position(now.done);
            bar.set_message(now.problem.to_owned());
        };
        let mut report = measure_stability::<StudyError>(&subjects, &settings, &mut show, &mut keep)?;
        bar.finish_and_clear();
        self.sign(&mut report);
        *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(report.clone());
        report.write(&self.out)?;
        drop(keeping);
        if !subjects.is_empty() {
            report.judged.iter().try_for_each(tell)?;
        }
        Ok(())
    }

    fn sign(&self, report: &mut StabilityReport) {
        report.commit = commit(&self.commit);
        report.command = command();
    }

    fn settings(&self) -> StabilitySettings {
        let mut settings = StabilitySettings::new(self.quick, self.cases, &self.family);
        if !self.sweep.is_empty() {
            settings.sweeps = self.sweep.iter().map(|sweep| sweep.name).collect();
            if self.cases.is_none() && self.family.is_empty() {
                settings.cases.clear();
            }
        } else if !self.family.is_empty() {
            settings.sweeps.clear();
        }
        settings
    }

    /// Scenes of the user's own, or single cases.
    ///
    /// Errors: a file that cannot be read.
    fn subjects(&self) -> anyhow::Result<Vec<Subject>> {
        let mut subjects = Vec::new();
        for name in &self.scenes {
            let subject = Subject::of_start(&Start::load(name)?);
            subjects.push(Subject { tolerance: self.tolerance.or(subject.tolerance), ..subject });
        }
        let mut cases = self.case.clone();
        cases.dedup();
        for &case in &cases {
            let duration = self.settings().case_seconds;
            subjects.push(Subject { duration, ..battery::subject(case)? });
        }
        Ok(subjects)
    }
}

/// A line on what was found of a subject.
fn tell(judged: &Judged) -> std::io::Result<()> {
    let found = &judged.found;
    let faults: Vec<String> = found
        .faults
        .iter()
        .map(|fault| format!("{} ({:.2e}, at most {:?})", fault.name(), fault.measured(found), fault.figure().1))
        .collect();
    let words = match &found.ended {
        Ended::Refused(reason) => format!("refused: {reason}"),
        _ if faults.is_empty() => "holds".to_owned(),
        _ => faults.join(", "),
    };
    // What was asked for is told also where it is kept.
    let told = found.told.filter(|told| told.is_finite() && !found.faults.contains(&Fault::Untold));
    let words = told.map_or(words.clone(), |told| format!("{words}; the error asked for is kept ({told:.2e} of it)"));
    writeln!(std::io::stdout(), "{}: {words}", judged.name)
}
