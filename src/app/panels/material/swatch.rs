//! Buttons for matter by name.

use egui::{Button, Color32, CornerRadius, Response, RichText, Stroke, Ui};

use crate::app::matter::Preset;
use crate::app::panels::theme::colors;
use crate::render::contrast;

/// Buttons for matter by name, in their colours. Returns the one that was clicked.
pub(in crate::app) fn presets(ui: &mut Ui, chosen: Option<Preset>) -> (Option<Response>, Option<Preset>) {
    let mut clicked = (None, None);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        for preset in Preset::ALL {
            let kind = (preset.name(), preset.color());
            let by = swatch(ui, kind, (chosen == Some(preset), 0.0)).on_hover_text(preset.words());
            if by.clicked() {
                clicked = (Some(by), Some(preset));
            }
        }
    });
    clicked
}

/// What is written on a button, on a bright ground and on a dark one.
const INK: [[u8; 3]; 2] = [[18, 22, 30], [250, 251, 253]];

/// A button for a matter, with its name and in its colour; so wide at least, and ringed where it is what is chosen.
pub(in crate::app::panels) fn swatch(
    ui: &mut Ui,
    (name, [red, green, blue]): (&str, [u8; 3]),
    (is_chosen, width): (bool, f32),
) -> Response {
    let edge = if is_chosen { colors(ui).accent } else { Color32::TRANSPARENT };
    let [bright, dark] = INK.map(|[red, green, blue]| Color32::from_rgb(red, green, blue));
    let fill = Color32::from_rgb(red, green, blue);
    let seen = |ink: Color32| contrast(fill.to_normalized_gamma_f32(), ink.to_normalized_gamma_f32());
    let text = RichText::new(name).color(if seen(bright) >= seen(dark) { bright } else { dark });
    let button = Button::selectable(is_chosen, text)
        .fill(fill)
        .stroke(Stroke::new(2.0, edge))
        .corner_radius(CornerRadius::same(7))
        .min_size(egui::vec2(width, 0.0));
    ui.add(button)
}
