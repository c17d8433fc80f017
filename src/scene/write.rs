//! From a scene to a text and a file.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::ser::Formatter;

use super::error::{SceneError, SceneErrorKind};
use super::keys::Scene;

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
        let mut writer = serde_json::Serializer::with_formatter(&mut text, Layout::default());
        let written = self.serialize(&mut writer).map_err(io::Error::from);
        let text = written.and_then(|()| {
            text.push(b'\n');
            String::from_utf8(text).map_err(io::Error::other)
        });
        text.map_err(|error| self.file_error(&self.source.label, "written", &error))
    }

    /// Writes the scene to a file: whole or not at all, in place of what was there.
    ///
    /// Errors: those of [`Scene::to_json`]; the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), SceneError> {
        let text = self.to_json()?;
        replace(path, text.as_bytes())
            .map_err(|error| self.file_error(&path.display().to_string(), "written", &error))
    }

    fn file_error(&self, label: &str, what: &str, error: &io::Error) -> SceneError {
        let message = format!("cannot be {what}: {error}");
        SceneError::whole(SceneErrorKind::File, label, message)
    }
}

/// Writes beside the file and renames: a crash leaves the old file or the new one.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // Through a link the file behind it is meant; a rename would put a file in the link's place.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if target.is_dir() {
        return Err(io::Error::other("it is a directory"));
    }
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".wobble-").suffix(".tmp");
    // As any new file, for all whom the user's mask allows; a temporary file alone would be private.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    if let Ok(old) = fs::metadata(&target) {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(&target)?;
    Ok(())
}

/// Depth down to which every entry has a line of its own.
const OPEN_DEPTH: usize = 2;

/// Items a line in a long list below that.
const ITEMS_A_LINE: usize = 8;

/// How a scene is laid out: the first two levels open, all below on one line, long lists in rows.
#[derive(Default)]
struct Layout {
    /// How many items have been written in each list or object that is open.
    items: Vec<usize>,
}

impl Layout {
    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.items.push(0);
        writer.write_all(bracket)
    }

    fn item<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let depth = self.items.len();
        let Some(items) = self.items.last_mut() else {
            return Ok(());
        };
        *items += 1;
        if *items > 1 {
            writer.write_all(b",")?;
        }
        let row =
            depth == OPEN_DEPTH + 1 && *items > 1 && (*items - 1).is_multiple_of(ITEMS_A_LINE);
        if depth <= OPEN_DEPTH || row {
            new_line(writer, depth)
        } else if *items > 1 {
            writer.write_all(b" ")
        } else {
            Ok(())
        }
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        let depth = self.items.len();
        let items = self.items.pop().unwrap_or(0);
        if depth <= OPEN_DEPTH && items > 0 {
            new_line(writer, depth - 1)?;
        }
        writer.write_all(bracket)
    }
}

fn new_line<W: ?Sized + Write>(writer: &mut W, depth: usize) -> io::Result<()> {
    writer.write_all(b"\n")?;
    (0..depth).try_for_each(|_| writer.write_all(b"  "))
}

impl Formatter for Layout {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, writer: &mut W, _: bool) -> io::Result<()> {
        self.item(writer)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, _: bool) -> io::Result<()> {
        self.item(writer)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
