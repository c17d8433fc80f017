//! The window is to be closed: what becomes of work that was not saved is asked first.

use std::time::{Duration, Instant};

use super::Session;
use super::asking::Asked;
use crate::app::count::counted;
use crate::app::panels::{Question, Sheet};

/// How far the program is with leaving.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Leaving {
    /// Nobody wants that.
    #[default]
    Not,
    /// Once a file has been named, and is written.
    Naming,
    /// Once the file is written.
    Writing,
    /// Once the clip is written.
    Filming,
    /// As soon as may be.
    Now,
}

/// How long a question stands at least before a key that is pressed once more throws work away: keys are struck twice by mistake.
const READ: Duration = Duration::from_secs(1);

/// The answers, the first by Enter, the last by Esc.
const ANSWERS: &[(&str, &str)] = &[("Save", "Enter"), ("Don't save", "Ctrl+Q once more"), ("Cancel", "Esc")];
/// The same where there is work in other scenes too.
const HERE_AND_ELSEWHERE: &[(&str, &str)] = &[
    ("Save", "Enter"),
    ("Don't save", "Ctrl+Q once more"),
    ("Go to the next", "to another scene that is not saved, and stay"),
    ("Cancel", "Esc"),
];
/// The same where the scene that is open has nothing to save.
const ELSEWHERE: &[(&str, &str)] = &[("Go there", "Enter"), ("Don't save", "Ctrl+Q once more"), ("Cancel", "Esc")];
/// The same where there is nothing to save, but a clip is being written.
const CLIP: &[(&str, &str)] = &[("Wait for it", "Enter"), ("Don't wait", "Ctrl+Q once more"), ("Cancel", "Esc")];
/// Said while it is waited for.
const WAITS: &str = "the window closes once the clip is written";

/// So many scenes that were not saved are named at most.
const MOST_NAMED: usize = 4;

/// What is asked where the scene that is open has work in it that was not saved, and others, of these names, that were left for it, or where
/// a clip is being written; `None`: nothing.
fn question(title: &str, (has_work, films): (bool, bool), left: &[&str]) -> Option<String> {
    let others = counted(left.len(), "other scene");
    let names = named(left);
    let clip = match (films, has_work) {
        (false, _) => "",
        (true, true) => " A clip is being written too: it is lost unless you save.",
        (true, false) => " A clip is being written too, which would be lost.",
    };
    let words = match (has_work, left.len()) {
        (false, 0) => return films.then(|| "A clip is being written: it would be lost.".to_owned()),
        (true, 0) => format!("{title}: save what you did?"),
        (true, _) => format!("{title}: save what you did? {others} that you worked on will not be saved: {names}."),
        (false, count) => {
            let was = if count == 1 { "was" } else { "were" };
            format!("{others} that you worked on {was} not saved: {names}.")
        }
    };
    Some(words + clip)
}

/// Whether more would be lost than was told of as it was asked: work in the scene that is open, or in other scenes, of these names.
fn is_more(has_work: bool, left: &[&str], told_of: &[String]) -> bool {
    let count = |name: &str| left.iter().filter(|other| **other == name).count();
    let told = |name: &str| told_of.iter().filter(|other| **other == name).count();
    has_work || left.iter().any(|name| count(name) > told(name))
}

/// The first few of some names, those that are the same counted, and how many there are more.
fn named(all: &[&str]) -> String {
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for &name in all {
        match kinds.iter_mut().find(|(other, _)| *other == name) {
            Some((_, count)) => *count += 1,
            None => kinds.push((name, 1)),
        }
    }
    let more: usize = kinds.iter().skip(MOST_NAMED).map(|(_, count)| count).sum();
    let said =
        |&(name, count): &(&str, usize)| if count == 1 { name.to_owned() } else { format!("{name} ({count} times)") };
    let first = kinds.iter().take(MOST_NAMED).map(said);
    first.chain((more > 0).then(|| format!("{more} more"))).collect::<Vec<_>>().join(", ")
}

impl Session {
    /// Somebody wants to leave; `insists`: whatever is asked already, if there was time to read it. Returns whether that may be at once: else it is asked what becomes of
    /// what was not saved, and of a clip that is being written.
    pub(in crate::app) fn may_leave(&mut self, insists: bool) -> bool {
        self.hear_of_clip();
        if let Some(since) = self.asked.as_ref().and_then(|asked| asked.leaving_since) {
            return insists && since.elapsed() >= READ;
        }
        let has_work = self.player.is_unsaved();
        let others = self.shelf.unsaved();
        let films = self.filming.is_some();
        let Some(words) = question(&self.title(), (has_work, films), &others) else { return true };
        let has_others = !others.is_empty();
        self.told_of = others.iter().map(|&name| name.to_owned()).collect();
        // A sheet would lie over the question.
        self.close_sheet();
        let answered = move |session: &mut Session, answer: usize| match answer {
            0 if !has_work && has_others => session.go_to_unsaved(),
            0 if !has_work => session.leave_once_filmed(),
            0 => {
                session.leaving = Leaving::Naming;
                session.save();
            }
            1 => session.leaving = Leaving::Now,
            2 if has_work && has_others => session.go_to_unsaved(),
            _ => {}
        };
        let answers = match (has_work, has_others) {
            (true, true) => HERE_AND_ELSEWHERE,
            (true, false) => ANSWERS,
            (false, true) => ELSEWHERE,
            (false, false) => CLIP,
        };
        let question = Question { words, answers };
        // What was answered before is asked anew.
        self.leaving = Leaving::Not;
        self.asked = Some(Asked { question, leaving_since: Some(Instant::now()), act: Box::new(answered) });
        self.touch();
        false
    }

    /// Whether the program leaves now.
    pub(in crate::app) fn leaves(&self) -> bool {
        self.leaving == Leaving::Now
    }

    /// A file was named for what is saved.
    pub(super) fn leave_once_written(&mut self) {
        if self.leaving == Leaving::Naming {
            self.leaving = Leaving::Writing;
        }
    }

    /// A file was written with all that was done or with this moment, or could not be.
    pub(super) fn have_saved(&mut self, is_written: bool) {
        if is_written {
            self.player.note_saved();
        }
        if self.leaving == Leaving::Writing {
            match is_written {
                true => self.leave_once_filmed(),
                // Another name may do.
                false if self.panels.sheet == Some(Sheet::SaveTo) => self.leaving = Leaving::Naming,
                false => self.leaving = Leaving::Not,
            }
        }
    }

    /// Nothing but a clip is waited for.
    fn leave_once_filmed(&mut self) {
        self.leaving = Leaving::Now;
        if self.filming.is_some() {
            self.leaving = Leaving::Filming;
            self.say(WAITS.to_owned());
        }
    }

    /// A clip was written, or there is none.
    pub(super) fn have_filmed(&mut self, is_written: bool) {
        if self.leaving == Leaving::Filming {
            self.leaving = Leaving::Not;
            // Meanwhile more may have been done, which is asked about.
            let is_answered = !is_more(self.player.is_unsaved(), &self.shelf.unsaved(), &self.told_of);
            if is_written && (is_answered || self.may_leave(false)) {
                self.leaving = Leaving::Now;
            }
        }
    }

    /// Whoever closes what asks for a name stays.
    pub(super) fn stay_without_name(&mut self) {
        if self.leaving == Leaving::Naming && self.panels.sheet != Some(Sheet::SaveTo) && self.saving.is_none() {
            self.leaving = Leaving::Not;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{is_more, named, question};

    #[test]
    fn work_that_was_not_saved_is_asked_about() {
        assert_eq!(question("jelly", (false, false), &[]), None);
        assert_eq!(question("jelly", (true, false), &[]).as_deref(), Some("jelly: save what you did?"));
        let words = question("jelly", (true, false), &["Rope", "Net"]).unwrap_or_default();
        assert!(words.ends_with("2 other scenes that you worked on will not be saved: Rope, Net."), "{words}");
        let words = question("jelly", (false, false), &["Rope"]).unwrap_or_default();
        assert_eq!(words, "1 other scene that you worked on was not saved: Rope.");
    }

    #[test]
    fn a_clip_that_is_being_written_is_asked_about() {
        let alone = question("jelly", (false, true), &[]).unwrap_or_default();
        assert_eq!(alone, "A clip is being written: it would be lost.");
        let words = question("jelly", (true, true), &[]).unwrap_or_default();
        assert!(words.starts_with("jelly: save what you did? A clip is being written too"), "{words}");
        let words = question("jelly", (false, true), &["Rope"]).unwrap_or_default();
        assert!(words.ends_with("Rope. A clip is being written too, which would be lost."), "{words}");
    }

    #[test]
    fn what_was_told_of_already_is_not_asked_about_once_a_clip_is_written() {
        let told = ["Rope".to_owned(), "Net".to_owned()];
        assert!(!is_more(false, &["Net", "Rope"], &told) && !is_more(false, &["Rope"], &told));
        assert!(is_more(true, &["Rope", "Net"], &told), "something was done since");
        assert!(is_more(false, &["Rope", "Jelly"], &told) && is_more(false, &["Rope", "Rope"], &told));
        assert!(!is_more(false, &[], &[]) && is_more(false, &["Rope"], &[]));
    }

    #[test]
    fn of_many_scenes_the_first_few_are_named() {
        assert_eq!(named(&["Rope", "Net", "Rope"]), "Rope (2 times), Net");
        assert_eq!(named(&["a", "b", "c", "d", "e", "f", "f"]), "a, b, c, d, 3 more");
    }
}
