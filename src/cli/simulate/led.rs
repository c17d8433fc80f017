//! A scene that is led by commands.

use std::time::Instant;

use anyhow::bail;

use super::{Arguments, Table};
use crate::cli::progress;
use crate::cli::replay::{past_end, say_notes};
use crate::history::{Entry, Log, Mark, Recording, Replay, Start, hash_now};
use crate::scene::frames::{Frames, next_close};
use crate::sim::{Ledger, judge};

/// Runs a recording, or a scene with commands, to a table, a hash or another recording.
pub(super) fn run(arguments: &Arguments, start: Start, quiet: bool) -> anyhow::Result<()> {
    let mut recording = start.recording().clone();
    let is_scene = !start.is_recording();
    if let Some(path) = &arguments.commands {
        recording.commands = Log::open(path)?.whole()?.commands()?;
        (recording.end, recording.marks) = (None, Vec::new());
    }
    arguments.change(&mut recording.scene);
    let mut times = arguments.samples.as_ref().map_or_else(|| recording.scene.sample_times(), |times| times.0.clone());
    if times.is_empty() && !(is_scene && recording.commands.is_empty()) {
        times.push(recording.end());
    }
    let Some(&end) = times.last() else {
        bail!("{}: the scene has no duration: give --samples", arguments.scene);
    };
    let bar = progress::bar(quiet, end);
    let label = arguments.commands.as_ref().map_or(arguments.scene.clone(), |path| path.display().to_string());
    let mut run = Replay::new(&recording, &label)?;
    let start = run.world().time();
    if let Some(first) = times.first().filter(|time| **time < start) {
        let file = &arguments.scene;
        bail!("{file}: it begins at {start:?} s, after the sample at {first:?} s: ask for later ones");
    }
    say_notes(&recording, &arguments.scene);
    let mut table = Table::new(&recording.scene);
    let mut frames = Frames::between(run.world().time(), end);
    let mut entries: Option<Vec<Ledger>> = run.world().sample(run.world().time()).ledger.map(|first| vec![first]);
    let mut marks = Vec::new();
    for time in times {
        advance(&mut run, (&recording.commands, time), (&mut frames, entries.as_mut()))?;
        table.sample(run.world(), time);
        marks.push(Mark { at: time, hash: hash_now(run.world(), time.max(run.world().time())) });
        bar.set_position((time * progress::SCALE) as u64);
    }
    bar.finish_and_clear();
    table.balance(entries.map(|entries| judge(&entries)));
    table.measure_beside(&recording)?;
    // A recording that is run to its own end goes no further than whoever made it.
    let goes_on = arguments.samples.is_some() || is_scene;
    table.pass_end(past_end(&recording, end).filter(|_| goes_on));
    table.name_bodies(arguments.bodies_of(run.tints(), run.world().point_count()));
    if let Some(path) = &arguments.record {
        recording.commands.retain(|entry| entry.at <= end);
        marks.dedup_by(|a, b| a.at == b.at);
        let made = Recording { end: Some(end), marks, ..recording };
        made.save(path)?;
    }
    table.write(arguments.target(), arguments.hash, Some(&frames))
}

/// Advances to `time` `[s]`, frame by frame: that is the same motion. The ledger, if one is kept, gets an entry a frame.
fn advance(
    run: &mut Replay,
    (commands, time): (&[Entry], f64),
    (frames, mut entries): (&mut Frames, Option<&mut Vec<Ledger>>),
) -> anyhow::Result<()> {
    let mut reached = run.world().time();
    while reached < time {
        let stop = next_close(reached).min(time);
        let (clock, work, before) = (Instant::now(), run.world().counters().work_ms(), run.world().time());
        run.advance(commands, stop)?;
        if run.world().time() > before {
            frames.add(stop, clock.elapsed().as_secs_f64(), run.world().counters().work_ms() - work);
        }
        if let Some(entries) = &mut entries {
            entries.extend(run.world().sample(stop.max(run.world().time())).ledger);
        }
        reached = stop;
    }
    Ok(run.advance(commands, time)?)
}
