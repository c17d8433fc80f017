//! The list of timelines, where time went several ways: one is chosen to go on with, called something, discarded.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Align, ComboBox, Grid, Id, Key, Layout, PopupCloseBehavior, Role, TextEdit, Ui, Vec2, WidgetInfo, vec2};

use super::choosing::choice;
use super::icons::{self, Icon};
use super::typed::takes_words;
use super::{Facts, Wish, moving};
use crate::history::{BranchView, History};

/// Width of the list as it is closed, beside a line of time with room and with little `[points]`.
const WIDTHS: [f32; 2] = [158.0, 112.0];
/// Width of the field that a name is written in `[points]`.
const FIELD: f32 = 220.0;
/// The size of the buttons beside a name `[points]`.
const BUTTON: Vec2 = vec2(24.0, 22.0);

/// What the list is for.
const WHY: &str = "you went back in time and did something else: each timeline is kept, choose which to go on with";

/// The number of the timeline whose name is being written, what is written, and whether its field has had the keyboard.
type Draft = (usize, String, bool);

/// The ways that time went, where there are several.
pub(super) fn show(ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    let list = &facts.figures.branches;
    let Some(present) = list.iter().position(|branch| branch.is_present).filter(|_| list.len() > 1) else {
        // The name that was being written has no list to be in.
        return ui.data_mut(|data| data.remove::<Draft>(draft_id()));
    };
    let (shown, width) = match ui.available_width() < moving::ROOMY {
        true => (format!("timeline {}", present + 1), WIDTHS[1]),
        false => (format!("{}: {}", present + 1, list[present].called()), WIDTHS[0]),
    };
    // As wide as it is, whatever it says.
    let size = vec2(width, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_width(width);
        let menu = ComboBox::from_id_salt("branches").selected_text(shown).width(width).truncate();
        let menu = menu.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show_ui(ui, |ui| {
            Grid::new("timelines").num_columns(3).spacing(vec2(6.0, 4.0)).show(ui, |ui| {
                for (place, branch) in list.iter().enumerate() {
                    row(ui, (place, branch), wishes);
                    ui.end_row();
                }
            });
        });
        if menu.inner.is_none() {
            // The click that closed the list took what was written.
            take(ui, list, wishes);
        }
        menu.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "timelines"));
        menu.response.on_hover_text(format!("timeline {} of {}\n{WHY}", present + 1, list.len()));
    });
}

/// One of them: its name and from when to when it is its own, or the field that the name is written in; and what is done with it.
fn row(ui: &mut Ui, (place, branch): (usize, &BranchView), wishes: &mut Vec<Wish>) {
    let draft = ui.data(|data| data.get_temp::<Draft>(draft_id()));
    if let Some(draft) = draft.filter(|(number, ..)| *number == branch.number) {
        return field(ui, (place, branch), draft, wishes);
    }
    if choice(ui, branch.is_present, words(place, branch)).clicked() {
        if !branch.is_present {
            wishes.push(Wish::ToBranch(branch.number));
        }
        ui.close();
    }
    let named = |what: &str| format!("{what} timeline {}", place + 1);
    let pencil = icons::button(ui, Icon::Draw, &named("rename"), BUTTON, false);
    if pencil.on_hover_text("call it something, as long as this window is open").clicked() {
        write(ui, branch);
    }
    if branch.is_present {
        return;
    }
    let cross = icons::button(ui, Icon::Close, &named("discard"), BUTTON, false);
    if cross.on_hover_text("discard it: Ctrl+Z brings it back").clicked() {
        wishes.push(Wish::DiscardBranch(branch.number));
    }
}

/// What a branch is called, and from when to when it is its own.
fn words(place: usize, branch: &BranchView) -> String {
    format!("{}: {}  ({:.1} to {:.1} s)", place + 1, branch.called(), branch.from, branch.end)
}

fn draft_id() -> Id {
    Id::unique("the name of a timeline")
}

/// Its name is about to be written.
fn write(ui: &Ui, branch: &BranchView) {
    ui.data_mut(|data| data.insert_temp::<Draft>(draft_id(), (branch.number, branch.called(), false)));
}

/// All of a text in its field is chosen, so that what is typed takes its place.
fn choose_all(ui: &Ui, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), draft_id()).unwrap_or_default();
    let all = CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), draft_id());
}

/// The field for that: what is written is taken as it is left, but for Esc.
fn field(ui: &mut Ui, (place, branch): (usize, &BranchView), draft: Draft, wishes: &mut Vec<Wish>) {
    let (_, mut text, had_focus) = draft;
    let edit = TextEdit::singleline(&mut text).id(draft_id()).char_limit(History::LONGEST_TITLE).desired_width(FIELD);
    let field = ui.add(edit);
    takes_words(&field);
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, format!("name of timeline {}", place + 1)));
    let has_focus = field.has_focus();
    if has_focus && !had_focus {
        choose_all(ui, &text);
    }
    ui.data_mut(|data| data.insert_temp::<Draft>(draft_id(), (branch.number, text, had_focus || has_focus)));
    match (had_focus, has_focus) {
        (_, true) => {}
        (true, false) => take(ui, std::slice::from_ref(branch), wishes),
        (false, false) => {
            field.request_focus();
            ui.ctx().request_repaint();
        }
    }
}

/// What was written becomes the name of that timeline, if it is another one and Esc did not give it up.
fn take(ui: &Ui, list: &[BranchView], wishes: &mut Vec<Wish>) {
    let Some((number, text, _)) = ui.data_mut(|data| data.remove_temp::<Draft>(draft_id())) else { return };
    let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
    let is_other = list.iter().any(|branch| branch.number == number && branch.called() != text.trim());
    if is_other && !is_given_up {
        wishes.push(Wish::CallBranch(number, text));
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::app::player::Figures;

    fn branch(number: usize, name: &str, is_present: bool) -> BranchView {
        BranchView { number, name: name.to_owned(), at: 3.21, title: None, from: 1.0, end: 8.0, is_present }
    }

    /// Frames until all stands where it will.
    const STEPS: usize = 10;

    /// The list of three timelines in a window, opened.
    fn opened() -> Harness<'static, Vec<Wish>> {
        let list = vec![branch(0, "pin", false), branch(2, "cut", true), branch(5, "", false)];
        let facts = Facts { figures: Figures { branches: list.into(), ..Figures::default() }, ..Facts::default() };
        let mut harness = Harness::builder().with_size([600.0, 400.0]).build_ui_state(
            move |ui, wishes: &mut Vec<Wish>| {
                let size = vec2(560.0, 30.0);
                ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| show(ui, &facts, wishes));
            },
            Vec::new(),
        );
        harness.run_steps(STEPS);
        harness.get_by_label("timelines").click();
        harness.run_steps(STEPS);
        harness
    }

    #[test]
    fn timelines_are_listed_by_name_and_one_is_gone_to() {
        let mut harness = opened();
        for words in ["2: cut at 3.2 s  (1.0 to 8.0 s)", "3: from 3.2 s on  (1.0 to 8.0 s)"] {
            assert!(harness.query_by_label(words).is_some(), "{words}");
        }
        assert!(harness.query_by_label("discard timeline 2").is_none(), "the world is on it");
        harness.get_by_label("1: pin at 3.2 s  (1.0 to 8.0 s)").click();
        harness.run_steps(STEPS);
        assert_eq!(*harness.state(), [Wish::ToBranch(0)]);
        assert!(harness.query_by_label("rename timeline 1").is_none(), "the list is closed");
    }

    #[test]
    fn a_timeline_is_renamed_in_the_list_and_discarded() {
        let mut harness = opened();
        harness.get_by_label("rename timeline 2").click();
        harness.run_steps(STEPS);
        let field = harness.get_by_label("name of timeline 2");
        field.type_text("the good one");
        harness.run_steps(STEPS);
        harness.key_press(Key::Enter);
        harness.run_steps(STEPS);
        assert_eq!(
            *harness.state(),
            [Wish::CallBranch(2, "the good one".to_owned())],
            "all of the old name was chosen"
        );
        harness.get_by_label("discard timeline 3").click();
        harness.run_steps(STEPS);
        assert_eq!(harness.state().last(), Some(&Wish::DiscardBranch(5)));
        harness.get_by_label("rename timeline 1").click();
        harness.run_steps(STEPS);
        harness.get_by_label("name of timeline 1").type_text("no");
        harness.run_steps(STEPS);
        harness.key_press(Key::Escape);
        harness.run_steps(STEPS);
        assert_eq!(harness.state().len(), 2, "Esc gives up what is written");
    }
}
