//! What comes into a session from outside: files that are dropped, chosen or pasted, pictures on their way into the world.

use std::path::Path;
use std::sync::Arc;

use super::super::fetch::{self, Fetch, Found};
use super::super::import::{Answer, Import};
use super::super::loading::{Loaded, Loading};
use super::{BRUSH, Session};
use crate::scene::{Scene, SceneError};

/// What a picture is called that was pasted.
const PASTED: &str = "pasted picture";

impl Session {
    /// Whether the scene is one to paint on.
    pub(super) fn is_canvas(&self) -> bool {
        self.scene.tags.iter().any(|tag| tag == BRUSH)
    }

    /// A file was dropped on the window, chosen or pasted: a picture is imported, a scene opens in place of this one.
    pub(in crate::app) fn take_file(&mut self, path: &Path) {
        if Scene::is_picture_file(path) {
            self.loading = Some(Loading::picture(path, self.wake_up()));
            return self.touch();
        }
        let taken = Scene::read(path).and_then(|scene| self.open(scene));
        self.complain(taken);
    }

    /// Opens a canvas to paint a body on: with the drawing that was put away, if there is one; else over the scene's picture, if
    /// it is one of the brush.
    pub(super) fn paint(&mut self) {
        if self.import.as_ref().is_some_and(Import::is_canvas) {
            return;
        }
        let opened = match self.kept.take() {
            Some(kept) => Ok(kept),
            None if self.is_canvas() && self.has_picture => Import::of_canvas_over(&self.scene, self.wake_up()),
            None => Import::of_canvas(self.wake_up()).map_err(|error| self.scene.complaint(&error.to_string())),
        };
        let opened = opened.map(|import| self.begin(import));
        self.complain(opened);
    }

    /// Opens an import; a drawing that lay there is put away.
    fn begin(&mut self, import: Import) {
        self.put_away();
        self.import = Some(import);
    }

    /// Closes the import, if one is open, and returns whether one was. A drawing is kept: the next canvas has it, with all its steps.
    pub(super) fn put_away(&mut self) -> bool {
        let Some(mut import) = self.import.take() else { return false };
        if import.has_work() {
            import.put_away();
            self.kept = Some(import);
        }
        true
    }

    /// Cuts the scene's first picture out anew.
    pub(super) fn cut_anew(&mut self) {
        match Import::of_scene(&self.scene, self.wake_up()) {
            Ok(Some(import)) => self.begin(import),
            Ok(None) => self.say(
                "no body of this scene is cut out of a picture: drop a picture on the window, open one (Ctrl+O), paste \
                 one (Ctrl+V) or draw one (N)",
            ),
            Err(error) => self.complain(Err(error)),
        }
    }

    /// Opens the system's dialog for a file, unless it is open.
    pub(super) fn choose_file(&mut self) {
        self.wake();
        match self.dialog {
            Some(_) => self.say("the dialog for files is open already"),
            None => self.dialog = Some(fetch::open(&self.window, self.wake_up())),
        }
    }

    /// Takes what lies on the clipboard.
    pub(super) fn paste(&mut self) {
        self.wake();
        if self.pasted.is_none() {
            self.pasted = Some(fetch::paste(self.wake_up()));
        }
    }

    /// What other threads call when they have something to show.
    pub(super) fn wake_up(&self) -> impl Fn() + Send + 'static {
        let waker = self.waker.clone();
        // A window that has been closed is woken no more.
        move || waker.send_event(()).unwrap_or_default()
    }

    /// Something was made or found elsewhere.
    pub(in crate::app) fn wake(&mut self) {
        if self.import.as_mut().is_some_and(Import::poll) {
            self.touch();
        }
        if let Some((name, loaded)) =
            self.loading.as_ref().and_then(|loading| Some((loading.name.clone(), loading.take()?)))
        {
            self.loading = None;
            self.take_loaded(name, loaded);
        }
        let fetched = [&mut self.dialog, &mut self.pasted].map(|fetch| {
            let found = fetch.as_ref().and_then(Fetch::take);
            fetch.take_if(|_| found.is_some());
            found
        });
        for found in fetched.into_iter().flatten() {
            match found {
                Ok(Found::File(path)) => self.take_file(&path),
                Ok(Found::Picture(picture)) => {
                    let import = Import::of_picture(PASTED.to_owned(), Arc::new(picture), self.wake_up());
                    self.begin(import);
                    self.complain(Ok(()));
                }
                Ok(Found::Nothing) => {}
                Err(why) => self.say(&why),
            }
        }
    }

    /// A picture was read: it opens as a scene, or to be cut out by hand.
    fn take_loaded(&mut self, name: String, loaded: Result<Loaded, SceneError>) {
        let mut why = None;
        let opened = loaded.and_then(|loaded| match loaded {
            Loaded::Scene(scene) => self.open(*scene),
            Loaded::Picture(picture, spacing, reason) => {
                why = reason;
                let import = Import::of_picture(name, picture, self.wake_up());
                self.begin(if let Some(spacing) = spacing { import.spaced(spacing) } else { import });
                Ok(())
            }
        });
        self.complain(opened);
        if let Some(why) = why {
            self.say(&why);
        }
    }

    /// Does what the import panel was told.
    pub(super) fn answer(&mut self, answer: Answer) {
        if answer == Answer::Cancel {
            self.put_away();
            return self.touch();
        }
        let Some(import) = self.import.take() else { return };
        let scene = match answer {
            Answer::Cancel => return,
            Answer::Open => import.scene(),
            Answer::Add => self.with_import(&import),
            Answer::Replace => import.put_into(&self.scene),
        };
        let (camera, points) = (self.camera, self.player.world().point_count());
        let polygons = self.player.world().polygons().len();
        let opened = scene.and_then(|scene| self.open(scene));
        match (&opened, answer) {
            (Err(_), _) => self.import = Some(import),
            // What one looked at is still there.
            (Ok(()), Answer::Add) => self.look_again(camera, [points, polygons]),
            (Ok(()), Answer::Replace) => self.look_again(camera, [usize::MAX; 2]),
            _ => {}
        }
        self.complain(opened);
    }

    /// The scene with what an import adds, at its start.
    fn with_import(&self, import: &Import) -> Result<Scene, SceneError> {
        let start = self.scene.world(None)?;
        self.scene.with(import.addition(&self.scene, &*start, self.seen())?)
    }

    /// Tells the user of what went wrong, if anything did.
    fn complain(&mut self, done: Result<(), SceneError>) {
        let warned = self.complaint.take().filter(|complaint| self.player.world().warnings().contains(complaint));
        self.complaint = done.err().map(|error| error.to_string()).or(warned);
        self.touch();
    }

    fn say(&mut self, line: &str) {
        self.complaint = Some(line.to_owned());
        self.touch();
    }
}
