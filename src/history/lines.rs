//! A recording that is written while it is made: commands are appended as lines, and where the history went back all is written anew.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::session::History;
use super::start::Recording;
use super::write::write_entry;
use crate::output;

/// A file of lines that follows a history.
#[derive(Debug)]
pub struct Lines {
    path: PathBuf,
    /// The file that commands are appended to; `None`: it is to be written whole.
    file: Option<File>,
    /// The branch in it, and how many of its commands.
    written: (usize, usize),
    /// How far it goes `[s]`.
    end: f64,
}

impl Lines {
    /// A file in place of what is there. Nothing is written yet.
    pub fn new(path: PathBuf) -> Self {
        Lines { path, file: None, written: (0, 0), end: f64::NEG_INFINITY }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes what is new.
    ///
    /// Errors: the disk is full, or may not be written: what was written before stays, and all is tried anew the next time.
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
}

/// How far a session went: nothing else says so where no command is given.
fn write_end(mut to: impl Write, history: &History) -> io::Result<()> {
    let (_, count) = history.log();
    let last = count.checked_sub(1).and_then(|last| history.entries(last..count).next()).map_or(0.0, |entry| entry.at);
    writeln!(to, "{{\"end\":{}}}", serde_json::Value::from(history.world().time().max(last)))
}
