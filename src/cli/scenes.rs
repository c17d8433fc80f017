//! `wobble scenes`: lists the gallery, prints scene files and their schema.

use std::io::{BufWriter, Write};

use clap::Args;

use crate::scene::{self, Scene};

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
        for entry in scene::gallery() {
            writeln!(out, "{:<14} {}", entry.name, entry.description)?;
        }
        return Ok(());
    };
    let scene = Scene::load(name)?;
    if arguments.expanded {
        write_json(&scene.expanded()?, out)?;
    } else if arguments.json {
        write_json(&scene, out)?;
    } else {
        if let Some(entry) = scene::gallery().iter().find(|entry| entry.name == name) {
            writeln!(out, "{}: {}", entry.title, entry.description)?;
        }
        let world = scene.world(None)?;
        let (points, bonds) = (world.point_count(), world.bonds().len());
        writeln!(out, "{points} points, {bonds} bonds, {} dimensions", scene.dimensions())?;
    }
    Ok(())
}

fn write_json(scene: &Scene, to: impl Write) -> std::io::Result<()> {
    // The terminal's own buffer ends at every line, of which there are millions.
    let mut buffer = BufWriter::with_capacity(1 << 16, to);
    scene.write_json(&mut buffer)?;
    buffer.flush()
}
