//! The panels: a transport bar below and figures in a corner. They return actions and change nothing.

use super::input::Action;

/// What the panels show.
#[derive(Clone, Debug, Default)]
pub(super) struct Figures {
    pub(super) scene: String,
    pub(super) playing: bool,
    pub(super) asleep: bool,
    /// Time of the scene [s].
    pub(super) time: f64,
    /// Time from frame to frame [s].
    pub(super) frame: f64,
    /// Time that stepping took of a frame [s].
    pub(super) step: f64,
    /// Share of its rate that the scene reaches [1].
    pub(super) pace: f64,
    pub(super) points: usize,
    pub(super) bonds: usize,
    /// Strokes and dots that the last picture drew for them.
    pub(super) drawn: u64,
    /// [J]
    pub(super) energy: f64,
    /// Bodies have skins: their bonds can be shown or not.
    pub(super) has_skin: bool,
    /// The scene is that of a picture, which can be cut out anew.
    pub(super) has_picture: bool,
}

/// Shows the panels; returns what was clicked, and the height that they leave to the world [points].
pub(super) fn show(ui: &mut egui::Ui, figures: &Figures) -> (Vec<Action>, f32) {
    let mut actions = Vec::new();
    egui::Panel::bottom("transport").resizable(false).show(ui, |ui| {
        ui.add_space(3.0);
        ui.horizontal(|ui| transport(ui, figures, &mut actions));
        ui.add_space(3.0);
    });
    egui::Area::new(egui::Id::unique("figures")).fixed_pos([12.0, 12.0]).interactable(false).show(ui.ctx(), |ui| {
        egui::Frame::popup(ui.style()).multiply_with_opacity(0.85).show(ui, |ui| hud(ui, figures));
    });
    (actions, ui.available_rect_before_wrap().height())
}

/// Shows what went wrong. Returns whether it has been read.
pub(super) fn complain(context: &egui::Context, complaint: &str) -> bool {
    let mut is_read = false;
    let place = egui::Area::new(egui::Id::unique("complaint")).anchor(egui::Align2::CENTER_TOP, [0.0, 12.0]);
    place.show(context, |ui| {
        egui::Frame::popup(ui.style()).fill(egui::Color32::from_rgb(74, 28, 28)).show(ui, |ui| {
            ui.set_max_width(640.0);
            ui.horizontal(|ui| {
                is_read = ui.button("Close").clicked();
                ui.add(egui::Label::new(complaint).wrap());
            });
        });
    });
    is_read
}

fn transport(ui: &mut egui::Ui, figures: &Figures, actions: &mut Vec<Action>) {
    let play = if figures.playing { "Pause" } else { "Play" };
    let buttons = [
        (play, "Space", Action::TogglePlay),
        ("Step", ".", Action::Step),
        ("Reset", "R", Action::Reset),
        ("Fit", "F", Action::Fit),
        ("Draw", "N", Action::Paint),
        ("Open", "Ctrl+O", Action::Open),
    ];
    let of_pictures = [
        (figures.has_skin, ("Mesh", "B", Action::ToggleMesh)),
        (figures.has_picture, ("Picture", "I", Action::Import)),
    ];
    let wanted = of_pictures.into_iter().filter(|(is_there, _)| *is_there).map(|(_, button)| button);
    for (label, key, action) in buttons.into_iter().chain(wanted) {
        let button = egui::Button::new(label).min_size(egui::vec2(76.0, 26.0));
        if ui.add(button).on_hover_text(format!("{label} ({key})")).clicked() {
            actions.push(action);
        }
    }
    ui.separator();
    ui.monospace(format!("t = {:8.2} s", figures.time));
    let state = match (figures.playing, figures.asleep) {
        (false, _) => "paused".to_owned(),
        (true, true) => "asleep".to_owned(),
        (true, false) if figures.pace < 0.95 => format!("at {:.0} % of its pace", 100.0 * figures.pace),
        (true, false) => String::new(),
    };
    ui.weak(state);
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.weak(&figures.scene));
}

fn hud(ui: &mut egui::Ui, figures: &Figures) {
    egui::Grid::new("figures").num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
        let mut row = |name: &str, value: String| {
            ui.weak(name);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.monospace(value));
            ui.end_row();
        };
        row("frame", format!("{:7.2} ms", 1e3 * figures.frame));
        row("step", format!("{:7.3} ms", 1e3 * figures.step));
        row("points", figures.points.to_string());
        row("bonds", figures.bonds.to_string());
        if figures.drawn != figures.bonds as u64 {
            row("drawn", figures.drawn.to_string());
        }
        row("energy", energy(figures.energy));
    });
}

/// An energy [J] in at most eleven characters: what is large has no millijoules.
fn energy(value: f64) -> String {
    match value.abs() {
        size if size < 1e4 => format!("{value:9.3} J"),
        size if size < 1e7 => format!("{value:9.0} J"),
        _ => format!("{value:9.2e} J"),
    }
}

#[cfg(test)]
mod tests {
    use super::energy;

    #[test]
    fn energies_of_any_size_are_short() {
        for (value, text) in [(1.25, "    1.250 J"), (-489_525.175, "  -489525 J"), (-4.8e12, " -4.80e12 J")] {
            assert_eq!(energy(value), text);
        }
    }
}
