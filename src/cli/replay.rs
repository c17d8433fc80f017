//! `wobble replay` and `wobble verify`: recordings run again.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;

use super::simulate::{self, Table};
use super::spared::spare;
use super::{WrongCall, progress, values};
use crate::history::{Difference, Log, Mark, Recording, apart_from_last, hash_now, replay};

/// What to run again and what to write of it.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  wobble replay session.json --hash\n  wobble replay session.json --time 2.5 --out state.json\n  wobble replay cut-off.jsonl --partial --hash"
)]
pub(super) struct Arguments {
    /// A recording.
    file: PathBuf,
    /// Where to end, in seconds: the recording's end if left out.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = values::at_least_zero)]
    time: Option<f64>,
    /// Where to write the state then: .json or .csv.
    #[arg(long, value_name = "FILE", value_parser = simulate::table)]
    out: Option<PathBuf>,
    /// Prints the hash of the state then.
    #[arg(long)]
    hash: bool,
    /// Of a file that was cut off: replays the commands that are whole.
    #[arg(long)]
    partial: bool,
}

pub(super) fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<()> {
    spare(&[&arguments.file], &arguments.out.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
    let log = Log::open(&arguments.file)?;
    let log = if arguments.partial { log } else { log.whole()? };
    let (head, end) = (log.head()?, log.end());
    let time = arguments.time.unwrap_or(end);
    if time > end {
        let file = log.label();
        bail!(WrongCall(format!("{file}: --time {time:?} is beyond its end at {end:?} s: give a time up to that")));
    }
    let bar = progress::bar(quiet, time);
    let mut table = Table::new(&head.scene);
    replay(head, &log, &[time], &mut |run, time| {
        table.sample(run.world(), time);
        Ok(true)
    })?;
    bar.finish_and_clear();
    say_notes(head, log.label());
    table.write(arguments.out.as_deref(), arguments.hash, None)
}

/// What to compare.
#[derive(Args)]
#[command(after_help = "Example:\n  wobble verify *.jsonl")]
pub(super) struct Verified {
    /// Recordings with marks.
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

pub(super) fn verify(arguments: &Verified) -> anyhow::Result<()> {
    let mut failed = 0;
    for file in &arguments.files {
        match Log::open(file).and_then(Log::whole).map_err(anyhow::Error::from).and_then(|log| verify_one(&log)) {
            Ok(line) => writeln!(std::io::stdout(), "{line}")?,
            Err(error) if arguments.files.len() == 1 => return Err(error),
            Err(error) => {
                failed += 1;
                writeln!(std::io::stderr(), "wobble: {error:#}")?;
            }
        }
    }
    if failed > 0 {
        bail!("{failed} of {} files are not what they were, or cannot be compared", arguments.files.len());
    }
    Ok(())
}

/// Errors: a mark that differs, or the state that was kept beside the file; nothing to compare.
fn verify_one(log: &Log) -> anyhow::Result<String> {
    let (head, label) = (log.head()?, log.label());
    let marks = &head.marks;
    let last = apart_from_last(log)?;
    if marks.is_empty() && last.is_none() {
        bail!("{label}: nothing to compare: it has no marks");
    }
    let island = last.and_then(|(time, apart)| Some((time, apart?))).map(|(time, Difference { island, apart })| {
        format!("the island of point {} is {apart:.1e} m from the state that was kept at t = {time:?} s", island.0)
    });
    let (count, made) = (marks.len(), &head.about.wobble);
    match (first_that_differs(log, marks)?, island) {
        (Some((Mark { at, hash }, found)), island) if head.about.is_ours() => {
            let island = island.map_or_else(String::new, |words| format!("; {words}"));
            bail!("{label}: differs from t = {at:?} s on: {found}, marked {hash}{island}")
        }
        (Some((Mark { at, .. }, _)), _) => bail!(
            "{label}: differs from t = {at:?} s on: it was made by wobble {made}, and only the same version comes to the same bits"
        ),
        (None, Some(island)) => bail!("{label}: {island}"),
        (None, None) if !head.about.is_ours() => bail!(
            "{label}: all {count} marks are the same, but it was made by wobble {made}: only the same version promises that"
        ),
        (None, None) => Ok(match (marks.last(), last) {
            (None, Some((time, _))) => format!("{label}: the state that was kept at t = {time:?} s is the same"),
            (last, _) => {
                format!("{label}: {count} marks are the same, to t = {:?} s", last.map_or(0.0, |mark| mark.at))
            }
        }),
    }
}

/// The first mark that differs, and the hash in its place.
fn first_that_differs(log: &Log, marks: &[Mark]) -> anyhow::Result<Option<(Mark, String)>> {
    let times: Vec<f64> = marks.iter().map(|mark| mark.at).collect();
    let mut left = marks.iter();
    let mut different = None;
    replay(log.head()?, log, &times, &mut |run, time| {
        let found = hash_now(run.world(), time);
        different = left.next().filter(|mark| mark.hash != found).map(|mark| (mark.clone(), found));
        Ok(different.is_none())
    })?;
    Ok(different)
}

/// That a run goes on where a scene ends by itself, and where the window stops; `None`: it ends before.
pub(super) fn past_end(recording: &Recording, time: f64) -> Option<String> {
    let end = recording.passed(time)?;
    Some(format!("the scene ends at {end} s, where the window stops: this goes on to {time} s"))
}

/// Says what is to be known of a recording that another version made.
pub(super) fn say_notes(recording: &Recording, label: &str) {
    for note in recording.notes() {
        // Who reads no messages misses nothing else.
        let _ = writeln!(std::io::stderr(), "wobble: {label}: {note}");
    }
}
