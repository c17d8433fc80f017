//! To another time: by undo and redo, by a time that was seen already, and to another branch.

use super::Stage;
use crate::app::player::order::{Note, Order};
use crate::history::GivenUp;

impl Stage {
    /// Goes to where an order leads, as long as `goes_on` says so, which is told how much of that is worked out, 0 to 1. Returns what is to be
    /// said of it.
    ///
    /// Errors: it was given up, and all is as it was.
    pub(super) fn go(&mut self, order: &Order, goes_on: &mut dyn FnMut(f64) -> bool) -> Result<Option<Note>, GivenUp> {
        let (note, cursor) = match order {
            Order::Undo(cursor) => match self.history.undo_while(goes_on)? {
                None => return Ok(Some(Note::NothingToUndo)),
                Some(undone) => (Some(Note::Undone(undone.name, undone.seconds)), cursor),
            },
            Order::Redo(cursor) => match self.history.redo_while(goes_on)? {
                None => return Ok(Some(Note::NothingToRedo)),
                Some(redone) => (Some(Note::Redone(redone.name, redone.seconds)), cursor),
            },
            Order::GoTo(time, cursor) => {
                self.pace.go_to_while((&mut self.history, *time), *cursor, goes_on)?;
                return Ok(None);
            }
            Order::ToBranch(number, cursor) => {
                self.history.to_branch_while(*number, goes_on)?;
                self.number_anew([0; 2]);
                (None, cursor)
            }
            _ => return Ok(None),
        };
        self.pace.gone_for_good(&self.history, *cursor);
        Ok(note)
    }
}
