//! What the brush paints with, beside the tools: a matter by name, or those numbers that are switched on.

use egui::{Area, DragValue, Id, Rect, RichText, Slider, Ui};

use super::folded::{part, titled};
use super::material::{WIDTH, gives_way, modulus, presets, sagging, short};
use super::theme::{as_high_as_buttons, colors, floating};
use super::{Facts, Wish, low, ranged, ticks};
use crate::app::matter::{Painted, Switched};
use crate::app::tools::{Brush, RADII};

/// How fast a number changes as it is dragged, as a share of it for each point, and the number that a drag from 0 goes by.
const SPEED: f64 = 0.01;
const LEAST: f64 = 0.1;
/// Width of the check boxes with their names `[points]`.
const NAMES: f32 = 98.0;

/// Shows it at the right of the tools, in a room that ends below; it may be folded.
pub(super) fn show(
    context: &egui::Context,
    (tools, room, can_fold): (Rect, Rect, bool),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) {
    let corner = tools.right_top() + egui::vec2(8.0, 0.0);
    let mut brush = facts.brush;
    Area::new(Id::unique("brush")).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            low::within(ui, room, |ui| {
                ui.set_width(WIDTH);
                ui.spacing_mut().slider_width = 120.0;
                titled(ui, ("Material brush", can_fold), |ui| all(ui, &mut brush, (facts, can_fold), wishes));
            })
        });
    });
    if brush != facts.brush {
        wishes.push(Wish::Brush(brush));
    }
}

fn all(ui: &mut Ui, brush: &mut Brush, (facts, can_fold): (&Facts, bool), wishes: &mut Vec<Wish>) {
    let is_named = !brush.numbers.is_any();
    ui.label(RichText::new("drag over bodies: they become").color(colors(ui).weak));
    if let (_, Some(preset)) = presets(ui, Some(brush.preset).filter(|_| is_named)) {
        (brush.preset, brush.numbers) = (preset, brush.numbers.all_off());
    }
    let words = if is_named { brush.preset.words() } else { "the numbers that are on below" };
    ui.label(RichText::new(words).color(colors(ui).weak));
    ui.separator();
    let words = "Alt and a click takes the numbers of what is under the brush";
    // What is on is seen.
    part(ui, ("or get single numbers", words, can_fold && is_named), |ui| numbers(ui, &mut brush.numbers));
    ui.separator();
    let [least, most] = RADII;
    let radius = Slider::new(&mut brush.radius, least..=most).max_decimals(0).suffix(" px").text("radius");
    ranged::slider(ui, radius, least..=most, " px");
    // Below all else: nothing moves away under the pointer. What was painted is there, what could be is not yet.
    if let Some(overload) = &facts.overload {
        if gives_way(ui, overload) {
            wishes.push(Wish::Bear);
        }
        return;
    }
    let Painted { density, stiffness, .. } = &mut brush.numbers;
    let given = |of: &Switched<f64>| of.is_on.then_some(of.value);
    let is_weight_painted = density.is_on || stiffness.is_on;
    let sags = facts.bearings.told(given(density), given(stiffness)).filter(|_| is_weight_painted);
    if let Some(sags) = sags.filter(|sags| sagging(ui, *sags).is_some()) {
        *stiffness = Switched { is_on: true, value: sags.1 };
    }
}

/// The numbers that it can paint.
fn numbers(ui: &mut Ui, of: &mut Painted) {
    let Painted { density, stiffness, damping, breaks, bending, friction, restitution, color, width, visible } = of;
    number(ui, ("mass", " kg/m²"), density, 1e-3..=1e6);
    of_stiffness(ui, stiffness);
    number(ui, ("damping", " N s/m"), damping, 0.0..=1e9);
    let mut percent = Switched { is_on: breaks.is_on, value: 100.0 * breaks.value };
    number(ui, ("tears at", " %"), &mut percent, 0.1..=1000.0);
    if percent.value != 100.0 * breaks.value {
        breaks.value = 0.01 * percent.value;
    }
    breaks.is_on = percent.is_on;
    number(ui, ("bending", " N m²"), bending, 0.0..=1e9);
    number(ui, ("friction", ""), friction, 0.0..=10.0);
    number(ui, ("restitution", ""), restitution, 0.0..=1.0);
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        let label = switch(ui, "colour", &mut color.is_on);
        let words = "bodies are filled in it; a picture is tinted by it";
        if let Some((_, chosen)) = super::color::button(ui, color.value, label, words) {
            *color = Switched { is_on: true, value: chosen };
        }
    });
    number(ui, ("width", " m"), width, 0.0..=1e3);
    shown(ui, visible);
}

/// How stiff springs are, by the stiffness of each or by Young's modulus.
fn of_stiffness(ui: &mut Ui, of: &mut Switched<f64>) {
    let before = modulus::shown(ui, of.value);
    let mut shown = Switched { is_on: of.is_on, value: before };
    ui.horizontal(|ui| {
        let name = modulus::name(ui);
        number(ui, (name, modulus::UNIT), &mut shown, 0.0..=1e9);
        if shown.value != before {
            of.value = modulus::meant(ui, shown.value);
        }
        of.is_on = shown.is_on;
        modulus::switch(ui);
    });
}

/// Whether it is drawn from then on, which a click on either switches on.
fn shown(ui: &mut Ui, visible: &mut Switched<bool>) {
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        switch(ui, "drawn", &mut visible.is_on);
        (ui.spacing_mut().item_spacing.x, ui.spacing_mut().button_padding.x) = (4.0, 5.0);
        let words = "what is hidden moves as before; the tool that selects shows its outline";
        for (value, name) in [(true, "visible"), (false, "hidden")] {
            let is_chosen = visible.is_on && visible.value == value;
            if ui.selectable_label(is_chosen, name).on_hover_text(words).clicked() {
                *visible = Switched { is_on: true, value };
            }
        }
    });
}

/// A number that is switched on by its check box, or by being changed.
fn number(ui: &mut Ui, (name, unit): (&str, &str), of: &mut Switched<f64>, range: std::ops::RangeInclusive<f64>) {
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        let label = switch(ui, name, &mut of.is_on);
        let speed = SPEED * of.value.max(LEAST);
        let field = DragValue::new(&mut of.value).speed(speed);
        let field = field.custom_formatter(|x, _| short(x)).suffix(unit).update_while_editing(false);
        of.is_on |= ranged::field(ui, field, range, unit).labelled_by(label).changed();
    });
}

/// A check box with its name: all are as wide, so that fields stand below each other.
fn switch(ui: &mut Ui, name: &str, is_on: &mut bool) -> Id {
    let size = egui::vec2(NAMES, ui.spacing().interact_size.y);
    let layout = egui::Layout::left_to_right(egui::Align::Center);
    let switch = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ticks::check(ui, is_on, name).id
    });
    switch.inner
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::{Event, Pos2, Shape, vec2};

    use super::super::pointer::click;
    use super::*;
    use crate::app::matter::{Bearings, Preset};

    struct Screen {
        context: egui::Context,
        facts: Facts,
    }

    impl Screen {
        /// A frame with events; what the brush is asked to be, it is. Returns what is written where.
        fn frame(&mut self, events: Vec<Event>) -> Vec<(String, Pos2)> {
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
            let mut wishes = Vec::new();
            let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
            let tools = Rect::from_min_size(Pos2::new(10.0, 80.0), vec2(50.0, 400.0));
            let places = (tools, Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)), false);
            let mut output = self.context.run_ui(input, |ui| show(ui.ctx(), places, &self.facts, &mut wishes));
            output.textures_delta.clear();
            if let Some(Wish::Brush(brush)) = wishes.pop() {
                self.facts.brush = brush;
            }
            let text = |shape: &Shape| match shape {
                Shape::Text(text) => Some((text.galley.text().to_owned(), text.pos + 0.5 * text.galley.size())),
                _ => None,
            };
            output.shapes.iter().filter_map(|clipped| text(&clipped.shape)).collect()
        }

        fn click(&mut self, text: &str) {
            let at = self.frame(Vec::new()).into_iter().find(|(other, _)| other == text).unwrap().1;
            click(at).into_iter().for_each(|events| _ = self.frame(events));
            self.frame(Vec::new());
        }
    }

    #[test]
    fn numbers_are_switched_on_one_by_one_and_a_matter_by_name_switches_them_off() {
        let mut screen = Screen { context: egui::Context::default(), facts: Facts::default() };
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
        assert_eq!(screen.facts.brush.name(), "Rubber");
        screen.click("stiffness");
        screen.click("friction");
        assert_eq!(screen.facts.brush.name(), "stiffness, friction");
        let numbers = screen.facts.brush.numbers;
        assert!(numbers.stiffness.is_on && numbers.friction.is_on && !numbers.density.is_on && !numbers.color.is_on);
        screen.click("stiffness");
        assert_eq!(screen.facts.brush.name(), "friction");
        for (click, name) in [
            ("bending", "friction, bending"),
            ("width", "friction, bending, width"),
            ("hidden", "friction, bending, width, hide"),
        ] {
            screen.click(click);
            let found: Vec<String> = screen.facts.brush.name().split(", ").map(str::to_owned).collect();
            assert!(name.split(", ").all(|name| found.iter().any(|found| found == name)), "{name}: {found:?}");
        }
        assert!(!screen.facts.brush.numbers.visible.value);
        screen.click("visible");
        assert!(screen.facts.brush.numbers.visible.is_on && screen.facts.brush.numbers.visible.value);
        screen.click("Steel");
        assert_eq!((screen.facts.brush.name().as_str(), screen.facts.brush.preset), ("Steel", Preset::Steel));
        assert!(!screen.facts.brush.numbers.is_any());
    }

    #[test]
    fn a_mass_that_bodies_do_not_bear_is_told_before_and_one_click_makes_them_bear_it() {
        let scene = crate::scene::Scene::parse(
            r#"{"wobble": 1, "gravity": [0, -9.81], "bodies": [{"make": "lattice", "columns": 6, "rows": 6, "spacing": 0.2,
                "material": {"kind": "spring", "stiffness": 600, "damping": 2, "mass": 2}}]}"#,
            "x.json",
        );
        let mut stage = crate::app::player::Stage::new(scene.unwrap().into()).unwrap();
        let mut shown = crate::app::player::Shown::default();
        stage.show(&mut shown);
        let facts = Facts { bearings: Bearings::of(&shown).into(), ..Facts::default() };
        let mut screen = Screen { context: egui::Context::default(), facts };
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
        let told = |screen: &mut Screen| {
            let texts = screen.frame(Vec::new());
            texts.into_iter().map(|(text, _)| text).find(|text| text.contains("bear it"))
        };
        screen.click("mass");
        assert_eq!(told(&mut screen), None, "1 kg/m^2 is borne");
        screen.facts.brush.numbers.density.value = 100.0;
        let offer = told(&mut screen).unwrap();
        screen.click(&offer);
        let numbers = screen.facts.brush.numbers;
        assert!(numbers.stiffness.is_on && numbers.stiffness.value > 600.0, "{numbers:?}");
        assert_eq!(told(&mut screen), None, "it is painted along with the mass");
    }
}
