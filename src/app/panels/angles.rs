//! Angles of a selection in its panel: where they are at rest, and the stops of joints.

use egui::{DragValue, RichText, Ui};

use super::material::{Sink, row};
use super::theme::colors;
use super::{ranged, ticks};
use crate::app::matter::{Matter, MatterChange, Span, Stops};

/// How fast an angle changes as it is dragged, for each point `[deg]`.
const SPEED: f64 = 0.5;
/// Angles at rest lie so far within a full turn, and stops so far apart `[deg]`.
const APART: f64 = 0.1;
const TURN: f64 = 360.0;
/// Of more joints stops are not ticked without being told of how many: a figure has fewer.
const FEW: usize = 12;
/// Said where there are more.
const ONE_CORNER: &str = "Ctrl+click a corner to give it stops alone";

/// Whether and where joints stop, and where angles are at rest.
pub(super) fn show(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    if matter.joints[1] > 0 {
        stops(ui, matter, sink);
    }
    if let Some(rest) = matter.rest_angle {
        let words = "where they are at rest: from the first arm to the second, anticlockwise";
        angle(ui, ("rest angle", words), (rest, [APART, TURN - APART]), sink, MatterChange::RestAngle);
    }
}

fn stops(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let [stopped, all] = matter.joints;
    if stopped == 0 && all > FEW {
        return all_stops(ui, all, sink);
    }
    row(ui, "joints", |ui, _| {
        let mut has_stops = stopped > 0;
        let by = ticks::check(ui, &mut has_stops, "stops");
        let by = by.on_hover_text("they turn so far and no further, as a knee");
        *sink.previews_stops = by.hovered() && stopped < all;
        if by.changed() {
            sink.set(&by, MatterChange::Stops(if has_stops { Stops::Some } else { Stops::None }));
        }
        if stopped > 0 && stopped < all {
            ui.label(RichText::new("some of them").color(colors(ui).weak));
        }
    });
    let Some([least, most]) = matter.stops else { return };
    let [lowest, highest] = [most.most.to_degrees() - TURN + APART, least.least.to_degrees() + TURN - APART];
    let words = ["the least angle of the joint", "the largest angle of the joint"];
    let below = [lowest, most.least.to_degrees() - APART];
    angle(ui, ("min", words[0]), (least, below), sink, |x| MatterChange::Stops(Stops::Least(x)));
    let above = [least.most.to_degrees() + APART, highest];
    angle(ui, ("max", words[1]), (most, above), sink, |x| MatterChange::Stops(Stops::Most(x)));
}

/// A net turns at each of its corners: all of them get stops by a button that says how many they are.
fn all_stops(ui: &mut Ui, all: usize, sink: &mut Sink<'_>) {
    row(ui, "joints", |ui, _| {
        let by = ui.button(format!("stops for all {all}")).on_hover_text("they turn so far and no further, as a knee");
        *sink.previews_stops = by.hovered();
        if by.clicked() {
            sink.set(&by, MatterChange::Stops(Stops::Some));
        }
    });
    ui.label(RichText::new(ONE_CORNER).color(colors(ui).weak));
}

/// An angle in degrees of a range, of numbers in radians.
fn angle(
    ui: &mut Ui,
    (name, words): (&str, &str),
    (span, [from, to]): (Span, [f64; 2]),
    sink: &mut Sink<'_>,
    change: impl Fn(f64) -> MatterChange,
) {
    let [least, most] = [span.least, span.most].map(f64::to_degrees);
    let mut value = 0.5 * (least + most);
    row(ui, name, |ui, label| {
        let field = DragValue::new(&mut value).speed(SPEED).fixed_decimals(1).update_while_editing(false);
        let field = match span.same() {
            Some(_) => field.suffix("°"),
            None => field.custom_formatter(|_, _| "mixed".to_owned()),
        };
        let by = ranged::field(ui, field, from..=to.max(from), "°").labelled_by(label);
        let by = match span.same() {
            Some(_) => by.on_hover_text(words),
            None => by.on_hover_text(format!("{words}: from {least:.1}° to {most:.1}°")),
        };
        if by.changed() {
            sink.set(&by, change(value.to_radians()));
        }
    });
}
