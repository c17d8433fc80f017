//! The keys that drive what is in the scene, as caps at the lower edge that the mouse holds too: those that are held are lit.

use egui::{
    Align2, Area, CornerRadius, CursorIcon, FontId, Id, LayerId, Order, Rect, Response, RichText, Sense, StrokeKind,
    WidgetInfo, pos2, vec2,
};

use super::places::APART;
use super::theme::{colors, floating};
use super::{Facts, Wish};
use crate::sim::Key;

/// Side of a cap `[points]`.
const CAP: f32 = 26.0;
/// What all of it takes of the lower edge, with some room above it `[points]`.
pub(super) const HEIGHT: f32 = CAP + 24.0;
/// Its width before it was shown `[points]`.
const WIDTH: f32 = 120.0;

/// Shows them at the lower edge of a room, in the middle of the window or as near to that as the room has place for them.
pub(super) fn show(context: &egui::Context, room: Rect, facts: &Facts, wishes: &mut Vec<Wish>) {
    if facts.keys.is_empty() {
        return;
    }
    let mut pressed = None;
    let half = 0.5 * context.memory(|memory| memory.area_rect(area_id())).map_or(WIDTH, |rect| rect.width()) + APART;
    let middle = context.content_rect().center().x.min(room.right() - half).max(room.left() + half);
    let place = Area::new(area_id()).pivot(Align2::CENTER_BOTTOM);
    place.fixed_pos(pos2(middle, room.bottom() - 4.0)).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.set_min_height(CAP);
                ui.label(RichText::new("hold").color(colors(ui).weak));
                for &(key, is_held) in &facts.keys {
                    let is_down = cap(ui, key, is_held).is_pointer_button_down_on();
                    pressed = pressed.or(is_down.then_some(key));
                }
            });
        });
    });
    if pressed != facts.key_by_mouse {
        wishes.push(Wish::Hold(pressed));
    }
}

fn area_id() -> Id {
    Id::unique("held keys")
}

/// Where they lie, if they are shown `[points]`.
pub(super) fn lie(context: &egui::Context) -> Option<Rect> {
    let layer = LayerId::new(Order::Middle, area_id());
    context.memory(|memory| memory.area_rect(area_id()).filter(|_| memory.areas().is_visible(&layer)))
}

/// A key's cap, which is held as long as the mouse is down on it.
fn cap(ui: &mut egui::Ui, key: Key, is_held: bool) -> Response {
    let text = sign(key);
    let width = if text.chars().count() > 1 { 2.4 * CAP } else { CAP };
    let (rect, response) = ui.allocate_exact_size(vec2(width, CAP), Sense::drag());
    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, is_held, key.name()));
    let said = format!("{}: hold it here with the mouse, or on the keyboard", key.name());
    let response = response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(said);
    let corner = CornerRadius::same(5);
    if is_held {
        ui.painter().rect_filled(rect, corner, colors(ui).accent);
    }
    let edge = if response.hovered() { colors(ui).text } else { colors(ui).weak };
    ui.painter().rect_stroke(rect, corner, egui::Stroke::new(1.2, edge), StrokeKind::Inside);
    let color = if is_held { colors(ui).on_accent } else { colors(ui).text };
    if let Some(turn) = arrow(key) {
        let at = |x: f32, y: f32| rect.center() + 0.26 * CAP * egui::emath::Rot2::from_angle(turn) * vec2(x, y);
        let stroke = egui::Stroke::new(1.8, color);
        ui.painter().line_segment([at(-1.0, 0.0), at(1.0, 0.0)], stroke);
        ui.painter().line(vec![at(0.2, -0.75), at(1.0, 0.0), at(0.2, 0.75)], stroke);
        return response;
    }
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, FontId::proportional(14.0), color);
    response
}

/// Which way an arrow looks, clockwise from the right `[rad]`: no font has all of them everywhere.
fn arrow(key: Key) -> Option<f32> {
    use std::f32::consts::{FRAC_PI_2, PI};
    match key.name() {
        "right" => Some(0.0),
        "down" => Some(FRAC_PI_2),
        "left" => Some(PI),
        "up" => Some(-FRAC_PI_2),
        _ => None,
    }
}

fn sign(key: Key) -> String {
    if arrow(key).is_some() { ">".to_owned() } else { key.name().to_uppercase() }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    #[test]
    fn the_mouse_holds_a_key_as_long_as_it_is_down_on_its_cap() {
        let keys: Vec<Key> = ["left", "right"].into_iter().filter_map(Key::of).collect();
        let facts = Facts { keys: keys.iter().map(|key| (*key, false)).collect(), ..Facts::default() };
        let state = (facts, Vec::new());
        let mut harness = Harness::builder().with_size([600.0, 300.0]).build_ui_state(
            |ui, (facts, held): &mut (Facts, Vec<Option<Key>>)| {
                let mut wishes = Vec::new();
                show(ui.ctx(), ui.max_rect(), facts, &mut wishes);
                for wish in wishes {
                    let Wish::Hold(key) = wish else { continue };
                    facts.key_by_mouse = key;
                    held.push(key);
                }
            },
            state,
        );
        harness.run();
        let at = harness.get_by_label("right").rect().center();
        harness.hover_at(at);
        harness.run();
        assert!(harness.state().1.is_empty(), "it is not pressed yet");
        for pressed in [true, false] {
            let button = egui::PointerButton::Primary;
            harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers: Default::default() });
            // However long.
            harness.run_steps(5);
        }
        assert_eq!(harness.state().1, [Some(keys[1]), None]);
    }
}
