//! What can be set of the scene while it runs: a panel at the right. It shows the world as it is, and returns commands.

mod fields;
mod labels;
mod marked;
mod names;
mod push;
mod sections;
mod time;

use std::sync::Arc;

use egui::{Align2, Area, Id, Rect, Response, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo};

use super::theme::{as_high_as_buttons, colors, floating};
use super::typed::takes_words;
use super::{Facts, PanelState, Wish, described};
use crate::app::action::Action;
use crate::app::player::MethodSetting;
use crate::history::{Clock, Do, SetKeys};
use crate::scene::{LabelKeys, Parameter, PrecisionName, Vector};
use crate::sim::{MouseForce, Profile, Region, SceneChange};
use sections::Section;

/// What the field that a search is written in is called.
const SEARCH: &str = "search the settings";
/// Width of the panel `[points]`.
pub(super) const WIDTH: f32 = 250.0;
/// Frame and header, above what is scrolled `[points]`.
const HEAD: f32 = 52.0;
/// What is scrolled is no lower, however low a window is `[points]`.
const LEAST: f32 = 60.0;
/// What can be set, as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct Settings {
    pub(in crate::app) scene: SceneChange,
    /// How fast it is played, and where it ends; `None`: that is not known.
    pub(in crate::app) clock: Option<Clock>,
    /// Strength `[1/s^2]` and radius `[m]` of the hover force; `None`: there is none, or it goes along a track.
    pub(in crate::app) push: Option<[f64; 2]>,
    /// What the hover force is else; `None`: there is none.
    pub(in crate::app) pushing: Option<Pushing>,
    /// What is fixed when a history begins: the precision, and a tolerance `[m]`.
    pub(in crate::app) fixed: Option<(PrecisionName, Option<f64>)>,
    /// The numbers that the scene names, each as it is now.
    pub(in crate::app) parameters: Vec<(Parameter, Option<f64>)>,
    /// The words that stand in the world.
    pub(in crate::app) labels: Arc<Vec<LabelKeys>>,
    /// How many points there were ever: one below that is one that a label can go along with.
    pub(in crate::app) points: usize,
    /// The middle of what is seen `[m]`, while the settings are open.
    pub(in crate::app) middle: [f64; 3],
}

/// Where the hover force acts, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) struct Pushing {
    pub(in crate::app) region: Region,
    pub(in crate::app) profile: Profile,
    /// It goes along a track of its own.
    pub(in crate::app) has_track: bool,
}

impl Pushing {
    pub(in crate::app) fn of(force: &MouseForce) -> Self {
        Pushing { region: force.region, profile: force.profile, has_track: !force.track.knots.is_empty() }
    }
}

/// A setting gets another value.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Setting {
    pub(in crate::app) act: Do,
    /// What it is called when it is undone.
    pub(in crate::app) name: &'static str,
    /// It belongs to the same drag as the last one.
    pub(in crate::app) goes_on: bool,
}

/// Where changes go to.
pub(super) struct Sink<'a> {
    /// What is being dragged.
    gesture: &'a mut Option<Id>,
    wishes: &'a mut Vec<Wish>,
    dimensions: usize,
}

impl Sink<'_> {
    /// What is dragged on is one edit.
    pub(super) fn set(&mut self, by: &Response, name: &'static str, act: Do) {
        self.set_all(by, name, vec![act]);
    }

    /// The same of several commands, which are one edit.
    pub(super) fn set_all(&mut self, by: &Response, name: &'static str, acts: Vec<Do>) {
        let mut goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.is_pointer_button_down_on().then_some(by.id);
        for act in acts {
            self.wishes.push(Wish::Set(Setting { act, name, goes_on }));
            goes_on = true;
        }
    }

    fn scene(&mut self, by: &Response, name: &'static str, keys: SetKeys) {
        self.set(by, name, Do::Set(Box::new(keys)));
    }

    fn method(&mut self, by: &Response, setting: MethodSetting) {
        let goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.is_pointer_button_down_on().then_some(by.id);
        self.wishes.push(Wish::Method(setting, goes_on));
    }

    pub(super) fn vector(&self, v: [f64; 3]) -> Vector {
        Vector::new(v, self.dimensions)
    }
}

/// The field that a search is written in.
pub(in crate::app) fn settings_search_id() -> Id {
    Id::unique("settings search")
}

/// Shows it along the lower edge of a room, in two columns. Returns where it begins `[points]`.
pub(super) fn show_below(
    context: &egui::Context,
    room: Rect,
    state: &mut PanelState,
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) -> f32 {
    let size = [(room.width() - 36.0).max(180.0), (super::lessons::LOW * room.height() - HEAD).max(LEAST)];
    let place = (Align2::CENTER_BOTTOM, room.center_bottom());
    // As high whatever is found: it stands on the lower edge, and the field would move.
    panel(context, (place, size, true), state, (facts, wishes), |ui, facts, sections, sink| {
        let (left, right) = sections.split_at(sections.len().div_ceil(2));
        ui.columns(2, |columns| {
            for (column, list) in columns.iter_mut().zip([left, right]) {
                all_of(column, list, facts, sink);
            }
        });
    })
}

/// Shows it at the upper right corner of a room.
pub(super) fn show(context: &egui::Context, room: Rect, state: &mut PanelState, facts: &Facts, wishes: &mut Vec<Wish>) {
    let corner = room.right_top() - egui::vec2(10.0, 0.0);
    let size = [WIDTH, (room.height() - HEAD).max(LEAST)];
    panel(context, ((Align2::RIGHT_TOP, corner), size, false), state, (facts, wishes), |ui, facts, sections, sink| {
        all_of(ui, sections, facts, sink);
    });
}

/// A panel at a place, so wide and what is scrolled so high at most `[points]`; `is_fixed`: always. Returns where it begins.
fn panel(
    context: &egui::Context,
    ((pivot, corner), [width, height], is_fixed): ((Align2, egui::Pos2), [f32; 2], bool),
    state: &mut PanelState,
    (facts, wishes): (&Facts, &mut Vec<Wish>),
    all: impl FnOnce(&mut Ui, &Facts, &[Section], &mut Sink<'_>),
) -> f32 {
    if !context.input(|input| input.pointer.any_down()) {
        state.gesture = None;
    }
    let (search, is_wanted) = (&mut state.settings_search, std::mem::take(&mut state.finds_setting));
    let mut sink = Sink { gesture: &mut state.gesture, wishes, dimensions: facts.dimensions };
    let area = Area::new(Id::unique("settings")).pivot(pivot).fixed_pos(corner);
    let shown = area.show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_width(width);
            let (mut entered, mut is_new): (Option<Response>, bool) = (None, false);
            ui.horizontal(|ui| {
                as_high_as_buttons(ui);
                ui.label(RichText::new("Settings").color(colors(ui).text).strong());
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button("Close").on_hover_text(described("close the settings", Action::Settings)).clicked() {
                        sink.wishes.push(Wish::Act(Action::Settings));
                    }
                    if is_wanted {
                        search.clear();
                    }
                    let hint = RichText::new("search …").italics();
                    let field = TextEdit::singleline(search).id(settings_search_id()).hint_text(hint);
                    let field = ui.add(field.desired_width(f32::INFINITY));
                    takes_words(&field);
                    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, SEARCH));
                    if is_wanted {
                        field.request_focus();
                    }
                    let field = field.on_hover_text(described("search the settings", Action::FindSetting));
                    is_new = field.changed();
                    let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
                    entered = is_entered.then_some(field);
                });
            });
            let found = sections::found(facts, search);
            // What finds nothing is written anew.
            entered.iter().filter(|_| found.is_empty()).for_each(Response::request_focus);
            let scroll = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
            scroll.auto_shrink([true, !is_fixed]).show(ui, |ui| {
                marked::show(ui, (search, is_new), |ui| all(ui, facts, &found, &mut sink));
                if found.is_empty() {
                    ui.label(RichText::new("no setting found: try another word").color(colors(ui).weak));
                }
            });
        });
    });
    shown.response.rect.top()
}

/// Sections below each other.
fn all_of(ui: &mut Ui, sections: &[Section], facts: &Facts, sink: &mut Sink<'_>) {
    for (place, section) in sections.iter().enumerate() {
        if place > 0 {
            ui.separator();
        }
        section.show(ui, facts, sink);
    }
}
