//! What Enter chooses in a menu closes the menu, as a click does; arrows begin at what is chosen already.

use egui::containers::menu::SubMenu;
use egui::{Context, Id, Key, LayerId, Order, Plugin, Popup, Response, Ui, WidgetText};

/// Closes menus once something in them was chosen by Enter.
#[derive(Default)]
pub(super) struct Choosing {
    /// What Enter was pressed on in this pass.
    chosen: Option<Id>,
}

impl Plugin for Choosing {
    fn debug_name(&self) -> &'static str {
        "choosing"
    }

    fn on_begin_pass(&mut self, ui: &mut Ui) {
        let context = ui.ctx();
        // A field in a menu has Enter for itself.
        let is_pressed = Popup::is_any_open(context)
            && !context.text_edit_focused()
            && context.input(|input| input.key_pressed(Key::Enter));
        self.chosen = is_pressed.then(|| context.memory(|memory| memory.focused())).flatten();
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        if let Some(chosen) = self.chosen.take()
            && !has_menu(ui.ctx(), chosen)
        {
            Popup::close_all(ui.ctx());
            ui.ctx().request_repaint();
        }
    }
}

/// Whether a menu hangs on what was chosen, which opened then.
fn has_menu(context: &Context, chosen: Id) -> bool {
    let layer = LayerId::new(Order::Foreground, SubMenu::id_from_widget_id(chosen));
    context.memory(|memory| memory.areas().is_visible(&layer))
}

/// One of a menu's choices, the present one or another: the first that arrows lead from, when the menu opens, is the present one.
pub(super) fn choice(ui: &mut Ui, is_present: bool, words: impl Into<WidgetText>) -> Response {
    let by = ui.selectable_label(is_present, words.into());
    begin_at(&by, is_present);
    by
}

/// The same of a choice that is there already.
pub(super) fn begin_at(by: &Response, is_present: bool) {
    // A menu is laid out twice as it opens: what is seen for the first or the second time was not there before.
    let pass = by.ctx.cumulative_pass_nr();
    let id = by.id.with("seen in a menu");
    let [first, last] = by.ctx.data(|data| data.get_temp::<[u64; 2]>(id)).unwrap_or([pass; 2]);
    let first = if pass > last + 1 { pass } else { first };
    by.ctx.data_mut(|data| data.insert_temp(id, [first, pass]));
    if is_present && pass <= first + 1 {
        by.request_focus();
        by.scroll_to_me(None);
    }
}

#[cfg(test)]
mod tests {
    use egui::{ComboBox, Event, Modifiers, RawInput, Rect, pos2, vec2};

    use super::super::pointer::click;
    use super::*;

    #[test]
    fn arrows_and_enter_choose_in_a_list_and_close_it() {
        let context = Context::default();
        super::super::listen(&context);
        let (mut value, mut button) = (1, Rect::NOTHING);
        let mut frame = |events: Vec<Event>| {
            let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0)));
            let mut output = context.run_ui(RawInput { events, screen_rect, ..RawInput::default() }, |ui| {
                let list = ComboBox::from_id_salt("list").selected_text(value.to_string()).show_ui(ui, |ui| {
                    for number in 0..5 {
                        if choice(ui, value == number, number.to_string()).clicked() {
                            value = number;
                        }
                    }
                });
                button = list.response.rect;
            });
            output.textures_delta.clear();
            (value, button, Popup::is_any_open(&context))
        };
        let at = frame(Vec::new()).1.center();
        let mut is_open = false;
        for events in click(at).into_iter().chain([Vec::new(), Vec::new()]) {
            is_open = frame(events).2;
        }
        assert!(is_open);
        let key = |key| {
            vec![Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }]
        };
        for pressed in [Key::ArrowDown, Key::ArrowDown] {
            frame(key(pressed));
            frame(Vec::new());
        }
        assert_eq!((frame(Vec::new()).0, frame(Vec::new()).2), (1, true), "nothing is chosen yet");
        frame(key(Key::Enter));
        let (value, _, is_open) = frame(Vec::new());
        assert_eq!((value, is_open), (3, false), "two below the one that was chosen");
    }
}
