//! Undo, redo, going back and going on.

use std::collections::BTreeSet;

use super::branch::Spot;
use super::command::{Do, Entry};
use super::discard::Discard;
use super::frame::Frame;
use super::keyframes::Kept;
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

/// It was given up on the way: all is as it was before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenUp;

/// What became of edits as the start was gone to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GoneBack {
    /// How many were left behind.
    pub left: usize,
    /// How many settings hold from there on, which were set later.
    pub kept: usize,
    /// There was nothing at the start: where the last thing was built was gone to.
    pub is_built: bool,
}

/// What doing again does.
#[derive(Clone, Debug)]
pub(super) enum Redo {
    /// It leads to a spot.
    To { spot: Spot, name: String },
    /// A branch is discarded again.
    Discard(Discard),
}

impl Redo {
    /// To a spot, which is called so.
    pub(super) fn to(spot: Spot, name: String) -> Self {
        Redo::To { spot, name }
    }

    /// Where it leads; `None`: nowhere.
    pub(super) fn spot(&self) -> Option<Spot> {
        match self {
            Redo::To { spot, .. } => Some(*spot),
            Redo::Discard(_) => None,
        }
    }

    /// The branch that it leads to, and how many of its commands are done there; `None`: nowhere.
    pub(super) fn reaches(&self) -> Option<(usize, usize)> {
        self.spot().map(|spot| (spot.branch, spot.place))
    }

    /// What it brings again is called.
    pub(super) fn name(&self) -> &str {
        match self {
            Redo::To { name, .. } => name,
            Redo::Discard(discard) => &discard.name,
        }
    }
}

/// What going back to the start is called.
const RESET: &str = "back to the start";
/// What it is called where nothing was there.
const BUILT: &str = "back to what was built";

impl History {
    /// Goes back to just before the last edit, or takes back that a branch was discarded, if that was done since. Nothing to undo is no
    /// error.
    pub fn undo(&mut self) -> Option<Undone> {
        self.undo_while(|_| true).unwrap_or_default()
    }

    /// The same, as long as `goes_on` says so, which is told before each step how much of what is worked out anew for it there is, 0 to 1.
    ///
    /// Errors: it was given up.
    pub fn undo_while(&mut self, goes_on: impl FnMut(f64) -> bool) -> Result<Option<Undone>, GivenUp> {
        if let Some(undone) = self.take_back_discard() {
            return Ok(Some(undone));
        }
        let before = self.world().time();
        let (branch, place) = (self.branch, self.frame.place);
        let (name, again, back) = match self.edit_before(place) {
            Some([named, last]) => {
                let first = self.with_grab(named);
                (self.name(branch, named), self.after(branch, self.last_of(branch, last)), self.before(branch, first))
            }
            None => {
                let Some(back) = self.tree.origin(branch) else { return Ok(None) };
                (self.name_anew(branch).to_owned(), self.tree.anew(branch), back)
            }
        };
        self.go(back, goes_on)?;
        self.undone.push(Redo::to(again, name.clone()));
        Ok(Some(Undone { name, seconds: self.world().time() - before }))
    }

    /// Goes to just after what was undone last, or else after the edit that comes next in the log. Nothing to do again is no
    /// error.
    pub fn redo(&mut self) -> Option<Undone> {
        self.redo_while(|_| true).unwrap_or_default()
    }

    /// The same, as long as `goes_on` says so, as of [`History::undo_while`].
    ///
    /// Errors: it was given up.
    pub fn redo_while(&mut self, goes_on: impl FnMut(f64) -> bool) -> Result<Option<Undone>, GivenUp> {
        let before = self.world().time();
        let Some(redo) = self.undone.last().cloned().or_else(|| self.next_edit()) else { return Ok(None) };
        let name = redo.name().to_owned();
        match redo {
            Redo::To { spot, .. } => self.go(spot, goes_on)?,
            Redo::Discard(discard) => self.discard_again(discard),
        }
        self.undone.pop();
        Ok(Some(Undone { name, seconds: self.world().time() - before }))
    }

    /// What undo would take back is called; `None`: there is nothing to undo.
    pub fn undoes(&self) -> Option<String> {
        if let Some(discard) = self.last_discard() {
            return Some(discard.name.clone());
        }
        match self.edit_before(self.frame.place) {
            Some([first, _]) => Some(self.name(self.branch, first)),
            None => self.tree.origin(self.branch).map(|_| self.name_anew(self.branch).to_owned()),
        }
    }

    /// What redo would bring again is called; `None`: there is nothing to redo.
    pub fn redoes(&self) -> Option<String> {
        let undone = self.undone.last().map(|redo| redo.name().to_owned());
        undone.or_else(|| self.to_come().map(|first| self.name(self.branch, first)))
    }

    /// The edit that comes next in the log, if that is followed.
    fn next_edit(&self) -> Option<Redo> {
        let first = self.to_come()?;
        Some(self.redo_of(self.branch, first))
    }

    fn redo_of(&self, branch: usize, first: usize) -> Redo {
        Redo::To { spot: self.after(branch, self.last_of(branch, first)), name: self.name(branch, first) }
    }

    /// What redo brings again of a branch that is left before its command `place`: what comes first last.
    fn undone_from(&self, branch: usize, place: usize) -> Vec<Redo> {
        let next = |place: usize| self.tree.edit_from(branch, place).map(|first| self.redo_of(branch, first));
        let mut all: Vec<Redo> = std::iter::successors(next(place), |redo| next(redo.reaches()?.1)).collect();
        all.reverse();
        all
    }

    /// The first command of the edit that comes next in the log, if that is followed.
    fn to_come(&self) -> Option<usize> {
        if self.is_free { None } else { self.tree.edit_from(self.branch, self.frame.place) }
    }

    /// The first and the last command before `place` of the edit that is the last there. What was taken along to the start was done before that
    /// was gone to, and is undone with it.
    pub(super) fn edit_before(&self, place: usize) -> Option<[usize; 2]> {
        let last = self.tree.edit_before(self.branch, place)?;
        let earlier = std::iter::successors(Some(last), |&place| self.tree.edit_before(self.branch, place));
        let first =
            earlier.take_while(|&place| self.edit_of(self.branch, place) == self.edit_of(self.branch, last)).last()?;
        (last >= self.tree.anew(self.branch).place).then_some([first, last])
    }

    /// The last command of the edit that a command of a branch is part of.
    fn last_of(&self, branch: usize, place: usize) -> usize {
        let later = std::iter::successors(Some(place), |&place| self.tree.edit_from(branch, place + 1));
        let is_same = |&later: &usize| self.edit_of(branch, later) == self.edit_of(branch, place);
        later.take_while(is_same).last().unwrap_or(place)
    }

    pub(super) fn edit_of(&self, branch: usize, place: usize) -> Option<u64> {
        self.tree.entry(branch, place).and_then(|entry| entry.edit)
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

    /// What going back to where a branch began anew is called.
    fn name_anew(&self, branch: usize) -> &'static str {
        if self.tree.anew(branch).time > self.from() { BUILT } else { RESET }
    }

    /// To the start of all, with the edits that were done there before any time went by, and with what was set since: numbers of the scene and
    /// of bodies that are there, and how they look. Where no body is there, to where the last thing was built. Undone as one.
    pub fn reset(&mut self) -> GoneBack {
        self.reset_while(|_| true).unwrap_or_default()
    }

    /// The same, as long as `goes_on` says so, as of [`History::undo_while`].
    ///
    /// Errors: it was given up.
    pub fn reset_while(&mut self, goes_on: impl FnMut(f64) -> bool) -> Result<GoneBack, GivenUp> {
        let here = self.spot();
        self.keyframes.keep(self.branch, self.frame.clone(), false);
        let start = self.start_of(here);
        self.travel(start, goes_on)?;
        let edits = (start.place..here.place).filter_map(|place| self.tree.entry(here.branch, place));
        let (mut own, later): (Vec<_>, Vec<_>) =
            edits.filter(|entry| entry.edit.is_some()).cloned().partition(|entry| entry.at <= start.time);
        let settings = self.settings_at_start(start.time, &own, &later);
        let of = |entries: &[Entry]| entries.iter().filter_map(|entry| entry.edit).collect::<BTreeSet<u64>>();
        let (kept, all) = (of(&settings).len(), of(&later).len());
        own.extend(settings);
        self.branch = self.tree.begin_anew(start, here, own);
        self.is_free = false;
        while self.frame.place < self.tree.len(self.branch) {
            self.pass();
        }
        self.undone.clear();
        self.arrive();
        Ok(GoneBack { left: all - kept, kept, is_built: start.place > 0 })
    }

    /// Where what is done until a spot begins: at the start of all, or where that has no bodies and none was built there, after the last edit
    /// by which something came or was put or held where it is.
    fn start_of(&self, here: Spot) -> Spot {
        let start = Spot { branch: here.branch, place: 0, time: self.from() };
        if self.keyframes.before(&self.tree, start).is_none_or(|kept| kept.frame.world.point_count() > 0) {
            return start;
        }
        let before = |place: usize| self.tree.edit_before(here.branch, place);
        let edits = std::iter::successors(before(here.place), |&place| before(place));
        let builds = |&place: &usize| self.tree.entry(here.branch, place).is_some_and(Entry::builds);
        let building: Vec<usize> = edits.filter(builds).collect();
        match building[..] {
            [last, ..] if building.iter().all(|&place| self.before(here.branch, place).time > start.time) => {
                self.after_all_at_once(here, last)
            }
            _ => start,
        }
    }

    /// After a command and those of its edit that were given with it: others of that edit came later, as those of a drag do.
    fn after_all_at_once(&self, here: Spot, first: usize) -> Spot {
        let of = |place: usize| self.tree.entry(here.branch, place).map(|entry| (entry.edit, entry.at));
        let last = (first..here.place).take_while(|&place| of(place) == of(first)).last().unwrap_or(first);
        self.after(here.branch, last)
    }

    /// What of later edits holds from `start` `[s]` on, where the world stands now, after what was `built` there: what can be done there. Of a
    /// drag the last number.
    fn settings_at_start(&self, start: f64, built: &[Entry], later: &[Entry]) -> Vec<Entry> {
        let mut trial = self.frame.clone();
        // What could not be done there when it was built cannot be done now.
        built.iter().for_each(|entry| _ = trial.follow(entry, &self.scene));
        let next = trial.world.next_numbers();
        let last =
            |(place, entry): &(usize, &Entry)| !later[place + 1..].iter().any(|other| entry.is_superseded_by(other));
        let others: BTreeSet<_> = later.iter().filter(|entry| !entry.is_setting()).map(|entry| entry.edit).collect();
        let alone = |(_, entry): &(usize, &Entry)| !others.contains(&entry.edit);
        let settings = later.iter().enumerate().filter(alone).filter(last);
        let settings = settings.filter_map(|(_, entry)| entry.at_start(start, next));
        settings.filter(|entry| trial.follow(entry, &self.scene).is_ok()).collect()
    }

    /// The state at the step that ends at or before `t` `[s]`, exactly. What comes after stays and is followed, until something
    /// new is given: then that is another branch.
    pub fn go_to(&mut self, t: f64) {
        _ = self.go_to_while(t, |_| true);
    }

    /// The same, as long as `goes_on` says so, as of [`History::undo_while`].
    ///
    /// Errors: it was given up.
    pub fn go_to_while(&mut self, t: f64, goes_on: impl FnMut(f64) -> bool) -> Result<(), GivenUp> {
        self.follow_to((self.branch, t), goes_on)
    }

    /// To a time `[s]` of a branch, whose log is followed from there on.
    fn follow_to(&mut self, (branch, t): (usize, f64), goes_on: impl FnMut(f64) -> bool) -> Result<(), GivenUp> {
        let end = if branch == self.branch { self.end() } else { self.from() };
        let t = if t.is_nan() { self.from() } else { t.clamp(self.from(), end.max(self.tree.end(branch))) };
        self.travel(Spot { branch, place: usize::MAX, time: t }, goes_on)?;
        self.is_free = false;
        Ok(())
    }

    /// The keyframe at or before `t` `[s]`, to be shown at once.
    pub fn nearest(&self, t: f64) -> Option<(f64, &dyn Dynamics)> {
        let spot = Spot { branch: self.branch, place: usize::MAX, time: t };
        let kept = self.keyframes.before(&self.tree, spot)?;
        Some((kept.time, &*kept.frame.world))
    }

    /// To another branch, where it was left: at its end, or where undo or redo led to on it and time went on from there. Redo brings again
    /// what was undone.
    pub fn to_branch(&mut self, number: usize) {
        _ = self.to_branch_while(number, |_| true);
    }

    /// The same, as long as `goes_on` says so, as of [`History::undo_while`].
    ///
    /// Errors: it was given up.
    pub fn to_branch_while(&mut self, number: usize, goes_on: impl FnMut(f64) -> bool) -> Result<(), GivenUp> {
        if number < self.tree.count() && number != self.branch {
            let left = self.tree.where_left(number, self.branch);
            match left.place {
                usize::MAX => self.follow_to((left.branch, left.time), goes_on)?,
                _ => self.go(left, goes_on)?,
            }
            self.undone = self.undone_from(number, self.tree.common(number, left.branch).min(left.place));
        }
        Ok(())
    }

    /// A step that was taken before. Copies are kept on the way as they were then: what is undone next is found from them, though all was worked out
    /// anew.
    fn step_again(&mut self, next: Option<f64>) {
        self.keyframes.keep_now_and_then(&mut self.kept, self.branch, &self.frame);
        self.frame.step(next, &self.scene);
    }

    /// To a spot that the history was at, exactly; what comes after it is not followed.
    fn go(&mut self, spot: Spot, goes_on: impl FnMut(f64) -> bool) -> Result<(), GivenUp> {
        self.travel(spot, goes_on)?;
        self.tree.leave_at(spot);
        self.is_free = true;
        Ok(())
    }

    /// Works out the state at a spot from the nearest copy, as long as `goes_on` says so, which is told before each step how much of the way
    /// is gone, 0 to 1. What is given up leaves the history where it was; copies that were kept on the way shorten the next one.
    fn travel(&mut self, spot: Spot, mut goes_on: impl FnMut(f64) -> bool) -> Result<(), GivenUp> {
        let from = (self.branch, self.kept, self.frame_before(spot));
        self.branch = spot.branch;
        self.kept = Kept::at(&self.frame);
        let began = self.world().time();
        let length = (spot.time - began).max(f64::MIN_POSITIVE);
        loop {
            if !goes_on(((self.world().time() - began) / length).clamp(0.0, 1.0)) {
                (self.branch, self.kept, self.frame) = from;
                return Err(GivenUp);
            }
            let is_wanted = self.frame.place < spot.place;
            let next = self.tree.entry(self.branch, self.frame.place).map(|entry| entry.at).filter(|_| is_wanted);
            match next {
                Some(at) if self.frame.is_due(at) => self.pass(),
                Some(at) if at <= spot.time => self.step_again(Some(at)),
                // A step that was cut short for what was undone is not: no file knows why.
                _ if self.frame.ends_by(spot.time) => self.step_again(next),
                _ => break,
            }
        }
        self.arrive();
        Ok(())
    }

    /// The last copy at or before a spot becomes the present. Returns what was the present.
    fn frame_before(&mut self, spot: Spot) -> Frame {
        let kept = self.keyframes.before(&self.tree, spot).map(|kept| kept.frame.clone());
        let next = kept.unwrap_or_else(|| self.frame.clone());
        std::mem::replace(&mut self.frame, next)
    }

    /// Does the next command of the log; what could not be done then cannot be done now.
    fn pass(&mut self) {
        if let Some(entry) = self.tree.entry(self.branch, self.frame.place) {
            let _ = self.frame.follow(entry, &self.scene);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::sim::PointId;

    #[test]
    fn what_was_worked_out_anew_is_undone_from_near_by() {
        let text = r#"{"wobble": 1, "gravity": [0, -9.81], "method": {"substep": 0.001}, "points": {"position": [[0, 0], [1, 0], [0, 1]]},
            "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 90}, {"a": 1, "b": 2, "kind": "spring", "stiffness": 90}]}"#;
        let mut history = History::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        (0..4000).for_each(|_| history.step());
        history.give(vec![Do::Pin(vec![PointId(0)])], Some("pin")).unwrap();
        (0..500).for_each(|_| history.step());
        let end = history.world().time();
        let mut again = History::new(history.recording().into()).unwrap();
        again.go_to(end);
        let mut told = Vec::new();
        let undone = again
            .undo_while(|share| {
                told.push(share);
                true
            })
            .unwrap()
            .unwrap();
        assert_eq!(undone.name, "pin");
        assert!(told.len() < 400, "{} steps of 4000", told.len());
        assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
        history.undo().unwrap();
        let places = |history: &History| (0..6).map(|k| history.world().positions().get(k)).collect::<Vec<_>>();
        assert_eq!((again.world().time(), places(&again)), (history.world().time(), places(&history)));
        let redone = again.redo().unwrap();
        assert_eq!(redone.name, "pin");
    }

    /// A scene with an edit each second, that runs for so many.
    fn edited(seconds: usize) -> History {
        let text = r#"{"wobble": 1, "gravity": [0, -9.81], "method": {"substep": 0.001}, "points": {"position": [[0, 0], [1, 0], [0, 1]]},
            "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 90}, {"a": 1, "b": 2, "kind": "spring", "stiffness": 90}]}"#;
        let mut history = History::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        for second in 0..seconds {
            let act = if second % 2 == 0 { Do::Pin } else { Do::Unpin };
            history.give(vec![act(vec![PointId(0)])], Some("pin")).unwrap();
            (0..1000).for_each(|_| history.step());
        }
        history
    }

    /// Goes somewhere as long as it is told to. Returns whether it was given up.
    type Way = fn(&mut History, &mut dyn FnMut(f64) -> bool) -> bool;

    #[test]
    fn what_is_given_up_on_its_way_leaves_all_as_it_was() {
        let mut history = edited(3);
        history.go_to(1.5);
        history.give(vec![Do::Pin(vec![PointId(2)])], Some("other")).unwrap();
        (0..1500).for_each(|_| history.step());
        // Of all copies only that of the start is left.
        history.bound_keyframes(1);
        let seen = |history: &History| {
            let places = (0..6).map(|k| history.world().positions().get(k)).collect::<Vec<_>>();
            (
                history.world().time(),
                places,
                history.undoes(),
                history.redoes(),
                history.branches(),
                history.has_future(),
            )
        };
        let before = seen(&history);
        let ways: [Way; 4] = [
            |history, on| history.undo_while(on).is_err(),
            |history, on| history.go_to_while(2.0, on).is_err(),
            |history, on| history.to_branch_while(0, on).is_err(),
            |history, on| history.go_to_while(3.0, on).is_err(),
        ];
        for (k, way) in ways.iter().enumerate() {
            let mut told = 0.0;
            let is_given_up = way(&mut history, &mut |share| {
                told = share;
                share < 0.4
            });
            assert!(is_given_up && (0.4..0.5).contains(&told), "{k}: {told}");
            assert_eq!(seen(&history), before, "{k}");
            history.bound_keyframes(1);
        }
        let undone = history.undo().unwrap();
        assert_eq!(undone.name, "other");
        let before = seen(&history);
        history.bound_keyframes(1);
        assert_eq!(history.redo_while(|_| false), Err(GivenUp));
        assert_eq!(seen(&history), before);
        assert_eq!(history.redo().unwrap().name, "other", "it is done again all the same");
        history.step();
        assert!(history.world().time() > 1.5 && !history.has_future());
    }
}
