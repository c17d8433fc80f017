//! The keys that drive what is in the scene, as caps at the lower edge: those that are held are lit.

use egui::{Align2, Area, CornerRadius, FontId, Id, LayerId, Order, Rect, RichText, Sense, StrokeKind, pos2, vec2};

use super::Facts;
use super::places::APART;
use super::theme::{colors, floating};
use crate::sim::Key;

/// Side of a cap `[points]`.
const CAP: f32 = 26.0;
/// What all of it takes of the lower edge, with some room above it `[points]`.
pub(super) const HEIGHT: f32 = CAP + 24.0;
/// Its width before it was shown `[points]`.
const WIDTH: f32 = 120.0;

/// Shows them at the lower edge of a room, in the middle of the window or as near to that as the room has place for them.
pub(super) fn show(context: &egui::Context, room: Rect, facts: &Facts) {
    if facts.keys.is_empty() {
        return;
    }
    let half = 0.5 * context.memory(|memory| memory.area_rect(area_id())).map_or(WIDTH, |rect| rect.width()) + APART;
    let middle = context.content_rect().center().x.min(room.right() - half).max(room.left() + half);
    let place = Area::new(area_id()).pivot(Align2::CENTER_BOTTOM).interactable(false);
    place.fixed_pos(pos2(middle, room.bottom() - 4.0)).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new("hold").color(colors(ui).weak));
                facts.keys.iter().for_each(|&(key, is_held)| cap(ui, key, is_held));
            });
        });
    });
}

fn area_id() -> Id {
    Id::unique("held keys")
}

/// Where they lie, if they are shown `[points]`.
pub(super) fn lie(context: &egui::Context) -> Option<Rect> {
    let layer = LayerId::new(Order::Middle, area_id());
    context.memory(|memory| memory.area_rect(area_id()).filter(|_| memory.areas().is_visible(&layer)))
}

fn cap(ui: &mut egui::Ui, key: Key, is_held: bool) {
    let text = sign(key);
    let width = if text.chars().count() > 1 { 2.4 * CAP } else { CAP };
    let (rect, _) = ui.allocate_exact_size(vec2(width, CAP), Sense::hover());
    let corner = CornerRadius::same(5);
    if is_held {
        ui.painter().rect_filled(rect, corner, colors(ui).accent);
    }
    ui.painter().rect_stroke(rect, corner, egui::Stroke::new(1.2, colors(ui).weak), StrokeKind::Inside);
    let color = if is_held { colors(ui).on_accent } else { colors(ui).text };
    if let Some(turn) = arrow(key) {
        let at = |x: f32, y: f32| rect.center() + 0.26 * CAP * egui::emath::Rot2::from_angle(turn) * vec2(x, y);
        let stroke = egui::Stroke::new(1.8, color);
        ui.painter().line_segment([at(-1.0, 0.0), at(1.0, 0.0)], stroke);
        ui.painter().line(vec![at(0.2, -0.75), at(1.0, 0.0), at(0.2, 0.75)], stroke);
        return;
    }
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, FontId::proportional(14.0), color);
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
