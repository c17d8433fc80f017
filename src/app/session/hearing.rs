//! What the stepping thread has to tell: what is new, and what became of orders.

use std::path::Path;
use std::sync::Arc;

use super::Session;
use crate::app::panels::{Saved, Sheet, is_recording};
use crate::app::player::{News, Note};
use crate::app::recent::Used;
use crate::history::GoneBack;

impl Session {
    /// Takes what the player has to tell.
    pub(super) fn hear(&mut self, news: News) {
        if let Some(scene) = news.opened {
            self.arrive(scene);
        }
        if news.is_new {
            self.dirty = true;
            if self.wants_hint {
                // What lies under the pointer may have gone.
                self.place_hint();
            }
            self.find_hinge();
            self.whereabouts.note(self.player.shown());
            self.meet_neighbors();
            self.find_misfits();
            self.panels_dirty |= self.panels.has_settings && self.shown().settings != self.settings;
            self.panels_dirty |= self.shown().matter != self.matter;
            // What is hidden is counted there.
            let tints = Arc::clone(&self.shown().scenery.tints);
            self.panels_dirty |= !Arc::ptr_eq(&tints, &std::mem::replace(&mut self.tints, Arc::clone(&tints)));
            self.gone_by.take_if(|serial| *serial <= self.player.shown().serial);
            self.plot();
            if self.base != self.shown().base {
                self.take_base();
            }
        }
        if let Some(failure) = news.failure {
            self.teaches = None;
            // What was there before is there again.
            match self.shelf.back() {
                Some(left) => {
                    self.bring_back(left);
                    self.complain(&failure.to_string());
                }
                None => self.failure = Some(failure),
            }
        }
        for note in news.notes {
            self.note(note);
        }
    }

    /// The hover force comes back after a grab as scene and log have it.
    pub(super) fn take_base(&mut self) {
        self.base = self.shown().base;
        self.hand.set_strength(self.base);
    }

    /// Something became of what was asked.
    pub(super) fn note(&mut self, note: Note) {
        match note {
            Note::Undone(name, seconds) => {
                let left = &self.player.shown().scenery.warnings;
                self.panels.notes.take_back(|line| left.iter().any(|other| other == line));
                self.have_gone(format!("Undid: {name}{}", with_what_followed(seconds)));
            }
            Note::Redone(name, seconds) => self.have_gone(format!("Redid: {name}{}", far(seconds))),
            Note::GoneBack(edits) => self.say(gone_back(edits)),
            Note::Discarded(called) => {
                self.say(format!("the timeline \"{called}\" is not listed any more: Ctrl+Z brings it back"));
            }
            Note::GivenUp => {
                self.gone_by = None;
                self.say("given up: it is as it was".to_owned());
            }
            Note::NothingToUndo => self.go_back(),
            Note::NothingToRedo => self.go_on(),
            Note::Branched => self.say(
                "from here on it is a new timeline: the list in the bar below leads back to the one before".to_owned(),
            ),
            Note::Added(None) => {
                self.adding = None;
                self.say("it is in the scene: Ctrl+Z takes it away again".to_owned());
            }
            Note::Added(Some(why)) => {
                self.adding = None;
                self.panels.notes.warn(format!("it is in the scene, but bodies pass through each other: {why}"));
            }
            Note::Came(came, said, why) => self.have_come(came, said, why),
            Note::Before(list) => self.plot_before(list),
            Note::Exact => {
                self.say("every body is moved by its own method from here on: Ctrl+Z takes that back".to_owned());
            }
            Note::Begins(start) => self.begin_from_here(*start),
            Note::Held => self.say(HELD_HERE.to_owned()),
            Note::Refused(why) => {
                self.import = self.adding.take().or_else(|| self.import.take());
                self.refuse(&why);
            }
            Note::Warned(lines) => lines.into_iter().for_each(|line| self.panels.notes.warn(line)),
            Note::Written(path) => self.have_written(&path),
            Note::NotWritten(why) => self.have_not_written(&why),
            Note::NotKept(why) => self.panels.notes.tell(format!(
                "what you do here would be lost if the program were killed, until this can be written again: {why}"
            )),
        }
        self.touch();
    }

    /// A file was written: a name that was asked for it is asked no longer.
    fn have_written(&mut self, path: &Path) {
        self.say(format!("written: {}", path.display()));
        if self.panels.save_to.is_written(path) {
            self.panels.sheet.take_if(|sheet| *sheet == Sheet::SaveTo);
            if self.panels.save_to.kind == Saved::Moment {
                self.player.lie_in(path);
            }
        }
        if is_recording(path) {
            self.remember(path, Used::Saved);
            self.have_saved(true);
            self.player.call(path);
        }
    }

    /// A file could not be written: where its name is asked for that can be mended.
    fn have_not_written(&mut self, why: &str) {
        let is_asked = self.panels.save_to.failed(why) && self.panels.sheet == Some(Sheet::SaveTo);
        self.panels.is_fresh |= is_asked;
        self.have_saved(false);
        if !is_asked {
            self.complain(why);
        }
    }

    /// The world went to another time.
    pub(super) fn have_gone(&mut self, line: String) {
        self.hand.drop_all();
        self.driving.clear();
        self.say(line);
    }
}

/// Said of a press on what pins hold.
const HELD_HERE: &str = "held by pins: point at a pin (a red ring) and press T to let it go, or drag the pin itself";

/// What became of edits as the start was gone to.
fn gone_back(GoneBack { left, kept, is_built }: GoneBack) -> String {
    let to = if is_built { "where the last thing was built" } else { "the start" };
    let with = if kept > 0 { ", with what you set since" } else { "" };
    match left {
        0 => format!("Back to {to}{with}"),
        1 => format!("Back to {to}{with}: Ctrl+Z brings back the edit that was made later"),
        edits => format!("Back to {to}{with}: Ctrl+Z brings back the {edits} edits that were made later"),
    }
}

/// How far time went, as one says it; below 0 back `[s]`.
fn far(seconds: f64) -> String {
    match seconds {
        some if some.abs() < 0.05 => String::new(),
        back if back < 0.0 => format!(" ({:.1} s back)", -back),
        on => format!(" ({on:.1} s on)"),
    }
}

/// What an edit is undone together with: all that happened since, which took so long, below 0 `[s]`.
fn with_what_followed(seconds: f64) -> String {
    if seconds <= -0.05 { format!(" (with what happened since: {:.1} s)", -seconds) } else { far(seconds) }
}

#[cfg(test)]
mod tests {
    use super::{far, gone_back, with_what_followed};
    use crate::history::GoneBack;

    #[test]
    fn what_the_start_takes_back_and_what_it_keeps_is_said() {
        let words = [(0, 2), (1, 0), (3, 1)].map(|(left, kept)| gone_back(GoneBack { left, kept, is_built: false }));
        assert_eq!(words[0], "Back to the start, with what you set since");
        assert_eq!(words[1], "Back to the start: Ctrl+Z brings back the edit that was made later");
        assert!(words[2].starts_with("Back to the start, with what you set since: Ctrl+Z brings back the 3 edits"));
        let built = gone_back(GoneBack { is_built: true, ..GoneBack::default() });
        assert_eq!(built, "Back to where the last thing was built");
    }

    #[test]
    fn how_far_time_went_is_said_with_its_direction() {
        assert_eq!([-33.1, 33.1, 0.0].map(far), [" (33.1 s back)", " (33.1 s on)", ""]);
        assert_eq!([-15.3, -0.01].map(with_what_followed), [" (with what happened since: 15.3 s)", ""]);
    }
}
