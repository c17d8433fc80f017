//! What a session draws: the world, with what tools mark in it, and the panels over it.

use std::sync::Arc;

use super::begun::panels_for;
use super::trails::AllTrails;
use super::{Framing, Session};
use crate::app::action::Tool;
use crate::app::canvas::{Canvas, Paint};
use crate::app::panels;
use crate::render::{Look, RenderError, View};
use crate::sim::{Cursor, MouseForce};

impl Session {
    /// Draws the world and the panels.
    pub(super) fn draw(&mut self) -> Result<(), RenderError> {
        self.look_for_the_lost();
        let (mut marks, words, labels) = self.marks();
        self.labels_at = labels;
        // What is written for the first time has its signs on the GPU with the panels: they are shown once more, so that none is missing.
        if self.marked_words != words {
            self.marked_words = words;
            self.show_panels();
            marks = self.marks().0;
            self.dirty = true;
        }
        self.paint.marks = marks;
        self.note_trails();
        let region = self.region();
        let empty = crate::app::player::Shown { dimensions: self.canvas.dimensions(), ..Default::default() };
        let shown = if self.player.is_open() { self.player.shown() } else { &empty };
        let view = View { mouse: region.as_ref().map(|(force, at)| (force, *at)), ..shown.view() };
        let force = view.mouse;
        let view = View { covered: &self.covered, ..view };
        let inset = if self.panels.hides_panels { 0.0 } else { panels::TOOLS };
        let look = Look { inset, ..self.look };
        let beside = (&shown.beside[..], AllTrails(&self.trails, &self.beside_trails));
        let panes = self.panes(view, beside, (force, &self.camera, look), self.area);
        let done = self.canvas.draw(&panes, self.area, &mut self.paint);
        match done {
            Err(RenderError::Lost { .. }) => self.reopen(),
            done => done,
        }
    }

    /// The region of the hover force: where the pointer is now, however long a step takes.
    pub(super) fn region(&self) -> Option<(MouseForce, Cursor)> {
        if self.is_covered() || self.hand.is_carrying() {
            return None;
        }
        match self.live_force() {
            // It is the hand's alone.
            Some(_) if self.hand.tool() != Tool::Hand && !self.shown().figures.follows => None,
            // Paused, the world has not heard yet of what other tools put away and the hand takes up again.
            Some(force) if !self.player.is_playing() && !self.hand.is_busy() && !self.shown().figures.follows => {
                let strength = self.hand.strength().filter(|_| self.hand.tool() == Tool::Hand)?;
                self.world_cursor().map(|at| (MouseForce { strength, ..force.clone() }, at))
            }
            _ if self.hand.is_calm() => None,
            // What is done again has the cursor of its own.
            Some(force) if self.shown().figures.follows => self.shown().cursor.map(|at| (force.clone(), at)),
            Some(force) => self.world_cursor().map(|at| (force.clone(), at)),
            None => self.shown().mouse.clone().zip(self.shown().cursor),
        }
    }

    /// The GPU was lost (a driver's update, a card pulled out): opens what there is now. The world is not touched.
    fn reopen(&mut self) -> Result<(), RenderError> {
        self.canvas = Canvas::new(Arc::clone(&self.window), self.display.clone(), self.scene.dimensions())?;
        // The panels' textures went with the GPU: a fresh context sends them again.
        self.egui = panels_for(&self.window, &self.canvas, self.palette);
        self.paint = Paint::default();
        self.forget_thumbnails();
        self.framing = if self.framing == Framing::Free { Framing::Free } else { Framing::Opening };
        self.touch();
        Ok(())
    }
}
