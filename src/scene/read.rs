//! From a file, a name or a text to a scene.

use std::path::Path;

use serde::Deserialize;

use super::error::{SceneError, SceneErrorKind, Source, Step, path_name};
use super::file::scene_bytes;
use super::gallery::{self, gallery};
use super::keys::Scene;
use super::locate;
use super::nearest::{list, nearest};
use super::of_picture::is_picture;
use super::support::LATER;
use crate::picture::{PictureError, Watch, is_picture_name, is_svg};

/// Largest file that is read `[bytes]`: beyond, it would only fill the memory.
const LARGEST_FILE: u64 = 4 << 30;

impl Scene {
    /// The scene of a file, or of the gallery where there is no such file.
    ///
    /// Errors: neither is there; the file cannot be read; those of [`Scene::parse`].
    pub fn load(file_or_name: &str) -> Result<Scene, SceneError> {
        let path = Path::new(file_or_name);
        if path.exists() && !path.is_dir() {
            return Scene::read(path);
        }
        if let Some(entry) = gallery::find(file_or_name) {
            return entry.scene();
        }
        let error = |kind, message| Err(SceneError::whole(kind, file_or_name, message));
        if path.is_dir() {
            let message = "is a directory: give a scene file in it, or the name of a gallery scene";
            return error(SceneErrorKind::File, message.to_owned());
        }
        error(SceneErrorKind::NotFound, not_found(file_or_name))
    }

    /// The scene of a file.
    ///
    /// Errors: the file is not there, cannot be read or is not UTF-8; those of [`Scene::parse`].
    pub fn read(path: &Path) -> Result<Scene, SceneError> {
        let label = path.display().to_string();
        let bytes = scene_bytes(path, LARGEST_FILE)
            .map_err(|reason| SceneError::whole(SceneErrorKind::File, &label, reason))?;
        if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
            let message = "is UTF-16: save it as UTF-8";
            return Err(SceneError::whole(SceneErrorKind::Syntax, &label, message));
        }
        if is_picture(path, &bytes) {
            return Scene::open_picture(path, &Watch::default());
        }
        if is_svg(&bytes) {
            return Err(SceneError::whole(SceneErrorKind::Syntax, &label, PictureError::Drawing.to_string()));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = error.utf8_error().valid_up_to();
            let line = 1 + error.as_bytes()[..valid].iter().filter(|&&c| c == b'\n').count();
            SceneError {
                line: Some(line),
                ..SceneError::whole(
                    SceneErrorKind::Syntax,
                    &label,
                    "is not text in UTF-8 nor a picture: give a scene file in UTF-8, or a PNG, JPEG, GIF, BMP, WebP or TIFF",
                )
            }
        })?;
        let scene = Scene::parse(&text, &label);
        match scene {
            // Text by the name of a picture.
            Err(error) if error.kind == SceneErrorKind::Syntax && is_picture_name(path) => {
                Err(SceneError::whole(SceneErrorKind::Syntax, &label, PictureError::Unknown.to_string()))
            }
            scene => scene,
        }
    }

    /// The scene of a text that stands in another: places are keys, for lines would be those of the whole.
    ///
    /// Errors: those of [`Scene::parse`].
    pub(crate) fn parse_within(text: &str, label: &str) -> Result<Scene, SceneError> {
        let within = |error: SceneError| {
            let key = if error.key.is_empty() { "scene".to_owned() } else { format!("scene.{}", error.key) };
            SceneError { line: None, key, ..error }
        };
        let mut scene = Scene::parse(text, label).map_err(within)?;
        scene.source.text = None;
        Ok(scene)
    }

    /// The scene of a text; `label` stands for the file in messages.
    ///
    /// Errors: the text is not JSON, or not a scene by the specification; with line and key.
    pub fn parse(text: &str, label: &str) -> Result<Scene, SceneError> {
        if text.trim().is_empty() {
            let message = "is empty: a scene starts with {\"wobble\": 1, …}";
            return Err(SceneError::whole(SceneErrorKind::Syntax, label, message));
        }
        if text.starts_with('\u{feff}') {
            return Err(SceneError {
                line: Some(1),
                ..SceneError::whole(
                    SceneErrorKind::Syntax,
                    label,
                    "starts with a byte order mark: save it as UTF-8 without one",
                )
            });
        }
        let mut scene: Scene = serde_json::from_str(text).map_err(|error| explain(&error, text, label))?;
        scene.tidy();
        scene.source = Source::new(label, text);
        // The text at hand says the line even where it is too long to be kept.
        super::check::check(&scene).map_err(|fault| fault.into_error(label, Some(text)))?;
        Ok(scene)
    }
}

/// What to do where neither a file nor a gallery scene has the name.
fn not_found(name: &str) -> String {
    let looks_like_file = name.contains(['/', '\\', '.']);
    let names: Vec<&str> = gallery().iter().map(|entry| entry.name).collect();
    match nearest(name, &names) {
        Some(meant) => {
            format!("no file or gallery scene of this name: did you mean `{meant}`? `wobble scenes` lists them")
        }
        None if looks_like_file => "no such file: check the path".to_owned(),
        None => "no file or gallery scene of this name: `wobble scenes` lists them".to_owned(),
    }
}

/// The error that a text has that did not parse.
///
/// It is read once more, keeping track of the keys: a scene in order is not slowed down by that.
fn explain(plain: &serde_json::Error, text: &str, label: &str) -> SceneError {
    if let Some(error) = other_version(text, label) {
        return error;
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let mut track = serde_path_to_error::Track::new();
    let tracked = serde_path_to_error::Deserializer::new(&mut reader, &mut track);
    let path = match Scene::deserialize(tracked) {
        Ok(_) => Vec::new(),
        Err(_) => steps(&track.path()),
    };
    let (kind, message) = match plain.classify() {
        serde_json::error::Category::Data => (SceneErrorKind::Invalid, translate(plain)),
        _ => (SceneErrorKind::Syntax, syntax(plain, text)),
    };
    SceneError { kind, label: label.to_owned(), line: Some(plain.line().max(1)), key: path_name(&path), message }
}

/// A file of another version may have keys that this one does not know: its version is what is wrong.
fn other_version(text: &str, label: &str) -> Option<SceneError> {
    #[derive(Deserialize)]
    struct Head {
        wobble: Option<serde_json::Value>,
    }
    let version = serde_json::from_str::<Head>(text).ok()?.wobble?;
    if !version.is_number() || version.as_u64() == Some(1) {
        return None;
    }
    let step = [Step::Key("wobble".to_owned())];
    Some(SceneError {
        kind: SceneErrorKind::Unsupported,
        label: label.to_owned(),
        line: locate::line_of(text, &step),
        key: path_name(&step),
        message: format!(
            "is version {version}: this program reads version 1, so write \"wobble\": 1 or get a newer wobble"
        ),
    })
}

fn steps(path: &serde_path_to_error::Path) -> Vec<Step> {
    use serde_path_to_error::Segment;
    path.iter()
        .filter_map(|segment| match segment {
            Segment::Seq { index } => Some(Step::Index(*index)),
            Segment::Map { key } => Some(Step::Key(key.clone())),
            Segment::Enum { variant } => Some(Step::Key(variant.clone())),
            Segment::Unknown => None,
        })
        .collect()
}

/// The message without the place that `serde_json` adds.
fn bare(error: &serde_json::Error) -> String {
    let full = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    full.strip_suffix(&place).unwrap_or(&full).to_owned()
}

/// What is wrong with a text that is not JSON.
fn syntax(error: &serde_json::Error, text: &str) -> String {
    if error.is_eof() {
        return "the text ends in the middle: it was cut off, so get it whole".to_owned();
    }
    let message = bare(error);
    if message.starts_with("number out of range") {
        return "the number is too large: give a finite one".to_owned();
    }
    let line = text.lines().nth(error.line().saturating_sub(1));
    let before = error.column().saturating_sub(1);
    let rest = line.and_then(|line| line.get(before..)).unwrap_or("");
    let rest = rest.trim_start_matches('-');
    if ["NaN", "nan", "Inf", "inf"].iter().any(|word| rest.starts_with(word)) {
        return "NaN and infinity are no numbers of JSON: give a finite one".to_owned();
    }
    format!("is not JSON: {message} (column {})", error.column())
}

/// What is wrong with a value, in the words of the scene file, with the cure.
pub(crate) fn translate(error: &serde_json::Error) -> String {
    let message = bare(error);
    let quoted = |text: &str| text.split('`').nth(1).unwrap_or("").to_owned();
    if let Some(rest) = message.strip_prefix("unknown field ") {
        let (key, known) = rest.split_once(", expected ").unwrap_or((rest, ""));
        let names: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
        let key = quoted(key);
        if LATER.contains(&&*key) && names.contains(&"wobble") {
            return format!("`{key}` is not in this version: leave it out");
        }
        return match nearest(&key, &names) {
            Some(name) => format!("unknown key: did you mean `{name}`?"),
            None => format!("unknown key: the keys here are {}", list(&names).replace(" or ", " and ")),
        };
    }
    if let Some(rest) = message.strip_prefix("missing field ") {
        let key = quoted(rest);
        let value = if key == "wobble" { "\"wobble\": 1" } else { rest };
        return format!("the key `{key}` is missing: add {value}");
    }
    if let Some(key) = message.strip_prefix("duplicate field ") {
        return format!("the key {key} stands here twice: leave one out");
    }
    wording(&message)
}

/// Names of types in the words of JSON.
fn wording(message: &str) -> String {
    let Some((found, expected)) = message.split_once(", expected ") else {
        return message.to_owned();
    };
    let expected = match expected {
        "f64" => "a number",
        "u32" => "a whole number from 0 to 4294967295",
        "u64" => "a whole number, 0 or more",
        "a string" | "str" => "a string",
        "a boolean" => "true or false",
        "a sequence" => "a list",
        other => other,
    };
    let found = found.replace("invalid type: ", "is ");
    let found = found.replace("invalid value: ", "is ");
    let found = found.replace("invalid length ", "has length ");
    let found = found.replace("sequence", "a list").replace("map", "an object");
    format!("{found}: give {expected}")
}
