//! What floats at the top: the scene with those before and after it, and what can be brought in or saved.

use std::path::PathBuf;

use egui::{Area, Id, Rect, RichText, Ui};

use super::beside::COMPARE;
use super::icons::{self, Icon};
use super::theme::{colors, floating};
use super::{Facts, Wish, described, icon, low, reopen};
use crate::app::action::{Action, Showing};

/// How close buttons stand, and which have a word beside their sign.
#[derive(Clone, Copy)]
struct Spread {
    /// All of them have one.
    has_words: bool,
    /// Those whose signs alone say little have one.
    has_names: bool,
    /// From button to button `[points]`.
    gap: f32,
    /// Width of the name of what is open at least `[points]`: what it is called moves no button.
    name: f32,
}

/// From the widest to the narrowest.
const SPREADS: [Spread; 4] = [
    Spread { has_words: true, has_names: true, gap: 8.0, name: 150.0 },
    Spread { has_words: false, has_names: true, gap: 4.0, name: 150.0 },
    Spread { has_words: false, has_names: true, gap: 4.0, name: 104.0 },
    Spread { has_words: false, has_names: false, gap: 4.0, name: 104.0 },
];

/// From this width on there is room for all words `[points]`.
const WORDS: f32 = 1500.0;

/// Width of the widest name, and what the figures take of the right edge `[points]`.
const MOST_NAME: f32 = 240.0;
const FIGURES: f32 = 180.0;

/// What the row does not have of the width of a room, and the width of a line between buttons `[points]`.
const BESIDE: f32 = 36.0;
const LINE: f32 = 6.0;

impl Spread {
    /// Of as few rows as may be in a room so wide, the widest one: by all buttons that there can be, so that none stands elsewhere where a
    /// scene has one more.
    fn of(ui: &Ui, width: f32) -> Self {
        let all = SPREADS.into_iter().filter(|spread| width >= WORDS || !spread.has_words);
        let width = width - BESIDE;
        let spread = all.min_by_key(|spread| spread.rows(ui, width).0).unwrap_or(SPREADS[3]);
        // What one row leaves beside the figures is the name's.
        let (rows, end) = spread.rows(ui, width);
        let more = if rows == 1 { (width - FIGURES - end).clamp(0.0, MOST_NAME - spread.name) } else { 0.0 };
        Spread { name: spread.name + more, ..spread }
    }

    /// How many rows all buttons are in, in so much width, and where the last row ends `[points]`.
    fn rows(self, ui: &Ui, width: f32) -> (usize, f32) {
        let sign = |has: bool, word: &str| if has { icons::width(ui, word) } else { icons::SMALL.x };
        let of_words = |words: &[&str]| words.iter().map(|word| sign(self.has_words, word)).collect::<Vec<_>>();
        let of_names = |words: &[&str]| words.iter().map(|word| sign(self.has_names, word)).collect::<Vec<_>>();
        let signs = |count: usize| vec![icons::SMALL.x; count];
        let names = Showing::ALL.map(Showing::name);
        let groups = [
            [signs(2), vec![self.name, LINE]].concat(),
            [of_words(&["New", "Draw", "Open", "Save"]), vec![LINE]].concat(),
            [signs(2), vec![LINE], of_words(&["Fit"])].concat(),
            [of_names(&names), of_names(&[COMPARE]), vec![LINE]].concat(),
            [signs(4), of_words(&[PICTURE])].concat(),
        ];
        let (mut rows, mut end) = (1, 0.0);
        for wide in groups.into_iter().flatten() {
            if end > 0.0 && end + wide > width {
                (rows, end) = (rows + 1, 0.0);
            }
            end += wide + self.gap;
        }
        (rows, end)
    }
}

/// What the button is called that cuts a picture out anew.
const PICTURE: &str = "Picture";

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
            ui.set_max_width((room.width() - BESIDE).max(40.0));
            let part = room.with_max_y(room.top() + MOST * room.height());
            low::within(ui, part, |ui| ui.horizontal_wrapped(|ui| buttons(ui, (room.width(), recent), facts, wishes)));
        });
    });
    shown.response.rect
}

/// All of them, in a room so wide.
fn buttons(ui: &mut Ui, (width, recent): (f32, &[PathBuf]), facts: &Facts, wishes: &mut Vec<Wish>) {
    let Spread { has_words, has_names, gap, name: of_name } = Spread::of(ui, width);
    ui.spacing_mut().item_spacing.x = gap;
    icon(ui, Icon::Before, "the scene before", Action::PreviousScene, wishes);
    icon(ui, Icon::After, "the scene after", Action::NextScene, wishes);
    let name = egui::Button::new(RichText::new(&facts.title).color(colors(ui).text).strong()).truncate();
    let of_name = of_name.min(ui.max_rect().width());
    let said = format!("{}: {}", facts.title, described("the gallery", Action::Gallery));
    let height = ui.spacing().interact_size.y.max(icons::SMALL.y);
    if ui.add_sized([of_name, height], name).on_hover_text(said).clicked() {
        wishes.push(Wish::Act(Action::Gallery));
    }
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
        worded(ui, (sign, showing.name()), (said, Action::Show(showing)), [has_names, is_on], wishes);
    }
    super::beside::menu(ui, has_names, facts, wishes);
    ui.separator();
    icon(ui, Icon::Book, "lessons: how it works", Action::Lessons, wishes);
    icon(ui, Icon::Plot, "plots of the energies", Action::Plots, wishes);
    icon(ui, Icon::Gear, "settings of the scene", Action::Settings, wishes);
    let keys = described("the keys", Action::Help);
    worded(ui, (Icon::Keys, "?"), (keys, Action::Help), [false; 2], wishes);
    // It stays where it is where a scene has none.
    let said = described("cut the scene's first picture out anew", Action::Import);
    let why = "no body of this scene is cut out of a picture: Open takes one";
    let button = |ui: &mut Ui| icons::worded(ui, Icon::Picture, PICTURE, (has_words, false));
    if ui.add_enabled(facts.has_picture, button).on_hover_text(said).on_disabled_hover_text(why).clicked() {
        wishes.push(Wish::Act(Action::Import));
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::{Pos2, vec2};

    use super::super::theme;
    use super::*;

    /// How wide and how high the bar is in a window so wide, of a scene with a picture or without.
    fn size(width: f32, has_picture: bool) -> egui::Vec2 {
        let context = egui::Context::default();
        theme::apply(&context, Default::default());
        let room = Rect::from_min_size(Pos2::ZERO, vec2(width, 700.0));
        let facts = Facts { has_picture, title: "a scene".to_owned(), ..Facts::default() };
        let mut rect = Rect::NOTHING;
        for _ in 0..4 {
            let input = egui::RawInput { screen_rect: Some(room), ..egui::RawInput::default() };
            let mut output = context.run_ui(input, |ui| rect = show(ui.ctx(), (room, &[]), &facts, &mut Vec::new()));
            output.textures_delta.clear();
        }
        rect.size()
    }

    #[test]
    fn buttons_are_in_one_row_wherever_that_has_room() {
        let row = size(1280.0, true).y;
        assert!((30.0..60.0).contains(&row), "{row}");
        for width in (800..2000).step_by(20) {
            let bar = size(width as f32, true);
            assert!(bar.y <= row + 1.0 && bar.x <= width as f32 - 16.0, "{width}: {bar}");
            let without = size(width as f32, false);
            assert_eq!(without, bar, "{width}: no button comes or goes");
        }
        for width in [480.0, 600.0, 720.0] {
            let bar = size(width, true);
            assert!(bar.y <= 2.0 * row && bar.x <= width - 16.0, "{width}: {bar}");
        }
    }
}
