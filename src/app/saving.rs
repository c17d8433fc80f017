//! Where something is saved: the system's dialog for a file that is to be written, and names for files that nobody named.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use rfd::AsyncFileDialog;
use winit::window::Window;

/// Nobody closes a dialog sooner: one that ends within this time was never shown.
const LEAST_SHOWN: Duration = Duration::from_millis(250);

/// A name that is being chosen.
pub(super) struct Saving {
    chosen: Receiver<Option<PathBuf>>,
}

impl Saving {
    /// Opens the dialog over `window` for a recording of a scene. Where none can be shown, the file gets a name that is free.
    pub(super) fn new(window: &Window, scene: &str, wake: impl Fn() + Send + 'static) -> Self {
        let name = format!("{}.json", plain(scene));
        let dialog = AsyncFileDialog::new().set_title("Save all that was done").set_parent(window);
        let chosen = dialog.set_file_name(name).add_filter("Recordings", &["json"]).save_file();
        let (sender, receiver) = channel();
        let (start, scene) = (Instant::now(), scene.to_owned());
        std::thread::spawn(move || {
            let path = match pollster::block_on(chosen) {
                Some(file) => Some(file.path().to_owned()),
                None if start.elapsed() < LEAST_SHOWN => Some(free_name(Path::new("."), &scene, "json")),
                None => None,
            };
            // A window that has been closed saves nothing more.
            let _ = sender.send(path);
            wake();
        });
        Saving { chosen: receiver }
    }

    /// The name, once it is chosen; the inner `None` where nothing is to be saved.
    pub(super) fn take(&self) -> Option<Option<PathBuf>> {
        match self.chosen.try_recv() {
            Ok(path) => Some(path),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(None),
        }
    }
}

/// A name in `folder` that no file has: the scene's with a number.
pub(super) fn free_name(folder: &Path, scene: &str, ending: &str) -> PathBuf {
    let named = |number: u32| folder.join(format!("wobble-{}-{number:03}.{ending}", plain(scene)));
    (1..1000).map(named).find(|path| !path.exists()).unwrap_or_else(|| named(1000))
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
    fn names_are_free_and_plain() {
        let folder = tempfile::tempdir().unwrap();
        let first = free_name(folder.path(), "a/b c", "png");
        assert_eq!(first.file_name().unwrap(), "wobble-a-b-c-001.png");
        std::fs::write(&first, b"").unwrap();
        assert_eq!(free_name(folder.path(), "a/b c", "png").file_name().unwrap(), "wobble-a-b-c-002.png");
        assert_eq!(plain(""), "scene");
    }
}
