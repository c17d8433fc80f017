//! The name of a file to open, where the system has no dialog for it: what is there that begins so is listed below.

use std::ops::Range;
use std::path::{Path, PathBuf};

use egui::{Align, Button, Key, Label, Layout, RichText, Role, ScrollArea, TextEdit, WidgetInfo};

use super::save_to::WIDE;
use super::theme::colors;
use super::typed::takes_words;
use super::{PanelState, Wish, sheet};
use crate::app::fetch::ENDINGS;

/// Said where the field is empty.
const NO_NAME: &str = "write a name first, or choose one from the list";
/// Said below the buttons.
const HINT: &str = "Tab completes; a file can be dropped on the window too";
/// Said of a file that is there and ends otherwise than those that are listed.
const UNLISTED: &str = "its ending is that of no picture, scene or recording";
/// So many files are listed at most.
const MOST: usize = 200;
/// Height of the list, and of the rest of the sheet `[points]`.
const HIGH: f32 = 220.0;
const BESIDE: f32 = 130.0;
const LEAST: f32 = 48.0;

/// What the sheet keeps.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct OpenFrom {
    /// Why what was asked for last cannot be opened.
    pub(in crate::app) fault: Option<String>,
    /// What the list is of, and the names in it, folders with a `/`.
    listed: Option<(String, Vec<String>)>,
    /// What it began with is in view.
    is_seen: bool,
}

impl OpenFrom {
    /// With the path of a file: all that lies beside it is listed, as if it had been chosen there.
    pub(in crate::app) fn at(path: &str) -> Self {
        let folder = split(path).0;
        let listed = (!folder.is_empty()).then(|| (path.to_owned(), found(&meant(folder), "")));
        OpenFrom { listed, ..OpenFrom::default() }
    }
}

pub(super) fn show(context: &egui::Context, state: &mut PanelState, wishes: &mut Vec<Wish>) {
    let stays = sheet::show(context, "open from", "Open", |ui| {
        // So much stands beside the list.
        let [width, high] = sheet::fitting(context, [WIDE, HIGH + BESIDE]);
        ui.set_width(width);
        // Tab completes: it leads nowhere else here.
        let completes = ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::Tab));
        let hint = "the path of a scene, a recording or a picture";
        let field = TextEdit::singleline(&mut state.path)
            .id(field_id())
            .hint_text(hint)
            .desired_width(f32::INFINITY)
            .lock_focus(true);
        let mut field = field.show(ui);
        takes_words(&field.response);
        field.response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, hint));
        if field.response.changed() {
            state.open_from.fault = None;
            if let Some(path) = anew(&state.path) {
                state.path = path;
                to_end(ui, &mut field, &state.path);
            }
        }
        if std::mem::take(&mut state.is_fresh) {
            select(ui, &mut field, name(&state.path));
            field.response.request_focus();
        }
        let is_entered = sheet::entered(ui, &field.response);
        let names = names(&mut state.open_from, &state.path);
        if completes && let Some(more) = completed(&state.path, &names) {
            state.path = more;
            to_end(ui, &mut field, &state.path);
            field.response.request_focus();
        }
        list(ui, (&names, high - BESIDE), state, wishes);
        // Its line is there before it is, so that the buttons stay where they are.
        let fault = state.open_from.fault.as_deref().unwrap_or(" ");
        ui.add(Label::new(RichText::new(fault).color(colors(ui).away)).wrap());
        ui.horizontal_wrapped(|ui| {
            let open = Button::new(RichText::new("Open").color(colors(ui).on_accent)).fill(colors(ui).accent);
            match ui.add(open).clicked() || is_entered {
                true if state.path.trim().is_empty() => state.open_from.fault = Some(NO_NAME.to_owned()),
                true => wishes.push(Wish::OpenFile(state.path.trim().to_owned())),
                false => {}
            }
            if ui.button("Cancel").clicked() {
                state.sheet = None;
            }
        });
        // Beside the buttons it would begin there and go on below them.
        ui.add(Label::new(RichText::new(HINT).color(colors(ui).weak)).wrap());
    });
    if !stays {
        state.sheet = None;
    }
}

/// The field that the name is written in.
fn field_id() -> egui::Id {
    egui::Id::unique("the path of a file to open")
}

/// What is written next comes at the end.
fn to_end(ui: &egui::Ui, field: &mut egui::text_edit::TextEditOutput, text: &str) {
    let end = text.chars().count();
    select(ui, field, end..end);
}

/// What is written next comes in the place of these letters.
pub(super) fn select(ui: &egui::Ui, field: &mut egui::text_edit::TextEditOutput, Range { start, end }: Range<usize>) {
    let [start, end] = [start, end].map(egui::text::CCursor::new);
    field.state.cursor.set_char_range(Some(egui::text::CCursorRange::two(start, end)));
    field.state.clone().store(ui.ctx(), field.response.id);
}

/// What begins as the name does: a click takes it, a second one opens it. The list stays as it is until one goes on writing.
fn list(ui: &mut egui::Ui, (names, high): (&[String], f32), state: &mut PanelState, wishes: &mut Vec<Wish>) {
    let high = high.max(LEAST);
    let scroll = ScrollArea::vertical().max_height(high).min_scrolled_height(high).auto_shrink(false);
    // A row is pressed wherever one presses on it.
    scroll.show(ui, |ui| {
        ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            let folder = split(&state.path).0.to_owned();
            if let Some(above) = above(&folder)
                && ui.selectable_label(false, "..").on_hover_text("the folder above").clicked()
            {
                take(state, above, None);
            }
            for name in names {
                let path = format!("{folder}{name}");
                let label = ui.selectable_label(state.path == path, name);
                if state.path == path && !state.open_from.is_seen {
                    label.scroll_to_me(Some(Align::Center));
                    state.open_from.is_seen = true;
                }
                if label.double_clicked() && !name.ends_with('/') {
                    wishes.push(Wish::OpenFile(path));
                } else if label.clicked() {
                    let stays = (!name.ends_with('/')).then_some(names);
                    take(state, path, stays);
                }
            }
            // What is written may be the whole name of what is not listed; why it cannot be opened says more.
            if names.is_empty() && state.open_from.fault.is_none() {
                let words = if meant(&state.path).is_file() { UNLISTED } else { "nothing there begins so" };
                ui.label(RichText::new(words).color(colors(ui).weak));
            }
        })
    });
}

/// A path was chosen in the list, which stays if it is of these names.
fn take(state: &mut PanelState, path: String, stays: Option<&[String]>) {
    state.open_from.listed = stays.map(|names| (path.clone(), names.to_vec()));
    (state.path, state.is_fresh, state.open_from.fault) = (path, true, None);
}

/// The folder above one, as it is written; `None` above all.
fn above(folder: &str) -> Option<String> {
    let bare = folder.trim_end_matches('/');
    match bare.rsplit('/').next().unwrap_or_default() {
        "" if folder.is_empty() => Some("../".to_owned()),
        "" => None,
        "." => Some(format!("{bare}./")),
        ".." => Some(format!("{bare}/../")),
        "~" if bare == "~" => meant("~/").parent().map(|above| format!("{}/", above.display())),
        _ => Some(split(bare).0.to_owned()),
    }
}

/// The folder as it is written, with its last `/`, and what is written of the name.
fn split(path: &str) -> (&str, &str) {
    path.split_at(path.rfind('/').map_or(0, |place| place + 1))
}

/// Where in a path the name of its file stands, in letters: what is typed takes its place.
fn name(path: &str) -> Range<usize> {
    let (folder, name) = split(path);
    let from = folder.chars().count();
    from..from + name.chars().count()
}

/// A whole path that was put behind a folder is meant by itself.
fn anew(path: &str) -> Option<String> {
    let from = path.rfind("//").map(|at| at + 1).or_else(|| path.rfind("/~/").map(|at| at + 1))?;
    Some(path[from..].to_owned())
}

/// A path as it is meant: `~/` is the home of the user.
pub(in crate::app) fn meant(path: &str) -> PathBuf {
    match (path.strip_prefix("~/"), etcetera::home_dir()) {
        (Some(rest), Ok(home)) => home.join(rest),
        _ => PathBuf::from(path),
    }
}

/// What could be opened in the folder of a path and begins as its name does; read once for each path.
fn names(kept: &mut OpenFrom, path: &str) -> Vec<String> {
    if kept.listed.as_ref().is_none_or(|(of, _)| of != path) {
        let (folder, begun) = split(path);
        let folder = if folder.is_empty() { PathBuf::from(".") } else { meant(folder) };
        kept.listed = Some((path.to_owned(), found(&folder, begun)));
    }
    kept.listed.as_ref().map_or_else(Vec::new, |(_, names)| names.clone())
}

fn found(folder: &Path, begun: &str) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let name = |entry: std::fs::DirEntry| {
        let (name, path) = (entry.file_name().into_string().ok()?, entry.path());
        let is_hidden = name.starts_with('.') && !begun.starts_with('.');
        if is_hidden || !name.to_lowercase().starts_with(&begun.to_lowercase()) {
            return None;
        }
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
        match path.is_dir() {
            true => Some(format!("{name}/")),
            false => ENDINGS.contains(&&*ending).then_some(name),
        }
    };
    let mut names: Vec<String> = entries.filter_map(|entry| name(entry.ok()?)).collect();
    names.sort_unstable_by_key(|name| (!name.ends_with('/'), name.to_lowercase()));
    names.truncate(MOST);
    names
}

/// The path with what all names that begin so have in common; `None` where that is no more.
fn completed(path: &str, names: &[String]) -> Option<String> {
    let (folder, begun) = split(path);
    let first = names.first()?;
    let is_common = |count: usize| {
        let start: String = first.chars().take(count).collect();
        names.iter().all(|name| name.starts_with(&start))
    };
    let count = (0..=first.chars().count()).take_while(|&count| is_common(count)).last()?;
    let common: String = first.chars().take(count).collect();
    (common.len() > begun.len()).then(|| format!("{folder}{common}"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn the_list_stays_where_a_file_of_it_is_taken_and_goes_up() {
        let mut state = PanelState { path: "/no/such/r".to_owned(), ..PanelState::default() };
        let listed = ["rim-1.json".to_owned(), "rope.png".to_owned()];
        take(&mut state, "/no/such/rim-1.json".to_owned(), Some(&listed));
        let path = state.path.clone();
        assert_eq!(names(&mut state.open_from, &path), listed);
        assert!(names(&mut state.open_from, "/no/such/rim-1.jso").is_empty(), "what is written on is looked for");
        let ups = [("", "../"), ("../", "../../"), ("./", "../"), ("a/b/", "a/"), ("a/", ""), ("/tmp/", "/")];
        for (folder, up) in ups {
            assert_eq!(above(folder).as_deref(), Some(up), "above {folder}");
        }
        assert_eq!(above("/"), None);
        assert!(above("~/").is_some_and(|up| up.starts_with('/') && up.ends_with('/')));
    }

    #[test]
    fn what_can_be_opened_is_listed_and_completed() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["rim-1.json", "rim-2.json", "notes.txt", "rope.PNG", ".hidden.json"] {
            std::fs::write(folder.path().join(name), b"").unwrap();
        }
        std::fs::create_dir(folder.path().join("ribbons")).unwrap();
        let base = format!("{}/", folder.path().display());
        let mut kept = OpenFrom::default();
        assert_eq!(names(&mut kept, &base), ["ribbons/", "rim-1.json", "rim-2.json", "rope.PNG"]);
        let path = format!("{base}ri");
        let of_rims = names(&mut kept, &format!("{base}rim"));
        assert_eq!(of_rims, ["rim-1.json", "rim-2.json"]);
        assert_eq!(completed(&format!("{base}rim"), &of_rims), Some(format!("{base}rim-")));
        assert_eq!(completed(&path, &names(&mut kept, &path)), None, "ribbons and rims part there");
        assert_eq!(names(&mut kept, &format!("{base}.h")), [".hidden.json"]);
        assert!(names(&mut kept, "/no/such/folder/").is_empty());
        assert_eq!((name("/a/ä/b.json"), name("/a/"), name("b.json")), (5..11, 3..3, 0..6));
        for (typed, is_meant) in
            [("/a//b/c.json", Some("/b/c.json")), ("/a/~/c.json", Some("~/c.json")), ("/a/b", None)]
        {
            assert_eq!(anew(typed).as_deref(), is_meant, "{typed}");
        }
        assert_eq!(meant("~/x.json"), etcetera::home_dir().unwrap().join("x.json"));
        assert_eq!(meant("a/b.json"), PathBuf::from("a/b.json"));
    }
}
