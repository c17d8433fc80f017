//! What the tool for forces makes, beside the tools.

use egui::{Area, Id, Rect, RichText, Slider, SliderClamping};

use super::folded::titled;
use super::settings::Setting;
use super::theme::{colors, floating};
use super::{Facts, Wish, low, ranged, ticks};
use crate::app::tools::PushWay;
use crate::history::{Do, SetKeys, Weather};
use crate::scene::{Vector, WindKeys};

/// Width of the panel `[points]`.
const WIDTH: f32 = 210.0;

/// What is done for wind.
const WIND: &str = "drag an arrow through the air: its length is the speed; a click on its end takes it away";

/// How gusty the wind is that blows.
fn turbulence(ui: &mut egui::Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    let Some(wind) = facts.settings.scene.wind.flatten().filter(|wind| wind.velocity != [0.0; 3]) else {
        ui.label(RichText::new("the air is still").color(colors(ui).weak));
        return;
    };
    let mut gusts = wind.turbulence;
    let slider = Slider::new(&mut gusts, 0.0..=1.0).clamping(SliderClamping::Edits).max_decimals(2).text("turbulence");
    ui.spacing_mut().slider_width = 96.0;
    let by = ranged::slider(ui, slider, 0.0..=1.0, "");
    if by.changed() {
        let keys = WindKeys {
            velocity: Vector::new(wind.velocity, facts.dimensions),
            turbulence: (gusts > 0.0).then_some(gusts),
            seed: Some(wind.seed),
        };
        let act = Do::Set(Box::new(SetKeys { wind: Some(Weather::This(keys)), ..SetKeys::default() }));
        let goes_on = by.dragged() && !by.drag_started();
        wishes.push(Wish::Set(Setting { act, name: "wind", goes_on }));
    }
}

/// What an arrow is.
fn choices(ui: &mut egui::Ui, way: &mut PushWay, facts: &Facts) {
    let is_plane = facts.dimensions == 2;
    for other in PushWay::ALL.into_iter().filter(|way| is_plane || *way != PushWay::Turn) {
        let words = match other {
            PushWay::Wind => "wind over all bodies (W)",
            PushWay::Point => "on a point",
            PushWay::Body => "on the body (Shift)",
            PushWay::Turn => "torque on the body (Alt)",
            PushWay::Speed => "no force: its velocity",
        };
        ticks::one_of(ui, way, other, words);
    }
}

/// Shows it at the right of the tools; it may be folded.
pub(super) fn show(
    context: &egui::Context,
    (tools, room, can_fold): (Rect, Rect, bool),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) {
    let corner = tools.right_top() + egui::vec2(8.0, 0.0);
    let mut way = facts.push;
    Area::new(Id::unique("push")).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            low::within(ui, room, |ui| {
                ui.set_width(WIDTH);
                let (title, said) = match way {
                    PushWay::Wind => ("Wind", WIND),
                    PushWay::Speed => ("Velocity", "drag an arrow from a body: it flies off so fast; a click stops it"),
                    _ => ("Force that stays", "drag an arrow from a body; a click on one takes it away"),
                };
                titled(ui, (title, can_fold), |ui| {
                    ui.label(RichText::new(said).color(colors(ui).weak));
                    choices(ui, &mut way, facts);
                    if way == PushWay::Wind {
                        turbulence(ui, facts, wishes);
                    }
                });
            })
        });
    });
    if way != facts.push {
        wishes.push(Wish::Push(way));
    }
}
