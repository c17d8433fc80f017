//! The pictures that a scene names and the meshes made of them: read and made once, however often they are asked for.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::error::{Fault, Source};
use super::file::file_bytes;
use crate::picture::{self, Picture, PictureMesh, Settings};

/// Largest picture file that is read [bytes].
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
static OWN: [(&str, &[u8]); 7] = own!["brush", "gear", "jellyfish", "letter", "maze", "pebble", "ring"];

/// What was read and made. Copies of a scene share it.
#[derive(Clone, Default)]
pub(super) struct Pictures(Arc<Mutex<Kept>>);

#[derive(Default)]
struct Kept {
    pictures: Vec<(String, Arc<Picture>)>,
    meshes: Vec<(String, Settings, Arc<PictureMesh>)>,
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
        let is_it = |kept: &&(String, Settings, Arc<PictureMesh>)| kept.0 == name && kept.1 == *settings;
        if let Some((_, _, mesh)) = self.pictures.kept().meshes.iter().find(is_it) {
            return Ok(Arc::clone(mesh));
        }
        let made = picture::mesh_picture(&*self.picture(name)?, settings).map_err(|error| fault(&error))?;
        let mesh = Arc::new(made.mesh);
        self.pictures.kept().meshes.push((name.to_owned(), *settings, Arc::clone(&mesh)));
        Ok(mesh)
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
        let name = format!("drawing-{}.png", kept.pictures.len());
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

/// A picture as it stands in a scene file itself.
pub(super) fn inline(png: &[u8]) -> String {
    format!("{INLINE}{}", BASE64_STANDARD.encode(png))
}
