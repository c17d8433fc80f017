//! A name for a file that is to be written, where the system has no dialog for it.

use egui::{Align2, Button, Key, RichText, TextEdit, Window};

use super::theme::{ACCENT, ON_ACCENT};
use super::{PanelState, Wish};

pub(super) fn show(context: &egui::Context, state: &mut PanelState, wishes: &mut Vec<Wish>) {
    let mut is_open = true;
    Window::new("Save all that was done")
        .id(egui::Id::unique("save to"))
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(context, |ui| {
            let field = ui.add(TextEdit::singleline(&mut state.path).desired_width(420.0));
            if std::mem::take(&mut state.is_fresh) {
                field.request_focus();
            }
            ui.horizontal(|ui| {
                let save = Button::new(RichText::new("Save").color(ON_ACCENT)).fill(ACCENT);
                let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                let is_asked = ui.add_enabled(!state.path.trim().is_empty(), save).clicked() || is_entered;
                if is_asked && !state.path.trim().is_empty() {
                    wishes.push(Wish::SaveTo(state.path.trim().into()));
                }
                if ui.button("Cancel").clicked() {
                    state.sheet = None;
                }
                ui.weak(".json is a recording, .jsonl one of lines");
            });
        });
    if !is_open {
        state.sheet = None;
    }
}
