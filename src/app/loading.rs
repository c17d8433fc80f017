//! A picture on its way in, read and meshed beside the window: how far it is, and a way to stop it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use crate::picture::{Picture, Stage, Watch};
use crate::scene::{Scene, SceneError};

/// Most points of a picture that opens as a scene by itself: of more, one is asked first.
const MOST_POINTS: u64 = 20_000;
/// What takes less time than this is not worth a word.
const PATIENCE: Duration = Duration::from_millis(300);
/// Time between two looks at how far it is.
const LOOK: Duration = Duration::from_millis(100);
/// Width of the panel `[points]`.
const WIDTH: f32 = 320.0;

/// What came of it.
pub(super) enum Loaded {
    /// The scene of the picture.
    Scene(Box<Scene>),
    /// The picture, to be cut out by hand; a spacing that would do `[px]`, and what was wrong with the usual way, if it was tried.
    Picture(Arc<Picture>, Option<f64>, Option<String>),
}

/// A picture that is being loaded.
pub(super) struct Loading {
    /// What it is called.
    pub(super) name: String,
    /// Its file.
    pub(super) path: PathBuf,
    watch: Watch,
    start: Instant,
    answer: Receiver<Result<Loaded, SceneError>>,
}

impl Loading {
    /// Begins to make a scene of a picture file; `wake` is called from another thread when it is there.
    pub(super) fn scene(path: &Path, wake: impl Fn() + Send + 'static) -> Self {
        Loading::new(path, wake, |path, watch| {
            match Scene::open_picture(path, watch) {
                Ok(scene) => Ok(Loaded::Scene(Box::new(scene))),
                Err(error) if watch.is_stopped() => Err(error),
                // It is shown to be cut out by hand, unless it cannot even be read.
                Err(error) => {
                    Ok(Loaded::Picture(Scene::picture_file(path)?, watch.would_do(), Some(error.to_string())))
                }
            }
        })
    }

    /// Begins to read a picture file that is to be imported.
    pub(super) fn picture(path: &Path, wake: impl Fn() + Send + 'static) -> Self {
        Loading::new(path, wake, |path, _| Ok(Loaded::Picture(Scene::picture_file(path)?, None, None)))
    }

    fn new(
        path: &Path,
        wake: impl Fn() + Send + 'static,
        load: impl FnOnce(&Path, &Watch) -> Result<Loaded, SceneError> + Send + 'static,
    ) -> Self {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let (watch, file) = (Watch::default().with_most_points(MOST_POINTS), path.to_owned());
        let (answers, answer) = channel();
        let seen = watch.clone();
        std::thread::spawn(move || {
            // One that was stopped wants no answer.
            let _ = answers.send(load(&file, &seen));
            wake();
        });
        Loading { name, path: path.to_owned(), watch, start: Instant::now(), answer }
    }

    /// What came of it; `None` while it is under way, or where it came to nothing.
    pub(super) fn take(&self) -> Option<Result<Loaded, SceneError>> {
        self.answer.try_recv().ok()
    }

    /// Says how far it is. Returns whether it is to be stopped.
    pub(super) fn show(&self, context: &egui::Context) -> bool {
        context.request_repaint_after(LOOK);
        if self.start.elapsed() < PATIENCE {
            return false;
        }
        let mut is_stopped = false;
        egui::Window::new(format!("Opening {}", self.name))
            .id(egui::Id::unique("loading"))
            .collapsible(false)
            .resizable(false)
            .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
            .show(context, |ui| {
                ui.set_width(WIDTH.min(context.content_rect().width() - 40.0));
                ui.label(words(self.watch.stage(), self.start.elapsed()));
                ui.add(egui::ProgressBar::new(self.watch.stage().share()));
                is_stopped = ui.button("Stop").on_hover_text("Esc").clicked();
            });
        is_stopped
    }
}

impl Drop for Loading {
    fn drop(&mut self) {
        self.watch.stop();
    }
}

/// "making triangles, 3 s".
pub(super) fn words(stage: Stage, since: Duration) -> String {
    match since.as_secs() {
        0 => stage.words().to_owned(),
        seconds => format!("{}, {seconds} s", stage.words()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::picture::{Settings, encode};
    use crate::scene::BodyKeys;

    /// A file with a picture of dots, so close that they make too many points, as they are or at any spacing.
    fn dots(folder: &Path, side: u32, each: u32) -> PathBuf {
        let mut picture = Picture::filled(side, side, [255, 255, 255, 0]);
        for (i, pixel) in (0..).zip(picture.rgba.chunks_exact_mut(4)) {
            let [x, y] = [i % side, i / side].map(|at| f64::from(at % each) - 0.5 * f64::from(each));
            if x.hypot(y) < 0.35 * f64::from(each) {
                pixel.copy_from_slice(&[0, 0, 0, 255]);
            }
        }
        let path = folder.join(format!("dots-{each}.png"));
        std::fs::write(&path, encode(&picture).unwrap()).unwrap();
        path
    }

    fn wait(loading: &Loading) -> Result<Loaded, SceneError> {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(60) {
            if let Some(loaded) = loading.take() {
                return loaded;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("no answer");
    }

    #[test]
    fn a_picture_opens_as_a_scene_and_one_of_too_many_points_is_asked_about() {
        let folder = tempfile::tempdir().unwrap();
        let (wake, woken) = channel();
        let loading = Loading::scene(&dots(folder.path(), 200, 200), move || wake.send(()).unwrap_or_default());
        let Ok(Loaded::Scene(scene)) = wait(&loading) else { panic!("no scene") };
        assert_eq!((scene.name(), &*loading.name), ("dots-200", "dots-200"));
        assert!(woken.recv_timeout(Duration::from_secs(10)).is_ok());
        drop(loading);
        let world = scene.world(None).unwrap();
        let picture = Arc::new(Picture::filled(40, 40, [0, 0, 0, 255]));
        let keys = BodyKeys::cut(&Settings::default(), 1.0, &picture);
        let added = scene.body_to_add(&*world, (&picture, keys), [[-5.0, -5.0], [5.0, 5.0]], false);
        assert!(added.is_ok(), "whoever waited for the scene does not end what is added to it: {added:?}");

        let loading = Loading::scene(&dots(folder.path(), 1600, 8), || ());
        let Ok(Loaded::Picture(picture, _, Some(why))) = wait(&loading) else { panic!("no picture") };
        assert_eq!(picture.width, 1600);
        assert!(why.contains("points: 20000 are the most") || why.contains("grain"), "{why}");
    }

    #[test]
    fn what_is_no_picture_is_an_error_and_what_is_stopped_makes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.png");
        std::fs::write(&path, b"\x89PNG\r\n\x1a\nno").unwrap();
        assert!(wait(&Loading::picture(&path, || ())).is_err());
        let loading = Loading::scene(&dots(folder.path(), 400, 100), || ());
        loading.watch.stop();
        let loaded = wait(&loading);
        assert!(!matches!(loaded, Ok(Loaded::Scene(_))) || loading.watch.stage() == Stage::Bonds);
    }

    #[test]
    fn waiting_is_said_in_words() {
        assert_eq!(words(Stage::Triangles, Duration::from_millis(900)), "making triangles");
        assert_eq!(words(Stage::Outlines, Duration::from_secs(4)), "tracing outlines and strokes, 4 s");
    }
}
