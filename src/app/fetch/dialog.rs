//! The system's dialog for opening a file.

use std::path::Path;
use std::time::{Duration, Instant};

use rfd::AsyncFileDialog;
use winit::window::Window;

use super::{Fetch, Found};

/// Endings of scenes and pictures. What a file is, its content says.
pub(in crate::app) const ENDINGS: [&str; 18] = [
    "json", "jsonl", "png", "jpg", "jpeg", "gif", "bmp", "webp", "tif", "tiff", "pnm", "pbm", "pgm", "ppm", "pam",
    "tga", "ico", "qoi",
];

/// Nobody closes a dialog sooner `[s]`: one that ends within this time was never shown.
pub(in crate::app) const LEAST_SHOWN: Duration = Duration::from_millis(1000);

/// Opens the dialog over `window`, in a folder and with the newest file, where that lies in it. One that is closed without a choice finds nothing.
///
/// Errors: no program that could show it.
pub(in crate::app) fn open(
    window: &Window,
    (begins, newest): (&Path, Option<&Path>),
    wake: impl Fn() + Send + 'static,
) -> Fetch {
    let upper = ENDINGS.map(str::to_uppercase);
    let endings: Vec<&str> = ENDINGS.into_iter().chain(upper.iter().map(String::as_str)).collect();
    let mut dialog = AsyncFileDialog::new().set_title("Open a scene, a recording or a picture").set_parent(window);
    dialog = dialog.set_directory(begins);
    if let Some(name) = newest.filter(|newest| newest.parent() == Some(begins)).and_then(Path::file_name) {
        dialog = dialog.set_file_name(name.to_string_lossy());
    }
    let chosen = dialog.add_filter("Scenes and pictures", &endings).add_filter("All files", &["*"]).pick_file();
    let start = Instant::now();
    Fetch::new(wake, move || match pollster::block_on(chosen) {
        Some(file) => Ok(Found::File(file.path().to_owned())),
        None if start.elapsed() < LEAST_SHOWN => {
            Err("no dialog for files can be shown here: neither a desktop portal nor zenity answers".to_owned())
        }
        None => Ok(Found::Nothing),
    })
}
