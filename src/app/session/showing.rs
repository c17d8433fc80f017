//! What the panels of a session show, when they have something new, and what they ask for.

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Color32, FontId, Pos2};

use super::Session;
use crate::app::action::Showing;
use crate::app::canvas::Paint;
use crate::app::film::Filming;
use crate::app::import::Answer;
use crate::app::panels::{self, At, Facts, Laid, Pushing, Settings, Wish, parameters};
use crate::app::thumbnails::{CutOff, Thumbnails};
use crate::app::tools::{no_motors, no_muscles};
use crate::app::whereabouts::{apart, places_of};
use crate::app::words;
use crate::lessons::heading_of;
use crate::render::{Look, Overlay, body_color};
use crate::scene::{Parameter, PrecisionName};

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

/// What panels ask for in one layout.
#[derive(Default)]
struct Replies {
    wishes: Vec<Wish>,
    /// What becomes of a picture that is looked at.
    of_import: Option<Answer>,
    /// Which answer a question got.
    of_question: Option<usize>,
}

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
        self.load_thumbnails(&context);
        let was_open = self.panels.sheet.is_some();
        let (output, laid, replies) = self.lay_panels(&context, input, &facts);
        if was_open && self.panels.sheet.is_none() {
            self.leave_field();
        }
        // What was dragged over bodies on purpose moves no view.
        let dragged = self.panels.matter_at.is_dragged().then_some("matter");
        let read = panels::read_at(&context, output.pixels_per_point, dragged);
        self.give_world(&laid, output.pixels_per_point, read);
        self.take_output(&context, output);
        self.reply(replies);
        // What stood over the world was closed: no panel says any longer that the world waits for it.
        if waited && !self.waits() {
            self.show_panels();
        }
    }

    /// Thumbnails are drawn anew when the gallery opens; those on their way are not waited for.
    pub(super) fn forget_thumbnails(&mut self) {
        self.panels.thumbnails.clear();
        self.panels.cut_off.clear();
        let threads = [self.thumbnails.take().map(Thumbnails::into_aside), self.cut_off.take().map(CutOff::into_aside)];
        threads.into_iter().flatten().for_each(|aside| self.unwanted.take(aside));
    }

    /// Pictures that were drawn since become textures, and those that are seen now are asked for.
    fn load_thumbnails(&mut self, context: &egui::Context) {
        if let Some(cut_off) = &mut self.cut_off {
            cut_off.load(context, &mut self.panels.cut_off);
        }
        if let Some(thumbnails) = &mut self.thumbnails {
            thumbnails.load(context, &mut self.panels.thumbnails);
            self.panels.is_drawing_thumbnails = thumbnails.is_drawing();
            if self.panels.sheet == Some(panels::Sheet::Gallery) {
                let found = panels::found_scenes(&self.panels.search);
                thumbnails.want(self.panels.in_view.iter().copied().chain(found).collect());
            }
        }
    }

    /// Lays the panels out once. Returns what is to be drawn, what they leave of the window, and what they ask for.
    fn lay_panels(
        &mut self,
        context: &egui::Context,
        input: egui::RawInput,
        facts: &Facts,
    ) -> (egui::FullOutput, Laid, Replies) {
        let (mut replies, mut laid) = (Replies::default(), Laid::default());
        let can_add = self.scene.dimensions() == 2;
        let output = context.run_ui(input, |ui| {
            ui.fonts_mut(|fonts| {
                for (sign, before) in SIGNS.chars().flat_map(|sign| BEFORE.map(|before| (sign, before))) {
                    fonts.layout_no_wrap(format!("{before}{sign}"), FontId::proportional(words::SIZE), Color32::WHITE);
                }
            });
            (replies.wishes, laid) = panels::show(ui, &mut self.panels, facts);
            // A sheet lies over the canvas too: it comes back with it.
            let import = self.import.as_mut().filter(|_| self.panels.sheet.is_none());
            replies.of_import = import.and_then(|import| import.show(ui.ctx(), can_add));
            replies.of_question = self.asked.as_ref().and_then(|asked| panels::ask(ui.ctx(), &asked.question));
            if self.loading.as_ref().is_some_and(|loading| loading.show(ui.ctx())) {
                self.loading = None;
            }
        });
        (output, laid, replies)
    }

    /// Keeps what the panels are painted by, and when they are to be laid out again.
    fn take_output(&mut self, context: &egui::Context, output: egui::FullOutput) {
        let covered = panels::covered(context, output.pixels_per_point);
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
    }

    /// Does what the panels ask for.
    fn reply(&mut self, replies: Replies) {
        for wish in replies.wishes {
            self.grant(wish);
        }
        if let Some(answer) = replies.of_import {
            self.answer(answer);
        }
        if let Some(place) = replies.of_question {
            self.answered(place);
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
            new_walls: if self.panels.has_settings { self.new_walls() } else { Default::default() },
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
}
