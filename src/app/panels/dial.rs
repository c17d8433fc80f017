//! A dial with an arrow that can be dragged: a direction of the plane and a strength.

use egui::epaint::PathShape;
use egui::{Pos2, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2};

use super::theme::colors;

/// Side of the dial `[points]`.
const SIDE: f32 = 72.0;
/// A drag so near to the middle means nothing at all, in radii `[1]`.
const DEAD: f64 = 0.08;
/// Values are rounded to this: nobody drags finer.
const STEP: f64 = 0.1;

/// Shows `value`, y up, where the rim is `full`; returns what it was dragged to.
pub(super) fn show(ui: &mut Ui, name: &str, value: [f64; 2], full: f64) -> (Response, Option<[f64; 2]>) {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(SIDE), Sense::click_and_drag());
    let is_enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, is_enabled, name));
    let (middle, radius) = (rect.center(), 0.5 * SIDE - 4.0);
    let visuals = ui.style().interact(&response);
    ui.painter().circle(middle, radius, visuals.weak_bg_fill, Stroke::new(1.0, colors(ui).weak));
    arrow(ui, middle, radius, value.map(|x| (x / full) as f32));
    let is_held = response.dragged() || response.clicked();
    let to = response.interact_pointer_pos().filter(|_| is_held).map(|at| dragged(at - middle, radius, full));
    (response, to.filter(|to| *to != value))
}

/// What a pointer says that is so far from the middle `[points]`.
fn dragged(from: Vec2, radius: f32, full: f64) -> [f64; 2] {
    let share = [from.x, -from.y].map(|x| f64::from(x / radius));
    let length = share[0].hypot(share[1]);
    if length < DEAD {
        return [0.0; 2];
    }
    share.map(|x| (x * full / length.max(1.0) / STEP).round() * STEP)
}

fn arrow(ui: &Ui, middle: Pos2, radius: f32, share: [f32; 2]) {
    let way = vec2(share[0], -share[1]);
    let way = way * radius / way.length().max(1.0);
    if way.length() < 2.0 {
        ui.painter().circle_filled(middle, 3.0, colors(ui).accent);
        return;
    }
    let (tip, unit) = (middle + way, way.normalized());
    ui.painter().line_segment([middle, tip - 6.0 * unit], Stroke::new(2.0, colors(ui).accent));
    let head = [tip, tip - 9.0 * unit + 5.0 * unit.rot90(), tip - 9.0 * unit - 5.0 * unit.rot90()];
    ui.painter().add(Shape::Path(PathShape::convex_polygon(head.to_vec(), colors(ui).accent, Stroke::NONE)));
    ui.painter().circle_filled(middle, 2.0, colors(ui).text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arrow_goes_to_the_pointer_and_no_further_than_the_rim() {
        assert_eq!(dragged(vec2(0.0, 16.0), 32.0, 20.0), [0.0, -10.0]);
        assert_eq!(dragged(vec2(320.0, 0.0), 32.0, 20.0), [20.0, 0.0]);
        assert_eq!(dragged(vec2(1.0, 1.0), 32.0, 20.0), [0.0, 0.0], "the middle is nothing");
        assert_eq!(dragged(vec2(0.0, -11.04), 32.0, 20.0)[1], 6.9, "by tenths");
    }
}
