//! The frame of a sheet: what lies over the world until it is closed.

use egui::{Align2, Context, Id, Key, Response, Ui, Window, vec2};

/// The bar below is so high `[points]`: sheets lie above it.
const BAR: f32 = 44.0;

/// Shows a sheet in the middle, with its title and a button that closes it. Returns whether it stays.
pub(in crate::app) fn show(context: &Context, id: &str, title: impl Into<String>, add: impl FnOnce(&mut Ui)) -> bool {
    let (mut stays, id) = (true, Id::unique(id));
    let high = context.memory(|memory| memory.area_rect(id)).map_or(0.0, |rect| rect.height());
    let raised = raised(context.content_rect().height() - BAR, high, said_below(context));
    Window::new(title.into())
        .id(id)
        .open(&mut stays)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, -0.5 * BAR - raised])
        .show(context, add);
    stays
}

/// By how much a sheet so high stands above the middle of a room, so that it covers nothing of what is said along the lower edge, so high: no
/// further than that takes, nor beyond the upper edge `[points]`.
fn raised(room: f32, high: f32, said: f32) -> f32 {
    let beside = 0.5 * (room - high);
    (said - beside).min(beside).max(0.0)
}

/// So much along the lower edge, above the bar below, is for what is said of a sheet in this pass and the next `[points]`: sheets lie above it.
pub(super) fn keep_above(context: &Context, high: f32) {
    let until = context.cumulative_pass_nr() + 1;
    context.data_mut(|data| data.insert_temp(said_id(), (until, high)));
}

fn said_id() -> Id {
    Id::unique("said below a sheet")
}

/// How much along the lower edge that is now `[points]`.
pub(in crate::app) fn said_below(context: &Context) -> f32 {
    let kept: Option<(u64, f32)> = context.data(|data| data.get_temp(said_id()));
    kept.filter(|(until, _)| *until >= context.cumulative_pass_nr()).map_or(0.0, |(_, high)| high)
}

/// What a sheet has beside what stands in it: margins, and room to the edges of the window; above and below it too, title and bar below
/// `[points]`.
const BESIDE: [f32; 2] = [44.0, 150.0];

/// So wide and so high what stands in a sheet may be, of what it would be `[points]`: as large as that or as the window lets it.
pub(super) fn fitting(context: &Context, wanted: [f32; 2]) -> [f32; 2] {
    let window = context.content_rect().size() - vec2(0.0, said_below(context));
    [0, 1].map(|axis| wanted[axis].min(window[axis] - BESIDE[axis]).max(40.0))
}

/// Whether Enter was pressed in the field that a sheet is about. It has the focus as long as nothing else has: a click beside it loses no key.
pub(super) fn entered(ui: &Ui, field: &Response) -> bool {
    let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    if ui.memory(|memory| memory.focused().is_none()) {
        field.request_focus();
    }
    is_entered
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::{Event, Modifiers, Pos2, Rect};

    use super::super::pointer::click;
    use super::super::{Facts, PanelState, Sheet, Wish, gallery, open_from, save_to};
    use super::*;

    fn key(key: Key) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
    }

    fn frame(context: &Context, state: &mut PanelState, events: Vec<Event>) -> Vec<Wish> {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
        let mut wishes = Vec::new();
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let mut output = context.run_ui(input, |ui| {
            let room = ui.available_rect_before_wrap();
            match state.sheet {
                Some(Sheet::SaveTo) => save_to::show(ui.ctx(), state, &mut wishes),
                Some(Sheet::OpenFrom) => open_from::show(ui.ctx(), state, &mut wishes),
                Some(Sheet::Gallery) => gallery::show(ui.ctx(), room, state, &Facts::default(), &mut wishes),
                _ => {}
            }
        });
        output.textures_delta.clear();
        wishes
    }

    /// With a sheet open; then a click beside its field, and what is typed.
    fn clicked_beside(sheet: Sheet, path: &str) -> (Context, PanelState) {
        let context = Context::default();
        let mut state =
            PanelState { sheet: Some(sheet), is_fresh: true, path: path.to_owned(), ..PanelState::default() };
        (0..3).for_each(|_| _ = frame(&context, &mut state, Vec::new()));
        for events in click(Pos2::new(1200.0, 690.0)) {
            frame(&context, &mut state, events);
        }
        (context, state)
    }

    #[test]
    fn a_sheet_stands_above_what_is_said_and_in_the_middle_where_there_is_room() {
        assert_eq!(raised(676.0, 200.0, 0.0), 0.0);
        assert_eq!(raised(676.0, 200.0, 48.0), 0.0, "it lies far below it");
        assert_eq!(raised(676.0, 600.0, 48.0), 10.0, "by what it would cover");
        assert_eq!(raised(676.0, 660.0, 48.0), 8.0, "its title stays in the window");
    }

    #[test]
    fn a_click_beside_the_field_of_a_sheet_loses_no_key() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.json");
        let (context, mut state) = clicked_beside(Sheet::SaveTo, &path.display().to_string());
        assert!(context.text_edit_focused());
        assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), [Wish::SaveTo(path.clone())]);
        let mut state = PanelState {
            sheet: Some(Sheet::SaveTo),
            is_fresh: true,
            path: path.display().to_string(),
            ..PanelState::default()
        };
        let context = Context::default();
        (0..3).for_each(|_| _ = frame(&context, &mut state, Vec::new()));
        frame(&context, &mut state, vec![Event::Text("swing".to_owned())]);
        assert_eq!(state.path, folder.path().join("swing.json").display().to_string(), "what is typed is the name");
        let (context, mut state) = clicked_beside(Sheet::OpenFrom, "here.json");
        assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), [Wish::OpenFile("here.json".to_owned())]);
        let (context, mut state) = clicked_beside(Sheet::Gallery, "");
        frame(&context, &mut state, vec![Event::Text("no such scene".to_owned())]);
        assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), []);
        for letter in 0..13 {
            assert!(context.text_edit_focused(), "{letter}");
            frame(&context, &mut state, vec![key(Key::Backspace)]);
        }
        frame(&context, &mut state, vec![Event::Text("rope".to_owned())]);
        assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), [Wish::OpenScene("rope")]);
    }

    #[test]
    fn enter_saves_from_the_field_and_from_what_is_chosen_above_it_and_presses_a_button_that_has_the_focus() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.json");
        let (context, mut state) = clicked_beside(Sheet::SaveTo, &path.display().to_string());
        let goes = |state: &mut PanelState, modifiers: Modifiers| {
            let key = Event::Key { key: Key::Tab, physical_key: None, pressed: true, repeat: false, modifiers };
            frame(&context, state, vec![key]);
            frame(&context, state, Vec::new());
            assert!(context.memory(|memory| memory.focused()).is_some() && !context.text_edit_focused());
        };
        // Back to the last of the rings above the field: it is chosen, then it is saved.
        goes(&mut state, Modifiers::SHIFT);
        assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), []);
        assert_eq!(frame(&context, &mut state, Vec::new()), []);
        assert_eq!(state.save_to.kind, save_to::Saved::Clip);
        let clip = folder.path().join("mine.gif");
        assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), [Wish::SaveTo(clip)]);
        // On from the field: to the button that saves, and the one that asks for a place.
        let (context, mut state) = clicked_beside(Sheet::SaveTo, &path.display().to_string());
        for wish in [Wish::SaveTo(path), Wish::BrowseToSave] {
            frame(&context, &mut state, vec![key(Key::Tab)]);
            frame(&context, &mut state, Vec::new());
            assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), [wish]);
        }
    }

    #[test]
    fn what_is_typed_ahead_of_a_sheet_is_entered_there() {
        let context = Context::default();
        super::super::listen(&context);
        let mut state = PanelState::default();
        frame(&context, &mut state, Vec::new());
        // As the key that opens it does.
        (state.sheet, state.is_fresh) = (Some(Sheet::Gallery), true);
        context.memory_mut(|memory| memory.request_focus(gallery::search_id()));
        let typed = vec![Event::Text("whip".to_owned()), key(Key::Enter)];
        let wishes: Vec<Wish> =
            [typed, vec![]].into_iter().flat_map(|events| frame(&context, &mut state, events)).collect();
        assert_eq!(wishes, [Wish::OpenScene("rope")]);
    }

    #[test]
    fn a_file_without_a_name_is_asked_for_one() {
        for sheet in [Sheet::SaveTo, Sheet::OpenFrom] {
            let (context, mut state) = clicked_beside(sheet, " ");
            assert_eq!(frame(&context, &mut state, vec![key(Key::Enter)]), []);
            let said = [state.save_to != save_to::SaveTo::default(), state.open_from.fault.is_some()];
            assert_eq!(said, [sheet == Sheet::SaveTo, sheet == Sheet::OpenFrom]);
        }
    }

    #[test]
    fn sheets_for_files_are_whole_in_the_smallest_window() {
        for (sheet, id) in [(Sheet::SaveTo, "save to"), (Sheet::OpenFrom, "open from")] {
            let context = Context::default();
            let mut state = PanelState { sheet: Some(sheet), is_fresh: true, ..PanelState::default() };
            let window = Rect::from_min_size(Pos2::ZERO, vec2(480.0, 360.0));
            for _ in 0..6 {
                let input = egui::RawInput { screen_rect: Some(window), ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| match sheet {
                    Sheet::SaveTo => save_to::show(ui.ctx(), &mut state, &mut Vec::new()),
                    _ => open_from::show(ui.ctx(), &mut state, &mut Vec::new()),
                });
                output.textures_delta.clear();
            }
            let rect = context.memory(|memory| memory.area_rect(Id::unique(id))).unwrap();
            assert!(rect.width() <= 480.0 && rect.height() <= 360.0 - BAR, "{sheet:?}: {rect}");
        }
    }
}
