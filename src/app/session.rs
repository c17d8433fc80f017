//! An open scene in a window: what its frames do.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

use super::canvas::{Canvas, Paint};
use super::input::{Action, Pointer};
use super::meter::Meter;
use super::opening;
use super::panels::{self, Figures};
use super::player::Player;
use crate::render::{Camera, Look, RenderCounters, RenderError, View};
use crate::scene::Scene;
use crate::sim::Command;

/// The scene, its player and its window.
pub(super) struct Session {
    pub(super) window: Arc<Window>,
    pub(super) panels: egui_winit::State,
    display: OwnedDisplayHandle,
    canvas: Canvas,
    player: Player,
    scene: Scene,
    pub(super) camera: Camera,
    /// Width and height of the part of the window that the world is drawn in [px].
    area: [u32; 2],
    pub(super) pointer: Pointer,
    look: Look,
    /// Something that is shown has changed since the last frame.
    dirty: bool,
    /// When the panels want to be shown again by themselves.
    panels_due: Option<Instant>,
    /// When the last frame began, if time has passed in the world since.
    last_frame: Option<Instant>,
    frame_meter: Meter,
    step_meter: Meter,
    pace_meter: Meter,
    frames: u64,
    /// Strokes and dots of the last picture.
    drawn: u64,
}

impl Session {
    /// Opens `scene` in `window`.
    ///
    /// Errors: no GPU that can draw to the window.
    pub(super) fn new(
        window: Arc<Window>,
        display: OwnedDisplayHandle,
        scene: Scene,
        player: Player,
    ) -> Result<Self, RenderError> {
        let canvas = Canvas::new(Arc::clone(&window), display.clone(), scene.dimensions())?;
        let size = canvas.size();
        let context = egui::Context::default();
        context.set_visuals(egui::Visuals::dark());
        let scale = window.scale_factor() as f32;
        let side = canvas.largest_side() as usize;
        let panels = egui_winit::State::new(context, egui::ViewportId::ROOT, &*window, Some(scale), None, Some(side));
        Ok(Session {
            camera: opening::camera(&scene, player.world(), size),
            area: size,
            look: Look { scale_factor: scale, ..Look::default() },
            window,
            panels,
            display,
            canvas,
            player,
            scene,
            pointer: Pointer::default(),
            dirty: true,
            panels_due: None,
            last_frame: None,
            frame_meter: Meter::default(),
            step_meter: Meter::default(),
            pace_meter: Meter::default(),
            frames: 0,
            drawn: 0,
        })
    }

    /// Whether another frame is needed: something moves or has changed.
    pub(super) fn wants_frame(&self) -> bool {
        self.dirty || self.player.is_moving()
    }

    /// When the panels want a frame by themselves.
    pub(super) fn panels_due(&self) -> Option<Instant> {
        self.panels_due
    }

    /// Something that is shown has changed.
    pub(super) fn touch(&mut self) {
        self.dirty = true;
    }

    pub(super) fn resize(&mut self, size: [u32; 2]) {
        self.canvas.resize(size);
        self.touch();
    }

    pub(super) fn rescale(&mut self, scale_factor: f64) {
        self.look.scale_factor = scale_factor as f32;
        self.touch();
    }

    /// Tells the world where the cursor is: nowhere while it is over a panel, drags the camera or has left.
    pub(super) fn move_cursor(&mut self) {
        if self.scene.mouse.is_none() {
            return;
        }
        let is_free = !self.pointer.is_dragging() && !self.panels.egui_ctx().is_pointer_over_egui();
        // A window that gets the focus is told of a pointer that may be anywhere.
        let [width, height] = self.area.map(f64::from);
        let is_inside = |at: &[f64; 2]| (0.0..width).contains(&at[0]) && (0.0..height).contains(&at[1]);
        let cursor = self.pointer.at.filter(is_inside).filter(|_| is_free).map(|at| self.camera.cursor(at));
        let shown = self.player.world().mouse().map(|(_, cursor)| cursor);
        if cursor != shown {
            self.player.apply(Command::MoveCursor(cursor));
            self.touch();
        }
    }

    /// Does what the user asks; leaving is the window's affair.
    pub(super) fn act(&mut self, action: Action) {
        match action {
            Action::TogglePlay => self.player.toggle(),
            Action::Step => self.player.step(),
            Action::Reset => self.player.reset(),
            Action::Fit => self.camera = opening::fit(self.player.world(), false, self.area),
            Action::Home => self.camera = opening::camera(&self.scene, self.player.world(), self.area),
            Action::Quit => return,
        }
        self.touch();
        self.move_cursor();
    }

    /// One frame: the substeps that are due, the panels, the picture. Draws nothing if nothing has changed.
    ///
    /// Errors: a GPU that gave up and cannot be had again.
    pub(super) fn frame(&mut self) -> Result<(), RenderError> {
        let start = Instant::now();
        if self.panels_due.is_some_and(|due| due <= start) {
            self.dirty = true;
            self.panels_due = None;
        }
        if !self.wants_frame() {
            return Ok(());
        }
        self.advance(start);
        self.dirty = false;
        let (actions, paint) = self.show_panels();
        for action in actions {
            self.act(action);
        }
        self.draw(paint)?;
        self.frames += 1;
        if !self.player.is_moving() {
            self.last_frame = None;
        }
        Ok(())
    }

    /// Lets the world's time pass. A world that did not move since the last frame does not make up for the pause.
    fn advance(&mut self, start: Instant) {
        if !self.player.is_moving() {
            self.last_frame = None;
            return;
        }
        let wall = self.last_frame.replace(start).map_or(0.0, |last| (start - last).as_secs_f64());
        let before = self.player.world().time();
        self.player.advance(wall, || start.elapsed().as_secs_f64());
        self.step_meter.push(start.elapsed().as_secs_f64());
        if wall > 0.0 {
            self.frame_meter.push(wall);
            self.pace_meter.push((self.player.world().time() - before) / (wall * self.player.rate()));
        }
    }

    fn show_panels(&mut self) -> (Vec<Action>, Paint) {
        let figures = self.figures();
        let input = self.panels.take_egui_input(&self.window);
        let context = self.panels.egui_ctx().clone();
        let mut actions = Vec::new();
        let mut height = 0.0;
        let output = context.run_ui(input, |ui| (actions, height) = panels::show(ui, &figures));
        self.give_world((height * output.pixels_per_point).round() as u32);
        self.panels.handle_platform_output(&self.window, output.platform_output);
        let delay = output.viewport_output.values().map(|viewport| viewport.repaint_delay).min();
        match delay {
            Some(Duration::ZERO) => self.dirty = true,
            Some(delay) => self.panels_due = Instant::now().checked_add(delay),
            None => {}
        }
        let paint = Paint {
            jobs: context.tessellate(output.shapes, output.pixels_per_point),
            textures: output.textures_delta,
            pixels_per_point: output.pixels_per_point,
        };
        (actions, paint)
    }

    /// The world is drawn above the panels: so many pixels high.
    fn give_world(&mut self, height: u32) {
        let [width, whole] = self.canvas.size();
        self.area = [width, height.min(whole)];
        self.camera.resize(self.area);
    }

    fn figures(&self) -> Figures {
        let world = self.player.world();
        Figures {
            scene: self.scene.name().to_owned(),
            playing: self.player.is_playing(),
            asleep: self.player.is_asleep(),
            time: world.time(),
            frame: self.frame_meter.value(),
            step: self.step_meter.value(),
            pace: self.pace_meter.value(),
            points: world.point_count(),
            bonds: world.bonds().len(),
            drawn: if self.frames == 0 { world.bonds().len() as u64 } else { self.drawn },
            energy: world.energy(),
        }
    }

    fn draw(&mut self, paint: Paint) -> Result<(), RenderError> {
        let (previous, mix) = self.player.previous();
        let (motion, topology) = (self.player.motion(), self.player.topology());
        let view = View { previous, mix, motion, topology, ..View::of(self.player.world()) };
        let shapes = |counters: &RenderCounters| counters.bonds_drawn + counters.dots_drawn;
        let before = shapes(self.canvas.counters());
        let done = self.canvas.draw(&view, &self.camera, &self.look, self.area, paint);
        self.drawn = shapes(self.canvas.counters()) - before;
        match done {
            Err(RenderError::Lost { .. }) => self.reopen(),
            done => done,
        }
    }

    /// The GPU was lost (a driver's update, a card pulled out): opens what there is now. The world is not touched.
    fn reopen(&mut self) -> Result<(), RenderError> {
        self.canvas = Canvas::new(Arc::clone(&self.window), self.display.clone(), self.scene.dimensions())?;
        // The panels' textures went with the GPU: a fresh context sends them again.
        let context = egui::Context::default();
        context.set_visuals(egui::Visuals::dark());
        let scale = Some(self.window.scale_factor() as f32);
        let side = Some(self.canvas.largest_side() as usize);
        self.panels = egui_winit::State::new(context, egui::ViewportId::ROOT, &*self.window, scale, None, side);
        self.touch();
        Ok(())
    }

    /// Frames made, and what drawing them took.
    pub(super) fn statistics(&self) -> (u64, u64, RenderCounters) {
        (self.frames, self.player.world().counters().substeps, *self.canvas.counters())
    }
}
