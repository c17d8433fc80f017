//! From a scene to a text and a file.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;
use serde_json::ser::Formatter;

use super::error::{SceneError, SceneErrorKind};
use super::keys::Scene;
use crate::output;

impl Scene {
    /// The scene as a file's text: keys that are not said stay away, numbers keep all their digits.
    ///
    /// `Scene::parse` of it is equal to the scene. Lists of the top level have an item a line, long lists below have
    /// eight.
    ///
    /// Errors: a number that is not finite, which JSON cannot say.
    pub fn to_json(&self) -> Result<String, SceneError> {
        self.check()?;
        let mut text = Vec::new();
        let written = self.lay_out(&mut text).and_then(|()| String::from_utf8(text).map_err(io::Error::other));
        written.map_err(|error| self.file_error(&self.source.label, "written", &error))
    }

    /// Writes the text of [`Scene::to_json`] piece by piece: one of a large scene need not be in memory as a whole.
    ///
    /// Errors: the writer's; those of [`Scene::check`], as invalid input, before anything is written.
    pub fn write_json(&self, to: impl Write) -> io::Result<()> {
        self.check().map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error))?;
        self.lay_out(to)
    }

    fn lay_out(&self, mut to: impl Write) -> io::Result<()> {
        self.serialize(&mut serde_json::Serializer::with_formatter(&mut to, Layout::default()))?;
        to.write_all(b"\n")
    }

    /// Writes the scene to a file: whole or not at all, in place of what was there.
    ///
    /// Errors: those of [`Scene::to_json`]; the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), SceneError> {
        self.check()?;
        output::replace(path, |to| self.lay_out(to))
            .map_err(|error| SceneError::whole(SceneErrorKind::File, "", error.to_string()))
    }

    fn file_error(&self, label: &str, what: &str, error: &io::Error) -> SceneError {
        let message = format!("cannot be {what}: {error}");
        SceneError::whole(SceneErrorKind::File, label, message)
    }
}

/// Depth down to which entries have lines of their own.
const OPEN_DEPTH: usize = 2;

/// Items a line in a long list below that.
const ITEMS_A_LINE: usize = 8;

/// How a scene is laid out: objects of the first two levels with a key a line, lists there with an object or a list a
/// line, all below on one line, and long lists of lists there in rows.
#[derive(Default)]
struct Layout {
    open: Vec<Open>,
}

/// A list or object that is being written.
#[derive(Default)]
struct Open {
    is_list: bool,
    /// Items written so far.
    items: usize,
    /// Whether a line was begun for any of them.
    broken: bool,
}

impl Layout {
    /// A bracket opens: in a list near the top, or at the start of a row, on a new line.
    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, is_list: bool) -> io::Result<()> {
        let depth = self.open.len();
        if let Some(within) = self.open.last_mut().filter(|within| within.is_list) {
            let row = depth == OPEN_DEPTH + 1 && within.items > 1 && (within.items - 1).is_multiple_of(ITEMS_A_LINE);
            if depth <= OPEN_DEPTH || row {
                within.broken = true;
                new_line(writer, depth)?;
            }
        }
        self.open.push(Open { is_list, ..Open::default() });
        writer.write_all(if is_list { b"[" } else { b"{" })
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let closed = self.open.pop().unwrap_or_default();
        let depth = self.open.len();
        if closed.broken && depth < OPEN_DEPTH {
            new_line(writer, depth)?;
        }
        writer.write_all(if closed.is_list { b"]" } else { b"}" })
    }

    /// What stands before an item: a comma, and before a key space or a new line.
    fn item<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let depth = self.open.len();
        let Some(within) = self.open.last_mut() else {
            return Ok(());
        };
        within.items += 1;
        if within.items > 1 {
            writer.write_all(b",")?;
        }
        if within.is_list {
            Ok(())
        } else if depth <= OPEN_DEPTH {
            within.broken = true;
            new_line(writer, depth)
        } else {
            writer.write_all(b" ")
        }
    }
}

fn new_line<W: ?Sized + Write>(writer: &mut W, depth: usize) -> io::Result<()> {
    writer.write_all(b"\n")?;
    (0..depth).try_for_each(|_| writer.write_all(b"  "))
}

impl Formatter for Layout {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, true)
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer)
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, writer: &mut W, _: bool) -> io::Result<()> {
        self.item(writer)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, false)
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        if self.open.len() > OPEN_DEPTH && self.open.last().is_some_and(|open| open.items > 0) {
            writer.write_all(b" ")?;
        }
        self.close(writer)
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, _: bool) -> io::Result<()> {
        self.item(writer)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
