//! The import panel: sliders on one side, the picture with its mesh on the other.

use std::sync::Arc;

use egui::{Color32, Pos2, Rect, Sense, Slider, Stroke, Vec2};

use super::worker::Forecast;
use super::{Answer, Import, Wish};
use crate::picture::{PictureMesh, Size, Strokes, Threshold};
use crate::scene::Matter;

/// Side of the square that the preview fits into [points].
const PREVIEW: f32 = 420.0;
/// Most bonds that are drawn one by one: of more the boundary says enough.
const MOST_SHOWN: usize = 15_000;
/// Longest side of the picture as it is shown [px].
const SHOWN_SIDE: u32 = 1024;

/// Shows the panel. What is changed in it is changed in the import's wish.
pub(super) fn show(import: &mut Import, context: &egui::Context, can_add: bool) -> Option<Answer> {
    let mut answer = None;
    let mut is_open = true;
    let title = if import.painting.is_some() { "Draw a body".to_owned() } else { format!("Import {}", import.name) };
    egui::Window::new(title)
        .id(egui::Id::unique("import"))
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
        .show(context, |ui| {
            ui.horizontal_top(|ui| {
                ui.vertical(|ui| {
                    if let Some(painting) = &mut import.painting {
                        painting.tools(ui);
                    }
                    preview(ui, import);
                });
                ui.vertical(|ui| {
                    ui.set_width(270.0);
                    wishes(ui, &mut import.wish);
                    ui.separator();
                    words(ui, import.forecast.as_ref());
                    ui.separator();
                    answer = buttons(ui, matches!(import.forecast, Some(Ok(_))), can_add);
                });
            });
        });
    if is_open { answer } else { Some(Answer::Cancel) }
}

fn wishes(ui: &mut egui::Ui, wish: &mut Wish) {
    let settings = &mut wish.settings;
    let mut spacing = settings.spacing();
    if ui.add(Slider::new(&mut spacing, 2.0..=128.0).logarithmic(true).suffix(" px").text("spacing")).changed() {
        settings.size = Size::Spacing(spacing);
    }
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
    ui.horizontal(|ui| {
        ui.label("made of");
        for (matter, label) in [(Matter::Soft, "springs"), (Matter::Rigid, "rigid bonds"), (Matter::Relaxed, "relaxed")]
        {
            ui.selectable_value(&mut wish.matter, matter, label);
        }
    });
    let young = Slider::new(&mut wish.young, 100.0..=100_000.0).logarithmic(true).suffix(" N/m").text("stiffness");
    ui.add_enabled(wish.matter == Matter::Soft, young);
    ui.add(Slider::new(&mut wish.height, 0.2..=10.0).logarithmic(true).suffix(" m").text("height"));
}

fn words(ui: &mut egui::Ui, forecast: Option<&Result<Forecast, String>>) {
    match forecast {
        None => {
            ui.weak("cutting it out …");
        }
        Some(Err(error)) => {
            ui.colored_label(Color32::from_rgb(255, 140, 120), error);
        }
        Some(Ok(Forecast { made, frame })) => {
            let mesh = &made.mesh;
            let parts =
                if mesh.components == 1 { "in one part".to_owned() } else { format!("in {} parts", mesh.components) };
            let counts =
                [(mesh.points.len(), "points"), (mesh.bonds.len(), "bonds"), (mesh.triangles.len(), "triangles")];
            let counts: Vec<String> = counts.iter().map(|(count, what)| format!("{count} {what}")).collect();
            ui.label(format!("{} {parts}", counts.join(", ")));
            ui.weak(format!("about {} a frame", time(1e3 * frame)));
        }
    }
}

/// A time [ms] in words.
fn time(ms: f64) -> String {
    match ms {
        ms if ms < 0.1 => "0.1 ms".to_owned(),
        ms if ms < 10.0 => format!("{ms:.1} ms"),
        ms => format!("{ms:.0} ms"),
    }
}

fn buttons(ui: &mut egui::Ui, is_ready: bool, can_add: bool) -> Option<Answer> {
    let mut answer = None;
    ui.horizontal(|ui| {
        let choices = [
            ("Make it a body", Answer::Open, is_ready),
            ("Add to this scene", Answer::Add, is_ready && can_add),
            ("Cancel", Answer::Cancel, true),
        ];
        for (label, choice, is_enabled) in choices {
            if ui.add_enabled(is_enabled, egui::Button::new(label)).clicked() {
                answer = Some(choice);
            }
        }
    });
    answer
}

/// The picture, and its mesh over it.
fn preview(ui: &mut egui::Ui, import: &mut Import) {
    let picture = &import.picture;
    if import.texture.as_ref().is_none_or(|shown| !Arc::ptr_eq(&shown.0, picture)) {
        let small = picture.shrunk(SHOWN_SIDE);
        let size = [small.width as usize, small.height as usize];
        let image = egui::ColorImage::from_rgba_unmultiplied(size, &small.rgba);
        let options = egui::TextureOptions::LINEAR;
        import.texture = Some((Arc::clone(picture), ui.ctx().load_texture("import", image, options)));
    }
    let Some((_, texture)) = &import.texture else { return };
    let size = Vec2::new(picture.width as f32, picture.height as f32);
    let scale = PREVIEW / size.max_elem();
    let (outer, response) = ui.allocate_exact_size(Vec2::splat(PREVIEW), Sense::click_and_drag());
    let place = Rect::from_center_size(outer.center(), size * scale);
    let painter = ui.painter_at(outer);
    if let Some(painting) = &mut import.painting {
        painting.paint(&response, place);
    }
    painter.rect_filled(place, 0.0, Color32::from_gray(60));
    painter.image(texture.id(), place, Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)), Color32::from_gray(150));
    if let Some(painting) = &import.painting {
        painting.outline(&painter, &response, place);
    }
    if let Some(Ok(forecast)) = &import.forecast {
        mesh(&painter, &forecast.made.mesh, place.min, scale);
    }
}

fn mesh(painter: &egui::Painter, mesh: &PictureMesh, corner: Pos2, scale: f32) {
    let at = |k: u32| {
        let [x, y] = mesh.points[k as usize];
        corner + Vec2::new(x as f32, y as f32) * scale
    };
    let (sides, ropes) = mesh.bonds.split_at(mesh.mesh_bonds);
    if sides.len() <= MOST_SHOWN {
        let stroke = Stroke::new(0.7, Color32::from_rgb(120, 210, 255));
        painter.extend(sides.iter().map(|&[a, b]| egui::Shape::line_segment([at(a), at(b)], stroke)));
    }
    for points in &mesh.loops {
        let outline = points.iter().map(|&k| at(k)).collect();
        painter.add(egui::Shape::closed_line(outline, Stroke::new(1.4, Color32::from_rgb(120, 255, 170))));
    }
    let stroke = Stroke::new(2.0, Color32::from_rgb(255, 120, 120));
    painter.extend(ropes.iter().map(|&[a, b]| egui::Shape::line_segment([at(a), at(b)], stroke)));
}
