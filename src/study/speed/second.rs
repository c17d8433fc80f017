//! The same frames and sweeps on all cores, in a process of its own: threads are decided once a process.

use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};

use super::super::error::StudyError;
use super::kernels::KernelRow;
use super::run::SpeedRun;
use crate::sim::InstructionSet;

/// The scenes that are run again: large ones, that gain, and small ones, that must not lose.
const SCENES: [&str; 9] =
    ["rope-1000", "rope-100k", "net-316", "hard-32", "hard-100", "hard-316", "hard-1000", "rims-1000", "disc-100k"];

/// A row of `threads.csv`: a frame or a step on one thread and on several.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ThreadRow {
    /// The scene, or what the body of a sweep is.
    pub scene: String,
    /// Its points.
    pub points: usize,
    /// What was run.
    pub method: String,
    /// Threads of the other process.
    pub threads: usize,
    /// On one thread `[ms]`.
    pub one_ms: f64,
    /// On all of them `[ms]`.
    pub all_ms: f64,
    /// The first over the second. The two were measured one after the other, not in turn.
    pub ratio: f64,
}

/// What is read of a row of the other process's tables.
#[derive(Deserialize)]
struct Frames {
    scene: String,
    method: String,
    median_ms: f64,
}

#[derive(Deserialize)]
struct Sweeps {
    family: String,
    points: usize,
    precision: String,
    step_ms: f64,
}

/// Whether a scene is run again.
pub(super) fn is_measured(scene: &str) -> bool {
    SCENES.contains(&scene)
}

/// Runs `program` on `threads` threads into `folder` and compares its tables with runs on one thread.
///
/// Errors: it cannot be started or fails, or its tables cannot be read.
pub(super) fn measure(
    program: &Path,
    folder: &Path,
    threads: usize,
    is_quick: bool,
    (runs, kernels): (&[SpeedRun], &[KernelRow]),
) -> Result<Vec<ThreadRow>, StudyError> {
    let failed = |reason: String| StudyError::Program { program: program.display().to_string(), reason };
    let mut scenes: Vec<&str> = runs.iter().map(|run| run.scene).filter(|scene| is_measured(scene)).collect();
    scenes.dedup();
    if scenes.is_empty() && kernels.is_empty() {
        return Ok(Vec::new());
    }
    let mut command = Command::new(program);
    command.args(["study", "speed"]).args(&scenes).arg("--out").arg(folder);
    command.args(["--threads", &threads.to_string(), "--instruction-set", InstructionSet::chosen().name()]);
    if !scenes.is_empty() {
        command.args(["--part", "frames"]);
    }
    if !kernels.is_empty() {
        command.args(["--part", "sweeps"]);
    }
    if is_quick {
        command.arg("--quick");
    }
    let done = command.output().map_err(|error| failed(error.to_string()))?;
    if !done.status.success() {
        return Err(failed(String::from_utf8_lossy(&done.stderr).trim().to_owned()));
    }
    let mut rows = Vec::new();
    if !scenes.is_empty() {
        rows.extend(compare_frames(runs, &read::<Frames>(&folder.join("frames.csv"))?, threads));
    }
    if !kernels.is_empty() {
        rows.extend(compare_sweeps(kernels, &read::<Sweeps>(&folder.join("kernels.csv"))?, threads));
    }
    Ok(rows)
}

fn read<T: for<'a> Deserialize<'a>>(path: &Path) -> Result<Vec<T>, StudyError> {
    let failed = |error: csv::Error| StudyError::Table { file: path.display().to_string(), reason: error.to_string() };
    let mut table = csv::Reader::from_path(path).map_err(failed)?;
    table.deserialize().collect::<Result<_, _>>().map_err(failed)
}

fn compare_frames(runs: &[SpeedRun], others: &[Frames], threads: usize) -> Vec<ThreadRow> {
    let row = |run: &SpeedRun| {
        let other = others.iter().find(|other| other.scene == run.scene && other.method == run.method)?;
        Some(ThreadRow {
            scene: run.scene.to_owned(),
            points: run.points,
            method: run.method.clone(),
            threads,
            one_ms: run.median_ms,
            all_ms: other.median_ms,
            ratio: run.median_ms / other.median_ms,
        })
    };
    runs.iter().filter_map(row).collect()
}

fn compare_sweeps(kernels: &[KernelRow], others: &[Sweeps], threads: usize) -> Vec<ThreadRow> {
    let chosen = InstructionSet::chosen().name();
    let row = |kernel: &KernelRow| {
        let is_same = |other: &&Sweeps| {
            other.family == kernel.family && other.points == kernel.points && other.precision == kernel.precision
        };
        let other = others.iter().find(is_same)?;
        Some(ThreadRow {
            scene: kernel.family.to_owned(),
            points: kernel.points,
            method: format!("a step of one sweep, {}", kernel.precision),
            threads,
            one_ms: kernel.step_ms,
            all_ms: other.step_ms,
            ratio: kernel.step_ms / other.step_ms,
        })
    };
    kernels.iter().filter(|kernel| kernel.instruction_set == chosen).filter_map(row).collect()
}
