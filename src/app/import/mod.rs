//! A picture on its way into the world: how it is cut out, with a live preview, before it becomes a body.
//!
//! It comes from a file, or is painted here.

mod painting;
mod panel;
mod worker;

use std::path::Path;
use std::sync::Arc;

use crate::picture::{Picture, PictureError, Settings, Size};
use crate::scene::{BodyKeys, Matter, Scene, SceneError};
use painting::Painting;
use worker::{Forecast, Worker};

/// What the user wants of an import.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// A scene of its own.
    Open,
    /// One more body of the present scene, which begins anew.
    Add,
    /// Nothing.
    Cancel,
}

/// How a picture is to be cut out and what of: what the panel edits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wish {
    pub(super) settings: Settings,
    pub(super) matter: Matter,
    /// Young's modulus of a soft body [N/m].
    pub(super) young: f64,
    /// Height of the picture in the world [m].
    pub(super) height: f64,
}

/// A picture that is being imported.
pub(super) struct Import {
    name: String,
    picture: Arc<Picture>,
    /// What the picture is painted with, if it is.
    painting: Option<Painting>,
    wish: Wish,
    worker: Worker,
    /// The last mesh that was made, or why there is none.
    forecast: Option<Result<Forecast, String>>,
    /// What is shown, and of which picture.
    texture: Option<(Arc<Picture>, egui::TextureHandle)>,
}

/// Neighbours along the longer side of a picture at first.
const NEIGHBOURS: f64 = 40.0;

impl Import {
    /// Begins with a picture file; `wake` is called from another thread when there is something new to show.
    ///
    /// Errors: the file is not there or no picture.
    pub(super) fn of_file(path: &Path, wake: impl Fn() + Send + 'static) -> Result<Self, SceneError> {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Import::new(name, Scene::picture_file(path)?, None, wake))
    }

    /// Begins with a canvas: an empty one, or one with a picture to paint over.
    ///
    /// Errors: a picture too large for a canvas.
    pub(super) fn of_canvas(on: Option<&Picture>, wake: impl Fn() + Send + 'static) -> Result<Self, PictureError> {
        let painting = Painting::new(on)?;
        let picture = Arc::new(painting.picture());
        Ok(Import::new("drawing".to_owned(), picture, Some(painting), wake))
    }

    fn new(name: String, picture: Arc<Picture>, painting: Option<Painting>, wake: impl Fn() + Send + 'static) -> Self {
        let side = f64::from(picture.width.max(picture.height));
        let settings = Settings { size: Size::Spacing((side / NEIGHBOURS).max(2.0)), ..Settings::default() };
        let wish = Wish { settings, matter: Matter::Soft, young: Matter::YOUNG, height: 2.0 };
        let worker = Worker::new(wake);
        worker.ask(&picture, wish);
        Import { name, picture, painting, wish, worker, forecast: None, texture: None }
    }

    /// Takes what the worker has made. Returns whether there is something new to show.
    pub(super) fn poll(&mut self) -> bool {
        let Some(made) = self.worker.take() else { return false };
        self.forecast = Some(made);
        true
    }

    /// Shows the panel; what is changed there is meshed at once, elsewhere.
    pub(super) fn show(&mut self, context: &egui::Context, can_add: bool) -> Option<Answer> {
        let before = self.wish;
        let answer = panel::show(self, context, can_add);
        let painted = self.painting.as_mut().and_then(Painting::take_changed);
        let is_new = painted.is_some() || self.wish != before;
        if let Some(picture) = painted {
            self.picture = Arc::new(picture);
        }
        if is_new {
            self.worker.ask(&self.picture, self.wish);
        }
        answer
    }

    /// The scene that the body falls into by itself.
    ///
    /// Errors: a picture without ink; settings that make no mesh.
    pub(super) fn scene(&self) -> Result<Scene, SceneError> {
        self.wish.scene(&self.name, &self.picture)
    }

    /// The present scene with the body in it, at `origin` [m].
    ///
    /// Errors: as of [`Import::scene`].
    pub(super) fn added_to(&self, scene: &Scene, origin: [f64; 2]) -> Result<Scene, SceneError> {
        scene.with_picture(Arc::clone(&self.picture), self.wish.keys(&self.picture), origin)
    }
}

impl Wish {
    fn keys(&self, picture: &Picture) -> BodyKeys {
        let material = self.matter.material((self.matter == Matter::Soft).then_some(self.young));
        BodyKeys { material: Some(material), ..BodyKeys::cut(&self.settings, self.height, picture) }
    }

    fn scene(&self, name: &str, picture: &Arc<Picture>) -> Result<Scene, SceneError> {
        Scene::of_drawing(name, Arc::clone(picture), self.keys(picture), self.matter)
    }
}
