//! The import panel: sliders on one side, the picture with its mesh on the other.

use egui::Color32;

use super::worker::Forecast;
use super::{Answer, Import, preview, wishes};
use crate::scene::Matter;

/// Shows the panel. What is changed in it is changed in the import's wish.
pub(super) fn show(import: &mut Import, context: &egui::Context, can_add: bool) -> Option<Answer> {
    let mut answer = None;
    let mut is_open = true;
    let title = match (&import.painting, import.body) {
        (Some(_), _) => "Draw a body".to_owned(),
        (None, Some(_)) => format!("The picture in {}", import.name),
        (None, None) => format!("Import {}", import.name),
    };
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
                    preview::show(ui, import);
                });
                ui.vertical(|ui| {
                    ui.set_width(290.0);
                    wishes::show(ui, &mut import.wish, &import.picture);
                    ui.separator();
                    words(ui, import.forecast.as_ref(), import.painting.is_some());
                    ui.separator();
                    answer = buttons(ui, import, can_add);
                });
            });
        });
    if is_open { answer } else { Some(Answer::Cancel) }
}

fn words(ui: &mut egui::Ui, forecast: Option<&Result<Forecast, String>>, is_painted: bool) {
    match forecast {
        None => {
            ui.weak("cutting it out …");
        }
        Some(Err(error)) if is_painted && error.starts_with("there is nothing in the picture") => {
            ui.weak("draw something on the canvas");
        }
        Some(Err(error)) => {
            ui.colored_label(Color32::from_rgb(255, 140, 120), error);
        }
        Some(Ok(Forecast { outlines, corners, .. })) if *corners > 0 => {
            let outlines = if *outlines == 1 { "one outline".to_owned() } else { format!("{outlines} outlines") };
            ui.label(format!("{corners} corners in {outlines}"));
            ui.weak("points meet its ink and its holes");
        }
        Some(Ok(Forecast { mesh, bonds, frames: [falling, landing], scene, .. })) => {
            let parts = match (mesh.components, scene.bodies.len()) {
                (1, _) => "in one part".to_owned(),
                (count, 1) => format!("in {count} parts"),
                (_, count) => format!("in {count} bodies"),
            };
            let counts = [(mesh.points.len(), "points"), (*bonds, "bonds"), (mesh.triangles.len(), "triangles")];
            let counts: Vec<String> = counts.iter().map(|(count, what)| format!("{count} {what}")).collect();
            ui.label(format!("{} {parts}", counts.join(", ")));
            ui.weak(format!(
                "about {} a frame in the air, {} where it lands",
                time(1e3 * falling),
                time(1e3 * landing)
            ));
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

fn buttons(ui: &mut egui::Ui, import: &Import, can_add: bool) -> Option<Answer> {
    let is_ready = matches!(import.forecast, Some(Ok(_)));
    let is_obstacle = import.wish.matter == Matter::Fixed;
    let into_scene = match import.body {
        // An obstacle is no body.
        Some(_) if !is_obstacle => ("Put in its place", Answer::Replace, is_ready),
        _ => ("Add to this scene", Answer::Add, is_ready && can_add),
    };
    let alone = if is_obstacle { "Make it an obstacle" } else { "Make it a body" };
    let mut answer = None;
    ui.horizontal(|ui| {
        for (label, choice, is_enabled) in
            [(alone, Answer::Open, is_ready), into_scene, ("Cancel", Answer::Cancel, true)]
        {
            if ui.add_enabled(is_enabled, egui::Button::new(label)).clicked() {
                answer = Some(choice);
            }
        }
    });
    answer
}
