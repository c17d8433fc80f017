//! A ring around what the keyboard's focus is on: buttons, rings and sliders show it no other way.

use egui::{Context, Plugin, Popup, Rect, Stroke, StrokeKind, Ui};

use super::theme::colors;

/// Room between what has the focus and its ring, and how wide the ring is `[points]`.
const APART: f32 = 2.0;
const WIDTH: f32 = 1.5;

/// Draws the ring. Fields have an outline of their own, and so has what arrows have reached in a menu.
pub(super) struct Focus;

impl Plugin for Focus {
    fn debug_name(&self) -> &'static str {
        "focus"
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        let context = ui.ctx();
        let Some((ring, layer, clip)) = focused(context) else { return };
        let painter = context.layer_painter(layer).with_clip_rect(clip);
        painter.rect_stroke(ring, 8.0, Stroke::new(WIDTH, colors(context).text), StrokeKind::Outside);
    }
}

/// Where the ring is, in which layer, and what of that is seen.
fn focused(context: &Context) -> Option<(Rect, egui::LayerId, Rect)> {
    let id = context.memory(|memory| memory.focused())?;
    if context.text_edit_focused() || Popup::is_any_open(context) {
        return None;
    }
    let response = context.read_response(id)?;
    let around = APART + WIDTH;
    Some((response.rect.expand(APART), response.layer_id, response.interact_rect.expand(around)))
}

#[cfg(test)]
mod tests {
    use egui::{Color32, Event, Key, Modifiers, RawInput, Shape, TextEdit, pos2, vec2};

    use super::super::pointer::click;
    use super::*;

    /// The ring in a frame, and where a field and two buttons lie.
    fn frame(context: &Context, words: &mut String, events: Vec<Event>) -> (Option<Rect>, [Rect; 3]) {
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0)));
        let mut places = [Rect::NOTHING; 3];
        let mut output = context.run_ui(RawInput { events, screen_rect, ..RawInput::default() }, |ui| {
            let field = ui.add(TextEdit::singleline(words)).rect;
            places = [field, ui.button("Save").rect, ui.add(egui::Button::new("Cancel").fill(Color32::RED)).rect];
        });
        output.textures_delta.clear();
        let stroke = Stroke::new(WIDTH, colors(context).text);
        let ring = output.shapes.iter().find_map(|clipped| match &clipped.shape {
            Shape::Rect(rect) if rect.stroke == stroke => Some(rect.rect),
            _ => None,
        });
        (ring, places)
    }

    #[test]
    fn what_tab_goes_to_is_seen_on_buttons_of_any_colour() {
        let context = Context::default();
        super::super::listen(&context);
        let mut words = String::new();
        let places = frame(&context, &mut words, Vec::new()).1;
        for events in click(places[0].center()) {
            assert_eq!(frame(&context, &mut words, events).0, None, "a field has an outline of its own");
        }
        let tab =
            Event::Key { key: Key::Tab, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
        for place in &places[1..] {
            frame(&context, &mut words, vec![tab.clone()]);
            let ring = frame(&context, &mut words, Vec::new()).0;
            assert_eq!(ring, Some(place.expand(APART)));
        }
    }
}
