//! A world with its past: undo, redo, going back and branches come to the same bits.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

use common::session::{Dice, play as play_at_random};
use wobble::history::{Autosave, Do, History, Left, Log, Start, hash_now, replay};
use wobble::scene::Scene;
use wobble::sim::{Cursor, MouseChange, PointId};

fn history(name: &str) -> History {
    History::new(Start::from(Scene::load(name).unwrap())).unwrap()
}

fn hash(history: &History) -> (String, u64) {
    (hash_now(history.world(), history.world().time()), history.world().time().to_bits())
}

fn cursor(x: f64, y: f64) -> Do {
    Do::Cursor { to: Some(Cursor::at([x, y])), by: None }
}

fn strength(strength: f64) -> Do {
    Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() })
}

/// Steps on, with a cursor that goes about.
fn play(history: &mut History, steps: usize) {
    for step in 0..steps {
        if step % 7 == 0 {
            let phase = step as f64 * 0.01;
            history.give(vec![cursor(phase.sin(), phase.cos())], None).unwrap();
        }
        history.step();
    }
}

#[test]
fn undo_goes_back_to_just_before_the_last_edit_and_redo_to_just_after_it() {
    let mut history = history("rim");
    play(&mut history, 300);
    let before = hash(&history);
    history.give(vec![strength(90.0)], Some("Stronger mouse")).unwrap();
    let after = hash(&history);
    play(&mut history, 200);
    let late = hash(&history);
    let undone = history.undo().unwrap();
    assert_eq!(undone.name, "Stronger mouse");
    assert!(undone.seconds < 0.0);
    assert_eq!(hash(&history), before);
    assert_eq!(history.undo(), None);
    let again = history.redo().unwrap();
    assert!(again.seconds == 0.0 && hash(&history) == after);
    assert_eq!(history.redo(), None);
    // What was undone is not done again by itself.
    history.undo().unwrap();
    play(&mut history, 200);
    assert_ne!(hash(&history), late);
}

#[test]
fn going_back_and_on_comes_to_the_same_bits() {
    let mut history = history("rim");
    let mut states = Vec::new();
    for _ in 0..40 {
        play(&mut history, 50);
        states.push(hash(&history));
    }
    let end = history.end();
    for &index in &[3, 38, 17, 0, 39] {
        let (_, bits) = states[index];
        history.go_to(f64::from_bits(bits));
        assert_eq!(hash(&history), states[index], "{index}");
        assert_eq!(history.end(), end);
    }
    history.go_to(0.5 * end);
    while history.world().time() < end {
        history.step();
    }
    assert_eq!(hash(&history), states[39]);
}

/// States on the way, by the bits of their times.
fn states_of(history: &mut History, dice: &mut Dice, seconds: f64) -> Vec<(String, u64)> {
    play_at_random(history, dice, seconds);
    let end = history.end();
    // Undoing on the way makes times go back: the branch that is left is what counts.
    history.go_to(end);
    let mut states = vec![hash(history)];
    for _ in 0..8 {
        history.go_to(dice.within(0.0, end));
        states.push(hash(history));
    }
    history.go_to(end);
    states
}

#[test]
fn random_sessions_replay_to_the_same_bits_from_the_start_and_from_keyframes() {
    for (seed, name) in ["rim", "spring-damper", "random-graph"].into_iter().enumerate() {
        let mut dice = Dice::new(seed as u64);
        let mut live = history(name);
        let states = states_of(&mut live, &mut dice, 1.5);
        assert!(live.take_refused().is_empty(), "{name}");
        let recording = live.recording();
        assert!(recording.commands.len() > 10, "{name}: {}", recording.commands.len());
        let mut text = Vec::new();
        recording.write_json(&mut text).unwrap();
        let log = Log::of_text(std::str::from_utf8(&text).unwrap(), name).unwrap();
        assert_eq!(log.count(), recording.commands.len());
        assert!(log.recording().unwrap().commands == recording.commands, "{name}");
        // From the file, without keyframes and without a window.
        let mut expected = states.clone();
        expected.sort_by(|a, b| f64::from_bits(a.1).total_cmp(&f64::from_bits(b.1)));
        let times: Vec<f64> = expected.iter().map(|state| f64::from_bits(state.1)).collect();
        let mut found = Vec::new();
        replay(log.head().unwrap(), &log, &times, &mut |run, time| {
            found.push((hash_now(run.world(), time), time.to_bits()));
            Ok(true)
        })
        .unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(found, expected, "{name}");
        for mark in &recording.marks {
            live.go_to(mark.at);
            assert_eq!(hash_now(live.world(), mark.at), mark.hash, "{name} at {}", mark.at);
        }
    }
}

#[test]
fn an_edit_is_what_has_a_name_and_a_drag_is_one() {
    let mut history = history("rim");
    play(&mut history, 20);
    let start = hash(&history);
    history.give(vec![strength(60.0)], Some("Drag")).unwrap();
    for step in 0..5 {
        play(&mut history, 10);
        history.give_on(vec![strength(61.0 + f64::from(step))], "Drag").unwrap();
    }
    play(&mut history, 10);
    let place = history.recording().commands.len();
    assert_eq!(history.undo().map(|undone| undone.name).as_deref(), Some("Drag"));
    assert_eq!(hash(&history), start);
    assert!(history.recording().commands.len() < place, "what is undone is not in the file");
    assert_eq!(history.redo().map(|undone| undone.name).as_deref(), Some("Drag"));
    assert_eq!(history.undo().map(|undone| undone.name).as_deref(), Some("Drag"));
    // Something new: what was undone is a branch that can be returned to.
    history.give(vec![strength(5.0)], Some("Other")).unwrap();
    assert_eq!(history.redo(), None);
    let branches = history.branches();
    assert_eq!(branches.len(), 2);
    let old = branches.iter().find(|branch| !branch.is_present).unwrap();
    assert_eq!(old.name, "Drag");
    history.to_branch(old.number);
    assert_eq!(history.recording().commands.len(), place);
    assert_eq!(history.world().time(), old.end);
}

#[test]
fn a_reset_is_undone_as_one() {
    let mut history = history("rim");
    play(&mut history, 100);
    history.give(vec![strength(50.0)], Some("Mouse")).unwrap();
    play(&mut history, 100);
    let late = hash(&history);
    history.reset();
    assert_eq!(history.world().time(), 0.0);
    play(&mut history, 30);
    let undone = history.undo().unwrap();
    assert_eq!((undone.name.as_str(), undone.seconds > 0.0), ("Reset", true));
    assert_eq!(hash(&history), late);
    assert_eq!(history.redo().unwrap().name, "Reset");
    assert_eq!(history.world().time(), 0.0);
    assert!(history.recording().commands.is_empty());
}

#[test]
fn commands_are_done_all_or_none_and_refused_with_number_and_reason() {
    let mut history = history("rim");
    play(&mut history, 10);
    let (before, count) = (hash(&history), history.recording().commands.len());
    let late = Do::Cursor { to: None, by: Some(0.0) };
    let refused = history.give(vec![cursor(1.0, 1.0), late], None).unwrap_err();
    assert_eq!(refused.number, 1);
    assert!(refused.to_string().contains("before its own time"), "{refused}");
    assert_eq!((hash(&history), history.recording().commands.len()), (before, count));
    assert_eq!(history.give(Vec::new(), Some("Nothing")), Ok(Vec::new()));
    assert!(history.undo().is_none() && history.redo().is_none());
}

#[test]
fn groups_are_the_historys_own_and_undone_like_the_rest() {
    let mut history = history("rim");
    let group = |points: &[u32]| Do::Group { points: points.iter().map(|&p| PointId(p)).collect(), name: "top".into() };
    history.give(vec![group(&[1, 2])], Some("Group")).unwrap();
    play(&mut history, 20);
    history.give(vec![group(&[3])], Some("Group")).unwrap();
    assert_eq!(history.groups().len(), 1);
    assert_eq!(history.groups()[0].points, [PointId(3)]);
    history.undo().unwrap();
    assert_eq!(history.groups()[0].points, [PointId(1), PointId(2)]);
    history.undo().unwrap();
    assert!(history.groups().is_empty());
    assert!(history.give(vec![group(&[99])], Some("Group")).unwrap_err().reason.contains("no point 99"));
}

#[test]
fn keyframes_stay_within_their_bytes_and_going_back_stays_exact() {
    let mut history = history("rim");
    let each = history.keyframe_bytes();
    history.bound_keyframes(8 * each);
    let mut states = Vec::new();
    for _ in 0..12 {
        play(&mut history, 1500);
        states.push(hash(&history));
        assert!(history.keyframe_bytes() <= 8 * each + each / 2);
    }
    let (time, _) = history.nearest(f64::from_bits(states[5].1)).unwrap();
    assert!(time <= f64::from_bits(states[5].1));
    for index in [10, 2, 11, 6] {
        history.go_to(f64::from_bits(states[index].1));
        assert_eq!(hash(&history), states[index], "{index}");
    }
}

#[test]
fn what_was_left_behind_is_found_and_what_goes_on_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let mut history = history("rim");
    let mut saved = Autosave::begin(folder.path()).unwrap();
    assert!(saved.tick(0.0, &history).unwrap());
    play(&mut history, 200);
    assert!(!saved.tick(1.9, &history).unwrap() && saved.tick(2.1, &history).unwrap());
    history.give(vec![strength(50.0)], Some("Mouse")).unwrap();
    play(&mut history, 100);
    saved.tick(4.2, &history).unwrap();
    assert!(Autosave::left(folder.path()).is_empty(), "its program still runs");
    let (path, whole) = (saved.path().to_owned(), hash(&history));
    let other = Autosave::begin(folder.path()).unwrap();
    // The program is killed: its lock is free, its file stays.
    drop(saved);
    let mut left = Autosave::left(folder.path());
    assert_eq!(left.iter().map(|left| left.path()).collect::<Vec<_>>(), [&path]);
    let again = |left: &Left| {
        let mut again = History::new(left.start().unwrap()).unwrap();
        again.go_to(again.end());
        again
    };
    assert_eq!(hash(&again(&left[0])), whole);
    // In the middle of a write.
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() - 40]).unwrap();
    let commands = again(&left[0]).recording().commands.len();
    assert!(commands > 10 && commands <= history.recording().commands.len());
    left.pop().unwrap().discard().unwrap();
    assert!(Autosave::left(folder.path()).is_empty());
    other.end().unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_disk_that_cannot_be_written_is_a_note_and_what_was_undone_is_not_saved() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("state");
    let mut history = history("rim");
    let mut saved = Autosave::begin(&inner).unwrap();
    play(&mut history, 50);
    history.give(vec![strength(50.0)], Some("Mouse")).unwrap();
    saved.write(&history).unwrap();
    history.undo().unwrap();
    saved.write(&history).unwrap();
    let log = Log::open(saved.path()).unwrap();
    assert_eq!(log.count(), history.recording().commands.len());
    std::fs::remove_dir_all(&inner).unwrap();
    history.give(vec![strength(60.0)], Some("Mouse")).unwrap();
    assert!(saved.write(&history).is_err());
    std::fs::create_dir(&inner).unwrap();
    saved.write(&history).unwrap();
    assert!(Log::open(saved.path()).unwrap().recording().unwrap().commands == history.recording().commands);
}

/// Positions and velocities now.
fn motion(history: &History) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let sample = history.world().sample(history.world().time());
    (sample.position, sample.velocity)
}

#[test]
fn a_snapshot_goes_on_from_its_state_the_same_way_every_time() {
    for name in ["rim", "spring-damper", "points"] {
        let mut live = history(name);
        play_at_random(&mut live, &mut Dice::new(3), 1.0);
        live.give(vec![Do::Group { points: vec![PointId(0)], name: "first".into() }], Some("Group")).unwrap();
        let mut text = Vec::new();
        live.snapshot().unwrap().write_json(&mut text).unwrap();
        let log = Log::of_text(std::str::from_utf8(&text).unwrap(), name).unwrap();
        let open = || History::new(Start::from(log.recording().unwrap())).unwrap();
        let mut first = open();
        assert_eq!(first.world().time().to_bits(), live.world().time().to_bits());
        // What is not a number is of points that are gone.
        assert_eq!(format!("{:?}", motion(&first)), format!("{:?}", motion(&live)), "{name}");
        assert_eq!(first.groups(), live.groups());
        let mut second = open();
        play(&mut first, 300);
        play(&mut second, 300);
        assert_eq!(hash(&first), hash(&second), "{name}");
        // A session that began with a state is a recording like any other.
        first.give(vec![strength(33.0)], Some("Mouse")).ok();
        play(&mut first, 100);
        let (late, made) = (hash(&first), first.recording());
        let mut again = History::new(Start::from(made)).unwrap();
        again.go_to(f64::from_bits(late.1));
        assert_eq!(hash(&again), late, "{name}");
    }
}

#[test]
fn a_damaged_state_is_refused() {
    let mut live = history("rim");
    play(&mut live, 100);
    let whole = live.snapshot().unwrap();
    let state = whole.state.clone().unwrap();
    let data = state["data"].as_str().unwrap();
    let mut dice = Dice::new(5);
    for _ in 0..200 {
        let mut bytes = data.as_bytes().to_vec();
        let at = dice.below(bytes.len() as u64) as usize;
        if dice.below(2) == 0 {
            bytes.truncate(at)
        } else {
            bytes[at] = b'A' + (dice.below(26) as u8)
        }
        let mut damaged = whole.clone();
        damaged.state = Some(serde_json::json!({ "layout": 1, "data": String::from_utf8(bytes).unwrap() }));
        // Whatever is damaged is noticed by the sum of the compressed bytes.
        let opened = History::new(Start::from(damaged.clone()));
        assert!(opened.is_err() || damaged.state.unwrap()["data"] == state["data"]);
    }
}
