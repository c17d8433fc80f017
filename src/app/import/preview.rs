//! The picture in the import panel, all of it, and what is taken of it: that is as bright as it is, all else is dim; the canvas, if it is painted.

use std::sync::Arc;

use egui::epaint::Vertex;
use egui::{Color32, Pos2, Rect, Sense, Stroke, TextureId, Vec2};

use super::Import;
use crate::picture::{Picture, PictureMesh};
use crate::scene::PatternName;

/// Side of the square that the preview fits into, at most and at least `[points]`.
pub(super) const LARGEST: f32 = 420.0;
pub(super) const LEAST: f32 = 160.0;
/// Most bonds that are drawn one by one: of more the boundary says enough.
const MOST_SHOWN: usize = 15_000;
/// Longest side of the picture as it is shown `[px]`.
const SHOWN_SIDE: u32 = 1024;

/// How bright the picture is where nothing is known yet, and what is left of it.
const UNKNOWN: Color32 = Color32::from_gray(150);
const LEFT: Color32 = Color32::from_gray(64);
/// What is behind it.
const BEHIND: Color32 = Color32::from_gray(60);

/// Said on an empty canvas.
const TO_DRAW: &str = "Draw a body here: press and drag.\n\nWhat you paint becomes soft.\nFill makes a closed outline solid.\nThen press a button below.";

/// Shows both, in a square of this side `[points]`.
pub(super) fn show(ui: &mut egui::Ui, import: &mut Import, side: f32) {
    let size = Vec2::new(import.picture.width as f32, import.picture.height as f32);
    let scale = side / size.max_elem();
    let (outer, response) = ui.allocate_exact_size(Vec2::splat(side), Sense::click_and_drag());
    let place = Rect::from_center_size(outer.center(), size * scale);
    let painter = ui.painter_at(outer);
    let texture = match &mut import.painting {
        Some(painting) => {
            let layer = ui.layer_id();
            let is_here =
                |at: Pos2| outer.contains(at) && ui.clip_rect().contains(at) && ui.ctx().layer_id_at(at) == Some(layer);
            painting.paint(&ui.input(|input| input.events.clone()), place, is_here);
            painting.texture(ui.ctx())
        }
        None => import.texture.get_or_insert_with(|| load(ui.ctx(), &import.picture)).id(),
    };
    let cut = import.forecast.as_ref().and_then(|made| made.as_ref().ok());
    // What is being painted is seen before it is cut out.
    let taken = cut.filter(|_| import.painting.is_none()).map(|forecast| Arc::clone(&forecast.mesh));
    painter.rect_filled(place, 0.0, BEHIND);
    let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    // What is painted is seen as it comes out.
    let light = match (&import.painting, &taken) {
        (Some(_), _) => Color32::WHITE,
        (None, Some(_)) => LEFT,
        (None, None) => UNKNOWN,
    };
    painter.image(texture, place, whole, light);
    if let Some(mesh) = taken {
        painter.add(bright(&mesh, texture, place));
    }
    if let Some(painting) = &import.painting {
        if !painting.has_work() && painting.is_empty() {
            let font = egui::FontId::proportional(15.0);
            painter.text(place.center(), egui::Align2::CENTER_CENTER, TO_DRAW, font, Color32::from_gray(225));
        }
        painting.outline(&painter, &response, place);
    }
    if let Some(Ok(forecast)) = &import.forecast {
        let is_braced = forecast.wish.pattern == PatternName::Braced;
        mesh(&painter, &forecast.mesh, is_braced, place.min, scale);
    }
}

fn load(context: &egui::Context, picture: &Picture) -> egui::TextureHandle {
    let small = picture.shrunk(SHOWN_SIDE);
    let size = [small.width as usize, small.height as usize];
    let image = egui::ColorImage::from_rgba_unmultiplied(size, &small.rgba);
    context.load_texture("import", image, egui::TextureOptions::LINEAR)
}

/// The part of the picture that is under triangles, as bright as it is.
fn bright(mesh: &PictureMesh, texture: TextureId, place: Rect) -> egui::Mesh {
    let vertices = mesh.texture[..mesh.mesh_points].iter().map(|&[u, v]| Vertex {
        pos: place.lerp_inside(Vec2::new(u, v)),
        uv: Pos2::new(u, v),
        color: Color32::WHITE,
    });
    egui::Mesh {
        vertices: vertices.collect(),
        indices: mesh.triangles.iter().flatten().copied().collect(),
        texture_id: texture,
    }
}

/// Sides in blue, braces fainter, the boundary in green, strokes in red.
fn mesh(painter: &egui::Painter, mesh: &PictureMesh, is_braced: bool, corner: Pos2, scale: f32) {
    let at = |k: u32| {
        let [x, y] = mesh.points[k as usize];
        corner + Vec2::new(x as f32, y as f32) * scale
    };
    let line = |[a, b]: [u32; 2], stroke: Stroke| egui::Shape::line_segment([at(a), at(b)], stroke);
    let (sides, ropes) = mesh.bonds.split_at(mesh.mesh_bonds);
    if sides.len() <= MOST_SHOWN {
        if is_braced {
            let stroke = Stroke::new(0.5, Color32::from_rgba_unmultiplied(120, 210, 255, 50));
            painter.extend(mesh.braces().into_iter().map(|brace| line(brace.ends, stroke)));
        }
        let stroke = Stroke::new(0.7, Color32::from_rgba_unmultiplied(120, 210, 255, 140));
        painter.extend(sides.iter().map(|&side| line(side, stroke)));
    }
    for points in &mesh.loops {
        let outline: Vec<Pos2> = points.iter().map(|&k| at(k)).collect();
        painter.add(egui::Shape::closed_line(outline.clone(), Stroke::new(3.2, Color32::from_black_alpha(160))));
        painter.add(egui::Shape::closed_line(outline, Stroke::new(1.6, Color32::from_rgb(120, 255, 170))));
    }
    let stroke = Stroke::new(2.0, Color32::from_rgb(255, 120, 120));
    painter.extend(ropes.iter().map(|&rope| line(rope, stroke)));
}
