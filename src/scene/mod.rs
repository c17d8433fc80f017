//! Scene files, version 1: read, checked, written; and the gallery.
//!
//! A scene is a start: loaded again, it runs bit for bit as it did.

mod check;
mod content;
mod error;
pub mod file;
pub mod gallery;
mod maker;
mod material;
mod method;
mod numbers;
pub mod record;

use std::path::Path;

pub use content::Content;
use error::Problem;
pub use error::SceneError;
pub use file::SceneFile;
use file::{PointsFile, ProfileFile, RegionFile};
pub use maker::{BodyFile, MakerFile, MaterialFile};
pub use method::{solver, solver_name};
pub use numbers::{Masses, Vector};

use crate::sim::vector::truncate;
use crate::sim::{BondKind, Bounds, Dynamics, Method, Model, MouseForce, Profile, Region, Solver, Track, build};

/// A scene that was read and checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its keys as written.
    pub file: SceneFile,
    /// Its points and bonds.
    pub content: Content,
    /// How it is computed: the file's `method`, which a call may change.
    pub method: Method,
    /// The file, or the name of a gallery scene.
    label: String,
}

/// What a file is refused for beyond [`LARGEST_FILE`] bytes: it would only fill the memory.
const LARGEST_FILE: u64 = 4 << 30;

impl Scene {
    /// The scene of the gallery with that name, else the one in that file.
    ///
    /// Errors: no such scene or file; a file that cannot be read or is not a scene.
    pub fn load(name: &str) -> Result<Self, SceneError> {
        if let Some(entry) = gallery::find(name) {
            return Scene::parse(entry.text, entry.name);
        }
        let fail = |problem: String| SceneError { label: name.to_owned(), line: None, path: String::new(), problem };
        let path = Path::new(name);
        if !path.exists() && path.extension().is_none() {
            return Err(fail(gallery::no_such_scene(name)));
        }
        let about = std::fs::metadata(path).map_err(|error| fail(format!("cannot be read: {error}")))?;
        if about.is_dir() {
            return Err(fail("is a folder: give a scene file".to_owned()));
        }
        if about.len() > LARGEST_FILE {
            return Err(fail(format!("is larger than {} GiB: no scene is", LARGEST_FILE >> 30)));
        }
        let bytes = std::fs::read(path).map_err(|error| fail(format!("cannot be read: {error}")))?;
        let text =
            String::from_utf8(bytes).map_err(|_| fail("is not text: a scene file is JSON in UTF-8".to_owned()))?;
        Scene::parse(&text, name)
    }

    /// Reads and checks a scene; `label` names it in errors.
    ///
    /// Errors: the first thing that is wrong, with line and key.
    pub fn parse(text: &str, label: &str) -> Result<Self, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let file: SceneFile = match serde_json::from_str(text) {
            Ok(file) => file,
            Err(_) => return Err(explain(text, label)),
        };
        let located = |problem: Problem| problem.at(label, Some(text));
        if file.wobble != 1 {
            return Err(located(wrong_version(&file.wobble)));
        }
        if !(2..=3).contains(&file.dimensions) {
            let problem = format!("is {}: give 2 for the plane or 3 for space", file.dimensions);
            return Err(located(Problem::new("dimensions", problem)));
        }
        let content = Content::of(&file).map_err(located)?;
        check::check(&file, content.position.len()).map_err(located)?;
        let pinned = |point| content.pinned.iter().any(|pin| pin.0 == point);
        if let Some(i) = file.pin_motion.iter().position(|motion| !pinned(motion.point)) {
            return Err(located(Problem::new(format!("pin_motion[{i}].point"), "is not pinned: pin it first")));
        }
        let method = method::read(&file.method).map_err(located)?;
        Ok(Scene { file, content, method, label: label.to_owned() })
    }

    /// Its name; without one, its file's.
    pub fn name(&self) -> &str {
        if self.file.name.is_empty() { &self.label } else { &self.file.name }
    }

    /// 2 in the plane, 3 in space.
    pub fn dimensions(&self) -> usize {
        self.file.dimensions as usize
    }

    /// The file with bodies written out as points and bonds: the same scene to the last bit.
    pub fn expanded(&self) -> SceneFile {
        let dimensions = self.dimensions();
        let vectors = |list: &[[f64; 3]]| list.iter().map(|&x| Vector::new(x, dimensions)).collect();
        SceneFile {
            points: Some(PointsFile {
                position: vectors(&self.content.position),
                velocity: Some(vectors(&self.content.velocity)),
                mass: Some(Masses::Each(self.content.mass.clone())),
                pinned: self.content.pinned.iter().map(|pin| pin.0).collect(),
            }),
            bonds: self.content.bonds.iter().map(material::write).collect(),
            bodies: Vec::new(),
            ..self.file.clone()
        }
    }

    /// The model of the scene, computed as `self.method` says, until `duration` [s] if that is given.
    ///
    /// Errors: a solver and bonds that do not go together, relaxed bonds without substep and iterations.
    fn model<const D: usize>(&self, duration: Option<f64>) -> Result<Model<D>, SceneError> {
        self.check_method().map_err(|problem| problem.at(&self.label, None))?;
        let vectors = |list: &[[f64; 3]]| list.iter().map(|&x| truncate(x)).collect();
        let components = |vector: &Vector| vector.components(D).map(truncate).unwrap_or([0.0; D]);
        Ok(Model {
            position: vectors(&self.content.position),
            velocity: vectors(&self.content.velocity),
            mass: self.content.mass.clone(),
            pinned: self.content.pinned.clone(),
            bonds: self.content.bonds.clone(),
            gravity: self.file.gravity.as_ref().map_or([0.0; D], components),
            drag_rate: self.file.drag_rate,
            mouse: self.mouse(),
            bounds: self.file.bounds.as_ref().map(|bounds| Bounds {
                min: components(&bounds.min),
                max: components(&bounds.max),
                restitution: bounds.restitution,
                friction: bounds.friction,
            }),
            duration,
            method: self.method,
        })
    }

    fn mouse(&self) -> Option<MouseForce> {
        self.file.mouse.as_ref().map(|mouse| MouseForce {
            strength: mouse.strength,
            radius: mouse.radius,
            region: match mouse.region {
                RegionFile::Round => Region::Round,
                RegionFile::Square => Region::Square,
            },
            profile: match mouse.profile {
                ProfileFile::Smooth => Profile::Smooth,
                ProfileFile::Linear => Profile::Linear,
            },
            track: Track { knots: mouse.track.iter().map(|&[t, x, y]| (t, [x, y])).collect() },
        })
    }

    fn check_method(&self) -> Result<(), Problem> {
        let spring = |kind: &BondKind| matches!(kind, BondKind::Spring { .. });
        let relaxed = |kind: &BondKind| matches!(kind, BondKind::Relaxed { .. });
        let any = |test: &dyn Fn(&BondKind) -> bool| self.content.bonds.iter().any(|bond| test(&bond.kind));
        let sweeps = self.method.solver == Solver::Relaxation;
        if sweeps && any(&spring) {
            return Err(Problem::new("method.solver", "relaxation has no springs: use auto or verlet"));
        }
        if (sweeps && !self.content.bonds.is_empty()) || any(&relaxed) {
            let missing =
                [("substep", self.method.substep.is_none()), ("iterations", self.method.iterations.is_none())];
            if let Some((key, _)) = missing.into_iter().find(|(_, missing)| *missing) {
                let problem = format!("relaxed bonds mean nothing without it: give {key} in the scene or the call");
                return Err(Problem::new(format!("method.{key}"), problem));
            }
        }
        Ok(())
    }

    /// A world at the start of the scene; its last substep before `duration` [s] ends there.
    ///
    /// Errors: a solver and bonds that do not go together, relaxed bonds without substep and iterations.
    pub fn world(&self, duration: Option<f64>) -> Result<Box<dyn Dynamics>, SceneError> {
        let world = match self.dimensions() {
            2 => build(&self.model::<2>(duration)?),
            _ => build(&self.model::<3>(duration)?),
        };
        world.map_err(|error| Problem::new("", error.to_string()).at(&self.label, None))
    }
}

/// What serde found wrong, with key and line.
fn explain(text: &str, label: &str) -> SceneError {
    /// The version alone: a file of another one is not blamed for keys that this one doesn't know.
    #[derive(serde::Deserialize)]
    struct Version {
        wobble: serde_json::Value,
    }
    if let Ok(version) = serde_json::from_str::<Version>(text)
        && version.wobble != 1
    {
        return wrong_version(&version.wobble).at(label, Some(text));
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let error = match serde_path_to_error::deserialize::<_, SceneFile>(&mut reader) {
        Err(error) => error,
        // The scene ends well and something follows it.
        Ok(_) => {
            let problem = "something follows the end of the scene: remove it".to_owned();
            return SceneError { label: label.to_owned(), line: None, path: String::new(), problem };
        }
    };
    let path = match error.path().to_string() {
        path if path == "." => String::new(),
        path => path,
    };
    let inner = error.inner();
    let place = format!(" at line {} column {}", inner.line(), inner.column());
    let message = inner.to_string();
    let problem = message.strip_suffix(&place).unwrap_or(&message);
    let cure = match inner.classify() {
        serde_json::error::Category::Eof => ": the file is cut short",
        serde_json::error::Category::Syntax => ": this is not JSON (NaN and infinity are not numbers there)",
        _ => "",
    };
    SceneError {
        label: label.to_owned(),
        line: Some(inner.line()).filter(|&line| line > 0),
        path,
        problem: format!("{problem}{cure}"),
    }
}

fn wrong_version(found: &impl std::fmt::Display) -> Problem {
    Problem::new("wobble", format!("is {found}: this program reads version 1"))
}

/// The JSON Schema of scene files.
pub fn schema() -> schemars::Schema {
    schemars::schema_for!(SceneFile)
}
