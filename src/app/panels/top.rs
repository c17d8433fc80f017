//! What floats at the top: the scene with those before and after it, and what can be brought in or saved.

use egui::{Area, Id, Rect, RichText};

use super::icons::{self, Icon};
use super::theme::{colors, floating};
use super::{Facts, Wish, button, described, icon};
use crate::app::action::{Action, Showing};

/// In narrower rooms buttons stand closer to each other, so that most of them are in one row `[points]`.
const TIGHT: f32 = 1080.0;

/// Width of the name of what is open `[points]`: what it is called moves no button. The second is that in narrower rooms.
const NAME: [f32; 2] = [150.0, 104.0];

/// Returns where it lies `[points]`.
pub(super) fn show(context: &egui::Context, room: Rect, facts: &Facts, wishes: &mut Vec<Wish>) -> Rect {
    let shown = Area::new(Id::unique("scene")).fixed_pos([10.0, 10.0]).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_max_width((room.width() - 36.0).max(40.0));
            ui.horizontal_wrapped(|ui| {
                if room.width() < TIGHT {
                    ui.spacing_mut().item_spacing.x = 4.0;
                    ui.spacing_mut().button_padding.x = 6.0;
                }
                icon(ui, Icon::Before, "the scene before", Action::PreviousScene, wishes);
                icon(ui, Icon::After, "the scene after", Action::NextScene, wishes);
                let name = egui::Button::new(RichText::new(&facts.title).color(colors(ui).text).strong()).truncate();
                let width = NAME[usize::from(room.width() < TIGHT)].min(ui.max_rect().width());
                let said = format!("{}: {}", facts.title, described("the gallery", Action::Gallery));
                let height = ui.spacing().interact_size.y.max(icons::SMALL.y);
                if ui.add_sized([width, height], name).on_hover_text(said).clicked() {
                    wishes.push(Wish::Act(Action::Gallery));
                }
                ui.separator();
                button(ui, "New", "an empty scene", Action::New, wishes);
                button(ui, "Draw", "draw a body", Action::Paint, wishes);
                button(ui, "Open", "open a scene, a recording or a picture", Action::Open, wishes);
                button(ui, "Save", "save this moment, or all that was done", Action::Save, wishes);
                ui.separator();
                icon(ui, Icon::Undo, "undo", Action::Undo, wishes);
                icon(ui, Icon::Redo, "redo", Action::Redo, wishes);
                ui.separator();
                button(ui, "Fit", "fit all points", Action::Fit, wishes);
                for showing in Showing::ALL {
                    let is_on = facts.showing == showing;
                    let said = described(showing.words(), Action::NextShowing);
                    if ui.selectable_label(is_on, showing.name()).on_hover_text(said).clicked() {
                        wishes.push(Wish::Act(Action::Show(showing)));
                    }
                }
                super::beside::menu(ui, facts, wishes);
                ui.separator();
                icon(ui, Icon::Book, "lessons: how it works", Action::Lessons, wishes);
                icon(ui, Icon::Plot, "plots of the energies", Action::Plots, wishes);
                icon(ui, Icon::Gear, "settings of the scene", Action::Settings, wishes);
                button(ui, "?", "the keys", Action::Help, wishes);
                // Last: where a scene has none no other button stands elsewhere.
                if facts.has_picture {
                    button(ui, "Picture", "cut the scene's first picture out anew", Action::Import, wishes);
                }
            });
        });
    });
    shown.response.rect
}
