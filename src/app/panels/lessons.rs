//! Lessons at the right: a list of them, and the steps of the one that is open.

use std::collections::BTreeMap;

use egui::{
    Align, Align2, Area, Button, Frame, Id, Label, Layout, Margin, Rect, RichText, Role, ScrollArea, Sense, Ui,
    WidgetInfo,
};

use super::theme::{as_high_as_buttons, colors, floating};
use super::{Wish, described};
use crate::app::action::{Action, Showing};
use crate::lessons::{Lesson, Step, lessons};
use crate::scene::Scene;

/// Width of the panel: the narrowest, and the widest, in which a step and its plot lie one above the other on a laptop `[points]`.
pub(super) const WIDTH: f32 = 270.0;
const WIDEST: f32 = 380.0;
/// It takes this share of the room's width, between those `[1]`.
const SHARE: f32 = 0.3;
/// From this width on names stand beside their words, and from that one on all that leads on is in one row `[points]`.
const WIDE: f32 = 370.0;
const ROW: f32 = 330.0;
/// Width of such names `[points]`.
const NAMES: f32 = 62.0;
/// Frame and header, above what is scrolled `[points]`.
const HEAD: f32 = 56.0;
/// What is scrolled is no lower, however low a window is; and below the header all that leads on has no room where there is less than that
/// `[points]`.
const LEAST: f32 = 36.0;
const ROOMY: f32 = 130.0;
/// Along the lower edge it takes this share of the height at most `[1]`.
pub(super) const LOW: f32 = 0.4;
/// The middle of the room and so much to its right stays free, but in the narrowest ones `[points]`.
const MIDDLE: f32 = 40.0;
/// Beside what lies at the edge there is place for it in rooms that are so much wider than all of it `[points]`.
const BESIDE: f32 = 500.0;

/// A step of a lesson, by its places in the list and in the lesson.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) struct At {
    pub(in crate::app) lesson: usize,
    pub(in crate::app) step: usize,
}

impl At {
    /// What the step is called.
    pub(in crate::app) fn heading(self) -> Option<&'static str> {
        Some(&lessons().get(self.lesson)?.steps.get(self.step)?.heading)
    }
}

/// What another scene is to the lesson that is open, or was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Met {
    /// Nothing.
    Nothing,
    /// It closed, and had opened the plots or not.
    Left {
        /// It had.
        had_plots: bool,
    },
    /// It is open again, at this step.
    Back(At),
}

/// What the panel keeps.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::app) struct Lessons {
    pub(in crate::app) is_open: bool,
    /// The lesson that is open; `None`: the list is.
    pub(super) lesson: Option<usize>,
    /// A step opened the plots.
    pub(in crate::app) plots: bool,
    /// The steps that lessons were left at.
    steps: BTreeMap<usize, usize>,
    /// The step that was left for another scene, which is gone back to by one click.
    pub(in crate::app) left: Option<At>,
    /// How a step shows bodies, and how they were shown before it.
    showing: Option<[Showing; 2]>,
}

impl Lessons {
    /// A step is shown from now on.
    pub(in crate::app) fn enter(&mut self, at: At) {
        (self.is_open, self.left) = (true, None);
        self.lesson = Some(at.lesson);
        self.steps.insert(at.lesson, at.step);
    }

    /// The step that is open.
    pub(in crate::app) fn open_at(&self) -> Option<At> {
        let lesson = self.lesson.filter(|_| self.is_open)?;
        Some(At { lesson, step: self.step(lesson) })
    }

    /// A scene is there that no step asked for: a lesson whose scene it is not closes, also where its panel was closed before, and one that was
    /// left comes back with its own.
    pub(in crate::app) fn meet(&mut self, scene: &Scene) -> Met {
        let is_of = |at: &At| {
            let own = lessons().get(at.lesson).and_then(|lesson| lesson.scene(at.step));
            own.is_some_and(|own| own.is_ok_and(|own| own == *scene))
        };
        let kept = self.lesson.map(|lesson| At { lesson, step: self.step(lesson) });
        if let Some(at) = kept.filter(|at| !is_of(at)) {
            // The list is what opens next; what was put away by hand is not offered again.
            self.left = Some(at).filter(|_| self.is_open);
            (self.is_open, self.lesson) = (false, None);
            return Met::Left { had_plots: std::mem::take(&mut self.plots) };
        }
        // Whoever opens a third scene has left the lesson behind.
        match self.left.take().filter(is_of) {
            Some(at) => {
                self.enter(at);
                Met::Back(at)
            }
            None => Met::Nothing,
        }
    }

    /// A step shows bodies so, while they are shown as they are `now`.
    pub(in crate::app) fn show_as(&mut self, wanted: Showing, now: Showing) {
        let before = self.showing.filter(|[own, _]| *own == now).map_or(now, |[_, before]| before);
        self.showing = Some([wanted, before]);
    }

    /// Its scene is left: how bodies are shown from now on, unless somebody has chosen that since.
    pub(in crate::app) fn show_no_more(&mut self, now: Showing) -> Option<Showing> {
        self.showing.take().filter(|[own, _]| *own == now).map(|[_, before]| before)
    }

    /// The step that a lesson is at.
    fn step(&self, lesson: usize) -> usize {
        self.steps.get(&lesson).copied().unwrap_or(0)
    }
}

/// Whether there is place for it beside what takes so much of the right edge `[points]`.
pub(super) fn has_room(room: Rect, at_edge: f32) -> bool {
    at_edge == 0.0 || room.width() >= at_edge + WIDTH + BESIDE
}

/// Its width in a room, beside what takes so much of the right edge `[points]`.
pub(super) fn width(room: Rect, at_edge: f32) -> f32 {
    let wide = if at_edge > 0.0 { WIDTH } else { (SHARE * room.width()).clamp(WIDTH, WIDEST) };
    wide.min((0.5 * room.width() - MIDDLE).max(180.0))
}

/// Shows it at the lower right corner of a room, beside what takes so much of the right edge `[points]`. Returns where it begins.
pub(super) fn show(
    context: &egui::Context,
    (room, at_edge): (Rect, f32),
    state: &mut Lessons,
    wishes: &mut Vec<Wish>,
) -> f32 {
    let corner = room.right_bottom() - egui::vec2(10.0 + at_edge, 0.0);
    panel(context, (Align2::RIGHT_BOTTOM, corner), [width(room, at_edge), room.height()], state, wishes)
}

/// Shows it along the lower edge of a room. Returns where it begins `[points]`.
pub(super) fn show_below(context: &egui::Context, room: Rect, state: &mut Lessons, wishes: &mut Vec<Wish>) -> f32 {
    let size = [(room.width() - 36.0).max(180.0), LOW * room.height()];
    panel(context, (Align2::CENTER_BOTTOM, room.center_bottom()), size, state, wishes)
}

/// A panel so wide, and so high at most `[points]`. Returns where it begins.
fn panel(
    context: &egui::Context,
    (pivot, corner): (Align2, egui::Pos2),
    [width, height]: [f32; 2],
    state: &mut Lessons,
    wishes: &mut Vec<Wish>,
) -> f32 {
    let height = (height - HEAD).max(LEAST);
    let shown = Area::new(Id::unique("lessons")).pivot(pivot).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_width(width);
            let open = state.lesson.and_then(|place| Some((place, lessons().get(place)?)));
            header(ui, state, open.map(|(_, lesson)| &*lesson.title), wishes);
            match open {
                Some((place, lesson)) => {
                    let at = At { lesson: place, step: state.step(place).min(lesson.steps.len().saturating_sub(1)) };
                    let next =
                        (place + 1 < lessons().len()).then(|| At { lesson: place + 1, step: state.step(place + 1) });
                    of_lesson(ui, lesson, (at, next), height, wishes);
                }
                None => list(ui, state, height, wishes),
            }
        });
    });
    shown.response.rect.top()
}

fn header(ui: &mut Ui, state: &mut Lessons, title: Option<&str>, wishes: &mut Vec<Wish>) {
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        if state.lesson.is_none() {
            ui.label(RichText::new("Lessons").color(colors(ui).text).strong());
        } else if ui.button("All lessons").clicked() {
            state.lesson = None;
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").on_hover_text(described("close the lessons", Action::Lessons)).clicked() {
                wishes.push(Wish::Act(Action::Lessons));
            }
            if let Some(title) = title {
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    let words = RichText::new(title).color(colors(ui).weak).size(12.0);
                    ui.add(Label::new(words).truncate().selectable(false));
                });
            }
        });
    });
}

/// All lessons, each with what it is about and how far one is.
fn list(ui: &mut Ui, state: &Lessons, height: f32, wishes: &mut Vec<Wish>) {
    ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
        for (place, lesson) in lessons().iter().enumerate() {
            let card = ui.scope_builder(egui::UiBuilder::new().sense(Sense::click()), |ui| {
                let is_hovered = ui.response().hovered();
                let fill = if is_hovered { ui.visuals().widgets.hovered.bg_fill } else { ui.visuals().faint_bg_color };
                Frame::new().fill(fill).corner_radius(8.0).inner_margin(Margin::symmetric(8, 6)).show(ui, |ui| {
                    ui.set_width(ui.available_width());
                    ui.spacing_mut().item_spacing.y = 2.0;
                    line(ui, RichText::new(&lesson.title).color(colors(ui).text).strong());
                    line(
                        ui,
                        RichText::new(&lesson.about)
                            .color(if is_hovered { colors(ui).text } else { colors(ui).weak })
                            .size(12.0),
                    );
                    let count = lesson.steps.len();
                    let said = match state.steps.get(&place) {
                        Some(step) => format!("at step {} of {count}", step + 1),
                        None => format!("{count} steps"),
                    };
                    line(ui, RichText::new(said).color(colors(ui).accent).size(12.0));
                });
            });
            card.response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &lesson.title));
            if card.response.clicked() {
                wishes.push(Wish::Learn(At { lesson: place, step: state.step(place) }));
            }
        }
    });
}

/// Words that are no button.
fn line(ui: &mut Ui, words: RichText) {
    ui.add(Label::new(words).wrap().selectable(false));
}

/// A step, with what leads to others below it, and from the last one to the `next` lesson.
fn of_lesson(ui: &mut Ui, lesson: &Lesson, (at, next): (At, Option<At>), height: f32, wishes: &mut Vec<Wish>) {
    let Some(step) = lesson.steps.get(at.step) else { return };
    let is_wide = ui.available_width() >= ROW;
    let has_again = height >= ROOMY;
    let height = (height - if is_wide || !has_again { 42.0 } else { 78.0 }).max(LEAST);
    let scroll = ScrollArea::vertical().id_salt((at.lesson, at.step)).max_height(height).min_scrolled_height(height);
    scroll.show(ui, |ui| {
        of_step(ui, step);
        if at.step + 1 == lesson.steps.len() {
            part(ui, "Read on", [&*lesson.source]);
        }
    });
    ui.separator();
    ui.horizontal(|ui| {
        if ui.add_enabled(at.step > 0, Button::new("Back")).clicked() {
            wishes.push(Wish::Learn(At { step: at.step.saturating_sub(1), ..at }));
        }
        ui.label(RichText::new(format!("step {} of {}", at.step + 1, lesson.steps.len())).color(colors(ui).weak));
        if is_wide {
            again(ui, at, wishes);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let (words, to) = match at.step + 1 < lesson.steps.len() {
                true => ("Next", Some(At { step: at.step + 1, ..at })),
                false => ("Next lesson", next),
            };
            let Some(to) = to else { return };
            let button = Button::new(RichText::new(words).color(colors(ui).on_accent)).fill(colors(ui).accent);
            if ui.add(button).clicked() {
                wishes.push(Wish::Learn(to));
            }
        });
    });
    if !is_wide && has_again {
        again(ui, at, wishes);
    }
}

/// Leads to the start of the step that is open.
fn again(ui: &mut Ui, at: At, wishes: &mut Vec<Wish>) {
    if ui.button("Begin again").on_hover_text("open the scene of this step again").clicked() {
        wishes.push(Wish::Learn(at));
    }
}

fn of_step(ui: &mut Ui, step: &Step) {
    line(ui, RichText::new(&step.heading).color(colors(ui).text).heading());
    line(ui, RichText::new(&step.text).color(colors(ui).text));
    if let Some(formula) = &step.formula {
        let ground = Frame::new().fill(ui.visuals().extreme_bg_color).corner_radius(6.0);
        ground.inner_margin(Margin::symmetric(8, 6)).show(ui, |ui| {
            ui.set_width(ui.available_width());
            line(ui, RichText::new(formula).color(colors(ui).text).monospace());
        });
    }
    part(ui, "Try", [&*step.to_try]);
    part(ui, "See", [&*step.seen]);
    if !step.claims.is_empty() {
        part(ui, "Measured", step.claims.iter().map(|claim| &*claim.words));
    }
}

/// A few lines beside a word that says what they are, or below it where there is little width.
fn part<'a>(ui: &mut Ui, name: &str, lines: impl IntoIterator<Item = &'a str>) {
    ui.add_space(3.0);
    let name = RichText::new(name).color(colors(ui).accent).size(12.0);
    let words = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        lines.into_iter().for_each(|words| line(ui, RichText::new(words).color(colors(ui).text)));
    };
    if ui.available_width() < WIDE - NAMES {
        line(ui, name);
        ui.scope(words);
        return;
    }
    ui.horizontal_top(|ui| {
        ui.allocate_ui_with_layout(egui::vec2(NAMES, 0.0), Layout::top_down(Align::Min), |ui| {
            ui.set_width(NAMES);
            ui.add_space(1.5);
            line(ui, name);
        });
        ui.vertical(words);
    });
}
