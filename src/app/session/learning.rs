//! Lessons: a step opens its scene, and lays out what it asks for.

use super::Session;
use crate::app::action::Showing;
use crate::app::panels::{At, Met, Opened, Room};
use crate::lessons::{Show, lessons};

impl Session {
    /// Goes to a step of a lesson: its scene opens in place of what is open, which can be gone back to.
    pub(super) fn learn(&mut self, at: At) {
        let scene = lessons().get(at.lesson).and_then(|lesson| lesson.scene(at.step));
        match scene {
            Some(Ok(scene)) => {
                self.panels.lessons.enter(at);
                self.open_for(scene.into(), Some(at));
            }
            Some(Err(error)) => self.complain(&error.to_string()),
            None => {}
        }
    }

    /// Opens the lessons, or closes them with the plots that a step opened.
    pub(super) fn toggle_lessons(&mut self) {
        self.panels.toggle_lessons();
        if self.panels.lessons.is_open && self.panels.plots.is_none() {
            self.panels.lessons.open_at().into_iter().for_each(|at| self.lay_out(at));
        } else if !self.panels.lessons.is_open
            && std::mem::take(&mut self.panels.lessons.plots)
            && self.panels.plots.is_some()
        {
            self.forget_plots();
        }
    }

    /// A scene is there that no step asked for: a lesson whose scene it is not closes, and one that was left comes back with its own.
    pub(super) fn leave_lesson(&mut self) {
        let met = self.panels.lessons.meet(&self.scene);
        // What a step shows goes with its scene, whether its words were still open or not.
        if self.panels.lessons.open_at().is_none() {
            let before = self.panels.lessons.show_no_more(self.showing());
            before.into_iter().for_each(|showing| self.show_as(showing));
        }
        match met {
            Met::Left { had_plots } if had_plots && self.panels.plots.is_some() => self.forget_plots(),
            Met::Back(at) => self.lay_out(at),
            Met::Left { .. } | Met::Nothing => {}
        }
        self.taught = self.panels.lessons.open_at();
    }

    /// The scene of a step is there: it is shown as the step wants it. The lesson's words stand in place of the caption.
    pub(super) fn lay_out(&mut self, at: At) {
        let Some(step) = lessons().get(at.lesson).and_then(|lesson| lesson.steps.get(at.step)) else { return };
        self.panels.notes.has_caption = false;
        let showing = match step.show {
            None => Showing::Bodies,
            Some(Show::Strain) => Showing::Strain,
            Some(Show::Bonds) => Showing::Bonds,
        };
        self.panels.lessons.show_as(showing, self.showing());
        self.show_as(showing);
        let had = self.panels.plots.is_some();
        match &step.plot {
            Some(plot) => {
                self.panels.lessons.plots |= !had;
                self.plot_as(plot);
                // Where there is no room for both, words come before curves.
                if !had && self.panels.room == Room::One {
                    self.panels.bring(Opened::Lessons);
                }
            }
            // What an earlier step opened would lie over this one's scene.
            None if std::mem::take(&mut self.panels.lessons.plots) && had => self.forget_plots(),
            None => {}
        }
    }
}
