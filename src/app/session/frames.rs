//! What a frame does, and when there is to be one.

use std::time::Instant;

use super::{FIGURES_EVERY, FIRST_FRAME, Session};
use crate::app::panels::Sheet;
use crate::app::player::Order;
use crate::render::RenderError;

impl Session {
    /// Whether another frame is needed: something moves or has changed.
    pub(in crate::app) fn wants_frame(&self) -> bool {
        self.dirty || self.panels_dirty || self.moves()
    }

    /// Whether time goes on: the world waits while a picture is being imported, which takes its place on the screen.
    pub(super) fn moves(&self) -> bool {
        let fades = self.hand.is_fading() && self.player.is_playing();
        !self.waits()
            && (self.player.is_moving() || self.rewinds || fades || self.hand.is_leading() || self.hand.is_hauling())
    }

    /// Whether the world waits for what lies over it: what is saved is the moment at which it was asked for.
    pub(super) fn waits(&self) -> bool {
        self.import.is_some() || self.asked.is_some() || self.panels.sheet.is_some_and(Sheet::stops_time)
    }

    /// Time ran on since the last frame: asks for it, once a frame.
    pub(super) fn advance(&mut self, start: Instant) {
        let is_asked = self.player.is_playing() || self.rewinds || self.shown().figures.behind;
        let way = self.way_of_cursor();
        let cursor = self.led_to(way);
        match is_asked {
            true => self.resting.tell(self.pointer.at, way),
            false => self.resting.stand(),
        }
        let is_new = cursor != self.told && self.player.is_open();
        if self.waits() || !is_asked || !(self.moves() || is_new) {
            self.last_frame = None;
            return;
        }
        let wall = self.last_frame.replace(start).map_or(FIRST_FRAME, |last| (start - last).as_secs_f64());
        self.frame_meter.push(wall);
        self.tell_press();
        if !self.is_led() {
            let deed = self.hand.pass(wall);
            self.do_deed(deed);
        }
        self.lead(wall);
        if way.jumps && self.told.is_some() {
            self.player.ask(Order::Jump);
        }
        self.told = cursor;
        self.player.advance(wall, cursor, self.rewinds);
    }

    /// One frame: the time that passed, the panels if they changed, the picture. Draws nothing if nothing has changed.
    ///
    /// Errors: a GPU that gave up and cannot be had again.
    pub(in crate::app) fn frame(&mut self) -> Result<(), RenderError> {
        let start = Instant::now();
        if self.panels_due().is_some_and(|due| due <= start) {
            (self.panels_dirty, self.panels_due) = (true, None);
        }
        if !self.wants_frame() {
            return Ok(());
        }
        self.stay_without_name();
        if !self.hand.is_busy() {
            self.hand.stand_still(!self.player.is_playing());
        }
        self.advance(start);
        self.inspect();
        self.dirty = false;
        let is_time = self.panels_at.is_none_or(|at| at.elapsed() >= FIGURES_EVERY);
        if self.panels_dirty || is_time {
            self.show_panels();
        }
        let news = self.player.poll_patiently();
        self.hear(news);
        self.follow_driven();
        self.look_for_stalls();
        // What was heard is drawn now; what moves on is drawn in the next frame anyway.
        self.dirty &= self.panels_dirty;
        self.draw()?;
        self.frames += 1;
        if !self.moves() {
            self.last_frame = None;
            // The last figures are those of the rest.
            if self.shown().figures != self.figures {
                self.panels_due.get_or_insert(start + FIGURES_EVERY);
            }
        }
        Ok(())
    }

    /// Nothing is seen: no time passes meanwhile.
    pub(in crate::app) fn rest(&mut self) {
        self.last_frame = None;
    }

    /// When the panels want a frame by themselves.
    pub(in crate::app) fn panels_due(&self) -> Option<Instant> {
        [self.panels_due, self.panels.notes.until()].into_iter().flatten().min()
    }
}
