//! `wobble mesh`: makes a soft body of a picture.

mod preview;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use anyhow::Context;
use clap::{Args, ValueEnum};
use serde_json::{Map, Value, json};

use super::spared::spare;
use super::{progress, values};
use crate::output;
use crate::picture::{self, Made, Picture, Settings, Size, Stage, Strokes, Threshold, Watch};
use crate::scene::{BodyKeys, Matter, PatternName, Scene, SceneError};

/// How a picture is cut out, and what is made of it.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  wobble mesh gear.png --out gear.json\n  wobble mesh photo.jpg --spacing 8 --threshold 0.4 --preview mesh.png\n  wobble mesh letter.png --material rigid --height 3 --out letter.json\n  wobble mesh scan.png --invert --stats"
)]
pub(super) struct Arguments {
    /// A PNG, JPEG, GIF, BMP, WebP, TIFF, PNM, TGA, ICO or QOI.
    picture: PathBuf,
    /// Distance of neighbours in pixels.
    #[arg(long, value_name = "PX", default_value = "16", allow_negative_numbers = true, value_parser = values::above_zero, conflicts_with = "max_area")]
    spacing: f64,
    /// Largest area of a triangle, in square pixels, in place of the spacing.
    #[arg(long, value_name = "PX2", allow_negative_numbers = true, value_parser = values::above_zero)]
    max_area: Option<f64>,
    /// How many times as far apart neighbours may be deep inside as along the boundary, 1 to 9.
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true, value_parser = values::above_zero, conflicts_with = "max_area")]
    grading: Option<f64>,
    /// Coverage above which a pixel belongs to the body, 0 to 1; where the picture splits best if left out.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = share)]
    threshold: Option<f64>,
    /// What is light, or clear, becomes the body.
    #[arg(long)]
    invert: bool,
    /// All of the picture becomes the body, a rectangle.
    #[arg(long, conflicts_with_all = ["threshold", "invert"])]
    whole: bool,
    /// Specks and holes smaller than so many square pixels are left out.
    #[arg(long, value_name = "PX2", default_value = "12", allow_negative_numbers = true, value_parser = values::at_least_zero)]
    min_area: f64,
    /// Blurs the picture first, over so many pixels: for grainy photographs.
    #[arg(long, value_name = "PX", default_value = "0", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=64))]
    blur: u32,
    /// Fills holes.
    #[arg(long)]
    fill_holes: bool,
    /// What becomes of strokes too thin for triangles.
    #[arg(long, value_enum, default_value_t = StrokesArgument::Ropes)]
    strokes: StrokesArgument,
    /// Which points are bonded.
    #[arg(long, value_enum, default_value_t = PatternArgument::Edges)]
    pattern: PatternArgument,
    /// What the body is made of.
    #[arg(long, value_enum, default_value_t = MatterArgument::Soft)]
    material: MatterArgument,
    /// Young's modulus in the plane of a soft body, 1e-3 to 1e9 N/m.
    #[arg(long, value_name = "E", allow_negative_numbers = true, value_parser = stiffness)]
    young: Option<f64>,
    /// Height of the whole picture in the world, in metres.
    #[arg(long, value_name = "M", default_value = "2", allow_negative_numbers = true, value_parser = values::above_zero)]
    height: f64,
    /// Writes the scene there, with points, bonds and triangles one by one.
    #[arg(long, value_name = "FILE.json", value_parser = |text: &str| values::ending(text, &["json"]))]
    out: Option<PathBuf>,
    /// Leaves the picture where it is: the scene names its path instead of holding a copy.
    #[arg(long, requires = "out")]
    link: bool,
    /// Draws the mesh over the picture there.
    #[arg(long, value_name = "FILE.png", value_parser = |text: &str| values::ending(text, &["png"]))]
    preview: Option<PathBuf>,
    /// Prints measures and times as JSON, and nothing else.
    #[arg(long)]
    stats: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum StrokesArgument {
    /// Chains of bonds.
    Ropes,
    /// Drawn wider.
    Widen,
    /// Left out.
    Drop,
    /// Small triangles.
    Mesh,
}

#[derive(Clone, Copy, ValueEnum)]
enum PatternArgument {
    /// The sides of triangles.
    Edges,
    /// Those, and the far corners of every two triangles that share a side: the body resists folding.
    Braced,
}

#[derive(Clone, Copy, ValueEnum)]
enum MatterArgument {
    /// Springs.
    Soft,
    /// Bonds that keep their lengths.
    Rigid,
    /// Bonds relaxed in sweeps.
    Relaxed,
    /// Nothing that moves: an obstacle, with points that rain on it.
    Fixed,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("give a number from 0 to 1".to_owned()),
    }
}

fn stiffness(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (1e-3..=1e9).contains(&value) => Ok(value),
        _ => Err("give a number from 1e-3 to 1e9 N/m".to_owned()),
    }
}

pub(super) fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<()> {
    arguments.check()?;
    let (picture, made, times) = arguments.mesh(quiet)?;
    let stats = made.stats();
    let braces = match arguments.pattern {
        PatternArgument::Edges => Vec::new(),
        PatternArgument::Braced => made.mesh.braces(),
    };
    let bonds = stats.bonds + braces.len();
    // Whatever can fail is done before the first file is written.
    let mut preview = None;
    if let Some(path) = &arguments.preview {
        preview = Some((path, picture::encode(&preview::draw(&picture, &made.mesh, &braces)?)?));
    }
    drop(made);
    let scene = arguments.out.as_ref().map(|path| Ok::<_, anyhow::Error>((path, arguments.scene(path, picture)?)));
    let scene = scene.transpose()?;
    if let Some((path, drawn)) = &preview {
        output::replace(path, |to| to.write_all(drawn))?;
    }
    if let Some((path, scene)) = &scene {
        scene.save(path)?;
    }
    let mut out = std::io::stdout().lock();
    if arguments.stats {
        let text = serde_json::to_string_pretty(&measures(&stats, bonds, times))?;
        writeln!(out, "{text}")?;
    } else {
        let corners =
            scene.iter().flat_map(|(_, scene)| &scene.obstacles).filter_map(|obstacle| obstacle.polygon.as_ref());
        let said = match corners.flatten().map(Vec::len).sum::<usize>() {
            0 => format!("{} points, {} triangles, {bonds} bonds", stats.points, stats.triangles),
            corners => format!("an obstacle of {corners} corners"),
        };
        let written: Vec<String> =
            [&arguments.out, &arguments.preview].into_iter().flatten().map(|path| path.display().to_string()).collect();
        let end = if written.is_empty() { String::new() } else { format!(": {}", written.join(", ")) };
        writeln!(out, "{said}{end}")?;
    }
    Ok(())
}

impl Arguments {
    /// Errors: what would be written in place of the picture; a stiffness of what is not soft.
    fn check(&self) -> anyhow::Result<()> {
        let written: Vec<&Path> = [&self.out, &self.preview].into_iter().flatten().map(PathBuf::as_path).collect();
        spare(&[&self.picture], &written)?;
        if self.young.is_some() && !matches!(self.material, MatterArgument::Soft) {
            anyhow::bail!("--young is of soft bodies: leave it out, or --material");
        }
        Ok(())
    }

    fn settings(&self) -> Settings {
        Settings {
            threshold: match self.threshold {
                _ if self.whole => Threshold::Whole,
                threshold => threshold.map_or(Threshold::Otsu, Threshold::At),
            },
            invert: self.invert,
            blur: self.blur,
            fill_holes: self.fill_holes,
            min_area: self.min_area,
            size: match (self.max_area, self.grading) {
                (Some(area), _) => Size::MaxArea(area),
                (None, Some(ratio)) => Size::Graded { spacing: self.spacing, ratio },
                (None, None) => Size::Spacing(self.spacing),
            },
            strokes: match self.strokes {
                StrokesArgument::Ropes => Strokes::Ropes,
                StrokesArgument::Widen => Strokes::Widen,
                StrokesArgument::Drop => Strokes::Drop,
                StrokesArgument::Mesh => Strokes::Mesh,
            },
            ..Settings::default()
        }
    }

    /// All stages, with the time that each took `[ms]`.
    fn mesh(&self, quiet: bool) -> anyhow::Result<(Arc<Picture>, Made, Map<String, Value>)> {
        let settings = self.settings();
        let shown = self.picture.display();
        settings.check().with_context(|| format!("{shown}"))?;
        let bytes = Scene::picture_bytes(&self.picture)?;
        let bar = progress::waiting(quiet, Stage::Read.words());
        let mut clock = Clock::new();
        let picture = picture::decode(&bytes).with_context(|| format!("{shown}"))?;
        drop(bytes);
        clock.lap("decode");
        let watch = Watch::default().with_word(move |stage| bar.set_message(stage.words()));
        let made = picture::mesh_in_stages(&picture, &settings, &watch, |stage| clock.lap(stage));
        Ok((Arc::new(picture), made.with_context(|| format!("{shown}"))?, clock.times()))
    }

    /// The scene as a file: explicit points, bonds and triangles, with the picture inside or named from where it will lie.
    fn scene(&self, out: &Path, picture: Arc<Picture>) -> anyhow::Result<Scene> {
        let link = if self.link { Some(relative(out, &self.picture)?) } else { None };
        let matter = match self.material {
            MatterArgument::Soft => Matter::Soft,
            MatterArgument::Rigid => Matter::Rigid,
            MatterArgument::Relaxed => Matter::Relaxed,
            MatterArgument::Fixed => Matter::Fixed,
        };
        let material = Some(matter.material(self.young));
        let pattern = match self.pattern {
            PatternArgument::Edges => None,
            PatternArgument::Braced => Some(PatternName::Braced),
        };
        let keys = BodyKeys { material, pattern, ..BodyKeys::cut(&self.settings(), self.height, &picture) };
        let made = Scene::of_picture_read(&self.picture, picture, keys, matter).and_then(|scene| scene.expanded());
        // The scene is ours: what is wrong is what was asked for.
        let scene = made.map_err(|error| SceneError { key: String::new(), ..error })?;
        Ok(match link {
            Some(path) => scene.with_picture_at(&path),
            None => scene.with_pictures_inside()?,
        })
    }
}

/// The path of `to` from the folder that the file `from` lies in.
///
/// Errors: a file that is not there; a name that no scene can hold.
fn relative(from: &Path, to: &Path) -> anyhow::Result<String> {
    let folder = from.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let real =
        |path: &Path| std::fs::canonicalize(path).with_context(|| format!("{}: cannot be found", path.display()));
    let (folder, to) = (real(folder)?, real(to)?);
    let shared = folder.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(shared).map(|_| Some("..".to_owned()));
    let down = to.components().skip(shared).map(|part| part.as_os_str().to_str().map(str::to_owned));
    let parts: Option<Vec<String>> = up.chain(down).collect();
    let unsaid =
        || format!("{}: its path is not UTF-8, which a scene is: rename it, or leave --link out", to.display());
    Ok(parts.with_context(unsaid)?.join("/"))
}

fn measures(stats: &picture::Stats, bonds: usize, times: Map<String, Value>) -> Value {
    json!({
        "points": stats.points,
        "triangles": stats.triangles,
        "bonds": bonds,
        "min_angle_deg": stats.min_angle_deg,
        "p1_angle_deg": stats.p1_angle_deg,
        "edge_cv": stats.edge_cv,
        "area_px": stats.area_px,
        "ink_px": stats.ink_px,
        "area_error": stats.area_error,
        "boundary_deviation_px": stats.boundary_deviation_px,
        "components": stats.components,
        "holes": stats.holes,
        "ms": times,
    })
}

/// Times of stages.
struct Clock {
    start: Instant,
    last: Instant,
    times: Map<String, Value>,
}

impl Clock {
    fn new() -> Self {
        let now = Instant::now();
        Clock { start: now, last: now, times: Map::new() }
    }

    fn lap(&mut self, stage: &str) {
        let now = Instant::now();
        self.times.insert(stage.to_owned(), milliseconds(now - self.last));
        self.last = now;
    }

    fn times(mut self) -> Map<String, Value> {
        self.times.insert("total".to_owned(), milliseconds(self.last - self.start));
        self.times
    }
}

fn milliseconds(time: std::time::Duration) -> Value {
    (1e3 * time.as_secs_f64()).into()
}
