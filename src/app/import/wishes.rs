//! How a picture is to be cut out and what of: the sliders of the import panel.

use egui::Slider;

use super::Wish;
use crate::app::lengths::length;
use crate::picture::{Picture, Settings, Size, Strokes, Threshold};
use crate::scene::{Matter, PatternName};

/// How many times as far apart points are deep inside as at the boundary, where grading is chosen.
const RATIO: f64 = 3.0;

/// Shows them; what is turned is changed in the wish.
pub(super) fn show(ui: &mut egui::Ui, wish: &mut Wish, picture: &Picture) {
    size(ui, &mut wish.settings);
    let metres = wish.settings.spacing() * wish.height / f64::from(picture.height);
    ui.weak(format!("points are {} apart in the world", length(metres)));
    cut(ui, &mut wish.settings);
    ui.separator();
    body(ui, wish);
}

/// Triangles all of a size, finer at the boundary, or none larger than an area.
fn size(ui: &mut egui::Ui, settings: &mut Settings) {
    let spacing = settings.spacing();
    ui.horizontal(|ui| {
        ui.label("triangles");
        let kinds = [
            ("even", Size::Spacing(spacing), "all of one size"),
            ("graded", Size::Graded { spacing, ratio: RATIO }, "small at the boundary, larger inside"),
            ("by area", Size::of_area(spacing), "none larger than an area of the picture"),
        ];
        for (label, kind, hint) in kinds {
            let is_it = std::mem::discriminant(&kind) == std::mem::discriminant(&settings.size);
            if ui.selectable_label(is_it, label).on_hover_text(hint).clicked() && !is_it {
                settings.size = kind;
            }
        }
    });
    match &mut settings.size {
        Size::Spacing(spacing) | Size::Graded { spacing, .. } => {
            ui.add(Slider::new(spacing, 2.0..=128.0).logarithmic(true).suffix(" px").text("spacing"));
        }
        Size::MaxArea(area) => {
            let range = 3.0..=12_000.0;
            ui.add(Slider::new(area, range).logarithmic(true).suffix(" px²").text("largest area"));
        }
    }
    // Always there, so that nothing moves under the pointer.
    let mut even = 1.0;
    let (ratio, is_graded) = match &mut settings.size {
        Size::Graded { ratio, .. } => (ratio, true),
        _ => (&mut even, false),
    };
    ui.add_enabled(is_graded, Slider::new(ratio, 1.0..=9.0).fixed_decimals(1).text("times as far inside"));
}

/// What of the picture is ink.
fn cut(ui: &mut egui::Ui, settings: &mut Settings) {
    let mut is_automatic = settings.threshold == Threshold::Otsu;
    ui.checkbox(&mut is_automatic, "threshold where the picture splits best");
    let mut threshold = if let Threshold::At(at) = settings.threshold { at } else { 0.5 };
    ui.add_enabled(!is_automatic, Slider::new(&mut threshold, 0.01..=0.99).text("threshold"));
    settings.threshold = if is_automatic { Threshold::Otsu } else { Threshold::At(threshold) };
    ui.checkbox(&mut settings.invert, "invert: what is light or clear is the body");
    ui.checkbox(&mut settings.fill_holes, "fill holes");
    let range = 0.0..=10_000.0;
    ui.add(Slider::new(&mut settings.min_area, range).logarithmic(true).suffix(" px²").text("least area"));
    ui.add(Slider::new(&mut settings.blur, 0..=8).suffix(" px").text("blur, for grainy pictures"));
    ui.horizontal(|ui| {
        ui.label("thin strokes");
        for (strokes, label) in [(Strokes::Ropes, "ropes"), (Strokes::Widen, "widen"), (Strokes::Drop, "drop")] {
            ui.selectable_value(&mut settings.strokes, strokes, label);
        }
    });
}

/// What the body is made of.
fn body(ui: &mut egui::Ui, wish: &mut Wish) {
    ui.horizontal(|ui| {
        ui.label("made of");
        let kinds = [
            (Matter::Soft, "springs"),
            (Matter::Rigid, "rigid bonds"),
            (Matter::Relaxed, "relaxed"),
            (Matter::Fixed, "obstacle"),
        ];
        for (matter, label) in kinds {
            ui.selectable_value(&mut wish.matter, matter, label);
        }
    });
    let moves = wish.matter != Matter::Fixed;
    ui.horizontal(|ui| {
        if !moves {
            ui.disable();
        }
        ui.label("bonds");
        let patterns = [
            (PatternName::Edges, "sides of triangles", "the body may fold where it is squeezed hard"),
            (PatternName::Braced, "braced", "bonds across every two triangles too: the body resists folding"),
        ];
        for (pattern, label, hint) in patterns {
            ui.selectable_value(&mut wish.pattern, pattern, label).on_hover_text(hint);
        }
    });
    let young = Slider::new(&mut wish.young, 100.0..=100_000.0).logarithmic(true).suffix(" N/m").text("stiffness");
    ui.add_enabled(wish.matter == Matter::Soft, young);
    ui.add(Slider::new(&mut wish.height, 0.2..=10.0).logarithmic(true).suffix(" m").text("height"));
    ui.add_enabled(moves, egui::Checkbox::new(&mut wish.apart, "parts as bodies of their own"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_by_area_keeps_the_spacing() {
        let settings = Settings { size: Size::of_area(12.0), ..Settings::default() };
        assert!((settings.spacing() - 12.0).abs() < 1e-9);
    }
}
