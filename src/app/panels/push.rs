//! What the tool for forces makes, beside the tools.

use egui::{Area, Id, Rect, RichText};

use super::theme::{TEXT, WEAK, floating};
use super::{Facts, Wish};
use crate::app::tools::PushWay;

/// Width of the panel `[points]`.
const WIDTH: f32 = 210.0;

/// Shows it at the right of the tools.
pub(super) fn show(context: &egui::Context, tools: Rect, facts: &Facts, wishes: &mut Vec<Wish>) {
    let corner = tools.right_top() + egui::vec2(8.0, 0.0);
    let mut way = facts.push;
    Area::new(Id::unique("push")).fixed_pos(corner).show(context, |ui| {
        floating().show(ui, |ui| {
            ui.set_width(WIDTH);
            ui.label(RichText::new("Force that stays").color(TEXT).strong());
            ui.label(RichText::new("drag an arrow from a body; a click on one takes it away").color(WEAK));
            for other in PushWay::ALL {
                let words = match other {
                    PushWay::Point => "on a point",
                    PushWay::Body => "on the body (Shift)",
                    PushWay::Turn => "torque on the body (Alt)",
                };
                ui.radio_value(&mut way, other, words);
            }
        });
    });
    if way != facts.push {
        wishes.push(Wish::Push(way));
    }
}
