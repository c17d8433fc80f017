//! What the tools for muscles and motors make, beside the tools.

use egui::{Area, ComboBox, Id, Label, Rect, Response, RichText, Slider, SliderClamping, Ui};

use super::choosing::choice;
use super::folded::titled;
use super::motors::FASTEST;
use super::theme::{colors, floating};
use super::wave::{self, slider};
use super::{Facts, Wish, low, ranged, ticks};
use crate::app::action::Tool;
use crate::app::tools::Drives;
use crate::scene::KeyName;
use crate::sim::drive::RATES;

/// Width of the panel `[points]`.
const WIDTH: f32 = 230.0;
/// Between its rows `[points]`.
const GAP: f32 = 4.0;
/// Most of what the sliders reach: share of a length, speed `[rad/s]`, torque `[N m]`.
const MOST: [f64; 3] = [0.6, 20.0, 10_000.0];
/// The torque that is begun with where one is said `[N m]`.
const TORQUE: f64 = 30.0;
/// Lengths of a wave that they reach, in lengths of the stroke.
const LENGTHS: [f64; 2] = [0.2, 3.0];

/// Said of the hinge under the pointer, and where no hinge is to get a motor.
const HAS_ONE: &str = "the hinge under the pointer has one: a click gives it what is set here, or takes it off";
const HAS_ONE_OFF: &str = "the hinge under the pointer has one, and loses it by a click: this was left unticked";
const HAS_NONE: &str = "the hinge under the pointer has none: a click gives it one, as strong as is set here";
const HAS_NONE_OFF: &str = "the hinge under the pointer has none, and a click gives it none: this was left unticked";

/// Shows it at the right of the tools; it may be folded.
pub(super) fn show(
    context: &egui::Context,
    (tools, room, can_fold): (Rect, Rect, bool),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) {
    let corner = tools.right_top() + egui::vec2(8.0, 0.0);
    let mut drives = facts.drives;
    Area::new(Id::unique("drives")).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            low::within(ui, room, |ui| {
                ui.set_width(WIDTH);
                // Low enough for what lies below it in the smallest window.
                ui.spacing_mut().item_spacing.y = GAP;
                ui.spacing_mut().slider_width = 100.0;
                match facts.tool {
                    Tool::Muscle => titled(ui, ("Muscle", can_fold), |ui| of_muscle(ui, &mut drives)),
                    _ => titled(ui, ("Hinge and motor", can_fold), |ui| of_motor(ui, &mut drives, facts.hinge)),
                }
            })
        });
    });
    if drives != facts.drives {
        wishes.push(Wish::Drives(drives));
    }
}

/// How muscles make something go.
const TO_WALK: &str = "To let a body crawl, drag along its underside with \"along the stroke\" ticked: it goes the way of the drag. To let it \
                       walk, make muscles of its legs, one after another in phase: the Snake and the Walker of the gallery are made so";

fn of_muscle(ui: &mut Ui, drives: &mut Drives) {
    let muscle = &mut drives.muscle;
    ui.label(RichText::new("click a bond, or drag over some").color(colors(ui).weak)).on_hover_text(TO_WALK);
    slider(ui, "stretch", &mut muscle.amplitude, -MOST[0]..=MOST[0], "");
    let follows = muscle.has_wave || muscle.key.is_none();
    ui.horizontal(|ui| {
        ticks::check(ui, &mut muscle.has_wave, "wave");
        if follows {
            ticks::check(ui, &mut muscle.runs, "along the stroke").on_hover_text(
                "a worm whose underside is stroked crawls the way of the stroke; without, all muscles of a stroke move as one",
            );
        }
    });
    if follows {
        wave::slide_period(ui, &mut muscle.period);
        if muscle.runs {
            let said = "in lengths of the stroke";
            slider(ui, "wave length", &mut muscle.length, LENGTHS[0]..=LENGTHS[1], "").on_hover_text(said);
        }
        let said = if muscle.runs { "at the beginning of the stroke" } else { "of all muscles of a stroke" };
        wave::slide_phase(ui, &mut muscle.phase).on_hover_text(said);
    }
    keys(ui, &mut muscle.key, &mut muscle.back);
    rate(ui, muscle.key, &mut muscle.rate);
}

/// What a hinge gets, or what the one under the pointer has: nobody who points at one ticks anything.
fn of_motor(ui: &mut Ui, drives: &mut Drives, hinge: Option<bool>) {
    let motor = &mut drives.motor;
    let said = "a click hinges the body under it: to the other one where two overlap, else to the background. A hinge that is there gets what is set here";
    ui.add(Label::new(RichText::new(said).color(colors(ui).weak)).wrap());
    let mut is_on = hinge.or(motor.is_on).unwrap_or(false);
    if ticks::check(ui, &mut is_on, "motor").changed() {
        motor.is_on = Some(is_on);
    }
    // As many lines whatever is ticked: nothing moves under the pointer.
    let said = match motor.is_on {
        Some(false) if hinge == Some(true) => HAS_ONE_OFF,
        _ if hinge == Some(true) => HAS_ONE,
        Some(false) if hinge == Some(false) => HAS_NONE_OFF,
        _ if hinge == Some(false) => HAS_NONE,
        None => "left as it is: a body hinged to the background gets a motor, two bodies get a hinge alone",
        Some(true) => "whatever is hinged next gets one, and so does a hinge that is there, by a click on it",
        Some(false) => "nothing that is hinged next gets one, and a hinge that is there loses it by a click on it",
    };
    ui.add(Label::new(RichText::new(said).color(colors(ui).weak)).wrap());
    if motor.is_on != Some(false) {
        let said = "below 0 clockwise, as a wheel rolls to the right";
        // What is typed goes further than the knob.
        let knob = Slider::new(&mut motor.speed, -MOST[1]..=MOST[1]).clamping(SliderClamping::Never).max_decimals(2);
        let knob = knob.suffix(" rad/s").text("speed");
        ranged::slider(ui, knob, -FASTEST..=FASTEST, " rad/s").on_hover_text(said);
        motor.speed = motor.speed.clamp(-FASTEST, FASTEST);
        torque(ui, &mut motor.torque);
        let said = "its speed goes to and fro";
        ticks::check(ui, &mut motor.has_wave, "wave").on_hover_text(said);
        if motor.has_wave {
            wave::slide_period(ui, &mut motor.period);
            wave::slide_phase(ui, &mut motor.phase);
        }
        keys(ui, &mut motor.key, &mut motor.back);
        rate(ui, motor.key, &mut motor.rate);
    }
}

/// How strong it is: as is said, or as what it is on needs.
fn torque(ui: &mut Ui, torque: &mut Option<f64>) {
    let mut fits = torque.is_none();
    let said = "from the weight and the inertia of what is clicked: what it comes to is said beside the pointer";
    if ticks::check(ui, &mut fits, "as strong as the body needs").on_hover_text(said).changed() {
        *torque = if fits { None } else { Some(TORQUE) };
    }
    if let Some(torque) = torque {
        let range = 1.0..=MOST[2];
        let slider = Slider::new(torque, range.clone()).logarithmic(true).max_decimals(2).suffix(" N m").text("torque");
        ranged::slider(ui, slider, range, " N m");
    }
}

/// The keys that have to be held. Returns by what they are chosen.
pub(super) fn keys(ui: &mut Ui, key: &mut Option<KeyName>, back: &mut Option<KeyName>) -> Response {
    let forth = of_keys(ui, "key", "always on", key);
    if key.is_some() { forth | of_keys(ui, "key back", "none", back) } else { forth }
}

/// How quickly what a key holds comes and goes, where there is one.
fn rate(ui: &mut Ui, key: Option<KeyName>, rate: &mut f64) {
    if key.is_none() {
        return;
    }
    let [slowest, quickest] = RATES;
    let slider = Slider::new(rate, slowest..=quickest).logarithmic(true).max_decimals(2).suffix(" /s").text("rate");
    let said = "how quickly it comes and goes with its key: 5 /s takes a fifth of a second";
    ranged::slider(ui, slider, slowest..=quickest, " /s").on_hover_text(said);
}

fn of_keys(ui: &mut Ui, name: &str, none: &str, key: &mut Option<KeyName>) -> Response {
    let text = key.map_or(none, |key| key.name());
    let shown = ComboBox::new(("key of a drive", name), name).selected_text(text).height(260.0).show_ui(ui, |ui| {
        if choice(ui, key.is_none(), none).clicked() {
            *key = None;
        }
        for other in KeyName::NAMES {
            let value = other.parse().ok();
            if choice(ui, *key == value, *other).clicked() {
                *key = value;
            }
        }
    });
    shown.response
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::{Event, Pos2, Shape, vec2};

    use super::super::pointer::click;
    use super::*;

    /// A frame with events; what the tools are asked to make, they make. Returns what is written where.
    fn frame(context: &egui::Context, facts: &mut Facts, events: Vec<Event>) -> Vec<(String, Pos2)> {
        let room = Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0));
        let tools = Rect::from_min_size(Pos2::new(10.0, 80.0), vec2(50.0, 400.0));
        let mut wishes = Vec::new();
        let input = egui::RawInput { events, screen_rect: Some(room), ..egui::RawInput::default() };
        let mut output = context.run_ui(input, |ui| show(ui.ctx(), (tools, room, false), facts, &mut wishes));
        output.textures_delta.clear();
        if let Some(Wish::Drives(drives)) = wishes.pop() {
            facts.drives = drives;
        }
        let text = |shape: &Shape| match shape {
            Shape::Text(text) => Some((text.galley.text().to_owned(), text.pos + 0.5 * text.galley.size())),
            _ => None,
        };
        output.shapes.iter().filter_map(|clipped| text(&clipped.shape)).collect()
    }

    fn has(texts: &[(String, Pos2)], words: &str) -> bool {
        texts.iter().any(|(text, _)| text == words)
    }

    #[test]
    fn over_a_hinge_the_switch_shows_whether_that_has_a_motor_and_no_row_moves() {
        let (context, mut facts) = (egui::Context::default(), Facts { tool: Tool::Motor, ..Facts::default() });
        let mut speed_at = |is_on: Option<bool>, hinge: Option<bool>, words: &str| {
            (facts.hinge, facts.drives.motor.is_on) = (hinge, is_on);
            (0..3).for_each(|_| _ = frame(&context, &mut facts, Vec::new()));
            let texts = frame(&context, &mut facts, Vec::new());
            assert!(has(&texts, words), "{is_on:?}, {hinge:?}: {texts:?}");
            assert_eq!(facts.drives.motor.is_on, is_on, "to point at one ticks nothing");
            texts.iter().find(|(text, _)| text == "speed").map(|(_, at)| at.y)
        };
        let alone = "left as it is: a body hinged to the background gets a motor, two bodies get a hinge alone";
        let first = speed_at(None, None, alone);
        assert!(first.is_some());
        for is_on in [None, Some(true)] {
            assert_eq!(speed_at(is_on, Some(true), HAS_ONE), first);
            assert_eq!(speed_at(is_on, Some(false), HAS_NONE), first);
        }
        assert_eq!(speed_at(Some(false), Some(true), HAS_ONE_OFF), None);
        assert_eq!(speed_at(Some(false), Some(false), HAS_NONE_OFF), None);
    }

    #[test]
    fn a_motor_is_as_fast_as_is_typed_up_to_ten_times_what_its_slider_reaches() {
        let (context, mut facts) = (egui::Context::default(), Facts { tool: Tool::Motor, ..Facts::default() });
        for (typed, is) in [(15.0, 15.0), (150.0, 150.0), (-200.0, -200.0), (500.0, 200.0)] {
            facts.drives.motor.speed = typed;
            (0..3).for_each(|_| _ = frame(&context, &mut facts, Vec::new()));
            assert_eq!(facts.drives.motor.speed, is, "{typed} rad/s");
        }
    }

    #[test]
    fn a_motor_can_follow_a_wave_and_what_a_key_holds_has_a_rate() {
        let (context, mut facts) = (egui::Context::default(), Facts { tool: Tool::Motor, ..Facts::default() });
        (0..3).for_each(|_| _ = frame(&context, &mut facts, Vec::new()));
        let texts = frame(&context, &mut facts, Vec::new());
        assert!(!has(&texts, "period") && !has(&texts, "rate"), "{texts:?}");
        let at = texts.iter().find(|(text, _)| text == "wave").unwrap().1;
        click(at).into_iter().for_each(|events| _ = frame(&context, &mut facts, events));
        assert!(facts.drives.motor.has_wave);
        let texts = frame(&context, &mut facts, Vec::new());
        assert!(has(&texts, "period") && has(&texts, "phase") && !has(&texts, "rate"), "{texts:?}");
        facts.drives.motor.key = Some(KeyName::A);
        facts.drives.muscle.key = Some(KeyName::A);
        for tool in [Tool::Motor, Tool::Muscle] {
            facts.tool = tool;
            (0..2).for_each(|_| _ = frame(&context, &mut facts, Vec::new()));
            assert!(has(&frame(&context, &mut facts, Vec::new()), "rate"), "{tool:?}");
        }
    }
}
