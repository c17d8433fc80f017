//! What is kept of a session while it goes on, so that a killed program loses two seconds at most.
//!
//! A session has a file of lines, to which its commands are appended, and a lock beside it, which the system lets go when the
//! program ends, however it does: a file whose lock is free was left behind.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::error::HistoryError;
use super::log::Log;
use super::session::History;
use super::start::{Recording, Start};
use super::write::write_entry;
use crate::output;

/// Seconds of the caller's clock between two writes.
pub const EVERY: f64 = 2.0;

/// Most files of one process: they are numbered.
const MOST: u32 = 1000;

/// The file of a session that goes on.
pub struct Autosave {
    path: PathBuf,
    /// Held as long as this lives.
    lock: File,
    lock_path: PathBuf,
    /// The file that commands are appended to; `None`: it is to be written whole.
    file: Option<File>,
    /// The branch in it, and how many of its commands.
    written: (usize, usize),
    /// How far it goes [s].
    end: f64,
    due: f64,
}

impl Autosave {
    /// Begins a file in a folder, which is made if it is not there. Nothing is written yet.
    ///
    /// Errors: the folder's.
    pub fn begin(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let process = std::process::id();
        for number in 0..MOST {
            let path = folder.join(format!("session-{process}-{number}.jsonl"));
            let lock_path = path.with_extension("lock");
            let lock = match OpenOptions::new().write(true).create_new(true).open(&lock_path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                lock => lock?,
            };
            if path.exists() {
                fs::remove_file(&lock_path)?;
                continue;
            }
            lock.lock()?;
            let (file, written, end, due) = (None, (0, 0), f64::NEG_INFINITY, f64::NEG_INFINITY);
            return Ok(Autosave { path, lock, lock_path, file, written, end, due });
        }
        Err(io::Error::other(format!("{} holds {MOST} sessions of this process: empty it", folder.display())))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes what is new, if the last time is two seconds ago by the caller's clock `now` [s]; true if it did.
    ///
    /// Errors: the disk is full, or may not be written: what was written before stays, and all is tried anew the next time. That is
    /// to be told and no reason to stop.
    pub fn tick(&mut self, now: f64, history: &History) -> io::Result<bool> {
        if now < self.due {
            return Ok(false);
        }
        self.due = now + EVERY;
        self.write(history)?;
        Ok(true)
    }

    /// Writes what is new, now.
    ///
    /// Errors: those of [`Autosave::tick`].
    pub fn write(&mut self, history: &History) -> io::Result<()> {
        let (branch, count) = history.log();
        let goes_on = branch == self.written.0 && count >= self.written.1;
        let done = match self.file.take().filter(|_| goes_on) {
            Some(file) => self.append(file, history, count),
            None => self.begin_anew(history),
        };
        // What was begun and not ended would stand in the middle of the next line.
        self.file = Some(done?);
        self.written = (branch, count);
        self.end = history.world().time();
        Ok(())
    }

    fn append(&self, mut file: File, history: &History, count: usize) -> io::Result<File> {
        let mut lines = Vec::new();
        for entry in history.entries(self.written.1..count) {
            write_entry(&mut lines, entry, history.scene())?;
            lines.push(b'\n');
        }
        if history.world().time() != self.end {
            write_end(&mut lines, history)?;
        }
        file.write_all(&lines)?;
        file.flush()?;
        Ok(file)
    }

    /// All of the branch that the world is on, in place of what was there.
    fn begin_anew(&self, history: &History) -> io::Result<File> {
        let recording = Recording { marks: Vec::new(), ..history.unmarked() };
        let written = output::replace(&self.path, |to| {
            recording.write_header(&mut *to)?;
            for entry in &recording.commands {
                write_entry(&mut *to, entry, &recording.scene)?;
                to.write_all(b"\n")?;
            }
            write_end(to, history)
        });
        written.map_err(io::Error::other)?;
        OpenOptions::new().append(true).open(&self.path)
    }

    /// The session ended as it should: its file goes.
    ///
    /// Errors: the file cannot be removed.
    pub fn end(self) -> io::Result<()> {
        let Autosave { path, lock, lock_path, file, .. } = self;
        drop((file, lock));
        remove(&path)?;
        remove(&lock_path)
    }

    /// What sessions that did not end as they should have left in a folder, the newest first. Files of programs that still run are
    /// left alone.
    pub fn left(folder: &Path) -> Vec<Left> {
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let is_session = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "jsonl");
        let mut left: Vec<Left> = paths.filter(is_session).filter_map(Left::of).collect();
        left.sort_by(|a, b| b.changed.cmp(&a.changed).then_with(|| a.path.cmp(&b.path)));
        left
    }
}

/// How far a session went: nothing else says so where no command is given.
fn write_end(mut to: impl Write, history: &History) -> io::Result<()> {
    let (_, count) = history.log();
    let last = count.checked_sub(1).and_then(|last| history.entries(last..count).next()).map_or(0.0, |entry| entry.at);
    writeln!(to, "{{\"end\":{}}}", serde_json::Value::from(history.world().time().max(last)))
}

fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// A session that did not end as it should. No other program is offered it while this lives.
#[derive(Debug)]
pub struct Left {
    path: PathBuf,
    /// `None`: it never had one.
    lock: Option<File>,
    changed: Option<std::time::SystemTime>,
}

impl Left {
    /// What a file was left by; `None` where its program still runs.
    fn of(path: PathBuf) -> Option<Left> {
        let lock = File::open(path.with_extension("lock")).ok();
        if let Some(lock) = &lock {
            lock.try_lock().ok()?;
        }
        let changed = fs::metadata(&path).and_then(|about| about.modified()).ok();
        Some(Left { path, lock, changed })
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is whole of it.
    ///
    /// Errors: it cannot be read, or not even its header is whole.
    pub fn start(&self) -> Result<Start, HistoryError> {
        Ok(Log::open(&self.path)?.recording()?.into())
    }

    /// It is not wanted any more.
    ///
    /// Errors: the file cannot be removed.
    pub fn discard(self) -> io::Result<()> {
        drop(self.lock);
        remove(&self.path)?;
        remove(&self.path.with_extension("lock"))
    }
}
