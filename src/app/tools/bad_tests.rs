//! What should not be done with tools: each has its outcome, and is told.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::drives::MotorChoice;
use super::tests::{grabbed, pixel, scope, shown};
use super::{Deed, Drives, Hand};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::{Cursor, PointId, Reach};

const WHEEL: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "duration": 0.05,
    "view": {"center": [0, 0], "height": 8}, "bounds": {"min": [-5, -3], "max": [5, 5]},
    "bodies": [{"make": "disc", "radius": 0.8, "spacing": 0.3, "origin": [-2, 0],
        "material": {"kind": "spring", "stiffness": 800, "damping": 2, "mass": 2}},
      {"make": "disc", "radius": 0.8, "spacing": 0.3, "origin": [2, 0], "material": {"kind": "rigid", "mass": 2}},
      {"make": "lattice", "columns": 2, "rows": 2, "spacing": 0.5, "origin": [0, 2], "pinned": [0, 1, 2, 3],
        "material": {"kind": "rigid", "mass": 2}}]}"#;

type Seen = (Shown, Camera, Scene);

fn bench() -> (Stage, Seen) {
    let scene = Scene::parse(WHEEL, "x.json").unwrap();
    (Stage::new(scene.clone().into()).unwrap(), shown(scene))
}

fn frames(stage: &mut Stage, seen: &mut Seen, count: u32) {
    for _ in 0..count {
        stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
    }
    stage.show(&mut seen.0);
}

fn at(seen: &Seen, x: f64, y: f64) -> DVec2 {
    DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap())
}

fn give(stage: &mut Stage, deed: Deed) -> Option<Note> {
    stage.obey(Order::Give(deed.commands, deed.edit))
}

#[test]
fn motors_of_any_strength_leave_wheels_whole() {
    for x in [-2.0, 2.0] {
        let (mut stage, mut seen) = bench();
        let mut hand = Hand::default();
        hand.take(Tool::Motor);
        let drives = hand.drives();
        let motor = MotorChoice { is_on: Some(true), speed: 1e4, torque: Some(1e9), ..drives.motor };
        hand.set_drives(Drives { motor, ..drives });
        let deed = hand.press(scope(&seen), at(&seen, x, 0.0));
        assert_eq!(give(&mut stage, deed), None);
        frames(&mut stage, &mut seen, 60);
        let world = stage.history().world();
        assert!(world.is_finite());
        let hub = seen.0.point_count() - 2;
        let far = |k: usize| {
            let [[a, b, _], [c, d, _]] = [seen.0.place(hub), seen.0.place(k)];
            (c - a).hypot(d - b)
        };
        let body = scope(&seen).body(PointId(hub as u32));
        let most = body.iter().map(|point| far(point.index())).fold(0.0, f64::max);
        assert!(most < 1.6, "{x}: {most} m from its axle");
    }
}

#[test]
fn what_is_pinned_is_led_by_its_pin_and_what_is_grabbed_can_be_deleted() {
    let (mut stage, seen) = bench();
    let mut hand = Hand::default();
    let pin = seen.0.point_count() - 1;
    assert!(grabbed(&hand.press(scope(&seen), pixel(&seen, pin))).is_empty() && hand.is_leading());
    hand.release(scope(&seen), pixel(&seen, pin));
    // A command that grabs pins alone is refused in words.
    let there = Do::Cursor { to: Some(Cursor::at([0.0, 2.0])), by: None };
    let grab = Do::Grab(Reach::Points(vec![PointId(pin as u32)]));
    assert_eq!(stage.obey(Order::Give(vec![there], None)), None);
    let note = stage.obey(Order::Give(vec![grab], None));
    assert_eq!(note, Some(Note::Held));
    let deed = hand.press(scope(&seen), at(&seen, -2.0, 0.0));
    assert!(!grabbed(&deed).is_empty());
    assert_eq!(give(&mut stage, deed), None);
    let gone = hand.delete(scope(&seen), None);
    assert_eq!((gone.edit, hand.is_busy()), (Some("delete"), false));
    assert!(gone.words.as_deref().is_some_and(|words| words.contains("Ctrl+Z")), "{:?}", gone.words);
    assert_eq!(give(&mut stage, gone), None);
    assert!(stage.history().world().grab().is_none(), "nothing hangs on the hand");
    assert_eq!(hand.release(scope(&seen), at(&seen, 0.0, 0.0)), Deed::default());
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "delete"));
}

#[test]
fn a_thousand_edits_are_undone_and_done_again_one_by_one() {
    let (mut stage, _) = bench();
    let before = stage.history().world().topology();
    for k in 0..1000_u32 {
        let acts = if k % 2 == 0 { vec![Do::Pin(vec![PointId(3)])] } else { vec![Do::Unpin(vec![PointId(3)])] };
        assert_eq!(stage.obey(Order::Give(acts, Some("pin"))), None);
    }
    for _ in 0..1000 {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
    }
    assert_eq!(stage.obey(Order::Undo(None)), Some(Note::NothingToUndo));
    assert!(!stage.history().world().pinned().contains(&PointId(3)));
    for _ in 0..1000 {
        assert!(matches!(stage.obey(Order::Redo(None)), Some(Note::Redone(..))));
    }
    assert_eq!(stage.obey(Order::Redo(None)), Some(Note::NothingToRedo));
    assert_ne!(stage.history().world().topology(), before);
}

#[test]
fn tools_work_in_a_scene_that_ended_and_in_one_that_went_back() {
    let (mut stage, mut seen) = bench();
    frames(&mut stage, &mut seen, 8);
    assert!(seen.0.figures.ended && !seen.0.figures.playing, "it ended");
    let mut hand = Hand::default();
    hand.stand_still(true);
    hand.press(scope(&seen), at(&seen, -2.0, 0.0));
    let moved = hand.release(scope(&seen), at(&seen, -2.0, 1.0));
    assert_eq!((moved.edit, give(&mut stage, moved)), (Some("move"), None));
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "move"));
    let end = stage.history().world().time();
    stage.obey(Order::GoTo(0.5 * end, None));
    stage.show(&mut seen.0);
    hand.take(Tool::Erase);
    hand.press(scope(&seen), at(&seen, -2.0, 0.0));
    let deed = hand.release(scope(&seen), at(&seen, -2.0, 0.0));
    assert_eq!(give(&mut stage, deed), Some(Note::Branched), "what came after it can be gone back to");
    frames(&mut stage, &mut seen, 2);
    assert!(seen.0.scenery.gone.len() > 10 && stage.history().world().is_finite());
}
