//! `wobble render`: draws a scene off-screen.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use image::{ImageFormat, RgbaImage};

use super::replay::{past_end, say_notes};
use super::spared::spare;
use super::{progress, values};
use crate::app::film::{Film, Gif, Shot, scale_factor};
use crate::app::{distances, opening};
use crate::history::{Replay, Start, chunk};
use crate::output;
use crate::render::{Look, Overlay, Palette, Tiles, Trails, View};
use crate::scene::{Scene, SolverName};

/// What to draw and where to write it.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  wobble render rim --time 2 --size 1280x720 --out rim.png\n  wobble render rim-relaxed --frames 75 --size 480x480 --out rim.gif\n  wobble render my-scene.json --frames 10 --fps 5 --out frame.png    (frame-0000.png, …)"
)]
pub(super) struct Arguments {
    /// A scene of the gallery, a scene file, a recording, or a picture.
    scene: String,
    /// When the first picture is taken, in seconds.
    #[arg(long, value_name = "T", default_value = "0", allow_negative_numbers = true, value_parser = values::at_least_zero)]
    time: f64,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    size: [u32; 2],
    /// Where to write: .png, or .gif for an animation.
    #[arg(long, value_name = "FILE", required_unless_present = "gif", value_parser = |text: &str| values::ending(text, &["png", "gif"]))]
    out: Option<PathBuf>,
    /// Writes an animation there.
    #[arg(long, value_name = "FILE.gif", value_parser = |text: &str| values::ending(text, &["gif"]))]
    gif: Option<PathBuf>,
    /// How many pictures; several PNGs are numbered. An animation has 50 if this is left out.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,
    /// Pictures a second, at the scene's rate.
    #[arg(long, default_value = "25", value_parser = values::above_zero)]
    fps: f64,
    /// What is shown by colour: nothing, but that what stands beside a scene that runs as printed shows its distance to it.
    #[arg(long, value_enum)]
    overlay: Option<OverlayName>,
    /// Whether bonds and points are drawn that a picture or a fill covers.
    #[arg(long, value_name = "on|off", default_value = "off", action = clap::ArgAction::Set, value_parser = switch)]
    mesh: bool,
    /// Whether bodies without a picture are filled.
    #[arg(long, value_name = "on|off", default_value = "on", action = clap::ArgAction::Set, value_parser = switch)]
    fills: bool,
    /// Whether the plane has a grid with numbers.
    #[arg(long, value_name = "on|off", default_value = "on", action = clap::ArgAction::Set, value_parser = switch)]
    grid: bool,
    /// In which colours: bright on a dark ground, or dark on a light one.
    #[arg(long, value_enum, default_value = "dark")]
    palette: PaletteName,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum PaletteName {
    Dark,
    Light,
}

impl From<PaletteName> for Palette {
    fn from(name: PaletteName) -> Self {
        match name {
            PaletteName::Dark => Palette::Dark,
            PaletteName::Light => Palette::Light,
        }
    }
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum OverlayName {
    /// Bodies have colours of their own.
    None,
    /// From blue, squeezed by a third, to red, stretched by it.
    Strain,
    /// Of what stands beside the scene, from grey to red: how far it is from where the scene has it.
    Difference,
}

fn switch(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("give on or off".to_owned()),
    }
}

pub(super) fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<()> {
    arguments.spare()?;
    let start = Start::load(&arguments.scene)?;
    let scene = start.scene();
    let run = Replay::new(start.recording(), &arguments.scene)?;
    say_notes(start.recording(), &arguments.scene);
    let past_end = past_end(start.recording(), arguments.time_of(arguments.count() - 1, scene));
    for warning in run.world().warnings().iter().chain(&past_end) {
        writeln!(std::io::stderr(), "wobble: warning: {warning}")?;
    }
    let alone = opening::alone(scene, &View::of(run.world()));
    let worlds = (1 + scene.beside.len(), arguments.size);
    let tiles = opening::tiles((scene, &alone), &View::of(run.world()), worlds, ([0.0; 2], 0.0));
    let camera = opening::camera(scene, &View::of(run.world()), tiles.pane(arguments.size));
    let followed = opening::followed(scene, &View::of(run.world()), tiles.pane(arguments.size));
    let difference_full = distances::full_distance(&alone) as f32;
    let Arguments { mesh: has_mesh, fills: has_fills, grid: has_grid, size, .. } = *arguments;
    let (overlay, palette) = (arguments.overlay(scene), Palette::from(arguments.palette));
    let scale_factor = scale_factor(size);
    let look =
        Look { overlay, has_mesh, has_fills, has_grid, difference_full, scale_factor, ..Look::in_palette(palette) };
    let shot = Shot {
        tiles,
        camera,
        followed: Some(followed),
        look,
        beside: overlay,
        palette,
        has_labels: true,
        followers: Box::new(Trails::usual),
        trail: TRAIL * scene.rate(),
        size,
    };
    let mut film = Film::new((start.recording(), run), &scene.beside, None, shot)?;
    name(&film.titles(), &tiles)?;
    let count = arguments.count();
    let bar = progress::frames(quiet, u64::from(count));
    let mut animation = Vec::new();
    film.lead_up(arguments.time, &mut |_| true)?;
    for index in 0..count {
        let picture = film.picture(arguments.time_of(index, scene))?;
        if let Some(path) = arguments.out.as_ref().filter(|path| values::extension(path) == "png") {
            let path = if count == 1 { path.clone() } else { numbered(path, index) };
            let scene = inside(film.run())?;
            output::replace(&path, |to| write_png(&picture, &scene, to))?;
        }
        if !arguments.animations().is_empty() {
            animation.push(picture);
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    for path in arguments.animations() {
        output::replace(path, |to| write_gif(&animation, arguments.fps, to))?;
    }
    Ok(())
}

impl Arguments {
    /// What is shown by colour.
    fn overlay(&self, scene: &Scene) -> Overlay {
        let is_printed = scene.method.solver == Some(SolverName::AsPrinted);
        match self.overlay {
            Some(OverlayName::Strain) => Overlay::Strain,
            Some(OverlayName::Difference) => Overlay::Difference,
            None if is_printed && !scene.beside.is_empty() => Overlay::Difference,
            None | Some(OverlayName::None) => Overlay::None,
        }
    }

    /// The animations to write.
    fn animations(&self) -> Vec<&PathBuf> {
        let out = self.out.as_ref().filter(|path| values::extension(path) == "gif");
        out.into_iter().chain(&self.gif).collect()
    }

    /// Errors: what would be written over the scene, a picture of several included, or over each other.
    fn spare(&self) -> anyhow::Result<()> {
        let mut written: Vec<&Path> = self.out.iter().chain(&self.gif).map(PathBuf::as_path).collect();
        let scene = Path::new(&self.scene);
        let several = self.out.as_ref().filter(|out| values::extension(out) == "png" && self.count() > 1);
        // Of the numbered names only one that is the scene's own can be in the way.
        let is_own = |path: &PathBuf| path.file_name() == scene.file_name();
        let own = several.and_then(|out| (0..self.count()).map(|index| numbered(out, index)).find(is_own));
        if several.is_some() {
            written.remove(0);
        }
        written.extend(own.as_deref());
        spare(&[scene], &written)
    }

    /// When a picture is taken `[s]`.
    fn time_of(&self, index: u32, scene: &Scene) -> f64 {
        self.time + f64::from(index) / self.fps * scene.rate()
    }

    fn count(&self) -> u32 {
        self.frames.unwrap_or(if self.animations().is_empty() { 1 } else { 50 })
    }
}

/// How long trails of points last `[s of wall time]`.
const TRAIL: f64 = 2.5;
/// Says what is where beside the scene.
fn name(titles: &[&str], tiles: &Tiles) -> std::io::Result<()> {
    if titles.is_empty() {
        return Ok(());
    }
    let place = match tiles.columns() {
        1 => "below it",
        all if all == tiles.count() => "beside it",
        _ => "beside and below it",
    };
    writeln!(std::io::stderr(), "wobble: {place}: {}", titles.join("; "))
}

fn numbered(path: &Path, index: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{index:04}.png"))
}

/// The text of the state that a picture shows, which it carries.
fn inside(run: &Replay) -> anyhow::Result<String> {
    let mut text = Vec::new();
    run.snapshot().map_err(anyhow::Error::msg)?.write_json(&mut text)?;
    Ok(String::from_utf8(text)?)
}

fn write_png(picture: &RgbaImage, scene: &str, to: &mut dyn Write) -> std::io::Result<()> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).map_err(std::io::Error::other)?;
    to.write_all(&chunk::insert(bytes.get_ref(), scene)?)
}

fn write_gif(pictures: &[RgbaImage], fps: f64, to: &mut dyn Write) -> std::io::Result<()> {
    let mut gif = Gif::begin(to, fps)?;
    pictures.iter().try_for_each(|picture| gif.add(picture.clone()))
}
