//! What is kept of a session, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::path::Path;
use std::time::{Duration, Instant};

use super::tests::{scene, strength, wait_for};
use super::{Keeping, Note, Order, Player};
use crate::history::{Autosave, History, Left, Log, Replay, hash_now};
use crate::sim::Cursor;

fn kept_in(folder: &Path) -> Keeping {
    Keeping { folder: Some(folder.to_owned()), ..Keeping::default() }
}

fn is_empty(folder: &Path) -> bool {
    std::fs::read_dir(folder).unwrap().next().is_none()
}

fn until(mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(20), "it never comes");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A session that someone did something in, as a killed program leaves it.
fn left(folder: &Path) -> Left {
    let mut player = Player::open(scene().into(), kept_in(folder), || {});
    wait_for(&mut player, Player::is_open);
    player.advance(0.1, Some(Cursor::at([0.0, 1.0])), false);
    wait_for(&mut player, |player| player.shown().figures.time > 0.0);
    assert!(is_empty(folder), "nobody would miss a look");
    player.give(vec![strength(7.0)], Some("calm"));
    until(|| !is_empty(folder) && std::fs::read_dir(folder).unwrap().count() == 3);
    assert!(Autosave::left(folder).is_empty(), "nobody else is offered what goes on");
    player.leave();
    drop(player);
    Autosave::left(folder).pop().unwrap()
}

#[test]
fn what_was_done_outlives_a_killed_program_and_goes_when_its_heir_ends() {
    let folder = tempfile::tempdir().unwrap();
    let left = left(folder.path());
    let (start, path) = (left.start().unwrap(), left.path().to_owned());
    let edits = start.recording().commands.iter().filter(|entry| entry.edit.is_some());
    assert_eq!(edits.count(), 1);
    let keeping = Keeping { heir_of: Some(left), ..kept_in(folder.path()) };
    let end = start.recording().end();
    let mut heir = Player::resume(start, keeping, || {});
    assert!(heir.is_unsaved() && !heir.is_open() && path.exists(), "it waits until something is asked of it");
    heir.play(false);
    assert!(heir.is_unfolding(), "it is said how far it is, and who does not wait is where one was");
    wait_for(&mut heir, Player::is_open);
    assert!(end > 0.0 && heir.shown().figures.time == end && !heir.is_playing() && heir.is_resumed());
    until(|| !path.exists() && std::fs::read_dir(folder.path()).unwrap().count() == 3);
    heir.end().unwrap();
    assert!(is_empty(folder.path()), "what ended as it should leaves nothing");
}

#[test]
fn redo_brings_again_in_the_window_what_was_undone_before_a_program_was_killed() {
    let folder = tempfile::tempdir().unwrap();
    let mut player = Player::open(scene().into(), kept_in(folder.path()), || {});
    wait_for(&mut player, Player::is_open);
    player.give(vec![strength(7.0)], Some("calm"));
    player.give(vec![strength(9.0)], Some("stir"));
    player.ask(Order::Undo(None));
    let is_redo = |path: &Path| path.extension().is_some_and(|ending| ending == "redo");
    let has_redo =
        || std::fs::read_dir(folder.path()).is_ok_and(|mut all| all.any(|file| is_redo(&file.unwrap().path())));
    until(has_redo);
    player.leave();
    drop(player);
    let left = Autosave::left(folder.path()).pop().unwrap();
    let (start, path) = (left.start().unwrap(), left.path().to_owned());
    let mut heir = Player::resume(start, Keeping { heir_of: Some(left), ..kept_in(folder.path()) }, || {});
    heir.play(false);
    wait_for(&mut heir, Player::is_open);
    assert_eq!(heir.shown().figures.redoes.as_deref(), Some("stir"));
    // Folded and worked out again it has it too, and so has its own file.
    heir.fold();
    heir.play(false);
    wait_for(&mut heir, |heir| heir.is_open() && !heir.is_unfolding());
    assert_eq!(heir.shown().figures.redoes.as_deref(), Some("stir"));
    until(|| !path.exists());
    heir.leave();
    drop(heir);
    let again = Autosave::left(folder.path()).pop().unwrap();
    let mut history = History::new(again.start().unwrap()).unwrap();
    assert_eq!(history.redo().unwrap().name, "stir");
}

#[test]
fn a_session_that_nobody_goes_back_to_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut player = Player::open(scene().into(), kept_in(folder.path()), || {});
    wait_for(&mut player, Player::is_open);
    player.give(vec![strength(7.0)], Some("calm"));
    until(|| !is_empty(folder.path()));
    drop(player);
    until(|| is_empty(folder.path()));
}

#[test]
fn a_folder_that_cannot_be_written_is_told_once_and_tried_again() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("state");
    std::fs::write(&inner, b"a file in its way").unwrap();
    let mut player = Player::open(scene().into(), kept_in(&inner), || {});
    wait_for(&mut player, Player::is_open);
    player.give(vec![strength(7.0)], Some("calm"));
    let mut told = Vec::new();
    let mut listen = |seconds: f64| {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs_f64(seconds) {
            player.advance(0.01, None, false);
            told.extend(player.poll().notes);
            std::thread::sleep(Duration::from_millis(10));
        }
        told.len()
    };
    assert_eq!(listen(2.5), 1, "told once, tried twice");
    std::fs::remove_file(&inner).unwrap();
    assert_eq!(listen(2.5), 1);
    assert!(matches!(&told[0], Note::NotKept(why) if why.contains("state")), "{told:?}");
    assert!(inner.is_dir() && !is_empty(&inner), "and the session went on");
}

#[test]
fn a_recording_grows_as_lines_or_is_written_at_the_end_and_comes_to_its_marks() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["session.jsonl", "session.json"] {
        let path = folder.path().join(name);
        let keeping = Keeping { record: Some(path.clone()), ..Keeping::default() };
        let mut player = Player::open(scene().into(), keeping, || {});
        wait_for(&mut player, Player::is_open);
        player.advance(0.1, Some(Cursor::at([0.2, 1.1])), false);
        player.give(vec![strength(7.0)], Some("calm"));
        player.advance(0.1, Some(Cursor::at([0.4, 1.3])), false);
        wait_for(&mut player, |player| player.shown().figures.time > 0.0);
        if name.ends_with('l') {
            until(|| path.exists());
        }
        assert_eq!(path.exists(), name.ends_with('l'), "{name}");
        player.end().unwrap();
        let recording = Log::open(&path).unwrap().whole().unwrap().recording().unwrap();
        assert_eq!(recording.commands.iter().filter(|entry| entry.edit.is_some()).count(), 1, "{name}");
        let mark = recording.marks.last().unwrap();
        let mut again = Replay::new(&recording, name).unwrap();
        again.advance(&recording.commands, mark.at).unwrap();
        assert_eq!(hash_now(again.world(), mark.at), mark.hash, "{name}");
    }
}

#[test]
fn files_that_were_asked_for_are_written_before_the_program_ends() {
    let folder = tempfile::tempdir().unwrap();
    for number in 0..8 {
        let [first, second] = ["a", "b"].map(|name| folder.path().join(format!("{name}{number}.json")));
        let mut player = Player::open(scene().into(), Keeping::default(), || {});
        wait_for(&mut player, Player::is_open);
        player.ask(Order::Save(first.clone()));
        player.ask(Order::Save(second.clone()));
        player.end().unwrap();
        assert!(first.exists() && second.exists(), "{number}");
        let later = folder.path().join(format!("c{number}.json"));
        player.ask(Order::Save(later.clone()));
        drop(player);
        until(|| later.exists());
    }
}

#[test]
fn a_recording_that_cannot_be_written_is_told_at_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("nowhere").join("session.json");
    let keeping = Keeping { record: Some(path), ..Keeping::default() };
    let mut player = Player::open(scene().into(), keeping, || {});
    wait_for(&mut player, Player::is_open);
    assert!(player.end().is_err());
}

#[test]
fn the_name_of_a_file_outlives_a_killed_program() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("my swing.json");
    let state = folder.path().join("state");
    let mut player = Player::open(scene().into(), kept_in(&state), || {});
    wait_for(&mut player, Player::is_open);
    player.lie_in(&file);
    player.give(vec![strength(7.0)], Some("calm"));
    let called = || {
        std::fs::read_dir(&state)
            .is_ok_and(|mut all| all.any(|file| file.unwrap().path().extension().is_some_and(|end| end == "called")))
    };
    until(called);
    player.call(&file);
    until(|| {
        std::fs::read_dir(&state).unwrap().any(|file| {
            std::fs::read_to_string(file.unwrap().path()).is_ok_and(|text| text.contains(r#""name":"my swing""#))
        })
    });
    player.leave();
    drop(player);
    let left = Autosave::left(&state).pop().unwrap();
    assert_eq!((left.called().name.as_deref(), left.called().file.as_deref()), (Some("my swing"), Some(&*file)));
    assert!(left.last().is_some(), "its picture is drawn of that");
    let (start, called) = (left.start().unwrap(), left.called());
    let mut heir = Player::resume(start, Keeping { heir_of: Some(left), ..kept_in(&state) }, || {});
    heir.be_called(called);
    assert_eq!((heir.called(), heir.file()), (Some("my swing"), Some(&*file)), "it is saved there again");
    heir.play(false);
    wait_for(&mut heir, Player::is_open);
    heir.end().unwrap();
    assert!(is_empty(&state), "what ended as it should leaves nothing");
}
