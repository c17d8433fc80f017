//! A scene made of a picture: its body in a box, soft enough to wobble.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::{Fault, SceneError, SceneErrorKind, Source};
use super::file::file_bytes;
use super::keys::{
    AddKeys, BodyKeys, BoundsKeys, KindName, MakerName, Material, Meeting, MethodKeys, MouseKeys, ObstacleKeys,
    OrderName, PatternName, PictureKeys, Scene, StrokesName, Vector, ViewKeys,
};
use super::pictures::{LARGEST_FILE, inline};
use crate::picture::{self, Ground, Picture, Settings, Size, Stage, Strokes, Threshold, Watch};

/// What a picture's body is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Matter {
    /// Springs, as soft as Young's modulus says.
    #[default]
    Soft,
    /// Bonds that keep their lengths.
    Rigid,
    /// Bonds relaxed in sweeps, as the source of this system has them.
    Relaxed,
    /// Nothing that moves: an obstacle.
    Fixed,
}

/// Mass of the body `[kg]`.
const MASS: f64 = 3.0;
/// Height of the picture above the floor, and half the width of the box, in heights of the picture.
const DROP: f64 = 0.3;
const ROOM: f64 = 1.5;
/// What stands on the floor begins so far above it `[heights of the picture]`: skins keep a distance, and soft feet give way to a fall.
const GAP: f64 = 0.005;
/// Substep and largest correction of relaxed bonds, as the source has them `[s]`, `[1]`.
const RELAXED_SUBSTEP: f64 = 0.003;
const RELAXED_CORRECTION: f64 = 0.8;
/// Gravity `[m/s^2]`; and of relaxed bodies, which under their own weight would crumple.
const GRAVITY: f64 = 9.81;
const RELAXED_GRAVITY: f64 = 1.0;
/// Points that rain on an obstacle.
const DROPS: u64 = 300;

/// Bending of strokes of a soft body, over their weight and the square of its height, where none is said: a stroke half as long as the
/// picture is high, which bears a third of that weight, sags by about a tenth of its length.
const STROKE_BENDING: f64 = 0.06;
/// Most bonds of a body that gets it by itself, or of a selection that is given some: what bends is none of the large bodies.
pub(crate) const MOST_BENT: usize = 4_000;

/// Bonds of a scene up to which bodies meet each other and themselves where nothing is said: of more, meeting would take too long for a
/// frame.
pub(crate) const MOST_MEETING: usize = 20_000;

impl Matter {
    /// Young's modulus in the plane if none is said `[N/m]`: a body 2 m high that falls 1 m is squeezed by about a tenth; braced, it hardly
    /// folds. Limbs a tenth as wide as the body buckle, and it stays upright on them; of twice that they spring, and it leaps and turns over.
    pub const YOUNG: f64 = 4_000.0;

    /// The material, with Young's modulus `[N/m]` if it is soft and one is given.
    pub fn material(self, young: Option<f64>) -> Material {
        let material = Material { mass: Some(MASS), ..Material::default() };
        match self {
            Matter::Soft => {
                Material { kind: Some(KindName::Spring), young: Some(young.unwrap_or(Matter::YOUNG)), ..material }
            }
            Matter::Fixed => Material::default(),
            Matter::Rigid => Material { kind: Some(KindName::Rigid), ..material },
            Matter::Relaxed => {
                Material { kind: Some(KindName::Relaxed), max_correction: Some(RELAXED_CORRECTION), ..material }
            }
        }
    }

    /// The method that its bonds mean nothing without.
    fn method(self) -> MethodKeys {
        match self {
            Matter::Relaxed => MethodKeys {
                substep: Some(RELAXED_SUBSTEP),
                iterations: Some(1),
                order: Some(OrderName::Shuffled),
                ..MethodKeys::default()
            },
            _ => MethodKeys::default(),
        }
    }
}

/// Height of a picture where none is said `[m]`.
const HEIGHT: f64 = 2.0;

impl BodyKeys {
    /// The keys that cut what stands out from a picture's ground, or all of it where it has none; paper and clear pixels take none.
    fn standing_out(picture: &Picture) -> Self {
        match picture::ground(picture) {
            Ground::Clear | Ground::Light => BodyKeys::default(),
            Ground::Dark => BodyKeys { invert: Some(true), ..BodyKeys::default() },
            Ground::Nothing => {
                let spacing = Settings::of(picture, Ground::Nothing).spacing() * HEIGHT / f64::from(picture.height);
                BodyKeys { whole: Some(true), spacing: Some(spacing), ..BodyKeys::default() }
            }
        }
    }

    /// The keys that cut a picture out by these settings; the whole of it is to be `height` `[m]` high.
    pub fn cut(settings: &Settings, height: f64, picture: &Picture) -> Self {
        let (spacing, max_area, grading) = match settings.size {
            Size::Spacing(spacing) => (Some(spacing), None, None),
            Size::Graded { spacing, ratio } => (Some(spacing), None, Some(ratio)),
            Size::MaxArea(area) => (None, Some(area), None),
        };
        let is_whole = settings.threshold == Threshold::Whole;
        BodyKeys {
            make: MakerName::Picture,
            height: Some(height),
            spacing: spacing.map(|pixels| pixels * height / f64::from(picture.height)),
            max_area,
            grading,
            threshold: if let Threshold::At(share) = settings.threshold { Some(share) } else { None },
            invert: (settings.invert && !is_whole).then_some(true),
            whole: is_whole.then_some(true),
            min_area: Some(settings.min_area),
            blur: (settings.blur > 0).then_some(settings.blur),
            holes: settings.fill_holes.then_some(false),
            strokes: Some(match settings.strokes {
                Strokes::Ropes => StrokesName::Ropes,
                Strokes::Widen => StrokesName::Widen,
                Strokes::Drop => StrokesName::Drop,
                Strokes::Mesh => StrokesName::Mesh,
            }),
            ..BodyKeys::default()
        }
    }
}

impl Scene {
    /// The picture of a file.
    ///
    /// Errors: it is not there or is none.
    pub fn picture_file(path: &Path) -> Result<Arc<Picture>, SceneError> {
        let (source, file) = source_of(path);
        source.picture(&file).map_err(|fault| source.error(fault))
    }

    /// A picture file as it is, before its pixels are decoded.
    ///
    /// Errors: it is not there or cannot be read; it is no regular file; it is larger than 512 MiB.
    pub fn picture_bytes(path: &Path) -> Result<Vec<u8>, SceneError> {
        let error = |reason| SceneError::whole(SceneErrorKind::File, &path.display().to_string(), reason);
        file_bytes(path, LARGEST_FILE).map_err(error)
    }

    /// Whether a file is a picture, by how it begins; of a Targa, which begins in any way, by how its name ends.
    pub fn is_picture_file(path: &Path) -> bool {
        // A pipe would be waited for.
        if !path.is_file() {
            return false;
        }
        let mut start = [0; 64];
        let read = std::fs::File::open(path).and_then(|mut file| std::io::Read::read(&mut file, &mut start));
        read.is_ok_and(|count| is_picture(path, &start[..count]))
    }

    /// The picture file that the scene was made of, if it was.
    pub fn picture_path(&self) -> Option<PathBuf> {
        let path = PathBuf::from(&self.source.label);
        Scene::is_picture_file(&path).then_some(path)
    }

    /// An error of this scene that is not of its text.
    pub fn complaint(&self, message: &str) -> SceneError {
        self.source.error(Fault::invalid(message))
    }

    /// A scene in which the body of a picture file falls into a box, `keys` saying how it is cut out and what of; of fixed matter
    /// points rain on it.
    ///
    /// Errors: the file is not there or no picture; keys that are out of order; no ink.
    pub fn of_picture(path: &Path, keys: BodyKeys, matter: Matter) -> Result<Scene, SceneError> {
        let (source, file) = source_of(path);
        Scene::around(source, (stem(path), file), keys, matter)
    }

    /// The same of a picture file that was read.
    ///
    /// Errors: as of [`Scene::of_picture`].
    pub fn of_picture_read(
        path: &Path,
        picture: Arc<Picture>,
        keys: BodyKeys,
        matter: Matter,
    ) -> Result<Scene, SceneError> {
        let (source, file) = source_of(path);
        source.keep_as(&file, picture);
        Scene::around(source, (stem(path), file), keys, matter)
    }

    /// The scene of a picture file as it opens: what stands out from the picture's ground, or all of it where it has none, standing on the
    /// floor at rest; `watch` sees how far it is.
    ///
    /// Errors: as of [`Scene::of_picture`]; more points than `watch` wants; it was stopped.
    pub fn open_picture(path: &Path, watch: &Watch) -> Result<Scene, SceneError> {
        let (source, file) = source_of(path);
        let source = Source { watch: watch.clone(), ..source };
        let read = watch.enter(Stage::Read).map_err(|error| Fault::invalid(error.to_string()));
        let picture = read.and_then(|()| source.picture(&file)).map_err(|fault| source.error(fault))?;
        let keys = BodyKeys { pattern: Some(PatternName::Braced), ..BodyKeys::standing_out(&picture) };
        // The scene is ours: what is wrong is how the picture is cut out, which nobody could say here.
        let scene = Scene::around(source, (stem(path), file), keys, Matter::Soft);
        let scene = scene.and_then(Scene::with_meeting).and_then(Scene::on_the_floor);
        scene.map_err(|error| {
            let message = format!("{}: `wobble mesh` has options for that", error.message);
            SceneError { message, key: String::new(), ..error }
        })
    }

    /// The same of a picture that is in no file; `watch` sees how far it is. What is soft or rigid stands on the floor.
    ///
    /// Errors: as of [`Scene::of_picture`]; more points than `watch` wants; it was stopped.
    pub fn of_drawing(
        name: &str,
        picture: Arc<Picture>,
        keys: BodyKeys,
        matter: Matter,
        watch: &Watch,
    ) -> Result<Scene, SceneError> {
        let source = Source { watch: watch.clone(), ..Source::new(name, "") };
        let file = source.keep(picture);
        let scene = Scene::around(source, (name.to_owned(), file), keys, matter)?;
        match matter {
            Matter::Soft | Matter::Rigid => scene.with_meeting().and_then(Scene::on_the_floor),
            Matter::Relaxed | Matter::Fixed => Ok(scene),
        }
    }

    /// The same scene, whose only body, of a picture, meets itself and what is added, where it is not too large for that.
    ///
    /// Errors: those of [`Scene::picture_mesh`].
    fn with_meeting(mut self) -> Result<Scene, SceneError> {
        let is_braced = self.bodies.first().is_some_and(|body| body.pattern == Some(PatternName::Braced));
        let mesh = self.picture_mesh(0)?;
        // A brace for every side that two triangles share, which most sides are.
        let bonds = mesh.bonds.len() + if is_braced { mesh.mesh_bonds } else { 0 };
        self.contact = (bonds <= MOST_MEETING).then_some(Meeting::Is(true));
        Ok(self)
    }

    /// The same scene, the floor of its box right below its only body, of a picture: what falls topples, and is not seen as it was drawn.
    ///
    /// Errors: those of [`Scene::picture_mesh`].
    fn on_the_floor(mut self) -> Result<Scene, SceneError> {
        let mesh = self.picture_mesh(0)?;
        let height = self.bodies[0].height.unwrap_or(HEIGHT);
        let lowest = mesh.points.iter().map(|point| point[1]).fold(0.0, f64::max) / f64::from(mesh.picture[1]);
        if let Some(bounds) = &mut self.bounds
            && let Vector::Plane([_, floor]) = &mut bounds.min
        {
            *floor = (0.5 - lowest - GAP) * height;
        }
        Ok(self)
    }

    /// The same scene, its soft bodies of pictures with strokes firm enough to keep their shape under their weight, where no bending is said.
    ///
    /// Errors: those of [`Scene::picture_mesh`].
    pub(super) fn with_firm_strokes(mut self) -> Result<Scene, SceneError> {
        for body in 0..self.bodies.len() {
            let keys = &self.bodies[body];
            let material = keys.material.as_ref();
            let is_open = |material: &Material| material.kind == Some(KindName::Spring) && material.bending.is_none();
            if keys.make != MakerName::Picture || !material.is_some_and(is_open) {
                continue;
            }
            let mesh = self.picture_mesh(body)?;
            if mesh.bonds.len() == mesh.mesh_bonds || mesh.bonds.len() > MOST_BENT {
                continue;
            }
            let height = keys.height.unwrap_or(HEIGHT);
            if let Some(material) = &mut self.bodies[body].material {
                let of_strokes = mesh.areas[mesh.mesh_points..].iter().sum::<f64>() / mesh.areas.iter().sum::<f64>();
                let mass = of_strokes * material.mass.unwrap_or(MASS);
                material.bending = Some(STROKE_BENDING * mass * GRAVITY * height * height);
            }
        }
        Ok(self)
    }

    /// A box around the picture that the source knows as `file`.
    fn around(
        source: Source,
        (name, file): (String, String),
        keys: BodyKeys,
        matter: Matter,
    ) -> Result<Scene, SceneError> {
        let height = keys.height.unwrap_or(HEIGHT);
        let picture = source.picture(&file).map_err(|fault| source.error(fault))?;
        let ratio = f64::from(picture.width) / f64::from(picture.height);
        let half = ROOM * height * ratio.max(1.0);
        let (floor, ceiling) = (-(0.5 + DROP) * height, 2.0 * height);
        let is_fixed = matter == Matter::Fixed;
        let bodies = if is_fixed {
            let (low, high) = ([-0.5 * height * ratio, 0.6 * height], [0.5 * height * ratio, 1.9 * height]);
            vec![BodyKeys {
                make: MakerName::Points,
                count: Some(DROPS),
                min: Some(Vector::Plane(low)),
                max: Some(Vector::Plane(high)),
                seed: Some(1),
                ..BodyKeys::default()
            }]
        } else {
            let material = keys.material.clone().or_else(|| Some(matter.material(None)));
            vec![BodyKeys { make: MakerName::Picture, file: Some(file.clone()), material, ..keys.clone() }]
        };
        let obstacle = || ObstacleKeys {
            picture: Some(PictureKeys { file, ..PictureKeys::of_body(&keys) }),
            restitution: Some(0.2),
            friction: Some(0.5),
            ..ObstacleKeys::default()
        };
        let gravity = if matter == Matter::Relaxed { RELAXED_GRAVITY } else { GRAVITY };
        let scene = Scene {
            name: Some(name),
            tags: vec!["picture".to_owned()],
            bodies,
            obstacles: if is_fixed { vec![obstacle()] } else { Vec::new() },
            gravity: Some(Vector::Plane([0.0, -gravity])),
            drag_rate: Some(0.2),
            mouse: Some(MouseKeys {
                strength: 800.0,
                radius: 0.35 * height,
                region: None,
                profile: None,
                track: Vec::new(),
            }),
            bounds: Some(BoundsKeys {
                min: Vector::Plane([-half, floor]),
                max: Vector::Plane([half, ceiling]),
                restitution: Some(0.2),
                friction: Some(0.5),
            }),
            view: Some(ViewKeys {
                center: Some(Vector::Plane([0.0, 0.1 * height])),
                height: Some(1.9 * height),
                ..ViewKeys::default()
            }),
            method: matter.method(),
            source,
            ..Scene::default()
        };
        scene.check()?;
        let scene = scene.with_firm_strokes()?;
        // It is there: what is made of it later has its own bounds, and is not ended by whoever waited for it.
        Ok(Scene { source: Source { watch: Watch::default(), ..scene.source.clone() }, ..scene })
    }

    /// Puts the pictures that the scene names by path into the scene itself.
    ///
    /// Errors: a picture that cannot be read.
    pub fn with_pictures_inside(mut self) -> Result<Scene, SceneError> {
        let label = self.source.label.clone();
        let put = |source: &Source, name: &str| -> Result<String, SceneError> {
            let png = source.png(name).map_err(|fault| fault.into_error(&label, None))?;
            Ok(inline(&png))
        };
        for body in &mut self.bodies {
            if let Some(file) = &mut body.file {
                *file = put(&self.source, file)?;
            }
        }
        for picture in self.obstacles.iter_mut().filter_map(|obstacle| obstacle.picture.as_mut()) {
            picture.file = put(&self.source, &picture.file)?;
        }
        if let Some(texture) = &mut self.texture {
            texture.image = put(&self.source, &texture.image)?;
        }
        Ok(self)
    }

    /// What is added to this scene, with the pictures that it names by path inside.
    ///
    /// Errors: a picture that cannot be read.
    pub(crate) fn addition_with_pictures_inside(&self, keys: &AddKeys) -> Result<AddKeys, SceneError> {
        let (bodies, obstacles) = (keys.bodies.clone(), keys.obstacles.clone());
        let alone = Scene { bodies, obstacles, source: self.source.clone(), ..Scene::default() };
        let Scene { bodies, obstacles, .. } = alone.with_pictures_inside()?;
        let mut textures = keys.textures.clone();
        for texture in &mut textures {
            let png = self.source.png(&texture.image).map_err(|fault| self.source.error(fault))?;
            texture.image = inline(&png);
        }
        Ok(AddKeys { bodies, obstacles, textures, ..keys.clone() })
    }

    /// Names the scene's only picture by this path instead: relative to where the scene will lie.
    pub fn with_picture_at(mut self, path: &str) -> Scene {
        for body in &mut self.bodies {
            body.file = body.file.take().map(|_| path.to_owned());
        }
        for picture in self.obstacles.iter_mut().filter_map(|obstacle| obstacle.picture.as_mut()) {
            path.clone_into(&mut picture.file);
        }
        if let Some(texture) = &mut self.texture {
            path.clone_into(&mut texture.image);
        }
        self
    }
}

/// The name of a scene of this file.
fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Whether a file that begins with these bytes is a picture.
pub(super) fn is_picture(path: &Path, start: &[u8]) -> bool {
    picture::is_picture(start) || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("tga"))
}

/// A source of scenes beside a picture file, and the file's name from there.
fn source_of(path: &Path) -> (Source, String) {
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    (Source::new(&path.display().to_string(), ""), file)
}
