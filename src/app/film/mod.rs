//! Pictures of a recording, one after another: `wobble render` writes them, and so does the window as a clip.

mod filming;
mod gif;
mod worlds;

use glam::DVec3;
use image::RgbaImage;

use super::opening::Followed;
use super::player::driven;
use super::words::Labels;
use crate::history::{Do, Entry, HistoryError, Recording, Replay};
use crate::render::{Camera, Capture, Gpu, Look, Overlay, Palette, Pane, RenderError, Tiles, Trails, View};
use crate::scene::BesideKeys;
use crate::sim::{Dynamics, PointId};
pub(super) use filming::{ClipSettings, Filmed, Filming, look_of_clip};
pub use gif::Gif;
use worlds::{Moment, Neighbors};

/// Which points of a world have trails.
pub type Followers = Box<dyn Fn(&View<'_>) -> Vec<PointId> + Send>;

/// How a film is looked at.
pub struct Shot {
    /// Where worlds lie that are side by side.
    pub tiles: Tiles,
    /// The camera of the first world, in its pane.
    pub camera: Camera,
    /// What it goes along with; `None`: it stands.
    pub followed: Option<Followed>,
    /// How worlds look.
    pub look: Look,
    /// What is shown by colour of those that stand beside the first.
    pub beside: Overlay,
    /// The colours that labels are written in.
    pub palette: Palette,
    /// Whether there are labels.
    pub has_labels: bool,
    /// Which points have trails.
    pub followers: Followers,
    /// How long these last `[s of the scene]`.
    pub trail: f64,
    /// Width and height of a picture `[px]`.
    pub size: [u32; 2],
}

/// A recording that is being drawn, picture by picture.
pub struct Film {
    run: Replay,
    commands: Vec<Entry>,
    beside: Neighbors,
    trails: Trails,
    labels: Labels,
    capture: Capture,
    shot: Shot,
    /// How many pictures there were.
    drawn: u64,
}

/// Why a film does not go on.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// What happens cannot be worked out again.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// It cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// Stretches of the trail before the first picture, and of the way to that.
const LEAD: u32 = 120;
/// The shorter side of pictures up to which lines and numbers have their usual width `[px]`: in larger ones they grow along.
const USUAL_SIDE: f32 = 1080.0;

/// Pixels of a picture of this size in a logical one.
pub fn scale_factor(size: [u32; 2]) -> f32 {
    (size[0].min(size[1]) as f32 / USUAL_SIDE).max(1.0)
}

impl Film {
    /// A film of a recording that `run` has followed to somewhere before the first picture, with the same start by other methods beside it, on
    /// this GPU or the one that there is.
    ///
    /// Errors: a method that cannot run the scene; no GPU; a size beyond what it draws.
    pub fn new(
        (start, run): (&Recording, Replay),
        beside: &[BesideKeys],
        gpu: Option<Gpu>,
        shot: Shot,
    ) -> Result<Self, FilmError> {
        let beside = Neighbors::new(start, beside, shot.trail)?;
        let dimensions = start.scene.dimensions();
        let capture = match gpu {
            Some(gpu) => Capture::on(gpu, shot.size, dimensions)?,
            None => Capture::new(shot.size, dimensions)?,
        };
        let labels = Labels::new(&[], (shot.palette, shot.look.scale_factor));
        let (trails, commands) = (Trails::new(shot.trail), start.commands.clone());
        Ok(Film { run, commands, beside, trails, labels, capture, shot, drawn: 0 })
    }

    /// What stands above the worlds beside the first.
    pub fn titles(&self) -> Vec<&str> {
        self.beside.titles()
    }

    /// How long trails last `[s of the scene]`.
    pub fn trail(&self) -> f64 {
        self.shot.trail
    }

    /// The world as it is in the last picture.
    pub fn run(&self) -> &Replay {
        &self.run
    }

    /// Goes to about a time `[s]` as long as `goes_on` says so, which is told how much of the way is gone, 0 to 1: it begins where the world is
    /// that is behind all others. Returns whether it got there.
    ///
    /// Errors: the recording cannot be followed.
    pub fn approach(&mut self, time: f64, goes_on: &mut dyn FnMut(f64) -> bool) -> Result<bool, FilmError> {
        let here = self.run.world().time();
        let began = self.beside.time().map_or(here, |behind| behind.min(here));
        for step in 0..LEAD {
            let share = f64::from(step) / f64::from(LEAD);
            if !goes_on(share) {
                return Ok(false);
            }
            self.go_to(began + (time - began) * share)?;
        }
        Ok(true)
    }

    /// Notes where points were before the first picture, at `time` `[s]`, as far as trails last, where there are some, as long as `goes_on` says
    /// so, which is told how much of the way is gone, 0 to 1. Returns whether it got there.
    ///
    /// Errors: the recording cannot be followed.
    pub fn lead_up(&mut self, time: f64, goes_on: &mut dyn FnMut(f64) -> bool) -> Result<bool, FilmError> {
        if (self.shot.followers)(&View::of(self.run.world())).is_empty() {
            return Ok(true);
        }
        let from = (time - self.shot.trail).max(0.0);
        for step in 0..LEAD {
            let share = f64::from(step) / f64::from(LEAD);
            if !goes_on(share) {
                return Ok(false);
            }
            self.go_to(from + (time - from) * share)?;
            self.note();
        }
        Ok(true)
    }

    /// All worlds reach a time `[s]`.
    fn go_to(&mut self, time: f64) -> Result<(), HistoryError> {
        self.run.advance(&self.commands, time)?;
        self.beside.reach(&self.commands, time);
        Ok(())
    }

    fn note(&mut self) {
        let view = View::of(self.run.world());
        self.trails.note(self.run.world().time(), &view, &(self.shot.followers)(&view));
        self.beside.note(&self.shot.followers);
    }

    /// The picture of a time `[s]`, which is none before that of the last one.
    ///
    /// Errors: the recording cannot be followed, or drawn.
    pub fn picture(&mut self, time: f64) -> Result<RgbaImage, FilmError> {
        self.go_to(time)?;
        self.go_along(time);
        let Film { run, beside, trails, labels, capture, shot, drawn, .. } = self;
        let camera = shot.tiles.whole(&shot.camera, shot.size);
        let skins = run.skins();
        let main = Moment::of(run.world(), (&skins, run.tints()), time, (trails, &shot.followers));
        let others = beside.moments(time, &main, &shot.followers);
        let moments: Vec<&Moment<'_>> = std::iter::once(&main).chain(&others).collect();
        let panes: Vec<Pane<'_>> = moments
            .iter()
            .enumerate()
            .map(|(place, moment)| {
                // The trails of all are compared on the first.
                let trails = moments.iter().zip(0..).filter(|(_, of)| place == 0 || *of == place);
                let trails = trails.map(|(moment, of)| (moment.trails, of)).collect();
                let view = View { trails, ..moment.view(*drawn) };
                let overlay = if place == 0 { shot.look.overlay } else { shot.beside };
                Pane::of(&shot.tiles, place, view, &camera, Look { overlay, ..shot.look }, shot.size)
            })
            .collect();
        if shot.has_labels {
            labels.say(run.labels());
        }
        let picture = labels.picture(capture, &panes)?;
        *drawn += 1;
        Ok(picture)
    }

    /// The camera goes along with what it follows from the start, else with what keys drive, as that of the window does once one was pressed.
    fn go_along(&mut self, time: f64) {
        let (world, Some(followed)) = (self.run.world(), &self.shot.followed) else { return };
        if world.dimensions() != 2 {
            return;
        }
        let presses = |entry: &Entry| entry.at <= time && matches!(entry.act, Do::Key { down: true, .. });
        let points = followed.or_driven(|| match self.commands.iter().any(presses) {
            true => driven(world),
            false => Vec::new(),
        });
        followed.lead(&mut self.shot.camera, points.into_iter().map(|point| place(world, point)));
    }
}

/// Where a point of the plane is `[m]`.
fn place(world: &dyn Dynamics, point: PointId) -> DVec3 {
    let positions = world.positions();
    DVec3::new(positions.get(2 * point.index()), positions.get(2 * point.index() + 1), 0.0)
}
