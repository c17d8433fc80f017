//! Time without a window: a clock that is nobody's, a history, and what comes of both.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::{Keeping, Note, Order, Pace, Player, Shown, Stage};
use crate::history::{Clock, Do, History, Recording};
use crate::scene::Scene;
use crate::sim::{Cursor, MouseChange, PointId, Reach};

/// Loose points and a soft disc between walls, in substeps of 1/700 s.
const SCENE: &str = r#"{
    "wobble": 1, "name": "test",
    "points": { "position": [[0, 1], [0.5, 2]], "velocity": [[1, 0], [0, 3]] },
    "gravity": [0, -9.81],
    "mouse": { "strength": 20, "radius": 1 },
    "bounds": { "min": [-5, -5], "max": [5, 5], "restitution": 0.3, "friction": 0.4 },
    "method": { "substep": 0.00142857142857142857 }
}"#;

pub(super) fn scene() -> Scene {
    Scene::parse(SCENE, "test.json").unwrap()
}

fn played() -> (History, Pace) {
    let history = History::new(scene().into()).unwrap();
    let pace = Pace::new(&history, 1.0, None);
    (history, pace)
}

/// Plays `seconds` at a frame rate while the cursor is where `path` says.
fn play(
    (history, pace): &mut (History, Pace),
    seconds: f64,
    frame_rate: u32,
    path: impl Fn(f64) -> Option<Cursor>,
) -> u32 {
    let frames = (seconds * f64::from(frame_rate)).round() as u32;
    let wall = 1.0 / f64::from(frame_rate);
    (1..=frames).map(|frame| pace.advance(history, wall, path(f64::from(frame) * wall), || 0.0)).sum()
}

pub(super) fn strength(strength: f64) -> Do {
    Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() })
}

fn away(_: f64) -> Option<Cursor> {
    None
}

fn positions(history: &History) -> Vec<f64> {
    let x = history.world().positions();
    (0..x.len()).map(|k| x.get(k)).collect()
}

#[test]
fn the_motion_is_the_same_at_30_60_and_144_hz() {
    let run = |frame_rate| {
        let mut played = played();
        assert_eq!(play(&mut played, 2.0, frame_rate, away), 1400, "{frame_rate} Hz");
        positions(&played.0)
    };
    let first = run(30);
    assert_eq!(first, run(60));
    assert_eq!(first, run(144));
}

#[test]
fn under_a_cursor_in_even_motion_too_to_rounding() {
    // Through both points as they fall; it is where the first frame of all rates has it.
    let path = |t: f64| Some(Cursor::at([-2.0 + 3.0 * t, 1.2 - 0.5 * t]));
    let run = |frame_rate| {
        let mut played = played();
        let start = Do::Cursor { to: path(0.0), by: None };
        played.0.give(vec![start], None).unwrap();
        play(&mut played, 1.5, frame_rate, path);
        (positions(&played.0), played.0.world().counters().mouse_points)
    };
    let (still, pushed) = (
        positions(&{
            let mut played = played();
            play(&mut played, 1.5, 60, away);
            played.0
        }),
        run(60),
    );
    assert!(pushed.1 > 0);
    let differs = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(differs(&still, &pushed.0) > 0.01, "the push is felt");
    for frame_rate in [30, 144] {
        let other = run(frame_rate);
        assert!(differs(&other.0, &pushed.0) < 1e-9, "{frame_rate} Hz: {}", differs(&other.0, &pushed.0));
    }
}

#[test]
fn a_run_by_hand_is_replayed_to_the_bit() {
    let mut played = played();
    let path = |t: f64| Some(Cursor::at([(7.0 * t).sin(), 1.0 + (5.0 * t).cos()]));
    play(&mut played, 0.5, 60, path);
    let grab = vec![strength(0.0), Do::Grab(Reach::Points(vec![PointId(0)]))];
    played.0.give(grab, None).unwrap();
    play(&mut played, 0.5, 144, path);
    played.0.give(vec![Do::Release, strength(20.0)], None).unwrap();
    play(&mut played, 0.5, 30, path);
    let (history, _) = &played;
    let mut again = History::new(history.recording().into()).unwrap();
    while again.world().time() < history.world().time() - 1e-9 {
        again.step();
    }
    assert_eq!(positions(&again), positions(history));
}

#[test]
fn what_is_drawn_lies_between_the_last_two_states() {
    let (mut history, mut pace) = played();
    pace.advance(&mut history, 1.5 / 700.0, None, || 0.0);
    assert_eq!(pace.previous.view().get(0), 0.0);
    assert!((pace.mix(history.world()) - 0.5).abs() < 1e-6);
    assert!(history.world().positions().get(0) > 0.0);
}

#[test]
fn a_long_hitch_is_clamped_and_a_slow_world_drops_time() {
    let (mut history, mut pace) = played();
    assert_eq!(pace.advance(&mut history, 60.0, None, || 0.0), 70);
    assert_eq!(pace.advance(&mut history, 0.1, None, || 1.0), 1, "the budget is spent after one substep");
    assert_eq!(pace.advance(&mut history, 0.0, None, || 0.0), 0, "and the rest is not owed");
}

#[test]
fn a_flick_through_the_rim_at_five_metres_a_second_moves_it() {
    let entry = crate::scene::gallery().iter().find(|entry| entry.name == "rim").unwrap();
    let history = History::new(entry.scene().unwrap().into()).unwrap();
    let pace = Pace::new(&history, 1.0, None);
    let mut played = (history, pace);
    let middle = |history: &History| {
        let x = positions(history);
        x.iter().step_by(2).sum::<f64>() / (x.len() / 2) as f64
    };
    play(&mut played, 0.5, 60, away);
    let before = middle(&played.0);
    let height = positions(&played.0).iter().skip(1).step_by(2).sum::<f64>() / played.0.world().point_count() as f64;
    let flick = |t: f64| Some(Cursor::at([-4.0 + 5.0 * t, height]));
    play(&mut played, 1.0, 60, flick);
    let moved = (middle(&played.0) - before).abs();
    assert!(moved > 0.5, "a quarter of its radius is seen: {moved} m");
}

#[test]
fn paused_nothing_is_stepped() {
    let (mut history, mut pace) = played();
    pace.playing = false;
    assert_eq!(pace.advance(&mut history, 1.0, Some(Cursor::at([0.0, 1.0])), || 0.0), 0);
    assert_eq!(history.world().time(), 0.0);
    assert_eq!(pace.step(&mut history, None), 12, "1/60 s in substeps of 1/700 s");
}

#[test]
fn a_cursor_at_rest_gives_no_commands_and_a_far_one_costs_nothing() {
    let mut played = played();
    let at = |_: f64| Some(Cursor::at([100.0, 100.0]));
    play(&mut played, 0.2, 60, at);
    assert_eq!(played.0.recording().commands.len(), 1, "it is told once where it is");
    assert_eq!(played.0.world().counters().mouse_points, 0);
}

#[test]
fn a_scene_with_a_duration_stops_there_and_can_go_on() {
    let history = History::new(scene().into()).unwrap();
    let pace = Pace::new(&history, 1.0, Some(0.5));
    let mut played = (history, pace);
    assert_eq!(play(&mut played, 1.0, 60, away), 350);
    assert!(!played.1.playing && played.1.ended);
    played.1.playing = true;
    assert_eq!(play(&mut played, 0.5, 60, away), 350);
    played.1.reset_while(&mut played.0, |_| true).unwrap();
    assert_eq!(played.0.world().time(), 0.0);
    assert_eq!(play(&mut played, 1.0, 60, away), 350, "it plays again from the start, to its end");
    played.1.reset_while(&mut played.0, |_| true).unwrap();
    assert!(played.1.playing, "and does not wait at 0");
    play(&mut played, 0.3, 60, away);
    played.1.playing = false;
    played.1.follow(Clock { rate: 1.0, duration: Some(0.5) }, Clock { rate: 1.0, duration: Some(0.2) });
    played.1.reset_while(&mut played.0, |_| true).unwrap();
    assert!(played.1.playing, "so it does where it was paused past an end that came later");
}

/// The strength of the hover force of what is shown.
fn force(stage: &Stage) -> f64 {
    stage.history().world().mouse().unwrap().0.strength
}

#[test]
fn undo_takes_an_edit_back_and_plays_on() {
    let mut stage = Stage::new(scene().into()).unwrap();
    let frames = |stage: &mut Stage, count: u32| {
        for _ in 0..count {
            stage.obey(Order::Advance { wall: 0.1, cursor: Some(Cursor::at([9.0, 9.0])), back: false });
        }
    };
    frames(&mut stage, 3);
    let before = stage.history().world().time();
    stage.obey(Order::Give(vec![strength(7.0)], Some("calm")));
    frames(&mut stage, 2);
    assert_eq!(force(&stage), 7.0);
    let Some(Note::Undone(name, seconds)) = stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    assert_eq!(name, "calm");
    assert!((0.001..0.25).contains(&seconds.abs()), "{seconds}");
    assert_eq!(stage.history().world().time(), before);
    frames(&mut stage, 2);
    assert_eq!(force(&stage), 20.0, "what was undone does not come back by itself");
    assert!(stage.history().world().time() > before, "and it plays on");
    assert!(matches!(stage.obey(Order::Redo(None)), Some(Note::Redone(..))));
    assert_eq!(force(&stage), 7.0);
}

#[test]
fn what_was_erased_comes_back_to_where_it_was_and_no_cursor_of_the_log_pushes_it() {
    let text = SCENE.replace("[0, -9.81]", "[0, 0]").replace("[[1, 0], [0, 3]]", "[[0, 0], [0, 0]]");
    let mut stage = Stage::new(Scene::parse(&text, "still.json").unwrap().into()).unwrap();
    let (far, over) = (Some(Cursor::at([4.0, -4.0])), Some(Cursor::at([0.2, 1.0])));
    let frame = |stage: &mut Stage, cursor| {
        stage.obey(Order::Advance { wall: 0.02, cursor, back: false });
    };
    frame(&mut stage, far);
    let before = positions(stage.history());
    let keys = crate::history::DeleteKeys { points: vec![0], ..Default::default() };
    // The click comes with the cursor, as it does where both lie in one frame.
    let click = vec![Do::Cursor { to: over, by: None }];
    stage.obey(Order::Give(click, None));
    stage.obey(Order::Give(vec![Do::Delete(keys)], Some("delete")));
    frame(&mut stage, far);
    assert!(matches!(stage.obey(Order::Undo(far)), Some(Note::Undone(..))));
    for _ in 0..5 {
        frame(&mut stage, far);
    }
    assert_eq!(positions(stage.history()), before, "nothing but a cursor that is there pushes");
}

#[test]
fn a_cursor_that_jumps_goes_through_no_body() {
    let text = SCENE.replace("[0, -9.81]", "[0, 0]").replace("[[1, 0], [0, 3]]", "[[0, 0], [0, 0]]");
    let still = Scene::parse(&text, "still.json").unwrap();
    let after = |jumps: bool| {
        let mut stage = Stage::new(still.clone().into()).unwrap();
        for (x, frames) in [(-4.0, 3), (4.0, 3)] {
            if jumps {
                stage.obey(Order::Jump);
            }
            let cursor = Some(Cursor::at([x, 1.0]));
            (0..frames).for_each(|_| _ = stage.obey(Order::Advance { wall: 0.05, cursor, back: false }));
        }
        positions(stage.history())
    };
    let start = positions(Stage::new(still.clone().into()).unwrap().history());
    assert_ne!(after(false), start, "its way led through a point");
    assert_eq!(after(true), start);
}

#[test]
fn time_runs_back_to_states_that_were_seen() {
    let mut played = played();
    play(&mut played, 0.5, 60, away);
    let (history, pace) = &mut played;
    let seen = positions(history);
    let time = history.world().time();
    pace.advance(history, 0.05, None, || 0.0);
    pace.rewind(history, 0.05, None);
    assert!((history.world().time() - time).abs() < 1e-9, "{}", history.world().time());
    assert_eq!(positions(history), seen);
}

pub(super) fn wait_for(player: &mut Player, mut is_so: impl FnMut(&Player) -> bool) {
    let start = Instant::now();
    while !is_so(player) {
        player.poll();
        assert!(start.elapsed() < Duration::from_secs(20), "it never comes");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_player_steps_beside_and_answers() {
    let mut player = Player::open(scene().into(), Keeping::default(), || {});
    wait_for(&mut player, Player::is_open);
    for _ in 0..5 {
        player.advance(0.1, None, false);
        wait_for(&mut player, |player| !player.is_busy() && player.shown().figures.time > 0.0);
    }
    assert_eq!(player.advances(), 5);
    player.play(false);
    assert!(!player.is_playing(), "at once");
    wait_for(&mut player, |player| !player.shown().figures.playing);
    player.ask(Order::Reset);
    wait_for(&mut player, |player| player.shown().figures.time == 0.0);
}

#[test]
fn what_was_refused_is_no_work_to_be_saved() {
    let mut player = Player::open(scene().into(), Keeping::default(), || {});
    wait_for(&mut player, Player::is_open);
    player.ask(Order::Add(Box::new(|_| Err("no room".to_owned()))));
    player.give(vec![Do::Pin(vec![PointId(1 << 20)])], Some("pin"));
    assert!(player.is_unsaved(), "until it is known");
    wait_for(&mut player, |player| !player.is_busy() && player.waiting_since.is_none());
    assert!(!player.is_unsaved(), "both were refused");
    player.give(vec![Do::Pin(vec![PointId(0)])], Some("pin"));
    wait_for(&mut player, |player| player.waiting_since.is_none());
    assert!(player.is_unsaved());
    let folder = tempfile::tempdir().unwrap();
    player.ask(Order::Save(folder.path().join("x.json")));
    player.give(vec![Do::Unpin(vec![PointId(0)])], Some("unpin"));
    wait_for(&mut player, |player| player.waiting_since.is_none());
    player.note_saved();
    assert!(player.is_unsaved(), "what came after the file was asked for");
    assert_eq!(player.called(), None);
    player.call(&folder.path().join("swing.json"));
    assert_eq!(player.called(), Some("swing"));
    assert_eq!(player.file(), None, "a recording may be called so");
    let file = folder.path().join("swing.json");
    player.lie_in(&file);
    player.lie_in(&folder.path().join("swing.jsonl"));
    player.lie_in(&folder.path().join("swing.png"));
    assert_eq!(player.file(), Some(&*file), "what is no scene is not written over");
}

#[test]
fn asking_never_waits_for_a_step() {
    // A hundred frames of work lie before what is asked: nothing here waits for them.
    let text = SCENE.replace("0.00142857142857142857", "0.000001");
    let mut player = Player::open(Scene::parse(&text, "slow.json").unwrap().into(), Keeping::default(), || {});
    wait_for(&mut player, Player::is_open);
    let start = Instant::now();
    for _ in 0..100 {
        player.advance(0.1, None, false);
        player.poll();
    }
    player.play(false);
    player.poll();
    assert!(start.elapsed() < Duration::from_millis(100), "{:?}", start.elapsed());
    wait_for(&mut player, |player| !player.shown().figures.playing);
    assert!(player.shown().figures.time < 1.0, "what could not be done in time is dropped");
}

#[test]
fn what_was_led_is_let_go_where_one_goes_back_and_on_another_way() {
    let mut played = played();
    let path = |t: f64| Some(Cursor::at([t.sin(), 1.0]));
    play(&mut played, 0.1, 60, path);
    played.0.give(vec![Do::Grab(Reach::Points(vec![PointId(0)]))], None).unwrap();
    play(&mut played, 0.4, 60, path);
    played.0.give(vec![Do::Release], None).unwrap();
    play(&mut played, 0.1, 60, path);
    let (history, pace) = &mut played;
    pace.go_to(history, 0.3, Some(Cursor::at([0.0, 1.0])));
    assert!(history.world().grab().is_some(), "it is led there");
    pace.presses = true;
    pace.advance(history, 0.02, Some(Cursor::at([3.0, 3.0])), || 0.0);
    assert!(history.world().grab().is_none(), "but not by a cursor that never took it");
}

#[test]
fn pins_are_shown_in_ascending_order_however_they_came() {
    let mut stage = Stage::new(scene().into()).unwrap();
    for point in [1, 0] {
        stage.obey(Order::Give(vec![Do::Pin(vec![PointId(point)])], Some("pin")));
    }
    assert_eq!(stage.history().world().pinned(), [PointId(1), PointId(0)]);
    let mut shown = Shown::default();
    stage.show(&mut shown);
    assert_eq!(shown.scenery.pinned, [PointId(0), PointId(1)]);
}

#[test]
fn what_is_worked_out_anew_tells_how_far_it_is_and_goes_no_further_than_it_is_wanted() {
    let mut stage = Stage::new(scene().into()).unwrap();
    (0..30).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    let before = (stage.history().world().time(), positions(stage.history()));
    let folded = stage.folded();
    let mut told = Vec::new();
    let unfolded = Stage::unfolded(&folded, |share| {
        told.push(share);
        share < 0.5
    });
    assert!(unfolded.unwrap().is_none() && told.len() > 100, "{} of 350 steps", told.len());
    assert!((told[told.len() - 1] - 0.5).abs() < 0.01, "{told:?}");
    told.clear();
    let whole = Stage::unfolded(&folded, |share| {
        told.push(share);
        true
    });
    let whole = whole.unwrap().unwrap();
    assert_eq!((whole.history().world().time(), positions(whole.history())), before);
    assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
}

#[test]
fn what_was_laid_down_before_it_was_folded_is_not_shown_as_if_it_were_there_again() {
    let mut player = Player::open(scene().into(), Keeping::default(), || {});
    assert!(player.wait_until_open(Duration::from_secs(20)).opened.is_some());
    player.fold();
    let desk = Arc::clone(&player.desk);
    let serial = player.serial();
    drop(desk.wait_for(serial, Duration::from_secs(20)));
    // As one that came between the order and its being done.
    desk.lock().fresh = Some(Box::new(Shown { dimensions: 2, serial: serial - 1, ..Shown::default() }));
    assert!(!player.poll().is_new && !player.is_open());
    player.play(false);
    assert!(player.is_unfolding());
    assert!(player.wait_until_open(Duration::from_secs(20)).opened.is_some());
}

/// A history whose recording takes long to be gone through: so many seconds, of which nothing is worked out.
fn unseen(seconds: f64) -> Player {
    let text = SCENE.replace("0.00142857142857142857", "0.00002");
    let recording: Recording = Scene::parse(&text, "slow.json").unwrap().into();
    let start = Recording { end: Some(seconds), paused: true, ..recording };
    let mut player = Player::open(start.into(), Keeping::default(), || {});
    assert!(player.wait_until_open(Duration::from_secs(20)).opened.is_some());
    player
}

#[test]
fn a_time_that_takes_long_says_how_far_it_is_and_is_given_up_without_a_loss() {
    let mut player = unseen(1e4);
    player.ask(Order::GoTo(1e4, None));
    let going = player.going().unwrap();
    assert_eq!((going.words.as_str(), going.to), ("Going to 10000.0 s", Some(1e4)));
    wait_for(&mut player, |player| player.worked_out() > 0.0);
    player.stay();
    let mut notes = Vec::new();
    let start = Instant::now();
    while player.going().is_some() {
        notes.extend(player.poll().notes);
        assert!(start.elapsed() < Duration::from_secs(20), "it goes on");
    }
    notes.extend(player.poll().notes);
    assert_eq!(notes, [Note::GivenUp]);
    assert_eq!(player.shown().figures.time, 0.0);
    player.ask(Order::GoTo(0.01, None));
    wait_for(&mut player, |player| player.shown().figures.time > 0.009);
}

#[test]
fn of_times_that_are_passed_the_last_one_is_worked_out_unless_something_was_done_between() {
    let mut player = unseen(1e4);
    for time in [1e4, 9e3, 0.01] {
        player.ask(Order::GoTo(time, None));
    }
    assert_eq!(player.going().unwrap().to, Some(0.01));
    wait_for(&mut player, |player| player.shown().figures.time > 0.009);
    assert!(player.poll().notes.is_empty(), "nobody gave it up");
    player.ask(Order::GoTo(0.2, None));
    player.give(vec![Do::Pin(vec![PointId(0)])], Some("pin"));
    player.ask(Order::GoTo(0.1, None));
    wait_for(&mut player, |player| player.going().is_none());
    wait_for(&mut player, |player| (player.shown().figures.time - 0.1).abs() < 1e-3);
    assert!(
        (player.shown().figures.end - 0.2).abs() < 1e-3,
        "the edit was given at 0.2 s: {}",
        player.shown().figures.end
    );
}

#[test]
fn undo_of_what_is_worked_out_again_has_one_share_with_it() {
    let mut player = unseen(0.4);
    player.ask(Order::GoTo(0.4, None));
    player.give(vec![Do::Pin(vec![PointId(0)])], Some("pin"));
    wait_for(&mut player, |player| player.waiting_since.is_none());
    player.fold();
    player.ask(Order::Undo(None));
    let mut told = Vec::new();
    wait_for(&mut player, |player| {
        told.push(player.worked_out());
        player.is_open()
    });
    // Until it begins there is what was told of the last one.
    let first = told.iter().position(|share| *share < 0.5).unwrap();
    assert!(told[first..].is_sorted() && told.len() > 5, "{told:?}");
}
