//! What the tools for muscles and motors make, beside the tools.

use egui::{Area, ComboBox, Id, Label, Rect, RichText, Slider, Ui};

use super::choosing::choice;
use super::folded::titled;
use super::theme::{colors, floating};
use super::{Facts, Wish, low, ranged, ticks};
use crate::app::action::Tool;
use crate::app::tools::Drives;
use crate::scene::KeyName;

/// Width of the panel `[points]`.
const WIDTH: f32 = 230.0;
/// Between its rows `[points]`.
const GAP: f32 = 4.0;
/// Most of what the sliders reach: share of a length, period `[s]`, speed `[rad/s]`, torque `[N m]`.
const MOST: [f64; 4] = [0.6, 4.0, 20.0, 10_000.0];
/// The torque that is begun with where one is said `[N m]`.
const TORQUE: f64 = 30.0;
/// Lengths of a wave that they reach, in lengths of the stroke.
const LENGTHS: [f64; 2] = [0.2, 3.0];
/// The shortest period that they reach `[s]`.
const QUICKEST: f64 = 0.2;

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
                    _ => titled(ui, ("Hinge and motor", can_fold), |ui| of_motor(ui, &mut drives)),
                }
            })
        });
    });
    if drives != facts.drives {
        wishes.push(Wish::Drives(drives));
    }
}

fn of_muscle(ui: &mut Ui, drives: &mut Drives) {
    let muscle = &mut drives.muscle;
    ui.label(RichText::new("click a bond, or drag over some").color(colors(ui).weak));
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
        slider(ui, "period", &mut muscle.period, QUICKEST..=MOST[1], " s");
        if muscle.runs {
            let said = "in lengths of the stroke";
            slider(ui, "wave length", &mut muscle.length, LENGTHS[0]..=LENGTHS[1], "").on_hover_text(said);
        }
        let said = if muscle.runs { "at the beginning of the stroke" } else { "of all muscles of a stroke" };
        slider(ui, "phase", &mut muscle.phase, 0.0..=std::f64::consts::TAU, " rad").on_hover_text(said);
    }
    keys(ui, &mut muscle.key, &mut muscle.back);
}

fn of_motor(ui: &mut Ui, drives: &mut Drives) {
    let motor = &mut drives.motor;
    let said = "a click hinges the body under it: to the other one where two overlap, else to the background. A hinge that is there gets what is set here";
    ui.add(Label::new(RichText::new(said).color(colors(ui).weak)).wrap());
    let mut is_on = motor.is_on.unwrap_or(false);
    if ticks::check(ui, &mut is_on, "motor").changed() {
        motor.is_on = Some(is_on);
    }
    if motor.is_on.is_none() {
        let said = "if this is left alone, a wheel on the background gets one, and two bodies are only hinged";
        ui.add(Label::new(RichText::new(said).color(colors(ui).weak)).wrap());
    }
    if motor.is_on != Some(false) {
        let said = "below 0 clockwise, as a wheel rolls to the right";
        slider(ui, "speed", &mut motor.speed, -MOST[2]..=MOST[2], " rad/s").on_hover_text(said);
        torque(ui, &mut motor.torque);
        keys(ui, &mut motor.key, &mut motor.back);
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
        let range = 1.0..=MOST[3];
        let slider = Slider::new(torque, range.clone()).logarithmic(true).max_decimals(2).suffix(" N m").text("torque");
        ranged::slider(ui, slider, range, " N m");
    }
}

fn slider(
    ui: &mut Ui,
    name: &str,
    value: &mut f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
) -> egui::Response {
    let slider = Slider::new(value, range.clone()).max_decimals(2).suffix(unit).text(name);
    ranged::slider(ui, slider, range, unit)
}

/// The keys that have to be held.
pub(super) fn keys(ui: &mut Ui, key: &mut Option<KeyName>, back: &mut Option<KeyName>) {
    of_keys(ui, "key", "always on", key);
    if key.is_some() {
        of_keys(ui, "key back", "none", back);
    }
}

fn of_keys(ui: &mut Ui, name: &str, none: &str, key: &mut Option<KeyName>) {
    let text = key.map_or(none, |key| key.name());
    ComboBox::new(("key of a drive", name), name).selected_text(text).height(260.0).show_ui(ui, |ui| {
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
}
