//! Recordings as files, through the program: what is done with good ones, and what is said of bad ones.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::session::{Dice, play};
use tempfile::TempDir;
use wobble::history::{History, Log, Start, chunk};
use wobble::scene::Scene;

fn wobble(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wobble"));
    command.args(arguments);
    command
}

fn run(arguments: &[&str]) -> Output {
    wobble(arguments).output().unwrap()
}

/// What a call that succeeds prints.
fn said(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

/// The one line of a call that ends with `code`.
fn refused(code: i32, arguments: &[&str]) -> String {
    let output = run(arguments);
    let line = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {line}");
    assert_eq!(line.lines().count(), 1, "{line}");
    line
}

fn file(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A recording of the rim with these commands.
fn recording(commands: &str, more: &str) -> String {
    format!("{{\"wobble_recording\": 1, \"scene\": \"rim\", \"commands\": [{commands}]{more}}}")
}

const THREE: &str = r#"{"at": 0.1, "do": "cursor", "to": [2.2, 0.3], "by": 0.2},
{"at": 0.25, "do": "mouse", "strength": 70, "edit": 0, "name": "Stronger"},
{"at": 0.3, "do": "cursor", "to": null}"#;

/// The line that replaying a recording with these commands ends with.
fn fault(commands: &str, more: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "x.json", &recording(commands, more));
    refused(1, &["replay", text(&path), "--hash"])
}

#[test]
fn a_session_is_the_same_run_again_with_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let mut history = History::new(Start::from(Scene::load("rim").unwrap())).unwrap();
    play(&mut history, &mut Dice::new(7), 1.5);
    history.go_to(history.end());
    let made = history.recording();
    let path = folder.path().join("session.json");
    made.save(&path).unwrap();
    let hash = made.marks.last().unwrap().hash.clone();
    for threads in ["1", "2", "3", "8"] {
        let done = wobble(&["replay", text(&path), "--hash"]).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!(String::from_utf8_lossy(&done.stdout).trim(), hash, "{threads}");
    }
    assert!(said(&["verify", text(&path)]).contains("marks are the same"));
    // As lines, and by way of another file.
    let lines = folder.path().join("session.jsonl");
    made.save(&lines).unwrap();
    assert_eq!(said(&["replay", text(&lines), "--hash"]), hash);
    let end = made.end().to_string();
    let again = folder.path().join("again.jsonl");
    let hashes =
        said(&["simulate", "rim", "--commands", text(&lines), "--samples", &end, "--hash", "--record", text(&again)]);
    assert_eq!(hashes, hash);
    assert_eq!(said(&["replay", text(&again), "--hash"]), hash);
    assert_eq!(said(&["simulate", text(&path), "--samples", &end, "--hash"]), hash);
}

#[test]
fn commands_may_be_a_list_lines_or_a_recording_whose_scene_is_not_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let list = file(&folder, "list.json", &format!("[{THREE}]"));
    let lines = file(&folder, "lines.jsonl", &THREE.replace(",\n", "\n"));
    let whole = recording(THREE, "").replace("\"rim\"", "\"gear\"");
    let whole = file(&folder, "whole.json", &whole);
    let hash = |path: &Path| said(&["simulate", "rim", "--commands", text(path), "--samples", "0.3,0.5", "--hash"]);
    assert_eq!(hash(&list), hash(&lines));
    assert_eq!(hash(&list), hash(&whole));
    assert_ne!(hash(&list), said(&["simulate", "rim", "--samples", "0.3,0.5", "--hash"]));
    assert!(refused(1, &["replay", text(&list), "--hash"]).contains("without a scene"));
}

#[test]
fn a_state_at_a_time_of_its_own_is_taken_on_a_copy() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "x.json", &recording(THREE, ", \"end\": 0.6"));
    let out = folder.path().join("state.json");
    let at = said(&["replay", text(&path), "--time", "0.25", "--hash", "--out", text(&out)]);
    let state: serde_json::Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
    assert_eq!((state["samples"].as_array().unwrap().len(), &state["hash"]), (1, &serde_json::json!(at)));
    assert_eq!(state["samples"][0]["t"], serde_json::json!(0.25));
    // Sampling on the way changes nothing.
    let last = said(&["replay", text(&path), "--hash"]);
    let marks = |hash: &str| {
        recording(
            THREE,
            &format!(", \"marks\": [{{\"at\":0.11234,\"hash\":\"{hash}\"}},{{\"at\":0.6,\"hash\":\"{last}\"}}]"),
        )
    };
    let odd = said(&["replay", text(&path), "--time", "0.11234", "--hash"]);
    let marked = file(&folder, "marked.json", &marks(&odd));
    assert!(said(&["verify", text(&marked)]).contains("2 marks"));
    let wrong = file(&folder, "wrong.json", &marks(&last));
    assert!(refused(1, &["verify", text(&wrong)]).contains("differs from t = 0.11234 s on"));
}

#[test]
fn what_is_wrong_with_a_call_ends_with_2_and_with_a_file_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "x.json", &recording(THREE, ", \"end\": 0.5"));
    assert!(refused(2, &["replay", text(&path), "--time", "0.6"]).contains("beyond its end at 0.5 s"));
    for time in ["-1", "NaN", "inf"] {
        assert_eq!(run(&["replay", text(&path), "--time", time]).status.code(), Some(2), "{time}");
    }
    assert!(refused(1, &["verify", text(&path)]).contains("nothing to compare"));
    let old = file(
        &folder,
        "old.json",
        &recording(
            THREE,
            ", \"end\": 0.4, \"marks\": [{\"at\":0.4,\"hash\":\"0\"}], \"about\": {\"wobble\": \"0.0.1\"}",
        ),
    );
    assert!(refused(1, &["verify", text(&old)]).contains("made by wobble 0.0.1"));
    let replayed = run(&["replay", text(&old), "--hash"]);
    assert!(replayed.status.success() && String::from_utf8_lossy(&replayed.stderr).contains("made by wobble 0.0.1"));
    assert!(refused(1, &["replay", "rim", "--hash"]).contains("rim: cannot be read"));
}

#[test]
fn bad_commands_are_refused_with_number_time_and_reason() {
    for (commands, more, reason) in [
        (
            r#"{"at": 0.2, "do": "release"}, {"at": 0.1, "do": "release"}"#,
            "",
            "commands[1]: at: 0.1 s comes after 0.2 s",
        ),
        (r#"{"at": 0.2, "do": "cursor", "to": [0, 0], "by": 0.1}"#, "", "commands[0]: by: 0.1 s is before its time"),
        (r#"{"at": 0.2, "do": "cursor", "to": [NaN, 0]}"#, "", "is not JSON, which knows no NaN"),
        (r#"{"at": 1e999, "do": "release"}"#, "", "number out of range"),
        (r#"{"at": -1, "do": "release"}"#, "", "commands[0]: at: give a time of 0 s or more"),
        (r#"{"do": "release"}"#, "", "commands[0]: the key `at` is missing"),
        (r#"{"at": 0.1}"#, "", "commands[0]: the key `do` is missing"),
        (r#"{"at": 0.1, "do": "explode"}"#, "", "commands[0]: do: `explode` is nothing that is done here"),
        (r#"{"at": 0.1, "do": "grab"}"#, "", "commands[0]: takes nothing: give `points` or `within`"),
        (r#"{"at": 0.1, "do": "set", "wind": {}}"#, "", "commands[0]: `wind` is not in this version"),
        (r#"{"at": 0.1, "do": "add", "angles": []}"#, "", "commands[0]: `angles` is not in this version"),
        (r#"{"at": 0.1, "do": "pin", "points": [0], "bond": 1}"#, "", "unknown key"),
        (r#"{"at": 0.1, "do": "pin", "points": [-1]}"#, "", "commands[0]: points[0]: "),
        (
            r#"{"at": 0.1, "do": "group", "points": [77], "name": "x"}"#,
            "",
            "commands[0] at t = 0.1 s: there is no point 77",
        ),
        (
            r#"{"at": 0.1, "do": "add", "bodies": [{"make": "rope"}]}"#,
            "",
            "commands[0] at t = 0.1 s: bodies[0]: `rope` needs `count`",
        ),
        (
            r#"{"at": 0.1, "do": "add", "bonds": [{"a": 0, "b": 99}]}"#,
            "",
            "commands[0] at t = 0.1 s: bonds[0].b: point 99 does not exist",
        ),
        (r#"{"at": 0.1, "do": "set", "bonds": [0], "mass": 2}"#, "", "mass: is no key of bonds"),
        (r#"{"at": 0.1, "do": "set", "gravity": [0, 0, 1]}"#, "", "gravity: has 3 numbers"),
        (THREE, ", \"end\": 0.2", "end: 0.2 s is before the last command or mark at 0.3 s"),
        (THREE, ", \"marks\": [{\"at\": 2, \"hash\": \"\"}], \"end\": 1", "before the last command or mark at 2.0 s"),
        (THREE, ", \"ends\": 1", "unknown key `ends`"),
    ] {
        let line = fault(commands, more);
        assert!(line.contains(reason), "{commands}{more}: {line}");
    }
    let folder = tempfile::tempdir().unwrap();
    for (whole, reason) in [
        (recording(THREE, "").replace(": 1,", ": 2,"), "is version 2"),
        (recording(THREE, "").replace("\"rim\"", "\"rimm\""), "no scene of the gallery"),
        (
            recording(THREE, "").replace("\"rim\"", "{\"wobble\": 1, \"gravty\": 1}"),
            "scene.gravty: unknown key: did you mean `gravity`?",
        ),
        (recording(THREE, "").replace("\"scene\": \"rim\",", ""), "the key `scene` is missing"),
        (recording(THREE, ", \"state\": {\"layout\": 9, \"data\": \"\"}"), "state: has layout 9"),
        (recording(THREE, ", \"state\": {\"layout\": 1, \"data\": \"AAAA\"}"), "state: is damaged"),
    ] {
        let path = file(&folder, "x.json", &whole);
        let line = refused(1, &["replay", text(&path), "--hash"]);
        assert!(line.contains(reason), "{line}");
    }
}

#[test]
fn of_a_file_that_was_cut_off_what_is_whole_is_offered() {
    let folder = tempfile::tempdir().unwrap();
    let whole = recording(THREE, ", \"end\": 0.5");
    let lines = format!("{{\"wobble_recording\":1,\"scene\":\"rim\"}}\n{}\n", THREE.replace(",\n", "\n"));
    let two = file(&folder, "two.json", &recording(&THREE[..THREE.rfind(",\n").unwrap()], ""));
    let hash = said(&["replay", text(&two), "--hash"]);
    for (name, text_of, cut) in [("x.json", &whole, whole.rfind("null").unwrap()), ("x.jsonl", &lines, lines.len() - 5)]
    {
        let path = file(&folder, name, &text_of[..cut]);
        let line = refused(1, &["replay", text(&path), "--hash"]);
        assert!(line.contains("2 commands are whole") && line.contains("--partial"), "{line}");
        assert_eq!(said(&["replay", text(&path), "--hash", "--partial"]), hash);
        assert!(refused(1, &["simulate", text(&path), "--hash"]).contains("2 commands are whole"));
        assert!(refused(1, &["verify", text(&path)]).contains("2 commands are whole"));
    }
    // Wherever the cut is, it is said or the file is whole.
    for cut in 0..lines.len() {
        let read = Log::of_text(&lines[..cut], "x");
        assert!(read.is_err() || read.is_ok_and(|log| log.count() <= 3), "{cut}");
    }
    // A header alone says nothing yet.
    let header = file(&folder, "header.jsonl", "{\"wobble_recording\":1,\"sce");
    assert!(refused(1, &["replay", text(&header), "--hash", "--partial"]).contains("0 commands are whole"));
}

#[test]
fn a_picture_that_was_drawn_carries_its_scene() {
    let Some(_) = common::gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "x.json", &recording(THREE, ", \"end\": 0.6"));
    let out = folder.path().join("shot.png");
    said(&["render", text(&path), "--time", "0.5", "--size", "160x120", "--out", text(&out)]);
    // Its state is that of the last step before, and goes on from there.
    let positions = |source: &Path, name: &str| {
        let out = folder.path().join(name);
        said(&["simulate", text(source), "--samples", "0.5", "--out", text(&out)]);
        let table: serde_json::Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
        let rows = table["samples"][0]["position"].as_array().unwrap().clone();
        rows.iter().flat_map(|x| [x[0].as_f64().unwrap(), x[1].as_f64().unwrap()]).collect::<Vec<f64>>()
    };
    let (shot, expected) = (positions(&out, "a.json"), positions(&path, "b.json"));
    assert_eq!(shot.len(), expected.len());
    assert!(shot.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-6), "{shot:?} {expected:?}");
    let png = std::fs::read(&out).unwrap();
    assert!(chunk::find(&png).unwrap().starts_with("{\n\"wobble_recording\""));
    assert_eq!(image::open(&out).unwrap().width(), 160);
}

#[test]
fn the_readmes_recording_runs() {
    let readme = include_str!("../README.md");
    let text_of = readme.split("```json\n").find(|text| text.starts_with("{ \"wobble_recording\"")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "x.json", text_of.split("```").next().unwrap());
    let start = said(&["replay", text(&path), "--time", "0", "--hash"]);
    assert_ne!(said(&["replay", text(&path), "--hash"]), start);
}
