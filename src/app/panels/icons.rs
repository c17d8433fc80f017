//! Signs on buttons, drawn as strokes: no font has all of them everywhere.

use std::f32::consts::{PI, TAU};
use std::sync::Arc;

use egui::epaint::PathShape;
use egui::{
    Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, TextStyle, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use super::primitives;
use super::theme::colors;
use crate::app::action::Primitive;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Icon {
    Play,
    Pause,
    Step,
    Reset,
    Before,
    After,
    Undo,
    Redo,
    Hand,
    Pin,
    Cut,
    Erase,
    Build,
    Select,
    Muscle,
    Motor,
    Brush,
    Push,
    Wind,
    Gear,
    Plot,
    Book,
    Close,
    New,
    Draw,
    Open,
    Save,
    Fit,
    Bodies,
    Strain,
    Bonds,
    Beside,
    Keys,
    Picture,
    Primitive(Primitive),
}

/// A button with a sign in place of words; it is called `name` by what reads aloud. `is_on`: it is lit.
pub(super) fn button(ui: &mut Ui, icon: Icon, name: &str, size: Vec2, is_on: bool) -> Response {
    captioned(ui, icon, (name, None), size, is_on)
}

/// The same, with a short word below the sign, if there is one, within the size of the button.
pub(super) fn captioned(
    ui: &mut Ui,
    icon: Icon,
    (name, word): (&str, Option<&str>),
    size: Vec2,
    is_on: bool,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let is_enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, is_enabled, name));
    let visuals = ui.style().interact(&response);
    let fill = lit(ui, &response, is_on).unwrap_or(visuals.weak_bg_fill);
    let color = if is_on { colors(ui).on_accent } else { visuals.fg_stroke.color };
    ui.painter().rect_filled(rect, visuals.corner_radius, fill);
    let high = if word.is_some() { size.y - CAPTION } else { size.y };
    paint(ui.painter(), icon, Rect::from_min_size(rect.min, vec2(size.x, high)), color);
    if let Some(word) = word {
        let foot = pos2(rect.center().x, rect.bottom() - 2.0);
        ui.painter().text(foot, Align2::CENTER_BOTTOM, word, FontId::proportional(LETTERS), color);
    }
    response
}

/// The ground of a button that is lit.
fn lit(ui: &Ui, response: &Response, is_on: bool) -> Option<Color32> {
    let strength = if response.hovered() { 0.85 } else { 1.0 };
    is_on.then(|| colors(ui).accent.gamma_multiply(strength))
}

/// Height of the word below a sign, and of its letters `[points]`.
pub(super) const CAPTION: f32 = 12.0;
const LETTERS: f32 = 10.0;

/// A button with a sign and, where there is room for it, the word that it is called by. `is_on`: it is what is chosen of several.
pub(super) fn worded(ui: &mut Ui, icon: Icon, word: &str, (has_word, is_on): (bool, bool)) -> Response {
    let galley = has_word.then(|| laid_out(ui, word));
    let size = SMALL + vec2(galley.as_deref().map_or(0.0, beside_sign), 0.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let is_enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, is_enabled, word));
    let visuals = ui.style().interact(&response);
    let (fill, color) = match is_on {
        true => (ui.visuals().selection.bg_fill, colors(ui).accent),
        false => (visuals.weak_bg_fill, visuals.fg_stroke.color),
    };
    ui.painter().rect_filled(rect, visuals.corner_radius, fill);
    paint(ui.painter(), icon, rect.with_max_x(rect.left() + SMALL.x), color);
    if let Some(galley) = galley {
        let at = pos2(rect.left() + SMALL.x - SIDE, rect.center().y - 0.5 * galley.size().y);
        ui.painter().galley(at, galley, color);
    }
    response
}

fn laid_out(ui: &Ui, word: &str) -> Arc<Galley> {
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().layout_no_wrap(word.to_owned(), font, Color32::PLACEHOLDER)
}

/// What a word takes beside the sign `[points]`.
fn beside_sign(galley: &Galley) -> f32 {
    galley.size().x + PAD - SIDE
}

/// How wide such a button is with its word `[points]`.
pub(super) fn width(ui: &Ui, word: &str) -> f32 {
    SMALL.x + beside_sign(&laid_out(ui, word))
}

/// Room at the right of such a word, and so much nearer to its sign than a button of that sign would end `[points]`.
const PAD: f32 = 8.0;
const SIDE: f32 = 2.0;

/// Draws a sign into the middle of a rectangle.
fn paint(painter: &Painter, icon: Icon, rect: Rect, color: Color32) {
    // All signs lie in a square from -1 to 1, y down.
    let unit = 0.27 * rect.height();
    let at = |x: f32, y: f32| rect.center() + unit * vec2(x, y);
    let stroke = Stroke::new(1.8, color);
    let line = |points: &[(f32, f32)]| {
        painter.add(Shape::line(points.iter().map(|&(x, y)| at(x, y)).collect(), stroke));
    };
    let filled = |points: &[(f32, f32)]| {
        let points: Vec<Pos2> = points.iter().map(|&(x, y)| at(x, y)).collect();
        painter.add(Shape::Path(PathShape::convex_polygon(points, color, Stroke::NONE)));
    };
    let ring = |x: f32, y: f32, radius: f32| {
        painter.circle_stroke(at(x, y), radius * unit, stroke);
    };
    match icon {
        Icon::Play => filled(&[(-0.7, -1.0), (1.0, 0.0), (-0.7, 1.0)]),
        Icon::Pause => {
            filled(&[(-0.8, -0.95), (-0.25, -0.95), (-0.25, 0.95), (-0.8, 0.95)]);
            filled(&[(0.25, -0.95), (0.8, -0.95), (0.8, 0.95), (0.25, 0.95)]);
        }
        Icon::Step => {
            filled(&[(-0.9, -0.9), (0.5, 0.0), (-0.9, 0.9)]);
            filled(&[(0.55, -0.9), (0.9, -0.9), (0.9, 0.9), (0.55, 0.9)]);
        }
        Icon::Reset => {
            filled(&[(0.9, -0.9), (-0.5, 0.0), (0.9, 0.9)]);
            filled(&[(-0.9, -0.9), (-0.55, -0.9), (-0.55, 0.9), (-0.9, 0.9)]);
        }
        Icon::Before => line(&[(0.4, -0.9), (-0.5, 0.0), (0.4, 0.9)]),
        Icon::After => line(&[(-0.4, -0.9), (0.5, 0.0), (-0.4, 0.9)]),
        Icon::Undo => turn(painter, &at, stroke, color, 1.0),
        Icon::Redo => turn(painter, &at, stroke, color, -1.0),
        Icon::Hand => {
            // A hand that points: a finger, the back of the hand, a thumb.
            line(&[(-0.35, 0.1), (-0.35, -1.1), (0.0, -1.1), (0.0, -0.15), (0.85, 0.05), (0.85, 0.6), (0.55, 1.1)]);
            line(&[(0.55, 1.1), (-0.3, 1.1), (-0.95, 0.25), (-0.7, -0.05), (-0.35, 0.3)]);
        }
        Icon::Pin => {
            painter.circle_filled(at(0.0, -0.45), 0.62 * unit, color);
            line(&[(0.0, 0.1), (0.0, 1.2)]);
        }
        Icon::Cut => {
            line(&[(-0.75, -1.1), (0.45, 0.55)]);
            line(&[(0.75, -1.1), (-0.45, 0.55)]);
            ring(-0.65, 0.85, 0.36);
            ring(0.65, 0.85, 0.36);
        }
        Icon::Erase => {
            line(&[(-0.95, -0.75), (0.95, -0.75)]);
            line(&[(-0.35, -0.75), (-0.35, -1.1), (0.35, -1.1), (0.35, -0.75)]);
            line(&[(-0.7, -0.75), (-0.55, 1.1), (0.55, 1.1), (0.7, -0.75)]);
        }
        Icon::Build => {
            // A square that is not whole yet, and a plus.
            line(&[(0.2, -1.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -0.1)]);
            line(&[(0.75, -1.25), (0.75, -0.35)]);
            line(&[(0.3, -0.8), (1.2, -0.8)]);
        }
        Icon::Select => {
            let tail = [(0.05, 0.25), (0.6, 1.15)];
            line(&[(-0.7, -1.1), (0.9, 0.1), (0.15, 0.2), (-0.45, 0.8), (-0.7, -1.1)]);
            line(&tail);
        }
        Icon::Muscle => {
            // A bond that bulges between its ends.
            line(&[(-1.2, 0.9), (-0.6, 0.45)]);
            line(&[(0.6, -0.45), (1.2, -0.9)]);
            let bulge = |side: f32| {
                let along = (0..=8).map(|k| k as f32 / 4.0 - 1.0);
                let of = |s: f32| (0.6 * s - 0.36 * side * (1.0 - s * s), -0.45 * s - 0.48 * side * (1.0 - s * s));
                along.map(of).collect::<Vec<_>>()
            };
            line(&bulge(1.0));
            line(&bulge(-1.0));
        }
        Icon::Motor => {
            // A wheel about a hub, and which way it turns.
            ring(0.0, 0.1, 0.95);
            painter.circle_filled(at(0.0, 0.1), 0.26 * unit, color);
            filled(&[(-0.25, -1.3), (0.55, -0.85), (-0.25, -0.4)]);
        }
        Icon::Brush => {
            // A handle, a ferrule, a tuft.
            line(&[(1.1, -1.1), (0.1, -0.1)]);
            filled(&[(0.1, -0.45), (0.45, -0.1), (0.1, 0.35), (-0.35, -0.1)]);
            filled(&[(-0.35, -0.05), (0.05, 0.35), (-0.3, 0.9), (-1.1, 1.1), (-0.85, 0.35)]);
        }
        Icon::Push => {
            // A body and an arrow from it.
            ring(-0.55, 0.55, 0.55);
            line(&[(-0.4, 0.4), (0.95, -0.95)]);
            filled(&[(1.2, -1.2), (0.95, -0.2), (0.2, -0.95)]);
        }
        Icon::Wind => {
            // Three gusts, of which two curl up.
            let gust = |y: f32, end: f32, curl: f32| {
                let mut way = vec![(-1.2, y), (end, y)];
                let about = (1..=9).map(|k| (k as f32 / 9.0) * 1.3 * PI);
                way.extend(about.map(|turn| (end + 0.4 * turn.sin(), y + curl * 0.4 * (1.0 - turn.cos()))));
                line(&way);
            };
            gust(-0.3, 0.35, -1.0);
            gust(0.3, 0.75, 1.0);
            line(&[(-1.0, 0.85), (0.1, 0.85)]);
        }
        Icon::Gear => {
            ring(0.0, 0.0, 0.4);
            ring(0.0, 0.0, 0.85);
            for tooth in (0..8).map(|k| k as f32 / 8.0 * TAU) {
                let (sin, cos) = tooth.sin_cos();
                line(&[(0.85 * cos, 0.85 * sin), (1.2 * cos, 1.2 * sin)]);
            }
        }
        Icon::Plot => {
            // Two axes and a curve.
            line(&[(-1.0, -1.1), (-1.0, 1.0), (1.2, 1.0)]);
            line(&[(-0.6, 0.4), (-0.2, -0.6), (0.3, 0.1), (1.0, -0.9)]);
        }
        Icon::Book => {
            // Two pages and the back between them.
            for side in [-1.0, 1.0] {
                line(&[(0.0, -0.7), (0.55 * side, -1.0), (1.3 * side, -0.85), (1.3 * side, 0.75)]);
                line(&[(1.3 * side, 0.75), (0.55 * side, 0.65), (0.0, 0.95)]);
            }
            line(&[(0.0, -0.7), (0.0, 0.95)]);
        }
        Icon::Close => {
            line(&[(-0.6, -0.6), (0.6, 0.6)]);
            line(&[(-0.6, 0.6), (0.6, -0.6)]);
        }
        Icon::New => {
            // A sheet with a corner turned down, and a plus.
            line(&[(0.1, 1.1), (-0.9, 1.1), (-0.9, -1.1), (0.3, -1.1), (0.9, -0.5), (0.9, 0.0)]);
            line(&[(0.3, -1.1), (0.3, -0.5), (0.9, -0.5)]);
            line(&[(0.75, 0.35), (0.75, 1.25)]);
            line(&[(0.3, 0.8), (1.2, 0.8)]);
        }
        Icon::Draw => {
            // A pencil.
            line(&[(-1.1, 1.1), (-0.85, 0.25), (0.55, -1.15), (1.15, -0.55), (-0.25, 0.85), (-1.1, 1.1)]);
            line(&[(0.15, -0.75), (0.75, -0.15)]);
        }
        Icon::Open => {
            // A folder.
            line(&[(-1.2, 0.95), (-1.2, -0.95), (-0.45, -0.95), (-0.1, -0.55), (0.95, -0.55), (0.95, -0.15)]);
            line(&[(-1.2, 0.95), (-0.75, -0.15), (1.35, -0.15), (0.95, 0.95), (-1.2, 0.95)]);
        }
        Icon::Save => {
            // Into a tray.
            line(&[(0.0, -1.2), (0.0, 0.3)]);
            line(&[(-0.5, -0.2), (0.0, 0.35), (0.5, -0.2)]);
            line(&[(-1.1, 0.2), (-1.1, 1.05), (1.1, 1.05), (1.1, 0.2)]);
        }
        Icon::Fit => {
            // The corners of what is seen, and what is shown in it.
            for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
                line(&[(1.15 * x, 0.5 * y), (1.15 * x, 1.05 * y), (0.55 * x, 1.05 * y)]);
            }
            painter.circle_filled(at(0.0, 0.0), 0.42 * unit, color);
        }
        Icon::Bodies => {
            painter.circle_filled(at(-0.45, 0.35), 0.75 * unit, color);
            line(&[(0.2, -0.5), (0.2, -1.1), (1.1, -1.1), (1.1, -0.2), (0.6, -0.2)]);
        }
        Icon::Strain => {
            // What is pulled apart.
            line(&[(-0.45, 0.0), (0.45, 0.0)]);
            filled(&[(-1.3, 0.0), (-0.6, -0.5), (-0.6, 0.5)]);
            filled(&[(1.3, 0.0), (0.6, -0.5), (0.6, 0.5)]);
            line(&[(-0.5, -0.95), (-0.5, -1.05), (0.5, -1.05), (0.5, -0.95)]);
            line(&[(-0.5, 0.95), (-0.5, 1.05), (0.5, 1.05), (0.5, 0.95)]);
        }
        Icon::Bonds => {
            let corners = [(-0.95, 0.8), (0.95, 0.8), (0.0, -0.9)];
            line(&[corners[0], corners[1], corners[2], corners[0]]);
            corners.into_iter().for_each(|(x, y)| _ = painter.circle_filled(at(x, y), 0.34 * unit, color));
        }
        Icon::Beside => {
            // Two windows side by side.
            for x in [-0.65, 0.65] {
                line(&[(x - 0.5, -0.9), (x + 0.5, -0.9), (x + 0.5, 0.9), (x - 0.5, 0.9), (x - 0.5, -0.9)]);
            }
        }
        Icon::Keys => {
            let font = FontId::proportional(2.1 * unit);
            _ = painter.text(rect.center(), Align2::CENTER_CENTER, "?", font, color);
        }
        Icon::Picture => {
            // Hills in a frame.
            line(&[(-1.2, -0.95), (1.2, -0.95), (1.2, 0.95), (-1.2, 0.95), (-1.2, -0.95)]);
            line(&[(-1.2, 0.7), (-0.4, -0.15), (0.2, 0.5), (0.55, 0.15), (1.2, 0.75)]);
            painter.circle_filled(at(0.6, -0.45), 0.2 * unit, color);
        }
        Icon::Primitive(primitive) => primitives::paint(painter, primitive, &at, stroke),
    }
}

/// An arrow that turns back, to the left (`side` 1) or to the right (-1).
fn turn(painter: &Painter, at: &impl Fn(f32, f32) -> Pos2, stroke: Stroke, color: Color32, side: f32) {
    let arc = (0..=14).map(|step| {
        let angle = -0.42 * TAU + step as f32 / 14.0 * (0.42 * TAU + 0.25 * PI);
        at(side * 0.85 * angle.cos(), 0.2 + 0.85 * angle.sin())
    });
    painter.add(Shape::line(arc.collect(), stroke));
    let head = [(-1.25, 0.05), (-0.35, -0.05), (-0.95, -0.85)].map(|(x, y)| at(side * x, y));
    painter.add(Shape::Path(PathShape::convex_polygon(head.to_vec(), color, Stroke::NONE)));
}

/// The size of a small button.
pub(super) const SMALL: Vec2 = vec2(30.0, 28.0);
/// The size of a tool.
pub(super) const TOOL: Vec2 = vec2(38.0, 34.0);

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn every_sign_draws_something() {
        let context = egui::Context::default();
        let all = [Icon::Play, Icon::Pause, Icon::Step, Icon::Reset, Icon::Before, Icon::After];
        let more = [Icon::Undo, Icon::Redo, Icon::Hand, Icon::Pin, Icon::Cut, Icon::Erase, Icon::Build, Icon::Select];
        let more = more.into_iter().chain([Icon::Muscle, Icon::Motor, Icon::Brush, Icon::Push, Icon::Wind]);
        for icon in all
            .into_iter()
            .chain(more)
            .chain([Icon::Gear, Icon::Plot, Icon::Book, Icon::Close, Icon::New, Icon::Draw, Icon::Open, Icon::Save])
            .chain([Icon::Fit, Icon::Bodies, Icon::Strain, Icon::Bonds, Icon::Beside, Icon::Keys, Icon::Picture])
            .chain(Primitive::ALL.map(Icon::Primitive))
        {
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(30.0, 30.0));
                paint(ui.painter(), icon, rect, Color32::WHITE);
            });
            output.textures_delta.clear();
            assert!(!output.shapes.is_empty(), "{icon:?}");
        }
    }
}
