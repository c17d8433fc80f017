//! What a study of stability leaves behind: one JSON file with everything, tables, plots, the worst scenes.

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use super::judge::Fault;
use super::page::page;
use super::run::Ended;
use super::summary::{FaultRow, Group};
use super::sweeps::{LimitRow, SweepRun};
use super::{Judged, StabilitySettings};
use crate::output::replace;
use crate::study::error::StudyError;
use crate::study::machine::Machine;
use crate::study::plot;
use crate::study::report::make_folder;

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
}

impl StabilityReport {
    /// Writes all files into a folder, which is made if need be. A table without a row is not written.
    ///
    /// Errors: the folder cannot be made, a plot cannot be drawn or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        self.write_tables(folder)?;
        for judged in &self.judged {
            if let Some(recording) = &judged.kept {
                let scenes = folder.join("worst");
                make_folder(&scenes)?;
                recording.save(&scenes.join(format!("{}.json", judged.name)))?;
            }
        }
        if !self.sweeps.is_empty() {
            plot::write(folder, "sweeps", &plot::outcomes(&self.sweeps))?;
        }
        if self.groups.iter().any(|group| group.by == "family") {
            plot::write(folder, "faults", &plot::shares(&self.groups))?;
            plot::write(folder, "rates", &plot::rates(&self.judged))?;
        }
        Ok(())
    }

    /// Writes what there is so far, but for plots and scenes.
    ///
    /// Errors: the folder cannot be made, a file cannot be written.
    pub fn write_tables(&self, folder: &Path) -> Result<(), StudyError> {
        make_folder(folder)?;
        replace(&folder.join("stability.json"), |to| {
            serde_json::to_writer_pretty(&mut *to, self)?;
            to.write_all(b"\n")
        })?;
        replace(&folder.join("README.md"), |to| to.write_all(page(self).as_bytes()))?;
        table(folder, "sweeps", self.sweeps.is_empty(), |to| sweeps(&self.sweeps, to))?;
        table(folder, "limits", self.limits.is_empty(), |to| rows(&self.limits, to))?;
        table(folder, "cases", self.judged.is_empty(), |to| cases(&self.judged, to))?;
        table(folder, "groups", self.groups.is_empty(), |to| groups(&self.groups, to))?;
        table(folder, "faults", self.faults.is_empty(), |to| rows(&self.faults, to))
    }
}

fn table(
    folder: &Path,
    name: &str,
    is_empty: bool,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), StudyError> {
    if is_empty { Ok(()) } else { Ok(replace(&folder.join(format!("{name}.csv")), write)?) }
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

fn cases(judged: &[Judged], to: &mut dyn Write) -> std::io::Result<()> {
    let mut table = csv::Writer::from_writer(to);
    table.write_record([
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
        "inverted",
        "crossings",
        "depth_m",
        "friction",
        "speed_m_s",
        "unrest",
        "refused_commands",
        "substeps",
        "bonds_solved",
        "points_moved",
        "iterations",
        "events",
        "guard_splits",
        "fallbacks",
        "bonds_torn",
        "hand_overs",
        "returns",
        "seconds",
        "rate",
        "frames",
        "median_ms",
        "p99_ms",
        "worst_ms",
        "refused",
    ])?;
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
        for value in [found.simulated, found.work_rate, found.worst_work_ms, gain, loss, found.strain, found.inverted] {
            table.write_field(if value.is_nan() { String::new() } else { number(value) })?;
        }
        table.write_field(found.crossings.to_string())?;
        table.write_field(number(found.depth))?;
        table.write_field(found.friction.map_or(String::new(), number))?;
        table.write_field(number(found.speed))?;
        table.write_field(found.unrest.map_or(String::new(), number))?;
        table.write_field(found.refused_commands.to_string())?;
        let c = &found.counters;
        let counts = [
            c.substeps,
            c.bonds_solved,
            c.points_moved,
            c.iterations,
            c.events,
            c.guard_splits,
            c.fallbacks,
            c.bonds_torn,
            c.hand_overs,
            c.returns,
        ];
        for count in counts {
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
