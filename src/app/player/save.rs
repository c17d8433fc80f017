//! What is written of a history, on its own thread: files are whole or not there.

use std::path::PathBuf;

use image::{ImageFormat, RgbaImage};

use super::order::Note;
use crate::history::{Entry, History, Recording, chunk};
use crate::output::replace;
use crate::scene::ViewKeys;

/// Writes all that was done.
pub(super) fn recording(recording: &Recording, path: PathBuf) -> Note {
    match recording.save(&path) {
        Ok(()) => Note::Written(path),
        Err(error) => Note::NotWritten(error.to_string()),
    }
}

/// How a moment is seen: the view, and whether it is paused.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    pub(super) view: Option<ViewKeys>,
    pub(super) paused: bool,
}

/// Writes a moment as a scene: whoever opens it goes on from there, without what was done before.
pub(super) fn moment(history: &History, path: PathBuf, seen: Seen) -> Note {
    match snapshot(history, seen) {
        Ok(snapshot) => recording(&snapshot, path),
        Err(why) => Note::NotWritten(why),
    }
}

/// Writes a picture with a snapshot of its moment in it: it opens as that.
pub(super) fn picture(history: &History, path: PathBuf, picture: (&RgbaImage, Seen)) -> Note {
    match encoded(history, picture)
        .and_then(|bytes| replace(&path, |file| file.write_all(&bytes)).map_err(|error| error.to_string()))
    {
        Ok(()) => Note::Written(path),
        Err(why) => Note::NotWritten(why),
    }
}

/// Writes a table.
pub(super) fn table(bytes: &[u8], path: PathBuf) -> Note {
    match replace(&path, |file| file.write_all(bytes)) {
        Ok(()) => Note::Written(path),
        Err(error) => Note::NotWritten(error.to_string()),
    }
}

/// What begins at this moment.
fn snapshot(history: &History, Seen { view, paused }: Seen) -> Result<Recording, String> {
    let mut recording = Recording { view, paused, ..history.snapshot()? };
    // Whoever opens it has nothing in hand.
    let at = history.world().time();
    let free = history.letting_go().into_iter().map(|act| Entry { at, act, edit: None, name: None });
    recording.commands.extend(free);
    Ok(recording)
}

/// The bytes of a PNG.
fn encoded(history: &History, (picture, seen): (&RgbaImage, Seen)) -> Result<Vec<u8>, String> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).map_err(|error| error.to_string())?;
    let recording = snapshot(history, seen)?;
    let mut text = Vec::new();
    recording.write_json(&mut text).map_err(|error| error.to_string())?;
    chunk::insert(bytes.get_ref(), &String::from_utf8_lossy(&text)).map_err(|error| error.to_string())
}
