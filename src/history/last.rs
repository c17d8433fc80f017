//! The last state of a session, in a file beside its log: shown at once when the session is gone on with, until its log has been run through.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use flate2::Compression;
use serde_json::{Value, json};

use super::pack::Packed;
use super::session::History;
use super::state;

/// What the file begins with.
const MARK: [u8; 8] = *b"wobble\0s";

/// Bytes that a write is worth: of a larger state fewer are written, so that the disk gets no more a second.
const WORTH_A_WRITE: usize = 4 << 20;

/// The file that the last state goes to.
#[derive(Debug)]
pub(super) struct LastState {
    path: PathBuf,
    /// The time of the state in it, and how many commands were done, if it is written.
    written: Option<(u64, usize)>,
    /// Writes that are passed over.
    rests: usize,
}

/// A state with its place in the log.
pub(super) struct Kept {
    /// After so many commands.
    pub(super) place: usize,
    /// The state as a recording has it.
    pub(super) state: Value,
}

/// The file beside a log, and what is written before it takes that one's place.
pub(super) fn files(log: &Path) -> [PathBuf; 2] {
    [log.with_extension("state"), log.with_extension("state-new")]
}

impl LastState {
    /// Beside a log. Nothing is written yet.
    pub(super) fn new(log: &Path) -> Self {
        let [path, _] = files(log);
        LastState { path, written: None, rests: 0 }
    }

    /// Writes the present state in place of the one before, if it is another; a large one not every time. The file is there whole, before and
    /// after, whenever the program is killed.
    ///
    /// Errors: the disk is full, or may not be written: the state before stays.
    pub(super) fn write(&mut self, history: &History) -> io::Result<()> {
        let spot = history.spot();
        let now = Some((spot.time.to_bits(), spot.place));
        if self.written == now {
            return Ok(());
        }
        if self.rests > 0 {
            self.rests -= 1;
            return Ok(());
        }
        // A world that no file can hold is not kept: the log is enough.
        let Ok(packed) = state::pack(&history.frame, Compression::none()) else { return Ok(()) };
        let mut bytes = MARK.to_vec();
        env!("CARGO_PKG_VERSION").as_bytes().to_vec().put(&mut bytes);
        state::LAYOUT.put(&mut bytes);
        spot.place.put(&mut bytes);
        bytes.extend(&packed);
        self.rests = bytes.len() / WORTH_A_WRITE;
        let new = self.path.with_extension("state-new");
        fs::write(&new, &bytes).and_then(|()| fs::rename(&new, &self.path)).inspect_err(|_| {
            // What a full disk took of it would be in the way.
            let _ = fs::remove_file(&new);
        })?;
        self.written = now;
        Ok(())
    }
}

/// The state beside a log; `None` where there is none, or it is no state. Whether it is damaged is seen when it is gone on from.
pub(super) fn read(log: &Path) -> Option<Kept> {
    let [path, _] = files(log);
    let bytes = fs::read(path).ok()?;
    let mut rest = bytes.strip_prefix(&MARK)?;
    let version = String::from_utf8(Packed::take(&mut rest)?).ok()?;
    let (layout, place) = (u64::take(&mut rest)?, usize::take(&mut rest)?);
    let data = state::text(rest);
    Some(Kept { place, state: json!({ "wobble": version, "layout": layout, "data": data }) })
}
