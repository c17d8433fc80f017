//! Who leads: the hand, or the log of what was done before.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::tests::{scene, strength};
use super::{Note, Order, Pace, Shown, Stage};
use crate::history::{DeleteKeys, Do, History, Start};
use crate::scene::{Vector, ViewKeys};
use crate::sim::{Cursor, PointId, Reach};

fn at(x: f64, y: f64) -> Option<Cursor> {
    Some(Cursor::at([x, y]))
}

/// Frames of a tenth of a second with a cursor.
fn frames(stage: &mut Stage, count: u32, cursor: Option<Cursor>) -> Vec<Note> {
    (0..count).filter_map(|_| stage.obey(Order::Advance { wall: 0.1, cursor, back: false })).collect()
}

fn grab() -> Vec<Do> {
    vec![Do::Cursor { to: at(0.5, 1.5), by: None }, strength(0.0), Do::Grab(Reach::Points(vec![PointId(0)]))]
}

fn shown(stage: &mut Stage) -> Shown {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    shown
}

/// The strength of the hover force.
fn force(stage: &Stage) -> f64 {
    stage.history().world().mouse().unwrap().0.strength
}

/// A second in which the cursor goes about and one point is pulled along, to be followed.
fn recorded() -> Start {
    let mut history = History::new(scene().into()).unwrap();
    let mut pace = Pace::new(&history, 1.0, None);
    let mut go = |history: &mut History, frames: u32, cursor| {
        (0..frames).for_each(|_| assert!(pace.advance(history, 0.1, cursor, || 0.0) > 0));
    };
    go(&mut history, 3, at(-1.0, 1.0));
    history.give(grab(), None).unwrap();
    go(&mut history, 4, at(2.0, 2.0));
    history.give(vec![Do::Release, strength(20.0)], None).unwrap();
    go(&mut history, 3, at(-2.0, 2.0));
    history.recording().into()
}

/// Whether a stage is where the log alone leads to.
fn is_as_recorded(stage: &Stage, start: &Start) -> bool {
    let mut alone = History::new(start.clone()).unwrap();
    while alone.world().time() < stage.history().world().time() {
        alone.step();
    }
    positions(&alone) == positions(stage.history())
}

fn positions(history: &History) -> Vec<f64> {
    let x = history.world().positions();
    (0..x.len()).map(|k| x.get(k)).collect()
}

#[test]
fn a_recording_is_followed_whatever_the_pointer_does_until_it_presses() {
    let start = recorded();
    let mut beside = Stage::new(start.clone()).unwrap();
    for frame in 0..6 {
        assert!(frames(&mut beside, 1, at(0.3 * f64::from(frame), 1.0)).is_empty());
    }
    assert!(is_as_recorded(&beside, &start));
    assert!(shown(&mut beside).figures.follows);
    beside.obey(Order::Press(true));
    assert_eq!(frames(&mut beside, 2, at(3.0, 1.0)), [Note::Branched], "it is said once");
    let shown = shown(&mut beside);
    assert!(!shown.figures.follows && shown.figures.branches.len() == 2, "and can be returned to");
    beside.obey(Order::ToBranch(0, None));
    beside.obey(Order::Press(false));
    beside.obey(Order::GoTo(0.0, None));
    frames(&mut beside, 8, at(0.0, 0.0));
    assert!(is_as_recorded(&beside, &start));
}

#[test]
fn an_edit_leaves_the_recording_too() {
    let mut stage = Stage::new(recorded()).unwrap();
    frames(&mut stage, 2, at(0.0, 0.0));
    let note = stage.obey(Order::Give(vec![Do::Pin(vec![PointId(1)])], Some("pin")));
    assert_eq!(note, Some(Note::Branched));
}

#[test]
fn a_grab_that_is_undone_into_is_let_go_and_the_push_comes_back() {
    let mut stage = Stage::new(scene().into()).unwrap();
    frames(&mut stage, 2, at(0.0, 1.0));
    stage.obey(Order::Give(grab(), None));
    frames(&mut stage, 2, at(1.0, 1.0));
    let gone = Do::Delete(DeleteKeys { points: vec![0], ..DeleteKeys::default() });
    stage.obey(Order::Give(vec![gone], Some("delete")));
    stage.obey(Order::Give(vec![strength(20.0)], None));
    frames(&mut stage, 2, at(1.0, 1.0));
    assert!(matches!(stage.obey(Order::Undo(at(1.0, 1.0))), Some(Note::Undone(..))));
    assert!(stage.history().world().grab().is_some(), "as it was then");
    frames(&mut stage, 1, at(1.0, 1.0));
    assert!(stage.history().world().grab().is_none(), "though the pointer rests");
    assert_eq!(force(&stage), 20.0);
    assert!(matches!(stage.obey(Order::Redo(None)), Some(Note::Redone(..))), "what was undone can be done again");
}

#[test]
fn a_grab_right_after_undo_is_the_hands_own() {
    let mut stage = Stage::new(scene().into()).unwrap();
    stage.obey(Order::Give(vec![Do::Pin(vec![PointId(1)])], Some("pin")));
    stage.obey(Order::Undo(None));
    stage.obey(Order::Give(grab(), None));
    frames(&mut stage, 2, at(1.0, 1.0));
    assert!(stage.history().world().grab().is_some());
    assert_eq!((force(&stage), shown(&mut stage).base), (0.0, Some(20.0)));
}

#[test]
fn what_is_opened_in_the_middle_of_a_grab_is_let_go_and_pushes_again() {
    let mut stage = Stage::new(scene().into()).unwrap();
    frames(&mut stage, 2, at(0.0, 1.0));
    stage.obey(Order::Give(grab(), None));
    frames(&mut stage, 2, at(1.0, 1.0));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("held.png");
    let view = ViewKeys { center: Some(Vector::Plane([3.0, 4.0])), height: Some(5.0), ..ViewKeys::default() };
    stage.obey(Order::Look(view.clone()));
    let recording = folder.path().join("all.json");
    stage.obey(Order::Save(recording.clone()));
    let moment = folder.path().join("moment.json");
    assert_eq!(stage.obey(Order::Moment(moment.clone())), Some(Note::Written(moment.clone())));
    stage.obey(Order::Picture(path.clone(), Box::new(image::RgbaImage::new(4, 4))));
    let snapshot = stage.history().snapshot().unwrap().into();
    let begins = Start::load(moment.to_str().unwrap()).unwrap();
    let (now, then) = (stage.history().world().sample(0.0), Stage::new(begins.clone()).unwrap());
    assert_eq!(then.history().world().sample(0.0).position, now.position, "a moment goes on from where it was");
    assert!(
        begins.recording().commands.iter().all(|entry| entry.at == stage.history().world().time()),
        "without a past"
    );
    assert!(!begins.is_replayed(), "what it lets go of is no motion that was recorded");
    assert!(Start::load(recording.to_str().unwrap()).unwrap().is_replayed());
    for file in [&path, &recording, &moment] {
        let start = Start::load(file.to_str().unwrap()).unwrap();
        assert_eq!(start.recording().view.as_ref(), Some(&view), "the camera is where it was");
    }
    for start in [Start::load(path.to_str().unwrap()).unwrap(), stage.history().recording().into(), snapshot] {
        let mut opened = Stage::new(start).unwrap();
        assert_eq!(shown(&mut opened).base, Some(20.0), "never the faded one");
        while shown(&mut opened).figures.follows {
            frames(&mut opened, 1, at(1.0, 1.0));
        }
        frames(&mut opened, 2, at(1.0, 1.0));
        assert!(opened.history().world().grab().is_none());
        assert_eq!(force(&opened), 20.0);
    }
}

#[test]
fn what_was_saved_while_it_was_paused_opens_paused_and_plays_on_when_asked() {
    let mut stage = Stage::new(scene().into()).unwrap();
    frames(&mut stage, 2, None);
    let folder = tempfile::tempdir().unwrap();
    let [played, paused, picture, all] = ["a.json", "b.json", "c.png", "d.json"].map(|name| folder.path().join(name));
    stage.obey(Order::Moment(played.clone()));
    stage.obey(Order::Play(false));
    stage.obey(Order::Moment(paused.clone()));
    stage.obey(Order::Picture(picture.clone(), Box::new(image::RgbaImage::new(4, 4))));
    stage.obey(Order::Save(all.clone()));
    let opened = |path: &std::path::Path| Stage::new(Start::load(path.to_str().unwrap()).unwrap()).unwrap();
    for (path, plays) in [(&played, true), (&paused, false), (&picture, false), (&all, true)] {
        assert_eq!(shown(&mut opened(path)).figures.playing, plays, "{}", path.display());
    }
    let mut again = opened(&paused);
    let time = again.history().world().time();
    frames(&mut again, 2, None);
    assert_eq!(again.history().world().time(), time, "it stands");
    again.obey(Order::Play(true));
    frames(&mut again, 2, None);
    assert!(again.history().world().time() > time);
}

#[test]
fn after_going_back_the_cursor_is_where_it_moves_to_at_once() {
    let mut stage = Stage::new(scene().into()).unwrap();
    frames(&mut stage, 3, at(-2.0, 1.0));
    stage.obey(Order::Give(vec![Do::Pin(vec![PointId(1)])], Some("pin")));
    frames(&mut stage, 2, at(2.0, 1.0));
    stage.obey(Order::Undo(at(2.0, 1.0)));
    frames(&mut stage, 1, at(2.1, 1.0));
    let last = stage.history().recording().commands.pop().unwrap();
    assert_eq!(last.act, Do::Cursor { to: at(2.1, 1.0), by: None }, "it does not sweep over the scene");
    frames(&mut stage, 1, at(2.2, 1.0));
    let last = stage.history().recording().commands.pop().unwrap();
    assert!(matches!(last.act, Do::Cursor { by: Some(_), .. }));
}
