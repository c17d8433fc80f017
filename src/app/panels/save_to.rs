//! What is to be saved, and the name of the file that is to be written.

use std::ops::Range;
use std::path::{Path, PathBuf};

use egui::{Button, DragValue, Label, Response, RichText, Role, TextEdit, WidgetInfo};

use super::open_from::{meant, select};
use super::theme::colors;
use super::typed::takes_words;
use super::{PanelState, Wish, ranged, sheet, ticks};
use crate::app::film::ClipSettings;
use crate::app::saving::Kind;

/// Width of the sheet `[points]`.
pub(super) const WIDE: f32 = 460.0;

/// What the sheet keeps.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct SaveTo {
    /// Why it cannot be written there, or not yet.
    fault: Option<String>,
    /// A file that is there already, and was asked for once: asked for again it is replaced.
    asked: Option<PathBuf>,
    /// The file that is being written.
    written: Option<PathBuf>,
    /// What is saved.
    pub(in crate::app) kind: Saved,
    /// How long a clip is, and how wide.
    pub(in crate::app) clip: ClipSettings,
}

/// What can be saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Saved {
    /// The scene as it stands.
    #[default]
    Moment,
    /// All that was done.
    All,
    /// The last seconds as they are seen.
    Clip,
    /// What is plotted, as numbers.
    Table,
    /// The plot that is looked at.
    Figure,
}

impl Saved {
    /// What a file of it ends in where nobody says otherwise.
    fn ending(self) -> &'static str {
        match self {
            Saved::Moment => "json",
            Saved::All => "jsonl",
            Saved::Clip => "gif",
            Saved::Table => "csv",
            Saved::Figure => "svg",
        }
    }

    /// Whether it is of the scene, and one of what can be chosen; what is plotted is written by its own buttons.
    pub(in crate::app) fn is_of_scene(self) -> bool {
        matches!(self, Saved::Moment | Saved::All | Saved::Clip)
    }

    /// What else writes a file that is called so, in words.
    fn hint(self, path: &Path) -> &'static str {
        match self {
            Saved::Table | Saved::Figure => "",
            _ if Saved::Clip.takes(path) => " (choose a clip above)",
            _ => " (F2 writes a picture)",
        }
    }

    /// What it is called, of a file.
    fn words(self) -> &'static str {
        match self {
            Saved::Moment => "a scene",
            Saved::All => "a recording",
            Saved::Clip => "a clip",
            Saved::Table => "a table",
            Saved::Figure => "a figure",
        }
    }

    /// Whether its file may be called so: scenes and recordings may end as each other.
    fn takes(self, path: &Path) -> bool {
        match self {
            Saved::Moment | Saved::All => is_recording(path),
            _ => path.extension().is_some_and(|ending| ending == self.ending()),
        }
    }

    /// What files of its kind are called in a dialog, and what they end in.
    pub(in crate::app) fn filter(self) -> Kind {
        match self {
            Saved::Moment | Saved::All => ("Scenes and recordings", &ENDINGS),
            Saved::Clip => ("Animated pictures", &["gif"]),
            Saved::Table => ("Tables", &["csv"]),
            Saved::Figure => ("Figures", &["svg"]),
        }
    }
}

pub(super) fn show(context: &egui::Context, state: &mut PanelState, wishes: &mut Vec<Wish>) {
    let stays = sheet::show(context, "save to", "Save", |ui| {
        ui.set_width(sheet::fitting(context, [WIDE, 0.0])[0]);
        let was = state.save_to.kind;
        let kind = &mut state.save_to.kind;
        let has_focus = match kind {
            Saved::Table => ui.label(TABLE).has_focus(),
            Saved::Figure => ui.label(FIGURE).has_focus(),
            _ => kinds(ui, kind),
        };
        let has_changed = *kind != was;
        // On a ring that is chosen already Enter chooses nothing.
        let is_on_ring = has_focus && !has_changed;
        if *kind == Saved::Clip {
            clip(ui, &mut state.save_to.clip);
        }
        if has_changed {
            // What is named for the one is named for the other, but for its ending.
            state.path = state.save_to.renamed(&state.path);
            state.save_to.begin();
        }
        ui.add_space(4.0);
        let hint = "the path of the file that is to be written";
        let mut field = TextEdit::singleline(&mut state.path).hint_text(hint).desired_width(f32::INFINITY).show(ui);
        takes_words(&field.response);
        field.response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, hint));
        if std::mem::take(&mut state.is_fresh) {
            select(ui, &mut field, bare_name(&state.path));
            field.response.request_focus();
        }
        if field.response.changed() {
            state.save_to.begin();
        }
        let is_entered =
            sheet::entered(ui, &field.response) || is_on_ring && ui.input(|input| input.key_pressed(egui::Key::Enter));
        // Its line is there before it is, so that the buttons stay where they are.
        let fault = state.save_to.fault.as_deref().unwrap_or(" ");
        ui.add(Label::new(RichText::new(fault).color(colors(ui).away)).wrap());
        ui.horizontal_wrapped(|ui| {
            let words = if state.save_to.asked.is_some() { "Replace it" } else { "Save" };
            let save = Button::new(RichText::new(words).color(colors(ui).on_accent)).fill(colors(ui).accent);
            let is_free = state.save_to.written.is_none();
            let is_clicked = ui.add_enabled(is_free, save).clicked();
            match (is_clicked || is_entered) && is_free {
                true if state.path.trim().is_empty() => state.save_to.complain(NO_NAME),
                true => ask(state, wishes),
                false => {}
            }
            if ui.button("Browse").on_hover_text("the system's dialog for files, if it has one").clicked() {
                wishes.push(Wish::BrowseToSave);
            }
            if ui.button("Cancel").clicked() {
                state.sheet = None;
            }
            ui.weak(format!(".{} is added if left out", state.save_to.ending()));
        });
    });
    if !stays {
        state.sheet = None;
    }
}

/// Said where the field is empty.
const NO_NAME: &str = "write a name for the file first";
/// What can be saved.
const MOMENT: &str = "the scene as it stands";
const ALL: &str = "all that was done, as a recording";
const CLIP: &str = "a clip, as an animated picture (.gif)";

/// What is written of the plots.
const TABLE: &str = "what is plotted, as a table (.csv)";
const FIGURE: &str = "the plot as it is seen, as a figure (.svg)";

/// What of the scene is saved. Returns whether one of its rings has the keyboard.
fn kinds(ui: &mut egui::Ui, kind: &mut Saved) -> bool {
    let rings = [
        (Saved::Moment, MOMENT, "opened, it goes on from here, without what was done before"),
        (Saved::All, ALL, "a recording: opened, it is replayed from its start"),
        (Saved::Clip, CLIP, "the last seconds as they are seen, without panels: for others to look at"),
    ];
    let rings = rings.map(|(own, words, more)| ticks::one_of(ui, kind, own, words).on_hover_text(more));
    rings.iter().any(Response::has_focus)
}

/// How long a clip is, and how wide.
fn clip(ui: &mut egui::Ui, settings: &mut ClipSettings) {
    let ([shortest, longest], [narrowest, widest]) = (ClipSettings::SECONDS, ClipSettings::WIDTHS);
    ui.horizontal_wrapped(|ui| {
        ui.weak("of the last");
        let seconds = DragValue::new(&mut settings.seconds).speed(0.1).max_decimals(1).suffix(" s");
        ranged::field(ui, seconds, shortest..=longest, "s").on_hover_text("how long it is, if there is as much");
        ui.weak("and so wide:");
        let width = DragValue::new(&mut settings.width).speed(4.0).suffix(" px");
        ranged::field(ui, width, f64::from(narrowest)..=f64::from(widest), "px")
            .on_hover_text("the width of its pictures");
    });
}

/// What is written is to be the path: its ending is added where it has none, so that one sees what is written.
pub(in crate::app) fn ask(state: &mut PanelState, wishes: &mut Vec<Wish>) {
    let path = with_ending(meant(state.path.trim()), state.save_to.ending());
    state.path = path.display().to_string();
    match state.save_to.ask(path) {
        Some(path) => wishes.push(Wish::SaveTo(path)),
        None => state.is_fresh = true,
    }
}

/// A path with an ending, where it has no other.
fn with_ending(path: PathBuf, ending: &str) -> PathBuf {
    let is_bare = path.extension().is_none() && path.file_name().is_some() && !path.is_dir();
    if is_bare { path.with_extension(ending) } else { path }
}

/// Where in a path the name of its file stands, without its ending, in letters: what is typed takes its place.
fn bare_name(path: &str) -> Range<usize> {
    let from = path.rfind(['/', std::path::MAIN_SEPARATOR]).map_or(0, |before| before + 1);
    let name = &path[from..];
    let bare = without_ending(name).unwrap_or(name);
    let letters = |bytes: usize| path[..bytes].chars().count();
    letters(from)..letters(from + bare.len())
}

/// A path without what files end in that are written here.
fn without_ending(path: &str) -> Option<&str> {
    let endings = [Saved::Moment, Saved::All, Saved::Clip, Saved::Table, Saved::Figure].map(Saved::ending);
    endings.iter().find_map(|known| path.strip_suffix(&format!(".{known}")))
}

/// Whether a path ends as a recording does.
pub(in crate::app) fn is_recording(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known))
}

/// What scenes end in, and recordings; either may end as the other.
const ENDINGS: [&str; 2] = ["json", "jsonl"];

impl SaveTo {
    /// Of another file, for what is to be written: clips are as they were set for the last one.
    pub(in crate::app) fn of(kind: Saved, clip: ClipSettings) -> Self {
        SaveTo { kind, clip, ..SaveTo::default() }
    }

    /// Another path: what was said of the last one goes.
    pub(in crate::app) fn begin(&mut self) {
        (self.fault, self.asked, self.written) = (None, None, None);
    }

    /// What a file of what is chosen ends in.
    pub(in crate::app) fn ending(&self) -> &'static str {
        self.kind.ending()
    }

    /// Whether what is chosen may be written to a file that is called so.
    pub(in crate::app) fn takes(&self, path: &Path) -> bool {
        self.kind.takes(path)
    }

    /// A path with that ending in place of the other.
    fn renamed(&self, path: &str) -> String {
        match without_ending(path) {
            Some(bare) => format!("{bare}.{}", self.ending()),
            None => path.to_owned(),
        }
    }

    /// A file begins to be written.
    pub(in crate::app) fn begin_to_write(&mut self, path: &Path) {
        self.written = Some(path.to_owned());
    }

    /// A file was written. Returns whether it is the one that was named here.
    pub(in crate::app) fn is_written(&mut self, path: &Path) -> bool {
        self.written.take_if(|written| written == path).is_some()
    }

    /// A file could not be written. Returns whether it is the one that was named here.
    pub(in crate::app) fn failed(&mut self, why: &str) -> bool {
        let is_own = self.written.take().is_some();
        if is_own {
            self.complain(why);
        }
        is_own
    }

    /// Something went wrong.
    pub(in crate::app) fn complain(&mut self, fault: &str) {
        self.fault = Some(fault.to_owned());
    }

    /// Somebody wants to write there. Returns the path if that can be, and if what is there already may go.
    fn ask(&mut self, path: PathBuf) -> Option<PathBuf> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let fault = match () {
            () if path.is_dir() => Some(format!("`{}` is a folder: add a name", path.display())),
            () if !folder.is_dir() => Some(format!("there is no folder `{}`", folder.display())),
            () if !self.takes(&path) => Some(format!(
                "what ends in `.{}` is not written: {} ends in .{}{}",
                path.extension().unwrap_or_default().display(),
                self.kind.words(),
                self.ending(),
                self.kind.hint(&path)
            )),
            () if path.exists() && self.asked.as_ref() != Some(&path) => {
                self.asked = Some(path.clone());
                self.fault = Some("there is a file of that name: once more to replace it".to_owned());
                return None;
            }
            () => None,
        };
        self.asked = None;
        self.fault = fault;
        self.fault.is_none().then_some(path)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_replaced_unasked_and_no_folder_is_made() {
        let folder = tempfile::tempdir().unwrap();
        let (old, new) = (folder.path().join("old.json"), folder.path().join("new.json"));
        std::fs::write(&old, "{}").unwrap();
        let mut state = SaveTo::default();
        assert_eq!(state.ask(new.clone()), Some(new.clone()));
        assert_eq!(state.ask(old.clone()), None);
        assert!(state.fault.as_deref().is_some_and(|fault| fault.contains("once more")));
        assert_eq!(state.ask(old.clone()), Some(old.clone()), "asked for again");
        assert_eq!(state.ask(old), None, "and the next time it is asked anew");
        assert_eq!(with_ending(folder.path().join("mine"), "json"), folder.path().join("mine.json"));
        for kept in [folder.path().to_owned(), folder.path().join("a.jsonl"), folder.path().join("a.png")] {
            assert_eq!(with_ending(kept.clone(), "json"), kept);
        }
        for (path, words) in [
            (folder.path().to_owned(), "is a folder"),
            (folder.path().join("no/x.json"), "no folder"),
            (folder.path().join("x.png"), "`.png` is not written: a scene ends in .json (F2"),
        ] {
            assert_eq!(state.ask(path), None);
            assert!(state.fault.as_deref().is_some_and(|fault| fault.contains(words)), "{:?}", state.fault);
        }
        assert!(!folder.path().join("no").exists());
        assert_eq!(state.ask(folder.path().join("x.gif")), None);
        assert!(state.fault.as_deref().is_some_and(|fault| fault.contains("a scene ends in .json (choose a clip")));
        let mut clip = SaveTo { kind: Saved::Clip, ..SaveTo::default() };
        let moving = folder.path().join("x.gif");
        assert_eq!((clip.ask(moving.clone()), clip.ask(new)), (Some(moving), None));
        assert!(clip.fault.is_some_and(|fault| fault.contains("`.json` is not written: a clip ends in .gif")));
        let mut all = SaveTo { kind: Saved::All, ..SaveTo::default() };
        assert_eq!(all.ask(folder.path().join("x.png")), None);
        assert!(all.fault.is_some_and(|fault| fault.contains("a recording ends in .jsonl")));
    }

    #[test]
    fn tables_and_figures_are_asked_for_their_names_and_end_in_their_own_ways() {
        let folder = tempfile::tempdir().unwrap();
        let old = folder.path().join("old.csv");
        std::fs::write(&old, "t").unwrap();
        let [mut table, mut figure] =
            [Saved::Table, Saved::Figure].map(|kind| SaveTo::of(kind, ClipSettings::default()));
        assert_eq!([&table, &figure].map(|of| of.ending()), ["csv", "svg"]);
        assert_eq!(table.ask(old.clone()), None, "what is there is asked about");
        assert_eq!(table.ask(old.clone()), Some(old.clone()));
        assert_eq!((table.ask(folder.path().join("scene.json")), figure.ask(old)), (None, None));
        assert!(table.fault.is_some_and(|fault| fault.ends_with("a table ends in .csv")));
        assert!(figure.fault.is_some_and(|fault| fault.ends_with("a figure ends in .svg")));
        assert_eq!(bare_name("/a/wobble-rim-001.svg").len(), "wobble-rim-001".len());
        let mut state =
            PanelState { save_to: SaveTo::of(Saved::Figure, ClipSettings::default()), ..Default::default() };
        state.path = folder.path().join("mine").display().to_string();
        let mut wishes = Vec::new();
        ask(&mut state, &mut wishes);
        assert_eq!(wishes, [Wish::SaveTo(folder.path().join("mine.svg"))]);
    }

    #[test]
    fn the_name_of_the_file_is_selected_and_neither_its_folder_nor_its_ending() {
        for (path, name) in [
            ("/home/ada/wobble-rim-001.json", "wobble-rim-001"),
            ("/home/åda/mein Rad.jsonl", "mein Rad"),
            ("mine", "mine"),
            ("/a/b.c/", ""),
            ("/a/v1.2", "v1.2"),
        ] {
            let range = bare_name(path);
            let selected: String = path.chars().skip(range.start).take(range.len()).collect();
            assert_eq!(selected, name, "{path}");
        }
    }

    #[test]
    fn a_recording_and_a_clip_end_otherwise_than_a_scene() {
        let [scene, recording, clip] =
            [Saved::Moment, Saved::All, Saved::Clip].map(|kind| SaveTo { kind, ..SaveTo::default() });
        assert_eq!([scene.ending(), recording.ending(), clip.ending()], ["json", "jsonl", "gif"]);
        assert_eq!(clip.renamed("/a/wobble-x-001.jsonl"), "/a/wobble-x-001.gif");
        assert_eq!(scene.renamed("/a/wobble-x-001.gif"), "/a/wobble-x-001.json");
        assert_eq!(recording.renamed("/a/wobble-x-001.json"), "/a/wobble-x-001.jsonl");
        assert_eq!(scene.renamed("/a/wobble-x-001.jsonl"), "/a/wobble-x-001.json");
        assert_eq!(recording.renamed("/a/mine"), "/a/mine", "what has no ending gets it when it is written");
        assert_eq!(with_ending(PathBuf::from("mine"), recording.ending()), PathBuf::from("mine.jsonl"));
        assert_eq!(SaveTo::default().kind, Saved::Moment, "the next file is of the scene again");
    }

    #[test]
    fn what_could_not_be_written_is_said_where_it_was_named() {
        let mut state = SaveTo::default();
        assert!(!state.failed("the disk is full"), "nothing was named here");
        assert_eq!(state.fault, None);
        let path = PathBuf::from("mine.json");
        state.begin_to_write(&path);
        assert!(!state.is_written(Path::new("shot.png")), "another file");
        assert!(state.failed("the disk is full"));
        assert_eq!(state.fault.as_deref(), Some("the disk is full"));
        state.begin();
        state.begin_to_write(&path);
        assert!(state.is_written(&path) && !state.is_written(&path));
    }
}
