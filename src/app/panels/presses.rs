//! What was done in one long frame, shown to the panels press by press.
//!
//! The panels' library looks where the pointer is at the end of a frame and what is held down then: of a press, a drag and a release that
//! come in one frame it sees nothing but a click somewhere else. So each of them gets a pass of its own. So does an Enter: a field that
//! gets the focus, is written in and is left in one frame never had it.

use super::choosing::Choosing;
use super::focus::Focus;
use super::typed::Numbers;
use egui::{Context, Event, Key, Plugin, RawInput, Ui};

/// Gives a context this way of hearing events.
pub(in crate::app) fn listen(context: &Context) {
    context.add_plugin(Presses::default());
    context.add_plugin(Numbers);
    context.add_plugin(Choosing::default());
    context.add_plugin(Focus);
    // A press and its release are a frame apart, which may take long: however long, they are a click where the pointer stays.
    context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
}

/// Events that later passes will hear of.
#[derive(Default)]
struct Presses {
    waiting: Vec<Event>,
}

impl Plugin for Presses {
    fn debug_name(&self) -> &'static str {
        "presses"
    }

    fn input_hook(&mut self, _: &Context, input: &mut RawInput) {
        let mut events = std::mem::take(&mut self.waiting);
        events.append(&mut input.events);
        self.waiting = events.split_off(end_of_first(&events));
        input.events = events;
    }

    fn on_begin_pass(&mut self, ui: &mut Ui) {
        if !self.waiting.is_empty() {
            ui.ctx().request_repaint();
        }
    }
}

/// How many of some events are heard in one pass: up to a press or a release that the pointer goes on after, up to a release that it
/// moved before, and up to an Enter that something came before.
fn end_of_first(events: &[Event]) -> usize {
    let is_of_pointer =
        |event: &Event| matches!(event, Event::PointerMoved(_) | Event::PointerButton { .. } | Event::PointerGone);
    let mut has_moved = false;
    for (place, event) in events.iter().enumerate() {
        match event {
            Event::PointerButton { pressed: false, .. } if has_moved => return place,
            Event::PointerButton { .. } if events[place + 1..].iter().any(is_of_pointer) => return place + 1,
            Event::PointerMoved(_) => has_moved = true,
            Event::Key { key: Key::Enter, pressed: true, .. } if place > 0 => return place,
            _ => {}
        }
    }
    events.len()
}

#[cfg(test)]
mod tests {
    use super::super::pointer::button;
    use super::*;
    use egui::{Modifiers, pos2};

    #[test]
    fn a_press_a_drag_and_a_release_are_heard_one_after_another() {
        let [from, to] = [pos2(10.0, 10.0), pos2(50.0, 10.0)];
        let all = [Event::PointerMoved(from), button(from, true), Event::PointerMoved(to), button(to, false)];
        let mut rest = &all[..];
        let mut heard = Vec::new();
        while !rest.is_empty() {
            let (first, later) = rest.split_at(end_of_first(rest));
            heard.push(first.len());
            rest = later;
        }
        assert_eq!(heard, [2, 1, 1]);
        assert_eq!(end_of_first(&all[..1]), 1, "moves alone are heard at once");
        assert_eq!(end_of_first(&[button(from, true), Event::Text("x".to_owned())]), 2, "so is what is typed");
        assert_eq!(end_of_first(&[]), 0);
        let enter = Event::Key {
            key: Key::Enter,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        let typed = [Event::Text("x".to_owned()), enter];
        assert_eq!(end_of_first(&typed), 1, "what is typed is heard before it is entered");
        assert_eq!(end_of_first(&typed[1..]), 1);
    }

    #[test]
    fn a_press_and_a_release_that_frames_of_a_second_part_are_a_click() {
        let context = Context::default();
        listen(&context);
        let (mut is_clicked, at) = (false, pos2(20.0, 20.0));
        let all = [vec![], vec![Event::PointerMoved(at)], vec![button(at, true)], vec![button(at, false)]];
        for (events, second) in all.into_iter().zip(1_u8..) {
            let input = RawInput { events, time: Some(f64::from(second)), ..RawInput::default() };
            let mut output = context.run_ui(input, |ui| {
                let size = egui::vec2(80.0, 40.0);
                is_clicked |= ui.put(egui::Rect::from_center_size(at, size), egui::Button::new("a button")).clicked();
            });
            output.textures_delta.clear();
        }
        assert!(is_clicked);
    }
}
