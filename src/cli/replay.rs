//! `wobble replay` and `wobble verify`: recordings run again.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;

use super::simulate::{self, Table};
use super::{WrongCall, progress, values};
use crate::history::{HistoryError, Log, Mark, hash_now, replay};

/// What to run again and what to write of it.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  wobble replay session.json --hash\n  wobble replay session.json --time 2.5 --out state.json\n  wobble replay cut-off.jsonl --partial --hash"
)]
pub(super) struct Arguments {
    /// A recording.
    file: PathBuf,
    /// Where to end [s]: the recording's end if left out.
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
    let log = Log::open(&arguments.file)?;
    let log = if arguments.partial { log } else { log.whole()? };
    let (head, end) = (log.head()?, log.end());
    let time = arguments.time.unwrap_or(end);
    if time > end {
        let file = log.label();
        bail!(WrongCall(format!("{file}: --time {time:?} is beyond its end at {end:?} s: give a time up to that")));
    }
    say_version(&log)?;
    let bar = progress::bar(quiet, time);
    let mut table = Table::new(&head.scene);
    replay(head, &log, &[time], &mut |run, time| {
        table.sample(run.world(), time);
        Ok(true)
    })?;
    bar.finish_and_clear();
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
    for file in &arguments.files {
        let line = verify_one(&Log::open(file)?.whole()?)?;
        writeln!(std::io::stdout(), "{line}")?;
    }
    Ok(())
}

/// Errors: a mark that differs; nothing to compare.
fn verify_one(log: &Log) -> anyhow::Result<String> {
    let (head, label) = (log.head()?, log.label());
    let marks = &head.marks;
    if marks.is_empty() {
        bail!("{label}: nothing to compare: it has no marks");
    }
    let times: Vec<f64> = marks.iter().map(|mark| mark.at).collect();
    let mut left = marks.iter();
    let mut different: Option<(Mark, String)> = None;
    replay(head, log, &times, &mut |run, time| {
        let found = hash_now(run.world(), time);
        different = left.next().filter(|mark| mark.hash != found).map(|mark| (mark.clone(), found));
        Ok(different.is_none())
    })?;
    let (count, made) = (marks.len(), &head.about.wobble);
    match different {
        Some((Mark { at, hash }, found)) if head.about.is_ours() => {
            bail!("{label}: differs from t = {at:?} s on: {found}, marked {hash}")
        }
        Some((Mark { at, .. }, _)) => bail!(
            "{label}: differs from t = {at:?} s on: it was made by wobble {made}, and only the same version comes to the same bits"
        ),
        None if !head.about.is_ours() => bail!(
            "{label}: all {count} marks are the same, but it was made by wobble {made}: only the same version promises that"
        ),
        None => Ok(format!("{label}: {count} marks are the same, to t = {:?} s", times.last().copied().unwrap_or(0.0))),
    }
}

/// Says where the motion is worked out anew, by another version than made the recording.
fn say_version(log: &Log) -> Result<(), HistoryError> {
    let about = &log.head()?.about;
    if !about.is_ours() {
        let (made, ours) = (&about.wobble, env!("CARGO_PKG_VERSION"));
        let label = log.label();
        // Who reads no messages misses nothing else.
        let _ = writeln!(
            std::io::stderr(),
            "wobble: {label}: was made by wobble {made}: {ours} replays the motion anew, which may differ"
        );
    }
    Ok(())
}
