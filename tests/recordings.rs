//! Recordings: what a history writes holds when it is run again, what a machine left of a file is had, and what could be taken
//! for something else is refused.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;
use wobble::history::{Autosave, Do, History, Log, Replay, Start, hash_now, replay};
use wobble::scene::Scene;
use wobble::sim::{Addition, Command as Act, Dynamics, MouseChange, Obstacle, PointId, SavedWorld, resume};

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_wobble")).args(arguments).output().unwrap()
}

/// What a call that succeeds prints.
fn said(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

/// What a call that fails says.
fn refused(arguments: &[&str]) -> String {
    let output = run(arguments);
    let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
    said
}

fn file(folder: &TempDir, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn rim() -> History {
    History::new(Start::from(Scene::load("rim").unwrap())).unwrap()
}

fn strength(strength: f64) -> Do {
    Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() })
}

/// Point 0 is at rest from now on: the state is another at once.
fn pin() -> Do {
    Do::Pin(vec![PointId(0)])
}

fn steps(history: &mut History, count: usize) {
    (0..count).for_each(|_| history.step());
}

/// What a history would write, read again.
fn written(history: &History) -> Log {
    let mut lines = Vec::new();
    history.recording().write_lines(&mut lines).unwrap();
    Log::of_text(std::str::from_utf8(&lines).unwrap(), "written").unwrap()
}

/// No time.
const NONE: [f64; 0] = [];

/// The times of the marks of a file that its motion does not come to; there are `least` marks or more.
fn differing(log: &Log, least: usize) -> Vec<f64> {
    let marks = &log.head().unwrap().marks;
    assert!(marks.len() >= least, "{} marks", marks.len());
    let times: Vec<f64> = marks.iter().map(|mark| mark.at).collect();
    let mut hashes = Vec::new();
    replay(log.head().unwrap(), log, &times, &mut |run, time| {
        hashes.push(hash_now(run.world(), time));
        Ok(true)
    })
    .unwrap();
    marks.iter().zip(hashes).filter(|(mark, hash)| mark.hash != *hash).map(|(mark, _)| mark.at).collect()
}

#[test]
fn marks_of_what_was_undone_are_not_written() {
    let mut history = rim();
    while history.world().time() < 1.0 {
        history.step();
    }
    // At the very time of a second's mark, which is after it.
    history.give(vec![pin()], Some("Pin")).unwrap();
    steps(&mut history, 3);
    history.undo().unwrap();
    assert_eq!(differing(&written(&history), 1), NONE);
    steps(&mut history, 300);
    assert_eq!(differing(&written(&history), 1), NONE);
}

#[test]
fn marks_of_a_file_that_was_gone_on_with_are_those_of_what_was_done() {
    let mut first = rim();
    steps(&mut first, 200);
    let made = written(&first).recording().unwrap();
    let end = made.end();
    let mut again = History::new(Start::from(made)).unwrap();
    while again.has_future() {
        again.step();
    }
    assert_eq!(again.world().time(), end);
    again.give(vec![pin()], Some("Pin")).unwrap();
    steps(&mut again, 200);
    assert_eq!(differing(&written(&again), 1), NONE);
}

#[test]
fn a_step_that_was_cut_for_what_was_undone_is_taken_whole() {
    let mut commands = Log::of_text(
        r#"{"wobble_recording": 1, "scene": "rim", "end": 0.6,
            "commands": [{"at": 0.4321, "do": "set", "gravity": [0, -5], "edit": 0, "name": "Moon"}]}"#,
        "x",
    )
    .unwrap()
    .recording()
    .unwrap();
    commands.end = None;
    for goes_beyond in [0, 1, 50] {
        let mut history = History::new(Start::from(commands.clone())).unwrap();
        while history.world().time() < 0.4321 {
            history.step();
        }
        steps(&mut history, goes_beyond);
        assert_eq!(history.undo().unwrap().name, "Moon");
        assert!(history.world().time() < 0.4321);
        steps(&mut history, 300);
        assert_eq!(differing(&written(&history), 1), NONE, "{goes_beyond}");
        history.redo().unwrap();
        assert_eq!(history.world().time(), 0.4321);
        steps(&mut history, 50);
        assert_eq!(differing(&written(&history), 1), NONE, "{goes_beyond}");
    }
}

#[test]
fn all_files_are_compared_whatever_becomes_of_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut history = rim();
    steps(&mut history, 20);
    let good = folder.path().join("good.jsonl");
    history.recording().save(&good).unwrap();
    let bare = file(&folder, "bare.json", r#"{"wobble_recording": 1, "scene": "rim", "commands": [], "end": 1}"#);
    let none = folder.path().join("none.jsonl");
    let output = run(&["verify", text(&none), text(&good), text(&bare), text(&good)]);
    assert_eq!(output.status.code(), Some(1));
    let [compared, failed] = [&output.stdout, &output.stderr].map(|said| String::from_utf8_lossy(said).into_owned());
    assert_eq!(compared.matches("marks are the same").count(), 2, "{compared}");
    let lines: Vec<&str> = failed.lines().collect();
    assert_eq!(lines.len(), 3, "{failed}");
    assert!(lines[0].contains("none.jsonl: cannot be read"), "{failed}");
    assert!(lines[1].contains("bare.json: nothing to compare"), "{failed}");
    assert!(lines[2].contains("2 of 4 files"), "{failed}");
    assert!(run(&["verify", text(&good), text(&good)]).status.success());
}

#[test]
fn where_nothing_is_whole_nothing_is_offered() {
    let folder = tempfile::tempdir().unwrap();
    for start in ["{\"wobble_recording\":1,\"sce", "[{\"at\": 0.1, \"do\""] {
        let path = file(&folder, "x.jsonl", start);
        for call in [vec!["replay", text(&path), "--hash"], vec!["replay", text(&path), "--hash", "--partial"]] {
            let line = refused(&call);
            assert!(line.contains("there is nothing to replay") && !line.contains("--partial"), "{line}");
        }
    }
}

const HEADER: &str = "{\"wobble_recording\":1,\"scene\":\"rim\"}\n";
const TWO: &str = "{\"at\":0.1,\"do\":\"mouse\",\"strength\":70}\n{\"at\":0.2,\"do\":\"cursor\",\"to\":[1,1]}\n";

#[test]
fn of_lines_that_end_in_what_is_no_json_what_is_whole_is_offered() {
    let folder = tempfile::tempdir().unwrap();
    let whole = file(&folder, "whole.jsonl", format!("{HEADER}{TWO}"));
    let hash = said(&["replay", text(&whole), "--hash"]);
    for tail in ["\0\0\0\0\0\0", "{\"at\":0.3,\"do\":\"cur\0\0\0", "{\"at\":0.3\0\0\0\0\0\0\0}\n", "\u{1}x"] {
        let path = file(&folder, "x.jsonl", format!("{HEADER}{TWO}{tail}"));
        let line = refused(&["replay", text(&path), "--hash"]);
        let at = line.contains("line 4: is not JSON") && line.contains("2 commands are whole");
        assert!(at && line.contains("--partial") && line.lines().count() == 1, "{tail:?}: {line}");
        assert_eq!(said(&["replay", text(&path), "--hash", "--partial"]), hash, "{tail:?}");
    }
    // What is JSON and no command is a mistake and no damage.
    let path = file(&folder, "x.jsonl", format!("{HEADER}{TWO}{{\"at\":0.3,\"do\":\"curse\"}}\n"));
    let line = refused(&["replay", text(&path), "--hash", "--partial"]);
    assert!(line.contains("commands[2]: do: `curse`"), "{line}");
}

#[test]
fn a_killed_session_whose_file_ends_in_zeros_is_gone_on_with() {
    let folder = tempfile::tempdir().unwrap();
    let mut history = rim();
    let mut saved = Autosave::begin(folder.path()).unwrap();
    history.give(vec![strength(50.0)], Some("Mouse")).unwrap();
    saved.write(&history).unwrap();
    steps(&mut history, 100);
    saved.write(&history).unwrap();
    let path = saved.path().to_owned();
    drop(saved);
    let mut bytes = std::fs::read(&path).unwrap();
    bytes.extend([0; 512]);
    std::fs::write(&path, bytes).unwrap();
    // A program that another test starts has the lock as well, until it is another program.
    let look = |_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        Autosave::left(folder.path())
    };
    let left = (0..200).map(look).find(|left| !left.is_empty()).unwrap();
    let start = left[0].start().unwrap();
    let again = start.recording();
    assert_eq!((again.commands.len(), again.end()), (1, history.world().time()));
}

#[test]
fn a_line_is_a_command_or_of_the_recording_and_never_both() {
    for (line, key) in [
        (r#"{"at": 0.3, "do": "release", "end": 9}"#, "end"),
        (r#"{"end": 9, "at": 0.3, "do": "release"}"#, "end"),
        (r#"{"at": 0.3, "do": "release", "scene": "gear"}"#, "scene"),
        (r#"{"at": 0.3, "do": "release", "view": {"height": 3}}"#, "view"),
        (r#"{"at": 0.3, "do": "release", "marks": []}"#, "marks"),
        (r#"{"scene": "gear"}"#, "scene"),
    ] {
        let read = Log::of_text(&format!("{HEADER}{TWO}{line}\n"), "x").err().map(|error| error.to_string());
        let message = read.unwrap_or_else(|| panic!("{line} is taken"));
        assert!(message.contains(key) && message.contains("leave"), "{message}");
    }
    // The place that something is moved about is the command's own.
    let command = r#"{"about":[1.0,2.0],"at":0.3,"do":"move","points":[0],"turn":0.5}"#;
    let of_lines = Log::of_text(&format!("{HEADER}{TWO}{command}\n"), "x").unwrap().commands().unwrap();
    let of_list = Log::of_text(&format!("[{command}]"), "x").unwrap().commands().unwrap();
    assert_eq!(of_lines[2..], of_list[..]);
    let Do::Move(keys) = &of_list[0].act else { panic!("{of_list:?}") };
    assert!(keys.about.is_some());
}

/// What becomes of a command in a scene.
fn fault(scene: &str, command: &str) -> Option<String> {
    let log = Log::of_text(&format!("[{command}]"), "x");
    let log = match log {
        Ok(log) => log,
        Err(error) => return Some(error.to_string()),
    };
    let mut run = Replay::new(&Scene::load(scene).unwrap().into(), "x").unwrap();
    run.follow(0, &log.commands().unwrap()[0]).err().map(|error| error.to_string())
}

#[test]
fn what_would_be_passed_over_without_a_word_is_refused() {
    let space = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/cloth-space.json");
    for (scene, keys, reason) in [
        ("rim", r#""do": "set", "method": {"precision": "f64"}"#, Some("method.precision: is fixed")),
        (
            "rim",
            r#""do": "set", "method": {"solver": "verlet", "tolerance": 1e-3}"#,
            Some("method.tolerance: is fixed"),
        ),
        ("rim", r#""do": "set", "method": {"solver": "verlet"}"#, None),
        ("rim", r#""do": "set", "areas": {"kind": "spring", "stiffness": 40}"#, None),
        ("rim", r#""do": "set", "areas": null"#, None),
        ("rim", r#""do": "set", "areas": {"kind": "spring"}"#, Some("areas: areas of kind spring need `stiffness`")),
        (space, r#""do": "set", "areas": {"stiffness": 40}"#, Some("areas: act in the plane only")),
        ("rim", r#""do": "move", "points": [0], "by": [0.1, 0, 0.1]"#, Some("by: has 3 numbers")),
        ("rim", r#""do": "move", "points": [0], "turn": 1, "about": [0, 0, 0]"#, Some("about: has 3 numbers")),
        ("rim", r#""do": "move", "points": [0], "by": [0.1, 0], "about": [0, 0]"#, None),
        (space, r#""do": "move", "points": [0], "by": [0.1, 0]"#, Some("by: has 2 numbers")),
        (space, r#""do": "move", "points": [0], "by": [0.1, 0, 0]"#, None),
        ("rim", r#""do": "release", "edit": 18446744073709551615"#, Some("edit: give a whole number from 0 to")),
        ("rim", r#""do": "release", "edit": 9007199254740992"#, None),
    ] {
        let found = fault(scene, &format!("{{\"at\": 0, {keys}}}"));
        match (found, reason) {
            (None, None) => {}
            (Some(found), Some(reason)) => assert!(found.contains(reason), "{keys}: {found}"),
            (found, _) => panic!("{keys}: {found:?}"),
        }
    }
}

/// A running world as it stands, in the plane.
fn saved(world: &dyn Dynamics) -> wobble::sim::Saved<2> {
    match world.save() {
        Some(SavedWorld::Plane(saved)) => saved,
        other => panic!("{other:?}"),
    }
}

#[test]
fn numbers_of_a_state_that_do_not_fit_what_has_them_are_refused() {
    let mut world = Scene::load("rim").unwrap().world(None).unwrap();
    let floor = Obstacle::Plane {
        point: [0.0, -4.0, 0.0],
        normal: [0.0, 1.0, 0.0],
        restitution: 0.0,
        friction: 0.0,
        penalty: None,
    };
    let more =
        |floor: &Obstacle| Act::Add(Box::new(Addition { obstacles: vec![floor.clone()], ..Addition::default() }));
    world.apply(&more(&floor)).unwrap();
    let whole = saved(&*world);
    let [bonds, obstacles] = whole.next_numbers;
    let goes_on =
        |next_numbers: [u32; 2]| resume(&SavedWorld::Plane(wobble::sim::Saved { next_numbers, ..whole.clone() }));
    assert!(goes_on([bonds, obstacles]).is_ok());
    for wrong in [[bonds + 1, obstacles], [bonds - 1, obstacles], [u32::MAX, obstacles], [bonds, 0]] {
        assert!(goes_on(wrong).is_err(), "{wrong:?}");
    }
    // The last number of all is no number for another.
    let mut full = goes_on([bonds, u32::MAX]).unwrap();
    let refused = full.apply(&more(&floor)).unwrap_err().to_string();
    assert!(refused.contains("more obstacles than numbers"), "{refused}");
}

#[test]
fn a_state_under_another_scene_is_refused_where_points_do_not_fit_and_said_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    let mut history = rim();
    steps(&mut history, 5);
    let mut whole = Vec::new();
    history.snapshot().unwrap().write_json(&mut whole).unwrap();
    let whole: Value = serde_json::from_slice(&whole).unwrap();
    let under = |scene: Value| {
        let mut other = whole.clone();
        other["scene"] = scene;
        file(&folder, "x.json", other.to_string())
    };
    let line = refused(&["replay", text(&under("spring-damper".into())), "--hash"]);
    assert!(line.contains("state: is of a scene of 24 points, and this has 10"), "{line}");
    let told = |scene: Value| {
        let output = run(&["replay", text(&under(scene)), "--hash"]);
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    let mut renamed = whole["scene"].clone();
    renamed["name"] = "wheel".into();
    let note = told(renamed);
    assert!(note.contains("its state is of the scene `rim` and goes on under `wheel`"), "{note}");
    assert_eq!(told(whole["scene"].clone()), "");
}

#[test]
fn a_strain_that_was_not_kept_is_said_of_worlds_that_are_led_too() {
    let folder = tempfile::tempdir().unwrap();
    let net = |strain: f64| {
        format!(
            r#"{{"wobble": 1, "name": "net", "gravity": [0, -9.8], "method": {{"max_strain": {strain:?}, "precision": "f32"}},
            "bodies": [{{"make": "cloth", "columns": 12, "rows": 12, "spacing": 0.1, "diagonals": "none", "pinned": [0, 11], "origin": [1000, 0]}}]}}"#
        )
    };
    let out = folder.path().join("out.json");
    let keys = file(&folder, "keys.json", r#"[{"at": 0.01, "do": "cursor", "to": [0, 0]}]"#);
    // A kilometre from the origin 32 bits know places to a thirtieth of a millimetre.
    for (strain, is_kept) in [(1e-4, false), (0.05, true)] {
        let scene = file(&folder, "net.json", net(strain));
        for more in [vec![], vec!["--commands", text(&keys)]] {
            let call = [vec!["simulate", text(&scene), "--samples", "0.02", "--out", text(&out)], more].concat();
            let output = run(&call);
            assert!(output.status.success());
            let table: Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
            let of_strain = |text: &str| text.contains(&format!("where {strain:?} was asked for"));
            let written = table["warnings"].as_array().unwrap().iter().filter_map(Value::as_str).any(of_strain);
            let told = of_strain(&String::from_utf8_lossy(&output.stderr));
            assert_eq!((written, told), (!is_kept, !is_kept), "{call:?}: {}", table["warnings"]);
        }
    }
}

#[test]
fn rigid_bonds_that_are_strained_in_the_live_step_are_told_of() {
    let folder = tempfile::tempdir().unwrap();
    let net = |speed: f64| {
        format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {{"min": [-3, 0], "max": [3, 4], "friction": 0.5}},
            "bodies": [{{"make": "cloth", "columns": 10, "rows": 10, "spacing": 0.1, "diagonals": "none", "origin": [-0.8, 1.2],
                "angle": 0.1, "velocity": [0, {speed:?}], "material": {{"kind": "rigid", "mass": 1}}}}]}}"#
        )
    };
    for (speed, is_told) in [(-60.0, true), (10.0, false)] {
        let scene = file(&folder, "net.json", net(speed));
        let output =
            run(&["simulate", text(&scene), "--samples", "0.15", "--out", text(&folder.path().join("out.json"))]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(said.contains("rigid bonds that the live step moves have a strain of"), is_told, "{said}");
    }
}

#[test]
fn the_recording_of_the_docs_does_what_is_said_of_it() {
    let page = include_str!("../docs/commands.md");
    let text_of = page.split("```json\n").find(|text| text.starts_with("{ \"wobble_recording\"")).unwrap();
    let log = Log::of_text(text_of.split("```").next().unwrap(), "commands.md").unwrap();
    let mut run = Replay::new(log.head().unwrap(), "commands.md").unwrap();
    let mut alone = Scene::load("rim").unwrap().world(None).unwrap();
    let count = alone.point_count();
    let mut seen = Vec::new();
    for (number, entry) in log.commands().unwrap().iter().enumerate() {
        run.reach(entry.at, Some(entry.at)).unwrap();
        let before = run.world().bonds().len();
        run.follow(number, entry).unwrap();
        let world = run.world();
        let mean = |of: &[[f64; 3]]| of[..count].iter().map(|v| v[1]).sum::<f64>() / count as f64;
        let now = world.sample(world.time());
        match &entry.act {
            Do::Cut { .. } => {
                while alone.time() + alone.substep() < world.time() {
                    alone.step();
                }
                let apart = (mean(&now.position) - mean(&alone.sample(world.time()).position)).abs();
                assert!(apart > 0.05, "it is pushed: {apart} m");
                assert!(world.bonds().len() < before, "it is cut");
                seen.push("cut");
            }
            Do::Add(_) => {
                assert_eq!((world.point_count(), world.bonds().len()), (count + 5, before + 4));
                seen.push("rope");
            }
            Do::Grab(_) => assert!(world.grab().unwrap().points.iter().any(|point| point.index() < count)),
            Do::Release => {
                assert!(mean(&now.velocity) > 5.0, "it is thrown: {} m/s", mean(&now.velocity));
                seen.push("throw");
            }
            _ => {}
        }
    }
    assert_eq!(seen, ["cut", "rope", "throw"]);
}
