//! Boxes that are ticked and rings of which one is chosen: outlined, so that they are seen where nothing is in them.

use egui::{Checkbox, RadioButton, Response, Stroke, Ui, WidgetText};

use super::theme::colors;

/// A box that is ticked or not.
pub(in crate::app) fn check(ui: &mut Ui, is_on: &mut bool, text: impl Into<WidgetText>) -> Response {
    let text = text.into();
    outlined(ui, |ui| ui.add(Checkbox::new(is_on, text)))
}

/// The same, of what may be switched off as a whole.
pub(in crate::app) fn check_if(ui: &mut Ui, is_enabled: bool, is_on: &mut bool, text: &str) -> Response {
    outlined(ui, |ui| ui.add_enabled(is_enabled, Checkbox::new(is_on, text)))
}

/// A ring, filled where it is what is chosen of several.
pub(in crate::app) fn radio(ui: &mut Ui, is_on: bool, text: impl Into<WidgetText>) -> Response {
    let text = text.into();
    outlined(ui, |ui| ui.add(RadioButton::new(is_on, text)))
}

/// A ring that sets `value` to one of several.
pub(in crate::app) fn one_of<T: PartialEq>(
    ui: &mut Ui,
    value: &mut T,
    own: T,
    text: impl Into<WidgetText>,
) -> Response {
    let mut ring = radio(ui, *value == own, text);
    if ring.clicked() && *value != own {
        *value = own;
        ring.mark_changed();
    }
    ring
}

/// Shows something whose frame has an outline: buttons have none, so it is for this alone.
fn outlined(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> Response) -> Response {
    let outline = Stroke::new(1.0, colors(ui).weak);
    let widgets = &mut ui.visuals_mut().widgets;
    let states = [&mut widgets.inactive, &mut widgets.hovered, &mut widgets.active];
    let before = states.map(|state| std::mem::replace(&mut state.bg_stroke, outline));
    let response = add(ui);
    let widgets = &mut ui.visuals_mut().widgets;
    let states = [&mut widgets.inactive, &mut widgets.hovered, &mut widgets.active];
    states.into_iter().zip(before).for_each(|(state, stroke)| state.bg_stroke = stroke);
    response
}

#[cfg(test)]
mod tests {
    use egui::{Color32, Context, Shape};

    use super::super::theme;
    use super::*;
    use crate::render::{Palette, contrast};

    /// The outlines of an empty box and an empty ring.
    fn outlines(context: &Context) -> Vec<Color32> {
        let mut output = context.run_ui(egui::RawInput::default(), |ui| {
            check(ui, &mut false, "a box");
            radio(ui, false, "a ring");
            assert_eq!(ui.visuals().widgets.inactive.bg_stroke, Stroke::NONE, "buttons have none");
        });
        output.textures_delta.clear();
        let stroke = |shape: &Shape| match shape {
            Shape::Rect(rect) if rect.rect.width() < 30.0 => Some(rect.stroke),
            Shape::Circle(circle) => Some(circle.stroke),
            _ => None,
        };
        let strokes = output.shapes.iter().filter_map(|clipped| stroke(&clipped.shape));
        strokes.filter(|stroke| stroke.width >= 1.0).map(|stroke| stroke.color).collect()
    }

    #[test]
    fn empty_boxes_and_rings_are_seen_in_both_palettes() {
        for palette in [Palette::Dark, Palette::Light] {
            let context = Context::default();
            theme::apply(&context, palette);
            let found = outlines(&context);
            assert_eq!(found.len(), 2, "{palette:?}");
            let visuals = context.global_style().visuals.clone();
            let grounds = [visuals.panel_fill, visuals.faint_bg_color, visuals.widgets.inactive.bg_fill];
            for (outline, ground) in found.iter().flat_map(|outline| grounds.map(|ground| (outline, ground))) {
                let found = contrast(outline.to_normalized_gamma_f32(), ground.to_normalized_gamma_f32());
                assert!(found >= 3.0, "{palette:?}: {outline:?} on {ground:?}: {found:.2}");
            }
        }
    }
}
