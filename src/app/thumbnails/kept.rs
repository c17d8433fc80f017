//! Thumbnails of an earlier start, as files in a folder: those of another build of the program may look otherwise, and go.

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use image::{ImageFormat, RgbaImage};

use crate::render::Palette;

/// In the folder: which build they are of.
const OF: &str = "of.txt";

/// Where thumbnails in the colours of a palette are kept.
pub(super) struct Kept {
    folder: Option<PathBuf>,
    palette: Palette,
    size: [u32; 2],
}

impl Kept {
    /// Those of a size `[px]` in a folder, which is emptied where another build left some. Without a folder, or where none can be made, none
    /// are kept.
    pub(super) fn in_folder(folder: Option<PathBuf>, palette: Palette, size: [u32; 2]) -> Self {
        let folder = folder.zip(build()).and_then(|(folder, build)| meet(&folder, &build).then_some(folder));
        Kept { folder, palette, size }
    }

    /// The thumbnail of a scene; `None`: it is not there, or not whole.
    pub(super) fn read(&self, scene: &str) -> Option<RgbaImage> {
        let picture = image::open(self.path(scene)?).ok()?.into_rgba8();
        (picture.dimensions() == self.size.into()).then_some(picture)
    }

    /// Keeps one. What cannot be written is drawn anew at the next start.
    pub(super) fn write(&self, scene: &str, picture: &RgbaImage) {
        let Some(path) = self.path(scene) else { return };
        let mut bytes = Cursor::new(Vec::new());
        if picture.write_to(&mut bytes, ImageFormat::Png).is_ok() {
            let _ = std::fs::write(path, bytes.into_inner());
        }
    }

    fn path(&self, scene: &str) -> Option<PathBuf> {
        let palette = match self.palette {
            Palette::Dark => "dark",
            Palette::Light => "light",
        };
        self.folder.as_ref().map(|folder| folder.join(format!("{scene}-{palette}.png")))
    }
}

/// Which build this is: its version, and when its file was written; `None`: nobody knows.
fn build() -> Option<String> {
    let written = std::fs::metadata(std::env::current_exe().ok()?).and_then(|about| about.modified()).ok()?;
    let since = written.duration_since(SystemTime::UNIX_EPOCH).unwrap_or(Duration::ZERO);
    Some(format!("{} {}", env!("CARGO_PKG_VERSION"), since.as_millis()))
}

/// Makes a folder, and takes away what is of another build. Returns whether it can be written to.
fn meet(folder: &Path, build: &str) -> bool {
    let of = folder.join(OF);
    if std::fs::read_to_string(&of).is_ok_and(|of| of == build) {
        return true;
    }
    let Ok(()) = std::fs::create_dir_all(folder) else { return false };
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let pictures = entries.filter_map(|entry| Some(entry.ok()?.path()));
    for picture in pictures.filter(|path| path.extension().is_some_and(|ending| ending == "png")) {
        let _ = std::fs::remove_file(picture);
    }
    std::fs::write(of, build).is_ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn what_was_kept_is_there_again_until_another_build_comes() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path().join("thumbnails");
        let kept = |palette| Kept::in_folder(Some(at.clone()), palette, [4, 3]);
        let picture = RgbaImage::from_pixel(4, 3, image::Rgba([1, 2, 3, 255]));
        kept(Palette::Dark).write("rim", &picture);
        assert_eq!(kept(Palette::Dark).read("rim"), Some(picture));
        assert_eq!(kept(Palette::Light).read("rim"), None, "in other colours");
        assert_eq!(Kept::in_folder(Some(at.clone()), Palette::Dark, [8, 6]).read("rim"), None, "of another size");
        std::fs::write(at.join(OF), "another").unwrap();
        assert_eq!(kept(Palette::Dark).read("rim"), None);
        std::fs::write(at.join("rim-dark.png"), b"not whole").unwrap();
        assert_eq!(kept(Palette::Dark).read("rim"), None);
        assert_eq!(Kept::in_folder(None, Palette::Dark, [4, 3]).read("rim"), None);
    }
}
