//! `wobble render`: draws a scene off-screen.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use glam::DVec3;
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, ImageFormat, RgbaImage};

use super::replay::{past_end, say_notes};
use super::spared::spare;
use super::{progress, values};
use crate::app::distances;
use crate::app::opening::{self, Followed};
use crate::app::player::driven;
use crate::app::words::Labels;
use crate::history::{Companion, Do, Entry, Replay, Start, chunk, distances};
use crate::output;
use crate::picture::{Skin, Tint};
use crate::render::{Camera, Capture, Look, Overlay, Palette, Pane, Tiles, Trails, View};
use crate::scene::{Scene, SolverName};
use crate::sim::{Cursor, Dynamics, PointId, Positions};

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
    let (scene, commands) = (start.scene(), &start.recording().commands);
    let mut run = Replay::new(start.recording(), &arguments.scene)?;
    say_notes(start.recording(), &arguments.scene);
    let past_end = past_end(start.recording(), arguments.time_of(arguments.count() - 1, scene));
    for warning in run.world().warnings().iter().chain(&past_end) {
        writeln!(std::io::stderr(), "wobble: warning: {warning}")?;
    }
    let alone = opening::alone(scene, &View::of(run.world()));
    let worlds = (1 + scene.beside.len(), arguments.size);
    let tiles = opening::tiles((scene, &alone), &View::of(run.world()), worlds, ([0.0; 2], 0.0));
    let mut own = opening::camera(scene, &View::of(run.world()), tiles.pane(arguments.size));
    let followed = opening::followed(scene, &View::of(run.world()), tiles.pane(arguments.size));
    let difference_full = distances::full_distance(&alone) as f32;
    let Arguments { mesh: has_mesh, fills: has_fills, grid: has_grid, .. } = *arguments;
    let overlay = arguments.overlay(scene);
    let scale_factor = scale_factor(arguments.size);
    let look = Look {
        overlay,
        has_mesh,
        has_fills,
        has_grid,
        difference_full,
        scale_factor,
        ..Look::in_palette(arguments.palette.into())
    };
    let mut beside = Neighbors::new(&start, scene)?;
    beside.name(&tiles)?;
    let mut capture = Capture::new(arguments.size, scene.dimensions())?;
    let mut labels = Labels::new(&scene.labels, (arguments.palette.into(), scale_factor));
    let count = arguments.count();
    let bar = progress::frames(quiet, u64::from(count));
    let mut animation = Vec::new();
    let mut trails = Trails::new(TRAIL * scene.rate());
    lead_up(&mut run, commands, arguments.time, &mut trails, &mut beside)?;
    for index in 0..count {
        let time = arguments.time_of(index, scene);
        run.advance(commands, time)?;
        let is_driven =
            commands.iter().any(|entry| entry.at <= time && matches!(entry.act, Do::Key { down: true, .. }));
        follow(&mut own, run.world(), &followed, is_driven);
        let camera = tiles.whole(&own, arguments.size);
        beside.reach(commands, time);
        let skins = run.skins();
        let main = Moment::of(run.world(), (&skins, run.tints()), time, &mut trails);
        let others = beside.moments(time, &main);
        let moments: Vec<&Moment<'_>> = std::iter::once(&main).chain(&others).collect();
        let panes: Vec<Pane<'_>> = moments
            .iter()
            .enumerate()
            .map(|(place, moment)| {
                // The trails of all are compared on the first.
                let trails = moments.iter().zip(0..).filter(|(_, of)| place == 0 || *of == place);
                let trails = trails.map(|(moment, of)| (moment.trails, of)).collect();
                let view = View { trails, ..moment.view(u64::from(index)) };
                Pane::of(&tiles, place, view, &camera, look, arguments.size)
            })
            .collect();
        labels.say(run.labels());
        let picture = labels.picture(&mut capture, &panes)?;
        if let Some(path) = arguments.out.as_ref().filter(|path| values::extension(path) == "png") {
            let path = if count == 1 { path.clone() } else { numbered(path, index) };
            let scene = inside(&run)?;
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

/// The camera goes along with what it follows from the start, else with what keys drive, as that of the window does once one was pressed.
fn follow(camera: &mut Camera, world: &dyn Dynamics, followed: &Followed, is_driven: bool) {
    if world.dimensions() != 2 {
        return;
    }
    let points = followed.or_driven(|| if is_driven { driven(world) } else { Vec::new() });
    let positions = world.positions();
    let place =
        |point: PointId| DVec3::new(positions.get(2 * point.index()), positions.get(2 * point.index() + 1), 0.0);
    followed.lead(camera, points.into_iter().map(place));
}

/// How long trails of points last `[s of wall time]`.
const TRAIL: f64 = 2.5;
/// The shorter side of pictures up to which lines and numbers have their usual width `[px]`: in larger ones they grow along.
const USUAL_SIDE: f32 = 1080.0;

/// Pixels of a picture of this size in a logical one.
fn scale_factor(size: [u32; 2]) -> f32 {
    (size[0].min(size[1]) as f32 / USUAL_SIDE).max(1.0)
}

/// Stretches of the trail before the first picture.
const LEAD: u32 = 120;

/// Goes to the first picture, and notes where points were on the way, as far as trails last, in a scene that has some.
fn lead_up(
    run: &mut Replay,
    commands: &[Entry],
    time: f64,
    trails: &mut Trails,
    beside: &mut Neighbors,
) -> anyhow::Result<()> {
    if !Trails::suit(&View::of(run.world())) {
        return Ok(());
    }
    let from = (time - trails.length()).max(0.0);
    for step in 0..LEAD {
        let at = from + (time - from) * f64::from(step) / f64::from(LEAD);
        run.advance(commands, at)?;
        let world = run.world();
        let view = View::of(world);
        trails.note(world.time(), &view, &Trails::usual(&view));
        beside.reach(commands, at);
        beside.note();
    }
    Ok(())
}

/// A world at a time that lies in its next substep.
struct Moment<'a> {
    world: &'a dyn Dynamics,
    skins: &'a [Skin],
    tints: &'a [Tint],
    time: f64,
    /// Where its points are `[m]`.
    places: Vec<f64>,
    /// How far they are from where the first world has them `[m]`.
    distances: Option<Vec<f32>>,
    trails: &'a Trails,
}

impl<'a> Moment<'a> {
    /// A world at `time` `[s]`, whose trails go on to there.
    fn of(
        world: &'a dyn Dynamics,
        (skins, tints): (&'a [Skin], &'a [Tint]),
        time: f64,
        trails: &'a mut Trails,
    ) -> Self {
        let dimensions = world.dimensions();
        let sample = world.sample(time.max(world.time()));
        let places: Vec<f64> = sample.position.iter().flat_map(|x| &x[..dimensions]).copied().collect();
        let places_now = Positions::F64(&places);
        let view = View { previous: places_now, current: places_now, ..View::of(world) };
        trails.note(time, &view, &Trails::usual(&view));
        Moment { world, skins, tints, time, places, distances: None, trails }
    }

    /// As the renderer reads it; `motion` is the number of the picture.
    fn view(&self, motion: u64) -> View<'_> {
        let Moment { world, skins, tints, time, ref places, ref distances, .. } = *self;
        let on_track = |(force, cursor): (_, Cursor)| {
            let force: &crate::sim::MouseForce = force;
            (force, force.track.at(time).map_or(cursor, Cursor::at))
        };
        View {
            previous: Positions::F64(places),
            current: Positions::F64(places),
            motion,
            mouse: world.mouse().map(on_track),
            skins,
            tints,
            values: distances.as_deref(),
            ..View::of(world)
        }
    }
}

/// The same start by other methods, with skins and trails of their own.
struct Neighbors {
    companions: Vec<(Companion, Vec<Skin>, Trails)>,
}

impl Neighbors {
    /// Errors: a method that cannot run the scene.
    fn new(start: &Start, scene: &Scene) -> anyhow::Result<Self> {
        let of = |entry| -> anyhow::Result<_> {
            let trails = Trails::new(TRAIL * scene.rate());
            Ok((Companion::new(start.recording(), entry)?, Vec::new(), trails))
        };
        Ok(Neighbors { companions: scene.beside.iter().map(of).collect::<Result<_, _>>()? })
    }

    /// Says what is where.
    fn name(&self, tiles: &Tiles) -> std::io::Result<()> {
        let titles: Vec<&str> = self.companions.iter().map(|(companion, ..)| companion.title()).collect();
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

    fn reach(&mut self, commands: &[Entry], time: f64) {
        for (companion, skins, _) in &mut self.companions {
            companion.reach(commands, time);
            *skins = companion.skins();
        }
    }

    fn note(&mut self) {
        for (companion, _, trails) in &mut self.companions {
            let view = View::of(companion.world());
            trails.note(companion.world().time(), &view, &Trails::usual(&view));
        }
    }

    /// All of them at `time` `[s]`, and how far from the first.
    fn moments<'a>(&'a mut self, time: f64, main: &Moment<'_>) -> Vec<Moment<'a>> {
        let of = |(companion, skins, trails): &'a mut (Companion, Vec<Skin>, Trails)| {
            let companion: &'a Companion = companion;
            let moment = Moment::of(companion.world(), (skins, companion.tints()), time, trails);
            let apart = distances(&main.places, &moment.places, companion.world().dimensions());
            Moment { distances: Some(apart), ..moment }
        };
        self.companions.iter_mut().map(of).collect()
    }
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

/// How hard the palette of an animation is searched for: 1 is slow and best, 30 fast.
const PALETTE_SPEED: i32 = 10;

fn write_gif(pictures: &[RgbaImage], fps: f64, to: &mut dyn Write) -> std::io::Result<()> {
    let delay = Delay::from_saturating_duration(std::time::Duration::from_secs_f64((1.0 / fps).clamp(0.01, 600.0)));
    let mut encoder = GifEncoder::new_with_speed(to, PALETTE_SPEED);
    encoder.set_repeat(Repeat::Infinite).map_err(std::io::Error::other)?;
    for picture in pictures {
        let frame = Frame::from_parts(picture.clone(), 0, 0, delay);
        encoder.encode_frame(frame).map_err(std::io::Error::other)?;
    }
    Ok(())
}
