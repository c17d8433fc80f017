//! Pictures of sessions that were cut off, as each was when it was last written, drawn beside the window while the gallery is open.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};

use image::RgbaImage;

use super::{Draft, FINE};
use crate::app::aside::Aside;
use crate::app::panels::THUMBNAIL;
use crate::history::Left;
use crate::render::{Gpu, Palette, View};
use crate::scene::Scene;

/// A session whose picture is wanted: its file, and the scene that it began with.
pub(in crate::app) type Wanted = (PathBuf, Scene);

/// Pictures on their way.
pub(in crate::app) struct CutOff {
    drawn: Receiver<(PathBuf, RgbaImage)>,
    ready: Vec<(PathBuf, RgbaImage)>,
    aside: Aside,
}

impl CutOff {
    /// Draws them one after another on a thread of its own, which calls `wake` after each and at the end. What cannot be drawn has none.
    pub(in crate::app) fn new(
        gpu: Gpu,
        palette: Palette,
        wanted: Vec<Wanted>,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let (sender, drawn) = channel();
        let aside = Aside::new(wake, move |is_wanted, wake| {
            let mut draft = Draft::new(gpu, THUMBNAIL.map(|side| (FINE * side) as u32), palette);
            for (path, scene) in wanted.into_iter().take_while(|_| is_wanted()) {
                let Some(picture) = picture(&path, &scene, &mut draft) else { continue };
                if sender.send((path, picture)).is_err() {
                    return;
                }
                wake();
            }
        });
        CutOff { drawn, ready: Vec::new(), aside }
    }

    /// Takes what was drawn. Returns whether there is something new.
    pub(in crate::app) fn poll(&mut self) -> bool {
        self.ready.extend(self.drawn.try_iter());
        !self.ready.is_empty()
    }

    /// The thread that draws them.
    pub(in crate::app) fn into_aside(self) -> Aside {
        self.aside
    }

    /// Gives what was drawn to the panels.
    pub(in crate::app) fn load(&mut self, context: &egui::Context, to: &mut BTreeMap<PathBuf, egui::TextureHandle>) {
        for (path, picture) in self.ready.drain(..) {
            let size = [picture.width() as usize, picture.height() as usize];
            let picture = egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
            let texture = context.load_texture(path.display().to_string(), picture, egui::TextureOptions::LINEAR);
            to.insert(path, texture);
        }
    }
}

/// A session as it was when it was last written, or where nothing of that is whole, as it began.
fn picture(path: &std::path::Path, scene: &Scene, draft: &mut Draft) -> Option<RgbaImage> {
    if let Some(last) = Left::last_of(path) {
        let skins = last.skins();
        return draft.picture(scene, &View { skins: &skins, tints: last.tints(), ..View::of(last.world()) });
    }
    let (world, skins) = (scene.world(None).ok()?, scene.skins().ok()?);
    draft.picture(scene, &View { skins: &skins, ..View::of(&*world) })
}
