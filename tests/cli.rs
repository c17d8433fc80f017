//! The program as a process: what it writes, its exit codes, its messages.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

#[cfg(unix)]
mod run_script;

use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

fn wobble(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_wobble")).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The one line of an error that ends with exit code 1.
fn failure(arguments: &[&str]) -> String {
    let done = wobble(arguments);
    let error = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{arguments:?}: {error}");
    assert!(done.stdout.is_empty());
    assert!(error.starts_with("wobble: ") && error.ends_with('\n'), "{error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    error
}

fn success(arguments: &[&str]) {
    let done = wobble(arguments);
    assert!(done.status.success(), "{arguments:?}: {}", text(&done.stderr));
}

fn refused(arguments: &[&str]) -> String {
    let done = wobble(arguments);
    assert_eq!(done.status.code(), Some(2), "{arguments:?}: {}", text(&done.stderr));
    text(&done.stderr)
}

fn simulated(arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.json");
    let done = wobble(&[&["simulate"], arguments, &["--out", out.to_str().unwrap()]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    serde_json::from_slice(&std::fs::read(out).unwrap()).unwrap()
}

#[test]
fn what_stands_beside_a_scene_is_measured_against_it_and_changes_nothing_of_it() {
    // A step of 0.1 s: by Euler along the tangent, by Verlet half a s^2 h^2 shorter; semi-implicit Euler goes by twice that.
    let with = simulated(&["slide-circle", "--samples", "0.1,6"]);
    let beside = with["beside"].as_array().unwrap();
    let titles: Vec<&str> = beside.iter().map(|entry| entry["title"].as_str().unwrap()).collect();
    assert_eq!(titles, ["the new velocity for the place: semi-implicit Euler", "Verlet"]);
    assert_eq!((&beside[1]["solver"], &beside[1]["substep"]), (&"verlet".into(), &0.1.into()));
    for (entry, expected) in beside.iter().zip([0.01, 0.005]) {
        let distance: Vec<f64> = entry["distance"].as_array().unwrap().iter().map(|d| d.as_f64().unwrap()).collect();
        assert!((distance[0] - expected).abs() < 1e-8, "{distance:?}");
        assert!(distance[1] > 0.3, "the spiral is wider by a third after a turn: {distance:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let alone = folder.path().join("alone.json");
    let scene = text(&wobble(&["scenes", "slide-circle", "--json"]).stdout);
    let mut scene: Value = serde_json::from_str(&scene).unwrap();
    scene.as_object_mut().unwrap().remove("beside").unwrap();
    std::fs::write(&alone, scene.to_string()).unwrap();
    let without = simulated(&[alone.to_str().unwrap(), "--samples", "0.1,6"]);
    assert_eq!((&with["hash"], without.get("beside")), (&without["hash"], None));
}

#[test]
fn the_gallery_is_listed_a_name_first_on_each_line() {
    let list = text(&wobble(&["scenes"]).stdout);
    let names: Vec<&str> = list.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    let small = [
        "jelly",
        "jelly-stack",
        "pegs",
        "ragdoll",
        "ragdoll-as-printed",
        "wrecking-ball",
        "bridge",
        "catapult",
        "cradle",
        "soft-car",
        "walker",
        "snake",
        "tearable-net",
        "box",
        "box-two-supports",
        "box-as-printed",
        "constraints",
        "points",
        "points-as-printed",
        "random-graph",
        "random-graph-as-printed",
        "rim",
        "rim-relaxed",
        "relaxation",
        "rim-as-printed",
        "spring-damper",
        "spring-damper-as-printed",
        "spring-damper-relative",
        "spring-damper-relative-as-printed",
        "slide-circle",
        "slide-decay",
        "phase-portrait",
        "penalty",
    ];
    let pictures = [
        "image-mesh",
        "image-mesh-as-printed",
        "brush",
        "gear",
        "jellyfish",
        "ring",
        "maze",
        "pebble",
        "picture-obstacle",
    ];
    assert_eq!(
        names,
        [
            &small[..],
            &pictures,
            &[
                "rope",
                "rope-on-cursor",
                "rope-as-printed",
                "net",
                "cloth-wind",
                "cloth-wind-as-printed",
                "thousand-rims",
                "cloth-space",
                "cloth-space-as-printed",
                "cloth-ball",
                "million-cloth",
            ]
        ]
        .concat()
    );
    assert!(list.lines().all(|line| line.ends_with('.') && line.split_whitespace().count() > 5), "{list}");
}

#[test]
fn a_scene_is_printed_and_read_back_expanded_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rim.json");
    let hash = text(&wobble(&["simulate", "rim", "--samples", "0.2", "--hash"]).stdout);
    for options in [&["--json"][..], &["--json", "--expanded"]] {
        let done = wobble(&[&["scenes", "rim"], options].concat());
        std::fs::write(&path, &done.stdout).unwrap();
        let again = wobble(&["simulate", path.to_str().unwrap(), "--samples", "0.2", "--hash"]);
        assert_eq!(text(&again.stdout), hash);
    }
    let schema: Value = serde_json::from_slice(&wobble(&["scenes", "--schema"]).stdout).unwrap();
    assert!(schema["properties"]["bonds"].is_object());
}

#[test]
fn a_recording_has_every_key() {
    let recording = simulated(&["rim", "--samples", "0,0.1,0.25", "--precision", "f32"]);
    let keys: Vec<&str> = recording.as_object().unwrap().keys().map(String::as_str).collect();
    for key in [
        "scene",
        "solver",
        "substep",
        "precision",
        "samples",
        "seconds",
        "frames",
        "search_seconds",
        "counters",
        "warnings",
        "hash",
    ] {
        assert!(keys.contains(&key), "{key}");
    }
    for key in
        ["substeps", "bonds_solved", "points_moved", "iterations", "events", "guard_splits", "fallbacks", "bonds_torn"]
    {
        assert!(recording["counters"][key].is_u64(), "{key}");
    }
    let frames = &recording["frames"];
    assert_eq!(frames["count"], 15, "0.25 s");
    let of = |key: &str| frames[key].as_f64().unwrap();
    assert!(0.0 < of("median_ms") && of("median_ms") <= of("p99_ms") && of("p99_ms") <= of("worst_ms"));
    let again = simulated(&["rim", "--samples", "0,0.1,0.25", "--precision", "f32"]);
    assert!(of("worst_work_ms") > 0.0, "by counting, and so");
    assert_eq!(frames["worst_work_ms"], again["frames"]["worst_work_ms"], "the same in every run");
    assert_eq!(recording["precision"], "f32");
    let samples = recording["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 3);
    assert_eq!(samples[2]["t"], 0.25);
    assert_eq!(samples[2]["position"].as_array().unwrap().len(), 24);
    assert_eq!(samples[0]["velocity"][0], serde_json::json!([0.0, 0.0]));
}

#[test]
fn a_ledger_is_written_where_it_is_asked_for() {
    let plain = simulated(&["rim", "--samples", "0.1,0.2"]);
    assert!(plain["balance"].is_null() && plain["samples"][0]["ledger"].is_null());
    let folder = tempfile::tempdir().unwrap();
    let commands = folder.path().join("none.json");
    std::fs::write(&commands, "[]").unwrap();
    for more in [&[][..], &["--commands", commands.to_str().unwrap()]] {
        let kept = simulated(&[&["rim", "--samples", "0.1,0.2", "--ledger"], more].concat());
        assert_eq!(kept["hash"], plain["hash"], "the same motion");
        let ledger = &kept["samples"][1]["ledger"];
        let of = |key: &str| ledger[key].as_f64().unwrap();
        let brought = of("mouse") + of("grab") + of("pins") + of("commands");
        let taken = of("dampers") + of("drag") + of("friction") + of("impacts") + of("breaks");
        let now = of("kinetic") + of("springs") + of("gravity");
        assert!((now - of("start") - (brought - taken + of("left_over"))).abs() < 1e-9 * now.abs());
        assert!(of("kinetic") > 1.0 && kept["balance"]["is_kept"] == true, "{}", kept["balance"]);
    }
}

#[test]
fn a_table_has_a_row_a_sample_and_point() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.csv");
    assert!(wobble(&["simulate", "points", "--samples", "0.5,1", "--out", out.to_str().unwrap()]).status.success());
    let table = std::fs::read_to_string(out).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!((rows[0], rows.len()), ("t,point,x,y,vx,vy", 21));
    assert!(rows[11].starts_with("1.0,0,"));
    // Bodies are a last column, if they are asked for.
    let with = wobble(&["simulate", "box", "--samples", "0.1", "--bodies", "-q"]);
    let with = text(&with.stdout);
    let without = text(&wobble(&["simulate", "box", "--samples", "0.1", "-q"]).stdout);
    let split: Vec<[&str; 2]> = with.lines().map(|row| row.rsplit_once(',').unwrap().into()).collect();
    assert!(split.iter().map(|[row, _]| *row).eq(without.lines()));
    let bodies: Vec<&str> = split.iter().map(|[_, body]| *body).collect();
    assert_eq!((bodies[0], bodies[1], bodies[bodies.len() - 1]), ("body", "0", "4"), "five boxes");
    // Where nothing else is asked for it goes to the standard output.
    let said = wobble(&["simulate", "points", "--samples", "0.5,1", "-q"]);
    assert_eq!(String::from_utf8(said.stdout).unwrap(), table);
}

#[test]
fn the_call_overrides_the_scene() {
    let one = simulated(&["rim-relaxed", "--samples", "0.6"]);
    let four = simulated(&[
        "rim-relaxed",
        "--samples",
        "0.6",
        "--iterations",
        "4",
        "--order",
        "coloured",
        "--substep",
        "0.003",
    ]);
    let count = |recording: &Value, key: &str| recording["counters"][key].as_u64().unwrap();
    assert_eq!((count(&one, "substeps"), count(&one, "iterations")), (100, 100));
    assert_eq!((count(&four, "substeps"), count(&four, "iterations")), (200, 800));
    assert_eq!(count(&four, "bonds_solved"), 800 * 48);
    assert_ne!(one["hash"], simulated(&["rim-relaxed", "--samples", "0.6", "--seed", "9"])["hash"]);
}

/// A point that flies beyond all numbers within a second.
const UNSTABLE: &str = r#"{ "wobble": 1, "points": { "position": [[0, 1e308]], "velocity": [[0, 1.7e308]] }, "method": { "solver": "verlet" } }"#;

#[test]
fn what_fails_says_so_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.json");
    let bad = path.to_str().unwrap();
    std::fs::write(&path, "{ \"wobble\": 1,\n \"points\": { \"position\": [[0, 0]], \"mass\": [-1] } }").unwrap();
    assert!(failure(&["simulate", bad, "--samples", "1", "--hash"]).contains("bad.json:2: points.mass[0]: "));
    assert!(failure(&["render", bad, "--out", "/tmp/x.png"]).contains("points.mass[0]"));
    assert!(failure(&[bad]).contains("points.mass[0]"));
    assert!(failure(&["scenes", "rimm"]).contains("did you mean `rim`?"));
    assert!(failure(&["simulate", "no-such-file.json", "--samples", "1", "--hash"]).contains("no-such-file.json"));
    assert!(failure(&["simulate", "rim", "--hash"]).contains("give --samples"));
    let recorded = folder.path().join("recorded.json");
    let recorded = recorded.to_str().unwrap();
    success(&["simulate", "spring-damper", "--samples", "0.1", "--record", recorded, "--hash"]);
    assert!(refused(&["simulate", recorded, "--tolerance", "1e-3", "--hash"]).contains("leave --tolerance out"));
    assert!(failure(&["simulate", "rim", "--solver", "relaxation", "--samples", "1", "--hash"]).contains("spring"));
    assert!(
        failure(&["simulate", "rim", "--samples", "1", "--out", "/no/such/folder/x.json"])
            .contains("cannot be written")
    );
    std::fs::write(&path, UNSTABLE).unwrap();
    assert!(failure(&["simulate", bad, "--samples", "200", "--hash"]).contains("smaller substep"));
}

#[test]
fn what_left_the_finite_numbers_is_told_of() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pushed.json");
    let scene = r#"{"wobble": 1, "contact": true, "points": {"position": [[0, 1]]},
        "forces": [{"points": [0], "force": [1e308, 1e308]}]}"#;
    std::fs::write(&file, scene).unwrap();
    let done = wobble(&["simulate", file.to_str().unwrap(), "--samples", "0.5", "-q"]);
    assert!(done.status.success() && text(&done.stderr).contains("an island left the finite numbers"), "{done:?}");
}

/// Whoever asks for a method and gets the live step instead is told, as there convergence means nothing.
#[test]
fn a_method_that_is_asked_for_and_not_kept_is_told_of() {
    let folder = tempfile::tempdir().unwrap();
    let handed = |method: &str, contact: &str| {
        let scene = format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "method": {{{method}"budget": 0.001}}, "contact": {contact},
            "bodies": [{{"make": "rope", "count": 12, "spacing": 0.1, "pinned": [0], "material": {{"kind": "spring", "stiffness": 1000}}}}]}}"#
        );
        let path = folder.path().join("scene.json");
        std::fs::write(&path, scene).unwrap();
        let output = wobble(&["simulate", path.to_str().unwrap(), "--samples", "0.2", "--quiet"]);
        assert!(output.status.success());
        text(&output.stderr).contains("handed to the live step")
    };
    assert!(handed(r#""substep": 0.0001, "#, "false"));
    assert!(!handed(r#""solver": "rk4", "#, "false"), "a method that is named is kept");
    assert!(!handed("", "false"), "whoever asks for nothing gets what moves it best");
    assert!(!handed(r#""substep": 0.0001, "#, "true"), "what may meet is the live step's");
}

#[test]
fn a_tolerance_is_kept_until_bodies_meet() {
    let folder = tempfile::tempdir().unwrap();
    let [scene, out] = ["meet.json", "x.json"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    // Two points in free fall, one above the other and thrown down: they come as near as their skins are thick a little before 0.25 s.
    let write = |contact: bool| {
        let ball = |x: f64, y: f64, v: f64| {
            serde_json::json!({"make": "disc", "radius": 0.2, "spacing": 0.1, "origin": [x, y], "velocity": [0, v],
                "material": {"kind": "rigid"}})
        };
        let bodies = [ball(0.0, 0.0, 0.0), ball(0.0, 1.4, -4.0)];
        let text = serde_json::json!({"wobble": 1, "gravity": [0, -9.81], "contact": contact, "bodies": bodies});
        std::fs::write(&scene, text.to_string()).unwrap();
    };
    let run = |samples: &str| wobble(&["simulate", &scene, "--tolerance", "1e-6", "--samples", samples, "--out", &out]);
    let read = || serde_json::from_str::<Value>(&std::fs::read_to_string(&out).unwrap()).unwrap();
    write(true);
    let done = run("0.05,0.1,0.5,1");
    let said = text(&done.stderr);
    assert!(done.status.code() == Some(1) && said.contains("bodies may meet from t = 0.2"), "{done:?}");
    let kept = read();
    let samples = kept["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 2, "those before the bodies meet");
    assert!(kept["expected_error"].as_f64().unwrap() <= 1e-6);
    let fallen = samples[1]["position"][0][1].as_f64().unwrap() - samples[0]["position"][0][1].as_f64().unwrap();
    assert!((fallen + 0.5 * 9.81 * (0.01 - 0.0025)).abs() < 1e-6, "{fallen}");
    assert!(run("0.05,0.1").status.success(), "nothing meets before that");
    std::fs::remove_file(&out).unwrap();
    let none = run("0.5");
    assert!(none.status.code() == Some(1) && text(&none.stderr).contains("before the first sample"), "{none:?}");
    assert!(!Path::new(&out).exists());
    write(false);
    assert!(run("0.05,0.5").status.success());
}

#[test]
fn a_tolerance_is_kept_or_what_was_reached_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("swing.json"), folder.path().join("x.json"));
    let (scene, out) = (scene.to_str().unwrap(), out.to_str().unwrap());
    std::fs::write(
        scene,
        r#"{ "wobble": 1, "points": { "position": [[0,0],[1,0],[2,0]], "pinned": [0] }, "gravity": [0,-9.81],
             "bonds": [{"a":0,"b":1},{"a":1,"b":2}], "duration": 1 }"#,
    )
    .unwrap();
    let read = || serde_json::from_str::<Value>(&std::fs::read_to_string(out).unwrap()).unwrap();
    success(&["simulate", scene, "--tolerance", "1e-5", "--out", out]);
    let kept = read();
    assert!(kept["expected_error"].as_f64().unwrap() <= 1e-5 && kept["search_seconds"].as_f64().unwrap() > 0.0);
    let said = failure(&["simulate", scene, "--tolerance", "1e-30", "--out", out]);
    assert!(said.contains("an error of 1e-30 m was not reached") && said.contains("comes to"), "{said}");
    assert!(read()["expected_error"].as_f64().unwrap() < 1e-9, "the best is written all the same");
    assert!(
        failure(&["simulate", "rim-relaxed", "--samples", "1", "--tolerance", "1e-3", "--hash"]).contains("no error")
    );
    assert!(failure(&["simulate", scene, "--substep", "1e-320", "--out", out]).contains("at least 1e-12"));
    success(&["simulate", scene, "--settle", "--out", out]);
    assert!((read()["samples"][0]["position"][2][1].as_f64().unwrap() + 2.0).abs() < 1e-12);
    success(&["simulate", "points", "--samples", "1", "--settle", "--out", out]);
    let lies = |x: &Value| (x[1].as_f64().unwrap() + 2.6).abs() < 1e-9;
    assert!(read()["samples"][0]["position"].as_array().unwrap().iter().all(lies), "they lie on the floor");
    std::fs::write(
        scene,
        r#"{ "wobble": 1, "points": {"position": [[0,0],[1,0],[2,0]], "pinned": [0]}, "gravity": [0,-9.81],
             "bonds": [{"a":0,"b":1}], "duration": 1 }"#,
    )
    .unwrap();
    let said = failure(&["simulate", scene, "--settle", "--out", out]);
    assert!(said.contains("point 2 falls for ever") && said.contains("written all the same"), "{said}");
    assert!((read()["samples"][0]["position"][1][1].as_f64().unwrap() + 1.0).abs() < 1e-12, "the rest is settled");
}

#[test]
fn a_wrong_call_ends_with_two() {
    assert!(refused(&["simulate", "rim", "--samples", "2,1", "--hash"]).contains("ascending"));
    assert!(refused(&["simulate", "rim", "--samples", "1", "--substep", "0", "--hash"]).contains("above 0"));
    assert!(refused(&["simulate", "rim", "--samples", "1", "--substep", "nan", "--hash"]).contains("above 0"));
    assert!(refused(&["simulate", "rim", "--samples", "1", "--iterations", "0", "--hash"]).contains("iterations"));
    assert!(refused(&["simulate", "rim", "--samples", "1", "--solver", "warp", "--hash"]).contains("warp"));
    assert!(refused(&["simulate", "rim", "--samples", "1", "--out", "x.txt"]).contains(".json or .csv"));
    assert!(refused(&["render", "rim", "--size", "0x10", "--out", "x.png"]).contains("1280x720"));
    assert!(refused(&["render", "rim", "--out", "x.bmp"]).contains(".png"));
    refused(&["simulate", "rim", "--no-such-option"]);
    refused(&["scenes", "--expanded"]);
}

#[test]
fn a_failed_run_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.json");
    std::fs::write(&out, "old").unwrap();
    let scene = folder.path().join("unstable.json");
    std::fs::write(&scene, UNSTABLE).unwrap();
    failure(&["simulate", scene.to_str().unwrap(), "--samples", "200", "--out", out.to_str().unwrap()]);
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "old");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn times_past_the_end_of_a_scene_are_told_of() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scene, list) = (at("x.json"), at("list.json"));
    let point = r#"{"wobble": 1, "points": {"position": [[0, 0]]}, "gravity": [0, -1], "duration": 0.2}"#;
    std::fs::write(&scene, point).unwrap();
    std::fs::write(&list, r#"[{"at": 0.1, "do": "set", "duration": 0.3}]"#).unwrap();
    let words =
        |end: f64, to: f64| format!("the scene ends at {end} s, where the window stops: this goes on to {to} s");
    for (call, expected) in [
        (&["--samples", "0.1,0.5"][..], Some(words(0.2, 0.5))),
        (&["--samples", "0.2"], None),
        (&[], None),
        (&["--samples", "0.25", "--commands", &list], None),
        (&["--samples", "0.5", "--commands", &list], Some(words(0.3, 0.5))),
    ] {
        let done = wobble(&[&["simulate", &scene, "--hash"], call].concat());
        assert!(done.status.success(), "{call:?}: {}", text(&done.stderr));
        let said = expected.map_or_else(String::new, |words| format!("wobble: warning: {words}\n"));
        assert_eq!(text(&done.stderr), said, "{call:?}");
    }
    let written = simulated(&[&scene, "--samples", "0.5"]);
    assert_eq!(written["warnings"], serde_json::json!([words(0.2, 0.5)]));
}

#[test]
fn a_reader_that_has_enough_is_no_failure() {
    // More than a pipe and all buffers hold, and less.
    let calls: [&[&str]; 5] = [
        &["simulate", "net", "--samples", "0.01,0.02,0.03", "-q"],
        &["simulate", "points", "--samples", "0.1", "-q"],
        &["simulate", "points", "--samples", "0.1", "--hash"],
        &["scenes", "net", "--json", "--expanded"],
        &["scenes"],
    ];
    for call in calls {
        let mut process = Command::new(env!("CARGO_BIN_EXE_wobble"))
            .args(call)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(process.stdout.take());
        let done = process.wait_with_output().unwrap();
        let said = text(&done.stderr);
        assert!(done.status.success() && !said.contains("pipe"), "{call:?}: {:?}: {said}", done.status.code());
    }
}

#[test]
fn what_is_read_is_never_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scene, list, picture, numbered) = (at("x.json"), at("list.json"), at("x.png"), at("frame-0001.png"));
    let point = r#"{"wobble": 1, "points": {"position": [[0, 0]]}, "duration": 1}"#;
    std::fs::write(&scene, point).unwrap();
    std::fs::write(&list, "[]").unwrap();
    plain_picture(Path::new(&picture), [0, 0, 0, 255]);
    plain_picture(Path::new(&numbered), [0, 0, 0, 255]);
    let before = [&scene, &list, &picture, &numbered].map(|path| std::fs::read(path).unwrap());
    let (again, out, frame) = (at("./x.json"), at("out.json"), at("frame.png"));
    let calls: [&[&str]; 10] = [
        &["simulate", &scene, "--out", &scene],
        &["simulate", &scene, "--out", &again],
        &["simulate", &scene, "--record", &scene, "--hash"],
        &["simulate", &scene, "--commands", &list, "--out", &list],
        &["simulate", &scene, "--out", &out, "--record", &out],
        &["render", &picture, "--out", &picture],
        &["render", &numbered, "--frames", "2", "--out", &frame],
        &["mesh", &picture, "--preview", &picture],
        &["replay", &scene, "--out", &scene],
        &["--record", &scene, &scene],
    ];
    for call in calls {
        let said = failure(call);
        assert!(said.contains("is what is read, and would be lost") || said.contains("written twice"), "{said}");
    }
    assert_eq!([&scene, &list, &picture, &numbered].map(|path| std::fs::read(path).unwrap()), before);
    success(&["simulate", &scene, "--out", &out]);
    success(&["simulate", &scene, "--out", &out]);
}

#[test]
fn without_a_driver_one_line_says_what_to_install() {
    let done = Command::new(env!("CARGO_BIN_EXE_wobble"))
        .args(["render", "rim", "--out", "/tmp/never.png"])
        .env("VK_DRIVER_FILES", "/nonexistent.json")
        .env("VK_ICD_FILENAMES", "/nonexistent.json")
        .env("WGPU_BACKEND", "vulkan")
        .output()
        .unwrap();
    let error = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{error}");
    assert!(
        error
            .lines()
            .any(|line| line.starts_with("wobble: no GPU driver found") && line.contains("mesa-vulkan-drivers"))
    );
    assert!(!Path::new("/tmp/never.png").exists());
}

#[test]
fn help_has_examples() {
    for command in [&["--help"][..], &["simulate", "--help"], &["render", "--help"], &["scenes", "--help"]] {
        let done = wobble(command);
        assert!(done.status.success());
        assert!(text(&done.stdout).contains("Examples:"), "{command:?}");
    }
}

#[test]
fn the_readmes_scene_runs() {
    let readme = include_str!("../README.md");
    let scene = readme.split("```json\n").nth(1).unwrap().split("```").next().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my-rope.json");
    std::fs::write(&path, scene).unwrap();
    assert!(wobble(&["simulate", path.to_str().unwrap(), "--hash"]).status.success());
}

#[test]
fn a_slip_of_a_command_is_told_from_a_scene() {
    for call in [&["rendr", "rim"][..], &["rendr", "rim", "--time", "2"], &["rendr"]] {
        let said = refused(call);
        assert!(said.contains("did you mean `wobble render`?") && said.lines().count() == 1, "{call:?}: {said}");
    }
    assert!(refused(&["simulat", "rim", "--samples", "1"]).contains("`wobble simulate`"));
    assert!(failure(&["rimm"]).contains("did you mean `rim`?"), "a scene's name");
    assert!(refused(&["rim", "net"]).contains("net"), "two scenes are no command");
}

/// A picture of one colour.
fn plain_picture(path: &Path, colour: [u8; 4]) {
    let picture = wobble::picture::Picture::filled(60, 40, colour);
    std::fs::write(path, wobble::picture::encode(&picture).unwrap()).unwrap();
}

#[test]
fn pictures_that_cannot_be_had_are_refused_in_our_words() {
    let folder = tempfile::tempdir().unwrap();
    let [nothing, drawing, white] = ["nothere.png", "logo.svg", "white.png"].map(|name| folder.path().join(name));
    std::fs::write(&drawing, "<?xml version=\"1.0\"?>\n<!-- mine -->\n<svg width=\"9\" height=\"9\"/>").unwrap();
    plain_picture(&white, [255; 4]);
    let [nothing, drawing, white] = [&nothing, &drawing, &white].map(|path| path.to_str().unwrap());
    let said = failure(&["mesh", nothing, "--stats"]);
    assert!(said.contains("nothere.png: cannot be found: check the path") && !said.contains("os error"), "{said}");
    for call in [&["mesh", drawing, "--stats"][..], &["simulate", drawing, "--samples", "1", "--hash"], &[drawing]] {
        let said = failure(call);
        assert!(said.contains("logo.svg: is an SVG") && said.contains("export it as a PNG"), "{said}");
    }
    let said = failure(&["simulate", white, "--samples", "1", "--hash"]);
    assert!(said.contains("nothing in the picture") && said.contains("`wobble mesh` has options for that"), "{said}");
    let said = failure(&["mesh", white, "--stats"]);
    assert!(said.contains("or invert") && !said.contains("wobble mesh"), "the options are there: {said}");
    success(&["mesh", white, "--invert", "--stats"]);
}

#[test]
fn grain_and_too_close_a_spacing_are_said_before_points_are_made() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grain.png");
    let mut picture = wobble::picture::Picture::filled(1600, 1200, [255; 4]);
    let mut state = 1_u32;
    for pixel in picture.rgba.chunks_exact_mut(4) {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        pixel[..3].fill((state >> 24) as u8);
    }
    std::fs::write(&path, wobble::picture::encode(&picture).unwrap()).unwrap();
    let start = std::time::Instant::now();
    let said = failure(&["mesh", path.to_str().unwrap(), "--stats"]);
    assert!(said.contains("points") && said.contains("blur it"), "{said}");
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
    let black = folder.path().join("black.png");
    let picture = wobble::picture::Picture::filled(4000, 3000, [0, 0, 0, 255]);
    std::fs::write(&black, wobble::picture::encode(&picture).unwrap()).unwrap();
    let said = failure(&["mesh", black.to_str().unwrap(), "--spacing", "1", "--stats"]);
    let advice = said.split("the most; ").nth(1).unwrap().split(" px would do").next().unwrap();
    let spacing: f64 = advice.parse().unwrap_or_else(|_| panic!("{said}"));
    assert!(spacing > 1.0 && spacing < 4.0, "{said}");
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_work_cleanly() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.json");
    let mut running = Command::new(env!("CARGO_BIN_EXE_wobble"))
        .args(["simulate", "net", "--samples", "10000", "--out", out.to_str().unwrap()])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let interrupted = Command::new("kill").args(["-INT", &running.id().to_string()]).status().unwrap();
    assert!(interrupted.success());
    let start = std::time::Instant::now();
    while running.try_wait().unwrap().is_none() {
        assert!(start.elapsed().as_secs() < 10, "it goes on");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let done = running.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(130));
    assert!(text(&done.stderr).contains("wobble: stopped"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left");
}

#[test]
fn a_tolerance_is_answered_in_few_digits() {
    let done = wobble(&["simulate", "rim", "--samples", "0.05", "--tolerance", "1e-3", "--hash"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let said = text(&done.stderr);
    let digits = said.split("a substep of ").nth(1).unwrap().split(" s").next().unwrap();
    assert!(digits.parse::<f64>().is_ok() && digits.len() <= 9, "{said}");
}

#[cfg(unix)]
#[test]
fn the_run_script_knows_every_command() {
    let script = include_str!("../scripts/run");
    let help = text(&wobble(&["--help"]).stdout);
    let commands = help.split("Commands:").nth(1).unwrap().split("\n\n").next().unwrap();
    let names: Vec<&str> = commands.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.contains(&"mesh") && names.len() >= 7, "{names:?}");
    for name in names {
        let is_case = |line: &&str| line.contains(" kind=") && line.split([' ', ')']).any(|word| word == name);
        assert_eq!(script.lines().filter(is_case).count(), 1, "{name} opens no window");
    }
}
