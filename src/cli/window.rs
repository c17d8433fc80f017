//! `wobble [SCENE]`: opens the window.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::WrongCall;
use super::spared::spare;
use crate::app;
use crate::history::{HistoryError, Start};
use crate::render::RenderCounters;
use crate::scene::{Scene, SceneErrorKind};

/// What to open.
#[derive(Args)]
pub(super) struct Arguments {
    /// A scene of the gallery, a scene file, a recording, or a picture; the jelly if left out.
    scene: Option<String>,
    /// Prints what was done when the window closes: frames, substeps, and what drawing them took.
    #[arg(long)]
    stats: bool,
    /// Writes what is done in the scene to a file, as a recording: one that ends in .jsonl grows as the session goes on, another is written
    /// when it is saved (Ctrl+S) and at the end.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let name = arguments.scene.as_deref().unwrap_or("jelly");
    let path = Path::new(name);
    spare(&[path], &arguments.record.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
    let is_plain = Scene::is_picture_file(path) && !app::holds_scene(path);
    let record = arguments.record.clone();
    let done = if is_plain { app::run_picture(path, record)? } else { run_start(start(name)?, path, record)? };
    if arguments.stats {
        let app::Statistics { frames, advances, substeps, drawing } = done;
        let RenderCounters { uploads, bytes_uploaded, bytes_held, submits, draws, .. } = drawing;
        let RenderCounters { bonds_drawn, dots_drawn, points_drawn, points_bounded, .. } = drawing;
        writeln!(
            std::io::stdout(),
            "frames {frames}  advances {advances}  substeps {substeps}  uploads {uploads}  submits {submits}  draws {draws}\n\
             bonds-drawn {bonds_drawn}  dots-drawn {dots_drawn}  points-drawn {points_drawn}  \
             points-bounded {points_bounded}\n\
             bytes-uploaded {bytes_uploaded}  bytes-held {bytes_held}"
        )?;
    }
    Ok(())
}

/// Errors: the recording cannot be written, which is tried before a window opens; those of the window.
fn run_start(start: Start, path: &Path, record: Option<PathBuf>) -> anyhow::Result<app::Statistics> {
    if let Some(path) = &record {
        start.recording().save(path)?;
    }
    let file = path.is_file().then(|| path.to_owned());
    Ok(app::run(start, file, record)?)
}

/// Errors: those of [`Start::load`]; a slip of a command's name.
fn start(name: &str) -> anyhow::Result<Start> {
    Start::load(name).map_err(|error| match (super::meant(name), &error) {
        (Some(meant), HistoryError::Scene(fault)) if fault.kind == SceneErrorKind::NotFound => anyhow::Error::from(
            WrongCall(format!("`{name}` is no file, gallery scene or command: did you mean `wobble {meant}`?")),
        ),
        _ => error.into(),
    })
}
