//! The table of the rigid bodies on the terminal, and the files rigid.csv and rigid.json.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result};
use serde::Serialize;

use super::judge::Verdict;
use super::run::Outcome;
use super::scenes::Scene;
use crate::report::Machine;
use crate::times::Times;

/// One row: an engine on a scene.
#[derive(Serialize)]
pub(super) struct Record {
    scene: &'static str,
    bodies: usize,
    /// Of each body; they mean nothing to engines whose bodies have no points.
    points: usize,
    engine: &'static str,
    version: String,
    /// The shape of its bodies, or wobble's precision.
    setting: &'static str,
    threads: usize,
    median_ms: f64,
    worst_ms: f64,
    mean_ms: f64,
    mean_awake_ms: f64,
    error_m: Option<f64>,
    error_rad: Option<f64>,
    gained_m: f64,
    deepest_m: f64,
    creep_m: Option<f64>,
    calm_after_s: Option<f64>,
    asleep_after_s: Option<f64>,
    seconds: f64,
    runs: u32,
    /// Of wobble (`auto`) over this row: 1 and more is slower or more wrong.
    ratio_mean_awake: Option<f64>,
    ratio_worst: Option<f64>,
    ratio_error: Option<f64>,
}

impl Record {
    /// The row of some runs that all ended the same.
    pub(super) fn new(
        scene: &Scene,
        points: usize,
        (engine, version, setting): (&'static str, String, &'static str),
        Outcome { times, verdict }: Outcome,
        runs: u32,
    ) -> Self {
        let Times { median_ms, worst_ms, mean_ms } = times;
        let Verdict { error_m, error_rad, gained_m, deepest_m, creep_m, calm_after_s, asleep_after_s } = verdict;
        Record {
            scene: scene.name,
            bodies: scene.bodies,
            points,
            engine,
            version,
            setting,
            threads: 1,
            median_ms,
            worst_ms,
            mean_ms,
            mean_awake_ms: times.awake_ms(asleep_after_s, scene.seconds),
            error_m,
            error_rad,
            gained_m,
            deepest_m,
            creep_m,
            calm_after_s,
            asleep_after_s,
            seconds: scene.seconds,
            runs,
            ratio_mean_awake: None,
            ratio_worst: None,
            ratio_error: None,
        }
    }

    /// Takes the ratios to wobble's row of the same scene.
    pub(super) fn compare(&mut self, wobble: &Record) {
        self.ratio_mean_awake = Some(wobble.mean_awake_ms / self.mean_awake_ms);
        self.ratio_worst = Some(wobble.worst_ms / self.worst_ms);
        self.ratio_error = wobble.error_m.zip(self.error_m).map(|(own, other)| own / other);
    }

    /// A row of the table.
    pub(super) fn row(&self) -> String {
        let text = |value: Option<f64>, digits: usize| {
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
        };
        let small = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1e}"));
        let ratio = |value: Option<f64>| match value {
            Some(value) if (0.01..1000.0).contains(&value) => format!("{value:.2}"),
            _ => small(value),
        };
        let Record { scene, engine, version, setting, median_ms, worst_ms, mean_awake_ms, .. } = self;
        format!(
            "| {scene} | {engine} {version} | {setting} | {median_ms:.4} | {worst_ms:.3} | {mean_awake_ms:.4} | {} | {} | \
             {:.1e} | {:.1e} | {} | {} | {} | {} | {} | {} |",
            small(self.error_m),
            small(self.error_rad),
            self.gained_m,
            self.deepest_m,
            small(self.creep_m),
            text(self.calm_after_s, 1),
            text(self.asleep_after_s, 1),
            ratio(self.ratio_mean_awake),
            ratio(self.ratio_worst),
            ratio(self.ratio_error),
        )
    }
}

/// Writes one table.
pub(super) fn print(mut out: impl Write, machine: &Machine, records: &[Record]) -> io::Result<()> {
    writeln!(out, "{}, {} cores, one thread used; {}\n", machine.processor, machine.cores, machine.command)?;
    writeln!(
        out,
        "| scene | engine | setting | ms a frame: median | worst | mean awake | error [m] | turn [rad] | gained [m] | \
         deepest [m] | creep [m] | calm after [s] | asleep after [s] | wobble/it: mean awake | worst | error |"
    )?;
    writeln!(out, "|{}", "---|".repeat(16))?;
    records.iter().try_for_each(|record| writeln!(out, "{}", record.row()))
}

/// Writes rigid.csv and rigid.json into `folder`, which is made if it is missing.
pub(super) fn save(folder: &Path, machine: &Machine, records: &[Record]) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let path = folder.join("rigid.json");
    let text = serde_json::to_string_pretty(&Report { machine, runs: records })?;
    fs::write(&path, text + "\n").with_context(|| format!("cannot write {}", path.display()))?;
    let path = folder.join("rigid.csv");
    write_csv(&path, machine, records).with_context(|| format!("cannot write {}", path.display()))
}

/// The file rigid.json; what is not a finite number is null in it.
#[derive(Serialize)]
struct Report<'a> {
    machine: &'a Machine,
    runs: &'a [Record],
}

/// A row a run.
fn write_csv(path: &Path, machine: &Machine, records: &[Record]) -> csv::Result<()> {
    let mut table = csv::Writer::from_path(path)?;
    records.iter().try_for_each(|record| table.serialize((record, machine)))?;
    table.flush()?;
    Ok(())
}
