//! What leaves a session: recordings and pictures, written to files.

use std::path::{Path, PathBuf};

use super::Session;
use super::trails::AllTrails;
use crate::app::opening::keys;
use crate::app::panels::{SaveTo, Saved, Sheet, Wish, ask_to_save};
use crate::app::player::Order;
use crate::app::recent::Used;
use crate::app::saving::{Chosen, Saving, folder, free_name, named_after, plain_name, saved_again};
use crate::render::{Capture, View};

impl Session {
    /// Asks what is to be saved and where, unless it is recorded to a file: then all that was done, there.
    pub(super) fn save(&mut self) {
        if let Some(record) = self.player.record() {
            let path = record.to_owned();
            return self.save_to(path);
        }
        self.ask_where_to_save(Saved::Moment);
    }

    /// Opens the system's dialog, unless it is open.
    pub(super) fn browse_to_save(&mut self) {
        if self.saving.is_none() {
            let (begins, ending) = (folder(self.recent.saved()), self.panels.save_to.ending());
            let kind = self.panels.save_to.kind;
            let path = match kind.is_of_scene() {
                true => saved_again(self.player.file(), ending)
                    .unwrap_or_else(|| begins.join(plain_name(self.scene.name(), ending))),
                false => self.free_path(ending),
            };
            self.saving = Some(Saving::new(&self.window, (&path, kind.filter()), self.wake_up()));
        }
    }

    /// The next file is looked for, or written, beside this one, which is the newest of those that are listed.
    pub(in crate::app) fn remember(&mut self, path: &Path, used: Used) {
        self.recent.note(path, used);
        let kept = self.state_folder.as_deref().map(|folder| self.recent.save(folder));
        self.panels.recent = self.recent.files().to_vec();
        if let Some(Err(why)) = kept {
            self.panels.notes.warn(format!("the next start does not list this file: {why}"));
        }
    }

    /// The scene was read from this file: it is listed as the newest, and saved there again. A recording stays as it is.
    pub(in crate::app) fn have_come_from(&mut self, path: &Path) {
        self.remember(path, Used::Opened);
        if !self.player.start().is_replayed() {
            self.player.lie_in(path);
        }
    }

    /// A name that no file has, of this ending, where files go that nobody named a place for: after the file that the scene was saved to or
    /// opened from, if there is one.
    pub(super) fn free_path(&self, ending: &str) -> PathBuf {
        let called = self.player.called().or(self.player.start().name());
        let name = named_after(called, self.player.file(), self.scene.name());
        free_name(&folder(self.recent.saved()), &name, ending)
    }

    /// A path can be written, for what is to be saved: what is plotted gets a name that no file has, however the scene is called.
    pub(super) fn ask_where_to_save(&mut self, kind: Saved) {
        // What was chosen for the last file says nothing of this one.
        self.panels.save_to = SaveTo::of(kind, self.panels.save_to.clip);
        let ending = self.panels.save_to.ending();
        let own = saved_again(self.player.file(), ending).filter(|_| kind.is_of_scene());
        let path = own.unwrap_or_else(|| self.free_path(ending));
        self.panels.path = path.display().to_string();
        (self.panels.sheet, self.panels.is_fresh) = (Some(Sheet::SaveTo), true);
        self.place_hint();
    }

    /// The dialog was told a path that ends otherwise: what becomes of it is written without a word if there is no such file yet.
    fn ask_for_ending(&mut self, path: &Path) {
        self.panels.save_to.begin();
        self.panels.path = path.display().to_string();
        let mut wishes = Vec::new();
        ask_to_save(&mut self.panels, &mut wishes);
        if wishes.is_empty() {
            (self.panels.sheet, self.panels.is_fresh) = (Some(Sheet::SaveTo), true);
        }
        wishes.into_iter().for_each(|wish| self.grant(wish));
    }

    /// Saves it there.
    pub(super) fn hear_of_saving(&mut self) {
        let chosen = self.saving.as_ref().and_then(Saving::take);
        let Some(chosen) = chosen else { return };
        self.saving = None;
        let is_writing = self.panels.sheet == Some(Sheet::SaveTo);
        match chosen {
            Chosen::File(path) => {
                match self.panels.save_to.takes(&path) {
                    // The dialog has asked whether what is there may go.
                    true => {
                        self.panels.path = path.display().to_string();
                        self.grant(Wish::SaveTo(path));
                    }
                    false => self.ask_for_ending(&path),
                }
            }
            Chosen::NoDialog if is_writing => {
                self.panels.save_to.complain("the system has no dialog for files: write a path")
            }
            // The path can still be written.
            Chosen::Nothing if is_writing => {}
            Chosen::Nothing | Chosen::NoDialog => self.say("nothing was saved".to_owned()),
        }
        self.touch();
    }

    /// Saves all that was done, and how it is looked at.
    pub(super) fn save_to(&mut self, path: PathBuf) {
        self.leave_once_written();
        self.tell_view();
        self.player.ask(Order::Save(path));
    }

    /// Saves this moment as a scene, and how it is looked at.
    pub(super) fn save_moment(&mut self, path: PathBuf) {
        self.leave_once_written();
        self.tell_view();
        self.player.ask(Order::Moment(path));
    }

    /// What is written from now on is looked at as it is seen now.
    pub(super) fn tell_view(&mut self) {
        self.player.ask(Order::Look(keys(&self.own_camera())));
    }

    /// Draws the world as it is seen, without panels, and has it written with a snapshot in it.
    pub(super) fn take_screenshot(&mut self) {
        if !self.player.is_open() || self.area.contains(&0) {
            return;
        }
        let region = self.region();
        let view = View { mouse: region.as_ref().map(|(force, at)| (force, *at)), ..self.player.shown().view() };
        let mut camera = self.camera;
        camera.resize(self.area);
        let capture = Capture::on(self.canvas.gpu().clone(), self.area, view.dimensions);
        let (view, force) = (view.clone(), view.mouse);
        let beside = (&self.player.shown().beside[..], AllTrails(&self.trails, &self.beside_trails));
        let panes = self.panes(view, beside, (force, &camera, self.look), self.area);
        let drawn = capture.and_then(|mut capture| capture.pictures(&panes));
        match drawn {
            Ok(picture) => {
                let path = self.free_path("png");
                self.tell_view();
                self.player.ask(Order::Picture(path, Box::new(picture)));
            }
            Err(error) => self.complain(&error.to_string()),
        }
    }
}
