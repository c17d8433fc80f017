//! What is said of what was done, and of what was not.

use super::Session;

impl Session {
    /// Says what was just done.
    pub(super) fn say(&mut self, line: String) {
        let over = self.lies_over();
        self.panels.notes.say(line, over);
        self.touch();
    }

    /// Says why something was not done, until something else is tried.
    pub(super) fn refuse(&mut self, line: &str) {
        self.panels.notes.refuse(line.to_owned(), self.lies_over());
        self.touch();
    }

    /// Says what went wrong, until it is read.
    pub(super) fn complain(&mut self, line: &str) {
        self.panels.notes.complain(line.to_owned(), self.lies_over());
        self.touch();
    }
}
