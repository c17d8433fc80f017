//! Branches that are called something, and those that are not wanted any more: these are not listed, until that is taken back.

use super::session::History;
use super::undo::{Redo, Undone};

/// A branch was discarded. Nothing of it is taken out of the log.
#[derive(Clone, Debug)]
pub(super) struct Discard {
    number: usize,
    /// What that is called.
    pub(super) name: String,
    after: Deed,
}

/// What undo would take back of the world: the number of an edit, or where its branch began anew.
type Deed = (Option<u64>, usize);

impl History {
    /// The letters that a title of a branch has at most.
    pub const LONGEST_TITLE: usize = 60;

    /// A branch that is listed is called so from now on; of an empty title, by what was done last in it. That is no edit, and no file has it.
    pub fn call_branch(&mut self, number: usize, title: &str) {
        let title: String = title.trim().chars().take(Self::LONGEST_TITLE).collect();
        if let Some(view) = self.branches().iter().find(|view| view.number == number) {
            self.tree.call(number, Some(title).filter(|title| !title.is_empty()), view.title.is_some());
        }
    }

    /// A branch is not listed any more: not the one that the world is on. Undo takes that back, if no edit was done since, or once those are
    /// undone. Returns what it was called; `None`: it is not listed, or the present one.
    pub fn discard_branch(&mut self, number: usize) -> Option<String> {
        let view = self.branches().into_iter().find(|view| view.number == number && !view.is_present)?;
        let called = view.called();
        let (name, after) = (format!("discard the timeline \"{called}\""), self.last_deed());
        self.discard_again(Discard { number, name, after });
        Some(called)
    }

    pub(super) fn discard_again(&mut self, discard: Discard) {
        self.tree.discard(discard.number, true);
        self.discards.retain(|other| other.number != discard.number);
        self.discards.push(discard);
    }

    /// What of the world undo would take back.
    fn last_deed(&self) -> Deed {
        let edit = self.edit_before(self.frame.place).and_then(|[_, last]| self.edit_of(self.branch, last));
        (edit, self.tree.anew(self.branch).branch)
    }

    /// Where in the list of them stands the branch that was discarded since the last edit, the last of these.
    fn place_of_discard(&self) -> Option<usize> {
        if self.discards.is_empty() {
            return None;
        }
        let deed = self.last_deed();
        let is_to_undo = |discard: &Discard| discard.after == deed && self.tree.is_discarded(discard.number);
        self.discards.iter().rposition(is_to_undo)
    }

    /// What undo takes back before any edit.
    pub(super) fn last_discard(&self) -> Option<&Discard> {
        Some(&self.discards[self.place_of_discard()?])
    }

    /// A branch that was discarded since the last edit is listed again.
    pub(super) fn take_back_discard(&mut self) -> Option<Undone> {
        let discard = self.discards.remove(self.place_of_discard()?);
        self.tree.discard(discard.number, false);
        let name = discard.name.clone();
        self.undone.push(Redo::Discard(discard));
        Some(Undone { name, seconds: 0.0 })
    }
}
