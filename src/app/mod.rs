//! The interactive program: window, clock, input, panels.
//!
//! Keys, clicks and panels become actions; actions become orders to the thread that steps, which alone has the history; the window
//! draws the last two states that it was handed. When nothing moves, nothing is stepped, uploaded or submitted.

pub mod action;
mod alike;
mod aside;
mod canvas;
mod clip;
mod count;
pub mod distances;
mod fetch;
pub mod film;
mod framing;
mod gone;
mod import;
mod keyboard;
pub mod keys;
mod leftovers;
mod lengths;
mod loading;
mod matter;
pub mod meter;
pub mod opening;
mod overlay;
mod painter;
mod panels;
pub mod player;
mod plots;
pub mod pointer;
mod preferences;
mod recent;
pub mod rehearsal;
mod resting;
mod saving;
mod session;
mod shell;
mod starting;
mod thumbnails;
mod tools;
mod trailing;
mod walled;
mod warnings;
mod whereabouts;
pub mod words;

pub use shell::Statistics;

use std::path::{Path, PathBuf};

use crate::history::{HistoryError, Start, chunk};
use crate::render::RenderError;
use crate::scene::Scene;

/// A window that cannot be opened or kept open.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// There is no display, or its libraries are missing.
    #[error(
        "no display ({reason}): set DISPLAY or WAYLAND_DISPLAY, install the X libraries that the README lists, or draw off-screen with `wobble render`"
    )]
    NoDisplay {
        /// What the system said.
        reason: String,
    },
    /// The display makes no window.
    #[error("no window could be opened: {reason}")]
    NoWindow {
        /// What the system said.
        reason: String,
    },
    /// The window was destroyed by another program.
    #[error("the window was taken away by another program: start again to go on where it was")]
    WindowGone,
    /// The GPU.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene, or the recording.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// The file that the session is recorded to.
    #[error("{}: the recording is not whole: {reason}", path.display())]
    Record {
        /// The file.
        path: PathBuf,
        /// Why, in words.
        reason: String,
    },
}

/// Opens a window on a scene or a recording and runs until it is closed. `file`: the one that it was read from, which is listed among those
/// opened last. What is done in it is written to `record`, if that is given.
///
/// Errors: a scene that cannot be run, no display, no GPU, a recording that cannot be written.
pub fn run(start: Start, file: Option<PathBuf>, record: Option<PathBuf>) -> Result<Statistics, AppError> {
    shell::run(shell::Asked { start, file, picture: None, record })
}

/// The scene that a picture is waited for in.
const WAITING: &str = r#"{"wobble": 1, "name": "picture", "view": {"center": [0, 0], "height": 4}}"#;

/// Opens a window at once and a picture in it as soon as it is read: its scene, or the panel to cut it out by hand where it would have
/// too many points. What is done in that scene is written to `record`, if that is given.
///
/// Errors: no display, no GPU, a recording that cannot be written.
pub fn run_picture(path: &Path, record: Option<PathBuf>) -> Result<Statistics, AppError> {
    let waiting = Scene::parse(WAITING, "").map_err(HistoryError::from)?;
    shell::run(shell::Asked { start: waiting.into(), file: None, picture: Some(path.to_owned()), record })
}

/// Whether a picture holds the scene that it was taken of.
pub fn holds_scene(path: &Path) -> bool {
    std::fs::read(path).is_ok_and(|bytes| chunk::find(&bytes).is_some())
}
