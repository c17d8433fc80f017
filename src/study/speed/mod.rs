//! The study of speed: what a frame costs at a strain, what a sweep costs beside a plain program, and whether what is
//! not needed is skipped.
//!
//! ```text
//! scenes --run--> frames --rules--> settings that auto could have taken
//!     \             \--peers, growth, second core--> ratios, exponents
//!      \--kernels, beside the naive program--> ns a bond
//! ```
//! "Fast and stretchy" is not the same work as "fast and stiff": every time stands beside the strain that it was reached
//! with. Times are medians; what is compared is measured in turn. Nothing here decides anything in the program, whose
//! rules know no clock.

mod clock;
mod growth;
mod kernels;
pub mod naive;
pub(super) mod peers;
mod reference;
mod report;
mod rules;
mod run;
mod scenes;
mod second;
mod skipping;
mod strain;
mod targets;

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::accuracy::Progress;
use super::error::StudyError;
use super::machine::machine;
use crate::sim::InstructionSet;

pub use growth::GrowthRow;
pub use kernels::KernelRow;
pub use peers::PeerRatio;
pub use reference::ReferenceRow;
pub use report::SpeedReport;
pub use rules::RuleRow;
pub use run::SpeedRun;
pub use scenes::{SpeedScene, find_speed_scene, speed_scenes};
pub use second::ThreadRow;
pub use skipping::SkipRow;
pub use targets::TargetRow;

use run::Limits;

/// Strains that scenes are held to `[1]`.
const STRAINS: [f64; 2] = [rules::STRAIN, 1e-3];
/// The scenes of a quick study.
const FEW: [&str; 3] = ["rope-1000", "hard-32", "rims-40"];

/// A part of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// What a frame costs with `auto`, and how that grows.
    Frames,
    /// What a sweep costs.
    Sweeps,
    /// Whether the rules chose well.
    Rules,
    /// A rope whose motion is known.
    Rope50,
    /// What is not needed.
    Skipping,
    /// The same on all cores.
    Threads,
}

impl Part {
    /// All.
    pub const ALL: [Part; 6] = [Part::Frames, Part::Sweeps, Part::Rules, Part::Rope50, Part::Skipping, Part::Threads];

    /// Its name in calls.
    pub fn name(self) -> &'static str {
        match self {
            Part::Frames => "frames",
            Part::Sweeps => "sweeps",
            Part::Rules => "rules",
            Part::Rope50 => "rope50",
            Part::Skipping => "skipping",
            Part::Threads => "threads",
        }
    }
}

/// What is measured and for how long.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedSettings {
    /// The parts.
    pub parts: Vec<Part>,
    /// Wall time of the longest run `[s]`: beyond, a run ends and is marked.
    pub run_seconds: f64,
    /// Wall time that frames or sweeps which are compared are read for `[s]`.
    pub reading_seconds: f64,
    /// Largest size of sweeps: 0 a thousand points, 3 a million.
    pub largest: usize,
    /// Threads that this process may use.
    pub threads: usize,
    /// Whether all instruction sets are measured, or only the chosen one.
    pub all_sets: bool,
    /// Whether this is a look only.
    pub is_quick: bool,
    /// This program, to be started again with more threads; `None`: it is not.
    #[serde(skip)]
    pub program: Option<PathBuf>,
}

impl SpeedSettings {
    /// All parts, on `threads` threads.
    pub fn new(is_quick: bool, threads: usize) -> Self {
        SpeedSettings {
            parts: Part::ALL.to_vec(),
            run_seconds: if is_quick { 2.0 } else { 12.0 },
            reading_seconds: if is_quick { 0.01 } else { 0.2 },
            largest: if is_quick { 0 } else { 3 },
            threads,
            all_sets: true,
            is_quick,
            program: None,
        }
    }

    fn has(&self, part: Part) -> bool {
        self.parts.contains(&part)
    }

    /// The scenes that are measured where none is named.
    pub fn scenes(&self) -> Vec<&'static SpeedScene> {
        speed_scenes().iter().filter(|scene| !self.is_quick || FEW.contains(&scene.name)).collect()
    }
}

/// Measures scenes and sweeps; `progress` is told before each piece of work. Other engines' times are taken from
/// `folder`/peers.csv, if there is such a file.
///
/// Errors: a built-in scene that is out of order, a table of peers that cannot be read, a second process that fails.
pub fn measure_speed(
    scenes: &[&'static SpeedScene],
    settings: &SpeedSettings,
    folder: &Path,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Result<SpeedReport, StudyError> {
    let total = scenes.len() as u64 + kernels::count(settings.largest) + 2;
    let mut done = 0;
    let mut next = |problem: &str| {
        progress(Progress { problem, done, total });
        done += 1;
    };
    let mut report = empty(settings);
    for scene in scenes {
        next(scene.name);
        measure_scene(scene, settings, &mut report)?;
    }
    if settings.has(Part::Sweeps) {
        let sets = if settings.all_sets { InstructionSet::ALL.to_vec() } else { vec![InstructionSet::chosen()] };
        let (threads, seconds) = (settings.threads, settings.reading_seconds);
        report.kernels = kernels::measure(settings.largest, &sets, threads, seconds, &mut next)?;
    }
    if settings.has(Part::Rope50) {
        next("rope-50");
        report.rope50 = reference::measure()?;
    }
    let autos: Vec<SpeedRun> = report.frames.iter().filter(|run| run.max_strain_asked.is_some()).cloned().collect();
    report.growth = growth::exponents(&autos);
    let all = report.machine.threads;
    if let (Some(program), true, true) = (&settings.program, settings.has(Part::Threads), all > settings.threads) {
        next("all cores");
        let into = folder.join(format!("threads-{all}"));
        report.threads = second::measure(program, &into, all, settings.is_quick, (&autos, &report.kernels))?;
    }
    report.ratios = peers::compare(&peers::read(&folder.join("peers.csv"))?, &report.frames, &report.rope50);
    report.targets = targets::judge(&report);
    Ok(report)
}

fn empty(settings: &SpeedSettings) -> SpeedReport {
    SpeedReport {
        version: env!("CARGO_PKG_VERSION"),
        commit: None,
        command: String::new(),
        machine: machine(),
        settings: settings.clone(),
        frames: Vec::new(),
        kernels: Vec::new(),
        rules: Vec::new(),
        growth: Vec::new(),
        rope50: Vec::new(),
        skipping: Vec::new(),
        threads: Vec::new(),
        ratios: Vec::new(),
        targets: Vec::new(),
    }
}

/// Frames of a scene, with what else is measured on it.
fn measure_scene(
    scene: &'static SpeedScene,
    settings: &SpeedSettings,
    report: &mut SpeedReport,
) -> Result<(), StudyError> {
    let limits = Limits { seconds: settings.run_seconds, strain: f64::INFINITY };
    let with_rules = settings.has(Part::Rules) && rules::is_compared(scene);
    let with_frames = settings.has(Part::Frames) || with_rules;
    let with_skipping = settings.has(Part::Skipping) && skipping::is_measured(scene);
    if !with_frames && !with_skipping {
        return Ok(());
    }
    let model = scene.model()?;
    if with_frames {
        let first = report.frames.len();
        for strain in STRAINS {
            let method = (run::paths(strain), format!("strain {strain}, paths"));
            report.frames.push(run::run(scene, &model, method, settings.threads, limits)?);
        }
        if with_rules {
            let auto = report.frames[first].clone();
            let (row, runs) = rules::measure(scene, &model, &auto, settings.run_seconds)?;
            report.rules.push(row);
            report.frames.extend(runs);
        }
    }
    if with_skipping {
        report.skipping.extend(skipping::measure(scene, &model, settings.reading_seconds)?);
    }
    Ok(())
}
