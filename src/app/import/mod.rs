//! A picture on its way into the world: how it is cut out, with a live preview, before it becomes a body.
//!
//! It comes from a file, from the clipboard or from a body of the scene, or is painted here.

#[cfg(test)]
mod meeting_tests;
mod painting;
mod panel;
mod preview;
#[cfg(test)]
mod taken_tests;
mod wishes;
mod worker;

use std::sync::Arc;

use super::matter::Preset;
use super::player::Coming;
use crate::history::History;
use crate::picture::{self, Ground, Picture, PictureError, PictureMesh, Settings, Size, Watch};
use crate::scene::{BodyKeys, Cut, KindName, Material, Matter, PatternName, Scene, SceneError};
use painting::Painting;
use worker::{Forecast, Worker};

/// What the user wants of an import.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// A scene of its own.
    Open,
    /// One more body of the present scene, which begins anew.
    Add,
    /// In place of the body that it was cut out as.
    Replace,
    /// Nothing.
    Cancel,
}

/// Height of a picture at first, for which [`Matter::YOUNG`] is chosen `[m]`.
const HEIGHT: f64 = 2.0;

/// How a picture is to be cut out and what of: what the panel edits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wish {
    pub(super) settings: Settings,
    pub(super) matter: Matter,
    /// The matter by name that it is of, with the density of that; `None`: what the numbers say.
    pub(super) of: Option<Preset>,
    /// Young's modulus of a soft body `[N/m]`.
    pub(super) young: f64,
    /// Height of the picture in the world `[m]`.
    pub(super) height: f64,
    pub(super) pattern: PatternName,
    /// Connected parts become bodies of their own.
    pub(super) apart: bool,
}

/// A picture that is being imported.
pub(super) struct Import {
    name: String,
    picture: Arc<Picture>,
    /// What its shapes stand out from.
    ground: Ground,
    /// What the picture is painted with, if it is.
    painting: Option<Painting>,
    wish: Wish,
    /// The body of the present scene that is cut out anew, and what it was made of, if it is one.
    body: Option<(usize, Matter, f64)>,
    worker: Worker,
    /// The last mesh that was made, or why there is none.
    forecast: Option<Result<Forecast, String>>,
    /// What is shown of a picture that is not painted.
    texture: Option<egui::TextureHandle>,
    /// It has just been opened: the panel is at its top.
    is_fresh: bool,
    /// Enter was pressed: the first button of the panel answers.
    is_entered: bool,
}

impl Import {
    /// Begins with a picture; `wake` is called from another thread when there is something new to show.
    pub(super) fn of_picture(name: String, picture: Arc<Picture>, wake: impl Fn() + Send + 'static) -> Self {
        let wish = Wish::of(&picture, picture::ground(&picture));
        Import::new(name, picture, wake, wish)
    }

    /// The same with points this far apart at first `[px]`.
    pub(super) fn spaced(mut self, spacing: f64) -> Self {
        self.wish.settings.size = Size::Spacing(spacing);
        self.worker.ask(&self.picture, self.wish);
        self
    }

    /// Begins with an empty canvas.
    ///
    /// Errors: none that is known.
    pub(super) fn of_canvas(wake: impl Fn() + Send + 'static) -> Result<Self, PictureError> {
        let painting = Painting::new(None)?;
        let picture = Arc::new(painting.picture());
        Ok(Import { painting: Some(painting), ..Import::of_picture("drawing".to_owned(), picture, wake) })
    }

    /// Begins with a canvas to paint over the picture of a scene's first body that is cut out of one, as it is.
    ///
    /// Errors: no such body; a picture that is not there any more, or is too large for a canvas.
    pub(super) fn of_canvas_over(scene: &Scene, wake: impl Fn() + Send + 'static) -> Result<Self, SceneError> {
        let (body, wish, picture) = of_body(scene)?.ok_or_else(|| scene.complaint("has no picture to paint over"))?;
        let painting = Painting::new(Some(&picture)).map_err(|error| scene.complaint(&error.to_string()))?;
        let picture = Arc::new(painting.picture());
        let import = Import::new("drawing".to_owned(), picture, wake, wish);
        Ok(Import { painting: Some(painting), body: Some(body), ..import })
    }

    /// Begins with the first body of a scene that is cut out of a picture, as it is; `None` where there is none. A picture file
    /// that the scene was made of is read again.
    ///
    /// Errors: a picture that is not there any more.
    pub(super) fn of_scene(scene: &Scene, wake: impl Fn() + Send + 'static) -> Result<Option<Self>, SceneError> {
        let Some((body, wish, picture)) = of_body(scene)? else { return Ok(None) };
        Ok(Some(Import { body: Some(body), ..Import::new(scene.name().to_owned(), picture, wake, wish) }))
    }

    /// What is wrong with the picture, in the words of the panel.
    pub(super) fn worded(&self, fault: String) -> String {
        panel::worded(fault, &self.wish.settings)
    }

    /// Whether it is a canvas.
    pub(super) fn is_canvas(&self) -> bool {
        self.painting.is_some()
    }

    /// Whether something was painted that would be lost with the import.
    pub(super) fn has_work(&self) -> bool {
        self.painting.as_ref().is_some_and(Painting::has_work)
    }

    /// Where on the screen the middle of what was painted is, if anything was `[points]`.
    pub(super) fn drawn_at(&self) -> Option<egui::Pos2> {
        self.painting.as_ref().and_then(Painting::middle)
    }

    /// It is put away for a while: a stroke under way ends, and what it was to take the place of may be another when it comes back.
    pub(super) fn put_away(&mut self) {
        if let Some(painting) = &mut self.painting {
            painting.lift();
        }
        (self.body, self.is_fresh) = (None, true);
    }

    fn new(name: String, picture: Arc<Picture>, wake: impl Fn() + Send + 'static, wish: Wish) -> Self {
        let mut worker = Worker::new(name.clone(), wake);
        worker.ask(&picture, wish);
        let ground = picture::ground(&picture);
        let (forecast, texture, is_fresh) = (None, None, true);
        let (painting, body, is_entered) = (None, None, false);
        Import { name, picture, ground, painting, wish, body, worker, forecast, texture, is_fresh, is_entered }
    }

    /// Enter was pressed, which no field took: it does what the first button does.
    pub(super) fn enter(&mut self) {
        self.is_entered = true;
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
        if let Some(painting) = &mut self.painting {
            painting.set_own(self.wish.of.map_or(painting::INK, Preset::color));
        }
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

    /// The scene that the body falls into by itself: the one that was tried out, if it is what is wished for now.
    ///
    /// Errors: a picture without ink; settings that make no mesh.
    pub(super) fn scene(&self) -> Result<Scene, SceneError> {
        match &self.forecast {
            Some(Ok(made)) if made.wish == self.wish && Arc::ptr_eq(&made.picture, &self.picture) => {
                Ok(made.scene.clone())
            }
            _ => self.wish.scene(&self.name, &self.picture, &Watch::default()),
        }
    }

    /// How many points it brings, as far as that is known; none as an obstacle.
    pub(super) fn coming(&self) -> usize {
        match &self.forecast {
            Some(Ok(made)) if made.outlines == 0 => made.mesh.points.len(),
            _ => 0,
        }
    }

    /// What the running world of a scene gets: bodies or an obstacle, where there is room when it is asked, if possible in what is
    /// `seen` of it (lower and upper corner `[m]`).
    ///
    /// Errors, then: as of [`Import::scene`].
    pub(super) fn adder(
        &self,
        seen: [[f64; 2]; 2],
    ) -> impl FnOnce(&History) -> Result<Coming, String> + Send + 'static {
        let (wish, name, picture) = (self.wish, self.name.clone(), Arc::clone(&self.picture));
        let known = self.area();
        move |history| {
            let (scene, world) = (history.scene(), history.world());
            let area = known.map_or_else(|| wish.area(&name, &picture), |area| Ok(Some(area)));
            let keys = wish.keys(&picture, area.map_err(|error| error.to_string())?);
            let added = match wish.matter {
                Matter::Fixed => scene.obstacle_to_add(world, (&picture, &keys), seen),
                _ => scene.body_to_add(world, (&picture, keys), seen, wish.apart),
            };
            let added = added.map(|mut keys| {
                keys.bodies.iter_mut().for_each(|body| wish.weigh(body));
                keys
            });
            added.map(Coming::of).map_err(|error| error.to_string())
        }
    }

    /// The present scene with its body cut out as it is wished for now.
    ///
    /// Errors: as of [`Import::scene`]; it is no body of the scene.
    pub(super) fn put_into(&self, scene: &Scene) -> Result<Scene, SceneError> {
        let (body, matter, young) = self.body.ok_or_else(|| scene.complaint("has no such body"))?;
        if self.wish.matter == Matter::Fixed {
            return Err(scene.complaint("an obstacle does not take the place of a body: add it to the scene"));
        }
        let area = self.area().map_or_else(|| self.wish.area(&self.name, &self.picture), |area| Ok(Some(area)))?;
        let mut keys = self.wish.keys(&self.picture, area);
        if (self.wish.of, self.wish.matter, self.wish.young) == (None, matter, young) {
            keys.material = None;
        }
        let mut changed = scene.with_picture_anew(body, Arc::clone(&self.picture), keys)?;
        if self.is_canvas() {
            changed.name = Some(self.name.clone());
        }
        if !self.wish.apart {
            return Ok(changed);
        }
        let first = changed.bodies.len();
        let mut changed = changed.in_parts(body)?;
        let parts = changed.bodies.len() + 1 - first;
        changed.bodies[body..body + parts].iter_mut().for_each(|part| self.wish.weigh(part));
        Ok(changed)
    }

    /// What the body covers, where it was cut out last as it is wished for now `[m^2]`.
    fn area(&self) -> Option<f64> {
        let made = self.forecast.as_ref()?.as_ref().ok()?;
        let is_same = made.wish.settings == self.wish.settings && Arc::ptr_eq(&made.picture, &self.picture);
        is_same.then(|| covered(&made.mesh, self.wish.height))
    }
}

/// What a body covers that is cut out of a picture so high `[m^2]`, its strokes too.
fn covered(mesh: &PictureMesh, height: f64) -> f64 {
    mesh.areas.iter().sum::<f64>() * (height / f64::from(mesh.picture[1])).powi(2)
}

/// The first body of a scene that is cut out of a picture: its number, with what it is made of, how it is cut out, and the picture.
type Body = ((usize, Matter, f64), Wish, Arc<Picture>);

/// Errors: a picture that is not there any more.
fn of_body(scene: &Scene) -> Result<Option<Body>, SceneError> {
    let Some(body) = scene.picture_body() else { return Ok(None) };
    let Cut { mut picture, settings, height } = scene.cut(body)?;
    if let Some(path) = scene.picture_path() {
        picture = Scene::picture_file(&path)?;
    }
    let keys = &scene.bodies[body];
    let material = keys.material.clone().unwrap_or_default();
    let matter = match material.kind {
        Some(KindName::Spring) => Matter::Soft,
        Some(KindName::Relaxed) => Matter::Relaxed,
        _ => Matter::Rigid,
    };
    let young = material.young.unwrap_or(Matter::YOUNG);
    let pattern = keys.pattern.unwrap_or(PatternName::Edges);
    Ok(Some((
        (body, matter, young),
        Wish { settings, matter, of: None, young, height, pattern, apart: false },
        picture,
    )))
}

impl Wish {
    /// What is wished for at first.
    fn of(picture: &Picture, ground: Ground) -> Self {
        let settings = Settings::of(picture, ground);
        let (matter, young, pattern) = (Matter::Soft, first_young(HEIGHT), PatternName::Braced);
        Wish { settings, matter, of: None, young, height: HEIGHT, pattern, apart: false }
    }

    /// The picture is so high from now on `[m]`: a stiffness that nobody has chosen goes with that.
    fn grow(&mut self, height: f64) {
        if self.young == first_young(self.height) {
            self.young = first_young(height);
        }
        self.height = height;
    }

    /// A body that covers so much, where that is known `[m^2]`.
    fn keys(&self, picture: &Picture, area: Option<f64>) -> BodyKeys {
        let material = match self.of.zip(area) {
            Some((preset, area)) => of_preset(preset, area),
            None => self.matter.material((self.matter == Matter::Soft).then_some(self.young)),
        };
        let pattern = (self.pattern != PatternName::Edges).then_some(self.pattern);
        BodyKeys { material: Some(material), pattern, ..BodyKeys::cut(&self.settings, self.height, picture) }
    }

    /// What a body of a matter by name covers, cut out for that `[m^2]`; `None` of another.
    ///
    /// Errors: as of [`Import::scene`].
    fn area(&self, name: &str, picture: &Arc<Picture>) -> Result<Option<f64>, SceneError> {
        if self.of.is_none() || self.matter == Matter::Fixed {
            return Ok(None);
        }
        let keys = self.keys(picture, None);
        let scene = Scene::of_drawing(name, Arc::clone(picture), keys, self.matter, &Watch::default())?;
        let mesh = scene.picture_mesh(0)?;
        Ok(Some(covered(&mesh, self.height)))
    }

    fn scene(&self, name: &str, picture: &Arc<Picture>, watch: &Watch) -> Result<Scene, SceneError> {
        let keys = self.keys(picture, None);
        let mut scene = Scene::of_drawing(name, Arc::clone(picture), keys, self.matter, watch)?;
        if let Some(preset) = self.of {
            // What it covers is known once it is cut out.
            let mesh = scene.picture_mesh(0)?;
            let area = covered(&mesh, self.height);
            scene.bodies[0].material = Some(of_preset(preset, area));
        }
        if !self.is_apart() {
            return Ok(scene);
        }
        let mut scene = scene.in_parts(0)?;
        scene.bodies.iter_mut().for_each(|part| self.weigh(part));
        Ok(scene)
    }

    /// A part of the body is of the matter by itself: as stiff as its own mass says.
    fn weigh(&self, part: &mut BodyKeys) {
        let mass = part.material.as_ref().and_then(|material| material.mass);
        if let Some((preset, mass)) = self.of.zip(mass) {
            part.material = Some(of_preset(preset, mass / preset.material(1.0, 1.0).mass.unwrap_or(1.0)));
        }
    }

    /// Parts that move become bodies of their own.
    fn is_apart(&self) -> bool {
        self.apart && self.matter != Matter::Fixed
    }
}

/// Young's modulus at first of a body whose picture is so high `[N/m]`, in two digits.
///
/// Model: bodies of pictures have one mass M, whatever their height H. A part w wide, a share of H, is pressed together by M g/(E w), and a limb
/// w wide and l long buckles where M g l^2/(E w^3) is too large: both stay as they are where E H does. So do the swings of a body in the time
/// (H/g)^(1/2), and its damping, which is a share of the critical one: it stands, falls and wobbles alike at any size.
fn first_young(height: f64) -> f64 {
    let young = Matter::YOUNG * HEIGHT / height;
    let digit = 10_f64.powf(young.log10().floor() - 1.0);
    (young / digit).round() * digit
}

/// What a body of a picture that covers so much is of `[m^2]`; it keeps the colours of its picture.
fn of_preset(preset: Preset, area: f64) -> Material {
    Material { color: None, ..preset.material(area, 1.0) }
}
