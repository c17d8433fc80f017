//! What a session shows: panels, when they have something new, and the world with what tools mark in it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::epaint::{ClippedShape, Shape};
use egui::{Color32, FontId, Pos2, Rect, Stroke};

use super::begun::panels_for;
use super::trails::AllTrails;
use super::{Framing, Session};
use crate::app::action::{Showing, Tool};
use crate::app::canvas::{Canvas, Paint};
use crate::app::film::Filming;
use crate::app::panels::{self, At, Facts, Laid, Pushing, Settings, parameters, theme};
use crate::app::tools::{Mark, Role, Scope, labels, moved_label, no_motors, no_muscles, probe, would_stop};
use crate::app::whereabouts::{apart, places_of};
use crate::app::words::{self, Anchor};
use crate::lessons::heading_of;
use crate::render::{Look, Overlay, RenderError, View, body_color};
use crate::scene::{Parameter, PrecisionName};
use crate::sim::{Cursor, MouseForce};

/// Marks are looked for among so many points: more would take longer than a frame.
pub(super) const MOST_MARKED: usize = 100_000;
/// So many points are looked at, where it is asked where bodies are.
const MOST_SEEN: usize = 2_000;
/// Of those that are selected so many.
const MOST_MARKS: usize = 16;
/// Panels that lie elsewhere than the time before are laid out so often once more in a row at most.
const MOST_LAID_ANEW: u8 = 3;
/// What numbers over the world are written with: signs are given to the GPU with the panels only, so they are had before, each at any part of
/// a pixel: it stands behind others of several widths.
const SIGNS: &str = "0123456789.,-× m°";
const BEFORE: [&str; 8] = ["", ".", "..", "1", "1.", "11", "11.", "m"];

impl Session {
    /// Shows the panels, and does what they ask for.
    pub(super) fn show_panels(&mut self) {
        self.panels_dirty = false;
        self.panels_at = Some(Instant::now());
        self.move_plots();
        self.weigh();
        let facts = self.facts();
        let waited = facts.waits;
        (self.figures, self.settings) = (self.shown().figures.clone(), self.shown().settings.clone());
        self.matter.clone_from(&self.player.shown().matter);
        let mut input = self.egui.take_egui_input(&self.window);
        self.leave_out_moves(&mut input.events);
        let context = self.egui.egui_ctx().clone();
        if let Some(cut_off) = &mut self.cut_off {
            cut_off.load(&context, &mut self.panels.cut_off);
        }
        if let Some(thumbnails) = &mut self.thumbnails {
            thumbnails.load(&context, &mut self.panels.thumbnails);
            self.panels.is_drawing_thumbnails = thumbnails.is_drawing();
            if self.panels.sheet == Some(panels::Sheet::Gallery) {
                let found = panels::found_scenes(&self.panels.search);
                thumbnails.want(self.panels.in_view.iter().copied().chain(found).collect());
            }
        }
        let mut wishes = Vec::new();
        let mut laid = Laid::default();
        let (mut answer, mut answered) = (None, None);
        let can_add = self.scene.dimensions() == 2;
        let was_open = self.panels.sheet.is_some();
        let output = context.run_ui(input, |ui| {
            ui.fonts_mut(|fonts| {
                for (sign, before) in SIGNS.chars().flat_map(|sign| BEFORE.map(|before| (sign, before))) {
                    fonts.layout_no_wrap(format!("{before}{sign}"), FontId::proportional(words::SIZE), Color32::WHITE);
                }
            });
            (wishes, laid) = panels::show(ui, &mut self.panels, &facts);
            // A sheet lies over the canvas too: it comes back with it.
            let import = self.import.as_mut().filter(|_| self.panels.sheet.is_none());
            answer = import.and_then(|import| import.show(ui.ctx(), can_add));
            answered = self.asked.as_ref().and_then(|asked| panels::ask(ui.ctx(), &asked.question));
            if self.loading.as_ref().is_some_and(|loading| loading.show(ui.ctx())) {
                self.loading = None;
            }
        });
        if was_open && self.panels.sheet.is_none() {
            self.leave_field();
        }
        // What was dragged over bodies on purpose moves no view.
        let dragged = self.panels.matter_at.is_dragged().then_some("matter");
        let read = panels::read_at(&context, output.pixels_per_point, dragged);
        self.give_world(&laid, output.pixels_per_point, read);
        let covered = panels::covered(&context, output.pixels_per_point);
        // What is placed by its size knows that only when it was shown: it is laid out once more, but not for ever.
        self.laid_anew = if covered == self.covered { 0 } else { self.laid_anew.saturating_add(1) };
        self.covered = covered;
        self.egui.handle_platform_output(&self.window, output.platform_output);
        let delay = output.viewport_output.values().map(|viewport| viewport.repaint_delay).min();
        match delay {
            Some(Duration::ZERO) => self.panels_dirty = true,
            _ if (1..=MOST_LAID_ANEW).contains(&self.laid_anew) => self.panels_dirty = true,
            Some(delay) => self.panels_due = Instant::now().checked_add(delay),
            None => {}
        }
        let mut textures = std::mem::take(&mut self.paint.textures);
        textures.append(output.textures_delta);
        self.paint = Paint {
            jobs: context.tessellate(output.shapes, output.pixels_per_point),
            is_new: true,
            marks: Vec::new(),
            textures,
            pixels_per_point: output.pixels_per_point,
        };
        for wish in wishes {
            self.grant(wish);
        }
        if let Some(answer) = answer {
            self.answer(answer);
        }
        if let Some(place) = answered {
            self.answered(place);
        }
        // What stood over the world was closed: no panel says any longer that the world waits for it.
        if waited && !self.waits() {
            self.show_panels();
        }
    }

    /// Moves of the pointer far from panels are nothing to them: each would have them shown once more.
    fn leave_out_moves(&mut self, events: &mut Vec<egui::Event>) {
        let is_near = self.pointer.at.is_some_and(|[x, y]| {
            let is_inside = |&[left, top, right, bottom]: &[f32; 4]| {
                (f64::from(left)..=f64::from(right)).contains(&x) && (f64::from(top)..=f64::from(bottom)).contains(&y)
            };
            self.covered.iter().any(is_inside) || y >= f64::from(self.area[1]) || x >= f64::from(self.area[0])
        });
        let was_near = std::mem::replace(&mut self.was_near_panels, is_near);
        let is_used = is_near || was_near || self.egui.egui_ctx().egui_is_using_pointer();
        events.retain(|event| is_used || !matches!(event, egui::Event::PointerMoved(_)));
    }

    fn facts(&self) -> Facts {
        let entry = self.entry();
        let mut figures = self.shown().figures.clone();
        figures.playing = self.player.is_playing();
        Facts {
            title: self.title(),
            caption: entry
                .filter(|_| !self.player.start().is_replayed())
                .map(|entry| [entry.description, entry.to_try]),
            figures,
            undoes: self.undoes(),
            redoes: self.redoes(),
            pace: if self.player.is_open() { self.pace() } else { 1.0 },
            stretch: self.shown().stretch(),
            frame: self.frame_meter.value(),
            tool: self.hand.tool(),
            primitive: self.hand.primitive(),
            built_of: self.hand.built_of(),
            links: self.hand.links(),
            push: self.hand.push_way(),
            drives: self.hand.drives(),
            hinge: self.panels.hinge,
            no_muscles: no_muscles(self.shown().driving),
            no_motors: no_motors(self.shown().driving),
            brush: self.hand.brush(),
            draws_lasso: self.hand.draws_lasso(),
            matter: self.shown().matter.clone().filter(|_| !self.inspected.is_empty()),
            bearings: Arc::clone(&self.bearings.1),
            overload: self.overload.clone(),
            chosen_at: self.selection_seen(),
            is_grouped: self.is_grouped(),
            drawn_color: body_color(&self.shown().view(), &self.look, &self.inspected.points),
            hidden: self.hidden_count(),
            keys: self.keys_to_hold(),
            key_by_mouse: self.key_by_mouse(),
            driven_at: self.driven_seen(),
            look: self.look,
            palette: self.palette,
            showing: self.showing(),
            has_picture: self.has_picture,
            is_canvas: self.is_canvas(),
            waits: self.waits(),
            asks: self.asked.is_some() && self.import.is_none(),
            is_opening: !self.player.is_open(),
            opening: self.opening(),
            going: self.player.going().filter(|_| self.player.is_open()),
            is_busy: self.player.is_busy(),
            filming: self.filming.as_ref().map(Filming::share),
            dimensions: self.scene.dimensions(),
            seen: if self.panels.has_settings { self.free_of_plane() } else { Default::default() },
            points: self.points_seen(),
            neighbors: self.neighbors(),
            trails: (self.trailing.is_on(), self.trailing.settings),
            tints_distance: self.tints_distance,
            misfits: Arc::clone(&self.misfits.1),
            settings: Settings {
                parameters: self.parameters(),
                scene: self.shown().settings.clone(),
                clock: Some(self.shown().figures.clock),
                fixed: Some((self.scene.method.precision.unwrap_or(PrecisionName::Auto), self.scene.method.tolerance)),
                pushing: self.shown().mouse.as_ref().map(Pushing::of),
                push: self.live_force().map(|force| [self.hand.strength().unwrap_or(force.strength), force.radius]),
                labels: Arc::clone(&self.shown().labels),
                points: self.shown().point_count(),
                middle: if self.panels.has_settings { self.middle_seen() } else { Default::default() },
            },
        }
    }

    /// What is open, as it is called in a list: a recording by its file.
    pub(super) fn title(&self) -> String {
        self.title_of(self.teaches.or(self.taught.filter(|_| self.panels.lessons.is_open)))
    }

    /// The same, for a step of a lesson or none.
    pub(super) fn title_of(&self, step: Option<At>) -> String {
        let start = self.player.start();
        if let Some(saved) = self.player.called().filter(|_| step.is_none()) {
            return saved.to_owned();
        }
        let heading = step.and_then(At::heading).or_else(|| heading_of(self.scene.name()));
        let name = start.name().or(heading).map(str::to_owned);
        let name = name.or_else(|| self.entry().map(|entry| entry.title.to_owned()));
        let name = name.unwrap_or_else(|| self.scene.name().to_owned());
        if start.is_replayed() { format!("{name} (recording)") } else { name }
    }

    /// Where points are and have been seen lately `[points]`, a few of many, while the plots look for a place.
    fn points_seen(&self) -> Vec<Pos2> {
        if self.panels.plots.is_none() || !self.panels.plots_at.seeks() {
            return Vec::new();
        }
        let shown = self.shown();
        let own = |place: usize| self.tiles.camera(place, &self.camera, self.area);
        let cameras: Vec<_> = (0..self.tiles.count()).map(own).collect();
        let pixel = |place: [f64; 3]| {
            let place = glam::DVec3::from(place);
            cameras.iter().filter_map(move |camera| camera.screen_from_world(place))
        };
        // Obstacles have no points.
        let corners = shown.scenery.polygons.iter().flat_map(|polygon| &polygon.loops).flatten();
        let corners = corners.take(MOST_SEEN).map(|[x, y]| [*x, *y, 0.0]);
        let all = places_of(shown, MOST_SEEN).chain(corners).flat_map(pixel).map(|pixel| self.point_of(pixel));
        let ways = apart(self.whereabouts.places().flat_map(pixel).map(|pixel| self.point_of(pixel)));
        // Where one of what is looked at lies, all else weighs less.
        let marked = self.marked_points().into_iter().flat_map(|at| std::iter::repeat_n(at, MOST_SEEN));
        all.chain(ways).chain(marked).collect()
    }

    /// Where the points are seen that are probed or selected `[points]`, a few of many.
    pub(super) fn marked_points(&self) -> Vec<Pos2> {
        let own = |place: usize| self.tiles.camera(place, &self.camera, self.area);
        let cameras: Vec<_> = (0..self.tiles.count()).map(own).collect();
        let selected = self.inspected.points.iter().copied();
        let selected = selected.step_by(self.inspected.points.len() / MOST_MARKS + 1);
        let count = self.shown().point_count();
        let points = self.probed_points().into_iter().chain(selected).filter(|point| point.index() < count);
        let seen = points.flat_map(|point| {
            let place = glam::DVec3::from(self.shown().place(point.index()));
            cameras.iter().filter_map(move |camera| camera.screen_from_world(place)).collect::<Vec<_>>()
        });
        seen.map(|pixel| self.point_of(pixel)).collect()
    }

    /// The numbers that the scene names, while its settings are open.
    fn parameters(&self) -> Vec<(Parameter, Option<f64>)> {
        if !self.panels.has_settings {
            return Vec::new();
        }
        let push = self.live_force().map(|force| [self.hand.strength().unwrap_or(force.strength), force.radius]);
        parameters(&self.named, self.shown(), push)
    }

    /// How bodies are shown.
    pub(super) fn showing(&self) -> Showing {
        match self.look {
            Look { has_fills: false, .. } => Showing::Bonds,
            Look { overlay: Overlay::Strain, .. } => Showing::Strain,
            _ => Showing::Bodies,
        }
    }

    /// Shows bodies in a way.
    pub(super) fn show_as(&mut self, showing: Showing) {
        self.look.has_fills = showing != Showing::Bonds;
        self.look.overlay = if showing == Showing::Strain { Overlay::Strain } else { Overlay::None };
    }

    /// Draws the world and the panels.
    pub(super) fn draw(&mut self) -> Result<(), RenderError> {
        self.look_for_the_lost();
        let (mut marks, words, labels) = self.marks();
        self.labels_at = labels;
        // What is written for the first time has its signs on the GPU with the panels: they are shown once more, so that none is missing.
        if self.marked_words != words {
            self.marked_words = words;
            self.show_panels();
            marks = self.marks().0;
            self.dirty = true;
        }
        self.paint.marks = marks;
        self.note_trails();
        let region = self.region();
        let empty = crate::app::player::Shown { dimensions: self.canvas.dimensions(), ..Default::default() };
        let shown = if self.player.is_open() { self.player.shown() } else { &empty };
        let view = View { mouse: region.as_ref().map(|(force, at)| (force, *at)), ..shown.view() };
        let force = view.mouse;
        let view = View { covered: &self.covered, ..view };
        let inset = if self.panels.hides_panels { 0.0 } else { panels::TOOLS };
        let look = Look { inset, ..self.look };
        let beside = (&shown.beside[..], AllTrails(&self.trails, &self.beside_trails));
        let panes = self.panes(view, beside, (force, &self.camera, look), self.area);
        let done = self.canvas.draw(&panes, self.area, &mut self.paint);
        match done {
            Err(RenderError::Lost { .. }) => self.reopen(),
            done => done,
        }
    }

    /// The region of the hover force: where the pointer is now, however long a step takes.
    pub(super) fn region(&self) -> Option<(MouseForce, Cursor)> {
        if self.is_covered() || self.hand.is_carrying() {
            return None;
        }
        match self.live_force() {
            // It is the hand's alone.
            Some(_) if self.hand.tool() != Tool::Hand && !self.shown().figures.follows => None,
            // Paused, the world has not heard yet of what other tools put away and the hand takes up again.
            Some(force) if !self.player.is_playing() && !self.hand.is_busy() && !self.shown().figures.follows => {
                let strength = self.hand.strength().filter(|_| self.hand.tool() == Tool::Hand)?;
                self.world_cursor().map(|at| (MouseForce { strength, ..force.clone() }, at))
            }
            _ if self.hand.is_calm() => None,
            // What is done again has the cursor of its own.
            Some(force) if self.shown().figures.follows => self.shown().cursor.map(|at| (force.clone(), at)),
            Some(force) => self.world_cursor().map(|at| (force.clone(), at)),
            None => self.shown().mouse.clone().zip(self.shown().cursor),
        }
    }

    /// What tools mark, ready to be painted, the words of it, whatever their digits are, and where the labels of the scene lie, by their numbers.
    fn marks(&self) -> (Vec<egui::ClippedPrimitive>, String, Vec<(usize, Rect)>) {
        let is_idle =
            !self.hand.is_busy() && (self.is_covered() || self.is_over_panels() || self.pointer.is_dragging());
        if !self.player.is_open() {
            return Default::default();
        }
        let (scale, here) = (f64::from(self.look.scale_factor), self.camera_here());
        let scope = Scope { shown: self.shown(), camera: &self.camera, scale, free: self.free.map(glam::DVec2::from) };
        // Over what is selected, which a click on a point or a bond is too.
        let probes: Vec<Mark> = self.probes().flat_map(|(place, point)| probe(scope, place, point)).collect();
        let scope = Scope { camera: &here, ..scope };
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
        let said = marks.iter().filter_map(|mark| match mark {
            Mark::Words(_, words) | Mark::Label(_, words, _) => Some(words),
            _ => None,
        });
        let signs = said.flat_map(|words| words.chars()).map(|sign| if sign.is_ascii_digit() { '0' } else { sign });
        let said = signs.collect();
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
        let shapes: Vec<ClippedShape> = marks
            .iter()
            .map(|mark| ClippedShape {
                clip_rect,
                shape: shape(context, mark, scale, room, &mut labels),
                transform_after_tessellation: egui::emath::TSTransform::IDENTITY,
            })
            .collect();
        let labels = numbers.into_iter().zip(labels.into_iter().skip(before)).collect();
        (context.tessellate(shapes, scale), said, labels)
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

    /// The GPU was lost (a driver's update, a card pulled out): opens what there is now. The world is not touched.
    fn reopen(&mut self) -> Result<(), RenderError> {
        self.canvas = Canvas::new(Arc::clone(&self.window), self.display.clone(), self.scene.dimensions())?;
        // The panels' textures went with the GPU: a fresh context sends them again.
        self.egui = panels_for(&self.window, &self.canvas, self.palette);
        self.paint = Paint::default();
        self.panels.thumbnails.clear();
        self.panels.cut_off.clear();
        (self.thumbnails, self.cut_off) = (None, None);
        self.framing = if self.framing == Framing::Free { Framing::Free } else { Framing::Opening };
        self.touch();
        Ok(())
    }
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
