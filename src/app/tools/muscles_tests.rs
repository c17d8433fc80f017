//! Muscles by clicks and by strokes: what is marked is what comes, as one step of undo.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use glam::DVec2;

use super::marks::{Mark, Role};
use super::tests::{scope, shown};
use super::{Deed, Hand};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::{Do, DriveOrNone};
use crate::render::Camera;
use crate::scene::Scene;

/// A ladder of springs, ten rungs 1 m wide, with a rope and a relaxed bond above.
const LADDER: &str = r#"{"wobble": 1, "view": {"center": [4.5, 0.5], "height": 10}, "method": {"substep": 0.005, "iterations": 3},
    "points": {"position": [[0,3],[9,3],[0,4],[9,4]]},
    "bonds": [{"a":0,"b":1,"limit":"max"},{"a":2,"b":3,"kind":"relaxed"}],
    "bodies": [{"make": "cloth", "columns": 10, "rows": 2, "spacing": 1, "diagonals": "none", "origin": [0, 1],
        "material": {"kind": "spring", "stiffness": 300}}]}"#;

type Seen = (Shown, Camera, Scene);

fn seen() -> Seen {
    shown(Scene::parse(LADDER, "x.json").unwrap())
}

fn at(seen: &Seen, x: f64, y: f64) -> DVec2 {
    seen.1.screen_from_world([x, y, 0.0].into()).unwrap().into()
}

/// A press, a way and a release at its end; with what is marked before that.
fn drag(seen: &Seen, way: &[[f64; 2]]) -> (Vec<Mark>, Deed) {
    let mut hand = Hand::default();
    hand.take(Tool::Muscle);
    let pixels: Vec<DVec2> = way.iter().map(|&[x, y]| at(seen, x, y)).collect();
    assert!(hand.press(scope(seen), pixels[0]).is_empty(), "what it becomes is known at the end");
    for pair in pixels.windows(2) {
        (1..=20).for_each(|k| hand.trace(scope(seen), pair[0].lerp(pair[1], f64::from(k) / 20.0)));
    }
    let end = pixels[pixels.len() - 1];
    let marks = hand.marks(scope(seen), Some(end));
    (marks, hand.release(scope(seen), end))
}

fn bonds(deed: &Deed) -> Vec<u32> {
    match &deed.commands[..] {
        [Do::Set(keys)] => keys.bonds.clone().unwrap(),
        _ => Vec::new(),
    }
}

/// Those of the ladder that lie across a way at this height, by both of their ends.
fn lying(seen: &Seen, is_it: impl Fn([DVec2; 2]) -> bool) -> Vec<u32> {
    let ends = seen.0.scenery.bonds.ends().iter().enumerate();
    let place = |point: crate::sim::PointId| DVec2::new(seen.0.place(point.index())[0], seen.0.place(point.index())[1]);
    ends.filter(|(_, ends)| is_it(ends.map(place))).map(|(number, _)| number as u32).collect()
}

fn given(stage: &mut Stage, seen: &mut Seen, deed: Deed) {
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    Arc::make_mut(&mut seen.0.scenery).bonds = stage.history().world().bonds().clone();
}

#[test]
fn a_stroke_makes_muscles_of_all_bonds_that_it_crosses_or_lies_along_in_one_step_of_undo() {
    let mut seen = seen();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let (marks, across) = drag(&seen, &[[-0.5, 0.5], [9.5, 0.5]]);
    let rungs = lying(&seen, |[a, b]| a.x == b.x && a.y.max(b.y) < 2.0);
    assert_eq!((rungs.len(), bonds(&across), across.edit), (10, rungs.clone(), Some("muscles")));
    let lines = marks.iter().filter(|mark| matches!(mark, Mark::Line(Role::Come, ..))).count();
    let words = marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words == "10 muscles"));
    assert!(lines == 10 && words, "{marks:?}");
    // A hand does not draw along a line to the pixel.
    let (_, along) = drag(&seen, &[[-0.3, 1.03], [4.5, 0.97], [9.3, 1.03]]);
    let upper = lying(&seen, |[a, b]| a.y == 1.0 && b.y == 1.0);
    let crossed = bonds(&along);
    assert!(upper.len() == 9 && upper.iter().all(|number| crossed.contains(number)), "{crossed:?}");
    assert!(crossed.iter().all(|number| upper.contains(number) || rungs.contains(number)), "{crossed:?}");
    given(&mut stage, &mut seen, across);
    let driven = |stage: &Stage| stage.history().world().bonds().iter().filter(|bond| bond.drive.is_some()).count();
    assert_eq!(driven(&stage), 10);
    // Over some that are muscles and some that are none, all become some; over such alone they go.
    let (_, more) = drag(&seen, &[[-0.5, 0.5], [0.5, 0.5], [0.5, 1.3]]);
    assert_eq!((bonds(&more).len(), more.edit), (1, Some("muscle")));
    let (marks, away) = drag(&seen, &[[-0.5, 0.4], [9.5, 0.6]]);
    assert!(marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words == "10 muscles away")));
    let [Do::Set(keys)] = &away.commands[..] else { panic!("{away:?}") };
    assert!(keys.drive == Some(DriveOrNone::None(())) && away.edit == Some("muscles away"));
    given(&mut stage, &mut seen, away);
    assert_eq!(driven(&stage), 0);
    for (name, left) in [("muscles away", 10), ("muscles", 0)] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name));
        assert_eq!(driven(&stage), left, "{name}");
    }
}

#[test]
fn what_can_be_no_muscle_is_left_out_and_that_is_said() {
    let seen = seen();
    let (_, deed) = drag(&seen, &[[4.5, 4.5], [4.5, -0.5]]);
    assert_eq!(bonds(&deed).len(), 2, "both long sides of the ladder");
    let words = deed.words.unwrap();
    assert!(words.starts_with("2 bonds left out: a bond that acts on one side"), "{words}");
    let (_, none) = drag(&seen, &[[4.5, 4.5], [4.5, 3.5]]);
    assert!(none.commands.is_empty() && none.words.unwrap().contains("relaxed"));
    let (_, empty) = drag(&seen, &[[4.5, 2.5], [4.5, 1.5]]);
    assert!(empty.commands.is_empty() && empty.words.unwrap().contains("no bond lies here"));
}

#[test]
fn a_stroke_that_is_cancelled_makes_nothing() {
    let seen = seen();
    let mut hand = Hand::default();
    hand.take(Tool::Muscle);
    hand.press(scope(&seen), at(&seen, -0.5, 0.5));
    hand.trace(scope(&seen), at(&seen, 5.0, 0.5));
    let (was, deed) = hand.cancel();
    assert!(was && deed.is_empty() && hand.release(scope(&seen), at(&seen, 9.0, 0.5)).is_empty());
}

#[test]
fn a_click_makes_a_bond_a_muscle_and_another_one_takes_it_away() {
    let mut seen = seen();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = Hand::default();
    hand.take(Tool::Muscle);
    let spot = [4.0, 0.5];
    let pixel = at(&seen, spot[0], spot[1]);
    let said = |seen: &Seen, at: DVec2| {
        hand.marks(scope(seen), Some(at)).into_iter().any(|mark| matches!(mark, Mark::Words(..)))
    };
    assert!(said(&seen, pixel) && !said(&seen, DVec2::ZERO));
    let (_, deed) = drag(&seen, &[spot]);
    let [Do::Set(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert!(matches!(keys.drive, Some(DriveOrNone::This(_))) && deed.edit == Some("muscle"));
    let number = keys.bonds.clone().unwrap()[0] as usize;
    given(&mut stage, &mut seen, deed);
    let drive = stage.history().world().bonds().get(number).drive.unwrap();
    assert_eq!((drive.amplitude, drive.signal.wave.unwrap().period), (0.3, 1.0));
    let (_, deed) = drag(&seen, &[spot]);
    assert_eq!(deed.edit, Some("muscle away"));
    given(&mut stage, &mut seen, deed);
    assert!(stage.history().world().bonds().get(number).drive.is_none());
}
