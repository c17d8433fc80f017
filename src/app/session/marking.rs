//! What tools and scenes mark in the world: lines, knobs, words and labels, as the panels' painter draws them.

use egui::epaint::{ClippedShape, Shape};
use egui::{ClippedPrimitive, Color32, Pos2, Rect, Stroke};

use super::Session;
use crate::app::panels::theme;
use crate::app::tools::{Mark, Role, Scope, labels, moved_label, probe, would_stop};
use crate::app::words::{self, Anchor};
use crate::render::View;

/// Marks are looked for among so many points: more would take longer than a frame.
pub(super) const MOST_MARKED: usize = 100_000;

impl Session {
    /// What tools mark, ready to be painted, the words of it, whatever their digits are, and where the labels of the scene lie, by their numbers.
    pub(super) fn marks(&self) -> (Vec<ClippedPrimitive>, String, Vec<(usize, Rect)>) {
        if !self.player.is_open() {
            return Default::default();
        }
        let (scale, here) = (f64::from(self.look.scale_factor), self.camera_here());
        let scope = Scope { shown: self.shown(), camera: &self.camera, scale, free: self.free.map(glam::DVec2::from) };
        // Over what is selected, which a click on a point or a bond is too.
        let probes: Vec<Mark> = self.probes().flat_map(|(place, point)| probe(scope, place, point)).collect();
        let scope = Scope { camera: &here, ..scope };
        let mut marks = self.marks_of_tools(scope);
        let others = marks.iter().filter(|mark| matches!(mark, Mark::Label(..))).count();
        let own = if self.is_covered() || self.panels.hides_hud { Vec::new() } else { self.labels(scope) };
        let before = others + own.iter().take(self.cell).map(|(numbers, _)| numbers.len()).sum::<usize>();
        let numbers = own.get(self.cell).map_or_else(Vec::new, |(numbers, _)| numbers.clone());
        marks.extend(own.into_iter().flat_map(|(_, marks)| marks));
        marks.extend(probes);
        marks.extend(self.ghosts());
        if !self.is_covered() {
            marks.extend(self.way_to_the_lost(scope));
        }
        if marks.is_empty() {
            return Default::default();
        }
        let (shapes, labels) = self.shapes(&marks);
        let labels = numbers.into_iter().zip(labels.into_iter().skip(before)).collect();
        let context = self.egui.egui_ctx();
        (context.tessellate(shapes, context.pixels_per_point()), said_by(&marks), labels)
    }

    /// What the hand, motors and joints mark.
    fn marks_of_tools(&self, scope: Scope<'_>) -> Vec<Mark> {
        let is_idle =
            !self.hand.is_busy() && (self.is_covered() || self.is_over_panels() || self.pointer.is_dragging());
        let mut marks = Vec::new();
        if !self.is_covered() && self.shown().point_count() <= MOST_MARKED {
            // What is selected is seen while its panel is used.
            let at = self.pixel().filter(|_| !is_idle);
            let label = at.and_then(|at| self.label_at(scope, at));
            // What lies below a label is not meant.
            marks.extend(self.hand.marks(scope, at.filter(|_| label.is_none())));
            marks.extend(label.map(|(_, place)| framed(place, self.egui.egui_ctx().pixels_per_point())));
            if let Some(matter) = self.shown().matter.as_ref().filter(|_| self.panels.previews_stops) {
                marks.extend(would_stop(scope, &matter.coming_stops));
            }
        }
        if !self.is_covered() && !self.panels.hides_hud {
            marks.extend(labels(scope, self.shown().figures.relaxed));
            marks.extend(self.stalls.marks(scope));
        }
        marks
    }

    /// Marks as the panels' painter draws them, and where those lie that are labels `[points]`.
    fn shapes(&self, marks: &[Mark]) -> (Vec<ClippedShape>, Vec<Rect>) {
        let context = self.egui.egui_ctx();
        let scale = context.pixels_per_point();
        let [width, height] = self.area.map(|side| side as f32 / scale);
        let clip_rect = Rect::from_min_max(Pos2::ZERO, Pos2::new(width, height));
        // Words stay off panels at the right edge.
        let room = clip_rect.with_max_x(width.min(self.free[1][0] as f32 / scale + words::SIZE)).shrink(words::APART);
        let panel = |[left, top, right, bottom]: &[f32; 4]| {
            Rect::from_min_max(Pos2::new(left / scale, top / scale), Pos2::new(right / scale, bottom / scale))
        };
        let taken: Vec<Rect> = self.covered.iter().map(panel).collect();
        let room = ((room, self.place_of_pointer()), &taken[..]);
        let mut labels = Vec::new();
        let shapes = marks
            .iter()
            .map(|mark| ClippedShape {
                clip_rect,
                shape: shape(context, mark, scale, room, &mut labels),
                transform_after_tessellation: egui::emath::TSTransform::IDENTITY,
            })
            .collect();
        (shapes, labels)
    }

    /// The label that a press at a pixel takes, and where it lies `[points]`.
    pub(super) fn label_at(&self, scope: Scope<'_>, at: glam::DVec2) -> Option<(usize, Rect)> {
        let pixels = self.egui.egui_ctx().pixels_per_point();
        let point = Pos2::new(at.x as f32 / pixels, at.y as f32 / pixels);
        // What is painted last lies on top.
        let lies = self.labels_at.iter().rev().find(|(_, place)| place.contains(point)).copied();
        lies.filter(|_| self.hand.takes_labels(scope, at))
    }

    /// What the scene says of itself, in each of its worlds: the numbers of those labels that are seen there, and the marks.
    fn labels(&self, scope: Scope<'_>) -> Vec<(Vec<usize>, Vec<Mark>)> {
        let labels = &self.shown().labels;
        if labels.is_empty() {
            return Vec::new();
        }
        let led = self.pixel().and_then(|at| self.hand.led_label(scope, at));
        let labels = led.map_or_else(|| labels.to_vec(), |led| moved_label(labels, led, scope.shown.dimensions));
        let others = self.shown().beside.iter().take(self.tiles.count() - 1);
        let others = others.map(|world| world.view(self.scene.dimensions()));
        let label = |(place, view): (usize, View<'_>)| -> (Vec<usize>, Vec<Mark>) {
            let camera = self.tiles.camera(place, &self.camera, self.area);
            let clip = self.tiles.clip(place, self.area);
            let seen = words::seen(&labels, &view, &camera, clip).into_iter();
            seen.map(|(number, at, text)| (number, Mark::Label(at, text.to_owned(), clip))).unzip()
        };
        std::iter::once(self.shown().view()).chain(others).enumerate().map(label).collect()
    }
}

/// What marks say, with one digit for all: words that count need no other signs.
fn said_by(marks: &[Mark]) -> String {
    let said = marks.iter().filter_map(|mark| match mark {
        Mark::Words(_, words) | Mark::Label(_, words, _) => Some(words),
        _ => None,
    });
    said.flat_map(|words| words.chars()).map(|sign| if sign.is_ascii_digit() { '0' } else { sign }).collect()
}

/// A frame about words, which lie here `[points]`.
fn framed(place: Rect, scale: f32) -> Mark {
    let pixel = |at: Pos2| glam::DVec2::new(at.x.into(), at.y.into()) * f64::from(scale);
    Mark::Frame(Role::Lead, pixel(place.min), pixel(place.max))
}

/// A mark as the panels' painter draws it, with an edge so that it is seen on any ground; labels lie on none of those before them.
fn shape(
    context: &egui::Context,
    mark: &Mark,
    scale: f32,
    (room, taken): ((Rect, Option<Pos2>), &[Rect]),
    labels: &mut Vec<Rect>,
) -> Shape {
    let colors = theme::colors(context);
    let color = |role: &Role| match role {
        Role::Lead => colors.lead,
        Role::Hold | Role::Come => colors.accent,
        Role::Away => colors.away,
        Role::Push => colors.push,
        Role::Probe(place) => colors.probes[*place],
        Role::Ghost => colors.text.gamma_multiply(0.45),
        Role::Paint([red, green, blue]) => Color32::from_rgb(*red, *green, *blue),
    };
    let at = |pixel: &glam::DVec2| Pos2::new(pixel.x as f32 / scale, pixel.y as f32 / scale);
    let edge = colors.edge;
    match mark {
        Mark::Line(role, from, to, width) => {
            let (ends, width) = ([at(from), at(to)], *width as f32 / scale);
            let line = |width, color| Shape::line_segment(ends, Stroke::new(width, color));
            Shape::Vec(vec![line(width + 2.0, edge), line(width, color(role))])
        }
        Mark::Ring(role, middle, radius) => {
            let ring =
                |width, color| Shape::circle_stroke(at(middle), *radius as f32 / scale, Stroke::new(width, color));
            Shape::Vec(vec![ring(4.0, edge), ring(2.0, color(role))])
        }
        Mark::Frame(role, low, high) => {
            let frame = Rect::from_two_pos(at(low), at(high));
            let stroke = Stroke::new(1.2, color(role));
            Shape::rect_stroke(frame, 0.0, stroke, egui::StrokeKind::Middle)
        }
        Mark::Knob(role, middle, radius) => {
            let radius = *radius as f32 / scale;
            Shape::Vec(vec![
                Shape::circle_filled(at(middle), radius + 1.5, edge),
                Shape::circle_filled(at(middle), radius, color(role)),
            ])
        }
        Mark::Square(role, middle, half) => {
            let square = |half| Rect::from_center_size(at(middle), egui::Vec2::splat(2.0 * half));
            let half = *half as f32 / scale;
            Shape::Vec(vec![
                Shape::rect_filled(square(half + 1.5), 2.0, edge),
                Shape::rect_filled(square(half), 1.5, color(role)),
            ])
        }
        Mark::Words(corner, said) => words::written_beside(context, (at(corner), Anchor::Corner), said, (room, taken)),
        Mark::Label(foot, said, clip) => {
            let own = words::points(*clip, scale).shrink(words::APART).intersect(room.0);
            words::written_apart(context, (at(foot), Anchor::Middle), said, ((own, room.1), taken), labels)
        }
    }
}
