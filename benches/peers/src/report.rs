//! The table on the terminal, and the files peers.csv and peers.json.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result};
use serde::Serialize;

use crate::peer::{Peer, Setting};
use crate::run::Outcome;
use crate::scenes::{Measure, Scene};

/// One run: a row of the files.
#[derive(Clone, Serialize)]
pub(crate) struct Record {
    engine: &'static str,
    version: String,
    scene: &'static str,
    points: usize,
    bonds: usize,
    setting: String,
    /// Whether this is the engine's own setting.
    is_default: bool,
    threads: usize,
    /// Median of the frames.
    pub(crate) ms_per_frame: f64,
    mean_ms_per_frame: f64,
    max_strain: f64,
    rms_strain: f64,
    /// Only where the true positions are known.
    max_error_m: Option<f64>,
    rms_error_m: Option<f64>,
    /// What the bounds are bounds of.
    measure: Measure,
    /// The bounds that no cheaper setting of this engine met.
    pub(crate) targets: Vec<f64>,
    /// False if the run was given up: strains are then lower bounds.
    is_finished: bool,
}

impl Record {
    /// The row of one run.
    pub(crate) fn new<P: Peer>(scene: &Scene, setting: Setting<P::Way>, outcome: &Outcome, is_default: bool) -> Self {
        Record {
            engine: P::NAME,
            version: P::version(),
            scene: scene.name,
            points: scene.positions.len(),
            bonds: scene.bonds.len(),
            setting: setting.to_string(),
            is_default,
            threads: 1,
            ms_per_frame: outcome.median_ms,
            mean_ms_per_frame: outcome.mean_ms,
            max_strain: outcome.strain.max,
            rms_strain: outcome.strain.rms,
            max_error_m: outcome.error.map(|error| error.max),
            rms_error_m: outcome.error.map(|error| error.rms),
            measure: scene.measure(),
            targets: Vec::new(),
            is_finished: outcome.is_finished,
        }
    }

    /// Whether the whole run stayed within `bound`.
    pub(crate) fn meets(&self, bound: f64) -> bool {
        self.is_finished && self.judged().0 <= bound
    }

    /// One line while a climb goes on.
    pub(crate) fn progress(&self) -> String {
        let Record { engine, scene, setting, ms_per_frame, .. } = self;
        format!("{engine}: {scene}: {setting}: {ms_per_frame:.4} ms, {}", self.deviations(" (RMS ", ")"))
    }

    /// The largest deviation and the root mean square, with `between` and `after`.
    fn deviations(&self, between: &str, after: &str) -> String {
        let (max, rms) = self.judged();
        let least = if self.is_finished { "" } else { "> " };
        let unit = if self.max_error_m.is_some() { " m" } else { "" };
        format!("{least}{max:.1e}{unit}{between}{rms:.1e}{unit}{after}")
    }

    /// Largest value and root mean square of what the scene is judged by; of strain if the end was not reached.
    fn judged(&self) -> (f64, f64) {
        match (self.max_error_m, self.rms_error_m) {
            (Some(max), Some(rms)) => (max, rms),
            _ => (self.max_strain, self.rms_strain),
        }
    }
}

/// Where and how the figures were measured.
#[derive(Serialize)]
pub(crate) struct Machine {
    /// Its name.
    pub(crate) processor: String,
    /// How many threads it runs at once.
    pub(crate) cores: usize,
    /// What was typed.
    pub(crate) command: String,
}

impl Machine {
    /// This machine, and the command that started this process as one would type it in this crate's folder.
    pub(crate) fn current() -> Self {
        let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
        let quoted = |word: String| if word.contains(char::is_whitespace) { format!("\"{word}\"") } else { word };
        let arguments = std::env::args().skip(1).map(|argument| format!(" {}", quoted(argument)));
        Machine {
            processor: model.map_or("unknown", |(_, name)| name).trim().to_owned(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            command: format!("cargo run --release --{}", arguments.collect::<String>()),
        }
    }
}

/// Writes one table: for each scene and engine its default, then the cheapest setting that met each bound.
///
/// `climbs`: the records of one scene and engine each; the first record is the default's.
pub(crate) fn print(mut out: impl Write, machine: &Machine, climbs: &[Vec<Record>]) -> io::Result<()> {
    writeln!(out, "{}, {} cores, one thread used; {}\n", machine.processor, machine.cores, machine.command)?;
    writeln!(out, "| scene | engine | bound | ms a frame | largest | RMS | setting |")?;
    writeln!(out, "|---|---|---|---|---|---|---|")?;
    for records in climbs {
        let Some(default) = records.first() else { continue };
        let Record { scene, engine, version, .. } = default;
        let mut row = |bound: &str, record: Option<&Record>| {
            let found = record.map(|record| {
                let deviations = record.deviations(" | ", "");
                format!("{:.3} | {deviations} | {}", record.ms_per_frame, record.setting)
            });
            let cells = found.as_deref().unwrap_or("- | | | not within the limits");
            writeln!(out, "| {scene} | {engine} {version} | {bound} | {cells} |")
        };
        row("default", Some(default))?;
        for bound in default.measure.bounds() {
            row(&format!("<= {bound}"), records.iter().find(|record| record.targets.contains(bound)))?;
        }
    }
    Ok(())
}

/// Writes peers.csv and peers.json into `folder`, which is made if it is missing.
pub(crate) fn save(folder: &Path, machine: &Machine, climbs: &[Vec<Record>]) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let path = folder.join("peers.json");
    let text = serde_json::to_string_pretty(&Report { machine, runs: climbs.iter().flatten().collect() })?;
    fs::write(&path, text + "\n").with_context(|| format!("cannot write {}", path.display()))?;
    let path = folder.join("peers.csv");
    write_csv(&path, machine, climbs).with_context(|| format!("cannot write {}", path.display()))
}

/// The file peers.json; a strain that is not a finite number is null in it.
#[derive(Serialize)]
struct Report<'a> {
    machine: &'a Machine,
    runs: Vec<&'a Record>,
}

/// One row a run; several bounds in one field are parted by spaces.
fn write_csv(path: &Path, machine: &Machine, climbs: &[Vec<Record>]) -> csv::Result<()> {
    let mut table = csv::Writer::from_path(path)?;
    table.write_record([
        "engine",
        "version",
        "scene",
        "points",
        "bonds",
        "setting",
        "is_default",
        "threads",
        "ms_per_frame",
        "mean_ms_per_frame",
        "max_strain",
        "rms_strain",
        "target_strain",
        "max_error_m",
        "rms_error_m",
        "target_error_m",
        "is_finished",
        "processor",
        "cores",
        "command",
    ])?;
    let optional = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for record in climbs.iter().flatten() {
        let bounds = record.targets.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let (strains, errors) = match record.measure {
            Measure::Strain => (bounds, String::new()),
            Measure::Error => (String::new(), bounds),
        };
        table.write_record([
            record.engine,
            &record.version,
            record.scene,
            &record.points.to_string(),
            &record.bonds.to_string(),
            &record.setting,
            &record.is_default.to_string(),
            &record.threads.to_string(),
            &record.ms_per_frame.to_string(),
            &record.mean_ms_per_frame.to_string(),
            &record.max_strain.to_string(),
            &record.rms_strain.to_string(),
            &strains,
            &optional(record.max_error_m),
            &optional(record.rms_error_m),
            &errors,
            &record.is_finished.to_string(),
            &machine.processor,
            &machine.cores.to_string(),
            &machine.command,
        ])?;
    }
    table.flush()?;
    Ok(())
}
