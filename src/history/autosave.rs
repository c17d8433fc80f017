//! What is kept of a session while it goes on, so that a killed program loses two seconds at most.
//!
//! A session has a file of lines, to which its commands are appended, and a lock beside it, which the system lets go when the
//! program ends, however it does: a file whose lock is free was left behind. The state of the last write lies there too, to be shown while
//! the lines are run through, and what redo would bring again.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead as _};
use std::path::{Path, PathBuf};

use super::error::HistoryError;
use super::last::{self, LastState};
use super::lines::Lines;
use super::log::Log;
use super::redo_file::{self, RedoFile};
use super::replay::Replay;
use super::session::History;
use super::start::Start;

/// Seconds of the caller's clock between two writes.
pub const EVERY: f64 = 2.0;

/// Most files of one process: they are numbered.
const MOST: u32 = 1000;

/// The file of a session that goes on.
pub struct Autosave {
    lines: Lines,
    last: LastState,
    redo: RedoFile,
    /// Held as long as this lives.
    lock: File,
    lock_path: PathBuf,
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
            // What another session of that name has left is not of this log.
            besides(&path).iter().try_for_each(|file| remove(file))?;
            let (last, redo) = (LastState::new(&path), RedoFile::new(&path));
            return Ok(Autosave { lines: Lines::new(path), last, redo, lock, lock_path, due: f64::NEG_INFINITY });
        }
        Err(io::Error::other(format!("{} holds {MOST} sessions of this process: empty it", folder.display())))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        self.lines.path()
    }

    /// Writes what is new, if the last time is two seconds ago by the caller's clock `now` `[s]`; true if it did.
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
        self.redo.drop_old(history)?;
        self.lines.write(history)?;
        self.redo.write(history)?;
        self.last.write(history)
    }

    /// Says what the session is called and where its scene lies, beside its file: nothing in that says so.
    ///
    /// Errors: those of [`Autosave::tick`].
    pub fn call(&self, called: &Called) -> io::Result<()> {
        let path = called_of(self.path());
        if *called == Called::default() {
            return remove(&path);
        }
        fs::write(path, serde_json::to_vec(called)?)
    }

    /// The session ended as it should: its file goes.
    ///
    /// Errors: the file cannot be removed.
    pub fn end(self) -> io::Result<()> {
        let Autosave { lines, lock, lock_path, .. } = self;
        let path = lines.path().to_owned();
        drop((lines, lock));
        remove_all(&path, &lock_path)
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

/// What a session is called, and where its scene lies.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Called {
    /// Since all of it was saved, or as the recording that it began with.
    pub name: Option<String>,
    /// The file that its scene was opened from or saved to.
    pub file: Option<PathBuf>,
}

/// The file beside a log that has what it is called.
fn called_of(log: &Path) -> PathBuf {
    log.with_extension("called")
}

/// Removes a session's files, the one that it is found by last but for the lock.
fn remove_all(path: &Path, lock_path: &Path) -> io::Result<()> {
    besides(path).iter().map(PathBuf::as_path).chain([path, lock_path]).try_for_each(remove)
}

/// The files beside a log, which mean nothing without it.
fn besides(log: &Path) -> [PathBuf; 4] {
    let [state, new] = last::files(log);
    [new, state, called_of(log), redo_file::file(log)]
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

    /// What is whole of it, and what redo would have brought again.
    ///
    /// Errors: it cannot be read, or not even its header is whole.
    pub fn start(&self) -> Result<Start, HistoryError> {
        let recording = Log::open(&self.path)?.recording()?;
        let undone = redo_file::read(&self.path, &recording.commands);
        Ok(Start::from(recording).with_undone(undone))
    }

    /// Whether its header is whole: then something was done that may be read by other means, though [`Left::start`] cannot.
    pub fn is_begun(&self) -> bool {
        let mut line = Vec::new();
        let read = File::open(&self.path).and_then(|file| io::BufReader::new(file).read_until(b'\n', &mut line));
        // What cannot be read now may be another time.
        read.is_err() || serde_json::from_slice::<serde_json::Map<_, _>>(&line).is_ok()
    }

    /// Its state when it was last written, to be shown until [`Left::start`] has been run through; `None` where there is none, or it is damaged.
    pub fn last(&self) -> Option<Replay> {
        Left::last_of(&self.path)
    }

    /// The same of its file.
    pub fn last_of(path: &Path) -> Option<Replay> {
        Log::open(path).ok()?.last().map(|(last, _)| last)
    }

    /// What it was called; nothing where nobody said so.
    pub fn called(&self) -> Called {
        let text = fs::read(called_of(&self.path)).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    /// It is not wanted any more.
    ///
    /// Errors: the file cannot be removed.
    pub fn discard(self) -> io::Result<()> {
        drop(self.lock);
        remove_all(&self.path, &self.path.with_extension("lock"))
    }
}
