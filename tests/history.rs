//! A world with its past: undo, redo, going back and branches come to the same bits.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod autosave;
mod beside;
use crate::common;
mod corrected;
mod keyframes;

use common::session::{Dice, play as play_at_random};
use wobble::history::{DeleteKeys, Do, GoneBack, History, Log, OneOrEach, Recording, SetKeys, Start, hash_now, replay};
use wobble::scene::{AddKeys, KindName, Scene, Vector};
use wobble::sim::{BondId, Contact, Cursor, MouseChange, PointId, Reach};

fn history(name: &str) -> History {
    History::new(Start::from(Scene::load(name).unwrap())).unwrap()
}

fn hash(history: &History) -> (String, u64) {
    (hash_now(history.world(), history.world().time()), history.world().time().to_bits())
}

/// A recording as its file is read.
fn as_log(recording: &Recording) -> Log {
    let mut text = Vec::new();
    recording.write_json(&mut text).unwrap();
    Log::of_text(std::str::from_utf8(&text).unwrap(), "x").unwrap()
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
    let ways = |history: &History| (history.undoes(), history.redoes());
    assert_eq!(ways(&history), (None, None));
    history.give(vec![strength(90.0)], Some("Stronger mouse")).unwrap();
    assert_eq!(ways(&history), (Some("Stronger mouse".to_owned()), None));
    let after = hash(&history);
    play(&mut history, 200);
    let late = hash(&history);
    let undone = history.undo().unwrap();
    assert_eq!(undone.name, "Stronger mouse");
    assert!(undone.seconds < 0.0);
    assert_eq!(hash(&history), before);
    assert_eq!(ways(&history), (None, Some("Stronger mouse".to_owned())));
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
        let log = as_log(&recording);
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

/// The names of the branches that are listed.
fn listed(history: &History) -> Vec<String> {
    history.branches().into_iter().map(|branch| branch.name).collect()
}

/// What undo leaves behind while time runs is reached by redo, and is no timeline; what was undone is one once something else is done.
#[test]
fn undo_while_time_runs_leaves_no_branches_in_the_list() {
    let mut history = history("rim");
    for k in 0..6 {
        play(&mut history, 10);
        history.give(vec![strength(20.0 + f64::from(k))], Some("Stronger")).unwrap();
    }
    play(&mut history, 10);
    for _ in 0..6 {
        history.undo().unwrap();
        play(&mut history, 10);
        assert_eq!(history.branches().len(), 1, "{:?}", history.branches());
    }
    for k in 0..6 {
        assert_eq!(history.redo().unwrap().name, "Stronger", "{k}");
        play(&mut history, 3);
        assert_eq!(history.branches().len(), 1, "{:?}", history.branches());
    }
    assert_eq!(history.redo(), None);
    (0..6).for_each(|_| _ = history.undo().unwrap());
    play(&mut history, 10);
    history.give(vec![strength(5.0)], Some("Other")).unwrap();
    assert_eq!(listed(&history), ["Stronger", "Other"]);
    history.to_branch(history.branches()[0].number);
    assert_eq!((history.undoes().as_deref(), history.redo()), (Some("Stronger"), None), "all of it is there");
}

/// A timeline whose last edit was undone is gone back to as it was when it was left, whether time ran on then or not; redo has that edit.
#[test]
fn a_branch_is_gone_back_to_where_it_was_left() {
    for runs_on in [0, 20] {
        let mut history = history("rim");
        play(&mut history, 30);
        history.give(vec![strength(90.0)], Some("Stronger")).unwrap();
        play(&mut history, 30);
        history.give(vec![Do::Clear], Some("Delete all")).unwrap();
        let empty = hash(&history);
        history.undo().unwrap();
        play(&mut history, runs_on);
        let left = hash(&history);
        history.go_to(0.2 * history.world().time());
        history.give(vec![strength(5.0)], Some("Drag")).unwrap();
        play(&mut history, 10);
        assert_eq!(listed(&history), ["Stronger", "Drag"], "{runs_on}");
        let drag = hash(&history);
        let branches = history.branches();
        history.to_branch(branches[0].number);
        assert_eq!(hash(&history), left, "{runs_on}");
        assert_eq!((history.world().time(), history.undoes().as_deref()), (branches[0].end, Some("Stronger")));
        assert_eq!(history.branches().len(), 2, "{runs_on}: {:?}", history.branches());
        assert_eq!(history.redo().unwrap().name, "Delete all");
        assert_eq!((hash(&history), history.redo()), (empty, None), "{runs_on}");
        history.to_branch(branches[1].number);
        assert_eq!(hash(&history), drag, "{runs_on}");
    }
}

/// What was dragged without an edit is a timeline, the first or not; where only the cursor went there is none.
#[test]
fn what_was_dragged_without_an_edit_is_gone_back_to_on_any_timeline() {
    let mut history = history("rim");
    let numbers =
        |history: &History| history.branches().into_iter().map(|branch| branch.number).collect::<Vec<usize>>();
    let grab = || vec![Do::Grab(Reach::Points(vec![PointId(3)]))];
    play(&mut history, 30);
    history.go_to(0.5 * history.world().time());
    history.give(vec![cursor(0.2, 0.1)], None).unwrap();
    assert_eq!((history.branch(), numbers(&history)), (1, vec![1]), "the cursor alone did nothing");
    let before = history.world().time();
    play(&mut history, 20);
    history.give(grab(), None).unwrap();
    play(&mut history, 20);
    let dragged = hash(&history);
    history.go_to(before);
    history.give(grab(), None).unwrap();
    play(&mut history, 10);
    assert_eq!((history.branch(), numbers(&history)), (2, vec![1, 2]));
    history.to_branch(1);
    assert_eq!(hash(&history), dragged);
}

/// Timelines are called something and discarded; undo takes that back in its order among edits, without going to another time.
#[test]
fn a_timeline_that_was_discarded_comes_back_by_undo_in_its_order() {
    let mut history = history("rim");
    let called = |history: &History| history.branches().iter().map(|branch| branch.called()).collect::<Vec<_>>();
    play(&mut history, 30);
    history.give(vec![strength(90.0)], Some("Stronger")).unwrap();
    let at = format!("Stronger at {:.1} s", history.world().time());
    play(&mut history, 30);
    history.go_to(0.2 * history.world().time());
    history.give(vec![strength(5.0)], Some("Weaker")).unwrap();
    play(&mut history, 10);
    let (present, other) = (history.branch(), history.branches()[0].number);
    assert_eq!(called(&history)[0], at);
    history.call_branch(other, "  the strong one ");
    assert_eq!(called(&history)[0], "the strong one");
    assert_eq!(history.discard_branch(present), None, "the world is on it");
    assert_eq!(history.discard_branch(other).as_deref(), Some("the strong one"));
    assert_eq!(history.branches().len(), 1);
    let name = "discard the timeline \"the strong one\"".to_owned();
    assert_eq!(history.undoes().as_deref(), Some(&*name));
    history.give(vec![strength(6.0)], Some("Again")).unwrap();
    let late = hash(&history);
    assert_eq!(history.undo().unwrap().name, "Again", "an edit that was done since is undone first");
    assert_eq!(history.branches().len(), 1);
    let there = hash(&history);
    assert_eq!((history.undo().unwrap().name, called(&history).len()), (name.clone(), 2));
    assert_eq!(hash(&history), there, "it is no other time");
    assert_eq!((history.redo().unwrap().name, called(&history).len()), (name.clone(), 1));
    assert_eq!((history.redo().unwrap().name.as_str(), hash(&history)), ("Again", late));
    assert_eq!(["Again", &*name, "Weaker"].map(|name| history.undo().unwrap().name == name), [true; 3]);
    history.redo().unwrap();
    assert_eq!(called(&history)[0], "the strong one");
    history.to_branch(other);
    history.call_branch(other, " ");
    assert_eq!(called(&history)[0], at, "an empty title is none");
}

#[test]
fn a_reset_is_undone_as_one() {
    let mut history = history("rim");
    play(&mut history, 100);
    history.give(vec![Do::Pin(vec![PointId(3)])], Some("Pin")).unwrap();
    play(&mut history, 100);
    let late = hash(&history);
    history.reset();
    assert_eq!(history.world().time(), 0.0);
    play(&mut history, 30);
    assert_eq!(history.undoes().as_deref(), Some("back to the start"));
    let undone = history.undo().unwrap();
    assert_eq!((undone.name.as_str(), undone.seconds > 0.0), ("back to the start", true));
    assert_eq!(hash(&history), late);
    assert_eq!(history.redo().unwrap().name, "back to the start");
    assert_eq!(history.world().time(), 0.0);
    assert!(history.recording().commands.is_empty());
}

/// What is built before time goes by is there again at the start, what came later is not; undone as one.
#[test]
fn a_reset_takes_along_what_was_built_at_the_start() {
    let mut history = history("rim");
    let grab = || Do::Grab(Reach::Points(vec![PointId(3)]));
    history.give(vec![cursor(0.0, 0.0), grab()], None).unwrap();
    history.give(vec![strength(50.0)], Some("Built")).unwrap();
    let (start, built) = (history.world().time(), hash(&history));
    play(&mut history, 20);
    history.give(vec![Do::Pin(vec![PointId(3)])], Some("Later")).unwrap();
    play(&mut history, 20);
    let late = hash(&history);
    for _ in 0..2 {
        assert_eq!(history.reset(), GoneBack { left: 1, kept: 0, is_built: false });
        assert_eq!((history.world().time(), history.recording().commands.len()), (start, 1));
        assert!(history.world().grab().is_none() && hash(&history) == built);
        play(&mut history, 10);
        assert_eq!(history.undo().unwrap().name, "back to the start");
        assert_eq!(hash(&history), late);
        assert_eq!(history.redo().unwrap().name, "back to the start");
        assert_eq!((history.world().time(), history.recording().commands.len()), (start, 1));
        history.undo().unwrap();
    }
    assert_eq!(["Later", "Built"].map(|name| history.undo().unwrap().name == name), [true; 2]);
}

/// What was set later holds from the start on, of bodies that are there; what was done and what came does not. Undone as one.
#[test]
fn a_reset_keeps_what_was_set_and_takes_back_what_was_done() {
    let mut history = history("rim");
    let set = |keys: SetKeys| vec![Do::Set(Box::new(keys))];
    let mass = |history: &History| history.world().masses()[0];
    play(&mut history, 20);
    let pinned = history.world().pinned().len();
    history.give(vec![Do::Pin(vec![PointId(3)])], Some("pin")).unwrap();
    history.give(set(SetKeys { drag_rate: Some(2.0), ..SetKeys::default() }), Some("drag")).unwrap();
    let of_mass = |kg: f64| SetKeys { points: Some(vec![0]), mass: Some(OneOrEach::One(kg)), ..SetKeys::default() };
    history.give(set(of_mass(0.1)), Some("mass")).unwrap();
    for kg in [0.2, 0.3] {
        play(&mut history, 2);
        history.give_on(set(of_mass(kg)), "mass").unwrap();
    }
    let both = [SetKeys { gravity: Some(Vector::Plane([0.0, -1.0])), ..SetKeys::default() }]
        .map(|keys| Do::Set(Box::new(keys)));
    history.give(both.into_iter().chain([Do::Pin(vec![PointId(5)])]).collect(), Some("built")).unwrap();
    let late = hash(&history);
    assert_eq!(
        history.reset(),
        GoneBack { left: 2, kept: 2, is_built: false },
        "the pins go, with what was set for one of them"
    );
    assert_eq!((history.world().time(), history.recording().commands.len()), (0.0, 2), "of a drag the last number");
    assert_eq!((mass(&history), history.world().pinned().len()), (0.3, pinned));
    play(&mut history, 20);
    let again = hash(&history);
    assert_eq!(history.reset(), GoneBack::default(), "nothing was done since");
    play(&mut history, 20);
    assert_eq!(hash(&history), again);
    assert_eq!([(); 2].map(|()| history.undo().unwrap().name), ["back to the start"; 2]);
    assert_eq!(hash(&history), late);
}

/// Where the start is empty, what was built later is there again, as it stood when the last thing came; what was thrown or cut since is not.
#[test]
fn a_reset_of_a_scene_that_began_empty_leads_to_what_was_built() {
    let empty = r#"{"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-4, -2], "max": [4, 6]}}"#;
    let mut history = History::new(Scene::parse(empty, "empty.json").unwrap().into()).unwrap();
    let build = |history: &mut History, name: &str, x: f64| {
        let triangle = format!(
            r#"{{"points": {{"position": [[{x}, 1], [{}, 1], [{x}, 2]]}}, "bonds": [{{"a": "+0", "b": "+1"}}]}}"#,
            x + 1.0
        );
        let first = history.world().next_numbers()[0];
        let text = triangle.replace("\"+0\"", &first.to_string()).replace("\"+1\"", &(first + 1).to_string());
        history.give(vec![Do::Add(Box::new(serde_json::from_str(&text).unwrap()))], Some(name)).unwrap();
    };
    let points = |history: &History| history.world().point_count();
    play(&mut history, 30);
    build(&mut history, "First", -2.0);
    play(&mut history, 30);
    build(&mut history, "Second", 1.0);
    let first = history.world().next_numbers()[0] - 3;
    history.give(vec![Do::Pin(vec![PointId(first)])], Some("Pin")).unwrap();
    let built = hash(&history);
    play(&mut history, 20);
    let drag = SetKeys { drag_rate: Some(2.0), ..SetKeys::default() };
    history.give(vec![Do::Set(Box::new(drag))], Some("Drag")).unwrap();
    history.give(vec![Do::Unpin(vec![PointId(first)])], Some("Unpin")).unwrap();
    history.give(vec![Do::Delete(DeleteKeys { points: vec![0], ..DeleteKeys::default() })], Some("Delete")).unwrap();
    play(&mut history, 20);
    let late = hash(&history);
    assert_eq!(history.reset(), GoneBack { left: 2, kept: 1, is_built: true });
    let drag = history.world().settings().drag_rate;
    assert_eq!((hash(&history), points(&history), drag), (built.clone(), 6, Some(2.0)));
    // Once more, after a while; then it is undone, done again, and saved.
    play(&mut history, 25);
    assert_eq!(history.reset(), GoneBack { is_built: true, ..GoneBack::default() });
    let again = hash(&history);
    let opened = History::new(Start::from(as_log(&history.recording()).recording().unwrap())).map(|mut opened| {
        opened.go_to(f64::from_bits(again.1));
        hash(&opened)
    });
    assert_eq!((again.clone(), opened.unwrap()), (built, again.clone()));
    for name in ["back to what was built"; 2] {
        assert_eq!(history.undoes().as_deref(), Some(name));
        assert_eq!(history.undo().unwrap().name, name);
    }
    assert_eq!(hash(&history), late);
    for name in ["back to what was built"; 2] {
        assert_eq!(history.redo().unwrap().name, name);
    }
    assert_eq!(hash(&history), again);
    // What is built from there on is where the next one leads to, and undone by itself.
    play(&mut history, 10);
    build(&mut history, "Third", 2.5);
    play(&mut history, 10);
    history.reset();
    assert_eq!(points(&history), 9);
    let names: Vec<String> = std::iter::from_fn(|| history.undo()).map(|undone| undone.name).collect();
    let back = "back to what was built";
    assert_eq!(names, [back, "Third", back, back, "Delete", "Unpin", "Drag", "Pin", "Second", "First"]);
    assert_eq!(points(&history), 0);
    // Before anything came there is but the start.
    assert_eq!((history.reset(), history.world().time()), (GoneBack::default(), 0.0));
}

/// An edit that goes on while time goes by, as a drag does: back where it began to build, what it set later holds from there, in a log whose
/// times ascend, and in none before it was done.
#[test]
fn a_reset_after_an_edit_that_went_on_is_a_log_that_can_be_read() {
    let empty = r#"{"wobble": 1, "gravity": [0, -9.81]}"#;
    let dragged = || {
        let mut history = History::new(Scene::parse(empty, "empty.json").unwrap().into()).unwrap();
        play(&mut history, 30);
        let points =
            r#"{"points": {"position": [[0, 1], [1, 1], [2, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}]}"#;
        history.give(vec![Do::Add(Box::new(serde_json::from_str(points).unwrap()))], Some("Built")).unwrap();
        play(&mut history, 30);
        let bend = r#"{"angles": [{"points": [0, 1, 2], "stiffness": 1}]}"#;
        history.give(vec![Do::Add(Box::new(serde_json::from_str(bend).unwrap()))], Some("Bending")).unwrap();
        let at = history.world().time();
        for stiffness in [2.0, 3.0] {
            play(&mut history, 15);
            let keys = format!(r#"{{"angles": [0], "stiffness": {stiffness}}}"#);
            history.give_on(vec![Do::Set(Box::new(serde_json::from_str(&keys).unwrap()))], "Bending").unwrap();
        }
        (history, at)
    };
    let stiffness = |history: &History| history.world().angles()[0].stiffness;
    let (mut history, at) = dragged();
    play(&mut history, 20);
    let late = hash(&history);
    assert!(history.reset().is_built);
    assert_eq!((history.world().time(), stiffness(&history)), (at, 3.0));
    play(&mut history, 20);
    let mut again = History::new(Start::from(as_log(&history.recording()).recording().unwrap())).unwrap();
    again.go_to(history.world().time());
    assert_eq!(hash(&again), hash(&history));
    history.undo().unwrap();
    assert_eq!(hash(&history), late);
    // Within it, what was not done yet is not done there.
    let (mut history, at) = dragged();
    history.go_to(at + 1e-6);
    history.reset();
    assert_eq!((history.world().time(), stiffness(&history)), (at, 1.0));
}

/// Time goes by in a recording of a scene that is empty until something comes.
#[test]
fn nothing_rests_as_long_as_something_is_to_come() {
    let empty = r#"{"wobble": 1, "gravity": [0, -9.81]}"#;
    let mut history = History::new(Scene::parse(empty, "empty.json").unwrap().into()).unwrap();
    assert!(history.rests());
    history.go_to(0.0);
    (0..20).for_each(|_| history.step());
    let point = r#"{"points": {"position": [[0, 1]]}}"#;
    history.give(vec![Do::Add(Box::new(serde_json::from_str(point).unwrap()))], Some("Built")).unwrap();
    let mut again = History::new(Start::from(as_log(&history.recording()).recording().unwrap())).unwrap();
    assert!(again.world().is_asleep() && !again.rests());
    while again.world().point_count() == 0 {
        again.step();
    }
    assert_eq!(again.world().time(), history.world().time());
    let clear = vec![Do::Clear];
    history.give(clear, Some("Cleared")).unwrap();
    let mut again = History::new(Start::from(as_log(&history.recording()).recording().unwrap())).unwrap();
    again.go_to(history.world().time());
    (0..4).for_each(|_| again.step());
    assert!(again.rests(), "nothing is to come");
}

/// What was built before time went by is where a scene that was empty begins.
#[test]
fn a_reset_leads_to_the_start_where_anything_was_built_there() {
    let empty = r#"{"wobble": 1, "gravity": [0, -9.81]}"#;
    let mut history = History::new(Scene::parse(empty, "empty.json").unwrap().into()).unwrap();
    let point = |x: f64| {
        let keys = format!(r#"{{"points": {{"position": [[{x}, 1]]}}}}"#);
        vec![Do::Add(Box::new(serde_json::from_str(&keys).unwrap()))]
    };
    history.give(point(0.0), Some("First")).unwrap();
    play(&mut history, 30);
    history.give(point(1.0), Some("Second")).unwrap();
    play(&mut history, 30);
    assert_eq!(history.reset(), GoneBack { left: 1, ..GoneBack::default() });
    assert_eq!((history.world().time(), history.world().point_count()), (0.0, 1));
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
    // What does nothing is no error and nothing to undo.
    let path = || Do::Cut { from: Cursor::at([50.0, 50.0]), to: Cursor::at([51.0, 50.0]) };
    let nothing =
        [Do::Delete(DeleteKeys::default()), path(), Do::Pin(Vec::new()), Do::Unpin(vec![PointId(0)]), Do::Release];
    assert_eq!(history.give(Vec::new(), Some("Nothing")), Ok(Vec::new()));
    for nothing in nothing {
        let done = history.give(vec![nothing.clone()], Some("Nothing")).unwrap();
        assert!(done.iter().all(|applied| !applied.is_something), "{nothing:?}");
    }
    assert!(history.undo().is_none() && history.redo().is_none());
}

#[test]
fn what_is_grabbed_may_be_deleted_and_so_may_all_points() {
    let mut live = history("rim");
    play(&mut live, 50);
    live.give(vec![Do::Grab(Reach::Points(vec![PointId(3), PointId(4)]))], None).unwrap();
    play(&mut live, 50);
    live.give(vec![Do::Delete(DeleteKeys { points: vec![3], ..DeleteKeys::default() })], Some("Delete")).unwrap();
    assert!(live.world().grab().is_some(), "the other one is still held");
    live.give(vec![Do::Delete(DeleteKeys { points: vec![4], ..DeleteKeys::default() })], Some("Delete")).unwrap();
    assert!(live.world().grab().is_none());
    play(&mut live, 50);
    let gone: Vec<u32> = live.world().gone().iter().map(|point| point.0).collect();
    let points = (0..live.world().point_count() as u32).filter(|point| !gone.contains(point)).collect();
    live.give(vec![Do::Delete(DeleteKeys { points, ..DeleteKeys::default() })], Some("Delete all")).unwrap();
    play(&mut live, 50);
    let late = hash(&live);
    for reach in [Reach::Points(vec![PointId(4)]), Reach::Within(5.0), Reach::Points(Vec::new())] {
        let refused = live.give(vec![Do::Grab(reach.clone())], None).unwrap_err();
        assert_eq!((refused.number, hash(&live)), (0, late.clone()), "{reach:?}");
    }
    let mut again = History::new(Start::from(live.recording())).unwrap();
    again.go_to(f64::from_bits(late.1));
    assert_eq!((hash(&again), again.take_refused().len()), (late, 0));
    live.undo().unwrap();
    assert_eq!(live.world().gone(), [PointId(3), PointId(4)]);
}

#[test]
fn what_is_led_at_any_rate_of_frames_replays_to_its_own_hash() {
    let uneven = [0.004, 0.031, 0.0167, 0.09, 0.0011];
    for frames in [&[1.0 / 30.0][..], &[1.0 / 60.0], &[1.0 / 144.0], &uneven] {
        let mut live = history("rim");
        let mut seen = 0.0;
        for frame in frames.iter().cycle().take((1.5 * frames.len() as f64 / frames.iter().sum::<f64>()) as usize) {
            seen += frame;
            let (now, phase) = (live.world().time(), 2.0 * seen);
            let to = Some(Cursor::at([1.5 * phase.sin(), phase.cos()]));
            live.give(vec![Do::Cursor { to, by: Some(now.max(seen)) }], None).unwrap();
            while live.world().time() + live.world().substep() <= seen {
                live.step();
            }
        }
        let log = as_log(&live.recording());
        let end = live.world().time();
        let mut found = None;
        replay(log.head().unwrap(), &log, &[end], &mut |run, time| {
            found = Some((hash_now(run.world(), time), time.to_bits()));
            Ok(true)
        })
        .unwrap();
        assert_eq!(found, Some(hash(&live)), "{frames:?}");
    }
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
    assert!(history.give(vec![group(&[99])], Some("Group")).unwrap_err().reason.to_string().contains("no point 99"));
}

#[test]
fn groups_of_a_scene_file_are_there_and_are_kept() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0], [3, 0]]},
        "groups": [{"points": [2, 0, 2]}, {"points": [1, 3], "title": "pair"}]}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let named = |history: &History| -> Vec<(String, Vec<u32>)> {
        let groups = history.groups().into_iter();
        groups.map(|group| (group.name, group.points.into_iter().map(|point| point.0).collect())).collect()
    };
    let expected = vec![("group 1".to_owned(), vec![0, 2]), ("pair".to_owned(), vec![1, 3])];
    let mut history = History::new(scene.clone().into()).unwrap();
    assert_eq!(named(&history), expected);
    let expanded = scene.expanded().unwrap();
    assert_eq!(named(&History::new(expanded.into()).unwrap()), expected);
    let recorded = as_log(&history.recording());
    assert_eq!(named(&History::new(Start::from(recorded.recording().unwrap())).unwrap()), expected);
    let ungroup = Do::Group { points: Vec::new(), name: "pair".into() };
    history.give(vec![ungroup], Some("Ungroup")).unwrap();
    let snapshot = as_log(&history.snapshot().unwrap());
    let mut again = History::new(Start::from(snapshot.recording().unwrap())).unwrap();
    assert_eq!(named(&again), expected[..1], "what was ended stays so");
    again.undo();
    history.undo().unwrap();
    assert_eq!(named(&history), expected);
}

/// Positions and velocities now.
fn motion(history: &History) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let sample = history.world().sample(history.world().time());
    (sample.position, sample.velocity)
}

#[test]
fn a_patch_that_is_led_is_in_recordings_and_snapshots_with_where_it_tears() {
    let mut live = history("cloth-space");
    let reach = Reach::Patch { points: [59, 60, 61, 70, 71, 72].map(PointId).to_vec(), torn_beyond: 0.9 };
    live.give(vec![cursor(0.0, 0.5), Do::Grab(reach.clone())], None).unwrap();
    live.give(vec![cursor(0.0, -0.2)], None).unwrap();
    let grabs = |recording: &Recording| {
        let entries = as_log(recording).recording().unwrap().commands;
        entries.into_iter().find(|entry| matches!(entry.act, Do::Grab(_))).map(|entry| entry.act)
    };
    assert_eq!(grabs(&live.recording()), Some(Do::Grab(reach)));
    let log = as_log(&live.snapshot().unwrap());
    let mut again = History::new(Start::from(log.recording().unwrap())).unwrap();
    // One that any cursor tears off is pulled by more than its threads bear.
    for history in [&mut live, &mut again] {
        let torn = |history: &History| history.world().counters().bonds_torn;
        let before = torn(history);
        while history.world().time() < 0.4 {
            history.step();
        }
        assert_eq!((torn(history) - before, history.world().grab().unwrap().points.len()), (0, 6));
    }
}

#[test]
fn a_slit_is_one_step_of_undo_and_replays_to_the_bit() {
    let mut live = history("cloth-space");
    play(&mut live, 30);
    let before = hash(&live);
    let is_across = |ends: &[PointId; 2]| {
        ends.iter().any(|end| (57..64).contains(&end.0)) && ends.iter().any(|end| (66..77).contains(&end.0))
    };
    let bonds = live.world().bonds().ends().iter().zip(0..).filter(|(ends, _)| is_across(ends));
    let bonds = bonds.map(|(_, number)| BondId(number)).collect();
    live.give(vec![Do::Split { points: (57..64).map(PointId).collect(), bonds }], Some("cut")).unwrap();
    assert_eq!(live.world().point_count(), 128);
    play(&mut live, 60);
    let late = hash(&live);
    let log = as_log(&live.recording());
    let mut again = History::new(Start::from(log.recording().unwrap())).unwrap();
    again.go_to(f64::from_bits(late.1));
    assert_eq!((hash(&again), again.take_refused().len()), (late, 0));
    live.undo().unwrap();
    assert_eq!((hash(&live), live.world().point_count()), (before, 121));
}

#[test]
fn a_snapshot_goes_on_from_its_state_the_same_way_every_time() {
    for name in ["rim", "spring-damper", "points"] {
        let mut live = history(name);
        play_at_random(&mut live, &mut Dice::new(3), 1.0);
        live.give(vec![Do::Group { points: vec![PointId(0)], name: "first".into() }], Some("Group")).unwrap();
        let log = as_log(&live.snapshot().unwrap());
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
        damaged.state =
            Some(serde_json::json!({ "layout": state["layout"], "data": String::from_utf8(bytes).unwrap() }));
        // Whatever is damaged is noticed by the sum of the compressed bytes.
        let opened = History::new(Start::from(damaged.clone()));
        assert!(opened.is_err() || damaged.state.unwrap()["data"] == state["data"]);
    }
}

#[test]
fn a_state_of_another_layout_or_version_is_gone_on_from_and_said() {
    let mut live = history("rim");
    play(&mut live, 200);
    live.give(vec![Do::Delete(DeleteKeys { points: vec![3], ..DeleteKeys::default() })], Some("Delete")).unwrap();
    live.give(vec![strength(70.0), Do::Grab(Reach::Points(vec![PointId(0)]))], None).unwrap();
    play(&mut live, 100);
    let whole = live.snapshot().unwrap();
    assert!(whole.notes().is_empty());
    let as_is = History::new(Start::from(whole.clone())).unwrap();
    let of = |key: &str, value: serde_json::Value| {
        let mut other = whole.clone();
        other.state.as_mut().unwrap()[key] = value;
        other
    };
    // Of another version the layout may still be known: then nothing is lost.
    let other = of("wobble", "0.0.9".into());
    assert!(other.notes()[0].contains("0.0.9") && other.notes().len() == 1, "{:?}", other.notes());
    assert_eq!(hash(&History::new(Start::from(other)).unwrap()), hash(&as_is));
    // Of another layout positions, velocities, bonds and time are.
    let other = of("layout", 99.into());
    assert!(other.notes()[0].contains("layout 99"), "{:?}", other.notes());
    let mut taken = History::new(Start::from(other)).unwrap();
    assert_eq!(taken.notes().len(), 1);
    assert_eq!(hash(&taken), hash(&as_is));
    let bonds = |history: &History| history.world().bonds().iter().collect::<Vec<_>>();
    assert_eq!(bonds(&taken), bonds(&live));
    assert_eq!(taken.world().gone(), [PointId(3)]);
    // A sector of the rim on either side of the point, and the half of one that it is no corner of.
    let covered = |history: &History| history.world().triangles().to_vec();
    assert_eq!(covered(&live).len() + 3, covered(&history("rim")).len());
    assert_eq!((covered(&taken), covered(&as_is)), (covered(&live), covered(&live)));
    let force = |history: &History| history.world().mouse_force().unwrap().strength;
    assert_eq!((force(&taken), force(&as_is)), (force(&history("rim")), 70.0));
    assert!(as_is.world().grab().is_some() && taken.world().grab().is_none());
    play(&mut taken, 100);
    let late = hash(&taken);
    let mut again = History::new(Start::from(taken.recording())).unwrap();
    again.go_to(f64::from_bits(late.1));
    assert_eq!(hash(&again), late);
    let refused = History::new(Start::from(of("layout", 1.into()))).err().unwrap();
    assert!(refused.to_string().contains("layout 1"), "{refused}");
}

/// A state as it was laid out before worlds knew of triangles, of a scene of a picture's body to which another was added; then a point
/// went, and some bonds by a stroke.
#[test]
fn a_state_that_says_nothing_of_triangles_is_gone_on_from_whole() {
    let old = Log::of_text(include_str!("files/state-2.json"), "state-2.json").unwrap().recording().unwrap();
    assert_eq!(old.state.as_ref().unwrap()["layout"], 2);
    assert_eq!(old.notes(), [] as [&str; 0]);
    let scene = old.scene.clone();
    let mut body = scene.bodies[0].clone();
    body.origin = Some(Vector::Plane([3.0, 0.0]));
    let mut live = History::new(Start::from(scene)).unwrap();
    let mut give = |at: f64, act: Do| {
        while live.world().time() < at - 1e-9 {
            live.step();
        }
        live.give(vec![act], Some("Edit")).unwrap();
    };
    give(0.1, Do::Add(Box::new(AddKeys { bodies: vec![body], ..AddKeys::default() })));
    let whole = 2 * 18;
    give(0.2, Do::Delete(DeleteKeys { points: vec![0], ..DeleteKeys::default() }));
    give(0.2, Do::Cut { from: Cursor::at([2.0, 0.05]), to: Cursor::at([3.05, 0.05]) });
    let opened = History::new(Start::from(old)).unwrap();
    assert_eq!(opened.world().triangles(), live.world().triangles());
    assert!(opened.skins() == live.skins() && opened.skins().len() == 2);
    let left: Vec<usize> = opened.skins().iter().map(|skin| skin.triangles.len()).collect();
    assert_eq!(left.iter().sum::<usize>(), opened.world().triangles().len());
    assert!(left.iter().all(|&left| left < whole / 2), "{left:?}");
}

#[test]
fn bodies_meet_from_a_command_on_in_copies_and_snapshots_too() {
    let mut live = history("rim");
    play(&mut live, 100);
    let keys = |text: &str| -> SetKeys { serde_json::from_str(text).unwrap() };
    let set = |text: &str| Do::Set(Box::new(keys(text)));
    for (wrong, why) in [
        (r#"{"contact": {"friction": -1}}"#, "contact.friction is -1.0"),
        (r#"{"contact": {"restitution": 2}}"#, "contact.restitution is 2.0"),
        (r#"{"contact": true, "method": {"solver": "rk4"}}"#, "solver rk4 knows no contact"),
        (r#"{"contact": true, "points": [0]}"#, "contact: is no key of points"),
    ] {
        let error = live.give(vec![set(wrong)], Some("Set")).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
    assert!(serde_json::from_str::<SetKeys>(r#"{"contact": null}"#).is_err());
    live.give(vec![set(r#"{"contact": {"friction": 0.2, "self": false}}"#)], Some("Meet")).unwrap();
    let contact = Some(Contact { friction: 0.2, with_itself: false, ..Contact::default() });
    let meets = |history: &History| {
        assert_eq!(history.world().contact(), contact);
        history.world().triangles().to_vec()
    };
    let all = meets(&live);
    let rope = r#"{"points": {"position": [[3, 3], [4, 3], [4, 4]]}, "bonds": [{"a": 24, "b": 25}], "triangles": [[24, 26, 25]]}"#;
    live.give(vec![Do::Add(Box::new(serde_json::from_str(rope).unwrap()))], Some("Add")).unwrap();
    let more = meets(&live);
    assert_eq!(more[..all.len()], all);
    assert_eq!(more[all.len()..], [[24, 25, 26].map(PointId)], "turned anticlockwise");
    play(&mut live, 50);
    let (late, again) = (hash(&live), as_log(&live.snapshot().unwrap()).recording().unwrap());
    assert_eq!(meets(&History::new(Start::from(again)).unwrap()), more);
    let mut anew = History::new(Start::from(as_log(&live.recording()).recording().unwrap())).unwrap();
    anew.go_to(f64::from_bits(late.1));
    assert_eq!((hash(&anew), meets(&anew)), (late, more));
    live.give(vec![set(r#"{"contact": false}"#), set(r#"{"method": {"solver": "rk4"}}"#)], Some("Part")).unwrap();
    assert!(live.world().contact().is_none());
    live.undo().unwrap();
    live.undo().unwrap();
    assert_eq!(meets(&live), all);
    live.undo().unwrap();
    assert!(live.world().contact().is_none() && live.world().triangles() == all);
}

#[test]
fn skins_of_the_scene_and_of_what_was_added_are_in_a_snapshot() {
    let mut live = history("pebble");
    let gear = Scene::load("gear").unwrap().with_pictures_inside().unwrap();
    let body = gear.bodies[0].clone();
    live.give(vec![Do::Add(Box::new(AddKeys { bodies: vec![body], ..AddKeys::default() }))], Some("Add")).unwrap();
    let first = live.skins().last().unwrap().first;
    let gone = vec![0, first, first + 1];
    live.give(vec![Do::Delete(DeleteKeys { points: gone, ..DeleteKeys::default() })], Some("Delete")).unwrap();
    let before = live.skins().to_vec();
    assert_eq!(before.len(), 3);
    let layered = SetKeys { points: Some(vec![1, 2]), layered: Some(true), ..SetKeys::default() };
    live.give(vec![Do::Set(Box::new(layered))], Some("Layers")).unwrap();
    let open = |recording: &Recording| History::new(Start::from(as_log(recording).recording().unwrap())).unwrap();
    let again = open(&live.snapshot().unwrap());
    assert!(again.skins() == before);
    assert_eq!([1, 2, 3].map(|point| again.world().skin_of(PointId(point)).layered), [Some(true), Some(true), None]);
    // A snapshot of what began with one has them too.
    assert!(open(&again.snapshot().unwrap()).skins() == before);
}

/// A soft block that is squeezed to a half by what lies on it becomes rigid within half a second. Its springs hold the more the stiffer they get as
/// long as they are squeezed, so its load hops off, by some metres; at once they would throw it to the ceiling. The block is whole again.
#[test]
fn what_is_squeezed_and_becomes_rigid_lifts_its_load() {
    let scene = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {"min": [-4, 0], "max": [4, 12], "friction": 0.5},
        "bodies": [
            {"make": "lattice", "columns": 11, "rows": 6, "spacing": 0.1, "origin": [-0.5, 0.01],
                "material": {"kind": "spring", "stiffness": 600, "damping": 2, "mass": 2}},
            {"make": "box", "width": 0.8, "height": 0.4, "origin": [0, 0.8], "material": {"kind": "rigid", "mass": 40}}]}"#;
    let mut history = History::new(Start::from(Scene::parse(scene, "scene").unwrap())).unwrap();
    let top = |history: &History| {
        let sample = history.world().sample(history.world().time());
        sample.position[66..].iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max)
    };
    let go = |history: &mut History, until: f64| {
        let mut most = f64::NEG_INFINITY;
        while history.world().time() < until {
            history.step();
            most = most.max(top(history));
        }
        most
    };
    go(&mut history, 3.0);
    let before = top(&history);
    assert!(before < 0.7, "it is squeezed: {before}");
    let rigid =
        SetKeys { bonds: Some((0..215).collect()), kind: Some(KindName::Rigid), over: Some(0.5), ..SetKeys::default() };
    history.give(vec![Do::Set(Box::new(rigid))], Some("Rigid")).unwrap();
    let most = go(&mut history, 6.0);
    let end = top(&history);
    assert!(most < 4.0 && end < 1.0, "it rises to {most} m and lies at {end} m");
    let strain = history.world().sample(history.world().time()).max_strain;
    assert!(strain < 1e-3, "{strain}");
}

#[test]
fn a_history_that_begins_at_a_moment_in_another_precision_goes_on_from_there() {
    use wobble::scene::PrecisionName;
    use wobble::sim::Precision;
    let mut live = history("ragdoll");
    play(&mut live, 200);
    let now = live.world().sample(live.world().time());
    for (name, precision) in [(PrecisionName::F32, Precision::F32), (PrecisionName::F64, Precision::F64)] {
        let recording = live.begun_with(name, None).unwrap();
        let mut other = History::new(Start::from(as_log(&recording).recording().unwrap())).unwrap();
        assert_eq!((other.world().precision(), other.world().time()), (precision, live.world().time()));
        let there = other.world().sample(other.world().time());
        let apart = now.position.iter().flatten().zip(there.position.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-6, "{name:?}");
        other.give(vec![strength(5.0)], Some("weaker")).unwrap();
        play(&mut other, 100);
        assert!(other.world().is_finite() && other.world().precision() == precision, "{name:?} stays so");
    }
    let refused = live.begun_with(PrecisionName::Auto, Some(1e-4)).unwrap_err();
    assert!(refused.contains("tolerance"), "where bodies meet none is held to: {refused}");
}
