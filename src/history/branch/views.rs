//! The branches that are listed, with what each is called, and those that are not wanted any more.

use std::collections::BTreeSet;

use super::{Branch, Shared, Spot, Tree, does_something};
use crate::history::command::{Do, Entry};

/// A branch, to be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchView {
    /// What [`super::super::History::to_branch`] takes.
    pub number: usize,
    /// What was done last where it was left, or else on it: the name of the last edit, or what was driven or dragged where there is no
    /// edit; empty where nothing was done.
    pub name: String,
    /// When that was done, or when it left the branch that it comes from `[s]`.
    pub at: f64,
    /// What somebody calls it; `None`: it is called by what was done last.
    pub title: Option<String>,
    /// When it left the branch that it comes from, or was left itself, if that was before `[s]`.
    pub from: f64,
    /// When it was left `[s]`.
    pub end: f64,
    /// Whether the world is on it.
    pub is_present: bool,
}

impl BranchView {
    /// What it is called: as somebody said, or else by what was done last in it, and when.
    pub fn called(&self) -> String {
        match &self.title {
            Some(title) => title.clone(),
            None if self.name.is_empty() => format!("from {:.1} s on", self.at),
            None => format!("{} at {:.1} s", self.name, self.at),
        }
    }
}

/// A command in words: by the name of its edit, or else by what it does.
fn said(entry: &Entry) -> String {
    let word = match entry.act {
        Do::Cursor { .. } => "pointer",
        Do::Mouse(_) => "mouse",
        Do::Grab(_) | Do::Release => "drag",
        Do::Key { .. } => "key",
        Do::Pin(_) => "pin",
        Do::Unpin(_) => "unpin",
        Do::Cut { .. } | Do::Split { .. } => "cut",
        Do::Add(_) => "add",
        Do::Delete(_) => "delete",
        Do::Clear => "delete all",
        Do::Move(_) => "move",
        Do::Set(_) => "set",
        Do::Group { .. } => "group",
    };
    entry.name.clone().unwrap_or_else(|| word.to_owned())
}

impl Tree {
    /// How many commands of each branch are of others as well that have an edit, of the present one, or of what redo brings again: of
    /// branches with so many of their commands each.
    fn elsewhere(&self, present: usize, redone: impl Iterator<Item = Shared>) -> Vec<usize> {
        let mut reached = vec![0; self.branches.len()];
        for (branch, place) in redone {
            reached[branch] = reached[branch].max(place);
        }
        // What leaves a branch comes after it.
        for (number, branch) in self.branches.iter().enumerate().rev() {
            let is_something = number == present || self.last_edit(number).is_some();
            let all = if is_something { self.len(number) } else { reached[number] };
            if let Some((parent, shared)) = branch.parent {
                reached[parent] = reached[parent].max(all.min(shared));
            }
        }
        reached
    }

    /// The branches that one may want to go back to: those on which something was done that is nowhere else, nor brought again by redo;
    /// those that were followed until something else was done; and the present one. What was discarded is none of them, and with it goes
    /// what others had in common with it alone.
    pub(in crate::history) fn views(&self, present: usize, redone: impl Iterator<Item = Shared>) -> Vec<BranchView> {
        let elsewhere = self.elsewhere(present, redone);
        let is_shown = |&number: &usize| {
            let Branch { is_taken_over, is_discarded, .. } = self.branches[number];
            let is_own = self.last_edit(number).is_some_and(|last| last >= elsewhere[number]);
            number == present || !is_discarded && (is_own || is_taken_over)
        };
        let mut given = BTreeSet::new();
        let view = |number: usize| {
            // Of several that go on from one that was called something the first is called so.
            let titled = self.titled(number).filter(|titled| given.insert(*titled));
            let title = titled.and_then(|titled| self.branches[titled].title.clone());
            BranchView { title, ..self.view(number, present) }
        };
        (0..self.count()).filter(is_shown).map(view).collect()
    }

    fn view(&self, number: usize, present: usize) -> BranchView {
        let is_present = number == present;
        let end = Spot { branch: number, place: usize::MAX, time: self.end(number) };
        let left = if is_present { end } else { self.where_left(number, present) };
        let last = if left == end { self.last_edit(number) } else { self.edit_before(left.branch, left.place) };
        let of = |branch: usize, place: Option<usize>| self.entry(branch, place?);
        let done = of(left.branch, last).or_else(|| of(number, self.last_edit(number)));
        let done = done.or_else(|| self.last_done(number));
        let from = self.branches[number].from.min(left.time);
        let (name, at) = done.map_or((String::new(), from), |entry| (said(entry), entry.at));
        BranchView { number, name, at, title: None, from, end: left.time, is_present }
    }

    /// What was done last on a branch and on none that it comes from, edit or not.
    fn last_done(&self, number: usize) -> Option<&Entry> {
        let Branch { own, taken_along, .. } = &self.branches[number];
        own[*taken_along..].iter().rev().find(|entry| does_something(entry))
    }

    /// The branch whose title a branch has: its own, or that of one that it goes on from, by itself or after undo, and on which nothing else
    /// was done.
    fn titled(&self, mut number: usize) -> Option<usize> {
        while self.branches[number].title.is_none() {
            let goes_on = |&other: &usize| self.branches[other].left.and_then(|left| left.by) == Some(number);
            let before = || (0..number).rev().find(goes_on).filter(|_| self.last_done(number).is_none());
            number = before().or_else(|| {
                let (parent, shared) = self.branches[number].parent?;
                let later = &self.branches[parent].own[shared - self.shared(parent)..];
                (!later.iter().any(does_something)).then_some(parent)
            })?;
        }
        Some(number)
    }

    /// Somebody calls a branch something; `None`: nothing any more. `is_called`: it is listed with a title, which it may have of one that it
    /// goes on from, and that is not called so any more.
    pub(in crate::history) fn call(&mut self, number: usize, title: Option<String>, is_called: bool) {
        if let Some(titled) = self.titled(number).filter(|_| is_called) {
            self.branches[titled].title = None;
        }
        self.branches[number].title = title;
    }

    /// A branch is not listed any more, or it is again.
    pub(in crate::history) fn discard(&mut self, number: usize, is_discarded: bool) {
        self.branches[number].is_discarded = is_discarded;
    }

    /// Whether it was discarded, and nothing was done on it since.
    pub(in crate::history) fn is_discarded(&self, number: usize) -> bool {
        self.branches[number].is_discarded
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(at: f64, name: &str) -> Entry {
        Entry { at, act: Do::Clear, edit: Some(at as u64), name: Some(name.to_owned()) }
    }

    fn called(tree: &Tree, present: usize) -> Vec<String> {
        tree.views(present, std::iter::empty()).iter().map(BranchView::called).collect()
    }

    fn spot(branch: usize, place: usize, time: f64) -> Spot {
        Spot { branch, place, time }
    }

    #[test]
    fn branches_are_called_by_what_was_done_last_and_when() {
        let mut tree = Tree::new(vec![entry(1.0, "pin"), entry(3.21, "cut")], Vec::new(), 0.0, 5.0);
        let other = tree.fork(spot(0, 1, 2.0));
        assert_eq!(called(&tree, other), ["cut at 3.2 s", "from 2.0 s on"]);
        tree.push(other, Entry { edit: None, name: None, act: Do::Release, ..entry(2.5, "") });
        assert_eq!(called(&tree, other)[1], "drag at 2.5 s", "it is no edit, but something done");
        tree.push(other, Entry { name: None, ..entry(4.0, "") });
        tree.push(other, Entry { edit: None, name: None, act: Do::Release, ..entry(4.5, "") });
        assert_eq!(called(&tree, other)[1], "delete all at 4.0 s", "by what it does, where a file has no name for it");
    }

    #[test]
    fn what_somebody_calls_a_branch_goes_on_with_it() {
        let mut tree = Tree::new(vec![entry(1.0, "pin"), entry(3.0, "cut")], Vec::new(), 0.0, 5.0);
        let other = tree.fork(spot(0, 1, 2.0));
        tree.push(other, entry(2.0, "move"));
        tree.call(0, Some("best".to_owned()), false);
        assert_eq!(called(&tree, other), ["best", "move at 2.0 s"]);
        // Gone back a little, to after all that was done on it, and on from there, twice.
        let on = tree.fork(spot(0, 2, 4.0));
        assert_eq!(called(&tree, on), ["move at 2.0 s", "best"]);
        tree.push(on, entry(4.0, "add"));
        let second = tree.fork(spot(0, 2, 4.5));
        tree.push(second, entry(4.5, "group"));
        assert_eq!(called(&tree, on), ["move at 2.0 s", "best", "group at 4.5 s"], "the first of them goes on with it");
        tree.call(on, Some("better".to_owned()), true);
        assert_eq!(called(&tree, on), ["move at 2.0 s", "better", "group at 4.5 s"]);
        tree.call(on, None, true);
        assert_eq!(called(&tree, on)[1], "add at 4.0 s");
        // Undone, while time went on: the same, until something else is done.
        tree.call(second, Some("last".to_owned()), false);
        tree.leave_at(spot(second, 2, 4.2));
        let undone = tree.fork(spot(second, 2, 4.2));
        tree.go_on(second, undone);
        let last = tree.views(undone, std::iter::once((second, 3))).pop();
        assert_eq!(last.map(|view| view.called()).as_deref(), Some("last"));
        tree.push(undone, entry(6.0, "weld"));
        assert_eq!(called(&tree, undone)[2..], ["last".to_owned(), "weld at 6.0 s".to_owned()]);
    }

    #[test]
    fn what_was_discarded_is_listed_only_while_the_world_is_on_it_or_it_is_wanted_again() {
        let mut tree = Tree::new(vec![entry(1.0, "pin"), entry(3.0, "cut")], Vec::new(), 0.0, 5.0);
        let other = tree.fork(spot(0, 1, 2.0));
        tree.push(other, entry(2.0, "move"));
        tree.discard(0, true);
        assert_eq!(called(&tree, other), ["move at 2.0 s"]);
        assert_eq!(called(&tree, 0).len(), 2, "the world is on it");
        tree.discard(0, false);
        assert_eq!(called(&tree, other).len(), 2);
        tree.discard(0, true);
        tree.push(0, entry(5.0, "weld"));
        assert!(!tree.is_discarded(0), "something is done on it");
    }
}
