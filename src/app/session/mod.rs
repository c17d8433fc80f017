//! An open scene in a window: what its frames do.

mod acts;
mod arrivals;
mod asking;
mod begun;
mod beside;
mod browsing;
mod coming;
mod copies;
mod drawing;
mod driving;
mod filming;
mod frames;
mod framing;
mod fresh;
mod hearing;
mod keeping;
mod learning;
mod leaving;
mod leftovers;
mod lost;
mod marking;
mod over;
mod playing;
mod plotting;
mod pointing;
mod saying;
mod selecting;
mod setting;
mod shelf;
mod showing;
mod taking;
mod told;
mod trails;
mod wearing;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use winit::event_loop::{EventLoopProxy, OwnedDisplayHandle};
use winit::window::{CursorIcon, Window};

use super::AppError;
use super::aside::Unwanted;
use super::canvas::{Canvas, Paint};
use super::fetch::Fetch;
use super::film::Filming;
use super::framing::{Framed, Framing, Undocked, Ways};
use super::import::Import;
use super::keys::{Down, Held};
use super::leftovers::{Found, Leftover, look};
use super::loading::Loading;
use super::matter::{Bearings, Matter, Overload, Turned};
use super::meter::Meter;
use super::opening::{Followed, Free, Over};
use super::panels::{At, Misfits, PanelState, theme};
use super::player::{Figures, Order, Player, Shown};
use super::pointer::Pointer;
use super::preferences::Preferences;
use super::recent::Recent;
use super::resting::Resting;
use super::saving::Saving;
use super::thumbnails::{CutOff, Thumbnails};
use super::tools::{Chosen, Hand, Stalls};
use super::trailing::Trailing;
use super::whereabouts::Whereabouts;
use crate::history::HistoryError;
use crate::picture::Tint;
use crate::render::{Camera, Look, Palette, RenderCounters, Tiles, Trails};
use crate::scene::{Parameter, Scene};
use crate::sim::{Cursor, Key, MouseForce, PointId, SceneChange};
use asking::Asked;
use copies::{Copied, Row};
use driving::Holder;
use leaving::Leaving;
use lost::Lost;
use shelf::{Shelf, Way};

/// The tag of scenes that are painted on.
const BRUSH: &str = "brush";
/// Least radius of a pinned point, of a few `[points]`: it is led by the hand.
const LEAST_PIN: f32 = 4.2;
/// A frame's time where there was none before it `[s]`.
const FIRST_FRAME: f64 = 1.0 / 60.0;
/// Figures are shown anew so often at most: nobody reads faster.
const FIGURES_EVERY: Duration = Duration::from_millis(100);

/// What it depends on whether bodies bear their weight: the topology, gravity, whose it is, and how often time has asked for another look.
type Borne = (u64, Option<[f64; 3]>, Option<Chosen>, i64);

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
    framed: Framed,
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
    /// Height of the titles of worlds side by side `[px]`.
    titles: f64,
    /// The view of worlds side by side before a panel took room from them.
    undocked: Option<Undocked>,
    /// How the view of one world made way for panels.
    ways: Ways,
    /// What lies over that at the right.
    over: Over,
    covered: Vec<[f32; 4]>,
    /// How often in a row panels were laid out and lay elsewhere than the time before.
    laid_anew: u8,
    pub(super) pointer: Pointer,
    hand: Hand,
    /// Which keys are held down beside others.
    pub(super) held: Held,
    /// Which keys were pressed, and for what.
    pub(super) down: Down,
    /// Keys of drives that are held in this history, and by what.
    driving: Vec<(Holder, Key)>,
    /// Which motors stall.
    stalls: Stalls,
    /// When the key went down that takes the tool for pins.
    pins_since: Option<Instant>,
    /// The camera goes along with what they drive.
    follows: bool,
    /// What the view goes along with as the scene opens.
    followed: Followed,
    /// Time runs back.
    rewinds: bool,
    /// The order by which the world goes to another time, until it is there.
    gone_by: Option<u64>,
    /// The stepping thread was told that the hand pushes.
    pushes: bool,
    /// What the stepping thread was told is selected, and what was copied.
    inspected: Chosen,
    /// The drag of a number has put what is selected elsewhere: before, there was no room.
    is_put: bool,
    copied: Option<Copied>,
    duplicated: Option<Row>,
    /// How the pointer looks.
    cursor_icon: CursorIcon,
    /// Strength of the hover force when nothing is led, as the world told it last.
    base: Option<f64>,
    look: Look,
    palette: Palette,
    trails: Trails,
    trailing: Trailing,
    /// Where bodies have been lately.
    whereabouts: Whereabouts,
    panels: PanelState,
    paint: Paint,
    /// What was written over the world last.
    marked_words: String,
    /// Where labels of the scene lie in the world that the pointer is in, by their numbers `[points]`.
    labels_at: Vec<(usize, egui::Rect)>,
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
    /// The other scenes with work that was not saved, as it was last asked whether to leave.
    told_of: Vec<String>,
    /// A file that is being chosen in the system's dialog, and what is on its way from the clipboard.
    dialog: Option<Fetch>,
    /// The points of a body that the picture in that file is for.
    wearer: Option<Vec<PointId>>,
    pasted: Option<Fetch>,
    saving: Option<Saving>,
    /// A clip that is being drawn and written.
    filming: Option<Filming>,
    /// What was saved and opened: the next file is looked for in the folder that was used last.
    recent: Recent,
    /// Where sessions outlive a killed program, what the next history is recorded to, what is found of earlier ones, and what is left
    /// of them, the newest last.
    state_folder: Option<PathBuf>,
    record: Option<PathBuf>,
    search: Option<Receiver<Found>>,
    /// Files of sessions that cannot be read, and that were not told of yet.
    unread: Vec<PathBuf>,
    leftovers: Vec<Leftover>,
    thumbnails: Option<Thumbnails>,
    /// Pictures of sessions that were cut off, on their way.
    cut_off: Option<CutOff>,
    /// Threads that draw what is not wanted any more.
    unwanted: Unwanted,
    waker: EventLoopProxy<()>,
    /// When the last frame began, if time has passed in the world since.
    last_frame: Option<Instant>,
    /// Where the cursor was told to be last, and with the pointer where.
    told: Option<Cursor>,
    resting: Resting,
    /// When the left button went down over the world last.
    pressed_at: Option<Instant>,
    frame_meter: Meter,
    frames: u64,
    /// Where to look from when the next history is there.
    looks_again: Option<Camera>,
    /// Which way along the shelf, and how far, the history lies that is being worked out anew.
    came: Option<(Way, usize)>,
    /// The history is there only until the picture is that the program was opened with.
    stands_in: bool,
    /// A history is being made that was never there: since when.
    opening_since: Option<Instant>,
    /// The step of a lesson that it is opened for.
    teaches: Option<At>,
    /// The step that the present history was opened for.
    taught: Option<At>,
    /// The figures and settings that panels show.
    figures: Figures,
    settings: SceneChange,
    matter: Option<Arc<Matter>>,
    /// Of a turn that is dragged on.
    turned: Turned,
    /// How soft bodies bear their weight, and of which topology and gravity that is.
    bearings: (Option<Borne>, Arc<Bearings>),
    /// What of it gives way, and the points that the brush went over in this history.
    overload: Option<Arc<Overload>>,
    painted: BTreeSet<PointId>,
    /// How points are drawn, and which are hidden, as panels say it.
    tints: Arc<[Tint]>,
}

impl Session {
    /// Sessions outlive a killed program in `folder`, where earlier ones are looked for; the next history is recorded to `record`.
    pub(super) fn keep_in(&mut self, folder: Option<PathBuf>, record: Option<PathBuf>) {
        let preferred = folder.as_deref().map(Preferences::load).unwrap_or_default();
        self.color(preferred.palette);
        self.trailing.settings = preferred.trails;
        self.recent = folder.as_deref().map(Recent::load).unwrap_or_default();
        self.panels.recent = self.recent.files().to_vec();
        self.search = folder.clone().map(|folder| look(folder, self.wake_up()));
        (self.state_folder, self.record) = (folder, record);
    }

    /// Panels and world have the colours of a palette from now on.
    fn color(&mut self, palette: Palette) {
        self.palette = palette;
        self.look = self.look.colored(palette);
        theme::apply(self.egui.egui_ctx(), palette);
        self.forget_thumbnails();
        self.touch();
    }

    /// Dark or light, as it is from now on and at the next start.
    fn recolor(&mut self) {
        self.color(self.palette.other());
        self.keep_preferences();
    }

    /// What is preferred is kept for the next start.
    fn keep_preferences(&mut self) {
        let preferred = Preferences { palette: self.palette, trails: self.trailing.settings };
        let kept = self.state_folder.as_deref().map(|folder| preferred.save(folder));
        if let Some(Err(why)) = kept {
            self.complain(&format!("at the next start colours and trails are as they were: {why}"));
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

    /// Whether something lies over the world that keys and the mouse are for.
    pub(super) fn is_covered(&self) -> bool {
        self.import.is_some() || self.panels.sheet.is_some() || self.asked.is_some()
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

    /// Why there is nothing to show, if the first scene could not be opened.
    pub(super) fn take_failure(&mut self) -> Option<HistoryError> {
        self.failure.take()
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
