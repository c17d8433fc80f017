//! What floats at the top: the scene with those before and after it, and what can be brought in or saved.

use std::path::PathBuf;

use egui::{Area, Id, Rect, RichText, Ui};

use super::icons::{self, Icon};
use super::theme::{colors, floating};
use super::{Facts, Wish, described, icon, low, reopen};
use crate::app::action::{Action, Showing};

/// In narrower rooms buttons stand closer to each other, so that most of them are in one row `[points]`.
const TIGHT: f32 = 1080.0;

/// From this width on there is room for words beside the signs `[points]`.
const WORDS: f32 = 1500.0;

/// Width of the name of what is open `[points]`: what it is called moves no button. The second is that in narrower rooms.
const NAME: [f32; 2] = [150.0, 104.0];

/// The part of the height that it takes at most `[1]`.
const MOST: f32 = 0.42;

/// Returns where it lies `[points]`.
pub(super) fn show(
    context: &egui::Context,
    (room, recent): (Rect, &[PathBuf]),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) -> Rect {
    let shown = Area::new(Id::unique("scene")).fixed_pos([10.0, 10.0]).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_max_width((room.width() - 36.0).max(40.0));
            let part = room.with_max_y(room.top() + MOST * room.height());
            low::within(ui, part, |ui| ui.horizontal_wrapped(|ui| buttons(ui, (room.width(), recent), facts, wishes)));
        });
    });
    shown.response.rect
}

/// All of them, in a room so wide.
fn buttons(ui: &mut Ui, (width, recent): (f32, &[PathBuf]), facts: &Facts, wishes: &mut Vec<Wish>) {
    if width < TIGHT {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 6.0;
    }
    icon(ui, Icon::Before, "the scene before", Action::PreviousScene, wishes);
    icon(ui, Icon::After, "the scene after", Action::NextScene, wishes);
    let name = egui::Button::new(RichText::new(&facts.title).color(colors(ui).text).strong()).truncate();
    let of_name = NAME[usize::from(width < TIGHT)].min(ui.max_rect().width());
    let said = format!("{}: {}", facts.title, described("the gallery", Action::Gallery));
    let height = ui.spacing().interact_size.y.max(icons::SMALL.y);
    if ui.add_sized([of_name, height], name).on_hover_text(said).clicked() {
        wishes.push(Wish::Act(Action::Gallery));
    }
    // A word beside its sign where there is room, and always where signs alone say little.
    let has_words = width >= WORDS;
    ui.separator();
    plain(ui, (Icon::New, "New"), ("new: an empty scene", Action::New), has_words, wishes);
    plain(ui, (Icon::Draw, "Draw"), ("draw a body", Action::Paint), has_words, wishes);
    reopen::button(ui, has_words, recent, wishes);
    let said = "save this moment, or all that was done";
    plain(ui, (Icon::Save, "Save"), (said, Action::Save), has_words, wishes);
    ui.separator();
    step(ui, (Icon::Undo, "undo", Action::Undo), facts.undoes.as_deref(), wishes);
    step(ui, (Icon::Redo, "redo", Action::Redo), facts.redoes.as_deref(), wishes);
    ui.separator();
    plain(ui, (Icon::Fit, "Fit"), ("fit all points", Action::Fit), has_words, wishes);
    for showing in Showing::ALL {
        let sign = match showing {
            Showing::Bodies => Icon::Bodies,
            Showing::Strain => Icon::Strain,
            Showing::Bonds => Icon::Bonds,
        };
        let said = described(showing.words(), Action::NextShowing);
        let is_on = facts.showing == showing;
        worded(ui, (sign, showing.name()), (said, Action::Show(showing)), [true, is_on], wishes);
    }
    super::beside::menu(ui, facts, wishes);
    ui.separator();
    icon(ui, Icon::Book, "lessons: how it works", Action::Lessons, wishes);
    icon(ui, Icon::Plot, "plots of the energies", Action::Plots, wishes);
    icon(ui, Icon::Gear, "settings of the scene", Action::Settings, wishes);
    let keys = described("the keys", Action::Help);
    worded(ui, (Icon::Keys, "?"), (keys, Action::Help), [false; 2], wishes);
    // Last: where a scene has none no other button stands elsewhere.
    if facts.has_picture {
        let said = described("cut the scene's first picture out anew", Action::Import);
        worded(ui, (Icon::Picture, "Picture"), (said, Action::Import), [true, false], wishes);
    }
}

/// A button that undoes or does again, and says what; it is off where there is nothing.
fn step(ui: &mut Ui, (sign, name, action): (Icon, &str, Action), what: Option<&str>, wishes: &mut Vec<Wish>) {
    let said = match what {
        Some(what) => format!("{name}: {what}"),
        None => format!("nothing to {name}"),
    };
    let button = |ui: &mut Ui| icons::button(ui, sign, name, icons::SMALL, false);
    let button = ui.add_enabled(what.is_some(), button);
    let said = described(&said, action);
    if button.on_hover_text(&said).on_disabled_hover_text(&said).clicked() {
        wishes.push(Wish::Act(action));
    }
}

/// A button with a sign and, where there is room, its word, which says what it does and by which key.
fn plain(ui: &mut Ui, name: (Icon, &str), (said, action): (&str, Action), has_word: bool, wishes: &mut Vec<Wish>) {
    worded(ui, name, (described(said, action), action), [has_word, false], wishes);
}

/// A button with a sign, the word that it is called by, and what is said of it and done by it: the word stands beside the sign, or it is lit.
fn worded(
    ui: &mut Ui,
    (sign, word): (Icon, &str),
    (said, action): (String, Action),
    [has_word, is_on]: [bool; 2],
    wishes: &mut Vec<Wish>,
) {
    if icons::worded(ui, sign, word, (has_word, is_on)).on_hover_text(said).clicked() {
        wishes.push(Wish::Act(action));
    }
}
