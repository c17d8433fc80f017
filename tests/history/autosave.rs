//! Sessions that did not end as they should: killed, in the middle of a write, on a full disk.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use wobble::history::{Autosave, History, Left, Log, hash_now};

use super::common::session::Dice;
use super::{hash, history, play, strength};

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
    // What is shown until then is the last state that was written.
    let shown = left[0].last().unwrap();
    assert_eq!((hash_now(shown.world(), shown.world().time()), shown.world().time().to_bits()), whole);
    assert_eq!(shown.skins().len(), history.skins().len());
    let state = path.with_extension("state");
    let bytes = std::fs::read(&state).unwrap();
    let wrong =
        |k: usize| bytes.iter().enumerate().map(|(at, byte)| if at == k { byte ^ 0x20 } else { *byte }).collect();
    let damaged: [Vec<u8>; 5] =
        [Vec::new(), bytes[..bytes.len() - 5].to_vec(), bytes[..20].to_vec(), wrong(2), wrong(bytes.len() / 2)];
    for damaged in damaged {
        std::fs::write(&state, damaged).unwrap();
        assert!(left[0].last().is_none());
    }
    std::fs::remove_file(&state).unwrap();
    assert!(left[0].last().is_none());
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

#[test]
fn what_another_session_of_its_name_has_left_is_not_offered_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let first = Autosave::begin(folder.path()).unwrap();
    let beside = ["redo", "state", "called"].map(|ending| first.path().with_extension(ending));
    let path = first.path().to_owned();
    first.end().unwrap();
    beside.iter().for_each(|file| std::fs::write(file, "{}").unwrap());
    let again = Autosave::begin(folder.path()).unwrap();
    assert_eq!(again.path(), path);
    assert!(!beside.iter().any(|file| file.exists()));
    again.end().unwrap();
}

#[test]
fn a_branch_that_redo_discards_again_takes_nothing_else_from_redo() {
    let folder = tempfile::tempdir().unwrap();
    let mut live = history("rim");
    let mut saved = Autosave::begin(folder.path()).unwrap();
    play(&mut live, 50);
    live.give(vec![strength(50.0)], Some("first")).unwrap();
    play(&mut live, 50);
    live.go_to(0.0);
    live.give(vec![strength(60.0)], Some("second")).unwrap();
    play(&mut live, 50);
    live.give(vec![strength(70.0)], Some("third")).unwrap();
    assert_eq!(live.undo().unwrap().name, "third");
    let other = live.branches().into_iter().find(|view| !view.is_present).unwrap();
    live.discard_branch(other.number).unwrap();
    assert!(live.undo().unwrap().name.starts_with("discard"));
    saved.write(&live).unwrap();
    drop(saved);
    let left = Autosave::left(folder.path()).pop().unwrap();
    let mut heir = History::new(left.start().unwrap()).unwrap();
    heir.go_to(heir.end());
    assert_eq!(heir.redo().unwrap().name, "third");
}

#[test]
fn redo_brings_again_what_was_undone_before_a_session_was_cut_off() {
    let folder = tempfile::tempdir().unwrap();
    let mut live = history("rim");
    let mut saved = Autosave::begin(folder.path()).unwrap();
    play(&mut live, 100);
    let mut after = Vec::new();
    for (name, strong) in [("first", 50.0), ("second", 60.0), ("third", 70.0)] {
        live.give(vec![strength(strong)], Some(name)).unwrap();
        after.push(hash(&live));
        play(&mut live, 50);
    }
    saved.write(&live).unwrap();
    let beside = saved.path().with_extension("redo");
    assert!(!beside.exists(), "nothing was undone");
    assert_eq!([live.undo(), live.undo()].map(|undone| undone.unwrap().name), ["third", "second"]);
    saved.write(&live).unwrap();
    // Time goes on, and nothing is done: redo leads to a time before.
    play(&mut live, 30);
    saved.write(&live).unwrap();
    let end = hash(&live);
    // The program is killed.
    drop(saved);
    let left = Autosave::left(folder.path()).pop().unwrap();
    assert_eq!(Log::open(left.path()).unwrap().count(), live.recording().commands.len(), "the log has nothing of it");
    let again = |left: &Left| {
        let mut again = History::new(left.start().unwrap()).unwrap();
        again.go_to(again.end());
        again
    };
    let mut heir = again(&left);
    assert_eq!(
        (hash(&heir), heir.redoes().as_deref(), heir.branches().len()),
        (end.clone(), Some("second"), live.branches().len())
    );
    // Its own file has it too, until something else is done.
    let inner = folder.path().join("heir");
    let mut of_heir = Autosave::begin(&inner).unwrap();
    of_heir.write(&heir).unwrap();
    for (name, expected) in [("second", &after[1]), ("third", &after[2])] {
        assert_eq!((heir.redo().unwrap().name.as_str(), &hash(&heir)), (name, expected));
    }
    assert_eq!((heir.redo(), heir.undoes().as_deref()), (None, Some("third")));
    drop(of_heir);
    let inner_left = Autosave::left(&inner).pop().unwrap();
    assert_eq!(again(&inner_left).redoes().as_deref(), Some("second"));
    inner_left.discard().unwrap();
    assert_eq!(std::fs::read_dir(&inner).unwrap().count(), 0);
    // What is damaged, or of another log, brings nothing, and the session is gone on with all the same.
    let text = std::fs::read_to_string(&beside).unwrap();
    let far = text.replacen("\"after\":", "\"after\":9", 1);
    let other = text.replacen("\"last\":{\"at\":", "\"last\":{\"at\":9", 1);
    assert_ne!(other, text);
    for damaged in [&text[..text.len() / 2], "", "{}", &far, &other] {
        std::fs::write(&beside, damaged).unwrap();
        let heir = again(&left);
        assert_eq!((hash(&heir), heir.redoes()), (end.clone(), None), "{damaged}");
    }
    left.discard().unwrap();
    // What is done instead takes it away.
    let mut saved = Autosave::begin(folder.path()).unwrap();
    let beside = saved.path().with_extension("redo");
    saved.write(&live).unwrap();
    assert!(beside.exists());
    live.give(vec![strength(80.0)], Some("other")).unwrap();
    saved.write(&live).unwrap();
    assert!(!beside.exists());
    saved.end().unwrap();
}

/// A program that runs one of the tests below, which do nothing but where they are given a folder.
#[cfg(unix)]
fn program(test: &str, folder: &Path, limit: &str) -> Child {
    let test = format!("history::autosave::{test}");
    let call = format!("trap '' XFSZ; {limit} exec \"$0\" --exact \"$1\" --nocapture");
    let mut command = Command::new("sh");
    command.arg("-c").arg(call).arg(std::env::current_exe().unwrap()).arg(test);
    command.env("WOBBLE_TEST_FOLDER", folder).stdout(Stdio::null()).spawn().unwrap()
}

/// Saves a session over and over, for ever: it goes on, and is written whole each time that something is undone.
#[test]
fn a_session_that_is_to_be_killed() {
    let Some(folder) = std::env::var_os("WOBBLE_TEST_FOLDER") else { return };
    let mut saved = Autosave::begin(Path::new(&folder)).unwrap();
    let mut live = history("rim");
    loop {
        play(&mut live, 20);
        live.give(vec![strength(50.0)], Some("Mouse")).unwrap();
        saved.write(&live).unwrap();
        play(&mut live, 10);
        live.undo().unwrap();
        saved.write(&live).unwrap();
    }
}

#[test]
#[cfg(unix)]
fn a_program_that_is_killed_while_it_saves_leaves_what_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let mut dice = Dice::new(2);
    let mut most = 0;
    for round in 0..6 {
        let mut child = program("a_session_that_is_to_be_killed", folder.path(), "");
        let has_state = |entry: std::fs::DirEntry| entry.path().extension().is_some_and(|ending| ending == "state");
        let is_written = || std::fs::read_dir(folder.path()).unwrap().flatten().any(has_state);
        for _ in 0..6000 {
            if is_written() {
                break;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_micros(100_000 + dice.below(100_000)));
        child.kill().unwrap();
        child.wait().unwrap();
        let mut left = Autosave::left(folder.path());
        assert_eq!(left.len(), 1, "{round}");
        let left = left.pop().unwrap();
        let mut again = History::new(left.start().unwrap()).unwrap();
        again.go_to(again.end());
        assert!(again.take_refused().is_empty());
        let shown = left.last().unwrap();
        assert!(shown.world().time() <= again.world().time() + 0.2);
        most = most.max(Log::open(left.path()).unwrap().count());
        left.discard().unwrap();
        // But for what was being written there is nothing else.
        let rest = std::fs::read_dir(folder.path()).unwrap().flatten();
        rest.for_each(|entry| {
            assert!(entry.file_name().to_string_lossy().starts_with(".wobble-"), "{entry:?}");
            std::fs::remove_file(entry.path()).unwrap();
        });
    }
    assert!(most > 5, "{most}");
}

/// Saves where no file may be larger than 64 KiB.
#[test]
fn a_session_on_a_disk_that_is_full() {
    let Some(folder) = std::env::var_os("WOBBLE_TEST_FOLDER") else { return };
    let mut saved = Autosave::begin(Path::new(&folder)).unwrap();
    let mut live = history("points");
    play(&mut live, 200);
    saved.write(&live).unwrap();
    live.give(vec![strength(50.0)], Some("Mouse")).unwrap();
    let whole = live.recording().commands.len();
    // Appending fails, and so does writing all of it anew.
    let fails = (0..60).any(|_| {
        play(&mut live, 300);
        saved.write(&live).is_err() && saved.write(&live).is_err()
    });
    assert!(fails, "the disk was never full");
    let log = Log::open(saved.path()).unwrap();
    assert!(log.count() >= whole && !log.recording().unwrap().commands.is_empty());
    assert!(Log::open(saved.path()).unwrap().last().is_some(), "the state before stays");
    // Where there is room again, all is written.
    live.undo().unwrap();
    saved.write(&live).unwrap();
    let log = Log::open(saved.path()).unwrap().whole().unwrap();
    assert_eq!(log.recording().unwrap().commands, live.recording().commands);
    saved.end().unwrap();
}

#[test]
#[cfg(unix)]
fn a_full_disk_is_an_error_and_what_was_written_before_stays() {
    let folder = tempfile::tempdir().unwrap();
    let done = program("a_session_on_a_disk_that_is_full", folder.path(), "ulimit -f 128;").wait().unwrap();
    assert!(done.success());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing half-written is left");
}
