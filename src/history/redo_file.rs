//! What redo would bring again, in a file beside a session's log: the log has nothing of what was undone.
//!
//! ```text
//! {"wobble_redo": 1, "after": c,             of the log's commands the first c are done before these
//!  "last": {"at": t, "do": kind},            the last of them, so that it is told from another log; null: there is none
//!  "commands": [...],                        what was undone, and what was done between
//!  "steps": [{"place": p, "name": words}]}   redo leads to after p commands in all, the last step first
//! ```

use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::branch::Spot;
use super::command::Entry;
use super::session::History;
use super::start::{Recording, Start};
use super::undo::Redo;
use super::write::write_entry;
use crate::output;

/// The version of the file.
const VERSION: u64 = 1;

/// What redo would bring again, as it is kept.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Undone {
    /// How many commands of the log are done before these.
    pub(super) after: usize,
    /// The last one of those.
    pub(super) last: Option<Last>,
    /// All that the first of the steps comes to, times ascending.
    pub(super) commands: Vec<Entry>,
    /// How many commands are done in all after each step of redo, and what it is called; the last one comes next.
    pub(super) steps: Vec<(usize, String)>,
}

/// What a command is known by: when it is done `[s]`, and of which kind it is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Last {
    at: f64,
    kind: String,
}

impl Last {
    /// The last one of some commands; `None`: there is none.
    fn of(commands: &[Entry]) -> Option<Self> {
        let last = commands.last()?;
        let kind = last.to_object().get("do").and_then(Value::as_str).unwrap_or_default().to_owned();
        Some(Last { at: last.at, kind })
    }

    /// As a file has it. `None`: it is damaged.
    fn read(value: &Value) -> Option<Option<Self>> {
        if value.is_null() {
            return Some(None);
        }
        let (at, kind) = (value.get("at")?.as_f64()?, value.get("do")?.as_str()?.to_owned());
        Some(Some(Last { at, kind }))
    }
}

/// Where the steps of redo lead: the commands that they share with the log, and branches with so many of their commands.
type Reaches = (usize, Vec<(usize, usize)>);

/// The file that what was undone goes to.
#[derive(Debug)]
pub(super) struct RedoFile {
    path: PathBuf,
    /// What is in it; `None`: it is not there.
    written: Option<Reaches>,
}

/// The file beside a log.
pub(super) fn file(log: &Path) -> PathBuf {
    log.with_extension("redo")
}

impl RedoFile {
    /// Beside a log. Nothing is written yet.
    pub(super) fn new(log: &Path) -> Self {
        RedoFile { path: file(log), written: None }
    }

    /// Takes away what redo does not bring any more, before the log goes on: a program that is killed between offers nothing wrong.
    ///
    /// Errors: the file cannot be removed.
    pub(super) fn drop_old(&mut self, history: &History) -> io::Result<()> {
        if self.written.is_some() && self.written != history.reaches() {
            match std::fs::remove_file(&self.path) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                _ => self.written = None,
            }
        }
        Ok(())
    }

    /// Writes what redo brings again, if it is something else than before, once the log is written.
    ///
    /// Errors: the disk is full, or may not be written: then there is none.
    pub(super) fn write(&mut self, history: &History) -> io::Result<()> {
        let reaches = history.reaches();
        let Some(undone) = history.undone_steps().filter(|_| self.written != reaches) else { return Ok(()) };
        let step = |(place, name): &(usize, String)| json!({ "place": place, "name": name });
        let steps: Vec<Value> = undone.steps.iter().map(step).collect();
        let last = undone.last.as_ref().map(|last| json!({ "at": last.at, "do": last.kind }));
        let last = last.unwrap_or(Value::Null);
        let written = output::replace(&self.path, |to| {
            write!(to, "{{\"wobble_redo\":{VERSION},\"after\":{},\"last\":{last},\"commands\":[", undone.after)?;
            for (number, entry) in undone.commands.iter().enumerate() {
                to.write_all(if number == 0 { b"\n" } else { b",\n" })?;
                write_entry(&mut *to, entry, history.scene())?;
            }
            writeln!(to, "],\"steps\":{}}}", Value::from(steps))
        });
        written.map_err(io::Error::other)?;
        self.written = reaches;
        Ok(())
    }
}

/// What was undone of a session whose log has these commands; `None` where nothing was, or it is damaged or of another log.
pub(super) fn read(log: &Path, commands: &[Entry]) -> Option<Undone> {
    let value: Value = serde_json::from_slice(&std::fs::read(file(log)).ok()?).ok()?;
    if value.get("wobble_redo").and_then(Value::as_u64) != Some(VERSION) {
        return None;
    }
    let place = |value: &Value| usize::try_from(value.as_u64()?).ok();
    let step = |step: &Value| Some((place(step.get("place")?)?, step.get("name")?.as_str()?.to_owned()));
    let undone = Undone {
        after: place(value.get("after")?)?,
        last: Last::read(value.get("last")?)?,
        commands: value
            .get("commands")?
            .as_array()?
            .iter()
            .map(|one| Entry::from_value(one.clone()).ok())
            .collect::<Option<_>>()?,
        steps: value.get("steps")?.as_array()?.iter().map(step).collect::<Option<_>>()?,
    };
    undone.fits(commands).then_some(undone)
}

impl Undone {
    /// Whether it goes on after the first commands of a log, of which the last is the one that it knows, and its steps lead backwards along it.
    fn fits(&self, log: &[Entry]) -> bool {
        let Some(shared) = log.get(..self.after) else { return false };
        let times: Vec<f64> = shared.last().into_iter().chain(&self.commands).map(|entry| entry.at).collect();
        let end = self.after + self.commands.len();
        Last::of(shared) == self.last
            && times.is_sorted()
            && self.steps.first().is_some_and(|(place, _)| *place == end)
            && self.steps.iter().all(|(place, _)| *place > self.after)
            && self.steps.windows(2).all(|pair| pair[1].0 < pair[0].0)
    }
}

impl History {
    /// The steps of redo that lead on from the log of the present branch, the last one first to come. What leads elsewhere, as back to before a
    /// start was gone to, is not among them, nor is what leads nowhere, as a branch that is discarded again.
    fn steps_on(&self) -> Vec<&Redo> {
        let (branch, count) = self.log();
        let shared = |of: usize| self.tree.common(of, branch).min(count);
        let leads_on = |redo: &Redo| {
            let Some(Spot { branch: of, place, time }) = redo.spot() else { return false };
            let last = place.checked_sub(1).and_then(|last| self.tree.entry(of, last));
            place > shared(of) && last.is_some_and(|last| last.at.to_bits() == time.to_bits())
        };
        let goes_on = |redo: &Redo, next: &Redo| {
            let Some(((of, place), (of_next, next_place))) = redo.reaches().zip(next.reaches()) else { return false };
            next_place > place && self.tree.common(of, of_next) >= place && shared(of) == shared(of_next)
        };
        let steps: Vec<&Redo> = self.undone.iter().filter(|redo| redo.spot().is_some()).collect();
        let first = (0..steps.len())
            .rev()
            .take_while(|&k| leads_on(steps[k]) && steps.get(k + 1).is_none_or(|redo| goes_on(redo, steps[k])))
            .last();
        first.map_or_else(Vec::new, |first| steps[first..].to_vec())
    }

    /// Where those steps lead; `None`: there are none.
    fn reaches(&self) -> Option<Reaches> {
        let steps = self.steps_on();
        let (branch, count) = self.log();
        let (of, _) = steps.first()?.reaches()?;
        Some((self.tree.common(of, branch).min(count), steps.iter().filter_map(|redo| redo.reaches()).collect()))
    }

    /// Those steps with the commands that they bring; `None`: there are none.
    fn undone_steps(&self) -> Option<Undone> {
        let (after, _) = self.reaches()?;
        let steps = self.steps_on();
        let (of, end) = steps.first()?.reaches()?;
        let commands = (after..end).filter_map(|place| self.tree.entry(of, place)).cloned().collect();
        let shared = after.checked_sub(1).and_then(|last| self.tree.entry(of, last));
        Some(Undone {
            after,
            last: shared.and_then(|last| Last::of(std::slice::from_ref(last))),
            commands,
            steps: steps.iter().filter_map(|redo| Some((redo.reaches()?.1, redo.name().to_owned()))).collect(),
        })
    }

    /// What goes on with a recording of it: redo brings again there what it does here.
    pub fn resumed_by(&self, recording: Recording) -> Start {
        Start::from(recording).with_undone(self.undone_steps())
    }

    /// Redo brings again what was undone before the session was cut off.
    pub(super) fn bring(&mut self, undone: Undone) {
        let Undone { after, commands, steps, .. } = undone;
        let (Some(first), Some(last)) = (commands.first().map(|entry| entry.at), commands.last().map(|entry| entry.at))
        else {
            return;
        };
        let branch = self.tree.fork(Spot { branch: self.branch, place: after, time: first });
        commands.into_iter().for_each(|entry| self.tree.push(branch, entry));
        self.tree.extend_to(branch, last);
        let redo = |(place, name): (usize, String)| {
            let time =
                place.checked_sub(1).and_then(|last| self.tree.entry(branch, last)).map_or(last, |entry| entry.at);
            Redo::to(Spot { branch, place, time }, name)
        };
        self.undone = steps.into_iter().map(redo).collect();
    }
}
