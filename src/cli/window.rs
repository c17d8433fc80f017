//! `wobble [SCENE]`: opens the window.

use std::io::Write;

use clap::Args;

use crate::app;
use crate::render::RenderCounters;
use crate::scene::Scene;

/// What to open.
#[derive(Args)]
pub(super) struct Arguments {
    /// A scene of the gallery, a scene file, or a picture; the rim if left out.
    scene: Option<String>,
    /// Prints what was done when the window closes: frames, substeps, and what drawing them took.
    #[arg(long)]
    stats: bool,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = Scene::load(arguments.scene.as_deref().unwrap_or("rim"))?;
    let done = app::run(scene)?;
    if arguments.stats {
        let app::Statistics { frames, substeps, drawing } = done;
        let RenderCounters { uploads, bytes_uploaded, bytes_held, submits, draws, .. } = drawing;
        let RenderCounters { bonds_drawn, dots_drawn, points_drawn, points_bounded, .. } = drawing;
        writeln!(
            std::io::stdout(),
            "frames {frames}  substeps {substeps}  uploads {uploads}  submits {submits}  draws {draws}\n\
             bonds-drawn {bonds_drawn}  dots-drawn {dots_drawn}  points-drawn {points_drawn}  \
             points-bounded {points_bounded}\n\
             bytes-uploaded {bytes_uploaded}  bytes-held {bytes_held}"
        )?;
    }
    Ok(())
}
