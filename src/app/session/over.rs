//! What lies over the world: sheets and panels, as they are opened, closed and hidden.

use super::Session;
use crate::app::action::Action;
use crate::app::panels::{Cover, Opened, Sheet, is_said, search_id};
use crate::app::thumbnails::Thumbnails;

/// Said as the panels go.
const HIDDEN: &str = "the panels are hidden: Tab brings them back";

impl Session {
    /// Hides the panels and says how they come back, or brings them back.
    pub(super) fn toggle_panels(&mut self) {
        self.panels.hides_panels = !self.panels.hides_panels;
        match self.panels.hides_panels {
            true => self.say(HIDDEN.to_owned()),
            false => self.panels.notes.take_back(|line| line == HIDDEN),
        }
    }

    /// Ends what is under way; else closes the topmost of what lies over the world; it never leaves.
    pub(super) fn cancel(&mut self) {
        // A sheet lies over all else.
        if self.panels.sheet.is_some() {
            return self.close_sheet();
        }
        if self.asked.is_some() {
            return self.answer_by(Action::Cancel);
        }
        if self.player.going().is_some_and(|going| is_said(&going)) {
            return self.player.stay();
        }
        if self.hand.is_drawing() {
            return self.leave_drawing();
        }
        let (was_busy, deed) = self.hand.cancel();
        self.do_deed(deed);
        if was_busy {
            return;
        }
        let is_closed = self.panels.notes.close() || self.loading.take().is_some() || self.stop_opening();
        if is_closed {
            return;
        }
        if self.import.is_some() {
            return self.put_away();
        }
        // In a field of a panel Esc gives up what is written: at once, so that the next one closes whatever came between.
        match self.is_writing() && !self.is_searching_settings() {
            true => self.leave_field(),
            // A clip lies over nothing: it is drawn while all goes on.
            false => _ = self.close_panel() || self.give_up_clip(),
        }
    }

    /// Closes the panel that was opened last. Returns whether there was one.
    fn close_panel(&mut self) -> bool {
        self.panels.has_selection = self.with_scope(|hand, scope| hand.chosen(scope)).is_some();
        match self.panels.opened_last() {
            Some(Opened::Settings) => self.close_settings(),
            Some(Opened::Selection) => self.hand.deselect(),
            Some(Opened::Plots) => self.toggle_plots(),
            Some(Opened::Lessons) => self.toggle_lessons(),
            Some(Opened::Tool) | None => return false,
        }
        true
    }

    /// A search that is filled is not there when they open again: it would hide the most.
    pub(super) fn close_settings(&mut self) {
        self.panels.has_settings = false;
        self.panels.settings_search.clear();
        self.leave_field();
    }

    pub(super) fn toggle_sheet(&mut self, sheet: Sheet) {
        self.panels.sheet = (self.panels.sheet != Some(sheet)).then_some(sheet);
        self.panels.is_fresh = true;
        self.panels.keys_search.clear();
        if self.panels.sheet == Some(Sheet::Gallery) {
            // What is typed from now on is looked for, and what lay over the world is put away with it.
            self.panels.search.clear();
            self.egui.egui_ctx().memory_mut(|memory| memory.request_focus(search_id()));
            self.put_away();
        }
        self.panels.chosen = if self.panels.search.is_empty() { self.place.unwrap_or(0) } else { 0 };
        if self.panels.sheet == Some(Sheet::Gallery) {
            self.draw_leftovers();
        }
        if self.panels.sheet == Some(Sheet::Gallery) && self.thumbnails.is_none() {
            let folder = self.state_folder.as_ref().map(|folder| folder.join("thumbnails"));
            self.thumbnails = Some(Thumbnails::new(self.canvas.gpu().clone(), self.palette, folder, self.wake_up()));
        }
    }

    /// What lies over the world: what is said now is of that.
    pub(super) fn lies_over(&self) -> Cover {
        Cover::of(self.panels.sheet, self.import.is_some())
    }
}
