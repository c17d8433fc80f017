//! An open scene in a window: what its frames do.

mod acts;
mod arrivals;
mod asking;
mod beside;
mod copies;
mod drawing;
mod driving;
mod fresh;
mod hearing;
mod keeping;
mod learning;
mod leaving;
mod leftovers;
mod lost;
mod plotting;
mod pointing;
mod selecting;
mod shelf;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use winit::event::WindowEvent;
use winit::event_loop::{EventLoopProxy, OwnedDisplayHandle};
use winit::keyboard::PhysicalKey;
use winit::window::{CursorIcon, Window};

use super::AppError;
use super::action::Tool;
use super::canvas::{Canvas, Paint};
use super::fetch::Fetch;
use super::import::Import;
use super::keys::{Down, Held};
use super::leftovers::{Leftover, look};
use super::loading::Loading;
use super::matter::Matter;
use super::meter::Meter;
use super::opening::Free;
use super::panels::{At, Misfits, PanelState, Sheet, listen, theme};
use super::player::{Figures, Order, Player, Shown, too_many_to_meet};
use super::pointer::Pointer;
use super::preferences::Preferences;
use super::saving::Saving;
use super::shell::is_for_panels;
use super::thumbnails::Thumbnails;
use super::tools::{Chosen, Hand};
use super::warnings::seen;
use crate::history::{HistoryError, Start};
use crate::render::{Camera, Look, Palette, RenderCounters, RenderError, Tiles, Trails};
use crate::scene::{MOST_MEETING, Parameter, Scene, SolverName, gallery};
use crate::sim::{Cursor, Key, MouseForce, SceneChange};
use asking::Asked;
use copies::{Copied, Row};
use leaving::Leaving;
use lost::Lost;
use shelf::{Left, Shelf};

/// The tag of scenes that are painted on.
const BRUSH: &str = "brush";
/// How long trails of points last, in scenes of few `[s of wall time]`.
const TRAIL: f64 = 2.5;
/// Least radius of a pinned point, of a few `[points]`: it is led by the hand.
const LEAST_PIN: f32 = 4.2;
/// A frame's time where there was none before it `[s]`.
const FIRST_FRAME: f64 = 1.0 / 60.0;
/// Figures are shown anew so often at most: nobody reads faster.
const FIGURES_EVERY: Duration = Duration::from_millis(100);

/// How the camera came to be where it is: it is put there again when the window gets another size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Framing {
    /// As the scene opens.
    Opening,
    /// All points.
    Fit,
    /// By hand.
    Free,
}

/// The scene, its player and its window.
pub(super) struct Session {
    pub(super) window: Arc<Window>,
    pub(super) egui: egui_winit::State,
    display: OwnedDisplayHandle,
    canvas: Canvas,
    player: Player,
    shelf: Shelf,
    scene: Arc<Scene>,
    /// Its place in the gallery, if it is of that.
    place: Option<usize>,
    /// The numbers that it names for sliders.
    named: Vec<Parameter>,
    /// A body of the scene is cut out of a picture.
    has_picture: bool,
    pub(super) camera: Camera,
    framing: Framing,
    /// Where the worlds lie that are side by side, and which of them the pointer is on.
    tiles: Tiles,
    cell: usize,
    /// What stands beside the world is coloured by its distance to it.
    tints_distance: bool,
    beside_trails: Vec<Trails>,
    /// Why solvers cannot run the scene, where bodies meet in it or not.
    misfits: (Option<bool>, Misfits),
    /// The largest distance of what stands beside the world that there was since it opened `[m]`.
    most_apart: f32,
    /// The distance of the last colours, where the largest is no less `[m]`.
    difference_most: f32,
    /// Width and height of the part of the window that the world is drawn in `[px]`.
    area: [u32; 2],
    /// What of it panels leave free for bodies `[px]`, and what lies over it: left, top, right and bottom `[px]`.
    free: Free,
    /// The left lower corner of what lies in the upper right one of it `[px]`.
    corner: Option<[f64; 2]>,
    covered: Vec<[f32; 4]>,
    pub(super) pointer: Pointer,
    hand: Hand,
    /// Which keys are held down beside others.
    pub(super) held: Held,
    /// Which keys were pressed, and for what.
    pub(super) down: Down,
    /// Keys of drives that are held in this history, with the keys of the keyboard.
    driving: Vec<(PhysicalKey, Key)>,
    /// The camera goes along with what they drive.
    follows: bool,
    /// Time runs back.
    rewinds: bool,
    /// The order by which the world goes to another time, until it is there.
    gone_by: Option<u64>,
    /// The stepping thread was told that the hand pushes.
    pushes: bool,
    /// What the stepping thread was told is selected, and what was copied.
    inspected: Chosen,
    copied: Option<Copied>,
    duplicated: Option<Row>,
    /// The last that was asked for in this history was to undo an edit.
    has_undone: bool,
    /// How the pointer looks.
    cursor_icon: CursorIcon,
    /// Strength of the hover force when nothing is led, as the world told it last.
    base: Option<f64>,
    look: Look,
    palette: Palette,
    trails: Trails,
    panels: PanelState,
    paint: Paint,
    /// What was written over the world last.
    marked_words: String,
    /// What of it was found in view.
    lost: Lost,
    /// Something that is shown has changed since the last frame; so has something that panels show.
    dirty: bool,
    panels_dirty: bool,
    /// When the panels want to be shown again by themselves, and when they were last.
    panels_due: Option<Instant>,
    panels_at: Option<Instant>,
    /// The pointer was over a panel when it last moved; it was over what floats, pressed or not, when panels were shown last.
    was_over_panels: bool,
    was_near_panels: bool,
    /// Nobody has pressed on anything yet: the first scene says how.
    wants_hint: bool,
    /// The system says that nothing of the window is seen.
    pub(super) is_occluded: bool,
    /// The first history could not begin: there is nothing to show.
    failure: Option<HistoryError>,
    /// A picture on its way into the world.
    import: Option<Import>,
    /// A drawing that was closed before anything was made of it.
    kept: Option<Import>,
    /// A picture that is being read and meshed.
    loading: Option<Loading>,
    /// What is just being added to the world: it comes back if it cannot be.
    adding: Option<Import>,
    /// What waits for an answer before it comes.
    asked: Option<Asked>,
    leaving: Leaving,
    /// A file that is being chosen in the system's dialog, and what is on its way from the clipboard.
    dialog: Option<Fetch>,
    pasted: Option<Fetch>,
    saving: Option<Saving>,
    /// The last file that was saved or opened: the next one is looked for beside it.
    last_file: Option<PathBuf>,
    /// Where sessions outlive a killed program, what the next history is recorded to, what is found of earlier ones, and what is left
    /// of them, the newest last.
    state_folder: Option<PathBuf>,
    record: Option<PathBuf>,
    search: Option<Receiver<Vec<Leftover>>>,
    leftovers: Vec<Leftover>,
    thumbnails: Option<Thumbnails>,
    waker: EventLoopProxy<()>,
    /// When the last frame began, if time has passed in the world since.
    last_frame: Option<Instant>,
    /// Where the cursor was told to be last.
    told: Option<Cursor>,
    frame_meter: Meter,
    frames: u64,
    /// Where to look from when the next history is there.
    looks_again: Option<Camera>,
    /// A history is being made that was never there: since when.
    opening_since: Option<Instant>,
    /// The step of a lesson that it is opened for.
    teaches: Option<At>,
    /// The figures and settings that panels show.
    figures: Figures,
    settings: SceneChange,
    matter: Option<Arc<Matter>>,
}

impl Session {
    /// Shows what `player` plays, in `window`.
    ///
    /// Errors: no GPU that can draw to the window.
    pub(super) fn new(
        window: Arc<Window>,
        (display, waker): (OwnedDisplayHandle, EventLoopProxy<()>),
        (player, scene): (Player, Arc<Scene>),
    ) -> Result<Self, RenderError> {
        let canvas = Canvas::new(Arc::clone(&window), display.clone(), scene.dimensions())?;
        let size = canvas.size();
        let egui = panels_for(&window, &canvas, Palette::default());
        let mut session = Session {
            // Until the scene is there.
            camera: Camera::fit([[-1.0; 3], [1.0; 3]], scene.dimensions(), size),
            framing: Framing::Opening,
            tiles: Tiles::ALONE,
            cell: 0,
            tints_distance: false,
            beside_trails: Vec::new(),
            misfits: Default::default(),
            most_apart: 0.0,
            difference_most: 1.0,
            area: size,
            free: [[0.0; 2], size.map(f64::from)],
            corner: None,
            covered: Vec::new(),
            trails: Trails::new(TRAIL),
            look: Look { scale_factor: window.scale_factor() as f32, least_pin: LEAST_PIN, ..Look::default() },
            palette: Palette::default(),
            has_picture: false,
            window,
            egui,
            display,
            canvas,
            player,
            shelf: Shelf::default(),
            scene,
            place: None,
            named: Vec::new(),
            pointer: Pointer::default(),
            hand: Hand::default(),
            held: Held::default(),
            down: Down::default(),
            driving: Vec::new(),
            follows: false,
            rewinds: false,
            gone_by: None,
            pushes: false,
            inspected: Chosen::default(),
            copied: None,
            duplicated: None,
            has_undone: false,
            cursor_icon: CursorIcon::Default,
            base: None,
            panels: PanelState::default(),
            paint: Paint::default(),
            marked_words: String::new(),
            lost: Lost::default(),
            dirty: true,
            panels_dirty: true,
            panels_due: None,
            panels_at: None,
            was_over_panels: false,
            was_near_panels: false,
            wants_hint: true,
            is_occluded: false,
            failure: None,
            import: None,
            kept: None,
            loading: None,
            adding: None,
            asked: None,
            leaving: Leaving::Not,
            dialog: None,
            pasted: None,
            saving: None,
            last_file: None,
            state_folder: None,
            record: None,
            search: None,
            leftovers: Vec::new(),
            thumbnails: None,
            waker,
            last_frame: None,
            told: None,
            frame_meter: Meter::default(),
            frames: 0,
            looks_again: None,
            opening_since: None,
            teaches: None,
            figures: Figures::default(),
            settings: SceneChange::default(),
            matter: None,
        };
        match session.player.is_open() {
            true => session.arrive(Arc::clone(&session.scene)),
            false => session.await_it(),
        }
        Ok(session)
    }

    /// Sessions outlive a killed program in `folder`, where earlier ones are looked for; the next history is recorded to `record`.
    pub(super) fn keep_in(&mut self, folder: Option<PathBuf>, record: Option<PathBuf>) {
        let preferred = folder.as_deref().map(Preferences::load).unwrap_or_default();
        self.color(preferred.palette);
        self.search = folder.clone().map(|folder| look(folder, self.wake_up()));
        (self.state_folder, self.record) = (folder, record);
    }

    /// Panels and world have the colours of a palette from now on.
    fn color(&mut self, palette: Palette) {
        self.palette = palette;
        self.look = self.look.colored(palette);
        theme::apply(self.egui.egui_ctx(), palette);
        // Those of the gallery are drawn anew when it opens.
        self.panels.thumbnails.clear();
        self.thumbnails = None;
        self.touch();
    }

    /// Dark or light, as it is from now on and at the next start.
    fn recolor(&mut self) {
        self.color(self.palette.other());
        let kept = self.state_folder.as_deref().map(|folder| Preferences { palette: self.palette }.save(folder));
        if let Some(Err(why)) = kept {
            self.complain(&format!("at the next start the colours are the old ones again: {why}"));
        }
    }

    /// The program ends as it should.
    ///
    /// Errors: a recording that could not be made whole.
    pub(super) fn end(&mut self) -> Result<(), AppError> {
        if self.player.record().is_some() {
            self.tell_view();
        }
        let mut done = Ok(());
        for player in self.shelf.players_mut().chain([&mut self.player]) {
            let ended = player.end();
            done = done.and(ended.map_err(|(path, reason)| AppError::Record { path, reason }));
        }
        done
    }

    /// The program gives up: what was kept of its sessions stays.
    pub(super) fn leave(&self) {
        self.shelf.players().chain([&self.player]).for_each(Player::leave);
    }

    /// Whether another frame is needed: something moves or has changed.
    pub(super) fn wants_frame(&self) -> bool {
        self.dirty || self.panels_dirty || self.moves()
    }

    /// Whether time goes on: the world waits while a picture is being imported, which takes its place on the screen.
    fn moves(&self) -> bool {
        let fades = self.hand.is_fading() && self.player.is_playing();
        !self.waits()
            && (self.player.is_moving() || self.rewinds || fades || self.hand.is_leading() || self.hand.is_hauling())
    }

    /// Whether the world waits for what lies over it: what is saved is the moment at which it was asked for.
    fn waits(&self) -> bool {
        self.import.is_some() || self.asked.is_some() || self.panels.sheet.is_some_and(Sheet::stops_time)
    }

    /// Whether something lies over the world that keys and the mouse are for.
    pub(super) fn is_covered(&self) -> bool {
        self.import.is_some() || self.panels.sheet.is_some() || self.asked.is_some()
    }

    /// Opens another scene, or a recording, in place of this one, which can be gone back to.
    fn open(&mut self, start: Start) {
        let keeping = self.keeping();
        let is_another = start.scene().name() != self.scene.name();
        let player = Player::open(start, keeping, self.wake_up());
        self.put_on(player);
        if is_another {
            // What was held for the scene before would surprise in this one.
            self.hand.take(Tool::Hand);
        }
    }

    /// Plays another history; the present one goes onto the shelf.
    fn put_on(&mut self, player: Player) {
        self.leave_drawing();
        // Whoever opens something else wants that.
        self.panels.notes.offer = None;
        self.take_leave();
        let last = std::mem::replace(&mut self.player, player);
        let recorded = last.record().map(|path| path.display().to_string());
        // What nobody has seen yet is not gone back to, unless something is to be kept of it.
        if self.opening_since.is_none() || last.record().is_some() {
            self.shelf.keep(Left::now(last, self.camera));
        }
        self.await_it();
        self.begin();
        self.settle();
        if let Some(path) = recorded {
            self.say(format!("{path} has all that was done so far; another scene is not recorded there"));
        }
    }

    /// A history is being made: it is called by its name from now on.
    fn await_it(&mut self) {
        self.opening_since = Some(Instant::now());
        let scene = self.player.start().scene().clone();
        self.place = place_of(&scene);
        self.scene = Arc::new(scene);
        self.call_window();
        (self.named, self.has_picture) = (Vec::new(), false);
        self.panels.notes.has_caption = false;
        self.panels.notes.complaint = None;
        self.panels.notes.begin();
    }

    /// The window is called by what is open in it.
    fn call_window(&self) {
        let name = self.player.start().name().unwrap_or(self.scene.name());
        self.window.set_title(&format!("wobble · {name}"));
    }

    /// A history that is being made is not waited for: the one before it is there again. Returns whether there is one.
    pub(super) fn stop_opening(&mut self) -> bool {
        if self.opening_since.is_none() || self.player.record().is_some() {
            return false;
        }
        let Some(left) = self.shelf.back() else { return false };
        self.teaches = None;
        drop(self.bring_back(left));
        self.settle();
        true
    }

    /// For how long a history is being made, and whether it can be given up for another.
    fn opening(&self) -> Option<(Duration, bool)> {
        self.opening_since.map(|since| (since.elapsed(), self.shelf.has_before() && self.player.record().is_none()))
    }

    /// The present history is left for another: nothing hangs on the hand in it.
    pub(super) fn take_leave(&mut self) {
        self.stop_driving();
        let deed = self.hand.leave();
        self.do_deed(deed);
        self.tell_press();
    }

    /// The stepping thread is told whether the hand pushes.
    fn tell_press(&mut self) {
        let pushes = self.hand.is_pushing();
        if std::mem::replace(&mut self.pushes, pushes) != pushes {
            self.player.ask(Order::Press(pushes));
        }
    }

    /// The world goes to another time: what the hand leads here stays here.
    pub(super) fn go(&mut self, order: Order) {
        self.leave_drawing();
        self.hand.drop_all();
        self.driving.clear();
        self.player.ask(order);
        self.gone_by = Some(self.player.serial());
    }

    /// Whether the log leads the world, not the hand.
    fn is_led(&self) -> bool {
        self.shown().figures.follows || self.rewinds || self.gone_by.is_some()
    }

    /// Another history is shown: nothing of the last one is under way any more.
    fn begin(&mut self) {
        self.hand.let_go();
        (self.asked, self.duplicated) = (None, None);
        self.inspected = Chosen::default();
        self.has_undone = false;
        self.driving.clear();
        self.panels.sheet = None;
        (self.rewinds, self.last_frame, self.told, self.gone_by) = (false, None, None, None);
        self.plot_anew();
        self.touch();
        let news = self.player.poll();
        self.hear(news);
    }

    /// The history is there: its scene is shown as it opens.
    fn arrive(&mut self, scene: Arc<Scene>) {
        self.opening_since = None;
        self.follows = false;
        self.canvas.forget_world(scene.dimensions());
        self.has_picture = scene.picture_body().is_some();
        self.look.has_mesh = false;
        self.trails = Trails::new(TRAIL * scene.rate());
        self.beside_trails.clear();
        (self.cell, self.misfits.0, self.most_apart) = (0, None, 0.0);
        self.tints_distance = scene.method.solver == Some(SolverName::AsPrinted);
        self.named = scene.named_parameters();
        self.place = place_of(&scene);
        self.scene = scene;
        self.call_window();
        self.plot_anew();
        self.frame_as(Framing::Opening);
        if let Some(camera) = self.looks_again.take() {
            (self.camera, self.framing) = (camera, Framing::Free);
            self.camera.resize(self.area);
        }
        self.take_base();
        let passes =
            self.has_picture && self.scene.contact.is_none() && self.shown().scenery.bonds.len() > MOST_MEETING;
        let through = passes.then(|| format!("its bodies pass through each other: {}", too_many_to_meet()));
        let warnings: Vec<&str> = self.shown().scenery.warnings.iter().map(|line| seen(line)).collect();
        let warning = (!warnings.is_empty()).then(|| listed(&warnings));
        let said: Vec<String> = [warning, through, self.taken_keys()].into_iter().flatten().collect();
        self.panels.notes.complaint = (!said.is_empty()).then(|| said.join("\n"));
        self.panels.notes.begin();
        if self.player.start().is_replayed() {
            self.panels.notes.warn(REPLAYED.to_owned());
        }
        self.panels.notes.has_caption = true;
        self.wants_hint &= self.place == Some(0);
        self.place_hint();
        match self.teaches.take() {
            Some(at) => self.lay_out(at),
            None => self.leave_lesson(),
        }
        self.touch();
    }

    /// Time ran on since the last frame: asks for it, once a frame.
    fn advance(&mut self, start: Instant) {
        let is_asked = self.player.is_playing() || self.rewinds || self.shown().figures.behind;
        let cursor = self.world_cursor();
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
        self.told = cursor;
        self.player.advance(wall, cursor, self.rewinds);
    }

    /// One frame: the time that passed, the panels if they changed, the picture. Draws nothing if nothing has changed.
    ///
    /// Errors: a GPU that gave up and cannot be had again.
    pub(super) fn frame(&mut self) -> Result<(), RenderError> {
        let start = Instant::now();
        if self.panels_due().is_some_and(|due| due <= start) {
            (self.panels_dirty, self.panels_due) = (true, None);
        }
        if !self.wants_frame() {
            return Ok(());
        }
        self.stay_without_name();
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
    pub(super) fn rest(&mut self) {
        self.last_frame = None;
    }

    /// Why there is nothing to show, if the first scene could not be opened.
    pub(super) fn take_failure(&mut self) -> Option<HistoryError> {
        self.failure.take()
    }

    /// Hands an event to the panels: keys only where they write or nothing else is meant by them.
    pub(super) fn tell_panels(&mut self, event: &WindowEvent) {
        let is_writing = self.is_writing();
        if let WindowEvent::KeyboardInput { event, .. } = event
            && !is_for_panels(event, is_writing)
        {
            return;
        }
        let response = self.egui.on_window_event(&self.window, event);
        let is_move = matches!(event, WindowEvent::CursorMoved { .. });
        self.panels_dirty |= response.repaint && !is_move;
    }

    /// Whether what is typed goes into a field: also into one that is only about to be shown.
    pub(super) fn is_writing(&self) -> bool {
        let is_coming = self.panels.is_fresh && self.panels.sheet.is_some_and(|sheet| sheet != Sheet::Help);
        is_coming || self.egui.egui_ctx().text_edit_focused()
    }

    /// Keys and buttons that were held down are let go elsewhere.
    pub(super) fn lose_focus(&mut self) {
        self.stop_driving();
        self.rewinds = false;
        self.hand.hold_pins(false);
        self.down = Down::default();
        self.hold(Held::default());
        self.touch();
    }

    /// Ctrl and Shift go down or up.
    pub(super) fn hold(&mut self, held: Held) {
        self.held = held;
        self.hand.hold([held.shift, held.alt]);
        self.dirty = true;
    }

    /// When the panels want a frame by themselves.
    pub(super) fn panels_due(&self) -> Option<Instant> {
        [self.panels_due, self.panels.notes.until()].into_iter().flatten().min()
    }

    /// Something that is shown has changed, on the panels too.
    pub(super) fn touch(&mut self) {
        (self.dirty, self.panels_dirty) = (true, true);
    }

    pub(super) fn resize(&mut self, size: [u32; 2]) {
        self.canvas.resize(size);
        self.touch();
    }

    pub(super) fn rescale(&mut self, scale_factor: f64) {
        self.look.scale_factor = scale_factor as f32;
        self.touch();
    }

    /// Whether the window has no size to draw on.
    pub(super) fn has_no_size(&self) -> bool {
        self.canvas.size().contains(&0)
    }

    /// The state that is drawn.
    fn shown(&self) -> &Shown {
        self.player.shown()
    }

    /// The hover force, where it follows the cursor: one with a track of its own doesn't.
    fn live_force(&self) -> Option<&MouseForce> {
        self.shown().mouse.as_ref().filter(|force| force.track.knots.is_empty())
    }

    /// Frames made, times asked for, substeps taken, and what drawing took.
    pub(super) fn statistics(&self) -> ([u64; 3], RenderCounters) {
        let players = self.shelf.players().chain([&self.player]);
        let work = players.fold([0; 2], |[advances, substeps], player| {
            [advances + player.advances(), substeps + player.shown().figures.substeps]
        });
        ([self.frames, work[0], work[1]], self.canvas.counters())
    }
}

/// The place in the gallery of a scene that is in it: not of another one that is called so.
fn place_of(scene: &Scene) -> Option<usize> {
    let place = gallery().iter().position(|entry| entry.name == scene.name())?;
    let own = gallery()[place].scene().ok()?;
    // What stands beside it may have been changed.
    let alone = Scene { name: own.name.clone(), beside: own.beside.clone(), ..scene.clone() };
    (alone == own).then_some(place)
}

/// Said of a recording as it opens.
const REPLAYED: &str = "a recording: it is replayed as it was done. A press on the world takes over from there; the list beside the \
                        timeline leads back to what was recorded";

/// So many warnings are shown at once, a line each.
const MOST_WARNINGS: usize = 3;

/// Warnings below each other, the first few of many.
fn listed(warnings: &[&str]) -> String {
    let shown = warnings.iter().take(MOST_WARNINGS).map(|line| (*line).to_owned());
    let more = warnings.len().saturating_sub(MOST_WARNINGS);
    let rest = (more > 0).then(|| format!("and {more} more: `wobble simulate` lists all"));
    shown.chain(rest).collect::<Vec<_>>().join("\n")
}

/// A context for the panels of a window.
fn panels_for(window: &Arc<Window>, canvas: &Canvas, palette: Palette) -> egui_winit::State {
    let context = egui::Context::default();
    theme::apply(&context, palette);
    listen(&context);
    let scale = Some(window.scale_factor() as f32);
    let side = Some(canvas.largest_side() as usize);
    egui_winit::State::new(context, egui::ViewportId::ROOT, &**window, scale, None, side)
}

#[cfg(test)]
mod tests {
    use super::{gallery, listed, place_of};
    use crate::scene::Scene;

    #[test]
    fn a_scene_that_is_called_as_one_of_the_gallery_is_none_of_it() {
        let own = gallery()[1].scene();
        assert_eq!(own.ok().and_then(|scene| place_of(&scene)), Some(1));
        let text = r#"{"wobble": 1, "name": "rope", "points": {"position": [[0, 0]]}}"#;
        assert_eq!(Scene::parse(text, "x.json").ok().and_then(|scene| place_of(&scene)), None);
    }

    #[test]
    fn of_many_warnings_the_first_are_listed() {
        let all = ["a", "b", "c", "d", "e"];
        assert_eq!(listed(&all[..2]), "a\nb");
        assert_eq!(listed(&all), "a\nb\nc\nand 2 more: `wobble simulate` lists all");
    }
}
