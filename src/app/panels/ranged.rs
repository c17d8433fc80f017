//! Fields for numbers that say from where to where they go, at the field and for a moment, where a number beyond that was typed.

use std::cell::Cell;
use std::ops::RangeInclusive;
use std::rc::Rc;

use egui::{Area, DragValue, Id, Order, Response, RichText, Slider, Ui, vec2};

use super::theme::{button_height, colors, floating};

/// It is said so long `[s]`.
const MOMENT: f64 = 3.0;
/// Room between it and the field `[points]`.
const APART: f32 = 4.0;

/// What is said, of which field, and until when `[s]`.
#[derive(Clone)]
struct Said {
    field: Id,
    words: String,
    until: f64,
}

/// A field for a number of a range, and the unit that it has in words.
pub(in crate::app) fn field(ui: &mut Ui, field: DragValue<'_>, range: RangeInclusive<f64>, unit: &str) -> Response {
    let (own, (parser, is_beyond)) = (ui.next_auto_id(), listening(&range));
    // What the world has beyond it stays until it is changed.
    let by = ui.add(field.range(range.clone()).clamp_existing_to_range(false).custom_parser(parser));
    say(ui, (own, &by), (&range, unit), is_beyond.get());
    by
}

/// A slider that is of this range, likewise.
pub(in crate::app) fn slider(ui: &mut Ui, slider: Slider<'_>, range: RangeInclusive<f64>, unit: &str) -> Response {
    // A slider is called by its number while that is written, and by itself else.
    let (own, (parser, is_beyond)) = (ui.next_auto_id(), listening(&range));
    // Its knob stands in the middle of the row that its number makes.
    let high = ui.spacing().interact_size.y;
    ui.spacing_mut().interact_size.y = high.max(button_height(ui));
    let by = ui.add(slider.custom_parser(parser));
    ui.spacing_mut().interact_size.y = high;
    say(ui, (own, &by), (&range, unit), is_beyond.get());
    by
}

/// Reads a number as fields do, and notes whether it is beyond a range.
fn listening(range: &RangeInclusive<f64>) -> (impl Fn(&str) -> Option<f64> + use<>, Rc<Cell<bool>>) {
    let (range, is_beyond) = (range.clone(), Rc::new(Cell::new(false)));
    let noted = Rc::clone(&is_beyond);
    let parser = move |text: &str| {
        let signs = text.chars().filter(|sign| !sign.is_whitespace());
        let number: f64 =
            signs.map(|sign| if sign == '\u{2212}' { '-' } else { sign }).collect::<String>().parse().ok()?;
        noted.set(!range.contains(&number));
        Some(number)
    };
    (parser, is_beyond)
}

/// Says the range below a field for a moment, from when a number beyond it was typed there.
fn say(ui: &Ui, (own, by): (Id, &Response), (range, unit): (&RangeInclusive<f64>, &str), is_beyond: bool) {
    let (place, now) = (Id::unique("beyond its range"), ui.input(|input| input.time));
    if is_beyond {
        let said = Said { field: own, words: words(range, unit), until: now + MOMENT };
        ui.data_mut(|data| data.insert_temp(place, said));
    }
    let said = ui.data(|data| data.get_temp::<Said>(place)).filter(|said| said.field == own && said.until > now);
    let Some(said) = said else { return };
    ui.ctx().request_repaint_after_secs((said.until - now) as f32);
    let area =
        Area::new(place).order(Order::Tooltip).interactable(false).fixed_pos(by.rect.left_bottom() + vec2(0.0, APART));
    area.show(ui.ctx(), |ui| {
        floating(ui).show(ui, |ui| ui.label(RichText::new(said.words).color(colors(ui).lead)));
    });
}

/// "from 2 to 128 px", or the one end that there is.
fn words(range: &RangeInclusive<f64>, unit: &str) -> String {
    let [least, most] = [*range.start(), *range.end()];
    match (least.is_finite(), most.is_finite()) {
        (true, true) => format!("from {} to {}{unit}", number(least), number(most)),
        (true, false) => format!("at least {}{unit}", number(least)),
        _ => format!("at most {}{unit}", number(most)),
    }
}

/// A number as short as it is.
fn number(x: f64) -> String {
    match x.abs() {
        size if size != 0.0 && !(1e-3..1e6).contains(&size) => format!("{x:e}"),
        _ => format!("{:.3}", x).trim_end_matches('0').trim_end_matches('.').to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use egui::{Context, Event, Pos2, RawInput, Rect, Shape};

    use super::super::pointer::click;
    use super::*;

    #[test]
    fn ranges_are_said_in_few_signs() {
        assert_eq!(words(&(2.0..=128.0), " px"), "from 2 to 128 px");
        assert_eq!(words(&(0.0..=1e9), " N/m"), "from 0 to 1e9 N/m");
        assert_eq!(words(&(1e-4..=0.5), ""), "from 1e-4 to 0.5");
        assert_eq!(words(&(0.001..=f64::INFINITY), " m"), "at least 0.001 m");
        assert_eq!(words(&(f64::NEG_INFINITY..=3.25), " m"), "at most 3.25 m");
    }

    #[test]
    fn a_number_beyond_the_range_is_the_nearest_in_it_and_the_range_is_said_for_a_moment() {
        [false, true].into_iter().for_each(type_beyond);
    }

    fn type_beyond(is_slider: bool) {
        let context = Context::default();
        let mut value = 5.0;
        let mut time = 0.0;
        let mut frame = |events: Vec<Event>, later: f64| {
            time += later;
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(400.0, 300.0)));
            let mut at = Pos2::ZERO;
            let input = RawInput { events, screen_rect, time: Some(time), ..RawInput::default() };
            let mut output = context.run_ui(input, |ui| {
                at = if is_slider {
                    let number = Slider::new(&mut value, 2.0..=128.0).suffix(" px").update_while_editing(false);
                    slider(ui, number, 2.0..=128.0, " px").rect.right_center() - vec2(15.0, 0.0)
                } else {
                    let number = DragValue::new(&mut value).suffix(" px").update_while_editing(false);
                    field(ui, number, 2.0..=128.0, " px").rect.center()
                };
            });
            output.textures_delta.clear();
            let is_said = output.shapes.iter().any(|clipped| match &clipped.shape {
                Shape::Text(text) => text.galley.text() == "from 2 to 128 px",
                _ => false,
            });
            (at, is_said, value)
        };
        let at = frame(Vec::new(), 0.1).0;
        let mut type_in = |text: &str| {
            for events in click(at).into_iter().chain([vec![Event::Text(text.to_owned())]]) {
                frame(events, 0.1);
            }
            for events in click(Pos2::new(300.0, 250.0)) {
                frame(events, 0.1);
            }
            let (_, is_said, value) = frame(Vec::new(), 0.1);
            (is_said, value, frame(Vec::new(), MOMENT).1)
        };
        assert_eq!(type_in("64"), (false, 64.0, false), "what is in it needs no word");
        assert_eq!(type_in("1e6"), (true, 128.0, false), "said, then gone");
        assert_eq!(type_in("-3"), (true, 2.0, false));
    }
}
