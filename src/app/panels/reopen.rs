//! The button that opens a file: where some were opened or saved before, a menu of those, the newest first.

use std::path::{Path, PathBuf};

use egui::{Button, Popup, Ui};

use super::icons::{self, Icon};
use super::{Wish, described};
use crate::app::action::Action;

/// Width of the menu `[points]`.
const WIDTH: f32 = 280.0;
/// What it does.
const OPEN: &str = "open a scene, a recording or a picture";

/// The button, with its word where there is room. What is gone is left out of the menu; where nothing is left there is none.
pub(super) fn button(ui: &mut Ui, has_word: bool, recent: &[PathBuf], wishes: &mut Vec<Wish>) {
    let button = icons::worded(ui, Icon::Open, "Open", (has_word, false));
    if recent.is_empty() {
        if button.clicked() {
            wishes.push(Wish::Act(Action::Open));
        }
    } else {
        Popup::menu(&button).width(WIDTH).show(|ui| menu(ui, recent, wishes));
    }
    button.on_hover_text(described(OPEN, Action::Open));
}

fn menu(ui: &mut Ui, recent: &[PathBuf], wishes: &mut Vec<Wish>) {
    ui.set_min_width(WIDTH);
    if ui.button("Choose a file …").on_hover_text(described(OPEN, Action::Open)).clicked() {
        wishes.push(Wish::Act(Action::Open));
    }
    ui.separator();
    let there: Vec<&PathBuf> = recent.iter().filter(|path| path.is_file()).collect();
    ui.weak(if there.is_empty() { "what was opened last is gone" } else { "Open recent" });
    for path in there {
        let [name, folder] = words(path);
        let button = Button::new(name).shortcut_text(folder).truncate();
        if ui.add(button).on_hover_text(path.display().to_string()).clicked() {
            wishes.push(Wish::OpenRecent(path.clone()));
        }
    }
}

/// The name of a file, and that of its folder.
fn words(path: &Path) -> [String; 2] {
    let name = |path: Option<&Path>| path.and_then(Path::file_name).unwrap_or_default().to_string_lossy().into_owned();
    [name(Some(path)), name(path.parent())]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    type Panels = Harness<'static, (Vec<PathBuf>, Vec<Wish>)>;

    fn shown(recent: Vec<PathBuf>) -> Panels {
        let show = |ui: &mut Ui, (recent, wishes): &mut (Vec<PathBuf>, Vec<Wish>)| button(ui, true, recent, wishes);
        Harness::new_ui_state(show, (recent, Vec::new()))
    }

    fn press(panels: &mut Panels, name: &str) {
        panels.get_by_label_contains(name).click();
        panels.run_steps(4);
    }

    #[test]
    fn files_that_were_opened_last_are_listed_but_for_those_that_are_gone() {
        let folder = tempfile::tempdir().unwrap();
        let [here, gone] = ["here.json", "gone.json"].map(|name| folder.path().join(name));
        std::fs::write(&here, "{}").unwrap();
        let mut panels = shown(vec![gone, here.clone()]);
        press(&mut panels, "Open");
        assert!(panels.query_by_label_contains("gone.json").is_none());
        press(&mut panels, "here.json");
        assert_eq!(panels.state().1, [Wish::OpenRecent(here)]);
        press(&mut panels, "Open");
        press(&mut panels, "Choose a file");
        assert_eq!(panels.state().1.last(), Some(&Wish::Act(Action::Open)));
    }

    #[test]
    fn where_nothing_was_opened_yet_the_button_asks_for_a_file_at_once() {
        let mut panels = shown(Vec::new());
        press(&mut panels, "Open");
        assert_eq!(panels.state().1, [Wish::Act(Action::Open)]);
    }
}
