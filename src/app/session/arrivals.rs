//! What comes into a session from outside: files that are dropped, chosen or pasted, pictures on their way into the world.

use std::io::Read as _;
use std::path::Path;
use std::sync::Arc;

use super::super::fetch::{self, Fetch, Found};
use super::super::import::{Answer, Import};
use super::super::loading::{Loaded, Loading};
use super::{BRUSH, CutOff, Session, Thumbnails};
use crate::app::action::Action;
use crate::app::clip::Clip;
use crate::app::holds_scene;
use crate::app::opening;
use crate::app::panels::{OpenFrom, Sheet, meant};
use crate::app::player::Order;
use crate::app::recent::Used;
use crate::app::saving::folder;
use crate::app::walled;
use crate::history::Start;
use crate::scene::{Scene, SceneError};

/// What a picture is called that was pasted.
const PASTED: &str = "pasted picture";

/// What a file is that comes.
enum Coming {
    Picture,
    Scene(Box<Start>),
}

impl Session {
    /// Whether the scene is one to paint on.
    pub(super) fn is_canvas(&self) -> bool {
        self.scene.tags.iter().any(|tag| tag == BRUSH)
    }

    /// Whether a key goes through what lies over the world: those for other scenes do where a canvas has nothing on it that was painted.
    pub(in crate::app) fn lets_through(&self, action: Action) -> bool {
        let is_untouched = self.import.as_ref().is_some_and(|import| import.is_canvas() && !import.has_work());
        let is_of_scenes = matches!(action, Action::PreviousScene | Action::NextScene);
        let has_answer = self.asked.is_some() || self.import.is_some() && self.panels.sheet.is_none();
        let is_answer = has_answer && action == Action::Finish;
        action.reaches_through() || is_answer || is_untouched && self.panels.sheet.is_none() && is_of_scenes
    }

    /// A file was dropped on the window, chosen or pasted: a picture is imported, a scene opens in place of this one.
    pub(in crate::app) fn take_file(&mut self, path: &Path) {
        match self.read(path) {
            Ok(coming) => self.take_in(path, coming),
            Err(why) => {
                self.wearer = None;
                self.complain(&why);
            }
        }
    }

    /// What a file is, looked at before anything is done with it.
    ///
    /// Errors: in words, why it is neither a picture nor a scene.
    fn read(&self, path: &Path) -> Result<Coming, String> {
        let is_picture = Scene::is_picture_file(path);
        // A picture may hold the scene that it was taken of.
        if is_picture && (self.wearer.is_some() || !holds_scene(path)) {
            return Ok(Coming::Picture);
        }
        let start = Start::load(&path.to_string_lossy()).map_err(|error| refused(path, &error.to_string()))?;
        Ok(Coming::Scene(Box::new(start)))
    }

    /// Takes what a file is.
    fn take_in(&mut self, path: &Path, coming: Coming) {
        match (self.wearer.take(), coming) {
            (Some(points), Coming::Picture) => self.wear(path, points),
            (None, Coming::Picture) => {
                self.loading = Some(Loading::picture(path, self.wake_up()));
                self.touch();
            }
            (_, Coming::Scene(start)) => {
                self.open(*start);
                self.have_come_from(path);
            }
        }
    }

    /// No dialog can be shown: the path is written in the window, beginning as the dialog would.
    fn ask_for_path(&mut self) {
        let newest = self.recent.newest().map(|newest| newest.display().to_string());
        let folder = || self.recent.opened().map(|folder| format!("{}/", folder.display()));
        self.panels.path = newest.or_else(folder).unwrap_or_default();
        self.panels.open_from = OpenFrom::at(&self.panels.path);
        (self.panels.sheet, self.panels.is_fresh) = (Some(Sheet::OpenFrom), true);
        self.touch();
    }

    /// Opens a file by the path that was written; one that is not there is said so beside it.
    pub(super) fn open_file(&mut self, path: &str) {
        let meant = meant(path);
        let fault = match std::fs::metadata(&meant) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Some("there is no such file".to_owned()),
            Err(error) => Some(format!("it cannot be read: {error}")),
            Ok(about) if about.is_dir() => Some("that is a folder: go on with the name of a file in it".to_owned()),
            Ok(_) => None,
        };
        let coming = fault.map_or_else(|| self.read(&meant), Err);
        match coming {
            Ok(coming) => {
                self.close_sheet();
                self.take_in(&meant, coming);
            }
            // Where the name is asked for it can be mended.
            Err(why) => {
                (self.panels.open_from.fault, self.panels.is_fresh) = (Some(why), true);
                self.touch();
            }
        }
    }

    /// Opens an import; a drawing that lay there is put away.
    fn bring_in(&mut self, import: Import) {
        self.put_away();
        self.close_sheet();
        self.import = Some(import);
        self.touch();
    }

    /// Closes the import, if one is open. A drawing is kept: the next canvas has it, with all its steps.
    pub(super) fn put_away(&mut self) {
        let Some(mut import) = self.import.take() else { return };
        if import.has_work() {
            import.put_away();
            self.kept = Some(import);
        }
        self.touch();
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
        let opened = opened.map(|import| self.bring_in(import));
        self.complain_of(opened);
    }

    /// Cuts the scene's first picture out anew.
    pub(super) fn cut_anew(&mut self) {
        match Import::of_scene(&self.scene, self.wake_up()) {
            Ok(Some(import)) => self.bring_in(import),
            Ok(None) => self.complain(
                "no body of this scene is cut out of a picture: drop a picture on the window, open one (Ctrl+O), paste \
                 one (Ctrl+V) or draw one (N)",
            ),
            Err(error) => self.complain_of(Err(error)),
        }
    }

    /// Opens the system's dialog for a file. Who asks again before it answers has seen none: a path can be written then.
    pub(super) fn choose_file(&mut self) {
        self.wake();
        match self.dialog {
            Some(_) => self.ask_for_path(),
            None => {
                let begins = folder(self.recent.opened());
                self.dialog = Some(fetch::open(&self.window, (&begins, self.recent.newest()), self.wake_up()));
            }
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
        let loaded = self.loading.as_ref().and_then(Loading::take);
        if let Some((loading, loaded)) = self.loading.take_if(|_| loaded.is_some()).zip(loaded) {
            self.take_loaded((loading.name.clone(), &loading.path), loaded);
        }
        let fetched = [&mut self.dialog, &mut self.pasted].map(|fetch| {
            let found = fetch.as_ref().and_then(Fetch::take);
            fetch.take_if(|_| found.is_some());
            found
        });
        for (is_pasted, found) in [false, true].into_iter().zip(fetched) {
            let Some(found) = found else { continue };
            match found {
                Ok(Found::Bodies(fragment)) => self.paste_clip(Clip::of_fragment(*fragment)),
                Ok(Found::Copied) if self.paste_copied() => {}
                Ok(Found::Copied) => self.refuse_to_paste(
                    "what was copied is in another window of wobble, and too large for the clipboard: save it there",
                ),
                Ok(Found::File(path)) => {
                    // The dialog came after all.
                    self.panels.sheet.take_if(|sheet| *sheet == Sheet::OpenFrom);
                    self.take_file(&path);
                }
                Ok(Found::Picture(picture)) => {
                    let import = Import::of_picture(PASTED.to_owned(), Arc::new(picture), self.wake_up());
                    self.bring_in(import);
                }
                Ok(Found::Nothing) if is_pasted => {}
                // A path is being written in its place.
                Ok(Found::Nothing) | Err(_) if !is_pasted && self.panels.sheet == Some(Sheet::OpenFrom) => {}
                Ok(Found::Nothing) => {
                    self.wearer = None;
                    self.say("no file was chosen".to_owned());
                }
                Ok(Found::Broken(why)) => self.refuse_to_paste(&why),
                // Where the clipboard has nothing of use, there may still be what was copied here.
                Err(_) if is_pasted && self.paste_copied() => {}
                Err(_) if !is_pasted => self.ask_for_path(),
                Err(why) => self.refuse_to_paste(&why),
            }
        }
        let is_drawn =
            [self.thumbnails.as_mut().is_some_and(Thumbnails::poll), self.cut_off.as_mut().is_some_and(CutOff::poll)];
        self.panels_dirty |= is_drawn.contains(&true);
        self.hear_of_saving();
        self.hear_of_clip();
        self.hear_of_leftovers();
        let news = self.player.poll();
        self.hear(news);
    }

    /// Makes a scene of the picture that the program was opened with: it takes the place of what is there until then.
    pub(in crate::app) fn load(&mut self, path: &Path) {
        self.stands_in = true;
        self.loading = Some(Loading::scene(path, self.wake_up()));
        self.touch();
    }

    /// A picture was read: it opens as a scene, or to be cut out by hand.
    fn take_loaded(&mut self, (name, path): (String, &Path), loaded: Result<Loaded, SceneError>) {
        if loaded.is_ok() {
            self.remember(path, Used::Opened);
        }
        match loaded {
            Ok(Loaded::Scene(scene)) => self.open((*scene).into()),
            Ok(Loaded::Picture(picture, spacing, why)) => {
                let import = Import::of_picture(name, picture, self.wake_up());
                let why = why.map(|why| import.worded(why));
                self.bring_in(if let Some(spacing) = spacing { import.spaced(spacing) } else { import });
                if let Some(why) = why {
                    self.complain(&why);
                }
            }
            Err(error) => self.complain_of(Err(error)),
        }
    }

    /// Does what the import panel was told.
    pub(super) fn answer(&mut self, answer: Answer) {
        let Some(import) = &self.import else { return };
        let scene = match answer {
            Answer::Cancel => return self.put_away(),
            Answer::Add => {
                let seen = self.seen();
                let near = import.drawn_at().map_or(seen, |at| about(self.world_at(at), seen));
                let (adder, coming) = (import.adder(near), import.coming());
                return self.ask_if_full(coming, move |session| {
                    session.player.ask(Order::Add(Box::new(adder)));
                    session.adding = session.import.take();
                });
            }
            Answer::Open => import.scene(),
            Answer::Replace => import.put_into(&self.scene),
        };
        match scene {
            Ok(scene) => {
                self.import = None;
                // What one looked at is still there.
                let looks_again = (answer == Answer::Replace).then_some(self.camera);
                self.open(scene.into());
                self.looks_again = looks_again;
            }
            Err(error) => self.complain_of(Err(error)),
        }
    }

    /// What of the plane is in view: its lower and upper corner `[m]`.
    fn seen(&self) -> [[f64; 2]; 2] {
        let [width, height] = self.area.map(f64::from);
        [[0.0, height], [width, 0.0]].map(|pixel| self.camera.world_from_screen(pixel).truncate().to_array())
    }

    /// What is seen of the plane at a place of the panels `[points]`.
    fn world_at(&self, at: egui::Pos2) -> [f64; 2] {
        let pixel = self.in_first(self.pixel_of(at));
        self.camera.world_from_screen(pixel).truncate().to_array()
    }

    /// What nothing lies over of a pane of this size `[px]`: at each side as much is left out as what lies over the picture takes there.
    pub(super) fn free_of_pane(&self, pane: [u32; 2]) -> opening::Free {
        opening::free_of_pane(pane, (self.area, self.free))
    }

    /// The part of the plane that is seen beside panels: its lower and upper corner `[m]`, to a hundredth of its height.
    pub(super) fn free_of_plane(&self) -> [[f64; 2]; 2] {
        let [[left, top], [right, bottom]] = self.free;
        let corners = [[left, bottom], [right, top]].map(|pixel| self.camera.world_from_screen(pixel).truncate());
        let step = 10_f64.powf((corners[1].y - corners[0].y).abs().max(1e-9).log10().floor() - 1.0);
        corners.map(|corner| ((corner / step).round() * step).to_array())
    }

    /// Where walls stand that are put up `[m]`: in the plane around what is seen, in space around all that is there.
    pub(super) fn new_walls(&self) -> [[f64; 3]; 2] {
        if self.scene.dimensions() == 2 {
            return self.free_of_plane().map(|[x, y]| [x, y, 0.0]);
        }
        walled::about(self.shown(), (self.camera.focus().to_array(), self.camera.height()))
    }

    /// The middle of what is seen `[m]`: in the plane of its part beside panels, in space what the camera looks at, to a hundredth of its height.
    pub(super) fn middle_seen(&self) -> [f64; 3] {
        if self.scene.dimensions() == 2 {
            let [low, high] = self.free_of_plane();
            return [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.0];
        }
        let step = 10_f64.powf(self.camera.height().max(1e-9).log10().floor() - 1.0);
        ((self.camera.focus() / step).round() * step).to_array()
    }

    /// Tells the user of what went wrong, if anything did.
    pub(super) fn complain_of(&mut self, done: Result<(), SceneError>) {
        if let Err(error) = done {
            self.complain(&error.to_string());
        }
        self.touch();
    }
}

/// Why a file is not opened: what does not begin as scenes and recordings do is none, whatever its first letters are.
fn refused(path: &Path, why: &str) -> String {
    let mut first = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(FIRST).read_to_end(&mut first));
    let begins = first.trim_ascii_start().strip_prefix("\u{feff}".as_bytes()).unwrap_or(first.trim_ascii_start());
    match read.is_ok() && !begins.starts_with(b"{") {
        true => format!("this is no picture, scene or recording: {why}"),
        false => why.to_owned(),
    }
}

/// So much of a file is looked at for that `[bytes]`.
const FIRST: u64 = 256;

/// The largest part of a box that has its middle there; of a place outside the box nothing but that.
fn about(at: [f64; 2], [low, high]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let half = [0, 1].map(|axis| (at[axis] - low[axis]).min(high[axis] - at[axis]).max(0.0));
    [-1.0, 1.0].map(|side| [0, 1].map(|axis| at[axis] + side * half[axis]))
}

#[cfg(test)]
mod tests {
    use super::{about, refused};

    #[test]
    fn a_text_is_called_no_scene_and_a_scene_with_a_fault_is_told_of_that_alone() {
        let Ok(folder) = tempfile::tempdir() else { return };
        for (text, is_other) in
            [("hello", true), ("", true), (" \n[1]", true), (" {\"wobble\": 1,}", false), ("\u{feff}{", false)]
        {
            let path = folder.path().join("text.txt");
            assert!(std::fs::write(&path, text).is_ok());
            let words = if is_other { "this is no picture, scene or recording: why" } else { "why" };
            assert_eq!(refused(&path, "why"), words, "{text:?}");
        }
        assert_eq!(refused(&folder.path().join("none"), "why"), "why");
    }

    #[test]
    fn a_drawing_is_looked_for_room_about_its_place() {
        let seen = [[-4.0, -1.0], [4.0, 3.0]];
        assert_eq!(about([-3.0, 1.0], seen), [[-4.0, -1.0], [-2.0, 3.0]]);
        assert_eq!(about([5.0, 1.0], seen), [[5.0, -1.0], [5.0, 3.0]]);
    }
}
