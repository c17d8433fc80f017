//! How stiff springs are: by the stiffness of each, or by Young's modulus of a sheet of them.

use egui::{Id, Ui};

use super::rows::number_beside;
use super::sink::Sink;
use crate::app::matter::{MatterChange, Span};
use crate::scene::{stiffness_of_young, young_of_stiffness};

/// What the number is called by either, and its unit.
const NAMES: [&str; 2] = ["stiffness", "modulus E"];
pub(in crate::app::panels) const UNIT: &str = " N/m";
/// Said of the switch between them.
const SAID: &str = "by Young's modulus times the thickness: a net of even triangles of springs k has E = 1.15 k, as `young` of scene files";

fn id() -> Id {
    Id::unique("stiffness is said by Young's modulus")
}

/// Whether it is Young's modulus.
fn is_young(ui: &Ui) -> bool {
    ui.data(|data| data.get_temp(id())).unwrap_or(false)
}

/// What the number is called now.
pub(in crate::app::panels) fn name(ui: &Ui) -> &'static str {
    NAMES[usize::from(is_young(ui))]
}

/// The number that is shown of a stiffness `[N/m]`.
pub(in crate::app::panels) fn shown(ui: &Ui, stiffness: f64) -> f64 {
    if is_young(ui) { young_of_stiffness(stiffness) } else { stiffness }
}

/// The stiffness that a number means `[N/m]`.
pub(in crate::app::panels) fn meant(ui: &Ui, number: f64) -> f64 {
    if is_young(ui) { stiffness_of_young(number) } else { number }
}

/// Switches between both: all panels follow.
pub(in crate::app::panels) fn switch(ui: &mut Ui) {
    let is_on = is_young(ui);
    if ui.selectable_label(is_on, "E").on_hover_text(SAID).clicked() {
        ui.data_mut(|data| data.insert_temp(id(), !is_on));
    }
}

/// The row of springs of what covers an area.
pub(super) fn row(ui: &mut Ui, stiffness: Span, sink: &mut Sink<'_>) {
    let span = Span { least: shown(ui, stiffness.least), most: shown(ui, stiffness.most) };
    let is_young = is_young(ui);
    let of = |x: f64| if is_young { stiffness_of_young(x) } else { x };
    let name = name(ui);
    number_beside(ui, (name, UNIT), Some(span), sink, |x| Some(MatterChange::Stiffness(of(x))), switch);
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::Role;
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::app::panels::Wish;

    #[test]
    fn the_switch_shows_youngs_modulus_and_what_is_written_there_is_the_stiffness_of_its_net() {
        let show = |ui: &mut Ui, wishes: &mut Vec<Wish>| {
            let mut sink = Sink { gesture: &mut None, wishes, previews_stops: &mut false };
            row(ui, Span { least: 750.0, most: 750.0 }, &mut sink);
        };
        let mut harness = Harness::builder().build_ui_state(show, Vec::new());
        harness.run_steps(3);
        let value = |harness: &Harness<'_, Vec<Wish>>, name: &str| {
            harness.get_by_role_and_label(Role::SpinButton, name).value().unwrap()
        };
        assert_eq!(value(&harness, "stiffness"), "750 N/m");
        harness.get_by_label("E").click();
        harness.run_steps(3);
        // 750 / 0.866
        assert_eq!(value(&harness, "modulus E"), "866 N/m");
        assert!(harness.state().is_empty(), "to be shown otherwise changes nothing");
        harness.get_by_role_and_label(Role::SpinButton, "modulus E").click();
        harness.run_steps(2);
        harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
        harness.event(egui::Event::Text("2000".to_owned()));
        harness.run_steps(2);
        harness.key_press(egui::Key::Enter);
        harness.run_steps(3);
        let set = harness.state().iter().find_map(|wish| match wish {
            Wish::Matter(MatterChange::Stiffness(stiffness), _) => Some(*stiffness),
            _ => None,
        });
        assert!((set.unwrap() - 2000.0 * 0.75_f64.sqrt()).abs() < 1e-6, "{set:?}");
    }
}
