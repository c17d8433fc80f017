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
    let words = marks
        .iter()
        .any(|mark| matches!(mark, Mark::Words(_, words) if words.starts_with("10 muscles: a wave of 7.00 m")));
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
    assert!(marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words == "let go: 10 muscles go")));
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

/// Each scene in which bonds can be no muscles: what is said of one, and whether all are so.
#[test]
fn what_a_click_would_refuse_is_said_before_it_and_nothing_is_marked() {
    let scenes = [
        (r#""dimensions": 3, "contact": true, "bodies": [SPRING]"#, "where bodies, balls or boxes meet", true),
        (
            r#""dimensions": 3, "obstacles": [{"circle": {"center": [0, -9, 0], "radius": 1}}], "bodies": [SPRING]"#,
            "meet",
            true,
        ),
        (r#""dimensions": 3, "bodies": [RIGID]"#, "springs alone", false),
        (
            r#""method": {"solver": "xpbd", "substep": 0.005, "iterations": 3}, "bodies": [SPRING]"#,
            "knows no muscles",
            true,
        ),
        (r#""method": {"solver": "verlet", "substep": 0.005}, "bodies": [RIGID]"#, "a rigid bond is no muscle", false),
        (
            r#""bodies": [{"make": "rope", "count": 2, "spacing": 2, "origin": [-1, 0], "material": {"kind": "relaxed"}}],
            "method": {"substep": 0.005, "iterations": 3}"#,
            "relaxed",
            false,
        ),
        // These can.
        (r#""bodies": [SPRING]"#, "", false),
        (r#""bodies": [RIGID], "contact": true"#, "", false),
        (r#""dimensions": 3, "bodies": [SPRING]"#, "", false),
    ];
    let rope = |kind: &str, d: usize| {
        let origin = if d == 3 { "[-1, 0, 0]" } else { "[-1, 0]" };
        format!(r#"{{"make": "rope", "count": 2, "spacing": 2, "origin": {origin}, "material": {{{kind}}}}}"#)
    };
    for (keys, why, all) in scenes {
        let d = if keys.contains("dimensions") { 3 } else { 2 };
        let keys = keys.replace("SPRING", &rope(r#""kind": "spring", "stiffness": 90"#, d));
        let keys = keys.replace("RIGID", &rope(r#""kind": "rigid""#, d));
        let scene = Scene::parse(&format!(r#"{{"wobble": 1, "drag_rate": 0.1, {keys}}}"#), "x.json").unwrap();
        let seen = shown(scene.clone());
        let middle = at(&seen, 0.0, 0.0);
        let mut hand = Hand::default();
        hand.take(Tool::Muscle);
        let marks = hand.marks(scope(&seen), Some(middle));
        let is_marked = marks.iter().any(|mark| matches!(mark, Mark::Line(Role::Come, ..)));
        let is_said = |mark: &Mark| matches!(mark, Mark::Words(_, words) if words.contains(why));
        assert!(is_marked == why.is_empty() && marks.iter().any(is_said), "{keys}: {marks:?}");
        let deed = {
            hand.press(scope(&seen), middle);
            hand.release(scope(&seen), middle)
        };
        assert_eq!(super::no_muscles(seen.0.driving).is_some(), all, "{keys}");
        // By its key the tool is taken where its button is on, no more.
        let lack = |tool| super::lack_of(tool, seen.0.driving);
        assert_eq!((lack(Tool::Muscle).is_some(), lack(Tool::Select)), (all, None), "{keys}");
        let mut stage = Stage::new(scene.into()).unwrap();
        if why.is_empty() {
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None, "{keys}");
            continue;
        }
        assert!(deed.is_empty() && deed.words.as_deref().is_some_and(|words| words.contains(why)), "{keys}: {deed:?}");
        // The world refuses it too: the preview holds back no click that would do something.
        let set = crate::history::SetKeys {
            bonds: Some(vec![0]),
            drive: Some(DriveOrNone::This(crate::scene::DriveKeys {
                amplitude: Some(0.2),
                period: Some(1.0),
                ..Default::default()
            })),
            ..Default::default()
        };
        let said = stage.obey(Order::Give(vec![Do::Set(Box::new(set))], Some("muscle")));
        assert!(matches!(said, Some(Note::Refused(_))), "{keys}: {said:?}");
    }
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

/// A strip of springs on the ground, as the tool for boxes makes it.
const STRIP: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.5}, "view": {"center": [1.5, 0.5], "height": 5},
    "bounds": {"min": [-20, 0], "max": [20, 10], "friction": 0.5},
    "bodies": [{"make": "lattice", "columns": 16, "rows": 3, "spacing": 0.2, "origin": [0, 0.01],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1.8, "mass": 1.2}}]}"#;

/// How far the strip crawls in 20 s by muscles that one stroke along its lower side makes `[m]`, and what is said while it is drawn.
fn crawl(runs: bool) -> (f64, Vec<Mark>) {
    let seen = shown(Scene::parse(STRIP, "x.json").unwrap());
    let mut hand = Hand::default();
    hand.take(Tool::Muscle);
    let mut drives = hand.drives();
    drives.muscle.runs = runs;
    hand.set_drives(drives);
    hand.press(scope(&seen), at(&seen, -0.1, 0.02));
    (1..=40).for_each(|k| hand.trace(scope(&seen), at(&seen, -0.1 + 3.2 * f64::from(k) / 40.0, 0.02)));
    let end = at(&seen, 3.1, 0.02);
    let marks = hand.marks(scope(&seen), Some(end));
    let deed = hand.release(scope(&seen), end);
    assert_eq!((deed.commands.len(), deed.edit), (1, Some("muscles")));
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    let middle = |stage: &Stage| {
        let world = stage.history().world();
        let count = world.point_count();
        (0..count).map(|point| world.positions().get(2 * point)).sum::<f64>() / count as f64
    };
    let from = middle(&stage);
    (0..1200).for_each(|_| _ = stage.obey(Order::Step(None)));
    (middle(&stage) - from, marks)
}

#[test]
fn a_worm_whose_muscles_one_stroke_drew_crawls_by_a_wave_that_runs_along_it() {
    let (far, marks) = crawl(true);
    let words =
        |marks: &[Mark]| marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words.contains("runs along")));
    assert!(words(&marks), "{marks:?}");
    // It is 3 m long.
    assert!(far > 3.0, "{far} m, the way of the stroke");
    let (bows, marks) = crawl(false);
    assert!(bows.abs() < 1.0 && !words(&marks), "all at once it stays: {bows} m");
}

#[test]
fn bonds_that_are_muscles_get_the_numbers_of_another_stroke_with_phases_along_it() {
    let mut seen = seen();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let (_, deed) = drag(&seen, &[[-0.5, 0.5], [9.5, 0.5]]);
    let rungs = bonds(&deed);
    given(&mut stage, &mut seen, deed);
    let wave = |stage: &Stage, number: u32| {
        stage.history().world().bonds().get(number as usize).drive.unwrap().signal.wave.unwrap()
    };
    let phases: Vec<f64> = rungs.iter().map(|&rung| wave(&stage, rung).phase).collect();
    let place = |rung: u32| seen.0.place(seen.0.scenery.bonds.ends()[rung as usize][0].index())[0];
    for pair in 0..9 {
        // A metre of a wave 7 m long.
        let turn = (phases[pair] - phases[pair + 1]).rem_euclid(std::f64::consts::TAU);
        let metres = (place(rungs[pair + 1]) - place(rungs[pair])).abs();
        assert!((turn - std::f64::consts::TAU * metres / 7.0).abs() < 0.02, "{phases:?}");
    }
    let mut hand = Hand::default();
    hand.take(Tool::Muscle);
    let mut drives = hand.drives();
    (drives.muscle.period, drives.muscle.runs) = (2.0, false);
    hand.set_drives(drives);
    hand.press(scope(&seen), at(&seen, -0.5, 0.5));
    hand.trace(scope(&seen), at(&seen, 4.0, 0.5));
    let deed = hand.release(scope(&seen), at(&seen, 9.5, 0.5));
    assert_eq!((bonds(&deed).len(), deed.edit), (10, Some("muscles")));
    given(&mut stage, &mut seen, deed);
    assert!(rungs.iter().all(|&rung| wave(&stage, rung) == crate::sim::Wave { period: 2.0, phase: 0.0 }));
    for period in [1.0, f64::NAN] {
        let note = stage.obey(Order::Undo(None));
        assert!(matches!(note, Some(Note::Undone(name, _)) if name == "muscles"));
        let drive = stage.history().world().bonds().get(rungs[0] as usize).drive;
        assert_eq!(drive.is_some(), period == 1.0);
    }
}

#[test]
fn a_rigid_bond_whose_ends_others_hold_is_left_out_and_said_a_truss_is_not() {
    let scene = |bonds: &str| {
        let points = "[[0,0],[2,0],[2,2],[0,2]]";
        let text = format!(
            r#"{{"wobble": 1, "view": {{"center": [1, 1], "height": 6}}, "points": {{"position": {points}}}, "bonds": {bonds}}}"#
        );
        shown(Scene::parse(&text, "x.json").unwrap())
    };
    let braced = scene(r#"[{"a":0,"b":1},{"a":1,"b":2},{"a":2,"b":3},{"a":3,"b":0},{"a":0,"b":2},{"a":1,"b":3}]"#);
    let deed = drag(&braced, &[[-1.0, 0.5], [3.0, 0.5]]).1;
    assert!(deed.commands.is_empty(), "{:?}", deed.commands);
    assert!(deed.words.unwrap().contains("other rigid bonds hold its ends"));
    // One diagonal less, and every bond leads two triangles.
    let truss = scene(r#"[{"a":0,"b":1},{"a":1,"b":2},{"a":2,"b":3},{"a":3,"b":0},{"a":0,"b":2}]"#);
    assert_eq!(bonds(&drag(&truss, &[[-1.0, 0.5], [3.0, 0.5]]).1), [1, 3, 4]);
}
