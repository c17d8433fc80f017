//! An open scene in a window: what its frames do.

mod arrivals;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event_loop::{EventLoopProxy, OwnedDisplayHandle};
use winit::window::Window;

use super::canvas::{Canvas, Paint};
use super::fetch::Fetch;
use super::import::Import;
use super::input::{Action, Pointer};
use super::loading::Loading;
use super::meter::Meter;
use super::opening;
use super::panels::{self, Figures};
use super::player::Player;
use crate::picture::Skin;
use crate::render::{Camera, Look, RenderCounters, RenderError, View};
use crate::scene::{Scene, SceneError};
use crate::sim::Command;

/// The tag of scenes that open on a canvas.
const BRUSH: &str = "brush";

/// What a session begins with.
pub(super) struct Opened {
    pub(super) scene: Scene,
    pub(super) player: Player,
    pub(super) skins: Vec<Skin>,
    /// A picture that is to be opened in its place.
    pub(super) picture: Option<PathBuf>,
}

impl Opened {
    /// A scene at its start.
    ///
    /// Errors: a scene that cannot be run, a picture that cannot be had.
    pub(super) fn new(scene: Scene) -> Result<Self, SceneError> {
        let world = scene.world(scene.duration)?;
        let player = Player::new(world, scene.rate(), scene.duration);
        let skins = scene.skins()?;
        Ok(Opened { scene, player, skins, picture: None })
    }
}

/// The scene, its player and its window.
pub(super) struct Session {
    pub(super) window: Arc<Window>,
    pub(super) panels: egui_winit::State,
    display: OwnedDisplayHandle,
    canvas: Canvas,
    player: Player,
    scene: Scene,
    skins: Vec<Skin>,
    /// A body of the scene is cut out of a picture.
    has_picture: bool,
    pub(super) camera: Camera,
    /// Width and height of the part of the window that the world is drawn in [px].
    area: [u32; 2],
    pub(super) pointer: Pointer,
    /// Ctrl, or its like on a Mac, is held down.
    pub(super) holds_command: bool,
    look: Look,
    /// Something that is shown has changed since the last frame.
    dirty: bool,
    /// When the panels want to be shown again by themselves.
    panels_due: Option<Instant>,
    /// A picture on its way into the world.
    import: Option<Import>,
    /// A drawing that was closed before anything was made of it.
    kept: Option<Import>,
    /// A picture that is being read and meshed.
    loading: Option<Loading>,
    /// A file that is being chosen in the system's dialog, and what is on its way from the clipboard.
    dialog: Option<Fetch>,
    pasted: Option<Fetch>,
    /// What went wrong, until the user has seen it.
    complaint: Option<String>,
    waker: EventLoopProxy<()>,
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
        (display, waker): (OwnedDisplayHandle, EventLoopProxy<()>),
        Opened { scene, player, skins, picture }: Opened,
    ) -> Result<Self, RenderError> {
        let canvas = Canvas::new(Arc::clone(&window), display.clone(), scene.dimensions())?;
        let size = canvas.size();
        let context = egui::Context::default();
        context.set_visuals(egui::Visuals::dark());
        let scale = window.scale_factor() as f32;
        let side = canvas.largest_side() as usize;
        let panels = egui_winit::State::new(context, egui::ViewportId::ROOT, &*window, Some(scale), None, Some(side));
        let warning = player.world().warnings().first().cloned();
        let mut session = Session {
            camera: opening::camera(&scene, player.world(), size),
            area: size,
            look: Look { scale_factor: scale, has_mesh: skins.is_empty(), ..Look::default() },
            skins,
            has_picture: scene.picture_body().is_some(),
            window,
            panels,
            display,
            canvas,
            player,
            scene,
            pointer: Pointer::default(),
            holds_command: false,
            dirty: true,
            panels_due: None,
            import: None,
            kept: None,
            loading: None,
            dialog: None,
            pasted: None,
            complaint: warning,
            waker,
            last_frame: None,
            frame_meter: Meter::default(),
            step_meter: Meter::default(),
            pace_meter: Meter::default(),
            frames: 0,
            drawn: 0,
        };
        if session.is_canvas() {
            session.paint();
        }
        if let Some(path) = picture {
            session.loading = Some(Loading::scene(&path, session.wake_up()));
        }
        Ok(session)
    }

    /// Whether another frame is needed: something moves or has changed.
    pub(super) fn wants_frame(&self) -> bool {
        self.dirty || self.moves()
    }

    /// Whether the world goes on: it waits while a picture is being imported, which takes its place on the screen.
    fn moves(&self) -> bool {
        self.player.is_moving() && self.import.is_none()
    }

    /// Closes what lies over the world. Returns whether there was anything.
    pub(super) fn dismiss(&mut self) -> bool {
        let was_open = self.complaint.take().is_some() || self.loading.take().is_some() || self.put_away();
        if was_open {
            self.touch();
        }
        was_open
    }

    /// Opens another scene in place of this one.
    fn open(&mut self, scene: Scene) -> Result<(), SceneError> {
        let opened = Opened::new(scene)?;
        let is_other_space = opened.scene.dimensions() != self.scene.dimensions();
        (self.scene, self.player, self.skins) = (opened.scene, opened.player, opened.skins);
        self.look.has_mesh = self.skins.is_empty();
        self.has_picture = self.scene.picture_body().is_some();
        self.camera = opening::camera(&self.scene, self.player.world(), self.area);
        self.window.set_title(&format!("wobble · {}", self.scene.name()));
        if is_other_space {
            // Its passes are others.
            self.reopen().map_err(|error| self.scene.complaint(&error.to_string()))?;
        }
        self.canvas.forget_world();
        self.move_cursor();
        self.complaint = self.player.world().warnings().first().cloned();
        Ok(())
    }

    /// What of the plane is in view: its lower and upper corner [m].
    fn seen(&self) -> [[f64; 2]; 2] {
        let [width, height] = self.area.map(f64::from);
        [[0.0, height], [width, 0.0]].map(|pixel| self.camera.world_from_screen(pixel).truncate().to_array())
    }

    /// Looks from where one looked before another scene was opened; at all of it, if the points and polygons from the `first` on are
    /// not all seen from there.
    fn look_again(&mut self, camera: Camera, first: [usize; 2]) {
        self.camera = camera;
        self.camera.resize(self.area);
        let [lower, upper] = self.seen();
        let is_seen = |[x, y]: [f64; 2]| (lower[0]..=upper[0]).contains(&x) && (lower[1]..=upper[1]).contains(&y);
        let world = self.player.world();
        let positions = world.positions();
        let mut points = (first[0]..positions.len() / 2).map(|i| [positions.get(2 * i), positions.get(2 * i + 1)]);
        let mut corners = world.polygons().iter().skip(first[1]).flat_map(|polygon| &polygon.loops).flatten().copied();
        let has_all = [points.all(is_seen), corners.all(is_seen)];
        if has_all.contains(&false) {
            self.camera = opening::fit(world, world.polygons().len() > first[1], self.area);
        }
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
            self.player.apply(Command::Cursor { to: cursor, by: 0.0 });
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
            Action::Paint => self.paint(),
            Action::Import => self.cut_anew(),
            Action::Open => self.choose_file(),
            Action::Paste => self.paste(),
            Action::ToggleMesh => self.look.has_mesh = !self.look.has_mesh,
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
        if !self.moves() {
            self.last_frame = None;
        }
        Ok(())
    }

    /// Lets the world's time pass. A world that did not move since the last frame does not make up for the pause.
    fn advance(&mut self, start: Instant) {
        if !self.moves() {
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
        let (mut answer, mut is_read) = (None, false);
        let can_add = self.scene.dimensions() == 2;
        let output = context.run_ui(input, |ui| {
            (actions, height) = panels::show(ui, &figures);
            answer = self.import.as_mut().and_then(|import| import.show(ui.ctx(), can_add));
            if self.loading.as_ref().is_some_and(|loading| loading.show(ui.ctx())) {
                self.loading = None;
            }
            is_read = self.complaint.as_ref().is_some_and(|complaint| panels::complain(ui.ctx(), complaint));
        });
        if is_read {
            self.complaint = None;
            self.dirty = true;
        }
        if let Some(answer) = answer {
            self.answer(answer);
        }
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
            has_skin: !self.skins.is_empty(),
            has_picture: self.has_picture,
        }
    }

    fn draw(&mut self, paint: Paint) -> Result<(), RenderError> {
        let (previous, mix) = self.player.previous();
        let (motion, topology) = (self.player.motion(), self.player.topology());
        let skins = &self.skins;
        let view = View { previous, mix, motion, topology, skins, ..View::of(self.player.world()) };
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
        (self.frames, self.player.substeps(), *self.canvas.counters())
    }
}
