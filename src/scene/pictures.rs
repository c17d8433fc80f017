//! The pictures that a scene names and the meshes made of them: read and made once, however often they are asked for.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::error::{Fault, Source, Within};
use super::file::file_bytes;
use crate::picture::{self, Picture, PictureMesh, Settings};

/// Largest picture file that is read `[bytes]`.
pub(super) const LARGEST_FILE: u64 = 512 << 20;

/// What a picture begins with that stands in the scene itself.
const INLINE: &str = "data:image/png;base64,";

/// A picture of the gallery, by the path that its scenes have for it.
macro_rules! own {
    ($($name:literal),*) => {
        [$((concat!("pictures/", $name, ".png"), include_bytes!(concat!("../../assets/pictures/", $name, ".png")))),*]
    };
}

/// The gallery's pictures, which are there wherever the program runs.
static OWN: [(&str, &[u8]); 9] = own!["brush", "gear", "jelly", "jellyfish", "letter", "maze", "pebble", "rim", "ring"];

/// What was read and made. Copies of a scene share it.
#[derive(Clone, Default)]
pub(super) struct Pictures(Arc<Mutex<Kept>>);

#[derive(Default)]
struct Kept {
    pictures: Vec<(String, Arc<Picture>)>,
    meshes: Vec<Meshed>,
    traced: Vec<Traced>,
    inks: Vec<(String, Settings, Arc<Picture>)>,
}

/// Outlines and holes.
pub(super) type Loops = Vec<Vec<[f64; 2]>>;

/// The outlines of a picture's ink `[px]`.
struct Traced {
    name: String,
    settings: Settings,
    loops: Arc<Loops>,
}

/// The mesh of a picture, or of a part of it.
struct Meshed {
    name: String,
    settings: Settings,
    part: Option<u32>,
    mesh: Arc<PictureMesh>,
}

impl fmt::Debug for Pictures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Pictures")
    }
}

impl Pictures {
    /// What is kept is whole at any time: a thread that panicked did no harm.
    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// How the names of pictures begin that are in no file.
const KEPT: &str = "drawing-";

/// Whether a picture of that name is in no file.
pub(super) fn is_kept(name: &str) -> bool {
    name.strip_prefix(KEPT)
        .and_then(|rest| rest.strip_suffix(".png"))
        .is_some_and(|number| number.parse::<u32>().is_ok())
}

impl Source {
    /// A picture that the scene names: a path relative to its file, one of the gallery's, or the picture itself.
    ///
    /// Errors: no such file, no picture.
    pub(super) fn picture(&self, name: &str) -> Result<Arc<Picture>, Fault> {
        if let Some((_, picture)) = self.pictures.kept().pictures.iter().find(|(known, _)| known == name) {
            return Ok(Arc::clone(picture));
        }
        let picture = Arc::new(picture::decode(&self.bytes(name)?).map_err(|error| fault(&error))?);
        self.pictures.kept().pictures.push((name.to_owned(), Arc::clone(&picture)));
        Ok(picture)
    }

    /// The mesh of a picture that the scene names.
    ///
    /// Errors: those of [`Source::picture`]; settings out of their ranges; no ink.
    pub(super) fn mesh(&self, name: &str, settings: &Settings) -> Result<Arc<PictureMesh>, Fault> {
        if let Some(mesh) = self.kept_mesh(name, settings, None) {
            return Ok(mesh);
        }
        let made = picture::mesh_in_stages(&*self.picture(name)?, settings, &self.watch, |_| {})
            .map_err(|error| fault(&error))?;
        Ok(self.keep_mesh(name, settings, None, made.mesh))
    }

    /// The outlines of the ink of a picture that the scene names `[px]`.
    ///
    /// Errors: those of [`Source::mesh`].
    pub(super) fn traced(&self, name: &str, settings: &Settings) -> Result<Arc<Loops>, Fault> {
        let is_it = |kept: &&Traced| kept.settings == *settings && kept.name == name;
        if let Some(traced) = self.pictures.kept().traced.iter().find(is_it) {
            return Ok(Arc::clone(&traced.loops));
        }
        let loops = picture::trace_picture(&*self.picture(name)?, settings).map_err(|error| fault(&error))?;
        let loops = Arc::new(loops);
        let traced = Traced { name: name.to_owned(), settings: *settings, loops: Arc::clone(&loops) };
        self.pictures.kept().traced.push(traced);
        Ok(loops)
    }

    /// The mesh of one of the connected parts of such a picture, counted from the largest.
    ///
    /// Errors: those of [`Source::mesh`]; there are not so many.
    pub(super) fn part(&self, name: &str, settings: &Settings, part: u32) -> Result<Arc<PictureMesh>, Fault> {
        if let Some(mesh) = self.kept_mesh(name, settings, Some(part)) {
            return Ok(mesh);
        }
        let whole = self.mesh(name, settings).at("file")?;
        match whole.parts().get(part as usize) {
            Some(&(number, _)) => Ok(self.keep_mesh(name, settings, Some(part), whole.part(number))),
            None => {
                let parts = match whole.components {
                    1 => "one part: give 0, or leave it out".to_owned(),
                    count => format!("{count} parts: give a number from 0, the largest, to {}", count - 1),
                };
                Err(Fault::invalid(format!("is {part}, and the picture has {parts}")).at("part"))
            }
        }
    }

    fn kept_mesh(&self, name: &str, settings: &Settings, part: Option<u32>) -> Option<Arc<PictureMesh>> {
        let kept = self.pictures.kept();
        let is_it = |kept: &&Meshed| kept.part == part && kept.settings == *settings && kept.name == name;
        kept.meshes.iter().find(is_it).map(|kept| Arc::clone(&kept.mesh))
    }

    fn keep_mesh(&self, name: &str, settings: &Settings, part: Option<u32>, mesh: PictureMesh) -> Arc<PictureMesh> {
        let mesh = Arc::new(mesh);
        let meshed = Meshed { name: name.to_owned(), settings: *settings, part, mesh: Arc::clone(&mesh) };
        self.pictures.kept().meshes.push(meshed);
        mesh
    }

    /// A picture that the scene names, without the paper that its ink stands on if it has any.
    ///
    /// Errors: those of [`Source::picture`].
    pub(super) fn ink(&self, name: &str, settings: &Settings) -> Result<Arc<Picture>, Fault> {
        if let Some((.., ink)) = self.pictures.kept().inks.iter().find(|kept| kept.0 == name && kept.1 == *settings) {
            return Ok(Arc::clone(ink));
        }
        let picture = self.picture(name)?;
        let ink = picture::without_paper(&picture, settings).map_or(picture, Arc::new);
        self.pictures.kept().inks.push((name.to_owned(), *settings, Arc::clone(&ink)));
        Ok(ink)
    }

    /// A picture that the scene names, as a PNG: the file itself where it is one.
    ///
    /// Errors: those of [`Source::picture`].
    pub(super) fn png(&self, name: &str) -> Result<Vec<u8>, Fault> {
        match self.bytes(name) {
            Ok(bytes) if bytes.starts_with(b"\x89PNG\r\n\x1a\n") => Ok(bytes),
            _ => picture::encode(&*self.picture(name)?).map_err(|error| fault(&error)),
        }
    }

    /// Keeps a picture that is in no file, by a name that nothing else has.
    pub(super) fn keep(&self, picture: Arc<Picture>) -> String {
        let mut kept = self.pictures.kept();
        let name = format!("{KEPT}{}.png", kept.pictures.len());
        kept.pictures.push((name.clone(), picture));
        name
    }

    /// Keeps a picture that was read, by the name that the scene has for it.
    pub(super) fn keep_as(&self, name: &str, picture: Arc<Picture>) {
        self.pictures.kept().pictures.push((name.to_owned(), picture));
    }

    fn bytes(&self, name: &str) -> Result<Vec<u8>, Fault> {
        if let Some(text) = name.strip_prefix(INLINE) {
            return BASE64_STANDARD.decode(text.trim()).map_err(|error| {
                Fault::invalid(format!("is no picture: its base64 is damaged ({error}): write it anew"))
            });
        }
        let path = self.folder().join(name);
        match file_bytes(&path, LARGEST_FILE) {
            Ok(bytes) => Ok(bytes),
            Err(reason) => match OWN.iter().find(|(own, _)| *own == name && !path.exists()) {
                Some((_, bytes)) => Ok(bytes.to_vec()),
                None => Err(Fault::invalid(format!(
                    "`{}` {reason}: give a path relative to the scene file",
                    path.display()
                ))),
            },
        }
    }

    /// The folder that paths in the scene are relative to.
    fn folder(&self) -> PathBuf {
        Path::new(&self.label).parent().unwrap_or(Path::new("")).to_owned()
    }
}

/// A picture that cannot be taken, at the key that names it.
fn fault(error: &picture::PictureError) -> Fault {
    Fault::invalid(error.to_string())
}

/// The same of a picture that is in no file.
///
/// Errors: more memory than there is.
pub(super) fn inline_picture(picture: &Picture) -> Result<String, Fault> {
    Ok(inline(&picture::encode(picture).map_err(|error| fault(&error))?))
}

/// The same, in the words of an error.
///
/// Errors: more memory than there is.
pub(crate) fn picture_as_text(picture: &Picture) -> Result<String, String> {
    picture::encode(picture).map(|png| inline(&png)).map_err(|error| error.to_string())
}

/// Whether what names a picture is the picture itself.
pub(super) fn is_inline(name: &str) -> bool {
    name.starts_with(INLINE)
}

/// A picture as it stands in a scene file itself.
pub(super) fn inline(png: &[u8]) -> String {
    format!("{INLINE}{}", BASE64_STANDARD.encode(png))
}
