//! Files that were opened or saved, and the folders that were used last for either: kept from one start to the next.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::output;

/// Their file in the folder for what is kept between two starts.
const FILE: &str = "recent.json";
/// So many files are listed at most.
const MOST: usize = 10;

/// What was done with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Used {
    /// It was read.
    Opened,
    /// It was written.
    Saved,
}

/// All of it. A file that cannot be read is as none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Recent {
    /// The folder that something was read from last, and the one that was written to.
    folder: Option<PathBuf>,
    saved: Option<PathBuf>,
    /// What was opened or saved, the newest first.
    files: Vec<PathBuf>,
}

impl Recent {
    /// What is kept in a folder.
    pub(super) fn load(kept: &Path) -> Self {
        let text = std::fs::read_to_string(kept.join(FILE)).unwrap_or_default();
        let mut found: Recent = serde_json::from_str(&text).unwrap_or_default();
        found.files.truncate(MOST);
        found
    }

    /// A file was opened or saved: it is the newest.
    pub(super) fn note(&mut self, file: &Path, used: Used) {
        // Of a name that is no text nothing can be kept.
        let Some(file) = std::path::absolute(file).ok().filter(|file| file.to_str().is_some()) else { return };
        let folder = file.parent().map(Path::to_owned);
        match used {
            Used::Opened => self.folder = folder,
            Used::Saved => self.saved = folder,
        }
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MOST);
    }

    /// Keeps it in a folder, which is made if it is not there, with what other windows kept there meanwhile.
    ///
    /// Errors: in words, what cannot be written; what was kept before stays then.
    pub(super) fn save(&mut self, kept: &Path) -> Result<(), String> {
        for other in Recent::load(kept).files {
            if !self.files.contains(&other) {
                self.files.push(other);
            }
        }
        self.files.truncate(MOST);
        std::fs::create_dir_all(kept).map_err(|error| format!("{}: {error}", kept.display()))?;
        let text = serde_json::to_string(self).map_err(|error| error.to_string())?;
        output::replace(&kept.join(FILE), |file| file.write_all(text.as_bytes())).map_err(|error| error.to_string())
    }

    /// The newest first, whether they are still there or not.
    pub(super) fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// The folder that something was opened from last, else the one that was saved to, where it is still there.
    pub(super) fn opened(&self) -> Option<&Path> {
        self.folder.as_deref().or(self.saved.as_deref()).filter(|folder| folder.is_dir())
    }

    /// The folder that was saved to last, where it is still there.
    pub(super) fn saved(&self) -> Option<&Path> {
        self.saved.as_deref().filter(|folder| folder.is_dir())
    }

    /// The newest file of the folder that something was opened from last, where it is still there.
    pub(super) fn newest(&self) -> Option<&Path> {
        let folder = self.opened()?;
        let mut files = self.files.iter().map(PathBuf::as_path);
        files.find(|file| file.parent() == Some(folder)).filter(|file| file.is_file())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn with(files: &[PathBuf]) -> Recent {
        let mut recent = Recent::default();
        files.iter().for_each(|file| recent.note(file, Used::Opened));
        recent
    }

    #[test]
    fn the_newest_is_first_each_is_listed_once_and_ten_at_most() {
        let folder = tempfile::tempdir().unwrap();
        let file = |k: usize| folder.path().join(format!("{k}.json"));
        let mut recent = with(&(0..12).map(file).collect::<Vec<_>>());
        assert_eq!(recent.files(), (2..12).rev().map(file).collect::<Vec<_>>());
        recent.note(&file(5), Used::Opened);
        assert_eq!((recent.files().len(), &recent.files()[0]), (10, &file(5)));
        assert_eq!(recent.files().iter().filter(|other| **other == file(5)).count(), 1);
        assert_eq!(recent.newest(), None, "it was never written");
        std::fs::write(file(5), "{}").unwrap();
        assert_eq!(recent.newest(), Some(&*file(5)));
        assert_eq!(recent.opened(), Some(folder.path()));
        let gone = with(&[folder.path().join("gone/x.json")]);
        assert_eq!(gone.opened(), None, "a folder that is not there is not begun in");
    }

    #[test]
    fn what_is_saved_goes_by_the_last_that_was_saved_and_what_is_opened_by_the_last_that_was_opened() {
        let folder = tempfile::tempdir().unwrap();
        let [pictures, scenes] = ["pictures", "scenes"].map(|name| folder.path().join(name));
        [&pictures, &scenes].into_iter().for_each(|folder| std::fs::create_dir(folder).unwrap());
        let (picture, scene) = (pictures.join("a.png"), scenes.join("b.json"));
        [&picture, &scene].into_iter().for_each(|file| std::fs::write(file, "{}").unwrap());
        let mut recent = with(std::slice::from_ref(&picture));
        assert_eq!((recent.opened(), recent.saved()), (Some(&*pictures), None));
        recent.note(&scene, Used::Saved);
        assert_eq!((recent.opened(), recent.saved()), (Some(&*pictures), Some(&*scenes)));
        assert_eq!((recent.files(), recent.newest()), (&[scene.clone(), picture.clone()][..], Some(&*picture)));
        let mut first = Recent::default();
        first.note(&scene, Used::Saved);
        assert_eq!((first.opened(), first.newest()), (Some(&*scenes), Some(&*scene)), "nothing was opened yet");
    }

    #[test]
    fn what_is_kept_is_there_at_the_next_start_with_what_another_window_kept() {
        let folder = tempfile::tempdir().unwrap();
        let kept = folder.path().join("not there yet");
        assert_eq!(Recent::load(&kept), Recent::default());
        let [a, b, c] = ["a.json", "b.png", "c.json"].map(|name| folder.path().join(name));
        let (mut one, mut other) = (with(std::slice::from_ref(&a)), with(std::slice::from_ref(&b)));
        one.save(&kept).unwrap();
        other.save(&kept).unwrap();
        one.note(&c, Used::Opened);
        one.save(&kept).unwrap();
        let next = Recent::load(&kept);
        assert_eq!(next.files(), [c, a, b]);
        assert_eq!(next.opened(), Some(folder.path()));
        std::fs::write(kept.join(FILE), "[1, 2").unwrap();
        assert_eq!(Recent::load(&kept), Recent::default(), "what is broken is as none");
    }

    #[test]
    fn what_cannot_be_written_takes_nothing_of_what_was_kept() {
        let folder = tempfile::tempdir().unwrap();
        let kept = folder.path().join("kept");
        let mut first = with(&[folder.path().join("a.json")]);
        first.save(&kept).unwrap();
        let before = std::fs::read(kept.join(FILE)).unwrap();
        // A file stands where the folder is to be.
        let no_folder = kept.join(FILE);
        let mut next = with(&[folder.path().join("b.json")]);
        assert!(next.save(&no_folder).is_err());
        assert_eq!(next.files().len(), 1, "and the list of this window stays");
        assert_eq!(std::fs::read(kept.join(FILE)).unwrap(), before);
    }
}
