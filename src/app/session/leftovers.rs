//! Sessions that a killed program left: the newest is offered once, at the start; all of them are in the gallery, gone on with or
//! discarded.

use super::Session;
use super::shelf::Way;
use crate::app::leftovers::{Leftover, note_offered, note_told, unread_line};
use crate::app::panels::Sheet;
use crate::app::player::{Keeping, Player};
use crate::app::thumbnails::CutOff;

impl Session {
    /// Takes what was found at the start, and offers the newest where it never was.
    pub(super) fn hear_of_leftovers(&mut self) {
        self.tell_of_unread();
        let found = self.search.as_ref().and_then(|search| search.try_recv().ok());
        let Some(found) = found else { return };
        self.search = None;
        (self.leftovers, self.unread) = (found.leftovers, found.unread);
        if self.panels.sheet == Some(Sheet::Gallery) {
            self.draw_leftovers();
        }
        if let Some(newest) = self.leftovers.last().filter(|newest| newest.is_new) {
            let others = match self.leftovers.len() {
                1 => "",
                _ => "; earlier ones are in the gallery",
            };
            self.panels.notes.offer = Some(format!("your last session was cut off: {}{others}", newest.line()));
        }
        self.list_leftovers();
        self.tell_of_unread();
    }

    /// Says once where sessions lie that cannot be read: as soon as a scene is there, which would close it as it comes.
    fn tell_of_unread(&mut self) {
        let Some(line) = unread_line(&self.unread).filter(|_| self.player.is_open()) else { return };
        let files = std::mem::take(&mut self.unread);
        if let Some(folder) = &self.state_folder {
            note_told(folder, &files);
        }
        self.panels.notes.tell(line);
        self.touch();
    }

    /// The gallery lists what is left, the newest first, and no start offers it again.
    fn list_leftovers(&mut self) {
        if let Some(folder) = &self.state_folder {
            note_offered(folder, &self.leftovers);
        }
        self.tell_leftovers();
        self.touch();
    }

    /// The gallery says of each how long ago it was, as it is opened.
    pub(super) fn tell_leftovers(&mut self) {
        let card = |leftover: &Leftover| (leftover.left.path().to_owned(), leftover.line());
        self.panels.leftovers = self.leftovers.iter().rev().map(card).collect();
    }

    /// Goes on with a session of the list, where it ended, once what was done in it is worked out again; who does not wait for that is where
    /// one came from, and finds it by redo.
    pub(super) fn go_on_with_leftover(&mut self, place: usize) {
        self.panels.notes.offer = None;
        let Some(place) = self.leftovers.len().checked_sub(place + 1) else { return };
        let leftover = self.leftovers.remove(place);
        let keeping = Keeping { heir_of: Some(leftover.left), ..self.keeping() };
        let mut player = Player::resume(leftover.start, keeping, self.wake_up());
        player.be_called(leftover.called);
        self.put_on(player);
        self.came = self.shelf.has_before().then_some((Way::On, 1));
        self.player.play(false);
        self.settle();
        self.list_leftovers();
    }

    /// A session of the list is not wanted.
    pub(super) fn discard_leftover(&mut self, place: usize) {
        self.panels.notes.offer = None;
        let Some(place) = self.leftovers.len().checked_sub(place + 1) else { return };
        if let Err(error) = self.leftovers.remove(place).left.discard() {
            self.complain(&format!("the session cannot be discarded: {error}"));
        }
        self.list_leftovers();
    }

    /// None of the list is wanted.
    pub(super) fn discard_leftovers(&mut self) {
        self.panels.notes.offer = None;
        for leftover in std::mem::take(&mut self.leftovers) {
            if let Err(error) = leftover.left.discard() {
                self.complain(&format!("a session cannot be discarded: {error}"));
            }
        }
        self.list_leftovers();
    }

    /// Draws those of the list, once the gallery is open.
    pub(super) fn draw_leftovers(&mut self) {
        if self.cut_off.is_none() && !self.leftovers.is_empty() {
            let wanted = |leftover: &Leftover| (leftover.left.path().to_owned(), leftover.start.scene().clone());
            let wanted = self.leftovers.iter().rev().map(wanted).collect();
            self.cut_off = Some(CutOff::new(self.canvas.gpu().clone(), self.palette, wanted, self.wake_up()));
        }
    }

    /// How a history is kept that opens now.
    pub(super) fn keeping(&mut self) -> Keeping {
        Keeping { folder: self.state_folder.clone(), record: self.record.take(), heir_of: None }
    }
}
