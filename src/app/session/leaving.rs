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

/// So many scenes that were not saved are named at most.
const MOST_NAMED: usize = 4;

/// What is asked where the scene that is open has work in it that was not saved, and others, of these names, that were left for it; `None`:
/// nothing.
fn question(title: &str, has_work: bool, left: &[&str]) -> Option<String> {
    let others = counted(left.len(), "other scene");
    let names = named(left);
    match (has_work, left.len()) {
        (false, 0) => None,
        (true, 0) => Some(format!("{title}: save what you did?")),
        (true, _) => {
            Some(format!("{title}: save what you did? {others} that you worked on will not be saved: {names}."))
        }
        (false, count) => {
            let was = if count == 1 { "was" } else { "were" };
            Some(format!("{others} that you worked on {was} not saved: {names}."))
        }
    }
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
    /// what was not saved.
    pub(in crate::app) fn may_leave(&mut self, insists: bool) -> bool {
        if let Some(since) = self.asked.as_ref().and_then(|asked| asked.leaving_since) {
            return insists && since.elapsed() >= READ;
        }
        let has_work = self.player.is_unsaved();
        let others = self.shelf.unsaved();
        let Some(words) = question(&self.title(), has_work, &others) else { return true };
        let has_others = !others.is_empty();
        // A sheet would lie over the question.
        self.close_sheet();
        let answered = move |session: &mut Session, answer: usize| match answer {
            0 if !has_work => session.go_to_unsaved(),
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
            (false, _) => ELSEWHERE,
        };
        let question = Question { words, answers };
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
            self.leaving = match is_written {
                true => Leaving::Now,
                // Another name may do.
                false if self.panels.sheet == Some(Sheet::SaveTo) => Leaving::Naming,
                false => Leaving::Not,
            };
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
    use super::{named, question};

    #[test]
    fn work_that_was_not_saved_is_asked_about() {
        assert_eq!(question("jelly", false, &[]), None);
        assert_eq!(question("jelly", true, &[]).as_deref(), Some("jelly: save what you did?"));
        let words = question("jelly", true, &["Rope", "Net"]).unwrap_or_default();
        assert!(words.ends_with("2 other scenes that you worked on will not be saved: Rope, Net."), "{words}");
        let words = question("jelly", false, &["Rope"]).unwrap_or_default();
        assert_eq!(words, "1 other scene that you worked on was not saved: Rope.");
    }

    #[test]
    fn of_many_scenes_the_first_few_are_named() {
        assert_eq!(named(&["Rope", "Net", "Rope"]), "Rope (2 times), Net");
        assert_eq!(named(&["a", "b", "c", "d", "e", "f", "f"]), "a, b, c, d, 3 more");
    }
}
