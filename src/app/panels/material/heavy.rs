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
    offer(ui, &words, (stiffness, "bear it"), "so stiff springs let it sag by a tenth of its height")
}

/// Says that a part of a body gives way under its load, and offers the stiffness that bears it. Returns whether it is taken.
pub(in crate::app::panels) fn gives_way(ui: &mut Ui, overload: &Overload) -> bool {
    let (words, told) = words(overload);
    let offered = if overload.is_first { "lift it" } else { "bear it" };
    offer(ui, &words, (overload.stiffness, offered), &told).is_some()
}

/// What is said of it, and what a click does.
fn words(overload: &Overload) -> (String, String) {
    let whose = if overload.is_whole { "its springs" } else { "what it stands on" };
    let what = match (overload.share, overload.is_whole) {
        (share, _) if share < 1.0 => format!("it sinks by {:.0} % of its height", 100.0 * share),
        (_, true) => "its own weight crushes it".to_owned(),
        (_, false) => "that is crushed".to_owned(),
    };
    let springs = if overload.is_whole { "springs" } else { "springs in it and in what it stands on" };
    let first =
        if overload.is_first { "; stiffer ones would throw it as it is bent now: again once it has risen" } else { "" };
    let told = format!("so stiff {springs}: {}{first}", counted(overload.bonds.len(), "bond"));
    (format!("too heavy for {whose}: {what}"), told)
}

/// Says that something is too heavy, and offers a stiffness `[N/m]` with what that does.
fn offer(ui: &mut Ui, words: &str, (stiffness, does): (f64, &str), told: &str) -> Option<Response> {
    ui.add(Label::new(RichText::new(words).color(colors(ui).away)).wrap());
    let offer = ui.button(format!("{} N/m {does}", short(stiffness)));
    Some(offer.on_hover_text(told)).filter(Response::clicked)
}

#[cfg(test)]
mod tests {
    use super::words;
    use crate::app::matter::Overload;

    #[test]
    fn a_body_by_itself_stands_on_nothing_else_and_what_is_bent_is_lifted_first() {
        let said = |share, is_whole, is_first| {
            let (said, told) = words(&Overload { share, is_whole, is_first, bonds: vec![0, 1], stiffness: 900.0 });
            format!("{said}; {told}")
        };
        assert!(said(2.0, true, false).starts_with("too heavy for its springs: its own weight crushes it"));
        assert!(said(0.7, true, false).contains("sinks by 70 %") && !said(0.7, true, false).contains("stands on"));
        assert!(said(2.0, false, false).starts_with("too heavy for what it stands on: that is crushed"));
        assert!(said(2.0, false, true).contains("once it has risen") && !said(2.0, false, false).contains("risen"));
    }
}
