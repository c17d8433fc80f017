//! The interactive program: window, clock, input, panels.
//!
//! Input becomes actions and commands; the player turns wall time into whole substeps; a frame draws the world between
//! its last two states. When nothing moves, nothing is stepped, uploaded or submitted.

mod canvas;
mod fetch;
mod import;
pub mod input;
mod loading;
pub mod meter;
pub mod opening;
mod panels;
pub mod player;
mod session;
mod shell;

pub use shell::Statistics;

use std::path::Path;

use crate::render::RenderError;
use crate::scene::{Scene, SceneError};
use session::Opened;

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
    /// The GPU.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Opens a window on `scene` and runs until it is closed.
///
/// Errors: a scene that cannot be run, no display, no GPU.
pub fn run(scene: Scene) -> Result<Statistics, AppError> {
    shell::run(Opened::new(scene)?)
}

/// The scene that a picture is waited for in.
const WAITING: &str = r#"{"wobble": 1, "name": "picture", "view": {"center": [0, 0], "height": 4}}"#;

/// Opens a window at once and a picture in it as soon as it is read: its scene, or the panel to cut it out by hand where it would have
/// too many points.
///
/// Errors: no display, no GPU.
pub fn run_picture(path: &Path) -> Result<Statistics, AppError> {
    let waiting = Opened::new(Scene::parse(WAITING, "")?)?;
    shell::run(Opened { picture: Some(path.to_owned()), ..waiting })
}
