//! The menu and the titles of worlds side by side, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use egui::{Event, Pos2, Shape, vec2};

use super::pointer::click;
use super::{Facts, Neighbor, Wish, beside};
use crate::app::player::{Shown, Stage};
use crate::render::Look;
use crate::scene::{Scene, SolverName};

/// What is written in a frame, and where.
type Written = Vec<(String, Pos2)>;

fn frame(context: &egui::Context, facts: &Facts, events: Vec<Event>) -> (Vec<Wish>, Written) {
    let mut wishes = Vec::new();
    let screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
    let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
    let mut output = context.run_ui(input, |ui| {
        beside::menu(ui, true, facts, &mut wishes);
        _ = beside::titles(ui.ctx(), facts, (false, false));
    });
    output.textures_delta.clear();
    let texts = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
        Shape::Text(text) => Some((text.galley.text().to_owned(), text.visual_bounding_rect().center())),
        _ => None,
    });
    (wishes, texts.collect())
}

/// What is written once sizes are found.
fn settled(context: &egui::Context, facts: &Facts) -> Written {
    (0..2).for_each(|_| _ = frame(context, facts, Vec::new()));
    frame(context, facts, Vec::new()).1
}

/// Clicks on words after others, and returns what is asked for.
fn choose(facts: &Facts, words: [&str; 2]) -> Vec<Wish> {
    let context = egui::Context::default();
    let mut wishes = Vec::new();
    for word in words {
        let written = settled(&context, facts);
        let at = written.iter().find(|(text, _)| text == word).unwrap_or_else(|| panic!("{word}: {written:?}")).1;
        click(at).into_iter().for_each(|events| wishes.extend(frame(&context, facts, events).0));
    }
    wishes
}

fn beside_each_other() -> Facts {
    let world = |title: &str, words: &str, x: f32| Neighbor {
        title: title.to_owned(),
        words: words.to_owned(),
        at: [x, 0.0],
        width: 600.0,
        columns: 2,
        color: Some(Look::default().trails[0]),
    };
    let neighbors = vec![world("euler", "", 66.0), world("Verlet", "up to 3.4 cm apart", 640.0)];
    Facts { neighbors, tints_distance: true, ..Facts::default() }
}

#[test]
fn the_menu_puts_worlds_there_and_takes_them_away() {
    let alone = Facts::default();
    assert_eq!(choose(&alone, ["Compare…", "Runge-Kutta, order 4"]), [Wish::Beside(Some(SolverName::Rk4))]);
    assert_eq!(choose(&alone, ["Compare…", "a reference: fine steps, 64 bits"]), [Wish::Beside(None)]);
    let two = beside_each_other();
    assert_eq!(choose(&two, ["Compare…", "Take away: Verlet"]), [Wish::TakeAway(0)]);
    assert_eq!(choose(&two, ["Compare…", "colour by the distance"]), [Wish::TintDistance(false)]);
}

#[test]
fn the_method_in_use_is_not_offered_beside_itself() {
    let scene =
        Scene::parse(r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 3, "to": [0, 1]}]}"#, "x.json").unwrap();
    let mut facts = Facts::default();
    let offered = |facts: &Facts| {
        let context = egui::Context::default();
        let written = settled(&context, facts);
        let at = written.iter().find(|(text, _)| text == "Compare…").unwrap().1;
        click(at).into_iter().for_each(|events| _ = frame(&context, facts, events));
        settled(&context, facts).iter().any(|(text, _)| text == SolverName::Auto.words())
    };
    assert!(offered(&facts));
    let mut shown = Shown::default();
    Stage::new(scene.into()).unwrap().show(&mut shown);
    facts.settings.scene = shown.settings;
    assert!(!offered(&facts), "automatic beside automatic shows nothing");
}

#[test]
fn solvers_are_named_once_where_it_is_said_why_they_cannot_run_a_scene() {
    for name in ["path", "`path`"] {
        assert_eq!(beside::reason(&format!("solver {name} knows no contact: leave it out")), "knows no contact");
    }
    assert_eq!(beside::reason("a bond is rigid, which solver rk4 refuses"), "a bond is rigid, which it refuses");
}

#[test]
fn what_the_scene_refuses_is_folded_behind_a_line_that_says_why() {
    let refused = |name: &str| Some(format!("solver `{name}` knows no contact: leave `solver` or `contact` out"));
    let misfits = [(SolverName::Rk4, refused("rk4")), (SolverName::Euler, refused("euler")), (SolverName::Rk2, None)];
    let facts = Facts { misfits: misfits.into_iter().collect(), ..Facts::default() };
    let context = egui::Context::default();
    let open = |words: &str| {
        let written = settled(&context, &facts);
        let at = written.iter().find(|(text, _)| text == words).unwrap_or_else(|| panic!("{words}: {written:?}")).1;
        click(at).into_iter().for_each(|events| assert!(frame(&context, &facts, events).0.is_empty(), "{words}"));
        settled(&context, &facts)
    };
    let has = |written: &Written, words: &str| written.iter().any(|(text, _)| text == words);
    let menu = open("Compare…");
    assert!(!has(&menu, "Runge-Kutta, order 4") && has(&menu, "Runge-Kutta, order 2"), "{menu:?}");
    let folded = open("Not for this scene (2)");
    let named = folded.iter().any(|(text, _)| text.contains("Runge-Kutta, order 4") && text.contains(", "));
    assert!(named && has(&folded, "each knows no contact"), "{folded:?}");
    assert_eq!(choose(&facts, ["Compare…", "Runge-Kutta, order 2"]), [Wish::Beside(Some(SolverName::Rk2))]);
}

#[test]
fn each_world_has_its_title_in_its_part_of_the_window_and_the_last_the_legend() {
    let context = egui::Context::default();
    let facts = beside_each_other();
    let written = settled(&context, &facts);
    let at = |words: &str| written.iter().find(|(text, _)| text == words).unwrap_or_else(|| panic!("{written:?}")).1;
    assert!((66.0..140.0).contains(&at("euler").x), "in the corner, behind its stroke: {written:?}");
    assert!((640.0..750.0).contains(&at("up to 3.4 cm apart").x) && at("Verlet").y < 100.0);
    assert!((640.0..1280.0).contains(&at("distance to the first:").x));
    assert_eq!(written.iter().filter(|(text, _)| text == "distance to the first:").count(), 1);
}
