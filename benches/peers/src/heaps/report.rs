//! The table of the heaps on the terminal, and the file heaps.csv.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result};

use super::mesh::Mesh;
use super::run::Outcome;
use super::scenes::Scene;
use crate::report::Machine;
use crate::times::Times;

/// An engine, as rows name it.
pub(crate) struct Label {
    /// Its name.
    pub(crate) engine: &'static str,
    /// Its version.
    pub(crate) version: String,
    /// What it was set to.
    pub(crate) setting: String,
}

/// One row: an engine on a scene.
pub(crate) struct Record {
    label: Label,
    outcome: Outcome,
    scene: &'static str,
    points: usize,
    bonds: usize,
    edge: f64,
    seconds: f64,
    runs: u32,
}

impl Record {
    /// The row of some runs that all ended the same.
    pub(crate) fn new(scene: &Scene, mesh: &Mesh, label: Label, outcome: Outcome, runs: u32) -> Self {
        Record {
            label,
            outcome,
            scene: scene.name,
            points: mesh.positions.len(),
            bonds: mesh.springs.len(),
            edge: mesh.edge,
            seconds: scene.seconds as f64,
            runs,
        }
    }

    /// Time of all frames over those before all slept for good [ms].
    fn awake_ms(&self) -> f64 {
        self.outcome.times.awake_ms(self.outcome.verdict.asleep_after, self.seconds)
    }

    /// A row of the table.
    pub(crate) fn row(&self) -> String {
        let Record { scene, label: Label { engine, version, setting }, outcome: Outcome { times, verdict }, .. } = self;
        let Times { median_ms, worst_ms, mean_ms } = times;
        let never = |time: Option<f64>| time.map_or_else(|| "-".to_owned(), |time| format!("{time:.1}"));
        let [calm, asleep] = [verdict.calm_after, verdict.asleep_after].map(never);
        format!(
            "| {scene} | {engine} {version} | {setting} | {median_ms:.3} | {worst_ms:.2} | {mean_ms:.3} | {:.3} | \
             {:.3} | {} | {calm} | {asleep} |",
            self.awake_ms(),
            verdict.deepest,
            verdict.inverted,
        )
    }
}

/// Writes one table.
pub(crate) fn print(mut out: impl Write, machine: &Machine, records: &[Record]) -> io::Result<()> {
    writeln!(out, "{}, {} cores, one thread used; {}\n", machine.processor, machine.cores, machine.command)?;
    writeln!(
        out,
        "| scene | engine | setting | ms a frame: median | worst | mean | mean awake | deepest [L] | inverted | \
         calm after [s] | asleep after [s] |"
    )?;
    writeln!(out, "|---|---|---|---|---|---|---|---|---|---|---|")?;
    records.iter().try_for_each(|record| writeln!(out, "{}", record.row()))
}

/// Writes heaps.csv into `folder`, which is made if it is missing.
pub(crate) fn save(folder: &Path, machine: &Machine, records: &[Record]) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let path = folder.join("heaps.csv");
    write_csv(&path, machine, records).with_context(|| format!("cannot write {}", path.display()))
}

fn write_csv(path: &Path, machine: &Machine, records: &[Record]) -> csv::Result<()> {
    let mut table = csv::Writer::from_path(path)?;
    table.write_record([
        "engine",
        "version",
        "scene",
        "setting",
        "threads",
        "points",
        "bonds",
        "mean_edge_m",
        "seconds",
        "median_ms",
        "worst_ms",
        "mean_ms",
        "mean_awake_ms",
        "deepest_edges",
        "inverted_triangles",
        "calm_after_s",
        "asleep_after_s",
        "is_asleep",
        "runs",
        "processor",
        "cores",
        "command",
    ])?;
    let optional = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for record in records {
        let Outcome { times, verdict } = record.outcome;
        table.write_record([
            record.label.engine,
            &record.label.version,
            record.scene,
            &record.label.setting,
            "1",
            &record.points.to_string(),
            &record.bonds.to_string(),
            &record.edge.to_string(),
            &record.seconds.to_string(),
            &times.median_ms.to_string(),
            &times.worst_ms.to_string(),
            &times.mean_ms.to_string(),
            &record.awake_ms().to_string(),
            &verdict.deepest.to_string(),
            &verdict.inverted.to_string(),
            &optional(verdict.calm_after),
            &optional(verdict.asleep_after),
            &verdict.asleep_after.is_some().to_string(),
            &record.runs.to_string(),
            &machine.processor,
            &machine.cores.to_string(),
            &machine.command,
        ])?;
    }
    table.flush()?;
    Ok(())
}
