//! What colours of strain mean: a bar with numbers, at the right edge, while strain is shown.

use egui::{Align2, Area, Color32, FontId, Id, Mesh, Rect, Sense, Shape, Ui, pos2, vec2};

use super::places::{APART, Places};
use super::theme::{colors, floating};
use crate::app::lengths::LengthUnit;
use crate::render::{Color, Look};

/// Width and height of the bar `[points]`.
const BAR: [f32; 2] = [230.0, 10.0];
/// Strains with a number at the bar `[%]`.
const NUMBERS: [f32; 7] = [-30.0, -5.0, -1.0, 0.0, 1.0, 5.0, 30.0];

pub(super) fn show(context: &egui::Context, places: &mut Places, look: &Look) {
    places.make_way(BAR[0] + 42.0);
    let place = Area::new(Id::unique("legend")).anchor(Align2::RIGHT_TOP, [-10.0, places.right]).interactable(false);
    let shown = place.show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.vertical(|ui| {
                ui.horizontal(|ui| {
                    ui.set_width(BAR[0] + 24.0);
                    ui.weak("squeezed");
                    ui.add_space(50.0);
                    ui.label(egui::RichText::new("strain").color(colors(ui).text));
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.weak("stretched"));
                });
                let (place, _) = ui.allocate_exact_size(vec2(BAR[0] + 24.0, BAR[1] + 17.0), Sense::hover());
                let bar = Rect::from_min_size(place.min + vec2(12.0, 0.0), BAR.into());
                ui.painter().add(Shape::mesh(shades(bar, &look.strain)));
                for number in NUMBERS {
                    let x = bar.left() + bar.width() * (0.5 + 0.5 * share(0.01 * number, look));
                    ui.painter()
                        .line_segment([pos2(x, bar.bottom()), pos2(x, bar.bottom() + 3.0)], (1.0, colors(ui).weak));
                    let words = if number == 0.0 { "0".to_owned() } else { format!("{number:+}") };
                    let words = if number == 30.0 { format!("{words} %") } else { words };
                    let at = pos2(x, bar.bottom() + 3.0);
                    ui.painter().text(at, Align2::CENTER_TOP, words, FontId::proportional(11.0), colors(ui).text);
                }
            });
        });
    });
    places.right = shown.response.rect.bottom() + APART;
}

/// Shares of the largest distance with a number at the bar, the ends first: what lies between them has no room at a narrow one `[1]`.
const SHARES: [f32; 4] = [1.0, 0.0, 0.1, 0.01];

/// Width of the bar of distances with its numbers `[points]`.
pub(super) const WIDTH: f32 = 220.0;

/// What colours of distance mean.
pub(super) fn of_distance(ui: &mut Ui, look: &Look) {
    ui.weak("distance to the first:");
    let width = ui.available_width().min(WIDTH);
    let (place, _) = ui.allocate_exact_size(vec2(width, BAR[1] + 17.0), Sense::hover());
    let bar = Rect::from_min_size(place.min + vec2(8.0, 0.0), vec2(width - 32.0, BAR[1]));
    let unit = LengthUnit::of(f64::from(look.difference_full));
    ui.painter().add(Shape::mesh(shades(bar, &look.distance)));
    let mut written: Vec<Rect> = Vec::new();
    for share in SHARES {
        let x = bar.left() + bar.width() * (100.0 * share).asinh() / 100.0_f32.asinh();
        ui.painter().line_segment([pos2(x, bar.bottom()), pos2(x, bar.bottom() + 3.0)], (1.0, colors(ui).weak));
        let words = of_length(share * look.difference_full, unit, share == 1.0);
        let at = pos2(x, bar.bottom() + 3.0);
        let galley = ui.painter().layout_no_wrap(words, FontId::proportional(11.0), colors(ui).text);
        let place = Align2::CENTER_TOP.anchor_size(at, galley.size());
        if written.iter().all(|other| !other.intersects(place.expand2(vec2(2.0, 0.0)))) {
            ui.painter().galley(place.min, galley, colors(ui).text);
            written.push(place);
        }
    }
}

/// A number of a unit without zeros at its end; the unit stands at the largest.
fn of_length(metres: f32, unit: LengthUnit, is_last: bool) -> String {
    let number = unit.number(f64::from(metres));
    let number = if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { &number };
    if is_last { format!("{number} {}", unit.name()) } else { number.to_owned() }
}

/// Where a strain lies on the bar: -1 at its left end, 1 at its right one, as in the shader.
fn share(strain: f32, look: &Look) -> f32 {
    let size = (strain.abs() / look.strain_scale).asinh() / (look.strain_full / look.strain_scale).asinh();
    size.min(1.0).copysign(strain)
}

/// The bar in its colours.
fn shades(bar: Rect, colors: &[Color]) -> Mesh {
    let mut mesh = Mesh::default();
    let steps = colors.len() - 1;
    for (place, color) in colors.iter().enumerate() {
        let [red, green, blue, _] = color.map(|part| (255.0 * part).round() as u8);
        let x = bar.left() + bar.width() * place as f32 / steps as f32;
        let first = mesh.vertices.len() as u32;
        for y in [bar.top(), bar.bottom()] {
            mesh.colored_vertex(pos2(x, y), Color32::from_rgb(red, green, blue));
        }
        if place < steps {
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_percent_is_seen_and_thirty_are_at_the_end() {
        let look = Look::default();
        assert_eq!([-0.5, -0.3, 0.0, 0.3].map(|strain| share(strain, &look)), [-1.0, -1.0, 0.0, 1.0]);
        assert!(share(0.01, &look) > 0.25 && share(-0.01, &look) < -0.25);
    }
}
