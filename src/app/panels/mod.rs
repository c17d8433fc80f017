//! The panels: a bar below, tools at the left, figures, what is said, and sheets over the world. They return wishes and change
//! nothing of the world.

mod beside;
#[cfg(test)]
mod beside_tests;
mod dial;
mod drives;
mod gallery;
mod held;
mod help;
mod hud;
mod icons;
mod legend;
mod lessons;
#[cfg(test)]
mod lessons_tests;
mod material;
#[cfg(test)]
mod material_tests;
mod moving;
mod notes;
mod palette;
mod plots;
#[cfg(test)]
mod plots_tests;
#[cfg(test)]
mod pointer;
mod primitives;
mod save_to;
mod settings;
#[cfg(test)]
mod settings_tests;
pub(super) mod theme;
mod top;
mod transport;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::action::{Action, Primitive, Showing, Tool};
use super::matter::{Matter, MatterChange};
use super::player::Figures;
use super::plots::Plots;
use super::tools::{Brush, Drives};
use crate::render::{Look, Overlay};
use crate::scene::{BesideKeys, SolverName};
use crate::sim::Key;
pub(super) use beside::Neighbor;
pub(super) use gallery::{THUMBNAIL, search_id};
use icons::Icon;
pub(super) use lessons::{At, Lessons};
pub(super) use notes::Notes;
pub(super) use settings::{Setting, Settings};

/// Room that the tools take at the left edge `[points]`.
pub(super) const TOOLS: f32 = 60.0;

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
    /// The tools for muscles and motors make these from now on.
    Drives(Drives),
    /// What is selected gets another matter; of the same drag as the last one.
    Matter(MatterChange, bool),
    /// The brush paints with this from now on.
    Brush(Brush),
    /// A drag beside all bodies is a free stroke from now on, or a box.
    Lasso(bool),
    /// Something is set of the scene.
    Set(Setting),
    /// The same start beside it, by this or as exact as can be.
    Beside(Option<BesideKeys>),
    /// What stands beside it at a place of the row is taken away.
    TakeAway(usize),
    /// What stands beside it is coloured by the distance.
    TintDistance(bool),
    /// Another solver, with all else of the method as it is.
    Solver(SolverName),
    /// Seconds of the scene a second of wall time, in those of the scene itself.
    Pace(f64),
    /// A time that was seen already `[s]`.
    GoTo(f64),
    /// The end of another branch.
    ToBranch(usize),
    /// Every island is moved by its own method, whatever that costs.
    Exact,
    /// What gave way to the load is taken back.
    TakeBack,
    /// What is plotted is written to a file, as a table.
    WriteTable,
    /// All that was done is saved to a file.
    SaveTo(PathBuf),
    /// The session that is offered is gone on with.
    GoOnWithLeftover,
    /// It is not wanted.
    DiscardLeftover,
}

/// What lies over the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sheet {
    /// Scenes to choose from.
    Gallery,
    /// The keys.
    Help,
    /// A name for a file, where the system has no dialog for it.
    SaveTo,
}

/// What the panels keep from frame to frame.
#[derive(Default)]
pub(super) struct PanelState {
    pub(super) sheet: Option<Sheet>,
    pub(super) hides_panels: bool,
    pub(super) has_settings: bool,
    /// What is plotted; `None`: the panel is closed, and nothing is measured.
    pub(super) plots: Option<Plots>,
    pub(super) lessons: Lessons,
    /// The setting that is being dragged.
    pub(super) gesture: Option<egui::Id>,
    pub(super) hides_hud: bool,
    /// What is looked for in the gallery.
    pub(super) search: String,
    /// The scene that Enter opens in the gallery, by its place among those that are found.
    pub(super) chosen: usize,
    /// The name of a file that is to be written.
    pub(super) path: String,
    /// The sheet has just been opened: what one writes in gets the focus.
    pub(super) is_fresh: bool,
    pub(super) notes: Notes,
    /// Thumbnails by the names of scenes.
    pub(super) thumbnails: BTreeMap<&'static str, egui::TextureHandle>,
}

/// What the panels show.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Facts {
    /// The name of the scene, as it is called in a list.
    pub(super) title: String,
    /// What is seen, and what to try: of scenes of the gallery.
    pub(super) caption: Option<[&'static str; 2]>,
    pub(super) figures: Figures,
    /// Seconds of the scene a second of wall time, in those of the scene itself.
    pub(super) pace: f64,
    /// Time from frame to frame `[s]`.
    pub(super) frame: f64,
    pub(super) tool: Tool,
    /// What the tool for building makes.
    pub(super) primitive: Primitive,
    /// What the tools for muscles and motors make.
    pub(super) drives: Drives,
    /// What the brush paints with.
    pub(super) brush: Brush,
    /// A drag beside all bodies is a free stroke.
    pub(super) draws_lasso: bool,
    /// What is selected is made of.
    pub(super) matter: Option<Arc<Matter>>,
    /// The keys that drives of the scene have, and which of them are held.
    pub(super) keys: Vec<(Key, bool)>,
    /// How the world looks.
    pub(super) look: Look,
    /// How bodies are shown.
    pub(super) showing: Showing,
    /// The scene is that of a picture, which can be cut out anew.
    pub(super) has_picture: bool,
    /// The world waits: something lies over it.
    pub(super) waits: bool,
    /// Another scene is being made.
    pub(super) is_opening: bool,
    /// A step takes long.
    pub(super) is_busy: bool,
    pub(super) dimensions: usize,
    /// The worlds that are side by side; none where there is but one.
    pub(super) neighbors: Vec<Neighbor>,
    /// They are coloured by their distance to the first.
    pub(super) tints_distance: bool,
    pub(super) settings: Settings,
}

/// Shows the panels; returns what was asked for, and the height that they leave to the world `[points]`.
pub(super) fn show(ui: &mut egui::Ui, state: &mut PanelState, facts: &Facts) -> (Vec<Wish>, f32) {
    let mut wishes = Vec::new();
    if !state.hides_panels {
        transport::show(ui, facts, &mut wishes);
    }
    let room = ui.available_rect_before_wrap();
    // What lies over the world has the room for itself.
    let is_covered = state.sheet.is_some();
    if !state.hides_panels && !is_covered {
        top::show(ui.ctx(), room, facts, &mut wishes);
        palette::show(ui.ctx(), room, state, facts, &mut wishes);
    }
    if state.has_settings && !state.hides_panels && !is_covered {
        settings::show(ui.ctx(), room, state, facts, &mut wishes);
    }
    if let Some(plots) = state.plots.as_mut().filter(|_| !state.hides_panels && !is_covered) {
        plots::show(ui.ctx(), room, plots, &mut wishes);
    }
    // What lies at the right edge, from there on: the settings, then the lessons.
    let at_edge = if state.has_settings && !state.hides_panels { settings::WIDTH + GAP } else { 0.0 };
    let has_lessons = state.lessons.is_open && !state.hides_panels && !is_covered && lessons::has_room(room, at_edge);
    if has_lessons {
        lessons::show(ui.ctx(), (room, at_edge), &mut state.lessons, &mut wishes);
    }
    if !state.hides_hud && room.width() > 560.0 && !is_covered {
        let at_edge = if has_lessons { at_edge + lessons::WIDTH + GAP } else { at_edge };
        let beside = if room.height() < settings::TALL { at_edge } else { 0.0 };
        hud::show(ui.ctx(), (room, beside), facts, &mut wishes);
    }
    held::show(ui.ctx(), room, facts);
    if facts.look.overlay == Overlay::Strain {
        legend::show(ui.ctx(), &facts.look);
    }
    if !state.hides_hud && !is_covered {
        beside::titles(ui.ctx(), facts, state.notes.has_caption && facts.caption.is_some());
    }
    state.notes.show(ui.ctx(), room, facts, &mut wishes);
    match state.sheet {
        Some(Sheet::Gallery) => gallery::show(ui.ctx(), room, state, facts, &mut wishes),
        Some(Sheet::Help) => help::show(ui.ctx(), room, state),
        Some(Sheet::SaveTo) => save_to::show(ui.ctx(), state, &mut wishes),
        None => {}
    }
    (wishes, room.height())
}

/// A time that something takes `[s]`, short: from a second on in seconds.
fn short(time: f64) -> String {
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
