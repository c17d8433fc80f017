//! Sessions that a killed program left: offered one after another, gone on with or discarded.

use super::Session;
use crate::app::player::{Keeping, Order, Player};

impl Session {
    /// Takes what was found at the start.
    pub(super) fn hear_of_leftovers(&mut self) {
        let found = self.search.as_ref().and_then(|search| search.try_recv().ok());
        if let Some(found) = found {
            self.search = None;
            self.leftovers = found;
            self.offer();
        }
    }

    /// Offers the newest that is left.
    fn offer(&mut self) {
        self.panels.notes.offer = self.leftovers.last().map(|leftover| leftover.line.clone());
        self.touch();
    }

    /// Goes on with the session that is offered, where it ended.
    pub(super) fn go_on_with_leftover(&mut self) {
        if let Some(leftover) = self.leftovers.pop() {
            let end = leftover.start.recording().end();
            let keeping = Keeping { heir_of: Some(leftover.left), ..self.keeping() };
            let player = Player::open(leftover.start, keeping, self.wake_up());
            self.put_on(player);
            self.player.ask(Order::GoTo(end, None));
            self.player.play(false);
            self.say("as it was when it was cut off: play goes on from there".to_owned());
        }
        self.offer();
    }

    /// The session that is offered is not wanted.
    pub(super) fn discard_leftover(&mut self) {
        if let Some(Err(error)) = self.leftovers.pop().map(|leftover| leftover.left.discard()) {
            self.complain(&format!("the session cannot be discarded: {error}"));
        }
        self.offer();
    }

    /// How a history is kept that opens now.
    pub(super) fn keeping(&mut self) -> Keeping {
        Keeping { folder: self.state_folder.clone(), record: self.record.take(), heir_of: None }
    }
}
