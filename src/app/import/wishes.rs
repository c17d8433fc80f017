//! How a picture is to be cut out and what of: the sliders of the import panel.

use std::ops::RangeInclusive;

use egui::Slider;

use super::Wish;
use crate::app::lengths::length;
use crate::app::panels::theme::as_high_as_buttons;
use crate::app::panels::{presets, ranged, ticks};
use crate::picture::{Ground, Picture, Settings, Size, Strokes, Threshold};
use crate::scene::{Matter, PatternName};

/// How many times as far apart points are deep inside as at the boundary, where grading is chosen.
const RATIO: f64 = 3.0;

/// Shows them; what is turned is changed in the wish.
pub(super) fn show(ui: &mut egui::Ui, wish: &mut Wish, (picture, ground): (&Picture, Ground), is_painted: bool) {
    taken(ui, &mut wish.settings, (picture, ground));
    ui.separator();
    size(ui, &mut wish.settings);
    let metres = wish.settings.spacing() * wish.height / f64::from(picture.height);
    ui.weak(format!("points are {} apart in the world", length(metres)));
    ui.add_enabled_ui(wish.settings.threshold != Threshold::Whole, |ui| cut(ui, &mut wish.settings));
    ui.separator();
    body(ui, wish, is_painted);
}

/// What stands out from the picture's ground, or all of it; and what is known of that ground.
fn taken(ui: &mut egui::Ui, settings: &mut Settings, (picture, ground): (&Picture, Ground)) {
    let was_whole = settings.threshold == Threshold::Whole;
    let first = Settings::first_spacing(picture, settings.threshold);
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        ui.label("take");
        let kinds = [
            ("what stands out", false, "the shapes of the picture, without their ground"),
            ("the whole picture", true, "a rectangle of all of it, as one body"),
        ];
        for (label, is_whole, hint) in kinds {
            if ui.selectable_label(is_whole == was_whole, label).on_hover_text(hint).clicked() && is_whole != was_whole
            {
                settings.threshold = if is_whole { Threshold::Whole } else { Threshold::Otsu };
            }
        }
    });
    // A spacing that nobody has chosen goes with what is taken.
    if settings.size == Size::Spacing(first) {
        settings.size = Size::Spacing(Settings::first_spacing(picture, settings.threshold));
    }
    ui.weak(match (settings.threshold == Threshold::Whole, ground) {
        (true, Ground::Nothing) => "no even ground that a shape stands out from: all is taken",
        (true, _) => "all of it, its ground too",
        (false, Ground::Nothing) => "it has no even ground: what is dark is taken",
        (false, Ground::Clear) => "its clear pixels are the ground",
        (false, Ground::Light) => "it stands out from light ground",
        (false, Ground::Dark) => "it stands out from dark ground",
    });
}

/// Triangles all of a size, finer at the boundary, or none larger than an area.
fn size(ui: &mut egui::Ui, settings: &mut Settings) {
    let spacing = settings.spacing();
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
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
            slider(ui, (spacing, 2.0..=128.0), ("spacing", " px"), true);
        }
        Size::MaxArea(area) => {
            slider(ui, (area, 3.0..=12_000.0), ("largest area", " px²"), true);
        }
    }
    // Always there, so that nothing moves under the pointer.
    let mut even = 1.0;
    let (ratio, is_graded) = match &mut settings.size {
        Size::Graded { ratio, .. } => (ratio, true),
        _ => (&mut even, false),
    };
    ui.add_enabled_ui(is_graded, |ui| {
        let times = Slider::new(ratio, 1.0..=9.0).fixed_decimals(1).text("times as far inside");
        ranged::slider(ui, times, 1.0..=9.0, "");
    });
}

/// What of the picture is ink.
fn cut(ui: &mut egui::Ui, settings: &mut Settings) {
    let is_whole = settings.threshold == Threshold::Whole;
    let mut is_automatic = is_whole || settings.threshold == Threshold::Otsu;
    ticks::check(ui, &mut is_automatic, "threshold where the picture splits best");
    let mut threshold = if let Threshold::At(at) = settings.threshold { at } else { 0.5 };
    let of_threshold = |ui: &mut egui::Ui| slider(ui, (&mut threshold, 0.01..=0.99), ("threshold", ""), false);
    ui.add_enabled_ui(!is_automatic, of_threshold);
    if !is_whole {
        settings.threshold = if is_automatic { Threshold::Otsu } else { Threshold::At(threshold) };
    }
    ticks::check(ui, &mut settings.invert, "invert: what is light or clear is the body");
    ticks::check(ui, &mut settings.fill_holes, "fill holes");
    slider(ui, (&mut settings.min_area, 0.0..=10_000.0), ("least area", " px²"), true);
    let blur = Slider::new(&mut settings.blur, 0..=8).suffix(" px").text("blur, for grainy pictures");
    ranged::slider(ui, blur, 0.0..=8.0, " px");
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        ui.label("thin strokes");
        for (strokes, label) in [(Strokes::Ropes, "ropes"), (Strokes::Widen, "widen"), (Strokes::Drop, "drop")] {
            ui.selectable_value(&mut settings.strokes, strokes, label);
        }
    });
}

/// A slider of a range with its name and its unit; of a wide one, by factors.
fn slider(
    ui: &mut egui::Ui,
    (value, range): (&mut f64, RangeInclusive<f64>),
    (name, unit): (&str, &str),
    is_wide: bool,
) {
    let slider = Slider::new(value, range.clone()).logarithmic(is_wide).suffix(unit).text(name);
    ranged::slider(ui, slider, range, unit);
}

/// What the body is made of.
fn body(ui: &mut egui::Ui, wish: &mut Wish, is_painted: bool) {
    ui.label("made of");
    if let (_, Some(preset)) = presets(ui, wish.of) {
        wish.of = Some(preset);
        // Rigid ones have no stiffness to be set.
        wish.matter = if preset.material(1.0, 1.0).stiffness.is_some() { Matter::Soft } else { Matter::Rigid };
    }
    let before = (wish.matter, wish.young);
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        ui.label("or of");
        let kinds = [
            (Matter::Soft, "springs"),
            (Matter::Rigid, "rigid bonds"),
            (Matter::Relaxed, "relaxed"),
            (Matter::Fixed, "obstacle"),
        ];
        for (matter, label) in kinds {
            if ui.selectable_label(wish.of.is_none() && wish.matter == matter, label).clicked() {
                (wish.matter, wish.of) = (matter, None);
            }
        }
    });
    let moves = wish.matter != Matter::Fixed;
    ui.horizontal(|ui| {
        if !moves {
            ui.disable();
        }
        as_high_as_buttons(ui);
        ui.label("bonds");
        let patterns = [
            (PatternName::Edges, "sides of triangles", "the body may fold where it is squeezed hard"),
            (PatternName::Braced, "braced", "bonds across every two triangles too: the body resists folding"),
        ];
        for (pattern, label, hint) in patterns {
            ui.selectable_value(&mut wish.pattern, pattern, label).on_hover_text(hint);
        }
    });
    ui.add_enabled_ui(wish.matter == Matter::Soft, |ui| {
        slider(ui, (&mut wish.young, 100.0..=100_000.0), ("stiffness", " N/m"), true);
    });
    // Whoever sets a number means that.
    if (wish.matter, wish.young) != before {
        wish.of = None;
    }
    // The body itself may be less high than what it is cut out of.
    let name = if is_painted { "height of the canvas" } else { "height of the picture" };
    let mut height = wish.height;
    slider(ui, (&mut height, 0.2..=10.0), (name, " m"), true);
    if height != wish.height {
        wish.grow(height);
    }
    ticks::check_if(ui, moves, &mut wish.apart, "parts as bodies of their own");
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
