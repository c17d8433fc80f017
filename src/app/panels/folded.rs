//! A panel of a tool: in a small window its title folds it, and unfolds it.

use egui::collapsing_header::CollapsingState;
use egui::{Id, Label, RichText, Sense, Ui};

use super::theme::colors;

/// Shows what a panel has below its title, which folds it where it `can_fold`.
pub(super) fn titled(ui: &mut Ui, (title, can_fold): (&str, bool), body: impl FnOnce(&mut Ui)) {
    match can_fold {
        true => folded(ui, title, body),
        false => {
            heading(ui, title);
            body(ui);
        }
    }
}

/// Shows what a panel has; where it `can_fold`, below a title that does that.
pub(super) fn untitled(ui: &mut Ui, (title, can_fold): (&str, bool), body: impl FnOnce(&mut Ui)) {
    if can_fold { folded(ui, title, body) } else { body(ui) }
}

/// Shows a part of a panel below a line of words; where it `can_fold` that is closed until it is clicked. `hint` is said of the line.
pub(super) fn part(ui: &mut Ui, (words, hint, can_fold): (&str, &str, bool), body: impl FnOnce(&mut Ui)) {
    let line = RichText::new(words).color(colors(ui).weak);
    match can_fold {
        true => closed(ui, (line, words, hint), body),
        false => {
            ui.label(line).on_hover_text(hint);
            body(ui);
        }
    }
}

fn closed(ui: &mut Ui, (line, name, hint): (RichText, &str, &str), body: impl FnOnce(&mut Ui)) {
    let fold = CollapsingState::load_with_default_open(ui.ctx(), Id::unique(("part of a panel", name)), false);
    let mut is_clicked = false;
    let mut header = fold.show_header(ui, |ui| {
        let line = ui.add(Label::new(line).selectable(false).sense(Sense::click()));
        is_clicked = line.on_hover_text(hint).clicked();
    });
    if is_clicked {
        header.toggle();
    }
    header.body_unindented(body);
}

fn folded(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui)) {
    let fold = CollapsingState::load_with_default_open(ui.ctx(), Id::unique(("panel of a tool", title)), true);
    let mut is_clicked = false;
    let mut header = fold.show_header(ui, |ui| is_clicked = heading(ui, title));
    if is_clicked {
        header.toggle();
    }
    header.body_unindented(body);
}

/// Returns whether it is clicked.
fn heading(ui: &mut Ui, title: &str) -> bool {
    let words = Label::new(RichText::new(title).color(colors(ui).text).strong());
    ui.add(words.selectable(false).sense(Sense::click())).clicked()
}
