//! What is searched for is marked where it is written, and scrolled to.

use egui::layers::ShapeIdx;
use egui::{Align, LayerId, Rect, Shape, Ui};

use crate::app::panels::theme::colors;

/// How opaque the mark is, which lies over the words `[1]`.
const OPACITY: f32 = 0.28;

/// Shows something, and marks in it the words of a search; `is_new`: it has just been written, and the first place where it stands is scrolled to.
pub(super) fn show(ui: &mut Ui, (search, is_new): (&str, bool), add: impl FnOnce(&mut Ui)) {
    let wanted: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    if wanted.is_empty() {
        return add(ui);
    }
    let (layer, clip) = (ui.layer_id(), ui.clip_rect());
    let before = count(ui, layer);
    if is_new {
        // What is out of view is painted, too, so that it is found.
        ui.set_clip_rect(Rect::EVERYTHING);
    }
    add(ui);
    ui.set_clip_rect(clip);
    if is_new {
        cut(ui, layer, before, clip);
    }
    let found = found(ui, (layer, before), &wanted);
    let color = colors(ui).accent.gamma_multiply(OPACITY);
    found.iter().for_each(|place| _ = ui.painter().rect_filled(place.expand2(egui::vec2(3.0, 1.0)), 4.0, color));
    if is_new && let Some(first) = found.first() {
        ui.scroll_to_rect(*first, Some(Align::Center));
    }
}

/// How many shapes a layer has.
fn count(ui: &Ui, layer: LayerId) -> usize {
    ui.ctx().graphics(|graphics| graphics.get(layer).map_or(0, |list| list.next_idx().0))
}

/// Shapes from one on are seen within a part of the screen alone.
fn cut(ui: &Ui, layer: LayerId, from: usize, clip: Rect) {
    ui.ctx().graphics_mut(|graphics| {
        let list = graphics.entry(layer);
        for shape in from..list.next_idx().0 {
            list.mutate_shape(ShapeIdx(shape), |shape| shape.clip_rect = shape.clip_rect.intersect(clip));
        }
    });
}

/// Where words stand that have all that is wanted in them, among the shapes of a layer from one on.
fn found(ui: &Ui, (layer, from): (LayerId, usize), wanted: &[String]) -> Vec<Rect> {
    let is_wanted = |text: &str| {
        let text = text.to_lowercase();
        wanted.iter().all(|word| text.contains(word))
    };
    ui.ctx().graphics(|graphics| {
        let shapes = graphics.get(layer).into_iter().flat_map(|list| list.all_entries().skip(from));
        let places = shapes.filter_map(|shape| match &shape.shape {
            Shape::Text(text) if is_wanted(text.galley.text()) => Some(text.visual_bounding_rect()),
            _ => None,
        });
        places.collect()
    })
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput, ScrollArea, pos2, vec2};

    use super::*;

    /// The marks of a search in a list of forty lines that is too long for its place, and what of the list is seen.
    fn frame(context: &Context, search: &str, is_new: bool) -> (Vec<Rect>, Rect) {
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 200.0)));
        let (mut seen, mut color) = (Rect::NOTHING, egui::Color32::default());
        let mut output = context.run_ui(RawInput { screen_rect, ..RawInput::default() }, |ui| {
            color = colors(ui).accent.gamma_multiply(OPACITY);
            let scroll = ScrollArea::vertical().max_height(100.0).animated(false).show(ui, |ui| {
                show(ui, (search, is_new), |ui| {
                    (0..40).for_each(|line| _ = ui.label(format!("line {line} here")));
                });
            });
            seen = scroll.inner_rect;
        });
        output.textures_delta.clear();
        let mark = |shape: &Shape| match shape {
            Shape::Rect(rect) if rect.fill == color => Some(rect.rect),
            _ => None,
        };
        (output.shapes.iter().filter_map(|clipped| mark(&clipped.shape)).collect(), seen)
    }

    #[test]
    fn what_is_searched_for_is_marked_and_brought_into_view() {
        let context = Context::default();
        frame(&context, "", false);
        assert!(frame(&context, "", false).0.is_empty());
        assert!(frame(&context, "LINE 31", false).0.is_empty(), "out of view");
        let (marks, seen) = frame(&context, "LINE 31", true);
        assert!(marks.len() == 1 && !seen.intersects(marks[0]), "{marks:?}");
        frame(&context, "LINE 31", false);
        let (marks, seen) = frame(&context, "LINE 31", false);
        // A mark is a little wider than its words.
        assert!(marks.len() == 1 && seen.expand(4.0).contains_rect(marks[0]), "{marks:?} in {seen}");
        assert!(frame(&context, "31 nowhere", false).0.is_empty(), "a word of it alone");
    }
}
