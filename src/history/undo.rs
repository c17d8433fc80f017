//! Undo, redo, going back and going on.

use super::branch::Spot;
use super::command::Do;
use super::session::History;
use crate::sim::Dynamics;

/// What was undone or done again.
#[derive(Clone, Debug, PartialEq)]
pub struct Undone {
    /// What it is called.
    pub name: String,
    /// How far time went `[s]`: below 0 back.
    pub seconds: f64,
}

/// Where doing again leads to.
#[derive(Clone, Debug)]
pub(super) struct Redo {
    spot: Spot,
    name: String,
}

/// What going back to the start is called.
const RESET: &str = "Reset";

impl History {
    /// Goes back to just before the last edit. Nothing to undo is no error.
    pub fn undo(&mut self) -> Option<Undone> {
        let before = self.world().time();
        let (branch, place) = (self.branch, self.frame.place);
        let edit_of = |place: usize| self.tree.entry(branch, place).and_then(|entry| entry.edit);
        // What was taken along to the start was done before that was gone to.
        let first = self.tree.taken_along(branch);
        let (name, again, back) = match (first..place).rev().find(|&place| edit_of(place).is_some()) {
            Some(last) => {
                let edit = edit_of(last);
                let same = |&place: &usize| edit_of(place).is_none() || edit_of(place) == edit;
                let first = (0..=last).rev().take_while(same).filter(|&place| edit_of(place) == edit).last();
                let named = first.unwrap_or(last);
                let first = self.with_grab(named);
                let after = (last..self.tree.len(branch)).take_while(same).filter(|&place| edit_of(place) == edit);
                let last = after.last().unwrap_or(last);
                (self.name(branch, named), self.after(branch, last), self.before(branch, first))
            }
            None => {
                let back = self.tree.origin(branch)?;
                let again = Spot { branch: self.tree.root(branch), place: first, time: self.from() };
                (RESET.to_owned(), again, back)
            }
        };
        self.undone.push(Redo { spot: again, name: name.clone() });
        self.go(back);
        Some(Undone { name, seconds: self.world().time() - before })
    }

    /// Goes to just after what was undone last, or else after the edit that comes next in the log. Nothing to do again is no
    /// error.
    pub fn redo(&mut self) -> Option<Undone> {
        let before = self.world().time();
        let Redo { spot, name } = match self.undone.pop() {
            Some(redo) => redo,
            None => self.next_edit()?,
        };
        self.go(spot);
        Some(Undone { name, seconds: self.world().time() - before })
    }

    /// The edit that comes next in the log, if that is followed.
    fn next_edit(&self) -> Option<Redo> {
        if self.is_free {
            return None;
        }
        let edit_of = |place: usize| self.tree.entry(self.branch, place).and_then(|entry| entry.edit);
        let to_come = self.frame.place..self.tree.len(self.branch);
        let first = to_come.clone().find(|&place| edit_of(place).is_some())?;
        let same = |&place: &usize| edit_of(place).is_none() || edit_of(place) == edit_of(first);
        let last = (first..to_come.end).take_while(same).filter(|&place| edit_of(place).is_some()).last()?;
        Some(Redo { spot: self.after(self.branch, last), name: self.name(self.branch, first) })
    }

    /// Where an edit begins that begins at this place: one that lets go begins with the grab that it ends, and with what led to that at the
    /// same time. A grab alone is no edit.
    fn with_grab(&self, place: usize) -> usize {
        let entry = |place: usize| self.tree.entry(self.branch, place);
        let is = |place: usize, what: fn(&Do) -> bool| entry(place).is_some_and(|entry| what(&entry.act));
        if !is(place, |act| matches!(act, Do::Release)) {
            return place;
        }
        let Some(grab) = (0..place).rev().find(|&k| is(k, |act| matches!(act, Do::Grab(_)))) else { return place };
        let at = entry(grab).map(|entry| entry.at);
        let leads = |&k: &usize| {
            let is_same = entry(k).is_some_and(|entry| Some(entry.at) == at && entry.edit.is_none());
            is_same && is(k, |act| matches!(act, Do::Cursor { .. } | Do::Mouse(_)))
        };
        (0..grab).rev().take_while(leads).last().unwrap_or(grab)
    }

    fn name(&self, branch: usize, place: usize) -> String {
        self.tree.entry(branch, place).and_then(|entry| entry.name.clone()).unwrap_or_default()
    }

    fn before(&self, branch: usize, place: usize) -> Spot {
        let time = self.tree.entry(branch, place).map_or(self.from(), |entry| entry.at);
        Spot { branch, place, time }
    }

    fn after(&self, branch: usize, place: usize) -> Spot {
        Spot { place: place + 1, ..self.before(branch, place) }
    }

    /// To the start of all, with the edits that were done there before any time went by; undone as one. Returns how many later edits that leaves
    /// behind.
    pub fn reset(&mut self) -> usize {
        let here = self.spot();
        self.keyframes.keep(self.branch, self.frame.clone(), false);
        let start = Spot { branch: self.branch, place: 0, time: self.from() };
        let edits = (0..here.place).filter_map(|place| self.tree.entry(here.branch, place));
        let (built, later): (Vec<_>, Vec<_>) =
            edits.filter(|entry| entry.edit.is_some()).cloned().partition(|entry| entry.at <= start.time);
        self.leave(start.branch, false);
        self.restore(start);
        self.branch = self.tree.begin_anew(start.time, here, built);
        self.is_free = false;
        while self.frame.place < self.tree.len(self.branch) {
            self.pass();
        }
        self.undone.clear();
        self.arrive();
        let mut left: Vec<_> = later.iter().map(|entry| entry.edit).collect();
        left.dedup();
        left.len()
    }

    /// The state at the step that ends at or before `t` `[s]`, exactly. What comes after stays and is followed, until something
    /// new is given: then that is another branch.
    pub fn go_to(&mut self, t: f64) {
        let t = if t.is_nan() { self.from() } else { t.clamp(self.from(), self.end().max(self.tree.end(self.branch))) };
        self.is_free = false;
        self.restore(Spot { branch: self.branch, place: usize::MAX, time: t });
        loop {
            let next = self.tree.entry(self.branch, self.frame.place).map(|entry| entry.at);
            match next {
                Some(at) if self.frame.is_due(at) => self.pass(),
                Some(at) if at <= t => self.frame.step(Some(at), &self.scene),
                _ if self.frame.ends_by(t) => self.frame.step(next, &self.scene),
                _ => break,
            }
        }
        self.arrive();
    }

    /// The keyframe at or before `t` `[s]`, to be shown at once.
    pub fn nearest(&self, t: f64) -> Option<(f64, &dyn Dynamics)> {
        let spot = Spot { branch: self.branch, place: usize::MAX, time: t };
        let kept = self.keyframes.before(&self.tree, spot)?;
        Some((kept.time, &*kept.frame.world))
    }

    /// To the end of another branch.
    pub fn to_branch(&mut self, number: usize) {
        if number >= self.tree.count() || number == self.branch {
            return;
        }
        self.undone.clear();
        self.leave(number, true);
        self.branch = number;
        self.go_to(self.tree.end(number));
    }

    /// To a spot that the history was at, exactly; what comes after it is not followed.
    fn go(&mut self, spot: Spot) {
        self.leave(spot.branch, true);
        self.restore(spot);
        self.branch = spot.branch;
        self.is_free = true;
        loop {
            let next = self.tree.entry(self.branch, self.frame.place).map(|entry| entry.at);
            match next {
                Some(at) if self.frame.place < spot.place => {
                    if self.frame.is_due(at) {
                        self.pass()
                    } else {
                        self.frame.step(Some(at), &self.scene)
                    }
                }
                // A step that was cut short for what was undone is not: no file knows why.
                _ if self.frame.ends_by(spot.time) => self.frame.step(None, &self.scene),
                _ => break,
            }
        }
        self.arrive();
    }

    /// The last keyframe at or before a spot becomes the present.
    fn restore(&mut self, spot: Spot) {
        if let Some(kept) = self.keyframes.before(&self.tree, spot) {
            self.frame = kept.frame.clone();
        }
    }

    /// Does the next command of the log; what could not be done then cannot be done now.
    fn pass(&mut self) {
        if let Some(entry) = self.tree.entry(self.branch, self.frame.place) {
            let _ = self.frame.follow(entry, &self.scene);
        }
    }

    /// The present branch is left for another.
    fn leave(&mut self, to: usize, forgets: bool) {
        if to != self.branch && forgets {
            self.tree.leave(self.branch);
        }
        self.tree.enter(to);
    }
}
