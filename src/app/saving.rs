//! Where something is saved: the system's dialog for a file that is to be written, and names for files that nobody named.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Instant;

use rfd::AsyncFileDialog;
use winit::window::Window;

use super::fetch::LEAST_SHOWN;

/// What became of a dialog.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Chosen {
    /// The name.
    File(PathBuf),
    /// The user thought better of it.
    Nothing,
    /// No dialog can be shown here: neither a desktop portal nor zenity answers.
    NoDialog,
}

/// What files are called that a dialog lists, and what they end in.
pub(super) type Kind = (&'static str, &'static [&'static str]);

/// A name that is being chosen.
pub(super) struct Saving {
    chosen: Receiver<Chosen>,
}

impl Saving {
    /// Opens the dialog over `window` with the path of a file, among others of its kind: what these are called, and what they end in.
    pub(super) fn new(
        window: &Window,
        (path, (kind, endings)): (&Path, Kind),
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let dialog = AsyncFileDialog::new().set_title("Save").set_parent(window);
        let dialog = path.parent().iter().fold(dialog, |dialog, begins| dialog.set_directory(begins));
        let chosen = dialog.set_file_name(name).add_filter(kind, endings).save_file();
        let (sender, receiver) = channel();
        let start = Instant::now();
        std::thread::spawn(move || {
            let chosen = match pollster::block_on(chosen) {
                Some(file) => Chosen::File(file.path().to_owned()),
                None if start.elapsed() < LEAST_SHOWN => Chosen::NoDialog,
                None => Chosen::Nothing,
            };
            // A window that has been closed saves nothing more.
            let _ = sender.send(chosen);
            wake();
        });
        Saving { chosen: receiver }
    }

    /// What became of it, once it is closed.
    pub(super) fn take(&self) -> Option<Chosen> {
        match self.chosen.try_recv() {
            Ok(chosen) => Some(chosen),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Chosen::Nothing),
        }
    }
}

/// Where files go that nobody named a place for: to the folder that was used last, for what is done, else to the user's documents, else home,
/// else to where the program was started.
pub(super) fn folder(used: Option<&Path>) -> PathBuf {
    let used = used.map(Path::to_owned);
    let home = etcetera::home_dir().ok();
    let documents = home.as_deref().map(|home| {
        let named = std::env::var_os("XDG_CONFIG_HOME").map_or_else(|| home.join(".config"), PathBuf::from);
        documents(home, std::fs::read_to_string(named.join("user-dirs.dirs")).ok().as_deref())
    });
    let all = [used, documents, home, std::env::current_dir().ok()];
    all.into_iter().flatten().find(|folder| folder.is_dir()).unwrap_or_default()
}

/// The folder of documents of a user at home there: as the desktop's list of folders names it, if there is one.
fn documents(home: &Path, list: Option<&str>) -> PathBuf {
    let named = list.and_then(|list| list.lines().find_map(|line| line.trim().strip_prefix("XDG_DOCUMENTS_DIR=")));
    let path = named.map(|path| path.trim_matches('"'));
    match path.map(|path| (path, path.strip_prefix("$HOME"))) {
        Some((_, Some(below))) => home.join(below.trim_start_matches('/')),
        Some((path, None)) if Path::new(path).is_absolute() => path.into(),
        _ => home.join("Documents"),
    }
}

/// What files of a scene are named after: what it is called since it was saved, the file that it lies in, else its own name.
pub(super) fn named_after(called: Option<&str>, file: Option<&Path>, scene: &str) -> String {
    let stem = file.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    called.map(str::to_owned).or(stem).unwrap_or_else(|| scene.to_owned())
}

/// A name in `folder` that no file has: the scene's with a number.
pub(super) fn free_name(folder: &Path, scene: &str, ending: &str) -> PathBuf {
    let named = |number: u32| folder.join(format!("wobble-{}-{number:03}.{ending}", plain(scene)));
    (1..1000).map(named).find(|path| !path.exists()).unwrap_or_else(|| named(1000))
}

/// The file that a scene lies in, with this ending: there it is saved again, if its folder is still there.
pub(super) fn saved_again(file: Option<&Path>, ending: &str) -> Option<PathBuf> {
    let file = file.filter(|file| file.parent().is_some_and(Path::is_dir))?;
    Some(file.with_extension(ending))
}

/// The scene's name with an ending.
pub(super) fn plain_name(scene: &str, ending: &str) -> String {
    format!("{}.{ending}", plain(scene))
}

/// A name that any file system takes.
fn plain(name: &str) -> String {
    let letters = name.chars().map(|letter| if letter.is_alphanumeric() || letter == '-' { letter } else { '-' });
    let name: String = letters.take(40).collect();
    if name.is_empty() { "scene".to_owned() } else { name }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn files_go_to_the_folder_that_was_used_last_or_to_the_documents_that_the_desktop_names() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(super::folder(Some(folder.path())), folder.path());
        let elsewhere = super::folder(Some(&folder.path().join("gone")));
        assert!(elsewhere.is_absolute() && elsewhere.is_dir(), "{elsewhere:?}");
        let home = Path::new("/home/ada");
        for (list, is) in [
            (None, "/home/ada/Documents"),
            (Some("# x\nXDG_DESKTOP_DIR=\"$HOME/Desk\"\nXDG_DOCUMENTS_DIR=\"$HOME/Papiere\"\n"), "/home/ada/Papiere"),
            (Some("XDG_DOCUMENTS_DIR=\"/data/papers\""), "/data/papers"),
            (Some("XDG_DOCUMENTS_DIR=\"$HOME/\""), "/home/ada/"),
            (Some("XDG_DOCUMENTS_DIR=\"papers\""), "/home/ada/Documents"),
        ] {
            assert_eq!(documents(home, list), Path::new(is), "{list:?}");
        }
    }

    #[test]
    fn names_are_free_and_plain() {
        let folder = tempfile::tempdir().unwrap();
        let first = free_name(folder.path(), "a/b c", "png");
        assert_eq!(first.file_name().unwrap(), "wobble-a-b-c-001.png");
        std::fs::write(&first, b"").unwrap();
        assert_eq!(free_name(folder.path(), "a/b c", "png").file_name().unwrap(), "wobble-a-b-c-002.png");
        assert_eq!(plain(""), "scene");
        assert_eq!(plain_name("a/b c", "json"), "a-b-c.json");
    }

    #[test]
    fn pictures_are_named_after_the_file_that_a_scene_was_saved_to_or_opened_from() {
        let file = Path::new("/data/my car.json");
        assert_eq!(named_after(None, None, "Untitled"), "Untitled");
        assert_eq!(named_after(None, Some(file), "Untitled"), "my car");
        assert_eq!(named_after(Some("ride"), Some(file), "Untitled"), "ride", "a recording lies in no scene file");
    }

    #[test]
    fn a_scene_is_saved_again_where_it_lies() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("wheel.json");
        assert_eq!(saved_again(Some(&file), "json"), Some(file.clone()), "whether it is there or not");
        assert_eq!(saved_again(Some(&file), "jsonl"), Some(folder.path().join("wheel.jsonl")), "a recording beside it");
        assert_eq!(saved_again(Some(&folder.path().join("gone/wheel.json")), "json"), None);
        assert_eq!(saved_again(None, "json"), None, "a scene of the gallery lies in no file");
    }
}
