//! Sessions that a killed program left: the newest is offered once, at the start; all of them are in the gallery, gone on with or
//! discarded.

use super::Session;
use super::shelf::Way;
use crate::app::leftovers::{Leftover, note_offered};
use crate::app::player::{Keeping, Player};

impl Session {
    /// Takes what was found at the start, and offers the newest where it never was.
    pub(super) fn hear_of_leftovers(&mut self) {
        let found = self.search.as_ref().and_then(|search| search.try_recv().ok());
        let Some(found) = found else { return };
        self.search = None;
        self.leftovers = found;
        if let Some(newest) = self.leftovers.last().filter(|newest| newest.is_new) {
            let others = match self.leftovers.len() {
                1 => "",
                _ => "; earlier ones are in the gallery",
            };
            self.panels.notes.offer = Some(format!("your last session was cut off: {}{others}", newest.line()));
        }
        self.list_leftovers();
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
        self.panels.leftovers = self.leftovers.iter().rev().map(Leftover::line).collect();
    }

    /// Goes on with a session of the list, where it ended, once what was done in it is worked out again; who does not wait for that is where
    /// one came from, and finds it by redo.
    pub(super) fn go_on_with_leftover(&mut self, place: usize) {
        self.panels.notes.offer = None;
        let Some(place) = self.leftovers.len().checked_sub(place + 1) else { return };
        let leftover = self.leftovers.remove(place);
        let keeping = Keeping { heir_of: Some(leftover.left), ..self.keeping() };
        let player = Player::resume(leftover.start, keeping, self.wake_up());
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

    /// How a history is kept that opens now.
    pub(super) fn keeping(&mut self) -> Keeping {
        Keeping { folder: self.state_folder.clone(), record: self.record.take(), heir_of: None }
    }
}
