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

/// Where along the lower edge they lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Side {
    #[default]
    Middle,
    Left,
    Right,
}

/// In so many frames panels and the view find their places after keys came.
const SETTLING: u8 = 8;

/// Where along the lower edge the keys lie: it is found once for those that there are, so that they stay where they are pressed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct HeldAt {
    keys: Vec<Key>,
    side: Side,
    /// For so many frames more it is found anew.
    left: u8,
}

impl HeldAt {
    /// Whether it is found for these keys.
    pub(in crate::app) fn is_found(&self, keys: &[(Key, bool)]) -> bool {
        self.left == 0 && self.is_of(keys)
    }

    fn is_of(&self, keys: &[(Key, bool)]) -> bool {
        self.keys.iter().eq(keys.iter().map(|(key, _)| key))
    }

    /// Where they lie of some places, the first of which covers nothing of what they drive, or least.
    fn find(&mut self, keys: &[(Key, bool)], places: [(Side, Rect); 3], driven: Option<Rect>) -> Side {
        if !self.is_of(keys) {
            *self = HeldAt { keys: keys.iter().map(|(key, _)| *key).collect(), left: SETTLING, ..HeldAt::default() };
        }
        if keys.iter().any(|(_, is_held)| *is_held) {
            // Nothing moves under what presses it.
            self.left = 0;
        }
        if self.left > 0 {
            let covers = |place: Rect| driven.map_or(0.0, |driven| covered(place.intersect(driven)));
            let best = places.into_iter().min_by(|a, b| covers(a.1).total_cmp(&covers(b.1)));
            self.side = best.map_or(Side::Middle, |(side, _)| side);
            self.left -= 1;
        }
        self.side
    }
}

/// How much a part of the window is, without fractions `[points^2]`.
fn covered(part: Rect) -> f32 {
    if part.is_positive() { part.area().round() } else { 0.0 }
}

/// Shows them at the lower edge of a room: in the middle of the window or as near to that as the room has place for them, or at an end of that
/// edge, where they would cover what they drive.
pub(super) fn show(
    context: &egui::Context,
    (room, held_at): (Rect, &mut HeldAt),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) {
    if facts.keys.is_empty() {
        return;
    }
    let middle = middle(context, room, held_at, facts);
    let place = Area::new(area_id()).pivot(Align2::CENTER_BOTTOM);
    let mut pressed = None;
    place.fixed_pos(pos2(middle, room.bottom() - 4.0)).show(context, |ui| {
        floating(ui).show(ui, |ui| pressed = caps(ui, &facts.keys));
    });
    if pressed != facts.key_by_mouse {
        wishes.push(Wish::Hold(pressed));
    }
}

/// Where along the lower edge of a room their middle is `[points]`.
fn middle(context: &egui::Context, room: Rect, held_at: &mut HeldAt, facts: &Facts) -> f32 {
    let known = context.memory(|memory| memory.area_rect(area_id()));
    let half = 0.5 * known.map_or(WIDTH, |rect| rect.width()) + APART;
    let ends = [room.left() + half, room.right() - half];
    let center = context.content_rect().center().x.min(ends[1]).max(ends[0]);
    let at = |side: Side| match side {
        Side::Middle => center,
        Side::Left => ends[0],
        Side::Right => ends[1].max(ends[0]),
    };
    let place = |side: Side| {
        let low = pos2(at(side) - half, room.bottom() - HEIGHT);
        (side, Rect::from_min_max(low, pos2(at(side) + half, room.bottom())))
    };
    // Their width is known from the second frame on.
    let places = [Side::Middle, Side::Left, Side::Right].map(place);
    at(known.map_or(Side::Middle, |_| held_at.find(&facts.keys, places, facts.driven_at)))
}

/// A cap for each. Returns the key that the mouse holds.
fn caps(ui: &mut egui::Ui, keys: &[(Key, bool)]) -> Option<Key> {
    let row = ui.horizontal(|ui| {
        ui.set_min_height(CAP);
        ui.label(RichText::new("hold").color(colors(ui).weak));
        let mut pressed = None;
        for &(key, is_held) in keys {
            let is_down = cap(ui, key, is_held).is_pointer_button_down_on();
            pressed = pressed.or(is_down.then_some(key));
        }
        pressed
    });
    row.inner
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
                show(ui.ctx(), (ui.max_rect(), &mut HeldAt::default()), facts, &mut wishes);
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

    #[test]
    fn keys_lie_in_the_middle_unless_they_would_cover_what_they_drive_and_then_stay() {
        let keys: Vec<(Key, bool)> =
            ["left", "right"].into_iter().filter_map(Key::of).map(|key| (key, false)).collect();
        let box_at = |x: f32| Rect::from_center_size(pos2(x, 560.0), vec2(160.0, 100.0));
        // Where they lie in a window of 1000 by 600 after what they drive was seen in these places.
        let lies = |seen: &[Option<Rect>], keys: &[(Key, bool)]| {
            let (facts, at) = (Facts { keys: keys.to_vec(), ..Facts::default() }, HeldAt::default());
            let mut harness = Harness::builder().with_size([1000.0, 600.0]).build_ui_state(
                |ui, (facts, at): &mut (Facts, HeldAt)| show(ui.ctx(), (ui.max_rect(), at), facts, &mut Vec::new()),
                (facts, at),
            );
            for driven in seen {
                harness.state_mut().0.driven_at = *driven;
                harness.run_steps(usize::from(SETTLING) + 4);
            }
            lie(&harness.ctx).map_or(0.0, |rect| rect.center().x)
        };
        assert!((lies(&[None], &keys) - 500.0).abs() < 2.0, "nothing is known of what they drive");
        assert!((lies(&[Some(box_at(200.0))], &keys) - 500.0).abs() < 2.0, "it is elsewhere");
        assert!(lies(&[Some(box_at(480.0))], &keys) < 120.0, "beside it");
        let wide = Rect::from_min_max(pos2(0.0, 500.0), pos2(700.0, 600.0));
        assert!(lies(&[Some(wide)], &keys) > 880.0);
        assert!((lies(&[Some(box_at(200.0)), Some(box_at(480.0))], &keys) - 500.0).abs() < 2.0, "they stay");
        let all = Rect::from_min_max(pos2(0.0, 500.0), pos2(1000.0, 600.0));
        assert!((lies(&[Some(all)], &keys) - 500.0).abs() < 2.0, "there is no place beside it");
    }

    #[test]
    fn other_keys_have_a_place_of_their_own() {
        let of = |names: &[&str]| -> Vec<(Key, bool)> {
            names.iter().filter_map(|name| Key::of(name)).map(|key| (key, false)).collect()
        };
        let place = |x: f32| Rect::from_min_size(pos2(x, 0.0), vec2(10.0, 10.0));
        let places = [(Side::Middle, place(50.0)), (Side::Left, place(0.0)), (Side::Right, place(90.0))];
        let mut at = HeldAt::default();
        let mut settled = |names: &[&str], driven: Rect| {
            (0..SETTLING).for_each(|_| _ = at.find(&of(names), places, Some(driven)));
            (at.find(&of(names), places, None), at.is_found(&of(names)))
        };
        assert_eq!(settled(&["a"], place(52.0)), (Side::Left, true));
        assert_eq!(settled(&["a"], place(0.0)), (Side::Left, true), "it stays");
        assert_eq!(settled(&["a", "b"], place(0.0)), (Side::Middle, true));
        assert!(!at.is_found(&of(&["a"])));
    }
}
