//! What is kept of a history while it is played: its log in the state folder, for the case that the program is killed, and the file that
//! it is recorded to. Both are written on the stepping thread.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::order::{Note, Order};
use crate::history::{Autosave, Called, EVERY, History, Left, Lines};

/// Where a history is kept while it is played.
#[derive(Debug, Default)]
pub struct Keeping {
    /// The folder in which its log outlives a killed program; `None`: it does not.
    pub folder: Option<PathBuf>,
    /// A file that it is recorded to. One that ends in .jsonl grows as the session goes on, another is written when it is saved.
    pub record: Option<PathBuf>,
    /// The session that it goes on with: its file goes when this one has a file of its own.
    pub heir_of: Option<Left>,
}

/// Writes what is new of a history every two seconds.
#[derive(Default)]
pub(super) struct Keeper {
    folder: Option<PathBuf>,
    autosave: Option<Autosave>,
    record: Option<Lines>,
    heir_of: Option<Left>,
    /// Something was done that would be missed.
    is_led: bool,
    /// What it is called, and whether that is written.
    called: (Called, bool),
    /// Something happened since the last time.
    is_behind: bool,
    written_at: Option<Instant>,
    /// It was said that nothing can be written.
    has_complained: bool,
}

impl Keeper {
    pub(super) fn new(keeping: Keeping) -> Self {
        let Keeping { folder, record, heir_of } = keeping;
        let has_lines = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "jsonl");
        let record = record.filter(has_lines).map(Lines::new);
        let is_led = heir_of.is_some();
        Keeper { folder, record, heir_of, is_led, is_behind: true, ..Keeper::default() }
    }

    /// It is called otherwise from now on.
    pub(super) fn call(&mut self, called: Called) {
        self.is_behind |= called != self.called.0;
        self.called = (called, false);
    }

    /// Something is done.
    pub(super) fn hear(&mut self, order: &Order) {
        self.is_behind = true;
        use Order::{Add, Change, Exact, Give, Haul, LeadPins, TakeBack};
        self.is_led |= matches!(order, Give(..) | Change { .. } | Haul(_) | LeadPins(_) | Add(_) | Exact | TakeBack);
        if let (Order::Save(path), Some(lines)) = (order, &self.record)
            && path == lines.path()
        {
            // Another file is there from now on.
            self.record = Some(Lines::new(path.clone()));
        }
    }

    /// How long until there is something to write; `None`: nothing is new.
    pub(super) fn wait(&self) -> Option<Duration> {
        let has_work = self.record.is_some() || self.folder.is_some() && self.is_led;
        let since = self.written_at.map_or(Duration::MAX, |at| at.elapsed());
        (self.is_behind && has_work).then(|| Duration::from_secs_f64(EVERY).saturating_sub(since))
    }

    /// Writes what is new, if it is time. Returns what is to be said: once, until it goes well again.
    pub(super) fn keep(&mut self, history: &History) -> Option<Note> {
        if self.wait() != Some(Duration::ZERO) {
            return None;
        }
        self.written_at = Some(Instant::now());
        let done = self.write(history);
        self.is_behind = done.is_err();
        let was_said = std::mem::replace(&mut self.has_complained, done.is_err());
        done.err().filter(|_| !was_said).map(Note::NotKept)
    }

    /// Writes what is new, whenever the last time was.
    pub(super) fn keep_now(&mut self, history: &History) -> Option<Note> {
        self.written_at = None;
        self.keep(history)
    }

    /// Errors: in words, what cannot be written. All of it is tried again the next time.
    fn write(&mut self, history: &History) -> Result<(), String> {
        let recorded = match &mut self.record {
            Some(lines) => lines.write(history).map_err(|error| format!("{}: {error}", lines.path().display())),
            None => Ok(()),
        };
        let kept = if self.is_led { self.autosave(history) } else { Ok(()) };
        recorded.and(kept)
    }

    fn autosave(&mut self, history: &History) -> Result<(), String> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let said = |error: std::io::Error| format!("{}: {error}", folder.display());
        let mut autosave = match self.autosave.take() {
            Some(autosave) => autosave,
            None => Autosave::begin(folder).map_err(said)?,
        };
        let written = autosave.write(history).map_err(said).and_then(|()| match self.called.1 {
            true => Ok(()),
            false => autosave.call(&self.called.0).map_err(said),
        });
        self.called.1 = written.is_ok();
        self.autosave = Some(autosave);
        written?;
        match self.heir_of.take() {
            Some(left) => left.discard().map_err(said),
            None => Ok(()),
        }
    }

    /// The session ended as it should: nothing is left behind.
    ///
    /// Errors: the file cannot be removed.
    pub(super) fn end(&mut self) -> std::io::Result<()> {
        self.folder = None;
        self.heir_of.take().map_or(Ok(()), Left::discard)?;
        self.autosave.take().map_or(Ok(()), Autosave::end)
    }

    /// It did not: what was written stays.
    pub(super) fn leave(&mut self) {
        (self.folder, self.heir_of, self.autosave) = (None, None, None);
    }
}
