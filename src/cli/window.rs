//! `wobble [SCENE]`: opens the window.

use std::io::Write;

use clap::Args;

use crate::app;
use crate::scene::Scene;

/// What to open.
#[derive(Args)]
pub(super) struct Arguments {
    /// A scene of the gallery, or a scene file; the rim if left out.
    scene: Option<String>,
    /// Prints what was done when the window closes: frames, substeps, uploads, submits.
    #[arg(long)]
    stats: bool,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = Scene::load(arguments.scene.as_deref().unwrap_or("rim"))?;
    let done = app::run(scene)?;
    if arguments.stats {
        let app::Statistics { frames, substeps, uploads, submits } = done;
        writeln!(std::io::stdout(), "frames {frames}  substeps {substeps}  uploads {uploads}  submits {submits}")?;
    }
    Ok(())
}
