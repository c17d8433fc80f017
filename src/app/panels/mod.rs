//! The panels: a bar below, tools at the left, figures, what is said, and sheets over the world. They return wishes and change
//! nothing of the world.

mod angles;
mod asking;
mod beside;
#[cfg(test)]
mod beside_tests;
mod bonds;
mod brush;
mod choosing;
pub(super) mod color;
#[cfg(test)]
mod column_tests;
mod complaint;
mod cut_off;
#[cfg(test)]
mod cut_tests;
mod dial;
mod drives;
mod fewer;
mod finding;
mod focus;
mod folded;
mod gallery;
mod held;
mod help;
mod hud;
mod icons;
mod laying;
#[cfg(test)]
mod layout_tests;
mod legend;
mod lessons;
#[cfg(test)]
mod lessons_tests;
mod low;
mod material;
#[cfg(test)]
mod material_tests;
mod motors;
mod moving;
mod notes;
mod open_from;
mod opened;
mod palette;
mod parameters;
mod places;
mod plots;
mod plots_at;
#[cfg(test)]
mod plots_tests;
#[cfg(test)]
mod pointer;
mod presses;
mod primitives;
mod push;
pub(super) mod ranged;
mod reopen;
mod save_to;
mod settings;
#[cfg(test)]
mod settings_tests;
mod sheet;
#[cfg(test)]
mod small_tests;
mod steady;
mod swings;
pub(super) mod theme;
pub(super) mod ticks;
mod timelines;
mod top;
mod transport;
mod typed;
mod waiting;
#[cfg(test)]
mod walls_tests;
mod wave;
mod ways;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::action::{Action, Primitive, Showing, Tool};
use super::matter::{Bearings, Matter, MatterChange, Overload, Placing};
use super::player::{Figures, Going, MethodSetting};
use super::plots::Plots;
use super::tools::{Brush, BuiltOf, Drives, Links, PushWay};
use super::trailing::TrailSettings;
use crate::history::Do;
use crate::render::{Look, Palette};
use crate::scene::{PrecisionName, SolverName};
use crate::sim::{Key, PointId};
pub(super) use asking::{Question, show as ask};
pub(super) use beside::{Misfits, Neighbor, solvers};
pub(super) use complaint::Cover;
pub(super) use cut_off::Discards;
pub(super) use finding::names as found_scenes;
pub(super) use gallery::{THUMBNAIL, search_id};
pub(super) use held::HeldAt;
use icons::Icon;
pub(super) use laying::show;
pub(super) use lessons::{At, Lessons, Met};
use material::MatterAt;
pub(super) use material::lies as matter_lies;
pub(super) use material::presets;
pub(super) use moving::{close as close_lines, is_open as are_lines_open};
pub(super) use notes::Notes;
pub(super) use open_from::{OpenFrom, meant};
use opened::Seen;
pub(super) use opened::{Opened, Room};
pub(super) use parameters::all as parameters;
pub(super) use places::{Laid, clear_about, covered, kept_in, read as read_at};
pub(super) use plots::{figure, lie as plots_lie};
pub(super) use plots_at::PlotsAt;
pub(super) use presses::listen;
pub(super) use save_to::{SaveTo, Saved, ask as ask_to_save, is_recording};
pub(super) use settings::settings_search_id;
pub(super) use settings::{Pushing, Setting, Settings};
pub(super) use sheet::{said_below, show as sheet};
pub(super) use transport::{at_end, speed};
pub(super) use waiting::{Opening, is_said};

/// Room that the tools take at the left edge `[points]`.
pub(super) const TOOLS: f32 = 66.0;

/// What a panel at the right edge takes there beside its width `[points]`.
const GAP: f32 = 28.0;

/// What the panels ask for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
    /// The same as a key.
    Act(Action),
    /// A scene of the gallery.
    OpenScene(&'static str),
    /// A step of a lesson, with its scene.
    Learn(At),
    /// The tool for building makes this from now on.
    Build(Primitive),
    /// The mouse holds this key of drives from now on, or none.
    Hold(Option<Key>),
    /// The tools for muscles and motors make these from now on.
    Drives(Drives),
    /// The hinge about this hub gets a motor.
    GiveMotor(PointId),
    /// The tool for forces makes these from now on.
    Push(PushWay),
    /// Drawn bonds are made of something else.
    Links(Links),
    /// What is built is made of these.
    BuildOf(BuiltOf),
    /// What is selected gets another matter; of the same drag as the last one.
    Matter(MatterChange, bool),
    /// It is put where a number says; of the same drag as the last one.
    Place(Placing, bool),
    /// The brush paints with this from now on.
    Brush(Brush),
    /// What gives way is made stiff enough for its load.
    Bear,
    /// A drag beside all bodies is a free stroke from now on, or a box.
    Lasso(bool),
    /// Something is set of the scene.
    Set(Setting),
    /// The same start beside it, by this solver or as exact as can be.
    Beside(Option<SolverName>),
    /// What stands beside it at a place of the row is taken away.
    TakeAway(usize),
    /// What stands beside it is coloured by the distance.
    TintDistance(bool),
    /// Another solver, with all else of the method as it is.
    Solver(SolverName),
    /// Something else of the method, of the same drag as the last one.
    Method(MethodSetting, bool),
    /// It goes on from this moment with this precision, and this tolerance `[m]`.
    Begin(PrecisionName, Option<f64>),
    /// What is selected wears another picture: a file is asked for.
    Wear,
    /// Commands, and what they are called when they are undone.
    Give(Vec<Do>, &'static str),
    /// Points have so many trails, so long.
    Trails(TrailSettings),
    /// Seconds of the scene a second of wall time, in those of the scene itself.
    Pace(f64),
    /// A time that was seen already `[s]`.
    GoTo(f64),
    /// What is to be worked out to go to another time is not.
    Stay,
    /// Another branch, where it was left.
    ToBranch(usize),
    /// A branch is called so from now on; of an empty title, by what was done in it.
    CallBranch(usize, String),
    /// A branch is not listed any more.
    DiscardBranch(usize),
    /// Every island is moved by its own method, whatever that costs.
    Exact,
    /// What gave way to the load is taken back.
    TakeBack,
    /// What is plotted is to be written as a table, to a file that is asked for.
    WriteTable,
    /// The plot is, as a figure.
    WriteFigure,
    /// What was chosen is saved to a file.
    SaveTo(PathBuf),
    /// A scene that takes long to open is not waited for.
    StopOpening,
    /// The system's dialog for that file.
    BrowseToSave,
    /// The clip that is being written is not wanted.
    GiveUpClip,
    /// A session that was cut off is gone on with, by its place in the list.
    GoOnWithLeftover(usize),
    /// One is not wanted.
    DiscardLeftover(usize),
    /// None of the sessions that were cut off is wanted.
    DiscardLeftovers,
    /// What is offered stays in the gallery for later.
    PutOffLeftover,
    /// A file is opened by its name.
    OpenFile(String),
    /// One of those that were opened or saved last.
    OpenRecent(PathBuf),
}

/// What lies over the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sheet {
    /// Scenes to choose from.
    Gallery,
    /// The keys.
    Help,
    /// What is to be saved, and a name for the file.
    SaveTo,
    /// The name of a file to open, likewise.
    OpenFrom,
}

impl Sheet {
    /// Whether the world stands still behind it.
    pub(super) fn stops_time(self) -> bool {
        matches!(self, Sheet::SaveTo | Sheet::OpenFrom)
    }
}

/// What the panels keep from frame to frame.
#[derive(Default)]
pub(super) struct PanelState {
    pub(super) sheet: Option<Sheet>,
    pub(super) hides_panels: bool,
    pub(super) has_settings: bool,
    /// Something is selected, and shown to be.
    pub(super) has_selection: bool,
    /// Panels that stay open, the one that was opened last at the end.
    pub(super) opened: Vec<Opened>,
    /// The pointer rests on what gives joints stops: it is shown where they would be.
    pub(super) previews_stops: bool,
    /// Whether the hinge under the pointer has a motor, while the tool for these is taken; `None`: none is there.
    pub(super) hinge: Option<bool>,
    /// Where the panel of what is selected stands.
    pub(super) matter_at: MatterAt,
    /// For which of them the window has room at once.
    pub(super) room: Room,
    /// The tool that was taken: one that is held for a while opens and closes no panel.
    pub(super) tool: Tool,
    /// Where the keys lie that are to be held.
    pub(super) held_at: HeldAt,
    /// What is plotted; `None`: the panel is closed, and nothing is measured.
    pub(super) plots: Option<Plots>,
    /// What was, of the same world, when it was closed.
    pub(super) plots_left: Option<Plots>,
    /// Where their panel lies.
    pub(super) plots_at: PlotsAt,
    pub(super) lessons: Lessons,
    /// The field of that search is to get the focus.
    pub(super) finds_setting: bool,
    /// What is looked for in the settings.
    pub(super) settings_search: String,
    /// The setting that is being dragged.
    pub(super) gesture: Option<egui::Id>,
    pub(super) hides_hud: bool,
    /// What is looked for in the gallery.
    pub(super) search: String,
    /// What is looked for among the keys.
    pub(super) keys_search: String,
    /// The scene that Enter opens in the gallery, by its place among those that are found.
    pub(super) chosen: usize,
    /// Sessions that were cut off, the newest first: the file of each, and what is said of it.
    pub(super) leftovers: Vec<(PathBuf, String)>,
    /// Their pictures, by their files.
    pub(super) cut_off: BTreeMap<PathBuf, egui::TextureHandle>,
    /// What of them is asked whether it is to be discarded.
    pub(super) discards: Option<Discards>,
    /// All sessions that were cut off are listed.
    pub(super) lists_leftovers: bool,
    /// The name of a file that is to be written or opened.
    pub(super) path: String,
    /// Files that were opened or saved, the newest first.
    pub(super) recent: Vec<PathBuf>,
    /// What is said of the name of a file that is to be opened.
    pub(super) open_from: OpenFrom,
    /// What is said of the name of a file that is to be written.
    pub(super) save_to: SaveTo,
    /// The sheet has just been opened: what one writes in gets the focus.
    pub(super) is_fresh: bool,
    pub(super) notes: Notes,
    /// Thumbnails by the names of scenes.
    pub(super) thumbnails: BTreeMap<&'static str, egui::TextureHandle>,
    /// Those that are not there yet will be.
    pub(super) is_drawing_thumbnails: bool,
    /// The names of scenes that are in view in the gallery.
    pub(super) in_view: Vec<&'static str>,
}

/// What the panels show.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Facts {
    /// The name of the scene, as it is called in a list.
    pub(super) title: String,
    /// What is seen, and what to try: of scenes of the gallery.
    pub(super) caption: Option<[&'static str; 2]>,
    pub(super) figures: Figures,
    /// What undo would take back and redo would bring again, in words; `None`: nothing.
    pub(super) undoes: Option<String>,
    pub(super) redoes: Option<String>,
    /// Seconds of the scene a second of wall time, in those of the scene itself.
    pub(super) pace: f64,
    /// Greatest strain of bonds that keep their length `[1]`; `None` where there are none.
    pub(super) stretch: Option<f64>,
    /// Time from frame to frame `[s]`.
    pub(super) frame: f64,
    pub(super) tool: Tool,
    /// What the tool for building makes.
    pub(super) primitive: Primitive,
    /// What the tools for muscles and motors make.
    pub(super) drives: Drives,
    /// Whether the hinge under the pointer has a motor; `None`: none is there.
    pub(super) hinge: Option<bool>,
    /// Why nothing can be a muscle in the scene, and why no hinge can have a motor, where that is so.
    pub(super) no_muscles: Option<String>,
    pub(super) no_motors: Option<String>,
    /// What the tool for forces makes.
    pub(super) push: PushWay,
    /// What bodies are built of.
    pub(super) built_of: BuiltOf,
    /// What drawn bonds are made of.
    pub(super) links: Links,
    /// What the brush paints with.
    pub(super) brush: Brush,
    /// A drag beside all bodies is a free stroke.
    pub(super) draws_lasso: bool,
    /// What is selected is made of.
    pub(super) matter: Option<Arc<Matter>>,
    /// How soft bodies bear their weight while there is a brush in the hand.
    pub(super) bearings: Arc<Bearings>,
    /// What of that gives way: of what is selected, or was painted.
    pub(super) overload: Option<Arc<Overload>>,
    /// Where that is seen `[points]`.
    pub(super) chosen_at: Option<egui::Rect>,
    /// Some of it is in a group.
    pub(super) is_grouped: bool,
    /// The colour that its first body is filled with; `None` where it is not.
    pub(super) drawn_color: Option<[u8; 3]>,
    /// How many bodies are hidden.
    pub(super) hidden: usize,
    /// The keys that drives of the scene have, and which of them are held; the one that the mouse holds.
    pub(super) keys: Vec<(Key, bool)>,
    pub(super) key_by_mouse: Option<Key>,
    /// Where what they drive is seen, until those keys have a place `[points]`.
    pub(super) driven_at: Option<egui::Rect>,
    /// How the world looks.
    pub(super) look: Look,
    /// In which colours.
    pub(super) palette: Palette,
    /// How bodies are shown.
    pub(super) showing: Showing,
    /// The scene is that of a picture, which can be cut out anew.
    pub(super) has_picture: bool,
    /// The scene is one to paint on.
    pub(super) is_canvas: bool,
    /// The world waits: something lies over it.
    pub(super) waits: bool,
    /// That is a question, which leaves the panels where they are.
    pub(super) asks: bool,
    /// Another scene is being made.
    pub(super) is_opening: bool,
    /// Nothing of it is there yet: for how long it is being made, and how far that is.
    pub(super) opening: Option<Opening>,
    /// Another time that is gone to and is not there yet.
    pub(super) going: Option<Going>,
    /// A step takes long.
    pub(super) is_busy: bool,
    /// How much of a clip is drawn that is being written, 0 to 1.
    pub(super) filming: Option<f32>,
    pub(super) dimensions: usize,
    /// Corners of what of the plane is seen `[m]`.
    pub(super) seen: [[f64; 2]; 2],
    /// Corners of the walls that would be put up `[m]`.
    pub(super) new_walls: [[f64; 3]; 2],
    /// Where points are seen, some of many, while the plots have no place yet `[points]`.
    pub(super) points: Vec<egui::Pos2>,
    /// The worlds that are side by side; none where there is but one.
    pub(super) neighbors: Vec<Neighbor>,
    /// Whether points have trails, and which.
    pub(super) trails: (bool, TrailSettings),
    /// They are coloured by their distance to the first.
    pub(super) tints_distance: bool,
    /// Why solvers cannot run the scene, of those that cannot.
    pub(super) misfits: Misfits,
    pub(super) settings: Settings,
}

/// A time that something takes `[s]`, short: from a second on in seconds.
pub(super) fn short(time: f64) -> String {
    if time < 1.0 { format!("{:.0} ms", 1e3 * time) } else { format!("{time:.0} s") }
}

/// A button that says its name and its key when the pointer rests on it.
fn button(ui: &mut egui::Ui, text: &str, name: &str, action: Action, wishes: &mut Vec<Wish>) {
    let said = described(name, action);
    if ui.button(text).on_hover_text(said).clicked() {
        wishes.push(Wish::Act(action));
    }
}

/// The same with a sign in place of words.
fn icon(ui: &mut egui::Ui, icon: Icon, name: &str, action: Action, wishes: &mut Vec<Wish>) {
    let said = described(name, action);
    if icons::button(ui, icon, name, icons::SMALL, false).on_hover_text(said).clicked() {
        wishes.push(Wish::Act(action));
    }
}

/// A name with the key beside it.
fn described(name: &str, action: Action) -> String {
    super::keys::keys_of(action).map_or_else(|| name.to_owned(), |keys| format!("{name} ({keys})"))
}
