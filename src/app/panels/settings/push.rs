//! The push of the mouse: how strong, how far, in which region, and how it falls off; where there is none yet, it can be had.

use egui::{Response, Ui};

use super::super::{Facts, ticks};
use super::fields::{number, number_within};
use super::{Pushing, Sink};
use crate::history::Do;
use crate::sim::{MouseChange, Profile, Region};

/// What a push that was not there begins with `[1/s^2]`, and how far it reaches, as a share of the height of what is seen `[1]`, or where that is
/// not known `[m]`.
const STRENGTH: f64 = 60.0;
const SHARE: f64 = 0.12;
const RADIUS: f64 = 0.5;
/// The least radius `[m]`.
const LEAST: f64 = 1e-3;

pub(super) fn show(ui: &mut Ui, facts: &Facts, sink: &mut Sink<'_>) {
    ui.strong("Push of the mouse");
    match (facts.settings.push, facts.settings.pushing) {
        (Some(push), pushing) => {
            numbers(ui, push, sink);
            shape(ui, pushing.unwrap_or_default(), sink);
        }
        (None, Some(Pushing { has_track: true, .. })) => {
            let by = ui.button("follow the pointer").on_hover_text("now it goes along a track of the scene");
            give(by.clicked().then_some(by), MouseChange { ends_track: true, ..MouseChange::default() }, sink);
        }
        (None, _) => {
            let by = ui.button("add one").on_hover_text("the pointer pushes bodies away, without a click");
            let [low, high] = facts.seen;
            let radius = if high[1] > low[1] { SHARE * (high[1] - low[1]) } else { RADIUS };
            let change = MouseChange { strength: Some(STRENGTH), radius: Some(radius), ..MouseChange::default() };
            give(by.clicked().then_some(by), change, sink);
        }
    }
}

fn give(by: Option<Response>, change: MouseChange, sink: &mut Sink<'_>) {
    if let Some(by) = by {
        sink.set(&by, "push", Do::Mouse(change));
    }
}

fn numbers(ui: &mut Ui, [mut strength, mut radius]: [f64; 2], sink: &mut Sink<'_>) {
    let [speed, pace] = [0.01 * strength.abs().max(1.0), 0.01 * radius];
    let both = ui.horizontal_wrapped(|ui| {
        let strength = number(ui, "strength", (&mut strength, speed, " /s²"));
        (strength, number_within(ui, "radius", (&mut radius, pace, " m"), LEAST..=f64::INFINITY))
    });
    let (of_strength, of_radius) = both.inner;
    let strength = MouseChange { strength: Some(strength), ..MouseChange::default() };
    give(of_strength.changed().then_some(of_strength), strength, sink);
    let radius = MouseChange { radius: Some(radius), ..MouseChange::default() };
    give(of_radius.changed().then_some(of_radius), radius, sink);
}

/// The region, and how the push falls off in it. In space all regions are round.
fn shape(ui: &mut Ui, now: Pushing, sink: &mut Sink<'_>) {
    if sink.dimensions == 2 {
        let regions = [
            (Region::Round, "round", "within the radius of the pointer"),
            (Region::Square, "square", "as far as the radius to each side"),
        ];
        one_of(ui, ("region", now.region), regions, sink, |region| MouseChange {
            region: Some(region),
            ..MouseChange::default()
        });
    }
    let profiles = [
        (Profile::Smooth, "smoothly", "to nothing at the edge of the region"),
        (Profile::Linear, "not at all", "the farther off, the stronger, up to the edge, where it ends at once"),
    ];
    one_of(ui, ("falls off", now.profile), profiles, sink, |profile| MouseChange {
        profile: Some(profile),
        ..MouseChange::default()
    });
}

/// A row of choices with their names and words, of which one is taken.
fn one_of<T: Copy + PartialEq>(
    ui: &mut Ui,
    (label, now): (&str, T),
    choices: [(T, &str, &str); 2],
    sink: &mut Sink<'_>,
    change: impl Fn(T) -> MouseChange,
) {
    ui.horizontal(|ui| {
        ui.label(label);
        for (choice, name, words) in choices {
            let by = ticks::radio(ui, now == choice, name).on_hover_text(words);
            let is_new = by.clicked() && now != choice;
            give(is_new.then_some(by), change(choice), sink);
        }
    });
}
