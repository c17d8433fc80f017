//! Pictures of the gallery's scenes, drawn beside the window by the renderer that draws in it.

mod cut_off;
mod kept;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use image::RgbaImage;

use super::aside::Aside;
use super::opening;
use super::panels::THUMBNAIL;
use crate::render::{Camera, Capture, Gpu, Look, Palette, View};
use crate::scene::{BodyKeys, EMPTY, Entry, MakerName, Scene, gallery};
pub(super) use cut_off::CutOff;
use kept::Kept;

/// A scene is shown as whoever opens it sees it after so long `[s]`, or what of that is stepped in this time.
const SHOWN_AT: f64 = 0.8;
const STEPPED_FOR: Duration = Duration::from_millis(40);
/// Room at the edges, as a share of the height.
const EDGE: f64 = 0.05;
/// Columns and rows of a cloth at most: more are not told apart.
const MOST_THREADS: u64 = 120;
/// Thumbnails have twice the pixels of what they are shown as on a plain screen.
const FINE: f32 = 2.0;

/// Thumbnails on their way.
pub(super) struct Thumbnails {
    drawn: Receiver<(&'static str, RgbaImage)>,
    ready: Vec<(&'static str, RgbaImage)>,
    /// All were drawn that can be.
    is_done: bool,
    /// The names of those that are looked at: they come first.
    wanted: Arc<Mutex<Vec<&'static str>>>,
    aside: Aside,
}

/// The next scene of those that are left: the first that is looked at.
fn next(left: &mut Vec<&'static Entry>, wanted: &[&str]) -> Option<&'static Entry> {
    let place = wanted.iter().find_map(|name| left.iter().position(|entry| entry.name == *name)).unwrap_or(0);
    (!left.is_empty()).then(|| left.remove(place))
}

impl Thumbnails {
    /// Draws all of the gallery, one after another, on a thread of its own, which calls `wake` after each and at the end: first those that are wanted. Those that
    /// were drawn at an earlier start are taken from a folder, if there is one.
    pub(super) fn new(gpu: Gpu, palette: Palette, folder: Option<PathBuf>, wake: impl Fn() + Send + 'static) -> Self {
        let (sender, drawn) = channel();
        let wanted: Arc<Mutex<Vec<&'static str>>> = Arc::default();
        let looked_at = Arc::clone(&wanted);
        let aside = Aside::new(wake, move |is_wanted, wake| {
            let size = THUMBNAIL.map(|side| (FINE * side) as u32);
            let mut draft = Draft::new(gpu, size, palette);
            let kept = Kept::in_folder(folder, palette, size);
            let mut draw = |entry: &'static Entry| {
                let drawn = thumbnail(entry, &mut draft)?;
                kept.write(entry.name, &drawn);
                Some(drawn)
            };
            let mut left: Vec<&Entry> = gallery().iter().chain([&EMPTY]).collect();
            let next = |left: &mut Vec<&'static Entry>| {
                let wanted = looked_at.lock().unwrap_or_else(PoisonError::into_inner).clone();
                next(left, &wanted)
            };
            while let Some(entry) = next(&mut left).filter(|_| is_wanted()) {
                let Some(picture) = kept.read(entry.name).or_else(|| draw(entry)) else { continue };
                if sender.send((entry.name, picture)).is_err() {
                    return;
                }
                wake();
            }
        });
        Thumbnails { drawn, ready: Vec::new(), is_done: false, wanted, aside }
    }

    /// These are looked at from now on.
    pub(super) fn want(&self, names: Vec<&'static str>) {
        *self.wanted.lock().unwrap_or_else(PoisonError::into_inner) = names;
    }

    /// Takes what was drawn. Returns whether there is something new.
    pub(super) fn poll(&mut self) -> bool {
        loop {
            match self.drawn.try_recv() {
                Ok(picture) => self.ready.push(picture),
                Err(TryRecvError::Empty) => return !self.ready.is_empty(),
                Err(TryRecvError::Disconnected) => {
                    return !std::mem::replace(&mut self.is_done, true) || !self.ready.is_empty();
                }
            }
        }
    }

    /// Whether there are still some to come.
    pub(super) fn is_drawing(&self) -> bool {
        !self.is_done
    }

    /// The thread that draws them.
    pub(super) fn into_aside(self) -> Aside {
        self.aside
    }

    /// Gives what was drawn to the panels.
    pub(super) fn load(&mut self, context: &egui::Context, to: &mut BTreeMap<&'static str, egui::TextureHandle>) {
        for (name, picture) in self.ready.drain(..) {
            let size = [picture.width() as usize, picture.height() as usize];
            let picture = egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
            to.insert(name, context.load_texture(name, picture, egui::TextureOptions::LINEAR));
        }
    }
}

/// A picture of a scene. One that cannot be drawn has none.
fn thumbnail(entry: &Entry, draft: &mut Draft) -> Option<RgbaImage> {
    let scene = coarser(entry.scene().ok()?);
    let mut world = scene.world(None).ok()?;
    let skins = scene.skins().ok()?;
    let (start, end) = (Instant::now(), SHOWN_AT * scene.rate());
    while world.time() < end && start.elapsed() < STEPPED_FOR {
        world.step();
    }
    draft.picture(&scene, &View { skins: &skins, ..View::of(&*world) })
}

/// What pictures of one size and in one palette are drawn with.
struct Draft {
    gpu: Gpu,
    size: [u32; 2],
    palette: Palette,
    /// In the plane, and in space.
    captures: [Option<Capture>; 2],
}

impl Draft {
    fn new(gpu: Gpu, size: [u32; 2], palette: Palette) -> Self {
        Draft { gpu, size, palette, captures: [None, None] }
    }

    /// A world of a scene; `None`: it cannot be drawn.
    fn picture(&mut self, scene: &Scene, view: &View<'_>) -> Option<RgbaImage> {
        let capture = self.captures.get_mut(view.dimensions.checked_sub(2)?)?;
        if capture.is_none() {
            *capture = Capture::on(self.gpu.clone(), self.size, view.dimensions).ok();
        }
        let capture = capture.as_mut()?;
        capture.forget_world();
        let camera = framed(scene, view, self.size);
        let look = Look { scale_factor: 1.0, ..Look::in_palette(self.palette) };
        capture.picture(view, &camera, &look).ok()
    }
}

/// All of a scene that its own view shows, with some room at the edges.
fn framed(scene: &Scene, view: &View<'_>, size: [u32; 2]) -> Camera {
    let [width, height] = size.map(f64::from);
    let edge = EDGE * height;
    opening::whole(opening::camera(scene, view, size), view, [[edge; 2], [width - edge, height - edge]])
}

/// The same scene with fewer threads in its cloths: as large, and hung as before.
pub(super) fn coarser(mut scene: Scene) -> Scene {
    for body in &mut scene.bodies {
        if body.make == MakerName::Cloth {
            thin_out(body);
        }
    }
    scene
}

fn thin_out(cloth: &mut BodyKeys) {
    let (Some(columns), Some(rows), Some(spacing)) = (cloth.columns, cloth.rows, cloth.spacing) else { return };
    let by = columns.max(rows).div_ceil(MOST_THREADS).max(1);
    if by == 1 {
        return;
    }
    let [fewer_columns, fewer_rows] = [columns, rows].map(|count| (count - 1) / by + 1);
    let thinned = |pin: &u32| {
        let (row, column) = (u64::from(*pin) / columns, u64::from(*pin) % columns);
        (row % by == 0 && column % by == 0).then_some((row / by * fewer_columns + column / by) as u32)
    };
    cloth.pinned = cloth.pinned.iter().filter_map(thinned).collect();
    (cloth.columns, cloth.rows) = (Some(fewer_columns), Some(fewer_rows));
    cloth.spacing = Some(spacing * by as f64);
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn what_is_looked_at_comes_first() {
        let mut left: Vec<&Entry> = gallery().iter().collect();
        let count = left.len();
        let names = [gallery()[7].name, gallery()[3].name];
        let first: Vec<&str> = (0..3).map(|_| next(&mut left, &names).unwrap().name).collect();
        assert_eq!(first, [names[0], names[1], gallery()[0].name]);
        assert_eq!((left.len(), next(&mut Vec::new(), &names).is_none()), (count - 3, true));
    }

    #[test]
    fn a_cloth_of_a_million_is_drawn_as_one_of_thousands_of_the_same_size() {
        let entry = gallery().iter().find(|entry| entry.name == "million-cloth").unwrap();
        let scene = coarser(entry.scene().unwrap());
        let world = scene.world(None).unwrap();
        assert!((5_000..20_000).contains(&world.point_count()), "{}", world.point_count());
        assert!(world.pinned().len() > 50, "its upper row");
        let small = gallery().iter().find(|entry| entry.name == "rim").unwrap().scene().unwrap();
        assert_eq!(coarser(small.clone()), small);
    }
}
