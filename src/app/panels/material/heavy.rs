//! What is too heavy for its springs, or for what it stands on, and how stiff these have to be.

use egui::{Label, Response, RichText, Ui};

use super::rows::short;
use crate::app::count::counted;
use crate::app::matter::Overload;
use crate::app::panels::theme::colors;

/// Says that a body would sag by some share of its height, and offers the stiffness that bears it `[N/m]`. Returns the offer, if it is taken.
pub(in crate::app::panels) fn sagging(ui: &mut Ui, (share, stiffness): (f64, f64)) -> Option<Response> {
    let words = match share {
        share if share < 1.0 => {
            format!("too heavy for its springs: it would sag by {:.0} % of its height", 100.0 * share)
        }
        _ => "too heavy for its springs: its own weight would crush it".to_owned(),
    };
    offer(ui, &words, stiffness, "so stiff springs let it sag by a tenth of its height")
}

/// Says that a part of a body gives way under its load, and offers the stiffness that bears it. Returns whether it is taken.
pub(in crate::app::panels) fn gives_way(ui: &mut Ui, overload: &Overload) -> bool {
    let words = match overload.share {
        share if share < 1.0 => {
            format!("too heavy for what it stands on: it sinks by {:.0} % of its height", 100.0 * share)
        }
        _ => "too heavy for what it stands on: that is crushed".to_owned(),
    };
    let told = format!("so stiff springs in it and in what it stands on: {}", counted(overload.bonds.len(), "bond"));
    offer(ui, &words, overload.stiffness, &told).is_some()
}

/// Says that something is too heavy, and offers the stiffness that bears it `[N/m]`.
fn offer(ui: &mut Ui, words: &str, stiffness: f64, told: &str) -> Option<Response> {
    ui.add(Label::new(RichText::new(words).color(colors(ui).away)).wrap());
    let offer = ui.button(format!("{} N/m bear it", short(stiffness)));
    Some(offer.on_hover_text(told)).filter(Response::clicked)
}
