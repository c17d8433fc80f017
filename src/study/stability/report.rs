//! What a study of stability leaves behind: one JSON file with everything, tables, plots, the worst scenes.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::counted::Counted;
use super::files::{SceneFile, WORST};
use super::judge::Fault;
use super::page::page;
use super::run::Ended;
use super::strain::Strains;
use super::summary::{FaultRow, Group};
use super::sweeps::{LimitRow, SweepRun};
use super::{Judged, StabilitySettings};
use crate::output::{replace, together};
use crate::study::error::StudyError;
use crate::study::machine::Machine;
use crate::study::plot;
use crate::study::report::{make_folder, ready_folder};

/// The page.
const PAGE: &str = "README.md";
/// Everything.
const DATA: &str = "stability.json";
/// Tables, without their ending.
const TABLES: [&str; 5] = ["sweeps", "limits", "cases", "groups", "faults"];
/// Plots, without their endings: of sweeps, of faults, of times.
const PLOTS: [&str; 3] = ["sweeps", "faults", "rates"];

/// A study of stability.
#[derive(Clone, Debug, Serialize)]
pub struct StabilityReport {
    /// Version of the program.
    pub version: &'static str,
    /// Commit of its source, if the caller said it.
    pub commit: Option<String>,
    /// The call.
    pub command: String,
    /// What it ran on.
    pub machine: Machine,
    /// What was run, and within what bounds.
    pub settings: StabilitySettings,
    /// Whether all of it was run.
    pub is_finished: bool,
    /// Every value of every sweep by every method.
    pub sweeps: Vec<SweepRun>,
    /// Where each method holds, degrades and breaks.
    pub limits: Vec<LimitRow>,
    /// The battery, or scenes of the user's own.
    pub judged: Vec<Judged>,
    /// The same by family, path and cause.
    pub groups: Vec<Group>,
    /// The same by class of faults.
    pub faults: Vec<FaultRow>,
    /// Scenes that are written out: those asked for by number, and the worst.
    #[serde(skip)]
    pub scenes: Vec<SceneFile>,
    /// Places of scenes that were written out earlier, and whose they are: what is meant no longer is taken away.
    #[serde(rename = "scenes", serialize_with = "places")]
    pub(super) written: Vec<(String, Option<usize>)>,
    /// An earlier study wrote to the folder: what this one does not write goes.
    #[serde(skip)]
    pub(super) takes_over: bool,
}

fn places<T: serde::Serializer>(written: &[(String, Option<usize>)], to: T) -> Result<T::Ok, T::Error> {
    to.collect_seq(written.iter().map(|(place, _)| place))
}

impl StabilityReport {
    /// Whether [`StabilityReport::write`] will find room for its files in a folder, which is made if need be. Nothing is left there.
    ///
    /// Errors: the folder cannot be made, no file can be made in it or in that of the worst scenes, or a folder stands where a file is to
    /// be.
    pub fn ready(folder: &Path) -> Result<(), StudyError> {
        ready_folder(folder)?;
        let worst = folder.join(WORST);
        if worst.exists() {
            ready_folder(&worst)?;
        }
        let tables = TABLES.map(|name| format!("{name}.csv"));
        let plots = PLOTS.iter().flat_map(|name| [format!("{name}.svg"), format!("{name}.png")]);
        let names = [PAGE, DATA].map(str::to_owned).into_iter().chain(tables).chain(plots);
        match names.map(|name| folder.join(name)).find(|file| file.is_dir()) {
            None => Ok(()),
            Some(file) => {
                let reason = std::io::Error::from(std::io::ErrorKind::IsADirectory);
                Err(StudyError::Folder { folder: file.display().to_string(), reason })
            }
        }
    }

    /// Writes all files into a folder, which is made if need be; an interrupt waits until all are there. A table without a row is not
    /// written, and one that an earlier study left goes.
    ///
    /// Errors: the folder cannot be made, a plot cannot be drawn or a file cannot be written.
    pub fn write(&mut self, folder: &Path) -> Result<(), StudyError> {
        let _whole = together();
        self.write_scenes(folder)?;
        self.write_tables(folder)?;
        let has_families = self.groups.iter().any(|group| group.by == "family");
        for (name, is_drawn) in PLOTS.into_iter().zip([!self.sweeps.is_empty(), has_families, has_families]) {
            if is_drawn {
                let plot = match name {
                    "sweeps" => plot::outcomes(&self.sweeps),
                    "faults" => plot::shares(&self.groups),
                    _ => plot::rates(&self.judged),
                };
                plot::write(folder, name, &plot)?;
            } else if self.takes_over {
                ["svg", "png"].iter().for_each(|ending| remove(&folder.join(format!("{name}.{ending}"))));
            }
        }
        Ok(())
    }

    /// What there is, in words.
    pub fn done(&self) -> String {
        match (self.sweeps.len(), self.judged.len()) {
            (0, judged) => format!("{judged} scenes"),
            (runs, 0) => format!("{runs} runs of sweeps"),
            (runs, judged) => format!("{runs} runs of sweeps, {judged} scenes"),
        }
    }

    /// Takes over a folder that an earlier study wrote to, by what it says of itself: its files go where this one does not write them too,
    /// but for those in `kept`, which are read.
    pub fn take_over(&mut self, folder: &Path, kept: &[PathBuf]) {
        let earlier = std::fs::read(folder.join(DATA)).ok().and_then(|data| serde_json::from_slice(&data).ok());
        let Some(Earlier { scenes, .. }) = earlier else { return };
        self.takes_over = true;
        let is_read = |place: &String| {
            let file = folder.join(place).canonicalize();
            file.is_ok_and(|file| kept.iter().any(|kept| kept.canonicalize().is_ok_and(|kept| kept == file)))
        };
        let is_own = |place: &String| {
            let name = place.strip_prefix(WORST).and_then(|rest| rest.strip_prefix('/')).unwrap_or(place);
            name.ends_with(".json") && name != DATA && !name.contains(['/', '\\'])
        };
        self.written =
            scenes.into_iter().filter(|place| is_own(place) && !is_read(place)).map(|place| (place, None)).collect();
    }

    fn write_scenes(&mut self, folder: &Path) -> Result<(), StudyError> {
        if self.scenes.iter().any(|scene| scene.place.starts_with(WORST)) {
            make_folder(&folder.join(WORST))?;
        }
        let meant: Vec<(String, Option<usize>)> =
            self.scenes.iter().map(|scene| (scene.place.clone(), Some(scene.subject))).collect();
        for (scene, mark) in self.scenes.iter().zip(&meant).filter(|(_, mark)| !self.written.contains(mark)) {
            scene.recording.save(&folder.join(&mark.0))?;
        }
        for (place, _) in self.written.iter().filter(|(place, _)| !meant.iter().any(|other| other.0 == *place)) {
            remove(&folder.join(place));
        }
        self.written = meant;
        Ok(())
    }

    fn write_tables(&self, folder: &Path) -> Result<(), StudyError> {
        make_folder(folder)?;
        replace(&folder.join(DATA), |to| {
            serde_json::to_writer_pretty(&mut *to, self)?;
            to.write_all(b"\n")
        })?;
        replace(&folder.join(PAGE), |to| to.write_all(page(self).as_bytes()))?;
        table(folder, TABLES[0], (self.sweeps.is_empty(), self.takes_over), |to| sweeps(&self.sweeps, to))?;
        table(folder, TABLES[1], (self.limits.is_empty(), self.takes_over), |to| rows(&self.limits, to))?;
        table(folder, TABLES[2], (self.judged.is_empty(), self.takes_over), |to| cases(&self.judged, to))?;
        table(folder, TABLES[3], (self.groups.is_empty(), self.takes_over), |to| groups(&self.groups, to))?;
        table(folder, TABLES[4], (self.faults.is_empty(), self.takes_over), |to| rows(&self.faults, to))
    }
}

fn table(
    folder: &Path,
    name: &str,
    (is_empty, goes): (bool, bool),
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), StudyError> {
    let file = folder.join(format!("{name}.csv"));
    if !is_empty {
        replace(&file, write)?;
    } else if goes {
        remove(&file);
    }
    Ok(())
}

/// Takes away a file of an earlier study; what cannot be taken away does no harm.
fn remove(file: &Path) {
    let _ = std::fs::remove_file(file);
}

/// What an earlier study says of itself and of its scenes.
#[derive(Deserialize)]
struct Earlier {
    #[serde(rename = "version")]
    _version: String,
    #[serde(rename = "settings")]
    _settings: serde_json::Value,
    #[serde(rename = "is_finished")]
    _is_finished: bool,
    scenes: Vec<String>,
}

/// A column a field.
fn rows<T: Serialize>(rows: &[T], to: &mut dyn Write) -> std::io::Result<()> {
    let mut table = csv::Writer::from_writer(to);
    rows.iter().try_for_each(|row| table.serialize(row))?;
    table.flush()
}

fn names(faults: &[Fault]) -> String {
    faults.iter().map(|fault| fault.name()).collect::<Vec<_>>().join(", ")
}

fn number(value: f64) -> String {
    format!("{value:?}")
}

fn sweeps(runs: &[SweepRun], to: &mut dyn Write) -> std::io::Result<()> {
    let mut table = csv::Writer::from_writer(to);
    table.write_record([
        "sweep", "method", "value", "outcome", "faults", "gain", "loss", "strain", "depth_m", "inverted", "unrest",
        "work_s", "refused",
    ])?;
    for SweepRun { sweep, method, value, outcome, found } in runs {
        let maybe = |value: Option<f64>| value.map_or(String::new(), number);
        table.write_record([
            (*sweep).to_owned(),
            (*method).to_owned(),
            number(*value),
            outcome.name().to_owned(),
            names(&found.faults),
            maybe(found.gain),
            maybe(found.loss),
            number(found.strain),
            number(found.depth),
            number(found.inverted),
            maybe(found.unrest),
            number(found.work_rate * found.simulated),
            refusal(&found.ended).to_owned(),
        ])?;
    }
    table.flush()
}

fn refusal(ended: &Ended) -> &str {
    if let Ended::Refused(reason) = ended { reason } else { "" }
}

fn ended(ended: &Ended) -> &'static str {
    match ended {
        Ended::Done => "done",
        Ended::NotFinite => "not finite",
        Ended::OutOfWork => "stopped by work",
        Ended::OutOfTime => "stopped by the clock",
        Ended::Refused(_) => "refused",
    }
}

/// Columns of cases before the counters.
const FOUND: [&str; 27] = [
    "name",
    "family",
    "causes",
    "path",
    "moved",
    "points",
    "bonds",
    "ended",
    "faults",
    "simulated_s",
    "work_rate_s",
    "worst_work_ms",
    "gain",
    "loss",
    "strain",
    "strain_solved",
    "strain_guarded",
    "strain_swept",
    "strain_live",
    "inverted",
    "crossings",
    "crossed",
    "depth_m",
    "friction",
    "speed_m_s",
    "unrest",
    "refused_commands",
];
/// Columns of cases behind the counters.
const TIMED: [&str; 7] = ["seconds", "rate", "frames", "median_ms", "p99_ms", "worst_ms", "refused"];

fn cases(judged: &[Judged], to: &mut dyn Write) -> std::io::Result<()> {
    let mut table = csv::Writer::from_writer(to);
    let counted = Counted::default().list().map(|(name, _)| name);
    table.write_record(FOUND.iter().chain(&counted).chain(&TIMED))?;
    for Judged { name, family, causes, found, timing, .. } in judged {
        let causes: Vec<&str> = causes.iter().map(|cause| cause.name()).collect();
        for text in [name, family, &causes.join(", "), &found.path, &found.moved] {
            table.write_field(text)?;
        }
        table.write_field(found.points.to_string())?;
        table.write_field(found.bonds.to_string())?;
        table.write_field(ended(&found.ended))?;
        table.write_field(names(&found.faults))?;
        let [gain, loss] = [found.gain, found.loss].map(|share| share.unwrap_or(f64::NAN));
        let costs = [found.simulated, found.work_rate, found.worst_work_ms, gain, loss];
        let Strains { solved, guarded, swept, live } = found.strains;
        for value in costs.into_iter().chain([found.strain, solved, guarded, swept, live, found.inverted]) {
            table.write_field(if value.is_nan() { String::new() } else { number(value) })?;
        }
        table.write_field(found.crossings.to_string())?;
        table.write_field(found.crossed.to_string())?;
        table.write_field(number(found.depth))?;
        table.write_field(found.friction.map_or(String::new(), number))?;
        table.write_field(number(found.speed))?;
        table.write_field(found.unrest.map_or(String::new(), number))?;
        table.write_field(found.refused_commands.to_string())?;
        for (_, count) in found.counters.list() {
            table.write_field(count.to_string())?;
        }
        let frames = &timing.frames;
        table.write_field(number(timing.seconds))?;
        table.write_field(number(timing.rate))?;
        table.write_field(frames.count.to_string())?;
        for value in [frames.median_ms, frames.p99_ms, frames.worst_ms] {
            table.write_field(number(value))?;
        }
        table.write_field(refusal(&found.ended))?;
        table.write_record(None::<&[u8]>)?;
    }
    table.flush()
}

fn groups(groups: &[Group], to: &mut dyn Write) -> std::io::Result<()> {
    let mut table = csv::Writer::from_writer(to);
    let head = [
        "by",
        "name",
        "cases",
        "faulty",
        "rate_p50",
        "rate_p90",
        "rate_p99",
        "work_rate_p50",
        "work_rate_p90",
        "work_rate_p99",
        "frame_p50_ms",
        "slow_frame_p50_ms",
        "worst_frame_p99_ms",
    ];
    table.write_record(head.into_iter().chain(Fault::ALL.map(Fault::name)))?;
    for group in groups {
        table.write_field(group.by)?;
        table.write_field(&group.name)?;
        table.write_field(group.cases.to_string())?;
        let rates = [group.faulty, group.rate_p50, group.rate_p90, group.rate_p99];
        let work = [group.work_rate_p50, group.work_rate_p90, group.work_rate_p99];
        let frames = [group.frame_p50_ms, group.slow_frame_p50_ms, group.worst_frame_p99_ms];
        for value in rates.into_iter().chain(work).chain(frames) {
            table.write_field(number(value))?;
        }
        for count in &group.faults {
            table.write_field(count.to_string())?;
        }
        table.write_record(None::<&[u8]>)?;
    }
    table.flush()
}
