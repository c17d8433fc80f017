//! `wobble scenes`: lists the gallery, prints scene files and their schema.

use std::io::Write;

use clap::Args;

use crate::scene::{self, Scene, gallery};

/// What to print.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  wobble scenes\n  wobble scenes rim --json > my-scene.json\n  wobble scenes rim --json --expanded"
)]
pub(super) struct Arguments {
    /// A scene of the gallery, or a scene file.
    scene: Option<String>,
    /// Prints the scene file.
    #[arg(long, requires = "scene")]
    json: bool,
    /// Bodies as points and bonds.
    #[arg(long, requires = "json")]
    expanded: bool,
    /// Prints the JSON Schema of scene files.
    #[arg(long, conflicts_with = "scene")]
    schema: bool,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    if arguments.schema {
        writeln!(out, "{}", serde_json::to_string_pretty(&scene::schema())?)?;
        return Ok(());
    }
    let Some(name) = &arguments.scene else {
        for entry in gallery::ENTRIES {
            writeln!(out, "{:<14} {}", entry.name, entry.about)?;
        }
        return Ok(());
    };
    let scene = Scene::load(name)?;
    if arguments.expanded {
        serde_json::to_writer(&mut out, &scene.expanded())?;
        writeln!(out)?;
    } else if arguments.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&scene.file)?)?;
    } else {
        let about = gallery::find(name).map_or("", |entry| entry.about);
        writeln!(out, "{name}: {about}")?;
        let (points, bonds) = (scene.content.position.len(), scene.content.bonds.len());
        writeln!(out, "{points} points, {bonds} bonds, {} dimensions", scene.dimensions())?;
    }
    Ok(())
}
