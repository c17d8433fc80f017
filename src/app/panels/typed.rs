//! What is typed into fields for numbers: only what numbers are written with arrives there.

use egui::text_edit::TextEditState;
use egui::{Context, Event, Id, ImeEvent, Plugin, RawInput, Response};

/// A field takes words from now on: all others take numbers.
pub(super) fn takes_words(field: &Response) {
    field.ctx.data_mut(|data| data.insert_temp(mark(field.id), true));
}

fn mark(field: Id) -> Id {
    field.with("takes words")
}

/// Leaves out of what is typed into a number what is in none.
pub(super) struct Numbers;

impl Plugin for Numbers {
    fn debug_name(&self) -> &'static str {
        "numbers"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let Some(field) = context.memory(|memory| memory.focused()) else { return };
        let Some(state) = TextEditState::load(context, field) else { return };
        if context.data(|data| data.get_temp(mark(field)).unwrap_or(false)) {
            return;
        }
        // A power of ten stands behind something.
        let mut is_behind =
            state.cursor.char_range().is_some_and(|range| range.is_empty() && range.primary.index.0 > 0);
        for event in &mut input.events {
            if let Event::Text(text) | Event::Paste(text) | Event::Ime(ImeEvent::Commit(text)) = event {
                *text = of_number(text, is_behind);
                is_behind |= !text.is_empty();
            }
        }
        input.events.retain(|event| !matches!(event, Event::Text(text) | Event::Paste(text) if text.is_empty()));
    }
}

/// Of some text what a number may be written with: a comma is a point, and a power of ten stands behind a digit, or behind what is there.
fn of_number(text: &str, mut is_behind: bool) -> String {
    let mut number = String::new();
    for sign in text.chars() {
        match sign {
            '0'..='9' | '.' | '-' | '+' => number.push(sign),
            ',' => number.push('.'),
            '\u{2212}' => number.push('-'),
            'e' | 'E' if is_behind => number.push('e'),
            _ => continue,
        }
        is_behind |= sign.is_ascii_digit();
    }
    number
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::{DragValue, TextEdit, pos2};

    use super::super::pointer::click;
    use super::*;

    #[test]
    fn a_number_has_no_letters_but_a_power_of_ten() {
        for (typed, number) in
            [("xyzzy", ""), ("1,5", "1.5"), ("12 m", "12"), ("-3e-2", "-3e-2"), ("e", ""), ("\u{2212}4", "-4")]
        {
            assert_eq!(of_number(typed, false), number);
        }
        assert_eq!(of_number("e", true), "e", "behind what is there");
    }

    #[test]
    fn a_field_for_numbers_takes_no_letters_and_a_click_beside_it_has_the_number() {
        let context = Context::default();
        super::super::listen(&context);
        let (mut value, mut words) = (2.0, String::new());
        let mut frame = |events: Vec<Event>| {
            let screen_rect = Some(egui::Rect::from_min_size(pos2(0.0, 0.0), egui::vec2(400.0, 300.0)));
            let mut fields = [egui::Rect::NOTHING; 2];
            let mut output = context.run_ui(RawInput { events, screen_rect, ..RawInput::default() }, |ui| {
                fields[0] = ui.add(DragValue::new(&mut value).update_while_editing(false)).rect;
                let field = ui.add(TextEdit::singleline(&mut words));
                takes_words(&field);
                fields[1] = field.rect;
            });
            output.textures_delta.clear();
            (fields, value, words.clone())
        };
        let fields = frame(Vec::new()).0;
        let text = |text: &str| text.chars().map(|sign| Event::Text(sign.into())).collect::<Vec<_>>();
        for at in fields.map(|field| field.center()) {
            for events in click(at) {
                frame(events);
            }
            frame(text("xyzzy7,5"));
        }
        let beside = pos2(300.0, 250.0);
        for events in click(beside) {
            frame(events);
        }
        let (_, value, words) = frame(Vec::new());
        assert_eq!((value, &*words), (7.5, "xyzzy7,5"));
    }
}
