//! Recordings as files, through the program: what is done with good ones, and what is said of bad ones.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use crate::common;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::session::{Dice, play};
use common::{asked, say};
use tempfile::TempDir;
use wobble::history::{Autosave, History, Log, Recording, Replay, Start, chunk, hash_now};
use wobble::scene::Scene;
use wobble::sim::InstructionSet;

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
fn a_session_is_the_same_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut history = History::new(Start::from(Scene::load("rim").unwrap())).unwrap();
    play(&mut history, &mut Dice::new(7), 1.5);
    history.go_to(history.end());
    let made = history.recording();
    let path = folder.path().join("session.json");
    made.save(&path).unwrap();
    let hash = made.marks.last().unwrap().hash.clone();
    assert_eq!(said(&["replay", text(&path), "--hash"]), hash);
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
        (r#"{"at": 0.1, "do": "set", "wind": {}}"#, "", "commands[0]: wind: "),
        (r#"{"at": 0.1, "do": "set", "duration": "x"}"#, "", "commands[0]: duration: give a time, or null"),
        (r#"{"at": 0.1, "do": "set", "bounds": 3}"#, "", "commands[0]: bounds: give an object with the keys `min`"),
        (r#"{"at": 0.1, "do": "set", "drives": {}}"#, "", "commands[0]: `drives` is not in this version"),
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
        (r#"{"at": 0.1, "do": "pin", "points": [77]}"#, "", "commands[0] at t = 0.1 s: there is no point 77"),
        (r#"{"at": 0.1, "do": "delete", "bonds": [9999]}"#, "", "commands[0] at t = 0.1 s: there is no bond 9999"),
        (r#"{"at": 0.1, "do": "delete", "obstacles": [5]}"#, "", "commands[0] at t = 0.1 s: there is no obstacle 5"),
        (
            r#"{"at": 0.1, "do": "set", "bonds": [0], "relaxation": 0.5}"#,
            "",
            "commands[0] at t = 0.1 s: bond 0 is not relaxed",
        ),
        (
            r#"{"at": 0.1, "do": "cursor", "to": [50, 50]}, {"at": 0.2, "do": "grab", "within": 0.5}"#,
            "",
            "commands[1] at t = 0.2 s: nothing is in reach",
        ),
        (
            r#"{"at": 0.1, "do": "cursor", "to": [0, 0]}, {"at": 0.1, "do": "pin", "points": [3]}, {"at": 0.2, "do": "grab", "points": [3]}"#,
            "",
            "commands[2] at t = 0.2 s: what is in reach is held by pins",
        ),
        (
            r#"{"at": 0.1, "do": "cursor", "to": [0, 0]}, {"at": 0.1, "do": "delete", "points": [3]}, {"at": 0.2, "do": "grab", "points": [3]}"#,
            "",
            "commands[2] at t = 0.2 s: there is no point 3",
        ),
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
        (recording(THREE, ", \"state\": {\"layout\": 1, \"data\": \"\"}"), "state: has layout 1"),
        (recording(THREE, ", \"state\": {\"layout\": 2, \"data\": \"AAAA\"}"), "state: is damaged"),
        (recording(THREE, ", \"state\": {\"layout\": 9, \"data\": \"AAAA\"}"), "state: is damaged"),
    ] {
        let path = file(&folder, "x.json", &whole);
        let line = refused(1, &["replay", text(&path), "--hash"]);
        assert!(line.contains(reason), "{line}");
    }
}

#[test]
fn numbers_that_are_set_and_refused_are_said_as_they_were_written() {
    let scene = r#"{"wobble": 1, "points": {"position": [[1, 0], [0, 0], [0, 1]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}], "angles": [{"points": [0, 1, 2], "min": 1, "max": 2}],
        "obstacles": [{"plane": {"point": [0, -5], "normal": [0, 1]}}]}"#;
    let folder = tempfile::tempdir().unwrap();
    for (keys, reason) in [
        (r#""angles": [0], "range": [4, 2]"#, "angle 0 is [4.0, 2.0]: it must be within min < max"),
        (r#""obstacles": [0], "penalty": {"stiffness": -1}"#, "penalty of plane 0 is [-1.0, 0.0]: it must be finite"),
    ] {
        let command = format!(r#"{{"at": 0.1, "do": "set", {keys}}}"#);
        let path = file(&folder, "x.json", &recording(&command, "").replace("\"rim\"", scene));
        let line = refused(1, &["replay", text(&path), "--hash"]);
        assert!(line.contains(reason) && !line.contains("Some"), "{line}");
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
    assert!(refused(1, &["replay", text(&header), "--hash", "--partial"]).contains("there is nothing to replay"));
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

/// Resident memory at most so far [kB], where the system tells.
fn peak_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    text.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.trim().parse().ok())
}

/// Far fewer bytes are in memory than a file has. WOBBLE_COMMANDS says how many commands there are.
#[test]
fn commands_are_streamed() {
    let count = asked("WOBBLE_COMMANDS", 400_000.0) as usize;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.jsonl");
    let mut lines = std::io::BufWriter::new(std::fs::File::create(&path).unwrap());
    writeln!(lines, "{{\"wobble_recording\":1,\"scene\":\"points\"}}").unwrap();
    for k in 0..count {
        let at = 1e-3 * (k * 100 / count) as f64;
        writeln!(
            lines,
            "{{\"at\":{at:?},\"do\":\"cursor\",\"to\":[{}.5,1],\"edit\":{k},\"name\":\"a long name\"}}",
            k % 7
        )
        .unwrap();
    }
    lines.into_inner().unwrap();
    let size = std::fs::metadata(&path).unwrap().len() >> 10;
    let before = peak_memory();
    let log = Log::open(&path).unwrap();
    let mut run = Replay::new(log.head().unwrap(), "x").unwrap();
    log.each(&mut |number, entry| run.follow(number, &entry).map(|()| true)).unwrap();
    assert_eq!(log.count(), count);
    if let (Some(before), Some(after)) = (before, peak_memory()) {
        say(&format!("{count} commands of {size} kB: {} kB more in memory", after - before));
        // Other tests run beside this one.
        assert!(after - before < size, "{} kB of {size}", after - before);
    }
}

/// A session of all kinds of commands, and its file.
fn session(name: &str, seconds: f64, folder: &TempDir) -> (Recording, PathBuf) {
    let mut live = History::new(Start::from(Scene::load(name).unwrap())).unwrap();
    play(&mut live, &mut Dice::new(name.len() as u64), seconds);
    live.go_to(live.end());
    assert!(live.take_refused().is_empty(), "{name}");
    let made = live.recording();
    let path = folder.path().join(format!("{name}.json"));
    made.save(&path).unwrap();
    (made, path)
}

/// From some keyframes on to the end: the same hash.
fn from_keyframes(name: &str, made: &Recording, count: usize) {
    let mut again = History::new(Start::from(made.clone())).unwrap();
    let (end, mut dice) = (made.end(), Dice::new(9));
    again.go_to(end);
    for _ in 0..count {
        let at = dice.within(0.0, end);
        again.go_to(at);
        while again.world().time() < end {
            again.step();
        }
        let hash = hash_now(again.world(), again.world().time());
        assert_eq!(Some(&hash), made.marks.last().map(|mark| &mark.hash), "{name} from {at} s on");
        assert!(again.take_refused().is_empty(), "{name}");
    }
}

/// Each varied alone from one base run: threads, vectors, where it is begun, and the build. Whole by WOBBLE_SCENES=10 WOBBLE_SECONDS=60
/// WOBBLE_KEYFRAMES=20 WOBBLE_OTHER=(the program of another build).
#[test]
fn random_sessions_come_to_the_same_bits_whatever_is_varied() {
    let (scenes, seconds) = (asked("WOBBLE_SCENES", 3.0) as usize, asked("WOBBLE_SECONDS", 6.0));
    let keyframes = asked("WOBBLE_KEYFRAMES", 2.0) as usize;
    let names =
        ["rim", "points", "spring-damper", "net", "gear", "jelly", "random-graph", "ring", "rope", "picture-obstacle"];
    let folder = tempfile::tempdir().unwrap();
    for name in names.into_iter().take(scenes) {
        let (made, path) = session(name, seconds, &folder);
        assert!(made.commands.len() as f64 > 5.0 * seconds, "{name}: {}", made.commands.len());
        let verify = |program: &str, variable: &str, value: &str| {
            let done = Command::new(program).args(["verify", text(&path)]).env(variable, value).output().unwrap();
            let said = String::from_utf8_lossy(&done.stderr);
            assert!(done.status.success(), "{name} with {variable}={value} by {program}: {said}");
        };
        let program = env!("CARGO_BIN_EXE_wobble");
        ["1", "2", "3", "8"].into_iter().for_each(|threads| verify(program, "RAYON_NUM_THREADS", threads));
        let narrower =
            InstructionSet::ALL.into_iter().filter(|set| set.is_available() && *set != InstructionSet::best());
        narrower.for_each(|set| verify(program, "WOBBLE_INSTRUCTION_SET", set.name()));
        if let Ok(other) = std::env::var("WOBBLE_OTHER") {
            verify(&other, "RAYON_NUM_THREADS", "2");
        }
        from_keyframes(name, &made, keyframes);
    }
}

#[test]
fn what_a_session_left_is_compared_with_its_last_state() {
    let folder = tempfile::tempdir().unwrap();
    let mut live = History::new(Start::from(Scene::load("spring-damper").unwrap())).unwrap();
    play(&mut live, &mut Dice::new(3), 0.5);
    let mut saved = Autosave::begin(folder.path()).unwrap();
    saved.write(&live).unwrap();
    let path = saved.path().to_owned();
    assert!(said(&["verify", text(&path)]).contains("the state that was kept at t = "));
    // Another motion than the one that was kept: nothing was done but a push.
    let lines = std::fs::read_to_string(&path).unwrap();
    let (header, rest) = lines.split_once('\n').unwrap();
    let push = r#"{"at": 0, "do": "set", "points": [9], "velocity": [0, 1]}"#;
    let ends: Vec<&str> = rest.lines().filter(|line| line.starts_with("{\"end\"")).collect();
    std::fs::write(&path, format!("{header}\n{push}\n{}\n", ends.join("\n"))).unwrap();
    let line = refused(1, &["verify", text(&path)]);
    assert!(
        line.contains("the island of point ") && line.contains(" m from the state that was kept at t = "),
        "{line}"
    );
}
