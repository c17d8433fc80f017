//! Whatever a command can set has a control in the window that sets it, found by the name that what reads aloud has of it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

mod scene_keys;

use std::collections::BTreeSet;

use egui::{Pos2, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use wobble::app::action::{Action, Tool};
use wobble::app::rehearsal::Rehearsal;
use wobble::history::{Do, SetKeys};
use wobble::scene::Scene;
use wobble::sim::PointId;

use crate::common::panels::harness;

/// So large that nothing has to be scrolled `[points]`.
const SIZE: [f32; 2] = [2800.0, 2600.0];

/// A soft block that meets others.
const SOFT: &str = r#"{"wobble": 1, "gravity": [0, -5], "drag_rate": 2, "contact": {"friction": 0.5, "restitution": 0.5},
    "wind": {"velocity": [1, 0]}, "bounds": {"min": [-9, -9], "max": [9, 9]},
    "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "material": {"kind": "spring", "stiffness": 300,
        "damping": 2, "mass": 4}}]}"#;
/// Ground, where bodies do not meet: it can be soft.
const GROUND: &str =
    r#"{"wobble": 1, "points": {"position": [[0, 1]]}, "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}}]}"#;
/// Two relaxed bonds.
const RELAXED: &str = r#"{"wobble": 1, "method": {"substep": 0.002, "iterations": 4}, "points": {"position": [[0, 0], [1, 0], [2, 0]]}, "bonds": [
    {"a": 0, "b": 1, "kind": "relaxed", "relaxation": 0.5, "max_correction": 0.5},
    {"a": 1, "b": 2, "kind": "relaxed", "relaxation": 0.5, "max_correction": 0.5}]}"#;
/// A joint that resists.
const KNEE: &str = r#"{"wobble": 1, "points": {"position": [[1, 0], [0, 0], [0, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
    "angles": [{"points": [0, 1, 2], "stiffness": 2, "damping": 0.5}]}"#;

/// Where a control stands.
#[derive(Clone, Copy, Debug)]
enum Panel {
    /// Among the settings.
    Settings,
    /// In the panel of what is selected: the points of a scene.
    Points(&'static str, u32),
    /// In that of the ground.
    Ground,
}

/// What is done with it.
#[derive(Clone, Copy, Debug)]
enum How {
    /// A button, a box or a choice.
    Press,
    /// A field for a number, which is dragged to the left.
    Drag,
    /// A slider, which is pressed near its left end.
    Slide,
}

const OF_SOFT: Panel = Panel::Points(SOFT, 9);
const OF_RELAXED: Panel = Panel::Points(RELAXED, 3);
const OF_KNEE: Panel = Panel::Points(KNEE, 3);

/// Keys, and the control that sets them.
const CONTROLS: [(&[&str], Panel, &str, How); 28] = [
    (&["gravity"], Panel::Settings, "down", How::Press),
    (&["drag_rate"], Panel::Settings, "drag /s", How::Slide),
    (&["wind"], Panel::Settings, "wind x", How::Drag),
    (&["bounds"], Panel::Settings, "floor", How::Drag),
    (&["contact"], Panel::Settings, "collide", How::Press),
    (&["areas"], Panel::Settings, "areas are kept", How::Press),
    (&["method"], Panel::Settings, "sweeps", How::Press),
    (&["rate"], Panel::Settings, "rate", How::Drag),
    (&["duration"], Panel::Settings, "ends", How::Press),
    (&["labels"], Panel::Settings, "add a label", How::Press),
    (&["points", "mass"], OF_SOFT, "mass", How::Drag),
    (&["velocity"], OF_SOFT, "velocity x", How::Drag),
    (&["bonds", "kind"], OF_SOFT, "relaxed", How::Press),
    (&["stiffness"], OF_SOFT, "stiffness", How::Drag),
    (&["damping"], OF_SOFT, "damping", How::Drag),
    (&["rest"], OF_SOFT, "rest length", How::Drag),
    (&["break_strain"], OF_SOFT, "tears", How::Press),
    (&["limit"], OF_SOFT, "pull", How::Press),
    (&["friction"], OF_SOFT, "friction", How::Slide),
    (&["restitution"], OF_SOFT, "restitution", How::Slide),
    (&["radius"], OF_SOFT, "skin", How::Drag),
    (&["layered"], OF_SOFT, "passes itself", How::Press),
    (&["relaxation"], OF_RELAXED, "relaxation", How::Drag),
    (&["max_correction"], OF_RELAXED, "corrects", How::Drag),
    (&["angles"], OF_KNEE, "damped by", How::Drag),
    (&["range"], OF_KNEE, "stops", How::Press),
    (&["drive"], OF_KNEE, "swings", How::Press),
    (&["obstacles", "penalty"], Panel::Ground, "soft ground", How::Press),
];

/// Keys that no control of a panel sets, and why.
const EXCEPTIONS: [(&str, &str); 6] = [
    ("compliance", "is the reciprocal of the stiffness, which has a control"),
    ("phase", "is what the tool for muscles gives the bonds of a stroke, one after another"),
    ("over", "comes along with masses and stiffness, where springs bear a load"),
    ("forces", "are arrows, which the tool for forces drags"),
    ("force", "is the length of such an arrow, and where it points"),
    ("torque", "is the same of an arrow that is drawn with Alt"),
];

fn opened(panel: Panel) -> Harness<'static, Rehearsal> {
    let text = match panel {
        Panel::Settings => SOFT,
        Panel::Points(text, _) => text,
        Panel::Ground => GROUND,
    };
    let mut rehearsal = Rehearsal::new(Scene::parse(text, "x.json").unwrap()).unwrap();
    match panel {
        Panel::Settings => rehearsal.act(Action::Settings),
        Panel::Points(..) | Panel::Ground => rehearsal.act(Action::Take(Tool::Select)),
    }
    match panel {
        Panel::Settings => {}
        Panel::Points(_, count) => rehearsal.select((0..count).map(PointId).collect()),
        Panel::Ground => rehearsal.select_obstacles(vec![0]),
    }
    harness(rehearsal, SIZE, 1.0).0
}

/// The pointer goes down at a place, to another, and up.
fn pull(panels: &mut Harness<'static, Rehearsal>, [from, to]: [Pos2; 2]) {
    panels.hover_at(from);
    panels.run_steps(2);
    panels.drag_at(from);
    panels.run_steps(2);
    for at in [from + 0.5 * (to - from), to] {
        panels.hover_at(at);
        panels.run_steps(2);
    }
    panels.drop_at(to);
    panels.run_steps(3);
}

/// Uses a control of a panel.
fn touched(panel: Panel, name: &str, how: How) -> Harness<'static, Rehearsal> {
    let mut panels = opened(panel);
    let widest = |a: &Rect, b: &Rect| a.width().total_cmp(&b.width());
    let place = panels.get_all_by_label(name).map(|node| node.rect()).max_by(widest).unwrap();
    match how {
        How::Press => {
            panels.get_by_label(name).click();
            panels.run_steps(4);
        }
        How::Drag => pull(&mut panels, [place.center(), place.center() - vec2(40.0, 0.0)]),
        How::Slide => {
            let at = Pos2::new(place.left() + 0.1 * place.width(), place.center().y);
            pull(&mut panels, [at, at]);
        }
    }
    assert_eq!(panels.state().refusals(), [""; 0], "{name}");
    panels
}

/// Uses a control. Returns the keys that were set by it.
fn used(panel: Panel, name: &str, how: How) -> BTreeSet<String> {
    let panels = touched(panel, name, how);
    let commands = panels.state().history().recording().commands;
    let sets = commands.iter().filter_map(|entry| if let Do::Set(keys) = &entry.act { Some(keys) } else { None });
    let names =
        |keys: &SetKeys| serde_json::to_value(keys).unwrap().as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    sets.flat_map(|keys| names(keys)).collect()
}

#[test]
fn every_key_of_a_command_that_sets_something_has_a_control_or_a_reason() {
    let schema = schemars::schema_for!(SetKeys).to_value();
    let known: Vec<&str> = schema["properties"].as_object().unwrap().keys().map(String::as_str).collect();
    let named = CONTROLS.iter().flat_map(|(keys, ..)| keys.iter().copied());
    let mut told: Vec<&str> = named.chain(EXCEPTIONS.iter().map(|(key, _)| *key)).collect();
    told.sort_unstable();
    let mut all = known.clone();
    all.sort_unstable();
    assert_eq!(told, all, "each key has one control here, or a reason why none has it");
}

#[test]
fn every_control_sets_the_keys_that_it_is_named_for() {
    let missed: Vec<String> = CONTROLS
        .iter()
        .filter_map(|(keys, panel, name, how)| {
            let set = used(*panel, name, *how);
            let is_missed = keys.iter().any(|key| !set.contains(*key));
            is_missed.then(|| format!("{name} sets {set:?}, not {keys:?}"))
        })
        .collect();
    assert_eq!(missed, [""; 0]);
}

#[test]
fn what_is_selected_is_moved_and_turned_by_the_numbers_of_its_place() {
    for (panel, name, edit) in [
        (OF_SOFT, "middle x", "move"),
        (OF_SOFT, "middle y", "move"),
        (OF_SOFT, "turn by", "turn"),
        (Panel::Ground, "middle y", "move"),
        (Panel::Ground, "angle", "turn"),
    ] {
        let mut panels = touched(panel, name, How::Drag);
        let moves = |panels: &Harness<'static, Rehearsal>| {
            let commands = panels.state().history().recording().commands;
            commands.into_iter().filter(|entry| matches!(entry.act, Do::Move(_))).collect::<Vec<_>>()
        };
        let given = moves(&panels);
        assert!(!given.is_empty(), "{name}");
        assert!(given.iter().all(|entry| entry.name.as_deref() == Some(edit)), "{name}: {given:?}");
        panels.state_mut().act(Action::Undo);
        assert_eq!(moves(&panels), [], "{name}: one step of undo takes all of the drag back");
    }
}
